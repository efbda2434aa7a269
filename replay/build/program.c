/* Puts programs into a scene, with the values that their constants have for a draw. */
#include "replay/build/program.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/mat4.h"
#include "gl_tokens.h"
#include "replay/build/intern.h"
#include "replay/build/material.h"
#include "replay/machine/errors.h"
#include "replay/programs/program.h"
#include "scene/mesa.h"

static void set_four(float out[4], const float *from)
{
	memcpy(out, from, 16);
}

static const float *face_color(const struct scene_face *face, uint32_t part)
{
	return part == GLS_AMBIENT  ? face->ambient :
	       part == GLS_DIFFUSE  ? face->diffuse :
	       part == GLS_SPECULAR ? face->specular :
	                              face->emission;
}

static const float *light_color(const struct scene_light *light, uint32_t part)
{
	return part == GLS_AMBIENT ? light->ambient : part == GLS_DIFFUSE ? light->diffuse : light->specular;
}

/* Scale x y z to length 1. */
static void normalize(float v[3])
{
	const float length = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);

	for (unsigned i = 0; i < 3 && length > 0; i++)
		v[i] /= length;
}

static void fill_light(const struct scene_light *light, uint32_t part, float out[4])
{
	switch (part) {
	case PROGRAM_LIGHT_AMBIENT: set_four(out, light->ambient); break;
	case PROGRAM_LIGHT_DIFFUSE: set_four(out, light->diffuse); break;
	case PROGRAM_LIGHT_SPECULAR: set_four(out, light->specular); break;
	case PROGRAM_LIGHT_POSITION: set_four(out, light->position_eye); break;
	case PROGRAM_LIGHT_ATTENUATION:
		memcpy(out, light->attenuation, 12);
		out[3] = light->spot_exponent;
		break;
	case PROGRAM_LIGHT_DIRECTION:
		memcpy(out, light->spot_direction_eye, 12);
		normalize(out);
		out[3] = fmaxf(cosf(light->spot_cutoff_deg * (float)(3.14159265358979323846 / 180)), 0); /* as in Mesa (22.3.6) */
		break;
	case PROGRAM_LIGHT_CUTOFF: out[0] = light->spot_cutoff_deg; break;
	default: /* halfway between the light and the viewer, both at infinity */
		memcpy(out, light->position_eye, 12);
		normalize(out);
		out[2] += 1;
		normalize(out);
		out[3] = 1;
	}
}

static void fill_matrix(const struct gls_state *st, const struct program_constant *c, float out[4])
{
	const struct gls_matrix_stack *stack = c->index == PROGRAM_MODELVIEW ?
	                                               &st->modelview :
	                                       c->index < PROGRAM_TEXTURE_MATRIX ?
	                                               &st->projection :
	                                       c->index < PROGRAM_OWN_MATRIX ?
	                                               &st->texture[c->index - PROGRAM_TEXTURE_MATRIX] :
	                                               &st->program_matrix[c->index - PROGRAM_OWN_MATRIX];
	float m[16], other[16];

	memcpy(m, stack->matrices[stack->depth], sizeof(m));
	if (c->index == PROGRAM_MVP)
		gls_sums(st)->mul(m, st->projection.matrices[st->projection.depth], st->modelview.matrices[st->modelview.depth]);
	if (c->part & PROGRAM_INVERTED) {
		mat4_invert(other, m);
		memcpy(m, other, sizeof(m));
	}
	for (uint32_t k = 0; k < 4; k++)
		out[k] = c->part & PROGRAM_TRANSPOSED ? m[4 * c->row + k] : m[4 * k + c->row];
}

/* A face's colour without any light, emission included. */
static void fill_scene_color(const struct gls_lighting *l, const struct scene_face *face, float out[4])
{
	for (unsigned k = 0; k < 3; k++)
		out[k] = face->emission[k] + l->model_ambient[k] * face->ambient[k];
	out[3] = face->diffuse[3];
}

static void fill_fog(const struct gls_fog *fog, float out[4])
{
	out[0] = fog->density;
	out[1] = fog->start;
	out[2] = fog->end;
	out[3] = fog->end == fog->start ? 1 : 1 / (fog->end - fog->start);
}

/* 1 / the length of the third row of the inverse (GL 2.1 sec. 2.11.3). */
static void fill_normal_scale(const struct gls_state *st, float out[4])
{
	float inverse[16];

	mat4_invert(inverse, st->modelview.matrices[st->modelview.depth]);
	out[0] = 1 / sqrtf(inverse[2] * inverse[2] + inverse[6] * inverse[6] + inverse[10] * inverse[10]);
}

