#include "look/look.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "base/err.h"
#include "base/frames.h"
#include "base/mat4.h"
#include "look/crease.h"
#include "look/film.h"
#include "look/gloss.h"
#include "look/modelview.h"
#include "look/plane.h"
#include "look/repaired.h"
#include "look/rules.h"
#include "look/solid.h"
#include "look/spare.h"
#include "look/world.h"
#include "scene/draw_list.h"
#include "scene/repair/holds.h"

/* Between ambient light and what a program rounds to 8 bits. */
#define SHADE (2.0f / 255)

/* --- Which surfaces ------------------------------------------------------------------------------------------------ */

static int has_texture(const struct scene *s, const struct scene_material *m, const char *text)
{
	for (uint32_t i = 0; i < m->unit_count; i++)
		if (world_hash_begins(s->textures[s->units[m->unit_first + i].texture]->hash, text))
			return 1;
	return 0;
}

int look_multiplies(const struct scene_material *m)
{
	return m->blend && ((m->blend_src_rgb == GL_DST_COLOR && m->blend_dst_rgb == GL_ZERO) ||
	                    (m->blend_src_rgb == GL_ZERO && m->blend_dst_rgb == GL_SRC_COLOR));
}

static int is_environment_mapped(const struct scene *s, const struct scene_material *m)
{
	for (uint32_t i = 0; i < m->unit_count; i++)
		for (int c = 0; c < 3; c++) {
			uint32_t mode = s->units[m->unit_first + i].gen_mode[c];

			if (mode == GL_SPHERE_MAP || mode == GL_REFLECTION_MAP)
				return 1;
		}
	return 0;
}

int look_is_parallel(const struct scene_view *view)
{
	return view->projection[3] == 0 && view->projection[7] == 0 && view->projection[11] == 0;
}

static int differs(const bool *wanted, int is)
{
	return wanted && *wanted != (is != 0);
}

static int matches(const struct scene *s, const struct scene_instance *in, const struct match *r,
                   const struct frame_list *draws)
{
	const struct scene_material *m = &s->materials[in->material];
	const struct scene_draw *draw = s->draws ? &s->draws[in->draw] : NULL;

	if (!r)
		return 1;
	if ((r->texture && !has_texture(s, m, r->texture)) || (r->mesh && !world_hash_begins(s->meshes[in->mesh]->hash, r->mesh)))
		return 0;
	if ((r->draws && !frame_list_contains(draws, in->draw)) || (r->call && (!draw || strcmp(draw->call, r->call) != 0)))
		return 0;
	if (r->list && (!draw || draw->list != *r->list))
		return 0;
	if (r->modelview && modelview_named(r->modelview) != modelview_kind_of(in->modelview))
		return 0;
	if ((r->units && *r->units != m->unit_count) || differs(r->stencil_tested, (int)m->stencil_test) ||
	    differs(r->multiplies, look_multiplies(m)) || differs(r->environment_mapped, is_environment_mapped(s, m)) ||
	    differs(r->parallel, look_is_parallel(&s->views[in->view])))
		return 0;
	return !differs(r->program, (int)m->program) && !differs(r->lit, (int)m->lighting) &&
	       !differs(r->textured, m->unit_count > 0) && !differs(r->blended, (int)m->blend) &&
	       !differs(r->alpha_tested, (int)m->alpha_test) && !differs(r->depth_tested, (int)m->depth_test);
}

static void set_number(float *to, const float *from, int n)
{
	if (from)
		memcpy(to, from, (size_t)n * sizeof(*to));
}

