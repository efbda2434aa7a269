#include "replay/programs/program.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "gl_tokens.h"
#include "replay/machine/errors.h"
#include "replay/programs/arb.h"

void gls_program_free(struct gls_program *p)
{
	program_code_free(&p->code);
	free(p->source);
	free(p);
}

int gls_program_set(struct gls_program *p, const char *text, size_t n)
{
	char *source = malloc(n + 1);
	int err;

	if (!source)
		return err_report(ERR_SYSTEM, NULL, "out of memory for a program of %zu bytes", n);
	memcpy(source, text, n);
	source[n] = 0;
	free(p->source);
	p->source = source;
	p->source_bytes = n;
	program_code_free(&p->code);
	err = program_translate_arb(source, n, p->target == GL_VERTEX_PROGRAM_ARB, &p->code, &p->why);
	if (err || p->why)
		program_code_free(&p->code);
	return err;
}

struct gls_program *gls_program_bound(const struct gls_state *st, uint32_t target)
{
	return table_find(&st->share->programs, gls_program_key(target, target == GL_VERTEX_PROGRAM_ARB ? st->arb_vertex : st->arb_fragment));
}

static const char *lack_of(const struct gls_state *st, uint32_t target)
{
	const struct gls_program *p = gls_program_bound(st, target);

	return !p || !p->source ? "draws with a program that has no text" : p->why;
}

const char *gls_program_lack(const struct gls_state *st)
{
	const char *lack = st->program ? gls_programs : NULL;

	if (!lack && st->a.programs.vertex)
		lack = lack_of(st, GL_VERTEX_PROGRAM_ARB);
	if (!lack && st->a.programs.fragment)
		lack = lack_of(st, GL_FRAGMENT_PROGRAM_ARB);
	return lack;
}

unsigned gls_program_current(const struct gls_state *st, uint64_t keys[2])
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
	return n;
}

static int runs(const struct gls_state *st, uint32_t target, struct program_stage *stage)
{
	const struct gls_program *p = gls_program_bound(st, target);

	*stage = (struct program_stage){ &p->code, st->program_env[target == GL_VERTEX_PROGRAM_ARB], p->local };
	return 1;
}

int gls_program_runs_vertices(const struct gls_state *st, struct program_stage *stage)
{
	return st->a.programs.vertex && !gls_program_lack(st) && runs(st, GL_VERTEX_PROGRAM_ARB, stage);
}

int gls_program_runs_fragments(const struct gls_state *st, struct program_stage *stage)
{
	return st->a.programs.fragment && !gls_program_lack(st) && runs(st, GL_FRAGMENT_PROGRAM_ARB, stage);
}
