#include "look/study/tricks/shadows.h"

#include <math.h>
#include <string.h>

#include "look/draws/matrix.h"
#include "look/draws/modelview.h"
#include "look/draws/pairs.h"
#include "look/spare/flattened.h"

static void into_world(const struct motion_camera *camera, double light[4], double plane[4])
{
	double inverse[16], out[4];

	if (!matrix_invert(inverse, camera->eye_from_world))
		return;
	matrix_transform(out, inverse, light);
	memcpy(light, out, 3 * sizeof(*out)); /* the camera's position does not change an infinite distance */
	for (int c = 0; c < 4; c++) {
		out[c] = 0;
		for (int r = 0; r < 4; r++)
			out[c] += plane[r] * camera->eye_from_world[4 * c + r];
	}
	memcpy(plane, out, sizeof(out));
}

/* Compare a flat draw with upright draws of the same mesh. The majority decides; tricks_note counts. */
static void study_flat(struct tricks *t, const struct scene *s, const struct pairs *pairs, uint32_t flat,
                       const struct motion *motion)
{
	uint32_t upright = pairs_find(pairs, s, flat, MODELVIEW_PLAIN);

	t->unmatched += upright == SCENE_NONE;
	for (int tries = 0; upright != SCENE_NONE && tries < 4; upright = pairs->next[upright], tries++) {
		struct trick_found what = { .kind = TRICK_PLANAR_SHADOW };

		if (!flattened_from(s, flat, upright, what.light, what.plane))
			continue;
		what.stencil = !(s->materials[s->instances[flat].material].color_mask & 7);
		what.has_opengl_light = flattened_is_lit(s, what.light, what.plane);
		into_world(motion_now(motion), what.light, what.plane);
		tricks_note(t, &what, motion->n_frames);
	}
}

int shadows_add(struct tricks *t, const struct scene *s, const struct motion *motion)
{
	struct pairs pairs = { .next = NULL };
	int flat = 0, err = 0;

	for (uint32_t i = 0; i < s->n_instances && !flat; i++)
		flat = modelview_kind_of(s->instances[i].modelview) == MODELVIEW_SINGULAR;
	if (flat)
		err = pairs_make(&pairs, s);
	for (uint32_t i = 0; i < s->n_instances && flat && !err; i++)
		if (flattened_may_be(s, &s->instances[i]))
			study_flat(t, s, &pairs, i, motion);
	pairs_free(&pairs);
	return err;
}
