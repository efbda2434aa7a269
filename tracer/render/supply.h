/*
 * Pixels for a replay that asks for them (replay_supply): a tracer of its own, on a queue of its own of a device that others
 * use as well, made when the first picture is asked for. Used by the thread that decodes.
 */
#ifndef TRACER_RENDER_SUPPLY_H
#define TRACER_RENDER_SUPPLY_H

#include "replay/replay.h"
#include "tracer/frame/trace.h"

struct feed {
	struct device *parent; /* borrowed */
	struct grove *grove;   /* trees that it shares with others; borrowed, or NULL */
	struct device *dev;    /* owned: shares the parent's device */
	struct tracer *tracer; /* owned */
};

/** A replay_supply; user is a struct feed with nothing but its parent and grove set. */
int feed_supply(void *user, const struct scene *scene, struct scene_picture *picture);
void feed_free(struct feed *feed);

#endif
