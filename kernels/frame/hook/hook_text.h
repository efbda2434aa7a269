/*
 * The structs and functions that a user's hook may use, all named relume_* and documented for its author in
 * corpus/hooks/README.md. Names that begin with hook_ are the kernels' own. The C twins compile only the part above
 * __OPENCL_VERSION__, and kernels only compile this file if there is a hook.
 */
#pragma once

#include "kernels/frame/light/path.h"

/* Requests of a hook: bits of relume_request.what and of hook_answer.what. */
#define RELUME_COLOR 1u
#define RELUME_RAY 2u
#define RELUME_IGNORE 4u
#define RELUME_SURFACE 8u

/* The surface that a hook is called for, for the functions that the hook may call in turn. */
struct hook_place {
	const struct tables *tables;
	const struct point *point;
	GLOBAL const float *visibility; /* [n_slots][n][3]: share of each light that arrives, red, green and blue */
	uint32_t n_slots, n, item;      /* light slots with known visibility; items in a slot; the item of `point` */
	uint32_t transport;             /* TRANSPORT_* */
	const struct hook_trees *trees; /* NULL: hooks cannot query the trees here */
};

/* --- Boxes ------------------------------------------------------------------------------------------------------- */

/*
 * Test whether a ray meets a box (the slab test). A box with lower > upper is empty.
 * least, most: range of distances to test; receive the range inside the box. Distances are multiples of d's length
 */
static inline int hook_meets_box(GLOBAL const float *lower, GLOBAL const float *upper, struct vec3 o, struct vec3 d,
                                 float *least, float *most)
{
	const float from[3] = { o.x, o.y, o.z }, along[3] = { d.x, d.y, d.z };

	for (int i = 0; i < 3; i++) {
		const float inverse = 1.0f / (M_ABS(along[i]) > 1.0e-20f ? along[i] : along[i] < 0.0f ? -1.0e-20f : 1.0e-20f);
		const float a = (lower[i] - from[i]) * inverse, b = (upper[i] - from[i]) * inverse;

		*least = M_MAX(*least, M_MIN(a, b));
		*most = M_MIN(*most, M_MAX(a, b));
	}
	return lower[0] <= upper[0] && *least <= *most + 1.0e-5f * M_ABS(*most); /* with some slack for rounding */
}

/* Transform a direction by a matrix of 3 rows of 4, as in struct instance. */
static inline struct vec3 hook_turn(GLOBAL const float *m, struct vec3 v)
{
	return v3(m[0] * v.x + m[1] * v.y + m[2] * v.z, m[4] * v.x + m[5] * v.y + m[6] * v.z,
	          m[8] * v.x + m[9] * v.y + m[10] * v.z);
}

/* Transform a position by such a matrix. */
static inline struct vec3 hook_move(GLOBAL const float *m, struct vec3 v)
{
	return v3_add(hook_turn(m, v), v3(m[3], m[7], m[11]));
}

/* Size of the stack of nodes to visit. A node that finds it full is skipped, and its boxes are not counted. */
#define HOOK_STACK 192u

/*
 * Count the boxes that a ray is tested against in the binary trees, up to a distance. Each visited node has two, in the
 * top level and in the meshes alike. Distances stay the same in object space, as the direction is not normalized there.
 */
