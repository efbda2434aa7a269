/*
 * GLSL 1.10 and 1.20: each built-in function, operator, statement, state variable and kind of texture, on a tilted
 * square; vertex shaders with varyings, attributes and their outputs to fixed function.
 */
#include "programs.h"

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

static GLuint compile(GLenum type, const char *text)
{
	const GLuint shader = glCreateShader(type);
	char log[1024];
	GLint good;

	glShaderSource(shader, 1, &text, NULL);
	glCompileShader(shader);
	glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
	glGetShaderInfoLog(shader, sizeof(log), NULL, log);
	if (!good)
		fprintf(stderr, "%s\n%s\n", text, log);
	expect(good, "a shader compiles");
	return shader;
}

static GLuint current; /* the program in use */
static GLuint shadow_map;

static void set_float(const char *name, float value)
{
	glUniform1f(glGetUniformLocation(current, name), value);
}
static void set_int(const char *name, int value)
{
	glUniform1i(glGetUniformLocation(current, name), value);
}

/* Set shaders for the following draws; without `vertices`, fixed function processes them. */
static void shade(const char *vertices, const char *fragments)
{
	GLint good;

	current = glCreateProgram();
	for (int i = 0; i < 2; i++) {
		const char *text = i ? fragments : vertices;
		GLuint shader = text ? compile(i ? GL_FRAGMENT_SHADER : GL_VERTEX_SHADER, text) : 0;

		if (shader) {
			glAttachShader(current, shader);
			glDeleteShader(shader);
		}
	}
	glBindAttribLocation(current, 3, "bound");
	glLinkProgram(current);
	glGetProgramiv(current, GL_LINK_STATUS, &good);
	expect(good, "a program links");
	glUseProgram(current);
}

static void drop_program(void)
{
	glUseProgram(0);
	glDeleteProgram(current);
}

/* The square that every program is tried on. */
static void draw(int i)
{
	draw_square(i);
	drop_program();
}

/* --- Functions --------------------------------------------------------------------------------------------------- */

/* Expressions for `r` from a, b and p; p is positive, the others have any sign. */
static const char *const functions[] = {
	"radians(a * 90.0)",
	"degrees(a * 0.03)",
	"sin(a * 3.0)",
	"cos(a * 3.0)",
	"tan(a * 0.5)",
	"asin(clamp(a, -1.0, 1.0))",
	"acos(clamp(a, -1.0, 1.0))",
	"atan(a * 3.0)",
	"atan(a, b)",
	"atan(b, a * 0.2)",
	"pow(p, b)",
	"exp(a)",
	"log(p)",
	"exp2(a)",
	"log2(p)",
	"sqrt(p)",
	"inversesqrt(p)",
	"abs(a)",
	"sign(a)",
	"floor(a * 2.0)",
	"ceil(a * 2.0)",
	"fract(a * 2.0)",
	"mod(a, 0.7)",
	"mod(a, p)",
	"min(a, b)",
	"min(a, 0.3)",
	"max(a, b)",
	"max(a, 0.3)",
	"clamp(a, -0.3, 0.6)",
	"clamp(a, b - 0.5, b + 0.5)",
	"mix(a, b, 0.3)",
	"mix(a, b, p)",
	"step(a, b)",
	"step(0.2, a)",
	"smoothstep(-0.5, 0.6, a)",
	"smoothstep(b - 0.6, b + 0.6, a)",
	"vec4(length(a), length(a.xy), length(a.xyz), length(a.x))",
	"vec4(distance(a, b), distance(a.xy, b.yx), 0.2, distance(a.x, b.x))",
	"vec4(dot(a, b), dot(a.xy, b.xy), dot(a.xyz, b.xyz), dot(a.x, b.x))",
	"vec4(cross(a.xyz, b.xyz), 1.0)",
	"normalize(a)",
	"vec4(normalize(a.xyz), normalize(a.w))",
	"faceforward(a, b, p)",
	"reflect(a, normalize(b))",
	"refract(normalize(a), normalize(b), 0.7)",
	"refract(normalize(a), normalize(b), 1.6)",
	"vec4(matrixCompMult(mat2(a), mat2(b)))",
	"vec4(lessThan(a, b))",
	"vec4(lessThanEqual(a, b))",
	"vec4(greaterThan(a, b))",
	"vec4(greaterThanEqual(a, b))",
	"vec4(equal(sign(a), sign(b)))",
	"vec4(notEqual(sign(a), sign(b)))",
	"vec4(any(lessThan(a, b)), all(lessThan(a, b)), any(lessThan(a.xy, b.xy)), all(lessThan(a.xy, b.xy)))",
	"vec4(not(lessThan(a, b)))",
	"dFdx(a * 3.0)",
	"dFdy(a * 3.0)",
	"fwidth(a * 3.0)",
	"dFdx(a * a)",
	"vec4(dFdy(sin(a.xy)), fwidth(b.xy))",
	"noise4(a)",
	"a + b",
	"a - b",
	"a * b",
	"a / p",
	"-a",
	"a * 2.0 + vec4(1.0, 0.5, 0.25, 0.0)",
	"2.0 - a",
	"1.0 / p",
	"mat4(a, b, p, a) * b",
	"b * mat4(a, b, p, a)",
	"vec4(mat3(a.xyz, b.xyz, p.xyz) * a.xyz, 1.0)",
	"vec4(mat2(a) * b.xy, a.xy * mat2(b))",
	"(mat4(a, b, p, a) * mat4(b, a, b, p))[1]",
	"mat4(0.5)[2]",
	"vec4(a.x)",
	"vec4(a.xy, b.zw)",
	"vec4(a.wzyx)",
	"vec4(a.rg, a.pq)",
	"vec4(int(a.x * 3.0), int(a.y * 3.0), bool(a.z), float(a.w > 1.2))",
	"vec4(ivec4(a * 4.0))",
	"vec4(bvec4(floor(a)))",
	"a.x > 0.0 ? a : b",
	"vec4(a.x > b.x && a.y > b.y, a.x > b.x || a.y > b.y, a.x > b.x ^^ a.y > b.y, !(a.x > b.x))",
	"vec4(float(int(a.x * 7.0) / 2), float(7 / int(1.0 + p.x)), float(int(a.y * 9.0) * 2 - 3), 0.5)",
	"vec4(floor(a) == floor(b), floor(a.xy) != floor(b.xy), a.x == a.x, false)",
	"float(true) * a",
	"clamp(p, 0.3, 1.0) * sign(b)",
	"min3(a, b, p - 0.5)",
	"max3(a, b, p - 0.5)",
	"mid3(a, b, p - 0.5)",
	"vec4(mid3(a.x, b.x, 0.3), min3(a.xy, b.xy, p.xy), max3(a.z, b.z, 0.2))",
	"fract(a / p * 1048576.0)",
	"fract(smoothstep(-0.5, 1.6, a) * 1048576.0)", /* to the last bit */
	"fract(sin(a * 9.0) * 1048576.0)",
	"fract(cos(a * 9.0) * 1048576.0)",
	"fract(sin(a * 70000.0) * 1048576.0)",
	"fract(tan(a) * 1048576.0)",
	"fract(exp2(a * 3.0) * 1048576.0)",
	"fract(exp(a) * 1048576.0)",
	"fract(log2(p) * 1048576.0)",
	"fract(log(p) * 1048576.0)",
	"fract(pow(p, b) * 1048576.0)",
	"fract(mat4(a, b, p, a) * mat4(b, a, b, p) * p * 65536.0)",
	"fract(mat4(b, p, b, a) * mat4(b, a, b, p) * mat4(p, a, p, b) * vec4(0.3, 0.7, 0.9, 0.4) * 65536.0)",
	"fract(mat4(a, b, p, a) * (mat4(b, a, b, p) * p) * 65536.0)",
	"fract(p * mat4(b, a, b, p) * mat4(a, b, p, a) * 65536.0)",
	"fract((mat4(a, b, p, a) * 0.3) * p * 65536.0)",
	/* sums of products with a common factor, and similar expressions */
	"fract((a * b + a * p) * 1048576.0)",
	"fract((a.x * b + b * p) * 1048576.0)",
	"fract((a * b + p * a + a.wzyx * a) * 1048576.0)",
	"fract((a * b + p * p + b * b) * 1048576.0)",
	"fract((a * b - a * p) * 1048576.0)",
	"fract((p * a - a * b) * 1048576.0)",
	"fract(vec4(dot(a.xy, b.xx), dot(a.xyz, b.yzz), dot(a, b.xyyx), dot(p, p)) * 1048576.0)",
	"fract((a * 0.3 + b * 0.3) * 1048576.0)",
};

