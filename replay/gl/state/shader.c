/* GLSL shader and program objects (GL 2.1 sec. 2.15), and the equivalent commands of ARB_shader_objects. */
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"
#include "gl_tokens.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "replay/machine/state.h"
#include "replay/glsl/object.h"
#include "replay/programs/held.h"
#include "replay/programs/program.h"
#include "scene/mesa.h"

/* A shader, or a program; NULL: none with this name. */
static struct gls_shader *find(const struct gls_state *st, uint32_t name, int wants_program)
{
	struct gls_shader *s = table_find(&st->share->shaders, name);

	return s && (s->type == 0) == wants_program ? s : NULL;
}

/* Create an object under the name that was returned to the program. */
static void create(struct gls_exec *x, struct gls_state *st, const struct call *c, uint32_t type)
{
	const uint32_t name = (uint32_t)gls_value_int(&c->ret);
	struct gls_shader *old = name ? table_remove(&st->share->shaders, name) : NULL, *s;

	if (!name)
		return;
	if (old)
		gls_shader_free(old);
	s = gls_object_create(x, &st->share->shaders, name, sizeof(*s));
	if (s)
		s->type = type;
}

GLS_HANDLER(glCreateShader, NOW) { create(x, st, c, arg_u(c, 0)); }
GLS_HANDLER(glCreateShaderObjectARB, NOW) { create(x, st, c, arg_u(c, 0)); }
GLS_HANDLER(glCreateProgram, NOW) { create(x, st, c, 0); }
GLS_HANDLER(glCreateProgramObjectARB, NOW) { create(x, st, c, 0); }

static void remove_object(struct gls_state *st, uint32_t name)
{
	struct gls_shader *s = table_remove(&st->share->shaders, name);

	if (s)
		gls_shader_free(s);
}

/* A program no longer uses a shader. */
static void detach(struct gls_state *st, uint32_t name)
{
	struct gls_shader *s = find(st, name, 0);

	if (s && s->uses && --s->uses == 0 && s->deleted)
		remove_object(st, name);
}

/* Delete an object, or mark it until nothing uses it any more. */
static void delete(struct gls_state *st, uint32_t name)
{
	struct gls_shader *s = table_find(&st->share->shaders, name);

	if (!s)
		return;
	s->deleted = 1;
	if (s->type ? s->uses != 0 : st->program == name)
		return;
	for (uint32_t i = 0; i < s->n_attached; i++)
		detach(st, s->attached[i]);
	remove_object(st, name);
}

GLS_HANDLER(glDeleteShader, OBJECT) { delete(st, arg_u(c, 0)); }
GLS_HANDLER(glDeleteProgram, OBJECT) { delete(st, arg_u(c, 0)); }
GLS_HANDLER(glDeleteObjectARB, OBJECT) { delete(st, arg_u(c, 0)); }

static void use_program(struct gls_exec *x, struct gls_state *st, uint32_t program)
{
	const uint32_t before = st->program;
	const struct gls_shader *used = find(st, program, 1);
	const char *lack;
	const struct gls_shader *old = before != program ? find(st, before, 1) : NULL;

	if (gls_refuses(x, st, program && !table_find(&st->share->shaders, program), GL_INVALID_VALUE) ||
	    gls_refuses(x, st, used && !used->stages.linked, GL_INVALID_OPERATION))
		return;
	st->program = program;
	lack = program ? gls_program_lack(st) : NULL;
	if (lack) {
		x->counts.programs_used++;
		x->counts.programs_why = gls_reason(x, lack);
	}
	if (old && old->deleted)
		delete(st, before);
}

GLS_HANDLER(glUseProgram, STATE) { use_program(x, st, arg_u(c, 0)); }
GLS_HANDLER(glUseProgramObjectARB, STATE) { use_program(x, st, arg_u(c, 0)); }

/* --- Shaders ----------------------------------------------------------------------------------------------------- */

/*
 * Arguments: the shader, the number of strings, the strings, their lengths or NULL. In a recording the strings are
 * already cut to these lengths.
 */
