#include "look/study/tricks/floor.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "look/draws/drawn.h"
#include "look/draws/matrix.h"
#include "look/draws/modelview.h"
#include "look/draws/plane.h"
#include "look/study/motion/face.h"

/* A floor has at most this many triangles. */
enum { MOST_TRIANGLES = 512 };
/* In at least LEAST_EVEN of the texels, neighbours differ by at most ALIKE of 255. The mean of each texel's largest
 * channel is at most DARKEST. */
enum { ALIKE = 6 };
#define LEAST_EVEN 0.5
#define DARKEST 0.3
/* A floor covers at least LEAST_SHARE of the window, and at least LEAST_SHADOWED of its draws lie in the plane of a
 * shadow. */
#define LEAST_SHARE 0.08
#define LEAST_SHADOWED 0.5
/* Reflectance of glass and polished stone at 75 degrees, by Fresnel's equations for an index of 1.5. */
#define MIRRORED 0.25

/* 1 if two planes are the same, whichever side they show. */
static int is_same_plane(const double a[4], const double b[4])
{
	const double side = matrix_dot3(a, b) < 0 ? -1 : 1;

	return fabs(matrix_dot3(a, b)) > 0.9999 && fabs(a[3] - side * b[3]) < 0.01 * (1 + fabs(a[3]));
}

static int has_shadow(const struct tricks *t, const double plane[4])
{
	for (unsigned i = 0; i < t->n; i++)
		if (t->found[i].kind == TRICK_PLANAR_SHADOW && !tricks_is_outvoted(t, i) && is_same_plane(t->found[i].plane, plane))
			return 1;
	return 0;
}

/* The plane in eye space that contains a whole draw. @param share  receives the share of the window it covers
 * @return 0: the draw is not flat */
static int find_plane(const struct scene *s, const struct scene_instance *in, double plane[4], double *share)
{
	const struct scene_mesh *mesh = s->meshes[in->mesh];
	double eye[16], size;
	float rounded[4];
	int found = 0;

	matrix_from_floats(eye, in->modelview);
	*share = 0;
	for (uint32_t p = 0; p < mesh->primitive_count; p++) {
		struct face face;

		if (!face_of(mesh, eye, p, &face))
			continue;
		for (int k = 0; k < 3 && !found; k++)
			plane[k] = face.normal[k];
		plane[3] = found ? plane[3] : -matrix_dot3(face.normal, face.corner[0]);
		found = 1;
		*share += face_share(&face, s->views[in->view].projection, &size);
	}
	for (int k = 0; k < 4 && found; k++)
		rounded[k] = (float)plane[k];
	return found && plane_holds(s, in, rounded);
}

/* Transform a plane from eye space to the world. */
static void into_world(const struct motion *motion, double plane[4])
{
	const double *eye = motion_now(motion)->eye_from_world;
	double out[4] = { 0, 0, 0, 0 };

	for (int c = 0; c < 4; c++)
		for (int r = 0; r < 4; r++)
			out[c] += plane[r] * eye[4 * c + r];
	memcpy(plane, out, sizeof(out));
}

static void read_texels(const struct scene_texture *t, struct floor_texture *f)
{
	const size_t n = (size_t)t->width * t->height;
	size_t even = 0;
	double sum = 0;

	for (uint32_t y = 0; y < t->height; y++)
		for (uint32_t x = 0; x < t->width; x++) {
			const uint8_t *c = t->texels + 4 * ((size_t)y * t->width + x),
				      *next[2] = { t->texels + 4 * ((size_t)y * t->width + (x + 1) % t->width),
				                   t->texels + 4 * ((size_t)((y + 1) % t->height) * t->width + x) };
			int off = 0, most = 0;

			for (int k = 0; k < 3; k++) {
				most = c[k] > most ? c[k] : most;
				for (int i = 0; i < 2; i++)
					off = abs(c[k] - next[i][k]) > off ? abs(c[k] - next[i][k]) : off;
			}
			even += off <= ALIKE;
			sum += most / 255.0;
		}
	f->even = n ? (double)even / (double)n : 0;
	f->shown = n ? sum / (double)n : 1;
}

static struct floor_texture *find_texture(struct floors *f, const struct scene_texture *t)
{
	for (unsigned i = 0; i < f->n; i++)
		if (memcmp(f->textures[i].hash, t->hash, sizeof(t->hash)) == 0)
			return &f->textures[i];
	if (f->n == FLOORS_MOST)
		return NULL;
	memcpy(f->textures[f->n].hash, t->hash, sizeof(t->hash));
	read_texels(t, &f->textures[f->n]);
	return &f->textures[f->n++];
}

/* 1 if a draw may be such a floor: a flat picture that OpenGL does not light. */
static int may_be_floor(const struct scene *s, const struct scene_instance *in)
{
	const struct scene_material *m = &s->materials[in->material];
	const struct scene_mesh *mesh = s->meshes[in->mesh];
	const struct scene_texture *t = m->unit_count == 1 ? s->textures[s->units[m->unit_first].texture] : NULL;

	return t && !t->floats && t->texels && !t->border && !m->lighting && !m->program && !m->stencil_test &&
	       !in->rectangle && m->color_mask & 7 && s->views[in->view].target == 0 &&
	       !drawn_in_parallel(&s->views[in->view]) && mesh->kind == SCENE_TRIANGLES &&
	       mesh->primitive_count <= MOST_TRIANGLES && modelview_kind_of(in->modelview) == MODELVIEW_PLAIN;
}

void floors_add(struct floors *f, const struct scene *scene, const struct motion *motion, const struct tricks *tricks)
{
	f->frames++;
	for (uint32_t i = 0; i < scene->n_instances; i++) {
		const struct scene_instance *in = &scene->instances[i];
		struct floor_texture *texture;
		double plane[4], share;

		if (!may_be_floor(scene, in) || !find_plane(scene, in, plane, &share) || !(share > 0))
			continue;
		texture = find_texture(f, scene->textures[scene->units[scene->materials[in->material].unit_first].texture]);
		if (!texture)
			continue;
		into_world(motion, plane);
		texture->draws++;
		texture->shadowed += (unsigned)has_shadow(tricks, plane);
		texture->share += fmin(1, share);
	}
}

static int is_polished(const struct floors *f, const struct floor_texture *t)
{
	return t->shadowed >= LEAST_SHADOWED * t->draws && t->share >= LEAST_SHARE * f->frames &&
	       t->even >= LEAST_EVEN && t->shown <= DARKEST;
}

void floors_find(const struct floors *f, struct findings *out)
{
	for (unsigned i = 0; i < f->n; i++) {
		const struct floor_texture *t = &f->textures[i];
		struct finding *rule;

		if (!is_polished(f, t))
			continue;
		rule = findings_add(out, FINDINGS_SURFACES, "polished floor");
		FINDING_SET(rule, FINDING_NUMBER("confidence", 1, 0.5));
		finding_say(rule, "shadows fall on it in %u of %u draws; it is dark, and %.0f %% of its texels are as "
		            "their neighbours", t->shadowed, t->draws, 100 * t->even);
		FINDING_MATCH(rule, FINDING_HASHED("texture", t->hash), FINDING_IS("lit", 0), FINDING_IS("parallel", 0),
		              FINDING_NAMED("modelview", "plain"));
		FINDING_SET(rule, FINDING_NUMBER("reflect", 6, MIRRORED), FINDING_IS("near", 1));
	}
}
