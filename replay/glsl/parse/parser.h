/* Token stream for the grammar, with macros expanded and up to one token of lookahead. */
#pragma once

#include "replay/glsl/meaning/types.h"
#include "replay/glsl/text/lexer.h"

/** Advance to the next token. */
void parse_advance(struct parse *p);

/** The token after the current one. */
const struct parse_token *parse_peek(struct parse *p);

/** Consume the current token if it is this sign. */
bool parse_accept(struct parse *p, uint32_t sign);

/** Consume this sign, or report an error. */
void parse_expect(struct parse *p, uint32_t sign);

/** As parse_accept, for a keyword: enum parse_keyword */
bool parse_accept_word(struct parse *p, uint32_t keyword);

/** The keyword that a token is in the unit's version. PARSE_TYPE_NAME: a built-in type */
uint32_t parse_keyword(const struct parse *p, const struct parse_token *token);

/** Consume a name that is not a keyword. */
struct parse_name *parse_identifier(struct parse *p);

/** Report that the current token is not allowed by the grammar. */
_Noreturn void parse_unexpected(struct parse *p);
