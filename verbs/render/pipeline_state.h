/* State that the threads of one pipeline share. */
#pragma once

#include <pthread.h>
#include <stdatomic.h>

#include "base/queue.h"
#include "tracer/image/image.h"
#include "verbs/render/alike.h"
#include "verbs/render/pipeline.h"
#include "verbs/render/shot.h"

#define PIPELINE_PATH_BYTES 4096

struct pipeline_state {
	struct pipeline *p;
	struct blas_cache *cache; /* BLASes that the workers share; NULL: there is only one */
	struct queue shots, pictures;
	struct shared_scene *held; /* frames for the pictures to come, and the first of these; NULL: none yet */
	uint64_t held_frame;
	pthread_mutex_t lock; /* guards what follows, and the progress */
	atomic_int err;       /* the first failure */
	int writer_said;      /* a writer has reported its failure */
	struct worker *seats; /* [n_seats]; started as pictures need them */
	size_t n_seats, n_started;
	uint64_t decoded;     /* that frame's number in file names */
	unsigned workers;     /* neither ended nor failed, started or not */
	unsigned at_work;     /* how many of these are started */
	unsigned untraced;    /* pictures handed out and not yet traced */
	unsigned in_flight;   /* pictures handed out and not yet on disk */
	uint64_t frame_bytes; /* most memory that a frame in flight has used so far; 0: not known yet */
	uint64_t idle_bytes;  /* memory used before the first frame */
	pthread_cond_t landed;
	int begun; /* a picture was handed out */
	struct alike alike;     /* reasons for failed frames; under the lock */
};

struct worker {
	struct pipeline_state *state;
	struct device *dev;
	uint64_t done; /* frames that it traced */
	struct tracer_undrawn undrawn; /* counts of its tracer after the last frame */
	struct tracer_added added;     /* the same */
	int seat;
	pthread_t thread;
};

struct picture {
	struct image img;
	uint64_t frame;
	double seconds;
};

/** The first failure ends the run; later ones only follow from it. */
void pipeline_fail(struct pipeline_state *state, int err);

void pipeline_drop_picture(struct picture **picture);

/** A picture is finished, rendered or not. */
void pipeline_land(struct pipeline_state *state);

void pipeline_note(struct pipeline_state *state, uint64_t frame, const char *outcome, double seconds);
/** A frame fails, and the run goes on. */
void pipeline_note_failed(struct pipeline_state *state, uint64_t frame, double seconds, const char *why);
