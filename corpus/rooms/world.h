/* Builds a world from a level, writes facts about it, and checks it. */
#pragma once

#include "cull.h"
#include "level.h"

void world_build(struct world *world, const struct level *level);

/** The view of a viewer who has walked `metres` along the level's path, and turned; stays at the path's end. */
struct view world_walk(const struct level *level, double metres, double turned_deg);

/** The view from the level's start, turned by some degrees. */
struct view world_view(const struct level *level, double turned_deg);

/** Write facts about the level as JSON: lights, mirror, zones, polygons drawn by each culling from the start. */
void world_write_truth(const struct world *world, const struct level *level, const char *path);

/**
 * Check a world: every zone is closed, there are no T-junctions, and for 10,000 points the BSP finds the same leaf as
 * asking every leaf, solid where the brushes are solid. Prints a line.
 * @return 1 or 0
 */
int world_check(const struct world *world, const struct level *level, unsigned seed);

void world_free(struct world *world);
