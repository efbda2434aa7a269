/*
 * Supplies the pixels that a replay asks for (scene_supply), with a tracer on a separate queue of a shared device. Both
 * are created for the first picture. Only the decoding thread uses it.
 */
#pragma once

#include "scene/scene.h"
#include "tracer/frame/trace.h"

struct supply {
	struct device *parent; /* borrowed */
	struct blas_cache *cache; /* BLASes that it shares with others; borrowed, or NULL */
	const uint64_t *number; /* number of the frame that needs the picture; borrowed, or NULL */
	struct device *dev;    /* owned: shares the parent's device */
	struct tracer *tracer; /* owned */
};

/** A scene_supply. `user` is a struct supply, whose borrowed members the caller has set. */
int supply_picture(void *user, const struct scene *scene, struct scene_picture *picture);
void supply_free(struct supply *supply);
