#include "look/spare/sides.h"

#include <float.h>
#include <math.h>
#include <string.h>
#include <xxhash.h>

#include "base/err.h"
#include "base/mat4.h"
#include "base/table.h"
#include "base/vec3.h"
#include "gl_tokens.h"
#include "look/draws/corner.h"
#include "look/draws/drawn.h"
#include "look/draws/modelview.h"

/* The sum of a closed body's cross products is at most this share of their lengths; corners computed twice differ by
 * rounding. */
#define CLOSED 1e-6
/* Normals this nearly parallel to a triangle do not determine its sides: as in kernels/frame/light/transparency.h. */
#define ACROSS 1e-3

static enum sides_shown shown_of(const struct scene_material *m)
{
	if (m->cull_face == GL_FRONT)
		return SIDES_BACK;
	if (m->cull_face == GL_BACK)
		return SIDES_FRONT;
	return m->lighting && !m->two_side ? SIDES_LIT : SIDES_BOTH;
}

struct sides sides_of(const struct scene *scene, const struct scene_instance *in)
{
	const struct scene_material *m = &scene->materials[in->material];
	struct sides sides = { .shown = shown_of(m) };

	sides.clockwise = (m->front_face == GL_CW) ^ (sides.shown == SIDES_BACK) ^
	                  (modelview_kind_of(in->modelview) == MODELVIEW_MIRRORED);
	return sides;
}

/* A triangle's cross product on the side that is visible by its winding. */
static void wound_normal(const struct scene_mesh *mesh, struct sides sides, uint32_t primitive, double out[3])
{
	const float *corner[3];
	double edge[2][3];

	for (unsigned c = 0; c < 3; c++)
		corner[c] = corner_place(mesh, primitive, c);
	for (int k = 0; k < 3; k++) {
		edge[0][k] = (double)corner[sides.clockwise ? 2 : 1][k] - corner[0][k];
		edge[1][k] = (double)corner[sides.clockwise ? 1 : 2][k] - corner[0][k];
	}
	vec3_cross(edge[0], edge[1], out);
}

/*
 * Turn a triangle's cross product to the side that its normals point to, if they count; set it to 0 if they do not
 * determine a side.
 * @return the factor: 1, 0 or -1
 */
static int turn_to_normals(const struct scene *scene, const struct scene_instance *in, struct sides sides,
                            uint32_t primitive, double normal[3])
{
	double sum[3] = { 0, 0, 0 }, along;
	int turn;

	if (sides.shown != SIDES_LIT)
		return 1;
	for (unsigned c = 0; c < 3; c++) {
		const float *n = corner_normal(scene, in, primitive, c);

		for (int k = 0; k < 3; k++)
			sum[k] += n[k];
	}
	along = vec3_dot(normal, sum);
	turn = along > 0 ? 1 : -1;
	if (!(along * along > ACROSS * ACROSS * vec3_dot(sum, sum) * vec3_dot(normal, normal)))
		turn = 0;
	for (int k = 0; k < 3; k++)
		normal[k] *= turn;
	return turn;
}

void sides_towards(const struct scene *scene, const struct scene_instance *in, struct sides sides, uint32_t primitive,
                   double out[3])
{
	wound_normal(scene->meshes[in->mesh], sides, primitive, out);
	turn_to_normals(scene, in, sides, primitive, out);
}

int sides_back_outside(const struct scene *scene, const struct scene_instance *in)
{
	const struct sides sides = sides_of(scene, in); /* lit: by the winding of fronts */
	double along = 0;

	if (sides.shown != SIDES_LIT)
		return sides.shown == SIDES_BACK;
	for (uint32_t i = 0; i < scene->meshes[in->mesh]->primitive_count; i++) {
		double front[3], shown[3];

		wound_normal(scene->meshes[in->mesh], sides, i, front);
		memcpy(shown, front, sizeof(shown));
		turn_to_normals(scene, in, sides, i, shown);
		along += vec3_dot(front, shown) / sqrt(fmax(vec3_dot(front, front), DBL_MIN));
	}
	return along < 0;
}

