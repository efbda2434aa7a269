/*
 * Pixels for a replay that asks for them (scene_supply): a tracer of its own, on a queue of its own of a device that others
 * use as well, made when the first picture is asked for. Used by the thread that decodes.
 */
#ifndef TRACER_RENDER_SUPPLY_H
#define TRACER_RENDER_SUPPLY_H

#include "replay/replay.h"
#include "tracer/frame/trace.h"

struct supply {
	struct device *parent; /* borrowed */
	struct blas_cache *cache; /* BLASes that it shares with others; borrowed, or NULL */
	struct device *dev;    /* owned: shares the parent's device */
	struct tracer *tracer; /* owned */
};

/** A scene_supply; user is a struct supply with nothing but its parent and cache set. */
int supply_picture(void *user, const struct scene *scene, struct scene_picture *picture);
void supply_free(struct supply *supply);

#endif
