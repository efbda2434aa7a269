/* Assembly programs (ARB_vertex_program, ARB_fragment_program): objects, translation, and their data in a draw's
 * scene. */
#include <stdio.h>

#include "replay/programs/ati.h"
#include "replay/programs/program.h"
#include "scene/program.h"
#include "tests/gl/gl.h"

static void set_text_of(struct gl *gl, uint32_t target, uint32_t name, const char *text)
{
	gl_call(gl, "glBindProgramARB", "eu", target, name);
	gl_call(gl, "glProgramStringARB", "eeus", target, GL_PROGRAM_FORMAT_ASCII_ARB, (unsigned)strlen(text), text);
}

static void set_text(struct gl *gl, uint32_t name, const char *text)
{
	set_text_of(gl, GL_FRAGMENT_PROGRAM_ARB, name, text);
}

static struct gls_program *bound(struct gl *gl)
{
	return gls_program_bound(gl_state(gl), GL_FRAGMENT_PROGRAM_ARB);
}

static struct gls_program *bound_to_vertices(struct gl *gl)
{
	return gls_program_bound(gl_state(gl), GL_VERTEX_PROGRAM_ARB);
}

static const struct scene_program *vertex_program_of(const struct scene *s, uint32_t instance)
{
	const uint32_t program = s->materials[s->instances[instance].material].vertex_program;

	ck_assert_uint_ne(program, 0);
	return (const struct scene_program *)(s->programs + program - 1);
}

/* No instruction may name a register or constant that does not exist. */
static void check_bounds(const struct gls_program *p)
{
	/* writable registers */
	const uint32_t first = p->target == GL_VERTEX_PROGRAM_ARB ? SCENE_VERTEX_RESULTS : SCENE_PROGRAM_COLOR;

	for (uint32_t i = 0; i < p->code.n_instructions; i++) {
		const struct scene_instruction *in = &p->code.instructions[i];
		if (in->operation == SCENE_OP_FETCH) {
			const uint32_t numbers = (in->c >> 16) * (in->c & 0xffff);

			ck_assert(in->a >= SCENE_PROGRAM_CONSTANT && in->a - SCENE_PROGRAM_CONSTANT + numbers <= 4 * p->code.n_constants);
			ck_assert(in->n <= (in->c & 0xffff) && in->b < p->code.n_registers && in->to >= first &&
			          in->to + in->n <= p->code.n_registers);
			continue;
		}
		const uint32_t operands[3] = { in->a, in->b, in->c },
			       taken = in->operation == SCENE_OP_TEXTURE || in->operation < SCENE_OP_ADD ||
		                                       in->operation == SCENE_OP_KILL ?
		                               1 :
		                       in->operation < SCENE_OP_MAD ? 2 :
		                                                      3;
		const uint32_t n = in->operation == SCENE_OP_TEXTURE ? 4 : in->n;

		ck_assert_uint_lt(in->operation, N_SCENE_OPERATIONS);
		ck_assert(in->operation == SCENE_OP_KILL || (in->to >= first && in->to + n <= p->code.n_registers));
		for (uint32_t k = 0; k < taken; k++)
			ck_assert(operands[k] >= SCENE_PROGRAM_CONSTANT ?
			                  operands[k] - SCENE_PROGRAM_CONSTANT + n <=
			                          4 * p->code.n_constants + (in->flags >> k & 1 ? 0 : n) :
			                  operands[k] + (in->flags >> k & 1 ? n : 1) <= p->code.n_registers);
	}
	ck_assert_uint_le(p->code.n_registers, SCENE_PROGRAM_REGISTERS);
}

/* A name belongs to the target that it was first bound to; parameters are the object's or the context's. */
START_TEST(test_objects)
{
	struct gl gl = gl_open();
	static const float four[4] = { 1, 2, 3, 4 };

	set_text(&gl, 7, "!!ARBfp1.0 MOV result.color, fragment.color; END");
	ck_assert_ptr_null(bound(&gl)->why);
	ck_assert_uint_eq(bound(&gl)->code.n_instructions, 1);
	gl_call(&gl, "glBindProgramARB", "eu", GL_VERTEX_PROGRAM_ARB, 7u);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_OPERATION);
	gl_call(&gl, "glBindProgramARB", "eu", GL_TEXTURE_2D, 7u);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_ENUM);
	gl_call(&gl, "glProgramLocalParameter4fvARB", "euF", GL_FRAGMENT_PROGRAM_ARB, 2u, 4, four);
	gl_call(&gl, "glProgramEnvParameter4dARB", "eudddd", GL_FRAGMENT_PROGRAM_ARB, 3u, 5.0, 6.0, 7.0, 8.0);
	ck_assert_floats(4, bound(&gl)->local[2], 1, 2, 3, 4);
	ck_assert_floats(4, gl_state(&gl)->program_env[0][3], 5, 6, 7, 8);
	gl_call(&gl, "glProgramEnvParameter4fARB", "euffff", GL_FRAGMENT_PROGRAM_ARB, 256u, 0.0, 0.0, 0.0, 0.0);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE);
	gl_call(&gl, "glDeleteProgramsARB", "uU", 1u, 1, (const uint32_t[1]){ 7 });
	ck_assert_uint_eq(gl_state(&gl)->arb_fragment, 0);
	gl_close(&gl);
}
END_TEST

