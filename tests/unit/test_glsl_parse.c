/* GLSL's front end: what a text means, and what is wrong with it at which line. Values are those that uniforms begin with (GLSL 1.20 sec. 4.3.5). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "replay/glsl/parse/parse.h"
#include "replay/glsl/tree/tree.h"
#include "tests/case.h"

#define MAIN "void main() { gl_FragColor = vec4(r); }\n"

static char message[GLSL_MESSAGE];

/* Why a stage of these texts is refused; NULL: it is not. */
static const char *why_of(enum glsl_stage stage, const char *const *texts, uint32_t n)
{
	struct glsl_tree tree = { 0 };
	const char *why;

	ck_assert_int_eq(glsl_parse(texts, n, stage, &tree, message, &why), 0);
	glsl_tree_free(&tree);
	return why;
}

static void check_why(enum glsl_stage stage, const char *text, const char *wanted)
{
	const char *why = why_of(stage, &text, 1);

	if (!wanted)
		ck_assert_msg(!why, "%s\n%s", text, why);
	else
		ck_assert_msg(why && strstr(why, wanted), "%s\n%s, not %s", text, why ? why : "taken", wanted);
}

static void check_refused(const char *text, const char *wanted)
{
	check_why(GLSL_FRAGMENT_STAGE, text, wanted);
}
static void check_taken(const char *text)
{
	check_why(GLSL_FRAGMENT_STAGE, text, NULL);
}

/* The number that the uniform r begins with. */
static double value_in(const char *text)
{
	struct glsl_tree tree = { 0 };
	const char *why;
	double value = NAN;

	ck_assert_int_eq(glsl_parse(&text, 1, GLSL_FRAGMENT_STAGE, &tree, message, &why), 0);
	ck_assert_msg(!why, "%s\n%s", text, why);
	for (uint32_t i = 0; i < tree.n_symbols; i++)
		if (strcmp(tree.names + tree.symbols[i].name, "r") == 0 && tree.symbols[i].first != GLSL_NONE)
			value = tree.numbers[tree.symbols[i].first];
	glsl_tree_free(&tree);
	return value;
}

/* lines: before the declaration of r. */
static void check_value(const char *version, const char *lines, const char *expression, double wanted)
{
	char text[1024];
	double value;

	snprintf(text, sizeof(text), "#version %s\n%s\nuniform float r = float(%s);\n" MAIN, version, lines, expression);
	value = value_in(text);
	ck_assert_msg(value == wanted || fabs(value - wanted) < 1e-6 * fabs(wanted), "%s: %.9g, not %.9g", expression, value, wanted);
}

/* --- Directives --------------------------------------------------------------------------------------------------------- */

START_TEST(test_macros)
{
	static const struct { const char *lines, *expression; double value; } cases[] = {
		{ "#define A 3", "A", 3 }, { "#define A B\n#define B 4", "A", 4 }, { "#define f(x) x * 2", "f(1 + 2)", 5 },
		{ "#define f(x, y) ((x) - (y))", "f((3 + 7), f(5, 3))", 8 }, { "#define f() 6", "f()", 6 }, { "#define f(x) 2\n#define g f\n", "g(9)", 2 },
		{ "#define join(a, b) a ## b", "join(1, 2)", 12 }, { "#define join(a, b) a##b\n#define A 5\n#define BA 7", "join(B, A)", 7 },
		{ "#define A 1 \\\n + 2", "A", 3 }, { "#define A 1 /* a\n comment */ + 1", "A", 2 }, { "#define A 1 // 2\n", "A", 1 },
		{ "#define A 1\n#undef A\n#define A 2", "A", 2 }, { "#define A 1\n#define A 1", "A", 1 }, { "#define A __VERSION__", "A", 120 },
		{ "", "__FILE__", 0 }, { "#line 40", "__LINE__", 40 }, { "#define L 70\n#line L 3", "__LINE__", 70 }, { "#define f(x) x\n#define A f(A) + 1\n int A0;", "3", 3 },
		{ "#define EMPTY\n", "EMPTY 8 EMPTY", 8 }, { "#define f(a, b) a + b + 1", "f(,)", 1 }, { "#define h(x) x(4)\n#define k(x) x + 1", "h(k)", 5 },
	};

	for (unsigned i = 0; i < sizeof(cases) / sizeof(cases[0]); i++)
		check_value("120", cases[i].lines, cases[i].expression, cases[i].value);
	check_refused("#define f(x) x + f\nvoid main() { gl_FragColor = vec4(f(1)); }", "'f' is not declared");
	check_refused("#define A 1\n#define A 2\nvoid main() {}", "line 2: the macro 'A' is defined otherwise");
	check_refused("#define GL_A 1\nvoid main() {}", "line 1: 'GL_A' cannot be a macro");
	check_refused("#define f(x) x\nvoid main() { gl_FragColor = vec4(f(1.0, 2.0)); }", "line 2: a macro is called with too many");
	check_refused("#define f(x, y) x\nvoid main() { gl_FragColor = vec4(f(1.0)); }", "line 2: a macro is called with too few");
	check_refused("#define f(x) x\nvoid main() { gl_FragColor = vec4(f(1.0; }", "a macro's arguments do not end");
	check_refused("#define A 1 ## -\nvoid main() { int i = A; }", "'1-' is no token");
	check_refused("#define f(x, x) x\nvoid main() {}", "two parameters");
}
END_TEST

