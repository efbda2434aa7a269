#include "replay/glsl/parse/specifier.h"

#include "replay/glsl/meaning/scope.h"
#include "replay/glsl/parse/expression.h"
#include "replay/glsl/parse/parser.h"
#include "replay/glsl/text/keywords.h"

void parse_members(struct parse *p, bool is_block, struct parse_members *list)
{
	do {
		const struct parse_qualifiers q = parse_qualifiers(p);
		const struct parse_type *type;

		if (!is_block && (q.any_storage || (p->version >= 120 && parse_keyword(p, &p->now) == PARSE_STRUCT)))
			parse_error(p, "a structure's member has a qualifier, or a structure of its own");
		type = parse_specifier(p);
		if (type->kind == GLSL_VOID)
			parse_error(p, "a member is void");
		do {
			struct parse_name *name = parse_identifier(p);
			const struct parse_type *own = parse_array_lengths(p, type);

			for (uint32_t i = 0; i < list->n; i++)
				if (list->at[i].name == name)
					parse_error(p, "there are two members '%s'", name->text);
			if (list->n >= PARSE_MAX_NUMBERS / 16)
				parse_refuse(p, "a structure in a shader has too many members");
			list->at = parse_grow(p, list->at, list->n, &list->room, sizeof(*list->at));
			list->at[list->n++] = (struct parse_member){ name, own };
		} while (parse_accept(p, ','));
		parse_expect(p, ';');
	} while (!parse_accept(p, '}'));
}

/* Parse a structure after `struct`. */
static const struct parse_type *read_structure(struct parse *p)
{
	struct parse_name *name = parse_is_sign(&p->now, '{') ? parse_name(p, "", 0) : parse_identifier(p);
	struct parse_members members = { 0 };
	const struct parse_type *type;

	parse_enter(p);
	parse_expect(p, '{');
	parse_members(p, false, &members);
	for (uint32_t i = 0; i < members.n; i++)
		if (members.at[i].type->kind == GLSL_ARRAY && !members.at[i].type->length)
			parse_error(p, "the member '%s' has no length", members.at[i].name->text);
	type = parse_type_structure(p, name, members.at, members.n);
	if (name->n)
		parse_bind(p, name, NULL, type);
	parse_leave(p);
	return type;
}

const struct parse_type *parse_specifier(struct parse *p)
{
	const struct parse_type *type = parse_accept_word(p, PARSE_STRUCT) ? read_structure(p) : parse_named_type(p);

	if (!type)
		parse_unexpected(p);
	if (parse_is_sign(&p->now, '[') && p->version < 120)
		parse_unexpected(p);
	return parse_array_lengths(p, type);
}

bool parse_begins_declaration(struct parse *p)
{
	const uint32_t keyword = parse_keyword(p, &p->now);

	if (keyword == PARSE_CONST || keyword == PARSE_STRUCT || keyword == PARSE_LOWP || keyword == PARSE_INVARIANT ||
	    keyword == PARSE_PRECISE || (keyword >= PARSE_ATTRIBUTE && keyword <= PARSE_INOUT))
		return true;
	if (!parse_names_type(p, &p->now))
		return false;
	return keyword == PARSE_UNSIGNED || !parse_is_sign(parse_peek(p), '(');
}
