/*
 * Display lists (GL 2.1 sec. 5.4): what they hold.
 *
 * While a list is made, its calls are kept; numbers of vertices are packed. list_assemble.h makes it cheap to call.
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

/* One call of a list. Its arguments lie in the list's arena. */
struct gls_op {
	uint16_t form;
	uint16_t command;
	uint32_t n; /* arguments, or floats */
	union {
		const struct trace_value *args; /* CALL */
		const float *floats;            /* FLOATS, FLOAT_ARRAY */
		const struct gls_op_mesh *mesh; /* MESH */
	};
	const struct gls_pixel_store *unpack; /* how pixels among the arguments lie; NULL: there are none */
};

/* A batch of Begin and End, or an array draw, assembled when the list was made. */
struct gls_op_mesh {
	struct gls_mesh *mesh; /* a reference, or NULL: only attributes */
	uint32_t before, after; /* attributes set before the first vertex, and to be set after the last: 1 << attribute */
	const float (*before_values)[4], (*after_values)[4]; /* in ascending order of attribute */
	uint32_t n_draws;
	uint32_t first_provokes; /* as it was cut */
};

/* What a list changes if nothing is drawn (effect.c). All zero: not made yet. */
struct gls_effect {
	struct gls_op *ops; /* owned; what they point to belongs to the lists they come from */
	uint32_t n;
	uint32_t pushes, nesting; /* room on the matrix stack and in nested lists that the ops left out would need */
	uint32_t n_made, none;    /* how often it was made; 1: there is none */
	uint64_t epoch;           /* of the share group when it was made, + 1 */
};

struct gls_list {
	struct gls_op *ops;
	uint32_t n, room;
	struct arena arena;
	struct gls_effect effect;
	uint32_t inlined, skipped; /* 1: effects of other lists may hold its ops; how often skipped frames called it */
	uint64_t name[2], bytes, held; /* of its blob; held: of the blob and its meshes together, 0: not known yet
	                                  (index/snapshot.h) */
};
#define GLS_MAX_LIST_NESTING 64
void gls_list_free(struct gls_list *list);
/** Keep a call in the list being compiled. @return 0 or ERR_SYSTEM (reported) */
int gls_list_append(struct gls_exec *x, struct gls_state *st, const struct call *c, uint32_t command);
/** Keep a mesh in it. Takes the reference. @return 0 or ERR_SYSTEM (reported) */
int gls_list_append_mesh(struct gls_exec *x, struct gls_list *list, const struct gls_op_mesh *mesh);

/* ---- ops, for those who make and run lists ---- */

#define GLS_MAX_PACKED 16 /* floats of a packed op */

/** One more op, all zero; NULL: out of memory. */
struct gls_op *gls_list_add(struct gls_list *list);
/**
 * Keep a call in an op, arguments ready for a handler. Floats take eight times their bytes this way.
 * @param unpack  how pixels among them lie; NULL: there are none
 * @return 0 or ERR_SYSTEM
 */
int gls_list_keep(struct gls_list *list, struct gls_op *op, const struct call *c, const struct gls_pixel_store *unpack);
/** What the calls of a list have in common. */
struct call gls_list_call(const struct gls_exec *x);
/**
 * An op as the call it was.
 * @param args  room for GLS_MAX_PACKED values and one more
 * @param c     as gls_list_call made it
 */
void gls_op_unpack(const struct gls_op *op, struct trace_value *args, struct call *c);
/** 1 if the op calls a command of this role. */
static inline int gls_op_is(const struct gls_op *op, enum gls_role role)
{
	return op->form != GLS_OP_MESH && gls_commands[op->command].role == role;
}
