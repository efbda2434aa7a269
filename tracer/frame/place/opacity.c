#include "tracer/frame/place/opacity.h"

#include <stdlib.h>

#include "base/err.h"
#include "base/hash.h"
#include "kernels/frame/light/transparency.h"
#include "kernels/rays/opacity.h"
#include "tracer/frame/hook/hook_objects.h"
#include "tracer/frame/place/opacity_cells.h"
#include "tracer/frame/place/opacity_sides.h"
#include "tracer/frame/place/opacity_words.h"

/* An instance that has words. */
struct source {
	struct opacity_surface surface;
	uint32_t turn; /* opacity_turn_of */
	struct instance *instance;
	struct opacity_blocks *blocks; /* [n_textures]; made when they are first needed */
};

int opacity_is_known(const struct frame *frame, const struct accel_space *space)
{
	return frame_in_packets(frame) && !hook_objects_in(frame, space);
}

/* The opacity of a whole instance, as transparency_of_hit finds it. */
static uint32_t opacity_of(const struct instance *instance, const struct scene_material *m)
{
	struct scene_material rest = *m;

	if (instance->flags & (INSTANCE_PASS_COUNTER | INSTANCE_PASS_CLOCKWISE)) /* the kernels know its sides */
		rest.surface.hidden &= ~SCENE_ONE_SIDED;
	if (transparency_is_none(&rest))
		return OPACITY_STOPS;
	if (m->surface.hidden & (SCENE_HIDDEN_FROM_LIGHTS | SCENE_FILM))
		return OPACITY_PASSES;
	if (m->blend && !m->depth_write && !(m->surface.transmit > 0) && !(m->surface.hidden & SCENE_SOLID))
		return OPACITY_PASSES;
	return OPACITY_ASK;
}

/* 1 if only alpha, and the side that a ray meets, decide what an instance's triangles let pass. */
static int has_words(const struct scene *scene, const struct instance *instance)
{
	const struct scene_instance *from = &scene->instances[instance->scene_instance];
	const struct scene_material *m = &scene->materials[from->material];

	return instance->flags & INSTANCE_SECONDARY && !(instance->flags & (INSTANCE_BAKED | INSTANCE_SCREEN)) &&
	       !(m->surface.transmit > 0) && !m->clip_plane_mask && m->polygon_stipple == SCENE_NONE && !m->unclamped &&
	       !m->floats && !m->program && scene->meshes[from->mesh]->kind == SCENE_TRIANGLES;
}

/* --- Words ------------------------------------------------------------------------------------------------------- */

/* A surface with the bounds of its texels, which are found once a frame. */
static struct opacity_surface with_blocks(const struct source *from)
{
	struct opacity_surface s = from->surface;
	const uint32_t texture = s.unit == SCENE_NONE ? SCENE_NONE : s.scene->units[s.unit].texture;

	if (texture == SCENE_NONE)
		return s;
	s.blocks = &from->blocks[texture];
	if (!s.blocks->alpha)
		opacity_blocks_make(s.scene->textures[texture], &from->blocks[texture]);
	return s;
}

static void fill_words(const void *object, uint32_t *words)
{
	const struct source *from = object;
	const struct opacity_surface s = with_blocks(from);

	opacity_words_fill(&s, from->turn, words);
}

/* Name an instance's words by all that they depend on. */
static void name_words(const struct source *from, XXH3_state_t *state, uint64_t hash[2])
{
	const struct opacity_surface *s = &from->surface;
	const struct scene_material *m = s->material;
	const float numbers[] = { m->front.diffuse[3], m->back.diffuse[3], m->alpha_ref, s->current->color[3],
		                  s->current->normal[0], s->current->normal[1], s->current->normal[2] };
	const uint32_t words[] = { from->turn, m->lighting, m->two_side, m->color_material, m->color_material_mode,
		                   m->normalize, m->cull_face, m->front_face, m->alpha_test, m->alpha_func, m->blend,
		                   m->blend_equation_rgb, m->blend_src_rgb, m->blend_dst_rgb, m->depth_write,
		                   m->surface.hidden, m->unit_count };
	XXH128_hash_t name;

	XXH3_128bits_reset(state);
	XXH3_128bits_update(state, s->mesh->hash, sizeof(s->mesh->hash));
	XXH3_128bits_update(state, numbers, sizeof(numbers));
	XXH3_128bits_update(state, words, sizeof(words));
	for (uint32_t i = 0; i < m->unit_count; i++) {
		struct scene_unit unit = s->scene->units[m->unit_first + i];
		const struct scene_texture *texture = s->scene->textures[unit.texture];

		XXH3_128bits_update(state, texture->hash, sizeof(texture->hash));
		XXH3_128bits_update(state, s->current->texcoord[unit.unit], sizeof(s->current->texcoord[unit.unit]));
		unit.texture = 0; /* its place in this scene */
		XXH3_128bits_update(state, &unit, sizeof(unit));
	}
	name = XXH3_128bits_digest(state);
	hash[0] = name.low64;
	hash[1] = name.high64;
}

