/* Rays from the fragments of the list: to the lights, into the surroundings, from mirror to mirror and through glass. */
#include "kernels/rays/rays.h"
#include "tracer/frame/frame.h"
#include "tracer/frame/scan.h"

/* Surfaces that let light pass, one behind the other, that a ray may meet beside its bounces. */
#define MOST_VEILS 32u

const struct accel_space *space_of_view(const struct job *job, uint32_t view, int sky)
{
	for (uint32_t i = 0; i < job->n_spaces; i++)
		if (job->spaces[i].space == job->prepared.scene_views[view].space && job->spaces[i].sky == sky &&
		    job->spaces[i].n_nodes)
			return &job->spaces[i];
	return NULL;
}

uint32_t transport_of(const struct tracer_options *options)
{
	if (options->mode == TRACER_PATH)
		return TRANSPORT_PATH;
	if (options->mode == TRACER_DIFFUSE)
		return TRANSPORT_DIFFUSE;
	return options->relight ? TRANSPORT_RELIGHT : TRANSPORT_GL;
}

/* Kernels for any hit and for the nearest, and what they walk. */
static const struct {
	enum device_kernel occlude, intersect;
	uint32_t rays_per_item;
	enum buffer top, nodes, triangles;
} ray_kernels[N_DEVICE_FAMILIES] = {
	[FAMILY_PACKETS] = { KERNEL_occlude_packet, KERNEL_intersect_packet, RAYS_PER_ITEM, BUFFER_TOP8, BUFFER_NODES8,
		             BUFFER_TRIANGLES8 },
	[FAMILY_BINARY] = { KERNEL_occlude_binary, KERNEL_intersect_binary, 1, BUFFER_TOP2, BUFFER_NODES2, BUFFER_TRIANGLES },
	[FAMILY_COMPRESSED] = { KERNEL_occlude_compressed, KERNEL_intersect_compressed, 1, BUFFER_TOP2, BUFFER_NODES8C,
		                BUFFER_TRIANGLES8C },
};

/* Trace n rays through a space, for any hit or for the nearest. */
static int trace_rays(struct job *job, const struct accel_space *space, enum buffer rays, enum buffer results, uint32_t n,
                      int occlude)
{
	struct tracer *tr = job->tr;
	enum device_family family = device_family(tr->dev);
	uint32_t top = family == FAMILY_PACKETS ? space->top8_first : space->top2_first;
	uint32_t rays_per_item = ray_kernels[family].rays_per_item;
	struct launch l = { .n = 0 };

	add_uint(&l, &n);
	add(&l, tr, rays);
	add_uint(&l, &top);
	add(&l, tr, ray_kernels[family].top);
	add(&l, tr, BUFFER_INSTANCE_LIST);
	add(&l, tr, BUFFER_INSTANCES);
	add(&l, tr, ray_kernels[family].nodes);
	add(&l, tr, ray_kernels[family].triangles);
	add(&l, tr, results);
	return run(tr, occlude ? ray_kernels[family].occlude : ray_kernels[family].intersect,
	           (n + rays_per_item - 1) / rays_per_item, &l);
}

/* --- Lists -------------------------------------------------------------------------------------------------------- */

/* Two buffers of paths and their rays: the list, and places for what comes of it. */
struct list {
	enum buffer paths, rays, next_paths, next_rays;
};

static const struct list path_list = { BUFFER_PATHS, BUFFER_PATH_RAYS, BUFFER_NEXT_PATHS, BUFFER_NEXT_RAYS };
static const struct list walk_list = { BUFFER_WALKERS, BUFFER_WALK_RAYS, BUFFER_NEXT_WALKERS, BUFFER_NEXT_WALK_RAYS };

static int reserve_list(struct job *job, enum buffer paths, enum buffer rays, size_t n)
{
	int err = reserve(job->tr, paths, n, sizeof(struct path));

	return err ? err : reserve(job->tr, rays, n, sizeof(struct ray));
}

/* Where n items' results go when they stand densely: BUFFER_PLACES, from a buffer of their counts. */
static int place(struct job *job, enum buffer counts, uint32_t n, uint32_t *total)
{
	struct tracer *tr = job->tr;

	return scan_counts(tr->dev, tr->buffers[counts], n, &tr->buffers[BUFFER_PLACES], &tr->buffers[BUFFER_SCAN], total);
}

