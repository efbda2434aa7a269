#include "look/spare/spare.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/mat4.h"
#include "look/draws/corner.h"
#include "look/spare/blockers.h"
#include "look/spare/cards.h"
#include "look/spare/carved.h"
#include "look/spare/flattened.h"
#include "look/spare/globes.h"
#include "look/spare/sides.h"
#include "scene/box.h"
#include "scene/draw_list.h"

/* A light is shut out if it reaches less than this share of the area that it lights. The sun through a window reaches
 * a few hundredths. */
#define REACHED_LEAST 0.1f
/* A surface belongs to an enclosure if it blocks light to this share of the area that is not reached. */
#define STOPS_LEAST 0.02f
/* An enclosure is spared if light then reaches this share. */
#define REACHED_AFTER 0.3f
/* Things within this factor of the lit world's radius belong to it. */
#define WORLD_MARGIN 1.1f

enum { RECEIVERS = 256, FIRST_RECEIVERS = 24, FEWEST_RECEIVERS = 4, PER_INSTANCE = 8 };

/* A place that OpenGL lights, in eye space, and the area that it represents. */
struct receiver {
	float at[3], normal[3], area;
	uint32_t instance;
};

struct sparing {
	const struct scene *scene;
	struct spare *out;
	struct blockers *blockers;
	struct receiver receivers[RECEIVERS];
	uint32_t n_receivers;
	int more_lamps; /* 1: there are more lamps than out->lamps has room for */
};

/* --- Lit surfaces ------------------------------------------------------------------------------------------------ */

static const struct scene_material *material_of(const struct scene *s, uint32_t i)
{
	return &s->materials[s->instances[i].material];
}

static int is_lit(const struct scene *s, uint32_t i)
{
	const struct scene_material *m = material_of(s, i);

	return m->lighting && m->light_count && m->depth_test && s->meshes[s->instances[i].mesh]->kind == SCENE_TRIANGLES &&
	       s->meshes[s->instances[i].mesh]->primitive_count && s->views[s->instances[i].view].target == 0;
}

static void add_lamps(struct sparing *a, uint32_t instance)
{
	const struct scene *s = a->scene;
	const struct scene_material *m = material_of(s, instance);
	const uint32_t space = s->views[s->instances[instance].view].space;

	for (uint32_t i = 0; i < m->light_count; i++) {
		const float *position = s->lights[m->light_first + i].position_eye;
		uint32_t k = 0;

		while (k < a->out->n_lamps && (a->out->lamps[k].space != space ||
		                               memcmp(a->out->lamps[k].position, position, sizeof(a->out->lamps[k].position)) != 0))
			k++;
		a->more_lamps |= k == SPARE_MOST_LAMPS;
		if (k < a->out->n_lamps || k == SPARE_MOST_LAMPS)
			continue;
		a->out->lamps[a->out->n_lamps].space = space;
		memcpy(a->out->lamps[a->out->n_lamps++].position, position, sizeof(a->out->lamps[k].position));
	}
}

static float area_of(const float a[4], const float b[4], const float c[4])
{
	float square = 0;

	for (int k = 0; k < 3; k++) {
		int i = (k + 1) % 3, j = (k + 2) % 3;
		float n = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);

		square += n * n;
	}
	return 0.5f * sqrtf(square);
}

/*
 * 1 if a surface turns a lit side to the viewer, hidden or not. If both sides are lit, the one towards the viewer
 * counts. The outer walls of a hall say nothing about the light inside.
 */
static int shows_lit_side(const struct scene *s, struct receiver *r)
{
	const struct scene_instance *in = &s->instances[r->instance];
	const float *projection = s->views[in->view].projection;
	float towards = projection[11] != 0 ?
	                        -(r->at[0] * r->normal[0] + r->at[1] * r->normal[1] + r->at[2] * r->normal[2]) :
	                        r->normal[2];

	if (towards < 0 && s->materials[in->material].two_side) {
		for (int k = 0; k < 3; k++)
			r->normal[k] = -r->normal[k];
		towards = -towards;
	}
	return towards > 0;
}

