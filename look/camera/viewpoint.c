#include "look/camera/viewpoint.h"

#include <math.h>
#include <string.h>

#include "base/err.h"
#include "base/mat4.h"
#include "base/vec3.h"
#include "look/camera/camera.h"
#include "look/draws/drawn.h"
#include "look/draws/solid.h"
#include "look/rules/rules.h"
#include "look/rules/world.h"

/* --- Vectors ----------------------------------------------------------------------------------------------------- */

static void cross(const float a[3], const float b[3], float out[3])
{
	for (int k = 0; k < 3; k++)
		out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3] + 0.0f;
}

static float length_of(const float v[3])
{
	return (float)sqrt((double)v[0] * v[0] + (double)v[1] * v[1] + (double)v[2] * v[2]);
}

/* @return 0: the vector has no direction */
static int normalize(float v[3])
{
	const float length = length_of(v);

	for (int k = 0; k < 3 && length > 0; k++)
		v[k] /= length;
	return length > 0 && isfinite(length);
}

static void move_place(const float m[16], const float from[3], float out[3])
{
	float at[4];

	mat4_transform(at, m, (const float[4]){ from[0], from[1], from[2], 1 });
	memcpy(out, at, 3 * sizeof(*out));
}

/* The transforms between eye space and the space of a camera at a place. @return 0: `up` is parallel to the line of
 * sight, or one of them is 0 */
static int stand(const float place[3], const float forward[3], const float up[3], float eye_from[16],
                 float from_eye[16])
{
	float f[3], side[3], above[3], upright[3];

	memcpy(f, forward, sizeof(f));
	memcpy(upright, up, sizeof(upright));
	if (!normalize(f) || !normalize(upright))
		return 0;
	cross(f, upright, side);
	if (length_of(side) < 1e-5f || !normalize(side))
		return 0;
	cross(side, f, above);
	memcpy(eye_from, mat4_identity, 16 * sizeof(*eye_from));
	memcpy(from_eye, mat4_identity, 16 * sizeof(*from_eye));
	for (int k = 0; k < 3; k++) {
		eye_from[k] = from_eye[4 * k] = side[k];
		eye_from[4 + k] = from_eye[4 * k + 1] = above[k];
		eye_from[8 + k] = from_eye[4 * k + 2] = 0.0f - f[k];
		eye_from[12 + k] = place[k];
	}
	for (int row = 0; row < 3; row++)
		from_eye[12 + row] = (float)(0.0 - (double)from_eye[row] * place[0] -
		                             (double)from_eye[4 + row] * place[1] -
		                             (double)from_eye[8 + row] * place[2]);
	return 1;
}

/* --- The recorded camera ----------------------------------------------------------------------------------------- */

/* Find the view that shows the most triangles with depth, among those that are usable. */
static uint32_t find_main_view(const struct scene *s)
{
	uint32_t best = SCENE_NONE;
	uint64_t most = 0;

	for (int strict = 1; strict >= 0 && best == SCENE_NONE; strict--)
		for (uint32_t v = 0; v < s->n_views; v++) {
			uint64_t n = 0;

			for (uint32_t i = 0; i < s->n_instances; i++) {
				const struct scene_instance *in = &s->instances[i];

				if (in->view == v && !in->rectangle && s->views[v].target == 0 && (solid_is(s, in) || !strict))
					n += s->meshes[in->mesh]->primitive_count;
			}
			if (n > most) {
				most = n;
				best = v;
			}
		}
	return best;
}

/* 1 if a projection's viewer is at the origin and looks along -z. */
static int is_plain(const float m[16])
{
	return m[1] == 0 && m[2] == 0 && m[3] == 0 && m[4] == 0 && m[6] == 0 && m[7] == 0 &&
	       (m[11] < 0 ? m[15] == 0 && m[12] == 0 && m[13] == 0 : m[11] == 0);
}

/* The point shown at x, y of the clip cube, on its near (-1) or far side. */
static void shown_at(const float inverse[16], float x, float y, float z, float out[3])
{
	float at[4];

	mat4_transform(at, inverse, (const float[4]){ x, y, z, 1 });
	for (int k = 0; k < 3; k++)
		out[k] = at[k] / at[3];
}

