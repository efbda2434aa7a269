#include "look/study/light/dome.h"

#include <math.h>
#include <string.h>

#include "look/draws/matrix.h"
#include "look/draws/solid.h"
#include "look/study/motion/face.h"
#include "look/study/roles/layer.h"

/* At most this many triangles of a surface are sampled. */
enum { MOST_TRIANGLES = 64 };
/* At most this many pictures of a sky, and this many texels of each. */
enum { SKIES = 64, SKY_TEXELS = 1024 };
/* How much of a sky's colour its light takes; textures often contain some of it already. */
#define TINT 0.3
/* If OpenGL lights more than this share of the solid surfaces, its lights are the scene's. */
#define MOST_LIT 0.05
/* How far away things still dim the light, in half widths of the window at their depth. */
#define REACH 0.6
#define REACH_LIT 1.2
/* Upright: within 60 degrees of the window's up. Normals within 8 degrees belong to one floor. */
#define UPRIGHT 0.5
#define SAME_UP 0.99
/* The weight of this light on surfaces that OpenGL lights; their own lights account for most of the rest. */
#define LIT_SHARE 0.8
/* A floor covers at least this share of the window. */
#define LEAST_FLOOR 0.08

static void note_size(double sizes[DOME_SIZES], double size, double weight)
{
	const double bin = 4 * log2(size) + DOME_SIZES / 2.0;

	if (isfinite(bin))
		sizes[bin < 0 ? 0 : bin >= DOME_SIZES ? DOME_SIZES - 1 : (int)bin] += weight;
}

static void note_up(struct dome *d, const double normal[3], double weight)
{
	unsigned i = 0;

	d->all += weight;
	while (i < d->n_ups && matrix_dot3(d->ups[i].normal, normal) < SAME_UP)
		i++;
	if (i == DOME_UPS)
		return;
	if (i == d->n_ups) {
		memcpy(d->ups[i].normal, normal, sizeof(d->ups[i].normal));
		d->ups[i].weight = 0;
		d->n_ups++;
	}
	d->ups[i].weight += weight;
}

/* The window's up direction in eye space; the camera may be in the projection. */
static void window_up(const struct scene_view *view, double out[3])
{
	for (int k = 0; k < 3; k++)
		out[k] = (double)view->projection[4 * k + 1];
	matrix_normalize3(out);
}

/* times: the number of faces that it represents */
static void note_face(struct dome *d, const struct scene_view *view, const struct face *face, unsigned times,
                      const double world_from_eye[16])
{
	double up[3], normal[4] = { 0, 0, 0, 0 }, turned[4], size,
		      weight = fmin(1, times * face_share(face, view->projection, &size)), side;

	if (!(weight > 0))
		return;
	d->unlit += weight;
	note_size(d->sizes[0], size, weight);
	window_up(view, up);
	side = matrix_dot3(face->normal, up);
	for (int k = 0; k < 3; k++)
		normal[k] = side < 0 ? -face->normal[k] : face->normal[k];
	matrix_transform(turned, world_from_eye, normal);
	if (fabs(side) > UPRIGHT && matrix_normalize3(turned))
		note_up(d, turned, weight);
	else
		d->all += weight;
}

static void note_instance(struct dome *d, const struct scene *scene, const struct scene_instance *in,
                          const double world_from_eye[16])
{
	const struct scene_mesh *mesh = scene->meshes[in->mesh];
	const uint32_t stride = mesh->primitive_count / MOST_TRIANGLES + 1;
	double eye[16];

	matrix_from_floats(eye, in->modelview);
	for (uint32_t p = 0; p < mesh->primitive_count; p += stride) {
		struct face face;
		double size, share;

		if (!face_of(mesh, eye, p, &face))
			continue;
		if (!scene->materials[in->material].lighting) {
			note_face(d, &scene->views[in->view], &face, stride, world_from_eye);
			continue;
		}
		share = fmin(1, stride * face_share(&face, scene->views[in->view].projection, &size));
		d->lit += share;
		if (share > 0)
			note_size(d->sizes[1], size, share);
	}
}

/* Add the mean colour of a sky's picture. */
static void note_sky(struct dome *d, const struct scene *s, const struct scene_instance *in)
{
	const struct scene_material *m = &s->materials[in->material];
	const struct scene_texture *t = m->unit_count == 1 ? s->textures[s->units[m->unit_first].texture] : NULL;
	const size_t n = t ? (size_t)t->width * t->height : 0, stride = n / SKY_TEXELS + 1;
	double sum[3] = { 0, 0, 0 }, weight = 0;

	if (!t || t->floats || d->skies == SKIES || m->lighting)
		return;
	for (size_t i = 0; i < n; i += stride) {
		const uint8_t *c = t->texels + 4 * i;

		weight += c[3];
		for (int k = 0; k < 3; k++)
			sum[k] += c[k] / 255.0 * c[3];
	}
	if (!(weight > 0))
		return;
	for (int k = 0; k < 3; k++)
		d->sky[k] += sum[k] / weight;
	d->skies++;
}

