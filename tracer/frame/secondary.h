/* Rays from the fragments of the list: to lights, into the surroundings, mirrored, through glass. Functions return 0 or
 * ERR_SYSTEM (reported). */
#pragma once

#include "tracer/frame/frame.h"

/** What rays from a view's fragments may hit: its surfaces, or its skies; NULL: nothing. */
const struct accel_space *secondary_space(const struct job *job, uint32_t view, int sky);

/** How points are lit and where their rays go: TRANSPORT_*. */
uint32_t secondary_transport(const struct tracer_options *options);

/** Ask all lights from all n fragments of the list: buffers.visibility[slot][fragment], of red, green and blue. */
int secondary_shadows(struct job *job, const struct accel_space *space, uint32_t n);

/** Make room for rays to lights in buffers.rays, and for what becomes of them. */
int secondary_reserve_rays(struct job *job, size_t n_rays);

/** What becomes of rays that are there already, into buffers.visibility[ray]. to_lights: 0: they look around instead */
int secondary_ask(struct job *job, const struct accel_space *space, uint32_t to_lights, union buffer_ray rays,
                  uint32_t n_rays);

/** How open the surroundings of all n fragments are, in place of their colours or over them. */
int secondary_openness(struct job *job, const struct accel_space *space, uint32_t n);

/** Follow the mirrored, bent and scattered rays of all n fragments, bounce by bounce, into their parts. */
int secondary_paths(struct job *job, const struct accel_space *space, const struct accel_space *sky, uint32_t n);

/**
 * Follow paths: the next rays of n items, up to `slots` each (buffers.next_path_rays, next_paths and next_counts),
 * bounce by bounce into the parts of the fragments that they come from.
 * @param see  1: what the first of them hit is what their pixels show (hooks_see)
 */
int secondary_follow(struct job *job, const struct accel_space *space, const struct accel_space *sky, uint32_t slots,
                     uint32_t n, int see);

/**
 * Follow n photons, whose rays and paths stand in buffers.path_rays and paths (kernels/frame/photon.h).
 * @param pass  what chances are drawn by
 * @param take  gets them after each way: those whose number is SCENE_NONE came nowhere
 */
int secondary_photons(struct job *job, const struct accel_space *space, uint32_t pass, uint32_t n,
                      void (*take)(void *user, const struct photon *photons, uint32_t n), void *user);
