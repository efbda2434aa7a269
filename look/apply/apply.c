#include "look/apply/apply.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "look/apply/lights.h"
#include "look/apply/match.h"
#include "look/apply/meshes.h"
#include "look/apply/surface.h"
#include "look/draws/film.h"
#include "look/draws/gloss.h"
#include "look/draws/solid.h"
#include "look/rules/matched.h"
#include "look/spare/sides.h"

/* Append parameters of a rule to the scene's, which have room for them. */
static void add_parameters(struct scene *out, const struct parameter_rule *list, uint32_t n)
{
	struct scene_parameter *to = (struct scene_parameter *)out->parameters + out->n_parameters;

	for (uint32_t i = 0; i < n; i++, out->n_parameters++, to++) {
		*to = (struct scene_parameter){ .name = list[i].name, .count = list[i].value_count };
		memcpy(to->value, list[i].value, list[i].value_count * sizeof(*to->value));
	}
}

/* Collect the parameters that rules pass to hooks for an instance. */
static void list_parameters(const struct applying *a, const struct scene_instance *in, struct scene_surface *s)
{
	const uint32_t first = a->out->n_parameters;

	for (uint32_t k = 0; k < a->rules->surfaces_count; k++)
		if (a->rules->surfaces[k].parameters_count && match_applies(a, in, k))
			add_parameters(a->out, a->rules->surfaces[k].parameters, a->rules->surfaces[k].parameters_count);
	if (a->out->n_parameters > first) {
		s->parameter_first = first;
		s->parameter_count = a->out->n_parameters - first;
	}
}

/* Apply sparing, highlights, the sky and rules to an instance's surface. @param m  its material, as OpenGL has it */
static void set_surface(const struct applying *a, uint32_t i, struct scene_material *m)
{
	const struct scene_instance *in = &a->scene->instances[i];
	const struct rules *rules = a->rules;
	const int sky_lights = rules->sky && (m->lighting ? a->out->dome.lit > 0 : !rules->sky->unlit || *rules->sky->unlit);

	if (!a->spare)
		m->surface.hidden |= SCENE_FACETED;
	else if (a->spare->bits)
		m->surface.hidden |= a->spare->bits[i];
	if (a->spare && film_is(a->scene, in))
		m->surface.hidden |= SCENE_FILM;
	if (rules->gloss && rules->gloss->share)
		gloss_set(m, *rules->gloss->share, &m->surface);
	if (sky_lights && solid_is(a->scene, in))
		m->surface.hidden |= SCENE_DOME_LIT;
	for (uint32_t k = 0; k < rules->surfaces_count; k++)
		if (match_applies(a, in, k)) {
			surface_set(&m->surface, &rules->surfaces[k], a->spare != NULL);
			a->matched[k]++;
		}
}

/* Decide whether the tracer replaces the surface's light, and which light its vertices or texels contain. */
static void decide_lighting(const struct applying *a, const struct scene_instance *in, const struct scene_material *m,
                            struct scene_surface *s)
{
	const struct scene_mesh *mesh = a->scene->meshes[in->mesh];

	if (m->lighting)
		s->relit = a->lights_change & LIGHTS_ON_LIT || s->light_unit || s->hidden & SCENE_CREASED;
	else
		s->relit = s->relit && a->lights_change & LIGHTS_ON_UNLIT;
	if (s->hidden & SCENE_UNSHADED) {
		s->hidden &= ~SCENE_DOME_LIT;
		s->relit = 0;
	}
	if (s->hidden & SCENE_NEAR_MIRROR && !mesh->normal)
		s->hidden |= SCENE_NO_NORMALS;
	if (!s->relit || (s->light_unit == SCENE_LIGHT_IN_COLORS && !mesh->color && !lights_leave_in_shade(a, in)))
		s->light_unit = 0;
}

/* Change the surface of an instance, giving it a material of its own if anything changes. */
static int change_instance(const struct applying *a, uint32_t i)
{
	const struct scene_instance *in = &a->scene->instances[i];
	const struct scene_material *own = &a->scene->materials[in->material];
	struct scene *out = a->out;
	struct scene_material *m = &out->materials[out->n_materials];
	uint32_t n = 0;
	int err;

	*m = *own;
	set_surface(a, i, m);
	if (m->surface.transmit > 0 && sides_back_outside(a->scene, in))
		m->surface.hidden |= SCENE_BACK_OUTSIDE;
	err = meshes_smooth(a, i, &out->instances[i], m);
	list_parameters(a, in, &m->surface);
	decide_lighting(a, in, m, &m->surface);
	if (m->surface.relit) {
		n = lights_list(a, in, m, out->lights + out->n_lights);
		m->surface.light_first = out->n_lights;
		m->surface.light_count = n;
	}
	if (err || memcmp(m, own, sizeof(*m)) == 0)
		return err;
	out->instances[i].material = out->n_materials++;
	out->n_lights += n;
	return 0;
}