void dome_add(struct dome *d, const struct scene *scene, const struct motion *motion, const uint8_t *layers)
{
	double world_from_eye[16];

	if (!matrix_invert(world_from_eye, motion_now(motion)->eye_from_world))
		return;
	d->frames++;
	d->known += motion->n_frames == 1 || motion_now(motion)->witnessed;
	for (uint32_t i = 0; i < scene->n_instances; i++)
		if (layers[i] == LAYER_SKY) {
			note_sky(d, scene, &scene->instances[i]);
		} else if (solid_is(scene, &scene->instances[i])) {
			window_up(&scene->views[scene->instances[i].view], d->up_eye);
			note_instance(d, scene, &scene->instances[i], world_from_eye);
		}
}

int dome_is_wanted(const struct dome *d)
{
	return d->unlit > 0 && d->lit <= MOST_LIT * (d->lit + d->unlit);
}

/* A size that two thirds of the window do not exceed; as much as half of it may be something held in the hand. */
static double middle_size(const double sizes[DOME_SIZES])
{
	double sum = 0, whole = 0;
	int i = 0;

	for (int k = 0; k < DOME_SIZES; k++)
		whole += sizes[k];
	while (i < DOME_SIZES - 1 && (sum += sizes[i]) < 0.67 * whole)
		i++;
	return exp2((i + 0.5 - DOME_SIZES / 2.0) / 4);
}

/* In a world that OpenGL lights, its ambient light comes from all around, and things nearby dim it. */
static void find_for_lit(const struct dome *d, struct findings *out)
{
	struct finding *rule = findings_add(out, FINDINGS_SKY, "ambient light");

	finding_explain(rule, d->lit / (d->unlit + d->lit),
	                "OpenGL lights %.0f %% of what is solid; things close by dim the light from all around",
	                100 * d->lit / (d->unlit + d->lit));
	FINDING_SET(rule, FINDING_NUMBER("reach", 4, REACH_LIT * middle_size(d->sizes[1])),
	            FINDING_VECTOR("light", 1, 1, 1, 1), FINDING_NUMBER("lit", 6, LIT_SHARE), FINDING_IS("unlit", 0));
}

/* The up direction that most of the level ground agrees on; NULL: there is too little ground. */
static const struct dome_up *find_floor(const struct dome *d)
{
	const struct dome_up *best = d->n_ups ? &d->ups[0] : NULL;

	for (unsigned i = 1; i < d->n_ups; i++)
		best = d->ups[i].weight > best->weight ? &d->ups[i] : best;
	return best && best->weight > LEAST_FLOOR * d->all && 2 * d->known > d->frames ? best : NULL;
}

int dome_find_up(const struct dome *d, double up[3])
{
	const struct dome_up *floor = find_floor(d);

	if (floor)
		memcpy(up, floor->normal, sizeof(floor->normal));
	return floor != NULL;
}

/* White, tinted towards the sky's colour at equal brightness. */
static void find_colors(const struct dome *d, struct finding *out)
{
	const double mean = (d->sky[0] + d->sky[1] + d->sky[2]) / 3;
	double light[3];

	for (int k = 0; k < 3; k++)
		light[k] = mean > 0 ? 1 + TINT * (d->sky[k] / mean - 1) : 1;
	FINDING_SET(out, FINDING_VECTOR("light", 3, light[0], light[1], light[2]),
	            FINDING_VECTOR("ground", 1, 0.7, 0.7, 0.7));
}

void dome_find(const struct dome *d, struct findings *out)
{
	const struct dome_up *best = find_floor(d);
	const double *up = best ? best->normal : d->up_eye;
	char why[80] = "up is where the window has it";
	struct finding *rule;

	if (!dome_is_wanted(d)) {
		if (d->lit > 0)
			find_for_lit(d, out);
		return;
	}
	rule = findings_add(out, FINDINGS_SKY, "sky light");
	if (best)
		snprintf(why, sizeof(why), "%.0f %% of the rest is level, which says what is up",
		         100 * best->weight / d->all);
	finding_explain(rule, d->unlit / (d->unlit + d->lit),
	                "OpenGL lights %.0f %% of what is solid, and nothing tells of another light; %s",
	                100 * d->lit / (d->unlit + d->lit), why);
	FINDING_SET(rule, FINDING_NUMBER("reach", 4, REACH * middle_size(d->sizes[0])),
	            FINDING_VECTOR("up", -4, up[0], up[1], up[2]));
	if (best)
		FINDING_SET(rule, FINDING_NAMED("space", "world"));
	find_colors(d, rule);
	FINDING_SET(rule, FINDING_NUMBER("lit", 6, LIT_SHARE));
}
