#include "replay/glsl/meaning/types.h"

#include <stdio.h>
#include <string.h>

#define N_LISTS (sizeof(((struct parse *)0)->types) / sizeof(struct parse_type *))

static const struct parse_type *intern(struct parse *p, const struct parse_type *wanted)
{
	const uint64_t key = wanted->kind ^ wanted->rows << 3 ^ wanted->columns << 6 ^ wanted->texture << 9 ^
	                     (uint64_t)wanted->length << 16 ^ (uintptr_t)wanted->element ^ (uintptr_t)wanted->structure;
	struct parse_type **list = &p->types[(key * 0x9e3779b97f4a7c15u >> 40) % N_LISTS], *t;

	for (t = *list; t; t = t->next)
		if (t->kind == wanted->kind && t->rows == wanted->rows && t->columns == wanted->columns &&
		    t->texture == wanted->texture && t->length == wanted->length && t->element == wanted->element &&
		    t->structure == wanted->structure)
			return t;
	if (wanted->depth > PARSE_MAX_DEPTH)
		parse_refuse(p, "a shader is nested too deeply");
	if (wanted->numbers > PARSE_MAX_NUMBERS)
		parse_refuse(p, "a shader has an array that is too large");
	t = parse_alloc(p, sizeof(*t));
	*t = *wanted;
	t->number = parse_alloc(p, sizeof(*t->number));
	t->next = *list;
	*list = t;
	return t;
}

const struct parse_type *parse_type(struct parse *p, enum glsl_kind kind, uint32_t rows, uint32_t columns)
{
	return intern(p, &(struct parse_type){ .kind = kind,
	                                       .rows = rows,
	                                       .columns = columns,
	                                       .numbers = rows * (columns ? columns : 1),
	                                       .holds_whole = kind == GLSL_INT || kind == GLSL_UINT });
}

const struct parse_type *parse_type_sampler(struct parse *p, uint32_t texture)
{
	return intern(
	        p, &(struct parse_type){
	                   .kind = GLSL_SAMPLER, .rows = 1, .texture = texture, .numbers = 1, .holds_sampler = true });
}

const struct parse_type *parse_type_array(struct parse *p, const struct parse_type *element, uint32_t length)
{
	if (length > PARSE_MAX_NUMBERS)
		parse_refuse(p, "a shader has an array that is too large");
	return intern(p, &(struct parse_type){ .kind = GLSL_ARRAY,
	                                       .length = length,
	                                       .element = element,
	                                       .numbers = length * element->numbers,
	                                       .depth = element->depth + 1,
	                                       .holds_sampler = element->holds_sampler,
	                                       .holds_array = true,
	                                       .holds_whole = element->holds_whole });
}

const struct parse_type *parse_type_structure(struct parse *p, struct parse_name *name,
                                              const struct parse_member *members, uint32_t n)
{
	struct parse_type t = { .kind = GLSL_STRUCT };
	struct parse_structure *s;

	for (s = p->structures; s; s = s->next)
		if (s->name == name && s->n == n && memcmp(s->members, members, n * sizeof(*members)) == 0)
			break;
	if (!s) {
		s = parse_alloc(p, sizeof(*s));
		s->name = name;
		s->n = n;
		s->members = parse_alloc(p, n * sizeof(*members));
		memcpy(s->members, members, n * sizeof(*members));
		s->next = p->structures;
		p->structures = s;
	}
	t.structure = s;
	for (uint32_t i = 0; i < n; i++) {
		t.numbers += members[i].type->numbers;
		t.depth = members[i].type->depth >= t.depth ? members[i].type->depth + 1 : t.depth;
		t.holds_sampler |= members[i].type->holds_sampler;
		t.holds_array |= members[i].type->holds_array;
		t.holds_whole |= members[i].type->holds_whole;
		if (t.numbers > PARSE_MAX_NUMBERS)
			parse_refuse(p, "a shader has an array that is too large");
	}
	return intern(p, &t);
}

const char *parse_type_text(struct parse *p, const struct parse_type *t)
{
	static const char *const scalars[] = { "void", "float", "int", "uint", "bool" }, *const vectors[] = {
		"", "vec", "ivec", "uvec", "bvec"
	};
	char *text = parse_alloc(p, 80);

	if (t->kind == GLSL_ARRAY)
		snprintf(text, 80, "%.60s[%u]", parse_type_text(p, t->element), t->length);
	else if (t->kind == GLSL_STRUCT)
		snprintf(text, 80, "%.70s", t->structure->name->n ? t->structure->name->text : "struct");
	else if (t->kind == GLSL_SAMPLER)
		snprintf(text, 80, "sampler");
	else if (t->columns)
		snprintf(text, 80, "mat%ux%u", t->columns, t->rows);
	else if (t->rows > 1)
		snprintf(text, 80, "%s%u", vectors[t->kind], t->rows);
	else
		snprintf(text, 80, "%s", scalars[t->kind]);
	return text;
}
