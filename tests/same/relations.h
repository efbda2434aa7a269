/* Relations: changes to a recording that must not change its picture. */
#pragma once

#include "tests/same/story.h"

enum {
	RELATION_RUNS = 1,       /* needs runs of vertices: story.h */
	RELATION_ALL = 2,        /* does not apply if there are foreign draws */
	RELATION_PASSES = 4,     /* draws between two clears are repeated in several passes */
	RELATION_ROUNDS = 8,     /* changes rounding: edges may shift by one pixel */
	RELATION_SATURATES = 16, /* no requirement where light is clamped at 1 */
	RELATION_COVERS = 32,    /* GL's picture may differ: such pixels are ignored if they are few */
	RELATION_COARSE = 64,    /* positions are so coarse that shadows may move, too */
	RELATION_TRIPLES = 128   /* the picture is three times as large: each middle pixel is compared */
};

typedef void relation_call(struct story *s, const struct call *c, int draws);
typedef void relation_run(struct story *s, const struct story_run *run);
typedef void relation_event(struct story *s);

struct relation {
	const char *name, *what;
	const char *idle; /* the reason for not applying if nothing was changed */
	uint32_t flags;
	double amount;    /* parameter of the relation */
	const char *base; /* base of the comparison: a relation, "-" for the recording itself, "" if only a base.
	                     NULL: "immediate" for those that need runs, else "-" */
	relation_call *call;     /* writes a call; NULL: unchanged */
	relation_run *run;       /* writes a run; NULL: unchanged */
	relation_event *cleared; /* the whole window was cleared, colour and depth */
	relation_event *first;   /* before the first draw after that */
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
#define OURS 0x7001u /* a name that no program uses, for any kind of object */

/** The current matrix of a stack. */
static inline const float *stack_top(const struct gls_matrix_stack *stack)
{
	return stack->matrices[stack->depth];
}

/**
 * Write a run with these vertices. Quads are split, because Mesa splits those from lists or with indices differently.
 */
void say_plain(struct story *s, const struct story_run *run, const struct story_vertex *v);

/** Load the modelview and projection matrices; say_own_matrices: those of the state. */
void say_matrices(struct story *s, const float modelview[16], const float projection[16]);
void say_own_matrices(struct story *s);

/** A call with four booleans, from bits. */
void say_mask(struct story *s, const char *name, uint32_t mask);

/** Up to four numbers of an argument. Those of OpenGL ES may be fixed-point. */
void read_numbers(const struct call *c, unsigned i, float v[4]);

/** 1: the draw hides everything behind it, by depth. */
int is_solid(const struct gls_state *st, const struct story_run *run);

/** Enabled lights: 1 << number. */
uint32_t lights_on(const struct gls_state *st);

/** Between these, only colours are drawn, and eye space is the world's. */
void begin_flat(struct story *s, const float projection[16]);
void end_flat(struct story *s);
