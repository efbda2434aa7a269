#include "replay/glsl/object.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"
#include "gl_tokens.h"
#include "replay/programs/held.h"

static void drop_texts(struct gls_shader *s)
{
	for (unsigned stage = 0; stage < N_GLS_STAGES; stage++) {
		for (uint32_t i = 0; i < s->n_texts[stage]; i++)
			free(s->texts[stage][i]);
		free(s->texts[stage]);
		s->texts[stage] = NULL;
		s->n_texts[stage] = 0;
	}
}

void gls_shader_free(struct gls_shader *s)
{
	free(s->source);
	free(s->compiled);
	free(s->attached);
	drop_texts(s);
	for (uint32_t i = 0; i < s->n_attributes; i++)
		free(s->attributes[i].name);
	free(s->attributes);
	for (unsigned stage = 0; stage < N_GLS_STAGES; stage++)
		program_code_free(&s->stages.code[stage]);
	gls_held_free(&s->stages);
	glsl_uniforms_free(&s->uniforms);
	table_free(&s->locations);
	free(s);
}

int gls_shader_set(char **to, const char *text, size_t n)
{
	char *copy = malloc(n + 1);

	if (!copy)
		return err_report(ERR_SYSTEM, NULL, "out of memory for a shader of %zu bytes", n);
	memcpy(copy, text, n);
	copy[n] = 0;
	free(*to);
	*to = copy;
	return 0;
}

void gls_shader_forget(struct gls_shader *program)
{
	drop_texts(program);
	table_free(&program->locations);
	program->stages.linked = program->other_stages = 0;
}

int gls_shader_add_text(struct gls_shader *program, uint32_t type, const char *text)
{
	const unsigned stage = type == GL_VERTEX_SHADER ? GLSL_VERTEX_STAGE : GLSL_FRAGMENT_STAGE;
	char **texts, *copy;

	if (type != GL_VERTEX_SHADER && type != GL_FRAGMENT_SHADER) {
		program->other_stages = 1;
		return 0;
	}
	texts = realloc(program->texts[stage], (program->n_texts[stage] + 1) * sizeof(*texts));
	if (texts)
		program->texts[stage] = texts;
	copy = texts ? strdup(text) : NULL;
	if (!copy)
		return err_report(ERR_SYSTEM, NULL, "out of memory for a shader");
	texts[program->n_texts[stage]++] = copy;
	return 0;
}

/*
 * Set the location of a uniform's element, and give the following elements the next locations unless these are taken,
 * as Mesa does.
 */
static int set_locations(struct gls_shader *program, uint64_t location, uint64_t number, uint32_t element)
{
	const uint32_t first = element;
	int err = 0;

	for (; element < program->uniforms.list[number].length && !err; element++, location++)
		if (element == first || !table_find(&program->locations, location))
			err = table_set(&program->locations, location, (void *)(uintptr_t)((number << 32 | element) + 1));
	return err;
}

/* Set locations that are given in the texts. */
static int set_given_locations(struct gls_shader *program)
{
	int err = 0;

	for (uint32_t i = 0; i < program->uniforms.n && !err; i++)
		if (program->uniforms.list[i].location != GLSL_NONE)
			err = set_locations(program, program->uniforms.list[i].location, i, 0);
	return err;
}

int gls_shader_translate(struct gls_shader *program, int keeps)
{
	const struct glsl_sources sources = { { (const char *const *)program->texts[0],
		                                (const char *const *)program->texts[1] },
		                              { program->n_texts[0], program->n_texts[1] },
		                              program->attributes,
		                              program->n_attributes,
		                              program->products_once };
	struct glsl_uniforms before = program->uniforms;
	int err;

	for (unsigned stage = 0; stage < N_GLS_STAGES; stage++)
		program_code_free(&program->stages.code[stage]);
	memset(&program->uniforms, 0, sizeof(program->uniforms));
	err = glsl_translate(&sources, program->stages.code, &program->uniforms, program->message, &program->stages.why);
	if (!err)
		err = set_given_locations(program);
	if (keeps && before.n_values == program->uniforms.n_values && before.n_values)
		memcpy(program->uniforms.values, before.values, before.n_values * sizeof(float));
	glsl_uniforms_free(&before);
	if (err && !program->stages.why)
		program->stages.why = "a program's shaders could not be translated";
	if (program->other_stages)
		program->stages.why = "a program has shaders other than vertex and fragment shaders";
	program->stages.linked = 1;
	program->stages.links += !keeps;
	gls_held_free(&program->stages);
	program->stages.uniforms = (const float (*)[4])program->uniforms.values;
	program->stages.n_uniforms = (program->uniforms.n_values + 3) / 4;
	for (unsigned stage = 0; stage < N_GLS_STAGES; stage++)
		program->stages.runs[stage] = program->n_texts[stage] != 0;
	return err;
}

int gls_shader_locate_attribute(struct gls_shader *program, const char *name, uint32_t location)
{
	char *copy;

	for (uint32_t i = 0; i < program->n_attributes; i++)
		if (strcmp(program->attributes[i].name, name) == 0) {
			program->attributes[i].location = location;
			return 0;
		}
	copy = strdup(name);
	if (!copy || MEMORY_GROW(program->attributes, program->attribute_room, program->n_attributes + 1)) {
		free(copy);
		return err_report(ERR_SYSTEM, NULL, "out of memory for an attribute");
	}
	program->attributes[program->n_attributes++] = (struct glsl_attribute){ copy, location };
	return 0;
}

int gls_shader_locate_uniform(struct gls_shader *program, const char *name, uint32_t location)
{
	uint32_t element;
	const struct glsl_uniform *u = glsl_uniforms_named(&program->uniforms, name, &element);

	return u ? set_locations(program, location, (uint64_t)(u - program->uniforms.list), element) : 0;
}

int gls_shader_set_uniform(struct gls_shader *program, uint32_t location, const float *values, uint32_t count,
                           uint32_t rows, uint32_t columns, int transposed, int only_asks,
                           struct gls_uniform_change *change)
{
	const uint64_t found = (uintptr_t)table_find(&program->locations, location);
	const uint32_t element = (uint32_t)(found - 1), n = rows * (columns ? columns : 1);
	const struct glsl_uniform *u;
	int changes = 0;

	if (!found || (found - 1) >> 32 >= program->uniforms.n)
		return 0;
	u = &program->uniforms.list[(found - 1) >> 32];
	if (u->rows != rows || u->columns != columns || element >= u->length)
		return 0;
	count = count < u->length - element ? count : u->length - element;
	*change = (struct gls_uniform_change){ u->first + element * n, count * n };
	for (uint32_t i = 0; i < count; i++)
		for (uint32_t k = 0; k < n; k++) {
			const float given = values[i * n + (transposed ? k % rows * columns + k / rows : k)],
				    v = u->kind == GLSL_BOOL ? given != 0 : given;
			float *to = &program->uniforms.values[change->first + i * n + k];

			changes |= memcmp(to, &v, sizeof(v)) != 0;
			if (!only_asks)
				*to = v;
		}
	return changes;
}
