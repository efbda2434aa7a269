#include "look/study/roles/laid.h"

#include <math.h>
#include <stdlib.h>

#include "base/err.h"
#include "gl_tokens.h"
#include "look/draws/drawn.h"
#include "look/draws/matrix.h"
#include "look/draws/modelview.h"
#include "look/draws/solid.h"
#include "look/study/motion/box.h"
#include "look/study/motion/face.h"

/* At most PLACES places of a draw are sampled; this share of them must lie on something. */
enum { PLACES = 8, MOST_TRIANGLES = 8192 };
#define MOST 0.75
/* The greatest height above the surface below, relative to the draw's size and to its distance. */
#define OFF_SIZE 0.1
#define OFF_DISTANCE 1e-4
/* Level: normals within 15 degrees. */
#define LEVEL 0.966
/* An object and its shadow differ in size by at most this factor. */
#define ALIKE 4
/* Two draws are at the same place if their middles and sizes differ by less than this share of their size. */
#define SAME 1e-3
/* Black, up to the rounding of 8-bit texels. */
#define BLACK 0.1f
#define BLACK_TEXEL 26

struct ball {
	double middle[3], radius;
};

static struct ball ball_of(const struct scene *s, const struct scene_instance *in)
{
	double eye[16];
	struct ball ball;
	struct box box;

	matrix_from_floats(eye, in->modelview);
	box = box_of(s->meshes[in->mesh], eye);
	ball.radius = 0.5 * box_measure(&box, ball.middle);
	return ball;
}

int laid_may_be(const struct scene *s, uint32_t instance)
{
	const struct scene_instance *in = &s->instances[instance];
	const struct scene_material *m = &s->materials[in->material];
	const struct scene_mesh *mesh = s->meshes[in->mesh];
	const int is_offset = m->polygon_offset & 4 && (m->polygon_offset_factor < 0 || m->polygon_offset_units < 0);

	return mesh->kind == SCENE_TRIANGLES && mesh->primitive_count && mesh->primitive_count <= MOST_TRIANGLES &&
	       !in->rectangle && s->views[in->view].target == 0 && !drawn_in_parallel(&s->views[in->view]) &&
	       m->color_mask & 7 && (!m->depth_test || !m->depth_write || is_offset) &&
	       modelview_kind_of(in->modelview) == MODELVIEW_PLAIN;
}

/* --- Surfaces below ---------------------------------------------------------------------------------------------- */

/* 1 if a point with a normal lies on a face. */
static int lies_on(const struct face *f, const double at[3], const double normal[3], double off)
{
	double from[3];

	for (int k = 0; k < 3; k++)
		from[k] = at[k] - f->corner[0][k];
	if (fabs(matrix_dot3(from, f->normal)) > off || fabs(matrix_dot3(normal, f->normal)) < LEVEL)
		return 0;
	for (int c = 0; c < 3; c++) {
		const double *a = f->corner[c], *b = f->corner[(c + 1) % 3];
		double out[3];

		for (int k = 0; k < 3; k++)
			out[k] = (b[(k + 1) % 3] - a[(k + 1) % 3]) * f->normal[(k + 2) % 3] -
			         (b[(k + 2) % 3] - a[(k + 2) % 3]) * f->normal[(k + 1) % 3];
		for (int k = 0; k < 3; k++)
			from[k] = at[k] - a[k];
		if (matrix_dot3(from, out) > off * sqrt(matrix_dot3(out, out)))
			return 0;
	}
	return 1;
}

/* The surface that an instance lies on. */
struct ground {
	double normal[3]; /* towards the viewer */
	double radius;    /* radius of the largest object below */
	uint32_t instance; /* SCENE_NONE: there is none */
};

/* 1 if a place of a draw lies on an instance. @param normal  receives the normal of the face below */
static int has_below(const struct scene *s, const struct scene_instance *below, const struct face *place, double off,
                     double normal[3])
{
	const struct scene_mesh *mesh = s->meshes[below->mesh];
	double eye[16], at[3];

	matrix_from_floats(eye, below->modelview);
	for (int k = 0; k < 3; k++)
		at[k] = (place->corner[0][k] + place->corner[1][k] + place->corner[2][k]) / 3;
	for (uint32_t p = 0; p < mesh->primitive_count; p++) {
		struct face face;

		if (!face_of(mesh, eye, p, &face) ||
		    !lies_on(&face, at, place->normal, off + OFF_DISTANCE * sqrt(matrix_dot3(at, at))))
			continue;
		for (int k = 0; k < 3; k++)
			normal[k] = matrix_dot3(face.normal, at) > 0 ? -face.normal[k] : face.normal[k];
		return 1;
	}
	return 0;
}

static double apart(const struct ball *a, const struct ball *b)
{
	double off[3] = { a->middle[0] - b->middle[0], a->middle[1] - b->middle[1], a->middle[2] - b->middle[2] };

	return sqrt(matrix_dot3(off, off));
}