/* The middle of a triangle, and the mean of its corners' normals under the inverse transpose (sec. 2.11.3). */
static int receiver_of(const struct scene *s, uint32_t instance, uint32_t primitive, struct receiver *out)
{
	const struct scene_instance *in = &s->instances[instance];
	float middle[4] = { 0, 0, 0, 1 }, corner[3][4], eye[4], plane[4] = { 0, 0, 0, 0 }, inverse[16], length;

	if (!mat4_invert(inverse, in->modelview))
		return 0;
	for (unsigned c = 0; c < 3; c++) {
		const float *at = corner_place(s->meshes[in->mesh], primitive, c);

		mat4_transform(corner[c], in->modelview, at);
		for (int k = 0; k < 3; k++) {
			middle[k] += at[k] / 3;
			plane[k] += corner_normal(s, in, primitive, c)[k];
		}
	}
	out->area = area_of(corner[0], corner[1], corner[2]);
	mat4_transform(eye, in->modelview, middle);
	mat4_transform_plane(middle, plane, inverse);
	length = sqrtf(middle[0] * middle[0] + middle[1] * middle[1] + middle[2] * middle[2]);
	for (int k = 0; k < 3; k++) {
		out->at[k] = eye[k];
		out->normal[k] = middle[k] / length;
	}
	out->instance = instance;
	return length > 0 && isfinite(length) && shows_lit_side(s, out);
}

/* Sample places on lit surfaces: the same number for each instance, evenly spread over its triangles. If there are
 * too many instances, they are sampled evenly. */
static void find_receivers(struct sparing *a)
{
	const struct scene *s = a->scene;
	uint32_t lit = 0, seen = 0, step;

	for (uint32_t i = 0; i < s->n_instances; i++)
		lit += (uint32_t)is_lit(s, i);
	step = lit * PER_INSTANCE / RECEIVERS + 1;
	for (uint32_t i = 0; i < s->n_instances; i++) {
		uint32_t n = s->meshes[s->instances[i].mesh]->primitive_count, stride = n / PER_INSTANCE + 1;

		if (!is_lit(s, i))
			continue;
		add_lamps(a, i);
		if (seen++ % step)
			continue;
		for (uint32_t p = 0; p < n && a->n_receivers < RECEIVERS; p += stride) {
			struct receiver *r = &a->receivers[a->n_receivers];

			a->n_receivers += (uint32_t)receiver_of(s, i, p, r);
			r->area *= (float)stride;
		}
	}
}

/* --- Enclosures -------------------------------------------------------------------------------------------------- */

/* The ray from a receiver to a lamp. @return 0: the lamp does not light it */
static int ray_to(const struct sparing *a, const struct receiver *r, const struct sides_lamp *lamp, float from[3],
                  float d[3])
{
	float cosine = 0, length = 0, off = 0;

	for (int k = 0; k < 3; k++) {
		d[k] = lamp->position[3] != 0 ? lamp->position[k] / lamp->position[3] - r->at[k] : lamp->position[k];
		cosine += d[k] * r->normal[k];
		length += d[k] * d[k];
		off = fmaxf(off, fabsf(r->at[k]));
	}
	for (int k = 0; k < 3; k++)
		from[k] = r->at[k] + d[k] / sqrtf(length) * off * 1e-4f;
	return cosine > 0.05f * sqrtf(length) && a->scene->views[a->scene->instances[r->instance].view].space == lamp->space;
}

/* 1 if a hit blocks light under the bits found so far. */
static int stops(const struct sparing *a, const struct sides_lamp *lamp, const struct blocker_hit *hit,
                 const uint32_t *bits)
{
	uint32_t b = bits[hit->instance];

	return !(b & SCENE_HIDDEN_FROM_LIGHTS || (b & SCENE_ONE_SIDED && hit->side == BLOCKER_SHOWN) ||
	         (b & SCENE_STOPS_NO_SUN && lamp->position[3] == 0) || !blockers_has(a->blockers, hit->instance));
}

