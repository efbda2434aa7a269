#include "look/study/tricks/cast.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "look/draws/drawn.h"
#include "look/draws/matrix.h"
#include "look/draws/solid.h"
#include "look/study/motion/box.h"

/* A shadow texture keeps at least NEUTRAL of the light along its edge and at most DARK in its middle. */
#define NEUTRAL 0.95
#define DARK 0.75
/* The object is this near to the texture's middle, as a share of the texture's size. */
#define MIDDLE 0.1
#define SAME 1e-4f

/* --- Effect of a unit -------------------------------------------------------------------------------------------- */

/* The share of light that a texel leaves; 2: the unit does something else. */
static double factor_of(const struct scene_unit *u, const uint8_t *texel)
{
	uint32_t operand = GL_SRC_COLOR;

	if (u->env_mode == GL_COMBINE) {
		const int at = u->source_rgb[0] == GL_TEXTURE ? 0 : 1;

		if (u->combine_rgb != GL_MODULATE || u->source_rgb[at] != GL_TEXTURE ||
		    u->operand_rgb[1 - at] != GL_SRC_COLOR || u->scale_rgb != 1 ||
		    (u->source_rgb[1 - at] != GL_PREVIOUS && u->source_rgb[1 - at] != GL_PRIMARY_COLOR))
			return 2;
		operand = u->operand_rgb[at];
	} else if (u->env_mode != GL_MODULATE) {
		return 2;
	}
	if (operand == GL_SRC_ALPHA || operand == GL_ONE_MINUS_SRC_ALPHA)
		return operand == GL_SRC_ALPHA ? texel[3] / 255.0 : 1 - texel[3] / 255.0;
	operand = operand == GL_SRC_COLOR ? 0 : 255;
	return (abs((int)operand - texel[0]) + abs((int)operand - texel[1]) + abs((int)operand - texel[2])) / 765.0;
}

/* 1 if a unit darkens in the middle of its texture and nowhere along the edge, which is extended beyond it. */
static int is_blob(const struct scene *s, const struct scene_unit *u)
{
	const struct scene_texture *t = s->textures[u->texture];
	const uint32_t middle = (t->height / 2) * t->width + t->width / 2;

	if (t->target != GL_TEXTURE_2D || t->floats || t->border || t->width < 4 || t->height < 4 ||
	    u->wrap_s == GL_REPEAT || u->wrap_t == GL_REPEAT || factor_of(u, t->texels + 4 * (size_t)middle) > DARK)
		return 0;
	for (uint32_t y = 0; y < t->height; y++)
		for (uint32_t x = 0; x < t->width; x += y == 0 || y + 1 == t->height ? 1 : t->width - 1) {
			const double factor = factor_of(u, t->texels + 4 * ((size_t)y * t->width + x));

			if (factor < NEUTRAL || factor > 1)
				return 0;
		}
	return 1;
}

/* --- Place of the shadow ----------------------------------------------------------------------------------------- */

/* 1 if a unit's coordinates are the positions of the points. */
static int is_by_place(const struct scene_mesh *mesh, const struct scene_unit *u)
{
	const float *c = mesh->texcoord[u->unit];

	if (u->gen_mode[0] || !c)
		return 0;
	for (uint32_t v = 0; v < mesh->vertex_count; v++)
		for (int k = 0; k < 3; k++)
			if (fabsf(c[4 * (size_t)v + (size_t)k] - mesh->position[4 * (size_t)v + (size_t)k]) >
			    SAME * (1 + fabsf(mesh->position[4 * (size_t)v + (size_t)k])))
				return 0;
	return 1;
}

/* The matrix from eye space to a unit's coordinates, before the unit's own matrix. @return 0: the coordinates do not
 * depend on position */
static int find_coordinates(const struct scene *s, const struct scene_instance *in, const struct scene_unit *u,
                            double out[16])
{
	double eye[16], inverse[16], rows[16];
	const uint32_t mode = u->gen_mode[0];

	matrix_from_floats(eye, in->modelview);
	if (!matrix_invert(inverse, eye))
		return 0;
	if (is_by_place(s->meshes[in->mesh], u)) {
		memcpy(out, inverse, sizeof(inverse));
		return 1;
	}
	if ((mode != GL_OBJECT_LINEAR && mode != GL_EYE_LINEAR) || u->gen_mode[1] != mode)
		return 0;
	for (int r = 0; r < 4; r++)
		for (int c = 0; c < 4; c++)
			rows[4 * c + r] = u->gen_mode[r] != mode     ? (r == 3 && c == 3) :
			                  mode == GL_EYE_LINEAR ? (double)u->gen_eye_plane[r][c] : (double)u->gen_object_plane[r][c];
	if (mode == GL_EYE_LINEAR)
		memcpy(out, rows, sizeof(rows));
	else
		matrix_mul(out, rows, inverse);
	return 1;
}

