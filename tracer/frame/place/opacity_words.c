#include "tracer/frame/place/opacity_words.h"

#include <string.h>

#include "kernels/rays/opacity.h"
#include "tracer/frame/place/opacity_sides.h"

/* Maps of a mesh are coarser if they would have more words than this. */
#define MOST_MAP_WORDS (1u << 18)

static uint32_t map_level(const struct opacity_surface *s)
{
	uint32_t level = s->unit == SCENE_NONE ? 0 : OPACITY_MOST_LEVEL;

	while (level > 0 && (uint64_t)s->mesh->primitive_count * opacity_map_words(level) > MOST_MAP_WORDS)
		level--;
	return level;
}

/* Fill a triangle's map. stops: 0 if it may let light pass that alpha would stop. @return its word without sides */
static uint32_t fill_map(const struct opacity_surface *s, const uint32_t index[3], int stops, uint32_t level,
                         uint32_t place, uint32_t *map)
{
	const uint32_t n = 1u << level;
	uint32_t all = SCENE_NONE, differs = 0;
	struct opacity_cells cells;

	memset(map, 0xaa, opacity_map_words(level) * sizeof(*map)); /* OPACITY_ASK beyond the diagonal */
	opacity_cells_start(s, index, n, &cells);
	for (uint32_t j = 0; j < n; j++)
		for (uint32_t i = 0; i + j < n; i++) {
			const uint32_t cell = j << level | i, shift = 2 * (cell & 15);
			uint32_t does = opacity_cells_at(&cells, i, j);

			if (does == OPACITY_STOPS && !stops)
				does = OPACITY_ASK;
			map[cell >> 4] = (map[cell >> 4] & ~(3u << shift)) | does << shift;
			all = all == SCENE_NONE ? does : all;
			differs |= does != all;
		}
	return differs ? OPACITY_MAP | level << OPACITY_LEVEL | place << OPACITY_PLACE : all;
}

size_t opacity_words_count(const struct opacity_surface *s)
{
	return s->mesh->primitive_count * (1 + (size_t)opacity_map_words(map_level(s)));
}

void opacity_words_fill(const struct opacity_surface *s, uint32_t turn, uint32_t *words)
{
	const uint32_t n = s->mesh->primitive_count, level = map_level(s);
	const int stops_sun = !(s->material->surface.hidden & SCENE_STOPS_NO_SUN);

	for (uint32_t i = 0; i < n; i++) {
		const uint32_t *index = s->mesh->index + 3 * (size_t)i, place = n + i * opacity_map_words(level);
		int sure;
		const uint32_t sides = opacity_sides_of(s, turn, index, &sure);

		words[i] = fill_map(s, index, sure && stops_sun, level, place, words + place) | sides >> OPACITY_SIDES_SHIFT;
	}
}
