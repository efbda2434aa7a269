/* Buffers of this room, except those of dome.h. */
#pragma once

#include "tracer/frame/common/frame.h"

/* X(element, name): those of a band. */
#define LIGHT_BUFFERS(X) \
	X(ray, rays) X(uint, occluded) X(float, visibility) X(uint, wanted) X(float, background) \
	X(uint, places) X(uint, scan) \
	X(path, paths) X(ray, path_rays) X(hit, path_hits) X(path, next_paths) X(ray, next_path_rays) X(uint, next_counts) \
	X(ray, sky_rays) X(hit, sky_hits) X(float, radiance) X(photon, photons) \
	X(path, shadow_paths) X(ray, shadow_rays) X(hit, shadow_hits) X(hit, shadow_last) X(path, next_shadow_paths) \
	X(ray, next_shadow_rays)
struct light_buffers {
	union buffer_emitter emitters; /* kept for the frame */
	LIGHT_BUFFERS(FRAME_FIELD)
};
