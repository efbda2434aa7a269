/* From characters to tokens, before macros. */
#pragma once

#include "replay/glsl/text/context.h"

/** A text with one kind of line end, lines that a backslash continues joined, and the lines behind them where they
 * were. */
const char *parse_lines(struct parse *p, const char *text);

/** The next token. What is no part of GLSL is PARSE_ODD: it may stand where nobody reads it. */
void parse_lex(struct parse *p, struct parse_place *place, struct parse_token *token);

/** Whether a token is this sign. */
static inline bool parse_is_sign(const struct parse_token *token, uint32_t sign)
{
	return token->kind == PARSE_SIGN && token->sign == sign;
}
/** Whether it is a name of this text. */
bool parse_is_word(const struct parse_token *token, const char *text);

/* A number of the text. */
struct parse_literal {
	enum glsl_kind kind; /* GLSL_FLOAT, GLSL_INT or GLSL_UINT */
	double value;
};
struct parse_literal parse_literal(struct parse *p, const struct parse_token *token);
