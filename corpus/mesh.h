/*
 * Triangle meshes for the corpus programs: read from an OBJ file, or a generated knot. Meshes are indexed, have one
 * smooth normal per vertex, and are centred and scaled to fit the cube from -1 to 1.
 */
#pragma once

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* All zero: empty. The arrays are never freed: programs show their mesh until they exit. */
struct mesh {
	float (*positions)[3], (*normals)[3]; /* [n_vertices] */
	unsigned (*triangles)[3];             /* [n_triangles]: vertex numbers from 0 */
	size_t n_vertices, n_triangles;
};

/** Make room for element number `count` of an array that mesh_grow grew from NULL. Exits if memory runs out. */
static void *mesh_grow(void *array, size_t count, size_t element_bytes)
{
	/* Room is a power of two, so the array is full only when `count` is 0 or a power of two. */
	if (count & (count - 1))
		return array;
	array = realloc(array, (count ? 2 * count : 1) * element_bytes);
	if (!array) {
		fputs("out of memory\n", stderr);
		exit(1);
	}
	return array;
}

static void mesh_add_vertex(struct mesh *m, float x, float y, float z)
{
	m->positions = (float(*)[3])mesh_grow(m->positions, m->n_vertices, sizeof(*m->positions));
	m->positions[m->n_vertices][0] = x;
	m->positions[m->n_vertices][1] = y;
	m->positions[m->n_vertices][2] = z;
	m->n_vertices++;
}

static void mesh_add_triangle(struct mesh *m, unsigned a, unsigned b, unsigned c)
{
	m->triangles = (unsigned(*)[3])mesh_grow(m->triangles, m->n_triangles, sizeof(*m->triangles));
	m->triangles[m->n_triangles][0] = a;
	m->triangles[m->n_triangles][1] = b;
	m->triangles[m->n_triangles][2] = c;
	m->n_triangles++;
}

/**
 * Add a face of an OBJ file ("1/1/1 2//2 -1") as a fan of triangles. Only positions are used; negative ones count from
 * the last vertex so far.
 * @param text  the line after "f"; modified
 * @return 0; -1: a vertex does not exist, or there are fewer than three
 */
static int mesh_read_face(struct mesh *m, char *text)
{
	unsigned fan[3];
	int n = 0;

	for (char *word = strtok(text, " \t\r\n"); word; word = strtok(NULL, " \t\r\n"), n++) {
		long index = strtol(word, NULL, 10);

		if (index < 0)
			index += (long)m->n_vertices + 1;
		if (index < 1 || (size_t)index > m->n_vertices)
			return -1;
		if (n < 2) {
			fan[n] = (unsigned)index - 1;
			continue;
		}
		fan[2] = (unsigned)index - 1;
		mesh_add_triangle(m, fan[0], fan[1], fan[2]);
		fan[1] = fan[2];
	}
	return n < 3 ? -1 : 0;
}

/** Read positions and faces of an OBJ file; ignores other lines. @return 0; -1: unreadable, wrong or without faces */
static int mesh_read_obj(struct mesh *m, const char *path)
{
	FILE *file = fopen(path, "r");
	char line[4096];
	int bad = file == NULL;

	while (!bad && fgets(line, sizeof(line), file)) {
		float x, y, z;

		if (sscanf(line, "v %f %f %f", &x, &y, &z) == 3)
			mesh_add_vertex(m, x, y, z);
		else if (line[0] == 'f' && (line[1] == ' ' || line[1] == '\t'))
			bad = mesh_read_face(m, line + 2) != 0;
	}
	if (file)
		fclose(file);
	return bad || m->n_triangles == 0 ? -1 : 0;
}

/** The point of a (2,3) torus knot at t, 0 to 2 pi. */
static void mesh_knot_center(float t, float out[3])
{
	float r = 2 + cosf(3 * t);

	out[0] = r * cosf(2 * t);
	out[1] = r * sinf(2 * t);
	out[2] = sinf(3 * t);
}