static inline uint32_t hook_box_tests(const struct hook_trees *a, struct vec3 from, struct vec3 along, float distance)
{
	/* The stack: a node's number, and its tree's instance, or SCENE_NONE for the top level. */
	uint32_t instance[HOOK_STACK], node[HOOK_STACK], depth = 1u, tests = 0u, inside = SCENE_NONE;
	struct vec3 o = from, d = along;

	if (a->top_first == SCENE_NONE)
		return 0u;
	instance[0] = SCENE_NONE;
	node[0] = 0u;
	while (depth) {
		GLOBAL const struct node2 *at;
		const uint32_t in = instance[--depth];

		if (in != inside) {
			o = in == SCENE_NONE ? from : hook_move(a->instances[in].obj_from_eye, from);
			d = in == SCENE_NONE ? along : hook_turn(a->instances[in].obj_from_eye, along);
			inside = in;
		}
		at = (in == SCENE_NONE ? a->top + a->top_first : a->nodes + a->instances[in].node2_first) + node[depth];
		tests += 2u;
		for (uint32_t side = 0u; side < 2u; side++) {
			/* A side is one child, several instances (a leaf of the top level), or a mesh's leaf without boxes. */
			const uint32_t count = at->count[side], n = !count ? 1u : in == SCENE_NONE ? count : 0u;
			float least = 0.0f, most = distance;

			if (!hook_meets_box(at->lo[side], at->hi[side], o, d, &least, &most))
				continue;
			for (uint32_t i = 0u; i < n && depth < HOOK_STACK; i++, depth++) {
				instance[depth] = count ? a->instance_list[at->child[side] + i] : in;
				node[depth] = count ? 0u : at->child[side];
			}
		}
	}
	return tests;
}

#ifdef __OPENCL_VERSION__

/* --- For hooks: corpus/hooks/README.md --------------------------------------------------------------------------- */

struct relume_ray {
	float4 origin, direction;
};

struct relume_pixel {
	float x, y;
	uint width, height;
	float u, v;
	struct relume_ray ray;
};

struct relume_hit {
	float4 position, normal, direction, color;
	float distance;
	uint depth, draw, front, shadow;
	const struct hook_place *place;
};

struct relume_miss {
	float4 origin, direction, color;
	uint depth;
};

struct relume_light {
	float4 direction, color, arrives;
};

struct relume_beam {
	float4 position, normal, direction, color, axis;
	float distance;
	uint number, draw;
};

struct relume_box {
	float4 lower, upper;
};

struct relume_object {
	struct relume_box box;
	uint draw;
};

struct relume_crossing {
	struct relume_ray ray;
	float least, most, enter, leave;
	struct relume_object object;
};

/* Set by the functions below only. For RELUME_SURFACE: texture coordinates, normal, and the distance in weight.x. */
struct relume_request {
	uint what; /* RELUME_*; 0: keep the built-in result */
	float4 color, direction, weight;
};

static inline struct relume_request relume_go_on(void)
{
	struct relume_request r;

	r.what = 0;
	r.color = r.direction = r.weight = (float4)(0);
	return r;
}

static inline struct relume_request relume_color(float4 color)
{
	struct relume_request r = relume_go_on();

	r.what = RELUME_COLOR;
	r.color = color;
	return r;
}

static inline struct relume_request relume_color_and_ray(float4 color, float4 direction, float4 weight)
{
	struct relume_request r = relume_color(color);

	r.what = RELUME_COLOR | RELUME_RAY;
	r.direction = direction;
	r.weight = weight;
	return r;
}

static inline struct relume_request relume_ignore(void)
{
	struct relume_request r = relume_go_on();

	r.what = RELUME_IGNORE;
	return r;
}

static inline struct relume_request relume_surface_at(float distance, float4 normal, float4 coordinates)
{
	struct relume_request r = relume_go_on();

	r.what = RELUME_SURFACE;
	r.weight.x = distance;
	r.direction = normal;
	r.color = coordinates;
	return r;
}

static inline struct relume_request relume_surface(float distance, float4 normal)
{
	return relume_surface_at(distance, normal, (float4)(0.0f, 0.0f, 0.0f, 1.0f));
}

/* An empty box: lower > upper. */
static inline struct relume_box relume_no_box(void)
{
	struct relume_box box;

	box.lower = (float4)(1.0f, 1.0f, 1.0f, 0.0f);
	box.upper = -box.lower;
	return box;
}

static inline float4 hook_float4(struct vec3 v)
{
	return (float4)(v.x, v.y, v.z, 0.0f);
}

static inline struct vec3 hook_vec3(float4 v)
{
	return v3(v.x, v.y, v.z);
}

