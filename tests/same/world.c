/* The same world moved or scaled, and in another eye space. */
#include "tests/same/relations.h"

#include <math.h>
#include <stdlib.h>

#include "gl_tokens.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "tests/same/story.h"

/* ---- the world moved ---- */

void read_numbers(const struct call *c, unsigned i, float v[4])
{
	const int fixed = gls_commands[c->sig->command].fixed != 0;

	arg_floats(c, i, v, 4);
	for (unsigned k = 0; k < 4; k++)
		v[k] /= fixed ? 65536 : 1;
}

void run_measured(struct story *s, const struct story_run *run)
{
	float eye[4];

	for (uint32_t i = 0; i < run->n && s->x->st->a.depth.enabled; i++) {
		mat4_transform(eye, stack_top(&s->x->st->modelview), run->v[i].position);
		s->n_measured++;
		s->distance += (logf(fmaxf(fabsf(eye[2] / eye[3]), 1e-6f)) - s->distance) / s->n_measured;
	}
}

/*
 * amount: distance, relative to that from the eye to objects; negative: vertices are only rounded as in the moved world
 */
void run_moved(struct story *s, const struct story_run *run)
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
				not_for(s, "texture coordinates are generated from object positions");
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

/* ---- another eye space: K is applied on the way into it, its inverse on the way out ---- */

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
	mat4_mul(modelview, k, stack_top(&st->modelview));
	mat4_mul(projection, stack_top(&st->projection), inverse);
	say_matrices(s, modelview, projection);
}

/* Whether the state means the same in the other eye space. */
static void check_eye(struct story *s)
{
	const struct gls_attribs *a = &s->x->st->a;
	const double amount = s->relation->amount;

	if (amount > 0 && (a->point.attenuation[1] != 0 || a->point.attenuation[2] != 0))
		not_for(s, "points shrink with distance");
	if (amount < 0 && a->fog.enabled)
		not_for(s, "fog depends on a direction in eye space");
	for (unsigned i = 0; amount < 0 && a->lighting.enabled && !a->lighting.local_viewer && i < GLS_MAX_LIGHTS; i++)
		for (unsigned k = 0; k < 3 && a->lighting.lights[i].enabled; k++)
			if (a->lighting.lights[i].value.specular[k] *
			        (a->lighting.face[0].specular[k] + a->lighting.face[1].specular[k]) >
			    0)
				not_for(s, "highlights depend on a direction in eye space");
	for (unsigned u = 0; amount <= 0 && u < GLS_MAX_UNITS; u++)
		for (unsigned k = 0; k < 4; k++) {
			const struct gls_unit *unit = &a->texturing.units[u];

			if (unit->enabled && unit->gen_enabled >> k & 1 && unit->value.gen_mode[k] != GL_EYE_LINEAR &&
			    unit->value.gen_mode[k] != GL_OBJECT_LINEAR)
				not_for(s, "reflection textures depend on directions in eye space");
		}
}

void run_eye(struct story *s, const struct story_run *run)
{
	const struct gls_attribs *a = &s->x->st->a;
	const float scale = s->relation->amount > 0 && !a->transform.normalize && !a->transform.rescale_normal
	                        ? (float)s->relation->amount
	                        : 1;
	struct story_vertex *v = need(malloc((run->n + 1) * sizeof(*v)));
	float k[16], inverse[16];

	check_eye(s);
	eye_matrices(s, k, inverse);
	for (unsigned i = 0; i < GLS_MAX_LIGHTS && !s->n_changes; i++) { /* the program may not have placed them */
		if (memcmp(a->lighting.lights[i].value.position_eye, (float[]){ 0, 0, 1, 0 }, 16) != 0)
			continue;
		say_matrices(s, k, stack_top(&s->x->st->projection));
		say(s, "glLightfv", "uuv", GL_LIGHT0 + i, GL_POSITION, (float[]){ 0, 0, 1, 0 });
	}
	memcpy(v, run->v, run->n * sizeof(*v));
	for (uint32_t i = 0; i < run->n; i++)
		for (unsigned c = 0; c < 3; c++)
			v[i].attribute[GLS_ATTR_NORMAL][c] *= scale;
	load_other_eye(s);
	say_plain(s, run, v);
	say_own_matrices(s);
	s->n_changes++;
	free(v);
}

void call_eye(struct story *s, const struct call *c, int draws)
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
		say_own_matrices(s);
	} else {
		say_call(s, c);
	}
	if (is(c, "glEnable") && arg_u(c, 0) == GL_FOG && scale != 1) { /* initial values count as well */
		say(s, "glFogf", "uf", GL_FOG_DENSITY, fog->density / scale);
		say(s, "glFogf", "uf", GL_FOG_START, fog->start * scale);
		say(s, "glFogf", "uf", GL_FOG_END, fog->end * scale);
	}
}
