/*
 * The commands of OpenGL and of window systems. gen.py generates the table from Khronos' registries, overlay.txt and
 * the handlers.
 *
 * A chapter of replay/gl/ defines one function per command, or per family of commands, with GLS_HANDLER or GLS_FAMILY
 * at the start of a line. That line also gives the command's kind (what the dispatcher does first) and its role in
 * display lists.
 */
#pragma once

#include <stdint.h>

struct call;
struct gls_exec;
struct gls_state;

typedef void gls_handler(struct gls_exec *x, struct gls_state *st, const struct call *c);

/* The work of the dispatcher before a handler runs. */
enum gls_kind {
	GLS_KIND_NONE,
	GLS_KIND_VERTEX, /* vertex attributes: allowed anywhere, compiled into lists, pending vertices stay pending */
	GLS_KIND_INSIDE, /* as VERTEX, but the handler itself deals with pending vertices (Material, CallList, End) */
	GLS_KIND_STATE,  /* outside Begin/End only, compiled into lists; draws pending vertices first, marks material
	                    and view dirty */
	GLS_KIND_MATRIX, /* as STATE, but only the current matrix changes */
	GLS_KIND_ARRAY,  /* draws from client state: outside Begin/End only; a list stores what was drawn */
	GLS_KIND_CLIENT, /* client state: allowed anywhere, never compiled into lists, does not affect pending vertices */
	GLS_KIND_NOW,    /* outside Begin/End only, never compiled into lists: client state, queries */
	GLS_KIND_OBJECT, /* as NOW, for objects that draws use: draws pending vertices first, marks material and view dirty */
	GLS_KIND_WINDOW  /* window system and memory: needs no context, st may be NULL */
};

/* The role of a command in display lists. */
enum gls_role {
	GLS_ROLE_NONE,
	GLS_ROLE_BEGIN, GLS_ROLE_END,
	GLS_ROLE_EDGE_FLAG,
	GLS_ROLE_VERTEX_ATTRIB, /* arguments: number, value */
	GLS_ROLE_MATERIAL,      /* arguments: face, parameter, value */
	GLS_ROLE_BIND_TEXTURE,
	GLS_ROLE_CALL_LIST,
	GLS_ROLE_MARKER, /* arguments: length, text */
	GLS_ROLE_BITMAP,        /* last argument: its pixels */
	GLS_ROLE_TRANSFORM,     /* changes only the current matrix, and never fails */
	GLS_ROLE_PUSH_MATRIX, GLS_ROLE_POP_MATRIX,
	GLS_ROLE_SELECT         /* selects another matrix or texture unit for later commands */
};

/* GLS_HANDLER(name, kind) or GLS_HANDLER(name, kind, role); enumerators without their prefixes. */
#define GLS_HANDLER(name, ...) \
	void gls_##name(struct gls_exec *x __attribute__((unused)), struct gls_state *st __attribute__((unused)), \
	                const struct call *c __attribute__((unused)))

/*
 * GLS_FAMILY(name, ...): the same for every command that is called name plus a suffix of GL 2.1 section 2.3.
 * GLS_FAMILY(glColor, VERTEX) handles glColor3b to glColor4usv.
 */
#define GLS_FAMILY GLS_HANDLER

enum gls_suffix_type {
	GLS_SUFFIX_NONE, GLS_SUFFIX_B, GLS_SUFFIX_UB, GLS_SUFFIX_S, GLS_SUFFIX_US, GLS_SUFFIX_I, GLS_SUFFIX_UI, GLS_SUFFIX_F,
	GLS_SUFFIX_D
};

/* A command's suffix within its family; glVertexAttrib4Nubv: 4, UB, 1, 1. */
struct gls_suffix {
	uint8_t n;          /* components, or dimensions for glTexImage2D; 1 if the name has no number */
	uint8_t type;       /* enum gls_suffix_type */
	uint8_t normalized; /* N: integers are mapped to [0,1] or [-1,1] */
	uint8_t array;      /* v: values are passed as an array */
};

/* Argument numbers of a command that reads pixels from client memory or the bound unpack buffer. */
struct gls_pixel_args {
	int8_t at;     /* the argument that points to the pixels; -1: the command reads none */
	int8_t dims;   /* 1 to 3; 0: not an image, and `width` is the argument with the size in bytes */
	int8_t format, type, width, height, depth; /* argument numbers; -1: GL_COLOR_INDEX, GL_BITMAP, an extent of 1,
	                                              or bytes that no argument gives */
};

enum gls_drawing { GLS_DRAWS = 1, GLS_ENDS }; /* from capture/gen/overlay.txt: only draws; ends a frame */

struct gls_command {
	const char *name;
	const char *excuse; /* why it needs no handler; NULL: it has one, or is not supported yet */
	uint32_t kind;      /* enum gls_kind; GLS_KIND_NONE: no handler */
	uint32_t role;      /* enum gls_role */
	uint16_t core;      /* 1: part of GL 1.0 - 2.1 */
	uint16_t drawing;   /* enum gls_drawing, or 0 */
	struct gls_suffix suffix;
	uint16_t fixed;     /* bit set of arguments in 16.16 fixed point; the handler takes floats (fixed.h) */
	struct gls_pixel_args pixels;
};
extern const struct gls_command gls_commands[]; /* sorted by name */
extern const unsigned n_gls_commands;

/** Index in gls_commands, or -1. */
int32_t gls_command_find(const char *name);
