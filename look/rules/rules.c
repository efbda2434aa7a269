#include "look/rules/rules.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/config.h"
#include "base/err.h"
#include "look/draws/modelview.h"
#include "look/rules/adopted.h"
#include "look/rules/findings.h"
#include "look/rules/matched.h"
#include "look/rules/repaired.h"
#include "look/rules/schema.h"
#include "look/spare/spare.h"
#include "scene/release.h"
#include "scene/scene.h"

/* --- Checks beyond libcyaml's ------------------------------------------------------------------------------------ */

/* @param value  NULL: the key is missing, which is fine. @param rule  from 0 */
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
	return err_report(ERR_INPUT, path, "%s, rule %u: %s '%s' is not the start of a hash (0-9, a-f)", list,
	                  rule + 1, key, value);
}

static int check_surface(const char *path, const struct surface_rule *r, uint32_t i)
{
	static const char list[] = "surfaces";
	int err = check_number(path, list, i, "reflect", r->reflect, 0, 1);

	if (!err)
		err = check_number(path, list, i, "transmit", r->transmit, 0, 1);
	if (!err && r->reflect && r->transmit && *r->reflect + *r->transmit > 1)
		err = err_report(ERR_INPUT, path, "surfaces, rule %u: reflect and transmit add up to more than 1", i + 1);
	if (!err)
		err = check_number(path, list, i, "ior", r->ior, 1, 10);
	if (!err)
		err = check_number(path, list, i, "roughness", r->roughness, 0, 1);
	if (!err)
		err = check_number(path, list, i, "crease", r->crease, 0, 180);
	if (!err && r->repair)
		err = check_number(path, list, i, "weld", r->repair->weld, 0, REPAIR_MOST_WELD);
	for (int c = 0; c < 3 && !err; c++) {
		err = check_number(path, list, i, "absorb", r->absorb ? r->absorb + c : NULL, 0, 1e30f);
		if (!err)
			err = check_number(path, list, i, "emission", r->emission ? r->emission + c : NULL, 0, 1e30f);
	}
	if (!err && r->match && r->match->modelview && modelview_named(r->match->modelview) == N_MODELVIEW_KINDS)
		err = err_report(ERR_INPUT, path, "surfaces, rule %u: modelview must be plain, mirrored or singular, not '%s'", i + 1,
		                 r->match->modelview);
	if (!err && r->passes && !spare_named(r->passes, &(uint32_t){ 0 }))
		err = err_report(
			ERR_INPUT, path,
			"surfaces, rule %u: passes must be none, from behind, suns, suns and from behind, or all, not '%s'",
			i + 1, r->passes);
	if (!err && r->match)
		err = check_hash(path, list, i, "mesh", r->match->mesh);
	if (!err && r->match)
		err = check_hash(path, list, i, "texture", r->match->texture);
	return err;
}

static int read_draws(const char *path, const char *list, uint32_t rule, const char *text, struct frame_list *out)
{
	if (strspn(text, "0123456789-,") != strlen(text))
		return err_report(ERR_INPUT, path, "%s, rule %u: draws '%.80s' is not a list of numbers", list, rule + 1, text);
	return frame_list_parse(text, out) ? ERR_INPUT : 0;
}

static int check_space(const char *path, const char *what, const char *space)
{
	if (!space || strcmp(space, "world") == 0 || strcmp(space, "eye") == 0)
		return 0;
	return err_report(ERR_INPUT, path, "%s: space must be eye or world, not '%s'", what, space);
}

static int check_light(const char *path, const struct light_rule *r, uint32_t i)
{
	char what[32];
	int err = check_number(path, "lights", i, "radius", r->radius, 0, 1e30f);

	if (!err && r->light && *r->light >= SCENE_MAX_LIGHTS)
		err = err_report(ERR_INPUT, path, "lights, rule %u: light must be between 0 and %d", i + 1, SCENE_MAX_LIGHTS - 1);
	if (!err && !r->light && !r->position)
		err = err_report(ERR_INPUT, path, "lights, rule %u: a new light needs a position", i + 1);
	if (!err && r->object && !r->position)
		err = err_report(ERR_INPUT, path, "lights, rule %u: object needs a position", i + 1);
	if (!err && r->spot)
		err = check_number(path, "lights", i, "cutoff", r->spot->cutoff, 0, 90);
	snprintf(what, sizeof(what), "lights, rule %u", i + 1);
	if (!err)
		err = check_space(path, what, r->space);
	if (!err && r->on && strcmp(r->on, "unlit") != 0 && strcmp(r->on, "all") != 0)
		err = err_report(ERR_INPUT, path, "lights, rule %u: on must be unlit or all, not '%s'", i + 1, r->on);
	return err ? err : check_hash(path, "lights", i, "object", r->object);
}

