/* Arranges the two pictures of a frame, the program's own (raster) and the traced one, in a picture of the film. */
#pragma once

#include <stdint.h>

#include "tracer/image/oiio.h"

enum layout_kind { LAYOUT_SIDE, LAYOUT_WIPE, LAYOUT_ALTERNATE, LAYOUT_TRACED, LAYOUT_RASTER, N_LAYOUTS };

/* Names for --layout, ended by NULL. */
extern const char *const layout_names[N_LAYOUTS + 1];

struct layout {
	enum layout_kind kind;
	const char *caption; /* in a strip below the pictures; NULL: none */
	int no_labels;       /* 1: the strip does not label the pictures */
};

/** 1 if the layout shows the program's picture, or the traced one. */
int layout_wants_raster(enum layout_kind kind);
int layout_wants_traced(enum layout_kind kind);

/** The size of the film's pictures for frames of a given size. */
void layout_size(const struct layout *layout, uint32_t width, uint32_t height, uint32_t *film_width,
                 uint32_t *film_height);

/** 1 if the picture changes with time while one frame is shown. */
int layout_moves(enum layout_kind kind);

/**
 * Draw one picture of the film.
 * @param raster, traced  [height][width][3], NULL if the layout does not want it
 * @param seconds         since the start of the film: sets the position of a wipe, and which picture alternates
 * @param film            receives the picture; its rgb has the size that layout_size gave
 */
void layout_draw(const struct layout *layout, const uint8_t *raster, const uint8_t *traced, uint32_t width,
                 uint32_t height, double seconds, const struct oiio_pixels *film);
