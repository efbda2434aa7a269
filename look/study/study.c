#include "look/study/study.h"

#include <stdlib.h>

#include "base/err.h"
#include "look/draws/gloss.h"
#include "look/draws/matrix.h"
#include "look/study/light/baked.h"
#include "look/study/light/dome.h"
#include "look/study/light/lamps.h"
#include "look/study/light/lightmaps.h"
#include "look/study/light/relight.h"
#include "look/study/light/solve.h"
#include "look/study/light/sun.h"
#include "look/study/motion/anchors.h"
#include "look/study/motion/motion.h"
#include "look/study/motion/seen.h"
#include "look/study/roles/roles.h"
#include "look/study/spared.h"
#include "look/study/tricks/cast.h"
#include "look/study/tricks/floor.h"
#include "look/study/tricks/mirrors.h"
#include "look/study/tricks/shadows.h"
#include "look/study/tricks/tricks.h"
#include "look/study/tricks/volumes.h"

/* The sine of the lowest elevation of a sun that lights the ground. */
#define LOWEST_SUN 0.1

struct study {
	struct motion motion;
	struct tricks tricks;
	struct lightmaps lightmaps, baked; /* light in textures; light in vertex colours, used if there is none in
	                                      textures */
	struct solved solved;
	struct dome dome;
	struct cast cast;
	struct sun sun;
	struct lamps lamps;
	struct roles roles;
	struct floors floors;
	struct spared spared;
	struct seen seen;
	unsigned lit, glossy; /* materials of all frames that are lit; those that mirror a little */
};

int study_create(struct study **out)
{
	*out = calloc(1, sizeof(**out));
	return *out ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");
}

void study_destroy(struct study **study)
{
	if (!*study)
		return;
	motion_free(&(*study)->motion);
	lightmaps_free(&(*study)->lightmaps);
	lightmaps_free(&(*study)->baked);
	roles_free(&(*study)->roles);
	spared_free(&(*study)->spared);
	seen_free(&(*study)->seen);
	free(*study);
	*study = NULL;
}

uint64_t study_most_frames(void)
{
	return MOTION_MAX_FRAMES;
}

static void note_gloss(struct study *study, const struct scene *scene)
{
	for (uint32_t i = 0; i < scene->n_materials; i++) {
		struct scene_surface surface = { .reflect = 0 };

		gloss_set(&scene->materials[i], 1, &surface);
		study->lit += scene->materials[i].lighting != 0;
		study->glossy += surface.reflect > 0;
	}
}

static void find_gloss(const struct study *study, struct findings *out)
{
	struct finding *rule;

	if (!study->glossy)
		return;
	rule = findings_add(out, FINDINGS_GLOSS, "highlights");
	FINDING_SET(rule, FINDING_NUMBER("confidence", 1, 0.5));
	finding_say(rule, "%u of %u materials that are lit have highlights sharp enough to mirror what is near",
	            study->glossy, study->lit);
	FINDING_SET(rule, FINDING_NUMBER("share", 1, 1));
}

int study_add(struct study *study, const struct scene *scene)
{
	int err = motion_add(&study->motion, scene);

	if (!err)
		err = shadows_add(&study->tricks, scene, &study->motion);
	if (!err)
		floors_add(&study->floors, scene, &study->motion, &study->tricks);
	if (!err)
		err = mirrors_add(&study->tricks, scene, &study->motion);
	if (!err)
		err = volumes_add(&study->tricks, scene, &study->motion);
	if (!err)
		err = roles_add(&study->roles, scene, &study->motion);
	if (!err)
		err = spared_add(&study->spared, scene);
	if (!err)
		err = seen_add(&study->seen, scene, &study->motion);
	if (!err) {
		dome_add(&study->dome, scene, &study->motion, study->roles.kinds.layers);
		note_gloss(study, scene);
		cast_add(&study->cast, scene);
	}
	if (!err)
		err = sun_add(&study->sun, scene, &study->motion, study->roles.kinds.layers);
	if (!err)
		lamps_add(&study->lamps, scene, &study->motion, study->roles.kinds.layers);
	if (!err)
		err = lightmaps_add(&study->lightmaps, scene, &study->motion);
	return err ? err : baked_add(&study->baked, scene, &study->motion);
}

int study_finish(struct study *study)
{
	struct lightmaps *maps = study->lightmaps.n ? &study->lightmaps : &study->baked;

	return maps->n ? solve_lights(maps, &study->solved) : 0;
}

/* Find lights in a world that neither OpenGL nor lightmaps light: the sun in the sky, and lamps. @param up  receives
 * the world's up */
static void find_shining(const struct study *study, double up[3], int *is_sunny, int *has_lamps)
{
	const int is_dark = dome_is_wanted(&study->dome) && !study->lightmaps.n && !relight_is_known(&study->solved);
	double towards[3];

	*is_sunny = is_dark && dome_find_up(&study->dome, up) && sun_is_there(&study->sun, towards) &&
	            matrix_dot3(up, towards) > LOWEST_SUN;
	*has_lamps = is_dark && lamps_count(&study->lamps, &study->motion);
}

int study_find(const struct study *study, struct findings *out)
{
	const struct motion *m = &study->motion;
	const struct lightmaps *maps = study->lightmaps.n ? &study->lightmaps : &study->baked;
	double up[3];
	int is_sunny, has_lamps, shines, err;

	find_shining(study, up, &is_sunny, &has_lamps);
	shines = is_sunny || has_lamps;
	anchors_summarize(m, &out->summary);
	spared_find(&study->spared, out);
	relight_find_surfaces(&study->tricks, maps, &study->solved, out);
	if (shines)
		sun_find_surfaces(out);
	roles_find(&study->roles, m, shines || (maps == &study->baked && relight_is_known(&study->solved)), out);
	cast_find(&study->cast, out);
	floors_find(&study->floors, out);
	if (shines)
		lamps_find_surfaces(&study->lamps, m, out);
	err = seen_find(&study->seen, m, out);
	relight_find_lights(&study->tricks, maps, &study->solved, out);
	if (shines)
		sun_find_ambient(&study->sun, is_sunny ? up : NULL, out);
	if (is_sunny)
		sun_find_light(&study->sun, up, out);
	if (has_lamps)
		lamps_find_lights(&study->lamps, m, out);
	if (!relight_is_known(&study->solved))
		dome_find(&study->dome, out);
	find_gloss(study, out);
	anchors_find(m, out);
	return err ? err : findings_check(out);
}
