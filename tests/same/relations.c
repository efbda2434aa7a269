#include "tests/same/relations.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "replay/gl/surface/drawable.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "tests/same/story.h"

#define ALL_ATTRIBS 0xfffffu
#define OURS 0x7001u /* a name that no program uses, of any kind of object */

/* Up to four numbers of an argument. Those of OpenGL ES may be fixed-point ones. */
static void read_numbers(const struct call *c, unsigned i, float v[4])
{
	const int fixed = gls_commands[c->sig->command].fixed != 0;

	arg_floats(c, i, v, 4);
	for (unsigned k = 0; k < 4; k++)
		v[k] /= fixed ? 65536 : 1;
}

static const float *top(const struct gls_matrix_stack *stack)
{
	return stack->matrices[stack->depth];
}

static int is_triangles(const struct story_run *run)
{
	return gls_mode_kind(run->mode) == SCENE_TRIANGLES;
}

/* ---- the same vertices by other calls ---- */

/* Write a run with these vertices. Quads are cut: Mesa cuts those otherwise that come from lists or by indices. */
static void say_plain(struct story *s, const struct story_run *run, const struct story_vertex *v)
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

static void run_plain(struct story *s, const struct story_run *run)
{
	s->n_changes++;
	run_as_it_is(s, run);
}

static void run_listed(struct story *s, const struct story_run *run)
{
	const uint32_t name = OURS + s->step++ % 0x10000;

	say(s, "glNewList", "uu", name, GL_COMPILE);
	run_plain(s, run);
	say(s, "glEndList", "");
	say(s, "glCallList", "u", name);
}

/* One array of a draw, of floats. a: an attribute; STORY_ATTRIBUTES: positions */
static void say_array(struct story *s, unsigned a, const float *floats, size_t n, int on)
{
	static const char *const names[] = { "glNormalPointer", "glColorPointer", "glSecondaryColorPointer",
		                             "glFogCoordPointer" };
	static const uint32_t arrays[] = { GL_NORMAL_ARRAY, GL_COLOR_ARRAY, GL_SECONDARY_COLOR_ARRAY, GL_FOG_COORD_ARRAY };
	const int is_vertex = a == STORY_ATTRIBUTES, is_texture = !is_vertex && a >= GLS_ATTR_TEXCOORD;

	if (is_texture)
		say(s, "glClientActiveTexture", "u", GL_TEXTURE0 + a - GLS_ATTR_TEXCOORD);
	say(s, on ? "glEnableClientState" : "glDisableClientState", "u",
	    is_vertex    ? GL_VERTEX_ARRAY
	    : is_texture ? GL_TEXTURE_COORD_ARRAY
	                 : arrays[a]);
	if (!on)
		return;
	if (is_vertex || is_texture)
		say(s, is_vertex ? "glVertexPointer" : "glTexCoordPointer", "uuub", 4, GL_FLOAT, 16, floats, 16 * n);
	else if (a == GLS_ATTR_NORMAL || a == GLS_ATTR_FOG_COORD)
		say(s, names[a], "uub", GL_FLOAT, 16, floats, 16 * n);
	else
		say(s, names[a], "uuub", a == GLS_ATTR_COLOR ? 4 : 3, GL_FLOAT, 16, floats, 16 * n);
}

/* amount 1: by indices, the vertices backwards */
static void run_arrays(struct story *s, const struct story_run *run)
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

static void run_cut(struct story *s, const struct story_run *run)
{
	const uint32_t *order, n = run_triangles(s, run, &order);

	s->n_changes += n && run->mode != GL_TRIANGLES;
	if (n)
		say_run(s, GL_TRIANGLES, run->v, 3 * n, order);
	else
		run_as_it_is(s, run);
}

/* One strip of all triangles, joined by empty ones: six between two keep the side. */
static void run_strip(struct story *s, const struct story_run *run)
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

static void run_split(struct story *s, const struct story_run *run)
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

static void run_join(struct story *s, const struct story_run *run)
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

static void call_join(struct story *s, const struct call *c, int draws)
{
	(void)draws;
	if (c->sig->command < 0 || gls_commands[c->sig->command].kind != GLS_KIND_VERTEX)
		say_joined(s);
	say_call(s, c);
}

/* ---- state that is what it was ---- */

static void load(struct story *s, const float modelview[16], const float projection[16])
{
	say(s, "glMatrixMode", "u", GL_PROJECTION);
	say(s, "glLoadMatrixf", "m", projection);
	say(s, "glMatrixMode", "u", GL_MODELVIEW);
	say(s, "glLoadMatrixf", "m", modelview);
	say(s, "glMatrixMode", "u", s->x->st->a.transform.matrix_mode);
}

static void run_loaded(struct story *s, const struct story_run *run)
{
	load(s, top(&s->x->st->modelview), top(&s->x->st->projection));
	run_as_it_is(s, run);
	s->n_changes++;
}

static int can_insert(const struct story *s, int draws)
{
	const struct gls_state *st = s->x->st;

	return draws && !st->begin_mode && !st->list && st->attrib_depth < GLS_MAX_ATTRIB_DEPTH - 1 &&
	       st->modelview.depth < 30;
}

static void call_undone(struct story *s, const struct call *c, int draws)
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

static void call_asked(struct story *s, const struct call *c, int draws)
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

/* ---- the world elsewhere ---- */

static void run_measured(struct story *s, const struct story_run *run)
{
	float eye[4];

	for (uint32_t i = 0; i < run->n && s->x->st->a.depth.enabled; i++) {
		mat4_transform(eye, top(&s->x->st->modelview), run->v[i].position);
		s->n_measured++;
		s->distance += (logf(fmaxf(fabsf(eye[2] / eye[3]), 1e-6f)) - s->distance) / s->n_measured;
	}
}

