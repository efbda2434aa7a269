/* The first object: a torus, and its shadow volume. */
#include <GL/gl.h>

#include "draw.h"

static const double turn = 6.28318530717958647692;

void torus_matrix(const struct level *level, long frame, float out[16])
{
	double a = turn * (double)frame / 72, c = cos(a), s = sin(a), tilt_c = cos(0.6), tilt_s = sin(0.6);
	struct vec at = level->n_objects ? level->objects[0] : vec(0, 0, 0);
	double columns[4][4] = { { c, 0, -s, 0 },
		                 { s * tilt_s, tilt_c, c * tilt_s, 0 },
		                 { s * tilt_c, -tilt_s, c * tilt_c, 0 },
		                 { at.x, at.y, at.z, 1 } };

	for (int i = 0; i < 16; i++)
		out[i] = (float)columns[i / 4][i % 4];
}

static struct vec torus_point(int around, int across, struct vec *normal)
{
	double a = turn * (around % TORUS_AROUND) / TORUS_AROUND, b = turn * (across % TORUS_ACROSS) / TORUS_ACROSS;

	*normal = vec(cos(a) * cos(b), sin(a) * cos(b), sin(b));
	return vec_mad(vec(0.5 * cos(a), 0.5 * sin(a), 0), *normal, 0.2);
}

/* Corners of a triangle, counter-clockwise from outside, as (around, across); first a quad's lower triangle, then its
 * upper one. */
static void torus_triangle(int i, int corners[3][2])
{
	int around = i / 2 / TORUS_ACROSS, across = i / 2 % TORUS_ACROSS;
	static const int lower[3][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 } }, upper[3][2] = { { 0, 0 }, { 1, 1 }, { 0, 1 } };

	for (int k = 0; k < 3; k++) {
		corners[k][0] = around + (i % 2 ? upper : lower)[k][0];
		corners[k][1] = across + (i % 2 ? upper : lower)[k][1];
	}
}

/* Draws the same triangles as the shadow volume's caps, so that depths agree to the last bit. */
void torus_draw(void)
{
	glBegin(GL_TRIANGLES);
	for (int i = 0; i < N_TORUS_TRIANGLES; i++) {
		int c[3][2];

		torus_triangle(i, c);
		for (int k = 0; k < 3; k++) {
			struct vec n, p = torus_point(c[k][0], c[k][1], &n);

			glTexCoord2d(4.0 * c[k][0] / TORUS_AROUND, 2.0 * c[k][1] / TORUS_ACROSS);
			glNormal3d(n.x, n.y, n.z);
			glVertex3d(p.x, p.y, p.z);
		}
	}
	glEnd();
}

static int faces_light(int triangle, struct vec light)
{
	int c[3][2];
	struct vec p[3], n;

	torus_triangle(triangle, c);
	for (int k = 0; k < 3; k++)
		p[k] = torus_point(c[k][0], c[k][1], &n);
	return vec_dot(vec_cross(vec_sub(p[1], p[0]), vec_sub(p[2], p[0])), vec_sub(light, p[0])) > 0;
}

/* The triangle on the other side of an edge (from corner k to the next). */
static int across_edge(int triangle, int k)
{
	int around = triangle / 2 / TORUS_ACROSS, across = triangle / 2 % TORUS_ACROSS;

	if (triangle % 2) { /* diagonal, upper edge, left edge */
		across += k == 1;
		around += k == 2 ? TORUS_AROUND - 1 : 0;
		return 2 * (around % TORUS_AROUND * TORUS_ACROSS + across % TORUS_ACROSS);
	}
	around += k == 1; /* lower edge, right edge, diagonal */
	across += k == 0 ? TORUS_ACROSS - 1 : 0;
	return 2 * (around % TORUS_AROUND * TORUS_ACROSS + across % TORUS_ACROSS) + 1;
}

static void put(struct vec p)
{
	glVertex3d(p.x, p.y, p.z);
}

void torus_draw_shadow_volume(struct vec light, double reach)
{
	glBegin(GL_TRIANGLES);
	for (int i = 0; i < N_TORUS_TRIANGLES; i++) {
		struct vec near[3], far[3], n;
		int c[3][2];

		if (!faces_light(i, light))
			continue;
		torus_triangle(i, c);
		for (int k = 0; k < 3; k++) {
			near[k] = torus_point(c[k][0], c[k][1], &n);
			far[k] = vec_mad(near[k], vec_unit(vec_sub(near[k], light)), reach);
		}
		for (int k = 0; k < 3; k++)
			put(near[k]);
		for (int k = 2; k >= 0; k--)
			put(far[k]);
		for (int k = 0; k < 3; k++) { /* sides along the silhouette */
			int next = (k + 1) % 3;

			if (faces_light(across_edge(i, k), light))
				continue;
			put(near[next]);
			put(near[k]);
			put(far[k]);
			put(near[next]);
			put(far[k]);
			put(far[next]);
		}
	}
	glEnd();
}