/* spares: 1 unless rules say `spare: no` */
static void set_surface(struct scene_surface *s, const struct surface_rule *r, int spares)
{
	uint32_t passes;

	set_number(&s->reflect, r->reflect, 1);
	if (r->reflect) { /* it is no longer what highlights say */
		s->hidden &= ~SCENE_NEAR_MIRROR;
		s->roughness = 0;
	}
	set_number(&s->transmit, r->transmit, 1);
	set_number(&s->ior, r->ior, 1);
	set_number(&s->roughness, r->roughness, 1);
	set_number(s->absorb, r->absorb, 3);
	set_number(s->emission, r->emission, 3);
	if (r->passes && spares && spare_named(r->passes, &passes))
		s->hidden = (s->hidden & ~SPARE_BITS) | passes;
	if (r->shadows)
		s->hidden = (s->hidden & ~(SPARE_BITS | SCENE_CARD | SCENE_FACETED | SCENE_FILM)) | (*r->shadows ? 0u : SCENE_HIDDEN_FROM_LIGHTS);
	if (r->mirrors)
		s->hidden = (s->hidden & ~SCENE_HIDDEN_FROM_MIRRORS) | (*r->mirrors ? 0u : SCENE_HIDDEN_FROM_MIRRORS);
	if (r->near)
		s->hidden = (s->hidden & ~SCENE_NEAR_MIRROR) | (*r->near ? SCENE_NEAR_MIRROR : 0);
	if (r->shaded)
		s->hidden = (s->hidden & ~SCENE_UNSHADED) | (*r->shaded ? 0 : SCENE_UNSHADED);
	if (r->left_out)
		s->hidden = (s->hidden & ~SCENE_LEFT_OUT) | (*r->left_out ? SCENE_LEFT_OUT : 0);
	if (r->solid)
		s->hidden = (s->hidden & ~SCENE_SOLID) | (*r->solid ? SCENE_SOLID : 0);
	if (r->lightmap)
		s->light_unit = *r->lightmap + 1;
	if (r->vertex_light)
		s->light_unit = *r->vertex_light ? SCENE_LIGHT_IN_COLORS : 0;
	if (r->shadow_unit)
		s->light_unit = *r->shadow_unit + 1;
	if (r->lit)
		s->relit = *r->lit;
	if (r->dome)
		s->hidden = (s->hidden & ~SCENE_DOME_LIT) | (*r->dome ? SCENE_DOME_LIT : 0);
}

/* --- Lights -------------------------------------------------------------------------------------------------------- */

/* Rules that only give a light a size leave GL's lighting as it is. */
static int changes_light(const struct light_rule *r)
{
	if (!r->light)
		return !r->off || !*r->off;
	return r->off || r->position || r->ambient || r->diffuse || r->specular || r->attenuation || r->spot;
}

/* A scene on its way under the rules. */
struct applying {
	const struct look *look;
	const struct rules *rules; /* the look's */
	const struct spare *spare; /* NULL: nothing is spared */
	const struct scene *scene;
	struct scene *out;
	float eye_from_world[16], world_from_eye[16]; /* where lights and planes of the world are */
	int knows_world;
	int has_mirror;           /* pictures in mirrors may be left out */
	uint8_t *in_plane;        /* [instances][surfaces]: whether a rule's plane holds an instance, 1 no, 2 yes; 0: not asked yet */
	int lights_change;        /* bits: 1 of what OpenGL does not light, 2 of what it lights, 4 where a unit holds a shadow, 8 where faces look round */
};

static int is_in_world(const struct light_rule *r)
{
	return r->space && strcmp(r->space, "world") == 0;
}

/* Bits as applying.lights_change. */
static int lit_by(const struct light_rule *r)
{
	return r->on && strcmp(r->on, "unlit") == 0 ? 1 : 3;
}

/* A light's position in eye space. It stays as written where the frame does not draw its object. */
static void place_light(const struct applying *a, const struct light_rule *r, float out[4])
{
	const struct scene *s = a->scene;

	memcpy(out, r->position, 4 * sizeof(*out));
	if (is_in_world(r))
		mat4_transform(out, a->eye_from_world, r->position);
	for (uint32_t i = 0; r->object && i < s->n_instances; i++)
		if (world_hash_begins(s->meshes[s->instances[i].mesh]->hash, r->object)) {
			mat4_transform(out, s->instances[i].modelview, r->position);
			return;
		}
}

static void turn_spot(const struct applying *a, const struct light_rule *r, float out[3])
{
	memcpy(out, r->spot->direction, 3 * sizeof(*out));
	if (is_in_world(r))
		mat4_turn(out, a->eye_from_world, out);
}

/* How large it is, or that nothing stops it. */
static void size_light(struct scene_light *l, const struct light_rule *r)
{
	set_number(&l->radius, r->radius, 1);
	if (r->shadows)
		l->radius = *r->shadows ? fmaxf(l->radius, 0) : -1;
}

static void set_light(const struct applying *a, struct scene_light *l, const struct light_rule *r)
{
	if (r->position)
		place_light(a, r, l->position_eye);
	set_number(l->ambient, r->ambient, 3);
	set_number(l->diffuse, r->diffuse, 3);
	set_number(l->specular, r->specular, 3);
	set_number(l->attenuation, r->attenuation, 3);
	size_light(l, r);
	if (!r->spot)
		return;
	if (r->spot->direction)
		turn_spot(a, r, l->spot_direction_eye);
	set_number(&l->spot_cutoff_deg, r->spot->cutoff, 1);
	set_number(&l->spot_exponent, r->spot->exponent, 1);
}

