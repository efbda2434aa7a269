/* Gate B: compares the traced frame with the approved one. */
#include "diff/score/approved.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

#include "base/err.h"
#include "diff/score/flip.h"
#include "diff/score/measures.h"
#include "diff/score/picture.h"

#define OFF_RELATIVE 0x1p-9  /* largest error of a half after two roundings */
#define OFF_ABSOLUTE 0x1p-14 /* linear; a fifth of the darkest display code */

static const char *const layers[] = { "beauty", "gl", "shadow", "relight", "reflect", "refract" };

/** 1 if two numbers of a colour channel differ by more than another build of the device's compiler can explain. */
static int is_off(float a, float b)
{
	double size = fmax(fabs((double)a), fabs((double)b));

	return !(fabs((double)a - (double)b) <= OFF_RELATIVE * size + OFF_ABSOLUTE);
}

void approved_mark(const struct image *now, const struct image *was, uint8_t *off)
{
	const size_t n = (size_t)now->width * now->height;
	const float *now_rgb[3], *was_rgb[3];

	for (size_t l = 0; l < sizeof(layers) / sizeof(layers[0]); l++)
		if (score_find_layer(now, layers[l], now_rgb) && score_find_layer(was, layers[l], was_rgb))
			for (size_t i = 0; i < n; i++)
				for (int c = 0; c < 3; c++)
					off[i] |= is_off(now_rgb[c][i], was_rgb[c][i]);
}

/* Measure the figures, if both have colours. *n_off: pixels that differ. */
static int measure_colors(struct gate_frame *f, const struct image *was, uint64_t *n_off)
{
	const struct image *img = f->img;
	const size_t n = (size_t)img->width * img->height;
	const float *now_rgb[3], *was_rgb[3];
	uint64_t count = 0;
	double flip = 0;
	uint8_t *off;
	int err;

	if (!score_find_layer(img, "beauty", now_rgb) || !score_find_layer(was, "beauty", was_rgb))
		return 0;
	off = calloc(n ? n : 1, 1);
	if (!off)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	approved_mark(img, was, off);
	for (size_t i = 0; i < n; i++) {
		const int is_compared = !score_ignores(f->ref, i);

		count += is_compared;
		*n_off += is_compared && off[i];
		f->blamed[i] |= is_compared && off[i];
	}
	free(off);
	err = flip_compare_hdr(was_rgb, now_rgb, img->width, img->height, NULL, &flip);
	if (!err) {
		gate_measure(f, GATE_B, 0, 100 * (double)*n_off / fmax(1, (double)count));
		gate_measure(f, GATE_B, 1, flip);
	}
	return err;
}

int gate_baseline(struct gate_frame *f)
{
	const struct image *img = f->img;
	const struct score_approved *approved = f->approved;
	const struct image *was = approved ? approved->image : NULL;
	uint64_t off = 0;
	int err;

	if (!approved) {
		gate_note(f, GATE_B, "no approved frame");
		return 0;
	}
	if (approved->same_hashes) {
		gate_measure(f, GATE_B, 0, 0);
		gate_measure(f, GATE_B, 1, 0);
		gate_note(f, GATE_B, "every channel has its approved hash");
		return 0;
	}
	if (!was && !approved->same_device) {
		gate_note(f, GATE_B, "another device, and only hashes are approved");
		return 0;
	}
	if (was && (was->width != img->width || was->height != img->height)) {
		gate_fail(f, GATE_B, "size %u x %u, approved %u x %u", img->width, img->height, was->width, was->height);
		return 0;
	}
	err = was ? measure_colors(f, was, &off) : 0;
	if (err)
		return err;
	if (!approved->same_channels) {
		gate_fail(f, GATE_B, "the channels are not the approved ones: %.90s", approved->changed);
	} else if (approved->same_device) {
		/* the same device must give the same bytes */
		gate_fail(f, GATE_B, "the same device, but other hashes: %.90s", approved->changed);
	} else {
		gate_note(f, GATE_B, "another device; %" PRIu64 " pixels off", off);
	}
	return 0;
}
