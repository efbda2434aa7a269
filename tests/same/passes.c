/* The same picture in several passes. */
#include "tests/same/relations.h"

#include "gl_tokens.h"
#include "replay/machine/args.h"
#include "tests/same/story.h"

static int is_triangles(const struct story_run *run)
{
	return gls_mode_kind(run->mode) == SCENE_TRIANGLES;
}

int is_solid(const struct gls_state *st, const struct story_run *run)
{
	const struct gls_attribs *a = &st->a;

	return is_triangles(run) && a->depth.enabled && (a->depth.func == GL_LESS || a->depth.func == GL_LEQUAL) &&
	       a->depth.write && !a->color.blend && !a->color.alpha_test && !a->stencil.enabled &&
	       !a->color.logic_op_enabled && (a->color.mask & 7) == 7 && !a->polygon.stipple &&
	       a->polygon.mode[0] == GL_FILL && a->polygon.mode[1] == GL_FILL && !st->program &&
	       !a->programs.fragment && !a->programs.vertex && !a->programs.ati;
}

void say_mask(struct story *s, const char *name, uint32_t mask)
{
	say(s, name, "uuuu", mask & 1, mask >> 1 & 1, mask >> 2 & 1, mask >> 3 & 1);
}

void run_prepass(struct story *s, const struct story_run *run)
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

/* Draws remain in the last pass. */
void call_prepass(struct story *s, const struct call *c, int draws)
{
	if (!draws || s->pass == 0 || s->pass == s->n_passes)
		say_call(s, c);
}

/* A quarter of the light: vertex colours are clamped at 1, the sum of several passes is not. */
void call_dimmed(struct story *s, const struct call *c, int draws)
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

/* Other draws remain in the first pass. */
void call_lights(struct story *s, const struct call *c, int draws)
{
	if (draws && s->pass > 1)
		return;
	s->step |= (uint32_t)draws << 31; /* run_lights: a draw covers lit surfaces */
	call_dimmed(s, c, draws);
}

uint32_t lights_on(const struct gls_state *st)
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
	return is_solid(st, run) && l->enabled && lights_on(st) &&
	       !(l->color_material && l->color_material_mode == GL_EMISSION);
}

static void say_lights(struct story *s, uint32_t mask)
{
	for (unsigned i = 0; i < GLS_MAX_LIGHTS; i++)
		say(s, mask >> i & 1 ? "glEnable" : "glDisable", "u", GL_LIGHT0 + i);
}

/* step: enabled lights, and bit 31 if light cannot be added at the end */
void run_lights(struct story *s, const struct story_run *run)
{
	static const float black[4] = { 0, 0, 0, 1 };
	const struct gls_state *st = s->x->st;
	const int lit = is_lit_solid(st, run);
	uint32_t light = s->step & 0xff;

	if (s->pass == 0) {
		s->step |= lit ? lights_on(st) : s->step && !is_solid(st, run) ? 1u << 31 : 0;
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
		say_lights(s, lights_on(st));
		s->n_changes++;
	} else if (s->pass > 1 && lit && lights_on(st) & light) {
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

void run_doubled(struct story *s, const struct story_run *run)
{
	run_as_it_is(s, run);
	if (is_solid(s->x->st, run)) {
		s->n_changes++;
		run_as_it_is(s, run);
	}
}
