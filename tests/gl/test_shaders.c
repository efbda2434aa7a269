/* GLSL programs (GL 2.1 sec. 2.15): objects, locations, uniforms, and their data in a draw's scene. */
#include <stdio.h>

#include "replay/glsl/object.h"
#include "replay/programs/program.h"
#include "scene/program.h"
#include "tests/gl/gl.h"

#define FRAGMENTS "void main() { gl_FragColor = gl_Color; }"

static struct gls_shader *object(struct gl *gl, uint32_t name)
{
	return table_find(&gl_state(gl)->share->shaders, name);
}

static void make_shader(struct gl *gl, uint32_t name, uint32_t type, const char *text)
{
	gl_answered(gl, name, "glCreateShader", "e", type);
	gl_call(gl, "glShaderSource", "uuSp", name, 1u, text, (uint64_t)0);
	gl_call(gl, "glCompileShader", "u", name);
}

/* A program with one fragment shader, named `name` and `name` + 100, in use from now on. */
static struct gls_shader *make_program(struct gl *gl, uint32_t name, const char *text)
{
	make_shader(gl, name + 100, GL_FRAGMENT_SHADER, text);
	gl_answered(gl, name, "glCreateProgram", "");
	gl_call(gl, "glAttachShader", "uu", name, name + 100);
	gl_call(gl, "glLinkProgram", "u", name);
	gl_call(gl, "glUseProgram", "u", name);
	return object(gl, name);
}

/* A shader lives as long as a program has it attached, a program as long as it is in use; the linked code survives
 * changes to sources. */
START_TEST(test_objects)
{
	struct gl gl = gl_open();
	const struct gls_shader *program = make_program(&gl, 1, FRAGMENTS);

	ck_assert_ptr_null(program->stages.why);
	gl_call(&gl, "glDeleteShader", "u", 101u);
	ck_assert_ptr_nonnull(object(&gl, 101));
	gl_call(&gl, "glShaderSource", "uuSp", 101u, 1u, "void main() { gl_FragColor = nothing; }", (uint64_t)0);
	gl_call(&gl, "glCompileShader", "u", 101u);
	ck_assert_ptr_null(program->stages.why);
	gl_call(&gl, "glLinkProgram", "u", 1u);
	ck_assert_ptr_nonnull(program->stages.why);
	gl_call(&gl, "glDetachShader", "uu", 1u, 101u);
	ck_assert_ptr_null(object(&gl, 101));
	gl_call(&gl, "glDeleteProgram", "u", 1u);
	ck_assert_ptr_nonnull(object(&gl, 1));
	gl_call(&gl, "glUseProgram", "u", 0u);
	ck_assert_ptr_null(object(&gl, 1));
	gl_close(&gl);
}
END_TEST

/* Locations are those in the recording; arrays, matrices, structures, and invalid locations. */
START_TEST(test_uniforms)
{
	struct gl gl = gl_open();
	static const float numbers[8] = { 1, 2, 3, 4, 5, 6, 7, 8 };
	const struct gls_shader *p = make_program(&gl, 1,
		"uniform vec2 a[3]; uniform mat2 m; uniform bool b; struct S { float x; vec3 y; }; uniform S s[2];\n"
		"void main() { gl_FragColor = vec4(a[0] + a[1] + a[2], m[0].x, b) + vec4(s[1].y, s[0].x); }");

	ck_assert_msg(!p->stages.why, "%s", p->stages.why);
	gl_answered(&gl, 7, "glGetUniformLocation", "us", 1u, "a");
	gl_answered(&gl, 20, "glGetUniformLocation", "us", 1u, "m");
	gl_answered(&gl, 21, "glGetUniformLocation", "us", 1u, "b");
	gl_answered(&gl, 30, "glGetUniformLocation", "us", 1u, "s[1].y");
	gl_answered(&gl, 31, "glGetUniformLocation", "us", 1u, "nothing");
	gl_call(&gl, "glUniform2fv", "iuF", 8, 9u, 8, numbers); /* more than there are elements */
	gl_call(&gl, "glUniformMatrix2fv", "iuuF", 20, 1u, 1u, 4, numbers);
	gl_call(&gl, "glUniform1i", "ii", 21, 5);
	gl_call(&gl, "glUniform3f", "ifff", 30, 9.0, 8.0, 7.0);
	gl_call(&gl, "glUniform4f", "iffff", 30, 1.0, 1.0, 1.0, 1.0); /* wrong size */
	gl_call(&gl, "glUniform1f", "if", 31, 3.0);
	ck_assert_floats(8, p->uniforms.values, 0, 0, 1, 2, 3, 4, 0, 0);
	ck_assert_floats(4, p->uniforms.values + 8, 1, 3, 2, 4);
	ck_assert_float_eq(p->uniforms.values[12], 1);
	ck_assert_floats(8, p->uniforms.values + 16, 0, 0, 0, 0, 0, 9, 8, 7);
	gl_call(&gl, "glLinkProgram", "u", 1u); /* locations and values are lost */
	ck_assert_float_eq(p->uniforms.values[12], 0);
	gl_call(&gl, "glUniform1i", "ii", 21, 5);
	ck_assert_float_eq(p->uniforms.values[12], 0);
	gl_close(&gl);
}
END_TEST

