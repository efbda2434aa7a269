/*
 * The sides of a triangle that rays to lights pass, of surfaces that block light only on the sides that they do not
 * show (SCENE_ONE_SIDED), as far as they are the same for all rays: transparency_meets_shown, triangle by triangle.
 */
#pragma once

#include "kernels/shared.h"
#include "tracer/frame/place/opacity_cells.h"

/* How a modelview matrix turns a mesh: bits. */
#define OPACITY_MIRRORED 1u
#define OPACITY_WARPED 2u /* by more than rotation, uniform scale and translation: angles change */

uint32_t opacity_turn_of(const struct instance *instance);

/**
 * The sides of a triangle that rays to lights pass: INSTANCE_PASS_*.
 * @param sure  receives 0 if that is not known
 */
uint32_t opacity_sides_of(const struct opacity_surface *s, uint32_t turn, const uint32_t index[3], int *sure);
