/*
 * Beauty = gl x shadow + relight + reflect + refract holds for the numbers as they are stored: each part is rounded to
 * half before the next is computed from it, so what rounding leaves ends in relight and reflect.
 */
#include "tracer/compose.h"

#define IMATH_HALF_NO_LOOKUP_TABLE
#include <half.h>
#include <math.h>
#include <string.h>

#include "base/err.h"

const char *const compose_groups[] = { "gl", "shadow", "relight", "reflect", "refract", "Z", "N", "P", "albedo", "id",
	                               "layers", NULL };

int compose_wants(const char *aov, const char *group)
{
	size_t n = strlen(group);

	if (!aov)
		return 1;
	for (const char *at = aov; at; at = strchr(at, ',')) {
		at += *at == ',';
		if (strncmp(at, group, n) == 0 && (at[n] == ',' || at[n] == '\0'))
			return 1;
	}
	return 0;
}

static float to_half(float x)
{
	return imath_half_to_float(imath_float_to_half(x));
}

/* The channels of an image that is being composed; NULL where they are not asked for. */
struct planes {
	float *beauty[4], *gl[4], *depth, *shadow[3], *relight[3], *reflect[3], *refract[3];
	float *z, *normal[3], *position[3], *albedo[3], *id, *layers;
};

static int add_group(struct image *img, const char *group, const char *letters, int full, float **planes)
{
	for (size_t i = 0; letters[i]; i++) {
		char name[32];

		strcpy(name, group);
		if (*group)
			strcat(name, ".");
		strncat(name, &letters[i], 1);
		planes[i] = image_add_channel(img, name, full);
		if (!planes[i])
			return -1;
	}
	return 0;
}

static int add_channels(struct image *img, const char *aov, struct planes *p)
{
	int failed = add_group(img, "", "RGBA", 0, p->beauty);

	if (compose_wants(aov, "gl") && !failed) {
		failed = add_group(img, "gl", "RGBA", 0, p->gl);
		p->depth = failed ? NULL : image_add_channel(img, "gl.depth", 1);
		failed |= !p->depth;
	}
	if (compose_wants(aov, "shadow") && !failed)
		failed = add_group(img, "shadow", "RGB", 0, p->shadow);
	if (compose_wants(aov, "relight") && !failed)
		failed = add_group(img, "relight", "RGB", 0, p->relight);
	if (compose_wants(aov, "reflect") && !failed)
		failed = add_group(img, "reflect", "RGB", 0, p->reflect);
	if (compose_wants(aov, "refract") && !failed)
		failed = add_group(img, "refract", "RGB", 0, p->refract);
	if (compose_wants(aov, "Z") && !failed)
		failed = !(p->z = image_add_channel(img, "Z", 1));
	if (compose_wants(aov, "N") && !failed)
		failed = add_group(img, "N", "XYZ", 0, p->normal);
	if (compose_wants(aov, "P") && !failed)
		failed = add_group(img, "P", "XYZ", 1, p->position);
	if (compose_wants(aov, "albedo") && !failed)
		failed = add_group(img, "albedo", "RGB", 0, p->albedo);
	if (compose_wants(aov, "id") && !failed)
		failed = !(p->id = image_add_channel(img, "id", 1));
	if (compose_wants(aov, "layers") && !failed)
		failed = !(p->layers = image_add_channel(img, "layers", 1));
	return failed ? -1 : 0;
}

static float encode(float display, int keep)
{
	return keep ? display : image_linear_from_display(display);
}

/* What is left to explain, rounded as it is stored; what rounding alone leaves is no effect. */
static float effect(float rest, float of)
{
	return fabsf(rest) > fabsf(of) * 0x1p-9f ? to_half(rest) : 0;
}

/* One colour channel of one pixel, taken apart. */
static void decompose(const struct planes *p, const struct frame_pixel *pixel, int c, int keep, size_t at)
{
	float exact = encode(pixel->gl[c], keep), gl = to_half(exact), shadowed = encode(pixel->shadowed[c], keep);
	float direct = encode(pixel->direct[c], keep), mirrored = encode(pixel->mirrored[c], keep);
	float shadow = 1, relight, reflect = 0, refract = 0, sum;

	if (gl > 0 && shadowed < exact)
		shadow = to_half(fmaxf(shadowed / exact, 0));
	relight = effect(direct - gl * shadow, direct);
	sum = gl * shadow + relight;
	if (pixel->mirrored[c] != pixel->direct[c])
		reflect = to_half(mirrored - sum);
	sum += reflect;
	if (pixel->beauty[c] != pixel->mirrored[c])
		refract = to_half(encode(pixel->beauty[c], keep) - sum);
	p->beauty[c][at] = to_half(sum + refract);
	if (p->gl[c])
		p->gl[c][at] = gl;
	if (p->shadow[c])
		p->shadow[c][at] = shadow;
	if (p->relight[c])
		p->relight[c][at] = relight;
	if (p->reflect[c])
		p->reflect[c][at] = reflect;
	if (p->refract[c])
		p->refract[c][at] = refract;
}

static void store3(float *const planes[3], const float *values, size_t at)
{
	for (int i = 0; i < 3; i++)
		if (planes[i])
			planes[i][at] = values[i];
}

static void compose_pixel(const struct planes *p, const struct frame_pixel *pixel, const float *surface,
                          const struct tracer_options *options, size_t at)
{
	int drawn = pixel->id != 0 || pixel->unknown & PIXEL_BEFORE;

	for (int c = 0; c < 3; c++) {
		if (options->mode == TRACER_NORMALS)
			p->beauty[c][at] = drawn ? encode(surface[c] * 0.5f + 0.5f, options->display) : 0;
		else
			decompose(p, pixel, c, options->display, at);
	}
	p->beauty[3][at] = (float)drawn;
	if (p->gl[3])
		p->gl[3][at] = pixel->gl[3];
	if (p->depth)
		p->depth[at] = pixel->depth_exact;
	if (p->id)
		p->id[at] = (float)pixel->id;
	if (p->layers)
		p->layers[at] = (float)pixel->layers;
	store3(p->normal, surface, at);
	store3(p->position, surface + 3, at);
	if (drawn)
		store3(p->albedo, (float[3]){ encode(pixel->albedo[0], options->display),
		                              encode(pixel->albedo[1], options->display),
		                              encode(pixel->albedo[2], options->display) }, at);
	if (p->z)
		p->z[at] = surface[6];
}

int compose_image(const struct frame_pixel *pixels, const float *planes, const struct tracer_options *options,
                  struct image *img)
{
	const char *aov = options->mode == TRACER_NORMALS ? "Z,N,P,albedo,id" : options->aov;
	struct planes p = { .depth = NULL };

	if (add_channels(img, aov, &p) != 0)
		return ERR_SYSTEM; /* reported by image_add_channel */
	for (uint32_t row = 0; row < img->height; row++)
		for (uint32_t x = 0; x < img->width; x++) {
			size_t from = (size_t)(img->height - 1 - row) * img->width + x;

			compose_pixel(&p, &pixels[from], planes + from * SURFACE_PLANES, options,
			              (size_t)row * img->width + x);
		}
	return 0;
}