START_TEST(test_conditions)
{
	static const struct { const char *condition; int holds; } cases[] = {
		{ "1", 1 }, { "0", 0 }, { "NOTHING", 0 }, { "defined A", 1 }, { "defined(A) && !defined(B)", 1 }, { "defined A == 1", 1 }, { "1 + 2 * 3 == 7", 1 },
		{ "(1 + 2) * 3 == 9", 1 }, { "7 / 2 == 3 && 7 % 2 == 1", 1 }, { "1 << 4 == 16", 1 }, { "-1 < 0", 1 }, { "~0 == -1", 1 }, { "0x10 == 16 && 010 == 8", 1 },
		{ "0 && 1 / 0", 0 }, { "1 || 1 / 0", 1 }, { "A == 5", 1 }, { "F(2) == 4", 1 }, { "1 | 2 & 4 ^ 4", 5 }, { "__VERSION__ >= 120", 1 },
		{ "1 ? 1", -1 }, { "1 / 0", -1 }, { "1.5", -1 }, { "(1", -1 }, { "", -1 },
	};
	char text[512];

	for (unsigned i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		snprintf(text, sizeof(text), "#version 120\n#define A 5\n#define F(x) ((x) * 2)\n#if %s\nuniform float r = 1.0;\n#else\nuniform float r = 0.0;\n#endif\n" MAIN, cases[i].condition);
		if (cases[i].holds < 0)
			check_refused(text, "line 4");
		else
			ck_assert_msg(value_in(text) == !!cases[i].holds, "%s", cases[i].condition);
	}
	ck_assert(value_in("#version 120\n#if 0\n#error not read: don't\n#if 1\n#else\n#endif\n#elif 1\nuniform float r = 3.0;\n#elif 1\n#else\nnot read\n#endif\n" MAIN) == 3);
	ck_assert(value_in("#version 120\n#ifndef A\n  #  define A\n#ifdef A\nuniform float r = 4.0;\n#endif\n#endif\n" MAIN) == 4);
	check_refused("#if 1\nvoid main() {}", "an '#if' does not end");
	check_refused("void main() {}\n#endif", "line 2: '#endif' has no '#if'");
	check_refused("#if 1\n#else\n#else\n#endif\nvoid main() {}", "line 3: '#else' has no '#if'");
	check_refused("\n#error on purpose, 2 words\nvoid main() {}", "line 2: #error on purpose, 2 words");
	check_refused("#nonsense\nvoid main() {}", "'#nonsense' is no directive");
	check_taken("#pragma optimize(off)\n#\nvoid main() { gl_FragColor = vec4(1.0); }");
}
END_TEST

