/*
 * A picture to render, and the recorded frames that it needs: the one that it shows, those around its moment and while
 * the shutter is open, and the previous one for motion vectors. Pictures share frames.
 */
#pragma once

#include <stdatomic.h>

#include "look/between/between.h"
#include "verbs/render/moments.h"

/* A recorded frame. */
struct shared_scene {
	struct scene *scene;
	struct shared_scene *next; /* the next frame; NULL: not decoded yet. Set, like `after`, before a shot needs it */
	struct interval *after;    /* from this frame to the next; NULL: no picture shows a moment between them */
	atomic_uint users;         /* shots that start here, the previous frame, and the decoder */
};

struct shot {
	struct shared_scene *of; /* the first frame that it needs; it counts as a user of that one */
	uint64_t first;          /* its number */
	uint64_t number;         /* number in file names: the frame's, or the picture's */
	double replay_s;         /* time taken to play the recording up to it */
};

/** Give up a frame. The last user frees it, and gives up the next one for it. Sets *shared to NULL. */
void shot_leave_scene(struct shared_scene **shared);

/** Free a shot, and give up its frames. Sets *shot to NULL. */
void shot_drop(struct shot **shot);

/**
 * The scene of a shot's moment, or of one before or after it. Parts that cannot be interpolated, such as text, come
 * from the frame nearest to the shot, whatever the moment. Beyond a cut there is no scene: the last one on this side is
 * used.
 * @param after  as for moments_at; the shot has taken the frames that it needs
 * @param room   all zero; holds a scene that had to be made; free with between_release
 * @param scene  receives it; it lives as long as the shot and room do
 * @return 0 or ERR_SYSTEM (reported)
 */
int shot_scene(const struct shot *shot, const struct moments *m, double after, struct between *room,
               const struct scene **scene);

/** 1 if there is a cut at the shot's moment, so that the picture shows the nearer frame. */
int shot_is_at_cut(const struct shot *shot, const struct moments *m);

/** 1 if there is a cut between the shot and the previous picture. */
int shot_is_behind_cut(const struct shot *shot, const struct moments *m);
