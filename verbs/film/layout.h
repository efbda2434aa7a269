/* How a frame's two pictures, the program's own (raster) and the traced one, share a picture of a film. */
#pragma once

#include <stdint.h>

#include "tracer/image/oiio.h"

enum layout_kind { LAYOUT_SIDE, LAYOUT_WIPE, LAYOUT_ALTERNATE, LAYOUT_TRACED, LAYOUT_RASTER, N_LAYOUTS };

/* The option's values, ended by NULL. */
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
 * @param film            of layout_size
 */
void layout_draw(const struct layout *layout, const uint8_t *raster, const uint8_t *traced, uint32_t width,
                 uint32_t height, double seconds, const struct oiio_pixels *film);