/* amount: how far, in distances from the eye to things; below 0: vertices are only rounded as they are there */
static void run_moved(struct story *s, const struct story_run *run)
{
	const float d = (float)(fabs(s->relation->amount) * exp2(ceil(s->distance / log(2))));
	const float by[3] = { d, -d, d };
	const int stays = s->relation->amount < 0;
	const struct gls_state *st = s->x->st;
	struct story_vertex *v = need(malloc((run->n + 1) * sizeof(*v)));

	for (unsigned unit = 0; unit < GLS_MAX_UNITS; unit++)
		for (unsigned k = 0; k < 4; k++)
			if (st->a.texturing.units[unit].gen_enabled >> k & 1 &&
			    st->a.texturing.units[unit].value.gen_mode[k] == GL_OBJECT_LINEAR)
				not_for(s, "texture coordinates come from places in the object");
	memcpy(v, run->v, run->n * sizeof(*v));
	for (uint32_t i = 0; i < run->n; i++)
		for (unsigned k = 0; k < 3; k++) {
			volatile float there = v[i].position[k] + by[k] * v[i].position[3];

			v[i].position[k] = stays ? there - by[k] * v[i].position[3] : there;
		}
	if (!stays) {
		say(s, "glMatrixMode", "u", GL_MODELVIEW);
		say(s, "glPushMatrix", "");
		say(s, "glTranslatef", "fff", -by[0], -by[1], -by[2]);
	}
	say_plain(s, run, v);
	if (!stays) {
		say(s, "glPopMatrix", "");
		say(s, "glMatrixMode", "u", st->a.transform.matrix_mode);
	}
	s->n_changes++;
	free(v);
}

/* ---- another eye space: K before all that leads there, its inverse before all that leads on ---- */

static void eye_matrices(const struct story *s, float k[16], float inverse[16])
{
	memcpy(k, mat4_identity, sizeof(mat4_identity));
	if (s->relation->amount > 0) { /* scaled by a power of two, so that nothing is rounded */
		k[0] = k[5] = k[10] = (float)s->relation->amount;
	} else if (s->relation->amount == 0) {
		k[0] = -1;
	} else { /* a rotation */
		mat4_rotation(k, 70, 0.6f, 0.64f, 0.48f);
	}
	mat4_invert(inverse, k);
}

static void load_other_eye(struct story *s)
{
	const struct gls_state *st = s->x->st;
	float k[16], inverse[16], modelview[16], projection[16];

	eye_matrices(s, k, inverse);
	mat4_mul(modelview, k, top(&st->modelview));
	mat4_mul(projection, top(&st->projection), inverse);
	load(s, modelview, projection);
}

static void load_own_eye(struct story *s)
{
	load(s, top(&s->x->st->modelview), top(&s->x->st->projection));
}

/* Does the state mean the same in the other eye space? */
static void check_eye(struct story *s)
{
	const struct gls_attribs *a = &s->x->st->a;
	const double amount = s->relation->amount;

	if (amount > 0 && (a->point.attenuation[1] != 0 || a->point.attenuation[2] != 0))
		not_for(s, "points shrink with distance");
	if (amount < 0 && a->fog.enabled)
		not_for(s, "fog goes by one direction of eye space");
	for (unsigned i = 0; amount < 0 && a->lighting.enabled && !a->lighting.local_viewer && i < GLS_MAX_LIGHTS; i++)
		for (unsigned k = 0; k < 3 && a->lighting.lights[i].enabled; k++)
			if (a->lighting.lights[i].value.specular[k] *
			        (a->lighting.face[0].specular[k] + a->lighting.face[1].specular[k]) >
			    0)
				not_for(s, "highlights go by one direction of eye space");
	for (unsigned u = 0; amount <= 0 && u < GLS_MAX_UNITS; u++)
		for (unsigned k = 0; k < 4; k++) {
			const struct gls_unit *unit = &a->texturing.units[u];

			if (unit->enabled && unit->gen_enabled >> k & 1 && unit->value.gen_mode[k] != GL_EYE_LINEAR &&
			    unit->value.gen_mode[k] != GL_OBJECT_LINEAR)
				not_for(s, "textures mirror by directions of eye space");
		}
}

static void run_eye(struct story *s, const struct story_run *run)
{
	const struct gls_attribs *a = &s->x->st->a;
	const float scale = s->relation->amount > 0 && !a->transform.normalize && !a->transform.rescale_normal
	                        ? (float)s->relation->amount
	                        : 1;
	struct story_vertex *v = need(malloc((run->n + 1) * sizeof(*v)));
	float k[16], inverse[16];

	check_eye(s);
	eye_matrices(s, k, inverse);
	for (unsigned i = 0; i < GLS_MAX_LIGHTS && !s->n_changes; i++) { /* nobody may have placed them */
		if (memcmp(a->lighting.lights[i].value.position_eye, (float[]){ 0, 0, 1, 0 }, 16) != 0)
			continue;
		load(s, k, top(&s->x->st->projection));
		say(s, "glLightfv", "uuv", GL_LIGHT0 + i, GL_POSITION, (float[]){ 0, 0, 1, 0 });
	}
	memcpy(v, run->v, run->n * sizeof(*v));
	for (uint32_t i = 0; i < run->n; i++)
		for (unsigned c = 0; c < 3; c++)
			v[i].attribute[GLS_ATTR_NORMAL][c] *= scale;
	load_other_eye(s);
	say_plain(s, run, v);
	load_own_eye(s);
	s->n_changes++;
	free(v);
}

