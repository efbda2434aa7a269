#include "tracer/frame/light/emitters.h"

#include <math.h>
#include <stdlib.h>

#include "base/err.h"
#include "kernels/frame/light/emitter.h"
#include "tracer/frame/light/buffers.h"

/* A list under construction. sums: running sum up to each emitter, finally converted to its `end`, a fraction of the
 * total. */
struct making {
	struct emitter *list;
	double *sums;
	uint32_t n, room;
	double area; /* area of the current space's emitters */
};

static int add_emitter(struct making *m, uint32_t instance, uint32_t primitive, double sum)
{
	if (m->n == m->room) {
		const uint32_t room = m->room ? 2 * m->room : 64;
		struct emitter *list = realloc(m->list, room * sizeof(*list));
		double *sums = list ? realloc(m->sums, room * sizeof(*sums)) : NULL;

		if (list)
			m->list = list;
		if (!sums)
			return err_report(ERR_SYSTEM, NULL, "out of memory");
		m->sums = sums;
		m->room = room;
	}
	m->list[m->n] = (struct emitter){ .instance = instance, .primitive = primitive };
	m->sums[m->n++] = sum;
	return 0;
}

/* Transform a vertex to eye space. */
static void place_vertex(const float *modelview, const float *position, double out[3])
{
	double v[4];

	for (int row = 0; row < 4; row++)
		v[row] = (double)modelview[row] * (double)position[0] +
		         (double)modelview[4 + row] * (double)position[1] +
		         (double)modelview[8 + row] * (double)position[2] +
		         (double)modelview[12 + row] * (double)position[3];
	for (int i = 0; i < 3; i++)
		out[i] = v[i] / v[3];
}

static double triangle_area(const struct scene_mesh *mesh, const float *modelview, uint32_t primitive)
{
	double corner[3][3], a[3], b[3], n[3];

	for (int k = 0; k < 3; k++)
		place_vertex(modelview, mesh->position + 4 * mesh->index[3 * primitive + (uint32_t)k], corner[k]);
	for (int i = 0; i < 3; i++) {
		a[i] = corner[1][i] - corner[0][i];
		b[i] = corner[2][i] - corner[0][i];
	}
	for (int i = 0; i < 3; i++)
		n[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
	return sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
}

/* Add the triangles of an instance. sum: area times strength of all triangles so far, updated. */
static int add_instance(const struct frame *frame, uint32_t transport, struct making *making, uint32_t i, double *sum)
{
	const struct prepared *p = &frame->prepared;
	const struct scene_instance *from = &frame->scene->instances[p->instances[i].scene_instance];
	const struct scene_mesh *mesh = frame->scene->meshes[from->mesh];
	const float strength = emitter_strength(transport, &frame->scene->materials[from->material], mesh->attributes);
	int err = 0;

	if (!(p->instances[i].flags & INSTANCE_SECONDARY) || p->instances[i].flags & INSTANCE_SKY ||
	    p->shapes[i] != PREPARED_FILLED || !(strength > 0))
		return 0;
	for (uint32_t k = 0; k < mesh->primitive_count && !err; k++) {
		const double light = triangle_area(mesh, from->modelview, k) * (double)strength;

		if (!(light > 0) || !isfinite(light))
			continue;
		*sum += light;
		making->area += light / (double)strength;
		err = add_emitter(making, i, k, *sum);
	}
	return err;
}

/* Area of the box around everything that rays can hit in a space. */
static double box_area(const struct frame *frame, const struct accel_space *space)
{
	const struct node2 *root = &frame->tr->accel->top2[space->top2_first];
	double size[3];

	for (int i = 0; i < 3; i++)
		size[i] = (double)fmaxf(root->hi[0][i], root->hi[1][i]) - (double)fminf(root->lo[0][i], root->lo[1][i]);
	return 2 * (size[0] * size[1] + size[1] * size[2] + size[2] * size[0]);
}

/* Append all emitters of a space to the list. If they are half of the surroundings, rays hit them by chance, so none is
 * sampled. */
static int add_space(const struct frame *frame, uint32_t transport, struct making *making,
                     const struct accel_space *space, struct emission_list *out)
{
	const struct prepared *p = &frame->prepared;
	double sum = 0;
	int err = 0;

	out->first = making->n;
	making->area = 0;
	for (uint32_t i = 0; i < p->n_instances && !err; i++)
		if (p->scene_views[p->instances[i].view].space == space->space)
			err = add_instance(frame, transport, making, i, &sum);
	if (making->area > box_area(frame, space) / 2)
		making->n = out->first;
	out->n = making->n - out->first;
	out->emitted = (float)sum;
	for (uint32_t i = out->first; i < making->n; i++)
		making->list[i].end = (float)(making->sums[i] / sum);
	return err;
}

int emitters_place(struct frame *frame, uint32_t transport)
{
	struct making making = { 0 };
	int err = launch_reserve(frame->tr->dev, frame->tr->light->emitters, 1); /* kernels need the buffer even if it
	                                                                            is empty */

	if (err || transport < TRANSPORT_PATH)
		return err;
	frame->emissions = calloc(frame->n_spaces + (size_t)1, sizeof(*frame->emissions));
	if (!frame->emissions)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t i = 0; i < frame->n_spaces && !err; i++)
		if (!frame->spaces[i].sky && frame->spaces[i].n_nodes)
			err = add_space(frame, transport, &making, &frame->spaces[i], &frame->emissions[i]);
	if (!err && making.n)
		err = launch_upload(frame->tr->dev, frame->tr->light->emitters, making.list, making.n);
	free(making.list);
	free(making.sums);
	return err;
}

struct emission_launch emitters_of(const struct frame *frame, const struct accel_space *space)
{
	const struct emission_list none = { 0 },
				   *e = frame->emissions ? &frame->emissions[space - frame->spaces] : &none;

	return (struct emission_launch){ .emitters = frame->tr->light->emitters,
		                         .emitter_first = e->first,
		                         .n_emitters = e->n,
		                         .emitted = e->emitted };
}
