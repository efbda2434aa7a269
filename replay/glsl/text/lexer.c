#include "replay/glsl/text/lexer.h"

#include <stdlib.h>
#include <string.h>

const char *parse_lines(struct parse *p, const char *text)
{
	char *const lines = parse_alloc(p, strlen(text) + 1);
	char *to = lines;
	uint32_t joined = 0;

	for (const char *at = text; *at; at++) {
		const bool continues = *at == '\\' && (at[1] == '\n' || at[1] == '\r');
		const char end = at[continues];

		if (end != '\n' && end != '\r') {
			*to++ = *at;
			continue;
		}
		at += continues;
		at += (at[1] == '\n' || at[1] == '\r') && at[1] != end;
		joined += 1;
		for (; joined && !continues; joined--)
			*to++ = '\n';
	}
	return lines;
}

static bool is_letter(char c)
{
	return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
static bool is_digit(char c)
{
	return c >= '0' && c <= '9';
}

static void skip_space(struct parse *p, struct parse_place *place, struct parse_token *token)
{
	for (;; place->at++) {
		const char *at = place->at;

		if (*at == '\n') {
			place->line++;
			place->first = true;
		} else if (at[0] == '/' && at[1] == '/') {
			place->at += strcspn(at, "\n") - 1;
		} else if (at[0] == '/' && at[1] == '*') {
			for (at += 2; at[0] && (at[0] != '*' || at[1] != '/'); at++)
				place->line += *at == '\n';
			p->line = place->line;
			if (!*at)
				parse_error(p, "a comment is not closed");
			place->at = at + 1;
		} else if (*at != ' ' && *at != '\t' && *at != '\v' && *at != '\f') {
			return;
		}
		token->spaced = true;
	}
}

/* Length of a number, well-formed or not. */
static uint32_t number_length(const char *at)
{
	const bool is_hexadecimal = at[0] == '0' && (at[1] | 32) == 'x';
	uint32_t n = 1;

	while (is_letter(at[n]) || is_digit(at[n]) || (at[n] == '.' && !is_hexadecimal) ||
	       ((at[n] == '+' || at[n] == '-') && (at[n - 1] | 32) == 'e' && !is_hexadecimal))
		n++;
	return n;
}

static uint32_t sign_length(const char *at)
{
	static const char longer[][4] = { "<<=", ">>=", "++", "--", "<<", ">>", "<=", ">=", "==", "!=", "&&",
		                          "||",  "^^",  "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "##" };

	for (unsigned i = 0; i < sizeof(longer) / sizeof(longer[0]); i++)
		if (strncmp(at, longer[i], strlen(longer[i])) == 0)
			return (uint32_t)strlen(longer[i]);
	return 1;
}

void parse_lex(struct parse *p, struct parse_place *place, struct parse_token *token)
{
	const char *at;

	*token = (struct parse_token){ 0 };
	skip_space(p, place, token);
	at = token->text = place->at;
	token->line = place->line;
	token->first = place->first;
	place->first = false;
	if (!*at)
		return;
	if (is_letter(*at)) {
		while (is_letter(at[token->n]) || is_digit(at[token->n]))
			token->n++;
		token->kind = PARSE_NAME;
		token->name = parse_name(p, at, token->n);
	} else if (is_digit(at[0]) || (at[0] == '.' && is_digit(at[1]))) {
		token->kind = PARSE_NUMBER;
		token->n = number_length(at);
	} else {
		token->kind = strchr("+-*/%<>=!&|^~?:;,.(){}[]#", *at) ? PARSE_SIGN : PARSE_ODD;
		token->n = token->kind == PARSE_SIGN ? sign_length(at) : 1;
		for (uint32_t i = 0; i < token->n; i++)
			token->sign |= (uint32_t)(unsigned char)at[i] << 8 * i;
	}
	place->at += token->n;
}

bool parse_is_word(const struct parse_token *token, const char *text)
{
	return token->kind == PARSE_NAME && strcmp(token->name->text, text) == 0;
}

static struct parse_literal float_literal(struct parse *p, const struct parse_token *token, const char *text)
{
	char *end;
	const float value = strtof(text, &end);

	if (strcmp(end, "f") == 0 || strcmp(end, "F") == 0)
		end++;
	if (*end)
		parse_error(p, "'%.*s' is not a number", (int)token->n, token->text);
	return (struct parse_literal){ GLSL_FLOAT, value };
}

struct parse_literal parse_literal(struct parse *p, const struct parse_token *token)
{
	char text[64], *end;
	unsigned long long value;
	const bool is_unsigned = (token->text[token->n - 1] | 32) == 'u';
	bool is_hexadecimal;

	if (token->n >= sizeof(text))
		parse_error(p, "a number has too many digits");
	memcpy(text, token->text, token->n);
	text[token->n] = 0;
	is_hexadecimal = text[0] == '0' && (text[1] | 32) == 'x';
	if (!is_hexadecimal && strpbrk(text, ".eEfF"))
		return float_literal(p, token, text);
	value = strtoull(text, &end, 0);
	if (is_unsigned && end[0] && !end[1])
		end += parse_has(p, 130, PARSE_GPU_SHADER4);
	if (*end || value > UINT32_MAX || (is_hexadecimal && !text[2]))
		parse_error(p, "'%.*s' is not a number", (int)token->n, token->text);
	return (struct parse_literal){ is_unsigned ? GLSL_UINT : GLSL_INT,
		                       is_unsigned ? (double)value : (double)(int32_t)(uint32_t)value };
}