/* A program has 2048 local parameters, call 0's excluded; arrays may hold all but one of them. */
START_TEST(test_many_parameters)
{
	static const float four[2][4] = { { 1, 2, 3, 4 }, { 5, 6, 7, 8 } };
	struct gl gl = gl_open();
	const struct scene_program *head;
	const float *constants;
	struct scene *s;

	set_text_of(&gl, GL_VERTEX_PROGRAM_ARB, 1,
	            "!!ARBvp1.0 PARAM p[2047] = { program.local[0..2046] }; MOV result.color, p[2046]; MOV "
	            "result.position, p[7]; END");
	ck_assert_uint_eq(gl_error(&gl), GL_NO_ERROR);
	gl_call(&gl, "glProgramLocalParameters4fvEXT", "euiF", GL_VERTEX_PROGRAM_ARB, 2046u, 2, 8, four);
	ck_assert_uint_eq(gl_error(&gl), GL_NO_ERROR);
	ck_assert_floats(4, bound_to_vertices(&gl)->local[2047], 5, 6, 7, 8);
	gl_call(&gl, "glProgramLocalParameters4fvEXT", "euiF", GL_VERTEX_PROGRAM_ARB, 2047u, 2, 8, four);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE);
	gl_call(&gl, "glProgramLocalParameter4fvARB", "euF", GL_VERTEX_PROGRAM_ARB, 2048u, 4, four);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE);
	gl_call(&gl, "glEnable", "e", GL_VERTEX_PROGRAM_ARB);
	gl_call(&gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0);
	s = gl_swap(&gl);
	head = vertex_program_of(s, 0);
	constants = (const float *)((const struct scene_instruction *)(head + 1) + head->n_instructions);
	ck_assert_floats(4, constants + 4 * 2046, 1, 2, 3, 4);
	ck_assert_floats(4, constants + 4 * 7, 0, 0, 0, 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* A long program is translated (piglit's has 12,293 such instructions, three of ours each); one that is far too long
 * is refused. */
START_TEST(test_long_texts)
{
	static const char head[] = "!!ARBfp1.0 TEMP r; MOV r, 0;", step[] = "ADD r,r.wxyz,.5;",
			  end[] = "MOV result.color, r; END";
	static const uint32_t steps[] = { 12293, 30000 };
	char *text = malloc(sizeof(head) + steps[1] * sizeof(step) + sizeof(end));
	struct gl gl = gl_open();

	ck_assert_ptr_nonnull(text);
	for (unsigned i = 0; i < 2; i++) {
		char *at = stpcpy(text, head);

		for (uint32_t k = 0; k < steps[i]; k++)
			at = stpcpy(at, step);
		strcpy(at, end);
		set_text(&gl, i + 1, text);
		ck_assert_uint_eq(gl_error(&gl), GL_NO_ERROR);
		ck_assert_uint_eq(bound(&gl)->why != NULL, i);
	}
	ck_assert_ptr_nonnull(strstr(bound(&gl)->why, "too many instructions"));
	free(text);
	gl_close(&gl);
}
END_TEST

/* ATI's shaders: compiled from the calls between Begin and End; local constants take precedence over the context's;
 * separate names. */
START_TEST(test_ati)
{
	static const float own[4] = { 1, 2, 3, 4 }, shared[4] = { 5, 6, 7, 8 };
	struct gl gl = gl_open();
	const struct gls_program *p;
	const struct scene_program *head;
	const float *constants;
	struct scene *s;

	gl_call(&gl, "glColorFragmentOp1ATI", "eeuueuu", GL_MOV_ATI, GL_REG_0_ATI, 0u, 0u, GL_CON_0_ATI, 0u, 0u);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_OPERATION); /* no Begin */
	set_text(&gl, 7, "!!ARBfp1.0 MOV result.color, fragment.color; END");
	gl_call(&gl, "glBindFragmentShaderATI", "u", 7u);
	gl_call(&gl, "glEnable", "e", GL_FRAGMENT_SHADER_ATI);
	gl_call(&gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0); /* without calls there is no shader */
	gl_call(&gl, "glBeginFragmentShaderATI", "");
	gl_call(&gl, "glBeginFragmentShaderATI", "");
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_OPERATION);
	gl_call(&gl, "glBindFragmentShaderATI", "u", 8u);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_OPERATION);
	gl_call(&gl, "glSampleMapATI", "eee", GL_REG_1_ATI, GL_TEXTURE0, GL_SWIZZLE_STR_ATI);
	gl_call(&gl, "glColorFragmentOp3ATI", "eeuueuueuueuu", GL_MAD_ATI, GL_REG_0_ATI, 0u, 0u, GL_REG_1_ATI, 0u, 0u,
	        GL_CON_1_ATI, 0u, 0u, GL_CON_0_ATI, 0u, 0u);
	gl_call(&gl, "glSetFragmentShaderConstantATI", "eF", GL_CON_1_ATI, 4, own);
	gl_call(&gl, "glEndFragmentShaderATI", "");
	gl_call(&gl, "glEndFragmentShaderATI", "");
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_OPERATION);
	gl_call(&gl, "glSetFragmentShaderConstantATI", "eF", GL_CON_0_ATI, 4, shared);
	gl_call(&gl, "glSetFragmentShaderConstantATI", "eF", GL_CON_0_ATI + 8, 4, shared);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_ENUM);
	p = gls_program_bound(gl_state(&gl), GL_FRAGMENT_SHADER_ATI);
	ck_assert_msg(!p->why, "%s", p->why ? p->why : "");
	ck_assert_uint_eq(p->code.enabled, 2);
	ck_assert_uint_eq(p->code.inputs, 1u << SCENE_INPUT_TEXCOORD);
	check_bounds(p);
	gl_call(&gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0);
	gl_call(&gl, "glEnable", "e", GL_FRAGMENT_PROGRAM_ARB); /* takes precedence */
	gl_call(&gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0);
	gl_call(&gl, "glDisable", "e", GL_FRAGMENT_PROGRAM_ARB);
	gl_call(&gl, "glEnable", "e", GL_FOG);
	gl_call(&gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0); /* unsupported */
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 4);
	ck_assert_uint_eq(s->materials[s->instances[0].material].fragment_program, 0);
	head = (const struct scene_program *)(s->programs + s->materials[s->instances[1].material].fragment_program - 1);
	constants = (const float *)((const struct scene_instruction *)(head + 1) + head->n_instructions);
	ck_assert_ptr_nonnull(memmem(constants, head->n_constants * 4, own, sizeof(own)));
	ck_assert_ptr_nonnull(memmem(constants, head->n_constants * 4, shared, sizeof(shared)));
	ck_assert_uint_ne(s->materials[s->instances[2].material].fragment_program,
	                  s->materials[s->instances[1].material].fragment_program);
	ck_assert_uint_eq(s->materials[s->instances[3].material].fragment_program, 0);
	ck_assert_uint_eq(gl.x->counts.programs, 1);
	scene_release(&s);
	gl_call(&gl, "glDeleteFragmentShaderATI", "u", 7u);
	ck_assert_ptr_nonnull(bound(&gl)); /* the assembly program of this name */
	gl_close(&gl);
}
END_TEST

