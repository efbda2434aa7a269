#include "tracer/frame/place/geometry.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/mat4.h"
#include "base/memory.h"
#include "scene/mesa.h"
#include "tracer/frame/hook/hook_objects.h"
#include "tracer/frame/place/opacity.h"
#include "tracer/frame/place/perspective.h"
#include "tracer/frame/place/upload.h"
#include "tracer/frame/prepare/expand.h"

/* --- Vertex stage ------------------------------------------------------------------------------------------------ */

/* Run the vertex stage, with room after its results for the vertices of expanded lines and points. */
static int run_vertices(struct frame *frame, uint32_t extra_vertices, uint32_t extra_texcoords)
{
	struct tracer *tr = frame->tr;
	struct prepared *p = &frame->prepared;
	const struct placed_buffers *b = &tr->placed;
	size_t n = (size_t)p->n_vertices + extra_vertices + hook_objects_vertices(frame),
	       coords = (size_t)p->n_texcoords + extra_texcoords;
	const struct vertex_launch *a;
	int err = launch_reserve(tr->dev, tr->placed.vertices, n);

	frame->objects.vertex_first = p->n_vertices + extra_vertices;
	frame->objects.texcoord_first = p->n_texcoords + extra_texcoords;
	if (!err)
		err = launch_reserve(tr->dev, tr->placed.windows, n);
	if (!err)
		err = launch_reserve(tr->dev, tr->placed.clips, 4 * n);
	if (!err)
		err = launch_reserve(tr->dev, tr->placed.texcoords, 4 * (coords + hook_objects_texcoords(frame)));
	if (err)
		return err;
	a = LAUNCH(vertex, .tables = frame_tables(tr), .views = b->views, .owners = b->owners, .height = frame->height,
	           .n = p->n_vertices, .shaded = b->vertices, .windows = b->windows, .clips = b->clips,
	           .coords = b->texcoords);
	err = frame_in_packets(frame) ?
	              launch_vertex_packet(tr->dev, (p->n_vertices + VERTEX_PACKET - 1) / VERTEX_PACKET, a) :
	              launch_vertex(tr->dev, p->n_vertices, a);
	if (err || !p->has_vertex_programs)
		return err;
	return launch_vertex_program(tr->dev, p->n_vertices,
	                             LAUNCH(vertex_program, .tables = frame_tables(tr), .views = b->views,
	                                    .owners = b->owners, .height = frame->height, .n = p->n_vertices,
	                                    .shaded = b->vertices, .windows = b->windows, .clips = b->clips,
	                                    .coords = b->texcoords, .programs = b->programs));
}

static int upload_vertex_stage(struct frame *frame)
{
	struct tracer *tr = frame->tr;
	struct prepared *p = &frame->prepared;
	int err = upload_attributes(frame);

	if (!err)
		err = launch_upload(tr->dev, tr->placed.geometries, p->geometries, p->n_instances);
	if (!err)
		err = launch_upload(tr->dev, tr->placed.views, p->views, p->n_views);
	if (!err)
		err = launch_upload(tr->dev, tr->placed.owners, p->owner, p->n_vertices);
	if (!err)
		err = device_reserve(tr->dev, &tr->indices.buffer, sizeof(uint32_t));
	return err;
}

/* --- Lines and points -------------------------------------------------------------------------------------------- */

