/*
 * Projections that vertex programs apply themselves. A vertex program may take its matrices from its parameters, so
 * that the recorded projection does not describe where it puts vertices. The projection is derived from the clip
 * positions that the program writes: x, y and w are those of an eye at the origin except for two factors.
 */
#pragma once

struct frame;

/**
 * Set a perspective for views that have none and are drawn only by programs, with varying w. Call after the vertex
 * stage. If *changed is set, eye positions have changed and the vertex stage must run again.
 * @return 0 or ERR_* (reported, except ERR_MEMORY)
 */
int perspective_find(struct frame *frame, int *changed);

/**
 * Use columns for segments where a program's depths differ from the projection's: the nearest fragment along a ray need
 * not be the nearest by depth there. Call after perspective_find.
 * @return 0 or ERR_* (reported, except ERR_MEMORY)
 */
int perspective_check_depths(struct frame *frame);
