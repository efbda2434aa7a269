#include "tracer/frame/light/secondary.h"

#include <stdlib.h>

#include "base/err.h"
#include "kernels/rays/opacity.h"
#include "tracer/frame/hook/hook_objects.h"
#include "tracer/frame/hook/hooks.h"
#include "tracer/frame/light/buffers.h"
#include "tracer/frame/light/emitters.h"
#include "tracer/frame/light/scan.h"
#include "tracer/frame/place/opacity.h"

/* Most transmitting surfaces in a row that a ray to a light may pass, besides its bounces. */
#define MOST_LAYERS 32u

const struct accel_space *secondary_space(const struct frame *frame, uint32_t view, int sky)
{
	for (uint32_t i = 0; i < frame->n_spaces; i++)
		if (frame->spaces[i].space == frame->prepared.scene_views[view].space && frame->spaces[i].sky == sky &&
		    (frame->spaces[i].n_nodes || hook_objects_in(frame, &frame->spaces[i])))
			return &frame->spaces[i];
	return NULL;
}

uint32_t secondary_transport(const struct tracer_options *options)
{
	if (options->mode == TRACER_PATH)
		return options->display ? TRANSPORT_PATH : TRANSPORT_LINEAR;
	if (options->mode == TRACER_DIFFUSE)
		return TRANSPORT_DIFFUSE;
	return options->relight ? TRANSPORT_RELIGHT : TRANSPORT_GL;
}

/* The frame number that scrambles samples in mode path; 0: all frames use the same samples. */
static uint32_t frame_number(const struct frame *frame)
{
	return frame->options->mode == TRACER_PATH ? (uint32_t)frame->scene->frame + 1 : 0;
}

/* Number of work items for kernels that process SHADE_PACKET items each. */
static uint32_t packs(uint32_t n)
{
	return (n + SHADE_PACKET - 1) / SHADE_PACKET;
}

/* Find which rays hit anything in a space. */
static int occlude(const struct frame *frame, const struct accel_space *space, const struct light_rays *rays,
                   union buffer_uint occluded)
{
	const struct traverse_rays r = { .space = space, .n = rays->n, .to_lights = rays->to_lights, .rays = rays->rays,
		                         .occluded = occluded };
	struct device *dev = frame->tr->dev;
	int err = space->n_nodes ?
	                  traverse_rays(dev, traverse_families[device_family(dev)].occlude, &frame->tr->trees, &r) :
	                  0;

	return err || !hook_objects_in(frame, space) ? err : hook_objects_occlude(frame, &r);
}

/* Find the nearest hits of rays. whose: kind of rays */
static int intersect(const struct frame *frame, enum hook_rays_of whose, struct traverse_rays r)
{
	struct device *dev = frame->tr->dev;
	int err = r.space->n_nodes ?
	                  traverse_rays(dev, traverse_families[device_family(dev)].intersect, &frame->tr->trees, &r) :
	                  0;

	return err || !hook_objects_in(frame, r.space) ? err : hook_objects_intersect(frame, &r, whose);
}

/* --- Lists ------------------------------------------------------------------------------------------------------- */

/* A list of paths and their rays, and room for the next list. */
struct list {
	union buffer_path *paths, *next_paths;
	union buffer_ray *rays, *next_rays;
};

static struct list list_of_paths(const struct frame *frame)
{
	struct light_buffers *b = frame->tr->light;

	return (struct list){ &b->paths, &b->next_paths, &b->path_rays, &b->next_path_rays };
}

/* The list of rays to lights that continue beyond the surface that stopped them. */
static struct list list_of_shadows(const struct frame *frame)
{
	struct light_buffers *b = frame->tr->light;

	return (struct list){ &b->shadow_paths, &b->next_shadow_paths, &b->shadow_rays, &b->next_shadow_rays };
}

