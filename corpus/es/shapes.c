/*
 * cc shapes.c -lEGL -lGLESv1_CM -lX11 -lm
 *
 * OpenGL ES 1.1 in floats: a lit torus from buffer objects with short indices, a textured floor of bytes from client
 * memory, a second texture by combiners, fog, a user clip plane, two lights.
 */
#include <math.h>

#include "window.h"

enum { RINGS = 24, SIDES = 12, N_INDICES = RINGS * SIDES * 6, TEXELS = 32 };

static GLuint textures[2], buffers[2];

static void make_torus(void)
{
	static GLfloat vertices[(RINGS + 1) * (SIDES + 1)][6];
	static GLushort indices[N_INDICES];
	int n = 0;

	for (int i = 0; i <= RINGS; i++)
		for (int j = 0; j <= SIDES; j++) {
			const float a = 6.2831853f * (float)i / RINGS, b = 6.2831853f * (float)j / SIDES;
			GLfloat *v = vertices[i * (SIDES + 1) + j];

			v[3] = cosf(a) * cosf(b);
			v[4] = sinf(a) * cosf(b);
			v[5] = sinf(b);
			v[0] = cosf(a) + 0.4f * v[3];
			v[1] = sinf(a) + 0.4f * v[4];
			v[2] = 0.4f * v[5];
		}
	for (int i = 0; i < RINGS; i++)
		for (int j = 0; j < SIDES; j++) {
			const GLushort at = (GLushort)(i * (SIDES + 1) + j), next = (GLushort)(at + SIDES + 1);
			const GLushort quad[6] = { at, next, (GLushort)(at + 1), (GLushort)(at + 1), next, (GLushort)(next + 1) };

			memcpy(indices + n, quad, sizeof(quad));
			n += 6;
		}
	glGenBuffers(2, buffers);
	glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
	glBufferData(GL_ARRAY_BUFFER, sizeof(vertices), vertices, GL_STATIC_DRAW);
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
	glBufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof(indices), indices, GL_STATIC_DRAW);
	glBindBuffer(GL_ARRAY_BUFFER, 0);
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
}

static void make_textures(void)
{
	static GLubyte checks[TEXELS][TEXELS][3], glow[TEXELS][TEXELS];

	for (int y = 0; y < TEXELS; y++)
		for (int x = 0; x < TEXELS; x++) {
			const int odd = (x / 8 + y / 8) % 2, dx = 2 * x - TEXELS + 1, dy = 2 * y - TEXELS + 1, d = dx * dx + dy * dy;

			checks[y][x][0] = odd ? 230 : 60;
			checks[y][x][1] = (GLubyte)(odd ? 200 : 70 + 4 * x);
			checks[y][x][2] = odd ? 160 : 120;
			glow[y][x] = (GLubyte)(d < 900 ? 255 - d / 4 : 30);
		}
	glGenTextures(2, textures);
	glBindTexture(GL_TEXTURE_2D, textures[0]);
	glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE);
	glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, TEXELS, TEXELS, 0, GL_RGB, GL_UNSIGNED_BYTE, checks);
	glActiveTexture(GL_TEXTURE1);
	glBindTexture(GL_TEXTURE_2D, textures[1]);
	glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
	glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_LUMINANCE, TEXELS, TEXELS, 0, GL_LUMINANCE, GL_UNSIGNED_BYTE, glow);
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_COMBINE);
	glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB, GL_MODULATE);
	glTexEnvi(GL_TEXTURE_ENV, GL_SRC0_RGB, GL_PREVIOUS);
	glTexEnvi(GL_TEXTURE_ENV, GL_SRC1_RGB, GL_TEXTURE);
	glTexEnvf(GL_TEXTURE_ENV, GL_RGB_SCALE, 2);
	glActiveTexture(GL_TEXTURE0);
}

static void set_up(void)
{
	static const GLfloat fog[4] = { 0.3f, 0.35f, 0.4f, 1 }, warm[4] = { 0.9f, 0.7f, 0.5f, 1 },
			     ambient[4] = { 0.2f, 0.2f, 0.25f, 1 };

	glViewport(0, 0, WIDTH, HEIGHT);
	glMatrixMode(GL_PROJECTION);
	glFrustumf(-0.4f, 0.4f, -0.3f, 0.3f, 1, 20);
	glMatrixMode(GL_MODELVIEW);
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_NORMALIZE);
	glEnable(GL_LIGHT0);
	glEnable(GL_LIGHT1);
	glLightfv(GL_LIGHT1, GL_DIFFUSE, warm);
	glLightf(GL_LIGHT1, GL_LINEAR_ATTENUATION, 0.1f);
	glLightModelfv(GL_LIGHT_MODEL_AMBIENT, ambient);
	glEnable(GL_FOG);
	glFogf(GL_FOG_MODE, GL_LINEAR);
	glFogf(GL_FOG_START, 4);
	glFogf(GL_FOG_END, 14);
	glFogfv(GL_FOG_COLOR, fog);
	glClearColor(fog[0], fog[1], fog[2], 1);
	make_torus();
	make_textures();
}

