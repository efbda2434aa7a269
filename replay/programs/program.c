/* Selects the programs that run for a draw, and gives the reason if one cannot run. */
#include "replay/programs/program.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"
#include "gl_tokens.h"
#include "replay/machine/errors.h"
#include "replay/programs/arb.h"
#include "replay/programs/arb_words.h"
#include "replay/programs/ati.h"
#include "replay/programs/held.h"

void gls_program_free(struct gls_program *p)
{
	program_code_free(&p->code);
	free(p->source);
	free(p->other);
	free(p->local);
	free(p);
}

int gls_program_reserve(struct gls_program *p, uint32_t n)
{
	if (n <= p->n_locals)
		return 0;
	if (memory_resize(&p->local, n, sizeof(*p->local)))
		return ERR_SYSTEM;
	memset(p->local + p->n_locals, 0, (n - p->n_locals) * sizeof(*p->local));
	p->n_locals = n;
	return 0;
}

/* The largest number of local parameters that a program reads. */
static uint32_t locals_of(const struct program_code *code)
{
	uint32_t n = 0;

	for (uint32_t i = 0; i < code->n_constants; i++)
		if (code->constants[i].source == PROGRAM_LOCAL && code->constants[i].index >= n)
			n = code->constants[i].index + 1;
	return n;
}

/* Translate a text. why: receives NULL, or why it cannot be run. @return 0 or ERR_SYSTEM (reported) */
static int translate(const struct gls_program *p, const char *text, size_t n, struct program_code *code,
                     const char **why)
{
	const int err = p->target == GL_FRAGMENT_SHADER_ATI ?
	                        program_translate_ati((const struct ati_call *)(const void *)text, n, code, why) :
	                        program_translate_arb(text, n, p->target == GL_VERTEX_PROGRAM_ARB, code, why);

	if (err || *why)
		program_code_free(code);
	return err;
}

static void keep_other(struct gls_program *p, char *text, size_t n, int is_refused)
{
	free(p->other);
	p->other = text;
	p->other_bytes = n;
	p->is_refused = is_refused;
}

int gls_program_set(struct gls_program *p, const char *text, size_t n)
{
	char *source = malloc(n + 1);
	struct program_code code = { .n_instructions = 0 };
	const char *why;
	int err;

	if (!source)
		return err_report(ERR_SYSTEM, NULL, "out of memory for a program of %zu bytes", n);
	memcpy(source, text, n);
	source[n] = 0;
	err = translate(p, source, n, &code, &why);
	if (!err)
		err = gls_program_reserve(p, locals_of(&code));
	if (!err && (why == arb_bad_grammar || why == arb_too_much)) {
		keep_other(p, source, n, 1);
		return 1;
	}
	keep_other(p, p->why ? NULL : p->source, p->source_bytes, 0);
	if (p->source != p->other)
		free(p->source);
	p->source = source;
	p->source_bytes = n;
	program_code_free(&p->code);
	p->code = code;
	p->why = why;
	return err;
}

int gls_program_judged(struct gls_program *p, int refuses)
{
	char *text = p->other;
	int err = 0;

	if (p->is_refused ? refuses : !refuses || !p->why)
		return 0;
	p->other = NULL;
	free(p->source);
	p->source = NULL;
	program_code_free(&p->code);
	p->why = NULL;
	if (p->is_refused) {
		p->source = text;
		p->source_bytes = p->other_bytes;
		p->why = "an ARB program that the GL accepted breaks the grammar that Relume knows";
	} else if (text) {
		err = gls_program_set(p, text, p->other_bytes);
		free(text);
	}
	p->is_refused = 0;
	return err < 0 ? err : 1;
}

struct gls_program *gls_program_bound(const struct gls_state *st, uint32_t target)
{
	const uint32_t name = target == GL_FRAGMENT_SHADER_ATI ? st->ati_fragment :
	                      target == GL_VERTEX_PROGRAM_ARB  ? st->arb_vertex :
	                                                         st->arb_fragment;

	return table_find(&st->share->programs, gls_program_key(target, name));
}

static const char *lack_of(const struct gls_state *st, uint32_t target)
{
	const struct gls_program *p = gls_program_bound(st, target);

	return !p || !p->source ? "draws with a program that has no text" : p->why;
}

static const struct gls_stages *linked(const struct gls_state *st)
{
	return table_find(&st->share->shaders, st->program);
}

/* Why the program object in use cannot be run. */
static const char *lack_of_shaders(const struct gls_state *st)
{
	const struct gls_stages *p = linked(st);

	if (!p || !p->linked || p->why)
		return p && p->linked ? p->why : "draws with a program object that was not linked";
	for (int which = 0; which < 2; which++) {
		const struct program_stage stage = { &p->code[which], NULL, p->uniforms };

		for (uint32_t i = 0; i < stage.code->n_samplers; i++)
			if (program_unit_of(&stage, i) >= GLS_MAX_UNITS)
				return "a shader samples texture units from 8 on";
	}
	return p->code[GLS_FRAGMENT_STAGE].n_data && st->a.color.also_drawn & GLS_OUT_OF_ORDER ?
	               "a shader draws to several buffers, not in the order of their numbers" :
	               NULL;
}

/*
 * 1 if an ATI fragment shader replaces fixed function: assembly programs take precedence, and a shader without calls
 * does not count.
 */
