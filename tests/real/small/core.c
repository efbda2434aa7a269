/*
 * A core profile of OpenGL 3.3, which has fewer queries: the recorder must learn the window's bits all the same, and
 * leave no error behind. A frame each; recorded by test_small.py.
 */
#include "tests/trace/window.h"

static void open_core_window(void)
{
	static const int kind[] = { GLX_DOUBLEBUFFER, True, GLX_DEPTH_SIZE, 24, GLX_FRAMEBUFFER_SRGB_CAPABLE_ARB, True, None };
	static const int wanted[] = { GLX_CONTEXT_MAJOR_VERSION_ARB, 3, GLX_CONTEXT_MINOR_VERSION_ARB, 3, None };
	const PFNGLXCREATECONTEXTATTRIBSARBPROC create =
		(PFNGLXCREATECONTEXTATTRIBSARBPROC)glXGetProcAddress((const GLubyte *)"glXCreateContextAttribsARB");
	XSetWindowAttributes set = { 0 };
	GLXFBConfig *configs;
	XVisualInfo *visual;
	int n;

	display = XOpenDisplay(NULL);
	configs = display ? glXChooseFBConfig(display, DefaultScreen(display), kind, &n) : NULL;
	if (!configs || !n || !create) {
		fprintf(stderr, "skipped: this GL has no such window: a core profile, sRGB\n");
		exit(77);
	}
	visual = glXGetVisualFromFBConfig(display, configs[0]);
	set.colormap = XCreateColormap(display, DefaultRootWindow(display), visual->visual, AllocNone);
	window = XCreateWindow(display, DefaultRootWindow(display), 0, 0, window_size[0], window_size[1], 0,
	                       visual->depth, InputOutput, visual->visual, CWColormap, &set);
	XMapWindow(display, window);
	if (!glXMakeCurrent(display, window, create(display, configs[0], NULL, True, wanted)))
		exit(1);
	expect(glGetError() == GL_NO_ERROR, "no error of the recorder's");
}

static GLuint shader_of(GLenum stage, const char *text)
{
	const GLuint shader = glCreateShader(stage);

	glShaderSource(shader, 1, &text, NULL);
	glCompileShader(shader);
	return shader;
}

static void use_program(void)
{
	static const GLfloat corners[] = { -0.9f, -0.7f, 0.1f, 0.8f, -0.5f, 0.9f, 0.1f, 0.9f, 0.5f };
	const GLuint program = glCreateProgram();
	GLuint names[2];

	glAttachShader(program, shader_of(GL_VERTEX_SHADER, "#version 150\nin vec3 place;\n"
	                                                    "void main() { gl_Position = vec4(place, 1.0); }"));
	glAttachShader(program, shader_of(GL_FRAGMENT_SHADER, "#version 150\nout vec4 color;\n"
	                                                      "void main() { color = vec4(0.2, 0.5, 0.7, 0.4); }"));
	glBindAttribLocation(program, 0, "place");
	glLinkProgram(program);
	glUseProgram(program);
	glGenVertexArrays(1, &names[0]);
	glBindVertexArray(names[0]);
	glGenBuffers(1, &names[1]);
	glBindBuffer(GL_ARRAY_BUFFER, names[1]);
	glBufferData(GL_ARRAY_BUFFER, sizeof(corners), corners, GL_STATIC_DRAW);
	glEnableVertexAttribArray(0);
	glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, NULL);
}

int main(void)
{
	open_core_window();
	use_program();
	glClearColor(0.1f, 0.3f, 0.2f, 1);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	for (int i = 0; i < 4; i++) {
		if (i == 1)
			glEnable(GL_FRAMEBUFFER_SRGB);
		if (i == 2)
			glEnable(GL_BLEND);
		if (i == 3)
			glEnable(GL_DEPTH_TEST);
		glClearDepth(i == 3 ? 0.5 : 1);
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		glDrawArrays(GL_TRIANGLES, 0, 3);
		end_frame();
	}
	return 0;
}