/* The same n paths for other rooms. */
static struct path_list path_list(const struct frame *frame, const struct list *list, union buffer_hit hits, uint32_t n)
{
	return (struct path_list){ *list->paths, *list->next_paths, *list->rays, *list->next_rays, hits,
		                   frame->tr->light->next_counts, n };
}

static int reserve_list(const struct frame *frame, const struct list *list, size_t n)
{
	int err = launch_reserve(frame->tr->dev, *list->paths, n);

	return err ? err : launch_reserve(frame->tr->dev, *list->rays, n);
}

static int reserve_next(const struct frame *frame, const struct list *list, size_t n)
{
	int err = launch_reserve(frame->tr->dev, *list->next_paths, n);

	return err ? err : launch_reserve(frame->tr->dev, *list->next_rays, n);
}

/* Compute the positions of n items' results in a dense list from their counts, into buffers.places. */
static int place(const struct frame *frame, union buffer_uint counts, uint32_t n, uint32_t *total)
{
	struct tracer *tr = frame->tr;

	return scan_counts(tr->dev,
	                   &(const struct scan_list){ counts, n, SCENE_NONE, &tr->light->places, &tr->light->scan },
	                   total, NULL);
}

/* Replace a list by the results of its n paths, up to `slots` each. */
static int gather_list(const struct frame *frame, const struct list *list, uint32_t slots, uint32_t *n)
{
	struct light_buffers *b = frame->tr->light;
	uint32_t from = *n;
	int err = place(frame, b->next_counts, from, n);

	if (err || *n == 0)
		return err;
	err = reserve_list(frame, list, *n);
	if (err)
		return err;
	return launch_gather_paths(frame->tr->dev, from,
	                           LAUNCH(gather_paths, .next_rays = *list->next_rays, .next_paths = *list->next_paths,
	                                  .counts = b->next_counts, .places = b->places, .slots = slots, .n = from,
	                                  .rays = *list->rays, .paths = *list->paths));
}

/* --- Rays to lights ---------------------------------------------------------------------------------------------- */

static int start_walk(const struct frame *frame, const struct list *list, union buffer_ray rays, uint32_t n_rays,
                      float weight, uint32_t *n)
{
	struct tracer *tr = frame->tr;
	struct light_buffers *b = tr->light;
	int err = place(frame, b->occluded, n_rays, n);

	if (err || *n == 0)
		return err;
	err = reserve_list(frame, list, *n);
	if (!err)
		err = reserve_next(frame, list, *n);
	if (!err)
		err = launch_reserve(tr->dev, tr->light->shadow_hits, *n);
	if (!err)
		err = launch_reserve(tr->dev, tr->light->shadow_last, *n);
	if (!err)
		err = launch_reserve(tr->dev, tr->light->next_counts, *n);
	if (err)
		return err;
	return launch_shadow_start(tr->dev, n_rays,
	                           LAUNCH(shadow_start, .occluded = b->occluded, .places = b->places, .rays = rays,
	                                  .weight = weight, .n = n_rays, .shadow_rays = *list->rays,
	                                  .shadow_paths = *list->paths));
}

static int walk_hooks(const struct frame *frame, const struct list *list, uint32_t n)
{
	const struct path_list walks = path_list(frame, list, frame->tr->light->shadow_hits, n);

	return hooks_walk(frame, secondary_transport(frame->options), &walks);
}

/* The rays that go on, and the hits that they continue behind. */
static int gather_walks(const struct frame *frame, const struct list *list, uint32_t *n)
{
	struct light_buffers *b = frame->tr->light;
	const uint32_t from = *n;
	int err = gather_list(frame, list, 1, n);

	return err || *n == 0 ? err :
	                        launch_gather_hits(frame->tr->dev, from,
	                                           LAUNCH(gather_hits, .hits = b->shadow_hits, .counts = b->next_counts,
	                                                  .places = b->places, .n = from, .last = b->shadow_last));
}

