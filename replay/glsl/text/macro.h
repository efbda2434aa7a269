/* Macros (GLSL 1.50 sec. 3.3, which refers to C++ for the rest): definitions and expansion. */
#pragma once

#include "replay/glsl/text/context.h"

struct parse_macro {
	bool is_function, busy; /* busy: being expanded, so not expanded again inside */
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

/** Define a macro from a directive's line after its first word. tokens: at least one */
void parse_macro_define(struct parse *p, const struct parse_token *tokens, uint32_t n);

/** Define a macro with a number as its value. */
void parse_macro_set(struct parse *p, const char *name, uint32_t value);

/** The next token of the unit, with macros expanded. */
void parse_macro_next(struct parse *p, struct parse_token *token);

/** Expand macros in a list of tokens. */
struct parse_tokens parse_macro_expand(struct parse *p, const struct parse_token *tokens, uint32_t n);
