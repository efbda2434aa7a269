#include "replay/index/snapshot_shaders.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "gl_tokens.h"
#include "replay/index/snapshot_parts.h"
#include "replay/programs/held.h"

/* Save a text, or the fact that there is none. */
static void put_text(struct saver *s, const char *text)
{
	bytes_put_u64(s->out, text != NULL);
	saver_blob(s, text, text ? strlen(text) : 0);
}

/* Read a text, to be freed with free(); NULL: there is none, or the loader is bad. */
static char *get_text(struct loader *l)
{
	const uint64_t is_there = cursor_u64(&l->in);
	size_t n;
	uint8_t *bytes = loader_blob(l, &n);
	char *text = is_there ? loader_alloc(l, n + 1) : NULL;

	if (text && n)
		memcpy(text, bytes, n);
	free(bytes);
	return text;
}

static void put_shader(struct saver *s, void *value)
{
	const struct gls_shader *sh = value;
	const uint32_t head[] = { sh->type, sh->deleted, sh->uses, sh->stages.linked, sh->other_stages,
		                  sh->stages.links, sh->products_once };

	bytes_put(s->out, head, sizeof(head));
	put_text(s, sh->source);
	put_text(s, sh->compiled);
	bytes_put_u64(s->out, sh->n_attached);
	bytes_put(s->out, sh->attached, sh->n_attached * sizeof(*sh->attached));
	bytes_put_u64(s->out, sh->n_attributes);
	for (uint32_t i = 0; i < sh->n_attributes; i++) {
		bytes_put_u64(s->out, sh->attributes[i].location);
		put_text(s, sh->attributes[i].name);
	}
	for (unsigned stage = 0; stage < 2; stage++) {
		bytes_put_u64(s->out, sh->n_texts[stage]);
		for (uint32_t i = 0; i < sh->n_texts[stage]; i++)
			put_text(s, sh->texts[stage][i]);
	}
	saver_table(s, &sh->locations, &snapshot_numbers);
	saver_blob(s, sh->uniforms.values, sh->uniforms.n_values * sizeof(float));
	bytes_put_u64(s->out, sh->stages.n_held);
	for (uint32_t i = 0; i < sh->stages.n_held; i++) {
		bytes_put_u64(s->out, sh->stages.held[i].context);
		bytes_put_u64(s->out, sh->stages.held[i].stage);
		saver_blob(s, sh->stages.held[i].values, sh->stages.n_uniforms * sizeof(*sh->stages.held->values));
	}
}

/* Values of its uniforms. */
static void get_held(struct loader *l, struct gls_shader *sh)
{
	for (uint64_t n = loader_count(l, 24); n && !loader_is_bad(l); n--) {
		const uint64_t context = cursor_u64(&l->in), stage = cursor_u64(&l->in);
		size_t bytes;
		uint8_t *values = loader_blob(l, &bytes);

		if (loader_is_bad(l) || stage >= N_GLS_STAGES || bytes != sh->stages.n_uniforms * sizeof(*sh->stages.held->values) ||
		    gls_held_keep(&sh->stages, context, (enum gls_stage)stage) || !sh->stages.n_held)
			l->in.failed = 1;
		else
			memcpy(sh->stages.held[sh->stages.n_held - 1].values, values, bytes);
		free(values);
	}
}

static void get_attributes(struct loader *l, struct gls_shader *sh)
{
	for (uint64_t n = loader_count(l, 16); n && !loader_is_bad(l); n--) {
		const uint32_t location = (uint32_t)cursor_u64(&l->in);
		char *name = get_text(l);

		if (!loader_is_bad(l) && (!name || gls_shader_locate_attribute(sh, name, location)))
			l->in.failed = 1;
		free(name);
	}
}

static void get_texts(struct loader *l, struct gls_shader *sh)
{
	for (unsigned stage = 0; stage < 2; stage++)
		for (uint64_t n = loader_count(l, 16); n && !loader_is_bad(l); n--) {
			char *text = get_text(l);

			if (!loader_is_bad(l) &&
			    (!text ||
			     gls_shader_add_text(sh, stage == GLSL_VERTEX_STAGE ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER,
			                         text)))
				l->in.failed = 1;
			free(text);
		}
}

/* The program as it was linked, with its uniforms' values at that time. */
static void get_program(struct loader *l, struct gls_shader *sh)
{
	uint8_t *values;
	size_t n;

	get_attributes(l, sh);
	get_texts(l, sh);
	if (!loader_is_bad(l) && sh->stages.linked && gls_shader_translate(sh, 0))
		l->err = ERR_SYSTEM;
	loader_table(l, &sh->locations, &snapshot_numbers);
	values = loader_blob(l, &n);
	if (values && n == sh->uniforms.n_values * sizeof(float))
		memcpy(sh->uniforms.values, values, n);
	free(values);
	get_held(l, sh);
}

static void drop_shader(void *shader)
{
	gls_shader_free(shader);
}

static void *get_shader(struct loader *l)
{
	struct gls_shader *sh = loader_alloc(l, sizeof(*sh));
	uint32_t head[7] = { 0 }, links;

	if (!sh)
		return NULL;
	cursor_copy(&l->in, head, sizeof(head));
	sh->type = head[0];
	sh->deleted = head[1];
	sh->uses = head[2];
	sh->stages.linked = head[3];
	sh->other_stages = head[4];
	links = head[5];
	sh->products_once = head[6];
	sh->source = get_text(l);
	sh->compiled = get_text(l);
	sh->n_attached = (uint32_t)loader_count(l, sizeof(*sh->attached));
	if (!loader_is_bad(l) && MEMORY_GROW(sh->attached, sh->attached_room, sh->n_attached + 1))
		l->err = ERR_SYSTEM;
	if (!loader_is_bad(l))
		cursor_copy(&l->in, sh->attached, sh->n_attached * sizeof(*sh->attached));
	get_program(l, sh);
	sh->stages.links = links;
	if (!loader_is_bad(l))
		return sh;
	gls_shader_free(sh);
	return NULL;
}

static const struct snapshot_table how = { "shader", 7 * sizeof(uint32_t), put_shader, get_shader, drop_shader };

void snapshot_put_shaders(struct saver *s, const struct table *shaders)
{
	saver_table(s, shaders, &how);
}

void snapshot_get_shaders(struct loader *l, struct table *shaders)
{
	loader_table(l, shaders, &how);
}
