/*
 * A knot above a floor, lit by a lamp: by fixed function (--by fixed), by a vertex program that computes the same light
 * (--by vertex), or by a fragment program that lights each fragment with the normal from a vertex program (--by
 * fragment; --by glsl: the same in GLSL 1.10). The floor uses fixed function. Engines had their own matrices: --by own
 * draws everything by a vertex program whose parameters hold them, while OpenGL's are the identity.
 *
 *   cc -o phong corpus/phong.c -lglut -lGLU -lGL -lm
 */
#define GL_GLEXT_PROTOTYPES
#include "mesh.h"
#include "program.h"
#include <GL/glext.h>

static const char eye_space[] =
	"TEMP e, n, h; PARAM mv[4] = { state.matrix.modelview }; PARAM it[4] = { state.matrix.modelview.invtrans };\n"
	"DP4 e.x, mv[0], vertex.position; DP4 e.y, mv[1], vertex.position; DP4 e.z, mv[2], vertex.position; MOV e.w, 1;\n"
	"DP3 n.x, it[0], vertex.normal; DP3 n.y, it[1], vertex.normal; DP3 n.z, it[2], vertex.normal;\n"
	"DP3 n.w, n, n; RSQ n.w, n.w; MUL n.xyz, n, n.w;\n";

static const char own_space[] =
	"TEMP e, n, h; PARAM mvp[4] = { program.env[0..3] }; PARAM mv[4] = { program.env[4..7] };\n"
	"DP4 result.position.x, mvp[0], vertex.position; DP4 result.position.y, mvp[1], vertex.position;\n"
	"DP4 result.position.z, mvp[2], vertex.position; DP4 result.position.w, mvp[3], vertex.position;\n"
	"DP4 e.x, mv[0], vertex.position; DP4 e.y, mv[1], vertex.position; DP4 e.z, mv[2], vertex.position; MOV e.w, 1;\n"
	"DP3 n.x, mv[0], vertex.normal; DP3 n.y, mv[1], vertex.normal; DP3 n.z, mv[2], vertex.normal;\n"
	"DP3 n.w, n, n; RSQ n.w, n.w; MUL n.xyz, n, n.w;\n";

/* Colour c from a light in the space of e, with normal n. Both stages use these instructions. */
static const char light[] =
	"SUB l, state.light[0].position, e; DP3 l.w, l, l; RSQ l.w, l.w; MUL l.xyz, l, l.w; ADD h, l, { 0, 0, 1, 0 };\n"
	"DP3 h.w, h, h; RSQ h.w, h.w; MUL h.xyz, h, h.w; DP3 l.x, n, l; DP3 l.y, n, h; MOV l.w, "
        "state.material.shininess.x; LIT l, l;\n"
	"MAD c, state.lightprod[0].diffuse, l.y, state.lightmodel.scenecolor; MAD c.xyz, state.lightprod[0].specular, "
        "l.z, c;\n";

static const char vertex_shader[] =
	"varying vec3 eye, normal;\n"
	"void main() {\n"
	"	eye = vec3(gl_ModelViewMatrix * gl_Vertex);\n"
	"	normal = normalize(gl_NormalMatrix * gl_Normal);\n"
	"	gl_Position = ftransform();\n"
	"}\n";

static const char fragment_shader[] = "varying vec3 eye, normal;\n"
				      "void main() {\n"
				      "	vec3 n = normalize(normal), l = normalize(gl_LightSource[0].position.xyz - "
                                      "eye), h = normalize(l + vec3(0.0, 0.0, 1.0));\n"
				      "	float facing = dot(n, l), shine = facing > 0.0 ? pow(max(dot(n, h), 0.0), "
                                      "gl_FrontMaterial.shininess) : 0.0;\n"
				      "	gl_FragColor = gl_FrontLightModelProduct.sceneColor + max(facing, 0.0) * "
                                      "gl_FrontLightProduct[0].diffuse +\n"
				      "	               shine * vec4(gl_FrontLightProduct[0].specular.rgb, 0.0);\n"
				      "}\n";

static struct mesh model;
static GLuint shaders; /* the program object of --by glsl */
static GLuint list;

static int is_by(const char *way)
{
	return program.by && strcmp(program.by, way) == 0;
}

static void set_program(GLenum target, const char *header, const char *first, const char *then, const char *last)
{
	char text[4096];
	GLuint name;
	GLint at;

	snprintf(text, sizeof(text), "%s\n%s%s%s\nEND\n", header, first, then, last);
	glGenProgramsARB(1, &name);
	glBindProgramARB(target, name);
	glProgramStringARB(target, GL_PROGRAM_FORMAT_ASCII_ARB, (GLsizei)strlen(text), text);
	glGetIntegerv(GL_PROGRAM_ERROR_POSITION_ARB, &at);
	if (at >= 0)
		fprintf(stderr, "phong: %s\n", (const char *)glGetString(GL_PROGRAM_ERROR_STRING_ARB));
}

