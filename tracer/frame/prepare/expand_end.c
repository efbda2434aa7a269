#include "tracer/frame/prepare/expand_end.h"

#include <math.h>
#include <string.h>

struct expand_end expand_load_end(const struct expand_input *in, uint32_t v, int side)
{
	struct expand_end e = { .v = in->vertices[v] };
	uint32_t units = in->material->unit_count;

	memcpy(e.clip_place, in->material->clip_by_program ? e.v.color[1] : e.v.eye, sizeof(e.clip_place));
	memcpy(e.v.color[0], in->vertices[v].color[side], sizeof(e.v.color[0]));
	memcpy(e.v.color[1], in->vertices[v].color[side], sizeof(e.v.color[1]));
	memcpy(e.v.secondary[0], in->vertices[v].secondary[side], sizeof(e.v.secondary[0]));
	memcpy(e.v.secondary[1], in->vertices[v].secondary[side], sizeof(e.v.secondary[1]));
	if (units)
		memcpy(e.texcoord, in->texcoords + (size_t)v * units, units * sizeof(e.texcoord[0]));
	return e;
}

void expand_take_color(struct expand_end *e, const struct expand_end *from)
{
	memcpy(e->v.color, from->v.color, sizeof(e->v.color));
	memcpy(e->v.secondary, from->v.secondary, sizeof(e->v.secondary));
}

static void mix_floats(const float *a, const float *b, float wa, float wb, float *out, size_t n)
{
	for (size_t i = 0; i < n; i++)
		out[i] = a[i] * wa + b[i] * wb;
}

/* As in the vertex stage, but not snapped. Mesa's clipper projects the ends that it makes without fused operations. */
static float scale_and_move(float scale, float x, float move, int fused)
{
	return fused ? fmaf(scale, x, move) : scale * x + move;
}

void expand_project(const struct expand_input *in, struct expand_end *e)
{
	const float *v = in->view->viewport, *c = e->v.clip, *range = in->view->depth_range;
	int fused = !e->cut;

	e->w_inv = 1 / c[3];
	e->x = scale_and_move(v[2] * 0.5f, c[0] * e->w_inv, v[0] + v[2] * 0.5f, fused);
	e->y = scale_and_move(-v[3] * 0.5f, c[1] * e->w_inv, (float)in->height - (v[1] + v[3] * 0.5f), fused);
	e->z = scale_and_move((range[1] - range[0]) * 0.5f, c[2] * e->w_inv, (range[1] + range[0]) * 0.5f, fused);
}

/* Signed distance to a plane of the view volume: near, far, or one of the four sides, which `guards` moves to twice the
 * distance from the middle. */
static float clip_distance(const float *c, int plane, int guards)
{
	const float side = (plane & 1 ? -1.0f : 1.0f) * (guards && plane >= 2 ? 0.5f : 1.0f);

	return c[3] + side * c[plane < 2 ? 2 : (plane - 2) / 2];
}

static void move_floats(float *from, const float *to, float t, size_t n)
{
	for (size_t i = 0; i < n; i++)
		from[i] += t * (to[i] - from[i]);
}

/* Interpolate attributes towards another end, in Mesa's order of operations. */
static void move_attributes(struct expand_end *e, const struct expand_end *to, float t)
{
	move_floats(&e->v.color[0][0], &to->v.color[0][0], t, 8);
	move_floats(&e->v.secondary[0][0], &to->v.secondary[0][0], t, 8);
	move_floats(e->v.normal, to->v.normal, t, 3);
	move_floats(&e->v.fog_coord, &to->v.fog_coord, t, 1);
	move_floats(&e->texcoord[0][0], &to->texcoord[0][0], t, SCENE_MAX_UNITS * 4);
}

static void move_end(struct expand_end *e, const struct expand_end *to, float t)
{
	move_floats(e->v.clip, to->v.clip, t, 4);
	move_floats(e->v.eye, to->v.eye, t, 4);
	move_floats(e->clip_place, to->clip_place, t, 4);
	move_attributes(e, to, t);
	e->cut = 1;
}

float expand_plane_distance(const struct expand_input *in, const struct expand_end *e, int plane)
{
	const float *p, *at = e->clip_place;

	if (plane < EXPAND_VOLUME_PLANES)
		return clip_distance(e->v.clip, plane, in->guards);
	plane -= EXPAND_VOLUME_PLANES;
	p = in->material->clip_plane_eye[plane];
	return in->material->clip_plane_mask >> plane & 1 ? p[0] * at[0] + p[1] * at[1] + p[2] * at[2] + p[3] * at[3] :
	                                                    0;
}

