/*
 * Rewriting a recording: calls of one recording run through a state machine and are written to another, unchanged or
 * changed by a relation (relations.h).
 *
 * Relations that need vertices receive runs: a primitive mode and complete vertices, whether these came from Begin and
 * End, from arrays or from display lists. Other drawing (vertex programs with attributes of their own, materials
 * between Begin and End, evaluators, pixels) is foreign: it is passed on unchanged, or the relation does not apply.
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
	uint32_t given;         /* in a display list: attributes set in the list itself, 1 << attribute */
	int listed;             /* 1: from a list, or by indices: gls_geometry_turn_quads */
	struct story_vertex *v; /* owned */
	float after[STORY_ATTRIBUTES][4]; /* current attributes */
};

/* A call or a run to be executed later. */
struct story_item {
	struct call call;
	struct story_run *run; /* owned; NULL: the call */
	int foreign;           /* 1: the call draws, but its vertices are unknown */
};
struct story_items {
	struct story_item *items; /* owned */
	size_t n, room;
	struct arena arena;       /* data that their calls point to */
};

struct relation;

struct story {
	const struct relation *relation;
	struct trace_reader *reader;
	struct trace_out *out;
	struct gls_exec *x;
	uint64_t thread;
	const char *why_not;  /* why the relation does not apply; a static string. NULL: it applies so far */
	uint64_t n_changes;   /* places changed by the relation */
	uint64_t n_said;      /* calls written */
	int mute;             /* 1: nothing is written */
	float said[STORY_ATTRIBUTES][4]; /* current attributes after the calls written */

	struct table lists;       /* name -> struct story_items, owned */
	struct story_items *list; /* list being compiled, or NULL */
	uint32_t list_name, list_runs, list_depth;
	struct story_run open;    /* between Begin and End */
	struct story_items raw;   /* the calls between them */
	int is_open, open_is_foreign;

	/* relations in several passes hold back the draws since the last clear */
	struct story_items held;
	int holds;
	unsigned pass, n_passes;
	unsigned step; /* a relation's counter */
	int fresh, fresh_color; /* no draw since depth and, by its colour, the whole window were cleared */
	struct story_run joined; /* adjacent draws */
	double distance, n_measured; /* mean logarithm of the vertices' distance from the eye, and the number of
	                                vertices */
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
/** The same, and the state machine executes it, so that it persists. */
void tell(struct story *s, const char *name, const char *form, ...);

/** Returns the memory, or ends the program if there is none. */
void *need(void *memory);

/** Mark the relation as not applying to this recording. */
void not_for(struct story *s, const char *why);

/** Write vertices in this order (NULL: as they are) as a primitive; current attributes are then the machine's. */
void say_run(struct story *s, uint32_t mode, const struct story_vertex *v, uint32_t n, const uint32_t *order);
/** Write a call unchanged. */
void say_call(struct story *s, const struct call *c);
/** The state machine executes a call. */
void story_execute(struct story *s, const struct call *c);
/** Set an attribute. lasts: as by `tell`. */
void put_attribute(struct story *s, unsigned attribute, const float value[4], int lasts);
/** Set an attribute, unless that value was written last. */
void say_attribute(struct story *s, unsigned attribute, const float value[4]);
/** Set current attributes to the machine's. */
void say_current(struct story *s);

/** Append a vertex. */
struct story_vertex *run_add(struct story_run *run);

/**
 * A run's triangles, with the provoking vertex last, as Mesa splits them. Unfilled polygons are not split.
 * @param order  receives [3 * result] numbers of vertices; valid until the next call
 * @return number of triangles; 0: lines, points, or not filled
 */
uint32_t run_triangles(struct story *s, const struct story_run *run, const uint32_t **order);

/** Rewrite a recording under a relation. @return 0; 1: it does not apply (s->why_not); ERR_* (reported) */
int story_tell(struct story *s, const char *from, const char *to);
