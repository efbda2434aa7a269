/*
 * A Cornell box of exactly 34 triangles: five walls and two boxes, one positional light below the ceiling. Vertex,
 * normal and colour arrays drawn by glDrawArrays, from client memory or from a buffer object (--vbo). With --mirror the
 * red wall is a mirror under a recorder, and an ordinary wall otherwise. --glass adds a box of glass in front,
 * --mesh a model of 100,000 triangles (or --model's) on the short box.
 *
 *   cc -o cornell corpus/cornell.c -lglut -lGLU -lGL -lm
 */
#include <math.h>
#include <stddef.h>

#include "mesh.h"
#include "program.h"

enum { N_TRIANGLES = 34, RED_WALL_VERTICES = 6, GLASS_VERTICES = 36 };

struct vertex {
	float position[3], normal[3], color[3];
};

static struct vertex vertices[3 * N_TRIANGLES + GLASS_VERTICES];
static size_t n_vertices;
static struct mesh model;

static const float white[3] = { 0.8f, 0.8f, 0.8f }, red[3] = { 0.8f, 0.1f, 0.1f }, green[3] = { 0.1f, 0.7f, 0.15f };

/** Two triangles; corners run counter-clockwise seen from the side of the normal. */
static void add_quad(const float corners[4][3], const float color[3])
{
	static const int order[6] = { 0, 1, 2, 0, 2, 3 };
	float u[3], v[3], normal[3], length;

	for (int k = 0; k < 3; k++) {
		u[k] = corners[1][k] - corners[0][k];
		v[k] = corners[3][k] - corners[0][k];
	}
	normal[0] = u[1] * v[2] - u[2] * v[1];
	normal[1] = u[2] * v[0] - u[0] * v[2];
	normal[2] = u[0] * v[1] - u[1] * v[0];
	length = sqrtf(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
	for (int i = 0; i < 6; i++, n_vertices++)
		for (int k = 0; k < 3; k++) {
			vertices[n_vertices].position[k] = corners[order[i]][k];
			vertices[n_vertices].normal[k] = normal[k] / length;
			vertices[n_vertices].color[k] = color[k];
		}
}

/** The room: x, y and z from -1 to 1, open towards the viewer (+z). The red wall comes first. */
static void add_walls(void)
{
	add_quad((const float[4][3]){ { -1, -1, 1 }, { -1, -1, -1 }, { -1, 1, -1 }, { -1, 1, 1 } }, red);
	add_quad((const float[4][3]){ { 1, -1, -1 }, { 1, -1, 1 }, { 1, 1, 1 }, { 1, 1, -1 } }, green);
	add_quad((const float[4][3]){ { -1, -1, 1 }, { 1, -1, 1 }, { 1, -1, -1 }, { -1, -1, -1 } }, white);
	add_quad((const float[4][3]){ { -1, 1, -1 }, { 1, 1, -1 }, { 1, 1, 1 }, { -1, 1, 1 } }, white);
	add_quad((const float[4][3]){ { -1, -1, -1 }, { 1, -1, -1 }, { 1, 1, -1 }, { -1, 1, -1 } }, white);
}

/** A box at height `bottom`, rotated about the vertical. */
static void add_box(float x, float z, float half_width, float bottom, float height, float turn_deg)
{
	/* bits of a corner: 1 right, 2 top, 4 front */
	static const int faces[6][4] = { { 4, 5, 7, 6 }, { 1, 0, 2, 3 }, { 5, 1, 3, 7 },
	                                 { 0, 4, 6, 2 }, { 6, 7, 3, 2 }, { 0, 1, 5, 4 } };
	float c = cosf(turn_deg * 0.01745329252f), s = sinf(turn_deg * 0.01745329252f);

	for (int f = 0; f < 6; f++) {
		float corners[4][3];

		for (int i = 0; i < 4; i++) {
			float dx = faces[f][i] & 1 ? half_width : -half_width;
			float dz = faces[f][i] & 4 ? half_width : -half_width;

			corners[i][0] = x + c * dx + s * dz;
			corners[i][1] = bottom + (faces[f][i] & 2 ? height : 0) - 1;
			corners[i][2] = z - s * dx + c * dz;
		}
		add_quad((const float(*)[3])corners, white);
	}
}

static GLuint buffer; /* 0: client memory */

/** Set the arrays of the box and its walls. */
static void point_at_box(void)
{
	const char *base = buffer ? NULL : (const char *)vertices;

	glBindBuffer(GL_ARRAY_BUFFER, buffer);
	glVertexPointer(3, GL_FLOAT, sizeof(struct vertex), base + offsetof(struct vertex, position));
	glNormalPointer(GL_FLOAT, sizeof(struct vertex), base + offsetof(struct vertex, normal));
	glColorPointer(3, GL_FLOAT, sizeof(struct vertex), base + offsetof(struct vertex, color));
	glEnableClientState(GL_VERTEX_ARRAY);
	glEnableClientState(GL_NORMAL_ARRAY);
	glEnableClientState(GL_COLOR_ARRAY);
}

static void init(void)
{
	add_walls();
	add_box(-0.35f, -0.35f, 0.3f, 0, 1.2f, 18);
	add_box(0.37f, 0.3f, 0.3f, 0, 0.6f, -17);
	add_box(-0.3f, 0.6f, 0.22f, 0.02f, 0.7f, 30); /* the glass; a gap separates its bottom from the floor */
	if (program.mesh)
		model = mesh_load(program.model, 500, 100);

	if (program.vbo) {
		glGenBuffers(1, &buffer);
		glBindBuffer(GL_ARRAY_BUFFER, buffer);
		glBufferData(GL_ARRAY_BUFFER, sizeof(vertices), vertices, GL_STATIC_DRAW);
	}
	point_at_box();

	glEnable(GL_DEPTH_TEST);
	glEnable(GL_LIGHTING);
	glEnable(GL_LIGHT0);
	glEnable(GL_COLOR_MATERIAL);
	glLightfv(GL_LIGHT0, GL_AMBIENT, (const float[]){ 0.1f, 0.1f, 0.1f, 1 });
	program_perspective(45, 0.1, 20);
}

static void draw_model(void)
{
	glPushMatrix();
	glTranslatef(0.37f, -0.07f, 0.3f);
	glScalef(0.32f, 0.32f, 0.32f);
	glEnable(GL_NORMALIZE);
	glDisableClientState(GL_COLOR_ARRAY);
	glColor3f(0.8f, 0.7f, 0.3f);
	glBindBuffer(GL_ARRAY_BUFFER, 0);
	glVertexPointer(3, GL_FLOAT, 0, model.positions);
	glNormalPointer(GL_FLOAT, 0, model.normals);
	glDrawElements(GL_TRIANGLES, (GLsizei)(3 * model.n_triangles), GL_UNSIGNED_INT, model.triangles);
	point_at_box();
	glDisable(GL_NORMALIZE);
	glPopMatrix();
}

static void draw(void)
{
	float turn = 0.1f * (float)program_frame;
	float eye[2] = { 0, 0 }, light[4] = { 0, 0.85f, 0, 1 };

	if (program.animate_camera) {
		eye[0] = 0.6f * sinf(turn);
		eye[1] = 0.3f * sinf(0.7f * turn);
	}
	if (program.animate_light) {
		light[0] = 0.5f * sinf(turn);
		light[2] = 0.5f * cosf(turn);
	}
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glLoadIdentity();
	gluLookAt(eye[0], eye[1], 3.6, 0, 0, 0, 0, 1, 0);
	glLightfv(GL_LIGHT0, GL_POSITION, light);

	if (program.mirror)
		rtMaterialEXT(RT_MIRROR_EXT, 0.9f, 1);
	glDrawArrays(GL_TRIANGLES, 0, RED_WALL_VERTICES);
	rtMaterialEXT(RT_MATTE_EXT, 0, 1);
	glDrawArrays(GL_TRIANGLES, RED_WALL_VERTICES, 3 * N_TRIANGLES - RED_WALL_VERTICES);
	if (program.mesh)
		draw_model();
	if (program.glass) {
		rtMaterialEXT(RT_GLASS_EXT, 0.9f, 1.5f);
		glDrawArrays(GL_TRIANGLES, 3 * N_TRIANGLES, GLASS_VERTICES);
		rtMaterialEXT(RT_MATTE_EXT, 0, 1);
	}
}

int main(int argc, char **argv)
{
	program_run(argc, argv, "Cornell box", init, draw);
	return 0;
}