/* A draw includes the program with its uniforms, and the units that its samplers refer to at that time. */
START_TEST(test_scene)
{
	struct gl gl = gl_open();
	const struct scene_program *head;
	const struct scene_instruction *instructions;
	uint32_t sampled = 0;
	struct scene *s;

	make_program(&gl, 1,
	             "uniform sampler2D t; uniform vec4 c; void main() { gl_FragColor = texture2D(t, "
	             "gl_TexCoord[3].xy) * c; }");
	gl_answered(&gl, 0, "glGetUniformLocation", "us", 1u, "t");
	gl_answered(&gl, 1, "glGetUniformLocation", "us", 1u, "c");
	for (int i = 0; i < 3; i++) {
		gl_call(&gl, "glUniform1i", "ii", 0, 5);
		gl_call(&gl, "glUniform4f", "iffff", 1, 0.5, i / 2 * 0.25, 0.0, 1.0);
		gl_call(&gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0);
	}
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 3);
	ck_assert_uint_eq(s->n_materials, 2);
	head = (const struct scene_program *)(s->programs + s->materials[1].fragment_program - 1);
	ck_assert_uint_eq(head->inputs, 1u << (SCENE_INPUT_TEXCOORD + 3));
	instructions = (const struct scene_instruction *)(head + 1);
	for (uint32_t i = 0; i < head->n_instructions; i++)
		if (instructions[i].operation == SCENE_OP_TEXTURE)
			sampled |= 1u << instructions[i].b;
	ck_assert_uint_eq(sampled, 1u << 5);
	ck_assert_floats(4, (const float *)(instructions + head->n_instructions) + 4, 0.5, 0.25, 0, 1);
	ck_assert_uint_eq(gl.x->counts.programs, 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Programs that cannot be translated are drawn by fixed function, and counted with the reason. */
START_TEST(test_reasons)
{
	static const char *const texts[][2] = {
		{ "void main() { gl_FragColor = nothing; }", "compile" },
		{ "float f(float x) { return f(x); } void main() { gl_FragColor = vec4(f(1.0)); }", "link" },
		{ "#version 130\nuniform usampler2D t; void main() { gl_FragColor = vec4(texture(t, "
		  "gl_TexCoord[0].xy)); }",
		  "texture" },
		{ "uniform float a[60000]; void main() { float b[600]; b[int(a[3])] = a[2]; gl_FragColor = vec4(b[1]); "
		  "}",
		  "too many registers" },
		{ "uniform int k; void main() { int i = k; gl_FragColor = vec4(float(i << 2)); }", "compile" },
		{ "#version 130\nuniform int k; void main() { int i = k; gl_FragColor = vec4(float(i << 2)); }",
		  "unsupported" },
		{ "void main() { gl_FragColor = gl_TexCoord[9]; }", "texture coordinates" },
		{ "uniform sampler2D t[2]; uniform int k; void main() { gl_FragColor = texture2D(t[k], "
		  "gl_TexCoord[0].xy); }",
		  "sampler" },
	};
	struct gl gl = gl_open();
	struct scene *s;

	for (unsigned i = 0; i < sizeof(texts) / sizeof(texts[0]); i++) {
		const struct gls_shader *p = make_program(&gl, i + 1, texts[i][0]);

		ck_assert_msg(p->stages.why && strstr(p->stages.why, texts[i][1]), "%s: %s", texts[i][0],
		              p->stages.why ? p->stages.why : "no reason");
		gl_call(&gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0);
	}
	s = gl_swap(&gl);
	ck_assert_uint_eq(gl.x->counts.programs, sizeof(texts) / sizeof(texts[0]));
	ck_assert_uint_eq(s->n_programs, 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* A reason names the line; counts keep it when the program is relinked or deleted. */
START_TEST(test_reasons_stay)
{
	static const char first[] = "void main() {\n\ngl_FragColor = nothing; }",
			  second[] = "void main() { gl_FragColor = other; }";
	struct gl gl = gl_open();
	const struct gls_shader *p = make_program(&gl, 1, first);
	const char *counted;

	ck_assert_str_eq(p->stages.why, "a shader does not compile here: line 3: 'nothing' is not declared");
	counted = gl.x->counts.programs_why;
	ck_assert_str_eq(counted, p->stages.why);
	gl_call(&gl, "glShaderSource", "uuSp", 101u, 1u, second, (uint64_t)0);
	gl_call(&gl, "glCompileShader", "u", 101u);
	gl_call(&gl, "glLinkProgram", "u", 1u);
	ck_assert_str_eq(p->stages.why, "a shader does not compile here: line 1: 'other' is not declared");
	ck_assert_str_eq(counted, "a shader does not compile here: line 3: 'nothing' is not declared");
	gl_call(&gl, "glUseProgram", "u", 0u);
	gl_call(&gl, "glDeleteProgram", "u", 1u);
	ck_assert_str_eq(gl.x->counts.programs_why, "a shader does not compile here: line 3: 'nothing' is not declared");
	for (uint32_t i = 300; i < 500; i += 2) { /* more than are stored separately: the rest share one */
		char text[64];

		snprintf(text, sizeof(text), "void main() { gl_FragColor = n%u; }", i);
		make_program(&gl, i, text);
		ck_assert_ptr_nonnull(strstr(gl.x->counts.programs_why, "compile here"));
	}
	ck_assert_uint_lt(gl.x->counts.n_reasons, 100);
	ck_assert_str_eq(counted, "a shader does not compile here: line 3: 'nothing' is not declared");
	gl_close(&gl);
}
END_TEST

/* Clip planes use a position other than fixed function's; together with two-sided colours this counts as missing.
 * The shader is run anyway. */
START_TEST(test_clip_vertex)
{
	static const struct { const char *text; uint32_t own;
	} texts[] = {
		{ "void main() { gl_Position = ftransform(); gl_ClipVertex = gl_ModelViewMatrix * gl_Vertex; }", 0 },
		{ "void main() { gl_Position = ftransform(); }", 0 },
		{ "void main() { gl_Position = ftransform(); gl_ClipVertex = gl_Vertex; }", 1 },
		{ "void main() { gl_Position = ftransform(); gl_ClipVertex = gl_ModelViewMatrix * gl_Vertex; "
		  "gl_ClipVertex.x += 1.0; }",
		  1 },
		{ "void main() { gl_Position = gl_Vertex; gl_ClipVertex = gl_ModelViewMatrix * gl_Vertex; }", 1 },
	};
	struct gl gl = gl_open();
	struct scene *s;

	for (unsigned i = 0; i < sizeof(texts) / sizeof(texts[0]); i++) {
		const uint64_t before = gl.x->counts.programs;

		make_shader(&gl, 100 + i, GL_VERTEX_SHADER, texts[i].text);
		gl_answered(&gl, 1 + i, "glCreateProgram", "");
		gl_call(&gl, "glAttachShader", "uu", 1 + i, 100 + i);
		gl_call(&gl, "glLinkProgram", "u", 1 + i);
		gl_call(&gl, "glUseProgram", "u", 1 + i);
		ck_assert_ptr_null(object(&gl, 1 + i)->stages.why);
		gl_call(&gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0);
		ck_assert_uint_eq(gl.x->counts.programs, before);
		gl_call(&gl, "glEnable", "e", GL_CLIP_PLANE0);
		gl_call(&gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0);
		ck_assert_uint_eq(gl.x->counts.programs, before);
		gl_call(&gl, "glEnable", "e", GL_VERTEX_PROGRAM_TWO_SIDE);
		gl_call(&gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0);
		gl_call(&gl, "glDisable", "e", GL_VERTEX_PROGRAM_TWO_SIDE);
		gl_call(&gl, "glDisable", "e", GL_CLIP_PLANE0);
		ck_assert_uint_eq(gl.x->counts.programs - before, texts[i].own);
	}
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 3 * sizeof(texts) / sizeof(texts[0]));
	for (uint32_t i = 0; i < s->n_instances; i++) {
		const struct scene_material *m = &s->materials[s->instances[i].material];

		ck_assert(m->vertex_program);
		ck_assert_uint_eq(m->clip_by_program, i % 3 == 1 ? texts[i / 3].own : 0);
	}
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* A program that was never linked is not used. */
START_TEST(test_unlinked)
{
	struct gl gl = gl_open();
	struct scene *s;

	make_program(&gl, 1, "void main() { gl_FragColor = vec4(1.0); }");
	gl_answered(&gl, 2, "glCreateProgram", "");
	gl_call(&gl, "glUseProgram", "u", 2u);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_OPERATION);
	gl_call(&gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0);
	gl_call(&gl, "glUseProgram", "u", 0u);
	gl_call(&gl, "glUseProgram", "u", 2u);
	gl_call(&gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0);
	s = gl_swap(&gl);
	ck_assert_uint_eq(gl.x->counts.programs, 0);
	ck_assert_uint_eq(s->n_materials, 2);
	ck_assert(s->materials[0].fragment_program && !s->materials[1].fragment_program);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Attributes are at the locations bound by the program or recorded, others where Mesa puts them; fixed function's
 * position stays separate. */
START_TEST(test_attributes)
{
	struct gl gl = gl_open();
	const struct gls_shader *p;

	make_shader(&gl, 200, GL_VERTEX_SHADER,
	            "attribute vec4 a, b; void main() { gl_Position = ftransform(); gl_FrontColor = a + b; }");
	gl_answered(&gl, 1, "glCreateProgram", "");
	gl_call(&gl, "glAttachShader", "uu", 1u, 200u);
	gl_call(&gl, "glBindAttribLocation", "uus", 1u, 4u, "a");
	gl_call(&gl, "glLinkProgram", "u", 1u);
	p = object(&gl, 1);
	ck_assert_msg(!p->stages.why, "%s", p->stages.why);
	ck_assert_uint_eq(p->stages.code[GLSL_VERTEX_STAGE].inputs >> SCENE_VERTEX_GENERIC, 1u << 3 | 1u << 0);
	ck_assert_uint_eq(p->stages.code[GLSL_VERTEX_STAGE].outputs >> SCENE_RESULT_POSITION & 1, 0);
	gl_answered(&gl, 7, "glGetAttribLocation", "us", 1u, "b");
	ck_assert_uint_eq(p->stages.code[GLSL_VERTEX_STAGE].inputs >> SCENE_VERTEX_GENERIC, 1u << 3 | 1u << 6);
	gl_close(&gl);
}
END_TEST

/* Number of rows of texture coordinates that a program's fragment stage reads, with a vertex stage that writes vec2
 * a, vec4 b, vec3 c[2]. */
static int rows_read(uint32_t name, const char *declared, const char *color)
{
	static const char vertex[] = "varying vec2 a; varying vec4 b; varying vec3 c[2];\n"
				     "void main() { a = gl_Vertex.xy; b = gl_Color; c[0] = c[1] = gl_Normal; gl_Position = ftransform(); }";
	struct gl gl = gl_open();
	char fragment[256];
	const struct gls_shader *p;
	uint32_t inputs;

	snprintf(fragment, sizeof(fragment), "%s void main() { gl_FragColor = %s; }", declared, color);
	make_shader(&gl, 200, GL_VERTEX_SHADER, vertex);
	make_shader(&gl, 201, GL_FRAGMENT_SHADER, fragment);
	gl_answered(&gl, name, "glCreateProgram", "");
	gl_call(&gl, "glAttachShader", "uu", name, 200u);
	gl_call(&gl, "glAttachShader", "uu", name, 201u);
	gl_call(&gl, "glLinkProgram", "u", name);
	p = object(&gl, name);
	ck_assert_msg(!p->stages.why, "%s: %s", fragment, p->stages.why);
	inputs = p->stages.code[GLSL_FRAGMENT_STAGE].inputs >> SCENE_INPUT_TEXCOORD;
	gl_close(&gl);
	return __builtin_popcount(inputs);
}

/* Varyings with the same name and size correspond in both stages (sec. 2.15.3). */
START_TEST(test_varyings)
{
	ck_assert_int_eq(rows_read(1, "", "gl_Color"), 0);
	ck_assert_int_eq(rows_read(1, "varying vec2 a;", "a.xyxy"), 1);
	ck_assert_int_eq(rows_read(1, "varying vec4 b;", "b"), 1);
	ck_assert_int_eq(rows_read(1, "varying vec3 c[2];", "vec4(c[0].x, c[1].z, 0.0, 1.0)"), 2);
}
END_TEST

/* From GLSL 1.50 on, the vertex stage's results are members of a block. */
START_TEST(test_results_in_blocks)
{
	static const char vertex[] = "#version 150 compatibility\nin vec4 a; out vec2 b; void main() { b = a.xy; "
	                             "gl_FrontColor = a; gl_Position = a * 0.5; gl_Position.w = 1.0; }";
	static const char fragment[] =
		"#version 150 compatibility\nin vec2 b; out vec4 c; void main() { c = vec4(b, 0.0, 1.0); }";
	static const char blocks[] = "#version 150 compatibility\nout pair { vec4 x, y; } p; void main() { p.x = "
	                             "gl_Vertex; gl_Position = gl_Vertex; }";
	struct gl gl = gl_open();
	const struct gls_shader *p;

	make_shader(&gl, 200, GL_VERTEX_SHADER, vertex);
	make_shader(&gl, 201, GL_FRAGMENT_SHADER, fragment);
	make_shader(&gl, 202, GL_VERTEX_SHADER, blocks);
	gl_answered(&gl, 1, "glCreateProgram", "");
	gl_call(&gl, "glAttachShader", "uu", 1u, 200u);
	gl_call(&gl, "glAttachShader", "uu", 1u, 201u);
	gl_call(&gl, "glLinkProgram", "u", 1u);
	p = object(&gl, 1);
	ck_assert_msg(!p->stages.why, "%s", p->stages.why);
	ck_assert_uint_eq(p->stages.code[GLSL_VERTEX_STAGE].outputs >> SCENE_RESULT_POSITION & 1, 1);
	gl_answered(&gl, 2, "glCreateProgram", "");
	gl_call(&gl, "glAttachShader", "uu", 2u, 202u);
	gl_call(&gl, "glLinkProgram", "u", 2u);
	ck_assert_msg(object(&gl, 2)->stages.why && strstr(object(&gl, 2)->stages.why, "blocks"),
	              "blocks of a shader's own are not done");
	gl_close(&gl);
}
END_TEST

GL_TESTS("shaders", test_objects, test_uniforms, test_scene, test_reasons, test_reasons_stay, test_clip_vertex,
         test_unlinked, test_attributes, test_varyings, test_results_in_blocks)
