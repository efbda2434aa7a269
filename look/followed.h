/*
 * The same draws of two frames, by number: the n-th draw of a mesh in one is the n-th draw of it in the other. Draws
 * without such a partner are paired by their points, whatever their triangles (quads that leave the view may be cut the
 * other way), or else by their triangles, whatever their points. Pixel rectangles have none.
 */
#pragma once

#include "base/table.h"
#include "scene/scene.h"

/* All zero: no frame. */
struct followed {
	struct table by[3]; /* mesh, points, triangles: keys with the number of the same before -> instance + 1 */
};

/** Sort a frame's draws. @return 0 or ERR_SYSTEM (reported) */
int followed_note(struct followed *p, const struct scene *scene);
void followed_free(struct followed *p);

/** The key of a mesh's points. */
uint64_t followed_points(const struct scene_mesh *mesh);

/** The key of a mesh's triangles: which points each has, wherever those are. */
uint64_t followed_triangles(const struct scene_mesh *mesh);

/**
 * Find those of another frame.
 * @param out  [scene.n_instances]: the sorted frame's instance, or SCENE_NONE
 * @return 0 or ERR_SYSTEM (reported)
 */
int followed_find(const struct followed *p, const struct scene *scene, uint32_t *out);