static void function(int i)
{
	char text[1024];

	snprintf(text, sizeof(text),
	         "%svoid main() { vec4 a = gl_TexCoord[0], b = gl_TexCoord[1], p = abs(a) + 0.1; vec4 r = vec4(%s); "
	         "gl_FragColor = r * 0.25 + vec4(0.4, 0.5, 0.45, 0.5); }",
	         strstr(functions[i], "min3") || strstr(functions[i], "max3") || strstr(functions[i], "mid3") ?
	                 "#extension GL_AMD_shader_trinary_minmax : require\n" :
	                 "",
	         functions[i]);
	glActiveTexture(GL_TEXTURE0);
	shade(NULL, text);
}

/* --- Statements -------------------------------------------------------------------------------------------------- */

/* Statements of main that compute r from a, b and p, and the functions and variables before main. */
static const char *const statements[][2] = {
	{ "", "if (a.x > 0.2) r = b;" },
	{ "", "if (a.x > 0.2) r = b; else r = p * 0.5;" },
	{ "", "if (a.x > 0.2) { if (a.y > 0.1) r = b; else r.x = 1.0; } else if (b.x < 0.0) r.yz = a.xy; r.w = 0.7;" },
	{ "", "for (int i = 0; i < 4; i++) r += a * 0.2;" },
	{ "", "for (int i = 0; i < 9; i++) { if (float(i) > p.x * 4.0) break; r.x += 0.1; } r.y = 0.3;" },
	{ "", "for (int i = 0; i < 9; i++) { if (mod(float(i), 2.0) < p.x) continue; r += 0.05 * a; }" },
	{ "", "int n = int(p.x * 6.0); while (n > 0) { r.z += 0.1; n--; }" },
	{ "", "float x = p.y; do { x *= 0.7; r.x += 0.1; } while (x > 0.3);" },
	{ "", "for (int i = 0; i < 3; i++) for (int k = 0; k < 5; k++) { if (k > int(p.y * 3.0)) break; if (i == k) "
	      "continue; r.xy += 0.06; }" },
	{ "", "if (a.x > 0.9) discard; r = b;" },
	{ "", "if (length(a.xy) > 1.0) discard; r = p;" },
	{ "", "if (a.y > 0.6) return; r = b;" },
	{ "", "for (int i = 0; i < 5; i++) { r.y += 0.1; if (r.y > p.x) return; } r.x = 0.9;" },
	{ "float f(float x) { return x * x; }", "r = vec4(f(a.x), f(a.y), f(f(b.x)), 0.5);" },
	{ "float f(float x) { if (x > 0.5) return 1.0; if (x > 0.0) return 0.4; return x; }",
	  "r = vec4(f(a.x), f(a.y), f(b.x), f(b.y));" },
	{ "void f(in vec2 x, out vec2 y, inout float z) { y = x.yx * 2.0; x *= 3.0; z += x.x; }",
	  "vec2 y; float z = b.x; f(a.xy, y, z); r = vec4(y, z, a.x);" },
	{ "vec4 f(vec4 x) { for (int i = 0; i < 4; i++) { if (x.x > 1.0) return x; x += 0.3; } return x * 0.5; }",
	  "r = f(a) - f(b);" },
	{ "float g = 0.3; float f() { g += 0.2; return g; }", "r.x = f(); r.y = f() + g; r.z = g;" },
	{ "struct S { vec3 v; float w[2]; };",
	  "S s; s.v = a.xyz; s.w[0] = b.x; s.w[1] = b.y; S t = s; t.w[1] *= 2.0; r = vec4(t.v.xy, t.w[0], t.w[1]);" },
	{ "struct S { vec2 v; float w; }; S f(vec2 x) { return S(x, 0.4); }",
	  "S s = f(a.xy); r = vec4(s.v, s.w, s == S(a.xy, 0.4) ? 1.0 : 0.0);" },
	{ "", "float w[5]; for (int i = 0; i < 5; i++) w[i] = float(i) * 0.2; r = vec4(w[int(p.x * 4.0)], w[int(p.y * "
	      "3.0)], w[0], w[4]);" },
	{ "", "vec3 w[3]; w[0] = a.xyz; w[1] = b.xyz; w[2] = p.xyz; int k = int(mod(p.x * 5.0, 3.0)); r = vec4(w[k], "
	      "w[k][k]);" },
	{ "", "mat3 m = mat3(1.0); int k = int(mod(p.x * 5.0, 3.0)); m[k] = a.xyz; m[2][k] = 0.3; r.xyz = m * b.xyz;" },
	{ "", "r[int(mod(p.x * 7.0, 4.0))] = 0.9;" },
	{ "", "int i = 3; r.x = float(i++) * 0.2; r.y = float(i--) * 0.2; r.z = float(++i) * 0.1; r.w = float(--i) * "
	      "0.1;" },
	{ "", "vec2 d = 400.0 * a.xy; d = vec2(length(d), length(d + b.yx)); vec2 e = d; r.xy = fract(e * d); d.x = "
	      "length(b) * 400.0; r.z = fract(d.x * d.x);" }, /* last bits */
	{ "", "float d = length(a), e = d; r = vec4(fract(d * 262144.0), fract(e * d * 262144.0), fract(dot(a, a) * "
	      "262144.0), 1.0);" },
	{ "", "r = fract(mat2x4(a, b) * mat3x2(b.xy, p.xy, a.xy) * vec3(0.3, 0.7, 0.9) * 65536.0);" },
	{ "", "mat4 m = mat4(a, b, p, a) * mat4(b, a, b, p); r = fract(m * vec4(0.3, 0.7, 0.9, 0.4) * 65536.0);" },
	{ "", "mat4 m = mat4(a, b, p, a) * mat4(b, a, b, p), n = m * mat4(p, a, p, b); vec4 x = n * vec4(0.3, 0.7, "
	      "0.9, 0.4); r = fract(x * 65536.0);" },
	{ "", "if (a.x > 0.1) { mat4 m = mat4(a, b, p, a) * mat4(b, a, b, p); r = fract(m * vec4(0.3, 0.7, 0.9, 0.4) * "
	      "65536.0); }" },
	{ "", "float x, y; y = a.x * 0.5; x = y; r = vec4(x, y, x, y * 0.3);" },
	{ "", "vec2 x[2], y[2]; x[0] = y[0] = a.xy; x[1] = y[1] = b.xy; y[0].x = 0.4; r = vec4(x == y, x != y, x[0].x, "
	      "y[1].y);" },
	{ "#define Q(x) x + x + x + x\n", "r = Q(Q(Q(Q(a * 0.002)))) - (b * 0.2 + p * (0.1 + a));" },
	{ "", "r.xy = r.yx = a.xy; r.zw += r.xy *= 0.5;" },
	{ "", "r = a; r.zyxw = r; r.xy = r.yx; r *= b; r -= 0.1; r /= p + 1.0;" },
	{ "", "mat2 m = mat2(a); m *= mat2(b); vec2 v = a.xy; v *= m; r = vec4(v, m[0]);" },
	{ "bool f(inout float x) { x += 0.4; return x > 0.5; }",
	  "float x = a.x; bool y = a.y > 0.0 && f(x); r = vec4(x, y, 0.3, 0.5);" },
	{ "bool f(inout float x) { x += 0.4; return x > 0.5; }",
	  "float x = a.x; bool y = a.y > 0.0 || f(x); r = vec4(x, y, 0.3, 0.5);" },
	{ "float f(inout float x) { x += 0.4; return x * 0.5; }",
	  "float x = a.x; r.y = a.y > 0.0 ? f(x) : f(x) + f(x); r.x = x;" },
	{ "", "float x = 1.0, y = (x = a.x, x * 2.0); r = vec4(x, y, x, y);" },
	{ "const vec4 c = vec4(0.1, 0.4, 0.7, 1.0);", "r = c * a + c.wzyx;" },
	{ "const float c[3] = float[3](0.2, 0.5, 0.9);",
	  "r = vec4(c[1], c[int(mod(p.x * 5.0, 3.0))], float(c.length()) * 0.1, 0.4);" },
	{ "uniform vec4 u[3]; uniform mat2 m; uniform bool t; uniform ivec2 n; uniform struct { float x; vec2 y[2]; } "
	  "s;",
	  "r = u[1] + u[int(mod(p.x * 5.0, 3.0))] * 0.3; r.xy = m * r.xy; if (t) r.z = float(n.y) * 0.1; r.w = s.x + "
	  "s.y[1].y;" },
	{ "uniform float w = 0.7; uniform vec2 x[2];", "r = vec4(w, x[0], x[1].x);" },
	{ "", "vec2 z = vec2(0.0); int n = 0; for (int i = 0; i < 24; i++) { z = vec2(z.x * z.x - z.y * z.y, 2.0 * z.x "
	      "* z.y) + a.xy; if (dot(z, z) > 4.0) break; n++; } r = vec4(float(n) / 24.0);" },
	{ "", "gl_FragData[0] = a * 0.3 + 0.5; return;" },
	{ "", "gl_FragDepth = 0.3 + 0.2 * p.x; r = b;" },
	{ "", "r = vec4(gl_FragCoord.xy * 0.004, gl_FragCoord.zw);" },
	{ "", "r = gl_FrontFacing ? a : b;" },
	{ "", "r = gl_Color;" },
	{ "", "r = gl_SecondaryColor + gl_Color * 0.5;" },
	{ "", "r = vec4(gl_FogFragCoord * 0.3);" },
	{ "varying vec4 gl_TexCoord[3];", "for (int i = 0; i < 3; i++) r += gl_TexCoord[i] * 0.3;" },
};

