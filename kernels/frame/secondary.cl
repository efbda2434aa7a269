/* Rays from fragments and hits: see kernels/frame/secondary.h. */
#include "kernels/frame/secondary.h"

__kernel void shadow_ray(TABLES_ARGUMENTS, __global const struct view *views,
                         __global const struct window_vertex *windows, __global const struct fragment *fragments,
                         __global const uint32_t *pixels, uint32_t width, __global const struct shaded *shaded,
                         uint32_t sample, uint32_t n, uint32_t n_rays, __global struct ray *rays)
{
	struct tables t = TABLES_NAMED;
	struct stage_kept_plane kept;

	if (get_global_id(0) < n_rays)
		shadow_ray_item(&t, views, windows, fragments, pixels, width, shaded, sample, n, rays,
		                (uint32_t)get_global_id(0), 0, &kept);
}

__kernel void hit_ray(TABLES_ARGUMENTS, __global const struct hit *hits, __global const struct ray *rays,
                      __global const struct path *paths, __global const uint32_t *pixels,
                      __global const uint32_t *wanted, uint32_t sample, uint32_t n, uint32_t n_rays,
                      __global struct ray *out)
{
	struct tables t = TABLES_NAMED;

	if (get_global_id(0) < n_rays)
		hit_ray_item(&t, hits, rays, paths, pixels, wanted, sample, n, out, (uint32_t)get_global_id(0));
}

__kernel void ao_ray(TABLES_ARGUMENTS, __global const struct view *views, __global const struct window_vertex *windows,
                     __global const struct fragment *fragments, __global const uint32_t *pixels, uint32_t width,
                     __global const struct shaded *shaded, uint32_t sample, float reach, uint32_t n,
                     __global struct ray *rays)
{
	struct tables t = TABLES_NAMED;

	if (get_global_id(0) < n)
		ao_ray_item(&t, views, windows, fragments, pixels, width, shaded, sample, reach, rays,
		            (uint32_t)get_global_id(0));
}

__kernel void shadow_sum(__global const uint32_t *stopped, float weight, uint32_t first, uint32_t n,
                         __global float *arriving)
{
	if (get_global_id(0) < n)
		shadow_sum_item(stopped, weight, first, arriving, (uint32_t)get_global_id(0));
}

__kernel void shadow_start(__global const uint32_t *stopped, __global const uint32_t *places,
                           __global const struct ray *rays, float weight, uint32_t n, __global struct ray *walk_rays,
                           __global struct path *walkers)
{
	if (get_global_id(0) < n)
		shadow_start_item(stopped, places, rays, weight, walk_rays, walkers, (uint32_t)get_global_id(0));
}

__kernel void shadow_walk(TABLES_ARGUMENTS, __global const struct hit *hits, __global const struct ray *rays,
                          __global const struct path *walkers, uint32_t n, __global float *arriving,
                          __global struct ray *next_rays, __global struct path *next, __global uint32_t *counts)
{
	struct tables t = TABLES_NAMED;

	if (get_global_id(0) < n)
		shadow_walk_item(&t, hits, rays, walkers, arriving, next_rays, next, counts, (uint32_t)get_global_id(0));
}

__kernel void gather_paths(__global const struct ray *next_rays, __global const struct path *next,
                           __global const uint32_t *counts, __global const uint32_t *places, uint32_t slots, uint32_t n,
                           __global struct ray *rays, __global struct path *paths)
{
	if (get_global_id(0) < n)
		gather_paths_item(next_rays, next, counts, places, slots, rays, paths, (uint32_t)get_global_id(0));
}

__kernel void leave(TABLES_ARGUMENTS, __global const struct view *views, __global const struct window_vertex *windows,
                    __global const struct fragment *fragments, __global const uint32_t *pixels, uint32_t width,
                    uint32_t transport, uint32_t sample, uint32_t n, __global struct shaded *shaded,
                    __global struct ray *next_rays, __global struct path *next, __global uint32_t *counts)
{
	struct tables t = TABLES_NAMED;

	if (get_global_id(0) < n)
		leave_item(&t, views, windows, fragments, pixels, width, transport, sample, shaded, next_rays, next, counts,
		           (uint32_t)get_global_id(0));
}

__kernel void sky_ray(__global const struct hit *hits, __global const struct ray *rays, uint32_t n,
                      __global struct ray *out)
{
	if (get_global_id(0) < n)
		sky_ray_item(hits, rays, out, (uint32_t)get_global_id(0));
}

__kernel void want_lights(TABLES_ARGUMENTS, __global const struct hit *hits, __global const struct ray *rays,
                          uint32_t transport, uint32_t n, __global uint32_t *wanted)
{
	struct tables t = TABLES_NAMED;

	if (get_global_id(0) < n)
		want_lights_item(&t, hits, rays, transport, wanted, (uint32_t)get_global_id(0));
}

__kernel void shade_hit(TABLES_ARGUMENTS, __global const struct hit *hits, __global const struct hit *sky,
                        uint32_t has_sky, __global const struct ray *rays, __global const struct path *paths,
                        __global const uint32_t *pixels, __global const float *arriving, uint32_t n_slots,
                        uint32_t transport, uint32_t sample, uint32_t depth, __global const float *background,
                        uint32_t n, __global float *given, __global struct ray *next_rays, __global struct path *next,
                        __global uint32_t *counts)
{
	struct tables t = TABLES_NAMED;

	if (get_global_id(0) < n)
		shade_hit_item(&t, hits, sky, has_sky, rays, paths, pixels, arriving, n_slots, transport, sample, depth,
		               background, n, given, next_rays, next, counts, (uint32_t)get_global_id(0));
}

__kernel void credit(__global const struct path *paths, __global const float *given, uint32_t n,
                     __global struct shaded *shaded)
{
	if (get_global_id(0) < n)
		credit_item(paths, given, n, shaded, (uint32_t)get_global_id(0));
}

__kernel void ao_shade(__global const float *arriving, uint32_t over_gl, uint32_t n, __global struct shaded *shaded)
{
	if (get_global_id(0) < n)
		ao_shade_item(arriving, over_gl, shaded, (uint32_t)get_global_id(0));
}
