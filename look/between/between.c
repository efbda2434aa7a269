#include "look/between/between.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "base/err.h"
#include "look/between/bridge.h"
#include "look/between/pose.h"
#include "look/matrix.h"

static void take(float out[16], const double part[16], const float place[16])
{
	double from[16], to[16];

	matrix_from_floats(from, place);
	matrix_mul(to, part, from);
	for (int k = 0; k < 16; k++)
		out[k] = (float)to[k];
}

/* The part of a couple's motion at this moment. @return 0: no body moves so */
static int part_of(const struct bridge *b, const struct couple *c, int filmed, double out[16])
{
	double own[16], part[16];

	if (!c->moves)
		return 0;
	if (!filmed)
		return pose_part(out, c->motion, b->mixer.at);
	if (bridge_agrees(c, b->camera, c->motion)) {
		memcpy(out, b->mixer.camera_part, sizeof(own));
		return 1;
	}
	matrix_mul(own, b->back, c->motion);
	if (!pose_part(part, own, b->mixer.at))
		return 0;
	matrix_mul(out, b->mixer.camera_part, part);
	return 1;
}

/* A draw that flattens goes with the camera if that explains its motion, else number by number. */
static void place_flat(const struct bridge *b, uint32_t i, int filmed, float out[16])
{
	const float *first = bridge_place(b, i, b->mixer.first), *second = bridge_place(b, i, b->mixer.second);
	float moved[16], most = 0;
	int goes = filmed;

	if (filmed)
		take(moved, b->camera, first);
	for (int k = 0; k < 16; k++)
		most = fmaxf(most, fabsf(second[k]));
	for (int k = 0; k < 16 && filmed; k++)
		goes &= fabsf(moved[k] - second[k]) <= (float)BRIDGE_SAME * most;
	if (goes) {
		take(out, b->mixer.camera_part, first);
		return;
	}
	for (int k = 0; k < 16; k++)
		out[k] = first[k] + (float)b->mixer.at * (second[k] - first[k]);
}

/* A draw without a partner goes with the camera. */
static void place_alone(const struct bridge *b, uint32_t i)
{
	const struct scene_instance *in = &b->mixer.base->instances[i];
	struct scene_instance *out = &b->mixer.out->instances[i];
	double back[16];

	if (b->views[in->view] != SCENE_NONE && !in->rectangle)
		out->view = b->views[in->view];
	if (!bridge_is_filmed(b, i))
		return;
	if (b->mixer.first == b->mixer.base)
		take(out->modelview, b->mixer.camera_part, in->modelview);
	else if (pose_part(back, b->back, 1 - b->mixer.at))
		take(out->modelview, back, in->modelview);
}

/* @return 0 or ERR_SYSTEM (reported) */
static int place(struct bridge *b, uint32_t i)
{
	struct mixer *m = &b->mixer;
	const struct couple *c = &b->couples[i];
	struct scene_instance *out = &m->out->instances[i];
	const struct scene_instance *other = &m->other->instances[c->other];
	const int filmed = bridge_is_filmed(b, i);
	double part[16];

	if (memcmp(bridge_place(b, i, m->first), bridge_place(b, i, m->second), sizeof(out->modelview)) == 0)
		memcpy(out->modelview, m->base->instances[i].modelview, sizeof(out->modelview));
	else if (part_of(b, c, filmed, part))
		take(out->modelview, part, bridge_place(b, i, m->first));
	else
		place_flat(b, i, filmed, out->modelview);
	out->mesh = mixed_mesh(m, out->mesh, other->mesh);
	out->material = mixed_material(m, out->material, other->material);
	out->current = mixed_current(m, out->current, other->current);
	out->view = mixed_view(m, out->view, other->view);
	b->views[m->base->instances[i].view] = out->view;
	return out->mesh == SCENE_NONE || out->material == SCENE_NONE || out->current == SCENE_NONE ||
	                       out->view == SCENE_NONE ?
	               ERR_SYSTEM :
	               0;
}

/* Room for one more. */
static void *copy_of(const void *items, size_t n, size_t size)
{
	void *copy = malloc((n + 1) * size);

	if (copy && n)
		memcpy(copy, items, n * size);
	return copy;
}

/* All arrays that mixing changes. */
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

static void name_scene(struct mixer *m)
{
	const struct {
		uint64_t first, second;
		double at;
	} of = { m->first->serial, m->second->serial, m->at };

	m->out->serial = XXH3_64bits(&of, sizeof(of)) | 1; /* 0 is none */
}

static void free_bridge(struct bridge *b)
{
	mixed_end(&b->mixer);
	free(b->couples);
	free(b->boxes);
	free(b->views);
}

static int make_bridge(struct bridge *b)
{
	const struct scene *s = b->mixer.base;

	b->couples = calloc(s->n_instances + (size_t)1, sizeof(*b->couples));
	b->boxes = calloc(s->n_meshes + (size_t)1, sizeof(*b->boxes));
	b->views = malloc((s->n_views + (size_t)1) * sizeof(*b->views));
	for (uint32_t i = 0; b->views && i < s->n_views; i++)
		b->views[i] = SCENE_NONE;
	return b->couples && b->boxes && b->views ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");
}

/* @return 0 or ERR_SYSTEM (reported) */
static int cross(struct bridge *b, struct between *out)
{
	const struct scene *s = b->mixer.base;
	int err = bridge_couple(b);

	for (uint32_t i = 0; i < s->n_instances && !err; i++) {
		out->n_matched += b->couples[i].other != SCENE_NONE;
		out->n_alone += b->couples[i].other == SCENE_NONE && !s->instances[i].rectangle;
	}
	if (err)
		return err;
	out->is_cut = s->width != b->mixer.other->width || s->height != b->mixer.other->height || bridge_is_cut(b);
	if (out->is_cut)
		return 0;
	for (uint32_t i = 0; i < s->n_instances && !err; i++)
		if (b->couples[i].other != SCENE_NONE)
			err = place(b, i);
	for (uint32_t i = 0; i < s->n_instances && !err; i++)
		if (b->couples[i].other == SCENE_NONE)
			place_alone(b, i);
	if (!err)
		mixed_clears(&b->mixer);
	return err;
}

int between_make(const struct scene *first, const struct scene *second, double at, struct between *out)
{
	const int is_first = at < 0.5;
	const struct scene *base = is_first ? first : second;
	struct bridge b = { .mixer = { .base = base, .other = is_first ? second : first, .first = first,
		                       .second = second, .at = at, .share = (float)(is_first ? at : 1 - at) } };
	int err;

	memset(out, 0, sizeof(*out));
	b.mixer.out = &out->scene;
	err = make_bridge(&b);
	if (!err)
		err = copy_scene(base, &out->scene);
	if (!err)
		err = cross(&b, out);
	if (!err)
		name_scene(&b.mixer);
	out->owned = b.mixer.owned;
	out->n_owned = b.mixer.n_owned;
	free_bridge(&b);
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

