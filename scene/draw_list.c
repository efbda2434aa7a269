/* Writes the draws of chosen instances as ranges: "3,7-9". */
#include "scene/draw_list.h"

#include <stdio.h>
#include <stdlib.h>

char *scene_draw_list(const struct scene *scene, scene_draw_chooser *is, const void *user)
{
	char *text = NULL;
	size_t size;
	FILE *out = open_memstream(&text, &size);
	uint32_t first = 0, next = 0; /* bounds of the range that is not yet written */
	int any = 0;

	for (uint32_t i = 0; out && i <= scene->n_instances; i++) {
		const uint32_t start = i < scene->n_instances ? scene->instances[i].draw : 0;
		const uint32_t end = i + 1 < scene->n_instances ? scene->instances[i + 1].draw : scene->n_draws + 1;
		const int chosen = i < scene->n_instances && is(user, scene, i);

		if (next > first && !(chosen && start == next)) {
			fprintf(out, "%s%u-%u", any++ ? "," : "", first, next - 1);
			first = next = 0;
		}
		if (!chosen)
			continue;
		first = next > first ? first : start;
		next = end > start ? end : start + 1;
	}
	if (out && fclose(out) == 0)
		return text;
	free(text);
	return NULL;
}
