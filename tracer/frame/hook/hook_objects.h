/*
 * Objects defined by a user's functions `bounds` and `intersection`. They are instances whose triangles are ignored by
 * rays, and whose shape comes from the hook instead (kernels/frame/hook/hook.h). They are in the eye space of
 * frame.hooked, and all its pixels are ray traced (hook_rays.h).
 *
 * Shading handles only triangles. So each hit is represented by a small triangle with the normal that the hook
 * returned. Its three vertices come after the frame's own, in a slot of the ray. Rays of different kinds have separate
 * slots.
 *
 * Functions return 0, ERR_MEMORY (more rays than slots: the frame's bands must be smaller) or ERR_SYSTEM (reported).
 */
#pragma once

#include "tracer/frame/common/frame.h"

/* Kinds of rays. First rays keep their slots until the band is composed, others for one bounce. */
enum hook_rays_of { HOOK_RAYS_FIRST, HOOK_RAYS_ON, HOOK_RAYS_TO_LIGHTS, N_HOOK_RAYS_OF };

/** Ask the hook for the bounds of all instances. Those with bounds become objects. Call after hooks_place and before
 * vertices and trees are made. */
int hook_objects_find(struct frame *frame);
void hook_objects_forget(struct frame *frame);

/** Number of vertices, and of texture coordinates (4 numbers each), to reserve for the triangles after the frame's
 * own. */
size_t hook_objects_vertices(const struct frame *frame);
size_t hook_objects_texcoords(const struct frame *frame);

/** Set an object's geometry to the triangles that represent its hits. index: start of their indices in the pool */
void hook_objects_stand(struct frame *frame, uint32_t object, uint32_t index);

/** 1 if a space has objects. */
int hook_objects_in(const struct frame *frame, const struct accel_space *space);

/** Find the nearest hits of rays on objects, after the nearest triangles were found; find whether rays hit any
 * object. */
int hook_objects_intersect(const struct frame *frame, const struct traverse_rays *rays, enum hook_rays_of whose);
int hook_objects_occlude(const struct frame *frame, const struct traverse_rays *rays);
