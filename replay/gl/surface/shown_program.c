#include "replay/gl/surface/shown_program.h"

#include <string.h>

#include "base/mat4.h"
#include "kernels/gl/instructions.h"

/* --- Fragments: contents of registers, as far as they are the same for all fragments ----------------------------- */

enum held { NUMBER, INPUT, TEXEL, OTHER };

struct value {
	enum held held;
	uint32_t which; /* INPUT: the register; TEXEL: the component */
	float number;
};

struct shading {
	struct program program;
	struct value registers[SCENE_PROGRAM_REGISTERS];
	struct shown_program *out;
	uint32_t samples;
};

static const struct value other = { OTHER, 0, 0 };

static struct value number(float n)
{
	return (struct value){ NUMBER, 0, n };
}

static int is_number(const struct value *v, float n)
{
	return v->held == NUMBER && v->number == n;
}

static struct value operand(const struct shading *s, uint32_t at, uint32_t negated)
{
	struct value v = at >= SCENE_PROGRAM_CONSTANT ? number(s->program.constants[at - SCENE_PROGRAM_CONSTANT]) :
	                                                s->registers[at];

	if (negated)
		v = v.held == NUMBER ? number(-v.number) : other;
	return v;
}

static struct value sum(struct value a, struct value b)
{
	if (a.held == NUMBER && b.held == NUMBER)
		return number(a.number + b.number);
	return is_number(&a, 0) ? b : is_number(&b, 0) ? a : other;
}

static struct value product(struct value a, struct value b)
{
	if (a.held == NUMBER && b.held == NUMBER)
		return number(a.number * b.number);
	return is_number(&a, 1) ? b : is_number(&b, 1) ? a : other;
}

static struct value result(uint32_t operation, struct value a, struct value b, struct value c)
{
	switch (operation) {
	case SCENE_OP_MOVE: return a;
	case SCENE_OP_ADD: return sum(a, b);
	case SCENE_OP_MULTIPLY: return product(a, b);
	case SCENE_OP_MAD: return sum(product(a, b), c);
	case SCENE_OP_CHOOSE: return a.held != NUMBER ? other : a.number != 0 ? b : c;
	case SCENE_OP_SELECT: return a.held != NUMBER ? other : a.number < 0 ? b : c;
	default:
		if (a.held != NUMBER || (operation >= SCENE_OP_ADD && b.held != NUMBER) || operation == SCENE_OP_DX ||
		    operation == SCENE_OP_DY)
			return other;
		return number(program_number(operation, a.number, b.number));
	}
}

static void compute(struct shading *s, const struct scene_instruction *in)
{
	for (uint32_t i = 0; i < in->n; i++) {
		const struct value a = operand(s, in->a + (in->flags & SCENE_STEP_A ? i : 0), in->flags & SCENE_NEGATE_A);
		const struct value b = in->operation >= SCENE_OP_ADD ?
		                               operand(s, in->b + (in->flags & SCENE_STEP_B ? i : 0),
		                                       in->flags & SCENE_NEGATE_B) :
		                               a;
		const struct value c = in->operation >= SCENE_OP_MAD ?
		                               operand(s, in->c + (in->flags & SCENE_STEP_C ? i : 0),
		                                       in->flags & SCENE_NEGATE_C) :
		                               a;
		struct value r = result(in->operation, a, b, c);

		if (in->flags & SCENE_SATURATE && r.held != TEXEL) /* texels are in [0,1] already */
			r = r.held == NUMBER ? number(r.number < 0 ? 0 : r.number > 1 ? 1 : r.number) : other;
		s->registers[in->to + i] = r;
	}
}

/* @return 0: does not sample one place of one texture */
static int sample(struct shading *s, const struct scene_instruction *in)
{
	const struct value *c = &s->registers[in->a];
	const uint32_t first = 4 * SCENE_INPUT_TEXCOORD;

	if (s->samples++ || in->c & (SCENE_TEXTURE_BIASED | SCENE_TEXTURE_LEVEL) ||
	    (in->c & SCENE_TEXTURE_DIVIDED && !is_number(&c[3], 1)) || c[0].held != INPUT || c[1].held != INPUT ||
	    c[0].which < first || c[1].which < first)
		return 0;
	*s->out = (struct shown_program){ in->b, { c[0].which - first, c[1].which - first } };
	for (uint32_t i = 0; i < 4; i++)
		s->registers[in->to + i] = (struct value){ TEXEL, i, 0 };
	return 1;
}

/*
 * Follow a program that is straight-line code for all fragments. @return 0: it is not, or uses unsupported operations
 */
