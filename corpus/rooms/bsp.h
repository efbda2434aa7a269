/*
 * A leaf BSP over the walls. Each node is a wall's plane, each leaf a convex space, solid or empty. Walls are not cut:
 * a leaf lists the walls that bound it, and a wall may bound several leaves.
 */
#pragma once

#include "mesh.h"

/* A child: a node, or a leaf as ~number. */
struct bsp_node {
	struct plane plane;
	int child[2]; /* in front, behind */
};

struct bsp_leaf {
	int solid;
	struct box box;   /* bounds of the parts of walls in it */
	unsigned *faces;  /* owned: numbers of the walls that bound it; none if solid */
	size_t n_faces;
};

struct bsp {
	struct bsp_node *nodes; /* the first is the root; none: leaf 0 is everything */
	size_t n_nodes;
	struct bsp_leaf *leaves;
	size_t n_leaves;
};

/** Build the tree of a mesh's walls. bsp: all zero */
void bsp_build(struct bsp *bsp, const struct mesh *mesh);

/** The leaf that contains a point. */
unsigned bsp_find(const struct bsp *bsp, struct vec p);

/** 1 if nothing solid is between two empty points. */
int bsp_sees(const struct bsp *bsp, struct vec from, struct vec to);

/** As bsp_find, but asks each leaf whether the point is on its side of every plane above it. */
unsigned bsp_find_slowly(const struct bsp *bsp, struct vec p);

void bsp_free(struct bsp *bsp);