START_TEST(test_versions_and_extensions)
{
	check_taken("// first\n/* of all */ #version 120\nvoid main() { gl_FragColor = vec4(1); }");
	check_refused("#version 110\nvoid main() { gl_FragColor = vec4(1.0) * 2; }", "line 2: an operator does not take vec4 and int");
	check_taken("#version 120\nvoid main() { gl_FragColor = vec4(1.0) * 2; }");
	check_refused("void main() {}\n#version 120", "line 2: '#version' stands behind something else");
	check_refused("#version 125\nvoid main() {}", "line 1: '#version' names none");
	check_refused("#version 120 core\nvoid main() {}", "line 1: '#version' names none");
	check_taken("#version 150 compatibility\nvoid main() { gl_FragColor = gl_Color; }");
	check_refused("#version 150\nvoid main() { gl_FragColor = gl_Color; }", "'gl_Color' is not declared");
	check_refused("#extension GL_NOBODY_nothing : require\nvoid main() {}", "line 1: the extension 'GL_NOBODY_nothing' is not known");
	check_taken("#extension GL_NOBODY_nothing : enable\n#extension all : warn\nvoid main() { gl_FragColor = vec4(1.0); }");
	check_refused("#extension all : require\nvoid main() {}", "'#extension all'");
	check_refused("#extension GL_ARB_draw_buffers enable\nvoid main() {}", "NAME : BEHAVIOUR");
	check_refused("uniform sampler2D s; void main() { gl_FragColor = texture2DLod(s, vec2(0.0), 1.0); }", "'texture2DLod' is not declared");
	check_taken("#extension GL_ARB_shader_texture_lod : enable\nuniform sampler2D s; void main() { gl_FragColor = texture2DLod(s, vec2(0.0), 1.0); }");
	check_why(GLSL_VERTEX_STAGE, "uniform sampler2D s; void main() { gl_Position = texture2DLod(s, vec2(0.0), 1.0); }", NULL);
	check_refused("void main() { gl_FragColor = vec4(min3(1.0, 2.0, 3.0)); }", "'min3' is not declared");
	check_value("120\n#extension GL_AMD_shader_trinary_minmax : require", "", "mid3(3.0, 1.0, 2.0) + min3(5.0, 4.0, 6.0) + max3(7, 8.0, 9)", 15);
	check_taken("uniform sampler2DRect s; void main() { gl_FragColor = texture2DRect(s, vec2(1.0)); }");
	check_taken("#version 330 compatibility\nlayout(location = 0) out vec4 c; void main() { c = vec4(1.0); }");
	check_refused("layout(location = 1) uniform vec4 v; void main() { gl_FragColor = v; }", "line 1");
	check_taken("#extension GL_ARB_explicit_uniform_location : enable\nlayout(location = 1) uniform vec4 v; void main() { gl_FragColor = v; }");
}
END_TEST

/* --- Expressions -------------------------------------------------------------------------------------------------------- */

START_TEST(test_operators)
{
	static const struct { const char *expression; double value; } cases[] = {
		{ "1.0 + 2.0 * 3.0", 7 }, { "(1.0 + 2.0) * 3.0", 9 }, { "8.0 / 4.0 / 2.0", 1 }, { "1.0 - 2.0 - 3.0", -4 }, { "-2.0 * -3.0", 6 }, { "- - 2.0", 2 },
		{ "1.0 < 2.0 == true", 1 }, { "1 + 1 < 3 && 2 > 1", 1 }, { "true || false && false", 1 }, { "true ^^ true || true", 1 }, { "!false && true", 1 },
		{ "true ? 1.0 : false ? 2.0 : 3.0", 1 }, { "false ? 1.0 : false ? 2.0 : 3.0", 3 }, { "7 / 2", 3 }, { "-7 / 2", -3 }, { "2147483647 + 1", -2147483648.0 },
		{ "1e2 + .5 + 2. + 1.5e-1", 102.65 }, { "0x1F + 017 + 10", 56 }, { "vec3(1.0, 2.0, 3.0) == vec3(1, 2, 3)", 1 }, { "vec2(1.0) != vec2(1.0, 2.0)", 1 },
		{ "0.1 + 0.2 == 0.3", 0.1f + 0.2f == 0.3f }, { "16777216.0 + 1.0", 16777216 }, { "3.9", 3.9 }, { "int(-3.9)", -3 }, { "bool(0.5)", 1 },
		{ "vec4(1, 2, 3, 4).wzyx.y", 3 }, { "vec3(5.0)[2]", 5 }, { "mat2(1.0, 2.0, 3.0, 4.0)[1][0]", 3 }, { "mat3(2.0)[1].y", 2 }, { "mat3(mat2(5.0))[2][2]", 1 },
		{ "(mat2(1, 2, 3, 4) * vec2(1, 10)).x", 31 }, { "(vec2(1, 10) * mat2(1, 2, 3, 4)).x", 21 }, { "(mat2(1, 2, 3, 4) * mat2(0, 1, 1, 0))[0][0]", 3 },
		{ "(mat2(1, 2, 3, 4) * 2)[1][1]", 8 }, { "float[](1, 2, 3).length()", 3 }, { "float[3](1, 2, 4)[2]", 4 }, { "mat2x3(1, 2, 3, 4, 5, 6)[1].z", 6 },
	};

	for (unsigned i = 0; i < sizeof(cases) / sizeof(cases[0]); i++)
		check_value("120", "", cases[i].expression, cases[i].value);
	check_value("130", "", "7 % 4 + (1 << 3) + (6 & 3) + (4 | 1) + (5 ^ 1) + (~0)", 3 + 8 + 2 + 5 + 4 - 1);
	check_value("130", "", "-8 >> 1", -4);
	check_value("130", "", "4294967295u / 2u", 2147483647);
	check_value("120", "struct S { float a; vec2 b; }; const S s = S(1.0, vec2(2.0, 3.0));", "s.b.y + s.a", 4);
	check_value("120", "const int n = 2; const float a[n + 1] = float[](4.0, 5.0, 6.0);", "a[n]", 6);
}
END_TEST

