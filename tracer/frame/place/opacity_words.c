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

/* Fill a triangle's map. @return its word without sides */
static uint32_t fill_map(const struct opacity_surface *s, const uint32_t index[3], uint32_t level, uint32_t place,
                         uint32_t *map)
{
	const uint32_t n = 1u << level;
	uint32_t passing = 0, stopping = 0;
	struct opacity_cells cells;

	memset(map, 0, opacity_map_words(level) * sizeof(*map));
	opacity_cells_start(s, index, n, &cells);
	for (uint32_t j = 0; j < n; j++)
		for (uint32_t i = 0; i + j < n; i++) {
			const uint32_t cell = j << level | i, passes = (uint32_t)opacity_cells_pass(&cells, i, j);

			map[cell >> 5] |= passes << (cell & 31);
			passing += passes;
			stopping += !passes;
		}
	if (passing && stopping)
		return OPACITY_MAP | level << OPACITY_LEVEL | place << OPACITY_PLACE;
	return passing ? OPACITY_PASSES : OPACITY_STOPS;
}

size_t opacity_words_count(const struct opacity_surface *s)
{
	return s->mesh->primitive_count * (1 + (size_t)opacity_map_words(map_level(s)));
}

void opacity_words_fill(const struct opacity_surface *s, uint32_t turn, uint32_t *words)
{
	const uint32_t n = s->mesh->primitive_count, level = map_level(s);

	for (uint32_t i = 0; i < n; i++) {
		const uint32_t *index = s->mesh->index + 3 * (size_t)i, place = n + i * opacity_map_words(level);

		words[i] = fill_map(s, index, level, place, words + place) |
		           opacity_sides_of(s, turn, index) >> OPACITY_SIDES_SHIFT;
	}
}
