/* Packs pixels and textures as PNG. */
#include "scene/png_pack.h"

#include <png.h>
#include <stdlib.h>

#include "base/err.h"

int png_pack(const struct png_pixels *p, uint8_t **out, size_t *n)
{
	png_image png = { .version = PNG_IMAGE_VERSION, .width = p->width, .height = p->height,
		          .format = p->has_alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB };
	png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(png);

	*out = malloc(bytes);
	if (*out && png_image_write_to_memory(&png, *out, &bytes, 0, p->bytes, (png_int_32)p->row_bytes, NULL)) {
		*n = bytes;
		return 0;
	}
	free(*out);
	*out = NULL;
	return err_report(ERR_SYSTEM, NULL, "out of memory");
}

/* Clamp texels of four floats to four bytes. */
static void clamp_texels(const struct scene_texture *t, size_t n, uint8_t *out)
{
	const float *v = (const float *)(const void *)t->texels;

	for (size_t i = 0; i < 4 * n; i++)
		out[i] = (uint8_t)(v[i] > 0 ? v[i] < 1 ? v[i] * 255 + 0.5f : 255 : 0);
}

int png_pack_texture(const struct scene_texture *t, uint8_t **out, size_t *n)
{
	const size_t w = t->width + 2 * (size_t)t->border, texels = w * (t->height + 2 * (size_t)t->border);
	uint8_t *clamped = t->floats ? malloc(4 * texels) : NULL;
	const uint8_t *first = (clamped ? clamped : t->texels) + 4 * (t->border * w + t->border);
	int err;

	*out = NULL;
	if (t->floats && !clamped)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	if (clamped)
		clamp_texels(t, texels, clamped);
	err = png_pack(&(struct png_pixels){ first, t->width, t->height, 4 * w, 1 }, out, n);
	free(clamped);
	return err;
}
