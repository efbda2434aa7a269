#include "look/apply/tell.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "look/apply/apply.h"
#include "look/apply/lights.h"
#include "look/apply/match.h"
#include "look/apply/meshes.h"
#include "look/apply/surface.h"
#include "look/rules/repaired.h"
#include "scene/draw_list.h"

enum {
	LINE_BYTES = 250,       /* a whole line; longer ones are cut off */
	DETAIL_BYTES = 90,      /* its list of draws, or its light's position */
	RANGE_BYTES = 24,       /* one more range in that list, ",4294967295-4294967295", and the final 0 */
	MOST_REPAIR_LINES = 64, /* per frame */
};

/* 1 if an earlier rule for surfaces has the same role as the k-th: rules with one role share a line. */
static int is_repeated_role(const struct rules *rules, uint32_t k)
{
	for (uint32_t i = 0; i < k; i++)
		if (rules->surfaces[i].reason.role && strcmp(rules->surfaces[i].reason.role, rules->surfaces[k].reason.role) == 0)
			return 1;
	return 0;
}

/* 1 if any rule with this role applies to an instance. */
static int has_role(const struct applying *a, const struct scene_instance *in, const char *role)
{
	for (uint32_t k = 0; k < a->rules->surfaces_count; k++)
		if (a->rules->surfaces[k].reason.role && strcmp(a->rules->surfaces[k].reason.role, role) == 0 &&
		    match_applies(a, in, k))
			return 1;
	return 0;
}

struct role_filter {
	const struct applying *a;
	const char *role;
};

static int instance_has_role(const void *user, const struct scene *scene, uint32_t i)
{
	const struct role_filter *w = user;

	return has_role(w->a, &scene->instances[i], w->role);
}

/* The draws of a role as whole ranges, as many as fit. @return 0 or ERR_SYSTEM (reported) */
static int list_draws(const struct applying *a, const char *role, char out[DETAIL_BYTES])
{
	char *all = scene_draw_list(a->scene, instance_has_role, &(struct role_filter){ a, role });
	size_t n = all ? strcspn(all, ",") : 0;

	if (!all)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	while (all[n] && n < DETAIL_BYTES - RANGE_BYTES)
		n += 1 + strcspn(all + n + 1, ",");
	memcpy(out, all, n);
	out[n] = 0;
	free(all);
	return 0;
}

/* Pass one line. kind: "surface" or "light"; what: the draws, or the light's position */
static int tell_one(const char *kind, const struct rule_reason *r, const char *what,
                    int (*tell)(void *user, const char *text), void *user)
{
	char text[LINE_BYTES];

	snprintf(text, sizeof(text), "%s\t%.40s\t%.2f\t%s\t%s", kind, r->role,
	         r->confidence ? (double)*r->confidence : 1.0, what, r->why ? r->why : "");
	return tell(user, text);
}

static int tell_surfaces(const struct applying *a, int (*tell)(void *user, const char *text), void *user)
{
	int err = 0;

	for (uint32_t k = 0; k < a->rules->surfaces_count && !err; k++) {
		char draws[DETAIL_BYTES];

		if (!a->rules->surfaces[k].reason.role || is_repeated_role(a->rules, k))
			continue;
		err = list_draws(a, a->rules->surfaces[k].reason.role, draws);
		if (!err && draws[0])
			err = tell_one("surface", &a->rules->surfaces[k].reason, draws, tell, user);
	}
	return err;
}

/* Report each repaired mesh with the draw of its first instance. Consecutive instances of a mesh share a line. */
static int tell_repairs(const struct applying *a, int (*tell)(void *user, const char *text), void *user)
{
	const struct scene *s = a->scene;
	const struct scene_mesh *last = NULL; /* reported last */
	int err = 0;

	if (!a->look || !a->look->repaired)
		return 0;
	for (uint32_t i = 0, n = 0; i < s->n_instances && n < MOST_REPAIR_LINES && !err; i++) {
		const struct scene_instance *in = &s->instances[i];
		char text[LINE_BYTES], why[LINE_BYTES - 50];
		const struct scene_mesh *mesh;
		struct repair_wants wants;
		struct repair_found found;
		struct scene_material m = s->materials[in->material];

		if (s->meshes[in->mesh] == last)
			continue;
		for (uint32_t k = 0; k < a->rules->surfaces_count; k++)
			if (match_applies(a, in, k))
				surface_set(&m.surface, &a->rules->surfaces[k], look_spares(a->look));
		if (!meshes_wants_repair(a, in, &m, &wants))
			continue;
		last = s->meshes[in->mesh];
		err = repaired_find(a->look->repaired, last, &wants, &mesh, &found);
		repaired_describe(&found, why, sizeof(why));
		snprintf(text, sizeof(text), "surface\t%s\t1.00\t%u\t%s",
		         found.closed ? "closed mesh" :
		         found.leaks  ? "mesh that leaks" :
		                        "mesh",
		         in->draw, why);
		err = err ? err : tell(user, text);
		n++;
	}
	return err;
}

/* Report added and changed lights, then the sky and highlights, which have no position. */
static int tell_lights(const struct applying *a, int (*tell)(void *user, const char *text), void *user)
{
	int err = 0;

	for (uint32_t k = 0; k < a->rules->lights_count && !err; k++) {
		const struct light_rule *r = &a->rules->lights[k];
		char place[DETAIL_BYTES] = "";
		float at[4];

		if (!r->reason.role)
			continue;
		if (r->position) {
			lights_place(a, r, at);
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
	int err = match_begin(&a);

	if (!err)
		err = tell_surfaces(&a, tell, user);
	if (!err)
		err = tell_repairs(&a, tell, user);
	if (!err)
		err = tell_lights(&a, tell, user);
	match_end(&a);
	return err;
}
