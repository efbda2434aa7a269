/*
 * State of the parser while it reads the texts of a stage: memory, names, error exits. Shared by replay/glsl's front
 * end.
 *
 * All memory comes from the arena, and is freed when the stage has been read. An error exits through longjmp: no
 * function owns anything else, and none returns an error.
 */
#pragma once

#include <setjmp.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "replay/glsl/tree/tree.h"

#define PARSE_MAX_DEPTH 400     /* for nodes: deep enough for any real shader, and safe for the stack */
#define PARSE_MAX_NESTED 1000   /* nesting of brackets, blocks and directives in the text */
#define PARSE_MAX_NUMBERS 65536 /* per type */
#define PARSE_NAMES 1024

struct parse_macro;
struct parse_binding;
struct parse_function;
struct parse_symbol;
struct parse_type;

/* An identifier; equal texts share one. */
struct parse_name {
	struct parse_name *next;
	const char *text;
	uint32_t n;
	uint32_t keyword;          /* enum parse_keyword */
	struct parse_macro *macro; /* bindings in the current unit at this point; NULL: none */
	struct parse_binding *binding;
	struct parse_function *functions;
	struct parse_symbol *global; /* declarations in any unit of the stage */
	struct parse_function *all_functions;
};

enum parse_kind { PARSE_END, PARSE_NAME, PARSE_NUMBER, PARSE_SIGN, PARSE_ODD };

/* Signs: their characters, the first in the low byte. */
#define PARSE_SIGN2(a, b) ((uint32_t)(a) | (uint32_t)(b) << 8)
#define PARSE_SIGN3(a, b, c) (PARSE_SIGN2(a, b) | (uint32_t)(c) << 16)

struct parse_token {
	enum parse_kind kind;
	uint32_t line, n, sign;
	const char *text;        /* [n] */
	struct parse_name *name; /* if it is a name */
	uint32_t parameter;      /* in a macro's body: 1 + number of the parameter; 0: none */
	bool first, spaced;      /* first: first token of its line; spaced: preceded by white space */
	bool painted;            /* the name of a macro that must not be expanded any more */
};

/* Position in the text; may be copied to look ahead. */
struct parse_place {
	const char *at;
	uint32_t line;
	bool first;
};

enum parse_extension {
	PARSE_PLAIN_EXTENSION = 1,
	PARSE_GPU_SHADER4 = 2,
	PARSE_TEXTURE_LOD = 4,
	PARSE_LOCATIONS = 8,
	PARSE_PACK = 16,
	PARSE_TRINARY = 32,
	PARSE_ARRAYS = 64,
	PARSE_GPU_SHADER5 = 128,
	PARSE_INSTANCED = 256,
	PARSE_COORD_LAYOUT = 512,
	PARSE_BLOCKS = 1024
};

struct parse {
	struct arena arena;
	size_t bytes;
	jmp_buf stop;
	int err;         /* ERR_SYSTEM: out of memory (reported) */
	const char *why; /* a static string, or `message` */
	char message[GLSL_MESSAGE];
	enum glsl_stage stage;
	bool products_once; /* parameter of glsl_parse */
	struct parse_name *names[PARSE_NAMES];
	struct parse_type *types[256];
	uint32_t depth;

	/* The current unit, which is one shader object. */
	uint32_t n_units;             /* number of units begun, including this one */
	uint32_t version, extensions; /* bits of enum parse_extension */
	bool is_es, is_core, is_prelude;
	struct parse_place place;
	struct parse_condition *conditions;
	struct parse_input *input;
	uint32_t n_expanded;
	uint32_t line;                                            /* the last token's */
	void (*read)(struct parse *p, struct parse_token *token); /* next token before macro expansion: lets macro.c
	                                                             call directive.c, which is a layer above */
	struct parse_token now, next;                             /* current token and lookahead */
	bool has_next;

	/* Declarations: scopes of the unit, then those of all units of the stage. */
	uint32_t scope, n_declared;
	struct parse_binding *bound; /* the last binding made */
	struct parse_structure *structures;
	struct parse_function *functions, *inside; /* all, in reverse order; the one whose body is being parsed */
	struct parse_nodes *root;                  /* statements that run before main */
	uint32_t loops, switches;
	bool assigns_color; /* a user-defined fragment output is assigned */
	bool returns;       /* the current function has a return */
};

/** n zeroed bytes. */
void *parse_alloc(struct parse *p, size_t n);

/** Make room for one item after n of them, which may move. */
void *parse_grow(struct parse *p, void *items, uint32_t n, uint32_t *room, size_t item_bytes);

/** The name object of a text. */
struct parse_name *parse_name(struct parse *p, const char *text, uint32_t n);

/** Stop: the shader is valid, but not supported. why: a static string */
_Noreturn void parse_refuse(struct parse *p, const char *why);

/** Stop: the text is invalid at the line of the last token. */
_Noreturn void parse_error(struct parse *p, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** Stop: the units do not fit together. */
_Noreturn void parse_link_error(struct parse *p, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** Enter and leave a nested construct. */
void parse_enter(struct parse *p);
void parse_leave(struct parse *p);

/** True if the unit's version is at least this one, or one of these extensions is enabled. */
bool parse_has(const struct parse *p, uint32_t version, uint32_t extensions);
