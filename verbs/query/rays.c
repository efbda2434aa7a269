/* Implements relume-rays.h: a tree of one mesh on a device, and batches of queries through it. */
#include "verbs/query/relume-rays.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"
#include "replay/replay.h"
#include "scene/release.h"
#include "tracer/device/outcome.h"
#include "tracer/frame/common/traverse.h"
#include "verbs/query/soup.h"

#define BATCH 262144u /* queries of a launch; fewer where a ray has many hits */

struct relume_rays {
	struct device *dev;
	struct query_soup soup;
	struct accel *accel;
	const struct accel_space *space; /* NULL: the scene is empty */
	struct traverse_trees trees;
	union buffer_ray rays;
	union buffer_hit hits;
	union buffer_uint counts;
	union buffer_query_point points;
	union buffer_query_nearest nearest;
	union buffer_query_body bodies;
	union buffer_query_contact contacts;
	struct hit *read; /* the device's hits for a batch of rays */
	size_t read_room;
};

/* The device's layouts are those of the interface. */
_Static_assert(sizeof(struct relume_rays_ray) == sizeof(struct ray), "");
_Static_assert(sizeof(struct relume_rays_point) == sizeof(struct query_point), "");
_Static_assert(sizeof(struct relume_rays_distance) == sizeof(struct query_nearest), "");
_Static_assert(sizeof(struct relume_rays_body) == sizeof(struct query_body), "");
_Static_assert(sizeof(struct relume_rays_contact) == sizeof(struct query_contact), "");
_Static_assert(RELUME_RAYS_NONE == SCENE_NONE, "");

/* --- The tree ---------------------------------------------------------------------------------------------------- */

/* A scene of one mesh, for the builders. */
static int build(struct relume_rays *r)
{
	const struct scene_mesh mesh = { .hash = { 1, 1 },
		                         .kind = SCENE_TRIANGLES,
		                         .vertex_count = r->soup.n_vertices,
		                         .primitive_count = r->soup.n_triangles,
		                         .position = r->soup.position[0],
		                         .index = r->soup.index[0] };
	const struct scene_mesh *meshes[1] = { &mesh };
	struct scene_instance scene_instance = { .mesh = 0 };
	struct scene_view scene_view = { .space = 0 };
	const struct scene scene = { .meshes = meshes,
		                     .instances = &scene_instance,
		                     .views = &scene_view,
		                     .n_meshes = 1,
		                     .n_instances = 1,
		                     .n_views = 1 };
	struct instance instance = { .flags = INSTANCE_OPAQUE | INSTANCE_SECONDARY };
	struct view view = { .tlas_count = 0 };
	const struct accel_space *spaces;
	uint32_t n_spaces;
	int err;

	for (int i = 0; i < 3; i++)
		instance.eye_from_obj[5 * i] = instance.obj_from_eye[5 * i] = 1;
	r->accel->wide = traverse_families[device_family(r->dev)].wide;
	r->accel->kind = ACCEL_BVH; /* no triangle is in two leaves: kernels/rays/query.h */
	if ((err = accel_build_frame(r->accel, &scene, NULL, NULL, &instance, 1, &view, &spaces, &n_spaces)) ||
	    (err = traverse_upload_tlases(r->dev, r->accel, &instance, 1, &r->trees)) ||
	    (err = traverse_upload_pools(r->dev, r->accel, &r->trees)))
		return err == ERR_MEMORY ? device_report_lack(r->dev) : err;
	r->space = n_spaces && spaces[0].n_nodes ? &spaces[0] : NULL;
	return 0;
}

/* Takes ownership of the soup, even on failure. */
static int open_soup(struct query_soup *soup, const char *device, struct relume_rays **out)
{
	struct relume_rays *r = calloc(1, sizeof(*r));
	int err = r ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");

	*out = NULL;
	if (!r) {
		query_soup_free(soup);
		return -err;
	}
	r->soup = *soup;
	*soup = (struct query_soup){ NULL };
	err = device_open(device, 0, &r->dev);
	if (!err)
		err = outcome_choose_known(r->dev);
	if (!err)
		err = accel_create(&r->accel);
	if (!err && r->soup.n_triangles)
		err = build(r);
	if (err)
		relume_rays_close(&r);
	*out = r;
	return -err;
}

