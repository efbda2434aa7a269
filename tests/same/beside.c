/* Additional drawing beside the world that must not change the picture. */
#include "tests/same/relations.h"

#include <math.h>

#include "gl_tokens.h"
#include "tests/same/story.h"

/* ---- flat sheets, and other drawing unrelated to the world ---- */

void begin_flat(struct story *s, const float projection[16])
{
	static const uint32_t off[] = {
		GL_LIGHTING, GL_FOG, GL_BLEND, GL_ALPHA_TEST, GL_STENCIL_TEST, GL_SCISSOR_TEST, GL_CULL_FACE, GL_DEPTH_TEST,
		GL_POLYGON_OFFSET_FILL, GL_COLOR_LOGIC_OP, GL_POLYGON_STIPPLE, GL_COLOR_SUM, GL_VERTEX_PROGRAM_ARB,
		GL_FRAGMENT_PROGRAM_ARB, GL_FRAGMENT_SHADER_ATI,
	};
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
	say_matrices(s, mat4_identity, projection);
}

void end_flat(struct story *s)
{
	say_own_matrices(s);
	say(s, "glPopAttrib", "");
	if (s->x->st->program)
		say(s, "glUseProgram", "u", s->x->st->program);
	s->n_changes++;
}

static void say_color(struct story *s, const float color[4])
{
	say(s, "glColor4f", "ffff", color[0], color[1], color[2], color[3]);
}

/* Cover the window at a depth in clip space [-1,1], through this projection. parts: number of strips, a draw each. */
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

/* amount 1: with depth writes, at the clear depth */
void cleared_behind(struct story *s)
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

/* amount: number of draws of a sky before a depth clear; 0: a sheet before the far plane, without depth */
void first_sky(struct story *s)
{
	const float *projection = stack_top(&s->x->st->projection);
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

/* Sheets that GL does not show, each for another reason. */
void first_unseen(struct story *s)
{
	static const uint32_t whys[4] = { GL_CULL_FACE, GL_DEPTH_TEST, GL_ALPHA_TEST, GL_DEPTH_TEST };
	const float *projection = stack_top(&s->x->st->projection);

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

/* Colourless glass over everything, twice. */
void frame_hud(struct story *s)
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

void cleared_lamps(struct story *s)
{
	s->step = 0;
}

/* A body around a light, small relative to the light's distance from its surfaces and from the eye. */
static void say_lamp(struct story *s, const struct scene_light *light, const struct story_run *run)
{
	static const float corners[6][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { -1, 0, 0 }, { 0, -1, 0 }, { 0, 0, -1 } };
	const float *p = light->position_eye, at[3] = { p[0] / p[3], p[1] / p[3], p[2] / p[3] };
	float near2 = at[0] * at[0] + at[1] * at[1] + at[2] * at[2], r;

	for (uint32_t i = 0; i < run->n; i++) {
		float eye[4], d[3];

		mat4_transform(eye, stack_top(&s->x->st->modelview), run->v[i].position);
		for (unsigned k = 0; k < 3; k++)
			d[k] = eye[k] / eye[3] - at[k];
		near2 = fminf(near2, d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
	}
	r = sqrtf(near2) / 20;
	if (!(r > 0))
		return;
	begin_flat(s, stack_top(&s->x->st->projection));
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

void run_lamps(struct story *s, const struct story_run *run)
{
	const struct gls_state *st = s->x->st;

	if (st->a.lighting.enabled && __builtin_popcount(lights_on(st)) > 1)
		not_for(s, "a lamp would block another light");
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
