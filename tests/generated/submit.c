#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "tests/generated/generated.h"

static unsigned choose_attributes(struct chance *chance)
{
	return chance_of(chance, 2) ? WITH_ALL & ~(unsigned)WITH_EDGE : chance_below(chance, WITH_ALL + 1);
}

enum { COLOR_4UB, COLOR_3FV, COLOR_4FV, N_COLORS };

/* @return one of the kinds, or N_COLORS for any, vertex by vertex. If an attribute grows, Mesa restarts the
 * primitive, including strips and stipple, and loses vertices of lists. */
static unsigned choose_color(struct chance *chance, GLenum primitive)
{
	GLint list = 0;

	glGetIntegerv(GL_LIST_INDEX, &list);
	return chance_below(chance,
	                    (primitive == GL_TRIANGLES || primitive == GL_QUADS) && !list ? N_COLORS + 1 : N_COLORS);
}

static void give_color(const float color[4], unsigned command)
{
	if (command == COLOR_4UB)
		glColor4ub((GLubyte)(color[0] * 255), (GLubyte)(color[1] * 255), (GLubyte)(color[2] * 255),
		           (GLubyte)(color[3] * 255));
	else if (command == COLOR_3FV)
		glColor3fv(color);
	else
		glColor4fv(color);
}

static void give_vertex(struct chance *chance, const struct vertex *vertex, unsigned with, unsigned color)
{
	if (with & WITH_NORMAL)
		glNormal3fv(vertex->normal);
	if (with & WITH_COLOR)
		give_color(vertex->color, color == N_COLORS ? chance_below(chance, N_COLORS) : color);
	if (with & WITH_TEXTURE) {
		glTexCoord4fv(vertex->texture);
		glMultiTexCoord2f(GL_TEXTURE1, vertex->texture[1], vertex->texture[0]);
		glMultiTexCoord3fv(GL_TEXTURE2, vertex->texture);
	}
	if (with & WITH_SECONDARY)
		glSecondaryColor3fv(vertex->secondary);
	if (with & WITH_FOG)
		glFogCoordf(vertex->fog);
	if (with & WITH_EDGE)
		glEdgeFlag(vertex->edge);
	if (vertex->position[3] != 1)
		glVertex4fv(vertex->position);
	else if (chance_of(chance, 4))
		glVertex3d(vertex->position[0], vertex->position[1], vertex->position[2]);
	else
		glVertex3fv(vertex->position);
}

static void submit_immediate(struct chance *chance, const struct mesh *mesh, unsigned with)
{
	const unsigned color = choose_color(chance, mesh->primitive);

	glBegin(mesh->primitive);
	for (unsigned i = 0; i < mesh->n_indices; i++)
		give_vertex(chance, &mesh->vertices[mesh->indices[i]], with, color);
	glEnd();
}

/* Set arrays of struct vertex, at an address or in a buffer. */
static void point_arrays(const char *base, unsigned with)
{
	const GLsizei stride = sizeof(struct vertex);

	glVertexPointer(4, GL_FLOAT, stride, base + offsetof(struct vertex, position));
	glEnableClientState(GL_VERTEX_ARRAY);
	if (with & WITH_NORMAL) {
		glNormalPointer(GL_FLOAT, stride, base + offsetof(struct vertex, normal));
		glEnableClientState(GL_NORMAL_ARRAY);
	}
	if (with & WITH_COLOR) {
		glColorPointer(4, GL_FLOAT, stride, base + offsetof(struct vertex, color));
		glEnableClientState(GL_COLOR_ARRAY);
	}
	for (unsigned unit = 0; with & WITH_TEXTURE && unit < MOST_UNITS; unit++) {
		glClientActiveTexture(GL_TEXTURE0 + unit);
		glTexCoordPointer(unit == 1 ? 2 : 4, GL_FLOAT, stride, base + offsetof(struct vertex, texture));
		glEnableClientState(GL_TEXTURE_COORD_ARRAY);
	}
	if (with & WITH_SECONDARY) {
		glSecondaryColorPointer(3, GL_FLOAT, stride, base + offsetof(struct vertex, secondary));
		glEnableClientState(GL_SECONDARY_COLOR_ARRAY);
	}
	if (with & WITH_FOG) {
		glFogCoordPointer(GL_FLOAT, stride, base + offsetof(struct vertex, fog));
		glEnableClientState(GL_FOG_COORD_ARRAY);
	}
	if (with & WITH_EDGE) {
		glEdgeFlagPointer(stride, base + offsetof(struct vertex, edge));
		glEnableClientState(GL_EDGE_FLAG_ARRAY);
	}
}

