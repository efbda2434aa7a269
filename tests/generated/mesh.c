#include <math.h>
#include <string.h>

#include "tests/generated/generated.h"

static struct vertex *add_vertex(struct chance *chance, struct mesh *mesh, float x, float y, float z)
{
	struct vertex *vertex = &mesh->vertices[mesh->n_vertices];
	float length = sqrtf(x * x + y * y + z * z);

	if (mesh->n_vertices == MOST_VERTICES)
		return vertex - 1;
	mesh->n_vertices++;
	*vertex = (struct vertex){ .position = { x, y, z, 1 }, .normal = { 0, 0, 1 }, .texture = { x, y, z, 1 } };
	if (length > 0)
		for (int i = 0; i < 3; i++)
			vertex->normal[i] = vertex->position[i] / length;
	chance_color(chance, vertex->color);
	for (int i = 0; i < 3; i++)
		vertex->secondary[i] = chance_between(chance, 0, 0.5f);
	vertex->fog = chance_between(chance, 2, 10);
	vertex->edge = (GLboolean)!chance_of(chance, 4);
	return vertex;
}

static void add_index(struct mesh *mesh, unsigned index)
{
	if (mesh->n_indices < MOST_INDICES)
		mesh->indices[mesh->n_indices++] = index;
}

/* Quads, or two triangles each, between rows + 1 rows of columns + 1 vertices. */
static void add_grid(struct mesh *mesh, unsigned columns, unsigned rows, int quads)
{
	mesh->primitive = quads ? GL_QUADS : GL_TRIANGLES;
	for (unsigned j = 0; j < rows; j++)
		for (unsigned i = 0; i < columns; i++) {
			unsigned a = j * (columns + 1) + i, b = a + 1, c = b + columns + 1, d = c - 1;
			unsigned two[6] = { a, b, c, a, c, d }, one[4] = { a, b, c, d };

			for (int k = 0; k < (quads ? 4 : 6); k++)
				add_index(mesh, quads ? one[k] : two[k]);
		}
}

/* A sheet of columns by rows in the plane z = 0, bent by height. */
static void make_sheet(struct chance *chance, struct mesh *mesh)
{
	unsigned columns = 1 + chance_below(chance, 10), rows = 1 + chance_below(chance, 10);
	float bend = chance_between(chance, -0.6f, 0.6f);
	int quads = chance_of(chance, 2);

	for (unsigned j = 0; j <= rows; j++)
		for (unsigned i = 0; i <= columns; i++) {
			float x = 2 * (float)i / (float)columns - 1, y = 2 * (float)j / (float)rows - 1;
			struct vertex *vertex = add_vertex(chance, mesh, x, y, bend * (x * x - y * y));
			float normal[3] = { -2 * bend * x, 2 * bend * y, 1 };

			memcpy(vertex->normal, normal, sizeof(normal));
			vertex->texture[0] = x * 0.5f + 0.5f;
			vertex->texture[1] = y * 0.5f + 0.5f;
			vertex->texture[2] = bend;
		}
	add_grid(mesh, columns, rows, quads);
}

/* Strips: a ribbon around the y axis. */
static void make_ribbon(struct chance *chance, struct mesh *mesh)
{
	unsigned n = 2 + chance_below(chance, 20);
	float turn = chance_between(chance, 1, 6.28f), twist = chance_between(chance, 0.2f, 1);

	mesh->primitive = ONE_OF(chance, GL_QUAD_STRIP, GL_TRIANGLE_STRIP);
	for (unsigned i = 0; i <= n; i++) {
		float angle = turn * (float)i / (float)n;

		for (int side = -1; side <= 1; side += 2) {
			struct vertex *vertex = add_vertex(chance, mesh, cosf(angle), (float)side * twist * 0.4f,
			                                   sinf(angle));

			vertex->texture[0] = (float)i / (float)n * 3;
			vertex->texture[1] = (float)side * 0.5f + 0.5f;
			add_index(mesh, mesh->n_vertices - 1);
		}
	}
}

/* Fans and convex polygons in the plane z = 0. */
static void make_disc(struct chance *chance, struct mesh *mesh)
{
	unsigned n = 3 + chance_below(chance, 14);
	int fan = chance_of(chance, 2);

	mesh->primitive = fan ? GL_TRIANGLE_FAN : GL_POLYGON;
	if (fan)
		add_vertex(chance, mesh, 0, 0, chance_between(chance, -0.5f, 0.5f));
	for (unsigned i = 0; i < n + (unsigned)fan; i++)
		add_vertex(chance, mesh, cosf(6.2831853f * (float)i / (float)n), sinf(6.2831853f * (float)i / (float)n),
		           0);
	for (unsigned i = 0; i < mesh->n_vertices; i++) {
		struct vertex *vertex = &mesh->vertices[i];

		vertex->normal[0] *= 0.5f;
		vertex->normal[1] *= 0.5f;
		vertex->normal[2] = 0.8f;
		add_index(mesh, i);
	}
}

