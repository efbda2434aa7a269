/* A level made into a world, what is known of it, and whether it is sound. */
#pragma once

#include "cull.h"
#include "level.h"

void world_build(struct world *world, const struct level *level);

/** The view from the level's start in a frame: it turns by so many degrees. */
/** A viewer who has walked so many metres along the level's path, and has turned; at its end they stay. */
struct view world_walk(const struct level *level, double metres, double turned_deg);

struct view world_view(const struct level *level, double turned_deg);

/** What is true of the level, as JSON: lights, mirror, zones, polygons drawn by each culling from the start. */
void world_write_truth(const struct world *world, const struct level *level, const char *path);

/**
 * Is every zone closed, no T-junction left, and does the BSP find for 10,000 points the leaf that asking every leaf
 * finds, solid where the brushes are solid? Prints a line.
 * @return 1 or 0
 */
int world_check(const struct world *world, const struct level *level, unsigned seed);

void world_free(struct world *world);
