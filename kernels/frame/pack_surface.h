/*
 * Where sixteen fragments lie in eye space: what point.h has for one, in the same order of operations. OpenCL C only.
 */
#pragma once

#include "kernels/frame/pack.h"

struct pack_vec {
	packf x, y, z;
};

WIDE_VECTORS static inline struct pack_vec pack_vec(packf x, packf y, packf z)
{
	struct pack_vec v;

	v.x = x;
	v.y = y;
	v.z = z;
	return v;
}

WIDE_VECTORS static inline struct pack_vec pack_add(struct pack_vec a, struct pack_vec b)
{
	return pack_vec(a.x + b.x, a.y + b.y, a.z + b.z);
}

WIDE_VECTORS static inline struct pack_vec pack_sub(struct pack_vec a, struct pack_vec b)
{
	return pack_vec(a.x - b.x, a.y - b.y, a.z - b.z);
}

WIDE_VECTORS static inline struct pack_vec pack_scale(struct pack_vec a, packf s)
{
	return pack_vec(a.x * s, a.y * s, a.z * s);
}

WIDE_VECTORS static inline packf pack_dot(struct pack_vec a, struct pack_vec b)
{
	return a.x * b.x + a.y * b.y + a.z * b.z;
}

WIDE_VECTORS static inline struct pack_vec pack_cross(struct pack_vec a, struct pack_vec b)
{
	return pack_vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

WIDE_VECTORS static inline struct pack_vec pack_choose(struct pack_vec a, struct pack_vec b, packi second)
{
	return pack_vec(select(a.x, b.x, second), select(a.y, b.y, second), select(a.z, b.z, second));
}

/* As v3_normalize. */
WIDE_VECTORS static inline struct pack_vec pack_normalize(struct pack_vec a)
{
	const packf length2 = pack_dot(a, a);

	return pack_choose(a, pack_scale(a, 1.0f / sqrt(length2)), length2 > 0.0f);
}

/* As sample_basis. */
WIDE_VECTORS static inline void pack_basis(struct pack_vec n, struct pack_vec *across, struct pack_vec *along)
{
	const packi by_x = fabs(n.x) < 0.6f;
	const packf one = 1, none = 0;

	*across = pack_normalize(pack_cross(n, pack_vec(select(none, one, by_x), select(one, none, by_x), none)));
	*along = pack_cross(n, *across);
}

/* The fragments' triangles in eye space, as struct point_plane. */
struct pack_surface {
	struct pack_vec corner[3], plane; /* plane: point_plane_normal */
	packf length[3], area, rounding;  /* once pack_measure has found them */
};

/* The corners, homogeneous. @return the lanes in which not all have w = 1 */
WIDE_VECTORS static inline packi pack_eyes(const struct tables *t, const struct pack *p, packf (*e)[4])
{
	for (int k = 0; k < 3; k++)
		pack_vertex(t, p, k, (packu)(PACK_EYE), e[k]);
	return (e[0][3] != 1.0f) | (e[1][3] != 1.0f) | (e[2][3] != 1.0f);
}

/* As point_corner_about, for the lanes `which`. */
WIDE_VECTORS static inline void pack_corners_about(const struct pack *p, packf (*e)[4], packi which,
                                                    struct pack_vec *corner)
{
	packf of_point[4], w_inv;
	struct pack_vec at;

	for (int i = 0; i < 4; i++)
		of_point[i] = e[0][i] * p->weight[0] + e[1][i] * p->weight[1] + e[2][i] * p->weight[2];
	w_inv = 1.0f / of_point[3];
	at = pack_scale(pack_vec(of_point[0], of_point[1], of_point[2]), w_inv);
	for (int k = 0; k < 3; k++)
		corner[k] = pack_choose(corner[k],
		                        pack_scale(pack_add(corner[k], pack_scale(at, of_point[3] - e[k][3])), w_inv), which);
}

/* From pack_eyes. */
WIDE_VECTORS static inline void pack_surface_through(const struct pack *p, packf (*e)[4], packi bent,
                                                      struct pack_surface *out)
{
	struct pack_vec n;

	for (int k = 0; k < 3; k++)
		out->corner[k] = pack_vec(e[k][0], e[k][1], e[k][2]);
	if (any_pack(bent))
		pack_corners_about(p, e, bent, out->corner);
	n = pack_normalize(pack_cross(pack_sub(out->corner[1], out->corner[0]), pack_sub(out->corner[2], out->corner[0])));
	out->plane = pack_choose(pack_vec(0, 0, 0), n, pack_dot(n, n) > 0.0f);
}

WIDE_VECTORS static inline void pack_surface(const struct tables *t, const struct pack *p, struct pack_surface *out)
{
	packf e[3][4];
	const packi bent = pack_eyes(t, p, e);

	pack_surface_through(p, e, bent, out);
}

/* As point_place. */
WIDE_VECTORS static inline struct pack_vec pack_place_at(const struct pack_surface *s, const packf *weight)
{
	return pack_add(pack_add(pack_scale(s->corner[0], weight[0]), pack_scale(s->corner[1], weight[1])),
	                pack_scale(s->corner[2], weight[2]));
}

/* The vertices' normals at the points, length 1 or 0. */
WIDE_VECTORS static inline struct pack_vec pack_vertex_normals(const struct tables *t, const struct pack *p)
{
	struct pack_vec v[3];

	for (int k = 0; k < 3; k++) {
		packf row[4];

		pack_vertex(t, p, k, (packu)(PACK_NORMAL), row);
		v[k] = pack_scale(pack_vec(row[0], row[1], row[2]), p->weight[k]);
	}
	return pack_normalize(pack_add(pack_add(v[0], v[1]), v[2]));
}

/* The same on the side of n; n where they have none. */
WIDE_VECTORS static inline struct pack_vec pack_smooth_normal(const struct tables *t, const struct pack *p,
                                                              struct pack_vec n)
{
	struct pack_vec smooth = pack_vertex_normals(t, p);

	smooth = pack_choose(smooth, pack_scale(smooth, (packf)(-1)), pack_dot(smooth, n) < 0.0f);
	return pack_choose(n, smooth, pack_dot(smooth, smooth) > 0.0f);
}

/* As point_normal. */
WIDE_VECTORS static inline struct pack_vec pack_normal(const struct tables *t, const struct pack *p,
                                                       const struct pack_surface *s)
{
	const packi seen = p->material->front_face == GL_CW ? p->front : ~p->front;
	const struct pack_vec n = pack_scale(s->plane, select((packf)(1), (packf)(-1), seen));

	return p->material->lighting || p->material->program_normals ? pack_smooth_normal(t, p, n) : n;
}

/* As stage_view_direction. */
WIDE_VECTORS static inline struct pack_vec pack_view_direction(const struct pack *p, uint height)
{
	__global const float *v = p->view->viewport, *m = p->view->inverse;
	const packf nx = 2.0f * (convert_float16(p->x) + 0.5f - v[0]) / v[2] - 1.0f;
	const packf ny = 2.0f * (convert_float16((int)height - 1 - p->row) + 0.5f - v[1]) / v[3] - 1.0f;
	packf near[4], far[4];

	for (int i = 0; i < 4; i++) {
		near[i] = m[i] * nx + m[4 + i] * ny + -m[8 + i] + m[12 + i];
		far[i] = m[i] * nx + m[4 + i] * ny + m[8 + i] + m[12 + i];
	}
	return pack_vec(far[0] * near[3] - near[0] * far[3], far[1] * near[3] - near[1] * far[3],
	                far[2] * near[3] - near[2] * far[3]);
}

/* As v3_extent. */
WIDE_VECTORS static inline packf pack_extent(struct pack_vec a)
{
	return pack_max(pack_max(fabs(a.x), fabs(a.y)), fabs(a.z));
}

/* Lengths, area and rounding of the triangles. */
WIDE_VECTORS static inline void pack_measure(const struct pack *p, struct pack_surface *s)
{
	const struct pack_vec edge[3] = { pack_sub(s->corner[2], s->corner[1]), pack_sub(s->corner[0], s->corner[2]),
		                          pack_sub(s->corner[1], s->corner[0]) };
	const struct pack_vec cross = pack_cross(edge[2], edge[0]);
	packf reach;

	s->area = sqrt(pack_dot(cross, cross));
	for (int i = 0; i < 3; i++)
		s->length[i] = sqrt(pack_dot(edge[i], edge[i]));
	reach = pack_max(pack_max(pack_extent(s->corner[0]), pack_extent(s->corner[1])), pack_extent(s->corner[2]));
	s->rounding = (reach + p->away) * POINT_ROUNDING;
}
