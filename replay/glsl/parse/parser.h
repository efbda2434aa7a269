/* Tokens as the grammar takes them, macros expanded: one is looked at, and sometimes the one behind it. */
#pragma once

#include "replay/glsl/meaning/types.h"
#include "replay/glsl/text/lexer.h"

/** Go on to the next token. */
void parse_advance(struct parse *p);

/** The token behind the one that is looked at. */
const struct parse_token *parse_peek(struct parse *p);

/** Go on if the token is this sign. */
bool parse_accept(struct parse *p, uint32_t sign);

/** Go on if it is, and end if not. */
void parse_expect(struct parse *p, uint32_t sign);

/** The same of keywords: enum parse_keyword */
bool parse_accept_word(struct parse *p, uint32_t keyword);

/** The keyword that a token is in the unit's version. PARSE_TYPE_NAME: a type of the language */
uint32_t parse_keyword(const struct parse *p, const struct parse_token *token);

/** Take a name that is no keyword. */
struct parse_name *parse_identifier(struct parse *p);

/** End: a token stands where the grammar has none. */
_Noreturn void parse_unexpected(struct parse *p);