static void find_recorded(const struct scene_view *view, float eye_from_recorded[16])
{
	float inverse[16], near[3], far[3], above[3], forward[3], up[3], from_eye[16], center[4];

	memcpy(eye_from_recorded, mat4_identity, 16 * sizeof(*eye_from_recorded));
	if (is_plain(view->projection) || !mat4_invert(inverse, view->projection))
		return;
	shown_at(inverse, 0, 0, -1, near);
	shown_at(inverse, 0, 0, 0.5f, far);
	shown_at(inverse, 0, 1, -1, above);
	vec3f_subtract(far, near, forward);
	vec3f_subtract(above, near, up);
	mat4_transform(center, inverse, (const float[4]){ 0, 0, 1, 0 }); /* the point where all lines of sight meet */
	for (int k = 0; k < 3 && !drawn_in_parallel(view); k++)
		near[k] = center[k] / center[3];
	if (!isfinite(near[0] + near[1] + near[2]) || !stand(near, forward, up, eye_from_recorded, from_eye))
		memcpy(eye_from_recorded, mat4_identity, 16 * sizeof(*eye_from_recorded));
}

/* The projection of a view in the recorded camera's own space, which looks along -z. */
static void project_recorded(const struct viewpoint *v, const struct scene_view *view, float out[16])
{
	mat4_mul(out, view->projection, v->eye_from_recorded);
	for (int i = 0; i < 16 && out[11] != -1; i++)
		if (i != 11 && out[11] < 0)
			out[i] /= -out[11];
	out[11] = out[11] < 0 ? -1 : out[11];
}

/* Find the middle of the visible part of the frame: of the box around all visible vertices, in eye space. */
static void find_middle(const struct scene *s, const struct viewpoint *v, float out[3])
{
	float low[3] = { INFINITY, INFINITY, INFINITY }, high[3] = { -INFINITY, -INFINITY, -INFINITY };

	for (uint32_t i = 0; i < s->n_instances; i++) {
		const struct scene_instance *in = &s->instances[i];
		const struct scene_mesh *mesh = s->meshes[in->mesh];
		const struct scene_view *view = &s->views[in->view];

		for (uint32_t n = 0; n < mesh->vertex_count && solid_is(s, in) && view->space == s->views[v->main_view].space; n++) {
			float at[4], clip[4];

			mat4_transform(at, in->modelview, mesh->position + 4 * (size_t)n);
			mat4_transform(clip, view->projection, at);
			if (!(fabsf(clip[0]) <= clip[3] && fabsf(clip[1]) <= clip[3] && fabsf(clip[2]) <= clip[3] && at[3] != 0))
				continue;
			for (int k = 0; k < 3; k++) {
				low[k] = fminf(low[k], at[k] / at[3]);
				high[k] = fmaxf(high[k], at[k] / at[3]);
			}
		}
	}
	move_place(v->eye_from_recorded, (const float[3]){ 0, 0, -1 }, out);
	for (int k = 0; k < 3 && low[0] <= high[0]; k++)
		out[k] = 0.5f * (low[k] + high[k]);
}

/* --- Position ---------------------------------------------------------------------------------------------------- */

/* The camera's position and target in eye space. */
struct stance {
	float place[3], at[3], up[3];
};

static void go_around(const struct camera *camera, uint32_t number, struct stance *s)
{
	const struct camera_turntable *t = camera->keys->turntable;
	const double degrees = (t->degrees ? (double)*t->degrees : 360.0) * number / camera_pictures(camera);
	float rotation[16], axis[3], arm[3];

	memcpy(axis, s->up, sizeof(axis));
	if (!number || !normalize(axis))
		return;
	mat4_rotation(rotation, (float)degrees, axis[0], axis[1], axis[2]);
	vec3f_subtract(s->place, s->at, arm);
	mat4_turn(arm, rotation, arm);
	for (int k = 0; k < 3; k++)
		s->place[k] = s->at[k] + arm[k];
}