static void statement(int i)
{
	char text[2048];

	snprintf(text, sizeof(text),
	         "#version 120\n%s\nvoid run(vec4 a, vec4 b, vec4 p, inout vec4 r) { %s }\nvoid main() { vec4 a = "
	         "gl_TexCoord[0], b = gl_TexCoord[1], p = abs(a) + 0.1, r = vec4(0.2, 0.1, 0.4, 0.6); "
	         "run(a, b, p, r); %s }",
	         statements[i][0], statements[i][1],
	         strstr(statements[i][1], "gl_FragData") ? "" : "gl_FragColor = r * 0.5 + 0.3;");
	glEnable(GL_DEPTH_TEST);
	shade(NULL, text);
	glUniform4fv(glGetUniformLocation(current, "u"), 2,
	             (const float[8]){ 0.1f, 0.5f, 0.3f, 0.9f, 0.6f, 0.2f, 0.8f, 0.4f });
	glUniform4f(glGetUniformLocation(current, "u[2]"), 0.9f, 0.8f, 0.7f, 0.6f);
	glUniformMatrix2fv(glGetUniformLocation(current, "m"), 1, i & 1, (const float[4]){ 0.4f, 0.7f, -0.3f, 0.9f });
	set_int("t", 1);
	glUniform2i(glGetUniformLocation(current, "n"), 3, 7);
	set_float("s.x", 0.2f);
	glUniform2fv(glGetUniformLocation(current, "s.y"), 2, (const float[4]){ 0.1f, 0.2f, 0.3f, 0.4f });
	glUniform2f(glGetUniformLocation(current, "x[1]"), 0.8f, 0.3f);
}

/* --- State ------------------------------------------------------------------------------------------------------- */