/* What came of a list's n paths, up to `slots` each, becomes the list. */
static int gather_list(struct job *job, const struct list *list, uint32_t slots, uint32_t *n)
{
	struct tracer *tr = job->tr;
	struct launch l = { .n = 0 };
	uint32_t from = *n;
	int err = place(job, BUFFER_NEXT_COUNTS, from, n);

	if (err || *n == 0)
		return err;
	err = reserve_list(job, list->paths, list->rays, *n);
	if (err)
		return err;
	add(&l, tr, list->next_rays);
	add(&l, tr, list->next_paths);
	add(&l, tr, BUFFER_NEXT_COUNTS);
	add(&l, tr, BUFFER_PLACES);
	add_uint(&l, &slots);
	add_uint(&l, &from);
	add(&l, tr, list->rays);
	add(&l, tr, list->paths);
	return run(tr, KERNEL_gather_paths, from, &l);
}

/* --- Rays to lights ----------------------------------------------------------------------------------------------- */

static int start_walk(struct job *job, uint32_t n_rays, float weight, uint32_t *n)
{
	struct tracer *tr = job->tr;
	struct launch l = { .n = 0 };
	int err = place(job, BUFFER_STOPPED, n_rays, n);

	if (err || *n == 0)
		return err;
	err = reserve_list(job, walk_list.paths, walk_list.rays, *n);
	if (!err)
		err = reserve_list(job, walk_list.next_paths, walk_list.next_rays, *n);
	if (!err)
		err = reserve(tr, BUFFER_WALK_HITS, *n, sizeof(struct hit));
	if (!err)
		err = reserve(tr, BUFFER_NEXT_COUNTS, *n, sizeof(uint32_t));
	if (err)
		return err;
	add(&l, tr, BUFFER_STOPPED);
	add(&l, tr, BUFFER_PLACES);
	add(&l, tr, BUFFER_RAYS);
	add_bytes(&l, &weight, sizeof(weight));
	add_uint(&l, &n_rays);
	add(&l, tr, walk_list.rays);
	add(&l, tr, walk_list.paths);
	return run(tr, KERNEL_shadow_start, n_rays, &l);
}

/* The stopped ones of n_rays rays go on through what lets light pass, from surface to surface. */
static int walk_veils(struct job *job, const struct accel_space *space, uint32_t n_rays, float weight)
{
	struct tracer *tr = job->tr;
	uint32_t n;
	int err = start_walk(job, n_rays, weight, &n);

	for (uint32_t i = 0; i < MOST_VEILS && n && !err; i++) {
		struct launch l = launch_with_tables(tr);

		err = trace_rays(job, space, walk_list.rays, BUFFER_WALK_HITS, n, 0);
		if (err)
			return err;
		add(&l, tr, BUFFER_WALK_HITS);
		add(&l, tr, walk_list.rays);
		add(&l, tr, walk_list.paths);
		add_uint(&l, &n);
		add(&l, tr, BUFFER_ARRIVING);
		add(&l, tr, walk_list.next_rays);
		add(&l, tr, walk_list.next_paths);
		add(&l, tr, BUFFER_NEXT_COUNTS);
		err = run(tr, KERNEL_shadow_walk, n, &l);
		if (!err)
			err = gather_list(job, &walk_list, 1, &n);
	}
	return err;
}

/* One of `samples` rounds of n_rays rays, already made, into BUFFER_ARRIVING. */
static int ask_lights(struct job *job, const struct accel_space *space, uint32_t n_rays, uint32_t sample,
                      uint32_t samples)
{
	struct tracer *tr = job->tr;
	struct launch l = { .n = 0 };
	uint32_t first = sample == 0;
	float weight = 1.0f / (float)samples;
	int err = trace_rays(job, space, BUFFER_RAYS, BUFFER_STOPPED, n_rays, 1);

	if (err)
		return err;
	add(&l, tr, BUFFER_STOPPED);
	add_bytes(&l, &weight, sizeof(weight));
	add_uint(&l, &first);
	add_uint(&l, &n_rays);
	add(&l, tr, BUFFER_ARRIVING);
	err = run(tr, KERNEL_shadow_sum, n_rays, &l);
	return err || !job->prepared.has_veils ? err : walk_veils(job, space, n_rays, weight);
}

static int reserve_light_rays(struct job *job, size_t n_rays)
{
	struct tracer *tr = job->tr;
	int err = reserve(tr, BUFFER_RAYS, n_rays, sizeof(struct ray));

	if (!err)
		err = reserve(tr, BUFFER_STOPPED, n_rays, sizeof(uint32_t));
	if (!err)
		err = reserve(tr, BUFFER_ARRIVING, n_rays, 3 * sizeof(float));
	return err;
}

/* Rays to each light a pass. */
static uint32_t light_rays(const struct job *job)
{
	uint32_t wide = 0;

	for (uint32_t i = 0; i < job->scene->n_lights; i++)
		wide |= job->scene->lights[i].radius > 0;
	return wide && job->options->mode != TRACER_PATH ? job->options->rays : 1;
}

