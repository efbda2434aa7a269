/* The measure functions of gate_table.h, and counts shared by several of them. */
#pragma once

#include "diff/score/gates.h"

#define GATE_MEASURE_PROTOTYPE(id, name, title, measure, ...) int measure(struct gate_frame *f);
SCORE_GATES(GATE_MEASURE_PROTOTYPE)

/** Fill f->colors and the score's fidelity from the maps (color.c). */
void gate_count_colors(struct gate_frame *f);

/** Fill f->closure and the shares of effects (effects.c). */
void gate_count_effects(struct gate_frame *f);

/** Find the draws visible at the blamed pixels (blame.c). @return 0 or ERR_SYSTEM (reported) */
int gate_blame(const struct gate_frame *f);

/** Measure how well pixels agree for each program that ran (programs.c). @return 0 or ERR_SYSTEM (reported) */
int gate_programs(const struct gate_frame *f);