/* The triangles of an instance as a whole, in object space. */
struct sheet {
	double sum[3], length; /* sums of cross products on the visible side, and of their lengths */
	double volume;         /* six times the enclosed volume; below 0 if the inside is what is visible */
	float low[3], high[3];
	uint32_t behind; /* triangles that show the side of their winding, the opposite side, or an unknown one */
	uint32_t as_wound, against, untold; /* triangles whose visible side is the one of their winding, the opposite
	                                       one, or unknown */
};

enum { MOST_LAMPS = 32 };

/* The lamps of an instance's eye space in its object space; w is 0 or 1. */
struct lamps {
	double place[MOST_LAMPS][4];
	uint32_t n;
};

static void add_lamp(struct lamps *lamps, const struct sides_lamp *lamp, const float obj_from_eye[16])
{
	double *place = lamps->place[lamps->n++];
	float at[4];

	mat4_transform(at, obj_from_eye, lamp->position);
	for (int k = 0; k < 4; k++)
		place[k] = at[3] != 0 ? (double)at[k] / at[3] : at[k];
}

static void widen(struct sheet *sheet, const float at[3])
{
	for (int k = 0; k < 3; k++) {
		sheet->low[k] = at[k] < sheet->low[k] ? at[k] : sheet->low[k];
		sheet->high[k] = at[k] > sheet->high[k] ? at[k] : sheet->high[k];
	}
}

static void add_triangle(const struct scene *s, const struct scene_instance *in, struct sides sides, uint32_t primitive,
                         const struct lamps *lamps, struct sheet *sheet)
{
	const float *corner = corner_place(s->meshes[in->mesh], primitive, 0);
	const double at[3] = { corner[0], corner[1], corner[2] };
	double shown[3], square, from_origin;
	int turn;

	wound_normal(s->meshes[in->mesh], sides, primitive, shown);
	square = vec3_dot(shown, shown);
	if (!(square > 0))
		return; /* no ray meets it */
	turn = turn_to_normals(s, in, sides, primitive, shown);
	++*(turn > 0 ? &sheet->as_wound : turn < 0 ? &sheet->against : &sheet->untold);
	for (int k = 0; k < 3; k++)
		sheet->sum[k] += shown[k];
	sheet->length += sqrt(square);
	from_origin = vec3_dot(shown, at);
	sheet->volume += from_origin;
	for (unsigned c = 0; c < 3; c++)
		widen(sheet, corner_place(s->meshes[in->mesh], primitive, c));
	for (uint32_t i = 0; i < lamps->n; i++)
		sheet->behind |= (uint32_t)!(vec3_dot(shown, lamps->place[i]) > lamps->place[i][3] * from_origin) << i;
}

static int is_inside(const struct sheet *sheet, const double lamp[4])
{
	int inside = lamp[3] != 0;

	for (int k = 0; k < 3; k++)
		inside &= lamp[k] >= sheet->low[k] && lamp[k] <= sheet->high[k];
	return inside;
}

/* 1 for a body that shows its outside alone. A ray through it meets a side that blocks, if all of that blocks. */
static int is_closed(const struct sheet *sheet)
{
	return sqrt(vec3_dot(sheet->sum, sheet->sum)) <= CLOSED * sheet->length && sheet->volume > 0;
}

/* How corners run on the visible side, if all triangles agree: a bit for either winding. */
static uint32_t winding_of(const struct sheet *sheet, struct sides sides)
{
	if (sheet->untold || (sheet->as_wound && sheet->against))
		return 0;
	return (sides.clockwise != 0) != (sheet->against != 0) ? SCENE_SHOWN_CLOCKWISE : SCENE_SHOWN_COUNTER;
}

/* @param lamps  NULL: light may come from anywhere
 * @return bits as in sides_find; 0: rays to lamps need not be tested */
