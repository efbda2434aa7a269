/* Generated mipmaps (GL 2.1 sec. 3.8.8). */
#pragma once

#include <stdint.h>

struct gls_exec;
struct gls_texture;

/** Generate all levels above the base level. */
void gls_texture_generate_mipmaps(struct gls_exec *x, struct gls_texture *t, unsigned face);

/** A level's texels have changed: generate the levels above it if the texture has GENERATE_MIPMAP. */
void gls_texture_level_changed(struct gls_exec *x, struct gls_texture *t, unsigned face, int64_t level);
