#include "look/study/tricks/mirrors.h"

#include <math.h>
#include <string.h>

#include "gl_tokens.h"
#include "look/draws/matrix.h"
#include "look/draws/modelview.h"
#include "look/draws/pairs.h"
#include "look/draws/plane.h"

/* The plane of a reflection in eye space, with its normal towards the viewer. @return 0: the matrix is no reflection */
static int read_reflection(const double m[16], double plane[4])
{
	double square = 0, most = 0;
	int best = 0;

	/* I - R = 2 n n^T: its longest column is along n, whose square lies on the diagonal. */
	for (int c = 0; c < 3; c++)
		best = 1 - m[5 * c] > 1 - m[5 * best] ? c : best;
	if (!(1 - m[5 * best] > 0.1))
		return 0;
	for (int r = 0; r < 3; r++)
		plane[r] = ((r == best) - m[4 * best + r]) / sqrt(2 * (1 - m[5 * best]));
	for (int r = 0; r < 3; r++)
		square += plane[r] * plane[r];
	for (int c = 0; c < 3; c++)
		for (int r = 0; r < 3; r++)
			most = fmax(most, fabs(m[4 * c + r] - (r == c) + 2 * plane[r] * plane[c] / square));
	if (most > 1e-3 || fabs(square - 1) > 1e-2)
		return 0;
	plane[3] = 0;
	for (int r = 0; r < 3; r++) {
		plane[r] /= sqrt(square);
		plane[3] -= 0.5 * m[12 + r] * plane[r];
	}
	for (int k = 0, behind = plane[3] < 0; k < 4 && behind; k++)
		plane[k] = -plane[k];
	return 1;
}

/* 1 if a texture is opaque and does not change alpha. */
static int is_opaque(const struct scene *s, const struct scene_unit *u)
{
	const struct scene_texture *t = s->textures[u->texture];

	for (size_t i = 0; i < (size_t)t->width * t->height; i++)
		if (t->floats || t->texels[4 * i + 3] != 255)
			return 0;
	return u->env_mode == GL_MODULATE || u->env_mode == GL_DECAL;
}

/* The share of the background that a draw lets through. */
static double share_behind(const struct scene *s, const struct scene_instance *in)
{
	const struct scene_material *m = &s->materials[in->material];

	if (!m->blend || m->blend_src_rgb != GL_SRC_ALPHA || m->blend_dst_rgb != GL_ONE_MINUS_SRC_ALPHA || m->unit_count > 1 ||
	    (m->unit_count && !is_opaque(s, &s->units[m->unit_first])))
		return 0;
	if (m->lighting)
		return 1 - fmin(1, fmax(0, (double)m->front.diffuse[3]));
	return s->meshes[in->mesh]->color ? 1 - (double)s->meshes[in->mesh]->color[3] :
	                                    1 - (double)s->currents[in->current].color[3];
}

/* Find the surface over the mirror image: a blended draw in its plane, after it. */
static void find_surface(struct trick_found *f, const struct scene *s, uint32_t after, const double plane[4])
{
	const float here[4] = { (float)plane[0], (float)plane[1], (float)plane[2], (float)plane[3] };

	for (uint32_t i = after + 1; i < s->n_instances && !(f->shows > 0); i++) {
		const struct scene_instance *in = &s->instances[i];

		if (s->meshes[in->mesh]->kind != SCENE_TRIANGLES || in->rectangle ||
		    !(s->materials[in->material].color_mask & 7) || !(share_behind(s, in) > 0) ||
		    modelview_kind_of(in->modelview) != MODELVIEW_PLAIN || !plane_holds(s, in, here))
			continue;
		f->shows = share_behind(s, in);
		f->surface_stencil = s->materials[in->material].stencil_test != 0;
	}
}

static void study_mirrored(struct tricks *t, const struct scene *s, const struct pairs *pairs, uint32_t mirrored,
                           const struct motion *motion)
{
	const double *camera = motion_now(motion)->eye_from_world;
	uint32_t upright = pairs_find(pairs, s, mirrored, MODELVIEW_PLAIN);
	double reflected[16];

	matrix_from_floats(reflected, s->instances[mirrored].modelview);
	for (int tries = 0; upright != SCENE_NONE && tries < 4; upright = pairs->next[upright], tries++) {
		struct trick_found what = { .kind = TRICK_MIRROR }, *f;
		double eye[16], inverse[16], relative[16], plane[4];

		matrix_from_floats(eye, s->instances[upright].modelview);
		if (!matrix_invert(inverse, eye))
			continue;
		matrix_mul(relative, reflected, inverse);
		if (!read_reflection(relative, plane))
			continue;
		for (int c = 0; c < 4; c++)
			for (int r = 0; r < 4; r++)
				what.plane[c] += plane[r] * camera[4 * c + r];
		what.stencil = s->materials[s->instances[mirrored].material].stencil_test != 0;
		f = tricks_note(t, &what, motion->n_frames);
		if (f && f->votes % 64 == 1 && !(f->shows > 0))
			find_surface(f, s, mirrored, plane);
	}
}

int mirrors_add(struct tricks *t, const struct scene *s, const struct motion *motion)
{
	struct pairs pairs = { .next = NULL };
	uint32_t mirrored = 0, plain = 0;
	int err = 0;

	for (uint32_t i = 0; i < s->n_instances; i++) {
		enum modelview_kind kind = modelview_kind_of(s->instances[i].modelview);

		mirrored += kind == MODELVIEW_MIRRORED;
		plain += kind == MODELVIEW_PLAIN;
	}
	if (!mirrored || !plain)
		return 0;
	err = pairs_make(&pairs, s);
	for (uint32_t i = 0; i < s->n_instances && !err; i++) {
		const struct scene_instance *in = &s->instances[i];

		if (s->meshes[in->mesh]->kind == SCENE_TRIANGLES && !in->rectangle &&
		    modelview_kind_of(in->modelview) == MODELVIEW_MIRRORED)
			study_mirrored(t, s, &pairs, i, motion);
	}
	pairs_free(&pairs);
	return err;
}
