#include "look/apply/unseen.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/mat4.h"
#include "base/memory.h"
#include "gl_tokens.h"
#include "look/draws/corner.h"
#include "look/draws/drawn.h"
#include "look/draws/solid.h"
#include "look/rules/rules.h"
#include "look/rules/world.h"
#include "look/spare/blockers.h"

/* PLACES of a mesh in view are tested by rays; PROOF of them prove that the mesh is gone. */
enum { PLACES = 256, PROOF = 2 };
/* A place is in view if it is within this share of the window. */
#define WITHIN 0.98f
/* Tolerance for the same mesh at the same place, as a share of its distance. */
#define SAME 2e-3f

/* A scene that is being extended. */
struct adding {
	const struct look *look;
	const struct scene *scene;
	struct scene *out;
	size_t room_instances, room_materials, room_units, room_lights, room_currents, room_meshes, room_textures;
	struct blockers *blockers; /* in the scene */
	uint32_t main_view;        /* the view that shows the viewer's world */
	float (*places)[3];        /* places in view that rays are sent to */
	size_t room_places;
};

/* --- Candidates -------------------------------------------------------------------------------------------------- */

static int is_same_place(const float a[16], const float b[16])
{
	float far = 1;

	for (int i = 12; i < 15; i++)
		far = fmaxf(far, fabsf(a[i]));
	for (int i = 0; i < 15; i++)
		if (!(fabsf(a[i] - b[i]) <= (i < 12 ? SAME : SAME * far)))
			return 0;
	return 1;
}

/* 1 if a scene draws a mesh at a place. */
static int is_drawn(const struct scene *s, const struct scene_mesh *mesh, const float modelview[16])
{
	for (uint32_t i = 0; i < s->n_instances; i++)
		if (memcmp(s->meshes[s->instances[i].mesh]->hash, mesh->hash, sizeof(mesh->hash)) == 0 &&
		    is_same_place(s->instances[i].modelview, modelview))
			return 1;
	return 0;
}

/* 1 if an instance depends on nothing but its place in eye space, so that its material can be moved with the viewer. */
static int can_move(const struct scene *s, const struct scene_instance *in)
{
	const struct scene_material *m = &s->materials[in->material];

	if (!solid_is(s, in) || m->clip_plane_mask || drawn_in_parallel(&s->views[in->view]))
		return 0;
	for (uint32_t i = 0; i < m->unit_count; i++)
		for (int c = 0; c < 4; c++)
			if (s->units[m->unit_first + i].gen_mode[c] == GL_EYE_LINEAR)
				return 0;
	return 1;
}

/* A primitive's middle, and a normal as long as twice its area; in the modelview's space. */
static void find_middle(const struct scene_mesh *mesh, const float modelview[16], uint32_t primitive, float middle[3],
                        float normal[3])
{
	float corner[3][4];

	for (unsigned c = 0; c < 3; c++)
		mat4_transform(corner[c], modelview, corner_place(mesh, primitive, c));
	for (int k = 0; k < 3; k++) {
		const int i = (k + 1) % 3, j = (k + 2) % 3;

		middle[k] = (corner[0][k] + corner[1][k] + corner[2][k]) / 3;
		normal[k] = (corner[1][i] - corner[0][i]) * (corner[2][j] - corner[0][j]) -
		            (corner[1][j] - corner[0][j]) * (corner[2][i] - corner[0][i]);
	}
}

static float facing(const float middle[3], const float normal[3])
{
	return middle[0] * normal[0] + middle[1] * normal[1] + middle[2] * normal[2];
}

static int is_in_view(const struct scene_view *view, const float at[3])
{
	float clip[4];

	mat4_transform(clip, view->projection, (const float[4]){ at[0], at[1], at[2], 1 });
	return clip[3] > 0 && fabsf(clip[0]) < WITHIN * clip[3] && fabsf(clip[1]) < WITHIN * clip[3] &&
	       fabsf(clip[2]) < clip[3];
}

/* 1 if a primitive is in view and turns the same side to the viewer as when it was drawn. */
static int is_to_be_seen(const struct scene_view *view, const struct scene_mesh *mesh, const float then[16],
                         const float now[16], uint32_t primitive, float middle[3])
{
	float normal[3], before[3], turned[3];

	find_middle(mesh, then, primitive, before, turned);
	find_middle(mesh, now, primitive, middle, normal);
	return facing(middle, normal) * facing(before, turned) > 0 && is_in_view(view, middle);
}

