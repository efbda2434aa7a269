/* Makes the scene at a moment: moves each draw of the base, and mixes the rest. */
#include "look/between/between.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "base/err.h"
#include "look/between/bridge.h"
#include "look/between/couples.h"
#include "look/between/mixed.h"
#include "look/between/pose.h"
#include "look/draws/matrix.h"

struct interval {
	struct bridge bridges[2]; /* by base */
	int is_cut;
};

/* The scene that between_make is making. */
struct making {
	const struct bridge *b;
	struct mixer mixer;
	uint32_t *views; /* [views] of the base: the mixed view, or SCENE_NONE */
};

/* --- Intervals --------------------------------------------------------------------------------------------------- */

struct interval *interval_new(const struct scene *first, const struct scene *second)
{
	struct interval *v = calloc(1, sizeof(*v));
	int err = v ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");

	for (int k = 0; k < 2 && !err; k++)
		err = couples_find(&v->bridges[k], k ? second : first, k ? first : second, k);
	if (err)
		interval_free(&v);
	else
		v->is_cut = first->width != second->width || first->height != second->height ||
		            bridge_is_cut(&v->bridges[0]) || bridge_is_cut(&v->bridges[1]);
	return v;
}

void interval_free(struct interval **interval)
{
	for (int k = 0; *interval && k < 2; k++)
		bridge_end(&(*interval)->bridges[k]);
	free(*interval);
	*interval = NULL;
}

int interval_is_cut(const struct interval *interval)
{
	return interval->is_cut;
}

/* --- Places of draws --------------------------------------------------------------------------------------------- */

/* out = part place. */
static void move_place(float out[16], const double part[16], const float place[16])
{
	double from[16], to[16];

	matrix_from_floats(from, place);
	matrix_mul(to, part, from);
	for (int k = 0; k < 16; k++)
		out[k] = (float)to[k];
}

/*
 * The part of a couple's motion up to this moment. If the camera's motion applies (filmed), the draw's own motion is
 * interpolated relative to it.
 * @return 0: no rigid body moves like this
 */
static int part_of(const struct making *m, const struct couple *c, int filmed, double out[16])
{
	double own[16], part[16];

	if (!c->moves)
		return 0;
	if (!filmed)
		return pose_part(out, c->motion, m->mixer.at);
	if (bridge_agrees(c, m->b->camera->motion, c->motion)) {
		memcpy(out, m->mixer.camera_part, sizeof(own));
		return 1;
	}
	matrix_mul(own, m->b->camera->back, c->motion);
	if (!pose_part(part, own, m->mixer.at))
		return 0;
	matrix_mul(out, m->mixer.camera_part, part);
	return 1;
}

/* A draw whose motion pose.h cannot interpolate, such as a flattened one, moves with the camera if that explains its
 * motion. Otherwise the elements of its modelview are interpolated. */
static void place_flat(const struct making *m, uint32_t i, int filmed, float out[16])
{
	const float *first = bridge_place(m->b, i, 0), *second = bridge_place(m->b, i, 1);
	float moved[16], most = 0;
	int follows = filmed;

	if (filmed)
		move_place(moved, m->b->camera->motion, first);
	for (int k = 0; k < 16; k++)
		most = fmaxf(most, fabsf(second[k]));
	for (int k = 0; k < 16 && filmed; k++)
		follows &= fabsf(moved[k] - second[k]) <= (float)BRIDGE_SAME * most;
	if (follows) {
		move_place(out, m->mixer.camera_part, first);
		return;
	}
	for (int k = 0; k < 16; k++)
		out[k] = first[k] + (float)m->mixer.at * (second[k] - first[k]);
}

/* A draw without a partner moves with the camera. */
static void place_alone(const struct making *m, uint32_t i)
{
	const struct scene_instance *in = &m->b->base->instances[i];
	struct scene_instance *out = &m->mixer.out->instances[i];
	double back[16];

	if (m->views[in->view] != SCENE_NONE && !in->rectangle)
		out->view = m->views[in->view];
	if (!bridge_is_filmed(m->b, i))
		return;
	if (!m->b->is_back)
		move_place(out->modelview, m->mixer.camera_part, in->modelview);
	else if (pose_part(back, m->b->camera->back, 1 - m->mixer.at))
		move_place(out->modelview, back, in->modelview);
}