static const char *const states[] = {
	"gl_ModelViewMatrix * a",
	"gl_ProjectionMatrix * a",
	"gl_ModelViewProjectionMatrix * a",
	"gl_TextureMatrix[1] * a",
	"gl_TextureMatrix[k] * a",
	"vec4(gl_NormalMatrix * a.xyz, 1.0)",
	"gl_ModelViewMatrixInverse * a",
	"gl_ProjectionMatrixInverse * a",
	"gl_ModelViewProjectionMatrixInverse * a",
	"gl_TextureMatrixInverse[1] * a",
	"gl_ModelViewMatrixTranspose * a",
	"gl_ProjectionMatrixTranspose * a",
	"gl_ModelViewMatrixInverseTranspose * a",
	"gl_ProjectionMatrixInverseTranspose[1]",
	"gl_ModelViewProjectionMatrixInverseTranspose[2]",
	"gl_TextureMatrixTranspose[1][0]",
	"vec4(gl_NormalScale)",
	"vec4(gl_DepthRange.near, gl_DepthRange.far, gl_DepthRange.diff, 1.0)",
	"gl_ClipPlane[1]",
	"vec4(gl_Point.size, gl_Point.sizeMin, gl_Point.sizeMax * 0.001, gl_Point.fadeThresholdSize)",
	"vec4(gl_Point.distanceConstantAttenuation, gl_Point.distanceLinearAttenuation, "
	"gl_Point.distanceQuadraticAttenuation, 1.0)",
	"gl_FrontMaterial.emission",
	"gl_FrontMaterial.ambient",
	"gl_FrontMaterial.diffuse",
	"gl_FrontMaterial.specular",
	"vec4(gl_FrontMaterial.shininess)",
	"gl_BackMaterial.diffuse",
	"gl_LightSource[0].ambient",
	"gl_LightSource[1].diffuse",
	"gl_LightSource[1].specular",
	"gl_LightSource[1].position",
	"gl_LightSource[1].halfVector",
	"vec4(gl_LightSource[1].spotDirection, gl_LightSource[1].spotExponent)",
	"vec4(gl_LightSource[1].spotCutoff * 0.01, gl_LightSource[1].spotCosCutoff, gl_LightSource[0].spotCosCutoff, "
	"0.0)",
	"vec4(gl_LightSource[1].constantAttenuation, gl_LightSource[1].linearAttenuation, "
	"gl_LightSource[1].quadraticAttenuation, 0.0)",
	"gl_LightSource[k].diffuse * 0.5 + gl_LightSource[k].position * 0.2",
	"gl_LightModel.ambient",
	"gl_FrontLightModelProduct.sceneColor",
	"gl_BackLightModelProduct.sceneColor",
	"gl_FrontLightProduct[1].ambient",
	"gl_FrontLightProduct[1].diffuse",
	"gl_BackLightProduct[1].specular",
	"gl_FrontLightProduct[k].specular",
	"gl_TextureEnvColor[0]",
	"gl_EyePlaneR[0]",
	"gl_ObjectPlaneS[0]",
	"gl_ObjectPlaneT[1]",
	"gl_Fog.color",
	"vec4(gl_Fog.density, gl_Fog.start, gl_Fog.end, gl_Fog.scale)",
	"vec4(float(gl_MaxLights) * 0.1, float(gl_MaxTextureUnits) * 0.1, 0.3, 0.0)",
};

/* Each state variable, for fragments and for vertices. In Mesa (22.3.6), half vectors of lights that were never
 * placed are 0. */
static void state(int i)
{
	const int of_vertices = i / (int)COUNT(states);
	char text[1024];

	set_state();
	snprintf(text, sizeof(text), "%s { %s; int k = int(mod(abs(a.x) * 5.0, 2.0)); %s = %s * 0.4 + 0.3; %s }",
	         of_vertices ? "varying vec4 r;\nvoid main()" : "void main()",
	         of_vertices ? "vec4 a = gl_MultiTexCoord0" : "vec4 a = gl_TexCoord[0]",
	         of_vertices ? "r" : "gl_FragColor", states[i % (int)COUNT(states)],
	         of_vertices ? "gl_Position = ftransform();" : "");
	shade(of_vertices ? text : NULL, of_vertices ? "varying vec4 r;\nvoid main() { gl_FragColor = r; }" : text);
}

/* --- Textures ---------------------------------------------------------------------------------------------------- */

static const char *const textures[] = {
	"texture2D(t0, a.xy)", "texture2D(t0, a.xy, 1.5)", "texture2D(t0, a.xy, -1.0)", "texture2DProj(t0, a.xyw)",
	"texture2DProj(t0, a)", "texture2DProj(t0, a, 1.0)", "texture2DProj(t0, a.xyw, 0.5)", "texture2D(t1, a.xy)",
	"texture2DProj(t1, a)", "textureCube(c, a.xyz)", "textureCube(c, b.xyz)", "texture1D(d, a.x)",
	"texture1DProj(d, a.xw)", "texture1DProj(d, a)", "texture3D(e, a.xyz)", "texture3DProj(e, a)",
	"shadow2D(s, vec3(a.xy, 0.5))", "shadow2D(s, abs(a.xyz))", "shadow2DProj(s, abs(a))",
	"texture2D(t0, texture2D(t0, b.xy).xy)", "texture2D(t0, a.xy * a.xy)", "texture2D(t0, gl_FragCoord.xy * 0.03)",
	"a.x > 0.2 ? texture2D(t0, a.xy) : texture2D(t1, b.xy)", "mix(texture2D(t0, a.xy), texture2D(t1, b.xy), a.z)",
	"pick(t0, a.xy)", "pick(t1, b.yx)", "texture2D(many[1], a.xy) + texture2D(many[0], a.xy) * 0.5",
	"vec4(texture2D(t0, a.xy).aaa, 1.0)", "textureCube(f, a.xyz)", "textureCube(f, a.xyz * abs(b.yxz) + 0.3)",
	"textureCube(f, reflect(normalize(a.xyz), b.xyz))",
};

/* Each unit has a different image, and each sampler a different unit. */
static void bind_images(void)
{
	static const GLenum targets[7] = { GL_TEXTURE_2D, GL_TEXTURE_2D, GL_TEXTURE_CUBE_MAP, GL_TEXTURE_1D,
		                           GL_TEXTURE_3D, GL_TEXTURE_2D, GL_TEXTURE_CUBE_MAP };

	for (int unit = 0; unit < 7; unit++) {
		glActiveTexture(GL_TEXTURE0 + unit);
		glBindTexture(targets[unit], images[unit]);
	}
	glActiveTexture(GL_TEXTURE0);
}

static void name_images(void)
{
	static const char *const names[7] = { "t0", "t1", "c", "d", "e", "s", "f" };

	for (int unit = 0; unit < 7; unit++)
		set_int(names[unit], unit);
	glUniform1iv(glGetUniformLocation(current, "many"), 2, (const int[2]){ 1, 0 });
}

