/* Pictures owned by the tracer. The last one drawn is kept, because the next scene requested is often the same. */
#pragma once

#include "scene/scene.h"

struct picture_kept {
	uint64_t serial; /* serial number of its scene; 0: no picture is kept */
	uint32_t n_instances, n_clears; /* counts in the scene */
	int is_start_there;
	int is_whole; /* 1: all its pixels are known */
	struct scene_picture *picture;
};

/** Create the picture of a scene, not drawn yet. @return NULL: out of memory */
struct scene_picture *picture_blank(const struct scene *scene);

/** Free a picture; NULL is allowed. */
void picture_free(struct scene_picture *picture);

/** Replace the kept picture by a copy of this one. If memory runs out, no picture is kept. */
void picture_keep(struct picture_kept *kept, const struct scene *scene, const struct scene_picture *picture);

/** Get the kept picture. @return 1 if it is this scene's; `picture` is then filled in */
int picture_recall(const struct picture_kept *kept, const struct scene *scene, struct scene_picture *picture);

/**
 * Make a scene of the draws added to this one since its picture was kept; it starts from that picture. Without this, a
 * frame of n draws that each copy pixels would be redrawn n times.
 * @param rest  receives a scene that borrows all arrays except its clears; free those with free()
 * @return 0: no picture is kept that the rest could be drawn over
 */
int picture_rest(const struct picture_kept *kept, const struct scene *scene, struct scene *rest);

void picture_kept_free(struct picture_kept *kept);