static void call_eye(struct story *s, const struct call *c, int draws)
{
	const double scale = s->relation->amount > 0 ? s->relation->amount : 1;
	const struct gls_fog *fog = s->x->st ? &s->x->st->a.fog : NULL;
	float v[4] = { 0 };

	(void)draws;
	if (begins(c, "glLight") && !begins(c, "glLightM") &&
	    (arg_u(c, 1) == GL_LINEAR_ATTENUATION || arg_u(c, 1) == GL_QUADRATIC_ATTENUATION)) {
		read_numbers(c, 2, v);
		say(s, "glLightf", "uuf", arg_u(c, 0), arg_u(c, 1),
		    v[0] / (arg_u(c, 1) == GL_LINEAR_ATTENUATION ? scale : scale * scale));
	} else if (begins(c, "glFog") && !begins(c, "glFogC") && arg_u(c, 0) == GL_FOG_DENSITY) {
		read_numbers(c, 1, v);
		say(s, "glFogf", "uf", GL_FOG_DENSITY, v[0] / scale);
	} else if (begins(c, "glFog") && !begins(c, "glFogC") &&
	           (arg_u(c, 0) == GL_FOG_START || arg_u(c, 0) == GL_FOG_END)) {
		read_numbers(c, 1, v);
		say(s, "glFogf", "uf", arg_u(c, 0), v[0] * scale);
	} else if ((begins(c, "glLight") && !begins(c, "glLightM")) || begins(c, "glClipPlane") ||
	           begins(c, "glTexGen") || begins(c, "glRasterPos")) {
		load_other_eye(s);
		say_call(s, c);
		load_own_eye(s);
	} else {
		say_call(s, c);
	}
	if (is(c, "glEnable") && arg_u(c, 0) == GL_FOG && scale != 1) { /* initial values count as well */
		say(s, "glFogf", "uf", GL_FOG_DENSITY, fog->density / scale);
		say(s, "glFogf", "uf", GL_FOG_START, fog->start * scale);
		say(s, "glFogf", "uf", GL_FOG_END, fog->end * scale);
	}
}

/* ---- passes ---- */

/* What this draws hides all behind it, by depth. */
static int is_solid(const struct gls_state *st, const struct story_run *run)
{
	const struct gls_attribs *a = &st->a;

	return is_triangles(run) && a->depth.enabled && (a->depth.func == GL_LESS || a->depth.func == GL_LEQUAL) &&
	       a->depth.write && !a->color.blend && !a->color.alpha_test && !a->stencil.enabled &&
	       !a->color.logic_op_enabled && (a->color.mask & 7) == 7 && !a->polygon.stipple &&
	       a->polygon.mode[0] == GL_FILL && a->polygon.mode[1] == GL_FILL && !st->program &&
	       !a->programs.fragment && !a->programs.vertex && !a->programs.ati;
}

static void say_mask(struct story *s, const char *name, uint32_t mask)
{
	say(s, name, "uuuu", mask & 1, mask >> 1 & 1, mask >> 2 & 1, mask >> 3 & 1);
}

static void run_prepass(struct story *s, const struct story_run *run)
{
	enum { IMPOSSIBLE = 1, SOLID = 2 };
	const struct gls_attribs *a = &s->x->st->a;
	const int solid = is_solid(s->x->st, run);

	if (s->pass == 0) {
		if (a->stencil.enabled || (a->depth.enabled && a->depth.func >= GL_GREATER && a->depth.func != GL_ALWAYS))
			s->step |= IMPOSSIBLE;
		s->step |= solid ? SOLID : 0;
		s->n_passes = s->step == SOLID ? 2 : 1;
	}
	if (s->n_passes == 1 || (s->pass == 2 && !solid)) {
		run_as_it_is(s, run);
	} else if (s->pass == 1 && solid) {
		say_mask(s, "glColorMask", 0);
		run_as_it_is(s, run);
		say_mask(s, "glColorMask", a->color.mask);
		s->n_changes++;
	} else if (s->pass == 2) {
		say(s, "glDepthFunc", "u", GL_LEQUAL);
		run_as_it_is(s, run);
		say(s, "glDepthFunc", "u", a->depth.func);
	}
}

/* Draws stay in the last pass. */
static void call_prepass(struct story *s, const struct call *c, int draws)
{
	if (!draws || s->pass == 0 || s->pass == s->n_passes)
		say_call(s, c);
}

/* Light of a quarter: colours of vertices are cut off at 1, which the sum of several passes is not. */
static void call_dimmed(struct story *s, const struct call *c, int draws)
{
	const int light = begins(c, "glLight") && !begins(c, "glLightM");
	float v[4] = { 0 };

	(void)draws;
	if (s->x->st && !s->target) {
		s->target = 1;
		for (unsigned i = 0; i < 2; i++)
			say(s, "glLightfv", "uuv", GL_LIGHT0, i ? GL_SPECULAR : GL_DIFFUSE, (float[]){ 0.25f, 0.25f, 0.25f, 1 });
		say(s, "glLightModelfv", "uv", GL_LIGHT_MODEL_AMBIENT, (float[]){ 0.05f, 0.05f, 0.05f, 1 });
	}
	if ((light && arg_u(c, 1) >= GL_AMBIENT && arg_u(c, 1) <= GL_SPECULAR) ||
	    (begins(c, "glLightM") && arg_u(c, 0) == GL_LIGHT_MODEL_AMBIENT)) {
		read_numbers(c, 1 + (unsigned)light, v);
		for (unsigned k = 0; k < 3; k++)
			v[k] /= 4;
		if (light)
			say(s, "glLightfv", "uuv", arg_u(c, 0), arg_u(c, 1), v);
		else
			say(s, "glLightModelfv", "uv", GL_LIGHT_MODEL_AMBIENT, v);
	} else {
		say_call(s, c);
	}
}

