#include "look/camera/elsewhere.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/mat4.h"
#include "gl_tokens.h"
#include "look/camera/camera.h"
#include "look/camera/programs.h"
#include "look/camera/viewpoint.h"
#include "look/draws/drawn.h"
#include "scene/box.h"
#include "scene/skies.h"

/* Limits for a sky's box: the viewer's distance from its middle, and its flatness. */
#define AMID 0.05f
#define THICK 0.125f

/* A scene being made. */
struct making {
	const struct scene *scene;
	struct scene *out;
	struct viewpoint viewpoint;
	uint8_t *skies;        /* [instances] */
	uint32_t *kept_before; /* [instances + 1]: the number of earlier instances that stay */
	uint32_t without;
};

/* --- Visible draws ----------------------------------------------------------------------------------------------- */

static int shows_as_much(const struct making *m, const struct scene_view *view)
{
	const float *a = view->projection, *b = m->scene->views[m->viewpoint.main_view].projection;

	for (int c = 0; c < 16; c += 4)
		if (a[c] != b[c] || a[c + 1] != b[c + 1])
			return 0;
	return 1;
}

/* 1 if a view shows the world: like the main view, apart from depth ranges. */
static int is_of_world(const struct making *m, const struct scene_view *view)
{
	const struct scene_view *main_view = &m->scene->views[m->viewpoint.main_view];

	return view->target == 0 && view->space == main_view->space && drawn_in_parallel(view) == m->viewpoint.was_parallel &&
	       (!m->viewpoint.was_parallel || shows_as_much(m, view));
}

/* 1 if a box is not flat and the viewer is in its middle along at least two axes, as inside a sky box or dome. */
static int is_around(const float low[3], const float high[3], const float viewer[3])
{
	float least = INFINITY, most = 0;
	int centered = 0;

	for (int k = 0; k < 3; k++) {
		const float extent = high[k] - low[k], off = fabsf(viewer[k] - 0.5f * (low[k] + high[k]));

		least = fminf(least, extent);
		most = fmaxf(most, extent);
		centered += off <= AMID * extent;
	}
	return least >= THICK * most && centered >= 2;
}

/*
 * Find skies. Draws that resemble skies and share a modelview form a sky if together they surround the viewer. Other
 * draws without depth, such as a ground, belong to the world.
 */
static int find_skies(struct making *m)
{
	const struct scene *s = m->scene;
	const float *at = m->viewpoint.eye_from_recorded + 12;
	uint32_t end;

	m->skies = calloc(s->n_instances + (size_t)1, 1);
	if (!m->skies || scene_find_skies(s, m->skies))
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t first = 0; first < s->n_instances; first = end) {
		const float *modelview = s->instances[first].modelview;
		float low[3] = { INFINITY, INFINITY, INFINITY }, high[3] = { -INFINITY, -INFINITY, -INFINITY },
		      viewer[4], inverse[16];

		for (end = first; end < s->n_instances && m->skies[end] == m->skies[first] &&
		                  memcmp(s->instances[end].modelview, modelview, sizeof(inverse)) == 0;
		     end++)
			if (m->skies[first])
				scene_box_grow(s->meshes[s->instances[end].mesh], low, high);
		if (!m->skies[first])
			continue;
		mat4_invert(inverse, modelview);
		mat4_transform(viewer, inverse, (const float[4]){ at[0], at[1], at[2], 1 });
		memset(m->skies + first, is_around(low, high, viewer), end - first);
	}
	return 0;
}

/* How a draw is treated. */
enum fate { LEFT_OUT, STAYS, MOVES, TURNS };

static enum fate fate_of(struct making *m, uint32_t i, uint32_t first_of_world)
{
	const struct scene_instance *in = &m->scene->instances[i];
	const struct scene_view *view = &m->scene->views[in->view], *main_view = &m->scene->views[m->viewpoint.main_view];

	if (in->rectangle || view->target || view->space != main_view->space)
		return LEFT_OUT;
	if (!is_of_world(m, view))
		return drawn_in_parallel(view) && i < first_of_world ? STAYS : LEFT_OUT;
	if (programs_place(m->scene, in) && !programs_can_move(m->scene, in)) {
		m->without++;
		return LEFT_OUT;
	}
	if (m->skies[i])
		return m->viewpoint.is_parallel ? LEFT_OUT : TURNS;
	return MOVES;
}

/* --- Moving ------------------------------------------------------------------------------------------------------ */