static void add_shader(GLenum stage, const char *text)
{
	const GLuint shader = glCreateShader(stage);
	char said[1024] = "";

	glShaderSource(shader, 1, &text, NULL);
	glCompileShader(shader);
	glGetShaderInfoLog(shader, sizeof(said), NULL, said);
	fputs(said, stderr);
	glAttachShader(shaders, shader);
}

static void set_programs(void)
{
	if (is_by("glsl")) {
		shaders = glCreateProgram();
		add_shader(GL_VERTEX_SHADER, vertex_shader);
		add_shader(GL_FRAGMENT_SHADER, fragment_shader);
		glLinkProgram(shaders);
	}
	if (is_by("vertex"))
		set_program(GL_VERTEX_PROGRAM_ARB, "!!ARBvp1.0\nOPTION ARB_position_invariant;\nTEMP l, c;", eye_space,
		            light, "MOV result.color, c;");
	if (is_by("own"))
		set_program(GL_VERTEX_PROGRAM_ARB, "!!ARBvp1.0\nTEMP l, c;", own_space, light, "MOV result.color, c;");
	if (!is_by("fragment"))
		return;
	set_program(GL_VERTEX_PROGRAM_ARB, "!!ARBvp1.0\nOPTION ARB_position_invariant;", eye_space, "",
	            "MOV result.texcoord[0], e; MOV result.texcoord[1], n; MOV result.texcoord[1].w, 1;");
	set_program(GL_FRAGMENT_PROGRAM_ARB, "!!ARBfp1.0\nTEMP e, n, h, l, c;",
	            "MOV e, fragment.texcoord[0]; MOV n, fragment.texcoord[1]; DP3 n.w, n, n; RSQ n.w, n.w; MUL n.xyz, "
	            "n, n.w;\n",
	            light, "MOV result.color, c;");
}

static void init(void)
{
	model = mesh_load(program.model, 256, 24);
	list = mesh_compile(&model);
	set_programs();
	glClearColor(0.2f, 0.2f, 0.25f, 1);
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_LIGHT0);
	glEnable(GL_NORMALIZE);
	glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, (const float[]){ 0.7f, 0.6f, 0.45f, 1 });
	glMaterialfv(GL_FRONT, GL_SPECULAR, (const float[]){ 0.4f, 0.4f, 0.4f, 1 });
	glMaterialf(GL_FRONT, GL_SHININESS, 40);
}

static void draw_floor(void)
{
	glBegin(GL_QUADS);
	glNormal3f(0, 1, 0);
	for (int i = 0; i < 4; i++)
		glVertex3f(i == 1 || i == 2 ? 3.0f : -3.0f, -1.2f, i >= 2 ? -3.0f : 3.0f);
	glEnd();
}

/* Move OpenGL's matrices into parameters, and load the identity. The lamp keeps its place in eye space. */
static void take_matrices(void)
{
	float p[16], m[16];

	glGetFloatv(GL_PROJECTION_MATRIX, p);
	glGetFloatv(GL_MODELVIEW_MATRIX, m);
	for (unsigned row = 0; row < 4; row++) {
		float mvp[4] = { 0 };

		for (int k = 0; k < 16; k++)
			mvp[k / 4] += p[4 * (k % 4) + (int)row] * m[k];
		glProgramEnvParameter4fvARB(GL_VERTEX_PROGRAM_ARB, row, mvp);
		glProgramEnvParameter4fARB(GL_VERTEX_PROGRAM_ARB, 4 + row, m[row], m[4 + row], m[8 + row], m[12 + row]);
	}
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
}

static void draw(void)
{
	const GLenum stages[2] = { GL_VERTEX_PROGRAM_ARB, GL_FRAGMENT_PROGRAM_ARB };
	const int n = is_by("fragment") ? 2 : is_by("vertex") ? 1 : 0;

	program_perspective(40, 1, 20);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glLoadIdentity();
	glTranslatef(0, 0, -5);
	glRotatef(20, 1, 0, 0);
	glLightfv(GL_LIGHT0, GL_POSITION, (const float[]){ 2, 5, 3, 1 });
	glRotatef(program_moved(program.animate_camera, 3), 0, 1, 0);
	glEnable(GL_LIGHTING);
	if (is_by("own")) {
		take_matrices();
		glEnable(GL_VERTEX_PROGRAM_ARB);
	}
	draw_floor();
	for (int i = 0; i < n; i++)
		glEnable(stages[i]);
	if (shaders)
		glUseProgram(shaders);
	glCallList(list);
	if (shaders)
		glUseProgram(0);
	for (int i = 0; i < n; i++)
		glDisable(stages[i]);
	glDisable(GL_VERTEX_PROGRAM_ARB);
}

int main(int argc, char **argv)
{
	program_run(argc, argv, "phong", init, draw);
	return 0;
}