static void fill(const struct gls_state *st, const struct gls_attribs *a, const struct program_stage *stage,
                 const struct program_constant *c, float out[4])
{
	const struct gls_lighting *l = &a->lighting;
	const struct scene_light *light = &l->lights[c->index % GLS_MAX_LIGHTS].value;
	const struct scene_unit *unit = &a->texturing.units[c->index % GLS_MAX_UNITS].value;
	const struct scene_face *face = &l->face[(c->source == PROGRAM_LIGHT_PRODUCT ? c->face : c->index) & 1];

	switch (c->source) {
	case PROGRAM_LITERAL: set_four(out, c->value); break;
	case PROGRAM_ENV: set_four(out, stage->env[c->index]); break;
	case PROGRAM_LOCAL: set_four(out, stage->local[c->index]); break;
	case PROGRAM_MATERIAL:
		if (c->part == PROGRAM_SHININESS)
			set_four(out, (const float[4]){ face->shininess, 0, 0, 1 });
		else
			set_four(out, face_color(face, c->part));
		break;
	case PROGRAM_LIGHT: fill_light(light, c->part, out); break;
	case PROGRAM_LIGHT_MODEL: set_four(out, l->model_ambient); break;
	case PROGRAM_SCENE_COLOR: fill_scene_color(l, face, out); break;
	case PROGRAM_LIGHT_PRODUCT:
		for (unsigned k = 0; k < 3; k++)
			out[k] = light_color(light, c->part)[k] * face_color(face, c->part)[k];
		out[3] = face_color(face, c->part)[3];
		break;
	case PROGRAM_ENV_COLOR: set_four(out, unit->env_color); break;
	case PROGRAM_FOG_COLOR: set_four(out, a->fog.color); break;
	case PROGRAM_FOG_NUMBERS: fill_fog(&a->fog, out); break;
	case PROGRAM_DEPTH_RANGE:
		set_four(out, (const float[4]){ a->viewport.depth_range[0], a->viewport.depth_range[1],
		                                a->viewport.depth_range[1] - a->viewport.depth_range[0], 1 });
		break;
	case PROGRAM_MATRIX: fill_matrix(st, c, out); break;
	case PROGRAM_CLIP_PLANE: set_four(out, a->transform.clip_plane_eye[c->index % GLS_MAX_CLIP_PLANES]); break;
	case PROGRAM_POINT_NUMBERS:
		set_four(out, (const float[4]){ a->point.size, a->point.size_min, a->point.size_max, a->point.fade_threshold });
		break;
	case PROGRAM_POINT_ATTENUATION:
		set_four(out, (const float[4]){ a->point.attenuation[0], a->point.attenuation[1], a->point.attenuation[2], 1 });
		break;
	case PROGRAM_NORMAL_SCALE: fill_normal_scale(st, out); break;
	case PROGRAM_TEXGEN:
		set_four(out, c->part ? unit->gen_object_plane[c->row & 3] : unit->gen_eye_plane[c->row & 3]);
		break;
	}
}

/* A program's point size counts only if the state enables it. */
static uint32_t outputs_of(const struct gls_state *st, const struct program_code *code)
{
	return st->a.programs.point_size ? code->outputs : code->outputs & ~(1u << SCENE_RESULT_POINT_SIZE);
}

/* Samplers hold texture units: look textures up by them. */
static void name_units(const struct program_stage *stage, struct scene_instruction *instructions)
{
	for (uint32_t i = 0; i < stage->code->n_instructions; i++)
		if (instructions[i].operation == SCENE_OP_TEXTURE)
			instructions[i].b = program_unit_of(stage, instructions[i].b);
}

uint32_t gls_program_build(struct gls_exec *x, struct gls_frame *f, const struct gls_state *st,
                           const struct gls_attribs *a, const struct program_stage *stage, uint32_t lights)
{
	const struct program_code *code = stage->code;
	const struct scene_program head = {
		code->n_instructions, 4 * code->n_constants, code->n_registers, code->inputs,   code->kills,
		code->sets_depth,     outputs_of(st, code),  code->across,      code->n_lights, 0,
		code->data,           code->n_data
	};
	const size_t instruction_bytes = code->n_instructions * sizeof(struct scene_instruction);
	const size_t light_bytes = code->n_lights * sizeof(struct scene_program_light);
	const size_t n = (sizeof(head) + instruction_bytes + light_bytes) / 4 + 4 * (size_t)code->n_constants;
	uint32_t *words = malloc(n * 4), place;

	if (!words) {
		gls_out_of_memory(x, n * 4);
		return 0;
	}
	memcpy(words, &head, sizeof(head));
	if (instruction_bytes)
		memcpy((char *)words + sizeof(head), code->instructions, instruction_bytes);
	if (code->n_samplers)
		name_units(stage, (struct scene_instruction *)((char *)words + sizeof(head)));
	for (uint32_t i = 0; i < code->n_lights; i++) {
		const struct program_light *from = &code->lights[i];
		const uint32_t before = lights & ((1u << code->constants[from->constant].index) - 1);
		const struct scene_program_light light = { from->to, 4 * from->constant, (uint32_t)__builtin_popcount(before) };

		memcpy((char *)words + sizeof(head) + instruction_bytes + i * sizeof(light), &light, sizeof(light));
	}
	for (uint32_t i = 0; i < code->n_constants; i++) {
		float four[4] = { 0 };

		fill(st, a, stage, &code->constants[i], four);
		memcpy((char *)words + sizeof(head) + instruction_bytes + light_bytes + 16 * i, four, sizeof(four));
	}
	place = gls_intern_array(x, &f->programs, &f->out->programs, &f->out->n_programs, &f->room.programs, words,
	                         (uint32_t)n, 4);
	free(words);
	return place == SCENE_NONE ? 0 : place + 1;
}

int gls_shades_flat(const struct gls_state *st)
{
	struct program_stage fragments;

	if (st->a.lighting.shade_model != GL_FLAT)
		return 0;
	if (st->program || !st->a.programs.fragment)
		return 1;
	return st->mesa & SCENE_MESA_FLAT_PROGRAMS && gls_program_runs_fragments(st, &fragments) &&
	       fragments.code->inputs & (1u << SCENE_INPUT_COLOR | 1u << SCENE_INPUT_SECONDARY);
}