static inline float4 relume_albedo(const struct relume_hit *hit)
{
	const struct hook_place *at = hit->place;
	struct texturing texturing;
	struct vec4 c;

	point_texture(at->tables, at->point, (const struct point_window *)0, &texturing);
	c = point_albedo(at->tables, at->point, &texturing);
	return hook_float4(stage_light(at->transport, v3(c.x, c.y, c.z)));
}

/* Solve eye_from_obj p = position for p by Cramer's rule: x, y, z are the matrix's columns. */
static inline float4 relume_object_position(const struct relume_hit *hit)
{
	GLOBAL const float *m = hit->place->point->geometry->eye_from_obj;
	const float4 x = hook_float4(v3_load(m)), y = hook_float4(v3_load(m + 4)), z = hook_float4(v3_load(m + 8));
	const float4 at = hit->position - hook_float4(v3_load(m + 12));

	return (float4)(dot(at, cross(y, z)), dot(at, cross(z, x)), dot(at, cross(x, y)), 0.0f) / dot(x, cross(y, z));
}

static inline uint relume_box_tests(const struct relume_hit *hit)
{
	const struct hook_place *at = hit->place;

	return at->trees ? hook_box_tests(at->trees, hook_vec3(hit->position - hit->distance * hit->direction),
	                                  hook_vec3(hit->direction), hit->distance) :
	                   0u;
}

static inline uint relume_lights(const struct relume_hit *hit)
{
	return point_takes_light(hit->place->point) ? point_lights(hit->place->point).count : 0u;
}

static inline struct relume_light relume_light(const struct relume_hit *hit, uint number)
{
	const struct hook_place *at = hit->place;
	GLOBAL const struct scene_light *light = &at->tables->lights[point_lights(at->point).first + number];
	struct relume_light out;
	struct vec3 to_light;
	const float strength = light_strength(light, point_position(at->point), &to_light);

	out.direction = hook_float4(to_light);
	out.color = hook_float4(stage_light(at->transport, v3_scale(v3_load(light->diffuse), strength)));
	/* No rays were sent to lights without a slot: they arrive whole. */
	out.arrives = number < at->n_slots ? hook_float4(v3_load(at->visibility + (number * at->n + at->item) * 3u)) :
	                                     (float4)(1.0f, 1.0f, 1.0f, 0.0f);
	return out;
}

/* The stages that the user's text defines. It follows the kernels, which call them. */
#ifdef HOOK_RAY_GENERATION
struct relume_ray ray_generation(struct relume_pixel pixel, struct relume_parameters parameters);
#endif
#ifdef HOOK_CLOSEST_HIT
struct relume_request closest_hit(struct relume_hit hit, struct relume_parameters parameters);
#endif
#ifdef HOOK_ANY_HIT
struct relume_request any_hit(struct relume_hit hit, struct relume_parameters parameters);
#endif
#ifdef HOOK_MISS
struct relume_request miss(struct relume_miss missed, struct relume_parameters parameters);
#endif
#ifdef HOOK_LIGHT
struct relume_request light(struct relume_beam beam, struct relume_parameters parameters);
#endif
#ifdef HOOK_BOUNDS
struct relume_box bounds(struct relume_object object, struct relume_parameters parameters);
#endif
#ifdef HOOK_INTERSECTION
struct relume_request intersection(struct relume_crossing crossing, struct relume_parameters parameters);
#endif

static inline struct relume_object hook_object_of(GLOBAL const struct hook_object *o)
{
	struct relume_object object;

	object.box.lower = hook_float4(v3_load(o->lower));
	object.box.upper = hook_float4(v3_load(o->upper));
	object.draw = o->draw;
	return object;
}

static inline struct hook_answer hook_answer_of(struct relume_request r)
{
	struct hook_answer a;

	a.what = r.what;
	a.color[0] = r.color.x, a.color[1] = r.color.y, a.color[2] = r.color.z;
	a.direction[0] = r.direction.x, a.direction[1] = r.direction.y, a.direction[2] = r.direction.z;
	a.weight[0] = r.weight.x, a.weight[1] = r.weight.y, a.weight[2] = r.weight.z;
	return a;
}

#endif