/* Primitives partly outside the view pass through Mesa's clipper and are projected by it, even if it does not clip
 * them. */
static void pass_clipper(struct expand_end *e)
{
	for (int plane = 0; plane < EXPAND_VOLUME_PLANES; plane++)
		e->cut |= clip_distance(e->v.clip, plane, 0) < 0;
}

int expand_clip_line(const struct expand_input *in, struct expand_end *a, struct expand_end *b)
{
	float t_a = 0, t_b = 0; /* fractions cut off at either end */
	struct expand_end from = *a;

	for (int plane = 0; plane < EXPAND_PLANES; plane++) {
		float da = expand_plane_distance(in, a, plane), db = expand_plane_distance(in, b, plane);

		if (da < 0 && db < 0)
			return 0;
		if (da < 0)
			t_a = fmaxf(t_a, da / (da - db));
		else if (db < 0)
			t_b = fmaxf(t_b, db / (db - da));
	}
	if (t_a + t_b >= 1)
		return 0;
	if (t_a > 0)
		move_end(a, b, t_a);
	if (t_b > 0)
		move_end(b, &from, t_b);
	pass_clipper(a);
	pass_clipper(b);
	return a->v.clip[3] > 0 && b->v.clip[3] > 0;
}

/* The point where a plane cuts the side between two corners, whose signed distances have different signs. Interpolates
 * from the nearer corner, as Mesa does. */
static struct expand_end cut_side(const struct expand_end *inside, float inner, const struct expand_end *outside,
                                  float outer)
{
	const int from_outside = -outer < inner;
	struct expand_end e = from_outside ? *outside : *inside;

	move_end(&e, from_outside ? inside : outside, from_outside ? outer / (outer - inner) : inner / (inner - outer));
	return e;
}

/* Clip a polygon of n corners by one plane. @return number of corners left */
static int cut_polygon(const struct expand_input *in, struct expand_end *corners, int n, int plane)
{
	struct expand_end all[EXPAND_CORNERS];
	float distance[EXPAND_CORNERS];
	int left = 0, cuts = 0;

	for (int i = 0; i < n; i++) {
		distance[i] = expand_plane_distance(in, &corners[i], plane);
		if (!isfinite(distance[i]))
			return 0;
		cuts |= distance[i] < 0;
	}
	if (!cuts)
		return n;
	memcpy(all, corners, (size_t)n * sizeof(*all));
	for (int i = 0; i < n; i++) {
		const struct expand_end *a = &all[i], *b = &all[(i + 1) % n];
		const float da = distance[i], db = distance[(i + 1) % n];

		if (!(da < 0))
			corners[left++] = *a;
		if ((da < 0) == (db < 0))
			continue;
		corners[left] = da < 0 ? cut_side(b, db, a, da) : cut_side(a, da, b, db);
		corners[left++].edge = da < 0 ? a->edge : plane >= EXPAND_VOLUME_PLANES;
	}
	return left;
}

int expand_is_cut(const struct expand_input *in, const struct expand_end corners[3])
{
	for (int i = 0; i < 3 * EXPAND_PLANES; i++)
		if (expand_plane_distance(in, &corners[i % 3], i / 3) < 0)
			return 1;
	return 0;
}

int expand_clip_triangle(const struct expand_input *in, struct expand_end corners[EXPAND_CORNERS])
{
	static const int order[EXPAND_VOLUME_PLANES] = { 3, 2, 5, 4, 0, 1 }; /* Mesa's order */
	int n = 3;

	for (int i = 0; i < EXPAND_PLANES && n >= 3; i++)
		n = cut_polygon(in, corners, n, i < EXPAND_VOLUME_PLANES ? order[i] : i);
	return n >= 3 ? n : 0;
}

struct expand_end expand_line_point(const struct expand_end *a, const struct expand_end *b, float s)
{
	float w_inv = a->w_inv + (b->w_inv - a->w_inv) * s, w;
	struct expand_end e = *a;

	if (!(w_inv > 0)) { /* beyond an end, and behind the eye */
		s = s < 0.5f ? 0 : 1;
		w_inv = s > 0 ? b->w_inv : a->w_inv;
	}
	move_attributes(&e, b, s);
	w = 1 / w_inv;
	mix_floats(a->v.eye, b->v.eye, (1 - s) * a->w_inv * w, s * b->w_inv * w, e.v.eye, 4);
	e.x = a->x + (b->x - a->x) * s;
	e.y = a->y + (b->y - a->y) * s;
	e.z = a->z + (b->z - a->z) * s;
	e.w_inv = w_inv;
	return e;
}
