/*
 * A BLAS (bottom level acceleration structure): all trees over one mesh in the forms that kernels walk, as parts that go into the pools of struct accel.
 */
#ifndef TRACER_ACCEL_BLAS_H
#define TRACER_ACCEL_BLAS_H

#include "kernels/shared.h"
#include "tracer/accel/tree.h"

/* Which eight-wide trees there are beside the binary ones. */
#define ACCEL_ROWS 1u       /* nodes8, triangles8, faces8 */
#define ACCEL_COMPRESSED 2u /* nodes8c, triangles8c */

enum blas_part {
	BLAS_NODES2,      /* struct node2 */
	BLAS_TRIANGLES,   /* struct triangle, leaf order of nodes2 */
	BLAS_NODES8,      /* struct node8 */
	BLAS_TRIANGLES8,  /* struct triangle8, leaf order of nodes8 */
	BLAS_FACES8,      /* struct face8, one for each triangle8 */
	BLAS_NODES8C,     /* struct node8c */
	BLAS_TRIANGLES8C, /* struct triangle, leaf order of nodes8c */
	N_BLAS_PARTS
};

/** Size of an item of each part. */
extern const size_t blas_item_bytes[N_BLAS_PARTS];

/* Indices inside nodes are relative to the first item of the part that they lead to. */
struct blas {
	void *parts[N_BLAS_PARTS]; /* NULL where there is nothing */
	size_t n[N_BLAS_PARTS];
	struct bvh_box box;   /* around all; empty where there is nothing to hit */
	uint64_t topology[2]; /* hash of the mesh's indices where the tree may be fitted to other vertices; 0 0: it may not */
	double built_cost;    /* bvh_cost when the tree was built, not fitted; with a topology only */
};

/**
 * Make the parts out of a binary tree.
 *
 * @param wide  of ACCEL_ROWS and ACCEL_COMPRESSED
 * @param out   receives parts, n and box, to be freed with blas_free, also after an error; what else it holds stays
 * @return 0 or ERR_SYSTEM (reported)
 */
int blas_make(const struct soup *soup, const struct tree *tree, unsigned wide, struct blas *out);
void blas_free(struct blas *blas);

/** Memory that the parts take. */
size_t blas_bytes(const struct blas *blas);

#endif
