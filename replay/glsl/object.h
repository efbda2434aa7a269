/* GLSL shader and program objects (GL 2.1 sec. 2.15), as part of the GL state: they share one name space. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "base/table.h"
#include "replay/programs/stages.h"
#include "replay/glsl/translate.h"

struct gls_shader {
	struct gls_stages stages; /* for a program, as last linked */
	uint32_t type;        /* GL token; 0: a program object */
	uint32_t deleted;     /* 1: freed as soon as nothing uses it */
	uint32_t uses;        /* number of programs that a shader is attached to */
	char *source, *compiled; /* for a shader, owned: the current text, and the text at the last compilation; NULL: none */

	/* Members of a program. */
	uint32_t *attached;   /* owned; names */
	uint32_t n_attached, attached_room;
	char **texts[2];      /* owned: texts at the last link, by enum glsl_stage */
	uint32_t n_texts[2];
	struct glsl_attribute *attributes; /* owned, including names */
	uint32_t n_attributes, attribute_room;
	struct glsl_uniforms uniforms;
	char message[GLSL_MESSAGE]; /* storage for stages.why, if that names a line */
	struct table locations; /* location reported to the program -> 1 + (index in uniforms.list << 32 | element) */
	uint32_t other_stages;  /* 1: it has shaders other than vertex and fragment shaders */
	uint32_t products_once; /* 1: parameter of glsl_parse at the last link */
};

void gls_shader_free(struct gls_shader *s);

/** Replace a text, which is either the current source or the compiled one. @return 0 or ERR_SYSTEM (reported) */
int gls_shader_set(char **to, const char *text, size_t n);

/** Drop the results of linking, including locations. */
void gls_shader_forget(struct gls_shader *program);

/** Add a text to those being linked. type: GL token of the shader. @return 0 or ERR_SYSTEM (reported) */
int gls_shader_add_text(struct gls_shader *program, uint32_t type, const char *text);

/**
 * Translate the texts being linked. Uniforms get their initial values, unless `keeps`. @return 0 or ERR_SYSTEM
 * (reported)
 */
int gls_shader_translate(struct gls_shader *program, int keeps);

/** Set the location of an attribute. @return 0 or ERR_SYSTEM (reported) */
int gls_shader_locate_attribute(struct gls_shader *program, const char *name, uint32_t location);

/** Set the location of a uniform, as it was reported to the program. @return 0 or ERR_SYSTEM (reported) */
int gls_shader_locate_uniform(struct gls_shader *program, const char *name, uint32_t location);

/* A range of numbers in a program's uniforms. */
struct gls_uniform_change {
	uint32_t first, n;
};

/**
 * Set `count` consecutive values, starting at a location.
 * @param rows, columns  of each value; columns 0: a vector
 * @param transposed     1: matrices are given by rows
 * @param only_asks      1: set nothing
 * @param change         receives the range that the values occupy, if any
 * @return 1 if any number changes
 */
int gls_shader_set_uniform(struct gls_shader *program, uint32_t location, const float *values, uint32_t count,
                           uint32_t rows, uint32_t columns, int transposed, int only_asks,
                           struct gls_uniform_change *change);
