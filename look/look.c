#include "look/look.h"

#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/config.h"
#include "base/err.h"
#include "base/frames.h"
#include "base/mat4.h"

/* --- The file ------------------------------------------------------------------------------------------------------ */

/* Pointers are NULL for keys that the file does not have. */
struct match {
	const char *texture, *mesh, *draws, *call;
	const uint32_t *list;
	const bool *program, *lit, *textured, *blended, *alpha_tested, *depth_tested;
};

struct surface_rule {
	struct match *match;
	const float *reflect, *transmit, *ior, *roughness, *absorb, *emission;
	const bool *shadows, *mirrors, *lit;
};

struct spot {
	const float *direction, *cutoff, *exponent;
};

struct light_rule {
	const uint32_t *light;
	const bool *off;
	const char *object;
	const float *position, *ambient, *diffuse, *specular, *attenuation, *radius;
	struct spot *spot;
};

struct rules {
	struct surface_rule *surfaces;
	struct light_rule *lights;
	uint32_t surfaces_count, lights_count; /* libcyaml wants these names */
};

struct look {
	struct rules *rules;
	struct frame_list *draws; /* [surfaces_count] */
};

#define OPTIONAL_POINTER (CYAML_FLAG_POINTER | CYAML_FLAG_OPTIONAL)

static const cyaml_schema_value_t number = { CYAML_VALUE_FLOAT(CYAML_FLAG_DEFAULT, float) };

#define TEXT(type, name) CYAML_FIELD_STRING_PTR(#name, OPTIONAL_POINTER, type, name, 1, 256)
#define TRUTH(type, name) CYAML_FIELD_BOOL_PTR(#name, OPTIONAL_POINTER, type, name)
#define COUNT(type, name) CYAML_FIELD_UINT_PTR(#name, OPTIONAL_POINTER, type, name)
#define NUMBER(type, name) CYAML_FIELD_FLOAT_PTR(#name, OPTIONAL_POINTER, type, name)
#define NUMBERS(type, name, n) CYAML_FIELD_SEQUENCE_FIXED(#name, OPTIONAL_POINTER, type, name, &number, n)

static const cyaml_schema_field_t match_fields[] = {
	TEXT(struct match, texture), TEXT(struct match, mesh), TEXT(struct match, draws), TEXT(struct match, call),
	COUNT(struct match, list), TRUTH(struct match, program), TRUTH(struct match, lit), TRUTH(struct match, textured),
	TRUTH(struct match, blended), TRUTH(struct match, alpha_tested), TRUTH(struct match, depth_tested), CYAML_FIELD_END
};

static const cyaml_schema_field_t surface_fields[] = {
	CYAML_FIELD_MAPPING_PTR("match", OPTIONAL_POINTER, struct surface_rule, match, match_fields),
	NUMBER(struct surface_rule, reflect), NUMBER(struct surface_rule, transmit), NUMBER(struct surface_rule, ior),
	NUMBER(struct surface_rule, roughness), NUMBERS(struct surface_rule, absorb, 3),
	NUMBERS(struct surface_rule, emission, 3), TRUTH(struct surface_rule, shadows), TRUTH(struct surface_rule, mirrors),
	TRUTH(struct surface_rule, lit), CYAML_FIELD_END
};

static const cyaml_schema_field_t spot_fields[] = {
	NUMBERS(struct spot, direction, 3), NUMBER(struct spot, cutoff), NUMBER(struct spot, exponent), CYAML_FIELD_END
};

static const cyaml_schema_field_t light_fields[] = {
	COUNT(struct light_rule, light), TRUTH(struct light_rule, off), TEXT(struct light_rule, object),
	NUMBERS(struct light_rule, position, 4), NUMBERS(struct light_rule, ambient, 3),
	NUMBERS(struct light_rule, diffuse, 3), NUMBERS(struct light_rule, specular, 3),
	NUMBERS(struct light_rule, attenuation, 3), NUMBER(struct light_rule, radius),
	CYAML_FIELD_MAPPING_PTR("spot", OPTIONAL_POINTER, struct light_rule, spot, spot_fields), CYAML_FIELD_END
};

static const cyaml_schema_value_t surface_schema = { CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, struct surface_rule,
                                                                         surface_fields) };