GLS_HANDLER(glShaderSource, NOW)
{
	struct gls_shader *s = find(st, arg_u(c, 0), 0);
	uint64_t n = 0, bytes = 0, at = 0;
	const struct trace_value *strings = arg_items(c, 2, &n);
	char *all;

	if (!s)
		return;
	for (uint64_t i = 0; i < n; i++)
		bytes += strings[i].type == TRACE_STRING ? strings[i].count : 0;
	all = gls_scratch(x, bytes + 1);
	if (!all)
		return;
	for (uint64_t i = 0; i < n; i++)
		if (strings[i].type == TRACE_STRING && strings[i].count) {
			memcpy(all + at, strings[i].str, strings[i].count);
			at += strings[i].count;
		}
	if (gls_shader_set(&s->source, all, at))
		gls_fail(x);
}

GLS_HANDLER(glCompileShader, NOW)
{
	struct gls_shader *s = find(st, arg_u(c, 0), 0);

	if (s && s->source && gls_shader_set(&s->compiled, s->source, strlen(s->source)))
		gls_fail(x);
}

/* --- Programs ---------------------------------------------------------------------------------------------------- */

GLS_HANDLER(glAttachShader, NOW)
{
	struct gls_shader *program = find(st, arg_u(c, 0), 1), *shader = find(st, arg_u(c, 1), 0);

	if (!program || !shader)
		return;
	for (uint32_t i = 0; i < program->n_attached; i++)
		if (gls_refuses(x, st, program->attached[i] == arg_u(c, 1), GL_INVALID_OPERATION))
			return;
	if (MEMORY_GROW(program->attached, program->attached_room, program->n_attached + 1)) {
		gls_fail(x);
		return;
	}
	program->attached[program->n_attached++] = arg_u(c, 1);
	shader->uses++;
}

GLS_HANDLER(glDetachShader, NOW)
{
	struct gls_shader *program = find(st, arg_u(c, 0), 1);

	for (uint32_t i = 0; program && i < program->n_attached; i++)
		if (program->attached[i] == arg_u(c, 1)) {
			memmove(program->attached + i, program->attached + i + 1,
			        (program->n_attached - i - 1) * sizeof(*program->attached));
			program->n_attached--;
			detach(st, arg_u(c, 1));
			return;
		}
}

GLS_HANDLER(glLinkProgram, OBJECT)
{
	struct gls_shader *program = find(st, arg_u(c, 0), 1);
	int err = 0;

	if (!program)
		return;
	gls_shader_forget(program);
	for (uint32_t i = 0; i < program->n_attached && !err; i++) {
		const struct gls_shader *s = find(st, program->attached[i], 0);

		if (s && s->compiled)
			err = gls_shader_add_text(program, s->type, s->compiled);
	}
	program->products_once = (st->mesa & SCENE_MESA_PRODUCTS_ONCE) != 0;
	if (!err)
		err = gls_shader_translate(program, 0);
	if (err)
		gls_fail(x);
}

GLS_HANDLER(glBindAttribLocation, NOW)
{
	struct gls_shader *program = find(st, arg_u(c, 0), 1);

	if (program && arg(c, 2)->type == TRACE_STRING && gls_shader_locate_attribute(program, arg(c, 2)->str, arg_u(c, 1)))
		gls_fail(x);
}

/* The location that was returned to the program: the linker of the original machine chose it. */
GLS_HANDLER(glGetAttribLocation, OBJECT)
{
	struct gls_shader *program = find(st, arg_u(c, 0), 1);
	const int64_t location = gls_value_int(&c->ret);

	if (!program || location < 0 || arg(c, 1)->type != TRACE_STRING)
		return;
	for (uint32_t i = 0; i < program->n_attributes; i++)
		if (strcmp(program->attributes[i].name, arg(c, 1)->str) == 0 && program->attributes[i].location == (uint32_t)location)
			return;
	if (gls_shader_locate_attribute(program, arg(c, 1)->str, (uint32_t)location) ||
	    (program->stages.linked && gls_shader_translate(program, 1)))
		gls_fail(x);
}

