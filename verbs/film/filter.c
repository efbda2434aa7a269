#include "verbs/film/filter.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "verbs/film/filter_weights.h"

#define ALBEDO_LEAST 0.02f /* light is a surface's colour over its albedo, or over this if it is less */

static int allocate(struct filter_frame *f)
{
	const size_t n = (size_t)f->width * f->height + 1;

	f->light = calloc(n, sizeof(*f->light));
	f->gloss = calloc(n, sizeof(*f->gloss));
	f->variance = calloc(n, sizeof(*f->variance));
	f->guess = calloc(n, sizeof(*f->guess));
	f->albedo = calloc(n, sizeof(*f->albedo));
	f->normal = calloc(n, sizeof(*f->normal));
	f->depth = calloc(n, sizeof(*f->depth));
	f->motion = calloc(n, sizeof(*f->motion));
	f->is_there = calloc(n, 1);
	f->is_inner = calloc(n, 1);
	if (f->is_inner && f->light && f->gloss && f->variance && f->guess && f->albedo && f->normal && f->depth &&
	    f->motion && f->is_there)
		return 0;
	return err_report(ERR_SYSTEM, NULL, "out of memory for %u x %u pixels", f->width, f->height);
}

void filter_free(struct filter_frame *f)
{
	free(f->light);
	free(f->gloss);
	free(f->variance);
	free(f->guess);
	free(f->albedo);
	free(f->normal);
	free(f->depth);
	free(f->motion);
	free(f->is_there);
	free(f->is_inner);
	*f = (struct filter_frame){ 0 };
}

/* A frame's planes by group: three each, except for Z. */
struct planes {
	const float *beauty[3], *reflect[3], *refract[3], *albedo[3], *normal[3], *motion[3], *depth;
};

static const struct group {
	const char *prefix, *letters;
	size_t offset;
	int is_needed;
} groups[] = {
	{ "", "RGB", offsetof(struct planes, beauty), 1 },
	{ "reflect.", "RGB", offsetof(struct planes, reflect), 1 },
	{ "refract.", "RGB", offsetof(struct planes, refract), 1 },
	{ "albedo.", "RGB", offsetof(struct planes, albedo), 1 },
	{ "N.", "XYZ", offsetof(struct planes, normal), 1 },
	{ "motion.", "XYA", offsetof(struct planes, motion), 0 },
};

static int find_planes(struct image *img, const char *where, struct planes *out)
{
	for (size_t g = 0; g < sizeof(groups) / sizeof(groups[0]); g++)
		for (int c = 0; c < 3; c++) {
			const float **plane = (const float **)(void *)((char *)out + groups[g].offset) + c;
			char name[16] = "";

			strcat(name, groups[g].prefix);
			strncat(name, groups[g].letters + c, 1);
			*plane = image_channel(img, name);
			if (!*plane && groups[g].is_needed)
				return err_report(ERR_INPUT, where, "has no channel %s; render it with all channels, or --aov %s",
				                  name, FILTER_NEEDS);
		}
	out->depth = image_channel(img, "Z");
	return out->depth ? 0 :
	                    err_report(ERR_INPUT, where, "has no channel Z; render it with all channels, or --aov %s",
	                               FILTER_NEEDS);
}

int filter_take(struct image *img, const char *where, struct filter_frame *f)
{
	struct planes p = { .depth = NULL };
	int err = find_planes(img, where, &p);

	if (err)
		return err;
	f->width = img->width;
	f->height = img->height;
	err = allocate(f);
	for (size_t i = 0; i < (size_t)f->width * f->height && !err; i++) {
		float square = 0;

		for (int c = 0; c < 3; c++) {
			f->albedo[i][c] = fmaxf(p.albedo[c][i], ALBEDO_LEAST);
			f->gloss[i][c] = p.reflect[c][i] + p.refract[c][i];
			f->light[i][c] = (p.beauty[c][i] - f->gloss[i][c]) / f->albedo[i][c];
			f->normal[i][c] = p.normal[c][i];
			f->motion[i][c] = p.motion[0] && p.motion[1] && p.motion[2] ? p.motion[c][i] : 0;
			square += f->normal[i][c] * f->normal[i][c];
		}
		f->depth[i] = p.depth[i];
		/* A surface in the viewer's own plane is not lit: it is a HUD, blended over another surface's light. */
		f->is_there[i] = square > 0.25f && f->depth[i] > 0 && isfinite(f->depth[i]) &&
		                 isfinite(filter_brightness(f->light[i]) + filter_brightness(f->gloss[i]));
	}
	return err;
}

static void drop_channel(struct image *img, size_t i)
{
	free(img->channels[i].values);
	free(img->channels[i].halves);
	memmove(&img->channels[i], &img->channels[i + 1], (img->n_channels - i - 1) * sizeof(*img->channels));
	img->n_channels--;
}

/* Files are written with a channel as it was rendered, if that is still there. */
static void forget_halves(struct image *img, const float *plane)
{
	for (size_t i = 0; i < img->n_channels; i++)
		if (img->channels[i].values == plane) {
			free(img->channels[i].halves);
			img->channels[i].halves = NULL;
		}
}

int filter_beauty(struct image *img, float *to[3])
{
	static const char *const effects[] = { "shadow.", "relight.", "reflect.", "refract." };

	for (int c = 0; c < 3; c++) {
		const char name[2] = { "RGB"[c], '\0' };

		to[c] = image_channel(img, name);
		if (!to[c])
			return ERR_SYSTEM;
		forget_halves(img, to[c]);
	}
	for (size_t i = img->n_channels; i-- > 0;)
		for (int k = 0; k < 4; k++)
			if (strncmp(img->channels[i].name, effects[k], strlen(effects[k])) == 0) {
				drop_channel(img, i);
				break;
			}
	return image_set_attribute(img, "relume:denoised", "1");
}

int filter_put(const struct filter_frame *f, struct image *img)
{
	float *to[3];
	const int err = filter_beauty(img, to);

	for (size_t i = 0; i < (size_t)f->width * f->height && !err; i++)
		for (int c = 0; c < 3; c++)
			to[c][i] = f->is_there[i] ? f->light[i][c] * f->albedo[i][c] + f->gloss[i][c] : to[c][i];
	return err;
}

int filter_alone(struct image *img)
{
	struct filter_frame f = { .width = 0 };
	int err = filter_take(img, NULL, &f);

	if (!err)
		err = filter_guess(&f);
	if (!err)
		err = filter_space(&f);
	if (!err)
		err = filter_put(&f, img);
	filter_free(&f);
	return err;
}