static const cyaml_schema_value_t light_schema = { CYAML_VALUE_MAPPING(CYAML_FLAG_DEFAULT, struct light_rule,
                                                                       light_fields) };

static const cyaml_schema_field_t rules_fields[] = {
	CYAML_FIELD_SEQUENCE("surfaces", OPTIONAL_POINTER, struct rules, surfaces, &surface_schema, 0, CYAML_UNLIMITED),
	CYAML_FIELD_SEQUENCE("lights", OPTIONAL_POINTER, struct rules, lights, &light_schema, 0, CYAML_UNLIMITED),
	CYAML_FIELD_END
};

static const cyaml_schema_value_t rules_schema = { CYAML_VALUE_MAPPING(CYAML_FLAG_POINTER, struct rules, rules_fields) };

/* --- Checks that libcyaml does not make ---------------------------------------------------------------------------- */

static int check_number(const char *path, const char *list, uint32_t rule, const char *key, const float *value,
                        float least, float most)
{
	if (!value || (*value >= least && *value <= most))
		return 0;
	return err_report(ERR_INPUT, path, "%s, rule %u: %s is %g; it must be %s%g%s%g", list, rule + 1, key, (double)*value,
	                  most < 1e30f ? "between " : "at least ", (double)least, most < 1e30f ? " and " : ", not beyond ",
	                  (double)most);
}

static int check_hash(const char *path, const char *list, uint32_t rule, const char *key, const char *value)
{
	if (!value || (strspn(value, "0123456789abcdef") == strlen(value) && strlen(value) <= 32))
		return 0;
	return err_report(ERR_INPUT, path, "%s, rule %u: %s '%s' is not the beginning of a hash (0-9, a-f)", list, rule + 1, key,
	                  value);
}

static int check_surface(const char *path, const struct surface_rule *r, uint32_t i)
{
	static const char list[] = "surfaces";
	int err = check_number(path, list, i, "reflect", r->reflect, 0, 1);

	if (!err)
		err = check_number(path, list, i, "transmit", r->transmit, 0, 1);
	if (!err && r->reflect && r->transmit && *r->reflect + *r->transmit > 1)
		err = err_report(ERR_INPUT, path, "surfaces, rule %u: reflect and transmit are more than 1 together", i + 1);
	if (!err)
		err = check_number(path, list, i, "ior", r->ior, 1, 10);
	if (!err)
		err = check_number(path, list, i, "roughness", r->roughness, 0, 1);
	for (int c = 0; c < 3 && !err; c++) {
		err = check_number(path, list, i, "absorb", r->absorb ? r->absorb + c : NULL, 0, 1e30f);
		if (!err)
			err = check_number(path, list, i, "emission", r->emission ? r->emission + c : NULL, 0, 1e30f);
	}
	if (!err && r->match)
		err = check_hash(path, list, i, "mesh", r->match->mesh);
	if (!err && r->match)
		err = check_hash(path, list, i, "texture", r->match->texture);
	return err;
}

static int check_light(const char *path, const struct light_rule *r, uint32_t i)
{
	int err = check_number(path, "lights", i, "radius", r->radius, 0, 1e30f);

	if (!err && r->light && *r->light >= SCENE_MAX_LIGHTS)
		err = err_report(ERR_INPUT, path, "lights, rule %u: there are lights 0 to %d", i + 1, SCENE_MAX_LIGHTS - 1);
	if (!err && !r->light && !r->position)
		err = err_report(ERR_INPUT, path, "lights, rule %u: a light that is added needs a position", i + 1);
	if (!err && r->object && !r->position)
		err = err_report(ERR_INPUT, path, "lights, rule %u: object says where a position counts, and there is none", i + 1);
	if (!err && r->spot)
		err = check_number(path, "lights", i, "cutoff", r->spot->cutoff, 0, 90);
	return err ? err : check_hash(path, "lights", i, "object", r->object);
}