static int check_sky(const char *path, const struct sky_rule *r)
{
	int err = r->reach ? check_number(path, "sky", 0, "reach", r->reach, 1e-30f, 1e30f) :
	                     err_report(ERR_INPUT, path, "sky: reach is missing");

	for (int c = 0; c < 3 && !err; c++) {
		err = check_number(path, "sky", 0, "light", r->light ? r->light + c : NULL, 0, 1e30f);
		if (!err)
			err = check_number(path, "sky", 0, "ground", r->ground ? r->ground + c : NULL, 0, 1e30f);
	}
	if (!err && r->up && r->up[0] == 0 && r->up[1] == 0 && r->up[2] == 0)
		err = err_report(ERR_INPUT, path, "sky: up must not be 0");
	if (!err)
		err = check_number(path, "sky", 0, "lit", r->lit, 0, 1);
	return err ? err : check_space(path, "sky", r->space);
}

static int check_anchor(const char *path, const struct anchor *a, uint32_t i)
{
	if (!a->mesh || !a->at)
		return err_report(ERR_INPUT, path, "world, entry %u: mesh or at is missing", i + 1);
	return check_hash(path, "world", i, "mesh", a->mesh);
}

/* Check ranges and required keys of what libcyaml has read, and parse the lists of draws. */
static int check_all(const char *path, struct look *look)
{
	const struct rules *rules = look->rules;
	int err = 0;

	look->draws = calloc(rules->surfaces_count + (size_t)1, sizeof(*look->draws));
	look->unseen = calloc(rules->unseen_count + (size_t)1, sizeof(*look->unseen));
	if (!look->draws || !look->unseen)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t i = 0; !err && i < rules->surfaces_count; i++) {
		const struct match *m = rules->surfaces[i].match;

		err = check_surface(path, &rules->surfaces[i], i);
		if (!err && rules->surfaces[i].repair && !look->repaired)
			err = repaired_create(&look->repaired);
		if (err || !m || !m->draws)
			continue;
		err = read_draws(path, "surfaces", i, m->draws, &look->draws[i]);
	}
	for (uint32_t i = 0; !err && i < rules->unseen_count; i++) {
		if (!rules->unseen[i].frame || !rules->unseen[i].draws)
			err = err_report(ERR_INPUT, path, "unseen, rule %u: it needs a frame and draws", i + 1);
		else
			err = read_draws(path, "unseen", i, rules->unseen[i].draws, &look->unseen[i].draws);
	}
	for (uint32_t i = 0; !err && i < rules->lights_count; i++)
		err = check_light(path, &rules->lights[i], i);
	for (uint32_t i = 0; !err && i < rules->world_count; i++)
		err = check_anchor(path, &rules->world[i], i);
	if (!err && rules->gloss)
		err = check_number(path, "gloss", 0, "share", rules->gloss->share, 0, 1);
	if (!err && rules->sky)
		err = check_sky(path, rules->sky);
	return err;
}

/* @param err  the result of reading the rules, which are NULL if it failed */
static int finish(const char *path, int err, void *rules, struct look **out)
{
	struct look *look = err ? NULL : calloc(1, sizeof(*look));

	*out = NULL;
	if (err)
		return err;
	if (!look) {
		config_free(&rules_schema, rules);
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	}
	look->rules = rules;
	err = check_all(path, look);
	if (!err)
		err = matched_create(path, look->rules->surfaces_count, &look->matched);
	if (err)
		rules_free(&look);
	*out = look;
	return err;
}

int rules_load(const char *path, struct look **out)
{
	void *data = NULL;
	int err = config_load(path, &rules_schema, &data);

	return finish(path, err, data, out);
}

int rules_parse(const char *name, const char *text, size_t n, struct look **out)
{
	void *data = NULL;
	int err = config_parse(name, text, n, &rules_schema, &data);

	return finish(name, err, data, out);
}

int rules_from_findings(const char *name, const struct findings *findings, struct look **out)
{
	struct rules *rules = NULL;
	int err = adopted_create(findings, &rules);

	return finish(name, err, rules, out);
}

void rules_free(struct look **look)
{
	struct look *l = *look;

	if (!l)
		return;
	for (uint32_t i = 0; l->draws && i < l->rules->surfaces_count; i++)
		frame_list_free(&l->draws[i]);
	for (uint32_t i = 0; l->unseen && i < l->rules->unseen_count; i++) {
		frame_list_free(&l->unseen[i].draws);
		scene_release(&l->unseen[i].scene);
	}
	matched_destroy(&l->matched);
	repaired_destroy(&l->repaired);
	free(l->draws);
	free(l->unseen);
	config_free(&rules_schema, l->rules);
	free(l);
	*look = NULL;
}

