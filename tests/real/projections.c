/*
 * Intersecting planes, placed by shaders with built-in projections, one per frame: some depths are linear in w (several
 * of these grow towards the viewer), others are not. The floor starts behind the viewer if depth is linear. Recorded by
 * test_projections.py.
 */
#include <math.h>

#include "tests/trace/window.h"

enum { LINEAR = 5 }; /* the first LINEAR ones are */

static const struct {
	const char *of;     /* depth as an expression of w and a vertex in eye space, e */
	GLenum func;
} depths[] = {
	{ "-1.002 * e.z - 0.02", GL_LESS }, { "-1.5 * e.z - 1.2", GL_LESS }, { "0.4 * w - 0.3", GL_LESS },
	{ "0.1 - 0.7 * w", GL_GREATER }, { "0.8 - 0.1 * w", GL_GREATER }, { "0.2 * w", GL_LEQUAL },
	{ "(2.0 * log(w * 10.0 + 1.0) / log(101.0) - 1.0) * w", GL_LESS }, { "w * w * 0.1 - 0.9", GL_LESS },
};

static GLuint program_of(const char *depth)
{
	const GLuint program = glCreateProgram(), shader = glCreateShader(GL_VERTEX_SHADER);
	static char text[400];
	const char *const texts[1] = { text };
	GLint good;

	snprintf(text, sizeof(text), "void main() { vec4 e = gl_Vertex; float w = -e.z; gl_FrontColor = gl_Color;"
	                             "gl_Position = vec4(1.3 * e.x, 1.7 * e.y, %s, w); }", depth);
	glShaderSource(shader, 1, texts, NULL);
	glCompileShader(shader);
	glAttachShader(program, shader);
	glLinkProgram(program);
	glGetProgramiv(program, GL_LINK_STATUS, &good);
	expect(good, "a program links");
	return program;
}

/* A plane as adjacent strips, each a mesh. */
static void plane(int k)
{
	enum { STRIPS = 6 };

	for (int s = 0; s < STRIPS; s++) {
		glBegin(GL_TRIANGLE_STRIP);
		for (int c = 0; c < 12; c++) {
			const float x = 2 * (float)(s + c % 2) / STRIPS - 1, y = 2 * (float)(c / 2) / 5 - 1;
			const float z = cosf(0.8f * (float)k) * x + sinf(0.8f * (float)k) * y;

			glColor3f(0.1f * (float)k, 0.15f * (float)s, 0.5f + 0.5f * y);
			glVertex3f(6 * x, 4 * y, 1.3f * z - 2.6f);
		}
		glEnd();
	}
}

static void floor_from(float z)
{
	glBegin(GL_TRIANGLE_STRIP);
	for (int c = 0; c < 40; c++) {
		const float far = (float)(c / 2) / 19;

		glColor3f(0.9f, far, 0.2f);
		glVertex3f(c % 2 ? 2 : -2, -0.2f - 0.1f * far, z - 5 * far);
	}
	glEnd();
}

int main(void)
{
	window_size[0] = 192;
	window_size[1] = 144;
	open_window();
	glEnable(GL_DEPTH_TEST);
	for (int frame = 0; frame < (int)(sizeof(depths) / sizeof(depths[0])); frame++) {
		glClearDepth(depths[frame].func == GL_GREATER ? 0 : 1);
		glDepthFunc(depths[frame].func);
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		glUseProgram(program_of(depths[frame].of));
		for (int k = 0; k < 8; k++)
			plane(k);
		floor_from(frame < LINEAR ? 0.7f : -0.3f);
		end_frame();
	}
	return 0;
}