static void make_ball(struct chance *chance, struct mesh *mesh)
{
	unsigned columns = 3 + chance_below(chance, 12), rows = 2 + chance_below(chance, 10);

	for (unsigned j = 0; j <= rows; j++)
		for (unsigned i = 0; i <= columns; i++) {
			float around = 6.2831853f * (float)i / (float)columns,
			      up = 3.14159265f * (float)j / (float)rows;
			struct vertex *vertex = add_vertex(chance, mesh, sinf(up) * cosf(around), cosf(up),
			                                   sinf(up) * sinf(around));

			vertex->texture[0] = (float)i / (float)columns * 2;
			vertex->texture[1] = (float)j / (float)rows;
		}
	add_grid(mesh, columns, rows, 0);
}

static void make_box(struct chance *chance, struct mesh *mesh)
{
	static const signed char corners[8][3] = { { -1, -1, -1 }, { 1, -1, -1 }, { 1, 1, -1 }, { -1, 1, -1 },
		                                   { -1, -1, 1 },  { 1, -1, 1 },  { 1, 1, 1 },  { -1, 1, 1 } };
	static const unsigned char faces[6][4] = { { 0, 3, 2, 1 }, { 4, 5, 6, 7 }, { 0, 1, 5, 4 },
		                                   { 2, 3, 7, 6 }, { 1, 2, 6, 5 }, { 0, 4, 7, 3 } };

	mesh->primitive = GL_QUADS;
	for (int f = 0; f < 6; f++)
		for (int k = 0; k < 4; k++) {
			const signed char *corner = corners[faces[f][k]];
			struct vertex *vertex = add_vertex(chance, mesh, corner[0] * 0.7f, corner[1] * 0.7f,
			                                   corner[2] * 0.7f);
			int axis = f < 2 ? 2 : f < 4 ? 1 : 0;

			memset(vertex->normal, 0, sizeof(vertex->normal));
			vertex->normal[axis] = corner[axis];
			vertex->texture[0] = k == 1 || k == 2 ? 1 : 0;
			vertex->texture[1] = k > 1 ? 1 : 0;
			add_index(mesh, mesh->n_vertices - 1);
		}
}

/* Lines, points and loose triangles anywhere. */
static void make_loose(struct chance *chance, struct mesh *mesh)
{
	unsigned n = 3 + chance_below(chance, 18);

	mesh->primitive = ONE_OF(chance, GL_POINTS, GL_LINES, GL_LINE_STRIP, GL_LINE_LOOP, GL_TRIANGLES);
	for (unsigned i = 0; i < n; i++) {
		struct vertex *vertex = add_vertex(chance, mesh, chance_between(chance, -1, 1),
		                                   chance_between(chance, -1, 1), chance_between(chance, -1, 1));

		vertex->texture[0] = chance_between(chance, -1, 2);
		add_index(mesh, i);
	}
}

/* Homogeneous positions, texture coordinates with q, normals of other lengths. */
static void vary(struct chance *chance, struct mesh *mesh)
{
	float w = chance_of(chance, 6) ? chance_between(chance, 0.5f, 2) : 1;
	float q = chance_of(chance, 6) ? chance_between(chance, 0.5f, 2) : 1;
	float length = chance_of(chance, 4) ? chance_between(chance, 0.5f, 2) : 1;

	for (unsigned i = 0; i < mesh->n_vertices; i++) {
		struct vertex *vertex = &mesh->vertices[i];

		for (int k = 0; k < 4; k++) {
			vertex->position[k] *= w;
			vertex->texture[k] *= q;
		}
		for (int k = 0; k < 3; k++)
			vertex->normal[k] *= length;
	}
}

void mesh_make(struct chance *chance, struct mesh *mesh)
{
	void (*const shapes[])(struct chance *, struct mesh *) = { make_sheet, make_ribbon, make_disc,
		                                                   make_ball,  make_box,    make_loose };

	mesh->n_vertices = mesh->n_indices = 0;
	shapes[chance_below(chance, sizeof(shapes) / sizeof(shapes[0]))](chance, mesh);
	vary(chance, mesh);
}