int trace_shadows(struct job *job, const struct accel_space *space, uint32_t n)
{
	struct tracer *tr = job->tr;
	uint32_t n_rays = job->prepared.n_light_slots * n, samples = light_rays(job);
	int packets = device_family(tr->dev) == FAMILY_PACKETS;
	int err = reserve_light_rays(job, n_rays);

	for (uint32_t i = 0; i < samples && !err; i++) {
		struct launch l = launch_with_tables(tr);
		uint32_t sample = job->pass * samples + i;

		add(&l, tr, BUFFER_VIEWS);
		add(&l, tr, BUFFER_WINDOWS);
		add(&l, tr, BUFFER_FRAGMENTS);
		add(&l, tr, BUFFER_PIXELS);
		add_uint(&l, &job->width);
		add(&l, tr, BUFFER_SHADED);
		add_uint(&l, &sample);
		add_uint(&l, &n);
		add_uint(&l, &n_rays);
		add(&l, tr, BUFFER_RAYS);
		err = run(tr, packets ? KERNEL_shadow_ray_packet : KERNEL_shadow_ray,
		          packets ? (n_rays + SHADE_PACKET - 1) / SHADE_PACKET : n_rays, &l);
		if (!err)
			err = ask_lights(job, space, n_rays, i, samples);
	}
	return err;
}

/* The same from what n paths hit. */
static int trace_hit_shadows(struct job *job, const struct accel_space *space, uint32_t transport, uint32_t n)
{
	struct tracer *tr = job->tr;
	uint32_t n_rays = job->prepared.n_light_slots * n, samples = (light_rays(job) + 3) / 4;
	struct launch l = launch_with_tables(tr);
	int err = reserve_light_rays(job, n_rays);

	if (!err)
		err = reserve(tr, BUFFER_WANTED, n, sizeof(uint32_t));
	if (err)
		return err;
	add(&l, tr, BUFFER_PATH_HITS);
	add(&l, tr, path_list.rays);
	add_uint(&l, &transport);
	add_uint(&l, &n);
	add(&l, tr, BUFFER_WANTED);
	err = run(tr, KERNEL_want_lights, n, &l);
	for (uint32_t i = 0; i < samples && !err; i++) {
		uint32_t sample = job->pass * samples + i;

		l = launch_with_tables(tr);
		add(&l, tr, BUFFER_PATH_HITS);
		add(&l, tr, path_list.rays);
		add(&l, tr, path_list.paths);
		add(&l, tr, BUFFER_PIXELS);
		add(&l, tr, BUFFER_WANTED);
		add_uint(&l, &sample);
		add_uint(&l, &n);
		add_uint(&l, &n_rays);
		add(&l, tr, BUFFER_RAYS);
		err = run(tr, KERNEL_hit_ray, n_rays, &l);
		if (!err)
			err = ask_lights(job, space, n_rays, i, samples);
	}
	return err;
}

/* --- Openness ------------------------------------------------------------------------------------------------------ */

int trace_openness(struct job *job, const struct accel_space *space, uint32_t n)
{
	struct tracer *tr = job->tr;
	float reach = job->options->reach > 0 ? job->options->reach : 1e30f;
	uint32_t over_gl = job->options->mode == TRACER_AO_PHONG, samples = job->options->rays;
	struct launch l = { .n = 0 };
	int err = reserve_light_rays(job, n);

	for (uint32_t i = 0; i < samples && !err; i++) {
		struct launch rays = launch_with_tables(tr);
		uint32_t sample = job->pass * samples + i;

		add(&rays, tr, BUFFER_VIEWS);
		add(&rays, tr, BUFFER_WINDOWS);
		add(&rays, tr, BUFFER_FRAGMENTS);
		add(&rays, tr, BUFFER_PIXELS);
		add_uint(&rays, &job->width);
		add(&rays, tr, BUFFER_SHADED);
		add_uint(&rays, &sample);
		add_bytes(&rays, &reach, sizeof(reach));
		add_uint(&rays, &n);
		add(&rays, tr, BUFFER_RAYS);
		err = run(tr, KERNEL_ao_ray, n, &rays);
		if (!err)
			err = ask_lights(job, space, n, i, samples);
	}
	if (err)
		return err;
	add(&l, tr, BUFFER_ARRIVING);
	add_uint(&l, &over_gl);
	add_uint(&l, &n);
	add(&l, tr, BUFFER_SHADED);
	return run(tr, KERNEL_ao_shade, n, &l);
}

/* --- Paths --------------------------------------------------------------------------------------------------------- */