/* Expand one instance's lines or points from the results of the vertex stage. */
static int expand_instance(struct frame *frame, uint32_t i, float *dashed)
{
	const struct scene *scene = frame->scene;
	const struct prepared *p = &frame->prepared;
	const struct geometry *g = &p->geometries[i];
	const struct scene_material *m = &scene->materials[g->material];
	size_t n = g->vertex_count, n_coords = n * m->unit_count;
	struct shaded_vertex *vertices = malloc((n + 1) * sizeof(*vertices));
	float (*texcoords)[4] = malloc((n_coords + 1) * sizeof(*texcoords));
	struct expand_input in = { .mesh = scene->meshes[scene->instances[p->instances[i].scene_instance].mesh],
		                   .material = m,
		                   .units = scene->units + m->unit_first,
		                   .view = &p->views[g->view],
		                   .shape = p->shapes[i],
		                   .cull = p->culls[i],
		                   .width = frame->width,
		                   .height = frame->height,
		                   .depth_bits = scene->depth_bits,
		                   .from_below = scene->samples_from_below,
		                   .mesa = scene->mesa,
		                   .guards = !scene->depth_bits && !scene->stencil_bits && !scene->floats &&
		                             scene->samples <= 1,
		                   .vertices = vertices,
		                   .texcoords = (const float(*)[4])texcoords,
		                   .dashed = dashed };
	uint32_t first = scene->instances[p->instances[i].scene_instance].rectangle;
	int err = 0;

	in.rectangles = first ? scene->rectangles + first - 1 : NULL;
	if (!vertices || !texcoords)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	if (!err && n)
		err = device_read(frame->tr->dev, frame->tr->placed.vertices.buffer,
		                  g->vertex_first * sizeof(*vertices), vertices, n * sizeof(*vertices));
	if (!err && n_coords)
		err = device_read(frame->tr->dev, frame->tr->placed.texcoords.buffer,
		                  g->texcoord_first * sizeof(*texcoords), texcoords, n_coords * sizeof(*texcoords));
	if (!err)
		err = expand_primitives(&in, &frame->expanded[i]);
	free(vertices);
	free(texcoords);
	return err;
}

/* Write the clip coordinates of new vertices, from `first` on. */
static int write_clips(struct tracer *tr, uint32_t first, const struct expanded *e)
{
	float (*clips)[4] = NULL;
	int err = memory_resize(&clips, e->n_vertices, sizeof(*clips));

	for (uint32_t v = 0; v < e->n_vertices && !err; v++)
		memcpy(clips[v], e->vertices[v].clip, sizeof(*clips));
	if (!err)
		err = device_write(tr->dev, tr->placed.clips.buffer, first * sizeof(*clips), clips,
		                   e->n_vertices * sizeof(*clips));
	free(clips);
	return err;
}

static uint32_t flags_of_lines(const struct scene *scene, const struct scene_material *m)
{
	if (!m->line_smooth)
		return GEOMETRY_LINE;
	return GEOMETRY_SMOOTH_LINE | (scene->mesa & SCENE_MESA_SMOOTH_LINES ? GEOMETRY_LENGTH_COVERS : 0);
}

/* Upload the new vertices after the frame's own, where room was made. */
static int upload_expanded(struct frame *frame)
{
	struct tracer *tr = frame->tr;
	struct prepared *p = &frame->prepared;
	uint32_t vertex = p->n_vertices, texcoord = p->n_texcoords;
	int err = 0;

	for (uint32_t i = 0; i < p->n_instances && !err; i++) {
		const struct expanded *e = &frame->expanded[i];
		struct geometry *g = &p->geometries[i];

		if (p->shapes[i] == PREPARED_FILLED)
			continue;
		frame->extra[i] = &e->mesh;
		g->flags |= GEOMETRY_EXPANDED;
		if (frame->scene->instances[p->instances[i].scene_instance].rectangle)
			g->flags |= GEOMETRY_PIXELS;
		if (p->shapes[i] == PREPARED_LINES)
			g->flags |= flags_of_lines(frame->scene, &frame->scene->materials[g->material]);
		if (p->shapes[i] == PREPARED_POINTS && frame->scene->materials[g->material].point_smooth &&
		    !frame->scene->materials[g->material].point_sprite)
			g->flags |= GEOMETRY_SMOOTH_POINT;
		g->vertex_first = p->instances[i].vertex_first = vertex;
		g->vertex_count = e->n_vertices;
		g->texcoord_first = texcoord;
		if (e->n_vertices == 0)
			continue;
		err = device_write(tr->dev, tr->placed.vertices.buffer, vertex * sizeof(*e->vertices), e->vertices,
		                   e->n_vertices * sizeof(*e->vertices));
		if (!err)
			err = device_write(tr->dev, tr->placed.windows.buffer, vertex * sizeof(*e->windows),
			                   e->windows, e->n_vertices * sizeof(*e->windows));
		if (!err)
			err = write_clips(tr, vertex, e);
		if (!err && e->n_texcoords)
			err = device_write(tr->dev, tr->placed.texcoords.buffer, texcoord * sizeof(*e->texcoords),
			                   e->texcoords, e->n_texcoords * sizeof(*e->texcoords));
		vertex += e->n_vertices;
		texcoord += e->n_texcoords;
	}
	return err;
}

