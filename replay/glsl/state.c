#include "replay/glsl/state.h"

#include <stdlib.h>
#include <string.h>

#include "replay/machine/state.h"

/* n numbers of a constant, starting at number `from`. */
struct piece {
	enum program_source source;
	uint32_t part, from, n;
};

/* Members of structures, in the order of their numbers; an array has one element for each light, unit or plane. */
static const struct state {
	const char *name;
	uint32_t face;    /* or row */
	uint32_t by_face; /* 1: the constant's index is the face */
	struct piece pieces[13];
} states[] = {
	{ "gl_LightSource",
	  0,
	  0,
	  { { PROGRAM_LIGHT, PROGRAM_LIGHT_AMBIENT, 0, 4 },
	    { PROGRAM_LIGHT, PROGRAM_LIGHT_DIFFUSE, 0, 4 },
	    { PROGRAM_LIGHT, PROGRAM_LIGHT_SPECULAR, 0, 4 },
	    { PROGRAM_LIGHT, PROGRAM_LIGHT_POSITION, 0, 4 },
	    { PROGRAM_LIGHT, PROGRAM_LIGHT_HALF, 0, 4 },
	    { PROGRAM_LIGHT, PROGRAM_LIGHT_DIRECTION, 0, 3 },
	    { PROGRAM_LIGHT, PROGRAM_LIGHT_ATTENUATION, 3, 1 },
	    { PROGRAM_LIGHT, PROGRAM_LIGHT_CUTOFF, 0, 1 },
	    { PROGRAM_LIGHT, PROGRAM_LIGHT_DIRECTION, 3, 1 },
	    { PROGRAM_LIGHT, PROGRAM_LIGHT_ATTENUATION, 0, 3 } } },
	{ "gl_FrontLightProduct",
	  0,
	  0,
	  { { PROGRAM_LIGHT_PRODUCT, GLS_AMBIENT, 0, 4 },
	    { PROGRAM_LIGHT_PRODUCT, GLS_DIFFUSE, 0, 4 },
	    { PROGRAM_LIGHT_PRODUCT, GLS_SPECULAR, 0, 4 } } },
	{ "gl_BackLightProduct",
	  1,
	  0,
	  { { PROGRAM_LIGHT_PRODUCT, GLS_AMBIENT, 0, 4 },
	    { PROGRAM_LIGHT_PRODUCT, GLS_DIFFUSE, 0, 4 },
	    { PROGRAM_LIGHT_PRODUCT, GLS_SPECULAR, 0, 4 } } },
	{ "gl_FrontMaterial",
	  0,
	  1,
	  { { PROGRAM_MATERIAL, GLS_EMISSION, 0, 4 },
	    { PROGRAM_MATERIAL, GLS_AMBIENT, 0, 4 },
	    { PROGRAM_MATERIAL, GLS_DIFFUSE, 0, 4 },
	    { PROGRAM_MATERIAL, GLS_SPECULAR, 0, 4 },
	    { PROGRAM_MATERIAL, PROGRAM_SHININESS, 0, 1 } } },
	{ "gl_BackMaterial",
	  1,
	  1,
	  { { PROGRAM_MATERIAL, GLS_EMISSION, 0, 4 },
	    { PROGRAM_MATERIAL, GLS_AMBIENT, 0, 4 },
	    { PROGRAM_MATERIAL, GLS_DIFFUSE, 0, 4 },
	    { PROGRAM_MATERIAL, GLS_SPECULAR, 0, 4 },
	    { PROGRAM_MATERIAL, PROGRAM_SHININESS, 0, 1 } } },
	{ "gl_LightModel", 0, 0, { { PROGRAM_LIGHT_MODEL, 0, 0, 4 } } },
	{ "gl_FrontLightModelProduct", 0, 1, { { PROGRAM_SCENE_COLOR, 0, 0, 4 } } },
	{ "gl_BackLightModelProduct", 1, 1, { { PROGRAM_SCENE_COLOR, 0, 0, 4 } } },
	{ "gl_Fog", 0, 0, { { PROGRAM_FOG_COLOR, 0, 0, 4 }, { PROGRAM_FOG_NUMBERS, 0, 0, 4 } } },
	{ "gl_DepthRange", 0, 0, { { PROGRAM_DEPTH_RANGE, 0, 0, 3 } } },
	{ "gl_Point", 0, 0, { { PROGRAM_POINT_NUMBERS, 0, 0, 4 }, { PROGRAM_POINT_ATTENUATION, 0, 0, 3 } } },
	{ "gl_TextureEnvColor", 0, 0, { { PROGRAM_ENV_COLOR, 0, 0, 4 } } },
	{ "gl_ClipPlane", 0, 0, { { PROGRAM_CLIP_PLANE, 0, 0, 4 } } },
	{ "gl_EyePlaneS", 0, 0, { { PROGRAM_TEXGEN, 0, 0, 4 } } },
	{ "gl_EyePlaneT", 1, 0, { { PROGRAM_TEXGEN, 0, 0, 4 } } },
	{ "gl_EyePlaneR", 2, 0, { { PROGRAM_TEXGEN, 0, 0, 4 } } },
	{ "gl_EyePlaneQ", 3, 0, { { PROGRAM_TEXGEN, 0, 0, 4 } } },
	{ "gl_ObjectPlaneS", 0, 0, { { PROGRAM_TEXGEN, 1, 0, 4 } } },
	{ "gl_ObjectPlaneT", 1, 0, { { PROGRAM_TEXGEN, 1, 0, 4 } } },
	{ "gl_ObjectPlaneR", 2, 0, { { PROGRAM_TEXGEN, 1, 0, 4 } } },
	{ "gl_ObjectPlaneQ", 3, 0, { { PROGRAM_TEXGEN, 1, 0, 4 } } },
};

