/*
 * The commands of OpenGL and of window systems. gen.py makes the table from Khronos' registries, overlay.txt and the handlers.
 *
 * A chapter defines one function per command, with GLS_HANDLER at the start of a line. The line says what others must know of the
 * command: its kind (what the dispatcher does first) and its role in display lists.
 */
#pragma once

#include <stdint.h>

struct call;
struct gls_exec;
struct gls_state;

typedef void gls_handler(struct gls_exec *x, struct gls_state *st, const struct call *c);

/* What the dispatcher does before a handler runs. */
enum gls_kind {
	GLS_KIND_NONE,
	GLS_KIND_VERTEX, /* vertex attributes: anywhere, kept in lists, pending vertices stay pending */
	GLS_KIND_INSIDE, /* the same, but the handler itself looks after pending vertices (Material, CallList, End) */
	GLS_KIND_STATE,  /* outside Begin/End only, kept in lists; pending vertices are drawn first, material and view are stale */
	GLS_KIND_MATRIX, /* as STATE, but only the current matrix changes */
	GLS_KIND_ARRAY,  /* draws from client state: outside Begin/End only; into a list goes what it drew */
	GLS_KIND_CLIENT, /* client state: anywhere, never kept in lists, changes nothing that is pending */
	GLS_KIND_NOW,    /* outside Begin/End only, never kept in lists: client state, queries */
	GLS_KIND_OBJECT, /* as NOW, for objects that draws use: pending vertices are drawn first, material and view are stale */
	GLS_KIND_WINDOW  /* window system and memory: no context needed, st may be NULL */
};

/* What display lists must know of a command. */
enum gls_role {
	GLS_ROLE_NONE,
	GLS_ROLE_BEGIN, GLS_ROLE_END,
	GLS_ROLE_EDGE_FLAG,
	GLS_ROLE_MATERIAL,      /* arguments: face, parameter, value */
	GLS_ROLE_BIND_TEXTURE,
	GLS_ROLE_CALL_LIST,
	GLS_ROLE_TRANSFORM,     /* changes the current matrix alone, and never fails */
	GLS_ROLE_PUSH_MATRIX, GLS_ROLE_POP_MATRIX,
	GLS_ROLE_SELECT         /* makes later commands mean another matrix or texture unit */
};

/* GLS_HANDLER(name, kind) or GLS_HANDLER(name, kind, role), enumerators without their prefixes. */
#define GLS_HANDLER(name, ...) \
	void gls_##name(struct gls_exec *x __attribute__((unused)), struct gls_state *st __attribute__((unused)), \
	                const struct call *c __attribute__((unused)))

enum gls_drawing { GLS_DRAWS = 1, GLS_ENDS }; /* capture/gen/overlay.txt: does nothing but draw; ends a frame */

struct gls_command {
	const char *name;
	const char *excuse; /* why it needs no handler; NULL: it has one, or is not done yet */
	uint32_t kind;      /* enum gls_kind; GLS_KIND_NONE: there is no handler */
	uint32_t role;      /* enum gls_role */
	uint32_t core;      /* 1: part of GL 1.0 - 2.1 */
	uint32_t drawing;   /* enum gls_drawing, or 0 */
};
extern const struct gls_command gls_commands[]; /* sorted by name */
extern const unsigned n_gls_commands;

/** Index in gls_commands, or -1. */
int32_t gls_command_find(const char *name);