/* GL's lights of a material under the rules. @return how many */
static uint32_t list_own_lights(const struct applying *a, const struct scene_material *m, struct scene_light *out)
{
	const struct rules *rules = a->rules;
	uint32_t n = 0;

	for (uint32_t i = 0; m->lighting && i < m->light_count && n < SCENE_MAX_LIGHTS; i++) {
		struct scene_light light = a->scene->lights[m->light_first + i];
		int off = 0;

		for (uint32_t k = 0; k < rules->lights_count; k++) {
			const struct light_rule *r = &rules->lights[k];

			if (!r->light || *r->light != light.index)
				continue;
			set_light(a, &light, r);
			off = r->off ? *r->off : off;
		}
		if (!off)
			out[n++] = light;
	}
	return n;
}

/* How much light reaches an object's middle at most, the ambient part doubly: it reaches all of it. */
static float strength_at(const struct scene_light *l, const float middle[4])
{
	float square = 0, distance, power = 0;

	for (int k = 0; k < 3; k++) {
		float to = l->position_eye[3] != 0 ? l->position_eye[k] / l->position_eye[3] - middle[k] : 0;

		square += to * to;
		power = fmaxf(power, l->diffuse[k] + 2 * l->ambient[k]);
	}
	distance = sqrtf(square);
	if (l->position_eye[3] == 0)
		return power;
	return power / (l->attenuation[0] + distance * (l->attenuation[1] + distance * l->attenuation[2]) + 1e-6f);
}

/* The middle of an instance's box, in eye space. */
static void middle_of(const struct scene *s, const struct scene_instance *in, float out[4])
{
	const struct scene_mesh *mesh = s->meshes[in->mesh];
	float low[3] = { 0, 0, 0 }, high[3] = { 0, 0, 0 };

	for (uint32_t v = 0; v < mesh->vertex_count; v++)
		for (int k = 0; k < 3; k++) {
			float x = mesh->position[4 * v + k];

			low[k] = v && low[k] < x ? low[k] : x;
			high[k] = v && high[k] > x ? high[k] : x;
		}
	mat4_transform(out, in->modelview, (const float[4]){ 0.5f * (low[0] + high[0]), 0.5f * (low[1] + high[1]), 0.5f * (low[2] + high[2]), 1 });
}

/* An instance's lights: GL's under the rules, and added ones, the strongest where they are too many. @return how many */
static uint32_t list_lights(const struct applying *a, const struct scene_instance *in, const struct scene_material *m,
                            struct scene_light out[SCENE_MAX_LIGHTS])
{
	const struct rules *rules = a->rules;
	uint32_t own = list_own_lights(a, m, out), n = own;
	float strength[SCENE_MAX_LIGHTS], middle[4];

	if (rules->lights_count > SCENE_MAX_LIGHTS - own)
		middle_of(a->scene, in, middle);
	for (uint32_t k = 0; k < rules->lights_count && own < SCENE_MAX_LIGHTS; k++) {
		const struct light_rule *r = &rules->lights[k];
		struct scene_light light = { .diffuse = { 1, 1, 1, 1 }, .spot_direction_eye = { 0, 0, -1 }, .spot_cutoff_deg = 180,
			                     .attenuation = { 1, 0, 0 }, .index = SCENE_NONE };
		uint32_t at = n, weakest = own;

		if (r->light || (r->off && *r->off) || !(lit_by(r) >> (m->lighting != 0) & 1))
			continue;
		set_light(a, &light, r);
		strength[at % SCENE_MAX_LIGHTS] = 0;
		if (rules->lights_count > SCENE_MAX_LIGHTS - own) {
			for (uint32_t i = own; i < n; i++)
				weakest = strength[i] < strength[weakest] ? i : weakest;
			at = n < SCENE_MAX_LIGHTS ? n : weakest;
			if (n == SCENE_MAX_LIGHTS && strength_at(&light, middle) <= strength[at])
				continue;
			strength[at] = strength_at(&light, middle);
		}
		out[at] = light;
		n += at == n;
	}
	return n;
}

/* --- A scene ------------------------------------------------------------------------------------------------------- */

static void size_lights(const struct rules *rules, struct scene *s)
{
	for (uint32_t i = 0; i < s->n_lights; i++)
		for (uint32_t k = 0; k < rules->lights_count; k++)
			if (rules->lights[k].light && *rules->lights[k].light == s->lights[i].index)
				size_light(&s->lights[i], &rules->lights[k]);
}