int look_load(const char *path, struct look **out)
{
	struct look *look = calloc(1, sizeof(*look));
	void *data = NULL;
	int err;

	if (!look)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	err = config_load(path, &rules_schema, &data);
	look->rules = data;
	if (!err) {
		look->draws = calloc(look->rules->surfaces_count + (size_t)1, sizeof(*look->draws));
		if (!look->draws)
			err = err_report(ERR_SYSTEM, NULL, "out of memory");
	}
	for (uint32_t i = 0; !err && i < look->rules->surfaces_count; i++) {
		const struct match *m = look->rules->surfaces[i].match;

		err = check_surface(path, &look->rules->surfaces[i], i);
		if (err || !m || !m->draws)
			continue;
		if (strspn(m->draws, "0123456789-,") != strlen(m->draws))
			err = err_report(ERR_INPUT, path, "surfaces, rule %u: draws '%s' is no list of numbers", i + 1, m->draws);
		else
			err = frame_list_parse(m->draws, &look->draws[i]) ? ERR_INPUT : 0;
	}
	for (uint32_t i = 0; !err && i < look->rules->lights_count; i++)
		err = check_light(path, &look->rules->lights[i], i);
	if (err)
		look_free(&look);
	*out = look;
	return err;
}

void look_free(struct look **look)
{
	struct look *l = *look;

	if (!l)
		return;
	for (uint32_t i = 0; l->draws && i < l->rules->surfaces_count; i++)
		frame_list_free(&l->draws[i]);
	free(l->draws);
	config_free(&rules_schema, l->rules);
	free(l);
	*look = NULL;
}

/* --- Which surfaces ------------------------------------------------------------------------------------------------ */

static int hash_begins(const uint64_t hash[2], const char *text)
{
	char whole[33];

	snprintf(whole, sizeof(whole), "%016" PRIx64 "%016" PRIx64, hash[1], hash[0]);
	return strncmp(whole, text, strlen(text)) == 0;
}

