/* Rays from the fragments of the list: to lights, into the surroundings, reflected, transmitted. Functions return 0 or
 * ERR_SYSTEM (reported). */
#pragma once

#include "tracer/frame/common/frame.h"

/** Space that rays from a view's fragments may hit: its surfaces, or its skies. NULL: there is nothing to hit. */
const struct accel_space *secondary_space(const struct frame *frame, uint32_t view, int sky);

/** How points are lit, and which rays leave them: TRANSPORT_*. */
uint32_t secondary_transport(const struct tracer_options *options);

/** Trace rays from all n fragments of the list to all lights, into buffers.visibility[slot][fragment], in red, green
 * and blue. */
int secondary_shadows(const struct pass *pass, const struct accel_space *space, uint32_t n);

/** Make room for rays to lights in buffers.rays, and for their results. */
int secondary_reserve_rays(const struct frame *frame, size_t n_rays, union buffer_float *visibility);

/* Rays, and room for the share of light that passes along each: [3][n], in red, green and blue. */
struct light_rays {
	union buffer_ray rays;
	union buffer_float visibility;
	uint32_t n, to_lights; /* to_lights: 0 for rays into the surroundings */
};

/** Trace rays that exist already. */
int secondary_ask(const struct frame *frame, const struct accel_space *space, const struct light_rays *rays);

/** Compute how open the surroundings of all n fragments are, which replaces or modulates their colours. */
int secondary_openness(const struct pass *pass, const struct accel_space *space, uint32_t n);

/** Follow the reflected, refracted and scattered rays of all n fragments bounce by bounce, and add their light to the
 * fragments' parts. */
int secondary_paths(const struct band *band, const struct accel_space *space, const struct accel_space *sky,
                    uint32_t n);

/**
 * Follow paths: the next rays of n items, up to `slots` each (buffers.next_path_rays, next_paths and next_counts),
 * bounce by bounce, and add their light to the parts of the fragments that they come from.
 * @param see  1: the first hits are the surfaces that their pixels show (hooks_see)
 */
int secondary_follow(const struct band *band, const struct accel_space *space, const struct accel_space *sky,
                     uint32_t slots, uint32_t n, int see);

/**
 * Follow n photons, whose rays and paths are in buffers.path_rays and paths (kernels/frame/light/photon.h).
 * @param pass  seed of random numbers
 * @param take  called with the photons after each step; a photon with number SCENE_NONE hit nothing
 */
int secondary_photons(const struct frame *frame, const struct accel_space *space, uint32_t pass, uint32_t n,
                      void (*take)(void *user, const struct photon *photons, uint32_t n), void *user);
