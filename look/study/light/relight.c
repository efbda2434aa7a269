#include "look/study/light/relight.h"

#include <math.h>

static const char *const trick_names[] = { "planar shadow", "stencil mirror", "shadow volume (z-pass)",
	                                   "shadow volume (z-fail)" };

/* More draws that agree give more confidence. */
static double confidence_of(unsigned votes)
{
	return 1 - 0.5 / (1 + votes);
}

/* The share of the light in lightmaps that the lights explain. */
static double explained_share(const struct solved *s)
{
	return s->signal > 0 ? 1 - s->residual * s->residual / (s->signal * s->signal) : 0;
}

int relight_is_known(const struct solved *s)
{
	return s->n && explained_share(s) > 0.9;
}

/* 1 if traced light casts the same shadow, from a light of OpenGL's or one that replaces lightmaps. */
static int is_replaced(const struct trick_found *f, const struct solved *s)
{
	for (unsigned i = 0; i < s->n && relight_is_known(s) && f->light[3] != 0; i++) {
		double off = 0, far = 0;

		for (int k = 0; k < 3; k++) {
			off += (s->lights[i].at[k] - f->light[k]) * (s->lights[i].at[k] - f->light[k]);
			far += f->light[k] * f->light[k];
		}
		if (sqrt(off) < 0.02 * (1 + sqrt(far)))
			return 1;
	}
	return f->has_opengl_light;
}

/* 1 if two findings give the same rule; positions of lights and planes are not part of it. */
static int has_rule_of(const struct trick_found *a, const struct trick_found *b, const struct solved *s)
{
	return a->kind == b->kind && a->stencil == b->stencil && is_replaced(a, s) == is_replaced(b, s);
}

/* One rule for a finding and all later ones that give the same rule. */
static void find_shadow(const struct tricks *t, unsigned first, const struct solved *s, struct findings *out)
{
	const struct trick_found *f = &t->found[first];
	const int is_volume = f->kind != TRICK_PLANAR_SHADOW;
	struct finding *rule = findings_add(out, FINDINGS_SURFACES, "%s", trick_names[f->kind]);
	unsigned votes = 0, frames = 0, n = 0;
	char lights[64] = "one light";

	for (unsigned i = first; i < t->n; i++)
		if (has_rule_of(&t->found[i], f, s) && !tricks_is_outvoted(t, i)) {
			votes += t->found[i].votes;
			frames = t->found[i].frames > frames ? t->found[i].frames : frames;
			n++;
		}
	if (n != 1)
		snprintf(lights, sizeof(lights), is_volume ? "%u lights" : "one light each, %u planes and lights in all", n);
	finding_explain(rule, confidence_of(votes), "%u draws in %u frames %s %s; %s", votes, frames,
	                is_volume ? "have edges that meet in" : "are flattened away from", lights,
	                is_replaced(f, s) ? "traced shadows replace them, as the surfaces below are lit from there" :
	                                    "no light is known there, and so they stay");
	if (!is_volume && n == 1)
		FINDING_SET(rule, FINDING_PLANE("plane", f->plane));
	if (is_volume || f->stencil)
		FINDING_MATCH(rule, FINDING_IS("stencil_tested", 1), FINDING_IS("blended", 1), FINDING_IS("depth_tested", 0));
	else
		FINDING_MATCH(rule, FINDING_NAMED("modelview", "singular"), FINDING_IS("lit", 0));
	if (is_replaced(f, s))
		FINDING_SET(rule, FINDING_IS("left_out", 1), FINDING_IS("shadows", 0), FINDING_IS("mirrors", 0));
}

static void find_mirror(const struct trick_found *f, struct findings *out)
{
	struct finding *rule = findings_add(out, FINDINGS_SURFACES, "stencil mirror");

	finding_explain(rule, confidence_of(f->votes), "%u draws in %u frames are reflections of others in one plane; %s",
	                f->votes, f->frames,
	                f->shows > 0 ? "a blended surface lies in it" : "no blended surface lies in it, and so they stay");
	FINDING_SET(rule, FINDING_PLANE("plane", f->plane));
	FINDING_MATCH(rule, FINDING_NAMED("modelview", "mirrored"), FINDING_IS("stencil_tested", f->stencil));
	if (!(f->shows > 0))
		return;
	FINDING_SET(rule, FINDING_IS("left_out", 1), FINDING_IS("shadows", 0), FINDING_IS("mirrors", 0));
	rule = findings_add(out, FINDINGS_SURFACES, "mirror");
	finding_explain(rule, confidence_of(f->votes), "it is blended over its picture and lets %.0f %% of it show",
	                100 * f->shows);
	FINDING_SET(rule, FINDING_PLANE("plane", f->plane));
	FINDING_MATCH(rule, FINDING_PLANE("in_plane", f->plane), FINDING_IS("blended", 1),
	              FINDING_IS("stencil_tested", f->surface_stencil));
	FINDING_SET(rule, FINDING_IS("solid", 1), FINDING_NUMBER("reflect", 4, f->shows));
}

static void find_light(const struct trick_found *f, struct findings *out)
{
	struct finding *rule = findings_add(out, FINDINGS_LIGHTS, "light of a %s", trick_names[f->kind]);

	finding_explain(rule, confidence_of(f->votes), "%s",
	                f->has_opengl_light ? "OpenGL has it too" : "how strong it is, nothing says");
	FINDING_SET(rule, FINDING_IS("off", 1), FINDING_NAMED("space", "world"),
	            FINDING_PLACE("position", 7, f->light, f->light[3]));
}

