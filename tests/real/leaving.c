/*
 * leaving [DEPTH_BITS]: triangles that leave the view volume on all sides and behind the viewer, under matrices made by
 * every call that makes one; some are drawn twice with polygon offset; and smooth lines. Recorded by test_leaving.py.
 */
#include "tests/trace/window.h"

#define FRAMES 12

static void quad(const float *corners)
{
	glBegin(GL_QUADS);
	for (int i = 0; i < 4; i++)
		glVertex3fv(corners + 3 * i);
	glEnd();
}

/* A ground, a wall along each side that passes the viewer, and a far wall. */
static void hall(int offset, const float *side)
{
	static const float ground[12] = { -100, -0.1f, 1000, 400, -0.1f, 1000, 275, -0.1f, -50, -100, -0.1f, -50 };
	static const float left[12] = { -20, -0.1f, 150, -20, 7, 150, -20, 7, -300, -20, -0.1f, -300 };
	static const float right[12] = { 30, 9, 40, 30, -3, 40, 25, -3, -700, 35, 9, -700 };
	static const float far[12] = { -300, -20, -333, 200, -20, -400, 200, 30, -400, -300, 30, -333 };

	glColor3f(0.2f, 0.8f, 0.4f);
	quad(ground);
	glColor3f(1, 0.6f, 0);
	quad(left);
	glColor3fv(side);
	quad(right);
	glColor3f(0.6f, 0.6f, 0.8f);
	quad(far);
	if (!offset)
		return;
	/* the same place again: visible if the offset brings it nearer */
	glEnable(GL_POLYGON_OFFSET_FILL);
	glPolygonOffset(offset > 0 ? -1.0f : 0.5f, offset > 0 ? 0.0f : -3.0f);
	glColor3f(0, 0, 0.4f);
	quad(left);
	glColor3f(0.8f, 0, 0.4f);
	quad(far);
	glDisable(GL_POLYGON_OFFSET_FILL);
}

/* Smooth lines above the walls, from far away to behind the viewer. */
static void rails(void)
{
	glEnable(GL_LINE_SMOOTH);
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	glDepthMask(GL_FALSE);
	glBegin(GL_LINES);
	glColor3f(1, 1, 1);
	glVertex3f(-19, 6, 150);
	glVertex3f(-19, 6, -300);
	glColor3f(1, 1, 0.2f);
	glVertex3f(24, 8, 40);
	glVertex3f(-15, 3, -120);
	glEnd();
	glDepthMask(GL_TRUE);
	glDisable(GL_BLEND);
	glDisable(GL_LINE_SMOOTH);
}

/* A lit panel in front; the squares of its short normals underflow. */
static void faint(void)
{
	static const float short_normal[3] = { 1.88677596e-21f, 1e-21f, 2e-21f }, away[3] = { -2e-21f, -1e-21f, -1e-21f };

	glLoadIdentity();
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glEnable(GL_NORMALIZE);
	glBegin(GL_QUADS);
	glNormal3fv(short_normal);
	glVertex3f(-15, -9, 320);
	glVertex3f(-5, -9, 320);
	glNormal3fv(away);
	glVertex3f(-5, 2, 320);
	glVertex3f(-15, 2, 320);
	glEnd();
	glDisable(GL_LIGHTING);
}

static void frame(int n)
{
	static const float blue[3] = { 0.4f, 0.2f, 1 }, between[3] = { 0.9f, 0.3f, 0.1f }; /* two numbers of 8 bits
	                                                                                      each */
	const float angle = 31.0f * (float)n, transposed[16] = { 1, 0, 0, 0, 0, 0.8f, -0.6f, 0, 0, 0.6f, 0.8f, 0, 0, 0, 0, 1 };

	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	if (n % 4 == 3)
		glOrtho(-17.3, 21.7, -11.1, 13.3, -1000.0 / 3, 700.0 / 3);
	else
		glFrustum(-0.29436624050140381, 0.31, -0.2180715799331665, 0.21, 1, n % 4 == 1 ? 10000 : 700);
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	glRotatef(angle / 9, 1, 0, 0);
	glRotatef(angle, 0, n & 1 ? -1 : 1, 0);
	glRotated(angle / 7, 0, 0, 3);
	glRotatef(angle / 5, 1, 2, n % 3 ? 0.3f : 0);
	if (n % 5 == 4)
		glMultTransposeMatrixf(transposed);
	glScalef(1, 1.1f, 0.9f);
	glTranslatef(0.1f * (float)n, -5.9f, 33.3f);
	hall(n % 3 - 1, n % 4 == 3 ? between : blue);
	rails();
	if (n % 4 == 3)
		faint();
}

int main(int argc, char **argv)
{
	int bits = argc > 1 ? atoi(argv[1]) : 24;
	int attributes[] = { GLX_RGBA, GLX_DOUBLEBUFFER, GLX_DEPTH_SIZE, bits, None };

	if (bits > 24)
		window_kind = "a depth buffer of more than 24 bits";
	open_window_of(attributes);
	glEnable(GL_DEPTH_TEST);
	glClearColor(0.3f, 0.9f, 0.7f, 0);
	for (int n = 0; n < FRAMES; n++) {
		frame(n);
		end_frame();
	}
	return 0;
}
