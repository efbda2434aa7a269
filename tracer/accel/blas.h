/*
 * A bottom level: all trees over one mesh in the forms that kernels walk, as parts that go into the pools of struct accel.
 */
#ifndef TRACER_ACCEL_BLAS_H
#define TRACER_ACCEL_BLAS_H

#include "kernels/shared.h"
#include "tracer/accel/tree.h"

/* Which eight-wide trees there are beside the binary ones. */
#define ACCEL_ROWS 1u       /* nodes8, triangles8, faces8 */
#define ACCEL_COMPRESSED 2u /* nodes8c, triangles8c */

enum bottom_part {
	BOTTOM_NODES2,      /* struct node2 */
	BOTTOM_TRIANGLES,   /* struct triangle, leaf order of nodes2 */
	BOTTOM_NODES8,      /* struct node8 */
	BOTTOM_TRIANGLES8,  /* struct triangle8, leaf order of nodes8 */
	BOTTOM_FACES8,      /* struct face8, one for each triangle8 */
	BOTTOM_NODES8C,     /* struct node8c */
	BOTTOM_TRIANGLES8C, /* struct triangle, leaf order of nodes8c */
	N_BOTTOM_PARTS
};

/** Size of an item of each part. */
extern const size_t bottom_item_bytes[N_BOTTOM_PARTS];

/* Indices inside nodes are relative to the first item of the part that they lead to. */
struct bottom {
	void *parts[N_BOTTOM_PARTS]; /* NULL where there is nothing */
	size_t n[N_BOTTOM_PARTS];
	struct bvh_box box;   /* around all; empty where there is nothing to hit */
	uint64_t topology[2]; /* hash of the mesh's indices where the tree may be fitted to other vertices; 0 0: it may not */
	double built_cost;    /* bvh_cost when the tree was built, not fitted; with a topology only */
};

/**
 * Make the parts out of a binary tree.
 *
 * @param wide  of ACCEL_ROWS and ACCEL_COMPRESSED
 * @param out   receives parts, n and box, to be freed with bottom_free, also after an error; what else it holds stays
 * @return 0 or ERR_SYSTEM (reported)
 */
int bottom_make(const struct soup *soup, const struct tree *tree, unsigned wide, struct bottom *out);
void bottom_free(struct bottom *bottom);

/** Memory that the parts take. */
size_t bottom_bytes(const struct bottom *bottom);

#endif
