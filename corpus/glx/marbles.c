/*
 * The program of `make demo`: marbles on a board of two woods, with a camera that moves slowly around them. Uses only
 * OpenGL 1.1 and GLX, for machines without GLUT: a display list, a texture, one light. It has no mirrors, glass or
 * shadows; marbles.look.yaml gives its draws their materials.
 *
 *   cc -o marbles corpus/glx/marbles.c -lGL -lX11 -lm
 *
 *   --frames N   end after N frames (default 60); each run draws the same pictures
 *   --size WxH   of the window (default 480x360)
 */
#include <GL/gl.h>
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SLICES = 64, STACKS = 40, TEXELS = 64 };
static const float pi = 3.14159265f;
static GLuint ball, board;
static int frames = 60, width = 480, height = 360;

/* Draw numbers in marbles.look.yaml: the clear is 1, the board 2, marbles follow in this order. */
static const struct marble {
	float at[2], radius, color[3];
} marbles[] = {
	{ { 0.9f, -1.0f }, 1.0f, { 0.75f, 0.75f, 0.78f } },   /* 3: a mirror */
	{ { -0.75f, 0.75f }, 0.8f, { 0.85f, 0.92f, 0.95f } }, /* 4: glass */
	{ { -1.75f, -0.9f }, 0.55f, { 0.85f, 0.12f, 0.1f } },
	{ { 0.75f, 1.1f }, 0.4f, { 0.95f, 0.7f, 0.08f } },
	{ { 2.2f, 0.35f }, 0.5f, { 0.1f, 0.3f, 0.85f } },
	{ { -0.35f, -1.75f }, 0.45f, { 0.12f, 0.6f, 0.25f } },
	{ { -2.1f, 0.7f }, 0.3f, { 0.9f, 0.9f, 0.85f } },
	{ { 0.15f, 2.0f }, 0.25f, { 0.55f, 0.15f, 0.6f } },
};

static void make_ball(void)
{
	ball = glGenLists(1);
	glNewList(ball, GL_COMPILE);
	glBegin(GL_QUADS);
	for (int stack = 0; stack < STACKS; stack++)
		for (int slice = 0; slice < SLICES; slice++)
			for (int k = 0; k < 4; k++) {
				const float up = pi * (float)(stack + (k == 1 || k == 2)) / STACKS,
					    around = 2 * pi * (float)(slice + k / 2) / SLICES;
				const float at[3] = { sinf(up) * sinf(around), cosf(up), sinf(up) * cosf(around) };

				glNormal3fv(at);
				glVertex3fv(at);
			}
	glEnd();
	glEndList();
}

/* Paint squares of light and dark wood, with a grain. */
static void make_board(void)
{
	static GLubyte texels[TEXELS][TEXELS][3];
	static const float woods[2][3] = { { 232, 200, 150 }, { 120, 66, 36 } };

	for (int y = 0; y < TEXELS; y++)
		for (int x = 0; x < TEXELS; x++) {
			const int dark = (x / (TEXELS / 2) + y / (TEXELS / 2)) % 2;
			const float grain = 1 + 0.06f * sinf((float)y * 0.8f + 2 * sinf((float)x * 0.12f + (float)dark));

			for (int c = 0; c < 3; c++)
				texels[y][x][c] = (GLubyte)fminf(255, woods[dark][c] * grain);
		}
	glGenTextures(1, &board);
	glBindTexture(GL_TEXTURE_2D, board);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, TEXELS, TEXELS, 0, GL_RGB, GL_UNSIGNED_BYTE, texels);
}

static void set_up(void)
{
	const double top = 0.1 * tan(19 * (double)pi / 180), side = top * width / height;

	make_ball();
	make_board();
	glViewport(0, 0, width, height);
	glClearColor(0.42f, 0.6f, 0.82f, 1);
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_CULL_FACE);
	glEnable(GL_NORMALIZE);
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glLightModelfv(GL_LIGHT_MODEL_AMBIENT, (const float[]){ 0.3f, 0.3f, 0.34f, 1 });
	glMatrixMode(GL_PROJECTION);
	glFrustum(-side, side, -top, top, 0.1, 60);
	glMatrixMode(GL_MODELVIEW);
}

