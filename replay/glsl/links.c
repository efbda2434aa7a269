#include "replay/glsl/links.h"

#include <string.h>

static const char *name_of(const struct glsl_tree *tree, uint32_t symbol)
{
	return tree->names + tree->symbols[symbol].name;
}

/* 1 for an input declared in the text: an attribute in the vertex stage, a varying in the fragment stage. */
static int is_declared_input(const struct glsl_tree *tree, uint32_t symbol)
{
	return tree->symbols[symbol].storage == GLSL_INPUT && strncmp(name_of(tree, symbol), "gl_", 3) != 0;
}

/* Bit set of the gl_TexCoord components that a tree uses. */
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

		if (!is_declared_input(tree, i))
			continue;
		if (s->flat || s->straight)
			*why = "a shader has inputs without perspective interpolation";
		else if (links->n == GLSL_MAX_LINKS || n > GLSL_LINK_NUMBERS)
			*why = "a program has too many varyings";
		else
			links->list[links->n].name = name_of(tree, i);
		for (uint32_t k = 0; k < GLSL_LINK_NUMBERS && found < n && !*why; k++)
			if (!(links->taken >> k & 1))
				links->list[links->n].at[found++] = k;
		if (*why || found < n) {
			*why = *why ? *why : "a program has too many varyings";
			return;
		}
		for (uint32_t k = 0; k < n; k++)
			links->taken |= 1u << links->list[links->n].at[k];
		links->list[links->n++].n = n;
	}
}

#define N_LOCATIONS (SCENE_MAX_GENERICS + 1)

/* Number of locations that an attribute takes. */
static uint32_t slots_of(const struct glsl_tree *tree, const struct glsl_symbol *s)
{
	const struct glsl_type *t = &tree->types[s->type];
	const uint32_t rows = t->rows ? t->rows : 1;

	return t->numbers / rows + (t->numbers % rows != 0);
}

/* Bit set of locations; 0: out of range. */
static uint32_t slot_bits(uint32_t location, uint32_t slots)
{
	return location < N_LOCATIONS && slots <= N_LOCATIONS - location ? ((1u << slots) - 1) << location : 0;
}

/* The largest attribute without a location, the first in the text among equals; GLSL_NONE: all have one. */
static uint32_t next_unplaced(const struct glsl_writer *w, const uint8_t *used)
{
	const struct glsl_tree *tree = w->tree;
	uint32_t best = GLSL_NONE;

	for (uint32_t i = 0; i < tree->n_symbols; i++) {
		const struct glsl_symbol *s = &tree->symbols[i], *b = best == GLSL_NONE ? NULL : &tree->symbols[best];

		if (!used[i] || !is_declared_input(tree, i) || w->links->locations[i] != GLSL_NONE)
			continue;
		if (!b || slots_of(tree, s) > slots_of(tree, b) ||
		    (slots_of(tree, s) == slots_of(tree, b) && s->declared < b->declared))
			best = i;
	}
	return best;
}

void glsl_links_locate(struct glsl_writer *w, const uint8_t *used)
{
	const struct glsl_tree *tree = w->tree;
	struct glsl_links *links = w->links;
	uint32_t taken = 0, next;

	links->locations = glsl_alloc(w, tree->n_symbols * sizeof(*links->locations));
	for (uint32_t i = 0; i < tree->n_nodes; i++)
		taken |= tree->nodes[i].operation == GLSL_FTRANSFORM;
	for (uint32_t i = 0; i < tree->n_symbols && links->locations; i++) {
		uint32_t *location = &links->locations[i];

		*location = tree->symbols[i].location;
		taken |= used[i] && strcmp(name_of(tree, i), "gl_Vertex") == 0;
		for (uint32_t k = 0; k < links->n_attributes && *location == GLSL_NONE && is_declared_input(tree, i); k++)
			if (strcmp(links->attributes[k].name, name_of(tree, i)) == 0)
				*location = links->attributes[k].location;
		if (used[i] && is_declared_input(tree, i) && *location != GLSL_NONE)
			taken |= slot_bits(*location, slots_of(tree, &tree->symbols[i]));
	}
	while (links->locations && (next = next_unplaced(w, used)) != GLSL_NONE) {
		const uint32_t slots = slots_of(tree, &tree->symbols[next]);
		uint32_t at = 0;

		while (slot_bits(at, slots) & taken)
			at++;
		if (!slot_bits(at, slots))
			return; /* no implementation could have linked it */
		links->locations[next] = at;
		taken |= slot_bits(at, slots);
	}
}

static struct glsl_value attribute(struct glsl_writer *w, const struct glsl_symbol *s)
{
	const struct glsl_type *t = glsl_type_of(w, s->type);
	struct glsl_value v = glsl_value_of(w, s->type, t->numbers);
	const uint32_t location = w->links->locations[s - w->tree->symbols], rows = t->rows ? t->rows : 1;

	if (!slot_bits(location, slots_of(w->tree, s)))
		return glsl_row(w, s->type, glsl_registers(w, v.n)); /* no implementation could have linked it: nothing sets it */
	for (uint32_t i = 0; i < v.n && v.at; i++) {
		const uint32_t at = location + i / rows;

		v.at[i] = 4 * (at ? SCENE_VERTEX_GENERIC + at - 1 : SCENE_VERTEX_POSITION) + i % rows;
	}
	return v;
}

/* The operand of a component in the fragment stage. */
static uint32_t component(struct glsl_writer *w, uint32_t k)
{
	const struct program_constant *c = &w->links->fixed[k].constant;
	const uint32_t part = w->links->fixed[k].part;

	if (!part)
		return 4 * SCENE_INPUT_TEXCOORD + k;
	return c->source == PROGRAM_LITERAL ? glsl_number(w, c->value[part - 1]) :
	       c->source == PROGRAM_LOCAL   ? SCENE_PROGRAM_CONSTANT + 4 * c->index + part - 1 :
	                                      glsl_constant(w, c) + part - 1;
}

struct glsl_value glsl_linked(struct glsl_writer *w, const struct glsl_symbol *s)
{
	const uint32_t n = glsl_type_of(w, s->type)->numbers;

	if (w->stage == GLSL_VERTEX_STAGE && s->storage == GLSL_INPUT)
		return attribute(w, s);
	/* since GLSL 1.30 colour outputs have user-defined names */
	if (w->stage == GLSL_FRAGMENT_STAGE && s->storage == GLSL_OUTPUT) {
		if (n > 4 || w->links->n_colors++)
			glsl_fail(w, "a shader draws to several buffers at once");
		return glsl_row(w, s->type, SCENE_PROGRAM_COLOR);
	}
	for (uint32_t i = 0; i < w->links->n; i++)
		if (strcmp(w->links->list[i].name, w->tree->names + s->name) == 0 && w->links->list[i].n == n) {
			struct glsl_value v = glsl_value_of(w, s->type, n);

			for (uint32_t k = 0; k < n && v.at; k++)
				v.at[k] = w->stage == GLSL_VERTEX_STAGE ?
				                  SCENE_VERTEX_RESULTS + 4 * SCENE_RESULT_TEXCOORD + w->links->list[i].at[k] :
				                  component(w, w->links->list[i].at[k]);
			return v;
		}
	return glsl_fresh(w, s->type); /* the other stage does not write it */
}
