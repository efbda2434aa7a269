/* Events of a surface: what is drawn and cleared, on its way into a scene. Without a scene under construction (x->want 0) nothing happens. */
#ifndef REPLAY_BUILD_FRAME_H
#define REPLAY_BUILD_FRAME_H

#include <stdint.h>

#include "gl_tokens.h"
#include "replay/machine/machine.h"

struct gls_mesh;
struct gls_picture;
struct gls_surface;
struct gls_texture_image;

/** 1 where drawing and clearing reach a surface, or would if it were wanted: neither selection nor feedback (sec. 5.2, 5.3). */
static inline int gls_renders(const struct gls_state *st)
{
	return st->render_mode == GL_RENDER && !st->rasterizer_discard;
}
/** 1 where they reach the surface. */
static inline int gls_is_drawn(const struct gls_exec *x, const struct gls_state *st)
{
	return x->want && gls_renders(st);
}
/**
 * Draw a mesh with the state as it is.
 * @param mesh    no reference is taken (the scene takes its own)
 * @param values  attributes that the mesh does not give
 */
void gls_frame_add(struct gls_exec *x, struct gls_state *st, struct gls_mesh *mesh, const float (*values)[4],
                   uint32_t command, uint64_t call_number);
/**
 * Draw a bitmap or pixel rectangle; values: the raster position's attributes, final. r->texture is filled in from the image.
 * @param corner  window coordinates, z the window depth
 */
void gls_frame_add_rectangle(struct gls_exec *x, struct gls_state *st, const struct scene_rectangle *r,
                             struct gls_texture_image *image, const float corner[4], const float (*values)[4]);
void gls_frame_clear(struct gls_exec *x, struct gls_state *st, uint32_t buffers);
/** The scene of all events so far, valid until the next one; begun where there is none. Borrowed; NULL: out of memory. */
struct scene *gls_frame_scene(struct gls_exec *x, struct gls_surface *surface);
/** The same, taken out of the surface: a reference for the caller. No events are left. */
struct scene *gls_frame_take(struct gls_exec *x, struct gls_surface *surface);
/** Forget all events. */
void gls_frame_drop(struct gls_surface *surface);
/** Nothing from before the events shows any more. */
void gls_frame_all_known(struct gls_surface *surface);
/** The scene so far becomes another one: what was rendered of it is not looked for. */
void gls_frame_renew(struct gls_exec *x, struct gls_surface *surface);
uint64_t gls_frame_events(const struct gls_surface *surface);
/** Where the picture of the first *events events is kept; the surface must have a frame. */
struct gls_picture **gls_frame_snapshot(struct gls_surface *surface, uint64_t **events);
struct scene *gls_scene_reference(struct scene *scene);

#endif