/* Continue those of the rays that shadow_sum left as stopped, through transmitting surfaces one after another. */
static int walk_layers(const struct frame *frame, const struct accel_space *space, const struct light_rays *to,
                       float weight)
{
	struct tracer *tr = frame->tr;
	struct light_buffers *b = tr->light;
	const struct list list = list_of_shadows(frame);
	uint32_t n;
	int err = start_walk(frame, &list, to->rays, to->n, weight, &n);

	for (uint32_t i = 0; i < MOST_LAYERS && n && !err; i++) {
		const union buffer_hit none = { 0 };

		err = intersect(frame, HOOK_RAYS_TO_LIGHTS,
		                (struct traverse_rays){ .space = space, .n = n, .rays = *list.rays,
		                                        .last = i ? b->shadow_last : none, .hits = b->shadow_hits });
		if (!err)
			err = launch_shadow_walk(tr->dev, n,
			                         LAUNCH(shadow_walk, .tables = frame_tables(tr), .hits = b->shadow_hits,
			                                .rays = *list.rays, .paths = *list.paths,
			                                .to_lights = to->to_lights, .least = weight * OPACITY_LEAST,
			                                .after = i > 0, .last = b->shadow_last, .n = n, .visibility = to->visibility,
			                                .next_rays = *list.next_rays, .next_paths = *list.next_paths,
			                                .counts = b->next_counts));
		if (!err && hooks_has(frame, HOOK_ANY_HIT))
			err = walk_hooks(frame, &list, n);
		if (!err)
			err = gather_walks(frame, &list, &n);
	}
	return err;
}

/* Trace one of `samples` rounds of rays. */
static int ask(const struct frame *frame, const struct accel_space *space, const struct light_rays *r, uint32_t sample,
               uint32_t samples)
{
	struct light_buffers *b = frame->tr->light;
	const int asks = hooks_has(frame, HOOK_ANY_HIT), transparent = frame->prepared.has_transparency,
		  through = asks || (transparent && !opacity_is_known(frame, space));
	float weight = 1.0f / (float)samples;
	int err = occlude(frame, space, r, b->occluded);

	if (!err)
		err = launch_shadow_sum(frame->tr->dev, r->n,
		                        LAUNCH(shadow_sum, .rays = r->rays, .weight = weight, .first = sample == 0,
		                               .through = (uint32_t)through, .n = r->n, .occluded = b->occluded,
		                               .visibility = r->visibility));
	return err || !(r->to_lights || transparent || asks) ? err : walk_layers(frame, space, r, weight);
}

int secondary_reserve_rays(const struct frame *frame, size_t n_rays, union buffer_float *visibility,
                           struct light_rays *out)
{
	struct tracer *tr = frame->tr;
	union buffer_float *to = visibility ? visibility : &tr->light->visibility;
	int err = launch_reserve(tr->dev, tr->light->rays, n_rays);

	if (!err)
		err = launch_reserve(tr->dev, tr->light->occluded, n_rays);
	if (!err)
		err = launch_reserve(tr->dev, *to, 3 * n_rays);
	*out = (struct light_rays){ tr->light->rays, *to, (uint32_t)n_rays, 1 };
	return err;
}

int secondary_ask(const struct frame *frame, const struct accel_space *space, const struct light_rays *rays)
{
	return ask(frame, space, rays, 0, 1);
}

/* Rays to each light per pass. */
static uint32_t rays_per_light(const struct frame *frame)
{
	uint32_t wide = 0;

	for (uint32_t i = 0; i < frame->scene->n_lights; i++)
		wide |= frame->scene->lights[i].radius > 0;
	return wide && frame->options->mode != TRACER_PATH ? frame->options->rays : 1;
}

