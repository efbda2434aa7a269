/*
 * State that the worker processes of one run pass on to each other (guard.h): faults, finished frames, and the totals
 * reported at the end. It is in shared memory, so it survives the end of any process.
 */
#pragma once

#include "base/err.h"
#include "base/progress.h"
#include "tracer/device/outcome.h"
#include "tracer/frame/trace.h"
#include "verbs/render/guard.h"

#define CARRIED_FRAMES (1u << 24) /* later frames are rendered again after a fault */

struct carried {
	struct guard guard;
	struct outcome_run run;   /* faults of earlier workers; their families are not used again */
	uint64_t made, made_then; /* frames traced; and that number when a frame last failed alone */
	unsigned in_row;          /* frames that have failed alone since then */
	int64_t first;            /* the frame of the last fault, to be tried first; FAULT_NO_FRAME: none */
	int one_by_one;           /* 1: one frame is under way at a time, so that a fault names it */
	int is_confirmed;         /* carried_confirms was 1 since the last fault */
	struct progress progress;
	int has_begun;            /* so has the progress */
	struct tracer_undrawn undrawn;
	struct tracer_added added;
	int has_dome;             /* 1: some frame was lit from all around */
	int lacks;                /* 1: decoded frames lack something that only the replay has revealed */
	uint64_t pixels, bright;  /* pixels of display pictures, and how many of these are brighter than white */
	struct err_lines lines;
	unsigned char done[CARRIED_FRAMES / 8];
};

/** A frame is on disk, or has failed for good. */
void carried_set_done(struct carried *c, uint64_t frame);
int carried_is_done(const struct carried *c, uint64_t frame);

/**
 * In a new worker: take over the fault that ended the previous one.
 * @return 0, or ERR_SYSTEM (reported): no other family can help
 */
int carried_take_fault(struct carried *c);

/** A frame was traced. @return 1: it is the first one by the device that had the last fault (outcome_confirm) */
int carried_confirms(struct carried *c, const struct device *dev);

/**
 * Every family that the device can run has failed in this run. If all failed on the same frame and other frames
 * succeeded, only that frame fails. If they failed on different frames, or with several frames under way, they are
 * tried once more.
 * @return 1: all families count as untried again; 0: the device is of no use
 */
int carried_blame_frame(struct carried *c);
