/* Reflectance derived from an OpenGL material's specular colour and shininess. */
#pragma once

#include "scene/scene.h"

/**
 * Make a lit surface mirror nearby things as its highlights suggest. Other surfaces stay as they are.
 *
 * A highlight of Blinn and Phong with exponent n is about as wide as that of a surface with roughness sqrt(2 / (n +
 * 2)) (B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces", 2007, eq. 16, inverted). A metal
 * has a coloured highlight that is brighter than its diffuse colour; it mirrors as much as its specular colour says.
 * Other surfaces mirror a tenth of that, like glass and paint.
 *
 * @param share  [0,1]: scales the reflection
 */
void gloss_set(const struct scene_material *m, float share, struct scene_surface *surface);
