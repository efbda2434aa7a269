/*
 * Texture objects and sampler objects (GL 2.1 sec. 3.8): levels, parameters and bindings.
 *
 * A texture that is attached to a framebuffer object may lag behind what was drawn to it: call gls_texture_update
 * (surface/framebuffer.h) before it is read or changed.
 */
#pragma once

#include "gl_tokens.h"
#include "replay/gl/texture/level.h"
#include "replay/machine/commands.h"
#include "replay/machine/state.h"
#include "scene/release.h"

struct gls_texture_image;


struct gls_texture {
	uint32_t name, target; /* target: enum gls_texture_target; N_GLS_TEXTURE_TARGETS before the first bind */
	struct gls_level levels[6][GLS_MAX_LEVELS]; /* one row per cube map face; other textures use face 0 */
	struct gls_texture_parameters parameters;
	uint32_t attached;               /* 1: is or was attached to a framebuffer object */
	uint32_t dirty;                  /* 1: the image must be looked up again */
	uint32_t hashed;                 /* 1: the levels' hashes are valid (snapshot.c) */
	uint32_t mipmapped;              /* 1: the image was looked up for a filter that needs all levels */
	struct gls_texture_image *image; /* a reference, or NULL: incomplete */
	struct scene *drawn;             /* a reference: the draws that made level 0, unchanged since; or NULL */
	uint32_t drawn_lost;             /* 1: there was such a scene, but checkpoints with pixels do not include it */
};

/** Note that texels or levels have changed. */
static inline void gls_texture_changed(struct gls_texture *t)
{
	t->dirty = 1;
	t->hashed = 0;
	scene_release(&t->drawn);
	t->drawn_lost = 0;
}

/** gls_texture_target of a GL token (texture or cube face), -1: none. `face` receives 0 .. 5. */
int gls_texture_target_of(uint32_t token, unsigned *face);
/** Handle an invalid target: a GL error, or a target that is not supported. */
void gls_texture_no_target(struct gls_exec *x, struct gls_state *st, uint32_t token);

/** The GL token of a gls_texture_target. */
static inline uint32_t gls_texture_token(uint32_t target)
{
	static const uint32_t tokens[N_GLS_TEXTURE_TARGETS] = {
		GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP, GL_TEXTURE_RECTANGLE,
		GL_TEXTURE_2D_ARRAY,
	};

	return tokens[target];
}

/** Number of layers of a level, without borders; 1 if its target has none. */
static inline uint32_t gls_texture_depth(const struct gls_texture *t, const struct gls_level *l)
{
	return t->target == GLS_TEXTURE_3D ? l->depth - 2 * l->border : t->target == GLS_TEXTURE_2D_ARRAY ? l->depth : 1;
}

/** The object bound to a target of a unit; created if necessary. NULL: out of memory (reported) */
struct gls_texture *gls_texture_bound(struct gls_exec *x, struct gls_state *st, unsigned unit, unsigned target);

/**
 * The source of a unit's sampling parameters: the sampler object bound to it (GL 3.3 sec. 3.8.2), or the texture
 * itself.
 */
const struct gls_texture *gls_texture_sampler(const struct gls_state *st, unsigned unit, const struct gls_texture *t);

/**
 * Save the parameters of the textures bound to each unit and target, for PushAttrib. They are restored to objects that
 * still exist.
 */
void gls_texture_save_parameters(const struct gls_state *st,
                                 struct gls_saved_texture saved[GLS_MAX_UNITS][N_GLS_TEXTURE_TARGETS]);
void gls_texture_restore_parameters(struct gls_state *st,
                                    const struct gls_saved_texture saved[GLS_MAX_UNITS][N_GLS_TEXTURE_TARGETS]);

/* The form of a level, as given to TexImage. */
struct gls_level_form {
	uint32_t internal_format;
	int64_t width, height, depth, border; /* sizes with border */
};

/**
 * Define a level, with texels all 0.
 * @return NULL: it has no texels (size 0), or is not possible (GL error, unsupported format, out of memory)
 */
struct gls_level *gls_texture_specify(struct gls_exec *x, struct gls_state *st, struct gls_texture *t, unsigned face,
                                      int64_t level, const struct gls_level_form *form);

/** The `missing` member of the first incomplete level; 0: all are complete. */
uint32_t gls_texture_missing(const struct gls_texture *t);

void gls_texture_free(struct gls_texture *t);