static int has_texture(const struct scene *s, const struct scene_material *m, const char *text)
{
	for (uint32_t i = 0; i < m->unit_count; i++)
		if (hash_begins(s->textures[s->units[m->unit_first + i].texture]->hash, text))
			return 1;
	return 0;
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
	if ((r->texture && !has_texture(s, m, r->texture)) || (r->mesh && !hash_begins(s->meshes[in->mesh]->hash, r->mesh)))
		return 0;
	if ((r->draws && !frame_list_contains(draws, in->draw)) || (r->call && (!draw || strcmp(draw->call, r->call) != 0)))
		return 0;
	if (r->list && (!draw || draw->list != *r->list))
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

static void set_surface(struct scene_surface *s, const struct surface_rule *r)
{
	set_number(&s->reflect, r->reflect, 1);
	set_number(&s->transmit, r->transmit, 1);
	set_number(&s->ior, r->ior, 1);
	set_number(&s->roughness, r->roughness, 1);
	set_number(s->absorb, r->absorb, 3);
	set_number(s->emission, r->emission, 3);
	if (r->shadows)
		s->hidden = (s->hidden & ~1u) | (*r->shadows ? 0u : 1u);
	if (r->mirrors)
		s->hidden = (s->hidden & ~2u) | (*r->mirrors ? 0u : 2u);
	if (r->lit)
		s->relit = *r->lit;
}

/* --- Lights -------------------------------------------------------------------------------------------------------- */

/* Rules that only give a light a size leave GL's lighting as it is. */
static int changes_light(const struct light_rule *r)
{
	return !r->light || r->off || r->position || r->ambient || r->diffuse || r->specular || r->attenuation || r->spot;
}

/* A light's position in eye space. It stays as written where the frame does not draw its object. */
static void place_light(const struct scene *s, const struct light_rule *r, float out[4])
{
	memcpy(out, r->position, 4 * sizeof(*out));
	for (uint32_t i = 0; r->object && i < s->n_instances; i++)
		if (hash_begins(s->meshes[s->instances[i].mesh]->hash, r->object)) {
			mat4_transform(out, s->instances[i].modelview, r->position);
			return;
		}
}

static void set_light(const struct scene *s, struct scene_light *l, const struct light_rule *r)
{
	if (r->position)
		place_light(s, r, l->position_eye);
	set_number(l->ambient, r->ambient, 3);
	set_number(l->diffuse, r->diffuse, 3);
	set_number(l->specular, r->specular, 3);
	set_number(l->attenuation, r->attenuation, 3);
	set_number(&l->radius, r->radius, 1);
	if (r->spot) {
		set_number(l->spot_direction_eye, r->spot->direction, 3);
		set_number(&l->spot_cutoff_deg, r->spot->cutoff, 1);
		set_number(&l->spot_exponent, r->spot->exponent, 1);
	}
}

/* A material's lights: GL's under the rules, and added ones. @return how many, at most SCENE_MAX_LIGHTS */
static uint32_t list_lights(const struct rules *rules, const struct scene *s, const struct scene_material *m,
                            struct scene_light out[SCENE_MAX_LIGHTS])
{
	uint32_t n = 0;

	for (uint32_t i = 0; m->lighting && i < m->light_count && n < SCENE_MAX_LIGHTS; i++) {
		struct scene_light light = s->lights[m->light_first + i];
		int off = 0;

		for (uint32_t k = 0; k < rules->lights_count; k++) {
			const struct light_rule *r = &rules->lights[k];

			if (!r->light || *r->light != light.index)
				continue;
			set_light(s, &light, r);
			off = r->off ? *r->off : off;
		}
		if (!off)
			out[n++] = light;
	}
	for (uint32_t k = 0; k < rules->lights_count && n < SCENE_MAX_LIGHTS; k++) {
		if (rules->lights[k].light || (rules->lights[k].off && *rules->lights[k].off))
			continue;
		out[n] = (struct scene_light){ .diffuse = { 1, 1, 1, 1 }, .spot_direction_eye = { 0, 0, -1 },
			                       .spot_cutoff_deg = 180, .attenuation = { 1, 0, 0 },
			                       .index = SCENE_NONE };
		set_light(s, &out[n++], &rules->lights[k]);
	}
	return n;
}

/* --- A scene ------------------------------------------------------------------------------------------------------- */

static void size_lights(const struct rules *rules, struct scene *s)
{
	for (uint32_t i = 0; i < s->n_lights; i++)
		for (uint32_t k = 0; k < rules->lights_count; k++)
			if (rules->lights[k].light && rules->lights[k].radius && *rules->lights[k].light == s->lights[i].index)
				s->lights[i].radius = *rules->lights[k].radius;
}

/* Change the surface of one instance: it gets a material of its own, where anything changes. */
static void change_instance(const struct look *look, const struct scene *scene, struct scene *out, uint32_t i,
                            int lights_change)
{
	struct scene_material *m = &out->materials[out->n_materials];
	const struct rules *rules = look->rules;
	uint32_t n = 0;

	*m = scene->materials[scene->instances[i].material];
	for (uint32_t k = 0; k < rules->surfaces_count; k++)
		if (matches(scene, &scene->instances[i], rules->surfaces[k].match, &look->draws[k]))
			set_surface(&m->surface, &rules->surfaces[k]);
	m->surface.relit = m->lighting ? (uint32_t)lights_change : m->surface.relit && lights_change;
	if (m->surface.relit) {
		n = list_lights(rules, scene, m, out->lights + out->n_lights);
		m->surface.light_first = out->n_lights;
		m->surface.light_count = n;
	}
	if (memcmp(m, &scene->materials[scene->instances[i].material], sizeof(*m)) == 0)
		return;
	out->instances[i].material = out->n_materials++;
	out->n_lights += n;
}

int look_apply(const struct look *look, const struct scene *scene, struct scene *out)
{
	size_t n = scene->n_instances;
	int lights_change = 0;

	for (uint32_t k = 0; k < look->rules->lights_count; k++)
		lights_change |= changes_light(&look->rules->lights[k]);
	*out = *scene;
	out->instances = malloc((n + 1) * sizeof(*out->instances));
	out->materials = malloc((scene->n_materials + n + 1) * sizeof(*out->materials));
	out->lights = malloc((scene->n_lights + (lights_change ? SCENE_MAX_LIGHTS * (n + 1) : 1)) * sizeof(*out->lights));
	if (!out->instances || !out->materials || !out->lights) {
		look_release(out);
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	}
	if (n)
		memcpy(out->instances, scene->instances, n * sizeof(*out->instances));
	if (scene->n_materials)
		memcpy(out->materials, scene->materials, scene->n_materials * sizeof(*out->materials));
	if (scene->n_lights)
		memcpy(out->lights, scene->lights, scene->n_lights * sizeof(*out->lights));
	size_lights(look->rules, out);
	for (uint32_t i = 0; i < n; i++)
		change_instance(look, scene, out, i, lights_change);
	return 0;
}

void look_release(struct scene *changed)
{
	free(changed->instances);
	free(changed->materials);
	free(changed->lights);
	memset(changed, 0, sizeof(*changed));
}
