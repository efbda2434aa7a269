/* Launches a user's hook at its stages of a frame: kernels/frame/hook/hook.h. Functions return 0, ERR_MEMORY, ERR_INPUT
 * or ERR_SYSTEM (reported). */
#pragma once

#include "tracer/frame/common/frame.h"

/* Buffers of this room. */
struct hook_buffers {
	union buffer_float parameters; /* both are kept for the frame */
	union buffer_hook_object objects;
	union buffer_hook_answer answers;  /* for a band */
};

/** 1 if the frame's hook has one of these stages. stages: HOOK_* */
int hooks_has(const struct frame *frame, unsigned stages);

/** Upload the hook's parameters: a row for each material, and one for rays that hit no material. Sets frame.hooked. */
int hooks_place(struct frame *frame);

/** Start of the row of parameters for rays that hit no material. */
uint32_t hooks_row(const struct frame *frame);

/** The rows of parameters on the device. */
union buffer_float hooks_parameters(const struct frame *frame);

/** Run any hit and closest hit for all fragments, after their rays to lights. transport: TRANSPORT_*, here and below;
 * visibility: of the lights */
int hooks_shade(const struct frame *frame, const struct accel_space *space, uint32_t transport,
                const struct fragment_list *from, union buffer_float visibility);

/** Replace the rays that leave the fragments, in paths->next_rays, by those that the hook requested, before they are
 * gathered. */
int hooks_ways(const struct frame *frame, uint32_t transport, const struct fragment_list *from,
               const struct path_list *paths);

/** Run any hit, closest hit and miss for paths, after they were shaded. radiance: their light */
int hooks_hit(const struct frame *frame, const struct accel_space *space, uint32_t transport,
              const struct path_list *paths, union buffer_float visibility, union buffer_float radiance);

/** Run any hit for rays to lights that were stopped, after shadow_walk. */
int hooks_walk(const struct frame *frame, uint32_t transport, const struct path_list *walks);

/** Run light for fragments, or for the hits of paths, after their rays to lights. */
int hooks_light(const struct frame *frame, uint32_t transport, const struct fragment_list *from,
                const struct light_rays *rays);
int hooks_light_hits(const struct frame *frame, uint32_t transport, const struct path_list *paths,
                     const struct light_rays *rays);

/** Make the hits of rays of hook_rays.h the surfaces of their pixels. */
int hooks_see(const struct band *band, const struct path_list *paths, union buffer_uint pixels);
