#include "diff/score/picture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/err.h"

uint8_t score_code_from_linear(float linear)
{
	float display = image_display_from_linear(linear);

	/* written so that NaN gives 0; lrintf rounds half to even */
	return (uint8_t)lrintf(255 * (display > 0 ? display < 1 ? display : 1 : 0));
}

static uint8_t code_from_display(float display)
{
	return (uint8_t)lrintf(255 * (display > 0 ? display < 1 ? display : 1 : 0));
}

static int is_display(const struct image *img)
{
	const char *encoding = image_attribute(img, "relume:encoding");

	return encoding && strcmp(encoding, "display") == 0;
}

int score_find_layer(const struct image *img, const char *layer, const float *planes[3])
{
	for (int c = 0; c < 3; c++) {
		char name[80];

		if (strcmp(layer, "beauty") == 0)
			snprintf(name, sizeof(name), "%c", "RGB"[c]);
		else
			snprintf(name, sizeof(name), "%s.%c", layer, "RGB"[c]);
		planes[c] = image_channel(img, name);
		if (!planes[c])
			return 0;
	}
	return 1;
}

int score_picture_from_image(const struct image *img, const char *layer, struct score_picture *out)
{
	const size_t n = (size_t)img->width * img->height;
	const float *planes[3];
	const int display = is_display(img);

	if (!score_find_layer(img, layer, planes))
		return ERR_INPUT;
	out->rgb = malloc(n ? 3 * n : 1);
	if (!out->rgb)
		return err_report(ERR_SYSTEM, NULL, "out of memory for %u x %u pixels", img->width, img->height);
	out->width = img->width;
	out->height = img->height;
	for (size_t i = 0; i < n; i++)
		for (int c = 0; c < 3; c++)
			out->rgb[3 * i + (size_t)c] = display ? code_from_display(planes[c][i])
			                                      : score_code_from_linear(planes[c][i]);
	out->depth = image_attribute(img, "relume:unknown") ? NULL : image_channel(img, "gl.depth");
	out->id = image_channel(img, "id");
	out->layers = image_channel(img, "layers");
	out->outside = img->outside;
	return 0;
}

void score_picture_free(struct score_picture *pic)
{
	free(pic->rgb);
	*pic = (struct score_picture){ 0 };
}