int secondary_shadows(const struct pass *pass, const struct accel_space *space, const struct fragment_list *from,
                      union buffer_float *visibility)
{
	const struct frame *frame = pass->frame;
	struct tracer *tr = frame->tr;
	struct light_buffers *b = tr->light;
	const uint32_t n = from->n, n_rays = frame->prepared.n_light_slots * n, samples = rays_per_light(frame);
	struct light_rays rays;
	int err = secondary_reserve_rays(frame, n_rays, NULL, &rays);

	for (uint32_t i = 0; i < samples && !err; i++) {
		const struct shadow_ray_launch *a = LAUNCH(
			shadow_ray, .tables = frame_tables(tr), .views = tr->placed.views,
			.windows = tr->placed.windows, .fragments = from->fragments, .pixels = from->pixels,
			.width = frame->width, .shaded = from->shaded, .sample = pass->number * samples + i,
			.frame = frame_number(frame), .n = n, .n_rays = n_rays, .rays = b->rays);

		if (frame_in_packets(frame))
			err = launch_shadow_ray_packet(tr->dev, packs(n_rays), a);
		else
			err = launch_shadow_ray(tr->dev, n_rays, a);
		if (!err)
			err = ask(frame, space, &rays, i, samples);
	}
	*visibility = rays.visibility;
	return err || !hooks_has(frame, HOOK_LIGHT) ?
	               err :
	               hooks_light(frame, secondary_transport(frame->options), from, &rays);
}

/* The same from the hits of n paths. */
static int trace_hit_shadows(const struct pass *pass, const struct accel_space *space, const struct path_list *paths,
                             union buffer_uint pixels)
{
	const struct frame *frame = pass->frame;
	struct tracer *tr = frame->tr;
	struct light_buffers *b = tr->light;
	const struct emission_launch emission = emitters_of(frame, space);
	const uint32_t n = paths->n, transport = secondary_transport(frame->options);
	const uint32_t n_rays = frame->prepared.n_light_slots * n, samples = (rays_per_light(frame) + 3) / 4,
		       all = n_rays + (emission.n_emitters ? n : 0);
	const int packets = frame_in_packets(frame);
	struct light_rays rays;
	int err = secondary_reserve_rays(frame, all, NULL, &rays);

	if (!err)
		err = launch_reserve(tr->dev, tr->light->wanted, n);
	if (!err && !packets)
		err = launch_want_lights(tr->dev, n,
		                         LAUNCH(want_lights, .tables = frame_tables(tr), .hits = paths->hits,
		                                .rays = paths->rays, .transport = transport, .n = n,
		                                .wanted = b->wanted));
	for (uint32_t i = 0; i < samples && !err; i++) {
		const struct hit_ray_launch *a = LAUNCH(
			hit_ray, .tables = frame_tables(tr), .hits = paths->hits, .rays = paths->rays,
			.paths = paths->paths, .pixels = pixels, .wanted = b->wanted, .transport = transport,
			.sample = pass->number * samples + i, .frame = frame_number(frame), .n = n, .n_rays = n_rays,
			.out = b->rays);

		err = packets ? launch_hit_ray_packet(tr->dev, packs(n), a) : launch_hit_ray(tr->dev, n_rays, a);
		if (!err && all > n_rays)
			err = launch_bounce_ray(tr->dev, n,
			                        LAUNCH(bounce_ray, .tables = frame_tables(tr), .hits = paths->hits,
			                               .rays = paths->rays, .paths = paths->paths, .pixels = pixels,
			                               .emission = emission, .sample = pass->number,
			                               .frame = frame_number(frame), .depth = frame->options->depth,
			                               .first = n_rays, .n = n, .out = b->rays));
		if (!err)
			err = ask(frame, space, &rays, i, samples);
	}
	return err || !hooks_has(frame, HOOK_LIGHT) ? err : hooks_light_hits(frame, transport, paths, &rays);
}

/* --- Openness ---------------------------------------------------------------------------------------------------- */

