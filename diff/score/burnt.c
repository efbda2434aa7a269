/* Gate N, third figure: counts pixels that light burns out. */
#include "diff/score/burnt.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "diff/score/picture.h"
#include "tracer/image/image.h"

#define FULL (250 / 255.0f) /* as displayed; ambient shadows of nearby things leave no more of a full channel */
#define BRIGHT_CODES 16     /* a clearly visible step */

struct burnt {
	const float *gl[3], *shadow[3], *relight[3], *albedo[3];
	const float *layers; /* NULL: the frame has no such channel */
	int is_display;
	float full; /* FULL in linear light */
};

/* Light at a pixel: least and greatest channel, and luminance. */
struct seen {
	float least, most, luminance;
};

static struct seen see(const struct burnt *b, const float color[3])
{
	float linear[3];

	for (int c = 0; c < 3; c++)
		linear[c] = b->is_display ? image_linear_from_display(color[c]) : color[c];
	return (struct seen){ .least = fminf(fminf(linear[0], linear[1]), linear[2]),
		              .most = fmaxf(fmaxf(linear[0], linear[1]), linear[2]),
		              .luminance = 0.2126f * linear[0] + 0.7152f * linear[1] + 0.0722f * linear[2] };
}

/* own: the surface's colour. @return the ratio of least to greatest channel above which a colour is washed out */
static float share_of(const struct burnt *b, size_t i, struct seen own)
{
	const int is_film = b->layers && b->layers[i] > 0; /* the albedo is that of the film alone */

	return is_film || !(own.most > 0) ? 1 : 1.25f * own.least / own.most + 0.05f;
}

static int is_burnt(const struct burnt *b, struct seen color, float share)
{
	return color.most >= b->full && color.least >= fminf(share, b->full) * color.most;
}

/* @return 1: burnt by light; -1: burnt in OpenGL's picture only; 0: in neither, or in both */
static int compare(const struct burnt *b, size_t i)
{
	float gl[3], light[3], albedo[3], share;
	struct seen before, after;

	for (int c = 0; c < 3; c++) {
		gl[c] = b->gl[c][i];
		light[c] = gl[c] * b->shadow[c][i] + b->relight[c][i];
		albedo[c] = b->albedo[c][i];
	}
	before = see(b, gl);
	after = see(b, light);
	share = share_of(b, i, see(b, albedo));
	if (is_burnt(b, before, share))
		return is_burnt(b, after, share) ? 0 : -1;
	return is_burnt(b, after, share) &&
	       score_code_from_linear(after.luminance) - score_code_from_linear(before.luminance) >= BRIGHT_CODES;
}

double burnt_share(const struct gate_frame *f)
{
	const size_t n = (size_t)f->img->width * f->img->height;
	const char *encoding = image_attribute(f->img, "relume:encoding");
	struct burnt b = { .layers = image_channel(f->img, "layers"),
		           .is_display = encoding && strcmp(encoding, "display") == 0,
		           .full = image_linear_from_display(FULL) };
	int64_t more = 0;

	if (!score_find_layer(f->img, "gl", b.gl) || !score_find_layer(f->img, "shadow", b.shadow) ||
	    !score_find_layer(f->img, "relight", b.relight) || !score_find_layer(f->img, "albedo", b.albedo))
		return 0;
	for (size_t i = 0; i < n; i++)
		more += score_ignores(f->ref, i) ? 0 : compare(&b, i);
	for (size_t i = 0; i < n && more > 0; i++)
		f->blamed[i] |= !score_ignores(f->ref, i) && compare(&b, i) > 0;
	return more > 0 ? (double)more / (double)n : 0;
}
