/* The relations: what may be told otherwise, and must show the same picture. */
#pragma once

#include <stdint.h>

struct call;
struct story;
struct story_run;

enum {
	RELATION_RUNS = 1,       /* wants runs of vertices: story.h */
	RELATION_ALL = 2,        /* does not apply where something foreign is drawn */
	RELATION_PASSES = 4,     /* what is drawn between two clears is told several times */
	RELATION_ROUNDS = 8,     /* numbers are rounded otherwise: edges may lie by one pixel elsewhere */
	RELATION_SATURATES = 16, /* where light is cut off at 1 nothing is demanded */
	RELATION_COVERS = 32,    /* GL's picture may differ: such pixels are not looked at, if they are few */
	RELATION_COARSE = 64,    /* places are so coarse that shadows may lie elsewhere, too */
	RELATION_TRIPLES = 128   /* the picture is three times as large: each middle pixel is looked at */
};

struct relation {
	const char *name, *what;
	const char *idle; /* why it does not apply where it has changed nothing */
	uint32_t flags;
	double amount;    /* what the relation takes it for */
	const char *base; /* what it is compared with: a relation, "-" the recording itself, "": it is only a base itself.
	                     NULL: "immediate" for those that want runs, else "-" */
	void (*call)(struct story *s, const struct call *c, int draws); /* write a call; NULL: as it is */
	void (*run)(struct story *s, const struct story_run *run);      /* write a run; NULL: as it is */
	void (*cleared)(struct story *s); /* the whole window was cleared, colour and depth */
	void (*first)(struct story *s);   /* something is about to be drawn for the first time since */
	void (*frame)(struct story *s);   /* a frame is about to end */
};

extern const struct relation relations[];
extern const unsigned n_relations;

/** Write a call as it is. */
void say_call(struct story *s, const struct call *c);
/** Write a run as it is. */
void run_as_it_is(struct story *s, const struct story_run *run);
