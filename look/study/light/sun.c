#include "look/study/light/sun.h"

#include <math.h>
#include <string.h>

#include "gl_tokens.h"
#include "look/draws/matrix.h"
#include "look/draws/solid.h"
#include "look/spare/blockers.h"
#include "look/study/motion/face.h"
#include "look/study/roles/layer.h"

enum { MOST_FRAMES = 16, PLACES = 64, WHITE = 250, PER_INSTANCE = 4 };
/* Limits for a spot: its share of the texture, how much of its circle it fills, and the brightness elsewhere in the
 * texture. */
#define SMALLEST 2e-4
#define LARGEST 0.03
#define ROUND 0.6
#define DARKER 0.85
/* The directions in all frames are within five degrees; at least this share of the visible places is open to it. */
#define SAME 0.996
#define OPEN 0.5
/* Limits of the sun's share of the light on level ground and of its strength, and the ambient light beside lamps
 * alone. */
#define SHARE 0.5
#define STRONGEST 1.0
#define WITHOUT 0.85

/* Find the centre of a texture's spot, in [0,1]. @return 0: there is none */
static int find_spot(const struct scene_texture *t, double at[2])
{
	double sum[2] = { 0, 0 }, square = 0, all = 0, n = 0, size = (double)t->width * t->height, radius;

	if (t->target != GL_TEXTURE_2D || t->floats || t->border)
		return 0;
	for (int pass = 0; pass < 2; pass++) {
		for (uint32_t y = 0; y < t->height; y++)
			for (uint32_t x = 0; x < t->width; x++) {
				const uint8_t *c = t->texels + 4 * ((size_t)y * t->width + x);
				const double off[2] = { x + 0.5 - at[0], y + 0.5 - at[1] };

				all += pass ? 0 : (c[0] + c[1] + c[2]) / 765.0;
				if (c[0] < WHITE || c[1] < WHITE || c[2] < WHITE)
					continue;
				if (pass) {
					square += off[0] * off[0] + off[1] * off[1];
					continue;
				}
				sum[0] += x + 0.5;
				sum[1] += y + 0.5;
				n++;
			}
		if (n < SMALLEST * size || n > LARGEST * size || all > DARKER * size)
			return 0;
		at[0] = sum[0] / n;
		at[1] = sum[1] / n;
	}
	radius = square / n; /* half the square of a disk's radius */
	at[0] /= t->width;
	at[1] /= t->height;
	return n >= 4 && n > ROUND * 2 * 3.14159265 * radius;
}

/* The spot of a texture, searched for once per texture. NULL: there is none, or there were too many textures */
static const double *spot_of(struct sun *sun, const struct scene_texture *t)
{
	struct sun_picture *p = sun->pictures;

	while (p < sun->pictures + sun->n_pictures && memcmp(p->hash, t->hash, sizeof(p->hash)) != 0)
		p++;
	if (p == sun->pictures + SUN_PICTURES)
		return NULL;
	if (p == sun->pictures + sun->n_pictures) {
		memcpy(p->hash, t->hash, sizeof(p->hash));
		p->has_spot = find_spot(t, p->at);
		sun->n_pictures++;
	}
	return p->has_spot ? p->at : NULL;
}

