/*
 * One of everything that a fault can break, each in its own draw: a textured floor, a box from client arrays, a lit
 * sphere in a display list, an unlit pyramid, a fence by alpha test, two panes of coloured glass by blending, fog, two
 * lights, culling. The projection is a glFrustum and every transformation is one call, so that a recording is easy to
 * edit.
 *
 *   cc -o still_life corpus/still_life.c -lglut -lGLU -lGL -lm
 */
#include <math.h>

#include "program.h"

enum { TEXELS = 16 };
static GLuint sphere, textures[2];

static void make_textures(void)
{
	static GLubyte floor[TEXELS][TEXELS][3], fence[TEXELS][TEXELS][4];

	for (int y = 0; y < TEXELS; y++) {
		for (int x = 0; x < TEXELS; x++) {
			int bar = x % 8 < 3 || y % 8 < 3;

			floor[y][x][0] = (GLubyte)((x / 2 + y / 2) % 2 ? 220 : 70 + 8 * x);
			floor[y][x][1] = (GLubyte)((x / 2 + y / 2) % 2 ? 200 : 60);
			floor[y][x][2] = (GLubyte)(60 + 10 * y);
			memcpy(fence[y][x], bar ? (GLubyte[]){ 120, 80, 40, 255 } : (GLubyte[]){ 0, 0, 0, 0 }, 4);
		}
	}
	glGenTextures(2, textures);
	for (int i = 0; i < 2; i++) {
		glBindTexture(GL_TEXTURE_2D, textures[i]);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, i ? GL_NEAREST : GL_LINEAR);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, i ? GL_NEAREST : GL_LINEAR);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
	}
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, TEXELS, TEXELS, 0, GL_RGBA, GL_UNSIGNED_BYTE, fence);
	glBindTexture(GL_TEXTURE_2D, textures[0]);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, TEXELS, TEXELS, 0, GL_RGB, GL_UNSIGNED_BYTE, floor);
}

/* A ball of triangles in one Begin and End: one draw. */
static void make_sphere(void)
{
	enum { AROUND = 32, DOWN = 16 };
	const float pi = 3.14159265f;

	sphere = glGenLists(1);
	glNewList(sphere, GL_COMPILE);
	glBegin(GL_QUADS);
	for (int y = 0; y < DOWN; y++) {
		for (int x = 0; x < AROUND; x++) {
			static const int corner[4][2] = { { 0, 0 }, { 0, 1 }, { 1, 1 }, { 1, 0 } };

			for (int c = 0; c < 4; c++) {
				float a = 2 * pi * (float)(x + corner[c][0]) / AROUND, d = pi * (float)(y + corner[c][1]) / DOWN;
				float p[3] = { cosf(a) * sinf(d), cosf(d), -sinf(a) * sinf(d) };

				glNormal3fv(p);
				glVertex3fv(p);
			}
		}
	}
	glEnd();
	glEndList();
}

static void init(void)
{
	make_textures();
	make_sphere();
	glClearColor(0.25f, 0.31f, 0.39f, 1);
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_LIGHT0);
	glEnable(GL_LIGHT1);
	glLightfv(GL_LIGHT1, GL_DIFFUSE, (const float[]){ 0.3f, 0.25f, 0.2f, 1 });
	glEnable(GL_NORMALIZE);
	glEnable(GL_CULL_FACE);
	glFrontFace(GL_CCW);
	glShadeModel(GL_SMOOTH);
	glDepthRange(0, 1);
	glFogi(GL_FOG_MODE, GL_LINEAR);
	glFogf(GL_FOG_START, 6);
	glFogf(GL_FOG_END, 22);
	glFogfv(GL_FOG_COLOR, (const float[]){ 0.25f, 0.31f, 0.39f, 1 });
	glEnable(GL_FOG);
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE);
	glAlphaFunc(GL_GREATER, 0.5f);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glFrustum(-0.4, 0.4, -0.3, 0.3, 1, 40);
	glMatrixMode(GL_MODELVIEW);
}

static void draw_floor(void)
{
	static const float corners[4][2] = { { -8, 5 }, { 8, 5 }, { 8, -14 }, { -8, -14 } };

	glEnable(GL_LIGHTING);
	glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, (const float[]){ 1, 1, 1, 1 });
	glMaterialfv(GL_FRONT, GL_SPECULAR, (const float[]){ 0, 0, 0, 1 });
	glBindTexture(GL_TEXTURE_2D, textures[0]);
	glEnable(GL_TEXTURE_2D);
	glBegin(GL_QUADS);
	glNormal3f(0, 1, 0);
	for (int i = 0; i < 4; i++) {
		glTexCoord2f(corners[i][0] / 4, corners[i][1] / 4);
		glVertex3f(corners[i][0], -1, corners[i][1]);
	}
	glEnd();
	glDisable(GL_TEXTURE_2D);
}

