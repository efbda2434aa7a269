#include "replay/glsl/text/condition.h"

#include "replay/glsl/text/lexer.h"
#include "replay/glsl/text/macro.h"

struct reading {
	struct parse *p;
	const struct parse_token *at, *end;
	uint32_t unread; /* above 0: the value is not used, as after `0 &&` */
};

static bool takes(struct reading *r, uint32_t sign)
{
	const bool is_there = r->at < r->end && parse_is_sign(r->at, sign);

	r->at += is_there;
	return is_there;
}

static uint32_t precedence(uint32_t sign)
{
	switch (sign) {
	case '*':
	case '/':
	case '%': return 10;
	case '+':
	case '-': return 9;
	case PARSE_SIGN2('<', '<'):
	case PARSE_SIGN2('>', '>'): return 8;
	case '<':
	case '>':
	case PARSE_SIGN2('<', '='):
	case PARSE_SIGN2('>', '='): return 7;
	case PARSE_SIGN2('=', '='):
	case PARSE_SIGN2('!', '='): return 6;
	case '&': return 5;
	case '^': return 4;
	case '|': return 3;
	case PARSE_SIGN2('&', '&'): return 2;
	case PARSE_SIGN2('|', '|'): return 1;
	default: return 0;
	}
}

static int32_t apply(struct reading *r, uint32_t sign, int32_t a, int32_t b)
{
	const uint32_t x = (uint32_t)a, y = (uint32_t)b;

	switch (sign) {
	case '*': return (int32_t)(x * y);
	case '/':
	case '%':
		if (!b && !r->unread)
			parse_error(r->p, "a condition divides by 0");
		if (!b || b == -1)
			return sign == '/' ? (int32_t)(0u - x) : 0;
		return sign == '/' ? a / b : a % b;
	case '+': return (int32_t)(x + y);
	case '-': return (int32_t)(x - y);
	case PARSE_SIGN2('<', '<'): return (int32_t)(x << (y & 31));
	case PARSE_SIGN2('>', '>'): return a >> (y & 31);
	case '<': return a < b;
	case '>': return a > b;
	case PARSE_SIGN2('<', '='): return a <= b;
	case PARSE_SIGN2('>', '='): return a >= b;
	case PARSE_SIGN2('=', '='): return a == b;
	case PARSE_SIGN2('!', '='): return a != b;
	case '&': return a & b;
	case '^': return a ^ b;
	case '|': return a | b;
	case PARSE_SIGN2('&', '&'): return a && b;
	default: return a || b;
	}
}

static int32_t level(struct reading *r, uint32_t lowest);

static int32_t operand(struct reading *r)
{
	int32_t value;

	parse_enter(r->p);
	if (takes(r, '-'))
		value = (int32_t)(0u - (uint32_t)operand(r));
	else if (takes(r, '+'))
		value = operand(r);
	else if (takes(r, '!'))
		value = !operand(r);
	else if (takes(r, '~'))
		value = ~operand(r);
	else if (takes(r, '(')) {
		value = level(r, 1);
		if (!takes(r, ')'))
			parse_error(r->p, "a condition lacks a ')'");
	} else if (r->at < r->end && r->at->kind == PARSE_NUMBER) {
		const struct parse_literal number = parse_literal(r->p, r->at++);

		if (number.kind == GLSL_FLOAT)
			parse_error(r->p, "a condition has a number that is not an integer");
		value = (int32_t)(uint32_t)(int64_t)number.value;
	} else if (r->at < r->end && r->at->kind == PARSE_NAME) {
		r->at++;
		value = 0;
	} else {
		parse_error(r->p, "a condition lacks a number");
	}
	parse_leave(r->p);
	return value;
}

static int32_t level(struct reading *r, uint32_t lowest)
{
	int32_t left;

	parse_enter(r->p);
	left = operand(r);
	while (r->at < r->end && r->at->kind == PARSE_SIGN && precedence(r->at->sign) >= lowest) {
		const uint32_t sign = r->at++->sign;
		const bool unread = (sign == PARSE_SIGN2('&', '&') && !left) || (sign == PARSE_SIGN2('|', '|') && left);
		int32_t right;

		r->unread += unread;
		right = level(r, precedence(sign) + 1);
		r->unread -= unread;
		left = apply(r, sign, left, right);
	}
	parse_leave(r->p);
	return left;
}

/* Replace `defined X` and `defined(X)` by numbers, before macros are expanded. */
static struct parse_tokens without_defined(struct parse *p, const struct parse_token *tokens, uint32_t n)
{
	struct parse_tokens list = { 0 };

	for (uint32_t i = 0; i < n; i++) {
		struct parse_token token = tokens[i];
		const bool bracket = i + 3 < n && parse_is_sign(&tokens[i + 1], '(') &&
		                     parse_is_sign(&tokens[i + 3], ')');

		if (parse_is_word(&token, "defined")) {
			i += 1 + bracket;
			if (i >= n || tokens[i].kind != PARSE_NAME)
				parse_error(p, "'defined' lacks a name");
			token = (struct parse_token){ .kind = PARSE_NUMBER,
				                      .text = tokens[i].name->macro ? "1" : "0",
				                      .n = 1,
				                      .line = token.line };
			i += bracket;
		}
		parse_tokens_add(p, &list, &token);
	}
	return list;
}

int32_t parse_condition(struct parse *p, const struct parse_token *tokens, uint32_t n)
{
	struct parse_tokens list = without_defined(p, tokens, n);
	struct reading r = { .p = p };
	int32_t value;

	list = parse_macro_expand(p, list.at, list.n);
	list = without_defined(p, list.at, list.n);
	if (!list.n)
		parse_error(p, "a condition lacks a number");
	r.at = list.at;
	r.end = list.at + list.n;
	value = level(&r, 1);
	if (r.at < r.end)
		parse_error(p, "a condition is followed by something else");
	return value;
}