int secondary_openness(const struct pass *pass, const struct accel_space *space, const struct fragment_list *from)
{
	const struct frame *frame = pass->frame;
	struct tracer *tr = frame->tr;
	struct light_buffers *b = tr->light;
	const uint32_t n = from->n, samples = frame->options->rays;
	struct light_rays rays;
	int err = secondary_reserve_rays(frame, n, NULL, &rays);

	rays.to_lights = 0;
	for (uint32_t i = 0; i < samples && !err; i++) {
		err = launch_ao_ray(tr->dev, n,
		                    LAUNCH(ao_ray, .tables = frame_tables(tr), .views = tr->placed.views,
		                           .windows = tr->placed.windows, .fragments = from->fragments,
		                           .pixels = from->pixels, .width = frame->width, .shaded = from->shaded,
		                           .sample = pass->number * samples + i,
		                           .reach = frame->options->reach > 0 ? frame->options->reach : 1e30f, .n = n,
		                           .rays = b->rays));
		if (!err)
			err = ask(frame, space, &rays, i, samples);
	}
	if (err)
		return err;
	return launch_ao_shade(tr->dev, n,
	                       LAUNCH(ao_shade, .visibility = b->visibility,
	                              .over_gl = frame->options->mode == TRACER_AO_PHONG, .n = n,
	                              .shaded = from->shaded));
}

/* --- Paths ------------------------------------------------------------------------------------------------------- */

/* Find the emissive surfaces that each of n fragments sees, into the room's visibility. */
static int ask_emitters(const struct pass *pass, const struct accel_space *space, const struct fragment_list *from)
{
	const struct frame *frame = pass->frame;
	struct tracer *tr = frame->tr;
	struct light_buffers *b = tr->light;
	const struct emission_launch emission = emitters_of(frame, space);
	const uint32_t n = from->n;
	struct light_rays rays;
	int err = emission.n_emitters ? secondary_reserve_rays(frame, n, NULL, &rays) : 0;

	if (err || !emission.n_emitters)
		return err;
	err = launch_leave_ray(tr->dev, n,
	                       LAUNCH(leave_ray, .tables = frame_tables(tr), .views = tr->placed.views,
	                              .windows = tr->placed.windows, .fragments = from->fragments,
	                              .pixels = from->pixels, .width = frame->width, .shaded = from->shaded,
	                              .emission = emission, .sample = pass->number, .frame = frame_number(frame),
	                              .n = n, .rays = b->rays));
	return err ? err : ask(frame, space, &rays, 0, 1);
}

static int leave(const struct pass *pass, const struct list *list, const struct accel_space *space,
                 const struct fragment_list *from)
{
	const struct frame *frame = pass->frame;
	struct tracer *tr = frame->tr;
	struct light_buffers *b = tr->light;
	const uint32_t n = from->n, transport = secondary_transport(frame->options);
	const struct leave_launch *a;
	int err = reserve_next(frame, list, (size_t)PATHS_PER_FRAGMENT * n);

	if (!err)
		err = launch_reserve(tr->dev, tr->light->next_counts, n);
	if (err)
		return err;
	a = LAUNCH(leave, .tables = frame_tables(tr), .views = tr->placed.views, .windows = tr->placed.windows,
	           .fragments = from->fragments, .pixels = from->pixels, .width = frame->width, .transport = transport,
	           .sample = pass->number, .frame = frame_number(frame), .emission = emitters_of(frame, space),
	           .visibility = b->visibility, .n = n, .shaded = from->shaded, .next_rays = *list->next_rays,
	           .next_paths = *list->next_paths, .counts = b->next_counts);
	return frame_in_packets(frame) ? launch_leave_packet(tr->dev, packs(n), a) : launch_leave(tr->dev, n, a);
}

