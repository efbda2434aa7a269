/*
 * A lit figure in an arena. Walls and floor are textured but not lit by OpenGL: the walls are a backdrop. The light is
 * meant for the figure, and shines through a wall. With --by ball, an unlit lantern hangs beside the figure, and a lit
 * ball hops below it every third frame: the lit geometry then extends to the lantern.
 *
 *   cc -o arena corpus/arena.c -lglut -lGLU -lGL -lm
 */
#include "program.h"

static const float half_size = 10, height = 7;
static GLuint panels;

static void make_panels(void)
{
	enum { SIZE = 64 };
	static GLubyte texels[SIZE][SIZE][3];

	for (int y = 0; y < SIZE; y++)
		for (int x = 0; x < SIZE; x++) {
			int line = x % 32 < 2 || y % 32 < 2;

			texels[y][x][0] = line ? 40 : 90;
			texels[y][x][1] = line ? 160 : 95;
			texels[y][x][2] = line ? 200 : 120;
		}
	glGenTextures(1, &panels);
	glBindTexture(GL_TEXTURE_2D, panels);
	gluBuild2DMipmaps(GL_TEXTURE_2D, GL_RGB, SIZE, SIZE, GL_RGB, GL_UNSIGNED_BYTE, texels);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
}

static void init(void)
{
	make_panels();
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_NORMALIZE);
	glEnable(GL_LIGHT0);
	program_perspective(50, 0.1, 60);
}

/** A wall of the arena between two corners of the floor. */
static void draw_wall(float x0, float z0, float x1, float z1)
{
	glBegin(GL_QUADS);
	glTexCoord2f(0, 0);
	glVertex3f(x0, 0, z0);
	glTexCoord2f(5, 0);
	glVertex3f(x1, 0, z1);
	glTexCoord2f(5, 2);
	glVertex3f(x1, height, z1);
	glTexCoord2f(0, 2);
	glVertex3f(x0, height, z0);
	glEnd();
}

static void draw_arena(void)
{
	const float s = half_size;

	glDisable(GL_LIGHTING);
	glEnable(GL_TEXTURE_2D);
	glColor3f(1, 1, 1);
	glBegin(GL_QUADS);
	for (int i = 0; i < 4; i++) {
		float x = i == 0 || i == 3 ? -1 : 1, z = i < 2 ? 1 : -1;

		glTexCoord2f(5 * x, 5 * z);
		glVertex3f(s * x, 0, s * z);
	}
	glEnd();
	draw_wall(-s, -s, s, -s);
	draw_wall(s, -s, s, s);
	draw_wall(s, s, -s, s);
	draw_wall(-s, s, -s, -s);
	glDisable(GL_TEXTURE_2D);
	glEnable(GL_LIGHTING);
}

static void draw_figure(void)
{
	program_color(0.9f, 0.3f, 0.15f);
	glPushMatrix();
	glRotatef(-90, 1, 0, 0);
	glutSolidCone(1.1, 2.6, 48, 16);
	glPopMatrix();
	program_color(0.85f, 0.8f, 0.7f);
	glTranslatef(0, 2.7f, 0);
	glutSolidSphere(0.75, 48, 32);
}

static void draw_lantern_and_ball(void)
{
	glPushMatrix();
	glTranslatef(8.7f, 2.5f, -2.3f);
	glDisable(GL_LIGHTING);
	glColor3f(0.9f, 0.8f, 0.3f);
	glutSolidCube(0.8);
	glEnable(GL_LIGHTING);
	glPopMatrix();
	if (program_frame % 3 != 2)
		return;
	glPushMatrix();
	glTranslatef(9, 0.5f, -3);
	program_color(0.3f, 0.4f, 0.8f);
	glutSolidSphere(0.5, 32, 16);
	glPopMatrix();
}

static void draw(void)
{
	float walk = program_moved(program.animate_camera, 0.1f);

	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glLoadIdentity();
	gluLookAt(1, 3.2, 0, 6, 1.6, -4, 0, 1, 0);
	glLightfv(GL_LIGHT0, GL_POSITION, (const float[]){ 0.8f, 0.35f, 0.5f, 0 });
	draw_arena();
	if (program.by)
		draw_lantern_and_ball();
	glTranslatef(6, 0, -4 + walk);
	draw_figure();
}

int main(int argc, char **argv)
{
	program_run(argc, argv, "arena", init, draw);
	return 0;
}
