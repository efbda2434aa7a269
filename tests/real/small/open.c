/*
 * Cases that the specification leaves open, or that one rounding decides: the result must be Mesa's. One frame each;
 * recorded by test_small.py.
 */
#include "tests/trace/window.h"

static void before(void)
{
	glPopAttrib();
	glPushAttrib(GL_ALL_ATTRIB_BITS);
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	glDisable(GL_VERTEX_PROGRAM_ARB);
	glUseProgram(0);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

static void quad(float x, float z)
{
	glBegin(GL_QUADS);
	glVertex3f(x, -0.7f, z);
	glVertex3f(x + 0.4f, -0.7f, z);
	glVertex3f(x + 0.4f, 0.7f, z);
	glVertex3f(x, 0.7f, z);
	glEnd();
}

static void light_nothing_attenuates(void)
{
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glLightf(GL_LIGHT0, GL_CONSTANT_ATTENUATION, 0);
	glNormal3f(0, 0, 1);
	glLightfv(GL_LIGHT0, GL_POSITION, (const float[]){ 0, 0, 1, 1 });
	quad(-0.9f, 0);
	glMaterialfv(GL_FRONT, GL_SPECULAR, (const float[]){ 0.2f, 0.3f, 0.4f, 1 });
	quad(-0.2f, 0);
	glLightf(GL_LIGHT0, GL_LINEAR_ATTENUATION, 0.5f);
	quad(0.5f, 0);
}

static void highlight_without_power(void)
{
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glLightfv(GL_LIGHT0, GL_POSITION, (const float[]){ 1, 0, -0.9f, 0 });
	glMaterialfv(GL_FRONT, GL_SPECULAR, (const float[]){ 0.2f, 0.3f, 0.4f, 1 });
	for (int i = 0; i < 4; i++) {
		glMaterialf(GL_FRONT, GL_SHININESS, (float)(i / 2));
		glNormal3f(i % 2 ? 0.6f : 0.28f, 0, i % 2 ? 0.8f : -0.96f);
		quad(0.45f * (float)i - 0.9f, 0);
	}
}

static void fog_without_length(void)
{
	glEnable(GL_FOG);
	glFogi(GL_FOG_MODE, GL_LINEAR);
	glFogfv(GL_FOG_COLOR, (const float[]){ 0, 0.2f, 0.6f, 1 });
	glFogf(GL_FOG_START, 0.5f);
	glFogf(GL_FOG_END, 0.5f);
	glColor3f(0.9f, 0.6f, 0.2f);
	for (int i = 0; i < 4; i++)
		quad(0.45f * (float)i - 0.9f, -0.25f * (float)i);
}

/* A new object for each: Mesa 25.0.7 frees memory twice if an object gets a second text. */
static void use_program(const char *text)
{
	GLuint program;

	glGenProgramsARB(1, &program);
	glBindProgramARB(GL_VERTEX_PROGRAM_ARB, program);
	glProgramStringARB(GL_VERTEX_PROGRAM_ARB, GL_PROGRAM_FORMAT_ASCII_ARB, (int)strlen(text), text);
	glEnable(GL_VERTEX_PROGRAM_ARB);
}

static void powers_of_programs(void)
{
	static const float of[4][4] = { { 1, 0, 0, 0 }, { 1, 0, 0, -3 }, { 1, -1, 0, 2 }, { 1, 0.5f, 0, 0 } };

	use_program("!!ARBvp1.0\nTEMP r;\nLIT r, program.env[0];\nPOW result.color, program.env[0].y, program.env[0].w;\n"
	            "MOV result.color.x, r.z;\nMOV result.position, vertex.position;\nEND\n");
	for (int i = 0; i < 4; i++) {
		glProgramEnvParameter4fvARB(GL_VERTEX_PROGRAM_ARB, 0, of[i]);
		quad(0.45f * (float)i - 0.9f, 0);
	}
}

/* Constant expressions are evaluated by another library: 0 to the power of 0 is 1. */
static void known_powers(void)
{
	static const char *const known[4] = {
		"MOV r, {1, 0, 0, 0};\nLIT r, r;\nMOV o.x, r.z;\n",
		"PARAM p = {0, 0, 0, 0};\nPOW o.x, p.x, p.y;\nADD r, {0.25, 0, 0, 0}, p;\nPOW o.y, r.x, {0.5}.x;\n",
		"SUB r, {1, 1, 1, 1}, {1, 1, 1, 1};\nPOW o.xyz, r.x, r.x;\nLIT o.x, program.env[0];\n",
		"LG2 r, {0.3}.x;\nEX2 o.x, r.x;\nLOG o.y, {0.4}.x;\nLIT r, {0.5, -2, 0, -3};\nMOV o.z, r.z;\n",
	};
	char text[512];

	glProgramEnvParameter4fARB(GL_VERTEX_PROGRAM_ARB, 0, 1, 0, 0, 0);
	for (int i = 0; i < 4; i++) {
		snprintf(text, sizeof(text),
		         "!!ARBvp1.0\nTEMP r, o;\nMOV o, {0, 0, 0.2, 1};\n%sMOV result.color, o;\nMOV result.position, "
		         "vertex.position;\nEND\n",
		         known[i]);
		use_program(text);
		quad(0.45f * (float)i - 0.9f, 0);
	}
}

static void logarithms(void)
{
	use_program("!!ARBvp1.0\nLOG result.color, program.env[0].x;\nMOV result.position, vertex.position;\nEND\n");
	for (int i = 0; i < 4; i++) {
		glProgramEnvParameter4fARB(GL_VERTEX_PROGRAM_ARB, 0, (const float[]){ 0, 1.5f, -0.4f, 0.1f }[i], 0, 0, 1);
		quad(0.45f * (float)i - 0.9f, 0);
	}
}

static GLuint compiled(GLenum kind, const char *text)
{
	const GLuint shader = glCreateShader(kind);

	glShaderSource(shader, 1, &text, NULL);
	glCompileShader(shader);
	return shader;
}

static void powers_of_shaders(void)
{
	const GLuint program = glCreateProgram();

	glAttachShader(program,
	               compiled(GL_VERTEX_SHADER,
	                        "varying vec4 c;\nvoid main() { c = vec4(pow(gl_Color.r, gl_Color.g), 0.0, 0.5, 1.0);\n"
	                        "gl_TexCoord[0] = gl_Color; gl_Position = gl_Vertex; }"));
	glAttachShader(program, compiled(GL_FRAGMENT_SHADER, "varying vec4 c;\nvoid main() { gl_FragColor = vec4(c.r,\n"
	                                                     "pow(gl_TexCoord[0].x, gl_TexCoord[0].y), c.b, 1.0); }"));
	glLinkProgram(program);
	glUseProgram(program);
	for (int i = 0; i < 4; i++) {
		glColor3f(i / 2 ? 0.7f : 0, i % 2 ? 0.6f : 0, 0);
		quad(0.45f * (float)i - 0.9f, 0);
	}
}

/* Depends on whether a program requests integer pixel centres, and on window positions. */
static void places_between_pixels(void)
{
	static GLubyte pixels[5 * 5 * 3];

	for (unsigned i = 0; i < sizeof(pixels); i++)
		pixels[i] = (GLubyte)(i * 37 % 256);
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	glOrtho(-0.5, 63.5, -0.5, 47.5, -1, 1);
	for (int i = 0; i < 8; i++) {
		glRasterPos2i(7 * i, 5 * i);
		glDrawPixels(5, 5, GL_RGB, GL_UNSIGNED_BYTE, pixels);
		glWindowPos2f((float)(7 * i) + 0.5f, (float)(40 - 5 * i) + 0.5f);
		if (i % 2)
			glCopyPixels(0, 0, 5, 5, GL_COLOR);
		else
			glDrawPixels(5, 5, GL_RGB, GL_UNSIGNED_BYTE, pixels);
	}
}

void glPolygonOffsetEXT(GLfloat factor, GLfloat bias);

/* Mesa's library exports only the name. */
static void offset_of_ext(void)
{
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_POLYGON_OFFSET_FILL);
	glPolygonOffset(1, 2);
	glPolygonOffsetEXT(0, -0.125f);
	glColor3f(0.3f, 0.9f, 0.5f);
	quad(-0.6f, 0.2f);
}

