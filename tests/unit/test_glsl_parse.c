/* GLSL's front end: the meaning of texts, and error messages. */
#include "tests/unit/glsl.h"

START_TEST(test_operators)
{
	static const struct {
		const char *expression;
		double value;
	} cases[] = {
		{ "1.0 + 2.0 * 3.0", 7 },
		{ "(1.0 + 2.0) * 3.0", 9 },
		{ "8.0 / 4.0 / 2.0", 1 },
		{ "1.0 - 2.0 - 3.0", -4 },
		{ "-2.0 * -3.0", 6 },
		{ "- - 2.0", 2 },
		{ "1.0 < 2.0 == true", 1 },
		{ "1 + 1 < 3 && 2 > 1", 1 },
		{ "true || false && false", 1 },
		{ "true ^^ true || true", 1 },
		{ "!false && true", 1 },
		{ "true ? 1.0 : false ? 2.0 : 3.0", 1 },
		{ "false ? 1.0 : false ? 2.0 : 3.0", 3 },
		{ "7 / 2", 3 },
		{ "-7 / 2", -3 },
		{ "2147483647 + 1", -2147483648.0 },
		{ "1e2 + .5 + 2. + 1.5e-1", 102.65 },
		{ "0x1F + 017 + 10", 56 },
		{ "vec3(1.0, 2.0, 3.0) == vec3(1, 2, 3)", 1 },
		{ "vec2(1.0) != vec2(1.0, 2.0)", 1 },
		{ "0.1 + 0.2 == 0.3", 0.1f + 0.2f == 0.3f },
		{ "16777216.0 + 1.0", 16777216 },
		{ "3.9", 3.9 },
		{ "int(-3.9)", -3 },
		{ "bool(0.5)", 1 },
		{ "vec4(1, 2, 3, 4).wzyx.y", 3 },
		{ "vec3(5.0)[2]", 5 },
		{ "mat2(1.0, 2.0, 3.0, 4.0)[1][0]", 3 },
		{ "mat3(2.0)[1].y", 2 },
		{ "mat3(mat2(5.0))[2][2]", 1 },
		{ "(mat2(1, 2, 3, 4) * vec2(1, 10)).x", 31 },
		{ "(vec2(1, 10) * mat2(1, 2, 3, 4)).x", 21 },
		{ "(mat2(1, 2, 3, 4) * mat2(0, 1, 1, 0))[0][0]", 3 },
		{ "(mat2(1, 2, 3, 4) * 2)[1][1]", 8 },
		{ "float[](1, 2, 3).length()", 3 },
		{ "float[3](1, 2, 4)[2]", 4 },
		{ "mat2x3(1, 2, 3, 4, 5, 6)[1].z", 6 },
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
	static const struct {
		const char *expression;
		double value;
	} cases[] = {
		{ "radians(180.0)", M_PI },
		{ "sin(1.0)", 0.8414709848 },
		{ "pow(2.0, 10.0)", 1024 },
		{ "exp2(3.0)", 8 },
		{ "inversesqrt(4.0)", 0.5 },
		{ "abs(-2.5)", 2.5 },
		{ "sign(-3.0)", -1 },
		{ "floor(-1.5)", -2 },
		{ "ceil(1.2)", 2 },
		{ "fract(1.75)", 0.75 },
		{ "mod(-1.0, 3.0)", 2 },
		{ "min(1, 2.0)", 1 },
		{ "max(vec2(1, 5), 3.0).x", 3 },
		{ "clamp(5.0, 0.0, 1.0)", 1 },
		{ "mix(1.0, 3.0, 0.5)", 2 },
		{ "step(2.0, 1.0)", 0 },
		{ "smoothstep(0.0, 1.0, 0.5)", 0.5 },
		{ "length(vec2(3, 4))", 5 },
		{ "distance(vec2(1, 1), vec2(4, 5))", 5 },
		{ "dot(vec3(1, 2, 3), vec3(4, 5, 6))", 32 },
		{ "cross(vec3(1, 0, 0), vec3(0, 1, 0)).z", 1 },
		{ "normalize(vec2(3, 4)).y", 0.8f },
		{ "reflect(vec2(1, -1), vec2(0, 1)).y", 1 },
		{ "refract(vec2(0, -1), vec2(0, 1), 1.0).y", -1 },
		{ "faceforward(vec2(1), vec2(1), vec2(1)).x", -1 },
		{ "any(lessThan(vec2(1, 2), vec2(1, 3)))", 1 },
		{ "all(equal(ivec2(1, 2), ivec2(1, 3)))", 0 },
		{ "not(bvec2(true, false)).y", 1 },
		{ "matrixCompMult(mat2(2.0), mat2(3.0))[1][1]", 6 },
		{ "transpose(mat2(1, 2, 3, 4))[0][1]", 3 },
		{ "outerProduct(vec2(1, 2), vec3(3, 4, 5))[2].y", 10 },
		{ "atan(1.0, -1.0)", 3 * M_PI / 4 },
		{ "log(1.0)", 0 },
	};

	for (unsigned i = 0; i < sizeof(cases) / sizeof(cases[0]); i++)
		check_value("120", "", cases[i].expression, cases[i].value);
	check_value("150 compatibility", "", "determinant(mat3(2.0)) + inverse(mat2(4.0))[0][0]", 8.25);
	check_value("130", "", "mix(1.0, 2.0, true) + abs(-3) + trunc(-1.5) + roundEven(2.5)", 6);
}
END_TEST

/* Overload resolution: a call must select the function that returns the expected number. */
START_TEST(test_overloads)
{
	static const char functions[] =
	        "#version 120\n"
	        "float f(float x) { return x; } vec2 f(int x) { return vec2(x); } "
	        "vec3 f(vec2 x) { return vec3(x, 0.0); }\n"
	        "float g(float x) { return x; } float g(vec2 x) { return x.x; }\n";
	static const struct {
		const char *call, *why;
	} cases[] = {
		{ "float y = f(1.0);", NULL },
		{ "vec2 y = f(1);", NULL },
		{ "vec3 y = f(vec2(1.0));", NULL },
		{ "vec3 y = f(ivec2(1));", NULL },
		{ "float y = g(1);", NULL },
		{ "float y = g(ivec2(1));", NULL },
		{ "float y = g(true);", "no function 'g'" },
		{ "float y = f();", "no function 'f'" },
		{ "float y = h(1.0);", "'h' is not declared" },
		{ "vec2 y = f(1.0);", "a value of type float where vec2 is expected" },
		{ "float f = 1.0; f(2.0);", "'f' is not a function" },
	};
	char text[1024];

	for (unsigned i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		snprintf(text, sizeof(text), "%svoid main() { %s gl_FragColor = vec4(1.0); }", functions,
		         cases[i].call);
		check_refused(text, cases[i].why);
	}
	check_refused("#version 120\nvoid f(float x, int y) {} void f(int x, float y) {} void main() { f(1, 1); }",
	              "is ambiguous");
	check_refused("#version 120\nfloat sin(int x) { return 1.0; } void main() { gl_FragColor = vec4(sin(1.0)); }",
	              "no function 'sin'");
	check_refused("#version 120\nvoid f(out float x) { x = 1.0; } void main() { f(1.0); }", "not a variable");
	check_taken(
	        "#version 120\nvoid f(out int x) { x = 1; } void main() { float y; f(y); gl_FragColor = vec4(y); }");
	check_refused("#version 110\nfloat f(float x) { return x; } void main() { gl_FragColor = vec4(f(1)); }",
	              "no function 'f'");
	check_refused("float f() { } void main() { gl_FragColor = vec4(f()); }", "'f' does not return a value");
	check_refused("float f(float x) { return f(x); } void main() { gl_FragColor = vec4(f(1.0)); }",
	              "do not link here: the function 'f' calls itself");
	check_refused("void f(); void g() { f(); } void f() { g(); } void main() { f(); }", "calls itself");
}
END_TEST

START_TEST(test_names)
{
	static const struct {
		const char *text, *why;
	} cases[] = {
		{ "\n\nvoid main() { gl_FragColor = nothing; }", "line 3: 'nothing' is not declared" },
		{ "void main() { float a = 1.0; { float a = a + 1.0; gl_FragColor = vec4(a); } }", NULL },
		{ "void main() { float a; float a; }", "'a' is declared twice" },
		{ "float a; int a; void main() {}", "'a' is declared twice" },
		{ "void f(float a) { float a; } void main() {}", "'a' is declared twice" },
		{ "void main() { for (int i = 0; i < 2; i++) {} gl_FragColor = vec4(float(i)); }",
		  "'i' is not declared" },
		{ "void main() { if (true) int b = 1; gl_FragColor = vec4(float(b)); }", "'b' is not declared" },
		{ "float gl_mine; void main() {}", "a reserved name" },
		{ "struct S { float x; }; void main() { S S = S(1.0); gl_FragColor = vec4(S.x); }", NULL },
		{ "struct S { float x; } s; void main() { gl_FragColor = vec4(s.y); }", "S has no member 'y'" },
		{ "const float a; void main() {}", "has no value" },
		{ "const float a = 1.0; void main() { a = 2.0; }", "is not a variable" },
		{ "uniform float u; void main() { u = 2.0; }", "'u' cannot be assigned" },
		{ "void main() { vec2 v; v.xx = vec2(1.0); }", "assigned twice" },
		{ "void main() { float half = 1.0; }", "'half' is not expected" },
		{ "float a[2]; void main() { a[2] = 1.0; }", "the index 2 is outside" },
		{ "float a[]; void main() { a[3] = 1.0; gl_FragColor = vec4(a[3]); }", NULL },
		{ "float a[]; uniform int i; void main() { a[i] = 1.0; }", "without a length and indexed" },
		{ "float a[]; float a[2]; void main() { a[1] = 1.0; }", NULL },
		{ "float a[]; void f() { a[3] = 1.0; } float a[2]; void main() {}", "indexed beyond its length" },
		{ "float a[0]; void main() {}", "not above 0" },
		{ "uniform sampler2D s; sampler2D t; void main() {}", "'t' is not a uniform" },
		{ "attribute vec4 a; void main() {}", "has attributes" },
		{ "varying bool b; void main() {}", "bool cannot be passed" },
		{ "void main() { break; }", "is not allowed here" },
		{ "void main() { return 1.0; }", "is void, but returns a value" },
		{ "float f() { return; } void main() {}", "does not return a value here" },
		{ "void main() { if (1) ; }", "a bool is expected, not int" },
		{ "void main() { gl_FragColor = vec4(1.0)", "unexpected end of the text" },
		{ "void main() { int i = 1 +; }", "';' is not expected" },
		{ "void main() { gl_FragColor = vec4(1.0); gl_FragData[0] = vec4(1.0); }", "two kinds of output" },
		{ "void f() {}", "no main function" },
		{ "", "no main function" },
		{ "void main() { vec2 v = vec3(1.0); }", "a value of type vec3 where vec2" },
		{ "void main() { vec3 v = vec3(1.0, 2.0); }", "too few values" },
		{ "void main() { vec2 v = vec2(1.0, 2.0, 3.0); }", "more values than" },
		{ "/* no end", "line 1: a comment is not closed" },
		{ "void main() { 08; }", "'08' is not a number" },
		{ "@", "'@' is not expected" },
	};

	for (unsigned i = 0; i < sizeof(cases) / sizeof(cases[0]); i++)
		check_refused(cases[i].text, cases[i].why);
	check_refused("#version 130\nvoid main() { switch (1) { case 1: case 1: break; } }", "two cases with the same value");
	check_refused("#version 130\nin int i; void main() {}", "an integer input of a fragment shader is not flat");
	check_why(GLSL_VERTEX_STAGE, "void main() { discard; }", "is not allowed here");
	check_why(GLSL_VERTEX_STAGE, "void main() { gl_Position = dFdx(gl_Vertex); }", "'dFdx' is not declared");
}
END_TEST

/* Shader objects of one stage share only functions and variables. */
START_TEST(test_units)
{
	static const struct {
		const char *texts[2], *why;
	} cases[] = {
		{ { "float f(float x); void main() { gl_FragColor = vec4(f(1.0)); }",
		    "float f(float x) { return x; }" },
		  NULL },
		{ { "uniform float u; void f(); void main() { f(); gl_FragColor = vec4(u); }",
		    "#version 120\nuniform float u; float g; void f() { g = 2 * u; }" },
		  NULL },
		{ { "uniform float u; void main() {}", "uniform vec2 u;" }, "'u' is declared in different ways" },
		{ { "void f() {} void main() {}", "void f() {}" }, "do not link here: 'f' is defined twice" },
		{ { "float a[]; void main() { a[1] = 1.0; }", "float a[3]; void f() { a[2] = 1.0; }" }, NULL },
		{ { "float a[]; void main() { a[4] = 1.0; }", "float a[3];" }, "indexed beyond its length" },
		{ { "#define A 1.0\nvoid main() { gl_FragColor = vec4(A); }", "void f() { gl_FragColor = vec4(A); }" },
		  "'A' is not declared" },
		{ { "const float c = 1.0; void main() { gl_FragColor = vec4(c); }",
		    "const float c = 2.0; void f() { gl_FragColor = vec4(c); }" },
		  NULL },
		{ { "struct S { float x; }; uniform S s; void main() { gl_FragColor = vec4(s.x); }",
		    "struct S { float x; }; uniform S s;" },
		  NULL },
		{ { "struct S { float x; }; uniform S s; void main() { gl_FragColor = vec4(s.x); }",
		    "struct S { float y; }; uniform S s;" },
		  "in different ways" },
	};

	for (unsigned i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		const char *why = why_of(GLSL_FRAGMENT_STAGE, cases[i].texts, 2);

		ck_assert_msg(cases[i].why ? why && strstr(why, cases[i].why) : !why, "%s\n%s", cases[i].texts[1],
		              why ? why : "taken");
	}
}
END_TEST

/* mid3 uses each of its arguments twice: nodes are counted as in the tree. */
START_TEST(test_shared_nodes)
{
	char text[8192] =
	        "#extension GL_AMD_shader_trinary_minmax : require\n"
	        "uniform float u; void main() { gl_FragColor = vec4(";

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
	check_refused(text, "too large");
}
END_TEST

/* Number of nodes of an operation that a text compiles to. */
static unsigned count_of(const char *text, bool once, enum glsl_operator operation)
{
	struct glsl_tree tree = { 0 };
	const char *why;
	unsigned n = 0;

	ck_assert_int_eq(glsl_parse(&text, 1, GLSL_FRAGMENT_STAGE, once, &tree, message, &why), 0);
	ck_assert_msg(!why, "%s\n%s", text, why);
	for (uint32_t i = 0; i < tree.n_nodes; i++)
		n += tree.nodes[i].operation == operation;
	glsl_tree_free(&tree);
	return n;
}

/* For each text: products of matrices, and of a matrix and a vector, fully expanded, and computed once. */
START_TEST(test_chains_of_products)
{
	static const struct {
		const char *expression;
		unsigned matrices[2], vectors[2];
	} cases[] = {
		{ "a * v", { 0, 0 }, { 1, 1 } },
		{ "a * b * v", { 0, 0 }, { 2, 2 } },
		{ "a * b * c * v", { 0, 1 }, { 3, 2 } },
		{ "a * b * c * a * v", { 0, 2 }, { 4, 2 } },
		{ "a * (b * c) * v", { 0, 1 }, { 3, 2 } },
		{ "(a * b) * (c * a) * v", { 0, 2 }, { 4, 2 } },
		{ "a * b * (c * a * v)", { 0, 0 }, { 4, 4 } },
		{ "v * a * b * c", { 0, 0 }, { 0, 0 } },
	};

	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++)
		for (unsigned once = 0; once < 2; once++) {
			char text[256];

			snprintf(text, sizeof(text), "uniform mat4 a, b, c; uniform vec4 v; void main() { gl_FragColor = %s; }",
			         cases[i].expression);
			ck_assert_msg(count_of(text, once, GLSL_MATRIX_TIMES_MATRIX) == cases[i].matrices[once] &&
			              count_of(text, once, GLSL_MATRIX_TIMES_VECTOR) == cases[i].vectors[once],
			              "%s, %s", cases[i].expression, once ? "once" : "whole");
		}
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("glsl_parse");

	tcase_set_timeout(tcase, 60);
	tcase_add_test(tcase, test_operators);
	tcase_add_test(tcase, test_functions_of_constants);
	tcase_add_test(tcase, test_overloads);
	tcase_add_test(tcase, test_names);
	tcase_add_test(tcase, test_units);
	tcase_add_test(tcase, test_shared_nodes);
	tcase_add_test(tcase, test_chains_of_products);
	return run_case(tcase, "glsl_parse");
}
