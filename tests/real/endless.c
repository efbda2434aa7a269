/*
 * Three programs, each drawing a stripe of the window: a short loop, a fragment shader loop beyond the limit, and the
 * same loop in a vertex shader. Frame 0 draws only the first. Recorded by test_endless.py.
 */
#include "tests/trace/window.h"

#define COUNT \
	"uniform int most; float count() { float n = 0.0; for (int i = 0; i < most; i++) n = fract(n + 0.0078125); " \
	"return n; }\n"

static const char plain_vertex[] = "void main() { gl_Position = gl_Vertex; gl_FrontColor = vec4(0.0, 0.5, 0.0, 1.0); }";
static const char plain_fragment[] = "void main() { gl_FragColor = gl_Color; }";
static const char long_vertex[] = COUNT
	"void main() { gl_Position = gl_Vertex; gl_FrontColor = vec4(count(), 0.0, 0.5, 1.0); }";
static const char long_fragment[] = COUNT "void main() { gl_FragColor = vec4(count(), 0.5, 0.0, 1.0); }";

static GLuint make_shader(GLuint program, GLenum stage, const char *text)
{
	const GLuint shader = glCreateShader(stage);

	glShaderSource(shader, 1, &text, NULL);
	glCompileShader(shader);
	glAttachShader(program, shader);
	return program;
}

/* A stripe from x to x + 0.5. */
static void draw(const char *vertex, const char *fragment, int most, float x)
{
	const GLuint program = make_shader(make_shader(glCreateProgram(), GL_VERTEX_SHADER, vertex), GL_FRAGMENT_SHADER,
	                                   fragment);

	glLinkProgram(program);
	glUseProgram(program);
	glUniform1i(glGetUniformLocation(program, "most"), most);
	glRectf(x, -1, x + 0.5f, 1);
	glUseProgram(0);
}

int main(void)
{
	window_size[0] = window_size[1] = 16;
	open_window();
	for (int i = 0; i < 2; i++) {
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		draw(plain_vertex, long_fragment, 100, -1);
		if (i) {
			draw(plain_vertex, long_fragment, 100032, -0.5f);
			draw(long_vertex, plain_fragment, 100064, 0);
		}
		end_frame();
	}
	return 0;
}
