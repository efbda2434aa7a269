#include "look/apply/match.h"

#include <stdlib.h>

#include "base/err.h"
#include "base/frames.h"
#include "base/mat4.h"
#include "look/apply/lights.h"
#include "look/draws/drawn.h"
#include "look/draws/modelview.h"
#include "look/draws/plane.h"
#include "look/rules/world.h"

/* 1 if one of a material's textures has a hash that begins with the text. */
static int has_texture(const struct scene *s, const struct scene_material *m, const char *text)
{
	for (uint32_t i = 0; i < m->unit_count; i++)
		if (world_hash_begins(s->textures[s->units[m->unit_first + i].texture]->hash, text))
			return 1;
	return 0;
}

/* 1 if a rule asks for a property (NULL: it does not) and the instance differs. */
static int differs(const bool *wanted, int is)
{
	return wanted && *wanted != (is != 0);
}

/* 1 if an instance has all that a rule asks for, except in_plane. r NULL: nothing */
static int matches(const struct scene *s, const struct scene_instance *in, const struct match *r,
                   const struct frame_list *draws)
{
	const struct scene_material *m = &s->materials[in->material];
	const struct scene_draw *draw = s->draws ? &s->draws[in->draw] : NULL;

	if (!r)
		return 1;
	if ((r->texture && !has_texture(s, m, r->texture)) ||
	    (r->mesh && !world_hash_begins(s->meshes[in->mesh]->hash, r->mesh)))
		return 0;
	if ((r->draws && !frame_list_contains(draws, in->draw)) || (r->call && (!draw || strcmp(draw->call, r->call) != 0)))
		return 0;
	if (r->list && (!draw || draw->list != *r->list))
		return 0;
	if (r->modelview && modelview_named(r->modelview) != modelview_kind_of(in->modelview))
		return 0;
	if ((r->units && *r->units != m->unit_count) || differs(r->stencil_tested, (int)m->stencil_test) ||
	    differs(r->multiplies, drawn_multiplies(m)) || differs(r->environment_mapped, drawn_with_environment(s, m)) ||
	    differs(r->parallel, drawn_in_parallel(&s->views[in->view])))
		return 0;
	return !differs(r->program, (int)m->program) && !differs(r->lit, (int)m->lighting) &&
	       !differs(r->textured, m->unit_count > 0) && !differs(r->blended, (int)m->blend) &&
	       !differs(r->alpha_tested, (int)m->alpha_test) && !differs(r->depth_tested, (int)m->depth_test);
}

/* 1 if a rule replaces a trick, but the file keeps tricks. */
static int is_kept(const struct rules *rules, const struct surface_rule *r)
{
	return rules->replace && !*rules->replace && (r->left_out || r->solid || r->shadow_unit);
}

/* 1 if an instance lies in the plane that rule k asks for, if any. Keeps the answer (applying.in_plane). */
static int is_in_plane(const struct applying *a, const struct scene_instance *in, uint32_t k)
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

int match_applies(const struct applying *a, const struct scene_instance *in, uint32_t k)
{
	const struct surface_rule *r = &a->rules->surfaces[k];
	const int is_reflection = r->left_out && *r->left_out && r->match && r->match->modelview &&
	                          modelview_named(r->match->modelview) == MODELVIEW_MIRRORED;

	if (is_kept(a->rules, r) || (is_reflection && !a->has_mirror))
		return 0;
	return matches(a->scene, in, r->match, &a->look->draws[k]) && is_in_plane(a, in, k);
}

/* 1 if the frame has a solid mirror, or rules have none. */
static int has_mirror(const struct applying *a)
{
	int known = 0;

	for (uint32_t k = 0; k < a->rules->surfaces_count; k++) {
		const bool *solid = a->rules->surfaces[k].solid;

		if (!solid || !*solid)
			continue;
		known = 1;
		for (uint32_t i = 0; i < a->scene->n_instances; i++)
			if (match_applies(a, &a->scene->instances[i], k))
				return 1;
	}
	return !known;
}

int match_begin(struct applying *a)
{
	static const struct rules none = { .surfaces = NULL };
	int in_world = 0;

	a->rules = a->look ? a->look->rules : &none;
	for (uint32_t k = 0; k < a->rules->surfaces_count; k++)
		a->lights_change |= (a->rules->surfaces[k].shadow_unit ? LIGHTS_SHADOW_UNITS : 0) |
		                    (a->rules->surfaces[k].crease ? LIGHTS_CREASES : 0);
	for (uint32_t k = 0; k < a->rules->lights_count; k++) {
		a->lights_change |= lights_change_of(&a->rules->lights[k]);
		in_world |= lights_in_world(&a->rules->lights[k]);
	}
	a->knows_world = world_find(a->rules, a->scene, a->eye_from_world, NULL);
	mat4_invert(a->world_from_eye, a->eye_from_world);
	if (in_world && !a->knows_world) {
		a->rules = &none; /* the positions of its lights are unknown */
		a->lights_change = 0;
	}
	a->in_plane = calloc(a->scene->n_instances + (size_t)1, a->rules->surfaces_count + (size_t)1);
	a->matched = calloc(a->rules->surfaces_count + (size_t)1, sizeof(*a->matched));
	if (!a->in_plane || !a->matched)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	a->has_mirror = has_mirror(a);
	return 0;
}

void match_end(struct applying *a)
{
	free(a->in_plane);
	free(a->matched);
	a->in_plane = NULL;
	a->matched = NULL;
}
