/*
 * Matching draws of two frames, by number: the n-th draw of a mesh in one frame matches its n-th draw in the other.
 * Draws without a match are paired by their points, whatever their triangles (quads that leave the view may be split
 * the other way), or else by their triangles, whatever their points. Pixel rectangles have no match.
 */
#pragma once

#include "base/table.h"
#include "scene/scene.h"

/* All zero: no frame. */
struct followed {
	struct table by[3]; /* by mesh, points and triangles: key with the number of equal draws before it ->
	                       instance + 1 */
};

/** Sort the draws of a frame. @return 0 or ERR_SYSTEM (reported) */
int followed_note(struct followed *p, const struct scene *scene);
void followed_free(struct followed *p);

/** The key of a mesh's points. */
uint64_t followed_points(const struct scene_mesh *mesh);

/** The key of a mesh's triangles: the numbers of their points, wherever these are. */
uint64_t followed_triangles(const struct scene_mesh *mesh);

/**
 * Find the matches of another frame's draws.
 * @param out  [scene.n_instances]: the instance in the sorted frame, or SCENE_NONE
 * @return 0 or ERR_SYSTEM (reported)
 */
int followed_find(const struct followed *p, const struct scene *scene, uint32_t *out);
