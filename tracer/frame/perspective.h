/*
 * Projections of programs' own. A vertex program may take its matrices from its parameters; the recorded projection
 * then says nothing of where it puts vertices. What it leaves in clip space tells: x, y and w are those of an eye at
 * the origin, but for two factors.
 */
#pragma once

struct job;

/**
 * Give views a perspective that have none, and in which programs alone draw, with different w. After the vertex stage,
 * which is to run again where *changed is set: eye positions are other ones.
 * @return 0 or ERR_* (reported, but for ERR_MEMORY)
 */
int perspective_find(struct job *job, int *changed);

/**
 * Let columns answer for segments in which a program gives vertices another depth than the projection: the nearest
 * along a ray need not be the nearest by depth there. After perspective_find.
 * @return 0 or ERR_* (reported, but for ERR_MEMORY)
 */
int perspective_check_depths(struct job *job);
