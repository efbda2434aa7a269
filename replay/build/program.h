/* What a draw saw of its fragment program: the program with the numbers of its constants, and the units that it samples. */
#pragma once

#include <stdint.h>

struct gls_attribs;
struct gls_frame;
struct gls_program;
struct gls_state;

/**
 * Put a fragment program into the scene of a frame, with its constants as they are now.
 * @return 1 + where it begins in scene.programs; 0: out of memory (reported)
 */
uint32_t gls_program_build(struct gls_frame *f, const struct gls_state *st, const struct gls_attribs *a, const struct gls_program *p);
