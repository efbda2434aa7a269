/*
 * For motion vectors: what is known of the frames before those that are handed out. The thread that decodes notes them,
 * workers ask and drop.
 */
#pragma once

#include <pthread.h>

#include "render/vectors.h"
#include "replay/replay.h"

struct earlier {
	struct vectors_frame *last; /* the frame that was decoded last; NULL: none yet */
	uint64_t last_number;
	pthread_mutex_t lock; /* of what follows */
	struct earlier_frame {
		struct vectors_frame *before; /* NULL: nothing is before the first frame */
		uint64_t frame;               /* that it comes before */
		struct earlier_frame *next;
	} *frames;
};

void earlier_init(struct earlier *e);
void earlier_free(struct earlier *e);

/** Note where everything is in a frame, for the one after it. @return 0 or ERR_SYSTEM (reported) */
int earlier_note(struct earlier *e, const struct scene *scene);

/** Decode the frame before one, unless it was the last, and keep what is to be known of it. @return 1; 0: the recording
 * ends before it; ERR_* (reported) */
int earlier_decode(struct earlier *e, struct replay *replay, uint64_t frame);

/** What is known of the frame before one; stays until earlier_drop. NULL: nothing */
const struct vectors_frame *earlier_of(struct earlier *e, uint64_t frame);
void earlier_drop(struct earlier *e, uint64_t frame);