/* Matrices are stored by rows; this is a column, as in GLSL. */
static const struct {
	const char *name;
	uint32_t index, part;
} matrices[] = {
	{ "gl_ModelViewMatrix", PROGRAM_MODELVIEW, PROGRAM_TRANSPOSED },
	{ "gl_ProjectionMatrix", PROGRAM_PROJECTION, PROGRAM_TRANSPOSED },
	{ "gl_ModelViewProjectionMatrix", PROGRAM_MVP, PROGRAM_TRANSPOSED },
	{ "gl_TextureMatrix", PROGRAM_TEXTURE_MATRIX, PROGRAM_TRANSPOSED },
	{ "gl_NormalMatrix", PROGRAM_MODELVIEW, PROGRAM_INVERTED },
	{ "gl_ModelViewMatrixInverse", PROGRAM_MODELVIEW, PROGRAM_INVERTED | PROGRAM_TRANSPOSED },
	{ "gl_ProjectionMatrixInverse", PROGRAM_PROJECTION, PROGRAM_INVERTED | PROGRAM_TRANSPOSED },
	{ "gl_ModelViewProjectionMatrixInverse", PROGRAM_MVP, PROGRAM_INVERTED | PROGRAM_TRANSPOSED },
	{ "gl_TextureMatrixInverse", PROGRAM_TEXTURE_MATRIX, PROGRAM_INVERTED | PROGRAM_TRANSPOSED },
	{ "gl_ModelViewMatrixTranspose", PROGRAM_MODELVIEW, 0 }, { "gl_ProjectionMatrixTranspose", PROGRAM_PROJECTION, 0 },
	{ "gl_ModelViewProjectionMatrixTranspose", PROGRAM_MVP, 0 },
	{ "gl_TextureMatrixTranspose", PROGRAM_TEXTURE_MATRIX, 0 },
	{ "gl_ModelViewMatrixInverseTranspose", PROGRAM_MODELVIEW, PROGRAM_INVERTED },
	{ "gl_ProjectionMatrixInverseTranspose", PROGRAM_PROJECTION, PROGRAM_INVERTED },
	{ "gl_ModelViewProjectionMatrixInverseTranspose", PROGRAM_MVP, PROGRAM_INVERTED },
	{ "gl_TextureMatrixInverseTranspose", PROGRAM_TEXTURE_MATRIX, PROGRAM_INVERTED },
};

/* Number of elements of an array and their type; for other types one, and the type itself. */
static uint32_t elements_of(const struct glsl_writer *w, uint32_t type, const struct glsl_type **element)
{
	const struct glsl_type *t = glsl_type_of(w, type);

	*element = t->kind == GLSL_ARRAY ? glsl_type_of(w, t->first) : t;
	return t->kind == GLSL_ARRAY ? t->length : 1;
}

static struct glsl_value matrix(struct glsl_writer *w, const struct glsl_symbol *s, uint32_t index, uint32_t part)
{
	const struct glsl_type *element;
	const uint32_t n = elements_of(w, s->type, &element);
	struct glsl_value v = glsl_value_of(w, s->type, n * element->numbers);
	uint32_t at = 0;

	for (uint32_t i = 0; i < n && v.at; i++)
		for (uint32_t column = 0; column < element->columns; column++) {
			const uint32_t first = glsl_constant(
				w, &(struct program_constant){
					   .source = PROGRAM_MATRIX, .index = index + i, .part = part, .row = column });

			for (uint32_t row = 0; row < element->rows; row++)
				v.at[at++] = first + row;
		}
	return v;
}

