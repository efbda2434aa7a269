/* Program objects of ARB_fragment_program, ARB_vertex_program and ATI_fragment_shader, as part of the GL state. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "gl_tokens.h"
#include "replay/programs/code.h"
#include "replay/machine/state.h"

struct gls_exec;

struct gls_program {
	uint32_t target; /* GL token */
	char *source;    /* owned, as the application passed it; NULL: none yet. GL_FRAGMENT_SHADER_ATI: an array of
	                    struct ati_call */
	size_t source_bytes;
	float (*local)[4]; /* owned: n_locals, at least as many as the code reads; those never set are 0 */
	uint32_t n_locals;
	struct program_code code; /* empty if `why` is set */
	const char *why;          /* why the program cannot be run; a static string, NULL: it can */
	/*
	 * owned, or NULL: the text to use instead if the recording shows that the GL judged the last one otherwise. If that
	 * was refused (is_refused 1), it is that text; otherwise the one before, to go back to
	 */
	char *other;
	size_t other_bytes;
	int is_refused;
};

void gls_program_free(struct gls_program *p);

/**
 * Set the program's text, of n bytes, and translate it.
 * @return 0; 1: the text is invalid, which is a GL error and changes nothing; or ERR_SYSTEM (reported)
 */
int gls_program_set(struct gls_program *p, const char *text, size_t n);

/**
 * Take in how the GL of the recording judged the last text.
 * @param refuses  1: as an error; 0: it accepted the text
 * @return 1 if gls_program_set judged otherwise: the program then has no text that runs, or its former one; 0; or
 *         ERR_SYSTEM (reported)
 */
int gls_program_judged(struct gls_program *p, int refuses);

/** Make room for n parameters. @return 0, or ERR_SYSTEM (reported) */
int gls_program_reserve(struct gls_program *p, uint32_t n);

/**
 * Key of an object in gls_share.programs; each target has one unnamed object. ATI's shaders have a separate name space.
 */
static inline uint64_t gls_program_key(uint32_t target, uint32_t name)
{
	return name && target != GL_FRAGMENT_SHADER_ATI ? name : (uint64_t)target << 32 | name;
}

/** The object bound to a target; NULL: no object has this name. */
struct gls_program *gls_program_bound(const struct gls_state *st, uint32_t target);

/**
 * 1 if OpenGL refuses to draw because an enabled assembly program has no text. As in Mesa (22.3), rectangles of pixels
 * need no vertex program.
 */
int gls_program_is_refused(const struct gls_state *st, int is_rectangle);

/**
 * The reason why draws with the current programs are not fully supported: a static string; NULL: they are. If a program
 * cannot be run, they are rendered as fixed function.
 */
const char *gls_program_lack(const struct gls_state *st);

/**
 * Identify the programs that draw: (0 for a GLSL program object, else the target of an assembly program) << 32 | name.
 * @return number of keys
 */
unsigned gls_program_current(const struct gls_state *st, uint64_t keys[SCENE_DRAW_PROGRAMS]);

/** The kind of program that a key identifies, in words: a static string. */
const char *gls_program_kind(uint64_t key);

/** Note which program object runs, before a draw. */
void gls_program_draws(struct gls_state *st);

/** The program that runs this stage of current draws. @return 1; 0: fixed function runs the stage */
int gls_program_runs_vertices(const struct gls_state *st, struct program_stage *stage);
int gls_program_runs_fragments(const struct gls_state *st, struct program_stage *stage);