static int expand_all(struct frame *frame)
{
	struct prepared *p = &frame->prepared;
	uint32_t n_vertices = 0, n_texcoords = 0;
	float dashed = 0;
	int err = 0;

	for (uint32_t i = 0; i < p->n_instances && !err; i++) {
		if (p->shapes[i] == PREPARED_FILLED)
			continue;
		err = expand_instance(frame, i, &dashed);
		n_vertices += frame->expanded[i].n_vertices;
		n_texcoords += frame->expanded[i].n_texcoords;
	}
	if (!err && n_vertices) /* run it again with room: a buffer loses its content when it grows */
		err = run_vertices(frame, n_vertices, n_texcoords);
	if (!err)
		err = upload_expanded(frame);
	return err;
}

/* --- Trees ------------------------------------------------------------------------------------------------------- */

static const struct scene_mesh *mesh_of(const struct frame *frame, uint32_t i)
{
	return frame->scene->meshes[frame->scene->instances[frame->prepared.instances[i].scene_instance].mesh];
}

/*
 * 1 if a program puts an instance's vertices where its modelview would. It then uses the tree of the mesh, however the
 * camera moves. eye: eye-space positions from the program
 */
static int is_in_place(const struct frame *frame, uint32_t i, const float (*eye)[4])
{
	const struct scene_instance *from = &frame->scene->instances[frame->prepared.instances[i].scene_instance];
	const struct scene_mesh *mesh = mesh_of(frame, i);
	float size = 0, at[4];

	for (uint32_t v = 0; v < mesh->vertex_count; v++)
		for (int a = 0; a < 4; a++)
			size = fmaxf(size, fabsf(eye[v][a]));
	for (uint32_t v = 0; v < mesh->vertex_count; v++) {
		mat4_transform(at, from->modelview, mesh->position + 4 * (size_t)v);
		for (int a = 0; a < 4; a++)
			if (!(fabsf(at[a] - eye[v][a]) <= 1e-6f * size))
				return 0;
	}
	return 1;
}

/* Read the eye-space positions of baked instances; *out is NULL if there are none. Instances that a program left in
 * place are no longer baked. */
static int read_baked(struct frame *frame, float (**out)[4])
{
	struct prepared *p = &frame->prepared;
	int err = 0;

	*out = NULL;
	for (uint32_t i = 0; i < p->n_instances && !err; i++) {
		const struct geometry *g = &p->geometries[i];
		struct shaded_vertex *vertices;

		if (!(p->instances[i].flags & INSTANCE_BAKED) || g->vertex_count == 0)
			continue;
		if (!*out)
			*out = calloc(p->n_vertices, sizeof(**out));
		vertices = malloc(g->vertex_count * sizeof(*vertices));
		if (!*out || !vertices) {
			free(vertices);
			return err_report(ERR_SYSTEM, NULL, "out of memory");
		}
		err = device_read(frame->tr->dev, frame->tr->placed.vertices.buffer,
		                  g->vertex_first * sizeof(*vertices), vertices, g->vertex_count * sizeof(*vertices));
		for (uint32_t v = 0; v < g->vertex_count; v++)
			memcpy((*out)[g->vertex_first + v], vertices[v].eye, sizeof(**out));
		free(vertices);
		if (err ||
		    !prepare_is_displaced(frame->scene, &frame->scene->instances[p->instances[i].scene_instance]))
			continue;
		if (is_in_place(frame, i, (const float (*)[4])*out + g->vertex_first))
			prepare_place(p, frame->scene, i);
		prepare_pad(p, i,
		            p->instances[i].flags & INSTANCE_BAKED ? (const float(*)[4]) * out + g->vertex_first :
		                                                     (const float(*)[4])mesh_of(frame, i)->position,
		            g->vertex_count);
	}
	return err;
}