static struct glsl_value state(struct glsl_writer *w, const struct glsl_symbol *s, const struct state *from)
{
	const struct glsl_type *element;
	const uint32_t n = elements_of(w, s->type, &element);
	struct glsl_value v = glsl_value_of(w, s->type, n * element->numbers);
	uint32_t at = 0;

	for (uint32_t i = 0; i < n && v.at; i++)
		for (const struct piece *p = from->pieces; p->n; p++) {
			const uint32_t first = glsl_constant(
				w, &(struct program_constant){ .source = p->source,
			                                       .index = from->by_face ? from->face : i,
			                                       .part = p->part,
			                                       .face = from->face,
			                                       .row = from->face });

			for (uint32_t k = 0; k < p->n && at < v.n; k++)
				v.at[at++] = first + p->from + k;
		}
	return v;
}

/* Inputs and outputs in fixed registers of the stage. */
static const struct place {
	const char *name;
	uint32_t first;
} fragment_places[] = {
	{ "gl_Color", 4 * SCENE_INPUT_COLOR }, { "gl_SecondaryColor", 4 * SCENE_INPUT_SECONDARY },
	{ "gl_FogFragCoord", 4 * SCENE_INPUT_FOG }, { "gl_FragCoord", 4 * SCENE_INPUT_POSITION },
	{ "gl_TexCoord", 4 * SCENE_INPUT_TEXCOORD }, { "gl_FrontFacing", 4 * SCENE_INPUT_FACE },
	{ "gl_FragColor", SCENE_PROGRAM_COLOR }, { "gl_FragDepth", SCENE_PROGRAM_DEPTH },
}, vertex_places[] = {
	{ "gl_Vertex", 4 * SCENE_VERTEX_POSITION }, { "gl_Normal", 4 * SCENE_VERTEX_NORMAL },
	{ "gl_Color", 4 * SCENE_VERTEX_COLOR }, { "gl_SecondaryColor", 4 * SCENE_VERTEX_SECONDARY },
	{ "gl_FogCoord", 4 * SCENE_VERTEX_FOG }, { "gl_MultiTexCoord0", 4 * SCENE_VERTEX_TEXCOORD },
	{ "gl_MultiTexCoord1", 4 * SCENE_VERTEX_TEXCOORD + 4 }, { "gl_MultiTexCoord2", 4 * SCENE_VERTEX_TEXCOORD + 8 },
	{ "gl_MultiTexCoord3", 4 * SCENE_VERTEX_TEXCOORD + 12 }, { "gl_MultiTexCoord4", 4 * SCENE_VERTEX_TEXCOORD + 16 },
	{ "gl_MultiTexCoord5", 4 * SCENE_VERTEX_TEXCOORD + 20 }, { "gl_MultiTexCoord6", 4 * SCENE_VERTEX_TEXCOORD + 24 },
	{ "gl_MultiTexCoord7", 4 * SCENE_VERTEX_TEXCOORD + 28 },
	{ "gl_Position", SCENE_VERTEX_RESULTS + 4 * SCENE_RESULT_POSITION },
	{ "gl_FrontColor", SCENE_VERTEX_RESULTS + 4 * SCENE_RESULT_COLOR },
	{ "gl_FrontSecondaryColor", SCENE_VERTEX_RESULTS + 4 * SCENE_RESULT_SECONDARY },
	{ "gl_BackColor", SCENE_VERTEX_RESULTS + 4 * SCENE_RESULT_BACK_COLOR },
	{ "gl_BackSecondaryColor", SCENE_VERTEX_RESULTS + 4 * SCENE_RESULT_BACK_SECONDARY },
	{ "gl_FogFragCoord", SCENE_VERTEX_RESULTS + 4 * SCENE_RESULT_FOG },
	{ "gl_PointSize", SCENE_VERTEX_RESULTS + 4 * SCENE_RESULT_POINT_SIZE },
	{ "gl_ClipVertex", SCENE_VERTEX_RESULTS + 4 * SCENE_RESULT_CLIP_VERTEX },
	{ "gl_TexCoord", SCENE_VERTEX_RESULTS + 4 * SCENE_RESULT_TEXCOORD },
};