/* The outcome of a lamp's rays: their number, and the areas that they represent. */
struct fare {
	uint32_t rays;
	float area, reached;
};

/*
 * Send every `step`-th of a lamp's rays.
 * @param at_last  [n_instances] or NULL: receives each instance's share of the area, namely that of rays it is the
 * last to block
 */
static struct fare follow(const struct sparing *a, const struct sides_lamp *lamp, const uint32_t *bits, uint32_t step,
                          float *at_last)
{
	struct fare fare = { 0, 0, 0 };

	for (uint32_t i = 0; i < a->n_receivers; i += step) {
		struct blocker_hit hits[BLOCKERS_MOST];
		const struct blocker_hit *last = NULL;
		float from[3], d[3];
		unsigned n;

		if (!ray_to(a, &a->receivers[i], lamp, from, d))
			continue;
		fare.rays++;
		fare.area += a->receivers[i].area;
		n = blockers_on(a->blockers, lamp->space, from, d, lamp->position[3] != 0 ? 0.9999f : INFINITY, hits);
		for (unsigned k = 0; k < n; k++) {
			if (stops(a, lamp, &hits[k], bits))
				last = !last || hits[k].t > last->t ? &hits[k] : last;
		}
		fare.reached += last ? 0 : a->receivers[i].area;
		if (last && at_last)
			at_last[last->instance] += a->receivers[i].area;
	}
	return fare;
}

static int is_shut_out(const struct fare *fare)
{
	return fare->rays >= FEWEST_RECEIVERS && fare->reached < REACHED_LEAST * fare->area;
}

/* Set a bit for instances that stop enough rays. @return how many */
static uint32_t mark(const struct sparing *a, const float *stopped, const struct fare *fare, uint32_t bit,
                     uint32_t *bits)
{
	uint32_t n = 0;

	for (uint32_t i = 0; i < a->scene->n_instances; i++)
		if (stopped[i] > STOPS_LEAST * (fare->area - fare->reached) && !(bits[i] & bit)) {
			bits[i] |= bit;
			n++;
		}
	return n;
}

/* Let a lamp's light through the enclosure that shuts it out. @param stopped, bits  [n_instances], scratch space */
static void let_in(struct sparing *a, const struct sides_lamp *lamp, float *stopped, uint32_t *bits)
{
	const uint32_t n = a->scene->n_instances;
	struct fare fare = follow(a, lamp, a->out->bits, a->n_receivers / FIRST_RECEIVERS + 1, NULL);
	uint32_t marked = 0;

	if (!is_shut_out(&fare))
		return;
	memcpy(bits, a->out->bits, n * sizeof(*bits));
	for (int layer = 0; layer < 3; layer++) {
		memset(stopped, 0, n * sizeof(*stopped));
		fare = follow(a, lamp, bits, 1, stopped);
		if (!is_shut_out(&fare))
			break;
		marked += mark(a, stopped, &fare, lamp->position[3] == 0 ? SCENE_STOPS_NO_SUN : SCENE_HIDDEN_FROM_LIGHTS, bits);
	}
	fare = follow(a, lamp, bits, 1, NULL);
	if (fare.reached < REACHED_AFTER * fare.area)
		return; /* these surfaces are not what shuts the light out */
	memcpy(a->out->bits, bits, n * sizeof(*bits));
	a->out->enclosures += marked;
}

