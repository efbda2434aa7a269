#include "tracer/frame/hook/hook_objects.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "tracer/frame/hook/hooks.h"

/* Room for rays of one kind that may hit objects in a CPU's band: twice its pixels. Wide pictures have larger bands
 * (trace.c). */
#define ROOM 131072u
#define ROOM_ROWS 64u

static const struct scene_mesh *mesh_of(const struct frame *frame, uint32_t instance)
{
	return frame->scene->meshes[frame->scene->instances[frame->prepared.instances[instance].scene_instance].mesh];
}

/* Describe an instance that the hook may make an object. @return 0: it may not */
static int describe(const struct frame *frame, uint32_t i, struct hook_object *out)
{
	const struct instance *instance = &frame->prepared.instances[i];
	const struct scene_mesh *mesh = mesh_of(frame, i);

	if (!(instance->flags & INSTANCE_SECONDARY) ||
	    instance->flags & (INSTANCE_BAKED | INSTANCE_SKY | INSTANCE_SCREEN) || mesh->vertex_count == 0 ||
	    frame->prepared.scene_views[instance->view].space != frame->objects.space)
		return 0;
	*out = (struct hook_object){ .instance = i, .material = instance->material, .draw = instance->draw };
	memcpy(out->obj_from_eye, instance->obj_from_eye, sizeof(out->obj_from_eye));
	for (int a = 0; a < 3; a++) {
		out->lower[a] = INFINITY;
		out->upper[a] = -INFINITY;
		for (uint32_t v = 0; v < mesh->vertex_count; v++) {
			const float *at = mesh->position + 4 * (size_t)v;

			out->lower[a] = fminf(out->lower[a], at[a] / at[3]);
			out->upper[a] = fmaxf(out->upper[a], at[a] / at[3]);
		}
	}
	return 1;
}

static int ask_bounds(struct frame *frame)
{
	struct tracer *tr = frame->tr;
	struct frame_objects *o = &frame->objects;
	int err = launch_upload(tr->dev, tr->hook->objects, o->list, o->n);

	if (!err)
		err = launch_hook_bounds(tr->dev, o->n,
		                         LAUNCH(hook_bounds, .parameters = tr->hook->parameters,
		                                .words = frame->options->hook->words, .n = o->n,
		                                .objects = tr->hook->objects));
	return err ? err : device_read(tr->dev, tr->hook->objects.buffer, 0, o->list, o->n * sizeof(*o->list));
}

/* Keep the objects that have a box, and make rays ignore their triangles. */
static void keep_bounded(struct frame *frame)
{
	struct frame_objects *o = &frame->objects;
	const uint32_t n = o->n;

	o->n = 0;
	for (uint32_t i = 0; i < n; i++) {
		const struct hook_object object = o->list[i];
		int is_there = 1;

		for (int a = 0; a < 3; a++)
			is_there &= isfinite(object.lower[a]) && isfinite(object.upper[a]) &&
			            object.lower[a] <= object.upper[a];
		if (!is_there)
			continue;
		frame->prepared.instances[object.instance].flags &= ~INSTANCE_SECONDARY;
		o->list[o->n++] = object;
	}
}

/* Make the mesh of slots: each has a triangle with three separate vertices. */
static int make_mesh(struct frame_objects *o, uint32_t width)
{
	uint32_t n;

	o->room = ROOM + ROOM_ROWS * width;
	n = N_HOOK_RAYS_OF * o->room;
	o->index = malloc(3 * (size_t)n * sizeof(*o->index));
	if (!o->index)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t i = 0; i < 3 * n; i++)
		o->index[i] = i;
	o->mesh = (struct scene_mesh){ .hash = { n, 0x6f626a65637473 },
		                       .kind = SCENE_TRIANGLES,
		                       .vertex_count = 3 * n,
		                       .primitive_count = n,
		                       .index = o->index };
	return 0;
}

/* Upload separate current attributes for objects: an object without vertex arrays has the colour of its first
 * vertex. */
