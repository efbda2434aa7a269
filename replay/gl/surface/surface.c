/*
 * Pixels of surfaces. The supplier (replay.h) renders them from the scene of all events so far, and only on demand.
 *
 * A frame may show what the previous one left. A surface therefore keeps its contents from before its events: as a
 * picture if one was rendered, otherwise as the scene that would produce it. After skipped frames the contents are
 * unknown. A frame that turns out to need them sets x->feedback.rewind; replay.c then goes back and builds the frames
 * before it.
 */
#include "replay/gl/surface/surface.h"

#include "base/err.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "replay/machine/picture.h"
#include "scene/before.h"
#include "scene/program.h"
#include "scene/release.h"

/* Buffers that a scene may not have set everywhere, so that earlier contents may show. */
static uint32_t kept_by(const struct scene *s)
{
	return (s->keeps_depth ? 2u : 0) | (s->stencil_bits ? 4u : 0);
}

/* Render a scene. NULL: not possible */
static struct gls_picture *render(struct gls_exec *x, const struct scene *s)
{
	struct gls_picture *p = gls_picture_make(x, &(struct gls_picture_form){ s->width, s->height, s->depth_bits,
	                                                                        s->alpha_bits, s->samples, s->floats });

	if (!p || !s->width || !s->height)
		return p;
	if (x->feedback.supply(x->feedback.supply_user, s, &p->picture) != 0) {
		if (!x->failed)
			x->failed = ERR_SYSTEM; /* reported by the supplier */
		gls_picture_release(p);
		return NULL;
	}
	if (s->start)
		p->lacks = ((const struct gls_picture *)s->start)->lacks & kept_by(s);
	return p;
}

static void forget(struct gls_surface *surface)
{
	gls_picture_release(surface->picture);
	surface->picture = NULL;
	scene_release(&surface->before);
	surface->lacks = 0;
}

void gls_surface_free(struct gls_surface *surface)
{
	gls_frame_drop(surface);
	forget(surface);
}

void gls_surface_share(struct gls_surface *to, const struct gls_surface *from)
{
	to->picture = gls_picture_reference(from->picture);
	to->before = from->before ? gls_scene_reference(from->before) : NULL;
	to->lacks = from->lacks;
	to->skipped = from->skipped;
	to->deferred = from->deferred;
}

static int has_size(const struct scene_picture *p, const struct scene *s)
{
	return p->width == s->width && p->height == s->height;
}

/* Drop earlier contents if the window's size has changed, even within a frame. */
static void check_size(struct gls_surface *surface, struct scene *s)
{
	if ((surface->picture && !has_size(&surface->picture->picture, s)) ||
	    (surface->before && (surface->before->width != s->width || surface->before->height != s->height)))
		forget(surface);
	if (s->start && !has_size(s->start, s)) {
		gls_picture_release((struct gls_picture *)(uintptr_t)s->start);
		s->start = NULL;
	}
}

/* Render a surface's initial contents from the scene that shows them. @return 0: not possible */
static int make_picture(struct gls_exec *x, struct gls_surface *surface)
{
	surface->picture = render(x, surface->before);
	scene_release(&surface->before);
	if (surface->picture)
		surface->picture->lacks |= surface->lacks;
	return surface->picture != NULL;
}

int gls_surface_is_unknown(struct gls_exec *x, struct gls_surface *surface)
{
	struct scene *s = surface->skipped && surface->frame ? gls_frame_scene(x, surface) : NULL;
	struct gls_picture *p = s && s->needs_previous && !x->failed ? render(x, s) : NULL;
	const int is_unknown = s && s->needs_previous && (!p || p->picture.unknown);

	if (p && !is_unknown)
		gls_frame_all_known(surface);
	gls_picture_release(p);
	return is_unknown;
}

int gls_surface_settle(struct gls_exec *x, struct gls_surface *surface)
{
	return !gls_frame_events(surface) && (!surface->before || make_picture(x, surface));
}

#define MOST_HELD 16u /* most scenes in a chain, in case none is rendered */

/* Leave a scene's initial contents to its renderer, if only colours of them may show. @return 0: not possible */
static int leave_start(const struct gls_surface *surface, struct scene *s)
{
	if (!surface->before || gls_frame_looked(surface) & 6 || scene_before_held(surface->before->before) >= MOST_HELD)
		return 0;
	s->before = scene_before_make(gls_scene_reference(surface->before));
	return s->before != NULL;
}

/* 1 if perhaps nothing earlier shows, because a sky covers it all. Depth, if there is any, is kept even so. */
static int may_cover_all(struct gls_exec *x, const struct gls_surface *surface, const struct scene *s)
{
	if (!surface->before)
		return s->n_instances != 0;
	x->feedback.shows_through |= scene_before_shows(surface->before->before);
	return s->n_instances && !x->feedback.shows_through && !s->keeps_depth;
}

