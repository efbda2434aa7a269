/* Surfaces that let light pass like a film. */
#pragma once

#include "scene/scene.h"

/**
 * 1 for a lit draw without texture that is blended over the background and lets more than half of it through: OpenGL
 * shows things inside such a shell in full light, but nested shells would block nearly all traced light. Also 1 for a
 * label: an unlit, blended picture perpendicular to the view.
 */
int film_is(const struct scene *scene, const struct scene_instance *instance);
