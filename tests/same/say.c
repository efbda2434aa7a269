#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/err.h"
#include "base/memory.h"
#include "gl_tokens.h"
#include "replay/build/program.h"
#include "replay/gl/dispatch.h"
#include "tests/same/story.h"

void *need(void *memory)
{
	if (!memory) {
		fputs("out of memory\n", stderr);
		exit(-ERR_SYSTEM);
	}
	return memory;
}

void not_for(struct story *s, const char *why)
{
	s->why_not = s->why_not ? s->why_not : why;
}

/* The signature of a command, by its name, a literal. */
static const struct call_sig *sig_of(const char *name, uint32_t n_args)
{
	static const char *arg_names[] = { "a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l" };
	static struct call_sig *sigs[256];
	size_t i;

	for (i = 0; sigs[i]; i++)
		if (sigs[i]->name == name)
			return sigs[i];
	sigs[i] = need(malloc(sizeof(*sigs[i])));
	*sigs[i] = (struct call_sig){
		.name = name, .n_args = n_args, .arg_names = arg_names, .command = gls_command_find(name)
	};
	return sigs[i];
}

void say_call(struct story *s, const struct call *c)
{
	if (!s->mute && trace_out_call(s->out, c))
		exit(-ERR_SYSTEM);
	if (s->n_said++ == STORY_MOST_CALLS)
		not_for(s, "it would take millions of calls");
}

void story_execute(struct story *s, const struct call *c)
{
	if (gls_exec_call(s->x, c))
		exit(-ERR_SYSTEM);
	if (s->x->st && !s->is_open)
		memcpy(s->said, s->x->st->a.current.attribute, sizeof(s->said));
}

static void make(struct story *s, int lasts, const char *name, const char *form, va_list list)
{
	struct trace_value args[12], numbers[12][16];
	struct call c = { .thread = s->thread, .n_args = (uint32_t)strlen(form), .args = args, .ret = { .type = TRACE_NONE } };

	for (uint32_t i = 0; i < c.n_args; i++) {
		struct trace_value *v = &args[i];
		const float *floats;

		*v = (struct trace_value){ .type = TRACE_NULL };
		switch (form[i]) {
		case 'u':
			*v = (struct trace_value){ .type = TRACE_UINT, .u = va_arg(list, uint32_t) };
			break;
		case 'f':
			*v = (struct trace_value){ .type = TRACE_FLOAT, .f = (float)va_arg(list, double) };
			break;
		case 's':
			v->type = TRACE_STRING;
			v->str = va_arg(list, const char *);
			v->count = strlen(v->str);
			break;
		case 'b':
			v->type = TRACE_BLOB;
			v->blob = va_arg(list, const uint8_t *);
			v->count = va_arg(list, size_t);
			break;
		case 'v': /* four floats */
		case 'm': /* a matrix */
			*v = (struct trace_value){ .type = TRACE_ARRAY, .count = form[i] == 'm' ? 16 : 4, .items = numbers[i] };
			floats = va_arg(list, const float *);
			for (unsigned k = 0; k < v->count; k++)
				numbers[i][k] = (struct trace_value){ .type = TRACE_FLOAT, .f = floats[k] };
		}
	}
	c.sig = sig_of(name, c.n_args);
	say_call(s, &c);
	if (lasts)
		story_execute(s, &c);
}

void say(struct story *s, const char *name, const char *form, ...)
{
	va_list list;

	va_start(list, form);
	make(s, 0, name, form, list);
	va_end(list);
}

void tell(struct story *s, const char *name, const char *form, ...)
{
	va_list list;

	va_start(list, form);
	make(s, 1, name, form, list);
	va_end(list);
}

void put_attribute(struct story *s, unsigned a, const float v[4], int lasts)
{
	void (*put)(struct story *, const char *, const char *, ...) = lasts ? tell : say;

	memcpy(s->said[a], v, sizeof(s->said[a]));
	if (a == GLS_ATTR_NORMAL)
		put(s, "glNormal3f", "fff", v[0], v[1], v[2]);
	else if (a == GLS_ATTR_COLOR)
		put(s, "glColor4f", "ffff", v[0], v[1], v[2], v[3]);
	else if (a == GLS_ATTR_SECONDARY)
		put(s, "glSecondaryColor3f", "fff", v[0], v[1], v[2]);
	else if (a == GLS_ATTR_FOG_COORD)
		put(s, "glFogCoordf", "f", v[0]);
	else
		put(s, "glMultiTexCoord4f", "uffff", GL_TEXTURE0 + a - GLS_ATTR_TEXCOORD, v[0], v[1], v[2], v[3]);
}

void say_attribute(struct story *s, unsigned a, const float v[4])
{
	if (memcmp(s->said[a], v, sizeof(s->said[a])) != 0)
		put_attribute(s, a, v, 0);
}

void say_current(struct story *s)
{
	for (unsigned a = 0; a < STORY_ATTRIBUTES; a++)
		say_attribute(s, a, s->x->st->a.current.attribute[a]);
}

void say_run(struct story *s, uint32_t mode, const struct story_vertex *v, uint32_t n, const uint32_t *order)
{
	say(s, "glBegin", "u", mode);
	for (uint32_t i = 0; i < n; i++) {
		const struct story_vertex *vertex = &v[order ? order[i] : i];
		const float *p = vertex->position;

		for (unsigned a = 0; a < STORY_ATTRIBUTES; a++)
			say_attribute(s, a, vertex->attribute[a]);
		if (p[3] == 1)
			say(s, "glVertex3f", "fff", p[0], p[1], p[2]);
		else
			say(s, "glVertex4f", "ffff", p[0], p[1], p[2], p[3]);
	}
	say(s, "glEnd", "");
	say_current(s);
}

/* ---- runs ---- */

struct story_vertex *run_add(struct story_run *run)
{
	if (MEMORY_GROW(run->v, run->room, run->n + 1))
		exit(-ERR_SYSTEM);
	return &run->v[run->n++];
}

uint32_t run_triangles(struct story *s, const struct story_run *run, const uint32_t **order)
{
	static struct gls_geometry g;
	const struct gls_state *st = s->x->st;

	if (gls_mode_kind(run->mode) != SCENE_TRIANGLES || st->a.polygon.mode[0] != GL_FILL ||
	    st->a.polygon.mode[1] != GL_FILL)
		return 0;
	gls_geometry_clear(&g);
	g.kind = SCENE_TRIANGLES;
	if (gls_geometry_reserve(s->x, &g, run->n, 0))
		exit(-ERR_SYSTEM);
	for (uint32_t i = 0; i < run->n; i++) {
		memcpy(g.position + 4 * (size_t)i, run->v[i].position, 16);
		g.edge[i] = 1;
	}
	g.n_vertices = run->n;
	if (gls_geometry_cut(s->x, &g, run->mode, 0, run->n, NULL, (int)st->a.lighting.first_provokes))
		exit(-ERR_SYSTEM);
	g.quads = run->mode == GL_QUADS;
	if (g.quads && g.n_primitives && !run->listed &&
	    gls_quads_turn(st, gls_shades_flat(st), g.position, g.index, g.n_primitives))
		gls_geometry_turn_quads(&g);
	*order = g.index;
	return g.n_primitives;
}
