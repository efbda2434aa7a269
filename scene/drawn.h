/* Which instance a draw is of. */
#pragma once

#include "scene/scene.h"

/** The last instance that begins with a draw or before it. Instances stand in the order of draws. SCENE_NONE: there is
 * none */
uint32_t scene_instance_of(const struct scene *scene, uint32_t draw);