/* Draw indices of one of the three types, at an address or in a buffer. */
static void draw_indices(struct chance *chance, const struct mesh *mesh)
{
	GLenum type = ONE_OF(chance, GL_UNSIGNED_INT, GL_UNSIGNED_SHORT, GL_UNSIGNED_BYTE);
	unsigned char bytes[MOST_INDICES];
	unsigned short shorts[MOST_INDICES];
	const void *indices = mesh->indices;
	GLsizei n = (GLsizei)mesh->n_indices;

	if (type == GL_UNSIGNED_BYTE && mesh->n_vertices > 256)
		type = GL_UNSIGNED_SHORT;
	for (unsigned i = 0; i < mesh->n_indices; i++) {
		bytes[i] = (unsigned char)mesh->indices[i];
		shorts[i] = (unsigned short)mesh->indices[i];
	}
	if (type != GL_UNSIGNED_INT)
		indices = type == GL_UNSIGNED_BYTE ? (const void *)bytes : shorts;
	switch (chance_below(chance, 4)) {
	case 0:
		glDrawRangeElements(mesh->primitive, 0, mesh->n_vertices - 1, n, type, indices);
		break;
	case 1: {
		GLuint buffer;
		size_t size = type == GL_UNSIGNED_INT ? 4 : type == GL_UNSIGNED_SHORT ? 2 : 1;

		glGenBuffers(1, &buffer);
		glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer);
		glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(size * mesh->n_indices), indices, GL_STATIC_DRAW);
		glDrawElements(mesh->primitive, n, type, NULL);
		glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
		glDeleteBuffers(1, &buffer);
		break;
	}
	case 2: {
		const void *both[2] = { indices, indices };
		GLsizei counts[2] = { n, 0 };

		glMultiDrawElements(mesh->primitive, counts, type, both, 2);
		break;
	}
	default:
		glDrawElements(mesh->primitive, n, type, indices);
	}
}

static void draw_array(struct chance *chance, const struct mesh *mesh)
{
	GLsizei n = (GLsizei)mesh->n_indices;

	if (chance_of(chance, 3)) {
		glBegin(mesh->primitive);
		for (GLint i = 0; i < n; i++)
			glArrayElement(i);
		glEnd();
	} else if (chance_of(chance, 3)) {
		GLint first[2] = { 0, 0 };
		GLsizei counts[2] = { n, 0 };

		glMultiDrawArrays(mesh->primitive, first, counts, 2);
	} else {
		glDrawArrays(mesh->primitive, 0, n);
	}
}

static void submit_arrays(struct chance *chance, const struct mesh *mesh, unsigned with)
{
	static struct vertex flat[MOST_INDICES];
	int by_index = chance_of(chance, 2), in_buffer = chance_of(chance, 2);
	const struct vertex *vertices = by_index ? mesh->vertices : flat;
	size_t n = by_index ? mesh->n_vertices : mesh->n_indices;
	GLuint buffer = 0;

	for (unsigned i = 0; i < mesh->n_indices; i++)
		flat[i] = mesh->vertices[mesh->indices[i]];
	glPushClientAttrib(GL_CLIENT_ALL_ATTRIB_BITS);
	if (in_buffer) {
		glGenBuffers(1, &buffer);
		glBindBuffer(GL_ARRAY_BUFFER, buffer);
		glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(n * sizeof(*vertices)), NULL, GL_STREAM_DRAW);
		if (chance_of(chance, 2)) {
			memcpy(glMapBuffer(GL_ARRAY_BUFFER, GL_WRITE_ONLY), vertices, n * sizeof(*vertices));
			glUnmapBuffer(GL_ARRAY_BUFFER);
		} else {
			glBufferSubData(GL_ARRAY_BUFFER, 0, (GLsizeiptr)(n * sizeof(*vertices)), vertices);
		}
	}
	point_arrays(in_buffer ? NULL : (const char *)vertices, with);
	if (by_index)
		draw_indices(chance, mesh);
	else
		draw_array(chance, mesh);
	glPopClientAttrib();
	if (in_buffer)
		glDeleteBuffers(1, &buffer);
}

static void submit_interleaved(struct chance *chance, const struct mesh *mesh)
{
	static GLfloat data[MOST_INDICES][12]; /* GL_T2F_C4F_N3F_V3F */

	for (unsigned i = 0; i < mesh->n_indices; i++) {
		const struct vertex *vertex = &mesh->vertices[mesh->indices[i]];

		memcpy(data[i], vertex->texture, 2 * sizeof(GLfloat));
		memcpy(data[i] + 2, vertex->color, 4 * sizeof(GLfloat));
		memcpy(data[i] + 6, vertex->normal, 3 * sizeof(GLfloat));
		for (int k = 0; k < 3; k++)
			data[i][9 + k] = vertex->position[k] / vertex->position[3];
	}
	glPushClientAttrib(GL_CLIENT_VERTEX_ARRAY_BIT);
	glInterleavedArrays(GL_T2F_C4F_N3F_V3F, 0, data);
	draw_array(chance, mesh);
	glPopClientAttrib();
}

/* Edge flags are set again at the end: Relume does not support calling lists with edge flags off, and says so. */
void mesh_submit(struct chance *chance, const struct mesh *mesh)
{
	unsigned with = choose_attributes(chance);

	switch (chance_below(chance, 5)) {
	case 0:
		submit_interleaved(chance, mesh);
		break;
	case 1:
	case 2:
		submit_arrays(chance, mesh, with);
		break;
	default:
		submit_immediate(chance, mesh, with);
	}
	glEdgeFlag(GL_TRUE);
}
