/*
 * A BLAS (bottom level acceleration structure): the trees over one mesh in every form that kernels traverse. Its parts
 * are copied into the pools of struct accel.
 */
#pragma once

#include "kernels/shared.h"
#include "tracer/accel/tree.h"

/* Eight-wide trees to build besides the binary one. */
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

/* Indices in nodes are relative to the first item of the part they point into. */
struct blas {
	void *parts[N_BLAS_PARTS]; /* NULL if the part is empty */
	size_t n[N_BLAS_PARTS];
	struct bvh_box box;   /* bounds of everything; empty if there is nothing to hit */
	uint64_t topology[2]; /* hash of the mesh's indices if the tree may be refitted to other vertices; else 0 0 */
	double built_cost;    /* bvh_cost of the tree when it was built; set only with a topology */
};

/**
 * Make the parts from a binary tree.
 *
 * @param wide  which of ACCEL_ROWS and ACCEL_COMPRESSED to build
 * @param out   receives parts, n and box; other fields are unchanged; free with blas_free, also after an error
 * @return 0 or ERR_SYSTEM (reported)
 */
int blas_make(const struct soup *soup, const struct tree *tree, unsigned wide, struct blas *out);
void blas_free(struct blas *blas);

/** Memory of all parts. */
size_t blas_bytes(const struct blas *blas);
