/*
 * A recording told otherwise: calls come from one recording, run through a state machine, and go into another one, as
 * they are or as a relation (relations.h) has them.
 *
 * Relations that need vertices get runs: a primitive mode and whole vertices, whether they came between Begin and End,
 * from arrays or from display lists. All else that draws (vertex programs with attributes of their own, materials
 * between Begin and End, evaluators, pixels) is foreign: it is passed on as it is, or the relation does not apply.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "base/arena.h"
#include "base/table.h"
#include "capture/format/call.h"
#include "replay/machine/machine.h"
#include "replay/trace/trace_out.h"

enum { STORY_ATTRIBUTES = GLS_ATTR_GENERIC }; /* the conventional ones */
enum { STORY_MOST_CALLS = 6000000 };

struct story_vertex {
	float position[4], attribute[STORY_ATTRIBUTES][4];
};

struct story_run {
	uint32_t mode, n, room; /* mode: a GL token */
	uint32_t given;         /* in a display list: attributes that it brings itself, 1 << attribute */
	int listed;             /* 1: it came from a list, or by indices: gls_geometry_turn_quads */
	struct story_vertex *v; /* owned */
	float after[STORY_ATTRIBUTES][4]; /* current attributes */
};

/* A call, or a run, that is played later. */
struct story_item {
	struct call call;
	struct story_run *run; /* owned; NULL: the call */
	int foreign;           /* 1: the call draws, and nobody sees its vertices */
};
struct story_items {
	struct story_item *items; /* owned */
	size_t n, room;
	struct arena arena;       /* what their calls point to */
};

struct relation;

struct story {
	const struct relation *relation;
	struct trace_reader *reader;
	struct trace_out *out;
	struct gls_exec *x;
	uint64_t thread;
	const char *why_not;  /* the relation does not apply; a static string. NULL: it does so far */
	uint64_t n_changes;   /* places that the relation has changed */
	uint64_t n_said;      /* calls written */
	int mute;             /* 1: nothing is written */
	float said[STORY_ATTRIBUTES][4]; /* current attributes, as what was written leaves them */

	struct table lists;       /* name -> struct story_items, owned */
	struct story_items *list; /* being made; NULL: none */
	uint32_t list_name, list_runs, list_depth;
	struct story_run open;    /* between Begin and End */
	struct story_items raw;   /* the calls between these */
	int is_open, open_is_foreign;

	/* relations in several passes hold what was drawn since the last clear */
	struct story_items held;
	int holds;
	unsigned pass, n_passes;
	unsigned step; /* what a relation counts */
	int fresh, fresh_color; /* nothing was drawn since depth and, by its colour, the whole window were cleared */
	struct story_run joined; /* draws that stand together */
	double distance, n_measured; /* the mean logarithm of how far things are from the eye, of so many vertices */
	uint32_t target;         /* framebuffer object in place of the window; 0: none yet */
};

static inline int is(const struct call *c, const char *name)
{
	return strcmp(c->sig->name, name) == 0;
}
static inline int begins(const struct call *c, const char *name)
{
	return strncmp(c->sig->name, name, strlen(name)) == 0;
}

/**
 * Write a call.
 * @param form  u uint32_t, f double, v float[4], m float[16], s a string, b pointer and size_t, n NULL; a letter
 * for each argument. */
void say(struct story *s, const char *name, const char *form, ...);
/** The same, and the state machine executes it: it lasts. */
void tell(struct story *s, const char *name, const char *form, ...);

/** Memory that could be had; else the program ends. */
void *need(void *memory);

/** The relation does not apply to this recording. */
void not_for(struct story *s, const char *why);

/** Write vertices in this order (NULL: as they come) as a primitive; then current attributes are the machine's. */
void say_run(struct story *s, uint32_t mode, const struct story_vertex *v, uint32_t n, const uint32_t *order);
/** Write a call as it is. */
void say_call(struct story *s, const struct call *c);
/** The state machine executes a call. */
void story_execute(struct story *s, const struct call *c);
/** Set an attribute. lasts: as by `tell`. */
void put_attribute(struct story *s, unsigned attribute, const float value[4], int lasts);
/** Set an attribute, if it is not what was written last. */
void say_attribute(struct story *s, unsigned attribute, const float value[4]);
/** Set current attributes to what the machine has. */
void say_current(struct story *s);

/** One more vertex. */
struct story_vertex *run_add(struct story_run *run);

/**
 * A run's triangles, the provoking vertex last, as Mesa cuts them. Polygons that are not filled are not cut.
 * @param order  receives [3 * result] numbers of vertices; valid until the next call
 * @return how many; 0: lines, points, or not filled
 */
uint32_t run_triangles(struct story *s, const struct story_run *run, const uint32_t **order);

/** Tell a recording as a relation has it. @return 0; 1: it does not apply (s->why_not); ERR_* (reported) */
int story_tell(struct story *s, const char *from, const char *to);
