/*
 * A viewer for test_ci.py. Its picture depends on a file named by its argument, on one that nothing names, on a library
 * that it links, on a variable, on its own code (SHINE), and on key s, which halves all sizes.
 *
 *   cc -DSHINE=0 -o viewer tests/real/ci_viewer.c -L. -lshape -lglut -lGL -lm
 */
#include <GL/glut.h>
#include <stdio.h>
#include <stdlib.h>

float shape_facing(void); /* in libshape.so: 1 or -1 */

static float points[6], scale = 1;
static int frame, frames;

static void read_numbers(const char *path, float *out, int n)
{
	FILE *file = fopen(path, "r");

	for (int i = 0; file && i < n; i++)
		if (fscanf(file, "%f", &out[i]) != 1)
			exit(3);
	if (file)
		fclose(file);
}

static void draw(void)
{
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glLoadIdentity();
	glRotatef((float)frame, 0, 0, 1);
	glScalef(scale, scale, 1);
	glNormal3f(0, 0, shape_facing());
	glBegin(GL_TRIANGLES);
	for (int i = 0; i < 3; i++)
		glVertex2f(points[2 * i], points[2 * i + 1]);
	glEnd();
	glutSwapBuffers();
	if (++frame == frames)
		exit(0);
	glutPostRedisplay();
}

static void take_key(unsigned char key, int x, int y)
{
	(void)x;
	(void)y;
	if (key == 's')
		scale /= 2;
}

int main(int argc, char **argv)
{
	const char *green = getenv("VIEWER_GREEN");
	const float color[4] = { 0.8f, green ? strtof(green, NULL) : 0.2f, SHINE, 1 };

	if (argc < 3)
		return 2;
	glutInit(&argc, argv);
	glutInitDisplayMode(GLUT_DOUBLE | GLUT_DEPTH);
	glutInitWindowSize(96, 64);
	glutCreateWindow("viewer");
	read_numbers(argv[1], points, 6);
	read_numbers("hidden.dat", &scale, 1);
	frames = atoi(argv[2]);
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, color);
	glutDisplayFunc(draw);
	glutKeyboardFunc(take_key);
	glutMainLoop();
}
