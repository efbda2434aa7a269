/*
 * What a user's functions `bounds` and `intersection` stand for: instances whose triangles no ray meets, and whose
 * shape the hook says instead (kernels/frame/hook.h). They lie in the eye space of job.hooked; all its pixels are
 * traced (hook_rays.h).
 *
 * Shading knows triangles alone. So a small triangle stands for each place that a ray hit, with the normal that the
 * hook told: three vertices behind the frame's own, in a slot of the ray. Rays of different kinds have slots apart.
 *
 * Functions return 0, ERR_MEMORY (more rays than slots: the frame's bands must be smaller) or ERR_SYSTEM (reported).
 */
#pragma once

#include "tracer/frame/frame.h"

/* First rays keep their slots until the band is composed, others for a bounce. */
enum hook_rays_of { HOOK_RAYS_FIRST, HOOK_RAYS_ON, HOOK_RAYS_TO_LIGHTS, N_HOOK_RAYS_OF };

/** Ask for the bounds of all instances; those that have some are objects. After hooks_place, before vertices and
 * trees. */
int hook_objects_find(struct job *job);
void hook_objects_forget(struct job *job);

/** Room for the triangles, behind the frame's own: vertices, and texture coordinates of 4 numbers. */
size_t hook_objects_vertices(const struct job *job);
size_t hook_objects_texcoords(const struct job *job);

/** Let an object's geometry be the triangles that stand for it. index: where theirs begin in the pool of indices */
void hook_objects_stand(struct job *job, uint32_t object, uint32_t index);

/** 1 where a space has objects. */
int hook_objects_in(const struct job *job, const struct accel_space *space);

/** What rays hit of them: after the nearest triangles were found; and whether they hit anything. */
int hook_objects_intersect(struct job *job, const struct traverse_rays *rays, enum hook_rays_of whose);
int hook_objects_occlude(struct job *job, const struct traverse_rays *rays);