static void draw_board(void)
{
	static const float corners[4][2] = { { -4, 4 }, { 4, 4 }, { 4, -4 }, { -4, -4 } };

	glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, (const float[]){ 1, 1, 1, 1 });
	glMaterialfv(GL_FRONT, GL_SPECULAR, (const float[]){ 0, 0, 0, 1 });
	glEnable(GL_TEXTURE_2D);
	glBegin(GL_QUADS);
	glNormal3f(0, 1, 0);
	for (int i = 0; i < 4; i++) {
		glTexCoord2f(corners[i][0] / 2, corners[i][1] / 2);
		glVertex3f(corners[i][0], 0, corners[i][1]);
	}
	glEnd();
	glDisable(GL_TEXTURE_2D);
}

static void draw_marble(const struct marble *m)
{
	glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, (const float[]){ m->color[0], m->color[1], m->color[2], 1 });
	glMaterialfv(GL_FRONT, GL_SPECULAR, (const float[]){ 0.8f, 0.8f, 0.8f, 1 });
	glMaterialf(GL_FRONT, GL_SHININESS, 60);
	glPushMatrix();
	glTranslatef(m->at[0], m->radius, m->at[1]);
	glScalef(m->radius, m->radius, m->radius);
	glCallList(ball);
	glPopMatrix();
}

static void draw_frame(int frame)
{
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glLoadIdentity();
	glTranslatef(0, -0.45f, -8.2f);
	glRotatef(22, 1, 0, 0);
	glRotatef((float)frame - 20, 0, 1, 0);
	glLightfv(GL_LIGHT0, GL_POSITION, (const float[]){ -4.5f, 7, 3, 1 });
	draw_board();
	for (size_t i = 0; i < sizeof(marbles) / sizeof(marbles[0]); i++)
		draw_marble(&marbles[i]);
}

static int parse(int argc, char **argv)
{
	for (int i = 1; i + 1 < argc; i += 2)
		if (strcmp(argv[i], "--frames") == 0)
			frames = atoi(argv[i + 1]);
		else if (strcmp(argv[i], "--size") != 0 || sscanf(argv[i + 1], "%dx%d", &width, &height) != 2)
			return 0;
	return argc % 2 && frames > 0 && width > 0 && height > 0;
}

int main(int argc, char **argv)
{
	int attributes[] = { GLX_RGBA, GLX_DOUBLEBUFFER, GLX_DEPTH_SIZE, 24, None };
	XSetWindowAttributes set = { .colormap = 0 };
	Display *display = XOpenDisplay(NULL);
	XVisualInfo *visual = display ? glXChooseVisual(display, DefaultScreen(display), attributes) : NULL;
	Window window;

	if (!parse(argc, argv)) {
		fprintf(stderr, "usage: %s [--frames N] [--size WxH]\n", argv[0]);
		return 2;
	}
	if (!visual) {
		fprintf(stderr, "no display, or none with OpenGL\n");
		return 1;
	}
	set.colormap = XCreateColormap(display, DefaultRootWindow(display), visual->visual, AllocNone);
	window = XCreateWindow(display, DefaultRootWindow(display), 0, 0, (unsigned)width, (unsigned)height, 0,
	                       visual->depth, InputOutput, visual->visual, CWColormap, &set);
	XStoreName(display, window, "marbles");
	XMapWindow(display, window);
	glXMakeCurrent(display, window, glXCreateContext(display, visual, NULL, True));
	set_up();
	for (int frame = 0; frame < frames; frame++) {
		draw_frame(frame);
		glXSwapBuffers(display, window);
	}
	return 0;
}
