/* Launches a user's hook at its stages of a frame: kernels/frame/hook/hook.h. Functions return 0, ERR_MEMORY, ERR_INPUT
 * or ERR_SYSTEM (reported). */
#pragma once

#include "tracer/frame/common/frame.h"

/** 1 if the frame's hook has one of these stages. stages: HOOK_* */
int hooks_has(const struct frame *frame, unsigned stages);

/** Upload the hook's parameters: a row for each material, and one for rays that hit no material. Sets frame.hooked. */
int hooks_place(struct frame *frame);

/** Start of the row of parameters for rays that hit no material. */
uint32_t hooks_row(const struct frame *frame);

/** Run any hit and closest hit for all n fragments of the list, after their rays to lights. transport: TRANSPORT_*,
 * here and below */
int hooks_shade(const struct frame *frame, const struct accel_space *space, uint32_t transport, uint32_t n);

/** Replace the rays that leave the fragments by those that the hook requested, before they are gathered. */
int hooks_ways(const struct frame *frame, uint32_t transport, uint32_t n);

/** Run any hit, closest hit and miss for all n paths, after they were shaded. */
int hooks_hit(const struct frame *frame, const struct accel_space *space, uint32_t transport, uint32_t n);

/** Run any hit for n rays to lights that were stopped, after shadow_walk. */
int hooks_walk(const struct frame *frame, uint32_t transport, uint32_t n);

/** Run light for all n fragments, or for n hits of paths, into buffers.visibility, after their rays to lights. */
int hooks_light(const struct frame *frame, uint32_t transport, uint32_t n);
int hooks_light_hits(const struct frame *frame, uint32_t transport, uint32_t n);

/** Make the hits of n rays of hook_rays.h the surfaces of their pixels. */
int hooks_see(const struct band *band, uint32_t n);