START_TEST(test_functions_of_constants)
{
	static const struct { const char *expression; double value; } cases[] = {
		{ "radians(180.0)", M_PI }, { "sin(1.0)", sin(1) }, { "pow(2.0, 10.0)", 1024 }, { "exp2(3.0)", 8 }, { "inversesqrt(4.0)", 0.5 }, { "abs(-2.5)", 2.5 },
		{ "sign(-3.0)", -1 }, { "floor(-1.5)", -2 }, { "ceil(1.2)", 2 }, { "fract(1.75)", 0.75 }, { "mod(-1.0, 3.0)", 2 }, { "min(1, 2.0)", 1 }, { "max(vec2(1, 5), 3.0).x", 3 },
		{ "clamp(5.0, 0.0, 1.0)", 1 }, { "mix(1.0, 3.0, 0.5)", 2 }, { "step(2.0, 1.0)", 0 }, { "smoothstep(0.0, 1.0, 0.5)", 0.5 }, { "length(vec2(3, 4))", 5 },
		{ "distance(vec2(1, 1), vec2(4, 5))", 5 }, { "dot(vec3(1, 2, 3), vec3(4, 5, 6))", 32 }, { "cross(vec3(1, 0, 0), vec3(0, 1, 0)).z", 1 },
		{ "normalize(vec2(3, 4)).y", 0.8f }, { "reflect(vec2(1, -1), vec2(0, 1)).y", 1 }, { "refract(vec2(0, -1), vec2(0, 1), 1.0).y", -1 },
		{ "faceforward(vec2(1), vec2(1), vec2(1)).x", -1 }, { "any(lessThan(vec2(1, 2), vec2(1, 3)))", 1 }, { "all(equal(ivec2(1, 2), ivec2(1, 3)))", 0 },
		{ "not(bvec2(true, false)).y", 1 }, { "matrixCompMult(mat2(2.0), mat2(3.0))[1][1]", 6 }, { "transpose(mat2(1, 2, 3, 4))[0][1]", 3 },
		{ "outerProduct(vec2(1, 2), vec3(3, 4, 5))[2].y", 10 }, { "atan(1.0, -1.0)", 3 * M_PI / 4 }, { "log(1.0)", 0 },
	};

	for (unsigned i = 0; i < sizeof(cases) / sizeof(cases[0]); i++)
		check_value("120", "", cases[i].expression, cases[i].value);
	check_value("150 compatibility", "", "determinant(mat3(2.0)) + inverse(mat2(4.0))[0][0]", 8.25);
	check_value("130", "", "mix(1.0, 2.0, true) + abs(-3) + trunc(-1.5) + roundEven(2.5)", 6);
}
END_TEST