int relume_rays_open_frame(const char *trace, uint64_t frame, const char *device, struct relume_rays **out)
{
	struct query_soup soup = { NULL };
	struct scene *scene = NULL;
	int err = replay_one_frame(trace, frame, &scene);

	*out = NULL;
	if (!err)
		err = query_soup_of_frame(scene, &soup);
	scene_release(&scene);
	return err ? -err : open_soup(&soup, device, out);
}

int relume_rays_open_triangles(const float (*position)[3], size_t n_vertices, const uint32_t (*index)[3],
                               size_t n_triangles, const char *device, struct relume_rays **out)
{
	struct query_soup soup = { NULL };
	int err = query_soup_of_triangles(position, n_vertices, index, n_triangles, "relume_rays_open_triangles", &soup);

	*out = NULL;
	return err ? -err : open_soup(&soup, device, out);
}

void relume_rays_close(struct relume_rays **rays)
{
	struct relume_rays *r = *rays;

	*rays = NULL;
	if (!r)
		return;
	if (r->dev) {
		struct device_buffer **buffers[] = { &r->rays.buffer,    &r->hits.buffer,    &r->counts.buffer,
			                             &r->points.buffer,  &r->nearest.buffer, &r->bodies.buffer,
			                             &r->contacts.buffer };

		for (size_t i = 0; i < sizeof(buffers) / sizeof(buffers[0]); i++)
			device_release(r->dev, buffers[i]);
		traverse_release(r->dev, &r->trees);
	}
	accel_destroy(&r->accel);
	device_close(&r->dev);
	query_soup_free(&r->soup);
	free(r->read);
	free(r);
}

size_t relume_rays_triangles(const struct relume_rays *rays)
{
	return rays->soup.n_triangles;
}

void relume_rays_describe(const struct relume_rays *rays, uint32_t triangle, struct relume_rays_triangle *out)
{
	const struct query_soup *soup = &rays->soup;

	for (int k = 0; k < 3; k++)
		memcpy(out->corner[k], soup->position[soup->index[triangle][k]], sizeof(out->corner[k]));
	out->draw = soup->sources ? soup->sources[triangle].draw : 0;
	out->primitive = soup->sources ? soup->sources[triangle].primitive : triangle;
}

/* --- Batches ----------------------------------------------------------------------------------------------------- */

enum question { NEAREST, ANY, ALL, DISTANCE, BOX, SPHERE, N_QUESTIONS };

/* A batch: the queries, and the destination of the answers. */
struct batch {
	enum question question;
	const void *asked;
	size_t n;
	uint32_t most;   /* ALL: hits of a ray */
	void *answers;   /* in the interface's layout */
	uint32_t *counts; /* ALL */
};

static const size_t asked_bytes[N_QUESTIONS] = {
	[NEAREST] = sizeof(struct ray), [ANY] = sizeof(struct ray), [ALL] = sizeof(struct ray),
	[DISTANCE] = sizeof(struct query_point), [BOX] = sizeof(struct query_body), [SPHERE] = sizeof(struct query_body),
};
static const size_t answer_bytes[N_QUESTIONS] = {
	[NEAREST] = sizeof(struct relume_rays_hit), [ANY] = sizeof(uint32_t), [ALL] = sizeof(struct relume_rays_hit),
	[DISTANCE] = sizeof(struct query_nearest), [BOX] = sizeof(struct query_contact),
	[SPHERE] = sizeof(struct query_contact),
};

static int read_hits(struct relume_rays *r, size_t n)
{
	int err = MEMORY_GROW(r->read, r->read_room, n);

	return err ? err : device_read(r->dev, r->hits.buffer, 0, r->read, n * sizeof(*r->read));
}

static void give_hit(const struct hit *hit, struct relume_rays_hit *out)
{
	*out = (struct relume_rays_hit){ hit->t, hit->b1, hit->b2,
		                         hit->instance == SCENE_NONE ? RELUME_RAYS_NONE : hit->primitive };
}

