/*
 * A picture to be made, and the recorded frames that it takes: the one that it shows, those about its moment and while
 * the shutter is open, and the one before for motion vectors. Pictures share frames.
 */
#pragma once

#include <stdatomic.h>

#include "look/between/between.h"
#include "verbs/render/moments.h"

/* A recorded frame. */
struct shared_scene {
	struct scene *scene;
	struct shared_scene *next; /* the frame behind it; NULL: not there yet. Set, like `after`, before a shot needs it */
	struct interval *after;    /* the time up to that; NULL: no picture shows it */
	atomic_uint users;
};

struct shot {
	struct shared_scene *of; /* the first frame that it takes */
	uint64_t first;          /* its number */
	uint64_t number;         /* in file names: the frame's, or the picture's */
	double replay_s;         /* that playing the recording up to it has taken */
};

void shot_leave_scene(struct shared_scene **shared);
void shot_drop(struct shot **shot);

/**
 * The scene of a shot's moment, or of one before or after it. What cannot be mixed, as texts, is that of the frame
 * nearest to the shot, whichever moment that is. Beyond a cut is no scene: the last one on this side takes its place.
 * @param after  as of moments_at; the shot has taken frames that far
 * @param room   all zero; holds a scene that had to be made: between_release
 * @param scene  receives it; it lives as long as the shot and room do
 * @return 0 or ERR_SYSTEM (reported)
 */
int shot_scene(const struct shot *shot, const struct moments *m, double after, struct between *room,
               const struct scene **scene);

/** 1 if a cut is about the shot's moment, and the picture shows the nearer frame. */
int shot_is_at_cut(const struct shot *shot, const struct moments *m);

/** 1 if a cut lies between the shot and the picture before. */
int shot_is_behind_cut(const struct shot *shot, const struct moments *m);
