/*
 * A stage while its texts are read: memory, names, how reading ends early. The other files of this room share it.
 *
 * All memory is the arena's and goes when the stage was read. An error leaves by longjmp: no function of the room owns
 * anything else, and none returns an error.
 */
#pragma once

#include <setjmp.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"
#include "replay/glsl/tree/tree.h"

#define PARSE_MAX_DEPTH 400     /* of nodes: deep enough for any shader that people write; the stack holds it */
#define PARSE_MAX_NESTED 1000   /* of brackets, blocks and directives in the text */
#define PARSE_MAX_NUMBERS 65536 /* of a type */
#define PARSE_NAMES 1024

struct parse_macro;
struct parse_binding;
struct parse_function;
struct parse_symbol;
struct parse_type;

/* An identifier; one of each text. */
struct parse_name {
	struct parse_name *next;
	const char *text;
	uint32_t n;
	uint32_t keyword;          /* enum parse_keyword */
	struct parse_macro *macro; /* what the unit has defined and declared under the name, as of now; NULL: nothing */
	struct parse_binding *binding;
	struct parse_function *functions;
	struct parse_symbol *global; /* what any unit of the stage has declared */
	struct parse_function *all_functions;
};

enum parse_kind { PARSE_END, PARSE_NAME, PARSE_NUMBER, PARSE_SIGN, PARSE_ODD };

/* Signs: their characters, first in the low byte. */
#define PARSE_SIGN2(a, b) ((uint32_t)(a) | (uint32_t)(b) << 8)
#define PARSE_SIGN3(a, b, c) (PARSE_SIGN2(a, b) | (uint32_t)(c) << 16)

struct parse_token {
	enum parse_kind kind;
	uint32_t line, n, sign;
	const char *text;        /* [n] */
	struct parse_name *name; /* of a name */
	uint32_t parameter;      /* of a macro's body: 1 + its number; 0: none */
	bool first, spaced;      /* the line begins with it; space stands before it */
	bool painted;            /* a macro's name that is not expanded any more */
};

/* Where reading has come to; may be copied to look ahead. */
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
	bool products_once; /* as of glsl_parse */
	struct parse_name *names[PARSE_NAMES];
	struct parse_type *types[256];
	uint32_t depth;

	/* The unit, which is one shader object. */
	uint32_t n_units;             /* that have begun, this one among them */
	uint32_t version, extensions; /* bits of enum parse_extension */
	bool is_es, is_core, is_prelude;
	struct parse_place place;
	struct parse_condition *conditions;
	struct parse_input *input;
	uint32_t n_expanded;
	uint32_t line;                                            /* of the last token */
	void (*read)(struct parse *p, struct parse_token *token); /* how macro.c reads on: directives stand above it */
	struct parse_token now, next;                             /* what the parser looks at */
	bool has_next;

	/* Declarations: scopes of the unit, then what the stage has of all units. */
	uint32_t scope, n_declared;
	struct parse_binding *bound; /* the last one */
	struct parse_structure *structures;
	struct parse_function *functions, *inside; /* all, the last one first; the one whose body is read */
	struct parse_nodes *root;                  /* what runs before main */
	uint32_t loops, switches;
	bool assigns_color; /* something assigns an output of fragments that the text itself declares */
	bool returns;       /* the function that is read has a return */
};

/** n bytes, all zero. */
void *parse_alloc(struct parse *p, size_t n);

/** Room for one item behind n of them, which may move. */
void *parse_grow(struct parse *p, void *items, uint32_t n, uint32_t *room, size_t item_bytes);

/** The name of a text. */
struct parse_name *parse_name(struct parse *p, const char *text, uint32_t n);

/** End: the shader is right, but not done here. why: a static string */
_Noreturn void parse_refuse(struct parse *p, const char *why);

/** End: the text is wrong, at the line of the last token. */
_Noreturn void parse_error(struct parse *p, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** End: the texts do not fit together. */
_Noreturn void parse_link_error(struct parse *p, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** Into and out of something that nests. */
void parse_enter(struct parse *p);
void parse_leave(struct parse *p);

/** Whether the unit's version is at least this one, or one of these extensions is enabled. */
bool parse_has(const struct parse *p, uint32_t version, uint32_t extensions);
