#include "tracer/frame/bands/ways.h"

#include "kernels/camera/camera.h"
#include "kernels/frame/plain/plain.h"
#include "tracer/frame/bands/layered.h"
#include "tracer/frame/bands/plain.h"
#include "tracer/frame/bands/staged.h"

/* On a CPU, the data of a band's pixels stays in its caches. A GPU needs many pixels at once. */
static uint32_t usual_pixels(const struct frame *frame)
{
	return frame_in_packets(frame) || frame->objects.n ? 65536u : 2097152u;
}

/* The first that suits a frame draws it. */
static const struct way ways[] = {
	{ plain_suits, plain_band, usual_pixels },
	{ layered_suits, layered_band, layered_pixels },
	{ staged_suits, staged_band, usual_pixels },
};

/* Most pixels in a band: the fragments of all looks at it are numbered. */
#define MOST_PIXELS (0xffffffffu / (PLAIN_LOOKS * CAMERA_COLUMN_MAX))

const struct way *way_of(const struct pass *pass)
{
	const struct way *way = ways;

	while (!way->suits(pass))
		way++;
	return way;
}

uint32_t way_rows(const struct way *way, const struct frame *frame)
{
	const uint32_t most = MOST_PIXELS / frame->width;
	uint32_t rows = frame->options->band_rows ? frame->options->band_rows : way->pixels(frame) / frame->width;

	if (frame->tr->most_rows && rows > frame->tr->most_rows)
		rows = frame->tr->most_rows;
	if (rows > most)
		rows = most;
	return rows < CAMERA_TILE ? CAMERA_TILE : rows / CAMERA_TILE * CAMERA_TILE;
}
