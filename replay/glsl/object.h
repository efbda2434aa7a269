/* Shader and program objects of GLSL (GL 2.1 sec. 2.15), as the state keeps them: one space of names. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "base/table.h"
#include "replay/programs/stages.h"
#include "replay/glsl/translate.h"

struct gls_shader {
	struct gls_stages stages; /* of a program, as it was linked */
	uint32_t type;        /* GL token; 0: a program object */
	uint32_t deleted;     /* 1: it goes when nothing uses it any more */
	uint32_t uses;        /* of a shader: programs that it is attached to */
	char *source, *compiled; /* of a shader, owned: as the program gave it last, and when it was compiled last;
	                            NULL: never */

	/* Of a program. */
	uint32_t *attached;   /* owned; names */
	uint32_t n_attached, attached_room;
	char **texts[2];      /* owned: what was linked last, by enum glsl_stage */
	uint32_t n_texts[2];
	struct glsl_attribute *attributes; /* owned, names too */
	uint32_t n_attributes, attribute_room;
	struct glsl_uniforms uniforms;
	char message[GLSL_MESSAGE]; /* stages.why, where that names a line */
	struct table locations; /* what the program was told -> 1 + (number in uniforms.list << 32 | element) */
	uint32_t other_stages;  /* 1: with shaders of neither stage */
	uint32_t products_once; /* 1: as of glsl_parse, when it was linked */
};

void gls_shader_free(struct gls_shader *s);

/** Another source, or what was given last becomes what is linked. @return 0 or ERR_SYSTEM (reported) */
int gls_shader_set(char **to, const char *text, size_t n);

/** Forget what was linked, locations too. */
void gls_shader_forget(struct gls_shader *program);

/** Add a text to what is linked. type: GL token of the shader. @return 0 or ERR_SYSTEM (reported) */
int gls_shader_add_text(struct gls_shader *program, uint32_t type, const char *text);

/** Translate what is linked. Uniforms begin as the text says, unless `keeps`. @return 0 or ERR_SYSTEM (reported) */
int gls_shader_translate(struct gls_shader *program, int keeps);

/** An attribute's location, another one or a new one. @return 0 or ERR_SYSTEM (reported) */
int gls_shader_locate_attribute(struct gls_shader *program, const char *name, uint32_t location);

/** The location that the program was told of a uniform. @return 0 or ERR_SYSTEM (reported) */
int gls_shader_locate_uniform(struct gls_shader *program, const char *name, uint32_t location);

/* Numbers of a program's uniforms. */
struct gls_uniform_change {
	uint32_t first, n;
};

/**
 * Set `count` values in a row of what has a location.
 * @param rows, columns  of each; columns 0: a vector
 * @param transposed     1: a matrix that is given by rows
 * @param only_asks      1: set nothing
 * @param change         receives which numbers these are, where there are any
 * @return 1 where they change
 */
int gls_shader_set_uniform(struct gls_shader *program, uint32_t location, const float *values, uint32_t count,
                           uint32_t rows, uint32_t columns, int transposed, int only_asks,
                           struct gls_uniform_change *change);