static int follow(struct shading *s)
{
	for (uint32_t at = 0; at < s->program.head->n_instructions; at++) {
		const struct scene_instruction *in = &s->program.instructions[at];
		const int turns = in->operation == SCENE_OP_KILL || in->operation == SCENE_OP_MASK ||
		                  in->operation == SCENE_OP_JUMP_NONE;
		const struct value a = turns ? operand(s, in->a, in->flags & SCENE_NEGATE_A) : other;

		if ((turns && a.held != NUMBER) || (in->operation == SCENE_OP_KILL && (a.number < 0 || in->n != 1)) ||
		    (in->operation == SCENE_OP_MASK && a.number == 0) || in->operation == SCENE_OP_FETCH ||
		    in->operation == SCENE_OP_STORE)
			return 0;
		if (in->operation == SCENE_OP_JUMP || (in->operation == SCENE_OP_JUMP_NONE && a.number == 0)) {
			if (in->to <= at)
				return 0;
			at = in->to - 1;
		} else if (in->operation == SCENE_OP_TEXTURE) {
			if (!sample(s, in))
				return 0;
		} else if (!turns) {
			compute(s, in);
		}
	}
	return 1;
}

int shown_program_of(const struct scene *s, const struct scene_material *m, struct shown_program *out)
{
	struct shading shading = { .program = program_at(s->programs + (m->fragment_program - 1)), .out = out };
	const struct value *color;

	for (uint32_t i = 0; i < 4 * N_SCENE_INPUTS; i++)
		shading.registers[i] = (struct value){ INPUT, i, 0 };
	if (shading.program.head->sets_depth || shading.program.head->n_lights || !follow(&shading) || !shading.samples)
		return 0;
	color = &shading.registers[program_color(&shading.program, 0)];
	for (uint32_t i = 0; i < 3; i++)
		if (color[i].held != TEXEL || color[i].which != i)
			return 0;
	return 1;
}

/* --- Vertices ---------------------------------------------------------------------------------------------------- */

static struct vec4 attribute(const float *array, const float *current, uint32_t v)
{
	const float *from = array ? array + 4 * (size_t)v : current;

	/* NOLINTNEXTLINE(clang-analyzer-core.NullDereference): without an array there is a current value */
	return v4(from[0], from[1], from[2], from[3]);
}

static struct vec4 input_of(const struct scene *s, const struct scene_instance *in, uint32_t v, uint32_t input)
{
	const struct scene_mesh *mesh = s->meshes[in->mesh];
	const struct scene_current *c = &s->currents[in->current];
	const float *normal = mesh->normal ? mesh->normal + 3 * (size_t)v : c->normal;

	switch (input) {
	case SCENE_VERTEX_POSITION: return attribute(mesh->position, NULL, v);
	case SCENE_VERTEX_NORMAL: return v4(normal[0], normal[1], normal[2], 1.0f);
	case SCENE_VERTEX_COLOR: return attribute(mesh->color, c->color, v);
	case SCENE_VERTEX_SECONDARY: return attribute(mesh->secondary, c->secondary, v);
	case SCENE_VERTEX_FOG: return v4(mesh->fog_coord ? mesh->fog_coord[v] : c->fog_coord, 0.0f, 0.0f, 1.0f);
	default: break;
	}
	if (input < SCENE_VERTEX_GENERIC)
		return attribute(mesh->texcoord[input - SCENE_VERTEX_TEXCOORD], c->texcoord[input - SCENE_VERTEX_TEXCOORD], v);
	return attribute(mesh->generics[input - SCENE_VERTEX_GENERIC], c->generics[input - SCENE_VERTEX_GENERIC], v);
}

int shown_program_vertex(const struct scene *s, const struct scene_instance *in, uint32_t v, float clip[4],
                         float *coordinates)
{
	const struct program program = program_at(s->programs + (s->materials[in->material].vertex_program - 1));
	struct program_run run;

	program_begin(&run, &program, 1, NULL);
	for (uint32_t input = 0; input < N_SCENE_VERTEX_INPUTS; input++)
		if (program.head->inputs >> input & 1)
			program_set(&run, 4 * input, 0, input_of(s, in, v, input));
	program_run_from(&run, &program, 0);
	for (uint32_t i = 0; i < 4 * SCENE_MAX_UNITS; i++)
		coordinates[i] = run.registers[SCENE_VERTEX_RESULTS + 4 * SCENE_RESULT_TEXCOORD + i].x;
	for (uint32_t i = 0; i < 4; i++)
		clip[i] = run.registers[SCENE_VERTEX_RESULTS + 4 * SCENE_RESULT_POSITION + i].x;
	return program.head->outputs >> SCENE_RESULT_POSITION & 1;
}
