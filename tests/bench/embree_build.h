/*
 * Embree's builders on the triangles of a bench_mesh: rtcBuildBVH, whose callbacks leave a binary tree that we can look
 * at, and rtcCommitScene, which makes all that its own traversal wants.
 */
#pragma once

#include "tests/bench/rtcore.h"

#include "verbs/render/bench/bench.h"

struct embree_build;

/** @return 0 or ERR_SYSTEM (reported) */
int embree_build_create(const struct bench_mesh *mesh, unsigned threads, struct embree_build **out);
void embree_build_destroy(struct embree_build **b);

/**
 * A binary tree with leaves of at most leaf_max triangles, at the costs of bvh_cost.
 * @param nodes    NULL: only time it; else receives the tree as ours: an array to be freed by the caller. Leaves count,
 *                 but do not say which triangles they hold
 * @param seconds  what the build alone took, copying of boxes and of the tree left out
 */
int embree_build_tree(struct embree_build *b, enum RTCBuildQuality quality, uint32_t leaf_max, struct node2 **nodes,
                      uint32_t *n_nodes, double *seconds);

/** A scene ready to be traced; everything is made anew. */
int embree_build_scene(struct embree_build *b, enum RTCBuildQuality quality, double *seconds);