int look_spares(const struct look *look)
{
	return !look || !look->rules->spare || *look->rules->spare;
}

/*
 * Copy the arrays that rules change, with room for all additions. The second half of the views covers no pixel; it is
 * for repaired meshes.
 */
static int copy_scene(struct applying *a)
{
	const struct scene *scene = a->scene;
	struct scene *out = a->out;
	const size_t copies = a->look && a->look->repaired ? 3 : 1; /* own, repaired, repaired and smooth */
	size_t n = scene->n_instances, parameters = 0;

	*out = *scene;
	for (uint32_t k = 0; k < a->rules->surfaces_count; k++)
		parameters += a->rules->surfaces[k].parameters_count * n;
	out->parameters = malloc((a->rules->parameters_count + parameters + 1) * sizeof(*out->parameters));
	out->instances = malloc((copies * n + 1) * sizeof(*out->instances));
	out->materials = malloc((scene->n_materials + copies * n + 2) * sizeof(*out->materials));
	out->views = malloc((2 * scene->n_views + (size_t)1) * sizeof(*out->views));
	/* room for the most lights: pages that stay untouched take no memory */
	out->lights = malloc((scene->n_lights + SCENE_MAX_LIGHTS * (n + 1)) * sizeof(*out->lights));
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
	for (uint32_t v = 0; v < scene->n_views; v++) {
		struct scene_view *covers_nothing = &out->views[scene->n_views + v]; /* meshes_repair */

		out->views[v] = *covers_nothing = scene->views[v];
		memset(covers_nothing->scissor, 0, sizeof(covers_nothing->scissor));
	}
	if (scene->n_materials)
		memcpy(out->materials, scene->materials, scene->n_materials * sizeof(*out->materials));
	if (scene->n_meshes)
		memcpy(out->meshes, scene->meshes, scene->n_meshes * sizeof(*out->meshes));
	if (scene->n_lights)
		memcpy(out->lights, scene->lights, scene->n_lights * sizeof(*out->lights));
	return 0;
}

/* 1 if rules determine the passing light for every surface, or turn sparing off. */
static int decides_sparing(const struct rules *rules)
{
	int decided = 0; /* bits: 1 for unlit surfaces, 2 for lit ones */

	for (uint32_t k = 0; k < rules->surfaces_count; k++) {
		const struct match only = { .lit = rules->surfaces[k].match ? rules->surfaces[k].match->lit : NULL };

		if (rules->surfaces[k].passes &&
		    (!rules->surfaces[k].match || memcmp(rules->surfaces[k].match, &only, sizeof(only)) == 0))
			decided |= !only.lit ? 3 : *only.lit ? 2 : 1;
	}
	return decided == 3 || (rules->spare && !*rules->spare);
}

/* The flags for spare_find: what the rules decide about sparing, tricks and lights. */
static unsigned sparing_flags(const struct applying *a)
{
	const struct rules *rules = a->rules;
	unsigned flags = (decides_sparing(rules) ? SPARE_IS_DECIDED : 0u) |
	                 (a->lights_change || rules->lights_count ? SPARE_NEW_LIGHTS : 0u);

	if (rules->replace && !*rules->replace)
		return flags | SPARE_TRICKS_STAY;
	for (uint32_t k = 0; k < rules->surfaces_count; k++)
		flags |= rules->surfaces[k].left_out ? SPARE_TRICKS_KNOWN : 0u;
	return flags;
}

int look_apply(const struct look *look, const struct scene *scene, struct scene *out, struct spare *found)
{
	struct applying a = { .look = look, .scene = scene, .out = out };
	struct spare spare = { .bits = NULL };
	int err = match_begin(&a);

	if (!err)
		err = spare_find(scene, sparing_flags(&a), &spare);
	spare.kept = !look_spares(look);
	a.spare = spare.kept ? NULL : &spare;
	if (!err)
		err = copy_scene(&a);
	if (!err) {
		lights_size(a.rules, out);
		lights_set_sky(&a);
	}
	for (uint32_t i = 0; i < scene->n_instances && !err; i++) {
		err = change_instance(&a, i);
		if (!err)
			err = meshes_repair(&a, i);
		if (err)
			look_release(out);
	}
	if (!err && look && a.rules == look->rules)
		matched_add(look->matched, a.matched);
	match_end(&a);
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
