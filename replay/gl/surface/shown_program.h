/* Whether programs show a texture as it is: what a fragment program does to its texels, and where a vertex program puts
 * what. */
#pragma once

#include <stdint.h>

#include "scene/scene.h"

struct shown_program {
	uint32_t unit;           /* whose texels the fragments' colours are */
	uint32_t coordinates[2]; /* numbers among all texture coordinates, four of unit 0 first, that say where */
};

/** @return 1 if a material's fragment program colours each fragment by a texel, unchanged, discards none and leaves
 * depth alone */
int shown_program_of(const struct scene *s, const struct scene_material *m, struct shown_program *out);

/** What a vertex program makes of vertex v. @param coordinates  [4 * SCENE_MAX_UNITS]. @return 0: its place is fixed
 * function's; clip is of no use */
int shown_program_vertex(const struct scene *s, const struct scene_instance *in, uint32_t v, float clip[4],
                         float *coordinates);
