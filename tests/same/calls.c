/* The same vertices through other calls, and redundant state changes. */
#include "tests/same/relations.h"

#include <stdlib.h>

#include "gl_tokens.h"
#include "replay/machine/commands.h"
#include "tests/same/story.h"

void say_plain(struct story *s, const struct story_run *run, const struct story_vertex *v)
{
	const uint32_t *order, n = run->mode == GL_QUADS ? run_triangles(s, run, &order) : 0;

	if (n)
		say_run(s, GL_TRIANGLES, v, 3 * n, order);
	else
		say_run(s, run->mode, v, run->n, NULL);
}

void run_as_it_is(struct story *s, const struct story_run *run)
{
	say_plain(s, run, run->v);
}

void run_plain(struct story *s, const struct story_run *run)
{
	s->n_changes++;
	run_as_it_is(s, run);
}

void run_listed(struct story *s, const struct story_run *run)
{
	const uint32_t name = OURS + s->step++ % 0x10000;

	say(s, "glNewList", "uu", name, GL_COMPILE);
	run_plain(s, run);
	say(s, "glEndList", "");
	say(s, "glCallList", "u", name);
}

/* One float array of a draw. a: an attribute; STORY_ATTRIBUTES: positions */
static void say_array(struct story *s, unsigned a, const float *floats, size_t n, int on)
{
	static const char *const names[] = { "glNormalPointer", "glColorPointer", "glSecondaryColorPointer",
		                             "glFogCoordPointer" };
	static const uint32_t arrays[] = { GL_NORMAL_ARRAY, GL_COLOR_ARRAY, GL_SECONDARY_COLOR_ARRAY, GL_FOG_COORD_ARRAY };
	const int is_vertex = a == STORY_ATTRIBUTES, is_texture = !is_vertex && a >= GLS_ATTR_TEXCOORD;

	if (is_texture)
		say(s, "glClientActiveTexture", "u", GL_TEXTURE0 + a - GLS_ATTR_TEXCOORD);
	say(s, on ? "glEnableClientState" : "glDisableClientState", "u",
	    is_vertex ? GL_VERTEX_ARRAY : is_texture ? GL_TEXTURE_COORD_ARRAY : arrays[a]);
	if (!on)
		return;
	if (is_vertex || is_texture)
		say(s, is_vertex ? "glVertexPointer" : "glTexCoordPointer", "uuub", 4, GL_FLOAT, 16, floats, 16 * n);
	else if (a == GLS_ATTR_NORMAL || a == GLS_ATTR_FOG_COORD)
		say(s, names[a], "uub", GL_FLOAT, 16, floats, 16 * n);
	else
		say(s, names[a], "uuub", a == GLS_ATTR_COLOR ? 4 : 3, GL_FLOAT, 16, floats, 16 * n);
}

/* amount 1: by indices, with vertices in reverse order */
void run_arrays(struct story *s, const struct story_run *run)
{
	const uint32_t *order, cut = run->mode == GL_QUADS ? run_triangles(s, run, &order) : 0, n = cut ? 3 * cut : run->n;
	const int indexed = s->relation->amount > 0;
	float (*floats)[4] = need(calloc(n, sizeof(*floats)));
	uint32_t *index = need(calloc(n, sizeof(*index)));

	say(s, "glPushClientAttrib", "u", GL_CLIENT_VERTEX_ARRAY_BIT);
	say(s, "glBindBuffer", "uu", GL_ARRAY_BUFFER, 0);
	say(s, "glBindBuffer", "uu", GL_ELEMENT_ARRAY_BUFFER, 0);
	say(s, "glDisableClientState", "u", GL_EDGE_FLAG_ARRAY);
	for (unsigned a = 0; a <= STORY_ATTRIBUTES; a++) {
		int varies = a == STORY_ATTRIBUTES;

		for (uint32_t i = 0; i < n; i++) {
			const struct story_vertex *v = &run->v[cut ? order[i] : i];
			const uint32_t at = indexed ? n - 1 - i : i;

			index[i] = n - 1 - i;
			memcpy(floats[at], a < STORY_ATTRIBUTES ? v->attribute[a] : v->position, 16);
			varies |= memcmp(floats[at], s->said[a < STORY_ATTRIBUTES ? a : 0], 16) != 0;
		}
		say_array(s, a, floats[0], n, varies);
	}
	if (indexed)
		say(s, "glDrawElements", "uuub", cut ? GL_TRIANGLES : run->mode, n, GL_UNSIGNED_INT, index, n * sizeof(*index));
	else
		say(s, "glDrawArrays", "uuu", cut ? GL_TRIANGLES : run->mode, 0, n);
	say(s, "glPopClientAttrib", "");
	say_current(s);
	s->n_changes++;
	free(floats);
	free(index);
}

