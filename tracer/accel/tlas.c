#include "tracer/accel/tlas.h"

#include <math.h>
#include <stdlib.h>

#include "base/err.h"
#include "base/memory.h"
#include "tracer/accel/builders.h"
#include "tracer/accel/bvh.h"
#include "tracer/accel/soup.h"

/* Most instances in a leaf. */
#define LEAF_INSTANCES 1

/* Compute the eye-space box of an instance. obj: the box of its BLAS; pad: widens obj by this much. */
static void eye_box(const struct instance *instance, const struct bvh_box *obj, float pad, struct bvh_box *out)
{
	for (int row = 0; row < 3; row++) {
		const float *m = instance->eye_from_obj + 4 * row;
		double lo = m[3], hi = m[3];

		for (int a = 0; a < 3; a++) {
			double x = (double)m[a] * (obj->lo[a] - pad), y = (double)m[a] * (obj->hi[a] + pad);

			lo += x < y ? x : y;
			hi += x < y ? y : x;
		}
		/* Rays transformed to object space are off by rounding. */
		lo -= 1e-6 * (fabs(lo) + (hi - lo));
		hi += 1e-6 * (fabs(hi) + (hi - lo));
		out->lo[row] = (float)(lo > -SOUP_UNBOUNDED ? lo : -SOUP_UNBOUNDED);
		out->hi[row] = (float)(hi < SOUP_UNBOUNDED ? hi : SOUP_UNBOUNDED);
	}
}

/* Input of a TLAS. */
struct top {
	struct bvh_box *boxes;
	uint32_t *items; /* instances */
	uint32_t *order;
	uint32_t n;
};

static void top_add(struct top *top, uint32_t item, const struct instance *instance, const struct bvh_box *obj,
                    float pad)
{
	struct bvh_box *box = &top->boxes[top->n];

	if (obj->lo[0] > obj->hi[0])
		return; /* an empty mesh */
	eye_box(instance, obj, pad, box);
	/* With a matrix that is not finite there is nothing to hit. */
	for (int a = 0; a < 3; a++)
		if (!(box->lo[a] <= box->hi[a]))
			return;
	top->items[top->n++] = item;
}

/* Append a binary tree over `top`, and an eight-wide one if `wide`. */
static int build_top(struct accel *accel, struct top *top, int wide)
{
	struct node2 *nodes2 = accel->top2 + accel->n_top2;
	const struct bvh_input in = { .boxes = top->boxes, .n = top->n, .leaf_max = LEAF_INSTANCES };
	struct tree tree = { .nodes = nodes2, .order = top->order };
	uint32_t n_nodes8;
	int err = bvh_build_sah(&in, &tree);

	if (err)
		return err;
	for (uint32_t i = 0; i < tree.n_nodes; i++)
		for (int side = 0; side < 2; side++)
			if (nodes2[i].count[side])
				nodes2[i].child[side] += (uint32_t)accel->n_instance_list;
	for (uint32_t i = 0; i < top->n; i++)
		accel->instance_list[accel->n_instance_list + i] = top->items[top->order[i]];
	accel->n_instance_list += top->n;
	accel->n_top2 += tree.n_nodes;
	if (!wide)
		return 0;
	err = bvh_collapse8(nodes2, tree.n_nodes, BVH_ITEMS, accel->top8 + accel->n_top8, &n_nodes8, NULL, NULL, NULL);
	if (!err)
		accel->n_top8 += n_nodes8;
	return err;
}

static int build_view_top(struct accel *accel, uint32_t view_index, const struct instance *instances, uint32_t n,
                          const struct bvh_box *boxes, struct top *top, struct view *view)
{
	int err;

	top->n = 0;
	for (uint32_t i = 0; i < n; i++)
		if (instances[i].view == view_index && !(instances[i].flags & INSTANCE_SCREEN))
			top_add(top, i, &instances[i], &boxes[i], instances[i].pad);
	view->tlas_first = (uint32_t)accel->n_top2;
	view->tlas_count = 0;
	if (top->n == 0)
		return 0;
	err = build_top(accel, top, 0);
	view->tlas_count = (uint32_t)accel->n_top2 - view->tlas_first;
	return err;
}

