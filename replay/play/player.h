/*
 * A trace, executed frame by frame from its beginning: a reader, a state machine, and the loop that feeds calls from
 * one to the other. It is used to build and check indexes; replay.h adds seeking and counts.
 *
 * Frame n (from 0) ends with the trace's n-th buffer swap.
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
	scene_supply *supply; /* NULL: no renderer */
	void *supply_user;
	int keeps_targets, leaves_starts; /* as in gls_feedback */
	int build_all; /* 1: some frame needs pixels of earlier ones; every frame played is built */
	const char *why; /* which pixels it needs, a static string; NULL: none */
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

/**
 * As replay_next_frame, except that a frame that needs pixels of skipped frames is abandoned: returns 1 with
 * exec->feedback.rewind set.
 */
int player_try_frame(struct player *p, int want, struct scene **scene);

/**
 * Read one call and execute it, without building scenes.
 * @param call  receives the call, valid until the next one is read
 * @return 1; 0 at the end; ERR_INPUT or ERR_SYSTEM (reported)
 */
int player_step(struct player *p, const struct call **call);

/**
 * Report how many of the frames `from` to `to` have been played: through `tell`, or, without one, as a warning every
 * ten seconds.
 */
void player_tell(struct player *p, uint64_t from, uint64_t to);

/** Continue with another state machine, which the player then owns. Counts so far are kept. */
void player_use(struct player *p, struct gls_exec *x);

/** Go back to the trace's beginning. @return 0, ERR_INPUT or ERR_SYSTEM (reported) */
int player_start_again(struct player *p);