/* Other draws stay in the first pass. */
static void call_lights(struct story *s, const struct call *c, int draws)
{
	if (draws && s->pass > 1)
		return;
	s->step |= (uint32_t)draws << 31; /* run_lights: something lies over what is lit */
	call_dimmed(s, c, draws);
}

static uint32_t lights_of(const struct gls_state *st)
{
	uint32_t mask = 0;

	for (unsigned i = 0; i < GLS_MAX_LIGHTS; i++)
		mask |= (uint32_t)(st->a.lighting.lights[i].enabled != 0) << i;
	return mask;
}

static int is_lit_solid(const struct gls_state *st, const struct story_run *run)
{
	const struct gls_lighting *l = &st->a.lighting;

	for (unsigned i = 0; i < GLS_MAX_UNITS; i++)
		if (st->a.texturing.units[i].enabled && st->a.texturing.units[i].value.env_mode != GL_MODULATE)
			return 0;
	return is_solid(st, run) && l->enabled && lights_of(st) &&
	       !(l->color_material && l->color_material_mode == GL_EMISSION);
}

static void say_lights(struct story *s, uint32_t mask)
{
	for (unsigned i = 0; i < GLS_MAX_LIGHTS; i++)
		say(s, mask >> i & 1 ? "glEnable" : "glDisable", "u", GL_LIGHT0 + i);
}

/* step: lights that are on, and bit 31 where light cannot be added at the end */
static void run_lights(struct story *s, const struct story_run *run)
{
	static const float black[4] = { 0, 0, 0, 1 };
	const struct gls_state *st = s->x->st;
	const int lit = is_lit_solid(st, run);
	uint32_t light = s->step & 0xff;

	if (s->pass == 0) {
		s->step |= lit ? lights_of(st) : s->step && !is_solid(st, run) ? 1u << 31 : 0;
		s->n_passes = s->step >> 31 ? 1 : 1 + (unsigned)__builtin_popcount(s->step);
	}
	for (unsigned i = 2; i < s->pass; i++)
		light &= light - 1;
	light &= -light;
	if (s->n_passes == 1 || (s->pass == 1 && !lit)) {
		run_as_it_is(s, run);
	} else if (s->pass == 1) {
		say_lights(s, 0);
		run_as_it_is(s, run);
		say_lights(s, lights_of(st));
		s->n_changes++;
	} else if (s->pass > 1 && lit && lights_of(st) & light) {
		say(s, "glPushAttrib", "u", GL_ENABLE_BIT | GL_LIGHTING_BIT | GL_DEPTH_BUFFER_BIT | GL_COLOR_BUFFER_BIT | GL_FOG_BIT);
		say_lights(s, light);
		say(s, "glLightModelfv", "uv", GL_LIGHT_MODEL_AMBIENT, black);
		say(s, "glMaterialfv", "uuv", GL_FRONT_AND_BACK, GL_EMISSION, black);
		say(s, "glFogfv", "uv", GL_FOG_COLOR, black);
		say(s, "glEnable", "u", GL_BLEND);
		say(s, "glBlendFunc", "uu", GL_ONE, GL_ONE);
		say(s, "glDepthMask", "u", 0);
		say(s, "glDepthFunc", "u", GL_EQUAL);
		say_mask(s, "glColorMask", 7);
		run_as_it_is(s, run);
		say(s, "glPopAttrib", "");
	}
}

static void run_doubled(struct story *s, const struct story_run *run)
{
	run_as_it_is(s, run);
	if (is_solid(s->x->st, run)) {
		s->n_changes++;
		run_as_it_is(s, run);
	}
}

/* ---- sides ---- */

static void run_wound(struct story *s, const struct story_run *run)
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

static void run_culled(struct story *s, const struct story_run *run)
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

/* ---- flat sheets, and what else has nothing to do with the world ---- */

static void begin_flat(struct story *s, const float projection[16])
{
	static const uint32_t off[] = { GL_LIGHTING,
		                        GL_FOG,
		                        GL_BLEND,
		                        GL_ALPHA_TEST,
		                        GL_STENCIL_TEST,
		                        GL_SCISSOR_TEST,
		                        GL_CULL_FACE,
		                        GL_DEPTH_TEST,
		                        GL_POLYGON_OFFSET_FILL,
		                        GL_COLOR_LOGIC_OP,
		                        GL_POLYGON_STIPPLE,
		                        GL_COLOR_SUM,
		                        GL_VERTEX_PROGRAM_ARB,
		                        GL_FRAGMENT_PROGRAM_ARB,
		                        GL_FRAGMENT_SHADER_ATI };
	static const uint32_t targets[] = { GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP,
		                            GL_TEXTURE_RECTANGLE };
	const struct gls_state *st = s->x->st;

	say(s, "glPushAttrib", "u", ALL_ATTRIBS);
	if (st->program)
		say(s, "glUseProgram", "u", 0);
	for (unsigned i = 0; i < sizeof(off) / sizeof(off[0]); i++)
		say(s, "glDisable", "u", off[i]);
	for (unsigned i = 0; i < GLS_MAX_CLIP_PLANES; i++)
		say(s, "glDisable", "u", GL_CLIP_PLANE0 + i);
	for (unsigned unit = 0; unit < GLS_MAX_UNITS; unit++)
		for (unsigned i = 0; i < N_GLS_TEXTURE_TARGETS; i++)
			if (st->a.texturing.units[unit].enabled >> i & 1) {
				say(s, "glActiveTexture", "u", GL_TEXTURE0 + unit);
				say(s, "glDisable", "u", targets[i]);
			}
	say(s, "glPolygonMode", "uu", GL_FRONT_AND_BACK, GL_FILL);
	say(s, "glShadeModel", "u", GL_SMOOTH);
	say_mask(s, "glColorMask", 15);
	load(s, mat4_identity, projection);
}