static int look_at_sky(const struct frame *frame, const struct accel_space *sky, uint32_t n)
{
	struct tracer *tr = frame->tr;
	struct light_buffers *b = tr->light;
	int err = launch_reserve(tr->dev, tr->light->sky_hits, sky ? n : 1);

	if (err || !sky)
		return err;
	err = launch_reserve(tr->dev, tr->light->sky_rays, n);
	if (!err)
		err = launch_sky_ray(
			tr->dev, n,
			LAUNCH(sky_ray, .hits = b->path_hits, .rays = b->path_rays, .n = n, .out = b->sky_rays));
	return err ? err : intersect(frame, HOOK_RAYS_ON,
		                       (struct traverse_rays){ .space = sky, .n = n, .rays = b->sky_rays,
		                                               .hits = b->sky_hits });
}

static int shade_hits(const struct pass *pass, const struct list *list, const struct accel_space *space,
                      uint32_t has_sky, const struct fragment_list *from, uint32_t n)
{
	const struct frame *frame = pass->frame;
	struct tracer *tr = frame->tr;
	struct light_buffers *b = tr->light;
	const uint32_t transport = secondary_transport(frame->options);
	const struct shade_hit_launch *a;
	int err = reserve_next(frame, list, (size_t)PATHS_PER_HIT * n);

	if (!err)
		err = launch_reserve(tr->dev, tr->light->next_counts, n);
	if (!err)
		err = launch_reserve(tr->dev, tr->light->radiance, 3 * (size_t)n);
	if (err)
		return err;
	a = LAUNCH(shade_hit, .tables = frame_tables(tr), .hits = b->path_hits, .sky = b->sky_hits, .has_sky = has_sky,
	           .rays = *list->rays, .paths = *list->paths, .pixels = from->pixels, .visibility = b->visibility,
	           .n_slots = frame->prepared.n_light_slots, .transport = transport, .sample = pass->number,
	           .frame = frame_number(frame), .emission = emitters_of(frame, space), .depth = frame->options->depth,
	           .most = frame->options->clamp, .background = b->background, .shaded = from->shaded, .n = n,
	           .radiance = b->radiance, .next_rays = *list->next_rays, .next_paths = *list->next_paths,
	           .counts = b->next_counts);
	return frame_in_packets(frame) ? launch_shade_hit_packet(tr->dev, packs(n), a) :
	                                 launch_shade_hit(tr->dev, n, a);
}

int secondary_follow(const struct band *band, const struct accel_space *space, const struct accel_space *sky,
                     const struct fragment_list *from, uint32_t slots, int see)
{
	const struct frame *frame = band->frame;
	struct tracer *tr = frame->tr;
	struct light_buffers *b = tr->light;
	const struct list list = list_of_paths(frame);
	const uint32_t transport = secondary_transport(frame->options);
	uint32_t n = from->n;
	int err = launch_upload(tr->dev, b->background, band->background, 4);

	if (!err)
		err = launch_reserve(tr->dev, b->visibility, 3);
	if (!err)
		err = gather_list(frame, &list, slots, &n);
	for (uint32_t i = 0; i < frame->options->depth + MOST_LAYERS && n && !err; i++) {
		struct path_list paths;

		err = launch_reserve(tr->dev, b->path_hits, n);
		paths = path_list(frame, &list, b->path_hits, n);
		if (!err)
			err = intersect(frame, i == 0 && see ? HOOK_RAYS_FIRST : HOOK_RAYS_ON,
			                (struct traverse_rays){ .space = space, .n = n, .rays = paths.rays,
			                                        .hits = paths.hits });
		if (!err && i == 0 && see)
			err = hooks_see(band, &paths, from->pixels);
		if (!err)
			err = look_at_sky(frame, sky, n);
		if (!err && (frame->prepared.n_light_slots || emitters_of(frame, space).n_emitters))
			err = trace_hit_shadows(band->pass, space, &paths, from->pixels);
		if (!err)
			err = shade_hits(band->pass, &list, space, sky != NULL, from, n);
		paths = path_list(frame, &list, b->path_hits, n);
		if (!err && hooks_has(frame, HOOK_ANY_HIT | HOOK_CLOSEST_HIT | HOOK_MISS))
			err = hooks_hit(frame, space, transport, &paths, b->visibility, b->radiance);
		if (!err)
			err = launch_credit(tr->dev, n,
			                    LAUNCH(credit, .paths = paths.paths, .radiance = b->radiance,
			                           .transport = transport, .n = n, .shaded = from->shaded));
		if (!err)
			err = gather_list(frame, &list, PATHS_PER_HIT, &n);
	}
	return err;
}