/* Calls with random tokens: refused or translated, never out of bounds. */
START_TEST(test_damaged_ati)
{
	static const uint32_t tokens[] = {
		GL_REG_0_ATI, GL_REG_5_ATI, GL_REG_5_ATI + 1, GL_CON_0_ATI, GL_CON_7_ATI, GL_ZERO, GL_ONE, GL_PRIMARY_COLOR_ARB,
		GL_SECONDARY_INTERPOLATOR_ATI, GL_RED, GL_ALPHA, GL_MOV_ATI, GL_MAD_ATI, GL_DOT2_ADD_ATI, GL_LERP_ATI,
		GL_SWIZZLE_STR_ATI, GL_SWIZZLE_STQ_DQ_ATI, GL_TEXTURE0, GL_TEXTURE7, GL_TEXTURE8, 2, 3, 15, UINT32_MAX
	};
	uint32_t seed = 1, translated = 0;

	for (int i = 0; i < 20000; i++) {
		struct gls_program p = { .target = GL_FRAGMENT_SHADER_ATI };
		struct ati_call calls[4];

		for (size_t k = 0; k < sizeof(calls) / 4; k++)
			((uint32_t *)calls)[k] = tokens[((seed = seed * 1664525 + 1013904223) >> 8) % (sizeof(tokens) / sizeof(tokens[0]))];
		for (unsigned k = 0; k < 4; k++) {
			calls[k].kind = (seed = seed * 1664525 + 1013904223) >> 8 & 7;
			calls[k].n_arguments = seed >> 16 & 3;
			if (seed >> 24 & 7) /* plausible ones */
				calls[k].to = GL_REG_0_ATI + (seed >> 20 & 3);
		}
		ck_assert_int_eq(program_translate_ati(calls, sizeof(calls) - (unsigned)(i & 1), &p.code, &p.why), 0);
		translated += !p.why;
		check_bounds(&p);
		program_code_free(&p.code);
	}
	ck_assert_uint_gt(translated, 100);
}
END_TEST

