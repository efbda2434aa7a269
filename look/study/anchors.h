/* The camera and the world, as a study knows them: a summary, and what stands still as anchors. */
#pragma once

#include "look/findings.h"
#include "look/study/motion.h"

/** How the camera moves and how many meshes stand still. */
void anchors_summarize(const struct motion *m, struct findings_summary *out);

/** The rules `world`: enough meshes that stand still for each frame to show some. None if none is known. */
void anchors_find(const struct motion *m, struct findings *out);