int secondary_paths(const struct band *band, const struct accel_space *space, const struct accel_space *sky,
                    const struct fragment_list *from)
{
	const struct frame *frame = band->frame;
	const struct list list = list_of_paths(frame);
	int err = launch_reserve(frame->tr->dev, frame->tr->light->visibility, 3);

	if (!err)
		err = ask_emitters(band->pass, space, from);
	if (!err)
		err = leave(band->pass, &list, space, from);
	if (!err && hooks_has(frame, HOOK_ANY_HIT | HOOK_CLOSEST_HIT)) {
		const struct path_list paths = path_list(frame, &list, frame->tr->light->path_hits, from->n);

		err = hooks_ways(frame, secondary_transport(frame->options), from, &paths);
	}
	return err ? err : secondary_follow(band, space, sky, from, PATHS_PER_FRAGMENT, 0);
}

int secondary_reserve_paths(const struct frame *frame, uint32_t n, struct path_list *out)
{
	const struct list list = list_of_paths(frame);
	int err = reserve_next(frame, &list, n);

	if (!err)
		err = launch_reserve(frame->tr->dev, frame->tr->light->next_counts, n);
	*out = path_list(frame, &list, frame->tr->light->path_hits, n);
	return err;
}

/* --- Photons ----------------------------------------------------------------------------------------------------- */

/* Trace n photons to their next hits. photons: room for n */
static int send(const struct frame *frame, const struct list *list, const struct accel_space *space, uint32_t pass,
                uint32_t n, struct photon *photons)
{
	struct tracer *tr = frame->tr;
	struct light_buffers *b = tr->light;
	int err;

	if ((err = launch_reserve(tr->dev, tr->light->path_hits, n)) ||
	    (err = launch_reserve(tr->dev, tr->light->photons, n)) ||
	    (err = launch_reserve(tr->dev, tr->light->next_counts, n)) ||
	    (err = reserve_next(frame, list, (size_t)PATHS_PER_HIT * n)) ||
	    (err = intersect(frame, HOOK_RAYS_ON,
	                     (struct traverse_rays){ .space = space, .n = n, .rays = *list->rays,
	                                             .hits = b->path_hits })) ||
	    (err = launch_photon(tr->dev, n,
	                         LAUNCH(photon, .tables = frame_tables(tr), .hits = b->path_hits, .rays = *list->rays,
	                                .paths = *list->paths, .depth = frame->options->depth, .pass = pass, .n = n,
	                                .photons = b->photons, .next_rays = *list->next_rays,
	                                .next_paths = *list->next_paths, .counts = b->next_counts))))
		return err;
	return device_read(tr->dev, b->photons.buffer, 0, photons, n * sizeof(*photons));
}

int secondary_photons(const struct frame *frame, const struct accel_space *space, uint32_t pass, uint32_t n,
                      void (*take)(void *user, const struct photon *photons, uint32_t n), void *user)
{
	const struct list list = list_of_paths(frame);
	struct photon *photons = malloc(((size_t)n + 1) * sizeof(*photons));
	int err = photons ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory for %u photons", n);

	while (n && !err) {
		err = send(frame, &list, space, pass, n, photons);
		if (err)
			break;
		take(user, photons, n);
		err = gather_list(frame, &list, PATHS_PER_HIT, &n);
	}
	free(photons);
	return err;
}
