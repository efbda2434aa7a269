#include "verbs/film/layout.h"

#include <math.h>
#include <string.h>

#define WIPE_S 6.0      /* there and back */
#define ALTERNATE_S 3.0 /* both once */
#define GAP 4u          /* black columns between pictures side by side */

const char *const layout_names[N_LAYOUTS + 1] = { "side", "wipe", "alternate", "traced", "raster", NULL };

int layout_wants_raster(enum layout_kind kind)
{
	return kind != LAYOUT_TRACED;
}

int layout_wants_traced(enum layout_kind kind)
{
	return kind != LAYOUT_RASTER;
}

int layout_moves(enum layout_kind kind)
{
	return kind == LAYOUT_WIPE || kind == LAYOUT_ALTERNATE;
}

/* Copy columns first .. end - 1 of a picture to a column of the film. */
static void put(const struct oiio_pixels *film, uint32_t at, const uint8_t *rgb, const uint32_t size[2], uint32_t first,
                uint32_t end)
{
	const uint32_t width = size[0];

	for (uint32_t y = 0; y < size[1] && first < end; y++)
		memcpy(film->rgb + 3 * ((size_t)y * film->width + at), rgb + 3 * ((size_t)y * width + first),
		       3 * (size_t)(end - first));
}

static int letters_of(uint32_t height)
{
	return height >= 480 ? 18 : 12;
}

/* Draws nothing without a font. */
static void write_text(const struct oiio_pixels *film, const char *text, uint32_t x, int letters)
{
	oiio_draw_text(film, &(struct oiio_label){
				     text, (int)x, (int)film->height - letters / 2, letters, { 230, 230, 230 } });
}

void layout_size(const struct layout *layout, uint32_t width, uint32_t height, uint32_t *film_width,
                 uint32_t *film_height)
{
	*film_width = layout->kind == LAYOUT_SIDE ? 2 * width + GAP : width;
	*film_height = height + (layout->caption || !layout->no_labels ? 2 * (uint32_t)letters_of(height) : 0);
}

/* The strip below the pictures. */
static void write_strip(const struct layout *layout, uint32_t width, int odd, const struct oiio_pixels *film,
                        int letters)
{
	static const char *const names[2] = { "OpenGL", "ray traced" };
	const uint32_t left = (uint32_t)letters / 2, right = film->width - width + left;
	const int has_two = layout->kind == LAYOUT_SIDE || layout->kind == LAYOUT_WIPE;

	if (!layout->no_labels)
		write_text(film, names[layout->kind == LAYOUT_TRACED || (layout->kind == LAYOUT_ALTERNATE && odd)], left, letters);
	if (!layout->no_labels && has_two)
		write_text(film, names[1], layout->kind == LAYOUT_SIDE ? right : width - 6 * (uint32_t)letters, letters);
	if (layout->caption)
		write_text(film, layout->caption, left + 9 * (uint32_t)letters, letters);
}

/* The column of the border between the raster picture and the traced one. */
static uint32_t wipe_column(uint32_t width, double seconds)
{
	const double share = 0.5 - 0.5 * cos(2 * 3.14159265358979 * (seconds / WIPE_S + 0.25));

	return (uint32_t)(share * width + 0.5);
}

static void draw_line(const struct oiio_pixels *film, uint32_t column, uint32_t height)
{
	for (uint32_t y = 0; y < height; y++)
		for (uint32_t x = column ? column - 1 : 0; x < column + 1 && x < film->width; x++)
			memset(film->rgb + 3 * ((size_t)y * film->width + x), 255, 3);
}

void layout_draw(const struct layout *layout, const uint8_t *raster, const uint8_t *traced, uint32_t width,
                 uint32_t height, double seconds, const struct oiio_pixels *film)
{
	const int odd = fmod(seconds, ALTERNATE_S) >= ALTERNATE_S / 2;
	const uint32_t column = wipe_column(width, seconds), size[2] = { width, height };

	memset(film->rgb, 0, (size_t)film->width * film->height * 3);
	switch (layout->kind) {
	case LAYOUT_SIDE:
		put(film, 0, raster, size, 0, width);
		put(film, width + GAP, traced, size, 0, width);
		break;
	case LAYOUT_WIPE:
		put(film, 0, raster, size, 0, column);
		put(film, column, traced, size, column, width);
		draw_line(film, column, height);
		break;
	default:
		put(film, 0,
		    layout->kind == LAYOUT_RASTER || (layout->kind == LAYOUT_ALTERNATE && !odd) ? raster : traced, size,
		    0, width);
	}
	write_strip(layout, width, odd, film, letters_of(height));
}
