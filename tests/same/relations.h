/* The relations: what may be told otherwise, and must show the same picture. */
#pragma once

#include "tests/same/story.h"

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

typedef void relation_call(struct story *s, const struct call *c, int draws);
typedef void relation_run(struct story *s, const struct story_run *run);
typedef void relation_event(struct story *s);

struct relation {
	const char *name, *what;
	const char *idle; /* why it does not apply where it has changed nothing */
	uint32_t flags;
	double amount;    /* what the relation takes it for */
	const char *base; /* what it is compared with: a relation, "-" the recording itself, "": it is only a base itself.
	                     NULL: "immediate" for those that want runs, else "-" */
	relation_call *call;     /* write a call; NULL: as it is */
	relation_run *run;       /* write a run; NULL: as it is */
	relation_event *cleared; /* the whole window was cleared, colour and depth */
	relation_event *first;   /* something is about to be drawn for the first time since */
	relation_event *frame;   /* a frame is about to end */
};

extern const struct relation relations[];
extern const unsigned n_relations;

extern relation_call call_asked, call_dimmed, call_eye, call_join, call_lights, call_prepass, call_target,
	call_thrice, call_undone;
extern relation_run run_as_it_is, run_arrays, run_culled, run_cut, run_doubled, run_eye, run_join, run_lamps,
	run_lights, run_listed, run_loaded, run_measured, run_moved, run_plain, run_prepass, run_split, run_strip,
	run_wound;
extern relation_event cleared_behind, cleared_lamps, first_sky, first_unseen, frame_hud, frame_target;

#define ALL_ATTRIBS 0xfffffu
#define OURS 0x7001u /* a name that no program uses, of any kind of object */

/** The current matrix of a stack. */
static inline const float *stack_top(const struct gls_matrix_stack *stack)
{
	return stack->matrices[stack->depth];
}

/** Write a run with these vertices. Quads are cut: Mesa cuts those otherwise that come from lists or by indices. */
void say_plain(struct story *s, const struct story_run *run, const struct story_vertex *v);

/** Load the modelview and projection matrices; say_own_matrices: those of the state. */
void say_matrices(struct story *s, const float modelview[16], const float projection[16]);
void say_own_matrices(struct story *s);

/** A call of four booleans, from bits. */
void say_mask(struct story *s, const char *name, uint32_t mask);

/** Up to four numbers of an argument. Those of OpenGL ES may be fixed-point ones. */
void read_numbers(const struct call *c, unsigned i, float v[4]);

/** 1: what this draws hides all behind it, by depth. */
int is_solid(const struct gls_state *st, const struct story_run *run);

/** Lights that are on: 1 << number. */
uint32_t lights_on(const struct gls_state *st);

/** Between these, nothing but colours is drawn, and eye space is the world's. */
void begin_flat(struct story *s, const float projection[16]);
void end_flat(struct story *s);
