/* Rays from the fragments of the list: to the lights, and from mirror to mirror. */
#include "kernels/rays.h"
#include "tracer/frame.h"

const struct accel_space *space_of_view(const struct job *job, uint32_t view)
{
	for (uint32_t i = 0; i < job->n_spaces; i++)
		if (job->spaces[i].space == job->prepared.scene_views[view].space && job->spaces[i].n_nodes)
			return &job->spaces[i];
	return NULL;
}

/* Trace n rays through a space: packets over binary trees where the device likes them and rays run side by side. */
static int trace_rays(struct job *job, const struct accel_space *space, enum buffer rays, enum buffer results, uint32_t n,
                      int occlude)
{
	struct tracer *tr = job->tr;
	int packets = device_prefers_packets(tr->dev) && occlude;
	enum device_kernel kernel = occlude ? (packets ? KERNEL_occlude_packet : KERNEL_occlude_wide) :
	                                      KERNEL_intersect_wide;
	uint32_t top = packets ? space->top2_first : space->top8_first;
	struct launch l = { .n = 0 };

	add_uint(&l, &n);
	add(&l, tr, rays);
	add_uint(&l, &top);
	add(&l, tr, packets ? BUFFER_TOP2 : BUFFER_TOP8);
	add(&l, tr, BUFFER_INSTANCE_LIST);
	add(&l, tr, BUFFER_INSTANCES);
	add(&l, tr, packets ? BUFFER_NODES2 : BUFFER_NODES8);
	add(&l, tr, packets ? BUFFER_TRIANGLES : BUFFER_TRIANGLES8);
	add(&l, tr, results);
	return run(tr, kernel, packets ? (n + RAYS_PER_PACKET - 1) / RAYS_PER_PACKET : n, &l);
}

int trace_shadows(struct job *job, const struct accel_space *space, uint32_t n)
{
	struct tracer *tr = job->tr;
	uint32_t slots = job->prepared.n_light_slots, n_rays = slots * n;
	struct launch l = launch_with_tables(tr);
	int err = reserve(tr, BUFFER_RAYS, n_rays, sizeof(struct ray));

	if (!err)
		err = reserve(tr, BUFFER_STOPPED, n_rays, sizeof(uint32_t));
	if (err)
		return err;
	add(&l, tr, BUFFER_VIEWS);
	add(&l, tr, BUFFER_WINDOWS);
	add(&l, tr, BUFFER_FRAGMENTS);
	add(&l, tr, BUFFER_PIXELS);
	add_uint(&l, &job->width);
	add(&l, tr, BUFFER_SHADED);
	add_uint(&l, &n);
	add_uint(&l, &n_rays);
	add(&l, tr, BUFFER_RAYS);
	err = run(tr, KERNEL_shadow_ray, n_rays, &l);
	return err ? err : trace_rays(job, space, BUFFER_RAYS, BUFFER_STOPPED, n_rays, 1);
}

/* The same from the hits of reflected rays. */
static int trace_hit_shadows(struct job *job, const struct accel_space *space, uint32_t n)
{
	struct tracer *tr = job->tr;
	uint32_t slots = job->prepared.n_light_slots, n_rays = slots * n;
	struct launch l = launch_with_tables(tr);
	int err;

	add(&l, tr, BUFFER_HITS);
	add(&l, tr, BUFFER_MIRROR_RAYS);
	add(&l, tr, BUFFER_WANTED);
	add_uint(&l, &n);
	add_uint(&l, &n_rays);
	add(&l, tr, BUFFER_RAYS);
	err = run(tr, KERNEL_hit_ray, n_rays, &l);
	return err ? err : trace_rays(job, space, BUFFER_RAYS, BUFFER_STOPPED, n_rays, 1);
}

static int shade_hits(struct job *job, uint32_t finish, uint32_t last, uint32_t slots, uint32_t n)
{
	struct tracer *tr = job->tr;
	struct launch l = launch_with_tables(tr);

	add(&l, tr, BUFFER_HITS);
	add_uint(&l, &finish);
	add_uint(&l, &last);
	add(&l, tr, BUFFER_STOPPED);
	add_uint(&l, &slots);
	add_uint(&l, &n);
	add(&l, tr, BUFFER_BACKGROUND);
	add(&l, tr, BUFFER_WANTED);
	add(&l, tr, BUFFER_MIRROR_RAYS);
	add(&l, tr, BUFFER_SHARES);
	add(&l, tr, BUFFER_SHADED);
	return run(tr, KERNEL_shade_hit, n, &l);
}

int trace_mirrors(struct job *job, const struct accel_space *space, uint32_t n)
{
	struct tracer *tr = job->tr;
	uint32_t slots = job->prepared.n_light_slots;
	struct launch l = launch_with_tables(tr);
	int err = reserve(tr, BUFFER_MIRROR_RAYS, n, sizeof(struct ray));

	if (!err)
		err = reserve(tr, BUFFER_SHARES, n, sizeof(float));
	if (!err)
		err = reserve(tr, BUFFER_HITS, n, sizeof(struct hit));
	if (!err)
		err = reserve(tr, BUFFER_WANTED, n, sizeof(uint32_t));
	if (!err)
		err = reserve(tr, BUFFER_RAYS, (size_t)slots * n, sizeof(struct ray));
	if (!err)
		err = reserve(tr, BUFFER_STOPPED, (size_t)slots * n, sizeof(uint32_t));
	if (!err)
		err = upload(tr, BUFFER_BACKGROUND, job->background, 4, sizeof(float));
	if (err)
		return err;
	add(&l, tr, BUFFER_VIEWS);
	add(&l, tr, BUFFER_WINDOWS);
	add(&l, tr, BUFFER_FRAGMENTS);
	add(&l, tr, BUFFER_PIXELS);
	add_uint(&l, &job->width);
	add_uint(&l, &n);
	add(&l, tr, BUFFER_SHADED);
	add(&l, tr, BUFFER_MIRROR_RAYS);
	add(&l, tr, BUFFER_SHARES);
	err = run(tr, KERNEL_mirror_ray, n, &l);
	for (unsigned bounce = 0; bounce < job->options->depth && !err; bounce++) {
		err = trace_rays(job, space, BUFFER_MIRROR_RAYS, BUFFER_HITS, n, 0);
		if (!err && slots)
			err = shade_hits(job, 0, 0, 0, n);
		if (!err && slots)
			err = trace_hit_shadows(job, space, n);
		if (!err)
			err = shade_hits(job, 1, bounce + 1 == job->options->depth, slots, n);
	}
	return err;
}