/* The middle of an instance's box, in eye space. */
static void find_middle(const struct scene *s, const struct scene_instance *in, double out[3])
{
	const struct box box = box_of(s->meshes[in->mesh], matrix_identity);
	double eye[16];

	box_measure(&box, out);
	matrix_from_floats(eye, in->modelview);
	matrix_point(out, eye, (double[3]){ out[0], out[1], out[2] });
}

static int has_texture(const struct scene *s, const struct scene_instance *in, uint32_t texture)
{
	const struct scene_material *m = &s->materials[in->material];

	for (uint32_t i = 0; i < m->unit_count; i++)
		if (s->units[m->unit_first + i].texture == texture)
			return 1;
	return 0;
}

/* 1 if the middle of the cast texture falls on something solid that does not have the texture itself. */
static int has_thing(const struct scene *s, const struct scene_instance *in, const struct scene_unit *u)
{
	double coordinates[16], matrix[16], all[16];

	matrix_from_floats(matrix, u->matrix);
	if (!find_coordinates(s, in, u, coordinates))
		return 0;
	matrix_mul(all, matrix, coordinates);
	for (uint32_t i = 0; i < s->n_instances; i++) {
		const struct scene_instance *thing = &s->instances[i];
		double at[4] = { 0, 0, 0, 1 }, out[4];

		if (!solid_is(s, thing) || has_texture(s, thing, u->texture) ||
		    s->views[thing->view].space != s->views[in->view].space ||
		    drawn_in_parallel(&s->views[thing->view]))
			continue;
		find_middle(s, thing, at);
		matrix_transform(out, all, at);
		if (out[3] > 0 && fabs(out[0] / out[3] - 0.5) < MIDDLE && fabs(out[1] / out[3] - 0.5) < MIDDLE)
			return 1;
	}
	return 0;
}

/* --- Frames ------------------------------------------------------------------------------------------------------ */

static struct cast_texture *entry_of(struct cast *c, const uint64_t hash[2], uint32_t unit, int may_add)
{
	for (unsigned i = 0; i < c->n; i++)
		if (memcmp(c->textures[i].hash, hash, sizeof(c->textures[i].hash)) == 0 && c->textures[i].unit == unit)
			return &c->textures[i];
	if (!may_add || c->n == CAST_MOST)
		return NULL;
	c->textures[c->n] = (struct cast_texture){ .hash = { hash[0], hash[1] }, .unit = unit };
	return &c->textures[c->n++];
}

/* Note one unit of a lit draw. The first draw of a frame that has the texture decides for the frame. */
static void note_unit(struct cast *c, const struct scene *s, const struct scene_instance *in,
                      const struct scene_unit *u)
{
	const uint64_t *hash = s->textures[u->texture]->hash;
	struct cast_texture *t = entry_of(c, hash, u->unit, 0);

	if (t && t->last == c->frames) {
		t->thrown++;
		return;
	}
	if (!is_blob(s, u) || !has_thing(s, in, u)) {
		if (t)
			t->others++;
		return;
	}
	t = entry_of(c, hash, u->unit, 1);
	if (!t)
		return;
	t->last = c->frames;
	t->frames++;
	t->thrown++;
}

void cast_add(struct cast *c, const struct scene *s)
{
	c->frames++;
	for (uint32_t i = 0; i < s->n_instances; i++) {
		const struct scene_instance *in = &s->instances[i];
		const struct scene_material *m = &s->materials[in->material];

		for (uint32_t k = 0; k + 1 < m->unit_count && m->lighting && m->light_count &&
		                     s->meshes[in->mesh]->kind == SCENE_TRIANGLES && !in->rectangle;
		     k++)
			note_unit(c, s, in, &s->units[m->unit_first + k]);
	}
}

void cast_find(const struct cast *c, struct findings *out)
{
	for (unsigned i = 0; i < c->n; i++) {
		const struct cast_texture *t = &c->textures[i];
		struct finding *rule;

		if (t->others > t->thrown)
			continue;
		rule = findings_add(out, FINDINGS_SURFACES, "shadow in a unit");
		finding_explain(rule, t->thrown * (1 - 0.5 / (1 + t->frames)) / (t->thrown + t->others),
		                "%u of %u draws in %u frames: a texture that is dark in its middle falls where a "
		                "thing is, by places alone; traced shadows of OpenGL's lights replace it",
		                t->thrown, t->thrown + t->others, t->frames);
		FINDING_MATCH(rule, FINDING_HASHED("texture", t->hash), FINDING_IS("lit", 1));
		FINDING_SET(rule, FINDING_COUNTED("shadow_unit", t->unit));
	}
}