void run_cut(struct story *s, const struct story_run *run)
{
	const uint32_t *order, n = run_triangles(s, run, &order);

	s->n_changes += n && run->mode != GL_TRIANGLES;
	if (n)
		say_run(s, GL_TRIANGLES, run->v, 3 * n, order);
	else
		run_as_it_is(s, run);
}

/* One strip for all triangles, joined by degenerate ones: six between two preserve the facing. */
void run_strip(struct story *s, const struct story_run *run)
{
	const uint32_t *order, n = run_triangles(s, run, &order);
	uint32_t *strip;

	if (!n) {
		run_as_it_is(s, run);
		return;
	}
	strip = need(malloc(6 * (size_t)n * sizeof(*strip)));
	for (uint32_t i = 0; i < n; i++) {
		const uint32_t *t = order + 3 * (size_t)i;

		memcpy(strip + 6 * (size_t)i, (uint32_t[]){ t[0], t[0], t[0], t[1], t[2], t[2] }, 24);
	}
	s->n_changes++;
	say_run(s, GL_TRIANGLE_STRIP, run->v, 6 * n, strip);
	free(strip);
}

void run_split(struct story *s, const struct story_run *run)
{
	const uint32_t *order, n = run_triangles(s, run, &order);

	for (uint32_t i = 0; i < n; i++)
		say_run(s, GL_TRIANGLES, run->v, 3, order + 3 * (size_t)i);
	s->n_changes += n > 1;
	if (!n)
		run_as_it_is(s, run);
}

static void say_joined(struct story *s)
{
	if (s->joined.n)
		run_as_it_is(s, &s->joined);
	s->joined.n = 0;
}

void run_join(struct story *s, const struct story_run *run)
{
	const uint32_t *order, n = run_triangles(s, run, &order);

	if (!n) {
		say_joined(s);
		run_as_it_is(s, run);
		return;
	}
	s->n_changes += s->joined.n > 0;
	s->joined.mode = GL_TRIANGLES;
	for (uint32_t i = 0; i < 3 * n; i++)
		*run_add(&s->joined) = run->v[order[i]];
}

void call_join(struct story *s, const struct call *c, int draws)
{
	(void)draws;
	if (c->sig->command < 0 || gls_commands[c->sig->command].kind != GLS_KIND_VERTEX)
		say_joined(s);
	say_call(s, c);
}

/* ---- redundant state changes ---- */

void say_matrices(struct story *s, const float modelview[16], const float projection[16])
{
	say(s, "glMatrixMode", "u", GL_PROJECTION);
	say(s, "glLoadMatrixf", "m", projection);
	say(s, "glMatrixMode", "u", GL_MODELVIEW);
	say(s, "glLoadMatrixf", "m", modelview);
	say(s, "glMatrixMode", "u", s->x->st->a.transform.matrix_mode);
}

void say_own_matrices(struct story *s)
{
	say_matrices(s, stack_top(&s->x->st->modelview), stack_top(&s->x->st->projection));
}

void run_loaded(struct story *s, const struct story_run *run)
{
	say_matrices(s, stack_top(&s->x->st->modelview), stack_top(&s->x->st->projection));
	run_as_it_is(s, run);
	s->n_changes++;
}