/* The point in eye space where a mesh shows a point of its texture. @return 0: it does not */
static int find_place(const struct scene *s, const struct scene_instance *in, const struct scene_unit *u,
                      const double at[2], double out[3])
{
	const struct scene_mesh *mesh = s->meshes[in->mesh];
	const float *coord = mesh->texcoord[u->unit];
	double eye[16];

	matrix_from_floats(eye, in->modelview);
	for (uint32_t p = 0; p < mesh->primitive_count && coord && !u->gen_mode[0]; p++) {
		const uint32_t *i = mesh->index + 3 * (size_t)p;
		const float *a = coord + 4 * (size_t)i[0], *b = coord + 4 * (size_t)i[1], *c = coord + 4 * (size_t)i[2];
		const double det = (double)(b[0] - a[0]) * (double)(c[1] - a[1]) - (double)(c[0] - a[0]) * (double)(b[1] - a[1]);
		const double v = ((at[0] - (double)a[0]) * (double)(c[1] - a[1]) -
		                  (double)(c[0] - a[0]) * (at[1] - (double)a[1])) /
		                 det;
		const double w = ((double)(b[0] - a[0]) * (at[1] - (double)a[1]) -
		                  (at[0] - (double)a[0]) * (double)(b[1] - a[1])) /
		                 det;
		struct face face;

		if (!(fabs(det) > 0) || !(v >= 0) || !(w >= 0) || !(v + w <= 1) || !face_of(mesh, eye, p, &face))
			continue;
		for (int k = 0; k < 3; k++)
			out[k] = (1 - v - w) * face.corner[0][k] + v * face.corner[1][k] + w * face.corner[2][k];
		return 1;
	}
	return 0;
}

/* The direction, in eye space, of the spot in a frame's sky. */
static int find_towards(struct sun *sun, const struct scene *s, const uint8_t *layers, double towards[3], int *has_sky)
{
	int found = 0;

	for (uint32_t i = 0; i < s->n_instances; i++) {
		const struct scene_instance *in = &s->instances[i];
		const struct scene_material *m = &s->materials[in->material];
		const struct scene_unit *u = m->unit_count == 1 ? &s->units[m->unit_first] : NULL;
		const double *at;
		double place[3];

		if (layers[i] != LAYER_SKY || !u || m->lighting || s->views[in->view].projection[11] == 0 ||
		    s->meshes[in->mesh]->kind != SCENE_TRIANGLES)
			continue;
		*has_sky = 1;
		at = spot_of(sun, s->textures[u->texture]);
		if (!at || !find_place(s, in, u, at, place) || !matrix_normalize3(place))
			continue;
		if (found && matrix_dot3(place, towards) < SAME)
			return 0; /* two suns are stars */
		memcpy(towards, place, sizeof(place));
		found = 1;
	}
	return found;
}

/* Count the visible places and those from where a direction is unobstructed. */
static int count_open(struct sun *sun, const struct scene *s, const uint8_t *layers, const double towards[3])
{
	struct blockers *blockers;
	unsigned places = 0;
	int err = blockers_create(s, &blockers);

	for (uint32_t i = 0; i < s->n_instances && !err && places < PLACES; i++) {
		const struct scene_instance *in = &s->instances[i];
		const struct scene_mesh *mesh = s->meshes[in->mesh];
		const uint32_t stride = mesh->primitive_count / PER_INSTANCE + 1;
		double eye[16];

		if (layers[i] == LAYER_SKY || !solid_is(s, in) || s->materials[in->material].lighting)
			continue;
		matrix_from_floats(eye, in->modelview);
		for (uint32_t p = 0; p < mesh->primitive_count && places < PLACES; p += stride) {
			struct blocker_hit hits[BLOCKERS_MOST];
			float from[3], d[3];
			struct face face;
			unsigned n, blocked = 0;

			if (!face_of(mesh, eye, p, &face) ||
			    matrix_dot3(face.normal, towards) *
			                    (matrix_dot3(face.normal, face.corner[0]) > 0 ? -1 : 1) <
			            0.05)
				continue;
			for (int k = 0; k < 3; k++) {
				d[k] = (float)towards[k];
				from[k] = (float)((face.corner[0][k] + face.corner[1][k] + face.corner[2][k]) / 3 +
				                  1e-3 * sqrt(face.area) * towards[k]);
			}
			n = blockers_on(blockers, s->views[in->view].space, from, d, 1e9f, hits);
			for (unsigned h = 0; h < n; h++)
				blocked += layers[hits[h].instance] != LAYER_SKY;
			places++;
			sun->open += !blocked;
		}
	}
	sun->places += places;
	if (!err)
		blockers_destroy(&blockers);
	return err;
}