GLS_HANDLER(glGetUniformLocation, NOW)
{
	struct gls_shader *program = find(st, arg_u(c, 0), 1);
	const int64_t location = gls_value_int(&c->ret);

	if (program && location >= 0 && arg(c, 1)->type == TRACE_STRING &&
	    gls_shader_locate_uniform(program, arg(c, 1)->str, (uint32_t)location))
		gls_fail(x);
}

/* --- Uniforms ---------------------------------------------------------------------------------------------------- */

/* Save the values of other contexts that drew with the program last; they do not see what is set here. */
static void let_others_hold(struct gls_exec *x, const struct gls_state *st, struct gls_stages *p)
{
	for (size_t i = 0; i < x->n_contexts; i++) {
		const struct gls_state *other = &x->contexts[i]->state;

		for (unsigned stage = 0; stage < N_GLS_STAGES && other != st && other->share == st->share; stage++)
			if (other->drawn_program[stage] == st->program && other->drawn_links[stage] == p->links &&
			    gls_held_keep(p, other->handle, stage))
				gls_fail(x);
	}
}

/* Arguments: the location, then numbers from `first` on, or the number of values and an array. */
static void set_uniform(struct gls_exec *x, struct gls_state *st, const struct call *c, uint32_t first, uint32_t count,
                        uint32_t rows, uint32_t columns, int transposed)
{
	struct gls_shader *program = find(st, st->program, 1);
	const uint32_t each = rows * (columns ? columns : 1);
	struct gls_uniform_change change;
	float *values;
	unsigned n;

	if (!program || !count || count > 65536)
		return;
	values = gls_scratch(x, (size_t)count * each * sizeof(*values));
	if (!values)
		return;
	if (arg(c, first)->type == TRACE_ARRAY)
		n = arg_floats(c, first, values, count * each);
	else
		for (n = 0; n < each && n < 4; n++)
			values[n] = arg_f(c, first + n);
	if (!gls_shader_set_uniform(program, arg_u(c, 0), values, n / each, rows, columns, transposed, 1, &change))
		return;
	let_others_hold(x, st, &program->stages);
	gls_shader_set_uniform(program, arg_u(c, 0), values, n / each, rows, columns, transposed, 0, &change);
	for (unsigned stage = 0; stage < N_GLS_STAGES; stage++)
		if (gls_held_reads(&program->stages, stage, change.first, change.n))
			gls_held_drop(&program->stages, st->handle, stage);
}

GLS_FAMILY(glUniform, STATE)
{
	const struct gls_suffix suffix = gls_commands[x->command].suffix;

	set_uniform(x, st, c, suffix.array ? 2 : 1, suffix.array ? arg_u(c, 1) : 1, suffix.n, 0, 0);
}

static void set_matrix(struct gls_exec *x, struct gls_state *st, const struct call *c, uint32_t columns, uint32_t rows)
{
	set_uniform(x, st, c, 3, arg_u(c, 1), rows, columns, arg_u(c, 2) != 0);
}

GLS_HANDLER(glUniformMatrix2fv, STATE) { set_matrix(x, st, c, 2, 2); }
GLS_HANDLER(glUniformMatrix3fv, STATE) { set_matrix(x, st, c, 3, 3); }
GLS_HANDLER(glUniformMatrix4fv, STATE) { set_matrix(x, st, c, 4, 4); }
GLS_HANDLER(glUniformMatrix2x3fv, STATE) { set_matrix(x, st, c, 2, 3); }
GLS_HANDLER(glUniformMatrix3x2fv, STATE) { set_matrix(x, st, c, 3, 2); }
GLS_HANDLER(glUniformMatrix2x4fv, STATE) { set_matrix(x, st, c, 2, 4); }
GLS_HANDLER(glUniformMatrix4x2fv, STATE) { set_matrix(x, st, c, 4, 2); }
GLS_HANDLER(glUniformMatrix3x4fv, STATE) { set_matrix(x, st, c, 3, 4); }
GLS_HANDLER(glUniformMatrix4x3fv, STATE) { set_matrix(x, st, c, 4, 3); }
