/* Interface of the stages: places of varyings and attributes. */
#pragma once

#include "replay/glsl/fixed.h"
#include "replay/glsl/writer.h"

#define GLSL_MAX_LINKS 32u
#define GLSL_LINK_NUMBERS (4u * SCENE_MAX_UNITS)

/*
 * Varyings passed from the vertex to the fragment stage, other than built-in ones: they use texture coordinate
 * components that gl_TexCoord leaves free. GL 2.1 guarantees 32 of them (MAX_VARYING_FLOATS), which is as many as there
 * are.
 */
struct glsl_links {
	struct {
		const char *name; /* owned by the tree */
		uint32_t n, at[GLSL_LINK_NUMBERS];
	} list[GLSL_MAX_LINKS];
	uint32_t n, taken; /* bits: components in use */
	struct glsl_fixed fixed[GLSL_LINK_NUMBERS]; /* by component */
	uint32_t n_colors; /* number of colour outputs of the fragment stage, other than built-in ones */
	const struct glsl_attribute *attributes;
	uint32_t n_attributes;
	uint32_t *locations; /* by number of the vertex stage's symbols; GLSL_NONE: none */
};

/** Reserve the components of gl_TexCoord that a tree uses. */
void glsl_links_take(struct glsl_links *links, const struct glsl_tree *tree);

/** Find places for the fragment stage's inputs. @param why  as in glsl_translate */
void glsl_links_place(struct glsl_links *links, const struct glsl_tree *tree, const char **why);

/**
 * Assign locations to the vertex stage's attributes. Locations in the text take precedence over those that the program
 * bound or queried. The rest get the lowest free locations, larger attributes first, then in source order, as Mesa
 * (22.3.6) links them; 0 is reserved for gl_Vertex if it is read.
 * @param used  [n_symbols], of w->tree: 1 if main reaches it
 */
void glsl_links_locate(struct glsl_writer *w, const uint8_t *used);

/**
 * The value of an attribute or varying. In the fragment stage, fixed components are constants.
 */
struct glsl_value glsl_linked(struct glsl_writer *w, const struct glsl_symbol *s);
