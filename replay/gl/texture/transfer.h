/* Pixel transfer (GL 2.1 sec. 3.6.5): operations on pixels between the client or the screen and their destination. */
#pragma once

#include <stdint.h>

struct gls_state;

/** Scale and bias, then the colour maps. @param is_drawn  1: by DrawPixels or CopyPixels */
void gls_transfer_color(const struct gls_state *st, int is_drawn, float rgba[4]);
/** @return 0: the current state does not change colours */
int gls_transfer_changes_colors(const struct gls_state *st);
/** Scale, bias (neither if st is NULL), clamp to [0,1]. */
float gls_transfer_depth(const struct gls_state *st, float depth);
/** Shift and offset a colour or stencil index. */
uint32_t gls_transfer_index(const struct gls_state *st, uint32_t index);
/** Map an index to a colour. */
void gls_transfer_color_index(const struct gls_state *st, uint32_t index, uint8_t rgba[4]);
/** Map a stencil index. */
uint32_t gls_transfer_stencil(const struct gls_state *st, uint32_t value);
