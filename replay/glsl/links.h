/* Names that both stages have, and attributes: where they lie. */
#pragma once

#include "replay/glsl/writer.h"

#define GLSL_MAX_LINKS 32u
#define GLSL_LINK_NUMBERS (4u * SCENE_MAX_UNITS)

/*
 * What the vertex stage hands the fragment stage, besides built-in names: numbers of texture coordinates that
 * gl_TexCoord leaves free. GL 2.1 promises 32 of them (MAX_VARYING_FLOATS), which is as many as there are.
 */
struct glsl_links {
	struct {
		const char *name; /* the tree's */
		uint32_t n, at[GLSL_LINK_NUMBERS];
	} list[GLSL_MAX_LINKS];
	uint32_t n, taken; /* bits: numbers that are in use */
	uint32_t n_colors; /* of the fragment stage, but for built-in ones */
	const struct glsl_attribute *attributes;
	uint32_t n_attributes;
	uint32_t *locations; /* of the vertex stage's symbols, by number; GLSL_NONE: it has none */
};

/** Take the numbers of gl_TexCoord that a tree names. */
void glsl_links_take(struct glsl_links *links, const struct glsl_tree *tree);

/** Find places for what the fragment stage reads. @param why  as of glsl_translate */
void glsl_links_place(struct glsl_links *links, const struct glsl_tree *tree, const char **why);

/**
 * Find locations of the vertex stage's attributes: what the text says goes before what the program was told or bound.
 * Those that are left get the lowest that are free, larger ones first, then in the order of the text, as Mesa (22.3.6)
 * links them; 0 is the vertex's where it is read.
 * @param used  [n_symbols], of w->tree: 1 where main comes to it
 */
void glsl_links_locate(struct glsl_writer *w, const uint8_t *used);

/** The value of an attribute, or of what one stage hands the other. */
struct glsl_value glsl_linked(struct glsl_writer *w, const struct glsl_symbol *s);
