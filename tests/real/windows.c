/*
 * Two windows of different sizes and colours, recorded by test_windows.py. One context draws to them in turn; with
 * "shaders" a program is in use; with "threads" each window has its own thread and context, and both swap at the same
 * time.
 */
#include <pthread.h>
#include <string.h>

#include "tests/trace/window.h"

#define FRAMES 5
#define THREAD_FRAMES 40

static XVisualInfo *visual;

static Window make_window(Display *on, unsigned size)
{
	XSetWindowAttributes set = { 0 };
	Window made;

	set.colormap = XCreateColormap(on, DefaultRootWindow(on), visual->visual, AllocNone);
	made = XCreateWindow(on, DefaultRootWindow(on), 0, 0, size, size, 0, visual->depth, InputOutput, visual->visual,
	                     CWColormap, &set);
	XMapWindow(on, made);
	XSync(on, False);
	return made;
}

static void draw(int which, int frame, unsigned size)
{
	glViewport(0, 0, (int)size, (int)size);
	glEnable(GL_DEPTH_TEST);
	glClearColor(which ? 0.6f : 0.1f, 0.1f * (float)frame, which ? 0.1f : 0.6f, 1);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glColor3f(1, 0.2f * (float)frame, (float)which);
	glRectf(-0.5f, -0.5f, 0.1f * (float)frame, which ? 0.2f : 0.7f);
}

/* A shader whose vertices use a texture that Relume does not support. */
static void make_program(void)
{
	const char *vertex = "uniform sampler2D heights;\n"
			     "void main() { gl_Position = ftransform() + 0.001 * texture2DLod(heights, vec2(0.0), "
	                     "0.0); gl_FrontColor = gl_Color; }\n";
	const GLuint shader = glCreateShader(GL_VERTEX_SHADER), program = glCreateProgram();

	glShaderSource(shader, 1, &vertex, NULL);
	glCompileShader(shader);
	glAttachShader(program, shader);
	glLinkProgram(program);
	glUseProgram(program);
	glUniform1i(glGetUniformLocation(program, "heights"), 9); /* unsupported by Relume */
}

static void both_from_one(int shaders)
{
	Window windows[2];
	GLXContext context;

	windows[0] = make_window(display, 48);
	windows[1] = make_window(display, 80);
	context = glXCreateContext(display, visual, NULL, True);
	for (int frame = 0; frame < FRAMES; frame++)
		for (int i = 0; i < 2; i++) {
			glXMakeCurrent(display, windows[i], context);
			if (shaders && !frame && !i)
				make_program();
			draw(i, frame, i ? 80 : 48);
			glXSwapBuffers(display, windows[i]);
		}
}

static pthread_barrier_t both_drew;

static void *paint(void *which)
{
	const int i = which != NULL, size = i ? 80 : 48;
	Display *own = XOpenDisplay(NULL);
	Window window = make_window(own, (unsigned)size);
	GLXContext context = glXCreateContext(own, visual, NULL, True);

	glXMakeCurrent(own, window, context);
	for (int frame = 0; frame < THREAD_FRAMES; frame++) {
		draw(i, frame % FRAMES, (unsigned)size);
		glFinish();
		pthread_barrier_wait(&both_drew);
		glXSwapBuffers(own, window);
	}
	return NULL;
}

static void one_each(void)
{
	pthread_t threads[2];

	pthread_barrier_init(&both_drew, NULL, 2);
	pthread_create(&threads[0], NULL, paint, NULL);
	pthread_create(&threads[1], NULL, paint, threads);
	pthread_join(threads[0], NULL);
	pthread_join(threads[1], NULL);
}

int main(int argc, char **argv)
{
	int attributes[] = { GLX_RGBA, GLX_DOUBLEBUFFER, GLX_DEPTH_SIZE, 1, None };

	XInitThreads();
	display = XOpenDisplay(NULL);
	if (!display || !(visual = glXChooseVisual(display, DefaultScreen(display), attributes)))
		return 1;
	if (argc > 1 && strcmp(argv[1], "threads") == 0)
		one_each();
	else
		both_from_one(argc > 1);
	return 0;
}
