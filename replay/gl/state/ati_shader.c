/* ATI_fragment_shader: objects, and the calls between Begin and End that define a shader (replay/programs/ati.h). */
#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "base/memory.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "replay/machine/state.h"
#include "replay/programs/ati.h"
#include "replay/programs/program.h"

/* The bound object, created if necessary. NULL: out of memory (reported) */
static struct gls_program *bound(struct gls_exec *x, struct gls_state *st)
{
	struct gls_program *p = gls_program_bound(st, GL_FRAGMENT_SHADER_ATI);

	if (!p) {
		p = gls_object_create(x, &st->share->programs, gls_program_key(GL_FRAGMENT_SHADER_ATI, st->ati_fragment), sizeof(*p));
		if (p)
			p->target = GL_FRAGMENT_SHADER_ATI;
	}
	return p;
}

/* Store a call of the shader being defined. */
static void keep(struct gls_exec *x, struct gls_state *st, const struct ati_call *call)
{
	struct gls_program *p;

	if (gls_refuses(x, st, !st->ati_open, GL_INVALID_OPERATION) || !(p = bound(x, st)))
		return;
	if (memory_resize(&p->source, p->source_bytes + sizeof(*call), 1)) {
		gls_fail(x);
		return;
	}
	memcpy(p->source + p->source_bytes, call, sizeof(*call));
	p->source_bytes += sizeof(*call);
}

GLS_HANDLER(glBindFragmentShaderATI, STATE)
{
	if (gls_refuses(x, st, st->ati_open, GL_INVALID_OPERATION))
		return;
	st->ati_fragment = arg_u(c, 0);
	bound(x, st);
}

GLS_HANDLER(glDeleteFragmentShaderATI, OBJECT)
{
	const uint64_t key = gls_program_key(GL_FRAGMENT_SHADER_ATI, arg_u(c, 0));
	struct gls_program *p = table_find(&st->share->programs, key);

	if (gls_refuses(x, st, st->ati_open, GL_INVALID_OPERATION) || !p || !arg_u(c, 0))
		return;
	if (st->ati_fragment == arg_u(c, 0))
		st->ati_fragment = 0;
	table_remove(&st->share->programs, key);
	gls_program_free(p);
}

GLS_HANDLER(glBeginFragmentShaderATI, OBJECT)
{
	struct gls_program *p;

	if (gls_refuses(x, st, st->ati_open, GL_INVALID_OPERATION) || !(p = bound(x, st)))
		return;
	free(p->source);
	p->source = NULL;
	p->source_bytes = 0;
	st->ati_open = 1;
}

GLS_HANDLER(glEndFragmentShaderATI, OBJECT)
{
	struct gls_program *p;

	if (gls_refuses(x, st, !st->ati_open, GL_INVALID_OPERATION))
		return;
	st->ati_open = 0;
	p = bound(x, st);
	if (p && p->source_bytes && gls_program_set(p, p->source, p->source_bytes) < 0)
		gls_fail(x);
}

GLS_HANDLER(glSetFragmentShaderConstantATI, OBJECT)
{
	struct ati_call call = { .kind = ATI_CONSTANT, .to = arg_u(c, 0) };

	if (gls_refuses(x, st, call.to - GL_CON_0_ATI >= ATI_CONSTANTS, GL_INVALID_ENUM))
		return;
	arg_floats(c, 1, call.value, 4);
	if (st->ati_open)
		keep(x, st, &call);
	else
		memcpy(st->ati_constants[call.to - GL_CON_0_ATI], call.value, sizeof(call.value));
}

static void texture(struct gls_exec *x, struct gls_state *st, const struct call *c, enum ati_kind kind)
{
	keep(x, st,
	     &(struct ati_call){ .kind = kind,
	                         .to = arg_u(c, 0),
	                         .arguments = { { .source = arg_u(c, 1) } },
	                         .operation = arg_u(c, 2) });
}

GLS_HANDLER(glPassTexCoordATI, OBJECT) { texture(x, st, c, ATI_PASS); }
GLS_HANDLER(glSampleMapATI, OBJECT) { texture(x, st, c, ATI_SAMPLE); }

/* n: number of arguments */
static void arithmetic(struct gls_exec *x, struct gls_state *st, const struct call *c, enum ati_kind kind, uint32_t n)
{
	const uint32_t has_mask = kind == ATI_COLOR;
	struct ati_call call = { .kind = kind, .operation = arg_u(c, 0), .to = arg_u(c, 1), .mask = has_mask ? arg_u(c, 2) : 0,
		                 .change = arg_u(c, 2 + has_mask), .n_arguments = n };

	for (uint32_t i = 0, at = 3 + has_mask; i < n; i++, at += 3)
		call.arguments[i] = (struct ati_argument){ arg_u(c, at), arg_u(c, at + 1), arg_u(c, at + 2) };
	keep(x, st, &call);
}

GLS_HANDLER(glColorFragmentOp1ATI, OBJECT) { arithmetic(x, st, c, ATI_COLOR, 1); }
GLS_HANDLER(glColorFragmentOp2ATI, OBJECT) { arithmetic(x, st, c, ATI_COLOR, 2); }
GLS_HANDLER(glColorFragmentOp3ATI, OBJECT) { arithmetic(x, st, c, ATI_COLOR, 3); }
GLS_HANDLER(glAlphaFragmentOp1ATI, OBJECT) { arithmetic(x, st, c, ATI_ALPHA, 1); }
GLS_HANDLER(glAlphaFragmentOp2ATI, OBJECT) { arithmetic(x, st, c, ATI_ALPHA, 2); }
GLS_HANDLER(glAlphaFragmentOp3ATI, OBJECT) { arithmetic(x, st, c, ATI_ALPHA, 3); }
