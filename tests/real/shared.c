/*
 * A program object used by two contexts that both set its uniforms: after one sets them, the other must draw with the
 * new values. Mesa continues with the old ones (replay/programs/held.h). Recorded by test_shared.py.
 */
#include "tests/trace/window.h"

static const char *const vertex_text =
	"uniform vec2 place;\nvoid main() { gl_Position = vec4(gl_Vertex.xy + place, 0.0, 1.0); }";
static const char *const fragment_text =
	"uniform vec3 color[2];\nvoid main() { gl_FragColor = vec4(color[0] + color[1], 1.0); }";
static const char *const plain_text = "void main() { gl_FragColor = vec4(0.1, 0.2, 0.3, 1.0); }";

static GLXContext contexts[2];
static GLuint program, other;

static GLuint make_program(const char *text)
{
	const GLuint made = glCreateProgram();
	const char *const texts[2] = { vertex_text, text };

	for (int i = 0; i < 2; i++) {
		const GLuint shader = glCreateShader(i ? GL_FRAGMENT_SHADER : GL_VERTEX_SHADER);

		glShaderSource(shader, 1, &texts[i], NULL);
		glCompileShader(shader);
		glAttachShader(made, shader);
	}
	glLinkProgram(made);
	return made;
}

static void use(int context)
{
	expect(glXMakeCurrent(display, window, contexts[context]), "a context is made current");
	glUseProgram(program);
}

static void set(float red, float green)
{
	glUniform3f(glGetUniformLocation(program, "color"), red, green, 0.2f);
}

static void square(float x, float y)
{
	glUniform2f(glGetUniformLocation(program, "place"), x, y);
	glRectf(-0.2f, -0.2f, 0.2f, 0.2f);
	glBegin(GL_TRIANGLES);
	glVertex2f(-0.2f, 0.2f);
	glVertex2f(0.2f, 0.2f);
	glVertex2f(0, 0.4f);
	glEnd();
}

/* The first context draws in red; the second sets green and draws. Then the first draws again. */
static void begin(void)
{
	use(0);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	set(0.8f, 0);
	square(-0.6f, 0.5f);
	use(1);
	set(0, 0.8f);
	square(0, 0.5f);
	use(0);
}

static void the_same(void) { set(0, 0.8f); }
static void nothing(void) { }
static void another(void) { set(0.1f, 0.5f); }
static void there_and_back(void) { another(); the_same(); }

static void other_element(void)
{
	glUniform3f(glGetUniformLocation(program, "color[1]"), 0, 0, 0.5f);
}

static void none_between(void)
{
	glUseProgram(0);
	glClear(GL_DEPTH_BUFFER_BIT);
	glUseProgram(program);
	the_same();
}

static void drawn_between(void)
{
	glUseProgram(other);
	glBegin(GL_TRIANGLES);
	glVertex2f(0.5f, -0.9f);
	glVertex2f(0.9f, -0.9f);
	glVertex2f(0.7f, -0.5f);
	glEnd();
	glUseProgram(program);
	the_same();
}

/* Must come last: Mesa (22.3.6) reads freed memory when the other context draws again. */
static void linked_again(void)
{
	glLinkProgram(program);
	glUseProgram(program);
	set(0.3f, 0.3f);
}

int main(void)
{
	static void (*const between[])(void) = { the_same,      nothing,      another,       there_and_back,
		                                 other_element, none_between, drawn_between, linked_again };
	/* the windows' visual */
	int attributes[] = { GLX_RGBA, GLX_DOUBLEBUFFER, GLX_DEPTH_SIZE, 1, GLX_STENCIL_SIZE, 1, None };

	open_window();
	contexts[0] = glXGetCurrentContext();
	contexts[1] = glXCreateContext(display, glXChooseVisual(display, DefaultScreen(display), attributes),
	                               contexts[0], True);
	program = make_program(fragment_text);
	other = make_program(plain_text);
	for (size_t i = 0; i < sizeof(between) / sizeof(between[0]); i++) {
		begin();
		between[i]();
		square(-0.6f, -0.5f);
		use(1);
		square(0, -0.5f);
		use(0);
		square(0.6f, 0.5f);
		end_frame();
	}
	return 0;
}
