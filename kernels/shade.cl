/* gather, shade, shadow_ray, mirror_ray, hit_ray, shade_hit: see kernels/gl_stages.h. */
#include "kernels/gl_stages.h"

__kernel void gather(__global const struct fragment *sparse, __global const uint32_t *counts, uint32_t slots,
                     __global const uint32_t *first, __global struct fragment *list, __global uint32_t *pixels,
                     __global uint32_t *after, struct camera_rectangle rectangle, uint32_t width, uint32_t n)
{
	if (get_global_id(0) < n)
		gather_item(sparse, counts, slots, first, list, pixels, after,
		            stage_pixel(rectangle, width, (uint32_t)get_global_id(0)));
}

__kernel void shade(TABLES_ARGUMENTS, __global const struct view *views, __global const struct window_vertex *windows,
                    __global struct fragment *fragments, __global const uint32_t *pixels, uint32_t width,
                    uint32_t height, uint32_t bits, __global const uint32_t *stopped, uint32_t n_slots, uint32_t n,
                    __global struct shaded *shaded)
{
	struct tables t = TABLES_NAMED;

	if (get_global_id(0) < n)
		shade_item(&t, views, windows, fragments, pixels, width, height, bits, stopped, n_slots, n, shaded,
		           (uint32_t)get_global_id(0));
}

__kernel void shadow_ray(TABLES_ARGUMENTS, __global const struct view *views,
                         __global const struct window_vertex *windows, __global const struct fragment *fragments,
                         __global const uint32_t *pixels, uint32_t width, __global const struct shaded *shaded,
                         uint32_t n, uint32_t n_rays, __global struct ray *rays)
{
	struct tables t = TABLES_NAMED;

	if (get_global_id(0) < n_rays)
		shadow_ray_item(&t, views, windows, fragments, pixels, width, shaded, n, rays, (uint32_t)get_global_id(0));
}

__kernel void mirror_ray(TABLES_ARGUMENTS, __global const struct view *views,
                         __global const struct window_vertex *windows, __global const struct fragment *fragments,
                         __global const uint32_t *pixels, uint32_t width, uint32_t n, __global struct shaded *shaded,
                         __global struct ray *rays, __global float *shares)
{
	struct tables t = TABLES_NAMED;

	if (get_global_id(0) < n)
		mirror_ray_item(&t, views, windows, fragments, pixels, width, shaded, rays, shares,
		                (uint32_t)get_global_id(0));
}

__kernel void hit_ray(TABLES_ARGUMENTS, __global const struct hit *hits, __global const struct ray *rays,
                      __global const uint32_t *wanted, uint32_t n, uint32_t n_rays, __global struct ray *out)
{
	struct tables t = TABLES_NAMED;

	if (get_global_id(0) < n_rays)
		hit_ray_item(&t, hits, rays, wanted, n, out, (uint32_t)get_global_id(0));
}

__kernel void shade_hit(TABLES_ARGUMENTS, __global const struct hit *hits, uint32_t finish, uint32_t last,
                        __global const uint32_t *stopped, uint32_t n_slots, uint32_t n,
                        __global const float *background, __global uint32_t *wanted, __global struct ray *rays,
                        __global float *shares, __global struct shaded *shaded)
{
	struct tables t = TABLES_NAMED;

	if (get_global_id(0) < n)
		shade_hit_item(&t, hits, finish, last, stopped, n_slots, n, background, wanted, rays, shares, shaded,
		               (uint32_t)get_global_id(0));
}