static void texture(int i)
{
	char text[1024];

	snprintf(text, sizeof(text),
	         "#version 120\nuniform sampler2D t0, t1, many[2]; uniform samplerCube c, f; uniform sampler1D d; "
	         "uniform sampler3D e; uniform sampler2DShadow s;\n"
	         "vec4 pick(sampler2D t, vec2 x) { return texture2D(t, x * 0.5).bgra; }\n"
	         "void main() { vec4 a = gl_TexCoord[0], b = gl_TexCoord[1]; gl_FragColor = %s; }",
	         textures[i]);
	shade(NULL, text);
	name_images();
	bind_images();
}

/* --- Vertices ---------------------------------------------------------------------------------------------------- */

static const char *const vertices[][2] = {
	/* vertex and fragment shader; NULL: fixed function */
	{ "void main() { gl_Position = ftransform(); gl_FrontColor = gl_Color.bgra; gl_TexCoord[0] = "
	  "gl_MultiTexCoord0; }",
	  NULL },
	{ "void main() { gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex; gl_FrontColor = gl_Color; "
	  "gl_TexCoord[0] = gl_MultiTexCoord1; }",
	  NULL },
	{ "void main() { vec4 v = gl_Vertex; v.xy *= 0.7; v.z += 0.3 * sin(v.x * 4.0); gl_Position = "
	  "gl_ModelViewProjectionMatrix * v; gl_FrontColor = vec4(gl_Normal * 0.5 + 0.5, 1.0); gl_TexCoord[0] = "
	  "gl_MultiTexCoord0; }",
	  NULL },
	{ "void main() { gl_Position = gl_ProjectionMatrix * (gl_ModelViewMatrix * gl_Vertex); gl_FrontColor = "
	  "gl_SecondaryColor; gl_FogFragCoord = gl_FogCoord; gl_TexCoord[0] = gl_MultiTexCoord0; }",
	  NULL },
	{ "varying vec3 n; void main() { n = gl_NormalMatrix * gl_Normal; gl_Position = ftransform(); }",
	  "varying vec3 n; void main() { gl_FragColor = vec4(normalize(n) * 0.5 + 0.5, 1.0); }" },
	{ "varying vec3 n, v; void main() { n = gl_NormalMatrix * gl_Normal; v = vec3(gl_ModelViewMatrix * gl_Vertex); "
	  "gl_Position = ftransform(); }",
	  "varying vec3 n, v; void main() { vec3 l = normalize(gl_LightSource[0].position.xyz), e = normalize(-v), m = "
	  "normalize(n); float d = max(dot(m, l), 0.0), "
	  "s = pow(max(dot(reflect(-l, m), e), 0.0), 8.0); gl_FragColor = gl_FrontLightProduct[0].ambient + "
	  "gl_FrontLightProduct[0].diffuse * d + vec4(s); }" },
	{ "varying vec3 n; void main() { n = gl_NormalMatrix * gl_Normal; gl_Position = ftransform(); }",
	  "varying vec3 n; void main() { float d = dot(normalize(n), normalize(vec3(0.3, 0.4, 1.0))); gl_FragColor = d "
	  "> 0.95 ? vec4(1.0, 0.5, 0.5, 1.0) : d > 0.8 ? vec4(0.6, 0.3, 0.3, 1.0) : vec4(0.4, 0.2, 0.2, 1.0); }" },
	{ "attribute vec4 bound; varying vec4 c; void main() { c = bound; gl_Position = ftransform(); }",
	  "varying vec4 c; void main() { gl_FragColor = c; }" },
	{ "#version 330 compatibility\nlayout(location = 3) in vec4 given; out vec4 c; void main() { c = given; "
	  "gl_Position = ftransform(); }",
	  "#version 330 compatibility\n#extension GL_ARB_explicit_uniform_location : require\n#extension "
	  "GL_ARB_shading_language_420pack : require\n"
	  "layout(location = 5) uniform vec4 tints[2]; layout(binding = 1) uniform sampler2D s; in vec4 c; void main() "
	  "{ gl_FragColor = c * tints[1] + texture(s, c.xy) * tints[0]; }" },
	{ "uniform mat4 bones[3]; void main() { int k = int(gl_MultiTexCoord2.x + 1.2); vec4 v = mix(gl_Vertex, "
	  "bones[k] * gl_Vertex, 0.7); gl_Position = gl_ModelViewProjectionMatrix * v; gl_FrontColor = gl_Color; "
	  "gl_TexCoord[0] = gl_MultiTexCoord0; }",
	  NULL },
	{ "varying vec2 t[3]; varying float f; void main() { for (int i = 0; i < 3; i++) t[i] = gl_MultiTexCoord0.xy * "
	  "float(i + 1); f = gl_Vertex.z; gl_TexCoord[2] = gl_MultiTexCoord1; gl_Position = ftransform(); }",
	  "varying vec2 t[3]; varying float f; void main() { gl_FragColor = vec4(t[0].x, t[1].y, t[2].x + f, 1.0) * "
	  "0.3 + 0.4 + gl_TexCoord[2] * 0.1; }" },
	{ "varying mat3 m; void main() { m = gl_NormalMatrix; m[2] = gl_Normal; gl_Position = ftransform(); }",
	  "varying mat3 m; void main() { gl_FragColor = vec4(m * vec3(0.3, 0.5, 0.7), 1.0) * 0.5 + 0.3; }" },
	{ "void main() { gl_Position = ftransform(); gl_FrontColor = vec4(1.7, -0.4, 0.5, 1.0) * gl_Color; }",
	  "void main() { gl_FragColor = gl_Color; }" },
	{ "void main() { gl_Position = ftransform(); gl_FrontColor = gl_Color; gl_BackColor = vec4(0.9, 0.2, 0.1, "
	  "1.0); }",
	  "void main() { gl_FragColor = gl_Color; }" },
	{ "void main() { vec4 v = gl_Vertex * vec4(0.7, 0.7, 1.0, 1.0); if (v.y > 0.0) v.x *= 0.5; for (int i = 0; i < "
	  "3; i++) if (v.x > 0.0) v.z += 0.1; gl_Position = gl_ModelViewProjectionMatrix * v; gl_FrontColor = "
	  "vec4(v.xyz, 1.0); gl_TexCoord[0] = gl_MultiTexCoord0; }",
	  NULL },
	{ "varying float c; void main() { c = gl_FrontMaterial.diffuse.r; gl_Position = vec4(gl_Vertex.xy * 0.8, 0.2, "
	  "1.0); }",
	  "varying float c; void main() { gl_FragColor = vec4(c, 0.4, 0.7, 1.0); }" },
	{ "void main() { gl_Position = ftransform(); gl_FrontColor = gl_Color; gl_TexCoord[0] = gl_TextureMatrix[0] * "
	  "gl_MultiTexCoord0; }",
	  "uniform sampler2D t; void main() { gl_FragColor = texture2D(t, gl_TexCoord[0].st) * gl_Color; }" },
	{ "void main() { vec4 v = gl_Vertex; v.w = 12.0; gl_Position = gl_ModelViewProjectionMatrix * v; gl_FrontColor "
	  "= gl_Color; gl_TexCoord[0] = gl_MultiTexCoord0; }",
	  NULL },
	{ "void main() { gl_Position = ftransform(); gl_ClipVertex = gl_ModelViewMatrix * gl_Vertex.yxzw; "
	  "gl_FrontColor = gl_Color; gl_TexCoord[0] = gl_MultiTexCoord0; }",
	  NULL },
	{ "void main() { gl_Position = ftransform(); gl_ClipVertex = vec4(gl_Vertex.xy * 1.3 - 0.2, -gl_Vertex.x, 1.0 "
	  "+ 0.4 * gl_Vertex.y); }",
	  "void main() { gl_FragColor = vec4(0.3, 0.6, 0.9, 1.0); }" },
	{ "void main() { vec4 v = gl_Vertex; v.xyw *= 0.4; gl_Position = gl_ModelViewProjectionMatrix * v; "
	  "gl_Position.z *= 0.1; gl_FrontColor = gl_Color; gl_TexCoord[0] = gl_MultiTexCoord0; }",
	  NULL },
};

