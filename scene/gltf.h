/*
 * A scene as glTF 2.0, for programs that know neither OpenGL nor Relume (modellers, other renderers).
 *
 * Mapping
 *   eye space      the file's space: glTF's camera looks along -z with y up as GL's does, so the viewer is the origin.
 *                  Views that share an eye space are one glTF scene; the one with most primitives is the default
 *   instances      nodes, with the modelview as matrix; if that is not a translation, rotation and scale (glTF 2.0
 *                  sec. 5.25), the vertices are written in eye space instead
 *   projections    cameras; a frustum that is not symmetric becomes the symmetric one with the same angles
 *   materials      metallic-roughness: diffuse is the base colour; roughness from the specular exponent n by
 *                  alpha^2 = 2/(n+2) (Walter et al. 2007, Beckmann width); unlit draws are KHR_materials_unlit;
 *                  rtMaterialEXT's mirrors are metals, its glass KHR_materials_transmission. Colours become linear
 *   textures       the 2D or rectangle texture that holds a draw's colour (gltf_looks.h), level 0, as PNG; the texture
 *                  matrix is applied to the coordinates. The image's first row is t = 0, as glTF requires
 *   lights         KHR_lights_punctual, in lux and candela. A light of diffuse colour 1 lights a white surface to a
 *                  radiance of 1 W/(sr m^2), a luminance of 683 cd/m^2 (683 lm/W). glTF has only inverse-square
 *                  falloff, so a positional light does so at the distance of the middle of the drawn geometry
 * Features that glTF lacks are dropped and counted: generated texture coordinates, further texture units, blending
 * other than by alpha, fog, stipples, draws without colour. Drawing order is lost.
 */
#pragma once

#include <stdio.h>

#include "scene/scene.h"

/** Losses in the conversion to glTF, as counts of instances unless another thing is named. */
struct gltf_losses {
	uint32_t no_color;   /* draws that write no colour: omitted */
	uint32_t texgen;     /* drawn with generated texture coordinates: exported without texture */
	uint32_t more_units; /* used more than one texture */
	uint32_t blended;    /* blended, but not by source alpha: exported as if by source alpha */
	uint32_t fogged;
	uint32_t infinite;   /* vertices at or beyond infinity: omitted */
};

/**
 * Write a scene as one binary glTF file (.glb).
 * @param out     open for writing, and left open; may be a pipe, as nothing is sought
 * @param where   for messages
 * @param losses  filled
 * @return 0, ERR_SYSTEM (reported; the file is incomplete) or ERR_INPUT (reported: nothing to export, or over 4 GiB)
 */
int gltf_write(FILE *out, const char *where, const struct scene *scene, struct gltf_losses *losses);
