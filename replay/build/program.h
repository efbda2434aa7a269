/* The programs of a draw, each with the values of its constants. */
#pragma once

#include <stdint.h>

struct gls_attribs;
struct gls_exec;
struct gls_frame;
struct program_stage;
struct gls_state;

/**
 * 1 if draws are flat shaded. Assembly programs ignore flat shading before Mesa 25.0; from then on it applies only to
 * those that read colours.
 */
int gls_shades_flat(const struct gls_state *st);

/**
 * Put a stage's program into the scene of a frame, with the present values of its constants.
 * @param lights  1 << number of each in the material's list
 * @return 1 + its first index in scene.programs; 0: out of memory (gls_fail)
 */
uint32_t gls_program_build(struct gls_exec *x, struct gls_frame *f, const struct gls_state *st,
                           const struct gls_attribs *a, const struct program_stage *stage, uint32_t lights);