static int is_by_ati(const struct gls_state *st)
{
	const struct gls_program *p = st->a.programs.ati && !st->a.programs.fragment && !st->ati_open ?
	                                      gls_program_bound(st, GL_FRAGMENT_SHADER_ATI) :
	                                      NULL;

	return p && p->source;
}

/* Why the current assembly programs, or ATI's shaders, cannot be run. */
static const char *lack_of_assembly(const struct gls_state *st)
{
	const char *lack = st->a.programs.vertex ? lack_of(st, GL_VERTEX_PROGRAM_ARB) : NULL;

	if (!lack && st->a.programs.fragment)
		return lack_of(st, GL_FRAGMENT_PROGRAM_ARB);
	if (lack || !is_by_ati(st))
		return lack;
	return st->a.fog.enabled ? "draws by an ATI fragment shader have fog" : lack_of(st, GL_FRAGMENT_SHADER_ATI);
}

static int has_text(const struct gls_state *st, uint32_t target)
{
	const struct gls_program *p = gls_program_bound(st, target);

	return p && p->source;
}

int gls_program_is_refused(const struct gls_state *st, int is_rectangle)
{
	if (st->program)
		return 0;
	return (st->a.programs.fragment && !has_text(st, GL_FRAGMENT_PROGRAM_ARB)) ||
	       (st->a.programs.vertex && !is_rectangle && !has_text(st, GL_VERTEX_PROGRAM_ARB));
}

const char *gls_program_lack(const struct gls_state *st)
{
	const char *lack;

	if (gls_program_is_refused(st, 0))
		return NULL;
	lack = st->program ? lack_of_shaders(st) : lack_of_assembly(st);
	if (lack || !st->program)
		return lack;
	return st->a.programs.two_side && st->a.transform.clip_plane_mask &&
	                       linked(st)->code[GLS_VERTEX_STAGE].outputs >> SCENE_RESULT_CLIP_VERTEX & 1 ?
	               "a shader sets gl_ClipVertex and colours of both sides: clip planes do not clip by it" :
	               NULL;
}

unsigned gls_program_current(const struct gls_state *st, uint64_t keys[SCENE_DRAW_PROGRAMS])
{
	unsigned n = 0;

	if (st->program) {
		keys[n++] = st->program;
		return n;
	}
	if (st->a.programs.vertex)
		keys[n++] = (uint64_t)GL_VERTEX_PROGRAM_ARB << 32 | st->arb_vertex;
	if (st->a.programs.fragment)
		keys[n++] = (uint64_t)GL_FRAGMENT_PROGRAM_ARB << 32 | st->arb_fragment;
	if (is_by_ati(st))
		keys[n++] = (uint64_t)GL_FRAGMENT_SHADER_ATI << 32 | st->ati_fragment;
	return n;
}

const char *gls_program_kind(uint64_t key)
{
	switch (key >> 32) {
	case 0: return "program object";
	case GL_VERTEX_PROGRAM_ARB: return "vertex program";
	case GL_FRAGMENT_SHADER_ATI: return "ATI fragment shader";
	default: return "fragment program";
	}
}

static int runs(const struct gls_state *st, uint32_t target, struct program_stage *stage)
{
	const struct gls_program *p = gls_program_bound(st, target);

	*stage = (struct program_stage){ &p->code,
		                         target == GL_FRAGMENT_SHADER_ATI ?
		                                 st->ati_constants :
		                                 st->program_env[target == GL_VERTEX_PROGRAM_ARB],
		                         p->local };
	return 1;
}

static int runs_shaders(const struct gls_state *st, enum gls_stage which, struct program_stage *stage)
{
	const struct gls_stages *p = linked(st);

	if (!p || !p->runs[which] || lack_of_shaders(st))
		return 0;
	*stage = (struct program_stage){ &p->code[which], st->program_env[0], gls_held_values(p, st->handle, which) };
	return 1;
}

void gls_program_draws(struct gls_state *st)
{
	struct gls_stages *p = st->program ? table_find(&st->share->shaders, st->program) : NULL;

	for (unsigned stage = 0; stage < N_GLS_STAGES; stage++) {
		const uint32_t program = p && p->linked && p->runs[stage] ? st->program : 0, links = program ? p->links : 0;

		if (program == st->drawn_program[stage] && links == st->drawn_links[stage])
			continue;
		st->drawn_program[stage] = program;
		st->drawn_links[stage] = links;
		if (program)
			gls_held_drop(p, st->handle, stage);
	}
}

int gls_program_runs_vertices(const struct gls_state *st, struct program_stage *stage)
{
	if (st->program)
		return runs_shaders(st, GLS_VERTEX_STAGE, stage);
	return st->a.programs.vertex && !lack_of_assembly(st) && runs(st, GL_VERTEX_PROGRAM_ARB, stage);
}

int gls_program_runs_fragments(const struct gls_state *st, struct program_stage *stage)
{
	if (st->program)
		return runs_shaders(st, GLS_FRAGMENT_STAGE, stage);
	if (!(st->a.programs.fragment || is_by_ati(st)) || lack_of_assembly(st))
		return 0;
	return runs(st, st->a.programs.fragment ? GL_FRAGMENT_PROGRAM_ARB : GL_FRAGMENT_SHADER_ATI, stage);
}
