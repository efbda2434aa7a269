/*
 * A trace, executed frame by frame from its beginning: a reader, a state machine, and the loop that takes calls from
 * one to the other. Indexes are built and checked with it; replay.h adds seeking and counts.
 *
 * Frame n (from 0) ends with the trace's n-th swap of buffers.
 */
#pragma once

#include "replay/machine/machine.h"
#include "replay/play/tell.h"
#include "replay/trace/reader.h"

/* All zero: closed. */
struct player {
	char *path;
	struct trace_reader *reader;
	struct gls_exec *exec;
	scene_supply *supply; /* NULL: nobody makes pixels */
	void *supply_user;
	int keeps_targets, leaves_starts; /* as in gls_feedback */
	int build_all; /* 1: some frame needs pixels of earlier ones; all that are played are built */
	const char *why; /* which ones it needs, a static string; NULL: none does */
	replay_tell *tell;
	void *tell_user;
	double told_s;
};

/** @return 0, ERR_INPUT or ERR_SYSTEM (reported); the player is closed then */
int player_open(struct player *p, const char *path);
void player_close(struct player *p);

/** As replay_set_supplier. */
void player_set_supplier(struct player *p, scene_supply *supply, void *user);

/** replay_keep_targets. */
void player_keep_targets(struct player *p);

/** replay_leave_starts. */
void player_leave_starts(struct player *p);

/** As replay_next_frame, but a frame that needs pixels of skipped frames is left: 1 is returned and
 * exec->feedback.rewind is set. */
int player_try_frame(struct player *p, int want, struct scene **scene);

/**
 * Read one call and execute it, without building scenes.
 * @param call  receives it, until the next one is read
 * @return 1; 0 at the end; ERR_INPUT or ERR_SYSTEM (reported)
 */
int player_step(struct player *p, const struct call **call);

/** Tell how far frames from `from` to `to` have been played: by `tell`, or every ten seconds as a warning where there
 * is none. */
void player_tell(struct player *p, uint64_t from, uint64_t to);

/** Go on with another state machine, which the player then owns. What was counted so far goes on being counted. */
void player_use(struct player *p, struct gls_exec *x);

/** Go back to the trace's beginning. @return 0, ERR_INPUT or ERR_SYSTEM (reported) */
int player_start_again(struct player *p);
