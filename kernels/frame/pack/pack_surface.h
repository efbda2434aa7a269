/*
 * Eye-space positions of sixteen fragments: what point.h does for one, in the same order of operations. OpenCL C only.
 */
#pragma once

#include "kernels/frame/pack/pack.h"

/* The fragments' triangles in eye space, as in struct point_plane. */
struct pack_surface {
	struct vec3_16 corner[3], plane;  /* plane: point_plane_normal */
	packf length[3], area, rounding;  /* set by pack_measure */
};

/* The corners, homogeneous. @return the lanes where some corner has w != 1 */
WIDE_VECTORS static inline packi pack_eyes(const struct tables *t, const struct pack *p, packf (*e)[4])
{
	for (int k = 0; k < 3; k++)
		pack_vertex(t, p, k, (packu)(PACK_EYE), e[k]);
	return (e[0][3] != 1.0f) | (e[1][3] != 1.0f) | (e[2][3] != 1.0f);
}

/* point_corner_about for the lanes `which`. */
WIDE_VECTORS static inline void pack_corners_about(const struct pack *p, packf (*e)[4], packi which,
                                                   struct vec3_16 *corner)
{
	packf of_point[4], w_inv;
	struct vec3_16 at;

	for (int i = 0; i < 4; i++)
		of_point[i] = e[0][i] * p->weight[0] + e[1][i] * p->weight[1] + e[2][i] * p->weight[2];
	w_inv = 1.0f / of_point[3];
	at = v3_scale(v3_16(of_point[0], of_point[1], of_point[2]), w_inv);
	for (int k = 0; k < 3; k++)
		corner[k] = v3_choose(which, v3_scale(v3_add(corner[k], v3_scale(at, of_point[3] - e[k][3])), w_inv),
		                      corner[k]);
}

/* Build the surface from pack_eyes. */
WIDE_VECTORS static inline void pack_surface_through(const struct pack *p, packf (*e)[4], packi bent,
                                                      struct pack_surface *out)
{
	struct vec3_16 n;

	for (int k = 0; k < 3; k++)
		out->corner[k] = v3_16(e[k][0], e[k][1], e[k][2]);
	if (any_pack(bent))
		pack_corners_about(p, e, bent, out->corner);
	n = v3_normalize(v3_cross(v3_sub(out->corner[1], out->corner[0]), v3_sub(out->corner[2], out->corner[0])));
	out->plane = v3_choose(v3_dot(n, n) > 0.0f, n, v3_16(0, 0, 0));
}

WIDE_VECTORS static inline void pack_surface(const struct tables *t, const struct pack *p, struct pack_surface *out)
{
	packf e[3][4];
	const packi bent = pack_eyes(t, p, e);

	pack_surface_through(p, e, bent, out);
}

/* point_place for all lanes. */
WIDE_VECTORS static inline struct vec3_16 pack_place_at(const struct pack_surface *s, const packf *weight)
{
	return v3_add(v3_add(v3_scale(s->corner[0], weight[0]), v3_scale(s->corner[1], weight[1])),
	              v3_scale(s->corner[2], weight[2]));
}

/* The vertices' normals interpolated at the points, of length 1 or 0. */
WIDE_VECTORS static inline struct vec3_16 pack_vertex_normals(const struct tables *t, const struct pack *p)
{
	struct vec3_16 v[3];

	for (int k = 0; k < 3; k++) {
		packf row[4];

		pack_vertex(t, p, k, (packu)(PACK_NORMAL), row);
		v[k] = v3_scale(v3_16(row[0], row[1], row[2]), p->weight[k]);
	}
	return v3_normalize(v3_add(v3_add(v[0], v[1]), v[2]));
}

/* pack_vertex_normals, turned to the side of n; n in lanes whose interpolated normal is 0. */
WIDE_VECTORS static inline struct vec3_16 pack_smooth_normal(const struct tables *t, const struct pack *p,
                                                             struct vec3_16 n)
{
	struct vec3_16 smooth = pack_vertex_normals(t, p);

	smooth = v3_choose(v3_dot(smooth, n) < 0.0f, v3_scale(smooth, (packf)(-1)), smooth);
	return v3_choose(v3_dot(smooth, smooth) > 0.0f, smooth, n);
}

/* point_normal for all lanes. */
WIDE_VECTORS static inline struct vec3_16 pack_normal(const struct tables *t, const struct pack *p,
                                                      const struct pack_surface *s)
{
	const packi seen = p->material->front_face == GL_CW ? p->front : ~p->front;
	const struct vec3_16 n = v3_scale(s->plane, select((packf)(1), (packf)(-1), seen));

	return p->material->lighting || p->material->program_normals ? pack_smooth_normal(t, p, n) : n;
}

/* stage_view_direction for all lanes. */
WIDE_VECTORS static inline struct vec3_16 pack_view_direction(const struct pack *p, uint height)
{
	__global const float *v = p->view->viewport, *m = p->view->inverse;
	const packf nx = 2.0f * (convert_float16(p->x) + 0.5f - v[0]) / v[2] - 1.0f;
	const packf ny = 2.0f * (convert_float16((int)height - 1 - p->row) + 0.5f - v[1]) / v[3] - 1.0f;
	packf near[4], far[4];

	for (int i = 0; i < 4; i++) {
		near[i] = m[i] * nx + m[4 + i] * ny + -m[8 + i] + m[12 + i];
		far[i] = m[i] * nx + m[4 + i] * ny + m[8 + i] + m[12 + i];
	}
	return v3_16(far[0] * near[3] - near[0] * far[3], far[1] * near[3] - near[1] * far[3],
	             far[2] * near[3] - near[2] * far[3]);
}

/* Compute the triangles' edge lengths, area and rounding. */
WIDE_VECTORS static inline void pack_measure(const struct pack *p, struct pack_surface *s)
{
	const struct vec3_16 edge[3] = { v3_sub(s->corner[2], s->corner[1]), v3_sub(s->corner[0], s->corner[2]),
		                         v3_sub(s->corner[1], s->corner[0]) };
	const struct vec3_16 cross = v3_cross(edge[2], edge[0]);
	packf reach;

	s->area = sqrt(v3_dot(cross, cross));
	for (int i = 0; i < 3; i++)
		s->length[i] = sqrt(v3_dot(edge[i], edge[i]));
	reach = pack_max(pack_max(v3_extent(s->corner[0]), v3_extent(s->corner[1])), v3_extent(s->corner[2]));
	s->rounding = (reach + p->away) * POINT_ROUNDING;
}