static int leave(struct job *job, uint32_t transport, uint32_t n)
{
	struct tracer *tr = job->tr;
	struct launch l = launch_with_tables(tr);
	int err = reserve_list(job, path_list.next_paths, path_list.next_rays, (size_t)PATHS_PER_FRAGMENT * n);

	if (!err)
		err = reserve(tr, BUFFER_NEXT_COUNTS, n, sizeof(uint32_t));
	if (err)
		return err;
	add(&l, tr, BUFFER_VIEWS);
	add(&l, tr, BUFFER_WINDOWS);
	add(&l, tr, BUFFER_FRAGMENTS);
	add(&l, tr, BUFFER_PIXELS);
	add_uint(&l, &job->width);
	add_uint(&l, &transport);
	add_uint(&l, &job->pass);
	add_uint(&l, &n);
	add(&l, tr, BUFFER_SHADED);
	add(&l, tr, path_list.next_rays);
	add(&l, tr, path_list.next_paths);
	add(&l, tr, BUFFER_NEXT_COUNTS);
	return run(tr, KERNEL_leave, n, &l);
}

static int look_at_sky(struct job *job, const struct accel_space *sky, uint32_t n)
{
	struct tracer *tr = job->tr;
	struct launch l = { .n = 0 };
	int err = reserve(tr, BUFFER_SKY_HITS, sky ? n : 1, sizeof(struct hit));

	if (err || !sky)
		return err;
	err = reserve(tr, BUFFER_SKY_RAYS, n, sizeof(struct ray));
	if (err)
		return err;
	add(&l, tr, BUFFER_PATH_HITS);
	add(&l, tr, path_list.rays);
	add_uint(&l, &n);
	add(&l, tr, BUFFER_SKY_RAYS);
	err = run(tr, KERNEL_sky_ray, n, &l);
	return err ? err : trace_rays(job, sky, BUFFER_SKY_RAYS, BUFFER_SKY_HITS, n, 0);
}

static int shade_hits(struct job *job, uint32_t has_sky, uint32_t transport, uint32_t n)
{
	struct tracer *tr = job->tr;
	struct launch l = launch_with_tables(tr);
	uint32_t slots = job->prepared.n_light_slots, depth = job->options->depth;
	int err = reserve_list(job, path_list.next_paths, path_list.next_rays, (size_t)PATHS_PER_HIT * n);

	if (!err)
		err = reserve(tr, BUFFER_NEXT_COUNTS, n, sizeof(uint32_t));
	if (!err)
		err = reserve(tr, BUFFER_GIVEN, n, 3 * sizeof(float));
	if (err)
		return err;
	add(&l, tr, BUFFER_PATH_HITS);
	add(&l, tr, BUFFER_SKY_HITS);
	add_uint(&l, &has_sky);
	add(&l, tr, path_list.rays);
	add(&l, tr, path_list.paths);
	add(&l, tr, BUFFER_PIXELS);
	add(&l, tr, BUFFER_ARRIVING);
	add_uint(&l, &slots);
	add_uint(&l, &transport);
	add_uint(&l, &job->pass);
	add_uint(&l, &depth);
	add(&l, tr, BUFFER_BACKGROUND);
	add_uint(&l, &n);
	add(&l, tr, BUFFER_GIVEN);
	add(&l, tr, path_list.next_rays);
	add(&l, tr, path_list.next_paths);
	add(&l, tr, BUFFER_NEXT_COUNTS);
	return run(tr, KERNEL_shade_hit, n, &l);
}

static int credit(struct job *job, uint32_t n)
{
	struct tracer *tr = job->tr;
	struct launch l = { .n = 0 };

	add(&l, tr, path_list.paths);
	add(&l, tr, BUFFER_GIVEN);
	add_uint(&l, &n);
	add(&l, tr, BUFFER_SHADED);
	return run(tr, KERNEL_credit, n, &l);
}

int trace_paths(struct job *job, const struct accel_space *space, const struct accel_space *sky, uint32_t n)
{
	struct tracer *tr = job->tr;
	uint32_t transport = transport_of(job->options), slots = job->prepared.n_light_slots;
	int err = upload(tr, BUFFER_BACKGROUND, job->background, 4, sizeof(float));

	if (!err)
		err = reserve(tr, BUFFER_ARRIVING, 1, 3 * sizeof(float));
	if (!err)
		err = leave(job, transport, n);
	if (!err)
		err = gather_list(job, &path_list, PATHS_PER_FRAGMENT, &n);
	for (uint32_t i = 0; i < job->options->depth + MOST_VEILS && n && !err; i++) {
		err = reserve(tr, BUFFER_PATH_HITS, n, sizeof(struct hit));
		if (!err)
			err = trace_rays(job, space, path_list.rays, BUFFER_PATH_HITS, n, 0);
		if (!err)
			err = look_at_sky(job, sky, n);
		if (!err && slots)
			err = trace_hit_shadows(job, space, transport, n);
		if (!err)
			err = shade_hits(job, sky != NULL, transport, n);
		if (!err)
			err = credit(job, n);
		if (!err)
			err = gather_list(job, &path_list, PATHS_PER_HIT, &n);
	}
	return err;
}
