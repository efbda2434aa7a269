#include "verbs/render/totals.h"

#include <stdio.h>

#define FEW 0.1 /* share of the pixels: if fewer show a difference, people wonder why */

/* A share of all pixels, "12", "0.3", "0.04" or "under 0.01". */
static void write_share(uint64_t part, uint64_t all, char text[16])
{
	const double percent = 100 * (double)part / (double)all;

	if (percent < 0.01)
		snprintf(text, 16, "under 0.01");
	else
		snprintf(text, 16, percent >= 1 ? "%.0f" : "%.1g", percent);
}

static const char *name_of(enum tracer_part part, const struct settings *s, const struct carried *c)
{
	static const char *const names[] = {
		[TRACER_SHADOWS] = "shadows", [TRACER_MIRRORS] = "mirrors", [TRACER_GLASS] = "glass"
	};

	if (part != TRACER_RELIGHT)
		return names[part];
	if (s->tracer.mode != TRACER_WHITTED)
		return "light from surface to surface";
	return c->has_dome ? "light from all around" : "other light";
}

static void print_added(const struct settings *s, const struct carried *c)
{
	const struct tracer_added *a = &c->added;
	unsigned n = 0;

	for (int i = 0; i < N_TRACER_PARTS; i++) {
		char share[16];

		if (!a->parts[i])
			continue;
		write_share(a->parts[i], a->pixels, share);
		fprintf(stderr, "%s%s on %s %%%s", n ? ", " : "  tracing added ", name_of((enum tracer_part)i, s, c),
		        share, n ? "" : " of the pixels");
		n++;
	}
	if (!n)
		fprintf(stderr, "  tracing added nothing: the frames look as OpenGL drew them");
	fputc('\n', stderr);
	if ((double)a->changed >= FEW * (double)a->pixels || s->tracer.mode == TRACER_PATH)
		return;
	fprintf(stderr,
	        "  for more, try %s--mode path, or materials and lights of your own (--look FILE; 'relume pick' writes "
	        "a rule)\n",
	        s->look_auto ? "" : "--look auto, ");
}

static void print_display(const struct settings *s, const struct carried *c)
{
	char share[16];

	write_share(c->bright, c->pixels, share);
	fprintf(stderr, "  exposure %+g stops, white at %g; %s %% of the pixels are brighter\n",
	        (double)s->display.exposure, (double)s->display.white, share);
}

void totals_print(const struct settings *s, const struct carried *c)
{
	if (s->progress == PROGRESS_NONE || s->progress == PROGRESS_JSON)
		return;
	if (c->added.pixels)
		print_added(s, c);
	if (c->bright)
		print_display(s, c);
}
