/*
 * The words of an instance: what its triangles do to rays to lights (kernels/rays/opacity.h), as far as it is the same
 * for all rays.
 */
#pragma once

#include "tracer/frame/place/opacity_cells.h"

/** Number of words. */
size_t opacity_words_count(const struct opacity_surface *s);

/**
 * Fill them.
 * @param s     s->blocks is set if s->unit is
 * @param turn  as opacity_turn_of
 */
void opacity_words_fill(const struct opacity_surface *s, uint32_t turn, uint32_t *words);
