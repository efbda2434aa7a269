/*
 * From a tree to instructions (scene/program.h): what the files of this room share, and operands. A value is a list of
 * operands, one for each of its numbers: registers, inputs or constants, in any order, so that swizzles, members and
 * constructors cost nothing.
 *
 * Registers: variables of main and of the text's own level first, then, as a stack, what a statement computes and what
 * functions keep, which are written where they are called. A failure sticks: all that follows does nothing.
 */
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "replay/glsl/tree/tree.h"
#include "replay/glsl/uniforms.h"
#include "replay/programs/code.h"

struct glsl_value {
	uint32_t type; /* in the tree */
	uint32_t n;
	uint32_t *at;  /* [n] operands; the writer's, until it ends */
};

/* What can be assigned, or read: numbers of which some array's element is chosen at run time. */
struct glsl_place {
	struct glsl_value value; /* of its first element */
	uint32_t offset;         /* operand: how many numbers further; GLSL_NONE: none */
	uint32_t limit;          /* offsets are below it */
};

/* What can end before its text does: pixels leave it one by one. */
enum glsl_level_kind { GLSL_LEVEL_IF, GLSL_LEVEL_BREAK, GLSL_LEVEL_CONTINUE, GLSL_LEVEL_RETURN };
struct glsl_level {
	enum glsl_level_kind kind;
	uint32_t mask; /* register: 1 where a pixel is in it */
};

#define GLSL_MAX_LEVELS 128

struct glsl_writer {
	const struct glsl_tree *tree;
	struct program_code *code;
	enum glsl_stage stage;
	const struct glsl_uniforms *uniforms;
	struct glsl_links *links;
	const char *why; /* what stands in the way: a static string, or `message` */
	char *message;   /* [GLSL_MESSAGE] room for a reason that names something */
	int err;         /* ERR_SYSTEM: out of memory (reported) */
	uint32_t top;    /* first free register */
	uint32_t barrier; /* instructions before this number are not changed any more: something jumps behind them, or
	                     they set variables */
	struct glsl_value *variables; /* [n_symbols]; at NULL: it has no place yet */
	uint8_t *written;             /* [n_symbols] 1: something assigns it */
	uint8_t *running;             /* [n_functions] 1: it is being written */
	struct glsl_level levels[GLSL_MAX_LEVELS];
	uint32_t n_levels;
	struct glsl_value result; /* of the function that is being written */
	const struct glsl_node *last_return; /* its only return, with which it ends; NULL: it has others */
	uint32_t depth;
	/* How expressions reach statement.c, which stands above them. */
	struct glsl_value (*call)(struct glsl_writer *w, const struct glsl_node *node);
	struct glsl_value (*choose)(struct glsl_writer *w, const struct glsl_node *node);
	void **blocks; /* memory that is freed at the end */
	uint32_t n_blocks, block_room;
	size_t memory; /* bytes in them */
};

void glsl_fail(struct glsl_writer *w, const char *why);
/** The same with a name of the shader's: "a shader calls refract(), which is not done". @param before, after  of the
 * name */
void glsl_fail_at(struct glsl_writer *w, const char *before, const char *name, const char *after);
static inline bool glsl_stopped(const struct glsl_writer *w)
{
	return w->why || w->err;
}

/** Memory until the writer ends, all zero. NULL: none (w has failed) */
void *glsl_alloc(struct glsl_writer *w, size_t n);

/** n registers in a row. */
uint32_t glsl_registers(struct glsl_writer *w, uint32_t n);

static inline const struct glsl_type *glsl_type_of(const struct glsl_writer *w, uint32_t type)
{
	return &w->tree->types[type];
}
/** Numbers of a type, all in a row from an operand on; `n` of them. */
struct glsl_value glsl_row(struct glsl_writer *w, uint32_t type, uint32_t first);
/** A value of n operands to be filled in. */
struct glsl_value glsl_value_of(struct glsl_writer *w, uint32_t type, uint32_t n);
/** A value in new registers. */
struct glsl_value glsl_fresh(struct glsl_writer *w, uint32_t type);

/** Operands of numbers that are the same whatever runs. */
uint32_t glsl_number(struct glsl_writer *w, float value);
void glsl_numbers(struct glsl_writer *w, const float *values, uint32_t n, uint32_t *at);
/** A constant of the state, behind the last one. @return its first number's operand */
uint32_t glsl_constant(struct glsl_writer *w, const struct program_constant *c);

/** to[i] = f(a[i], b[i], c[i]), registers from `to` on, of which i may be among the i-th operands alone; b and c may be
 * NULL. flags: SCENE_NEGATE_A ... */
void glsl_write(struct glsl_writer *w, enum scene_operation operation, uint32_t flags, uint32_t to, uint32_t n,
                const uint32_t *a, const uint32_t *b, const uint32_t *c);
/** The same of one number. @return a new register */
uint32_t glsl_one(struct glsl_writer *w, enum scene_operation operation, uint32_t a, uint32_t b, uint32_t c);
/** An instruction as it stands. @return its number */
uint32_t glsl_append(struct glsl_writer *w, const struct scene_instruction *in);
/** Where the last instruction has made a value, have it made in registers from `top` on, what lay there being of no use
 * any more. */
void glsl_settle(struct glsl_writer *w, uint32_t top, struct glsl_value *v);
/** to = from, whatever they share. `to`: registers */
void glsl_copy(struct glsl_writer *w, const uint32_t *to, const uint32_t *from, uint32_t n);
