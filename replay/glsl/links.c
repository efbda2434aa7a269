#include "replay/glsl/links.h"

#include <string.h>

static const char *name_of(const struct glsl_tree *tree, uint32_t symbol)
{
	return tree->names + tree->symbols[symbol].name;
}

/* Bits of the numbers of gl_TexCoord that a tree names. */
static uint32_t coordinates_of(const struct glsl_tree *tree)
{
	uint32_t taken = 0;

	for (uint32_t i = 0; i < tree->n_nodes; i++) {
		const struct glsl_node *n = &tree->nodes[i], *of = NULL, *at = NULL;

		if (n->operation != GLSL_INDEX)
			continue;
		of = &tree->nodes[tree->children[n->first]];
		at = &tree->nodes[tree->children[n->first + 1]];
		if (of->operation != GLSL_SYMBOL || strcmp(name_of(tree, of->value), "gl_TexCoord") != 0)
			continue;
		if (at->operation != GLSL_NUMBERS || !(tree->numbers[at->value] >= 0 && tree->numbers[at->value] < SCENE_MAX_UNITS))
			return UINT32_MAX;
		taken |= 15u << 4 * (uint32_t)tree->numbers[at->value];
	}
	return taken;
}

void glsl_links_take(struct glsl_links *links, const struct glsl_tree *tree)
{
	links->taken |= coordinates_of(tree);
}

void glsl_links_place(struct glsl_links *links, const struct glsl_tree *tree, const char **why)
{
	for (uint32_t i = 0; i < tree->n_symbols && !*why; i++) {
		const struct glsl_symbol *s = &tree->symbols[i];
		const uint32_t n = tree->types[s->type].numbers;
		uint32_t found = 0;

		if (s->storage != GLSL_INPUT || strncmp(name_of(tree, i), "gl_", 3) == 0)
			continue;
		if (s->flat || s->straight)
			*why = "a shader has inputs that are not interpolated in perspective";
		else if (links->n == GLSL_MAX_LINKS || n > GLSL_LINK_NUMBERS)
			*why = "a program has more varyings than are done";
		else
			links->list[links->n].name = name_of(tree, i);
		for (uint32_t k = 0; k < GLSL_LINK_NUMBERS && found < n && !*why; k++)
			if (!(links->taken >> k & 1))
				links->list[links->n].at[found++] = k;
		if (*why || found < n) {
			*why = *why ? *why : "a program has more varyings than are done";
			return;
		}
		for (uint32_t k = 0; k < n; k++)
			links->taken |= 1u << links->list[links->n].at[k];
		links->list[links->n++].n = n;
	}
}

static struct glsl_value attribute(struct glsl_writer *w, const struct glsl_symbol *s)
{
	const struct glsl_type *t = glsl_type_of(w, s->type);
	struct glsl_value v = glsl_value_of(w, s->type, t->numbers);
	uint32_t location = s->location, rows = t->rows ? t->rows : 1; /* what the text says goes before what is bound */

	for (uint32_t i = 0; i < w->links->n_attributes && s->location == GLSL_NONE; i++)
		if (strcmp(w->links->attributes[i].name, w->tree->names + s->name) == 0)
			location = w->links->attributes[i].location;
	if (location > SCENE_MAX_GENERICS || location + (v.n + rows - 1) / rows > SCENE_MAX_GENERICS + 1)
		return glsl_row(w, s->type, glsl_registers(w, v.n)); /* the program has never asked where it is: nothing sets it */
	for (uint32_t i = 0; i < v.n && v.at; i++) {
		const uint32_t at = location + i / rows;

		v.at[i] = 4 * (at ? SCENE_VERTEX_GENERIC + at - 1 : SCENE_VERTEX_POSITION) + i % rows;
	}
	return v;
}

struct glsl_value glsl_linked(struct glsl_writer *w, const struct glsl_symbol *s)
{
	const uint32_t first = w->stage == GLSL_VERTEX_STAGE ? SCENE_VERTEX_RESULTS + 4 * SCENE_RESULT_TEXCOORD : 4 * SCENE_INPUT_TEXCOORD;
	const uint32_t n = glsl_type_of(w, s->type)->numbers;

	if (w->stage == GLSL_VERTEX_STAGE && s->storage == GLSL_INPUT)
		return attribute(w, s);
	if (w->stage == GLSL_FRAGMENT_STAGE && s->storage == GLSL_OUTPUT) { /* GLSL 1.30: the colour has a name of its own */
		if (n > 4 || w->links->n_colors++)
			glsl_fail(w, "a shader draws to several buffers at once");
		return glsl_row(w, s->type, SCENE_PROGRAM_COLOR);
	}
	for (uint32_t i = 0; i < w->links->n; i++)
		if (strcmp(w->links->list[i].name, w->tree->names + s->name) == 0 && w->links->list[i].n == n) {
			struct glsl_value v = glsl_value_of(w, s->type, n);

			for (uint32_t k = 0; k < n && v.at; k++)
				v.at[k] = first + w->links->list[i].at[k];
			return v;
		}
	return glsl_fresh(w, s->type); /* the other stage does not have it */
}
