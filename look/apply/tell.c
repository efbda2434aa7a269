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

enum { TOLD_BYTES = 250, TOLD_DRAWS = 90, MOST_REPAIRS = 64 };

/* 1 if an earlier rule for surfaces has the same role as the k-th; they share a line. */
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
		if (a->rules->surfaces[k].reason.role && strcmp(a->rules->surfaces[k].reason.role, role) == 0 &&
		    match_applies(a, in, k))
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

/* The draws of a role, as ranges, cut off if there are too many. @return 0 or ERR_SYSTEM (reported) */
static int list_draws(const struct applying *a, const char *role, char out[TOLD_DRAWS])
{
	char *all = scene_draw_list(a->scene, is_with_role, &(struct with_role){ a, role });
	size_t n = all ? strcspn(all, ",") : 0;

	if (!all)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	while (all[n] && n < TOLD_DRAWS - 24)
		n += 1 + strcspn(all + n + 1, ",");
	memcpy(out, all, n);
	out[n] = 0;
	free(all);
	return 0;
}

static int tell_one(const char *kind, const struct rule_reason *r, const char *what,
                    int (*tell)(void *user, const char *text), void *user)
{
	char text[TOLD_BYTES];

	snprintf(text, sizeof(text), "%s\t%.40s\t%.2f\t%s\t%s", kind, r->role,
	         r->confidence ? (double)*r->confidence : 1.0, what, r->why ? r->why : "");
	return tell(user, text);
}

static int tell_surfaces(const struct applying *a, int (*tell)(void *user, const char *text), void *user)
{
	int err = 0;

	for (uint32_t k = 0; k < a->rules->surfaces_count && !err; k++) {
		char draws[TOLD_DRAWS];

		if (!a->rules->surfaces[k].reason.role || is_told(a->rules, k))
			continue;
		err = list_draws(a, a->rules->surfaces[k].reason.role, draws);
		if (!err && draws[0])
			err = tell_one("surface", &a->rules->surfaces[k].reason, draws, tell, user);
	}
	return err;
}

/* Report the first instance of each repaired mesh, and its repair. */
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
