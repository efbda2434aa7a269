/*
 * A typical OBJ viewer: the mesh in a display list of glVertex calls, or as indexed arrays in buffer
 * objects (--vbo), turning in front of a headlight; perspective or parallel projection (--ortho).
 *
 *   cc -o viewer corpus/viewer.c -lglut -lGLU -lGL -lm
 */
#include "mesh.h"
#include "program.h"

static struct mesh model;
static GLuint list;

static void fill_buffers(void)
{
	GLsizeiptr bytes = (GLsizeiptr)(model.n_vertices * sizeof(*model.positions));
	GLuint buffers[2];

	glGenBuffers(2, buffers);
	glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
	glBufferData(GL_ARRAY_BUFFER, 2 * bytes, NULL, GL_STATIC_DRAW);
	glBufferSubData(GL_ARRAY_BUFFER, 0, bytes, model.positions);
	glBufferSubData(GL_ARRAY_BUFFER, bytes, bytes, model.normals);
	glVertexPointer(3, GL_FLOAT, 0, NULL);
	glNormalPointer(GL_FLOAT, 0, (const char *)NULL + bytes);
	glEnableClientState(GL_VERTEX_ARRAY);
	glEnableClientState(GL_NORMAL_ARRAY);
	glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
	glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(model.n_triangles * sizeof(*model.triangles)), model.triangles,
	             GL_STATIC_DRAW);
}

static void init(void)
{
	const double aspect = (double)PROGRAM_WIDTH / PROGRAM_HEIGHT;

	model = mesh_load(program.model, 512, 48);
	if (program.vbo)
		fill_buffers();
	else
		list = mesh_compile(&model);

	glClearColor(0.2f, 0.2f, 0.25f, 1);
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, 1);
	glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, (const float[]){ 0.7f, 0.6f, 0.45f, 1 });
	glMaterialfv(GL_FRONT_AND_BACK, GL_SPECULAR, (const float[]){ 0.4f, 0.4f, 0.4f, 1 });
	glMaterialf(GL_FRONT_AND_BACK, GL_SHININESS, 40);
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	if (program.ortho)
		glOrtho(-1.4 * aspect, 1.4 * aspect, -1.4, 1.4, 1, 10);
	else
		gluPerspective(40, aspect, 1, 10);
	glMatrixMode(GL_MODELVIEW);
}

static void draw(void)
{
	float light[4] = { 2, 0, 0, 10 }; /* divided by w = 10: the viewer's place */

	if (program.animate_light)
		light[0] = 30 * sinf(0.1f * (float)program_frame);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glLoadIdentity();
	glLightfv(GL_LIGHT0, GL_POSITION, light);
	glTranslatef(0, 0, -4);
	glRotatef(20, 1, 0, 0);
	if (program.animate_camera)
		glRotatef(3 * (float)program_frame, 0, 1, 0);
	if (program.vbo)
		glDrawElements(GL_TRIANGLES, (GLsizei)(3 * model.n_triangles), GL_UNSIGNED_INT, NULL);
	else
		glCallList(list);
}

int main(int argc, char **argv)
{
	program_run(argc, argv, "viewer", init, draw);
	return 0;
}
