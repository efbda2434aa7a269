#include "tracer/frame/picture/added.h"

#include <string.h>

#define HALF_ONE 0x3c00u
#define ROW 4096u /* pixels whose bits are computed at a time */

/* A channel group, its planes, and the magnitude of its values if nothing is added. */
static const struct part {
	const char *group;
	uint32_t plane, nothing;
} parts[N_TRACER_PARTS] = {
	[TRACER_SHADOWS] = { "shadow", COMPOSE_SHADOW, HALF_ONE },
	[TRACER_RELIGHT] = { "relight", COMPOSE_RELIGHT, 0 },
	[TRACER_MIRRORS] = { "reflect", COMPOSE_REFLECT, 0 },
	[TRACER_GLASS] = { "refract", COMPOSE_REFRACT, 0 },
};

int added_counts(const struct pass *pass)
{
	const enum tracer_mode mode = pass->frame->options->mode;

	return pass->image && pass->frame->options->counts &&
	       (mode == TRACER_WHITTED || mode == TRACER_DIFFUSE || mode == TRACER_PATH);
}

int added_needs(const struct pass *pass, const char *group)
{
	for (int i = 0; i < N_TRACER_PARTS && added_counts(pass); i++)
		if (strcmp(parts[i].group, group) == 0)
			return 1;
	return 0;
}

/* Mark the pixels of a row that show a part. @return their number */
static uint32_t mark(const struct part *part, const uint16_t *const planes[3], size_t n, uint8_t *changed)
{
	const uint16_t *r = planes[0], *g = planes[1], *b = planes[2];
	uint32_t count = 0;

	for (size_t i = 0; i < n; i++) {
		const unsigned is = (((r[i] ^ part->nothing) | (g[i] ^ part->nothing) | (b[i] ^ part->nothing)) &
		                     0x7fffu) != 0;

		changed[i] |= (uint8_t)is;
		count += is;
	}
	return count;
}

void added_take(const struct band *band, const struct compose_request *request, const uint16_t *halves)
{
	struct tracer_added *added = &band->pass->drawn->added;

	if (!added_counts(band->pass))
		return;
	if (band->row_first + band->n_rows == band->frame->height) /* the topmost band is drawn first */
		memset(added, 0, sizeof(*added));
	for (uint32_t first = 0; first < band->n_pixels; first += ROW) {
		const uint32_t n = band->n_pixels - first < ROW ? band->n_pixels - first : ROW;
		uint8_t changed[ROW] = { 0 };

		for (int k = 0; k < N_TRACER_PARTS; k++) {
			const uint32_t *at = &request->half_plane[parts[k].plane];

			added->parts[k] += mark(&parts[k],
			                        (const uint16_t *[]){ halves + at[0] + first, halves + at[1] + first,
			                                              halves + at[2] + first },
			                        n, changed);
		}
		for (uint32_t i = 0; i < n; i++)
			added->changed += changed[i];
	}
	added->pixels += band->n_pixels;
}
