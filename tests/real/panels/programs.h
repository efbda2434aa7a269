/* Shared by the panels of programs: textures, state without default values, a tilted square, assembly programs. */
#pragma once

#include "panels.h"

static GLuint images[7]; /* 2D with all levels, nearest, a cube, 1D, 3D, depths, a cube with all levels */

static inline void fill(unsigned char *texels, unsigned n, unsigned seed)
{
	for (unsigned i = 0; i < n; i++)
		texels[i] = (unsigned char)(255.9f * noise(i + seed));
}

static inline void set_filter(GLenum target, GLint filter)
{
	glTexParameteri(target, GL_TEXTURE_MIN_FILTER, filter);
	glTexParameteri(target, GL_TEXTURE_MAG_FILTER, filter);
}

static inline void make_images(void)
{
	unsigned char texels[32 * 32 * 4];

	fill(texels, sizeof(texels), 7);
	glGenTextures(7, images);
	glBindTexture(GL_TEXTURE_2D, images[0]);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
	for (int level = 0; level < 6; level++)
		glTexImage2D(GL_TEXTURE_2D, level, GL_RGBA, 32 >> level, 32 >> level, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
	glBindTexture(GL_TEXTURE_2D, images[1]);
	set_filter(GL_TEXTURE_2D, GL_NEAREST);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 8, 8, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
	glBindTexture(GL_TEXTURE_CUBE_MAP, images[2]);
	set_filter(GL_TEXTURE_CUBE_MAP, GL_NEAREST);
	for (unsigned face = 0; face < 6; face++)
		glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, GL_RGBA, 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE,
		             texels + 64 * face);
	glBindTexture(GL_TEXTURE_1D, images[3]);
	glTexParameteri(GL_TEXTURE_1D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	glTexImage1D(GL_TEXTURE_1D, 0, GL_RGBA, 16, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
	glBindTexture(GL_TEXTURE_3D, images[4]);
	set_filter(GL_TEXTURE_3D, GL_NEAREST);
	glTexImage3D(GL_TEXTURE_3D, 0, GL_RGBA, 4, 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
	glBindTexture(GL_TEXTURE_2D, images[5]);
	set_filter(GL_TEXTURE_2D, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_R_TO_TEXTURE);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, 8, 8, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_BYTE, texels);
	glBindTexture(GL_TEXTURE_CUBE_MAP, images[6]);
	glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
	for (int level = 0; level < 5; level++)
		for (unsigned face = 0; face < 6; face++)
			glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, level, GL_RGBA, 16 >> level, 16 >> level, 0,
			             GL_RGBA, GL_UNSIGNED_BYTE, texels + 64 * face);
}

/* Set all state that programs read to values other than the defaults. */
static inline void set_state(void)
{
	glMaterialfv(GL_FRONT, GL_SPECULAR, (const float[4]){ 0.9f, 0.4f, 0.1f, 0.7f });
	glMaterialfv(GL_FRONT, GL_EMISSION, (const float[4]){ 0.1f, 0.2f, 0, 0.4f });
	glMaterialfv(GL_BACK, GL_DIFFUSE, (const float[4]){ 0.1f, 0.6f, 0.3f, 0.2f });
	glMaterialf(GL_FRONT, GL_SHININESS, 1.5f);
	glLightfv(GL_LIGHT1, GL_DIFFUSE, (const float[4]){ 0.5f, 0.7f, 1, 0.3f });
	glLightfv(GL_LIGHT1, GL_POSITION, (const float[4]){ 0.5f, 0.7f, 1, 1 });
	glLightf(GL_LIGHT1, GL_LINEAR_ATTENUATION, 0.35f);
	glLightf(GL_LIGHT1, GL_SPOT_CUTOFF, 40);
	glLightf(GL_LIGHT1, GL_SPOT_EXPONENT, 0.8f);
	glTexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, (const float[4]){ 0.2f, 0.7f, 0.4f, 0.3f });
	glTexGenfv(GL_S, GL_OBJECT_PLANE, (const float[4]){ 0.2f, 0.7f, 0.4f, 0.3f });
	glTexGenfv(GL_T, GL_OBJECT_PLANE, (const float[4]){ 0.1f, 0.4f, 0.9f, 0.2f });
	glTexGenfv(GL_R, GL_EYE_PLANE, (const float[4]){ 0.3f, 0.1f, 0.9f, 0.6f });
	glFogfv(GL_FOG_COLOR, (const float[4]){ 0.8f, 0.2f, 0.4f, 0.3f });
	glFogf(GL_FOG_END, 3);
	glPointSize(0.7f);
	glPointParameterfv(GL_POINT_DISTANCE_ATTENUATION, (const float[3]){ 0.3f, 0.6f, 0.9f });
	glClipPlane(GL_CLIP_PLANE1, (const double[4]){ 0.2, 0.4, 0.6, 0.8 });
	glMatrixMode(GL_TEXTURE);
	glActiveTexture(GL_TEXTURE1);
	glTexGenfv(GL_S, GL_EYE_PLANE, (const float[4]){ 0.6f, 0.3f, 0.1f, 0.5f });
	glLoadIdentity();
	glRotatef(30, 0, 0, 1);
	glActiveTexture(GL_TEXTURE0);
	glMatrixMode(GL_MODELVIEW);
}

/* A vertex's attributes at a corner of the unit square, except its position. */
static inline void set_corner(float u, float v)
{
	glColor4f(0.2f + 0.7f * u, 0.9f - 0.6f * v, 0.5f, 0.3f + 0.6f * u);
	glSecondaryColor3f(0.5f * v, 0.1f, 0.3f * u);
	glFogCoordf(0.5f + 2 * v);
	glNormal3f(u - 0.5f, v - 0.5f, 0.7f);
	glMultiTexCoord4f(GL_TEXTURE0, 3.1f * u - 1.33f, 2.6f * v - 1.2f, u - v + 0.03f, 1 + 0.5f * v);
	glMultiTexCoord4f(GL_TEXTURE1, 0.6f - v, 1.3f - 2 * u, 0.7f, u + 0.1f);
	glMultiTexCoord4f(GL_TEXTURE2, 2 * u - 1.1f, 0.9f - 2 * v, 0.3f, 1);
}

static inline void draw_square(int i)
{
	(void)i;
	glBegin(GL_QUADS);
	for (int k = 0; k < 4; k++) {
		const float u = k == 1 || k == 2, v = k >= 2;

		set_corner(u, v);
		glVertex3f(2 * u - 1, 2 * v - 1, -v);
	}
	glEnd();
}

/* Use an assembly program for the following draws, given as the text between its header and END. */
static inline void set_program(GLenum target, const char *header, const char *text)
{
	char whole[8192];
	GLuint program;
	GLint at;

	snprintf(whole, sizeof(whole), "%s\n%s\nEND\n", header, text);
	glGenProgramsARB(1, &program);
	glBindProgramARB(target, program);
	glProgramStringARB(target, GL_PROGRAM_FORMAT_ASCII_ARB, (GLsizei)strlen(whole), whole);
	glGetIntegerv(GL_PROGRAM_ERROR_POSITION_ARB, &at);
	if (at >= 0)
		fprintf(stderr, "%s: %s\n", text, (const char *)glGetString(GL_PROGRAM_ERROR_STRING_ARB));
	glEnable(target);
}