/* 1 where a rule replaces a trick, and the file says that tricks stay. */
static int is_kept(const struct rules *rules, const struct surface_rule *r)
{
	return rules->replace && !*rules->replace && (r->left_out || r->solid || r->shadow_unit);
}

static void set_sky(const struct applying *a)
{
	static const float white[3] = { 1, 1, 1 };
	const struct sky_rule *r = a->rules->sky;
	struct scene_dome *dome = &a->out->dome;
	float up[4] = { 0, 0, 0, 0 }, turned[4], length;

	if (!r)
		return;
	dome->reach = *r->reach;
	memcpy(dome->light, r->light ? r->light : white, sizeof(dome->light));
	memcpy(dome->ground, r->ground ? r->ground : dome->light, sizeof(dome->ground));
	dome->lit = r->lit ? *r->lit : 0;
	if (!r->up || (r->space && strcmp(r->space, "world") == 0 && !a->knows_world))
		return;
	memcpy(up, r->up, 3 * sizeof(*up));
	memcpy(turned, up, sizeof(turned));
	if (r->space && strcmp(r->space, "world") == 0)
		mat4_transform(turned, a->eye_from_world, up);
	length = sqrtf(turned[0] * turned[0] + turned[1] * turned[1] + turned[2] * turned[2]);
	for (int k = 0; k < 3 && length > 0; k++)
		dome->up_eye[k] = turned[k] / length;
}

static int is_where_said(const struct applying *a, const struct scene_instance *in, uint32_t k)
{
	const struct match *r = a->rules->surfaces[k].match;
	uint8_t *known;
	float plane[4];

	if (!r || !r->in_plane)
		return 1;
	known = &a->in_plane[(size_t)(in - a->scene->instances) * a->rules->surfaces_count + k];
	if (!*known) {
		mat4_transform_plane(plane, r->in_plane, a->world_from_eye);
		*known = a->knows_world && plane_holds(a->scene, in, plane) ? 2 : 1;
	}
	return *known == 2;
}

/* 1 for the k-th rule of surfaces where it changes an instance. */
static int applies(const struct applying *a, const struct scene_instance *in, uint32_t k)
{
	const struct surface_rule *r = &a->rules->surfaces[k];
	const int is_reflection = r->left_out && *r->left_out && r->match && r->match->modelview &&
	                          modelview_named(r->match->modelview) == MODELVIEW_MIRRORED;

	if (is_kept(a->rules, r) || (is_reflection && !a->has_mirror))
		return 0;
	return matches(a->scene, in, r->match, &a->look->draws[k]) && is_where_said(a, in, k);
}

/* 1 where a solid mirror is in the frame, or rules know of none. */
static int has_mirror(const struct applying *a)
{
	int known = 0;

	for (uint32_t k = 0; k < a->rules->surfaces_count; k++) {
		const bool *solid = a->rules->surfaces[k].solid;

		if (!solid || !*solid)
			continue;
		known = 1;
		for (uint32_t i = 0; i < a->scene->n_instances; i++)
			if (applies(a, &a->scene->instances[i], k))
				return 1;
	}
	return !known;
}

/* 1 where an instance whose vertices all have one colour is as bright as ambient light makes it: no other light of the rules falls there. */
static int is_in_shade(const struct applying *a, const struct scene_instance *in)
{
	const float *color = a->scene->currents[in->current].color;
	float ambient[3] = { 0, 0, 0 };

	for (uint32_t k = 0; k < a->rules->lights_count; k++) {
		const struct light_rule *r = &a->rules->lights[k];

		for (int c = 0; c < 3 && !r->light && r->ambient && !(r->off && *r->off); c++)
			ambient[c] += r->ambient[c];
	}
	return fabsf(color[0] - ambient[0]) < SHADE && fabsf(color[1] - ambient[1]) < SHADE && fabsf(color[2] - ambient[2]) < SHADE;
}

/* The angle up to which an instance's faces look round, in degrees. */
static float crease_of(const struct applying *a, const struct scene_instance *in)
{
	float angle = 0;

	for (uint32_t k = 0; k < a->rules->surfaces_count; k++)
		if (a->rules->surfaces[k].crease && applies(a, in, k))
			angle = *a->rules->surfaces[k].crease;
	return angle;
}