static void vertex(int i)
{
	static const double planes[2][4] = { { 0.6, 0.8, 0.1, 0.4 }, { -0.9, 0.2, 0, 0.7 } };
	float bones[48] = { 0 };

	for (int k = 0; k < 3; k++)
		for (int c = 0; c < 4; c++)
			bones[16 * k + 5 * c] = c < 3 ? 0.6f + 0.2f * (float)k : 1;
	bones[12] = 0.3f;
	bones[16 + 13] = -0.2f;
	if (i / (int)COUNT(vertices) == 1) {
		glFrontFace(GL_CW);
		glEnable(GL_VERTEX_PROGRAM_TWO_SIDE);
		glShadeModel(GL_FLAT);
	}
	if (strstr(vertices[i % (int)COUNT(vertices)][0], "gl_ClipVertex")) {
		glDisable(GL_VERTEX_PROGRAM_TWO_SIDE);
		for (int k = 0; k < 2; k++) {
			glClipPlane(GL_CLIP_PLANE0 + (GLenum)k, planes[k]);
			glEnable(GL_CLIP_PLANE0 + (GLenum)k);
		}
	}
	glEnable(GL_TEXTURE_2D);
	glBindTexture(GL_TEXTURE_2D, images[0]);
	shade(vertices[i % (int)COUNT(vertices)][0], vertices[i % (int)COUNT(vertices)][1]);
	glUniformMatrix4fv(glGetUniformLocation(current, "bones"), 3, GL_FALSE, bones);
	if (strstr(vertices[i % (int)COUNT(vertices)][0], "given")) {
		glUniform4f(5, 0.5f, 0.4f, 0.3f, 1);
		glUniform4f(6, 0.6f, 0.3f, 0.5f, 1);
	}
	glVertexAttrib4f(3, 0.3f, 0.8f, 0.4f, 1);
}

static void draw_vertices(int i)
{
	draw(i);
	glDisable(GL_VERTEX_PROGRAM_TWO_SIDE);
}

/* --- Attributes without assigned locations ----------------------------------------------------------------------- */

static const struct { const char *text; GLuint place, constants[3];
} unplaced[] = {
	/* the locations that Mesa assigns */
	{ "attribute vec4 tint; attribute vec3 place; attribute vec2 more; varying vec4 c; void main() { c = more.xyxy "
	  "* 0.4 + tint; gl_Position = gl_ModelViewProjectionMatrix * vec4(place, 1.0); }",
	  1,
	  { 0, 2, 5 } },
	{ "attribute vec2 small; attribute mat2 wide; attribute vec3 place; attribute vec4 never; varying vec4 c; void "
	  "unused() { c = never; } void main() { c = vec4(wide * small, wide[0]) + 0.2; gl_Position = "
	  "gl_ModelViewProjectionMatrix * vec4(place, 1.0); }",
	  3,
	  { 0, 1, 2 } },
	{ "attribute vec4 bound; attribute vec4 b, a; varying vec4 c; void main() { c = a * 0.5 + b * 0.3 + bound; "
	  "gl_Position = ftransform(); }",
	  0,
	  { 1, 2, 3 } },
	{ "attribute vec4 b, a; varying vec4 c; void main() { c = a * 0.5 + b * 0.3; gl_Position = "
	  "gl_ModelViewProjectionMatrix * gl_Vertex; }",
	  0,
	  { 1, 2, 3 } },
};

static void unplace(int i)
{
	shade(unplaced[i / 3].text, "varying vec4 c; void main() { gl_FragColor = c; }");
}

/* By consecutive elements, by indices, and with constant values from a list. */
static void draw_unplaced(int i)
{
	static const float corners[4][3] = {
		{ -0.9f, -0.8f, 0 }, { 0.9f, -0.7f, 0.1f }, { 0.7f, 0.8f, 0.3f }, { -0.8f, 0.7f, -0.2f }
	};
	static const GLubyte order[4] = { 2, 3, 0, 1 };
	const GLuint place = unplaced[i / 3].place, list = i % 3 == 2 ? glGenLists(1) : 0;

	if (list)
		glNewList(list, GL_COMPILE);
	for (int k = 0; k < 3; k++)
		glVertexAttrib4f(unplaced[i / 3].constants[k], 0.3f + 0.2f * (float)k, 0.9f - 0.3f * (float)k,
		                 k == 1 ? 0.1f : 0.5f, 1);
	if (list) {
		glEndList();
		glCallList(list);
		glDeleteLists(list, 1);
	}
	glEnableVertexAttribArray(place);
	glVertexAttribPointer(place, 3, GL_FLOAT, GL_FALSE, 0, corners);
	if (i % 3 == 1)
		glDrawElements(GL_QUADS, 4, GL_UNSIGNED_BYTE, order);
	else
		glDrawArrays(GL_QUADS, 0, 4);
	glDisableVertexAttribArray(place);
	glVertexAttrib4f(0, 0, 0, 0, 1);
	drop_program();
}

/* --- Typical uses of shaders ------------------------------------------------------------------------------------- */

#define EYE "varying vec3 e; varying vec2 t; " \
	"void main() { vec3 v = vec3(gl_ModelViewMatrix * gl_Vertex), n = gl_NormalMatrix * vec3(0.0, 0.0, 1.0), " \
	"a = gl_NormalMatrix * vec3(1.0, 0.0, 0.0); e = vec3(dot(-v, a), dot(-v, cross(n, a)), dot(-v, n)); " \
	"t = gl_MultiTexCoord2.xy * 0.4 + 0.5; gl_Position = ftransform(); }"
