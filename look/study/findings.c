#include "look/study/findings.h"

#include <inttypes.h>
#include <math.h>

static const char *const trick_names[] = { "planar shadow", "stencil mirror", "shadow volume (z-pass)", "shadow volume (z-fail)" };

/* More draws that agree are more certain. */
static double confidence_of(const struct trick_found *f)
{
	return 1 - 0.5 / (1 + f->votes);
}

static void write_plane(const struct trick_found *f, FILE *out)
{
	fprintf(out, "    plane: [%.7g, %.7g, %.7g, %.7g]\n", f->plane[0], f->plane[1], f->plane[2], f->plane[3]);
}

static void write_shadow(const struct trick_found *f, FILE *out)
{
	int is_volume = f->kind != TRICK_PLANAR_SHADOW;

	fprintf(out, "  - role: %s\n    confidence: %.2f\n", trick_names[f->kind], confidence_of(f));
	fprintf(out, "    why: \"%u draws in %u frames %s one light; %s\"\n", f->votes, f->frames,
	        is_volume ? "have edges that meet in" : "are flattened away from",
	        f->has_opengl_light ? "OpenGL lights what they darken from there, so that its traced shadows replace them"
	                            : "OpenGL has no light there, and so they stay");
	if (!is_volume)
		write_plane(f, out);
	fprintf(out, "    match: %s\n", is_volume ? "{ stencil_tested: yes, blended: yes, depth_tested: no }" : "{ modelview: singular, lit: no }");
	if (f->has_opengl_light)
		fprintf(out, "    left_out: yes\n    shadows: no\n    mirrors: no\n");
}

static void write_mirror(const struct trick_found *f, FILE *out)
{
	fprintf(out, "  - role: stencil mirror\n    confidence: %.2f\n", confidence_of(f));
	fprintf(out, "    why: \"%u draws in %u frames are reflections of others in one plane; %s\"\n", f->votes, f->frames,
	        f->shows > 0 ? "a blended surface lies in it" : "no blended surface lies in it, and so they stay");
	write_plane(f, out);
	fprintf(out, "    match: { modelview: mirrored, stencil_tested: %s }\n", f->stencil ? "yes" : "no");
	if (!(f->shows > 0))
		return;
	fprintf(out, "    left_out: yes\n    shadows: no\n    mirrors: no\n");
	fprintf(out, "  - role: mirror\n    confidence: %.2f\n    why: \"it is blended over its picture, of which %.0f %% show\"\n",
	        confidence_of(f), 100 * f->shows);
	write_plane(f, out);
	fprintf(out, "    match: { mesh: \"%016" PRIx64 "%016" PRIx64 "\", blended: yes }\n", f->surface[1], f->surface[0]);
	fprintf(out, "    solid: yes\n    reflect: %.4g\n", f->shows);
}

static void write_light(const struct trick_found *f, FILE *out)
{
	fprintf(out, "  - role: light of a %s\n    confidence: %.2f\n", trick_names[f->kind], confidence_of(f));
	fprintf(out, "    why: \"%s\"\n", f->has_opengl_light ? "OpenGL has it too" : "how strong it is, nothing says");
	fprintf(out, "    off: yes\n    space: world\n    position: [%.7g, %.7g, %.7g, %g]\n", f->light[0], f->light[1], f->light[2], f->light[3]);
}

void findings_write(const struct tricks *t, FILE *out)
{
	unsigned lights = 0;

	fprintf(out, t->n ? "surfaces:\n" : "surfaces: []\n");
	for (unsigned i = 0; i < t->n; i++) {
		lights += t->found[i].kind != TRICK_MIRROR;
		if (t->found[i].kind == TRICK_MIRROR)
			write_mirror(&t->found[i], out);
		else
			write_shadow(&t->found[i], out);
	}
	fprintf(out, lights ? "lights:\n" : "lights: []\n");
	for (unsigned i = 0; i < t->n; i++)
		if (t->found[i].kind != TRICK_MIRROR)
			write_light(&t->found[i], out);
}