/* A draw includes the program with its constants at that time; equal ones are stored once. */
START_TEST(test_scene)
{
	struct gl gl = gl_open();
	const struct scene_program *head;
	const float *constants;
	struct scene *s;

	set_text(&gl, 1,
	         "!!ARBfp1.0 TEMP r; TEX r, fragment.texcoord[2], texture[1], 2D; MUL result.color, r, program.env[0]; "
	         "END");
	gl_call(&gl, "glEnable", "e", GL_FRAGMENT_PROGRAM_ARB);
	for (int i = 0; i < 3; i++) {
		gl_call(&gl, "glProgramEnvParameter4fARB", "euffff", GL_FRAGMENT_PROGRAM_ARB, 0u, 0.5, i / 2 * 0.25, 0.0, 1.0);
		gl_call(&gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0);
	}
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 3);
	ck_assert_uint_eq(s->n_materials, 2);
	head = (const struct scene_program *)(s->programs + s->materials[1].fragment_program - 1);
	ck_assert_uint_eq(head->inputs, 1u << (SCENE_INPUT_TEXCOORD + 2));
	constants = (const float *)((const struct scene_instruction *)(head + 1) + head->n_instructions);
	ck_assert_floats(4, constants, 0.5, 0.25, 0, 1);
	ck_assert_uint_eq(s->materials[0].unit_count, 2); /* units that are sampled, and coordinates that are read */
	ck_assert_uint_eq(s->units[0].unit, 1);
	ck_assert_uint_eq(s->units[1].unit, 2);
	ck_assert_uint_eq(gl.x->counts.programs, 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* A draw includes its vertex program, the numbered attributes, and the state for point sizes and two sides. */
START_TEST(test_vertices)
{
	struct gl gl = gl_open();
	static const char text[] =
		"!!ARBvp1.0 PARAM m[4] = { state.matrix.program[1] }; DP4 result.position.x, m[0], vertex.position;\n"
		"MOV result.color, vertex.attrib[3]; MOV result.color.back, vertex.attrib[5]; MOV result.pointsize.x, "
	        "vertex.normal.x; END";
	static const float matrix[16] = { 7, 0, 0, 0, 6, 0, 0, 0, 5, 0, 0, 0, 4, 0, 0, 0 };
	const struct scene_program *head;
	const float *constants;
	struct scene *s;

	set_text_of(&gl, GL_VERTEX_PROGRAM_ARB, 1, text);
	ck_assert_msg(!bound_to_vertices(&gl)->why, "%s", bound_to_vertices(&gl)->why ? bound_to_vertices(&gl)->why : "");
	gl_call(&gl, "glEnable", "e", GL_VERTEX_PROGRAM_ARB);
	gl_call(&gl, "glMatrixMode", "e", GL_MATRIX0_ARB + 1);
	gl_call(&gl, "glLoadMatrixf", "F", 16, matrix);
	gl_call(&gl, "glVertexAttrib4f", "uffff", 5u, 0.1, 0.2, 0.3, 0.4);
	gl_call(&gl, "glVertexAttrib4f", "uffff", 16u, 0.1, 0.2, 0.3, 0.4);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE);
	for (int i = 0; i < 2; i++) {
		gl_call(&gl, "glBegin", "e", GL_TRIANGLES);
		for (int k = 0; k < 3; k++) {
			gl_call(&gl, "glVertexAttrib3f", "ufff", 3u, 0.5, 0.25 * k, 1.0);
			gl_call(&gl, "glVertexAttrib2f", "uff", 0u, 1.0 * k, 2.0);
		}
		gl_call(&gl, "glEnd", "");
		gl_call(&gl, "glEnable", "e", GL_VERTEX_PROGRAM_POINT_SIZE);
		gl_call(&gl, "glEnable", "e", GL_VERTEX_PROGRAM_TWO_SIDE);
	}
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 2);
	ck_assert_uint_eq(s->meshes[0]->attributes, SCENE_HAS_GENERIC << 2);
	ck_assert_floats(4, s->meshes[0]->generics[2] + 4, 0.5, 0.25, 1, 1);
	ck_assert_floats(4, s->meshes[0]->position + 8, 2, 2, 0, 1);
	ck_assert_floats(4, s->currents[s->instances[0].current].generics[4], 0.1, 0.2, 0.3, 0.4);
	ck_assert_uint_eq(s->materials[s->instances[0].material].two_side, 0);
	ck_assert_uint_eq(s->materials[s->instances[1].material].two_side, 1);
	ck_assert_uint_eq(s->materials[s->instances[1].material].program_normals, 1);
	head = vertex_program_of(s, 0);
	ck_assert_uint_eq(head->outputs,
	                  1u << SCENE_RESULT_POSITION | 1u << SCENE_RESULT_COLOR | 1u << SCENE_RESULT_BACK_COLOR);
	ck_assert_uint_eq(vertex_program_of(s, 1)->outputs, head->outputs | 1u << SCENE_RESULT_POINT_SIZE);
	ck_assert_uint_eq(head->inputs,
	                  1u << SCENE_VERTEX_POSITION | 1u << SCENE_VERTEX_NORMAL | 5u << (SCENE_VERTEX_GENERIC + 2));
	constants = (const float *)((const struct scene_instruction *)(head + 1) + head->n_instructions);
	ck_assert_floats(4, constants, 7, 6, 5, 4);
	ck_assert_uint_eq(gl.x->counts.programs, 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Instructions of a bound vertex program that negate an operand. */
static unsigned negations(struct gl *gl, const char *instruction)
{
	const struct gls_program *p;
	unsigned n = 0;
	char text[128];

	snprintf(text, sizeof(text), "!!ARBvp1.0 TEMP r; %s; MOV result.position, r; END", instruction);
	set_text_of(gl, GL_VERTEX_PROGRAM_ARB, 1, text);
	p = bound_to_vertices(gl);
	ck_assert_msg(!p->why, "%s: %s", text, p->why ? p->why : "");
	for (uint32_t i = 0; i < p->code.n_instructions; i++)
		n += (p->code.instructions[i].flags & (SCENE_NEGATE_A | SCENE_NEGATE_B | SCENE_NEGATE_C)) != 0;
	return n;
}

/* Negation of operands is translated, for scalars and vectors. */
START_TEST(test_negated)
{
	static const char *const operations[] = { "MOV r, %sr",        "ABS r, %sr",        "FLR r, %sr",
		                                  "RCP r, %sr.y",      "RSQ r, %sr.y",      "EX2 r, %sr.y",
		                                  "EXP r, %sr.y",      "LG2 r, %sr.y",      "LOG r, %sr.y",
		                                  "POW r, %sr.x, r.y", "POW r, r.x, %sr.y", "ADD r, r, %sr",
		                                  "MUL r, %sr, r",     "MAD r, r, %sr, r",  "MAD r, r, r, %sr",
		                                  "DP3 r, %sr, r",     "MIN r, r, %sr" };
	struct gl gl = gl_open();

	for (size_t i = 0; i < sizeof(operations) / sizeof(operations[0]); i++) {
		char with[64], without[64];

		snprintf(with, sizeof(with), operations[i], "-");
		snprintf(without, sizeof(without), operations[i], "");
		ck_assert_msg(negations(&gl, with) > negations(&gl, without), "%s: nothing is negated", with);
	}
	gl_close(&gl);
}
END_TEST

/* Attribute arrays apply if a program draws; attribute 0 takes precedence over the conventional position. */
START_TEST(test_vertex_arrays)
{
	struct gl gl = gl_open();
	static const float positions[6] = { 1, 2, 3, 4, 5, 6 };
	static const uint8_t colors[12] = { 255, 0, 51, 255, 0, 255, 102, 255, 0, 0, 153, 255 };
	struct scene *s;

	set_text_of(&gl, GL_VERTEX_PROGRAM_ARB, 1,
	            "!!ARBvp1.0 OPTION ARB_position_invariant; MOV result.color, vertex.attrib[2]; END");
	gl_call(&gl, "glVertexPointer", "ieib", 2, GL_FLOAT, 0, sizeof(colors), colors);
	gl_call(&gl, "glEnableClientState", "e", GL_VERTEX_ARRAY);
	gl_call(&gl, "glVertexAttribPointer", "uieuib", 0u, 2, GL_FLOAT, 0u, 0, sizeof(positions), positions);
	gl_call(&gl, "glVertexAttribPointer", "uieuib", 2u, 4, GL_UNSIGNED_BYTE, 1u, 0, sizeof(colors), colors);
	gl_call(&gl, "glEnableVertexAttribArray", "u", 0u);
	gl_call(&gl, "glEnableVertexAttribArray", "u", 2u);
	for (int i = 0; i < 2; i++) {
		gl_call(&gl, i ? "glDisable" : "glEnable", "e", GL_VERTEX_PROGRAM_ARB);
		gl_call(&gl, "glDrawArrays", "eii", GL_TRIANGLES, 0, 3);
	}
	gl_call(&gl, "glEnableVertexAttribArray", "u", 16u);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 2);
	ck_assert_uint_eq(s->meshes[0]->attributes, SCENE_HAS_GENERIC << 1);
	ck_assert_floats(4, s->meshes[0]->generics[1] + 4, 0, 1, 0.4, 1);
	ck_assert_floats(4, s->meshes[0]->position + 4, 3, 4, 0, 1);
	ck_assert_uint_eq(s->meshes[1]->attributes, 0);
	ck_assert_uint_eq(vertex_program_of(s, 0)->outputs, 1u << SCENE_RESULT_COLOR); /* fixed function's position */
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* PopAttrib restores program enables that are in ENABLE_BIT's group. */
START_TEST(test_enables)
{
	struct gl gl = gl_open();

	gl_call(&gl, "glEnable", "e", GL_VERTEX_PROGRAM_ARB);
	gl_call(&gl, "glPushAttrib", "m", GL_ENABLE_BIT);
	gl_call(&gl, "glDisable", "e", GL_VERTEX_PROGRAM_ARB);
	gl_call(&gl, "glEnable", "e", GL_VERTEX_PROGRAM_TWO_SIDE);
	gl_call(&gl, "glPopAttrib", "");
	ck_assert_uint_eq(gl_state(&gl)->a.programs.vertex, 1);
	ck_assert_uint_eq(gl_state(&gl)->a.programs.two_side, 0);
	gl_close(&gl);
}
END_TEST

/* Programs that cannot be translated are drawn by fixed function, and counted with the reason. */
START_TEST(test_reasons)
{
	static const char *const texts[][2] = {
		{ "!!ARBfp1.0 FOO result.color, fragment.color; END", "instruction" },
		{ "!!ARBfp1.0 OPTION ARB_made_up; END", "option" },
		{ "!!ARBfp1.0 MOV result.color, state.made.up; END", "state" },
	};
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glEnable", "e", GL_FRAGMENT_PROGRAM_ARB);
	for (unsigned i = 0; i < sizeof(texts) / sizeof(texts[0]); i++) {
		set_text(&gl, i + 1, texts[i][0]);
		ck_assert_uint_eq(gl_error(&gl), GL_NO_ERROR);
		ck_assert_ptr_nonnull(bound(&gl)->why);
		ck_assert_msg(strstr(bound(&gl)->why, texts[i][1]), "%s: %s", texts[i][0], bound(&gl)->why);
		ck_assert_uint_eq(bound(&gl)->code.n_instructions, 0);
		gl_call(&gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0);
	}
	s = gl_swap(&gl);
	ck_assert_uint_eq(gl.x->counts.programs, sizeof(texts) / sizeof(texts[0]));
	ck_assert_uint_eq(gl.x->counts.program_draws.n, sizeof(texts) / sizeof(texts[0])); /* for as many objects */
	ck_assert_uint_eq(s->n_programs, 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Invalid texts are errors, and so are draws with a program that has no other text; neither counts as missing. */
START_TEST(test_invalid_texts)
{
	static const char *const texts[] = {
		"END", "!!ARBfp1.1 END", "!!ARBvp1.0 END", "!!ARBfp1.0 MOV result.color, fragment.color END",
		"!!ARBfp1.0 MOV result.color, state.light[99].ambient; END", "!!ARBfp1.0 TEMP a, a; END",
		"!!ARBfp1.0 MOV result.color, fragment.color.xyq; END", "!!ARBfp1.0 MOV fragment.color, 1; END",
		"!!ARBfp1.0 MOV result.color.yx, 1; END",
	};
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glEnable", "e", GL_FRAGMENT_PROGRAM_ARB);
	for (unsigned i = 0; i < sizeof(texts) / sizeof(texts[0]); i++) {
		set_text(&gl, i + 1, texts[i]);
		ck_assert_msg(gl_error(&gl) == GL_INVALID_OPERATION, "%s", texts[i]);
		ck_assert_ptr_null(bound(&gl)->source);
		gl_call(&gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0);
		gl_call(&gl, "glEnable", "e", GL_LIGHTING); /* collected vertices are drawn */
		gl_call(&gl, "glDisable", "e", GL_LIGHTING);
		ck_assert_uint_eq(gl_error(&gl), GL_INVALID_OPERATION);
	}
	set_text(&gl, 99, " # blanks are valid before it\n !!ARBfp1.0 MOV result.color, fragment.color; END");
	ck_assert_uint_eq(gl_error(&gl), GL_NO_ERROR);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 0);
	ck_assert_uint_eq(gl.x->counts.programs, 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

static uint64_t errors_of_texts(const struct gl *gl)
{
	return gl->x->counts.errors[gls_command_find("glProgramStringARB")];
}

/* The recording shows how the GL judged a text, which counts more than what Relume knows of the language. */
START_TEST(test_judged_texts)
{
	static const char unknown[] = "!!ARBfp1.0 OPTION ARB_made_up; END", wrong[] = "!!ARBfp1.0 TEMP a, a; END",
			  good[] = "!!ARBfp1.0 MOV result.color, fragment.color; END";
	static const uint32_t places[] = { 11, UINT32_MAX };
	struct gl gl = gl_open();

	set_text(&gl, 1, unknown);
	gl_answered(&gl, GL_INVALID_OPERATION, "glGetError", "");
	ck_assert_ptr_null(bound(&gl)->source);
	ck_assert_ptr_null(bound(&gl)->why);
	ck_assert_uint_eq(errors_of_texts(&gl), 1);
	set_text(&gl, 2, good);
	set_text(&gl, 2, unknown);
	gl_call(&gl, "glGetIntegerv", "eU", GL_PROGRAM_ERROR_POSITION_ARB, 1u, &places[0]);
	ck_assert_str_eq(bound(&gl)->source, good);
	ck_assert_uint_eq(bound(&gl)->code.n_instructions, 1);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_OPERATION);
	ck_assert_uint_eq(errors_of_texts(&gl), 2);
	set_text(&gl, 2, unknown);
	gl_call(&gl, "glGetIntegerv", "eU", GL_PROGRAM_ERROR_POSITION_ARB, 1u, &places[1]);
	ck_assert_str_eq(bound(&gl)->source, unknown);
	ck_assert_ptr_nonnull(bound(&gl)->why);
	set_text(&gl, 2, wrong); /* the GL knows more */
	gl_answered(&gl, GL_NO_ERROR, "glGetError", "");
	ck_assert_str_eq(bound(&gl)->source, wrong);
	ck_assert_ptr_nonnull(bound(&gl)->why);
	ck_assert_uint_eq(errors_of_texts(&gl), 2);
	gl_close(&gl);
}
END_TEST

/* Nothing is drawn while a program without a text is enabled; nothing counts as missing either. */
START_TEST(test_no_text)
{
	static const uint32_t targets[] = { GL_VERTEX_PROGRAM_ARB, GL_FRAGMENT_PROGRAM_ARB };
	static const uint8_t texel[4] = { 255, 0, 0, 255 };
	struct gl gl = gl_open();
	struct scene *s;

	for (unsigned i = 0; i < 2; i++) {
		gl_call(&gl, "glBindProgramARB", "eu", targets[i], 5 + i);
		gl_call(&gl, "glEnable", "e", targets[i]);
		gl_call(&gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0);
		gl_call(&gl, "glEnable", "e", GL_LIGHTING); /* collected vertices are drawn */
		ck_assert_uint_eq(gl_error(&gl), GL_INVALID_OPERATION);
		gl_call(&gl, "glDrawPixels", "iieeb", 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, sizeof(texel), texel);
		ck_assert_uint_eq(gl_error(&gl), i == 0 ? GL_NO_ERROR : GL_INVALID_OPERATION);
		gl_call(&gl, "glDisable", "e", targets[i]);
		gl_call(&gl, "glDisable", "e", GL_LIGHTING);
	}
	gl_call(&gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 2); /* the first pixels and the last rectangle */
	ck_assert_uint_eq(gl.x->counts.programs, 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* An invalid text is an error, and leaves the old one. */
START_TEST(test_wrong_texts)
{
	struct gl gl = gl_open();

	set_text(&gl, 1, "!!ARBfp1.0 MOV result.color, fragment.color; END");
	ck_assert_uint_eq(gl_error(&gl), GL_NO_ERROR);
	set_text(&gl, 1, "!!ARBfp1.0 MOV result.color, fragment.color; MOV result.color, fragment.color END");
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_OPERATION);
	ck_assert_ptr_null(bound(&gl)->why);
	ck_assert_uint_eq(bound(&gl)->code.n_instructions, 1);
	set_text(&gl, 1, "!!ARBfp1.0 OPTION ARB_made_up; END"); /* possibly valid: Relume cannot know */
	ck_assert_uint_eq(gl_error(&gl), GL_NO_ERROR);
	ck_assert_ptr_nonnull(bound(&gl)->why);
	gl_close(&gl);
}
END_TEST

/* A text with letters changed, omitted and doubled. */
static void check_damaged(struct gl *gl, uint32_t target, const char *text, size_t length)
{
	uint32_t seed = 1, translated = 0;
	const struct gls_program *p;
	char damaged[1024];

	ck_assert_uint_lt(length, sizeof(damaged));
	set_text_of(gl, target, target, text);
	p = gls_program_bound(gl_state(gl), target);
	ck_assert_msg(!p->why, "%s", p->why ? p->why : "");
	for (int i = 0; i < 20000; i++) {
		size_t n = length;

		memcpy(damaged, text, n + 1);
		for (int k = 0; k < 1 + i % 3; k++) {
			const size_t at = (seed = seed * 1664525 + 1013904223) >> 8, place = at % n, other = at / n % n;

			if (i % 4 == 0)
				memmove(damaged + place, damaged + place + 1, n-- - place);
			else
				damaged[place] = i % 4 == 1 ? (char)(at >> 12) : text[other];
		}
		damaged[n] = 0;
		set_text_of(gl, target, target, damaged);
		translated += gl_error(gl) == GL_NO_ERROR && !p->why;
		check_bounds(p);
	}
	ck_assert_uint_gt(translated, 100);
}

/* Texts with letters changed, omitted and doubled: refused or translated, never out of bounds. */
START_TEST(test_damaged_texts)
{
	static const char text[] =
		"!!ARBfp1.0 OPTION ARB_fog_exp; PARAM p[3] = { program.env[0..1], { 1, -2.5e1, .5 } }; PARAM m[4] = { "
	        "state.matrix.mvp.transpose };\n"
		"ATTRIB c = fragment.color.secondary; OUTPUT o = result.color; ALIAS q = o; TEMP a, b; # words\n"
		"DP4 a.x, m[1], fragment.position; LRP_SAT a, -c.wzyx, p[2], state.lightprod[3].back.diffuse; SWZ b, "
	        "a, 1, -x, 0, w;\n"
		"TXP a, b, texture[2], CUBE; KIL -a.x; LIT b, a; XPD b.xyz, a, c; POW a.w, b.x, { 2 }.x; MAD q, a, b, "
	        "0.25; MOV result.depth.z, a; END";
	static const char vertices[] =
		"!!ARBvp1.0 PARAM p[] = { program.env[0..3], { 1, -2.5e1, .5 } }; PARAM m[4] = { "
	        "state.matrix.mvp.transpose }; ADDRESS A, B;\n"
		"ATTRIB c = vertex.color.secondary; OUTPUT o = result.color.back; ALIAS q = o; TEMP a, b; # words\n"
		"DP4 result.position.x, m[1], vertex.position; ARL A.x, vertex.attrib[9].y; MAD a, -p[A.x + 2].wzyx, "
	        "p[A.x], m[3]; EXP b.xy, a.w; LOG a, -b.x;\n"
		"ARL B.x, a.x; SWZ b, p[B.x - 1], 1, -x, 0, w; LIT b, a; XPD b.xyz, a, c; MOV q, "
	        "state.texgen[1].eye.q; MOV result.pointsize.x, a; END";
	struct gl gl = gl_open();

	check_damaged(&gl, GL_FRAGMENT_PROGRAM_ARB, text, sizeof(text) - 1);
	check_damaged(&gl, GL_VERTEX_PROGRAM_ARB, vertices, sizeof(vertices) - 1);
	gl_close(&gl);
}
END_TEST

GL_TESTS("programs", test_objects, test_ati, test_damaged_ati, test_many_parameters, test_long_texts, test_scene,
         test_vertices, test_negated, test_vertex_arrays, test_enables, test_reasons, test_invalid_texts,
         test_judged_texts, test_no_text, test_wrong_texts, test_damaged_texts)
