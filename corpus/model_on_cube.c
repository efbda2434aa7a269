/*
 * A model on a cube on a plate, one light from the side: a plain scene to check that shadows fall where they should.
 * The model is drawn from client arrays, the cube and the plate in immediate mode.
 *
 *   cc -o model_on_cube corpus/model_on_cube.c -lglut -lGLU -lGL -lm
 */
#include "mesh.h"
#include "program.h"

static struct mesh model;

static void init(void)
{
	model = mesh_load(program.model, 512, 48);
	glClearColor(0.5f, 0.6f, 0.7f, 1);
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_CULL_FACE);
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glEnable(GL_NORMALIZE);
	program_perspective(40, 1, 50);
}

/** The plate in pieces, as lighting at vertices must vary across it. */
static void draw_plate(void)
{
	enum { PIECES = 16 };
	const float size = 12.0f / PIECES;

	glNormal3f(0, 1, 0);
	for (int i = 0; i < PIECES; i++) {
		float z = -6 + size * (float)i;

		glBegin(GL_QUAD_STRIP);
		for (int j = 0; j <= PIECES; j++) {
			glVertex3f(-6 + size * (float)j, -1, z);
			glVertex3f(-6 + size * (float)j, -1, z + size);
		}
		glEnd();
	}
}

/** GLUT's cube changes the arrays, so they are set for each draw. */
static void draw_model(void)
{
	glVertexPointer(3, GL_FLOAT, 0, model.positions);
	glNormalPointer(GL_FLOAT, 0, model.normals);
	glEnableClientState(GL_VERTEX_ARRAY);
	glEnableClientState(GL_NORMAL_ARRAY);
	glDrawElements(GL_TRIANGLES, (GLsizei)(3 * model.n_triangles), GL_UNSIGNED_INT, model.triangles);
	glDisableClientState(GL_VERTEX_ARRAY);
	glDisableClientState(GL_NORMAL_ARRAY);
}

static void draw(void)
{
	float camera = program_moved(program.animate_camera, 0.05f), light = program_moved(program.animate_light, 0.05f);

	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glLoadIdentity();
	gluLookAt(8 * sinf(camera), 5, 8 * cosf(camera), 0, 0.5, 0, 0, 1, 0);
	glLightfv(GL_LIGHT0, GL_POSITION, (const float[]){ 5 * cosf(light) - 3, 7, 5 * sinf(light) + 4, 1 });

	program_color(0.7f, 0.7f, 0.7f);
	draw_plate();
	program_color(0.3f, 0.4f, 0.8f);
	glutSolidCube(2);
	glTranslatef(0, 2, 0);
	program_color(0.9f, 0.6f, 0.2f);
	draw_model();
}

int main(int argc, char **argv)
{
	program_run(argc, argv, "model on cube", init, draw);
	return 0;
}
