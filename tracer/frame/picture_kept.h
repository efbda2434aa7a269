/* Pictures that the tracer holds itself. The one that was drawn last is kept: the scene that asks next is often the
 * same. */
#pragma once

#include "scene/scene.h"

struct picture_kept {
	uint64_t serial; /* of its scene; 0: there is none */
	uint32_t n_instances, n_clears; /* that the scene had */
	int is_start_there;
	int is_whole; /* 1: all is known that it shows */
	struct scene_picture *picture;
};

/** A scene's picture, not drawn yet. @return NULL: out of memory */
struct scene_picture *picture_blank(const struct scene *scene);

/** NULL is allowed. */
void picture_free(struct scene_picture *picture);

/** Keep a copy of a scene's picture in place of what was kept. Where memory is short, nothing is kept. */
void picture_keep(struct picture_kept *kept, const struct scene *scene, const struct scene_picture *picture);

/** @return 1 where this scene's picture is kept; `picture` is filled then */
int picture_recall(const struct picture_kept *kept, const struct scene *scene, struct scene_picture *picture);

/**
 * What was added to a scene since its picture was kept, as a scene that begins with that picture. A frame of n draws,
 * each of which copies pixels, would otherwise be drawn n times over.
 * @param rest  receives a scene that borrows all arrays but its clears, which free() takes
 * @return 0: no picture of it is kept that the rest can be drawn over
 */
int picture_rest(const struct picture_kept *kept, const struct scene *scene, struct scene *rest);

void picture_kept_free(struct picture_kept *kept);