#define LAMP \
	"varying vec4 p; void main() { p = gl_TextureMatrix[1] * gl_Vertex; gl_FrontColor = gl_Color; " \
	"gl_Position = ftransform(); }"
#define PLACE \
	"gl_Position = gl_ModelViewProjectionMatrix * v; gl_FrontColor = vec4(v.xyz * 0.4 + 0.5, 1.0); " \
	"gl_TexCoord[0] = gl_MultiTexCoord0; "
#define SHADOWS 4 /* the first of these use a shadow map */

static const char *const scenes[][2] = {
	/* vertex and fragment shader; NULL: fixed function */
	{ LAMP, "uniform sampler2DShadow s; varying vec4 p; void main() { gl_FragColor = gl_Color * (0.3 + 0.7 * "
	        "shadow2DProj(s, p).r); }" },
	{ LAMP, "uniform sampler2DShadow s; varying vec4 p; void main() { vec3 q = p.xyz / p.w; gl_FragColor = "
	        "vec4(shadow2D(s, q + vec3(0.0, 0.0, 0.02)).rgb, 1.0) * gl_Color; }" },
	{ LAMP, "uniform sampler2D s; varying vec4 p; void main() { gl_FragColor = texture2DProj(s, p).r < p.z / p.w ? "
	        "gl_Color * 0.3 : gl_Color; }" },
	{ LAMP, "uniform sampler2D s; varying vec4 p; void main() { vec3 q = p.xyz / p.w; float lit = 0.0; for (int i "
	        "= 0; i < 4; i++) lit += step(q.z, texture2D(s, q.xy + vec2(mod(float(i), 2.0), floor(float(i) * 0.5)) * "
	        "0.06).r); gl_FragColor = gl_Color * (0.2 + 0.2 * lit); }" },
	{ EYE, "uniform sampler2D t0; varying vec3 e; varying vec2 t; void main() { vec3 d = normalize(e); "
	       "gl_FragColor = texture2D(t0, t + (texture2D(t0, t).a * 0.2 - 0.1) * d.xy); }" },
	{ EYE, "uniform sampler2D t0, t1; varying vec3 e; varying vec2 t; void main() { vec2 by = e.xy / e.z * 0.03, "
	       "at = t; float high = 1.0; for (int i = 0; i < 8; i++) "
	       "if (texture2D(t1, at).r < high) { at -= by; high -= 0.125; } gl_FragColor = vec4(texture2D(t0, "
	       "at).rgb, 1.0) * (0.5 + 0.5 * high); }" },
	{ EYE, "uniform sampler2D t1; varying vec3 e; varying vec2 t; void main() { vec3 n = normalize(texture2D(t1, "
	       "t).xyz - 0.5), d = normalize(e), l = normalize(vec3(0.4, 0.5, 0.7)); "
	       "float s = pow(max(dot(n, normalize(l + d)), 0.0), 12.0); gl_FragColor = vec4(vec3(0.2, 0.3, 0.6) * "
	       "max(dot(n, l), 0.0) + s, 1.0); }" },
	{ "varying vec3 n, v; void main() { n = gl_NormalMatrix * gl_Normal; v = vec3(gl_ModelViewMatrix * gl_Vertex); "
	  "gl_Position = ftransform(); }",
	  "uniform sampler1D d; varying vec3 n, v; void main() { vec3 m = normalize(n); float k = max(dot(m, "
	  "normalize(vec3(0.2, 0.3, 1.0))), 0.0); gl_FragColor = dot(m, normalize(-v)) < 0.8 ? vec4(0.0, 0.0, 0.0, 1.0) : "
	  "texture1D(d, k) * 0.5 + 0.5 * floor(k * 4.0) / 4.0; }" },
	{ "uniform sampler2D t0; void main() { vec4 v = gl_Vertex * vec4(0.7, 0.7, 1.0, 1.0); v.z += texture2D(t0, "
	  "gl_MultiTexCoord0.xy).r * 0.6; " PLACE "}",
	  NULL },
	{ "uniform sampler2D t1; void main() { vec4 v = gl_Vertex; v.xy *= 0.6 + 0.4 * texture2DLod(t1, "
	  "gl_MultiTexCoord0.xy, 0.0).g; " PLACE "}",
	  "void main() { gl_FragColor = gl_Color; }" },
	{ "uniform sampler2D t0; void main() { vec4 v = gl_Vertex; v.z += texture2DLod(t0, gl_MultiTexCoord1.xy, "
	  "2.3).r * 0.8; " PLACE "}",
	  "uniform sampler2D t1; void main() { gl_FragColor = texture2D(t1, gl_TexCoord[0].xy) * gl_Color; }" },
	{ "uniform sampler2D t0; void main() { vec4 v = gl_Vertex; v.x += texture2DProj(t0, gl_MultiTexCoord0).b * 0.3 "
	  "- texture2DProjLod(t0, gl_MultiTexCoord0.xyw, 1.0).a * 0.2; " PLACE "}",
	  "uniform sampler2D t0; void main() { gl_FragColor = texture2D(t0, gl_TexCoord[0].xy) + gl_Color * 0.3; }" },
	{ "uniform samplerCube c; uniform sampler3D e; void main() { vec4 v = gl_Vertex; " PLACE
	  "gl_FrontColor = textureCube(c, gl_MultiTexCoord0.xyz) * 0.6 + texture3D(e, gl_MultiTexCoord1.xyz) * 0.4; }",
	  NULL },
	{ "uniform sampler1D d; void main() { vec4 v = gl_Vertex; for (int i = 0; i < 3; i++) v.xy += texture1D(d, v.x "
	  "+ float(i) * 0.3).rg * 0.2 - 0.1; " PLACE "}",
	  "void main() { gl_FragColor = gl_Color.bgra; }" },
	{ "uniform sampler2D t1; varying vec4 r; void main() { vec4 v = gl_Vertex; " PLACE
	  "r = v.x > 0.0 ? texture2D(t1, gl_MultiTexCoord1.xy) : vec4(0.2, 0.4, 0.1, 1.0); }",
	  "varying vec4 r; void main() { gl_FragColor = r; }" },
	{ "uniform sampler2DShadow s; void main() { vec4 v = gl_Vertex; " PLACE
	  "gl_FrontColor.rg *= shadow2D(s, vec3(gl_MultiTexCoord1.xy, 0.5)).rg; }",
	  NULL },
};

/* Some geometry in front of the square, and the square. */
static void put_scene(void)
{
	glBegin(GL_TRIANGLES);
	for (int k = 0; k < 3; k++) {
		set_corner(0.3f * (float)k, 0.8f - 0.2f * (float)k);
		glVertex3f(0.5f * (float)k - 0.7f, k == 1 ? 0.6f : -0.3f, 0.6f);
	}
	glEnd();
	draw_square(0);
}

