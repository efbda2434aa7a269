/* GLSL's front end: directives, macros, line numbers, and texts that exceed limits. */
#include "tests/unit/glsl.h"

START_TEST(test_macros)
{
	static const struct {
		const char *lines, *expression;
		double value;
	} cases[] = {
		{ "#define A 3", "A", 3 },
		{ "#define A B\n#define B 4", "A", 4 },
		{ "#define f(x) x * 2", "f(1 + 2)", 5 },
		{ "#define f(x, y) ((x) - (y))", "f((3 + 7), f(5, 3))", 8 },
		{ "#define f() 6", "f()", 6 },
		{ "#define f(x) 2\n#define g f\n", "g(9)", 2 },
		{ "#define join(a, b) a ## b", "join(1, 2)", 12 },
		{ "#define join(a, b) a##b\n#define A 5\n#define BA 7", "join(B, A)", 7 },
		{ "#define A 1 \\\n + 2", "A", 3 },
		{ "#define A 1 /* a\n comment */ + 1", "A", 2 },
		{ "#define A 1 // 2\n", "A", 1 },
		{ "#define A 1\n#undef A\n#define A 2", "A", 2 },
		{ "#define A 1\n#define A 1", "A", 1 },
		{ "#define A __VERSION__", "A", 120 },
		{ "", "__FILE__", 0 },
		{ "#line 40", "__LINE__", 40 },
		{ "#define L 70\n#line L 3", "__LINE__", 70 },
		{ "#define f(x) x\n#define A f(A) + 1\n int A0;", "3", 3 },
		{ "#define EMPTY\n", "EMPTY 8 EMPTY", 8 },
		{ "#define f(a, b) a + b + 1", "f(,)", 1 },
		{ "#define h(x) x(4)\n#define k(x) x + 1", "h(k)", 5 },
	};

	for (unsigned i = 0; i < sizeof(cases) / sizeof(cases[0]); i++)
		check_value("120", cases[i].lines, cases[i].expression, cases[i].value);
	check_refused("#define f(x) x + f\nvoid main() { gl_FragColor = vec4(f(1)); }", "'f' is not declared");
	check_refused("#define A 1\n#define A 2\nvoid main() {}", "line 2: the macro 'A' is already defined differently");
	check_refused("#define GL_A 1\nvoid main() {}", "line 1: 'GL_A' cannot be a macro");
	check_refused("#define f(x) x\nvoid main() { gl_FragColor = vec4(f(1.0, 2.0)); }",
	              "line 2: a macro is called with too many");
	check_refused("#define f(x, y) x\nvoid main() { gl_FragColor = vec4(f(1.0)); }",
	              "line 2: a macro is called with too few");
	check_refused("#define f(x) x\nvoid main() { gl_FragColor = vec4(f(1.0; }", "a macro's arguments are not closed");
	check_refused("#define A 1 ## -\nvoid main() { int i = A; }", "'1-', made by '##', is not a token");
	check_refused("#define f(x, x) x\nvoid main() {}", "two parameters");
}
END_TEST