static int ask_rays(struct relume_rays *r, const struct batch *b)
{
	const struct traverse_family *family = &traverse_families[device_family(r->dev)];
	struct traverse_rays rays = { .space = r->space, .n = (uint32_t)b->n };
	int err;

	if ((err = launch_upload(r->dev, r->rays, (const struct ray *)b->asked, b->n)) ||
	    (err = b->question == ANY ? launch_reserve(r->dev, r->counts, b->n) : launch_reserve(r->dev, r->hits, b->n)))
		return err;
	rays.rays = r->rays;
	rays.occluded = r->counts;
	rays.hits = r->hits;
	if ((err = traverse_rays(r->dev, b->question == ANY ? family->occlude : family->intersect, &r->trees, &rays)))
		return err;
	if (b->question == ANY)
		return device_read(r->dev, r->counts.buffer, 0, b->answers, b->n * sizeof(uint32_t));
	err = read_hits(r, b->n);
	for (size_t i = 0; i < b->n && !err; i++)
		give_hit(&r->read[i], (struct relume_rays_hit *)b->answers + i);
	return err;
}

static int ask_all(struct relume_rays *r, const struct batch *b)
{
	int err;

	if ((err = launch_upload(r->dev, r->rays, (const struct ray *)b->asked, b->n)) ||
	    (err = launch_reserve(r->dev, r->hits, b->n * b->most)) ||
	    (err = launch_reserve(r->dev, r->counts, b->n)) ||
	    (err = launch_query_all(r->dev, b->n,
	                            LAUNCH(query_all, .n = (uint32_t)b->n, .nodes = r->trees.nodes2,
	                                   .triangles = r->trees.triangles, .rays = r->rays, .most = b->most,
	                                   .hits = r->hits, .counts = r->counts))) ||
	    (err = device_read(r->dev, r->counts.buffer, 0, b->counts, b->n * sizeof(*b->counts))) ||
	    (err = read_hits(r, b->n * b->most)))
		return err;
	for (size_t i = 0; i < b->n; i++)
		for (uint32_t k = 0; k < b->most; k++) {
			struct relume_rays_hit *out = (struct relume_rays_hit *)b->answers + i * b->most + k;

			if (k < b->counts[i])
				give_hit(&r->read[i * b->most + k], out);
			else
				*out = (struct relume_rays_hit){ INFINITY, 0, 0, RELUME_RAYS_NONE };
		}
	return 0;
}

static int ask_distance(struct relume_rays *r, const struct batch *b)
{
	int err;

	if ((err = launch_upload(r->dev, r->points, (const struct query_point *)b->asked, b->n)) ||
	    (err = launch_reserve(r->dev, r->nearest, b->n)) ||
	    (err = launch_query_distance(r->dev, b->n,
	                                 LAUNCH(query_distance, .n = (uint32_t)b->n, .nodes = r->trees.nodes2,
	                                        .triangles = r->trees.triangles, .points = r->points,
	                                        .nearest = r->nearest))))
		return err;
	return device_read(r->dev, r->nearest.buffer, 0, b->answers, b->n * sizeof(struct query_nearest));
}

static int ask_bodies(struct relume_rays *r, const struct batch *b)
{
	int err;

	if ((err = launch_upload(r->dev, r->bodies, (const struct query_body *)b->asked, b->n)) ||
	    (err = launch_reserve(r->dev, r->contacts, b->n)))
		return err;
	if (b->question == BOX)
		err = launch_query_box(r->dev, b->n,
		                       LAUNCH(query_box, .n = (uint32_t)b->n, .nodes = r->trees.nodes2,
		                              .triangles = r->trees.triangles, .bodies = r->bodies,
		                              .contacts = r->contacts));
	else
		err = launch_query_sphere(r->dev, b->n,
		                          LAUNCH(query_sphere, .n = (uint32_t)b->n, .nodes = r->trees.nodes2,
		                                 .triangles = r->trees.triangles, .bodies = r->bodies,
		                                 .contacts = r->contacts));
	return err ? err : device_read(r->dev, r->contacts.buffer, 0, b->answers, b->n * sizeof(struct query_contact));
}