static void find_stance(const struct camera *camera, const float space[16], const struct viewpoint *v,
                        const float middle[3], uint32_t number, struct stance *out)
{
	const struct camera_keys *k = camera->keys;
	const float *at = k->turntable ? k->turntable->about : k->look_at;

	if (k->place)
		move_place(space, k->place, out->place);
	else
		memcpy(out->place, v->eye_from_recorded + 12, sizeof(out->place));
	mat4_turn(out->up, space, k->up ? k->up : (const float[3]){ 0, 1, 0 });
	if (at)
		move_place(space, at, out->at);
	else if (k->turntable)
		memcpy(out->at, middle, sizeof(out->at));
	for (int i = 0; i < 3 && !at && !k->turntable; i++)
		out->at[i] = out->place[i] - v->eye_from_recorded[8 + i];
	if (k->turntable)
		go_around(camera, number, out);
}

/* The distance to the target. */
static float find_distance(const struct camera_keys *k, const struct stance *s, const float middle[3])
{
	float to[3], forward[3], along = 0;

	vec3f_subtract(s->at, s->place, forward);
	if (k->look_at || k->turntable)
		return length_of(forward);
	vec3f_subtract(middle, s->place, to);
	normalize(forward);
	for (int i = 0; i < 3; i++)
		along += to[i] * forward[i];
	return along > 0 ? along : length_of(to);
}

static int find_space(const struct camera *camera, const struct look *look, const struct scene *scene,
                      const struct viewpoint *v, float out[16])
{
	memcpy(out, v->eye_from_recorded, 16 * sizeof(*out));
	if (!camera_is_in_world(camera) || (look && world_find(look->rules, scene, out, NULL)))
		return 0;
	return err_report(
		ERR_INPUT, camera->path,
		"frame %llu: space is world, but no mesh of the frame is in the list `world` of --look",
		(unsigned long long)scene->frame);
}

int viewpoint_find(const struct camera *camera, const struct look *look, const struct scene *scene, uint32_t number,
                   struct viewpoint *out)
{
	const struct camera_keys *k = camera->keys;
	float space[16], middle[3], forward[3], moved[16];
	struct stance stance;
	int err;

	*out = (struct viewpoint){ .keys = k, .main_view = find_main_view(scene) };
	if (out->main_view == SCENE_NONE)
		return 0;
	find_recorded(&scene->views[out->main_view], out->eye_from_recorded);
	err = find_space(camera, look, scene, out, space);
	if (err)
		return err;
	find_middle(scene, out, middle);
	find_stance(camera, space, out, middle, number, &stance);
	vec3f_subtract(stance.at, stance.place, forward);
	if (!stand(stance.place, forward, stance.up, out->eye_from_camera, out->camera_from_eye))
		return err_report(ERR_INPUT, camera->path,
		                  "frame %llu: no such camera: up is parallel to the line of sight, or place and "
		                  "look_at are the same",
		                  (unsigned long long)scene->frame);
	mat4_mul(moved, out->camera_from_eye, out->eye_from_recorded);
	out->is_moved = memcmp(moved, mat4_identity, sizeof(moved)) != 0;
	memcpy(out->sky_from_eye, out->camera_from_eye, sizeof(out->sky_from_eye));
	memset(out->sky_from_eye + 12, 0, 3 * sizeof(float));
	mat4_turn(moved, out->camera_from_eye, out->eye_from_recorded + 12);
	for (int i = 0; i < 3; i++)
		out->sky_from_eye[12 + i] = 0.0f - moved[i];
	out->was_parallel = drawn_in_parallel(&scene->views[out->main_view]);
	out->is_parallel = k->kind          ? camera_is_kind(k, "orthographic") :
	                   k->height        ? 1 :
	                   k->field_of_view ? 0 :
	                                      out->was_parallel;
	out->distance = find_distance(k, &stance, middle);
	out->aspect = k->size ? (float)k->size[0] / (float)k->size[1] :
	              scene->views[out->main_view].viewport[2] / scene->views[out->main_view].viewport[3];
	if (k->near && !out->is_parallel && !(*k->near > 0))
		return err_report(ERR_INPUT, camera->path, "near is %g; for a pinhole, it must be above 0",
		                  (double)*k->near);
	return 0;
}

/* --- Projection -------------------------------------------------------------------------------------------------- */

