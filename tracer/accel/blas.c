#include "tracer/accel/blas.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "scene/scene.h"
#include "tracer/accel/bvh.h"
#include "tracer/accel/compress.h"

const size_t blas_item_bytes[N_BLAS_PARTS] = {
	[BLAS_NODES2] = sizeof(struct node2),   [BLAS_TRIANGLES] = sizeof(struct triangle),
	[BLAS_NODES8] = sizeof(struct node8),   [BLAS_TRIANGLES8] = sizeof(struct triangle8),
	[BLAS_FACES8] = sizeof(struct face8),
	[BLAS_NODES8C] = sizeof(struct node8c), [BLAS_TRIANGLES8C] = sizeof(struct triangle),
};

/* Allocate n items of a part, uninitialized. @return NULL: out of memory (reported) */
static void *make_part(struct blas *blas, enum blas_part part, size_t n)
{
	blas->n[part] = n;
	blas->parts[part] = malloc(n * blas_item_bytes[part] + 1);
	if (!blas->parts[part])
		err_report(ERR_SYSTEM, NULL, "acceleration structures: out of memory");
	return blas->parts[part];
}

/* Shrink the allocation of a part to its n items. */
static void cut_part(struct blas *blas, enum blas_part part, size_t n)
{
	void *less = realloc(blas->parts[part], n * blas_item_bytes[part] + 1);

	blas->parts[part] = less ? less : blas->parts[part];
	blas->n[part] = n;
}

static void set_triangle8(struct triangle8 *out, const struct triangle *triangles, uint32_t n)
{
	memset(out, 0, sizeof(*out));
	for (uint32_t lane = 0; lane < 8; lane++) {
		out->primitive[lane] = SCENE_NONE;
		if (lane >= n)
			continue;
		for (int a = 0; a < 3; a++) {
			out->v0[a][lane] = triangles[lane].v0[a];
			out->e1[a][lane] = triangles[lane].e1[a];
			out->e2[a][lane] = triangles[lane].e2[a];
		}
		out->primitive[lane] = triangles[lane].primitive;
	}
}

static void set_face8(struct face8 *out, const struct triangle *triangles, uint32_t n)
{
	memset(out, 0, sizeof(*out));
	for (uint32_t lane = 0; lane < 8; lane++) {
		out->primitive[lane] = lane < n ? triangles[lane].primitive : SCENE_NONE;
		for (int i = 0; i < 3 && lane < n; i++)
			out->vertex[i][lane] = triangles[lane].vertex[i];
	}
}

/* The eight-wide tree in rows. */
static int make_rows(const struct tree *tree, struct blas *blas)
{
	const struct triangle *triangles = blas->parts[BLAS_TRIANGLES];
	uint32_t *first = malloc(2 * ((size_t)tree->n_order + 1) * sizeof(*first)), *count = first + tree->n_order + 1;
	struct node8 *nodes = make_part(blas, BLAS_NODES8, tree->n_nodes);
	uint32_t n_nodes, n_blocks;
	struct triangle8 *blocks;
	struct face8 *faces;
	int err = nodes ? 0 : ERR_SYSTEM;

	if (!first)
		err = err_report(ERR_SYSTEM, NULL, "acceleration structures: out of memory");
	if (!err)
		err = bvh_collapse8(tree->nodes, tree->n_nodes, BVH_BLOCKS, nodes, &n_nodes, first, count, &n_blocks);
	if (err)
		goto done;
	cut_part(blas, BLAS_NODES8, n_nodes);
	blocks = make_part(blas, BLAS_TRIANGLES8, n_blocks);
	faces = make_part(blas, BLAS_FACES8, n_blocks);
	err = blocks && faces ? 0 : ERR_SYSTEM;
	for (uint32_t i = 0; i < n_blocks && !err; i++) {
		set_triangle8(&blocks[i], triangles + first[i], count[i]);
		set_face8(&faces[i], triangles + first[i], count[i]);
	}
done:
	free(first);
	return err;
}

static int make_compressed(const struct tree *tree, struct blas *blas)
{
	struct node8c *nodes = make_part(blas, BLAS_NODES8C, BVH_COMPRESSED_NODES(tree->n_nodes, tree->n_order));
	struct triangle *triangles = make_part(blas, BLAS_TRIANGLES8C, tree->n_order);
	uint32_t n_nodes;
	int err = nodes && triangles ? 0 : ERR_SYSTEM;

	if (!err)
		err = bvh_compress8(tree->nodes, tree->n_nodes, blas->parts[BLAS_TRIANGLES], tree->n_order, nodes,
		                    &n_nodes, triangles);
	if (!err)
		cut_part(blas, BLAS_NODES8C, n_nodes);
	return err;
}

int blas_make(const struct soup *soup, const struct tree *tree, unsigned wide, struct blas *out)
{
	struct node2 *nodes = make_part(out, BLAS_NODES2, tree->n_nodes);
	struct triangle *triangles = make_part(out, BLAS_TRIANGLES, tree->n_order);
	int err = nodes && triangles ? 0 : ERR_SYSTEM;

	if (err)
		return err;
	out->box = soup->box;
	memcpy(nodes, tree->nodes, tree->n_nodes * sizeof(*nodes));
	for (uint32_t i = 0; i < tree->n_order; i++)
		triangles[i] = soup->triangles[tree->order[i]];
	if (wide & ACCEL_ROWS)
		err = make_rows(tree, out);
	if (!err && wide & ACCEL_COMPRESSED)
		err = make_compressed(tree, out);
	return err;
}

void blas_free(struct blas *blas)
{
	for (int part = 0; part < N_BLAS_PARTS; part++)
		free(blas->parts[part]);
	*blas = (struct blas){ .n = { 0 } };
}

size_t blas_bytes(const struct blas *blas)
{
	size_t bytes = 0;

	for (int part = 0; part < N_BLAS_PARTS; part++)
		bytes += blas->n[part] * blas_item_bytes[part];
	return bytes;
}