/* 1 if the middle of a face is in the window. */
static int is_in_sight(const double clip[16], const struct face *f)
{
	double at[4] = { 0, 0, 0, 1 }, out[4];

	for (int k = 0; k < 3; k++)
		at[k] = (f->corner[0][k] + f->corner[1][k] + f->corner[2][k]) / 3;
	matrix_transform(out, clip, at);
	return fabs(out[0]) <= out[3] && fabs(out[1]) <= out[3] && fabs(out[2]) <= out[3];
}

/* Sample some of a draw's visible faces, evenly spread. @return how many */
static unsigned find_places(const struct scene *s, const struct scene_instance *in, struct face out[PLACES])
{
	const struct scene_mesh *mesh = s->meshes[in->mesh];
	double eye[16], projection[16];
	uint32_t seen = 0, stride = 1;
	unsigned n = 0;

	matrix_from_floats(eye, in->modelview);
	matrix_from_floats(projection, s->views[in->view].projection);
	for (int pass = 0; pass < 2; pass++) {
		if (pass)
			stride = (seen + PLACES - 1) / PLACES;
		seen = 0;
		for (uint32_t p = 0; p < mesh->primitive_count; p++) {
			struct face face;

			if (!face_of(mesh, eye, p, &face) || !is_in_sight(projection, &face))
				continue;
			if (pass && seen % stride == 0 && n < PLACES)
				out[n++] = face;
			seen++;
		}
	}
	return n;
}

/* Find the solid objects drawn earlier that a draw lies on. @return 0: the draw is out of sight */
static int find_ground(const struct scene *s, const struct ball *balls, uint32_t instance, struct ground *ground)
{
	const struct scene_instance *in = &s->instances[instance];
	const struct ball *ball = &balls[instance];
	struct face places[PLACES];
	const unsigned n = find_places(s, in, places);
	unsigned found = 0;

	*ground = (struct ground){ .instance = SCENE_NONE };
	for (unsigned p = 0; p < n; p++) {
		int lies = 0;

		for (uint32_t i = instance; i-- > 0 && !lies;) {
			const struct scene_instance *below = &s->instances[i];

			if (apart(ball, &balls[i]) > ball->radius + balls[i].radius || !solid_is(s, below) ||
			    s->views[below->view].space != s->views[in->view].space ||
			    s->meshes[below->mesh]->primitive_count > MOST_TRIANGLES)
				continue;
			lies = has_below(s, below, &places[p], OFF_SIZE * ball->radius, ground->normal);
			if (lies && balls[i].radius > ground->radius) {
				ground->radius = balls[i].radius;
				ground->instance = i;
			}
		}
		found += (unsigned)lies;
	}
	if (found < MOST * n)
		ground->instance = SCENE_NONE;
	return n > 0;
}

/* --- Effect on colour -------------------------------------------------------------------------------------------- */

static int has_black_texels(const struct scene_texture *t)
{
	if (t->floats || !t->texels)
		return 0;
	for (size_t i = 0; i < (size_t)t->width * t->height; i++)
		for (int c = 0; c < 3; c++)
			if (t->texels[4 * i + (size_t)c] > BLACK_TEXEL && t->texels[4 * i + 3] > 0)
				return 0;
	return 1;
}

/* 1 if a texture is white along its edge, so that multiplying by it changes nothing there. Lightmaps have no such
 * edge. */
static int has_white_edge(const struct scene_texture *t)
{
	if (t->floats || !t->texels || t->border)
		return 0;
	for (uint32_t y = 0; y < t->height; y++)
		for (uint32_t x = 0; x < t->width; x += y == 0 || y + 1 == t->height || t->width < 2 ? 1 : t->width - 1)
			for (int c = 0; c < 3; c++)
				if (t->texels[4 * ((size_t)y * t->width + x) + (size_t)c] < 255 - BLACK_TEXEL)
					return 0;
	return 1;
}

static int has_black_vertices(const struct scene *s, const struct scene_instance *in)
{
	const struct scene_mesh *mesh = s->meshes[in->mesh];
	const float *own = s->currents[in->current].color;

	for (uint32_t v = 0; v < (mesh->color ? mesh->vertex_count : 1); v++) {
		const float *c = mesh->color ? mesh->color + 4 * (size_t)v : own;

		if (c[0] > BLACK || c[1] > BLACK || c[2] > BLACK)
			return 0;
	}
	return 1;
}

/* 1 if everything that a draw adds is black. */
static int is_black(const struct scene *s, const struct scene_instance *in)
{
	const struct scene_material *m = &s->materials[in->material];
	const struct scene_unit *unit = m->unit_count == 1 ? &s->units[m->unit_first] : NULL;

	if (m->lighting || m->unit_count > 1 || m->color_sum)
		return 0;
	if (!unit)
		return has_black_vertices(s, in);
	if (unit->env_mode == GL_REPLACE)
		return has_black_texels(s->textures[unit->texture]);
	return unit->env_mode == GL_MODULATE && (has_black_vertices(s, in) || has_black_texels(s->textures[unit->texture]));
}