/* --- A frame ----------------------------------------------------------------------------------------------------- */

static int compare_names(const void *a, const void *b)
{
	const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;

	return (x > y) - (x < y);
}

/*
 * Keep the items whose words may be used again, in front. Surfaces that change from frame to frame are sampled, as
 * their words would cost more: words are made for the surfaces of a tracer's first frame, and of two in a row.
 * @return their number
 */
static size_t choose_items(struct opacity_met *met, struct pool_item *items, size_t n)
{
	uint64_t *names = malloc((n + 1) * sizeof(*names));
	size_t chosen = 0;

	for (size_t i = 0; i < n; i++) {
		const uint64_t name = items[i].hash[0];

		if (names)
			names[i] = name;
		if (!met->is_used || bsearch(&name, met->names, met->n, sizeof(name), compare_names))
			items[chosen++] = items[i];
	}
	free(met->names);
	*met = (struct opacity_met){ names, names ? n : 0, 1 };
	if (names)
		qsort(names, n, sizeof(*names), compare_names);
	return chosen;
}

/* Give words to instances whose surfaces have to be sampled, as far as something is known of them. */
static int place_words(struct frame *frame, struct source *sources, uint32_t n, struct opacity_blocks *blocks)
{
	struct pool_item *items = calloc(n + (size_t)1, sizeof(*items));
	XXH3_state_t *state = XXH3_createState();
	int err = 0;

	if (!items || !state)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t i = 0; i < n && !err; i++) {
		sources[i].blocks = blocks;
		items[i] = (struct pool_item){ { 0, 0 }, opacity_words_count(&sources[i].surface), &sources[i], 0 };
		name_words(&sources[i], state, items[i].hash);
	}
	if (!err)
		n = (uint32_t)choose_items(&frame->tr->opacity_met, items, n);
	if (!err)
		err = pool_place(&frame->tr->opacity, frame->tr->dev, items, n, fill_words);
	for (uint32_t i = 0; i < n && !err; i++)
		((const struct source *)items[i].object)->instance->opacity = OPACITY_WORDS + items[i].place;
	XXH3_freeState(state);
	free(items);
	return err;
}

int opacity_place(struct frame *frame)
{
	const struct scene *scene = frame->scene;
	const struct prepared *p = &frame->prepared;
	struct tracer *tr = frame->tr;
	struct opacity_blocks *blocks;
	struct source *sources;
	uint32_t n = 0;
	int err = 0;

	if (!p->has_transparency)
		return 0; /* all have OPACITY_STOPS */
	blocks = calloc(scene->n_textures + (size_t)1, sizeof(*blocks));
	sources = calloc(p->n_instances + (size_t)1, sizeof(*sources));
	if (!blocks || !sources)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t i = 0; i < p->n_instances && !err; i++) {
		struct instance *instance = &p->instances[i];
		const struct scene_instance *from = &scene->instances[instance->scene_instance];
		const struct scene_material *m = &scene->materials[from->material];

		instance->opacity = opacity_of(instance, m);
		if (instance->opacity == OPACITY_ASK && has_words(scene, instance))
			sources[n++] = (struct source){
				.surface = { scene, scene->meshes[from->mesh], m, &scene->currents[from->current], opacity_unit(scene, m),
				             NULL },
				.turn = opacity_turn_of(instance),
				.instance = instance,
			};
	}
	if (n && frame_in_packets(frame) && !err)
		err = place_words(frame, sources, n, blocks);
	tr->trees.opacity = tr->opacity.words;
	for (uint32_t i = 0; i < scene->n_textures && blocks; i++)
		opacity_blocks_free(&blocks[i]);
	free(blocks);
	free(sources);
	return err;
}