START_TEST(test_conditions)
{
	static const struct {
		const char *condition;
		int holds;
	} cases[] = {
		{ "1", 1 },
		{ "0", 0 },
		{ "NOTHING", 0 },
		{ "defined A", 1 },
		{ "defined(A) && !defined(B)", 1 },
		{ "defined A == 1", 1 },
		{ "1 + 2 * 3 == 7", 1 },
		{ "(1 + 2) * 3 == 9", 1 },
		{ "7 / 2 == 3 && 7 % 2 == 1", 1 },
		{ "1 << 4 == 16", 1 },
		{ "-1 < 0", 1 },
		{ "~0 == -1", 1 },
		{ "0x10 == 16 && 010 == 8", 1 },
		{ "0 && 1 / 0", 0 },
		{ "1 || 1 / 0", 1 },
		{ "A == 5", 1 },
		{ "F(2) == 4", 1 },
		{ "1 | 2 & 4 ^ 4", 5 },
		{ "__VERSION__ >= 120", 1 },
		{ "1 ? 1", -1 },
		{ "1 / 0", -1 },
		{ "1.5", -1 },
		{ "(1", -1 },
		{ "", -1 },
	};
	char text[512];

	for (unsigned i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		snprintf(
		        text, sizeof(text),
		        "#version 120\n#define A 5\n#define F(x) ((x) * 2)\n#if %s\nuniform float r = 1.0;\n#else\n"
		        "uniform float r = 0.0;\n#endif\n" MAIN,
		        cases[i].condition);
		if (cases[i].holds < 0)
			check_refused(text, "line 4");
		else
			ck_assert_msg(value_in(text) == !!cases[i].holds, "%s", cases[i].condition);
	}
	ck_assert(
	        value_in(
	                "#version 120\n#if 0\n#error not read: don't\n#if 1\n#else\n#endif\n#elif 1\n"
	                "uniform float r = 3.0;\n#elif 1\n#else\nnot read\n#endif\n" MAIN) ==
	        3);
	ck_assert(
	        value_in(
	                "#version 120\n#ifndef A\n  #  define A\n#ifdef A\nuniform float r = 4.0;\n#endif\n#endif\n"
	                "" MAIN) ==
	        4);
	check_refused("#if 1\nvoid main() {}", "an '#if' has no '#endif'");
	check_refused("void main() {}\n#endif", "line 2: '#endif' has no '#if'");
	check_refused("#if 1\n#else\n#else\n#endif\nvoid main() {}", "line 3: '#else' has no '#if'");
	check_refused("\n#error on purpose, 2 words\nvoid main() {}", "line 2: #error on purpose, 2 words");
	check_refused("#nonsense\nvoid main() {}", "'#nonsense' is not a directive");
	check_taken("#pragma optimize(off)\n#\nvoid main() { gl_FragColor = vec4(1.0); }");
}
END_TEST

START_TEST(test_versions_and_extensions)
{
	check_taken("// first\n/* of all */ #version 120\nvoid main() { gl_FragColor = vec4(1); }");
	check_refused("#version 110\nvoid main() { gl_FragColor = vec4(1.0) * 2; }",
	              "line 2: an operator does not take vec4 and int");
	check_taken("#version 120\nvoid main() { gl_FragColor = vec4(1.0) * 2; }");
	check_refused("void main() {}\n#version 120", "line 2: '#version' is not at the beginning");
	check_refused("#version 125\nvoid main() {}", "line 1: '#version' has an unknown version");
	check_refused("#version 120 core\nvoid main() {}", "line 1: '#version' has an unknown version");
	check_taken("#version 150 compatibility\nvoid main() { gl_FragColor = gl_Color; }");
	check_refused("#version 150\nvoid main() { gl_FragColor = gl_Color; }", "'gl_Color' is not declared");
	check_refused("#extension GL_NOBODY_nothing : require\nvoid main() {}",
	              "line 1: the extension 'GL_NOBODY_nothing' is unknown");
	check_taken(
	        "#extension GL_NOBODY_nothing : enable\n#extension all : warn\n"
	        "void main() { gl_FragColor = vec4(1.0); }");
	check_refused("#extension all : require\nvoid main() {}", "'#extension all'");
	check_refused("#extension GL_ARB_draw_buffers enable\nvoid main() {}", "NAME : BEHAVIOUR");
	check_refused("uniform sampler2D s; void main() { gl_FragColor = texture2DLod(s, vec2(0.0), 1.0); }",
	              "'texture2DLod' is not declared");
	check_taken(
	        "#extension GL_ARB_shader_texture_lod : enable\n"
	        "uniform sampler2D s; void main() { gl_FragColor = texture2DLod(s, vec2(0.0), 1.0); }");
	check_why(GLSL_VERTEX_STAGE,
	          "uniform sampler2D s; void main() { gl_Position = texture2DLod(s, vec2(0.0), 1.0); }", NULL);
	check_refused("void main() { gl_FragColor = vec4(min3(1.0, 2.0, 3.0)); }", "'min3' is not declared");
	check_value("120\n#extension GL_AMD_shader_trinary_minmax : require", "",
	            "mid3(3.0, 1.0, 2.0) + min3(5.0, 4.0, 6.0) + max3(7, 8.0, 9)", 15);
	check_taken("uniform sampler2DRect s; void main() { gl_FragColor = texture2DRect(s, vec2(1.0)); }");
	check_taken("#version 330 compatibility\nlayout(location = 0) out vec4 c; void main() { c = vec4(1.0); }");
	check_refused("layout(location = 1) uniform vec4 v; void main() { gl_FragColor = v; }", "line 1");
	check_taken(
	        "#extension GL_ARB_explicit_uniform_location : enable\n"
	        "layout(location = 1) uniform vec4 v; void main() { gl_FragColor = v; }");
}
END_TEST