static void end_flat(struct story *s)
{
	load_own_eye(s);
	say(s, "glPopAttrib", "");
	if (s->x->st->program)
		say(s, "glUseProgram", "u", s->x->st->program);
	s->n_changes++;
}

static void say_color(struct story *s, const float color[4])
{
	say(s, "glColor4f", "ffff", color[0], color[1], color[2], color[3]);
}

/* All of the window, at a depth of clip space [-1,1], through this projection. Parts: so many strips, a draw each. */
static void say_sheet(struct story *s, const float projection[16], float depth, unsigned parts)
{
	float inverse[16];

	mat4_invert(inverse, projection);
	for (unsigned i = 0; i < parts; i++) {
		const float y0 = -1 + 2.0f * i / parts, y1 = -1 + 2.0f * (i + 1) / parts;
		const float corners[4][4] = { { -1, y0, depth, 1 }, { 1, y0, depth, 1 }, { 1, y1, depth, 1 }, { -1, y1, depth, 1 } };

		say(s, "glLineWidth", "f", 1.0 + i);
		say(s, "glBegin", "u", GL_QUADS);
		for (unsigned k = 0; k < 4; k++) {
			float eye[4];

			mat4_transform(eye, inverse, corners[k]);
			say(s, "glVertex3f", "fff", eye[0] / eye[3], eye[1] / eye[3], eye[2] / eye[3]);
		}
		say(s, "glEnd", "");
	}
}

/* amount 1: with depth writes, at the depth of the clear */
static void cleared_behind(struct story *s)
{
	const struct gls_attribs *a = &s->x->st->a;

	begin_flat(s, mat4_identity);
	if (s->relation->amount > 0) {
		say(s, "glEnable", "u", GL_DEPTH_TEST);
		say(s, "glDepthFunc", "u", GL_ALWAYS);
	}
	say(s, "glDepthMask", "u", s->relation->amount > 0);
	say_color(s, a->color.clear);
	say_sheet(s, mat4_identity, s->relation->amount > 0 ? 2 * a->depth.clear - 1 : 0, 1);
	end_flat(s);
}

/* amount: a sky of so many draws before a clear of depth; 0: a sheet before the far plane, without depth */
static void first_sky(struct story *s)
{
	const float *projection = top(&s->x->st->projection);
	const unsigned parts = (unsigned)s->relation->amount;

	if (!s->fresh || !s->fresh_color || !s->x->st->a.depth.enabled)
		return;
	begin_flat(s, projection);
	say(s, parts ? "glEnable" : "glDisable", "u", GL_DEPTH_TEST);
	say(s, "glDepthFunc", "u", GL_LESS);
	say(s, "glDepthMask", "u", parts > 0);
	say_color(s, s->x->st->a.color.clear);
	say_sheet(s, projection, parts ? 0 : 0.999f, parts ? parts : 1);
	if (parts)
		say(s, "glClear", "u", GL_DEPTH_BUFFER_BIT);
	end_flat(s);
}

/* Sheets that GL shows nothing of, each for another reason. */
static void first_unseen(struct story *s)
{
	static const uint32_t whys[4] = { GL_CULL_FACE, GL_DEPTH_TEST, GL_ALPHA_TEST, GL_DEPTH_TEST };
	const float *projection = top(&s->x->st->projection);

	if (!s->x->st->a.depth.enabled)
		return;
	for (unsigned why = 0; why < 4; why++) {
		begin_flat(s, projection);
		say(s, "glCullFace", "u", GL_FRONT_AND_BACK);
		say(s, "glDepthFunc", "u", GL_NEVER);
		say(s, "glAlphaFunc", "uf", GL_NEVER, 0.0);
		say_mask(s, "glColorMask", why < 3 ? 15 : 0);
		say(s, why < 3 ? "glEnable" : "glDisable", "u", whys[why]);
		say(s, "glDepthMask", "u", why != 3);
		say_color(s, (float[]){ 1, 1, 1, 1 });
		say_sheet(s, projection, -0.5f + 0.1f * why, 1);
		end_flat(s);
	}
}

