#include "look/apply/lights.h"

#include <math.h>

#include "base/mat4.h"
#include "look/rules/world.h"
#include "scene/box.h"

/* The tolerance between ambient light and colours that a program rounded to 8 bits. */
#define SHADE (2.0f / 255)

int lights_in_world(const struct light_rule *r)
{
	return r->space && strcmp(r->space, "world") == 0;
}

/* Bits LIGHTS_ON_* for the surfaces that an added light reaches. */
static int lit_by(const struct light_rule *r)
{
	return r->on && strcmp(r->on, "unlit") == 0 ? LIGHTS_ON_UNLIT : LIGHTS_ON_UNLIT | LIGHTS_ON_LIT;
}

int lights_change_of(const struct light_rule *r)
{
	const int changes = r->light ? r->off || r->position || r->ambient || r->diffuse || r->specular ||
	                                       r->attenuation || r->spot :
	                               !r->off || !*r->off;

	return changes ? lit_by(r) : 0;
}

void lights_place(const struct applying *a, const struct light_rule *r, float out[4])
{
	const struct scene *s = a->scene;

	memcpy(out, r->position, 4 * sizeof(*out));
	if (lights_in_world(r))
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
	if (lights_in_world(r))
		mat4_turn(out, a->eye_from_world, out);
}

/* Set a light's size, and whether anything blocks it. */
static void size_light(struct scene_light *l, const struct light_rule *r)
{
	applying_number(&l->radius, r->radius, 1);
	if (r->shadows)
		l->radius = *r->shadows ? fmaxf(l->radius, 0) : -1;
}

static void set_light(const struct applying *a, struct scene_light *l, const struct light_rule *r)
{
	if (r->position)
		lights_place(a, r, l->position_eye);
	applying_number(l->ambient, r->ambient, 3);
	applying_number(l->diffuse, r->diffuse, 3);
	applying_number(l->specular, r->specular, 3);
	applying_number(l->attenuation, r->attenuation, 3);
	size_light(l, r);
	if (!r->spot)
		return;
	if (r->spot->direction)
		turn_spot(a, r, l->spot_direction_eye);
	applying_number(&l->spot_cutoff_deg, r->spot->cutoff, 1);
	applying_number(&l->spot_exponent, r->spot->exponent, 1);
}

/* The lights of GL for a material, under the rules. @return how many */
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

/* An upper bound for the light that reaches an object's middle. The ambient part counts twice, since it reaches the
 * whole object. */
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
	float low[3], high[3];

	scene_box(s->meshes[in->mesh], low, high);
	mat4_transform(
		out, in->modelview,
		(const float[4]){ 0.5f * (low[0] + high[0]), 0.5f * (low[1] + high[1]), 0.5f * (low[2] + high[2]), 1 });
}

uint32_t lights_list(const struct applying *a, const struct scene_instance *in, const struct scene_material *m,
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

		if (r->light || (r->off && *r->off) || !(lit_by(r) & (m->lighting ? LIGHTS_ON_LIT : LIGHTS_ON_UNLIT)))
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

int lights_leave_in_shade(const struct applying *a, const struct scene_instance *in)
{
	const float *color = a->scene->currents[in->current].color;
	float ambient[3] = { 0, 0, 0 };

	for (uint32_t k = 0; k < a->rules->lights_count; k++) {
		const struct light_rule *r = &a->rules->lights[k];

		for (int c = 0; c < 3 && !r->light && r->ambient && !(r->off && *r->off); c++)
			ambient[c] += r->ambient[c];
	}
	return fabsf(color[0] - ambient[0]) < SHADE && fabsf(color[1] - ambient[1]) < SHADE &&
	       fabsf(color[2] - ambient[2]) < SHADE;
}

void lights_size(const struct rules *rules, struct scene *s)
{
	for (uint32_t i = 0; i < s->n_lights; i++)
		for (uint32_t k = 0; k < rules->lights_count; k++)
			if (rules->lights[k].light && *rules->lights[k].light == s->lights[i].index)
				size_light(&s->lights[i], &rules->lights[k]);
}

void lights_set_sky(const struct applying *a)
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
