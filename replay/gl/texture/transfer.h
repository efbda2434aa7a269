/* Pixel transfer (GL 2.1 sec. 3.6.5): what becomes of pixels between the client or the screen and where they go. */
#pragma once

#include <stdint.h>

struct gls_state;

/** Scale and bias, then the colour maps. @param is_drawn  1: by DrawPixels or CopyPixels */
void gls_transfer_color(const struct gls_state *st, int is_drawn, float rgba[4]);
/** 0: the state leaves colours as they are. */
int gls_transfer_changes_colors(const struct gls_state *st);
/** Scale, bias (neither where st is NULL), clamp to [0,1]. */
float gls_transfer_depth(const struct gls_state *st, float depth);
/** Shift and offset of a colour or stencil index. */
uint32_t gls_transfer_index(const struct gls_state *st, uint32_t index);
/** The colour that the maps give such an index. */
void gls_transfer_color_index(const struct gls_state *st, uint32_t index, uint8_t rgba[4]);
/** The stencil value that the map gives it. */
uint32_t gls_transfer_stencil(const struct gls_state *st, uint32_t value);
