#include "look/study/light/lamps.h"

#include <math.h>
#include <string.h>

#include "gl_tokens.h"
#include "look/draws/matrix.h"
#include "look/draws/solid.h"
#include "look/study/roles/layer.h"

/* Texels are bright by their luma, and coloured if their largest component exceeds the smallest by this share. At
 * most MOST_TEXELS of a lamp's texels are both. */
#define BRIGHT 0.75
#define COLOURED 0.2
#define MOST_TEXELS 0.5
/* A lamp's box is at most this large, relative to the largest object's. */
#define SMALL 0.1
/* The brightness at the lamp, and the distance where it halves, in sizes of the lamp. */
#define STRENGTH 0.8
#define REACH 6

static void find_color(const struct scene_texture *t, double out[3])
{
	double n = 0, sum[3] = { 0, 0, 0 };

	for (size_t i = 0; i < (size_t)t->width * t->height && !t->floats && t->target == GL_TEXTURE_2D; i++) {
		const uint8_t *c = t->texels + 4 * i;
		const double luma = (0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2]) / 255,
			     most = fmax(c[0], fmax(c[1], c[2])), least = fmin(c[0], fmin(c[1], c[2]));

		if (luma < BRIGHT || most - least < COLOURED * most)
			continue;
		n++;
		for (int k = 0; k < 3; k++)
			sum[k] += c[k] / 255.0;
	}
	for (int k = 0; k < 3; k++)
		out[k] = n >= MOST_TEXELS * t->width * t->height ? sum[k] / n : 0;
}

/* The mean colour of a texture's bright texels; NULL: it has too few, or there are too many textures. */
static const double *color_of(struct lamps *l, const struct scene_texture *t)
{
	unsigned i = 0;

	while (i < l->n_textures && memcmp(l->textures[i].texture, t->hash, sizeof(t->hash)) != 0)
		i++;
	if (i == LAMPS_SEEN)
		return NULL;
	if (i == l->n_textures) {
		memcpy(l->textures[i].texture, t->hash, sizeof(t->hash));
		find_color(t, l->textures[i].color);
		l->n_textures++;
	}
	return l->textures[i].color[0] + l->textures[i].color[1] > 0 ? l->textures[i].color : NULL;
}

static double size_of(const struct motion *m, const struct scene *s, uint32_t i)
{
	double eye[16];

	if (m->of_instance[i] == SCENE_NONE)
		return 0;
	matrix_from_floats(eye, s->instances[i].modelview);
	return 0.5 * m->things[m->of_instance[i]].size * matrix_scale(eye);
}

static void note(struct lamps *l, const struct motion *m, const struct scene *s, uint32_t instance,
                 const double color[3])
{
	const uint32_t thing = m->of_instance[instance];
	unsigned i = 0;

	while (i < l->n && l->list[i].thing != thing)
		i++;
	if (i == LAMPS_SEEN)
		return;
	l->n += i == l->n;
	l->list[i].thing = thing;
	l->list[i].draws++;
	l->list[i].size = size_of(m, s, instance);
	memcpy(l->list[i].color, color, sizeof(l->list[i].color));
	memcpy(l->list[i].mesh, s->meshes[s->instances[instance].mesh]->hash, sizeof(l->list[i].mesh));
	matrix_point(l->list[i].at, m->things[thing].world, m->things[thing].middle);
}

void lamps_add(struct lamps *l, const struct scene *s, const struct motion *m, const uint8_t *layers)
{
	double largest = 0;

	for (uint32_t i = 0; i < s->n_instances; i++)
		if (layers[i] == LAYER_WORLD && solid_is(s, &s->instances[i]))
			largest = fmax(largest, size_of(m, s, i));
	for (uint32_t i = 0; i < s->n_instances; i++) {
		const struct scene_instance *in = &s->instances[i];
		const struct scene_material *material = &s->materials[in->material];
		const struct scene_unit *u = material->unit_count == 1 ? &s->units[material->unit_first] : NULL;
		const double *color;

		if (layers[i] != LAYER_WORLD || !u || !solid_is(s, in) || material->lighting || material->blend ||
		    material->alpha_test || s->meshes[in->mesh]->color || s->views[in->view].projection[11] == 0 ||
		    m->of_instance[i] == SCENE_NONE || size_of(m, s, i) > SMALL * largest)
			continue;
		color = color_of(l, s->textures[u->texture]);
		if (color)
			note(l, m, s, i, color);
	}
}

/* 1 if every frame that draws a lamp shows it as one, and it stands still. */
static int is_lamp(const struct lamp *lamp, const struct motion *m)
{
	return motion_is_static(&m->things[lamp->thing]) && lamp->draws == m->things[lamp->thing].frames;
}

unsigned lamps_count(const struct lamps *l, const struct motion *m)
{
	unsigned n = 0;

	for (unsigned i = 0; i < l->n; i++)
		n += (unsigned)is_lamp(&l->list[i], m);
	return n;
}

void lamps_find_surfaces(const struct lamps *l, const struct motion *m, struct findings *out)
{
	for (unsigned i = 0; i < l->n; i++) {
		const struct lamp *lamp = &l->list[i];
		struct finding *rule;

		if (!is_lamp(lamp, m))
			continue;
		rule = findings_add(out, FINDINGS_SURFACES, "lamp");
		finding_explain(rule, 0.8 * (1 - 0.5 / (1 + lamp->draws)), "small, lit by nothing, and bright in %u frames",
		                lamp->draws);
		FINDING_MATCH(rule, FINDING_HASHED("mesh", lamp->mesh), FINDING_IS("lit", 0));
		FINDING_SET(rule, FINDING_IS("shadows", 0), FINDING_IS("dome", 0), FINDING_IS("lit", 0));
	}
}

void lamps_find_lights(const struct lamps *l, const struct motion *m, struct findings *out)
{
	unsigned n = 0;

	for (unsigned i = 0; i < l->n && n < LAMPS_MOST; i++) {
		const struct lamp *lamp = &l->list[i];
		unsigned larger = 0;
		struct finding *rule;

		for (unsigned k = 0; k < l->n; k++)
			larger += is_lamp(&l->list[k], m) && (l->list[k].size > lamp->size || (l->list[k].size == lamp->size && k < i));
		if (!is_lamp(lamp, m) || larger >= LAMPS_MOST)
			continue;
		n++;
		rule = findings_add(out, FINDINGS_LIGHTS, "light of a lamp");
		finding_explain(rule, 0.5, "bright texels shine; how strongly, nothing says");
		FINDING_SET(rule, FINDING_NAMED("on", "unlit"), FINDING_NAMED("space", "world"),
		            FINDING_PLACE("position", 6, lamp->at, 1),
		            FINDING_VECTOR("diffuse", -3, STRENGTH * lamp->color[0], STRENGTH * lamp->color[1],
		                           STRENGTH * lamp->color[2]),
		            FINDING_VECTOR("specular", 1, 0, 0, 0),
		            FINDING_VECTOR("attenuation", 4, 1, 0, 1 / (REACH * REACH * lamp->size * lamp->size)),
		            FINDING_NUMBER("radius", 4, 0.5 * lamp->size));
	}
}