/** A tube along the knot: 2 * along * around triangles. */
static void mesh_make_knot(struct mesh *m, unsigned along, unsigned around)
{
	const float turn = 6.28318530718f, step = 0.001f, radius = 0.45f;

	for (unsigned i = 0; i < along; i++) {
		float t = turn * (float)i / (float)along;
		float c[3], ahead[3], u[3], v[3], w[3], length;

		/*
		 * A frame of the tube: u along it, w and v across it. Two adjacent points, as vectors from the origin, give
		 * both: their difference is u; their sum, not parallel to u, gives w = u x sum; then v = w x u.
		 */
		mesh_knot_center(t, c);
		mesh_knot_center(t + step, ahead);
		for (int k = 0; k < 3; k++) {
			u[k] = (ahead[k] - c[k]) / step;
			v[k] = c[k] + ahead[k];
		}
		w[0] = u[1] * v[2] - u[2] * v[1];
		w[1] = u[2] * v[0] - u[0] * v[2];
		w[2] = u[0] * v[1] - u[1] * v[0];
		length = sqrtf(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
		for (int k = 0; k < 3; k++)
			w[k] /= length;
		v[0] = w[1] * u[2] - w[2] * u[1];
		v[1] = w[2] * u[0] - w[0] * u[2];
		v[2] = w[0] * u[1] - w[1] * u[0];
		length = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
		for (unsigned j = 0; j < around; j++) {
			float a = turn * (float)j / (float)around;
			float cv = radius * cosf(a) / length, cw = radius * sinf(a);

			mesh_add_vertex(m, c[0] + cv * v[0] + cw * w[0], c[1] + cv * v[1] + cw * w[1],
			                c[2] + cv * v[2] + cw * w[2]);
		}
	}
	for (unsigned i = 0; i < along; i++)
		for (unsigned j = 0; j < around; j++) {
			unsigned a = i * around + j, b = i * around + (j + 1) % around;
			unsigned c = (i + 1) % along * around + j, d = (i + 1) % along * around + (j + 1) % around;

			mesh_add_triangle(m, a, b, d);
			mesh_add_triangle(m, a, d, c);
		}
}

/** Centre the mesh and scale it into the cube from -1 to 1. */
static void mesh_fit(struct mesh *m)
{
	float low[3] = { INFINITY, INFINITY, INFINITY }, high[3] = { -INFINITY, -INFINITY, -INFINITY }, size = 0;

	for (size_t i = 0; i < m->n_vertices; i++)
		for (int k = 0; k < 3; k++) {
			low[k] = fminf(low[k], m->positions[i][k]);
			high[k] = fmaxf(high[k], m->positions[i][k]);
		}
	for (int k = 0; k < 3; k++)
		size = fmaxf(size, high[k] - low[k]);
	for (size_t i = 0; i < m->n_vertices; i++)
		for (int k = 0; k < 3; k++)
			m->positions[i][k] = (2 * m->positions[i][k] - low[k] - high[k]) / size;
}

/**
 * Add one normal per vertex: the mean of its triangles' normals, weighted by area. It faces the side where corners run
 * counterclockwise. Exits if memory runs out.
 */
static void mesh_add_normals(struct mesh *m)
{
	m->normals = (float(*)[3])calloc(m->n_vertices, sizeof(*m->normals));
	if (!m->normals) {
		fputs("out of memory\n", stderr);
		exit(1);
	}
	for (size_t i = 0; i < m->n_triangles; i++) {
		const unsigned *t = m->triangles[i];
		float u[3], v[3];

		for (int k = 0; k < 3; k++) {
			u[k] = m->positions[t[1]][k] - m->positions[t[0]][k];
			v[k] = m->positions[t[2]][k] - m->positions[t[0]][k];
		}
		for (int c = 0; c < 3; c++)
			for (int k = 0; k < 3; k++)
				m->normals[t[c]][k] += u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
	}
	for (size_t i = 0; i < m->n_vertices; i++) {
		float *n = m->normals[i], length = sqrtf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);

		for (int k = 0; k < 3 && length > 0; k++)
			n[k] /= length;
	}
}

/**
 * Load the model to show: the OBJ file, or if `path` is NULL, a knot of 2 * along * around triangles. On failure, exits
 * with a line on standard error.
 */
static inline struct mesh mesh_load(const char *path, unsigned along, unsigned around)
{
	struct mesh m = { 0 };

	if (path && mesh_read_obj(&m, path) != 0) {
		fprintf(stderr, "%s: cannot be read as an OBJ file of triangles or polygons\n", path);
		exit(1);
	}
	if (!path)
		mesh_make_knot(&m, along, around);
	mesh_fit(&m);
	mesh_add_normals(&m);
	return m;
}

/** Compile a display list that draws the mesh by glVertex calls. */
static inline GLuint mesh_compile(const struct mesh *m)
{
	const GLuint list = glGenLists(1);

	glNewList(list, GL_COMPILE);
	glBegin(GL_TRIANGLES);
	for (size_t i = 0; i < m->n_triangles; i++)
		for (int c = 0; c < 3; c++) {
			glNormal3fv(m->normals[m->triangles[i][c]]);
			glVertex3fv(m->positions[m->triangles[i][c]]);
		}
	glEnd();
	glEndList();
	return list;
}
