#include "look/spare/cards.h"

#include <math.h>
#include <stdlib.h>

#include "base/err.h"
#include "base/mat4.h"

/* The cards of a tree are drawn one after another: each is compared with this many before it. */
#define NEIGHBOURS 4u
#define MOST_TRIANGLES 16384u /* in a mesh; larger meshes are no cards */

/* A flat cut-out in eye space. */
struct card {
	float middle[3], normal[3], size; /* size: its longest edge */
	uint32_t instance;
	int crosses;
};

static int may_be_cards(const struct scene *s, const struct scene_instance *in)
{
	const struct scene_material *m = &s->materials[in->material];
	const struct scene_mesh *mesh = s->meshes[in->mesh];

	return mesh->kind == SCENE_TRIANGLES && mesh->primitive_count >= 2 && mesh->primitive_count % 2 == 0 &&
	       mesh->primitive_count <= MOST_TRIANGLES && m->lighting && m->depth_test && m->unit_count &&
	       (m->alpha_test || m->blend) && s->views[in->view].target == 0;
}

/* Two consecutive triangles that form a parallelogram. @return 0: they do not */
static int card_of(const struct scene *s, uint32_t instance, uint32_t first, struct card *out)
{
	const struct scene_instance *in = &s->instances[instance];
	const struct scene_mesh *mesh = s->meshes[in->mesh];
	float corner[6][4], low[3], high[3], normal[2][3], length[2] = { 0, 0 }, along = 0;

	for (unsigned c = 0; c < 6; c++)
		mat4_transform(corner[c], in->modelview, mesh->position + 4 * (size_t)mesh->index[3 * (size_t)first + c]);
	for (int half = 0; half < 2; half++)
		for (int k = 0; k < 3; k++) {
			const float *a = corner[3 * half], *b = corner[3 * half + 1], *c = corner[3 * half + 2];
			int i = (k + 1) % 3, j = (k + 2) % 3;

			normal[half][k] = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
			length[half] += normal[half][k] * normal[half][k];
		}
	*out = (struct card){ .instance = instance };
	for (int k = 0; k < 3; k++) {
		low[k] = high[k] = corner[0][k];
		for (int c = 1; c < 6; c++) {
			low[k] = fminf(low[k], corner[c][k]);
			high[k] = fmaxf(high[k], corner[c][k]);
		}
		out->middle[k] = 0.5f * (low[k] + high[k]);
		out->size += (high[k] - low[k]) * (high[k] - low[k]);
		out->normal[k] = normal[0][k] / sqrtf(length[0]);
		along += normal[0][k] * normal[1][k];
	}
	out->size = sqrtf(out->size);
	return length[0] > 0 && length[1] > 0.5f * length[0] && length[1] < 2 * length[0] &&
	       fabsf(along) > 0.999f * sqrtf(length[0] * length[1]);
}

/* 1 if two cards share a centre and are at least 20 degrees apart. */
static int do_cross(const struct card *a, const struct card *b)
{
	float apart = 0, cosine = 0;

	for (int k = 0; k < 3; k++) {
		apart += (a->middle[k] - b->middle[k]) * (a->middle[k] - b->middle[k]);
		cosine += a->normal[k] * b->normal[k];
	}
	return sqrtf(apart) < 0.15f * fminf(a->size, b->size) && fabsf(cosine) < 0.94f && a->size < 2 * b->size &&
	       b->size < 2 * a->size;
}

static void compare(struct card *cards, size_t n)
{
	for (size_t i = 0; i < n; i++)
		for (size_t k = i < NEIGHBOURS ? 0 : i - NEIGHBOURS; k < i; k++)
			if (do_cross(&cards[i], &cards[k]))
				cards[i].crosses = cards[k].crosses = 1;
}

int cards_find(const struct scene *scene, uint32_t bit, uint32_t *bits, uint32_t *count)
{
	size_t most = 0, n = 0;
	struct card *cards;

	for (uint32_t i = 0; i < scene->n_instances; i++)
		most += may_be_cards(scene, &scene->instances[i]) ? scene->meshes[scene->instances[i].mesh]->primitive_count / 2 : 0;
	*count = 0;
	if (!most)
		return 0;
	cards = malloc(most * sizeof(*cards));
	if (!cards)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t i = 0; i < scene->n_instances; i++)
		for (uint32_t p = 0; may_be_cards(scene, &scene->instances[i]) &&
		                     p < scene->meshes[scene->instances[i].mesh]->primitive_count;
		     p += 2)
			n += (size_t)card_of(scene, i, p, &cards[n]);
	compare(cards, n);
	for (size_t first = 0, end; first < n; first = end) {
		const uint32_t instance = cards[first].instance;
		uint32_t crossed = 0;

		for (end = first; end < n && cards[end].instance == instance; end++)
			crossed += (uint32_t)cards[end].crosses;
		if (4 * crossed < scene->meshes[scene->instances[instance].mesh]->primitive_count)
			continue;
		bits[instance] |= bit;
		++*count;
	}
	free(cards);
	return 0;
}