/* @return the first register; GLSL_NONE: not one of these */
static uint32_t place_of(const struct glsl_writer *w, const char *name)
{
	const int is_vertex = w->stage == GLSL_VERTEX_STAGE;
	const struct place *places = is_vertex ? vertex_places : fragment_places;
	const size_t n = is_vertex ? sizeof(vertex_places) / sizeof(*places) : sizeof(fragment_places) / sizeof(*places);

	for (size_t i = 0; i < n; i++)
		if (strcmp(name, places[i].name) == 0)
			return places[i].first;
	return GLSL_NONE;
}

/* gl_FragData: a colour for each buffer. */
static struct glsl_value data(struct glsl_writer *w, const struct glsl_symbol *s)
{
	const uint32_t n = glsl_type_of(w, s->type)->numbers;

	if (!w->code->n_data) {
		w->code->data = glsl_registers(w, n);
		w->code->n_data = n / 4;
	}
	return glsl_row(w, s->type, w->code->data);
}

struct glsl_value glsl_builtin(struct glsl_writer *w, const struct glsl_symbol *s)
{
	const char *name = w->tree->names + s->name;
	const uint32_t place = place_of(w, name);

	if (place != GLSL_NONE &&
	    glsl_type_of(w, s->type)->numbers > (strcmp(name, "gl_TexCoord") == 0 ? 4 * SCENE_MAX_UNITS : 4)) {
		glsl_fail(w, "a shader uses too many texture coordinates");
		return (struct glsl_value){ 0 };
	}
	if (place != GLSL_NONE)
		return glsl_row(w, s->type, place);
	if (strcmp(name, "gl_FragData") == 0)
		return data(w, s);
	if (strcmp(name, "gl_NormalScale") == 0)
		return glsl_row(w, s->type, glsl_constant(w, &(struct program_constant){ .source = PROGRAM_NORMAL_SCALE }));
	for (unsigned i = 0; i < sizeof(matrices) / sizeof(matrices[0]); i++)
		if (strcmp(name, matrices[i].name) == 0)
			return matrix(w, s, matrices[i].index, matrices[i].part);
	for (unsigned i = 0; i < sizeof(states) / sizeof(states[0]); i++)
		if (strcmp(name, states[i].name) == 0)
			return state(w, s, &states[i]);
	glsl_fail_at(w, "a shader reads or writes ", name, ", which is not supported");
	return (struct glsl_value){ 0 };
}

/* --- Removal of unused constants -------------------------------------------------------------------------------- */

static void mark(struct program_code *code, uint8_t *used, uint32_t operand, uint32_t n, uint32_t n_inputs)
{
	for (uint32_t k = 0; k < n; k++)
		if (operand + k < 4 * n_inputs)
			code->inputs |= 1u << (operand + k) / 4;
		else if (operand >= SCENE_PROGRAM_CONSTANT && operand - SCENE_PROGRAM_CONSTANT + k < 4 * code->n_constants)
			used[(operand - SCENE_PROGRAM_CONSTANT + k) / 4] = 1;
}

/* Number of numbers that operand k of an instruction reads. */
static uint32_t span_of(const struct scene_instruction *in, unsigned k)
{
	if (k == 0 && in->operation == SCENE_OP_FETCH)
		return (in->c >> 16) * (in->c & 0xffff) + in->n;
	return in->flags >> k & 1 ? in->n : 1;
}

void glsl_prune(struct program_code *code, uint32_t keep, uint32_t n_inputs)
{
	uint8_t *used = calloc(code->n_constants + 1, 1);
	uint32_t *moved = calloc(code->n_constants + 1, sizeof(*moved)), n = 0;

	for (uint32_t i = 0; used && moved && i < code->n_instructions; i++) {
		const struct scene_instruction *in = &code->instructions[i];

		for (unsigned k = 0; k < program_operands(in->operation); k++)
			mark(code, used, k == 0 ? in->a : k == 1 ? in->b : in->c, span_of(in, k), n_inputs);
	}
	for (uint32_t i = 0; used && moved && i < code->n_constants; i++)
		if (i < keep || used[i]) {
			code->constants[n] = code->constants[i];
			moved[i] = n++;
		}
	for (uint32_t i = 0; used && moved && i < code->n_instructions; i++) {
		struct scene_instruction *in = &code->instructions[i];
		uint32_t *const operands[3] = { &in->a, &in->b, &in->c };

		for (unsigned k = 0; k < program_operands(in->operation); k++)
			if (*operands[k] >= SCENE_PROGRAM_CONSTANT) {
				const uint32_t place = *operands[k] - SCENE_PROGRAM_CONSTANT;

				*operands[k] = SCENE_PROGRAM_CONSTANT + 4 * moved[place / 4] + place % 4;
			}
	}
	if (used && moved)
		code->n_constants = n;
	free(used);
	free(moved);
}