/* Give faces that look round a mesh with further normals. i: of the scene's instance; placed, m: what stands for it now, and its material */
static int smooth_instance(const struct applying *a, uint32_t i, struct scene_instance *placed, struct scene_material *m)
{
	const struct scene_instance *in = &a->scene->instances[i];
	const float angle = a->lights_change & 8 && m->lighting && !(m->surface.hidden & SCENE_UNSHADED) ? crease_of(a, in) : 0;
	struct scene_mesh *mesh = NULL;
	int err = angle > 0 ? crease_smooth(a->out->meshes[placed->mesh], m->shade_model == GL_FLAT, angle, &mesh) : 0;

	if (!mesh)
		return err;
	m->surface.hidden |= SCENE_CREASED;
	placed->mesh = a->out->n_meshes;
	a->out->meshes[a->out->n_meshes++] = mesh;
	return 0;
}

/* How an instance's mesh is repaired. m: its material under the rules. @return 0: it is not */
static int wants_repair(const struct applying *a, const struct scene_instance *in, const struct scene_material *m, struct repair_wants *wants)
{
	const struct repair_rule *rule = NULL;

	for (uint32_t k = 0; k < a->rules->surfaces_count && a->look && a->look->repaired; k++)
		if (a->rules->surfaces[k].repair && applies(a, in, k))
			rule = a->rules->surfaces[k].repair;
	return rule && repaired_wants(rule, a->scene, in, m, wants);
}

/* 1 where the viewer is not in a body. mesh: an instance's, closed */
static int is_outside(const struct scene *s, const struct scene_instance *in, const struct scene_mesh *mesh)
{
	float obj_from_eye[16], viewer[4];

	if (look_is_parallel(&s->views[in->view]) || !mat4_invert(obj_from_eye, in->modelview))
		return 1;
	mat4_transform(viewer, obj_from_eye, (const float[4]){ 0, 0, 0, 1 });
	return !holds_place(mesh, viewer);
}

/*
 * Let a repaired mesh stand for an instance where only the camera does not look: in a view of the same space that covers no pixel. The
 * program's own stays for the camera alone.
 */
static int repair_instance(const struct applying *a, uint32_t i)
{
	struct scene *out = a->out;
	struct scene_instance *own = &out->instances[i], *added = &out->instances[out->n_instances];
	struct scene_material *m = &out->materials[out->n_materials];
	const struct scene_mesh *mesh;
	struct repair_wants wants;
	struct repair_found found;
	int err;

	m[0] = m[1] = out->materials[own->material];
	if (!wants_repair(a, &a->scene->instances[i], m, &wants))
		return 0;
	err = repaired_find(a->look->repaired, a->scene->meshes[a->scene->instances[i].mesh], &wants, &mesh, &found);
	if (err || !mesh)
		return err;
	m[0].surface.hidden |= SCENE_HIDDEN_FROM_LIGHTS | SCENE_HIDDEN_FROM_MIRRORS |
	                       (found.closed && found.turned && !m->cull_face && is_outside(a->scene, own, mesh) ? SCENE_ENTERED : 0);
	*added = a->scene->instances[i];
	added->mesh = out->n_meshes;
	added->view += a->scene->n_views;
	added->draw = out->n_draws;
	added->first_primitive = out->n_primitives;
	own->material = out->n_materials;
	added->material = out->n_materials + 1;
	out->n_materials += 2;
	out->meshes[out->n_meshes++] = mesh;
	out->n_primitives += mesh->primitive_count;
	out->n_instances++;
	out->n_views = 2 * a->scene->n_views;
	return m[1].surface.hidden & SCENE_CREASED ? smooth_instance(a, i, added, &m[1]) : 0;
}

static void add_parameters(struct scene *out, const struct parameter_rule *list, uint32_t n)
{
	struct scene_parameter *to = (struct scene_parameter *)out->parameters + out->n_parameters;

	for (uint32_t i = 0; i < n; i++, out->n_parameters++, to++) {
		*to = (struct scene_parameter){ .name = list[i].name, .count = list[i].value_count };
		memcpy(to->value, list[i].value, list[i].value_count * sizeof(*to->value));
	}
}

/* What rules say to hooks about an instance. */
static void list_parameters(const struct applying *a, const struct scene_instance *in, struct scene_surface *s)
{
	const uint32_t first = a->out->n_parameters;

	for (uint32_t k = 0; k < a->rules->surfaces_count; k++)
		if (a->rules->surfaces[k].parameters_count && applies(a, in, k))
			add_parameters(a->out, a->rules->surfaces[k].parameters, a->rules->surfaces[k].parameters_count);
	if (a->out->n_parameters > first) {
		s->parameter_first = first;
		s->parameter_count = a->out->n_parameters - first;
	}
}