static uint32_t has_lamp_behind(const struct scene *s, const struct scene_instance *in, const struct lamps *lamps)
{
	static const struct lamps none = { .n = 0 };
	struct sheet sheet = { .low = { INFINITY, INFINITY, INFINITY }, .high = { -INFINITY, -INFINITY, -INFINITY } };
	const struct sides sides = sides_of(s, in);
	int is_asked;

	for (uint32_t i = 0; i < s->meshes[in->mesh]->primitive_count; i++)
		add_triangle(s, in, sides, i, lamps ? lamps : &none, &sheet);
	is_asked = !lamps || sheet.behind;
	if (is_closed(&sheet) && !s->materials[in->material].blend && !s->materials[in->material].alpha_test) {
		is_asked = 0;
		for (uint32_t i = 0; lamps && i < lamps->n; i++)
			is_asked |= is_inside(&sheet, lamps->place[i]);
	}
	return is_asked ? SCENE_ONE_SIDED | winding_of(&sheet, sides) : 0;
}

/* 1 if the winding of triangles in eye space determines the front for rays; a mirroring projection makes it wrong. */
static int is_told_apart(const struct scene *s, const struct scene_instance *in)
{
	const enum sides_shown shown = shown_of(&s->materials[in->material]);

	return s->meshes[in->mesh]->kind == SCENE_TRIANGLES && s->meshes[in->mesh]->primitive_count && !in->rectangle &&
	       (shown == SIDES_LIT || (shown != SIDES_BOTH && !drawn_mirrored(&s->views[in->view])));
}

/* Whether rays to some lamp must be tested for the side of an instance that they meet: bits as in sides_find. */
static uint32_t asked_of(const struct scene *s, const struct scene_instance *in, const struct sides_lamp *lamps,
                         uint32_t n_lamps)
{
	struct lamps near = { .n = 0 };
	float inverse[16];

	if (s->materials[in->material].vertex_program || !mat4_invert(inverse, in->modelview))
		return SCENE_ONE_SIDED;
	if (!lamps)
		return has_lamp_behind(s, in, NULL);
	for (uint32_t k = 0; k < n_lamps; k++) {
		if (lamps[k].space != s->views[in->view].space)
			continue;
		if (near.n == MOST_LAMPS)
			return SCENE_ONE_SIDED;
		add_lamp(&near, &lamps[k], inverse);
	}
	return near.n ? has_lamp_behind(s, in, &near) : 0;
}

/* Identifies the position of a culled mesh. */
static uint64_t key_of(const struct scene *s, const struct scene_instance *in)
{
	const uint64_t place = XXH3_64bits(in->modelview, sizeof(in->modelview)) + s->views[in->view].space;

	return place ^ s->meshes[in->mesh]->hash[0];
}

/*
 * The visible sides of the meshes at each position: transparent bodies are often drawn twice, backs first.
 * @param both  keys to bits of 1 << enum sides_shown
 */
static int find_both(const struct scene *s, struct table *both)
{
	for (uint32_t i = 0; i < s->n_instances; i++) {
		const struct scene_instance *in = &s->instances[i];
		const enum sides_shown shown = shown_of(&s->materials[in->material]);
		const uint64_t key = key_of(s, in);

		if ((shown == SIDES_FRONT || shown == SIDES_BACK) &&
		    table_set(both, key, (void *)((uintptr_t)table_find(both, key) | (uintptr_t)1 << shown)))
			return ERR_SYSTEM;
	}
	return 0;
}

int sides_find(const struct scene *scene, const struct sides_lamp *lamps, uint32_t n_lamps, uint32_t *bits, uint32_t *n)
{
	const uintptr_t all = (uintptr_t)1 << SIDES_FRONT | (uintptr_t)1 << SIDES_BACK;
	struct table both = { 0 };
	int err = find_both(scene, &both);

	for (uint32_t i = 0; i < scene->n_instances && !err; i++) {
		const struct scene_instance *in = &scene->instances[i];
		uint32_t asked;

		if (!is_told_apart(scene, in) || (uintptr_t)table_find(&both, key_of(scene, in)) == all)
			continue;
		asked = asked_of(scene, in, lamps, n_lamps);
		bits[i] |= asked;
		*n += asked != 0;
	}
	table_free(&both);
	return err;
}