static int upload_currents(const struct frame *frame)
{
	const struct scene *scene = frame->scene;
	const struct frame_objects *o = &frame->objects;
	struct scene_current *currents = malloc((scene->n_currents + (size_t)o->n) * sizeof(*currents));
	int err;

	if (!currents)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	memcpy(currents, scene->currents, scene->n_currents * sizeof(*currents));
	for (uint32_t i = 0; i < o->n; i++) {
		const struct scene_mesh *mesh = mesh_of(frame, o->list[i].instance);
		struct scene_current *c = &currents[scene->n_currents + i];

		*c = scene->currents[frame->prepared.geometries[o->list[i].instance].current];
		if (mesh->color)
			memcpy(c->color, mesh->color, sizeof(c->color));
		if (mesh->secondary)
			memcpy(c->secondary, mesh->secondary, sizeof(c->secondary));
	}
	err = launch_upload(frame->tr->dev, frame->tr->placed.currents, currents, scene->n_currents + o->n);
	free(currents);
	return err;
}

int hook_objects_find(struct frame *frame)
{
	const struct segment *segment = hooks_has(frame, HOOK_INTERSECTION) ? frame->hooked : NULL;
	struct frame_objects *o = &frame->objects;
	int err;

	if (!segment)
		return 0;
	o->space = frame->prepared.scene_views[segment->view].space;
	o->list = calloc(frame->prepared.n_instances, sizeof(*o->list));
	if (!o->list)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t i = 0; i < frame->prepared.n_instances; i++)
		o->n += (uint32_t)describe(frame, i, &o->list[o->n]);
	err = o->n ? ask_bounds(frame) : 0;
	if (!err)
		keep_bounded(frame);
	if (err || !o->n)
		return err;
	err = make_mesh(o, frame->width);
	if (!err)
		err = launch_upload(frame->tr->dev, frame->tr->hook->objects, o->list, o->n);
	return err ? err : upload_currents(frame);
}

void hook_objects_forget(struct frame *frame)
{
	free(frame->objects.list);
	free(frame->objects.index);
	frame->objects = (struct frame_objects){ .n = 0 };
}

size_t hook_objects_vertices(const struct frame *frame)
{
	return frame->objects.n ? frame->objects.mesh.vertex_count : 0;
}

size_t hook_objects_texcoords(const struct frame *frame)
{
	const struct frame_objects *o = &frame->objects;
	size_t most = 0;

	for (uint32_t i = 0; i < o->n; i++)
		if (frame->scene->materials[o->list[i].material].unit_count > most)
			most = frame->scene->materials[o->list[i].material].unit_count;
	return most * hook_objects_vertices(frame);
}

void hook_objects_stand(struct frame *frame, uint32_t object, uint32_t index)
{
	const struct frame_objects *o = &frame->objects;
	struct geometry *g = &frame->prepared.geometries[o->list[object].instance];

	g->attributes = 0;
	g->current = frame->scene->n_currents + object;
	g->crease = g->primitive_draw = SCENE_NONE;
	g->index = index;
	g->vertex_first = o->vertex_first;
	g->vertex_count = o->mesh.vertex_count;
	g->texcoord_first = o->texcoord_first;
}

int hook_objects_in(const struct frame *frame, const struct accel_space *space)
{
	return frame->objects.n && !space->sky && space->space == frame->objects.space;
}

int hook_objects_intersect(const struct frame *frame, const struct traverse_rays *rays, enum hook_rays_of whose)
{
	struct tracer *tr = frame->tr;
	const struct hook_buffers *b = frame->tr->hook;

	if (rays->n > frame->objects.room)
		return ERR_MEMORY;
	return launch_hook_intersect(
		tr->dev, rays->n,
		LAUNCH(hook_intersect, .tables = frame_tables(tr), .views = frame->tr->placed.views,
	               .objects = b->objects, .n_objects = frame->objects.n, .rays = rays->rays,
	               .after = rays->last.buffer != NULL, .parameters = b->parameters, .words = frame->options->hook->words,
	               .alone = !rays->space->n_nodes, .first_slot = (uint32_t)whose * frame->objects.room,
	               .n = rays->n, .hits = rays->hits, .made = frame->tr->placed.vertices,
	               .made_coords = frame->tr->placed.texcoords, .windows = frame->tr->placed.windows));
}

int hook_objects_occlude(const struct frame *frame, const struct traverse_rays *rays)
{
	const struct hook_buffers *b = frame->tr->hook;

	return launch_hook_occlude(frame->tr->dev, rays->n,
	                           LAUNCH(hook_occlude, .objects = b->objects, .n_objects = frame->objects.n,
	                                  .rays = rays->rays, .parameters = b->parameters,
	                                  .words = frame->options->hook->words, .alone = !rays->space->n_nodes,
	                                  .n = rays->n, .occluded = rays->occluded));
}