static int find_enclosures(struct sparing *a)
{
	const size_t n = a->scene->n_instances;
	float *stopped = malloc((n + 1) * sizeof(*stopped));
	uint32_t *bits = malloc((n + 1) * sizeof(*bits));

	for (uint32_t i = 0; i < a->out->n_lamps; i++) {
		const struct sides_lamp *lamp = &a->out->lamps[i];

		a->out->enclosures += globes_find(a->scene, a->blockers, lamp->position, lamp->space, a->out->bits);
	}
	for (uint32_t i = 0; stopped && bits && i < a->out->n_lamps; i++)
		let_in(a, &a->out->lamps[i], stopped, bits);
	free(stopped);
	free(bits);
	return stopped && bits ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");
}

/* --- Backdrops --------------------------------------------------------------------------------------------------- */

/* A ball around something in eye space, which does not depend on the view direction. */
struct ball {
	float middle[3], radius;
};

static struct ball ball_of(const struct scene *s, uint32_t instance)
{
	const struct scene_instance *in = &s->instances[instance];
	float low[3], high[3], middle[4] = { 0, 0, 0, 1 }, eye[4], scale = 0;
	struct ball ball = { .radius = 0 };

	scene_box(s->meshes[in->mesh], low, high);
	for (int k = 0; k < 3; k++) {
		const float *column = in->modelview + 4 * k;

		middle[k] = 0.5f * (low[k] + high[k]);
		ball.radius += 0.25f * (high[k] - low[k]) * (high[k] - low[k]);
		scale = fmaxf(scale, column[0] * column[0] + column[1] * column[1] + column[2] * column[2]);
	}
	mat4_transform(eye, in->modelview, middle);
	memcpy(ball.middle, eye, sizeof(ball.middle));
	ball.radius = sqrtf(ball.radius * scale);
	return ball;
}

static float distance(const struct ball *a, const struct ball *b)
{
	float sum = 0;

	for (int k = 0; k < 3; k++)
		sum += (a->middle[k] - b->middle[k]) * (a->middle[k] - b->middle[k]);
	return sqrtf(sum);
}

/* A ball around everything that is lit in an eye space. Its centre is the mean of the contents, weighted by size. */
static struct ball lit_world(const struct scene *s, uint32_t space)
{
	struct ball world = { .radius = 0 };
	float weight = 0;

	for (int pass = 0; pass < 2; pass++)
		for (uint32_t i = 0; i < s->n_instances; i++) {
			struct ball ball;

			if (!is_lit(s, i) || s->views[s->instances[i].view].space != space)
				continue;
			ball = ball_of(s, i);
			if (pass == 1) {
				world.radius = fmaxf(world.radius, distance(&ball, &world) + ball.radius);
				continue;
			}
			for (int k = 0; k < 3; k++)
				world.middle[k] = (world.middle[k] * weight + ball.middle[k] * ball.radius) / (weight + ball.radius + 1e-30f);
			weight += ball.radius;
		}
	return world;
}

static void find_backdrops(struct sparing *a)
{
	const struct scene *s = a->scene;
	struct ball world = { .radius = 0 };
	uint32_t space = SCENE_NONE;

	for (uint32_t i = 0; i < s->n_instances; i++) {
		const struct scene_instance *in = &s->instances[i];
		struct ball ball;

		if (!blockers_has(a->blockers, i) || material_of(s, i)->lighting)
			continue;
		if (s->views[in->view].space != space) {
			space = s->views[in->view].space;
			world = lit_world(s, space);
		}
		ball = ball_of(s, i);
		if (distance(&ball, &world) + ball.radius <= WORLD_MARGIN * world.radius)
			continue;
		a->out->bits[i] |= SCENE_STOPS_NO_SUN;
		a->out->backdrops++;
	}
}

/* ----------------------------------------------------------------------------------------------------------------- */

static int has_sun(const struct sparing *a)
{
	for (uint32_t i = 0; i < a->out->n_lamps; i++)
		if (a->out->lamps[i].position[3] == 0)
			return 1;
	return 0;
}

/* Find the bits of surfaces that shut out light. */
static int find_blocking(struct sparing *a)
{
	int err = blockers_create(a->scene, &a->blockers);

	if (!err && has_sun(a))
		find_backdrops(a);
	if (!err)
		err = find_enclosures(a);
	blockers_destroy(&a->blockers);
	return err;
}

