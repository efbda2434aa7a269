/* Gate R5: window depth of interior pixels. */
#include "diff/score/measures.h"

#include <math.h>

#include "diff/score/picture.h"

/* Depth tolerance; slope / 256 is added, as llvmpipe snaps vertices to 1/256 pixel. */
#define OFF_24 0x1p-23
#define OFF_16 0x1p-16

/** Change of depth over one pixel, along x plus along y. */
static double slope_at(const float *depth, int width, int height, int x, int y)
{
	const float *z = depth + (size_t)y * (size_t)width + x;
	double sx = 0, sy = 0;

	if (x > 0)
		sx = fabs((double)z[0] - (double)z[-1]);
	if (x + 1 < width)
		sx = fmax(sx, fabs((double)z[1] - (double)z[0]));
	if (y > 0)
		sy = fabs((double)z[0] - (double)z[-width]);
	if (y + 1 < height)
		sy = fmax(sy, fabs((double)z[width] - (double)z[0]));
	return sx + sy;
}

int gate_depth(struct gate_frame *f)
{
	const struct score_picture *ref = f->ref, *traced = &f->traced;
	uint64_t failing = 0, count = 0;
	double bar, worst = 0;

	if (!ref->depth || !traced->depth) {
		gate_note(f, GATE_R5,
		          !ref->depth ? "no depth reference" :
		          image_attribute(f->img, "relume:unknown") ?
		                        "it is that of earlier frames: nothing here clears depth or looks at it" :
		                        "the frame has no channel \"gl.depth\"");
		return 0;
	}
	bar = score_depth_is_16_bit(ref->depth, (size_t)ref->width * ref->height) ? OFF_16 : OFF_24;
	for (int y = 0; y < (int)ref->height; y++) {
		for (int x = 0; x < (int)ref->width; x++) {
			size_t i = (size_t)y * ref->width + (size_t)x;
			double off;

			if (f->maps.band[i] || score_ignores(ref, i))
				continue;
			off = fabs((double)ref->depth[i] - (double)traced->depth[i]) /
				(bar + slope_at(ref->depth, (int)ref->width, (int)ref->height, x, y) / 256);
			count++;
			failing += off > 1;
			f->blamed[i] |= off > 1;
			worst = fmax(worst, off);
		}
	}
	if (count == 0) {
		gate_note(f, GATE_R5, "no pixel is interior");
		return 0;
	}
	gate_measure(f, GATE_R5, 0, (double)failing);
	gate_note(f, GATE_R5, "worst is %.3g of the bar (2^%d + slope/256)", worst, bar == OFF_24 ? -23 : -16);
	return 0;
}