/* 1 if a draw brightens nothing. */
static int darkens(const struct scene *s, const struct scene_instance *in)
{
	const struct scene_material *m = &s->materials[in->material];

	if (!m->blend || m->blend_equation_rgb != GL_FUNC_ADD)
		return 0;
	if (drawn_multiplies(m) && m->unit_count)
		return has_white_edge(s->textures[s->units[m->unit_first + m->unit_count - 1].texture]);
	if (m->blend_src_rgb == GL_ZERO)
		return m->blend_dst_rgb == GL_ONE_MINUS_SRC_ALPHA || m->blend_dst_rgb == GL_SRC_ALPHA ||
		       m->blend_dst_rgb == GL_SRC_COLOR || m->blend_dst_rgb == GL_ONE_MINUS_SRC_COLOR;
	return drawn_multiplies(m) || (m->blend_dst_rgb == GL_ONE_MINUS_SRC_ALPHA && is_black(s, in));
}

/* 1 if the sizes of two balls are similar. */
static int is_alike(const struct ball *a, const struct ball *b)
{
	return a->radius < ALIKE * b->radius && b->radius < ALIKE * a->radius;
}

/* 1 if something solid of similar size rests on a draw. */
static int has_thing(const struct scene *s, const struct ball *balls, uint32_t instance, const struct ground *ground)
{
	const struct ball *ball = &balls[instance];

	for (uint32_t i = 0; i < s->n_instances; i++) {
		const struct scene_instance *in = &s->instances[i];
		const struct ball *thing = &balls[i];
		double off[3], height, aside;

		if (!is_alike(thing, ball) || i == instance || i == ground->instance || !solid_is(s, in) ||
		    s->views[in->view].space != s->views[s->instances[instance].view].space ||
		    modelview_kind_of(in->modelview) != MODELVIEW_PLAIN)
			continue;
		for (int k = 0; k < 3; k++)
			off[k] = thing->middle[k] - ball->middle[k];
		height = matrix_dot3(off, ground->normal);
		aside = sqrt(fmax(0, matrix_dot3(off, off) - height * height));
		if (height > 0.1 * thing->radius && aside < thing->radius + ball->radius)
			return 1;
	}
	return 0;
}

/* 1 if a draw has the same points as an earlier one and adds to its colour: another pass of the same surface. A draw
 * that covers the earlier one is a picture. */
static int is_pass(const struct scene *s, const struct ball *balls, uint32_t instance)
{
	const struct scene_instance *in = &s->instances[instance];
	const struct scene_material *m = &s->materials[in->material];

	if (m->alpha_test || (m->blend && m->blend_src_rgb == GL_SRC_ALPHA && m->blend_dst_rgb == GL_ONE_MINUS_SRC_ALPHA))
		return 0;
	for (uint32_t i = 0; i < instance; i++)
		if (s->meshes[s->instances[i].mesh]->primitive_count == s->meshes[in->mesh]->primitive_count &&
		    apart(&balls[i], &balls[instance]) < SAME * balls[instance].radius &&
		    fabs(balls[i].radius - balls[instance].radius) < SAME * balls[instance].radius)
			return 1;
	return 0;
}

static enum laid find_one(const struct scene *s, const struct ball *balls, uint32_t instance)
{
	const struct scene_material *m = &s->materials[s->instances[instance].material], *below;
	struct ground ground;

	if (!find_ground(s, balls, instance, &ground))
		return LAID_UNKNOWN;
	if (ground.instance == SCENE_NONE || is_pass(s, balls, instance))
		return LAID_NOT;
	if (!darkens(s, &s->instances[instance]) || !has_thing(s, balls, instance, &ground))
		return drawn_multiplies(m) ? LAID_NOT : LAID_DECAL; /* lightmaps multiply too */
	below = &s->materials[s->instances[ground.instance].material];
	return below->lighting && below->light_count ? LAID_LIT_SHADOW : LAID_SHADOW;
}

int laid_find(const struct scene *s, uint8_t *out)
{
	struct ball *balls = NULL;

	for (uint32_t i = 0; i < s->n_instances; i++) {
		if (out[i] == LAID_NOT)
			continue;
		if (!balls) {
			balls = malloc(s->n_instances * sizeof(*balls));
			if (!balls)
				return err_report(ERR_SYSTEM, NULL, "out of memory");
			for (uint32_t k = 0; k < s->n_instances; k++)
				balls[k] = ball_of(s, &s->instances[k]);
		}
		out[i] = (uint8_t)find_one(s, balls, i);
	}
	free(balls);
	return 0;
}