static int copy_scene(struct making *m)
{
	const struct scene *s = m->scene;
	struct scene *out = m->out;

	*out = *s;
	out->release = NULL;
	out->instances = calloc(s->n_instances + (size_t)1, sizeof(*out->instances));
	out->materials = calloc(s->n_materials + (size_t)s->n_instances + 1, sizeof(*out->materials));
	out->units = calloc(s->n_units + (size_t)1, sizeof(*out->units));
	out->lights = calloc(s->n_lights + (size_t)1, sizeof(*out->lights));
	out->views = calloc(s->n_views + (size_t)1, sizeof(*out->views));
	out->clears = calloc(s->n_clears + (size_t)1, sizeof(*out->clears));
	out->programs = NULL;
	m->kept_before = calloc(s->n_instances + (size_t)1, sizeof(*m->kept_before));
	if (!out->instances || !out->materials || !out->units || !out->lights || !out->views || !out->clears ||
	    !m->kept_before)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	if (s->n_materials)
		memcpy(out->materials, s->materials, s->n_materials * sizeof(*out->materials));
	if (s->n_units)
		memcpy(out->units, s->units, s->n_units * sizeof(*out->units));
	if (s->n_lights)
		memcpy(out->lights, s->lights, s->n_lights * sizeof(*out->lights));
	if (s->n_views)
		memcpy(out->views, s->views, s->n_views * sizeof(*out->views));
	return programs_copy(s, out);
}

/* Round to a whole number of pixels. */
static int32_t pixels(float x)
{
	return (int32_t)floorf(x + 0.5f);
}

/* The part of the window that showed the world. */
static void shown_rectangle(const struct scene *s, const struct scene_view *view, int32_t out[4])
{
	const int32_t left = pixels(view->viewport[0]), low = pixels(view->viewport[1]);
	const int32_t right = left + pixels(view->viewport[2]), high = low + pixels(view->viewport[3]);

	out[0] = left > 0 ? left : 0;
	out[1] = low > 0 ? low : 0;
	out[2] = (right < (int32_t)s->width ? right : (int32_t)s->width) - out[0];
	out[3] = (high < (int32_t)s->height ? high : (int32_t)s->height) - out[1];
}

static int holds(const int32_t outer[4], const int32_t inner[4])
{
	return outer[0] <= inner[0] && outer[1] <= inner[1] && outer[0] + outer[2] >= inner[0] + inner[2] &&
	       outer[1] + outer[3] >= inner[1] + inner[3];
}

/* @param shown  in the recorded window */
static void set_view(const struct making *m, struct scene_view *view, const int32_t shown[4])
{
	const uint32_t *size = m->viewpoint.keys->size;

	if (is_of_world(m, view))
		viewpoint_project(&m->viewpoint, m->scene, view, view->projection);
	if (size) {
		memcpy(view->viewport, (const float[4]){ 0, 0, (float)size[0], (float)size[1] }, sizeof(view->viewport));
		memcpy(view->scissor, (const int32_t[4]){ 0, 0, (int32_t)size[0], (int32_t)size[1] }, sizeof(view->scissor));
	} else if (!holds(view->scissor, shown)) {
		memcpy(view->scissor, shown, sizeof(view->scissor));
	}
}

static void set_unit(const struct viewpoint *v, struct scene_unit *unit)
{
	float turned[16];

	for (int c = 0; c < 4; c++)
		mat4_transform_plane(unit->gen_eye_plane[c], unit->gen_eye_plane[c], v->eye_from_camera);
	if (unit->gen_mode[0] != GL_REFLECTION_MAP && unit->gen_mode[0] != GL_NORMAL_MAP)
		return;
	memcpy(turned, v->eye_from_camera, sizeof(turned));
	memset(turned + 12, 0, 3 * sizeof(*turned));
	mat4_mul(unit->matrix, unit->matrix, turned);
}

static void move_state(const struct making *m)
{
	struct scene *out = m->out;
	const struct viewpoint *v = &m->viewpoint;

	for (uint32_t i = 0; i < out->n_lights; i++) {
		const float at[4] = { out->lights[i].position_eye[0], out->lights[i].position_eye[1], out->lights[i].position_eye[2],
			              out->lights[i].position_eye[3] };

		mat4_transform(out->lights[i].position_eye, v->camera_from_eye, at);
		mat4_turn(out->lights[i].spot_direction_eye, v->camera_from_eye, out->lights[i].spot_direction_eye);
	}
	for (uint32_t i = 0; i < out->n_materials; i++)
		for (int p = 0; p < SCENE_MAX_CLIP_PLANES; p++)
			mat4_transform_plane(out->materials[i].clip_plane_eye[p], out->materials[i].clip_plane_eye[p], v->eye_from_camera);
	for (uint32_t i = 0; i < out->n_units; i++)
		set_unit(v, &out->units[i]);
	mat4_turn(out->dome.up_eye, v->camera_from_eye, out->dome.up_eye);
}