/* Of glass without colour over all, twice. */
static void frame_hud(struct story *s)
{
	if (s->x->st->draw_framebuffer)
		return;
	begin_flat(s, mat4_identity);
	say(s, "glEnable", "u", GL_BLEND);
	say(s, "glBlendFunc", "uu", GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	say_color(s, (float[]){ 1, 1, 1, 0 });
	say_sheet(s, mat4_identity, 0, 1);
	say(s, "glEnable", "u", GL_DEPTH_TEST);
	say(s, "glDepthFunc", "u", GL_ALWAYS);
	say_sheet(s, mat4_identity, -0.9f, 1);
	end_flat(s);
}

/* ---- lamps ---- */

static void cleared_lamps(struct story *s)
{
	s->step = 0;
}

/* A body about a light, small beside how far the light is from what it shines on here and from the eye. */
static void say_lamp(struct story *s, const struct scene_light *light, const struct story_run *run)
{
	static const float corners[6][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { -1, 0, 0 }, { 0, -1, 0 }, { 0, 0, -1 } };
	const float *p = light->position_eye, at[3] = { p[0] / p[3], p[1] / p[3], p[2] / p[3] };
	float near2 = at[0] * at[0] + at[1] * at[1] + at[2] * at[2], r;

	for (uint32_t i = 0; i < run->n; i++) {
		float eye[4], d[3];

		mat4_transform(eye, top(&s->x->st->modelview), run->v[i].position);
		for (unsigned k = 0; k < 3; k++)
			d[k] = eye[k] / eye[3] - at[k];
		near2 = fminf(near2, d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
	}
	r = sqrtf(near2) / 20;
	if (!(r > 0))
		return;
	begin_flat(s, top(&s->x->st->projection));
	say(s, "glEnable", "u", GL_DEPTH_TEST);
	say(s, "glDepthFunc", "u", GL_LESS);
	say(s, "glDepthMask", "u", 1);
	say_color(s, light->diffuse);
	say(s, "glBegin", "u", GL_TRIANGLES);
	for (unsigned i = 0; i < 24; i++) {
		const unsigned face = i / 3, axis = i % 3, odd = (face ^ face >> 1 ^ face >> 2) & 1, k = odd ? 2 - axis : axis;
		const float *c = corners[face >> k & 1 ? k + 3 : k];

		say(s, "glVertex3f", "fff", at[0] + r * c[0], at[1] + r * c[1], at[2] + r * c[2]);
	}
	say(s, "glEnd", "");
	end_flat(s);
}

static void run_lamps(struct story *s, const struct story_run *run)
{
	const struct gls_state *st = s->x->st;

	if (st->a.lighting.enabled && __builtin_popcount(lights_of(st)) > 1)
		not_for(s, "a lamp would stand in the way of another light");
	if (st->surface.reflect > 0 || st->surface.transmit > 0)
		not_for(s, "mirrors would show the lamp");
	for (unsigned i = 0; i < GLS_MAX_LIGHTS && st->a.lighting.enabled && is_solid(st, run); i++) {
		const struct gls_light *light = &st->a.lighting.lights[i];

		if (light->enabled && light->value.position_eye[3] != 0 && !(s->step >> i & 1)) {
			say_lamp(s, &light->value, run);
			s->step |= 1u << i;
		}
	}
	run_as_it_is(s, run);
}

/* ---- another window ---- */

static void make_target(struct story *s)
{
	const struct gls_state *st = s->x->st;
	const struct gls_drawable *d = gls_drawable_of(s->x, st->drawable);

	if (st->samples > 1 || !st->double_buffered)
		not_for(s, "the window has several samples, or no back buffer");
	s->target = OURS;
	say(s, "glBindTexture", "uu", GL_TEXTURE_2D, OURS);
	say(s, "glTexParameteri", "uuu", GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	say(s, "glTexParameteri", "uuu", GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	say(s, "glTexImage2D", "uuuuuuuun", GL_TEXTURE_2D, 0, st->alpha_bits ? GL_RGBA8 : GL_RGB8, d->width, d->height,
	    0, GL_RGBA, GL_UNSIGNED_BYTE);
	say(s, "glBindTexture", "uu", GL_TEXTURE_2D, st->a.texturing.units[st->a.texturing.active].bound[GLS_TEXTURE_2D]);
	say(s, "glBindRenderbuffer", "uu", GL_RENDERBUFFER, OURS);
	say(s, "glRenderbufferStorage", "uuuu", GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, d->width, d->height);
	say(s, "glBindRenderbuffer", "uu", GL_RENDERBUFFER, st->renderbuffer);
	say(s, "glBindFramebuffer", "uu", GL_FRAMEBUFFER, OURS);
	say(s, "glFramebufferTexture2D", "uuuuu", GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, OURS, 0);
	say(s, "glFramebufferRenderbuffer", "uuuu", GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, OURS);
	say(s, "glFramebufferRenderbuffer", "uuuu", GL_FRAMEBUFFER, GL_STENCIL_ATTACHMENT, GL_RENDERBUFFER, OURS);
}

static void call_target(struct story *s, const struct call *c, int draws)
{
	const struct gls_state *st = s->x->st;
	const uint32_t kind = c->sig->command >= 0 ? gls_commands[c->sig->command].kind : GLS_KIND_NONE;

	if (s->x->n_contexts > 1 || begins(c, "glAccum") ||
	    (begins(c, "glDrawBuffer") && arg_u(c, 0) == GL_FRONT && !(c->flags & CALL_FAKE)))
		not_for(s, "it has several contexts, or draws to more than the back buffer");
	/* The recorder's own calls draw to the front buffer first. */
	if (st && !s->target && !st->list && !(c->flags & CALL_FAKE) &&
	    (draws || (kind == GLS_KIND_STATE && !begins(c, "glDrawBuffer"))))
		make_target(s);
	if (s->target && begins(c, "glBindFramebuffer") && arg_u(c, 1) == 0)
		say(s, "glBindFramebuffer", "uu", arg_u(c, 0), s->target);
	else if (!s->target || !((begins(c, "glDrawBuffer") && !st->draw_framebuffer) ||
	                         (begins(c, "glReadBuffer") && !st->read_framebuffer)))
		say_call(s, c);
}

/* amount 1: by a textured quad */
static void frame_target(struct story *s)
{
	const struct gls_drawable *d = gls_drawable_of(s->x, s->x->st->drawable);
	const uint32_t bound = s->x->st->draw_framebuffer;

	if (!s->target)
		return;
	say(s, "glBindFramebuffer", "uu", GL_FRAMEBUFFER, 0);
	begin_flat(s, mat4_identity);
	if (s->relation->amount > 0) {
		say(s, "glViewport", "uuuu", 0, 0, d->width, d->height);
		say(s, "glActiveTexture", "u", GL_TEXTURE0);
		say(s, "glBindTexture", "uu", GL_TEXTURE_2D, OURS);
		say(s, "glEnable", "u", GL_TEXTURE_2D);
		say(s, "glTexEnvi", "uuu", GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
		for (unsigned i = 0; i < 4; i++)
			say(s, "glDisable", "u", GL_TEXTURE_GEN_S + i);
		say(s, "glMatrixMode", "u", GL_TEXTURE);
		say(s, "glPushMatrix", "");
		say(s, "glLoadIdentity", "");
		say(s, "glBegin", "u", GL_QUADS);
		for (unsigned i = 0; i < 4; i++) {
			say(s, "glTexCoord2f", "ff", (double)(i == 1 || i == 2), (double)(i > 1));
			say(s, "glVertex2f", "ff", i == 1 || i == 2 ? 1.0 : -1.0, i > 1 ? 1.0 : -1.0);
		}
		say(s, "glEnd", "");
		say(s, "glPopMatrix", "");
	} else {
		say(s, "glBindFramebuffer", "uu", GL_READ_FRAMEBUFFER, s->target);
		say(s, "glBlitFramebuffer", "uuuuuuuuuu", 0, 0, d->width, d->height, 0, 0, d->width, d->height,
		    GL_COLOR_BUFFER_BIT, GL_NEAREST);
	}
	end_flat(s);
	say(s, "glBindFramebuffer", "uu", GL_FRAMEBUFFER, bound ? bound : s->target);
}

static void call_thrice(struct story *s, const struct call *c, int draws)
{
	unsigned width, height;
	char text[80];
	size_t n;
	const char *marker =
	    c->n_args > 1 && c->args[1].type == TRACE_STRING ? c->args[1].str : (const char *)arg_blob(c, 1, &n);

	if (s->x->st && !s->target && (draws || is(c, "glClear")) && !s->x->st->list) {
		s->target = 1;
		for (unsigned unit = 0; unit < GLS_MAX_UNITS; unit++) { /* the same level of detail */
			say(s, "glActiveTexture", "u", GL_TEXTURE0 + unit);
			say(s, "glTexEnvf", "uuf", GL_TEXTURE_FILTER_CONTROL, GL_TEXTURE_LOD_BIAS, log2(3));
		}
		say(s, "glActiveTexture", "u", GL_TEXTURE0 + s->x->st->a.texturing.active);
	}
	if (begins(c, "glBitmap") || begins(c, "glDrawPixels") || begins(c, "glDrawTex") || begins(c, "glCopy") ||
	    begins(c, "glReadPixels") || begins(c, "glBindFramebuffer"))
		not_for(s, "pixels do not grow with the window");
	if ((is(c, "glBegin") || begins(c, "glDrawArrays") || begins(c, "glDrawElements") || begins(c, "glDrawRange")) &&
	    gls_mode_kind(arg_u(c, 0)) != SCENE_TRIANGLES)
		not_for(s, "lines and points are cut otherwise");
	if (is(c, "glViewport") || is(c, "glScissor")) {
		say(s, c->sig->name[2] == 'V' ? "glViewport" : "glScissor", "uuuu", 3 * arg_u(c, 0), 3 * arg_u(c, 1),
		    3 * arg_u(c, 2), 3 * arg_u(c, 3));
	} else if (is(c, "glPolygonOffset")) {
		say(s, "glPolygonOffset", "ff", 3 * arg_d(c, 0), arg_d(c, 1));
	} else if (is(c, "glStringMarkerGREMEDY") && marker && sscanf(marker, "relume:drawable %u %u", &width, &height) == 2) {
		snprintf(text, sizeof(text), "relume:drawable %u %u", 3 * width, 3 * height);
		say(s, "glStringMarkerGREMEDY", "us", (uint32_t)strlen(text), text);
	} else {
		say_call(s, c);
	}
	s->n_changes++;
}

#define RUNS RELATION_RUNS
#define EVERY (RELATION_RUNS | RELATION_ALL | RELATION_ROUNDS)
#define FAR (EVERY | RELATION_COVERS)
#define NO_DRAWS "nothing is drawn that it could change"
#define NO_TRIANGLES "no triangles are drawn"
#define NO_CLEAR "the window is not cleared"
#define NO_DEPTH "nothing is drawn in depth right after a clear"
#define NO_FRAME "no frame ends in the window"

const struct relation relations[] = {
	/* how it is told */
	{ "immediate", "all vertices between Begin and End", NO_DRAWS, RUNS, .base = "-", .run = run_plain },
	{ "lists", "each draw in a display list", NO_DRAWS, RUNS, .run = run_listed },
	{ "arrays", "each draw from arrays", NO_DRAWS, RUNS, .run = run_arrays },
	{ "elements", "each draw by indices", NO_DRAWS, RUNS, 1, .run = run_arrays },
	{ "triangles", "strips, fans, quads as separate triangles", "it draws triangles already", RUNS,
	  .run = run_cut },
	{ "strips", "triangles as one strip, joined by empty ones", NO_TRIANGLES, RUNS, .run = run_strip },
	{ "split", "each triangle a draw of its own", "no draw has two triangles", RUNS, .run = run_split },
	{ "joined", "draws that stand together as one", "no two draws do", RUNS, .run = run_join, .call = call_join },
	{ "loaded", "matrices loaded before each draw", NO_DRAWS, RUNS, .run = run_loaded },
	{ "undone", "state changed and put back, set again, pushed and popped", NO_DRAWS, 0, .call = call_undone },
	{ "asked", "queries, and calls that are errors", NO_DRAWS, 0, .call = call_asked },
	{ "wound", "triangles the other way round, and the front face", NO_TRIANGLES, RUNS | RELATION_ROUNDS,
	  .run = run_wound },
	{ "culled", "the front face and the side that is culled turned", NO_DRAWS, RUNS, .run = run_culled },
	{ "doubled", "solid draws twice", "nothing solid is drawn", RUNS, .run = run_doubled },
	/* another world: bases have vertices rounded as they are there */
	{ "near-base", "", NO_DRAWS, EVERY, -1, .run = run_moved, .base = "" },
	{ "near", "the world moved as far as its things are from the eye", NO_DRAWS, EVERY, 1, "near-base",
	  .run = run_moved },
	{ "far-base", "", NO_DRAWS, EVERY, -256, .run = run_moved, .base = "" },
	{ "far", "moved 256 times as far", NO_DRAWS, FAR, 256, "far-base", .run = run_moved },
	{ "farther-base", "", NO_DRAWS, EVERY, -4096, .run = run_moved, .base = "" },
	{ "farther", "moved 4,096 times as far", NO_DRAWS, FAR | RELATION_COARSE, 4096, "farther-base",
	  .run = run_moved },
	{ "small", "the world scaled by 2^-10", NO_DRAWS, EVERY, 0x1p-10, .run = run_eye, .call = call_eye },
	{ "large", "the world scaled by 2^17", NO_DRAWS, EVERY, 0x1p17, .run = run_eye, .call = call_eye },
	{ "mirrored", "eye space mirrored, back by the projection", NO_DRAWS, EVERY, 0, .run = run_eye,
	  .call = call_eye },
	{ "turned", "eye space turned, back by the projection", NO_DRAWS, EVERY, -1, .run = run_eye, .call = call_eye },
	/* passes */
	{ "prepass", "depth first, colour after it", "nothing solid is drawn, or by stencil", RUNS | RELATION_PASSES,
	  .run = run_prepass, .call = call_prepass },
	{ "lights-base", "light of a quarter", NO_DRAWS, RUNS, .base = "", .run = run_plain, .call = call_dimmed },
	{ "lights", "light by light, added", "nothing solid is lit, or something lies over it",
	  RUNS | RELATION_PASSES | RELATION_SATURATES, .base = "lights-base", .run = run_lights, .call = call_lights },
	/* beside the world */
	{ "behind", "a sheet behind all, without depth", NO_CLEAR, 0, 0, .cleared = cleared_behind },
	{ "behind-depth", "a sheet behind all that writes depth", NO_CLEAR, 0, 1, .cleared = cleared_behind },
	{ "behind-far", "a sheet before the far plane, without depth", NO_DEPTH, RUNS, 0, .first = first_sky },
	{ "sky", "a sky of one draw, and a clear of depth", NO_DEPTH, RUNS, 1, .first = first_sky },
	{ "skies", "a sky of 24 draws, and a clear of depth", NO_DEPTH, RUNS, 24, .first = first_sky },
	{ "unseen", "sheets that GL does not show", NO_DEPTH, RUNS, .first = first_unseen },
	{ "hud", "a HUD of clear glass", NO_FRAME, 0, .frame = frame_hud },
	{ "lamps", "a body about the light", "no light has a place", RUNS | RELATION_COVERS, .run = run_lamps,
	  .cleared = cleared_lamps },
	/* another window */
	{ "blit", "a framebuffer object, blitted", NO_FRAME, 0, 0, .call = call_target, .frame = frame_target },
	{ "quad", "a framebuffer object, as a textured quad", NO_FRAME, 0, 1, .call = call_target,
	  .frame = frame_target },
	{ "thrice", "the window three times as large", NO_DRAWS, RELATION_ROUNDS | RELATION_TRIPLES,
	  .call = call_thrice },
};
const unsigned n_relations = sizeof(relations) / sizeof(relations[0]);

/* ---- the program ---- */

static const struct relation measured = { "", "", "measured", RUNS, .run = run_measured };

static int usage(void)
{
	fputs("usage: relations | relations RELATION FROM.trace TO.trace\n"
	      "Without arguments: a line for each relation, NAME BASE FLAGS WHAT.\n"
	      "Exits with 77 and a reason where it does not apply.\n", stderr);
	return 2;
}

int main(int argc, char **argv)
{
	struct story s = { 0 }, first = { .relation = &measured };
	int rc;

	for (unsigned i = 0; i < n_relations && argc == 1; i++) {
		const struct relation *r = &relations[i];
		const char *base = r->base ? r->base : r->flags & RUNS ? "immediate" : "-";

		printf("%s\t%s\t%u\t%s\n", r->name, base, r->flags, r->what);
	}
	if (argc == 1)
		return 0;
	for (unsigned i = 0; i < n_relations && argc == 4; i++)
		if (strcmp(relations[i].name, argv[1]) == 0)
			s.relation = &relations[i];
	if (!s.relation)
		return usage();
	if (s.relation->run == run_moved) { /* nothing is written: it never applies */
		rc = story_tell(&first, argv[2], argv[3]);
		s.distance = first.distance;
	}
	rc = story_tell(&s, argv[2], argv[3]);
	if (rc == 1)
		puts(s.why_not);
	else if (rc == 0)
		printf("%llu\n", (unsigned long long)s.n_changes);
	return rc == 1 ? 77 : -rc;
}