/* Which function a call means: the one that returns the number wanted. */
START_TEST(test_overloads)
{
	static const char functions[] = "#version 120\nfloat f(float x) { return x; } vec2 f(int x) { return vec2(x); } vec3 f(vec2 x) { return vec3(x, 0.0); }\n"
					"float g(float x) { return x; } float g(vec2 x) { return x.x; }\n";
	static const struct { const char *call, *why; } cases[] = {
		{ "float y = f(1.0);", NULL }, { "vec2 y = f(1);", NULL }, { "vec3 y = f(vec2(1.0));", NULL }, { "vec3 y = f(ivec2(1));", NULL }, { "float y = g(1);", NULL },
		{ "float y = g(ivec2(1));", NULL }, { "float y = g(true);", "no function 'g'" }, { "float y = f();", "no function 'f'" }, { "float y = h(1.0);", "'h' is not declared" },
		{ "vec2 y = f(1.0);", "a value of type float stands where vec2 is wanted" }, { "float f = 1.0; f(2.0);", "'f' is no function" },
	};
	char text[1024];

	for (unsigned i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		snprintf(text, sizeof(text), "%svoid main() { %s gl_FragColor = vec4(1.0); }", functions, cases[i].call);
		check_refused(text, cases[i].why);
	}
	check_refused("#version 120\nvoid f(float x, int y) {} void f(int x, float y) {} void main() { f(1, 1); }", "may mean several");
	check_refused("#version 120\nfloat sin(int x) { return 1.0; } void main() { gl_FragColor = vec4(sin(1.0)); }", "no function 'sin'");
	check_refused("#version 120\nvoid f(out float x) { x = 1.0; } void main() { f(1.0); }", "no variable");
	check_taken("#version 120\nvoid f(out int x) { x = 1; } void main() { float y; f(y); gl_FragColor = vec4(y); }");
	check_refused("#version 110\nfloat f(float x) { return x; } void main() { gl_FragColor = vec4(f(1)); }", "no function 'f'");
	check_refused("float f() { } void main() { gl_FragColor = vec4(f()); }", "'f' does not return a value");
	check_refused("float f(float x) { return f(x); } void main() { gl_FragColor = vec4(f(1.0)); }", "do not link here: the function 'f' calls itself");
	check_refused("void f(); void g() { f(); } void f() { g(); } void main() { f(); }", "calls itself");
}
END_TEST

/* --- Declarations and statements ---------------------------------------------------------------------------------------- */

START_TEST(test_names)
{
	static const struct { const char *text, *why; } cases[] = {
		{ "\n\nvoid main() { gl_FragColor = nothing; }", "line 3: 'nothing' is not declared" },
		{ "void main() { float a = 1.0; { float a = a + 1.0; gl_FragColor = vec4(a); } }", NULL }, { "void main() { float a; float a; }", "'a' is declared twice" },
		{ "float a; int a; void main() {}", "'a' is declared twice" }, { "void f(float a) { float a; } void main() {}", "'a' is declared twice" },
		{ "void main() { for (int i = 0; i < 2; i++) {} gl_FragColor = vec4(float(i)); }", "'i' is not declared" },
		{ "void main() { if (true) int b = 1; gl_FragColor = vec4(float(b)); }", "'b' is not declared" }, { "float gl_mine; void main() {}", "a name that the language keeps" },
		{ "struct S { float x; }; void main() { S S = S(1.0); gl_FragColor = vec4(S.x); }", NULL }, { "struct S { float x; } s; void main() { gl_FragColor = vec4(s.y); }", "S has no member 'y'" },
		{ "const float a; void main() {}", "has no value" }, { "const float a = 1.0; void main() { a = 2.0; }", "is no variable" },
		{ "uniform float u; void main() { u = 2.0; }", "'u' cannot be assigned" }, { "void main() { vec2 v; v.xx = vec2(1.0); }", "assigned twice" },
		{ "void main() { float half = 1.0; }", "'half' is not expected" }, { "float a[2]; void main() { a[2] = 1.0; }", "the index 2 is outside" },
		{ "float a[]; void main() { a[3] = 1.0; gl_FragColor = vec4(a[3]); }", NULL }, { "float a[]; uniform int i; void main() { a[i] = 1.0; }", "without a length and indexed" },
		{ "float a[]; float a[2]; void main() { a[1] = 1.0; }", NULL }, { "float a[]; void f() { a[3] = 1.0; } float a[2]; void main() {}", "indexed beyond its length" },
		{ "float a[0]; void main() {}", "not above 0" }, { "uniform sampler2D s; sampler2D t; void main() {}", "'t' is no uniform" },
		{ "attribute vec4 a; void main() {}", "has attributes" }, { "varying bool b; void main() {}", "bool cannot be handed" },
		{ "void main() { break; }", "stands where it cannot" }, { "void main() { return 1.0; }", "returns nothing" }, { "float f() { return; } void main() {}", "returns a value" },
		{ "void main() { if (1) ; }", "a bool is wanted, not int" }, { "void main() { gl_FragColor = vec4(1.0)", "the text ends too early" }, { "void main() { int i = 1 +; }", "';' is not expected" },
		{ "void main() { gl_FragColor = vec4(1.0); gl_FragData[0] = vec4(1.0); }", "names of two kinds" }, { "void f() {}", "no main function" }, { "", "no main function" },
		{ "void main() { vec2 v = vec3(1.0); }", "a value of type vec3 stands where vec2" }, { "void main() { vec3 v = vec3(1.0, 2.0); }", "too few values" },
		{ "void main() { vec2 v = vec2(1.0, 2.0, 3.0); }", "more values than" }, { "/* no end", "line 1: a comment does not end" }, { "void main() { 08; }", "'08' is no number" }, { "@", "'@' is not expected" },
	};

	for (unsigned i = 0; i < sizeof(cases) / sizeof(cases[0]); i++)
		check_refused(cases[i].text, cases[i].why);
	check_refused("#version 130\nvoid main() { switch (1) { case 1: case 1: break; } }", "two cases of one value");
	check_refused("#version 130\nin int i; void main() {}", "whole numbers reach a shader of fragments flat alone");
	check_why(GLSL_VERTEX_STAGE, "void main() { discard; }", "stands where it cannot");
	check_why(GLSL_VERTEX_STAGE, "void main() { gl_Position = dFdx(gl_Vertex); }", "'dFdx' is not declared");
}
END_TEST

