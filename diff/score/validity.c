/* Gate V: can the frame be compared with the reference at all? */
#include "diff/score/measures.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "diff/score/picture.h"

/** Note the first reason why the frame cannot be compared, and count NaN and infinite numbers. */
int gate_validity(struct gate_frame *f)
{
	const struct score_picture *ref = f->ref;
	const struct image *img = f->img;
	const size_t n = (size_t)img->width * img->height;
	const char *number = image_attribute(img, "relume:frame"), *recording = image_attribute(img, "relume:trace");
	const char *program = image_attribute(img, "relume:program"), *moment = image_attribute(img, "relume:moment");
	const char *odd_channel = NULL;
	const float *planes[3];
	char layers[96];
	uint64_t odd = 0;

	for (size_t c = 0; c < img->n_channels; c++) {
		const float *values = image_values(img, c);

		for (size_t i = 0; i < n; i++) {
			if (values && isfinite(values[i]))
				continue;
			odd++;
			if (!odd_channel)
				odd_channel = img->channels[c].name;
		}
	}
	gate_measure(f, GATE_V, 0, (double)odd);
	if (odd_channel)
		gate_note(f, GATE_V, "first in channel %s", odd_channel);

	if (recording && ref->recording && ref->recording[0] && strcmp(recording, ref->recording) != 0) {
		gate_fail(f, GATE_V,
		          "made from another recording: one%s%.60s of hash %.8s, and the reference's is %.8s (relume "
		          "info)",
		          program ? " of " : "", program ? program : "", recording, ref->recording);
	} else if (image_attribute(img, "relume:camera")) {
		gate_fail(f, GATE_V, "made with --camera: the reference shows another view (camera %.100s)",
		          image_attribute(img, "relume:camera"));
	} else if (moment && ref->recording && ref->recording[0]) {
		gate_fail(f, GATE_V, "made with --fps, of moment %.40s: the reference has recorded frames", moment);
	} else if (img->width != ref->width || img->height != ref->height) {
		gate_fail(f, GATE_V, "size %u x %u, but the reference is %u x %u", img->width, img->height, ref->width, ref->height);
	} else if (!score_find_layer(img, f->layer, planes)) {
		score_list_layers(img, layers, sizeof(layers));
		gate_fail(f, GATE_V, "there is no layer \"%.32s\", but %s (--channel)", f->layer, layers);
	} else if (strcmp(f->layer, "gl") == 0 && !score_find_layer(img, "beauty", planes)) {
		gate_fail(f, GATE_V, "a traced frame, but without channels R, G and B");
	} else if (number && !moment && strtoull(number, NULL, 10) != f->score->frame) {
		gate_fail(f, GATE_V, "the file says that it is frame %.20s, not %" PRIu64, number, f->score->frame);
	} else if (n == 0) {
		gate_fail(f, GATE_V, "the picture is empty");
	} else if (ref->ignore && !memchr(ref->ignore, 0, n)) {
		gate_fail(f, GATE_V, "every pixel is ignored, or shown by one side only");
	}
	for (size_t i = 0; i < f->options->n_channels; i++) {
		if (image_channel(img, f->options->channels[i]))
			continue;
		gate_fail(f, GATE_V, "there is no channel \"%.40s\"", f->options->channels[i]);
		break;
	}
	return 0;
}
