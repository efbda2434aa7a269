/*
 * A window with two views and a board over both, as toolkits compose them; each view has a floor, a box on it and a
 * lamp. All frames look the same but are made differently: drawn directly; through framebuffer objects; the objects
 * shown again; by a blit; with objects drawn after they are shown; and then shown again up to the given number of
 * frames. Recorded by test_composed.py.
 */
#include "tests/trace/window.h"

enum { N_VIEWS = 2 };

static const int places[N_VIEWS][2] = { { 9, 17 }, { 141, 31 } }, size[2] = { 120, 100 };
static GLuint objects[N_VIEWS], colors[N_VIEWS], depths[N_VIEWS];

static void box(float x, float y, float z, float r)
{
	glBegin(GL_QUADS);
	glNormal3f(0, 1, 0);
	for (int i = 0; i < 4; i++)
		glVertex3f(x + (i == 2 || i == 3 ? r : -r), y, z + (i == 1 || i == 2 ? r : -r));
	glEnd();
}

/* Draws into the current viewport and scissor. */
static void view(int number)
{
	const float lamp[4] = { number ? -1.0f : 1.0f, 3, 1, 1 };

	glClearColor(0.25f, 0.5f, number ? 0.5f : 0.75f, 1);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_LIGHTING);
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glFrustum(-0.5, 0.5, -0.5, 0.5, 1, 20);
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	glTranslatef(0, -0.5f, -5);
	glRotatef(35, 1, 0, 0);
	glLightfv(GL_LIGHT0, GL_POSITION, lamp);
	box(0, 0, 0, 2);
	box(number ? 0.5f : -0.5f, 1, 0, 0.5f);
	glDisable(GL_LIGHTING);
	glDisable(GL_DEPTH_TEST);
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
}

static void draw_there(void)
{
	glEnable(GL_SCISSOR_TEST);
	for (int i = 0; i < N_VIEWS; i++) {
		glViewport(places[i][0], places[i][1], size[0], size[1]);
		glScissor(places[i][0], places[i][1], size[0], size[1]);
		view(i);
	}
	glDisable(GL_SCISSOR_TEST);
}

static void draw_objects(void)
{
	glViewport(0, 0, size[0], size[1]);
	for (int i = 0; i < N_VIEWS; i++) {
		glBindFramebuffer(GL_FRAMEBUFFER, objects[i]);
		view(i);
	}
	glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

static void show(int number)
{
	const float x = (float)places[number][0], y = (float)places[number][1];

	glViewport(0, 0, window_size[0], window_size[1]);
	glMatrixMode(GL_PROJECTION);
	glOrtho(0, window_size[0], 0, window_size[1], -1, 1);
	glBindTexture(GL_TEXTURE_2D, colors[number]);
	glEnable(GL_TEXTURE_2D);
	glColor3f(1, 1, 1);
	glBegin(GL_QUADS);
	for (int i = 0; i < 4; i++) {
		const int right = i == 1 || i == 2, high = i >= 2;

		glTexCoord2i(right, high);
		glVertex2f(x + (float)(right * size[0]), y + (float)(high * size[1]));
	}
	glEnd();
	glDisable(GL_TEXTURE_2D);
	glLoadIdentity();
	glMatrixMode(GL_MODELVIEW);
}

static void blit(int number)
{
	glBindFramebuffer(GL_READ_FRAMEBUFFER, objects[number]);
	glBlitFramebuffer(0, 0, size[0], size[1], places[number][0], places[number][1], places[number][0] + size[0],
	                  places[number][1] + size[1], GL_COLOR_BUFFER_BIT, GL_NEAREST);
	glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
}

/* Half transparent, covering part of both views. */
static void board(void)
{
	glViewport(0, 0, window_size[0], window_size[1]);
	glEnable(GL_BLEND);
	glColor4f(0.75f, 0.25f, 0, 0.5f);
	glRectf(-0.5f, -0.75f, 0.5f, -0.5f);
	glDisable(GL_BLEND);
}

static void make_objects(void)
{
	glGenFramebuffers(N_VIEWS, objects);
	glGenTextures(N_VIEWS, colors);
	glGenRenderbuffers(N_VIEWS, depths);
	for (int i = 0; i < N_VIEWS; i++) {
		glBindTexture(GL_TEXTURE_2D, colors[i]);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
		glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, size[0], size[1], 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
		glBindRenderbuffer(GL_RENDERBUFFER, depths[i]);
		glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, size[0], size[1]);
		glBindFramebuffer(GL_FRAMEBUFFER, objects[i]);
		glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colors[i], 0);
		glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depths[i]);
	}
	glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

int main(int argc, char **argv)
{
	const int frames = argc > 1 ? atoi(argv[1]) : 5;

	window_size[0] = 280;
	window_size[1] = 140;
	open_window();
	make_objects();
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	glEnable(GL_LIGHT0);
	for (int frame = 0; frame < frames; frame++) {
		if (frame == 1 || frame == 3)
			draw_objects();
		glClearColor(0, 0.25f, 0, 1);
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		if (!frame)
			draw_there();
		for (int i = 0; frame && i < N_VIEWS; i++)
			if (frame >= 3 && frame % 2 && i)
				blit(i);
			else
				show(i);
		if (frame == 4) /* too late for this frame */
			draw_objects();
		board();
		end_frame();
	}
	return 0;
}
