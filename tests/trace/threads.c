/* Two threads, each with its own window and context, draw at the same time, using functions from glXGetProcAddress. */
#include <pthread.h>

#include "window.h"

enum { FRAMES = 20, TRIANGLES = 200 };

struct painter {
	Display *display;
	Window window;
	GLXContext context;
	float shade;
};

static void open_painter(struct painter *p, float shade)
{
	int attributes[] = { GLX_RGBA, GLX_DOUBLEBUFFER, None };
	XSetWindowAttributes set = { 0 };
	XVisualInfo *visual;

	p->display = XOpenDisplay(NULL);
	expect(p->display != NULL, "a display");
	visual = glXChooseVisual(p->display, DefaultScreen(p->display), attributes);
	expect(visual != NULL, "a visual");
	set.colormap = XCreateColormap(p->display, DefaultRootWindow(p->display), visual->visual, AllocNone);
	p->window = XCreateWindow(p->display, DefaultRootWindow(p->display), 0, 0, 32, 32, 0, visual->depth, InputOutput,
	                          visual->visual, CWColormap, &set);
	XMapWindow(p->display, p->window);
	p->context = glXCreateContext(p->display, visual, NULL, True);
	p->shade = shade;
}

static void *paint(void *data)
{
	struct painter *p = data;
	float corners[200] = { 0 };
	unsigned char pixels[64];
	void (*color)(float, float, float) = (void (*)(float, float, float))glXGetProcAddress((const GLubyte *)"glColor3f");

	expect(glXMakeCurrent(p->display, p->window, p->context), "current");
	for (int frame = 0; frame < FRAMES; frame++) {
		glClear(GL_COLOR_BUFFER_BIT);
		for (int i = 0; i < TRIANGLES; i++) {
			glBegin(GL_TRIANGLES);
			color(p->shade, 0, 0);
			glVertex2f(-1, -1);
			glVertex2f(1, -1);
			glVertex2f(0, 1);
			glEnd();
		}
		glEnableClientState(GL_VERTEX_ARRAY);
		glVertexPointer(2, GL_FLOAT, 0, corners);
		corners[0] = 0.01f * (float)frame;
		glDrawArrays(GL_TRIANGLES, 0, 100);
		glDisableClientState(GL_VERTEX_ARRAY);
		glReadPixels(0, 0, 4, 4, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
		glXSwapBuffers(p->display, p->window);
	}
	glXMakeCurrent(p->display, None, NULL);
	return NULL;
}

int main(void)
{
	struct painter painters[2];
	pthread_t threads[2];

	XInitThreads();
	for (int i = 0; i < 2; i++)
		open_painter(&painters[i], i ? 0.25f : 0.75f);
	for (int i = 0; i < 2; i++)
		pthread_create(&threads[i], NULL, paint, &painters[i]);
	for (int i = 0; i < 2; i++)
		pthread_join(threads[i], NULL);
	return 0;
}