static int can_insert(const struct story *s, int draws)
{
	const struct gls_state *st = s->x->st;

	return draws && !st->begin_mode && !st->list && st->attrib_depth < GLS_MAX_ATTRIB_DEPTH - 1 &&
	       st->modelview.depth < 30;
}

void call_undone(struct story *s, const struct call *c, int draws)
{
	const struct gls_state *st = s->x->st;

	if (can_insert(s, draws)) {
		say(s, "glPushAttrib", "u", ALL_ATTRIBS);
		say(s, "glMatrixMode", "u", GL_MODELVIEW);
		say(s, "glPushMatrix", "");
		say(s, "glScalef", "fff", 2.0, 3.0, 4.0);
		say(s, st->a.lighting.enabled ? "glDisable" : "glEnable", "u", GL_LIGHTING);
		say(s, "glLightfv", "uuv", GL_LIGHT0, GL_POSITION, (float[]){ 5, 6, 7, 1 });
		say(s, "glDepthFunc", "u", GL_GREATER);
		say(s, "glColorMask", "uuuu", 0, 1, 0, 1);
		say(s, "glColor4f", "ffff", 0.1, 0.2, 0.3, 0.4);
		say(s, "glViewport", "uuuu", 3, 3, 9, 9);
		say(s, "glPopMatrix", "");
		say(s, "glPopAttrib", "");
		say(s, "glDepthFunc", "u", st->a.depth.func);
		say(s, "glShadeModel", "u", st->a.lighting.shade_model);
		s->n_changes++;
	}
	say_call(s, c);
}

void call_asked(struct story *s, const struct call *c, int draws)
{
	if (can_insert(s, draws)) {
		say(s, "glBeginQuery", "uu", GL_SAMPLES_PASSED, OURS);
		say(s, "glGetError", "");
		say(s, "glGetIntegerv", "u", GL_MATRIX_MODE);
		say(s, "glEnable", "u", 0xdead);
		say(s, "glMatrixMode", "u", 1);
		say(s, "glBlendFunc", "uu", 7, 7);
		say(s, "glLightf", "uuf", 0, 0, 0.0);
		say(s, "glBegin", "u", 99);
		say(s, "glViewport", "uuff", 0, 0, -1.0, -1.0);
		say(s, "glEndQuery", "u", GL_SAMPLES_PASSED);
		s->n_changes++;
	}
	say_call(s, c);
}

/* ---- sides ---- */

void run_wound(struct story *s, const struct story_run *run)
{
	const uint32_t *order, n = run_triangles(s, run, &order), ccw = s->x->st->a.polygon.front_face == GL_CCW;
	uint32_t *other = need(malloc((3 * (size_t)n + 1) * sizeof(*other)));

	for (uint32_t i = 0; i < n; i++)
		memcpy(other + 3 * (size_t)i, (uint32_t[]){ order[3 * i + 1], order[3 * i], order[3 * i + 2] }, 12);
	if (!n) {
		run_as_it_is(s, run);
	} else {
		say(s, "glFrontFace", "u", ccw ? GL_CW : GL_CCW);
		say_run(s, GL_TRIANGLES, run->v, 3 * n, other);
		say(s, "glFrontFace", "u", ccw ? GL_CCW : GL_CW);
		s->n_changes++;
	}
	free(other);
}

void run_culled(struct story *s, const struct story_run *run)
{
	const struct gls_polygon *p = &s->x->st->a.polygon;

	if (s->x->st->a.lighting.two_side || s->x->st->a.programs.two_side || s->x->st->a.stencil.two_side ||
	    p->mode[0] != p->mode[1])
		not_for(s, "both sides count");
	say(s, "glFrontFace", "u", p->front_face == GL_CCW ? GL_CW : GL_CCW);
	say(s, "glCullFace", "u", p->cull_face == GL_BACK ? GL_FRONT : p->cull_face == GL_FRONT ? GL_BACK : p->cull_face);
	run_as_it_is(s, run);
	say(s, "glCullFace", "u", p->cull_face);
	say(s, "glFrontFace", "u", p->front_face);
	s->n_changes++;
}