/*
 * Give a surface's scene its initial contents, if they show through.
 * @param leaves    1: the renderer may be left to do this
 * @param snapshot  receives a reference to the scene's picture, if it had to be rendered to find out; else NULL
 * @return 1: the scene is complete; 0: it is not, and cannot be completed now
 */
static int find_start(struct gls_exec *x, struct gls_surface *surface, struct scene *s, int leaves,
                      struct gls_picture **snapshot)
{
	*snapshot = NULL;
	check_size(surface, s);
	if (s->start && ((const struct gls_picture *)s->start)->lacks & gls_frame_looked(surface)) {
		gls_rewind(x, "depth or stencil values that they left are used");
		return 0;
	}
	if (!s->needs_previous || s->start || (!surface->picture && !surface->before && !surface->skipped))
		return 1;
	if (!surface->picture) {
		const int try = may_cover_all(x, surface, s);

		if (try && leaves && leave_start(surface, s))
			return 1;
		if (try && !(*snapshot = render(x, s)))
			return 0;
		if (*snapshot && !(*snapshot)->picture.unknown) {
			(*snapshot)->lacks = surface->skipped ? kept_by(s) : 0;
			gls_frame_all_known(surface);
			return 1;
		}
		x->feedback.shows_through |= try;
		gls_picture_release(*snapshot);
		*snapshot = NULL;
		if (surface->skipped) {
			gls_rewind(x, "their drawing is not cleared, and shows");
			x->feedback.fronts |= surface->is_front;
			return 0;
		}
		if (!make_picture(x, surface))
			return 0;
	}
	s->start = &gls_picture_reference(surface->picture)->picture;
	if (surface->picture->lacks & gls_frame_looked(surface)) {
		gls_rewind(x, "depth or stencil values that they left are used");
		return 0;
	}
	return 1;
}

const struct scene_picture *gls_surface_read(struct gls_exec *x, struct gls_surface *surface,
                                             const struct gls_area *area)
{
	const struct gls_picture *kept;
	struct gls_picture *snapshot = NULL;
	struct scene *s;
	int in_part;

	if (!x->want || !surface)
		return NULL;
	if (!x->feedback.supply) {
		gls_unsupported(x, gls_needs_renderer);
		return NULL;
	}
	s = gls_frame_scene(x, surface);
	if (!s)
		return NULL;
	kept = gls_frame_snapshot(surface, area);
	if (kept && has_size(&kept->picture, s))
		return &kept->picture;
	/* Initial contents need not be rendered if they are not read. */
	in_part = s->needs_previous && !s->start && !surface->picture && (surface->before || surface->skipped) &&
	          gls_frame_knows(surface, area);
	if (!in_part && !find_start(x, surface, s, 0, &snapshot))
		return NULL;
	if (!snapshot)
		snapshot = s->start && !gls_frame_events(surface) ? gls_picture_reference((struct gls_picture *)(uintptr_t)s->start) :
		                                                    render(x, s);
	gls_frame_keep_snapshot(surface, snapshot, in_part);
	return snapshot ? &snapshot->picture : NULL;
}

/* 1 if programs write different colours to further buffers. */
static int has_outputs(const struct scene *s)
{
	for (uint32_t i = 0; i < s->n_materials; i++)
		if (s->materials[i].fragment_program && scene_program_of(s, s->materials[i].fragment_program)->n_data)
			return 1;
	return 0;
}

int gls_surface_restart(struct gls_exec *x, struct gls_surface *surface, struct gls_picture *picture)
{
	struct scene *s = gls_frame_scene(x, surface);

	if (s)
		s->output++;
	if (!s || (!s->needs_previous && !has_outputs(s))) {
		gls_picture_release(picture);
		return 0;
	}
	gls_frame_keep_snapshot(surface, NULL, 0);
	if (s->start)
		gls_picture_release((struct gls_picture *)(uintptr_t)s->start);
	s->start = NULL;
	gls_frame_renew(surface);
	forget(surface);
	surface->picture = picture;
	return 1;
}

struct scene *gls_surface_end(struct gls_exec *x, struct gls_surface *surface, int is_shown)
{
	struct gls_picture *snapshot = NULL;
	struct scene *s = gls_frame_scene(x, surface);
	uint32_t lacks;

	if (!s || (x->feedback.supply && !find_start(x, surface, s, is_shown && x->feedback.leaves_starts, &snapshot)))
		return NULL;
	s = gls_frame_take(x, surface);
	lacks = (surface->skipped ? 6u : surface->lacks) & kept_by(s);
	forget(surface);
	surface->lacks = lacks;
	surface->skipped = surface->deferred = 0;
	if (snapshot)
		surface->picture = snapshot;
	else if (x->feedback.supply)
		surface->before = gls_scene_reference(s);
	return s;
}
