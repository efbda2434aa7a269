/*
 * Whitted's picture (An Improved Illumination Model for Shaded Display, 1980): a glass sphere in front of a mirror
 * sphere above a checkered floor. The spheres are display lists of strips, the floor is textured. Without a recorder
 * the spheres are plain plastic.
 *
 *   cc -o spheres corpus/spheres.c -lglut -lGLU -lGL -lm
 */
#include <math.h>

#include "program.h"

static GLuint sphere, checkers;

static void make_sphere(void)
{
	GLUquadric *quadric = gluNewQuadric();

	sphere = glGenLists(1);
	glNewList(sphere, GL_COMPILE);
	gluSphere(quadric, 1, 64, 48);
	glEndList();
	gluDeleteQuadric(quadric);
}

static void make_checkers(void)
{
	static const GLubyte texels[4][3] = { { 230, 40, 30 }, { 240, 220, 60 }, { 240, 220, 60 }, { 230, 40, 30 } };

	glGenTextures(1, &checkers);
	glBindTexture(GL_TEXTURE_2D, checkers);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 2, 2, 0, GL_RGB, GL_UNSIGNED_BYTE, texels);
}

static void init(void)
{
	make_sphere();
	make_checkers();
	glClearColor(0.35f, 0.55f, 0.85f, 1);
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	program_perspective(45, 0.5, 60);
}

static void draw_sphere(float x, float y, float z, const float color[4])
{
	glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, color);
	glMaterialfv(GL_FRONT, GL_SPECULAR, (const float[]){ 0.9f, 0.9f, 0.9f, 1 });
	glMaterialf(GL_FRONT, GL_SHININESS, 100);
	glPushMatrix();
	glTranslatef(x, y, z);
	glCallList(sphere);
	glPopMatrix();
}

static void draw_floor(void)
{
	static const float corners[4][2] = { { -6, 4 }, { 6, 4 }, { 6, -20 }, { -6, -20 } };

	glMaterialfv(GL_FRONT, GL_AMBIENT_AND_DIFFUSE, (const float[]){ 1, 1, 1, 1 });
	glMaterialfv(GL_FRONT, GL_SPECULAR, (const float[]){ 0, 0, 0, 1 });
	glEnable(GL_TEXTURE_2D);
	glBegin(GL_QUADS);
	glNormal3f(0, 1, 0);
	for (int i = 0; i < 4; i++) {
		glTexCoord2f(corners[i][0] / 2, corners[i][1] / 2);
		glVertex3f(corners[i][0], -1.3f, corners[i][1]);
	}
	glEnd();
	glDisable(GL_TEXTURE_2D);
}

static void draw(void)
{
	float sway = sinf(program_moved(program.animate_camera, 0.05f)), light = program_moved(program.animate_light, 0.05f);

	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glLoadIdentity();
	gluLookAt(2 * sway, 0.8, 6, 0, 0, 0, 0, 1, 0);
	glLightfv(GL_LIGHT0, GL_POSITION, (const float[]){ -4 * cosf(light), 8, 4 + 4 * sinf(light), 1 });

	rtMaterialEXT(RT_MATTE_EXT, 0, 1);
	draw_floor();
	rtMaterialEXT(RT_MIRROR_EXT, 0.9f, 1);
	draw_sphere(1.1f, 0.1f, -1.2f, (const float[]){ 0.75f, 0.75f, 0.75f, 1 });
	rtMaterialEXT(RT_GLASS_EXT, 0.9f, 1.5f);
	draw_sphere(-0.6f, 0.5f, 1.4f, (const float[]){ 0.85f, 0.9f, 0.95f, 1 });
	rtMaterialEXT(RT_MATTE_EXT, 0, 1);
}

int main(int argc, char **argv)
{
	program_run(argc, argv, "spheres", init, draw);
	return 0;
}