/* Line numbers follow the text, for all kinds of line ends and anything in between. */
START_TEST(test_lines)
{
	static const char *const texts[][2] = {
		{ "\n\nx", "line 3" },
		{ "\r\n\r\nx", "line 3" },
		{ "\r\rx", "line 3" },
		{ "/*\n\n*/x", "line 3" },
		{ "#define A \\\n\\\n\nx", "line 4" },
		{ "// a\\\n b\nx", "line 3" },
		{ "#line 100\nx", "line 100" },
		{ "#define f(a) a\nf(\n1.0\n)", "line 3" },
		{ "#define f(a) 1.0\n\nf(\na)", "line 3" },
		{ "#if 0\n\n#endif\nx", "line 4" },
	};

	for (unsigned i = 0; i < sizeof(texts) / sizeof(texts[0]); i++)
		check_refused(texts[i][0], texts[i][1]);
}
END_TEST

/* head, n copies of part, tail */
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
	static const char bomb[] =
	        "#define a0 1.0+1.0+1.0+1.0+1.0+1.0+1.0+1.0+1.0+1.0\n#define a1 a0+a0+a0+a0+a0+a0+a0+a0+a0+a0\n"
	        "#define a2 a1+a1+a1+a1+a1+a1+a1+a1+a1+a1\n"
	        "#define a3 a2+a2+a2+a2+a2+a2+a2+a2+a2+a2\n#define a4 a3+a3+a3+a3+a3+a3+a3+a3+a3+a3\n"
	        "#define a5 a4+a4+a4+a4+a4+a4+a4+a4+a4+a4\n"
	        "#define a6 a5+a5+a5+a5+a5+a5+a5+a5+a5+a5\nvoid main() { gl_FragColor = vec4(a6); }";

	check_refused(bomb, "too much text");
	check_repeated("#define f(x) x x\nvoid main() { ", "f(", "1.0", 5000, "");
	check_repeated("void main() { float x = ", "(", "", 100000, "nested too deeply");
	check_repeated("void main() { float x = ", "-", "1.0; }", 100000, "nested too deeply");
	check_repeated("void main() ", "{", "", 100000, "nested too deeply");
	check_repeated("void main() { ", "if (true) ", ";}", 100000, "nested too deeply");
	check_repeated("uniform float u; void main() { float x = u", " + u", "; }", 20000, "nested too deeply");
	check_repeated("void main() { vec4 v; v = v", ".xyzw", "; }", 20000, "nested too deeply");
	check_repeated(
	        "#extension GL_AMD_shader_trinary_minmax : require\n"
	        "uniform float u; void main() { gl_FragColor = vec4(",
	        "mid3(u, u, ", "", 40, "unexpected end");
	check_repeated("", "#if 1\n", "void main() {}", 50000, "has no '#endif'");
	check_repeated("#if ", "(", "\n", 100000, "nested too deeply");
	check_repeated("void main() { float x", "yyyyyyyyyy", " = z; }", 10000, "'z' is not declared");
	check_repeated("void main() { float x = 1", "0000000000", ".0; }", 10000, "a number has too many digits");
	check_refused("float a[2000000000]; void main() { a[1] = 1.0; }", "an array that is too large");
	check_refused("float a[65536]; struct S { float x[65536]; float y; } s; void main() { a[1] = 1.0; }",
	              "an array that is too large");
	check_refused("float a[]; void main() { a[2000000000] = 1.0; }", "an array that is too large");
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("glsl_text");

	tcase_set_timeout(tcase, 60);
	tcase_add_test(tcase, test_macros);
	tcase_add_test(tcase, test_conditions);
	tcase_add_test(tcase, test_versions_and_extensions);
	tcase_add_test(tcase, test_lines);
	tcase_add_test(tcase, test_limits);
	return run_case(tcase, "glsl_text");
}