/* Set rows x and y. @param recorded  project_recorded of the view */
static void project_across(const struct viewpoint *v, const struct scene *scene, const float recorded[16],
                           float out[16])
{
	const struct scene_view *main_view = &scene->views[v->main_view];
	float of_main[16], up;

	if (v->is_parallel == v->was_parallel && !v->keys->field_of_view && !v->keys->height) {
		const float share = v->keys->size ? main_view->viewport[2] / main_view->viewport[3] / v->aspect : 1;

		for (int c = 0; c < 4; c++) {
			out[4 * c] = recorded[4 * c] * share;
			out[4 * c + 1] = recorded[4 * c + 1];
		}
		return;
	}
	project_recorded(v, main_view, of_main);
	up = fabsf(of_main[5]);
	if (v->keys->height)
		up = 2 / *v->keys->height;
	else if (v->keys->field_of_view)
		up = (float)(1 / tan((double)*v->keys->field_of_view * (3.14159265358979323846 / 360)));
	else if (v->is_parallel && !v->was_parallel)
		up /= v->distance;
	else if (!v->is_parallel && v->was_parallel)
		up *= v->distance;
	out[0] = up / v->aspect;
	out[5] = up;
}

/* Find the range of depths that contains what the view showed, as seen from here. @param far  infinite if the view
 * had no end */
static void find_depths(const struct viewpoint *v, const float recorded[16], float *near, float *far)
{
	float inverse[16], camera_from_recorded[16];
	const int is_endless = recorded[11] < 0 && !(recorded[10] < -1.0000001f);

	*near = INFINITY;
	*far = is_endless ? INFINITY : -INFINITY;
	mat4_mul(camera_from_recorded, v->camera_from_eye, v->eye_from_recorded);
	for (int corner = 0; corner < 8 && mat4_invert(inverse, recorded) && !is_endless; corner++) {
		float at[3];

		shown_at(inverse, corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1, at);
		move_place(camera_from_recorded, at, at);
		*near = fminf(*near, -at[2]);
		*far = fmaxf(*far, -at[2]);
	}
	if (!v->was_parallel) { /* extend to the sides as far as the program saw forwards */
		*near = recorded[14] / (recorded[10] - 1);
		*far = is_endless ? INFINITY : fmaxf(*far, recorded[14] / (recorded[10] + 1));
	}
	if (!v->was_parallel && v->is_parallel)
		*near = 0;
	if (v->was_parallel && !v->is_parallel) {
		*far = fmaxf(*far, 2 * v->distance);
		*near = fmaxf(*near, 1e-3f * fminf(*far, v->distance));
	}
}

/* Set rows z and w. */
static void project_along(const struct viewpoint *v, const float recorded[16], float out[16])
{
	float near, far;

	find_depths(v, recorded, &near, &far);
	near = v->keys->near ? *v->keys->near : near;
	far = v->keys->far ? *v->keys->far : far;
	if (!(far > near)) /* one of them is from the file */
		near = v->keys->far ? v->is_parallel ? far - 1 : 0.5f * far : near;
	if (!(far > near))
		far = v->is_parallel ? near + 1 : 2 * near;
	if (v->is_parallel && isinf(far))
		far = near + 1e6f * v->distance;
	out[10] = v->is_parallel ? -2 / (far - near) : isinf(far) ? -1 : -(far + near) / (far - near);
	out[14] = v->is_parallel ? -(far + near) / (far - near) : isinf(far) ? -2 * near : -2 * far * near / (far - near);
	out[11] = v->is_parallel ? 0 : -1;
	out[15] = v->is_parallel ? 1 : 0;
}

void viewpoint_project(const struct viewpoint *v, const struct scene *scene, const struct scene_view *view,
                       float out[16])
{
	const int is_same = !v->is_moved && v->is_parallel == v->was_parallel && !v->keys->near && !v->keys->far;
	float recorded[16];

	project_recorded(v, view, recorded);
	memset(out, 0, 16 * sizeof(*out));
	project_across(v, scene, recorded, out);
	if (!is_same)
		project_along(v, recorded, out);
	for (int c = 0; c < 4 && is_same; c++) {
		out[4 * c + 2] = recorded[4 * c + 2];
		out[4 * c + 3] = recorded[4 * c + 3];
	}
}
