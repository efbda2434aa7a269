/* Assembly programs (ARB_vertex_program, ARB_fragment_program): objects, texts and parameters. */
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

/* The bound object, created if necessary. NULL: out of memory (reported) */
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

	if (gls_refuses(x, st, !is_target(target), GL_INVALID_ENUM) ||
	    gls_refuses(x, st, p && p->target != target, GL_INVALID_OPERATION))
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
		x->text_set.call = x->text_set.key == name ? 0 : x->text_set.call;
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
	x->text_set = (struct gls_text_set){ gls_program_key(target, *binding_of(st, target)), c->number, x->command };
}

/*
 * The recording shows how the GL judged the last text. That counts more than Relume's own judgement, which takes what
 * it does not know (options, state, instructions) as valid.
 */
static void judge(struct gls_exec *x, struct gls_state *st, int refuses)
{
	struct gls_program *p = x->text_set.call ? table_find(&st->share->programs, x->text_set.key) : NULL;
	const int other = p ? gls_program_judged(p, refuses) : 0;
	const uint32_t command = x->command;

	x->text_set.call = 0;
	if (other < 0)
		gls_fail(x);
	if (other <= 0)
		return;
	st->dirty |= GLS_DIRTY_MATERIAL;
	x->command = x->text_set.command;
	if (refuses)
		gls_error(x, st, GL_INVALID_OPERATION);
	else
		x->counts.errors[x->command]--;
	x->command = command;
}

GLS_HANDLER(glGetIntegerv, CLIENT)
{
	uint64_t n;
	const struct trace_value *values = arg_items(c, 1, &n);

	if (arg_u(c, 0) == GL_PROGRAM_ERROR_POSITION_ARB && values && n)
		judge(x, st, (int32_t)gls_value_int(&values[0]) >= 0);
}

/* Once the program has read the error, the next one is recorded again. */
GLS_HANDLER(glGetError, NOW)
{
	if (c->number == x->text_set.call + 1 && c->ret.type != TRACE_NONE &&
	    (c->ret.u == GL_NO_ERROR || c->ret.u == GL_INVALID_OPERATION))
		judge(x, st, c->ret.u != GL_NO_ERROR);
	st->error = 0;
}

/* The n parameters of a target that a call sets, from number `first` on. @return the first; NULL: none */
static float (*env_of(struct gls_exec *x, struct gls_state *st, const struct call *c, uint32_t n))[4]
{
	const uint32_t target = arg_u(c, 0), first = arg_u(c, 1);

	if (gls_refuses(x, st, !is_target(target), GL_INVALID_ENUM) ||
	    gls_refuses(x, st, first > GLS_MAX_PROGRAM_PARAMETERS || n > GLS_MAX_PROGRAM_PARAMETERS - first, GL_INVALID_VALUE))
		return NULL;
	return &st->program_env[target == GL_VERTEX_PROGRAM_ARB][first];
}

static float (*local_of(struct gls_exec *x, struct gls_state *st, const struct call *c, uint32_t n))[4]
{
	const uint32_t target = arg_u(c, 0), first = arg_u(c, 1);
	struct gls_program *p;

	if (gls_refuses(x, st, !is_target(target), GL_INVALID_ENUM) ||
	    gls_refuses(x, st, first > GLS_MAX_PROGRAM_LOCALS || n > GLS_MAX_PROGRAM_LOCALS - first, GL_INVALID_VALUE))
		return NULL;
	p = bound(x, st, target);
	if (p && gls_program_reserve(p, first + n)) {
		gls_fail(x);
		return NULL;
	}
	return p ? &p->local[first] : NULL;
}

/* Set a parameter from four floats, given as arguments or as an array. */
static void set_parameter(const struct call *c, float (*parameter)[4])
{
	for (unsigned i = 0; parameter && c->n_args > 3 && i < 4; i++)
		(*parameter)[i] = arg_f(c, 2 + i);
	if (parameter && c->n_args <= 3)
		arg_floats(c, 2, *parameter, 4);
}

/* EXT_gpu_program_parameters: set a number of parameters, four floats each. */
typedef float (*parameters_of(struct gls_exec *x, struct gls_state *st, const struct call *c, uint32_t n))[4];

static void set_parameters(struct gls_exec *x, struct gls_state *st, const struct call *c, parameters_of *of)
{
	float (*parameters)[4];

	if (gls_refuses(x, st, arg_i(c, 2) <= 0, GL_INVALID_VALUE))
		return;
	parameters = of(x, st, c, arg_u(c, 2));
	if (parameters)
		arg_floats(c, 3, parameters[0], 4 * arg_u(c, 2));
}

GLS_HANDLER(glProgramEnvParameters4fvEXT, STATE) { set_parameters(x, st, c, env_of); }
GLS_HANDLER(glProgramLocalParameters4fvEXT, STATE) { set_parameters(x, st, c, local_of); }

GLS_HANDLER(glProgramEnvParameter4fARB, STATE) { set_parameter(c, env_of(x, st, c, 1)); }
GLS_HANDLER(glProgramEnvParameter4fvARB, STATE) { set_parameter(c, env_of(x, st, c, 1)); }
GLS_HANDLER(glProgramEnvParameter4dARB, STATE) { set_parameter(c, env_of(x, st, c, 1)); }
GLS_HANDLER(glProgramEnvParameter4dvARB, STATE) { set_parameter(c, env_of(x, st, c, 1)); }
GLS_HANDLER(glProgramLocalParameter4fARB, STATE) { set_parameter(c, local_of(x, st, c, 1)); }
GLS_HANDLER(glProgramLocalParameter4fvARB, STATE) { set_parameter(c, local_of(x, st, c, 1)); }
GLS_HANDLER(glProgramLocalParameter4dARB, STATE) { set_parameter(c, local_of(x, st, c, 1)); }
GLS_HANDLER(glProgramLocalParameter4dvARB, STATE) { set_parameter(c, local_of(x, st, c, 1)); }
