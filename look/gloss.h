/* What a material of OpenGL's says about how it mirrors: its specular colour, and shininess. */
#pragma once

#include "scene/scene.h"

/**
 * Make a lit surface mirror what is near, in the way that its highlights say. Others stay as they are.
 *
 * A highlight of Blinn and Phong with exponent n is about as wide as that of a surface with roughness sqrt(2 / (n + 2))
 * (B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces", 2007, eq. 16 turned round). A metal's
 * highlight has a colour and is above its diffuse colour: it mirrors as much as its specular colour says. Other
 * surfaces mirror a tenth of that, as glass and paint do.
 *
 * @param share  [0,1]: of all this
 */
void gloss_set(const struct scene_material *m, float share, struct scene_surface *surface);
