/* A user's hook at its stages of a frame: kernels/frame/hook.h. Functions return 0, ERR_MEMORY, ERR_INPUT or ERR_SYSTEM
 * (reported). */
#pragma once

#include "tracer/frame/frame.h"

/** 1 where the frame's hook has one of these stages. stages: HOOK_* */
int hooks_has(const struct job *job, unsigned stages);

/** Bring its parameters to the device: a row for each material, and one for rays that meet none. Finds job.hooked. */
int hooks_place(struct job *job);

/** Where the row of parameters starts that rays have which meet no material. */
uint32_t hooks_row(const struct job *job);

/** Any hit and closest hit of all n fragments of the list: after their lights were asked. transport: TRANSPORT_*, here
 * and below */
int hooks_shade(struct job *job, const struct accel_space *space, uint32_t transport, uint32_t n);

/** The rays that it asked for, in place of those that leave the fragments: before they are gathered. */
int hooks_ways(struct job *job, uint32_t transport, uint32_t n);

/** Any hit, closest hit and miss of all n paths: after they were shaded. */
int hooks_hit(struct job *job, const struct accel_space *space, uint32_t transport, uint32_t n);

/** Any hit of n rays to lights that were stopped: after shadow_walk. */
int hooks_walk(struct job *job, uint32_t transport, uint32_t n);

/** Light: of all n fragments, and of n hits of paths, to buffers.visibility: after their lights were asked. */
int hooks_light(struct job *job, uint32_t transport, uint32_t n);
int hooks_light_hits(struct job *job, uint32_t transport, uint32_t n);

/** What n rays of hook_rays.h hit becomes their pixels' surface. */
int hooks_see(struct job *job, uint32_t n);
