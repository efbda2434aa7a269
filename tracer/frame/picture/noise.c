#include "tracer/frame/picture/noise.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/err.h"
#include "tracer/frame/picture/buffers.h"

#define BEAUTY 9u /* index of the beauty among a pixel's parts in the sums */

void noise_free(struct noise *noise)
{
	free(noise->sums);
	*noise = (struct noise){ 0 };
}

/* Read the brightness of the sums. NULL: the device failed, or out of memory */
static float *read_sums(const struct frame *frame, int *err)
{
	const size_t n = (size_t)frame->width * frame->height;
	float (*parts)[PASS_PARTS] = malloc(n * sizeof(*parts)), *out = malloc(n * sizeof(*out));

	*err = parts && out ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");
	if (!*err)
		*err = device_read(frame->tr->dev, frame->tr->picture->sums.buffer, 0, parts, n * sizeof(*parts));
	for (size_t i = 0; i < n && !*err; i++)
		out[i] = 0.2126f * parts[i][BEAUTY] + 0.7152f * parts[i][BEAUTY + 1] + 0.0722f * parts[i][BEAUTY + 2];
	free(parts);
	if (!*err)
		return out;
	free(out);
	return NULL;
}

int noise_measure(const struct frame *frame, struct noise *noise, uint32_t passes, float *out)
{
	const size_t n = (size_t)frame->width * frame->height;
	const double before = noise->passes, since = (double)passes - before, all = passes;
	double squares = 0, total = 0;
	int err;
	float *sums = read_sums(frame, &err);

	*out = FLT_MAX;
	if (err)
		return err;
	for (size_t i = 0; i < n && noise->sums; i++) {
		const double off = (double)noise->sums[i] / before - ((double)sums[i] - (double)noise->sums[i]) / since;

		squares += off * off;
		total += (double)sums[i] / all;
	}
	/* The variances of the means are proportional to 1 / before, 1 / since and, for all samples, 1 / all. */
	if (noise->sums)
		*out = total > 0 ? (float)(sqrt(squares / (double)n * before * since) / all / (total / (double)n)) : 0;
	free(noise->sums);
	noise->sums = sums;
	noise->passes = passes;
	return 0;
}
