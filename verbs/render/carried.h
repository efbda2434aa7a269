/*
 * What the worker processes of one run hand on to each other (guard.h): faults, frames that are done, and all that the
 * run tells in the end. It lies in memory that they share, so a process that ends at any moment leaves it there.
 */
#pragma once

#include "base/err.h"
#include "base/progress.h"
#include "tracer/device/outcome.h"
#include "tracer/frame/trace.h"
#include "verbs/render/guard.h"

#define CARRIED_FRAMES (1u << 24) /* later ones are rendered again after a fault */

struct carried {
	struct guard guard;
	struct outcome_run run;   /* faults of earlier workers; families that had them are not taken again */
	uint64_t made, made_then; /* frames traced; and when a frame failed alone last */
	unsigned in_row;          /* frames that have failed alone since then */
	int64_t first;            /* the frame of the last fault, which is tried first; FAULT_NO_FRAME: none */
	int one_by_one;           /* 1: one frame is under way at a time, so that a fault names it */
	int is_confirmed;         /* carried_confirms was 1 since the last fault */
	struct progress progress;
	int has_begun;            /* so has the progress */
	struct tracer_undrawn undrawn;
	struct tracer_added added;
	int has_dome;             /* 1: some frame was lit from all around */
	int lacks;                /* 1: frames that were decoded lack something that only replay has shown */
	uint64_t pixels, bright;  /* of display pictures, and how many of these are brighter than white */
	struct err_lines lines;
	unsigned char done[CARRIED_FRAMES / 8];
};

/** A frame is on disk, or has failed for good. */
void carried_set_done(struct carried *c, uint64_t frame);
int carried_is_done(const struct carried *c, uint64_t frame);

/**
 * In a new worker: take over the fault that ended the one before.
 * @return 0, or ERR_SYSTEM (reported): it came where no other family helps
 */
int carried_take_fault(struct carried *c);

/** A frame was traced. @return 1: it is the first by the device that had the last fault (outcome_confirm) */
int carried_confirms(struct carried *c, const struct device *dev);

/**
 * Every family that a device may run has failed in this run. Where all failed on one frame, and others were made, that
 * one fails alone. Where each had another frame, or one of several, they are tried once more.
 * @return 1: all families count as untried again; 0: the device is of no use
 */
int carried_blame_frame(struct carried *c);