/* Move the draws that are visible from the camera, in their order. */
static int move_draws(struct making *m)
{
	const struct scene *s = m->scene;
	struct scene *out = m->out;
	uint32_t first = 0;
	int err = 0;

	while (first < s->n_instances && !is_of_world(m, &s->views[s->instances[first].view]))
		first++;
	out->n_instances = 0;
	for (uint32_t i = 0; i < s->n_instances && !err; i++) {
		const enum fate fate = fate_of(m, i, first);
		struct scene_instance *to = &out->instances[out->n_instances];
		const float *moved = fate == TURNS ? m->viewpoint.sky_from_eye : m->viewpoint.camera_from_eye;

		m->kept_before[i] = out->n_instances;
		if (fate == LEFT_OUT)
			continue;
		*to = s->instances[i];
		out->n_instances++;
		if (fate == STAYS)
			continue;
		mat4_mul(to->modelview, moved, s->instances[i].modelview);
		if (programs_place(s, &s->instances[i]))
			err = programs_move(s, &s->instances[i], moved, out->views[to->view].projection, out, to);
	}
	m->kept_before[s->n_instances] = out->n_instances;
	return err;
}

/* Keep the clears of everything that showed the world, and clear depth if the frame starts without doing so. */
static void set_clears(const struct making *m, const int32_t shown[4])
{
	const struct scene *s = m->scene;
	struct scene *out = m->out;
	uint32_t begun = 0;

	out->n_clears = 0;
	for (uint32_t i = 0; i < s->n_clears; i++)
		if (s->clears[i].target == 0 && holds(s->clears[i].scissor, shown) &&
		    m->kept_before[s->clears[i].before_instance] == 0)
			begun |= s->clears[i].buffers;
	if ((begun & 3) != 3)
		out->clears[out->n_clears++] = (struct scene_clear){ .draw = s->n_clears ? s->clears[0].draw : 0,
			                                             .buffers = ~begun & 7,
			                                             .depth = 1,
			                                             .color_mask = 15,
			                                             .stencil_mask = ~0u,
			                                             .scissor = { 0, 0, (int32_t)s->width,
			                                                          (int32_t)s->height } };
	for (uint32_t i = 0; i < s->n_clears; i++) {
		if (s->clears[i].target || !holds(s->clears[i].scissor, shown))
			continue;
		out->clears[out->n_clears] = s->clears[i];
		out->clears[out->n_clears++].before_instance = m->kept_before[s->clears[i].before_instance];
	}
	for (uint32_t i = 0; i < out->n_clears && m->viewpoint.keys->size; i++)
		memcpy(out->clears[i].scissor,
		       (const int32_t[4]){ 0, 0, (int32_t)m->viewpoint.keys->size[0],
		                           (int32_t)m->viewpoint.keys->size[1] },
		       sizeof(out->clears[i].scissor));
}

static void write_placement(const struct viewpoint *v, uint32_t number, uint32_t pictures, char *out, size_t size)
{
	const float *m = v->eye_from_camera;
	int n = snprintf(out, size, "at %.6g %.6g %.6g, towards %.4g %.4g %.4g, up %.4g %.4g %.4g", 0.0 + m[12],
	                 0.0 + m[13], 0.0 + m[14], 0.0 - m[8], 0.0 - m[9], 0.0 - m[10], 0.0 + m[4], 0.0 + m[5],
	                 0.0 + m[6]);

	if (pictures && n > 0 && (size_t)n < size)
		snprintf(out + n, size - (size_t)n, ", picture %u of %u", number, pictures);
}

int elsewhere_make(const struct camera *camera, const struct look *look, const struct scene *scene, uint32_t number,
                   struct elsewhere *out)
{
	struct making m = { .scene = scene, .out = &out->scene };
	int32_t shown[4];
	int err;

	memset(out, 0, sizeof(*out));
	err = viewpoint_find(camera, look, scene, number, &m.viewpoint);
	if (!err && m.viewpoint.main_view == SCENE_NONE)
		err = err_report(ERR_INPUT, camera->path,
		                 "frame %llu shows nothing in 3D, so it cannot be seen from another place",
		                 (unsigned long long)scene->frame);
	if (!err)
		err = find_skies(&m);
	if (!err)
		err = copy_scene(&m);
	if (!err) {
		shown_rectangle(scene, &scene->views[m.viewpoint.main_view], shown);
		for (uint32_t i = 0; i < scene->n_views; i++)
			set_view(&m, &out->scene.views[i], shown);
		err = move_draws(&m);
	}
	if (!err) {
		move_state(&m);
		set_clears(&m, shown);
		out->scene.width = camera->keys->size ? camera->keys->size[0] : scene->width;
		out->scene.height = camera->keys->size ? camera->keys->size[1] : scene->height;
		out->scene.needs_previous = out->scene.keeps_depth = 0;
		out->scene.start = NULL;
		out->scene.before = NULL;
		out->without = m.without;
		write_placement(&m.viewpoint, number, camera_pictures(camera), out->placement, sizeof(out->placement));
	}
	free(m.skies);
	free(m.kept_before);
	if (err)
		elsewhere_release(out);
	return err;
}

void elsewhere_release(struct elsewhere *elsewhere)
{
	struct scene *s = &elsewhere->scene;

	free(s->instances);
	free(s->materials);
	free(s->units);
	free(s->lights);
	free(s->views);
	free(s->clears);
	free(s->programs);
	memset(elsewhere, 0, sizeof(*elsewhere));
}
