/* Macros (GLSL 1.50 sec. 3.3; what that leaves to C++ is as there): what is defined, and tokens with macros expanded.
 */
#pragma once

#include "replay/glsl/text/context.h"

struct parse_macro {
	bool is_function, busy; /* busy: its text is being read; it does not expand there */
	bool is_line;           /* __LINE__ */
	uint32_t n_parameters, n_body;
	struct parse_name **parameters;
	struct parse_token *body;
};

/* A list of tokens. */
struct parse_tokens {
	struct parse_token *at;
	uint32_t n, room;
};
void parse_tokens_add(struct parse *p, struct parse_tokens *list, const struct parse_token *token);

/** Define what a directive's line says behind its first word. tokens: at least one */
void parse_macro_define(struct parse *p, const struct parse_token *tokens, uint32_t n);

/** Define a word as a number. */
void parse_macro_set(struct parse *p, const char *name, uint32_t value);

/** The next token of the unit, macros expanded. */
void parse_macro_next(struct parse *p, struct parse_token *token);

/** A list with macros expanded. */
struct parse_tokens parse_macro_expand(struct parse *p, const struct parse_token *tokens, uint32_t n);
