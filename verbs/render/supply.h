/*
 * Gives a replay the pixels that it asks for (scene_supply): a tracer on a queue of its own, on a device that others
 * use too. Both are made for the first picture. Only the thread that decodes uses it.
 */
#pragma once

#include "scene/scene.h"
#include "tracer/frame/trace.h"

struct supply {
	struct device *parent; /* borrowed */
	struct blas_cache *cache; /* BLASes that it shares with others; borrowed, or NULL */
	const uint64_t *number; /* of the frame that needs the picture; borrowed, or NULL */
	struct device *dev;    /* owned: shares the parent's device */
	struct tracer *tracer; /* owned */
};

/** A scene_supply; user is a struct supply, whose caller sets what is borrowed. */
int supply_picture(void *user, const struct scene *scene, struct scene_picture *picture);
void supply_free(struct supply *supply);
