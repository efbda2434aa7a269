/* Varyings that are not interpolated, because all vertices have the same constant there. */
#pragma once

#include "replay/glsl/writer.h"

/* One component of a varying. */
struct glsl_fixed {
	struct program_constant constant; /* in the vertex stage */
	uint32_t part; /* 1 + the index of its number; 0: it is interpolated */
};

/**
 * Find the components that the vertex stage always sets to a uniform, a state value or a number, unchanged. Mesa
 * (22.3.6, nir_link_opt_varyings) does not interpolate these, so they have no rounding errors. Call it before unused
 * constants are removed. Loops that Mesa unrolls and branches that agree are not followed, nor is Mesa 25.0
 * (nir_opt_varyings), which treats built-in varyings and numbers computed from uniforms in the same way.
 * @param fixed  [n], the components of texture coordinates; all 0
 */
void glsl_fix(struct glsl_writer *w, struct glsl_fixed *fixed, uint32_t n);
