#include "look/study/findings.h"

#include <inttypes.h>
#include <math.h>

static const char *const trick_names[] = { "planar shadow", "stencil mirror", "shadow volume (z-pass)",
	                                   "shadow volume (z-fail)" };

/* More draws that agree are more certain. */
static double confidence_of(unsigned votes)
{
	return 1 - 0.5 / (1 + votes);
}

static void write_plane(const struct trick_found *f, FILE *out)
{
	fprintf(out, "    plane: [%.7g, %.7g, %.7g, %.7g]\n", f->plane[0], f->plane[1], f->plane[2], f->plane[3]);
}

/* How much of the lightmaps the lights explain. */
static double explained_share(const struct solved *s)
{
	return s->signal > 0 ? 1 - s->residual * s->residual / (s->signal * s->signal) : 0;
}

int findings_relights(const struct solved *s)
{
	return s->n && explained_share(s) > 0.9;
}

/* 1 where traced light makes the same shadow: of a light of OpenGL's, or of one that lights walls anew. */
static int is_replaced(const struct trick_found *f, const struct solved *s)
{
	for (unsigned i = 0; i < s->n && findings_relights(s) && f->light[3] != 0; i++) {
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

/* 1 where the rule of one finding is that of another: places of lights and planes are no part of it. */
static int has_rule_of(const struct trick_found *a, const struct trick_found *b, const struct solved *s)
{
	return a->kind == b->kind && a->stencil == b->stencil && is_replaced(a, s) == is_replaced(b, s);
}

/* The rule of a finding and of all later ones whose rule is the same. */
static void write_shadow(const struct tricks *t, unsigned first, const struct solved *s, FILE *out)
{
	const struct trick_found *f = &t->found[first];
	const int is_volume = f->kind != TRICK_PLANAR_SHADOW;
	unsigned votes = 0, frames = 0, n = 0;

	for (unsigned i = first; i < t->n; i++)
		if (has_rule_of(&t->found[i], f, s) && !tricks_is_outvoted(t, i)) {
			votes += t->found[i].votes;
			frames = t->found[i].frames > frames ? t->found[i].frames : frames;
			n++;
		}
	fprintf(out, "  - role: %s\n    confidence: %.2f\n", trick_names[f->kind], confidence_of(votes));
	fprintf(out, "    why: \"%u draws in %u frames %s ", votes, frames,
	        is_volume ? "have edges that meet in" : "are flattened away from");
	if (n == 1)
		fprintf(out, "one light; ");
	else
		fprintf(out, is_volume ? "%u lights; " : "one light each, %u planes and lights in all; ", n);
	fprintf(out, "%s\"\n", is_replaced(f, s) ? "what they darken is lit from there, and traced shadows replace them" :
	        "no light is known there, and so they stay");
	if (!is_volume && n == 1)
		write_plane(f, out);
	fprintf(out, "    match: %s\n",
	        is_volume || f->stencil ? "{ stencil_tested: yes, blended: yes, depth_tested: no }" :
	                                  "{ modelview: singular, lit: no }");
	if (is_replaced(f, s))
		fprintf(out, "    left_out: yes\n    shadows: no\n    mirrors: no\n");
}

static void write_mirror(const struct trick_found *f, FILE *out)
{
	fprintf(out, "  - role: stencil mirror\n    confidence: %.2f\n", confidence_of(f->votes));
	fprintf(out, "    why: \"%u draws in %u frames are reflections of others in one plane; %s\"\n", f->votes, f->frames,
	        f->shows > 0 ? "a blended surface lies in it" : "no blended surface lies in it, and so they stay");
	write_plane(f, out);
	fprintf(out, "    match: { modelview: mirrored, stencil_tested: %s }\n", f->stencil ? "yes" : "no");
	if (!(f->shows > 0))
		return;
	fprintf(out, "    left_out: yes\n    shadows: no\n    mirrors: no\n");
	fprintf(out,
	        "  - role: mirror\n    confidence: %.2f\n    why: \"it is blended over its picture, of which %.0f %% "
	        "show\"\n",
	        confidence_of(f->votes), 100 * f->shows);
	write_plane(f, out);
	fprintf(out, "    match: { in_plane: [%.7g, %.7g, %.7g, %.7g], blended: yes, stencil_tested: %s }\n",
	        f->plane[0], f->plane[1], f->plane[2], f->plane[3], f->surface_stencil ? "yes" : "no");
	fprintf(out, "    solid: yes\n    reflect: %.4g\n", f->shows);
}

static void write_light(const struct trick_found *f, FILE *out)
{
	fprintf(out, "  - role: light of a %s\n    confidence: %.2f\n", trick_names[f->kind], confidence_of(f->votes));
	fprintf(out, "    why: \"%s\"\n", f->has_opengl_light ? "OpenGL has it too" : "how strong it is, nothing says");
	fprintf(out, "    off: yes\n    space: world\n    position: [%.7g, %.7g, %.7g, %g]\n", f->light[0], f->light[1],
	        f->light[2], f->light[3]);
}

static void write_walls(const struct lightmaps *maps, const struct solved *s, FILE *out)
{
	static const char *const stays = "; they are too few, and lightmaps stay";
	double share = explained_share(s);

	if (maps->n_units)
		fprintf(out,
		        "  - role: lightmap in a second unit\n    confidence: %.2f\n    why: \"%u walls; %u lights "
		        "explain %.1f %% of it%s\"\n"
		        "    match: { units: 2, lit: no, blended: no, depth_tested: yes, stencil_tested: no, "
		        "environment_mapped: no }\n%s",
		        fmax(0, share), maps->n_units, s->n, 100 * share, findings_relights(s) ? "" : stays,
		        findings_relights(s) ? "    lit: yes\n" : "");
	if (maps->n_units && findings_relights(s))
		fprintf(out, "    lightmap: %u\n", maps->unit);
	if (maps->n_passes)
		fprintf(out,
		        "  - role: lightmap pass\n    confidence: %.2f\n    why: \"%u walls; %u lights explain %.1f %% "
		        "of it%s\"\n"
		        "    match: { multiplies: yes, units: 1, lit: no, stencil_tested: no }\n%s",
		        fmax(0, share), maps->n_passes, s->n, 100 * share, findings_relights(s) ? "" : stays,
		        findings_relights(s) ? "    left_out: yes\n" : "");
	if (maps->n_colors && findings_relights(s))
		fprintf(out,
		        "  - role: light in vertex colours\n    confidence: %.2f\n    why: \"%u meshes; %u lights "
		        "explain %.1f %% of it\"\n"
		        "    match: { lit: no, blended: no, depth_tested: yes, stencil_tested: no, environment_mapped: "
		        "no, parallel: no }\n"
		        "    lit: yes\n    vertex_light: yes\n",
		        share, maps->n_colors, s->n, 100 * share);
	if (maps->n_passes && findings_relights(s))
		fprintf(out,
		        "  - role: wall below a lightmap pass\n    confidence: %.2f\n    why: \"its light comes by the "
		        "pass\"\n"
		        "    match: { units: 1, lit: no, blended: no, depth_tested: yes, stencil_tested: no, "
		        "environment_mapped: no }\n    lit: yes\n",
		        share);
}

static void write_solved(const struct solved *s, const char *of, FILE *out)
{
	fprintf(out,
	        "  - role: ambient light of %s\n    confidence: %.2f\n"
	        "    why: \"what no light explains is as bright as this everywhere\"\n    on: unlit\n    space: "
	        "world\n    position: [0, 1, 0, 0]\n    ambient: [%.5g, %.5g, %.5g]\n    diffuse: [0, 0, 0]\n    "
	        "specular: [0, 0, 0]\n",
	        of, explained_share(s), s->ambient[0], s->ambient[1], s->ambient[2]);
	for (unsigned i = 0; i < s->n; i++)
		fprintf(out,
		        "  - role: light of %s\n    confidence: %.2f\n"
		        "    why: \"without it %.0f %% of what is explained is not; %zu texels, rest %.2g\"\n"
		        "    on: unlit\n    space: world\n    position: [%.6g, %.6g, %.6g, 1]\n    diffuse: [%.5g, "
		        "%.5g, %.5g]\n    specular: [0, 0, 0]\n"
		        "    attenuation: [0, 0, 1]\n",
		        of, s->lights[i].share, 100 * s->lights[i].share, s->texels, s->residual, s->lights[i].at[0],
		        s->lights[i].at[1], s->lights[i].at[2], s->lights[i].color[0], s->lights[i].color[1],
		        s->lights[i].color[2]);
}

void findings_write_surfaces(const struct tricks *t, const struct lightmaps *maps, const struct solved *s, FILE *out)
{
	for (unsigned i = 0; i < t->n; i++) {
		unsigned first = 0;

		while (first < i && !(has_rule_of(&t->found[first], &t->found[i], s) && !tricks_is_outvoted(t, first)))
			first++;
		if (t->found[i].kind == TRICK_MIRROR)
			write_mirror(&t->found[i], out);
		else if (first == i && !tricks_is_outvoted(t, i))
			write_shadow(t, i, s, out);
	}
	write_walls(maps, s, out);
}

void findings_write_lights(const struct tricks *t, const struct lightmaps *maps, const struct solved *s, int has_more,
                           FILE *out)
{
	unsigned lights = 0;

	for (unsigned i = 0; i < t->n; i++)
		lights += t->found[i].kind != TRICK_MIRROR && !tricks_is_outvoted(t, i);
	fprintf(out, lights || has_more || findings_relights(s) ? "lights:\n" : "lights: []\n");
	for (unsigned i = 0; i < t->n; i++)
		if (t->found[i].kind != TRICK_MIRROR && !tricks_is_outvoted(t, i))
			write_light(&t->found[i], out);
	if (findings_relights(s))
		write_solved(s, maps->n_colors ? "vertex colours" : "lightmaps", out);
}