static void draw_floor(void)
{
	static const GLbyte corners[4][3] = { { -4, -1, -4 }, { 4, -1, -4 }, { -4, -1, 4 }, { 4, -1, 4 } };
	static const GLshort texels[4][2] = { { 0, 0 }, { 4, 0 }, { 0, 4 }, { 4, 4 } };
	static const GLfloat glow[4][2] = { { 0, 0 }, { 1, 0 }, { 0, 1 }, { 1, 1 } };
	static const GLubyte colors[4][4] = {
		{ 255, 255, 255, 255 }, { 200, 255, 200, 255 }, { 200, 200, 255, 255 }, { 255, 220, 200, 255 }
	};

	glEnable(GL_TEXTURE_2D);
	glEnableClientState(GL_TEXTURE_COORD_ARRAY);
	glTexCoordPointer(2, GL_SHORT, 0, texels);
	glActiveTexture(GL_TEXTURE1);
	glEnable(GL_TEXTURE_2D);
	glClientActiveTexture(GL_TEXTURE1);
	glEnableClientState(GL_TEXTURE_COORD_ARRAY);
	glTexCoordPointer(2, GL_FLOAT, 0, glow);
	glEnableClientState(GL_VERTEX_ARRAY);
	glEnableClientState(GL_COLOR_ARRAY);
	glVertexPointer(3, GL_BYTE, 0, corners);
	glColorPointer(4, GL_UNSIGNED_BYTE, 0, colors);
	glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
	glDisableClientState(GL_COLOR_ARRAY);
	glDisableClientState(GL_VERTEX_ARRAY);
	glDisableClientState(GL_TEXTURE_COORD_ARRAY);
	glDisable(GL_TEXTURE_2D);
	glActiveTexture(GL_TEXTURE0);
	glClientActiveTexture(GL_TEXTURE0);
	glDisableClientState(GL_TEXTURE_COORD_ARRAY);
	glDisable(GL_TEXTURE_2D);
}

static void draw_torus(int frame)
{
	static const GLfloat diffuse[4] = { 0.8f, 0.3f, 0.2f, 1 }, specular[4] = { 1, 1, 1, 1 };
	const GLfloat plane[4] = { 0.3f, 1, 0, 0.6f - 0.05f * (float)frame };

	glPushMatrix();
	glRotatef(20 + 9 * (float)frame, 0.3f, 1, 0.2f);
	glMaterialfv(GL_FRONT_AND_BACK, GL_DIFFUSE, diffuse);
	glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, specular);
	glMaterialf(GL_FRONT_AND_BACK, GL_SHININESS, 25);
	glEnable(GL_LIGHTING);
	glClipPlanef(GL_CLIP_PLANE0, plane);
	glEnable(GL_CLIP_PLANE0);
	glLightModelf(GL_LIGHT_MODEL_TWO_SIDE, 1);
	glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
	glEnableClientState(GL_VERTEX_ARRAY);
	glEnableClientState(GL_NORMAL_ARRAY);
	glVertexPointer(3, GL_FLOAT, 24, (void *)0);
	glNormalPointer(GL_FLOAT, 24, (void *)12);
	glDrawElements(GL_TRIANGLES, N_INDICES, GL_UNSIGNED_SHORT, (void *)0);
	glDisableClientState(GL_NORMAL_ARRAY);
	glDisableClientState(GL_VERTEX_ARRAY);
	glBindBuffer(GL_ARRAY_BUFFER, 0);
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
	glDisable(GL_CLIP_PLANE0);
	glDisable(GL_LIGHTING);
	glPopMatrix();
}

static void draw_frame(int frame)
{
	static const GLfloat sun[4] = { 0.5f, 1, 0.8f, 0 }, lamp[4] = { -2, 1, 2, 1 };

	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glLoadIdentity();
	glTranslatef(0, -0.2f, -6);
	glRotatef(25, 1, 0, 0);
	glLightfv(GL_LIGHT0, GL_POSITION, sun);
	glLightfv(GL_LIGHT1, GL_POSITION, lamp);
	glColor4f(1, 1, 1, 1);
	draw_floor();
	draw_torus(frame);
}