/* Change the surface of one instance: it gets a material of its own, where anything changes. */
static int change_instance(const struct applying *a, uint32_t i)
{
	const struct scene *scene = a->scene;
	const struct scene_instance *in = &scene->instances[i];
	const struct rules *rules = a->rules;
	struct scene *out = a->out;
	struct scene_material *m = &out->materials[out->n_materials];
	uint32_t n = 0;
	int err;

	*m = scene->materials[in->material];
	if (!a->spare)
		m->surface.hidden |= SCENE_FACETED;
	else if (a->spare->bits)
		m->surface.hidden |= a->spare->bits[i];
	if (a->spare && film_is(scene, in))
		m->surface.hidden |= SCENE_FILM;
	if (rules->gloss && rules->gloss->share)
		gloss_set(m, *rules->gloss->share, &m->surface);
	if (rules->sky && (m->lighting ? out->dome.lit > 0 : !rules->sky->unlit || *rules->sky->unlit) && solid_is(scene, in))
		m->surface.hidden |= SCENE_DOME_LIT;
	for (uint32_t k = 0; k < rules->surfaces_count; k++)
		if (applies(a, in, k))
			set_surface(&m->surface, &rules->surfaces[k], a->spare != NULL);
	err = smooth_instance(a, i, &out->instances[i], m);
	list_parameters(a, in, &m->surface);
	m->surface.relit = m->lighting ? (uint32_t)(a->lights_change >> 1 & 1) || m->surface.light_unit || m->surface.hidden & SCENE_CREASED : m->surface.relit && a->lights_change & 1;
	if (m->surface.hidden & SCENE_UNSHADED) {
		m->surface.hidden &= ~SCENE_DOME_LIT;
		m->surface.relit = 0;
	}
	if (m->surface.hidden & SCENE_NEAR_MIRROR && !scene->meshes[in->mesh]->normal)
		m->surface.hidden |= SCENE_NO_NORMALS;
	if (!m->surface.relit ||
	    (m->surface.light_unit == SCENE_LIGHT_IN_COLORS && !scene->meshes[in->mesh]->color && !is_in_shade(a, in)))
		m->surface.light_unit = 0;
	if (m->surface.relit) {
		n = list_lights(a, in, m, out->lights + out->n_lights);
		m->surface.light_first = out->n_lights;
		m->surface.light_count = n;
	}
	if (err || memcmp(m, &scene->materials[in->material], sizeof(*m)) == 0)
		return err;
	out->instances[i].material = out->n_materials++;
	out->n_lights += n;
	return 0;
}

int look_spares(const struct look *look)
{
	return !look || !look->rules->spare || *look->rules->spare;
}

static int copy_scene(struct applying *a)
{
	const struct scene *scene = a->scene;
	struct scene *out = a->out;
	const size_t copies = a->look && a->look->repaired ? 3 : 1; /* own, repaired, repaired and round */
	size_t n = scene->n_instances, parameters = 0;

	*out = *scene;
	for (uint32_t k = 0; k < a->rules->surfaces_count; k++)
		parameters += a->rules->surfaces[k].parameters_count * n;
	out->parameters = malloc((a->rules->parameters_count + parameters + 1) * sizeof(*out->parameters));
	out->instances = malloc((copies * n + 1) * sizeof(*out->instances));
	out->materials = malloc((scene->n_materials + copies * n + 2) * sizeof(*out->materials));
	out->views = malloc((2 * scene->n_views + (size_t)1) * sizeof(*out->views));
	out->lights = malloc((scene->n_lights + (a->lights_change ? SCENE_MAX_LIGHTS * (n + 1) : 1)) * sizeof(*out->lights));
	out->meshes = malloc((scene->n_meshes + copies * n + 1) * sizeof(*out->meshes));
	if (!out->instances || !out->materials || !out->views || !out->lights || !out->meshes || !out->parameters) {
		out->n_meshes = 0;
		look_release(out);
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	}
	out->n_parameters = 0;
	add_parameters(out, a->rules->parameters, a->rules->parameters_count);
	out->n_shared_parameters = out->n_parameters;
	if (n)
		memcpy(out->instances, scene->instances, n * sizeof(*out->instances));
	for (uint32_t v = 0; v < 2 * scene->n_views; v++) {
		out->views[v] = scene->views[v % scene->n_views];
		if (v >= scene->n_views) /* nobody looks through it (repair_instance) */
			memset(out->views[v].scissor, 0, sizeof(out->views[v].scissor));
	}
	if (scene->n_materials)
		memcpy(out->materials, scene->materials, scene->n_materials * sizeof(*out->materials));
	if (scene->n_meshes)
		memcpy(out->meshes, scene->meshes, scene->n_meshes * sizeof(*out->meshes));
	if (scene->n_lights)
		memcpy(out->lights, scene->lights, scene->n_lights * sizeof(*out->lights));
	return 0;
}