/* Lines go on where the text has them, whatever ends them and whatever is between. */
START_TEST(test_lines)
{
	static const char *const texts[][2] = {
		{ "\n\nx", "line 3" }, { "\r\n\r\nx", "line 3" }, { "\r\rx", "line 3" }, { "/*\n\n*/x", "line 3" }, { "#define A \\\n\\\n\nx", "line 4" }, { "// a\\\n b\nx", "line 3" },
		{ "#line 100\nx", "line 100" }, { "#define f(a) a\nf(\n1.0\n)", "line 3" }, { "#define f(a) 1.0\n\nf(\na)", "line 3" }, { "#if 0\n\n#endif\nx", "line 4" },
	};

	for (unsigned i = 0; i < sizeof(texts) / sizeof(texts[0]); i++)
		check_refused(texts[i][0], texts[i][1]);
}
END_TEST

/* Shader objects of one stage share functions and variables, and nothing else. */
START_TEST(test_units)
{
	static const struct { const char *texts[2], *why; } cases[] = {
		{ { "float f(float x); void main() { gl_FragColor = vec4(f(1.0)); }", "float f(float x) { return x; }" }, NULL },
		{ { "uniform float u; void f(); void main() { f(); gl_FragColor = vec4(u); }", "#version 120\nuniform float u; float g; void f() { g = 2 * u; }" }, NULL },
		{ { "uniform float u; void main() {}", "uniform vec2 u;" }, "'u' is declared in two ways" }, { { "void f() {} void main() {}", "void f() {}" }, "do not link here: 'f' is defined twice" },
		{ { "float a[]; void main() { a[1] = 1.0; }", "float a[3]; void f() { a[2] = 1.0; }" }, NULL }, { { "float a[]; void main() { a[4] = 1.0; }", "float a[3];" }, "indexed beyond its length" },
		{ { "#define A 1.0\nvoid main() { gl_FragColor = vec4(A); }", "void f() { gl_FragColor = vec4(A); }" }, "'A' is not declared" },
		{ { "const float c = 1.0; void main() { gl_FragColor = vec4(c); }", "const float c = 2.0; void f() { gl_FragColor = vec4(c); }" }, NULL },
		{ { "struct S { float x; }; uniform S s; void main() { gl_FragColor = vec4(s.x); }", "struct S { float x; }; uniform S s;" }, NULL },
		{ { "struct S { float x; }; uniform S s; void main() { gl_FragColor = vec4(s.x); }", "struct S { float y; }; uniform S s;" }, "in two ways" },
	};

	for (unsigned i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		const char *why = why_of(GLSL_FRAGMENT_STAGE, cases[i].texts, 2);

		ck_assert_msg(cases[i].why ? why && strstr(why, cases[i].why) : !why, "%s\n%s", cases[i].texts[1], why ? why : "taken");
	}
}
END_TEST

/* --- Limits ------------------------------------------------------------------------------------------------------------- */

