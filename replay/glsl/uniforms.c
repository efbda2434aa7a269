#include "replay/glsl/uniforms.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"

#define MAX_UNIFORMS 8192u
#define MAX_NAME 512

struct naming {
	struct glsl_uniforms *u;
	const struct glsl_tree *tree;
	const char *why;
	uint32_t location; /* the next one's; GLSL_NONE: not given */
	char name[MAX_NAME];
};

static int add_one(struct naming *n, const struct glsl_type *t, uint32_t length, uint32_t first)
{
	struct glsl_uniforms *u = n->u;
	char *name;

	if (u->n == MAX_UNIFORMS) {
		n->why = "a program has too many uniforms";
		return 0;
	}
	name = strdup(n->name);
	if (!name || MEMORY_GROW(u->list, u->room, u->n + 1)) {
		free(name);
		return err_report(ERR_SYSTEM, NULL, "out of memory for uniforms");
	}
	u->list[u->n++] = (struct glsl_uniform){ name, t->kind, t->rows, t->columns, t->texture, length, first, n->location };
	n->location += n->location != GLSL_NONE ? length : 0;
	return 0;
}

/* Add the parts of a type, which is called n.name and starts at number `first`. */
static int add_parts(struct naming *n, uint32_t type, uint32_t first)
{
	const struct glsl_type *t = &n->tree->types[type], *element = t->kind == GLSL_ARRAY ? &n->tree->types[t->first] : NULL;
	const size_t end = strlen(n->name);

	if (!element && t->kind != GLSL_STRUCT)
		return add_one(n, t, 1, first);
	if (element && element->kind != GLSL_ARRAY && element->kind != GLSL_STRUCT)
		return add_one(n, element, t->length, first);
	for (uint32_t i = 0; i < t->length && !n->why; i++) {
		const struct glsl_member *member = element ? NULL : &n->tree->members[t->first + i];
		const uint32_t part = element ? t->first : member->type;
		const int length = element ? snprintf(n->name + end, MAX_NAME - end, "[%u]", i) :
		                             snprintf(n->name + end, MAX_NAME - end, ".%s", n->tree->names + member->name);
		int err;

		if (length >= (int)(MAX_NAME - end)) {
			n->why = "the name of a uniform is too long";
			return 0;
		}
		err = add_parts(n, part, first);
		if (err)
			return err;
		first += n->tree->types[part].numbers;
	}
	n->name[end] = 0;
	return 0;
}

static int add_root(struct naming *n, const struct glsl_symbol *s)
{
	struct glsl_uniforms *u = n->u;
	const char *name = n->tree->names + s->name;
	const uint32_t numbers = n->tree->types[s->type].numbers, padded = (numbers + 3) / 4 * 4, first = u->n_values;
	char *kept;

	if (strlen(name) >= MAX_NAME || first + padded > 65536) {
		n->why = "a program has too many uniforms";
		return 0;
	}
	kept = strdup(name);
	if (!kept || MEMORY_GROW(u->roots, u->root_room, u->n_roots + 1) ||
	    MEMORY_GROW(u->values, u->value_room, first + padded)) {
		free(kept);
		return err_report(ERR_SYSTEM, NULL, "out of memory for uniforms");
	}
	u->roots[u->n_roots++] = (struct glsl_uniform_root){ kept, first, numbers };
	memset(u->values + first, 0, padded * sizeof(float));
	if (s->first != GLSL_NONE && s->first + numbers <= n->tree->n_numbers)
		memcpy(u->values + first, n->tree->numbers + s->first, numbers * sizeof(float));
	for (uint32_t i = 0; i < numbers && s->binding != GLSL_NONE; i++) /* samplers of an array get consecutive units */
		u->values[first + i] = (float)(s->binding + i);
	u->n_values += padded;
	strcpy(n->name, name);
	n->location = s->location;
	return add_parts(n, s->type, first);
}

int glsl_uniforms_add(struct glsl_uniforms *u, const struct glsl_tree *tree, const char **why)
{
	struct naming n = { .u = u, .tree = tree };
	int err = 0;

	for (uint32_t i = 0; i < tree->n_symbols && !err && !n.why; i++) {
		const struct glsl_symbol *s = &tree->symbols[i];
		const char *name = tree->names + s->name;

		if (s->storage == GLSL_UNIFORM && strncmp(name, "gl_", 3) != 0 && glsl_uniforms_find(u, name) == GLSL_NONE)
			err = add_root(&n, s);
	}
	*why = n.why;
	return err;
}

uint32_t glsl_uniforms_find(const struct glsl_uniforms *u, const char *name)
{
	for (uint32_t i = 0; i < u->n_roots; i++)
		if (strcmp(u->roots[i].name, name) == 0)
			return u->roots[i].first;
	return GLSL_NONE;
}

const struct glsl_uniform *glsl_uniforms_named(const struct glsl_uniforms *u, const char *name, uint32_t *element)
{
	const char *bracket = strrchr(name, '[');
	size_t n = strlen(name);
	unsigned at = 0;
	int used = 0;

	*element = 0;
	for (int pass = 0; pass < 2; pass++) {
		for (uint32_t i = 0; i < u->n; i++)
			if (strlen(u->list[i].name) == n && strncmp(u->list[i].name, name, n) == 0 && at < u->list[i].length) {
				*element = at;
				return &u->list[i];
			}
		if (!bracket || sscanf(bracket, "[%u]%n", &at, &used) != 1 || !used || bracket[used])
			return NULL;
		n = (size_t)(bracket - name); /* an element of an array of numbers */
	}
	return NULL;
}

void glsl_uniforms_free(struct glsl_uniforms *u)
{
	for (uint32_t i = 0; i < u->n; i++)
		free(u->list[i].name);
	for (uint32_t i = 0; i < u->n_roots; i++)
		free(u->roots[i].name);
	free(u->list);
	free(u->roots);
	free(u->values);
	memset(u, 0, sizeof(*u));
}
