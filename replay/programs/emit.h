/* Translates instructions on vectors of four, as in assembly programs, to instructions on numbers (scene/program.h). */
#pragma once

#include <stdint.h>

#include "replay/programs/code.h"

/* Four numbers, each a register or a constant. */
struct emit_source {
	uint32_t number[4];
	uint32_t negated; /* bits */
};

/* Four consecutive registers. */
struct emit_target {
	uint32_t first;
	uint32_t mask; /* bits: components that are written */
	int saturates;
};

struct emitter {
	struct program_code *code;
	uint32_t scratch; /* eight registers that nothing else uses */
	int err;          /* the first failure of program_append; later calls do nothing */
};

/** A source with one component replicated to all four. */
struct emit_source emit_splat(const struct emit_source *from, uint32_t component);

/** Four consecutive registers or constants. */
struct emit_source emit_four(uint32_t first);

/** to = f(a, b, c) for each component that is written; b and c may be NULL. The target may also be a source. */
void emit_vector(struct emitter *e, enum scene_operation operation, const struct emit_target *to,
                 const struct emit_source *a, const struct emit_source *b, const struct emit_source *c);

/** All components = f(a.x, b.x). */
void emit_scalar(struct emitter *e, enum scene_operation operation, const struct emit_target *to,
                 const struct emit_source *a, const struct emit_source *b);

/** All components = the sum of the first n products; plus b.w if `homogeneous`. */
void emit_dot(struct emitter *e, const struct emit_target *to, const struct emit_source *a, const struct emit_source *b,
              uint32_t n, int homogeneous);

/** Sample a unit. flags: SCENE_TEXTURE_* */
void emit_texture(struct emitter *e, const struct emit_target *to, const struct emit_source *coordinates, uint32_t unit,
                  uint32_t flags);

/**
 * Fetch element number address + offset, two operands, of an array: four numbers, zeros if out of range. array: its
 * first constant
 */
void emit_fetch(struct emitter *e, uint32_t to, uint32_t array, uint32_t elements, uint32_t address, uint32_t offset);

/** Discard the fragment if a component is below 0. */
void emit_kill(struct emitter *e, const struct emit_source *a);
