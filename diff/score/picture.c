/* Extracts layers of an image, and converts numbers to display codes. */
#include "diff/score/picture.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

#include "base/err.h"

/* Code by the formula, which the tables below reproduce. NaN gives 0; lrintf rounds half to even. */
static uint8_t calculated_code(float linear)
{
	const float display = image_display_from_linear(linear);

	return (uint8_t)lrintf(255 * (display > 0 ? display < 1 ? display : 1 : 0));
}

/* Table cell of a positive number, by its leading bits: exponent and six of the fraction. A cell contains few codes. */
static uint32_t cell_of(float positive)
{
	uint32_t bits;

	memcpy(&bits, &positive, sizeof(bits));
	return bits >> 17;
}

/* Tables of codes that avoid pow(): the least number of each code, and the first code of each cell. */
enum { CELLS = 127 << 6 };

static struct {
	float least[256];
	uint8_t first[CELLS];
} codes;

static float float_of_bits(uint32_t bits)
{
	float number;

	memcpy(&number, &bits, sizeof(number));
	return number;
}

static void make_codes(void)
{
	const uint32_t one = (uint32_t)CELLS << 17;

	for (uint32_t code = 1, below = 0; code < 256; code++) {
		uint32_t from = one;

		while (from - below > 1) {
			const uint32_t middle = below + (from - below) / 2;

			*(calculated_code(float_of_bits(middle)) < code ? &below : &from) = middle;
		}
		codes.least[code] = float_of_bits(from);
	}
	for (uint32_t cell = 0; cell < CELLS; cell++)
		codes.first[cell] = calculated_code(float_of_bits(cell << 17));
}

uint8_t score_code_from_linear(float linear)
{
	static pthread_once_t once = PTHREAD_ONCE_INIT;
	uint8_t code;

	pthread_once(&once, make_codes);
	if (!(linear >= codes.least[1]))
		return 0; /* or NaN */
	if (linear >= codes.least[255])
		return 255;
	for (code = codes.first[cell_of(linear)]; linear >= codes.least[code + 1];)
		code++;
	return code;
}

uint8_t score_code(float number, int is_display)
{
	return is_display ? (uint8_t)lrintf(255 * (number > 0 ? number < 1 ? number : 1 : 0)) : score_code_from_linear(number);
}

static int is_display(const struct image *img)
{
	const char *encoding = image_attribute(img, "relume:encoding");

	return encoding && strcmp(encoding, "display") == 0;
}

/* Find channels NAME.X of a layer, or of the layer without a name; all `suffixes` must exist. */
static int find_channels(const struct image *img, const char *layer, const char suffixes[3], const float *planes[3])
{
	for (int c = 0; c < 3; c++) {
		char name[80];

		snprintf(name, sizeof(name), "%s%s%c", layer, layer[0] ? "." : "", suffixes[c]);
		planes[c] = image_channel(img, name);
		if (!planes[c])
			return 0;
	}
	return 1;
}

int score_find_layer(const struct image *img, const char *layer, const float *planes[3])
{
	static const char *const kinds[] = { "RGB", "XYZ", "rgb", "xyz", "YYY" };

	if (strcmp(layer, "beauty") == 0)
		return find_channels(img, "", "RGB", planes) || find_channels(img, "", "YYY", planes);
	for (size_t k = 0; k < sizeof(kinds) / sizeof(kinds[0]); k++)
		if (find_channels(img, layer, kinds[k], planes))
			return 1;
	planes[0] = planes[1] = planes[2] = image_channel(img, layer);
	return planes[0] != NULL;
}

void score_list_layers(const struct image *img, char *out, size_t size)
{
	const float *planes[3];
	const int has_beauty = score_find_layer(img, "beauty", planes);
	size_t used = 0;

	out[0] = '\0';
	if (has_beauty)
		used = (size_t)snprintf(out, size, "beauty");
	for (size_t i = 0; i < img->n_channels && used < size; i++) {
		const char *name = img->channels[i].name, *dot = strrchr(name, '.');
		const int n = dot ? (int)(dot - name) : (int)strlen(name);
		int is_new = !(has_beauty && n == 1 && !dot && strchr("RGBAY", name[0]));

		for (size_t k = 0; k < i; k++) {
			const char *before = img->channels[k].name;

			is_new &= strncmp(before, name, (size_t)n) != 0 || (before[n] && before[n] != '.');
		}
		if (is_new)
			used += (size_t)snprintf(out + used, size - used, "%s%.*s", used ? ", " : "", n, name);
	}
}

static struct score_numbers numbers_of(const struct image *img, const char *layer, const float *const planes[3])
{
	const char *alpha = image_attribute(img, "relume:alpha");
	char name[80];

	snprintf(name, sizeof(name), "%s%sA", strcmp(layer, "beauty") ? layer : "", strcmp(layer, "beauty") ? "." : "");
	return (struct score_numbers){
		.rgb = { planes[0], planes[1], planes[2] }, .alpha = image_channel(img, name), .is_display = is_display(img),
		.is_straight = alpha && strcmp(alpha, "straight") == 0,
		.is_frame = image_attribute(img, "relume:device") || image_attribute(img, "relume:record"),
	};
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
			out->rgb[3 * i + (size_t)c] = score_code(planes[c][i], display);
	out->depth = image_attribute(img, "relume:unknown") ? NULL : image_channel(img, "gl.depth");
	out->id = image_channel(img, "id");
	out->layers = image_channel(img, "layers");
	out->outside = img->outside;
	out->numbers = numbers_of(img, layer, planes);
	return 0;
}

void score_picture_free(struct score_picture *pic)
{
	free(pic->rgb);
	free(pic->alpha);
	free(pic->beyond);
	*pic = (struct score_picture){ 0 };
}
