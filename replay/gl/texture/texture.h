/*
 * Texture objects and sampler objects (GL 2.1 sec. 3.8): their levels and parameters, and what is bound.
 *
 * A texture that is attached to a framebuffer object may be behind what was drawn to it: gls_texture_update
 * (surface/framebuffer.h) comes before anybody looks at it or changes it.
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
	struct gls_level levels[6][GLS_MAX_LEVELS]; /* faces of cubes; others use face 0 */
	struct gls_texture_parameters parameters;
	uint32_t attached;               /* 1: is or was attached to a framebuffer object */
	uint32_t dirty;                  /* 1: the image must be found again */
	uint32_t hashed;                 /* 1: the levels' hashes are of their texels (snapshot.c) */
	uint32_t mipmapped;              /* the image was found for a filter that wants all levels */
	struct gls_texture_image *image; /* a reference, or NULL: incomplete */
	struct scene *drawn;             /* a reference: what drew all of level 0, and nobody changed it since; or NULL */
	uint32_t drawn_lost;             /* 1: there was such a scene, but checkpoints with pixels hold none */
};

/** Texels or levels have changed. */
static inline void gls_texture_changed(struct gls_texture *t)
{
	t->dirty = 1;
	t->hashed = 0;
	scene_release(&t->drawn);
	t->drawn_lost = 0;
}

/** gls_texture_target of a GL token (texture or cube face), -1: none. `face` receives 0 .. 5. */
int gls_texture_target_of(uint32_t token, unsigned *face);
/** A target that is none: the program's error, or one that we lack. */
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

/** Layers of a level, without borders; 1: its target has none. */
static inline uint32_t gls_texture_depth(const struct gls_texture *t, const struct gls_level *l)
{
	return t->target == GLS_TEXTURE_3D ? l->depth - 2 * l->border : t->target == GLS_TEXTURE_2D_ARRAY ? l->depth : 1;
}

/** The object bound to a target of a unit; made where there is none yet. NULL: out of memory (reported) */
struct gls_texture *gls_texture_bound(struct gls_exec *x, struct gls_state *st, unsigned unit, unsigned target);

/** Where a unit's sampling parameters come from: the sampler object bound to it (GL 3.3 sec. 3.8.2), else the texture
 * itself. */
const struct gls_texture *gls_texture_sampler(const struct gls_state *st, unsigned unit, const struct gls_texture *t);

/** The parameters of what is bound to each unit and target, for PushAttrib; they come back to objects that are still
 * there. */
void gls_texture_save_parameters(const struct gls_state *st,
                                 struct gls_saved_texture saved[GLS_MAX_UNITS][N_GLS_TEXTURE_TARGETS]);
void gls_texture_restore_parameters(struct gls_state *st,
                                    const struct gls_saved_texture saved[GLS_MAX_UNITS][N_GLS_TEXTURE_TARGETS]);

/* What TexImage says of a level. */
struct gls_level_form {
	uint32_t internal_format;
	int64_t width, height, depth, border; /* sizes with border */
};

/**
 * Make a level anew, texels all 0.
 * @return NULL: it has no texels (size 0), or cannot be (GL error, unsupported format, out of memory)
 */
struct gls_level *gls_texture_specify(struct gls_exec *x, struct gls_state *st, struct gls_texture *t, unsigned face,
                                      int64_t level, const struct gls_level_form *form);

/** `missing` of the first level that misses pixels; 0: there is none. */
uint32_t gls_texture_missing(const struct gls_texture *t);

void gls_texture_free(struct gls_texture *t);