/* head, n times part, tail */
static void check_repeated(const char *head, const char *part, const char *tail, unsigned n, const char *wanted)
{
	char *text = malloc(strlen(head) + n * strlen(part) + strlen(tail) + 1), *at;

	ck_assert_ptr_nonnull(text);
	at = stpcpy(text, head);
	for (unsigned i = 0; i < n; i++)
		at = stpcpy(at, part);
	stpcpy(at, tail);
	check_refused(text, wanted);
	free(text);
}

START_TEST(test_limits)
{
	static const char bomb[] = "#define a0 1.0+1.0+1.0+1.0+1.0+1.0+1.0+1.0+1.0+1.0\n#define a1 a0+a0+a0+a0+a0+a0+a0+a0+a0+a0\n#define a2 a1+a1+a1+a1+a1+a1+a1+a1+a1+a1\n"
				   "#define a3 a2+a2+a2+a2+a2+a2+a2+a2+a2+a2\n#define a4 a3+a3+a3+a3+a3+a3+a3+a3+a3+a3\n#define a5 a4+a4+a4+a4+a4+a4+a4+a4+a4+a4\n"
				   "#define a6 a5+a5+a5+a5+a5+a5+a5+a5+a5+a5\nvoid main() { gl_FragColor = vec4(a6); }";

	check_refused(bomb, "longer text than is done");
	check_repeated("#define f(x) x x\nvoid main() { ", "f(", "1.0", 5000, "");
	check_repeated("void main() { float x = ", "(", "", 100000, "nests deeper");
	check_repeated("void main() { float x = ", "-", "1.0; }", 100000, "nests deeper");
	check_repeated("void main() ", "{", "", 100000, "nests deeper");
	check_repeated("void main() { ", "if (true) ", ";}", 100000, "nests deeper");
	check_repeated("uniform float u; void main() { float x = u", " + u", "; }", 20000, "nests deeper");
	check_repeated("void main() { vec4 v; v = v", ".xyzw", "; }", 20000, "nests deeper");
	check_repeated("#extension GL_AMD_shader_trinary_minmax : require\nuniform float u; void main() { gl_FragColor = vec4(", "mid3(u, u, ", "", 40, "ends too early");
	check_repeated("", "#if 1\n", "void main() {}", 50000, "does not end");
	check_repeated("#if ", "(", "\n", 100000, "nests deeper");
	check_repeated("void main() { float x", "yyyyyyyyyy", " = z; }", 10000, "'z' is not declared");
	check_repeated("void main() { float x = 1", "0000000000", ".0; }", 10000, "a number is longer");
	check_refused("float a[2000000000]; void main() { a[1] = 1.0; }", "larger array than is done");
	check_refused("float a[65536]; struct S { float x[65536]; float y; } s; void main() { a[1] = 1.0; }", "larger array than is done");
	check_refused("float a[]; void main() { a[2000000000] = 1.0; }", "larger array than is done");
}
END_TEST

/* mid3 names its arguments twice each: nodes are counted as the tree has them. */
START_TEST(test_shared_nodes)
{
	char text[8192] = "#extension GL_AMD_shader_trinary_minmax : require\nuniform float u; void main() { gl_FragColor = vec4(";

	for (unsigned i = 0; i < 40; i++)
		strcat(text, "mid3(u, u, ");
	strcat(text, "u");
	for (unsigned i = 0; i < 40; i++)
		strcat(text, ")");
	strcat(text, "); }");
	check_taken(text);
	*strstr(text, "mid3(u, u, ") = 0;
	for (unsigned i = 0; i < 40; i++)
		strcat(text, "mid3(");
	strcat(text, "u");
	for (unsigned i = 0; i < 40; i++)
		strcat(text, ", u, u)");
	strcat(text, "); }");
	check_refused(text, "larger than is done");
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("glsl_parse");

	tcase_set_timeout(tcase, 60);
	tcase_add_test(tcase, test_macros);
	tcase_add_test(tcase, test_conditions);
	tcase_add_test(tcase, test_versions_and_extensions);
	tcase_add_test(tcase, test_operators);
	tcase_add_test(tcase, test_functions_of_constants);
	tcase_add_test(tcase, test_overloads);
	tcase_add_test(tcase, test_names);
	tcase_add_test(tcase, test_lines);
	tcase_add_test(tcase, test_units);
	tcase_add_test(tcase, test_limits);
	tcase_add_test(tcase, test_shared_nodes);
	return run_case(tcase, "glsl_parse");
}