static void use_cube(GLint filter)
{
	static GLubyte texels[6][16][3];

	for (int i = 0; i < 6 * 16; i++) {
		texels[i / 16][i % 16][0] = (GLubyte)(40 * (i / 16) + 10);
		texels[i / 16][i % 16][1] = (GLubyte)(60 * (i % 4) + 10);
		texels[i / 16][i % 16][2] = (GLubyte)(60 * (i / 4 % 4) + 10);
	}
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_GENERATE_MIPMAP, filter != GL_NEAREST && filter != GL_LINEAR);
	for (GLenum i = 0; i < 6; i++)
		glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + i, 0, GL_RGB, 4, 4, 0, GL_RGB, GL_UNSIGNED_BYTE, texels[i]);
	glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, filter);
	glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAG_FILTER,
	                filter == GL_NEAREST || filter == GL_NEAREST_MIPMAP_NEAREST ? GL_NEAREST : GL_LINEAR);
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
	glEnable(GL_TEXTURE_CUBE_MAP);
}

/* A zero direction, and directions between two or three faces. */
static void between_faces(GLint filter)
{
	static const float along[8][3] = { { 0, 0, 0 }, { 1, 1, 0 },  { 1, 0, 1 },    { 0, 1, 1 },
		                           { 1, 1, 1 }, { -1, 1, 1 }, { -1, -1, -1 }, { -1, -1, 0 } };

	use_cube(filter);
	for (int i = 0; i < 8; i++) {
		glTexCoord3fv(along[i]);
		glRectf(-1 + 0.25f * (float)i, -0.9f, -0.75f + 0.25f * (float)i, 0.9f);
	}
}

static void nearest(void)
{
	between_faces(GL_NEAREST);
}

static void linear(void)
{
	between_faces(GL_LINEAR);
}

static void nearest_level(void)
{
	between_faces(GL_NEAREST_MIPMAP_NEAREST);
}

static void linear_levels(void)
{
	between_faces(GL_LINEAR_MIPMAP_LINEAR);
}

int main(void)
{
	static void (*const frames[])(void) = {
		light_nothing_attenuates, highlight_without_power, fog_without_length, powers_of_programs, known_powers, logarithms,
		powers_of_shaders, places_between_pixels, offset_of_ext, nearest, linear, nearest_level, linear_levels,
	};

	open_window();
	glPushAttrib(GL_ALL_ATTRIB_BITS);
	draw_frames(frames, sizeof(frames) / sizeof(frames[0]), before);
	expect(glGetError() == GL_NO_ERROR, "no error");
	return 0;
}