/* 1 where rules say of everything what light it lets through, or that nothing is spared. */
static int decides_sparing(const struct rules *rules)
{
	int decided = 0; /* bits: 1 of what is not lit, 2 of what is */

	for (uint32_t k = 0; k < rules->surfaces_count; k++) {
		const struct match only = { .lit = rules->surfaces[k].match ? rules->surfaces[k].match->lit : NULL };

		if (rules->surfaces[k].passes && (!rules->surfaces[k].match || memcmp(rules->surfaces[k].match, &only, sizeof(only)) == 0))
			decided |= !only.lit ? 3 : *only.lit ? 2 : 1;
	}
	return decided == 3 || (rules->spare && !*rules->spare);
}

/* What the rules need to know of a frame before they apply. in_plane is to be freed. */
static int prepare(struct applying *a)
{
	static const struct rules none = { .surfaces = NULL };
	int in_world = 0;

	a->rules = a->look ? a->look->rules : &none;
	for (uint32_t k = 0; k < a->rules->surfaces_count; k++)
		a->lights_change |= (a->rules->surfaces[k].shadow_unit ? 4 : 0) | (a->rules->surfaces[k].crease ? 8 : 0);
	for (uint32_t k = 0; k < a->rules->lights_count; k++) {
		a->lights_change |= changes_light(&a->rules->lights[k]) ? lit_by(&a->rules->lights[k]) : 0;
		in_world |= is_in_world(&a->rules->lights[k]);
	}
	a->knows_world = world_find(a->rules, a->scene, a->eye_from_world);
	mat4_invert(a->world_from_eye, a->eye_from_world);
	if (in_world && !a->knows_world) {
		a->rules = &none; /* its lights stand nobody knows where */
		a->lights_change = 0;
	}
	a->in_plane = calloc(a->scene->n_instances + (size_t)1, a->rules->surfaces_count + (size_t)1);
	if (!a->in_plane)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	a->has_mirror = has_mirror(a);
	return 0;
}

int look_apply(const struct look *look, const struct scene *scene, struct scene *out, struct spare *found)
{
	struct applying a = { .look = look, .scene = scene, .out = out };
	struct spare spare = { .bits = NULL };
	int err = prepare(&a);

	if (!err)
		err = spare_find(scene, decides_sparing(a.rules), &spare);
	spare.kept = !look_spares(look);
	a.spare = spare.kept ? NULL : &spare;
	if (!err)
		err = copy_scene(&a);
	if (!err) {
		size_lights(a.rules, out);
		set_sky(&a);
	}
	for (uint32_t i = 0; i < scene->n_instances && !err; i++) {
		err = change_instance(&a, i);
		if (!err)
			err = repair_instance(&a, i);
		if (err)
			look_release(out);
	}
	free(a.in_plane);
	if (found)
		*found = spare;
	else
		spare_free(&spare);
	return err;
}

void look_release(struct scene *changed)
{
	for (uint32_t i = 0; i < changed->n_meshes; i++)
		if (changed->meshes[i]->crease)
			free((void *)changed->meshes[i]);
	free(changed->meshes);
	free(changed->instances);
	free(changed->materials);
	free(changed->views);
	free(changed->lights);
	free((void *)changed->parameters);
	memset(changed, 0, sizeof(*changed));
}

/* --- What rules say, for a report ------------------------------------------------------------------------------------ */

enum { TOLD_BYTES = 250, TOLD_DRAWS = 90, MOST_REPAIRS = 64 };

/* 1 where a rule of surfaces before the k-th has its role: they are told together. */
static int is_told(const struct rules *rules, uint32_t k)
{
	for (uint32_t i = 0; i < k; i++)
		if (rules->surfaces[i].reason.role && strcmp(rules->surfaces[i].reason.role, rules->surfaces[k].reason.role) == 0)
			return 1;
	return 0;
}

static int has_role(const struct applying *a, const struct scene_instance *in, const char *role)
{
	for (uint32_t k = 0; k < a->rules->surfaces_count; k++)
		if (a->rules->surfaces[k].reason.role && strcmp(a->rules->surfaces[k].reason.role, role) == 0 && applies(a, in, k))
			return 1;
	return 0;
}

struct with_role {
	const struct applying *a;
	const char *role;
};

