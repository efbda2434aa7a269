/* What a study knows of camera and world, as text. */
#pragma once

#include <stdio.h>

#include "look/study/motion.h"

/** Comments: how the camera moves, how many meshes stand still. */
void world_report(const struct motion *m, FILE *out);

/** The list `world`: meshes that stand still, so many that each frame shows some of them. Nothing where none is
 * known. */
void world_write(const struct motion *m, FILE *out);
