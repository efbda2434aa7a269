/* Draws of the same points in one frame: a mesh drawn both upright and flattened, or on both sides of a mirror. */
#pragma once

#include "base/table.h"
#include "look/draws/modelview.h"
#include "scene/scene.h"

/* All zero: empty. */
struct pairs {
	struct table first; /* points and kind of modelview -> instance + 1 */
	uint32_t *next;     /* [instances]: the next instance with the same key, or SCENE_NONE */
	uint64_t *points;   /* [meshes]: hash of the points of its triangles */
};

/** Sort the filled, depth-tested draws of a frame. @return 0 or ERR_SYSTEM (reported) */
int pairs_make(struct pairs *p, const struct scene *scene);
void pairs_free(struct pairs *p);

/** The first draw of an instance's points under a kind of modelview; pairs.next links to the others. SCENE_NONE: there
 * is none */
uint32_t pairs_find(const struct pairs *p, const struct scene *scene, uint32_t instance, enum modelview_kind kind);
