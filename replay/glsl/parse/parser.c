#include "replay/glsl/parse/parser.h"

#include <string.h>

#include "replay/glsl/text/keywords.h"
#include "replay/glsl/text/macro.h"
#include "replay/glsl/text/type_names.h"

void parse_advance(struct parse *p)
{
	if (p->has_next)
		p->now = p->next;
	else
		parse_macro_next(p, &p->now);
	p->has_next = false;
	p->line = p->now.line;
}

const struct parse_token *parse_peek(struct parse *p)
{
	const uint32_t line = p->line;

	if (!p->has_next)
		parse_macro_next(p, &p->next);
	p->has_next = true;
	p->line = line;
	return &p->next;
}

bool parse_accept(struct parse *p, uint32_t sign)
{
	const bool is_there = parse_is_sign(&p->now, sign);

	if (is_there)
		parse_advance(p);
	return is_there;
}

_Noreturn void parse_unexpected(struct parse *p)
{
	if (p->now.kind == PARSE_END)
		parse_error(p, "unexpected end of the text");
	parse_error(p, "'%.*s' is not expected here", (int)(p->now.n < 60 ? p->now.n : 60), p->now.text);
}

void parse_expect(struct parse *p, uint32_t sign)
{
	if (!parse_accept(p, sign))
		parse_unexpected(p);
}

bool parse_accept_word(struct parse *p, uint32_t keyword)
{
	const bool is_there = parse_keyword(p, &p->now) == keyword;

	if (is_there)
		parse_advance(p);
	return is_there;
}

uint32_t parse_keyword(const struct parse *p, const struct parse_token *token)
{
	const uint32_t keyword = token->kind == PARSE_NAME ? token->name->keyword : PARSE_NO_KEYWORD;
	struct parse_type_name type;

	if (keyword == PARSE_NO_KEYWORD || keyword == PARSE_RESERVED)
		return keyword;
	if (keyword == PARSE_TYPE_NAME && parse_type_name(token->name->text, &type))
		return type.version <= 120 ? (p->version >= type.version ? keyword : PARSE_NO_KEYWORD) :
		       parse_has(p, type.version, PARSE_GPU_SHADER4) ? keyword :
		                                                       PARSE_NO_KEYWORD;
	if (keyword == PARSE_LAYOUT)
		return parse_has(p, 140, PARSE_LOCATIONS | PARSE_PACK | PARSE_COORD_LAYOUT | PARSE_BLOCKS) ?
		               keyword :
		               PARSE_NO_KEYWORD;
	if (p->is_es && (keyword == PARSE_PRECISION || keyword == PARSE_LOWP || keyword == PARSE_INVARIANT))
		return keyword;
	return parse_has(p, parse_keyword_version(keyword), keyword == PARSE_FLAT ? PARSE_GPU_SHADER4 : 0) ?
	               keyword :
	               PARSE_NO_KEYWORD;
}

struct parse_name *parse_identifier(struct parse *p)
{
	struct parse_name *name = p->now.name;

	if (p->now.kind != PARSE_NAME || parse_keyword(p, &p->now) != PARSE_NO_KEYWORD)
		parse_unexpected(p);
	parse_advance(p);
	return name;
}
