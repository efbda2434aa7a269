/*
 * Cost of recording: 10,000 lit triangles, 100 frames, drawn in one of four ways; prints milliseconds per frame of wall
 * time and of the process' processor time.
 *
 *     static_scene immediate|arrays|elements|changing [FRAMES]
 *
 * immediate: Begin..End with a normal and a vertex each; arrays: one glDrawArrays; elements: 20 glDrawElements over the
 * same arrays; changing: like arrays, with vertices that move every frame. show-overhead runs it bare, recorded and
 * under apitrace.
 */
#include <GL/gl.h>
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { TRIANGLES = 10000, VERTICES = 3 * TRIANGLES, DRAWS = 20, SIDE = 100 };

static float vertices[VERTICES][3], normals[VERTICES][3];
static unsigned indices[VERTICES];

/* A waving sheet of 100 x 100 triangles. */
static void make_sheet(float phase)
{
	for (int i = 0; i < VERTICES; i++) {
		int t = i / 3, corner = i % 3;
		float x = (float)(t % SIDE + (corner == 1)) / SIDE * 2 - 1, y = (float)(t / SIDE + (corner == 2)) / SIDE * 2 - 1;

		vertices[i][0] = x;
		vertices[i][1] = y;
		vertices[i][2] = 0.2f * sinf(7 * x + phase) * cosf(5 * y);
		normals[i][0] = -0.3f * cosf(7 * x + phase);
		normals[i][1] = 0.3f * sinf(5 * y);
		normals[i][2] = 0.9f;
		indices[i] = (unsigned)i;
	}
}

static void draw_immediate(void)
{
	glBegin(GL_TRIANGLES);
	for (int i = 0; i < VERTICES; i++) {
		glNormal3fv(normals[i]);
		glVertex3fv(vertices[i]);
	}
	glEnd();
}

static void set_arrays(void)
{
	glEnableClientState(GL_VERTEX_ARRAY);
	glEnableClientState(GL_NORMAL_ARRAY);
	glVertexPointer(3, GL_FLOAT, 0, vertices);
	glNormalPointer(GL_FLOAT, 0, normals);
}

static void draw(const char *how, int frame)
{
	if (strcmp(how, "immediate") == 0) {
		draw_immediate();
		return;
	}
	if (strcmp(how, "changing") == 0)
		make_sheet((float)frame * 0.1f);
	set_arrays();
	if (strcmp(how, "elements") != 0) {
		glDrawArrays(GL_TRIANGLES, 0, VERTICES);
		return;
	}
	for (int i = 0; i < DRAWS; i++)
		glDrawElements(GL_TRIANGLES, VERTICES / DRAWS, GL_UNSIGNED_INT, indices + i * (VERTICES / DRAWS));
}

static double now_ms(void)
{
	struct timespec t;

	clock_gettime(CLOCK_MONOTONIC, &t);
	return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

/* Processor time of all threads. */
static double used_ms(void)
{
	struct timespec t;

	clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
	return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

int main(int argc, char **argv)
{
	int attributes[] = { GLX_RGBA, GLX_DOUBLEBUFFER, GLX_DEPTH_SIZE, 24, None };
	const char *how = argc > 1 ? argv[1] : "arrays";
	int frames = argc > 2 ? atoi(argv[2]) : 100;
	Display *display = XOpenDisplay(NULL);
	XSetWindowAttributes set = { 0 };
	XVisualInfo *visual;
	GLXContext context;
	Window window;
	double start, used;

	if (!display || !(visual = glXChooseVisual(display, DefaultScreen(display), attributes)))
		return 1;
	set.colormap = XCreateColormap(display, DefaultRootWindow(display), visual->visual, AllocNone);
	window = XCreateWindow(display, DefaultRootWindow(display), 0, 0, 640, 480, 0, visual->depth, InputOutput,
	                       visual->visual, CWColormap, &set);
	context = glXCreateContext(display, visual, NULL, True);
	XMapWindow(display, window);
	glXMakeCurrent(display, window, context);
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_NORMALIZE);
	make_sheet(0);
	start = now_ms();
	used = used_ms();
	for (int frame = 0; frame < frames; frame++) {
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		draw(how, frame);
		glXSwapBuffers(display, window);
	}
	glFinish();
	printf("%.3f %.3f\n", (now_ms() - start) / frames, (used_ms() - used) / frames);
	return 0;
}
