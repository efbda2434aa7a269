/*
 * Embree's builders on the triangles of a bench_mesh: rtcBuildBVH, whose callbacks make a binary tree for inspection,
 * and rtcCommitScene, which builds everything for Embree's own traversal.
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
 * @param nodes    NULL: only measure time; else receives the tree in our format: an array that the caller frees. Leaves
 * have
 *                 counts, but not their triangles
 * @param seconds  time of the build alone, without copying boxes and the tree
 */
int embree_build_tree(struct embree_build *b, enum RTCBuildQuality quality, uint32_t leaf_max, struct node2 **nodes,
                      uint32_t *n_nodes, double *seconds);

/** A scene ready for tracing; everything is rebuilt. */
int embree_build_scene(struct embree_build *b, enum RTCBuildQuality quality, double *seconds);
