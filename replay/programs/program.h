/* Program objects of ARB_fragment_program, ARB_vertex_program and ATI_fragment_shader, as the state keeps them. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "gl_tokens.h"
#include "replay/programs/code.h"
#include "replay/machine/state.h"

struct gls_exec;

struct gls_program {
	uint32_t target; /* GL token */
	char *source;    /* owned, as the program gave it; NULL: it has given none. GL_FRAGMENT_SHADER_ATI: struct
	                    ati_call, one behind the other */
	size_t source_bytes;
	float (*local)[4]; /* owned: n_locals, at least as many as its code reads; those beyond are 0 */
	uint32_t n_locals;
	struct program_code code; /* empty where there is a reason */
	const char *why;          /* what stands in the way of running it; a static string, NULL: nothing */
};

void gls_program_free(struct gls_program *p);

/**
 * Give it a text, of n bytes, and translate it.
 * @return 0; 1: the text is wrong, which is an error; a good one before it stays, as in Mesa (22.3.6); or ERR_SYSTEM
 * (reported)
 */
int gls_program_set(struct gls_program *p, const char *text, size_t n);

/** Have room for n parameters. @return 0, or ERR_SYSTEM (reported) */
int gls_program_reserve(struct gls_program *p, uint32_t n);

/** Where an object stands in gls_share.programs; those that nobody has named are one of each target. ATI's have names
 * of their own. */
static inline uint64_t gls_program_key(uint32_t target, uint32_t name)
{
	return name && target != GL_FRAGMENT_SHADER_ATI ? name : (uint64_t)target << 32 | name;
}

/** The object bound to a target; NULL: there is none of this name. */
struct gls_program *gls_program_bound(const struct gls_state *st, uint32_t target);

/**
 * 1 where OpenGL refuses to draw: a program in assembly is enabled that has no text. As in Mesa (22.3), rectangles of
 * pixels need none for vertices.
 */
int gls_program_is_refused(const struct gls_state *st, int is_rectangle);

/**
 * What is missing of draws with the programs that are current: a static string; NULL: nothing.
 * Where a program cannot run, they are rendered as fixed function.
 */
const char *gls_program_lack(const struct gls_state *st);

/** Which programs draw, as numbers: the kind (0: a program object of GLSL, else the target of one in assembly) << 32 |
 * its name. @return how many */
unsigned gls_program_current(const struct gls_state *st, uint64_t keys[SCENE_DRAW_PROGRAMS]);

/** What such a number is of, in words: a static string. */
const char *gls_program_kind(uint64_t key);

/** A draw comes: note which program object runs. */
void gls_program_draws(struct gls_state *st);

/** The programs that run a stage of what is drawn now. @return 1; 0: fixed function runs it */
int gls_program_runs_vertices(const struct gls_state *st, struct program_stage *stage);
int gls_program_runs_fragments(const struct gls_state *st, struct program_stage *stage);