/*
 * 1 if a mesh is gone or has been replaced: some of it would be visible, and nothing in the frame hides it. A ground
 * that is triangulated differently in each frame lies half above and half below itself. @param then, now  its
 * modelviews
 * @return ERR_SYSTEM: out of memory
 */
static int is_gone(struct adding *a, const struct scene_mesh *mesh, const float then[16], const float now[16])
{
	const struct scene_view *view = &a->scene->views[a->main_view];
	const unsigned proof = mesh->primitive_count < PROOF ? mesh->primitive_count : PROOF;
	size_t n = 0;
	unsigned open = 0;

	if (MEMORY_GROW(a->places, a->room_places, mesh->primitive_count))
		return ERR_SYSTEM;
	for (uint32_t p = 0; p < mesh->primitive_count; p++)
		n += (size_t)is_to_be_seen(view, mesh, then, now, p, a->places[n]);
	for (size_t i = 0; i < n && open < proof; i += n / PLACES + 1) {
		struct blocker_hit hits[BLOCKERS_MOST];

		open += !blockers_on(a->blockers, view->space, (const float[3]){ 0, 0, 0 }, a->places[i], 0.995f, hits);
	}
	return open >= proof;
}

/* --- Extending a scene ------------------------------------------------------------------------------------------- */

#define APPEND(a, items, item) \
	(MEMORY_GROW((a)->out->items, (a)->room_##items, (a)->out->n_##items + (size_t)1) ? ERR_SYSTEM : \
	 ((a)->out->items[(a)->out->n_##items++] = (item), 0))

static int add_texture(struct adding *a, const struct scene_texture *texture, uint32_t *index)
{
	for (*index = 0; *index < a->out->n_textures; ++*index)
		if (memcmp(a->out->textures[*index]->hash, texture->hash, sizeof(texture->hash)) == 0)
			return 0;
	return APPEND(a, textures, texture);
}

/* A light as it is now: the frame's own light with this number, or the old one, moved with the world. */
static int add_light(struct adding *a, const struct scene_light *light, const float now_from_then[16])
{
	struct scene_light moved = *light;
	float turned[4];

	for (uint32_t i = 0; i < a->scene->n_lights; i++)
		if (a->scene->lights[i].index == light->index) {
			moved = a->scene->lights[i];
			return APPEND(a, lights, moved);
		}
	mat4_transform(moved.position_eye, now_from_then, light->position_eye);
	mat4_transform(turned, now_from_then,
	               (const float[4]){ light->spot_direction_eye[0], light->spot_direction_eye[1],
	                                 light->spot_direction_eye[2], 0 });
	memcpy(moved.spot_direction_eye, turned, sizeof(moved.spot_direction_eye));
	return APPEND(a, lights, moved);
}

static int add_material(struct adding *a, const struct scene *from, const struct scene_material *was,
                        const float now_from_then[16])
{
	struct scene_material m = *was;
	int err = 0;

	m.unit_first = a->out->n_units;
	m.light_first = a->out->n_lights;
	m.polygon_stipple = SCENE_NONE;
	m.fragment_program = 0;
	for (uint32_t i = 0; i < m.unit_count && !err; i++) {
		struct scene_unit unit = from->units[was->unit_first + i];

		err = add_texture(a, from->textures[unit.texture], &unit.texture);
		if (!err)
			err = APPEND(a, units, unit);
	}
	for (uint32_t i = 0; i < m.light_count && !err; i++)
		err = add_light(a, &from->lights[was->light_first + i], now_from_then);
	return err ? err : APPEND(a, materials, m);
}

/* Add a draw of another frame. @param hidden  the view that covers no pixel */
static int add_instance(struct adding *a, const struct scene *from, const struct scene_instance *in,
                        const float now_from_then[16], uint32_t hidden)
{
	struct scene_instance added = *in;
	const struct scene_mesh *mesh = from->meshes[in->mesh];
	int err;

	mat4_mul(added.modelview, now_from_then, in->modelview);
	if (is_drawn(a->scene, mesh, added.modelview))
		return 0;
	err = is_gone(a, mesh, in->modelview, added.modelview);
	if (err)
		return err < 0 ? err : 0;
	added.mesh = a->out->n_meshes;
	added.material = a->out->n_materials;
	added.view = hidden;
	added.current = a->out->n_currents;
	added.draw = a->scene->n_draws;
	added.first_primitive = a->out->n_primitives;
	a->out->n_primitives += mesh->primitive_count;
	err = add_material(a, from, &from->materials[in->material], now_from_then);
	if (!err)
		err = APPEND(a, meshes, mesh);
	if (!err)
		err = APPEND(a, currents, from->currents[in->current]);
	return err ? err : APPEND(a, instances, added);
}

#define COPY(a, items) \
	(MEMORY_GROW((a)->out->items, (a)->room_##items, (a)->scene->n_##items + (size_t)1) ? ERR_SYSTEM : \
	 ((a)->scene->n_##items ? (void)memcpy((a)->out->items, (a)->scene->items, \
	 (a)->scene->n_##items * sizeof(*(a)->out->items)) : (void)0, 0))

/* Copy the scene's arrays, and add a view of the main view's space that covers no pixel. */
static int copy(struct adding *a)
{
	struct scene *out = a->out;
	const struct scene *s = a->scene;

	*out = *s;
	out->instances = NULL;
	out->materials = NULL;
	out->units = NULL;
	out->lights = NULL;
	out->currents = NULL;
	out->meshes = NULL;
	out->textures = NULL;
	out->views = malloc((s->n_views + (size_t)1) * sizeof(*out->views));
	if (!out->views || COPY(a, instances) || COPY(a, materials) || COPY(a, units) || COPY(a, lights) ||
	    COPY(a, currents) || COPY(a, meshes) || COPY(a, textures))
		return ERR_SYSTEM;
	memcpy(out->views, s->views, s->n_views * sizeof(*out->views));
	out->views[s->n_views] = s->views[a->main_view];
	memset(out->views[s->n_views].scissor, 0, sizeof(out->views[s->n_views].scissor));
	out->n_views++;
	return 0;
}

/* Find the view that shows the most solid surfaces in perspective. @return 0: there is none */
static int find_main_view(struct adding *a)
{
	const struct scene *s = a->scene;
	uint32_t most = 0;

	for (uint32_t v = 0; v < s->n_views; v++) {
		uint32_t n = 0;

		for (uint32_t i = 0; i < s->n_instances; i++)
			n += s->instances[i].view == v && solid_is(s, &s->instances[i]) && !drawn_in_parallel(&s->views[v]);
		if (n > most) {
			most = n;
			a->main_view = v;
		}
	}
	return most > 0;
}

/* Add what rule k lists of its frame, if that frame shows the same part of the world. */
static int add_frame(struct adding *a, uint32_t k, const float eye_from_world[16], uint32_t part)
{
	const struct scene *from = a->look->unseen[k].scene;
	float then[16], world_from_then[16], now_from_then[16];
	uint32_t part_then;
	int err = 0;

	if (!from || from->frame == a->scene->frame || !world_find(a->look->rules, from, then, &part_then) ||
	    part_then != part || !mat4_invert(world_from_then, then))
		return 0;
	mat4_mul(now_from_then, eye_from_world, world_from_then);
	for (uint32_t i = 0; i < from->n_instances && !err; i++)
		if (frame_list_contains(&a->look->unseen[k].draws, from->instances[i].draw) && can_move(from, &from->instances[i]))
			err = add_instance(a, from, &from->instances[i], now_from_then, a->scene->n_views);
	return err;
}

int unseen_add(const struct look *look, const struct scene *scene, struct scene *out)
{
	struct adding a = { .look = look, .scene = scene, .out = out };
	float eye_from_world[16];
	uint32_t part;
	int err;

	*out = (struct scene){ .instances = NULL };
	if (!look || !look->rules->unseen_count || !find_main_view(&a) ||
	    !world_find(look->rules, scene, eye_from_world, &part))
		return 0;
	err = copy(&a);
	if (!err)
		err = blockers_create(scene, &a.blockers);
	for (uint32_t k = 0; k < look->rules->unseen_count && !err; k++)
		err = add_frame(&a, k, eye_from_world, part);
	blockers_destroy(&a.blockers);
	free(a.places);
	if (err || out->n_instances == scene->n_instances)
		unseen_release(out);
	return err ? err_report(ERR_SYSTEM, NULL, "out of memory") : 0;
}

void unseen_release(struct scene *added)
{
	free(added->instances);
	free(added->materials);
	free(added->units);
	free(added->lights);
	free(added->currents);
	free(added->meshes);
	free(added->textures);
	free(added->views);
	memset(added, 0, sizeof(*added));
}