int spare_find(const struct scene *scene, unsigned said, struct spare *out)
{
	struct sparing *a = calloc(1, sizeof(*a));
	const int new_lights = (said & SPARE_NEW_LIGHTS) != 0, decided = (said & SPARE_IS_DECIDED) != 0;
	int err = 0;

	*out = (struct spare){ .bits = NULL };
	if (!a)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	*a = (struct sparing){ .scene = scene, .out = out };
	find_receivers(a);
	if (!out->n_lamps && !new_lights) {
		free(a);
		return 0;
	}
	out->bits = calloc(scene->n_instances + (size_t)1, sizeof(*out->bits));
	if (!out->bits)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	if (!err)
		err = sides_find(scene, new_lights || a->more_lamps ? NULL : out->lamps, out->n_lamps, out->bits,
		                 &out->one_sided);
	if (!err && !decided && a->n_receivers)
		err = find_blocking(a);
	if (!err && !(said & SPARE_TRICKS_KNOWN))
		err = flattened_find(scene, !(said & SPARE_TRICKS_STAY), out->bits, &out->flattened);
	if (!err)
		out->carved = carved_find(scene, out->bits);
	if (!err)
		err = cards_find(scene, SCENE_CARD, out->bits, &out->cards);
	free(a);
	if (err || !(out->one_sided + out->flattened + out->enclosures + out->backdrops + out->cards +
	             out->carved)) {
		free(out->bits);
		out->bits = NULL;
	}
	return err;
}

static const struct {
	const char *name;
	uint32_t bits;
} names[] = {
	{ "none", 0 }, { "from behind", SCENE_ONE_SIDED }, { "suns", SCENE_STOPS_NO_SUN },
	{ "suns and from behind", SCENE_STOPS_NO_SUN | SCENE_ONE_SIDED }, { "all", SCENE_HIDDEN_FROM_LIGHTS },
};

enum { N_NAMES = sizeof(names) / sizeof(names[0]) };

const char *spare_name(uint32_t bits)
{
	for (int i = 0; i < N_NAMES - 1; i++)
		if (names[i].bits == bits)
			return names[i].name;
	return names[N_NAMES - 1].name;
}

int spare_named(const char *name, uint32_t *bits)
{
	for (int i = 0; i < N_NAMES; i++)
		if (strcmp(name, names[i].name) == 0) {
			*bits = names[i].bits;
			return 1;
		}
	return 0;
}

void spare_free(struct spare *spare)
{
	free(spare->bits);
	*spare = (struct spare){ .bits = NULL };
}

char *spare_tell_lights(const struct spare *spare)
{
	char *text = NULL;
	size_t size;
	FILE *out = open_memstream(&text, &size);

	for (uint32_t i = 0; out && i < spare->n_lamps; i++) {
		const float *p = spare->lamps[i].position;

		fprintf(out, "%s%.9g %.9g %.9g %.9g", i ? "," : "", (double)p[0], (double)p[1], (double)p[2], (double)p[3]);
	}
	if (out && fclose(out) == 0)
		return text;
	free(text);
	return NULL;
}

static int is_card(const void *user, const struct scene *scene, uint32_t i)
{
	const struct spare *spare = user;

	(void)scene;
	return spare->bits && spare->kept && spare->bits[i] & SCENE_CARD;
}

static int is_left_out(const void *user, const struct scene *scene, uint32_t i)
{
	(void)user;
	return (scene->materials[scene->instances[i].material].surface.hidden & SCENE_LEFT_OUT) != 0;
}

char *spare_tell_cards(const struct spare *spare, const struct scene *scene)
{
	return scene_draw_list(scene, is_card, spare);
}

char *spare_tell_left_out(const struct scene *scene)
{
	return scene_draw_list(scene, is_left_out, NULL);
}