static int ask_device(struct relume_rays *r, const struct batch *b)
{
	switch (b->question) {
	case ALL:
		return ask_all(r, b);
	case DISTANCE:
		return ask_distance(r, b);
	case BOX:
	case SPHERE:
		return ask_bodies(r, b);
	default:
		return ask_rays(r, b);
	}
}

/* The answers in an empty scene. */
static void answer_nothing(const struct batch *b)
{
	for (size_t i = 0; i < b->n * b->most; i++)
		switch (b->question) {
		case ANY:
			((uint32_t *)b->answers)[i] = 0;
			break;
		case DISTANCE:
			((struct relume_rays_distance *)b->answers)[i] =
				(struct relume_rays_distance){ .distance = INFINITY, .triangle = RELUME_RAYS_NONE };
			break;
		case BOX:
		case SPHERE:
			((struct relume_rays_contact *)b->answers)[i] = (struct relume_rays_contact){ INFINITY, RELUME_RAYS_NONE };
			break;
		default:
			((struct relume_rays_hit *)b->answers)[i] = (struct relume_rays_hit){ INFINITY, 0, 0, RELUME_RAYS_NONE };
		}
	for (size_t i = 0; i < b->n && b->counts; i++)
		b->counts[i] = 0;
}

/* All queries, in batches that shrink if the device lacks memory. */
static int ask(struct relume_rays *r, const struct batch *all)
{
	size_t room = BATCH / all->most ? BATCH / all->most : 1;

	if (!r->space) {
		answer_nothing(all);
		return 0;
	}
	for (size_t done = 0; done < all->n;) {
		struct batch b = *all;
		int err;

		b.n = all->n - done < room ? all->n - done : room;
		b.asked = (const char *)all->asked + done * asked_bytes[b.question];
		b.answers = (char *)all->answers + done * all->most * answer_bytes[b.question];
		b.counts = all->counts ? all->counts + done : NULL;
		err = ask_device(r, &b);
		if (err == ERR_MEMORY && b.n > 1) {
			room = b.n / 2;
			continue;
		}
		if (err)
			return err == ERR_MEMORY ? -device_report_lack(r->dev) : -err;
		done += b.n;
	}
	return 0;
}

int relume_rays_nearest(struct relume_rays *rays, const struct relume_rays_ray *ray, size_t n,
                        struct relume_rays_hit *hits)
{
	return ask(rays, &(struct batch){ .question = NEAREST, .asked = ray, .n = n, .most = 1, .answers = hits });
}

int relume_rays_any(struct relume_rays *rays, const struct relume_rays_ray *ray, size_t n, uint32_t *any)
{
	return ask(rays, &(struct batch){ .question = ANY, .asked = ray, .n = n, .most = 1, .answers = any });
}

int relume_rays_all(struct relume_rays *rays, const struct relume_rays_ray *ray, size_t n, uint32_t most,
                    struct relume_rays_hit *hits, uint32_t *counts)
{
	if (!most)
		return -err_report(ERR_USAGE, "relume_rays_all", "keeps at least one hit of a ray");
	return ask(rays,
	           &(struct batch){
			   .question = ALL, .asked = ray, .n = n, .most = most, .answers = hits, .counts = counts });
}

int relume_rays_distance(struct relume_rays *rays, const struct relume_rays_point *points, size_t n,
                         struct relume_rays_distance *out)
{
	return ask(rays, &(struct batch){ .question = DISTANCE, .asked = points, .n = n, .most = 1, .answers = out });
}

int relume_rays_move_box(struct relume_rays *rays, const struct relume_rays_body *bodies, size_t n,
                         struct relume_rays_contact *out)
{
	return ask(rays, &(struct batch){ .question = BOX, .asked = bodies, .n = n, .most = 1, .answers = out });
}

int relume_rays_move_sphere(struct relume_rays *rays, const struct relume_rays_body *bodies, size_t n,
                            struct relume_rays_contact *out)
{
	return ask(rays, &(struct batch){ .question = SPHERE, .asked = bodies, .n = n, .most = 1, .answers = out });
}
