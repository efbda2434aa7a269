/* What a draw saw of its programs: each with the numbers of its constants. */
#pragma once

#include <stdint.h>

struct gls_attribs;
struct gls_exec;
struct gls_frame;
struct program_stage;
struct gls_state;

/**
 * 1 where what is drawn is shaded flat. Programs in assembly know no flat colours before Mesa 25.0, and only those that
 * read colours do then.
 */
int gls_shades_flat(const struct gls_state *st);

/**
 * Put a stage's program into the scene of a frame, with its constants as they are now.
 * @param lights  1 << number of each in the material's list
 * @return 1 + where it begins in scene.programs; 0: out of memory (gls_fail)
 */
uint32_t gls_program_build(struct gls_exec *x, struct gls_frame *f, const struct gls_state *st,
                           const struct gls_attribs *a, const struct program_stage *stage, uint32_t lights);
