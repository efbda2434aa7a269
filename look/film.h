/* What lies in a lit world as a film does: light passes. */
#pragma once

#include "scene/scene.h"

/**
 * 1 for a lit draw without texture that is blended over what lies behind it and lets more than half of that through:
 * OpenGL shows what lies within such a shell in full light, and shells one in another would leave little of it. 1 also
 * for a label: an unlit, blended picture that lies straight across the view.
 */
int film_is(const struct scene *scene, const struct scene_instance *instance);
