/*
 * cc fixed.c -lEGL -lGLESv1_CM -lX11
 *
 * OpenGL ES 1.0 as on processors without floating point: all numbers are 16.16 fixed point, arrays included. Lit cubes,
 * fog, blending, a textured quad by combiners, wide lines, points, depth range, scissored clears.
 */
#include "window.h"

#define X(v) ((GLfixed)((v) * 65536))

enum { TEXELS = 16, N_CUBE = 36 };

static GLfixed cube[N_CUBE][3], normals[N_CUBE][3];

static void make_cube(void)
{
	static const int order[6] = { 0, 1, 2, 2, 1, 3 };

	for (int face = 0; face < 6; face++)
		for (int k = 0; k < 6; k++) {
			const int axis = face / 2, sign = face % 2 ? 1 : -1, corner = order[sign > 0 ? k : 5 - k];
			GLfixed *v = cube[6 * face + k];

			v[axis] = X(sign);
			v[(axis + 1) % 3] = X(corner % 2 ? 1 : -1);
			v[(axis + 2) % 3] = X(corner / 2 ? 1 : -1);
			normals[6 * face + k][axis] = X(sign);
		}
}

static void make_texture(void)
{
	static GLushort texels[TEXELS][TEXELS];

	for (int y = 0; y < TEXELS; y++)
		for (int x = 0; x < TEXELS; x++)
			texels[y][x] = (GLushort)(x << 12 | y << 8 | ((x ^ y) & 15) << 4 | (x > 3 && y > 3 ? 15 : 6));
	glTexParameterx(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	glTexParameterx(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	glTexParameterx(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, TEXELS, TEXELS, 0, GL_RGBA, GL_UNSIGNED_SHORT_4_4_4_4, texels);
}

static void set_up(void)
{
	static const GLfixed fog[4] = { X(0.2), X(0.1), X(0.3), X(1) }, diffuse[4] = { X(1), X(0.875), X(0.75), X(1) };
	static const GLfixed ambient[4] = { X(0.3), X(0.3), X(0.3), X(1) }, spot[3] = { 0, 0, X(-1) };

	glViewport(0, 0, WIDTH, HEIGHT);
	glMatrixMode(GL_PROJECTION);
	glFrustumx(X(-0.5), X(0.5), X(-0.375), X(0.375), X(1), X(16));
	glMatrixMode(GL_MODELVIEW);
	glClearColorx(X(0.2), X(0.1), X(0.3), X(1));
	glClearDepthx(X(1));
	glDepthRangex(X(0.125), X(0.875));
	glLightModelxv(GL_LIGHT_MODEL_AMBIENT, ambient);
	glLightModelx(GL_LIGHT_MODEL_TWO_SIDE, GL_FALSE);
	glLightxv(GL_LIGHT0, GL_DIFFUSE, diffuse);
	glLightxv(GL_LIGHT0, GL_SPOT_DIRECTION, spot);
	glLightx(GL_LIGHT0, GL_SPOT_CUTOFF, X(35));
	glLightx(GL_LIGHT0, GL_SPOT_EXPONENT, X(4));
	glLightx(GL_LIGHT0, GL_QUADRATIC_ATTENUATION, X(0.0078125));
	glEnable(GL_LIGHT0);
	glFogx(GL_FOG_MODE, GL_EXP);
	glFogx(GL_FOG_DENSITY, X(0.0625));
	glFogxv(GL_FOG_COLOR, fog);
	glEnable(GL_NORMALIZE);
	glEnable(GL_CULL_FACE);
	glPointSizex(X(9));
	glLineWidthx(X(3));
	glPolygonOffsetx(X(-1), X(-1));
	glAlphaFuncx(GL_GREATER, X(0.5));
	make_cube();
	make_texture();
}

static void draw_cubes(int frame)
{
	static const GLfixed position[4] = { 0, 0, 0, X(1) }, shine[4] = { X(1), X(1), X(1), X(1) };

	glLightxv(GL_LIGHT0, GL_POSITION, position);
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_LIGHTING);
	glEnable(GL_FOG);
	glEnable(GL_COLOR_MATERIAL);
	glMaterialxv(GL_FRONT_AND_BACK, GL_SPECULAR, shine);
	glMaterialx(GL_FRONT_AND_BACK, GL_SHININESS, X(12));
	glEnableClientState(GL_VERTEX_ARRAY);
	glEnableClientState(GL_NORMAL_ARRAY);
	glVertexPointer(3, GL_FIXED, 0, cube);
	glNormalPointer(GL_FIXED, 0, normals);
	for (int i = 0; i < 4; i++) {
		glPushMatrix();
		glTranslatex(X(-2.25) + i * X(1.5), X(0.25) - (i % 2) * X(0.5), X(-5) - i * X(0.75));
		glRotatex(X(11) * frame + X(40) * i, X(0.5), X(1), X(0.25));
		glScalex(X(0.5), X(0.625), X(0.5));
		glColor4x(X(1) - i * X(0.25), X(0.5), i * X(0.25), X(1));
		glDrawArrays(GL_TRIANGLES, 0, N_CUBE);
		glPopMatrix();
	}
	glDisableClientState(GL_NORMAL_ARRAY);
	glDisable(GL_COLOR_MATERIAL);
	glDisable(GL_FOG);
	glDisable(GL_LIGHTING);
	glDisable(GL_DEPTH_TEST);
}

static void draw_flat(int frame)
{
	static const GLfixed corners[4][2] = { { 0, 0 }, { X(96), 0 }, { 0, X(80) }, { X(96), X(80) } };
	static const GLfixed texels[4][2] = { { 0, 0 }, { X(1), 0 }, { 0, X(1) }, { X(1), X(1) } };
	static const GLfixed colors[4][4] = {
		{ X(1), 0, 0, X(1) }, { 0, X(1), 0, X(0.75) }, { 0, 0, X(1), X(0.5) }, { X(1), X(1), X(1), X(0.25) }
	};
	static const GLfixed tint[4] = { X(0.25), X(0.5), X(0.75), X(1) };

	glMatrixMode(GL_PROJECTION);
	glPushMatrix();
	glLoadIdentity();
	glOrthox(0, X(WIDTH), 0, X(HEIGHT), X(-1), X(1));
	glMatrixMode(GL_MODELVIEW);
	glTranslatex(X(12) + frame * X(8), X(10), 0);
	glVertexPointer(2, GL_FIXED, 0, corners);
	glTexCoordPointer(2, GL_FIXED, 0, texels);
	glEnableClientState(GL_TEXTURE_COORD_ARRAY);
	glEnable(GL_TEXTURE_2D);
	glEnable(GL_ALPHA_TEST);
	glTexEnvx(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_BLEND);
	glTexEnvxv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, tint);
	glColor4x(X(1), X(0.875), X(0.75), X(1));
	glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
	glDisable(GL_ALPHA_TEST);
	glDisable(GL_TEXTURE_2D);
	glDisableClientState(GL_TEXTURE_COORD_ARRAY);
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	glEnableClientState(GL_COLOR_ARRAY);
	glColorPointer(4, GL_FIXED, 0, colors);
	glTranslatex(X(120), 0, 0);
	glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
	glDisable(GL_BLEND);
	glTranslatex(X(120), X(0.5), 0);
	glDrawArrays(GL_LINE_LOOP, 0, 3);
	glTranslatex(X(3), X(8), 0);
	glDrawArrays(GL_POINTS, 0, 4);
	glDisableClientState(GL_COLOR_ARRAY);
	glMatrixMode(GL_PROJECTION);
	glPopMatrix();
	glMatrixMode(GL_MODELVIEW);
}

static void draw_frame(int frame)
{
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glEnable(GL_SCISSOR_TEST);
	glScissor(300, 220, 80, 60);
	glClearColorx(X(0.5), X(0.75), X(0.0625) * frame, X(1));
	glClear(GL_COLOR_BUFFER_BIT);
	glDisable(GL_SCISSOR_TEST);
	glClearColorx(X(0.2), X(0.1), X(0.3), X(1));
	glLoadIdentity();
	draw_cubes(frame);
	glLoadIdentity();
	draw_flat(frame);
	glDisableClientState(GL_VERTEX_ARRAY);
}
