/* Splits text into tokens, before macro expansion. */
#pragma once

#include "replay/glsl/text/context.h"

/** Normalize line ends, and join lines continued by a backslash while keeping the numbers of later lines. */
const char *parse_lines(struct parse *p, const char *text);

/** The next token. Characters that are not part of GLSL become PARSE_ODD: they are allowed where text is skipped. */
void parse_lex(struct parse *p, struct parse_place *place, struct parse_token *token);

/** True if a token is this sign. */
static inline bool parse_is_sign(const struct parse_token *token, uint32_t sign)
{
	return token->kind == PARSE_SIGN && token->sign == sign;
}
/** True if a token is a name with this text. */
bool parse_is_word(const struct parse_token *token, const char *text);

/* The value of a number. */
struct parse_literal {
	enum glsl_kind kind; /* GLSL_FLOAT, GLSL_INT or GLSL_UINT */
	double value;
};
struct parse_literal parse_literal(struct parse *p, const struct parse_token *token);