static void draw_box(void)
{
	static float positions[24][3], normals[24][3];
	static GLushort indices[36];

	for (int f = 0; f < 6; f++) {
		int axis = f / 2, side = f % 2;

		for (int c = 0; c < 4; c++) {
			int u = c == 1 || c == 2, v = c >= 2, k = 4 * f + c;

			positions[k][axis] = side ? 0.7f : -0.7f;
			positions[k][(axis + 1) % 3] = (side ? u : v) ? 0.7f : -0.7f;
			positions[k][(axis + 2) % 3] = (side ? v : u) ? 0.7f : -0.7f;
			normals[k][axis] = side ? 1 : -1;
		}
		for (int i = 0; i < 6; i++)
			indices[6 * f + i] = (GLushort)(4 * f + (const int[]){ 0, 1, 2, 0, 2, 3 }[i]);
	}
	glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, (const float[]){ 0.8f, 0.2f, 0.15f, 1 });
	glPushMatrix();
	glTranslatef(-1.6f, -0.3f, -1.2f);
	glRotatef(25, 0, 1, 0);
	glEnableClientState(GL_VERTEX_ARRAY);
	glEnableClientState(GL_NORMAL_ARRAY);
	glVertexPointer(3, GL_FLOAT, 0, positions);
	glNormalPointer(GL_FLOAT, 0, normals);
	glDrawElements(GL_TRIANGLES, 36, GL_UNSIGNED_SHORT, indices);
	glDisableClientState(GL_VERTEX_ARRAY);
	glDisableClientState(GL_NORMAL_ARRAY);
	glPopMatrix();
}

static void draw_sphere(void)
{
	glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, (const float[]){ 0.2f, 0.7f, 0.3f, 1 });
	glMaterialfv(GL_FRONT, GL_SPECULAR, (const float[]){ 0.8f, 0.8f, 0.8f, 1 });
	glMaterialf(GL_FRONT, GL_SHININESS, 40);
	glPushMatrix();
	glTranslatef(0.5f, 0, -2);
	glCallList(sphere);
	glPopMatrix();
	glDisable(GL_LIGHTING);
}

static void draw_pyramid(void)
{
	static const float base[5][2] = {
		{ -0.6f, 0.6f }, { 0.6f, 0.6f }, { 0.6f, -0.6f }, { -0.6f, -0.6f }, { -0.6f, 0.6f }
	};

	glPushMatrix();
	glTranslatef(1.9f, -1, 0);
	glBegin(GL_TRIANGLES);
	for (int i = 0; i < 4; i++) {
		glColor3f(0.9f, 0.8f - 0.15f * (float)i, 0.1f);
		glVertex3f(base[i][0], 0, base[i][1]);
		glColor3f(0.5f, 0.2f, 0.1f + 0.2f * (float)i);
		glVertex3f(base[i + 1][0], 0, base[i + 1][1]);
		glColor3f(1, 1, 0.8f);
		glVertex3f(0, 1.3f, 0);
	}
	glEnd();
	glPopMatrix();
}

static void draw_fence(void)
{
	glColor3f(1, 1, 1);
	glEnable(GL_TEXTURE_2D);
	glEnable(GL_ALPHA_TEST);
	glBindTexture(GL_TEXTURE_2D, textures[1]);
	glBegin(GL_QUADS);
	for (int i = 0; i < 4; i++) {
		int right = i == 1 || i == 2, up = i >= 2;

		glTexCoord2f(right ? 3 : 0, (float)up);
		glVertex3f(right ? 4 : -4, up ? 0.6f : -1, -5);
	}
	glEnd();
	glDisable(GL_ALPHA_TEST);
	glDisable(GL_TEXTURE_2D);
}

static void draw_panes(void)
{
	static const float colors[2][4] = { { 0.9f, 0.3f, 0.2f, 0.4f }, { 0.2f, 0.4f, 0.9f, 0.5f } };

	glEnable(GL_BLEND);
	glDepthMask(GL_FALSE);
	for (int i = 0; i < 2; i++) {
		float x = -0.9f + 0.4f * (float)i, z = 0.6f + 0.4f * (float)i;

		glBegin(GL_QUADS);
		glColor4fv(colors[i]);
		glVertex3f(x, -0.9f, z);
		glVertex3f(x + 0.5f, -0.9f, z);
		glVertex3f(x + 0.5f, 0, z);
		glVertex3f(x, 0, z);
		glEnd();
	}
	glDepthMask(GL_TRUE);
	glDisable(GL_BLEND);
}

static void draw(void)
{
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glLoadIdentity();
	glTranslatef(program.animate_camera ? 0.15f * (float)program_frame : 0, -0.2f, -5);
	glLightfv(GL_LIGHT0, GL_POSITION, (const float[]){ -3, 6, 3, 1 });
	glLightfv(GL_LIGHT1, GL_POSITION, (const float[]){ 4, 2, 4, 1 });
	draw_floor();
	draw_box();
	draw_sphere();
	draw_pyramid();
	draw_fence();
	draw_panes();
}

int main(int argc, char **argv)
{
	program_run(argc, argv, "still life", init, draw);
	return 0;
}
