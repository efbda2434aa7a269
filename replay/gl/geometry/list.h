/*
 * Contents of display lists (GL 2.1 sec. 5.4).
 *
 * While a list is compiled, its calls are stored; vertex data is packed. list_assemble.h then makes it cheap to call.
 */
#pragma once

#include <stdint.h>

#include "base/arena.h"
#include "replay/machine/commands.h"

struct call;
struct gls_exec;
struct gls_mesh;
struct gls_pixel_store;
struct gls_state;
struct trace_value;

enum gls_op_form { GLS_OP_CALL, GLS_OP_FLOATS, GLS_OP_FLOAT_ARRAY, GLS_OP_MESH };

/* One call of a list. Its arguments are in the list's arena. */
struct gls_op {
	uint16_t form;
	uint16_t command;
	uint32_t n; /* number of arguments, or of floats */
	union {
		const struct trace_value *args; /* for CALL */
		const float *floats;            /* for FLOATS, FLOAT_ARRAY */
		const struct gls_op_mesh *mesh; /* for MESH */
	};
	const struct gls_pixel_store *unpack; /* layout of pixels among the arguments; NULL: none */
};

/* A batch of Begin/End pairs, or an array draw, assembled when the list was compiled. */
struct gls_op_mesh {
	struct gls_mesh *mesh; /* a reference, or NULL: attributes only */
	uint32_t before, after; /* bit sets of attributes to set before the first vertex, and after the last: 1 << attribute */
	const float (*before_values)[4], (*after_values)[4]; /* in ascending order of attribute */
	uint32_t n_draws;
	uint32_t given;          /* as in gls_event */
	uint32_t first_provokes; /* convention used to split it */
};

/* The effect of a list if nothing is drawn (effect.c). All zero: not derived yet. */
struct gls_effect {
	struct gls_op *ops; /* owned; their data belongs to the lists they come from */
	uint32_t n;
	uint32_t pushes, nesting; /* room on the matrix stack and in nested lists that the omitted ops would need */
	uint32_t n_made, none;    /* times it was derived; 1: there is no effect */
	uint64_t epoch;           /* 1 + epoch of the share group when it was derived */
};

struct gls_list {
	struct gls_op *ops;
	uint32_t n, room;
	struct arena arena;
	struct gls_effect effect;
	uint32_t inlined, skipped; /* 1: effects of other lists may contain its ops; number of calls from skipped frames */
	uint64_t name[2], bytes, held; /* its blob's; held: size of the blob and its meshes together, 0: unknown
	                                  (index/snapshot.h) */
};
#define GLS_MAX_LIST_NESTING 64
void gls_list_free(struct gls_list *list);
/** Add a call to the list being compiled. @return 0 or ERR_SYSTEM (reported) */
int gls_list_append(struct gls_exec *x, struct gls_state *st, const struct call *c, uint32_t command);
/** Add a mesh to a list. Takes the reference. @return 0 or ERR_SYSTEM (reported) */
int gls_list_append_mesh(struct gls_exec *x, struct gls_list *list, const struct gls_op_mesh *mesh);

/* ---- ops, for code that compiles and runs lists ---- */

#define GLS_MAX_PACKED 16 /* most floats in a packed op */

/** Add an op, all zero; NULL: out of memory. */
struct gls_op *gls_list_add(struct gls_list *list);
/**
 * Store a call in an op, with arguments ready for a handler. Floats take eight times their size in this form.
 * @param unpack  layout of pixels among them; NULL: none
 * @return 0 or ERR_SYSTEM
 */
int gls_list_keep(struct gls_list *list, struct gls_op *op, const struct call *c, const struct gls_pixel_store *unpack);
/** The members that all calls of a list have in common. */
struct call gls_list_call(const struct gls_exec *x);
/**
 * Restore the call that an op was made from.
 * @param args  room for GLS_MAX_PACKED + 1 values
 * @param c     as gls_list_call made it
 */
void gls_op_unpack(const struct gls_op *op, struct trace_value *args, struct call *c);
/** 1 if the op calls a command with this role. */
static inline int gls_op_is(const struct gls_op *op, enum gls_role role)
{
	return op->form != GLS_OP_MESH && gls_commands[op->command].role == role;
}
