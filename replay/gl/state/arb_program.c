/* Programs in assembly (ARB_vertex_program, ARB_fragment_program): objects, their texts and parameters. */
#include <string.h>

#include "gl_tokens.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "replay/machine/state.h"
#include "replay/programs/program.h"

static int is_target(uint32_t target)
{
	return target == GL_VERTEX_PROGRAM_ARB || target == GL_FRAGMENT_PROGRAM_ARB;
}

static uint32_t *binding_of(struct gls_state *st, uint32_t target)
{
	return target == GL_VERTEX_PROGRAM_ARB ? &st->arb_vertex : &st->arb_fragment;
}

/* The bound object, made where there is none yet. NULL: out of memory (reported) */
static struct gls_program *bound(struct gls_exec *x, struct gls_state *st, uint32_t target)
{
	struct gls_program *p = gls_program_bound(st, target);

	if (!p) {
		p = gls_object_create(x, &st->share->programs, gls_program_key(target, *binding_of(st, target)), sizeof(*p));
		if (p)
			p->target = target;
	}
	return p;
}

GLS_HANDLER(glBindProgramARB, STATE)
{
	const uint32_t target = arg_u(c, 0), name = arg_u(c, 1);
	const struct gls_program *p = table_find(&st->share->programs, gls_program_key(target, name));

	if (gls_refuses(x, st, !is_target(target), GL_INVALID_ENUM) || gls_refuses(x, st, p && p->target != target, GL_INVALID_OPERATION))
		return;
	*binding_of(st, target) = name;
	bound(x, st, target);
}

GLS_HANDLER(glDeleteProgramsARB, OBJECT)
{
	uint64_t at = 0;

	for (uint32_t name; (name = arg_next_name(c, 1, &at));) {
		struct gls_program *p = table_find(&st->share->programs, name);

		if (!p)
			continue;
		if (*binding_of(st, p->target) == name)
			*binding_of(st, p->target) = 0;
		table_remove(&st->share->programs, name);
		gls_program_free(p);
	}
}

GLS_HANDLER(glProgramStringARB, OBJECT)
{
	const uint32_t target = arg_u(c, 0);
	const struct trace_value *text = arg(c, 3);
	const char *bytes = text->type == TRACE_STRING ? text->str : text->type == TRACE_BLOB ? (const char *)text->blob : "";
	struct gls_program *p;
	int refused;

	if (gls_refuses(x, st, !is_target(target) || arg_u(c, 1) != GL_PROGRAM_FORMAT_ASCII_ARB, GL_INVALID_ENUM))
		return;
	p = bound(x, st, target);
	refused = p ? gls_program_set(p, bytes, *bytes ? text->count : 0) : 0;
	if (refused < 0)
		gls_fail(x);
	gls_refuses(x, st, refused > 0, GL_INVALID_OPERATION);
}

/* Four numbers for a parameter, as floats of their own or as an array. */
static void set_parameter(struct gls_exec *x, struct gls_state *st, const struct call *c, float (*parameters)[4])
{
	const uint32_t index = arg_u(c, 1);

	if (gls_refuses(x, st, index >= GLS_MAX_PROGRAM_PARAMETERS, GL_INVALID_VALUE))
		return;
	if (c->n_args > 3)
		for (unsigned i = 0; i < 4; i++)
			parameters[index][i] = arg_f(c, 2 + i);
	else
		arg_floats(c, 2, parameters[index], 4);
}

static void set_env(struct gls_exec *x, struct gls_state *st, const struct call *c)
{
	if (!gls_refuses(x, st, !is_target(arg_u(c, 0)), GL_INVALID_ENUM))
		set_parameter(x, st, c, st->program_env[arg_u(c, 0) == GL_VERTEX_PROGRAM_ARB]);
}

static void set_local(struct gls_exec *x, struct gls_state *st, const struct call *c)
{
	struct gls_program *p;

	if (gls_refuses(x, st, !is_target(arg_u(c, 0)), GL_INVALID_ENUM))
		return;
	p = bound(x, st, arg_u(c, 0));
	if (p)
		set_parameter(x, st, c, p->local);
}

/* EXT_gpu_program_parameters: so many, four numbers each. */
static void set_parameters(struct gls_exec *x, struct gls_state *st, const struct call *c, float (*parameters)[4])
{
	const uint32_t index = arg_u(c, 1), n = arg_u(c, 2);

	if (!gls_refuses(x, st, arg_i(c, 2) <= 0 || index > GLS_MAX_PROGRAM_PARAMETERS || n > GLS_MAX_PROGRAM_PARAMETERS - index, GL_INVALID_VALUE))
		arg_floats(c, 3, parameters[index], 4 * n);
}

GLS_HANDLER(glProgramEnvParameters4fvEXT, STATE)
{
	if (!gls_refuses(x, st, !is_target(arg_u(c, 0)), GL_INVALID_ENUM))
		set_parameters(x, st, c, st->program_env[arg_u(c, 0) == GL_VERTEX_PROGRAM_ARB]);
}

GLS_HANDLER(glProgramLocalParameters4fvEXT, STATE)
{
	struct gls_program *p;

	if (!gls_refuses(x, st, !is_target(arg_u(c, 0)), GL_INVALID_ENUM) && (p = bound(x, st, arg_u(c, 0))))
		set_parameters(x, st, c, p->local);
}

GLS_HANDLER(glProgramEnvParameter4fARB, STATE) { set_env(x, st, c); }
GLS_HANDLER(glProgramEnvParameter4fvARB, STATE) { set_env(x, st, c); }
GLS_HANDLER(glProgramEnvParameter4dARB, STATE) { set_env(x, st, c); }
GLS_HANDLER(glProgramEnvParameter4dvARB, STATE) { set_env(x, st, c); }
GLS_HANDLER(glProgramLocalParameter4fARB, STATE) { set_local(x, st, c); }
GLS_HANDLER(glProgramLocalParameter4fvARB, STATE) { set_local(x, st, c); }
GLS_HANDLER(glProgramLocalParameter4dARB, STATE) { set_local(x, st, c); }
GLS_HANDLER(glProgramLocalParameter4dvARB, STATE) { set_local(x, st, c); }