/* A rule for walls; its confidence is the share of their light that the lights explain. */
static struct finding *add_walls(struct findings *out, const char *role, const char *walls, unsigned n,
                                 const struct solved *s)
{
	struct finding *rule = findings_add(out, FINDINGS_SURFACES, "%s", role);

	finding_explain(rule, fmax(0, explained_share(s)), "%u %s; %u lights explain %.1f %% of it%s", n, walls, s->n,
	                100 * explained_share(s), relight_is_known(s) ? "" : "; they are too few, and lightmaps stay");
	return rule;
}

static void find_walls(const struct lightmaps *maps, const struct solved *s, struct findings *out)
{
	const int is_known = relight_is_known(s);
	struct finding *rule;

	if (maps->n_units) {
		rule = add_walls(out, "lightmap in a second unit", "walls", maps->n_units, s);
		FINDING_MATCH(rule, FINDING_COUNTED("units", 2), FINDING_IS("lit", 0), FINDING_IS("blended", 0),
		              FINDING_IS("depth_tested", 1), FINDING_IS("stencil_tested", 0),
		              FINDING_IS("environment_mapped", 0));
		if (is_known)
			FINDING_SET(rule, FINDING_IS("lit", 1), FINDING_COUNTED("lightmap", maps->unit));
	}
	if (maps->n_passes) {
		rule = add_walls(out, "lightmap pass", "walls", maps->n_passes, s);
		FINDING_MATCH(rule, FINDING_IS("multiplies", 1), FINDING_COUNTED("units", 1), FINDING_IS("lit", 0),
		              FINDING_IS("stencil_tested", 0));
		if (is_known)
			FINDING_SET(rule, FINDING_IS("left_out", 1));
	}
	if (maps->n_colors && is_known) {
		rule = add_walls(out, "light in vertex colours", "meshes", maps->n_colors, s);
		FINDING_MATCH(rule, FINDING_IS("lit", 0), FINDING_IS("blended", 0), FINDING_IS("depth_tested", 1),
		              FINDING_IS("stencil_tested", 0), FINDING_IS("environment_mapped", 0),
		              FINDING_IS("parallel", 0));
		FINDING_SET(rule, FINDING_IS("lit", 1), FINDING_IS("vertex_light", 1));
	}
	if (maps->n_passes && is_known) {
		rule = findings_add(out, FINDINGS_SURFACES, "wall below a lightmap pass");
		finding_explain(rule, explained_share(s), "its light comes by the pass");
		FINDING_MATCH(rule, FINDING_COUNTED("units", 1), FINDING_IS("lit", 0), FINDING_IS("blended", 0),
		              FINDING_IS("depth_tested", 1), FINDING_IS("stencil_tested", 0),
		              FINDING_IS("environment_mapped", 0));
		FINDING_SET(rule, FINDING_IS("lit", 1));
	}
}

static void find_solved(const struct solved *s, const char *of, struct findings *out)
{
	struct finding *rule = findings_add(out, FINDINGS_LIGHTS, "ambient light of %s", of);
	static const double above[3] = { 0, 1, 0 };

	finding_explain(rule, explained_share(s), "light that no lamp explains is this bright everywhere");
	FINDING_SET(rule, FINDING_NAMED("on", "unlit"), FINDING_NAMED("space", "world"),
	            FINDING_PLACE("position", 7, above, 0),
	            FINDING_VECTOR("ambient", 5, s->ambient[0], s->ambient[1], s->ambient[2]),
	            FINDING_VECTOR("diffuse", 1, 0, 0, 0), FINDING_VECTOR("specular", 1, 0, 0, 0));
	for (unsigned i = 0; i < s->n; i++) {
		const struct solved_light *l = &s->lights[i];

		rule = findings_add(out, FINDINGS_LIGHTS, "light of %s", of);
		finding_explain(rule, l->share, "without it %.0f %% of what is explained is not; %zu texels, rest %.2g",
		                100 * l->share, s->texels, s->residual);
		FINDING_SET(rule, FINDING_NAMED("on", "unlit"), FINDING_NAMED("space", "world"),
		            FINDING_PLACE("position", 6, l->at, 1),
		            FINDING_VECTOR("diffuse", 5, l->color[0], l->color[1], l->color[2]),
		            FINDING_VECTOR("specular", 1, 0, 0, 0), FINDING_VECTOR("attenuation", 1, 0, 0, 1));
	}
}

void relight_find_surfaces(const struct tricks *t, const struct lightmaps *maps, const struct solved *s,
                           struct findings *out)
{
	for (unsigned i = 0; i < t->n; i++) {
		unsigned first = 0;

		while (first < i && !(has_rule_of(&t->found[first], &t->found[i], s) && !tricks_is_outvoted(t, first)))
			first++;
		if (t->found[i].kind == TRICK_MIRROR)
			find_mirror(&t->found[i], out);
		else if (first == i && !tricks_is_outvoted(t, i))
			find_shadow(t, i, s, out);
	}
	find_walls(maps, s, out);
}

void relight_find_lights(const struct tricks *t, const struct lightmaps *maps, const struct solved *s,
                         struct findings *out)
{
	for (unsigned i = 0; i < t->n; i++)
		if (t->found[i].kind != TRICK_MIRROR && !tricks_is_outvoted(t, i))
			find_light(&t->found[i], out);
	if (relight_is_known(s))
		find_solved(s, maps->n_colors ? "vertex colours" : "lightmaps", out);
}
