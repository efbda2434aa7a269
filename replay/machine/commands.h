/*
 * The commands of OpenGL and of window systems. gen.py makes the table from Khronos' registries, overlay.txt and the
 * handlers.
 *
 * A chapter defines one function per command, or per family of commands, with GLS_HANDLER or GLS_FAMILY at the start of
 * a line. The line says what others must know of the command: its kind (what the dispatcher does first) and its role in
 * display lists.
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
	GLS_KIND_STATE,  /* outside Begin/End only, kept in lists; pending vertices are drawn first, material and view
	                    are stale */
	GLS_KIND_MATRIX, /* as STATE, but only the current matrix changes */
	GLS_KIND_ARRAY,  /* draws from client state: outside Begin/End only; into a list goes what it drew */
	GLS_KIND_CLIENT, /* client state: anywhere, never kept in lists, changes nothing that is pending */
	GLS_KIND_NOW,    /* outside Begin/End only, never kept in lists: client state, queries */
	GLS_KIND_OBJECT, /* as NOW, for objects that draws use: pending vertices are drawn first, material and view are
	                    stale */
	GLS_KIND_WINDOW  /* window system and memory: no context needed, st may be NULL */
};

/* What display lists must know of a command. */
enum gls_role {
	GLS_ROLE_NONE,
	GLS_ROLE_BEGIN, GLS_ROLE_END,
	GLS_ROLE_EDGE_FLAG,
	GLS_ROLE_VERTEX_ATTRIB, /* arguments: number, value */
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

/*
 * GLS_FAMILY(name, ...): the same for all commands that are called name and a suffix of GL 2.1 section 2.3.
 * GLS_FAMILY(glColor, VERTEX) handles glColor3b to glColor4usv.
 */
#define GLS_FAMILY GLS_HANDLER

enum gls_suffix_type {
	GLS_SUFFIX_NONE, GLS_SUFFIX_B, GLS_SUFFIX_UB, GLS_SUFFIX_S, GLS_SUFFIX_US, GLS_SUFFIX_I, GLS_SUFFIX_UI, GLS_SUFFIX_F,
	GLS_SUFFIX_D
};

/* What the suffix of a command in a family says; glVertexAttrib4Nubv: 4, UB, 1, 1. */
struct gls_suffix {
	uint8_t n;          /* components or, of glTexImage2D, dimensions; 1 where the name has no number */
	uint8_t type;       /* enum gls_suffix_type */
	uint8_t normalized; /* N: integers stand for [0,1] or [-1,1] */
	uint8_t array;      /* v: the values come as an array */
};

/* Where the arguments are that say which pixels, in client memory or in the bound unpack buffer, a command reads. */
struct gls_pixel_args {
	int8_t at;     /* the argument that points to them; -1: the command reads none */
	int8_t dims;   /* 1 to 3; 0: they are no image, and `width` is the argument with their bytes */
	int8_t format, type, width, height, depth; /* arguments; -1: GL_COLOR_INDEX, GL_BITMAP, an extent of 1, bytes
	                                              that no argument says */
};

enum gls_drawing { GLS_DRAWS = 1, GLS_ENDS }; /* capture/gen/overlay.txt: does nothing but draw; ends a frame */

struct gls_command {
	const char *name;
	const char *excuse; /* why it needs no handler; NULL: it has one, or is not done yet */
	uint32_t kind;      /* enum gls_kind; GLS_KIND_NONE: there is no handler */
	uint32_t role;      /* enum gls_role */
	uint16_t core;      /* 1: part of GL 1.0 - 2.1 */
	uint16_t drawing;   /* enum gls_drawing, or 0 */
	struct gls_suffix suffix;
	uint16_t fixed;     /* bits of its arguments that are 16.16 fixed point; the handler takes floats (fixed.h) */
	struct gls_pixel_args pixels;
};
extern const struct gls_command gls_commands[]; /* sorted by name */
extern const unsigned n_gls_commands;

/** Index in gls_commands, or -1. */
int32_t gls_command_find(const char *name);
