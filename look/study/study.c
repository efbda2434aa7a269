#include "look/study/study.h"

#include <stdlib.h>

#include "base/err.h"
#include "look/gloss.h"
#include "look/study/baked.h"
#include "look/study/cast.h"
#include "look/study/dome.h"
#include "look/study/findings.h"
#include "look/study/floor.h"
#include "look/study/lamps.h"
#include "look/study/lightmaps.h"
#include "look/matrix.h"
#include "look/study/mirrors.h"
#include "look/study/motion.h"
#include "look/study/roles.h"
#include "look/study/seen.h"
#include "look/study/shadows.h"
#include "look/study/solve.h"
#include "look/study/spared.h"
#include "look/study/sun.h"
#include "look/study/tricks.h"
#include "look/study/volumes.h"
#include "look/study/world.h"

/* The sine of the lowest height of a sun that lights the ground. */
#define LOWEST_SUN 0.1

struct study {
	struct motion motion;
	struct tricks tricks;
	struct lightmaps lightmaps, baked; /* light in textures, and in vertex colours where there is none in textures */
	struct solved solved;
	struct dome dome;
	struct cast cast;
	struct sun sun;
	struct lamps lamps;
	struct roles roles;
	struct floors floors;
	struct spared spared;
	struct seen seen;
	unsigned lit, glossy; /* materials of all frames; of these, such as mirror a little */
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

static void write_gloss(const struct study *study, FILE *out)
{
	if (study->glossy)
		fprintf(out,
		        "gloss:\n  role: highlights\n  confidence: 0.5\n  why: \"%u of %u materials that are lit have "
		        "highlights sharp enough to mirror what is near\"\n"
		        "  share: 1\n",
		        study->glossy, study->lit);
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

/* What shines in a world that OpenGL does not light, and lightmaps do not either: the sky's sun, lamps. up: receives
 * the world's */
static void find_shining(const struct study *study, double up[3], int *is_sunny, int *has_lamps)
{
	const int is_dark = dome_is_wanted(&study->dome) && !study->lightmaps.n && !findings_relights(&study->solved);
	double towards[3];

	*is_sunny = is_dark && dome_find_up(&study->dome, up) && sun_is_there(&study->sun, towards) &&
	            matrix_dot3(up, towards) > LOWEST_SUN;
	*has_lamps = is_dark && lamps_count(&study->lamps, &study->motion);
}

int study_write(const struct study *study, const char *trace, FILE *out)
{
	const struct motion *m = &study->motion;
	const struct lightmaps *maps = study->lightmaps.n ? &study->lightmaps : &study->baked;
	double up[3];
	int is_sunny, has_lamps, shines, err;

	find_shining(study, up, &is_sunny, &has_lamps);
	shines = is_sunny || has_lamps;
	fprintf(out, "# Rules for %s, written by relume look after it studied %zu frames", trace, m->n_frames);
	if (m->n_frames)
		fprintf(out, " (%llu to %llu)", (unsigned long long)m->cameras[0].frame,
		        (unsigned long long)m->cameras[m->n_frames - 1].frame);
	fprintf(out, ".\n# relume render --look FILE reads them. Change what you like: what stands here counts.\n");
	world_report(m, out);
	fprintf(out, "replace: yes # no: tricks stay as they are\n");
	fprintf(out, study->tricks.n || study->lightmaps.n || findings_relights(&study->solved) ||
	                             spared_count(&study->spared) || roles_count(&study->roles, m) ||
	                             cast_write(&study->cast, NULL) || floors_write(&study->floors, NULL) || shines ?
	                     "surfaces:\n" :
	                     "surfaces: []\n");
	spared_write(&study->spared, out);
	findings_write_surfaces(&study->tricks, maps, &study->solved, out);
	if (shines)
		sun_write_surfaces(out);
	roles_write(&study->roles, m, shines || (maps == &study->baked && findings_relights(&study->solved)), out);
	cast_write(&study->cast, out);
	floors_write(&study->floors, out);
	if (shines)
		lamps_write_surfaces(&study->lamps, m, out);
	err = seen_write(&study->seen, m, out);
	findings_write_lights(&study->tricks, maps, &study->solved, shines, out);
	if (shines)
		sun_write_ambient(&study->sun, is_sunny ? up : NULL, out);
	if (is_sunny)
		sun_write_light(&study->sun, up, out);
	if (has_lamps)
		lamps_write_lights(&study->lamps, m, out);
	if (!findings_relights(&study->solved))
		dome_write(&study->dome, out);
	write_gloss(study, out);
	world_write(m, out);
	return err;
}