/* Move a draw that has a partner; mix its mesh, material, attributes and view. @return 0 or ERR_SYSTEM (reported) */
static int place(struct making *m, uint32_t i)
{
	const struct bridge *b = m->b;
	const struct couple *c = &b->couples[i];
	struct scene_instance *out = &m->mixer.out->instances[i];
	const struct scene_instance *other = &b->other->instances[c->other];
	const float *first = bridge_place(b, i, 0);
	const int filmed = bridge_is_filmed(b, i);
	double part[16];

	if (memcmp(first, bridge_place(b, i, 1), sizeof(out->modelview)) != 0) {
		if (part_of(m, c, filmed, part))
			move_place(out->modelview, part, first);
		else
			place_flat(m, i, filmed, out->modelview);
	}
	out->mesh = mixed_mesh(&m->mixer, out->mesh, other->mesh);
	out->material = mixed_material(&m->mixer, out->material, other->material);
	out->current = mixed_current(&m->mixer, out->current, other->current);
	out->view = mixed_view(&m->mixer, out->view, other->view);
	m->views[b->base->instances[i].view] = out->view;
	return out->mesh == SCENE_NONE || out->material == SCENE_NONE || out->current == SCENE_NONE ||
	                       out->view == SCENE_NONE ?
	               ERR_SYSTEM :
	               0;
}

/* --- The scene --------------------------------------------------------------------------------------------------- */

/* Allocate a copy with room for one more item. */
static void *copy_of(const void *items, size_t n, size_t size)
{
	void *copy = malloc((n + 1) * size);

	if (copy && n)
		memcpy(copy, items, n * size);
	return copy;
}

/* Copy a scene, with arrays of its own where mixing changes or extends them. @return 0 or ERR_SYSTEM (reported) */
static int copy_scene(const struct scene *s, struct scene *out)
{
	*out = *s;
	out->release = NULL;
	out->instances = copy_of(s->instances, s->n_instances, sizeof(*s->instances));
	out->materials = copy_of(s->materials, s->n_materials, sizeof(*s->materials));
	out->units = copy_of(s->units, s->n_units, sizeof(*s->units));
	out->lights = copy_of(s->lights, s->n_lights, sizeof(*s->lights));
	out->currents = copy_of(s->currents, s->n_currents, sizeof(*s->currents));
	out->views = copy_of(s->views, s->n_views, sizeof(*s->views));
	out->clears = copy_of(s->clears, s->n_clears, sizeof(*s->clears));
	out->programs = copy_of(s->programs, s->n_programs, sizeof(*s->programs));
	out->meshes = copy_of(s->meshes, s->n_meshes, sizeof(*s->meshes));
	return out->instances && out->materials && out->units && out->lights && out->currents && out->views &&
	                       out->clears && out->programs && out->meshes ?
	               0 :
	               err_report(ERR_SYSTEM, NULL, "out of memory");
}

/* Give the scene a serial number that depends on both frames and the moment. */
static void name_scene(const struct making *m)
{
	const struct {
		uint64_t base, other;
		double at;
	} of = { m->b->base->serial, m->b->other->serial, m->mixer.at };

	m->mixer.out->serial = XXH3_64bits(&of, sizeof(of)) | 1; /* 0 means none */
}

/* Turn a copy of the base into the scene. @return 0 or ERR_SYSTEM (reported) */
static int fill(struct making *m)
{
	const struct bridge *b = m->b;
	const uint32_t n = b->base->n_instances;
	int err = 0;

	if (b->camera && pose_part(m->mixer.camera_part, b->camera->motion, m->mixer.at))
		m->mixer.camera = b->camera->motion;
	for (uint32_t i = 0; i < b->base->n_views; i++)
		m->views[i] = SCENE_NONE;
	for (uint32_t i = 0; i < n && !err; i++)
		if (b->couples[i].other != SCENE_NONE)
			err = place(m, i);
	for (uint32_t i = 0; i < n && !err; i++)
		if (b->couples[i].other == SCENE_NONE)
			place_alone(m, i);
	if (!err)
		mixed_clears(&m->mixer);
	return err;
}

int between_make(const struct interval *interval, double at, int base, struct between *out)
{
	const struct bridge *b = &interval->bridges[base];
	struct making m = { .b = b, .mixer = { .base = b->base, .other = b->other, .is_back = b->is_back, .at = at,
		                                   .share = (float)(base ? 1 - at : at), .out = &out->scene } };
	int err;

	*out = (struct between){ .n_matched = b->n_matched, .n_alone = b->n_alone };
	m.views = malloc((b->base->n_views + (size_t)1) * sizeof(*m.views));
	err = m.views ? copy_scene(b->base, &out->scene) : err_report(ERR_SYSTEM, NULL, "out of memory");
	if (!err)
		err = fill(&m);
	if (!err)
		name_scene(&m);
	mixed_end(&m.mixer);
	free(m.views);
	out->owned = m.mixer.owned;
	out->n_owned = m.mixer.n_owned;
	if (err)
		between_release(out);
	return err;
}

void between_release(struct between *between)
{
	struct scene *s = &between->scene;

	for (size_t i = 0; i < between->n_owned; i++)
		free(between->owned[i]);
	free(between->owned);
	free(s->instances);
	free(s->materials);
	free(s->units);
	free(s->lights);
	free(s->currents);
	free(s->views);
	free(s->clears);
	free(s->programs);
	free(s->meshes);
	memset(between, 0, sizeof(*between));
}