/* Number the primitives of the frame's instances in draw order, counted after expansion. */
static int number_primitives(struct frame *frame)
{
	const struct scene *scene = frame->scene;
	struct prepared *p = &frame->prepared;
	uint32_t *next = calloc((size_t)scene->n_instances + 1, sizeof(*next)), total = 0;

	if (!next)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t i = 0; i < p->n_instances; i++) {
		uint32_t from = p->instances[i].scene_instance;

		next[from] += frame->extra[i] ? frame->extra[i]->primitive_count :
		                              scene->meshes[scene->instances[from].mesh]->primitive_count;
	}
	for (uint32_t i = 0; i < scene->n_instances; i++) {
		uint32_t count = next[i];

		next[i] = total;
		total += count;
	}
	for (uint32_t i = 0; i < p->n_instances; i++) {
		uint32_t from = p->instances[i].scene_instance;

		p->instances[i].primitive_first = next[from];
		next[from] += frame->extra[i] ? frame->extra[i]->primitive_count :
		                              scene->meshes[scene->instances[from].mesh]->primitive_count;
	}
	free(next);
	return 0;
}

static int build_trees(struct frame *frame)
{
	struct tracer *tr = frame->tr;
	struct prepared *p = &frame->prepared;
	struct scene scene = *frame->scene; /* with a view for each segment */
	float (*baked)[4];
	int err = read_baked(frame, &baked);

	if (!err)
		err = number_primitives(frame);
	tr->accel->kind = frame->scene->kd_tree && !frame->options->accel_asked ? ACCEL_KD : frame->options->accel;
	tr->accel->store = frame->options->store;
	scene.views = p->scene_views;
	scene.n_views = p->n_views;
	if (!err)
		err = accel_build_frame(tr->accel, &scene, frame->extra, (const float (*)[4])baked, p->instances,
		                        p->n_instances, p->views, &frame->spaces, &frame->n_spaces);
	free(baked);
	if (!err)
		err = launch_upload(tr->dev, tr->placed.views, p->views, p->n_views);
	if (!err)
		err = upload_indices(frame);
	if (!err)
		err = launch_upload(tr->dev, tr->placed.geometries, p->geometries, p->n_instances);
	if (!err)
		err = opacity_place(frame);
	if (!err)
		err = upload_trees(frame);
	return err;
}

/* If programs apply their own projections, eye space is known only after they have run. */
static int find_perspectives(struct frame *frame)
{
	int changed = 0, err = frame->prepared.has_vertex_programs ? perspective_find(frame, &changed) : 0;

	if (!err && changed)
		err = launch_upload(frame->tr->dev, frame->tr->placed.views, frame->prepared.views,
		                    frame->prepared.n_views);
	if (!err && changed)
		err = run_vertices(frame, 0, 0);
	return err || !frame->prepared.has_vertex_programs ? err : perspective_check_depths(frame);
}

int geometry_place(struct frame *frame)
{
	int err = upload_vertex_stage(frame);

	if (!err)
		err = run_vertices(frame, 0, 0);
	if (!err)
		err = find_perspectives(frame);
	if (!err)
		err = expand_all(frame);
	return err ? err : build_trees(frame);
}

int geometry_can_move(const struct frame *frame)
{
	int filled = frame->scene->samples <= 1;

	for (uint32_t i = 0; i < frame->prepared.n_instances && filled; i++)
		filled = frame->prepared.shapes[i] == PREPARED_FILLED;
	return filled;
}

int geometry_move(struct frame *frame)
{
	struct tracer *tr = frame->tr;
	const struct prepared *p = &frame->prepared;
	const struct placed_buffers *b = &tr->placed;
	int err = launch_upload(tr->dev, tr->placed.views, p->views, p->n_views);

	return err ? err :
	             launch_window(tr->dev, p->n_vertices,
	                           LAUNCH(window, .geometries = b->geometries, .views = b->views, .owners = b->owners,
	                                  .clips = b->clips, .height = frame->height, .n = p->n_vertices,
	                                  .windows = b->windows));
}
