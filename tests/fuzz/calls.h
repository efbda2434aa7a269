/*
 * Bytes as calls of the state machine: every byte string means a sequence of calls, most of them legal or nearly so.
 * How a fuzzer comes past the reader, which hardly lets a damaged stream through.
 *
 * A call is a slot of CALLS_SLOT bytes: 16 bits that choose the command whose number is the next at or above them, then
 * 16 bits for each of its parameters, of which the high half says how the low half becomes a value: a small number, one
 * of the parameter's enumerants, an extreme one. The last two bytes are what the call returned.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "replay/replay.h"

struct call;
struct gls_exec;

#define CALLS_MAX_PARAMS 15
#define CALLS_SLOT (2 + 2 * CALLS_MAX_PARAMS)

struct calls_group {
	const uint32_t *values; /* ascending */
	uint32_t n;
};
struct calls_command {
	const char *name;
	uint16_t number, chapter;         /* chapter: commands of one source of replay/ have to do with each other */
	const char *letters;              /* of each parameter: see gen_commands.py */
	uint16_t group[CALLS_MAX_PARAMS]; /* in calls_groups; 0: any token */
};

/* Made by gen_commands.py. Commands in ascending order of their numbers. */
extern const struct calls_group calls_groups[];
extern const struct calls_command calls_commands[];
extern const unsigned n_calls_commands;

/** A number below n (0 for n = 0), and the next state of the generator. */
unsigned calls_draw(unsigned *state, unsigned n);

/**
 * Any call with any values; half of them are of the commands without which little is drawn, a quarter of near's
 * chapter.
 * @param slot  [CALLS_SLOT]
 * @param near  a call; NULL: none
 */
void calls_invent(unsigned *state, uint8_t *slot, const uint8_t *near);

/** Name a call's command by its very number: then it is the same one when others have come. @param slot 
 * [CALLS_SLOT] */
void calls_settle(uint8_t *slot);

/** How many of a call's bytes mean something: the command and its parameters. @param slot  [CALLS_SLOT] */
size_t calls_used(const uint8_t *slot);

/* Who makes pixels of scenes. */
struct calls_painter {
	void (*paint)(void *user, const struct scene *scene); /* of each frame */
	scene_supply *supply;                                /* for calls that read what was drawn */
	int skips; /* 1: of every fourth length of a sequence every other frame is skipped */
	void *user;
};

/* Pictures that have little to do with the scenes, for what becomes of pictures. */
extern const struct calls_painter calls_grey;

/**
 * Execute the calls in a state machine of their own, with one context current at the start; scenes are built at each
 * swap. After each frame the state is saved, loaded and saved again: both are the same bytes (replay/index/snapshot.h).
 * @param painter  NULL: nobody makes pixels
 * @return 0; 1 where they are not
 */
int calls_run(const uint8_t *data, size_t size, const struct calls_painter *painter);

/**
 * Save a state, load it and save it again; with what was drawn as well, where it can be saved.
 * @return 0 the same bytes, or nothing that can be saved; 1 other bytes, which is told
 */
int calls_check_snapshot(struct gls_exec *x);

/** What stands before the calls of calls_run: a context is current. */
void calls_begin(struct gls_exec *x);

/** Execute more calls in a state machine that is there, and build its scenes. */
void calls_go_on(struct gls_exec *x, const uint8_t *data, size_t size, const struct calls_painter *painter);

/**
 * Hand over the calls of a sequence, one by one: those of calls_begin first, and a swap at the end. The last frame is
 * shown twice.
 * @param take  gets calls that are there until the next one; not 0: no more of them
 * @return 0, what take returned, or ERR_SYSTEM: no memory
 */
int calls_each(const uint8_t *data, size_t size, int (*take)(void *user, const struct call *call), void *user);