int sun_add(struct sun *sun, const struct scene *s, const struct motion *motion, const uint8_t *layers)
{
	double towards[4] = { 0, 0, 0, 0 }, inverse[16], world[4];
	int has_sky = 0;

	if (sun->skies == MOST_FRAMES || !matrix_invert(inverse, motion_now(motion)->eye_from_world))
		return 0;
	if (!find_towards(sun, s, layers, towards, &has_sky)) {
		sun->skies += (unsigned)has_sky;
		return 0;
	}
	sun->skies++;
	sun->frames++;
	matrix_transform(world, inverse, towards);
	for (int k = 0; k < 3 && matrix_normalize3(world); k++)
		sun->towards[k] += world[k];
	return count_open(sun, s, layers, towards);
}

int sun_is_there(const struct sun *sun, double towards[3])
{
	memcpy(towards, sun->towards, sizeof(sun->towards));
	return sun->frames && 2 * sun->frames > sun->skies && sqrt(matrix_dot3(towards, towards)) > SAME * sun->frames &&
	       sun->open > OPEN * sun->places && matrix_normalize3(towards);
}

void sun_find_surfaces(struct findings *out)
{
	struct finding *rule = findings_add(out, FINDINGS_SURFACES, "lit anew");

	FINDING_SET(rule, FINDING_NUMBER("confidence", 1, 0.8));
	finding_say(rule, "OpenGL lights nothing, and there is a light");
	FINDING_MATCH(rule, FINDING_IS("lit", 0), FINDING_IS("blended", 0), FINDING_IS("depth_tested", 1),
	              FINDING_IS("stencil_tested", 0), FINDING_IS("parallel", 0));
	FINDING_SET(rule, FINDING_IS("lit", 1));
}

static double strength_of(const double towards[3], const double up[3])
{
	return fmin(STRONGEST, SHARE / fmax(0.1, matrix_dot3(up, towards)));
}

void sun_find_light(const struct sun *sun, const double up[3], struct findings *out)
{
	double towards[3], strength;
	struct finding *rule;

	if (!sun_is_there(sun, towards))
		return;
	strength = strength_of(towards, up);
	rule = findings_add(out, FINDINGS_LIGHTS, "sun");
	finding_explain(rule, (double)sun->frames / sun->skies * sun->open / sun->places,
	                "in %u of %u frames the sky has a small white spot there, and %u of %u places in sight are open to "
	                "it", sun->frames, sun->skies, sun->open, sun->places);
	FINDING_SET(rule, FINDING_NAMED("on", "unlit"), FINDING_NAMED("space", "world"),
	            FINDING_PLACE("position", -5, towards, 0), FINDING_VECTOR("diffuse", -3, strength, strength, strength),
	            FINDING_VECTOR("specular", 1, 0, 0, 0), FINDING_NUMBER("radius", 1, 0.01));
}

void sun_find_ambient(const struct sun *sun, const double *up, struct findings *out)
{
	static const double above[3] = { 0, 1, 0 };
	struct finding *rule = findings_add(out, FINDINGS_LIGHTS, "ambient light");
	double towards[3], ambient = WITHOUT;

	if (up && sun_is_there(sun, towards))
		ambient = 1 - strength_of(towards, up) * matrix_dot3(up, towards);
	FINDING_SET(rule, FINDING_NUMBER("confidence", 1, 0.5));
	finding_say(rule, "as much as leaves level ground about as bright as it was");
	FINDING_SET(rule, FINDING_NAMED("on", "unlit"), FINDING_NAMED("space", "world"),
	            FINDING_PLACE("position", 1, above, 0), FINDING_VECTOR("ambient", -3, ambient, ambient, ambient),
	            FINDING_VECTOR("diffuse", 1, 0, 0, 0), FINDING_VECTOR("specular", 1, 0, 0, 0));
}