static int is_with_role(const void *user, const struct scene *scene, uint32_t i)
{
	const struct with_role *w = user;

	return has_role(w->a, &scene->instances[i], w->role);
}

/* The draws of a role, as ranges, as many as there is room for. */
static void list_draws(const struct applying *a, const char *role, char out[TOLD_DRAWS])
{
	char *all = scene_draw_list(a->scene, is_with_role, &(struct with_role){ a, role });
	size_t n = all ? strcspn(all, ",") : 0;

	while (all && all[n] && n < TOLD_DRAWS - 24)
		n += 1 + strcspn(all + n + 1, ",");
	memcpy(out, all ? all : "", n);
	out[n] = 0;
	free(all);
}

static int tell_one(const char *kind, const struct rule_reason *r, const char *what, int (*tell)(void *user, const char *text), void *user)
{
	char text[TOLD_BYTES];

	snprintf(text, sizeof(text), "%s\t%.40s\t%.2f\t%s\t%s", kind, r->role, r->confidence ? (double)*r->confidence : 1.0, what, r->why ? r->why : "");
	return tell(user, text);
}

static int tell_surfaces(const struct applying *a, int (*tell)(void *user, const char *text), void *user)
{
	int err = 0;

	for (uint32_t k = 0; k < a->rules->surfaces_count && !err; k++) {
		char draws[TOLD_DRAWS];

		if (!a->rules->surfaces[k].reason.role || is_told(a->rules, k))
			continue;
		list_draws(a, a->rules->surfaces[k].reason.role, draws);
		if (draws[0])
			err = tell_one("surface", &a->rules->surfaces[k].reason, draws, tell, user);
	}
	return err;
}

/* The first instance of each repaired mesh, and what was done to it. */
static int tell_repairs(const struct applying *a, int (*tell)(void *user, const char *text), void *user)
{
	const struct scene *s = a->scene;
	const struct scene_mesh *last = NULL;
	int err = 0;

	for (uint32_t i = 0, n = 0; i < s->n_instances && n < MOST_REPAIRS && !err && a->look && a->look->repaired; i++) {
		const struct scene_instance *in = &s->instances[i];
		char text[TOLD_BYTES], why[TOLD_BYTES - 50];
		const struct scene_mesh *mesh;
		struct repair_wants wants;
		struct repair_found found;
		struct scene_material m = s->materials[in->material];

		if (s->meshes[in->mesh] == last)
			continue;
		for (uint32_t k = 0; k < a->rules->surfaces_count; k++)
			if (applies(a, in, k))
				set_surface(&m.surface, &a->rules->surfaces[k], look_spares(a->look));
		if (!wants_repair(a, in, &m, &wants))
			continue;
		last = s->meshes[in->mesh];
		err = repaired_find(a->look->repaired, last, &wants, &mesh, &found);
		repaired_describe(&found, why, sizeof(why));
		snprintf(text, sizeof(text), "surface\t%s\t1.00\t%u\t%s", found.closed ? "closed mesh" : found.leaks ? "mesh that leaks" : "mesh", in->draw, why);
		err = err ? err : tell(user, text);
		n++;
	}
	return err;
}

static int tell_lights(const struct applying *a, int (*tell)(void *user, const char *text), void *user)
{
	int err = 0;

	for (uint32_t k = 0; k < a->rules->lights_count && !err; k++) {
		const struct light_rule *r = &a->rules->lights[k];
		char place[TOLD_DRAWS] = "";
		float at[4];

		if (!r->reason.role)
			continue;
		if (r->position) {
			place_light(a, r, at);
			snprintf(place, sizeof(place), "%.6g %.6g %.6g %.6g", (double)at[0], (double)at[1], (double)at[2], (double)at[3]);
		}
		err = tell_one("light", &r->reason, place, tell, user);
	}
	if (!err && a->rules->sky && a->rules->sky->reason.role)
		err = tell_one("light", &a->rules->sky->reason, "", tell, user);
	if (!err && a->rules->gloss && a->rules->gloss->reason.role)
		err = tell_one("light", &a->rules->gloss->reason, "", tell, user);
	return err;
}

int look_tell(const struct look *look, const struct scene *scene, int (*tell)(void *user, const char *text), void *user)
{
	struct applying a = { .look = look, .scene = scene };
	int err = prepare(&a);

	if (!err)
		err = tell_surfaces(&a, tell, user);
	if (!err)
		err = tell_repairs(&a, tell, user);
	if (!err)
		err = tell_lights(&a, tell, user);
	free(a.in_plane);
	return err;
}
