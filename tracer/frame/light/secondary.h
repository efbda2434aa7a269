/* Rays from the fragments of the list: to lights, into the surroundings, reflected, transmitted. Functions return 0 or
 * ERR_SYSTEM (reported). */
#pragma once

#include "tracer/frame/common/frame.h"

/** Space that rays from a view's fragments may hit: its surfaces, or its skies. NULL: there is nothing to hit. */
const struct accel_space *secondary_space(const struct frame *frame, uint32_t view, int sky);

/** How points are lit, and which rays leave them: TRANSPORT_*. */
uint32_t secondary_transport(const struct tracer_options *options);

/** Trace rays from all fragments to all lights. visibility: receives its buffer, [slot][fragment] in red, green and
 * blue */
int secondary_shadows(const struct pass *pass, const struct accel_space *space, const struct fragment_list *from,
                      union buffer_float *visibility);

/** Make room for rays to lights, and for their results: in the room's own buffer, or in `visibility` if not NULL. */
int secondary_reserve_rays(const struct frame *frame, size_t n_rays, union buffer_float *visibility,
                           struct light_rays *out);

/** Trace rays that exist already. */
int secondary_ask(const struct frame *frame, const struct accel_space *space, const struct light_rays *rays);

/** Compute how open the surroundings of all fragments are, which replaces or modulates their colours. */
int secondary_openness(const struct pass *pass, const struct accel_space *space, const struct fragment_list *from);

/** Follow the reflected, refracted and scattered rays of all fragments bounce by bounce, and add their light to the
 * fragments' parts. */
int secondary_paths(const struct band *band, const struct accel_space *space, const struct accel_space *sky,
                    const struct fragment_list *from);

/** Make room for the first rays of n paths that start in another way, and for their counts. */
int secondary_reserve_paths(const struct frame *frame, uint32_t n, struct path_list *out);

/**
 * Follow paths: the next rays of all fragments, up to `slots` each, bounce by bounce, and add their light to the parts
 * of the fragments.
 * @param see  1: the first hits are the surfaces that their pixels show (hooks_see)
 */
int secondary_follow(const struct band *band, const struct accel_space *space, const struct accel_space *sky,
                     const struct fragment_list *from, uint32_t slots, int see);

/**
 * Follow n photons, whose rays and paths are in the room's lists (kernels/frame/light/photon.h).
 * @param pass  seed of random numbers
 * @param take  called with the photons after each step; a photon with number SCENE_NONE hit nothing
 */
int secondary_photons(const struct frame *frame, const struct accel_space *space, uint32_t pass, uint32_t n,
                      void (*take)(void *user, const struct photon *photons, uint32_t n), void *user);