/* A texture of the depths seen from a lamp, and the matrix that maps to it. */
static void make_shadow_map(int compares)
{
	static const float to_texture[16] = { 0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 0.5f, 0, 0.5f, 0.5f, 0.49f, 1 };
	GLint at[4];

	glGetIntegerv(GL_VIEWPORT, at);
	glEnable(GL_DEPTH_TEST);
	for (int i = 0; i < 2; i++) { /* the lamp's view; the matrix */
		glMatrixMode(i ? GL_TEXTURE : GL_PROJECTION);
		glActiveTexture(i ? GL_TEXTURE1 : GL_TEXTURE0);
		if (!i)
			glPushMatrix();
		glLoadIdentity();
		if (i)
			glMultMatrixf(to_texture);
		glFrustum(-0.6, 0.6, -0.6, 0.6, 1, 6);
		glTranslatef(0.5f, -0.2f, -3);
		glRotatef(25, 0.3f, 1, 0);
		if (i)
			continue;
		glMatrixMode(GL_MODELVIEW);
		glPushMatrix();
		glLoadIdentity();
		put_scene();
		glPopMatrix();
		glMatrixMode(GL_PROJECTION);
		glPopMatrix();
	}
	glMatrixMode(GL_MODELVIEW);
	glActiveTexture(GL_TEXTURE5);
	if (!shadow_map)
		glGenTextures(1, &shadow_map);
	glBindTexture(GL_TEXTURE_2D, shadow_map);
	set_filter(GL_TEXTURE_2D, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, compares ? GL_COMPARE_R_TO_TEXTURE : GL_NONE);
	glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, at[0] + 2, at[1] + 2, 16, 16, 0);
	glActiveTexture(GL_TEXTURE0);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

static void scene(int i)
{
	const char *const *texts = scenes[i];

	bind_images();
	if (i < SHADOWS)
		make_shadow_map(i < 2);
	glEnable(GL_DEPTH_TEST);
	shade(texts[0], texts[1]);
	name_images();
}

static void draw_scene(int i)
{
	put_scene();
	draw(i);
}

/* --- Multiple render targets ------------------------------------------------------------------------------------- */

enum { BUFFERS = 3, BUFFER = 32 };

static const char *const targets[] = {
	/* fragment shaders with three outputs */
	"void main() { gl_FragData[0] = gl_Color; gl_FragData[1] = gl_Color.bgra; gl_FragData[2] = "
	"vec4(gl_FragCoord.xy * 0.03, 0.5, 0.7); }",
	"void main() { gl_FragData[2] = gl_SecondaryColor; gl_FragData[1] = vec4(0.3); for (int i = 0; i < 2; i++) "
	"gl_FragData[i] = gl_Color * (0.4 + 0.5 * float(i)); }",
	"void main() { gl_FragColor = gl_Color.gbra; }",
	"uniform sampler2D t1; void main() { vec4 c = texture2D(t1, gl_TexCoord[0].xy); if (gl_FragCoord.x > 20.0) "
	"discard; gl_FragData[0] = c; gl_FragData[1] = gl_Color; gl_FragData[2] = c * gl_Color; }",
	"void main() { gl_FragData[1] = gl_Color * 0.5; gl_FragData[2] = gl_Color.brga; gl_FragData[0] = 1.0 - "
	"gl_Color; if (gl_Color.r > 0.5) gl_FragData[2].g = 0.9; }",
};

static void several(int i)
{
	const int text = choose(&i, COUNT(targets)), blends = choose(&i, 2);

	if (blends) {
		glEnable(GL_BLEND);
		glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	}
	bind_images();
	shade(NULL, targets[text]);
	name_images();
}

/* Draw the square into three textures, and show them side by side. */
static void draw_several(int i)
{
	static const GLenum all[BUFFERS] = { GL_COLOR_ATTACHMENT0_EXT, GL_COLOR_ATTACHMENT1_EXT, GL_COLOR_ATTACHMENT2_EXT };
	GLuint object, textures_of[BUFFERS];
	GLint at[4];

	glGetIntegerv(GL_VIEWPORT, at);
	glGenTextures(BUFFERS, textures_of);
	glGenFramebuffersEXT(1, &object);
	glBindFramebufferEXT(GL_FRAMEBUFFER_EXT, object);
	for (int k = 0; k < BUFFERS; k++) {
		glBindTexture(GL_TEXTURE_2D, textures_of[k]);
		set_filter(GL_TEXTURE_2D, GL_NEAREST);
		glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, BUFFER, BUFFER, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
		glFramebufferTexture2DEXT(GL_FRAMEBUFFER_EXT, all[k], GL_TEXTURE_2D, textures_of[k], 0);
	}
	glBindTexture(GL_TEXTURE_2D, images[0]);
	glViewport(0, 0, BUFFER, BUFFER);
	glDisable(GL_SCISSOR_TEST);
	for (int k = 0; k < BUFFERS; k++) { /* each starts with different contents */
		glDrawBuffer(all[k]);
		glClearColor(0.3f * (float)k, 0.5f, 0.9f - 0.4f * (float)k, 1);
		glClear(GL_COLOR_BUFFER_BIT);
	}
	glDrawBuffers(BUFFERS, all);
	draw(i);
	glBindFramebufferEXT(GL_FRAMEBUFFER_EXT, 0);
	glDisable(GL_BLEND);
	glViewport(at[0], at[1], at[2], at[3]);
	glEnable(GL_TEXTURE_2D);
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
	for (int k = 0; k < BUFFERS; k++) {
		glBindTexture(GL_TEXTURE_2D, textures_of[k]);
		glBegin(GL_QUADS);
		for (int c = 0; c < 4; c++) {
			const int right = c == 1 || c == 2, up = c >= 2;

			glTexCoord2i(right, up);
			glVertex2f(-1 + 0.66f * (float)(k + right), up ? 0.9f : -0.9f);
		}
		glEnd();
	}
	glDeleteFramebuffersEXT(1, &object);
	glDeleteTextures(BUFFERS, textures_of);
}

int main(void)
{
	static const struct table tables[] = {
		{ COUNT(functions), function, draw }, { COUNT(statements), statement, draw }, { 2 * COUNT(states), state, draw },
		{ COUNT(textures), texture, draw }, { 2 * COUNT(vertices), vertex, draw_vertices },
		{ 3 * COUNT(unplaced), unplace, draw_unplaced }, { COUNT(scenes), scene, draw_scene },
		{ 2 * COUNT(targets), several, draw_several },
	};

	DRAW_TABLES(tables, make_images);
	return 0;
}
