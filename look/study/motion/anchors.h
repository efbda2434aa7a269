/* The camera and the meshes that stand still, which anchor each frame in the world. */
#pragma once

#include "look/rules/findings.h"
#include "look/study/motion/motion.h"

/** How the camera moves and how many meshes stand still. */
void anchors_summarize(const struct motion *m, struct findings_summary *out);

/** The rules `world`: enough static meshes that each frame shows some. None if none is known. */
void anchors_find(const struct motion *m, struct findings *out);
