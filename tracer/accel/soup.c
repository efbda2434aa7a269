#include "tracer/accel/soup.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "kernels/rays/rays.h"

/* Convert a homogeneous position to a point. Clears *bounded if w <= 0. @return 0: it is not finite */
static int point_of(const float p[4], float out[3], int *bounded)
{
	if (p[3] == 1.0f) {
		memcpy(out, p, 3 * sizeof(*out));
	} else if (p[3] > 0) {
		for (int a = 0; a < 3; a++)
			out[a] = p[a] / p[3];
	} else {
		*bounded = 0;
		return isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]) && isfinite(p[3]);
	}
	for (int a = 0; a < 3; a++)
		if (!(fabsf(out[a]) < SOUP_UNBOUNDED))
			return 0;
	return 1;
}

/* Fill in one triangle and its box. @return 0: leave it out */
static int set_triangle(const float (*positions)[4], const uint32_t vertex[3], uint32_t primitive,
                        struct triangle *triangle, struct bvh_box *box)
{
	float p[3][3];
	int bounded = 1;

	for (int i = 0; i < 3; i++)
		if (!point_of(positions[vertex[i]], p[i], &bounded))
			return 0;
	memset(triangle, 0, sizeof(*triangle));
	triangle->primitive = primitive;
	memcpy(triangle->vertex, vertex, sizeof(triangle->vertex));
	for (int a = 0; a < 3; a++) {
		if (!bounded) {
			box->lo[a] = -SOUP_UNBOUNDED;
			box->hi[a] = SOUP_UNBOUNDED;
			continue;
		}
		triangle->v0[a] = p[0][a];
		triangle->e1[a] = p[1][a] - p[0][a];
		triangle->e2[a] = p[2][a] - p[0][a];
		box->lo[a] = fminf(p[0][a], fminf(p[1][a], p[2][a]));
		box->hi[a] = fmaxf(p[0][a], fmaxf(p[1][a], p[2][a]));
	}
	for (int a = 0; a < 3 && bounded; a++) {
		/* A hit may lie this far outside the triangle (kernels/rays/rays.h): rounding must not hide it. */
		const float pad = RAYS_EDGE_SLACK * (fabsf(triangle->e1[a]) + fabsf(triangle->e2[a])) +
		                  2.5e-7f * fmaxf(fabsf(box->lo[a]), fabsf(box->hi[a]));

		box->lo[a] -= pad;
		box->hi[a] += pad;
	}
	return 1;
}

int soup_make(const struct scene_mesh *mesh, const float (*positions)[4], struct soup *out)
{
	*out = (struct soup){ .bounded = 1 };
	bvh_box_clear(&out->box);
	out->triangles = malloc((mesh->primitive_count + 1) * sizeof(*out->triangles));
	out->boxes = malloc((mesh->primitive_count + 1) * sizeof(*out->boxes));
	if (!out->triangles || !out->boxes)
		return err_report(ERR_SYSTEM, NULL, "acceleration structures: out of memory");
	for (uint32_t i = 0; i < mesh->primitive_count; i++)
		out->n += (uint32_t)set_triangle(positions, mesh->index + 3 * (size_t)i, i, &out->triangles[out->n],
		                                 &out->boxes[out->n]);
	for (uint32_t i = 0; i < out->n; i++) {
		bvh_box_join(&out->box, &out->boxes[i]);
		out->bounded &= out->boxes[i].hi[0] < SOUP_UNBOUNDED;
	}
	return 0;
}

void soup_free(struct soup *soup)
{
	free(soup->triangles);
	free(soup->boxes);
	*soup = (struct soup){ NULL };
}