static int build_space_top(struct accel *accel, const struct scene *scene, const struct instance *instances, uint32_t n,
                           const struct bvh_box *boxes, struct top *top, struct accel_space *space)
{
	int err;

	top->n = 0;
	for (uint32_t i = 0; i < n; i++)
		if (scene->views[instances[i].view].space == space->space &&
		    (instances[i].flags & (space->sky ? INSTANCE_SKY : INSTANCE_SECONDARY)) &&
		    !(instances[i].flags & INSTANCE_SCREEN))
			top_add(top, i, &instances[i], &boxes[i], 0);
	space->top2_first = (uint32_t)accel->n_top2;
	space->top8_first = (uint32_t)accel->n_top8;
	space->n_nodes = 0;
	if (top->n == 0)
		return 0;
	err = build_top(accel, top, 1);
	space->n_nodes = (uint32_t)accel->n_top2 - space->top2_first;
	return err;
}

/* List the eye spaces of the scene's views, each once, and once more for its skies. */
static int list_spaces(struct accel *accel, const struct scene *scene, const struct instance *instances, uint32_t n)
{
	uint32_t skies = 0;

	for (uint32_t i = 0; i < n; i++)
		skies |= instances[i].flags & INSTANCE_SKY;
	free(accel->spaces);
	accel->n_spaces = 0;
	accel->spaces = calloc(2 * (size_t)scene->n_views + 1, sizeof(*accel->spaces));
	if (!accel->spaces)
		return err_report(ERR_SYSTEM, NULL, "acceleration structures: out of memory");
	for (uint32_t i = 0; i < scene->n_views; i++) {
		size_t k = 0;

		while (k < accel->n_spaces && accel->spaces[k].space != scene->views[i].space)
			k++;
		if (k < accel->n_spaces)
			continue;
		for (int sky = 0; sky <= (skies != 0); sky++) {
			accel->spaces[accel->n_spaces].space = scene->views[i].space;
			accel->spaces[accel->n_spaces++].sky = sky;
		}
	}
	return 0;
}

/* Allocate for n instances: each may be in the tree of one view, of its space, and of its space's skies. */
static int make_room(struct accel *accel, uint32_t n)
{
	const size_t most = 3 * (size_t)n + 1;
	int err = memory_resize(&accel->top2, most, sizeof(*accel->top2));

	if (!err)
		err = memory_resize(&accel->top8, most, sizeof(*accel->top8));
	if (!err)
		err = memory_resize(&accel->instance_list, most, sizeof(*accel->instance_list));
	accel->n_top2 = accel->n_top8 = accel->n_instance_list = 0;
	return err;
}

int tlas_build(struct accel *accel, const struct scene *scene, const struct instance *instances, uint32_t n,
               const struct bvh_box *boxes, struct view *views)
{
	struct top top = { .boxes = malloc((n + 1) * sizeof(*top.boxes)), .items = malloc((n + 1) * sizeof(*top.items)),
		           .order = malloc((n + 1) * sizeof(*top.order)) };
	int err = top.boxes && top.items && top.order ?
	                  0 :
	                  err_report(ERR_SYSTEM, NULL, "acceleration structures: out of memory");

	if (!err)
		err = make_room(accel, n);
	if (!err)
		err = list_spaces(accel, scene, instances, n);
	for (uint32_t i = 0; i < scene->n_views && !err; i++)
		err = build_view_top(accel, i, instances, n, boxes, &top, &views[i]);
	for (size_t i = 0; i < accel->n_spaces && !err; i++)
		err = build_space_top(accel, scene, instances, n, boxes, &top, &accel->spaces[i]);
	free(top.boxes);
	free(top.items);
	free(top.order);
	return err;
}
