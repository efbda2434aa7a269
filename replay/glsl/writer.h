/*
 * Translation of a tree to instructions (scene/program.h): the state that the translator's files share, and operands. A
 * value is a list of operands, one for each of its numbers: registers, inputs or constants, in any order, so that
 * swizzles, members and constructors cost nothing.
 *
 * Registers: first the variables of main and global ones; above them, as a stack, temporaries of statements and
 * variables of functions, which are inlined where they are called. A failure is kept: after it, every function does
 * nothing.
 */
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "replay/glsl/tree/tree.h"
#include "replay/glsl/uniforms.h"
#include "replay/programs/code.h"

struct glsl_value {
	uint32_t type; /* index in the tree */
	uint32_t n;
	uint32_t *at;  /* [n] operands; owned by the writer */
};

/* An assignable place, possibly with an array index computed at run time. */
struct glsl_place {
	struct glsl_value value; /* for element 0 */
	uint32_t offset;         /* operand: offset in numbers; GLSL_NONE: none */
	uint32_t limit;          /* offsets are below this */
};

/* Constructs that pixels can leave one by one. */
enum glsl_level_kind { GLSL_LEVEL_IF, GLSL_LEVEL_BREAK, GLSL_LEVEL_CONTINUE, GLSL_LEVEL_RETURN };
struct glsl_level {
	enum glsl_level_kind kind;
	uint32_t mask; /* register: 1 for pixels that are active in it */
};

#define GLSL_MAX_LEVELS 128

struct glsl_writer {
	const struct glsl_tree *tree;
	struct program_code *code;
	enum glsl_stage stage;
	const struct glsl_uniforms *uniforms;
	struct glsl_links *links;
	const char *why; /* why the shader cannot be run: a static string, or `message` */
	char *message;   /* [GLSL_MESSAGE] storage for a reason that contains a name */
	int err;         /* ERR_SYSTEM: out of memory (reported) */
	uint32_t top;    /* first free register */
	uint32_t barrier; /* instructions before this one must not be changed: a jump leads past them, or they set variables */
	struct glsl_value *variables; /* [n_symbols]; .at NULL: not allocated yet */
	uint8_t *written;             /* [n_symbols] 1: assigned somewhere */
	uint8_t *running;             /* [n_functions] 1: being translated */
	struct glsl_level levels[GLSL_MAX_LEVELS];
	uint32_t n_levels;
	struct glsl_value result; /* result of the function being translated */
	const struct glsl_node *last_return; /* its only return, at its end; NULL: it has others */
	uint32_t depth;
	/* Let expressions call statement.c, which is a layer above. */
	struct glsl_value (*call)(struct glsl_writer *w, const struct glsl_node *node);
	struct glsl_value (*choose)(struct glsl_writer *w, const struct glsl_node *node);
	void **blocks; /* memory freed at the end */
	uint32_t n_blocks, block_room;
	size_t memory; /* size of the blocks in bytes */
};

void glsl_fail(struct glsl_writer *w, const char *why);
/**
 * As glsl_fail, with a name from the shader: "a shader calls refract(), which is not supported". @param before, after
 * text around the name
 */
void glsl_fail_at(struct glsl_writer *w, const char *before, const char *name, const char *after);
static inline bool glsl_stopped(const struct glsl_writer *w)
{
	return w->why || w->err;
}

/** Zeroed memory, valid until the writer ends. NULL: none (w has failed) */
void *glsl_alloc(struct glsl_writer *w, size_t n);

/** Allocate n consecutive registers. */
uint32_t glsl_registers(struct glsl_writer *w, uint32_t n);

static inline const struct glsl_type *glsl_type_of(const struct glsl_writer *w, uint32_t type)
{
	return &w->tree->types[type];
}
/** A value of a type in consecutive operands. */
struct glsl_value glsl_row(struct glsl_writer *w, uint32_t type, uint32_t first);
/** A value of n operands that the caller fills in. */
struct glsl_value glsl_value_of(struct glsl_writer *w, uint32_t type, uint32_t n);
/** A value in new registers. */
struct glsl_value glsl_fresh(struct glsl_writer *w, uint32_t type);

/** Operands of literal numbers. */
uint32_t glsl_number(struct glsl_writer *w, float value);
void glsl_numbers(struct glsl_writer *w, const float *values, uint32_t n, uint32_t *at);
/** Append a constant from GL state. @return operand of its first number */
uint32_t glsl_constant(struct glsl_writer *w, const struct program_constant *c);

/**
 * to[i] = f(a[i], b[i], c[i]), for registers from `to` on; register i may only be an i-th operand; b and c may be NULL.
 * flags: SCENE_NEGATE_A ...
 */
void glsl_write(struct glsl_writer *w, enum scene_operation operation, uint32_t flags, uint32_t to, uint32_t n,
                const uint32_t *a, const uint32_t *b, const uint32_t *c);
/** As glsl_write, for one number. @return a new register */
uint32_t glsl_one(struct glsl_writer *w, enum scene_operation operation, uint32_t a, uint32_t b, uint32_t c);
/** Append an instruction as it is. @return its index */
uint32_t glsl_append(struct glsl_writer *w, const struct scene_instruction *in);
/**
 * If the last instruction computed a value, make it write to registers from `top` on instead, whose contents are no
 * longer needed, and free those above.
 */
void glsl_settle(struct glsl_writer *w, uint32_t top, struct glsl_value *v);
/** to = from; they may overlap. `to`: registers */
void glsl_copy(struct glsl_writer *w, const uint32_t *to, const uint32_t *from, uint32_t n);
