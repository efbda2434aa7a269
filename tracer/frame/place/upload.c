#include "tracer/frame/place/upload.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "gl_tokens.h"
#include "tracer/frame/hook/hook_objects.h"

int upload_attributes(struct frame *frame)
{
	const struct scene *scene = frame->scene;
	struct pool_item *items = calloc(scene->n_meshes + (size_t)1, sizeof(*items));
	int err;

	if (!items)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t i = 0; i < scene->n_meshes; i++)
		items[i] = (struct pool_item){ { scene->meshes[i]->hash[0], scene->meshes[i]->hash[1] },
			                       prepare_attribute_words(scene->meshes[i]), scene->meshes[i], 0 };
	err = pool_place(&frame->tr->attributes, frame->tr->dev, items, scene->n_meshes, prepare_fill_attributes);
	for (uint32_t i = 0; i < frame->prepared.n_instances && !err; i++) {
		uint32_t mesh = scene->instances[frame->prepared.instances[i].scene_instance].mesh;

		prepare_layout(scene->meshes[mesh], items[mesh].place, &frame->prepared.geometries[i]);
	}
	free(items);
	return err;
}

/* Uploads the scene's meshes and those of expanded lines and points. */
int upload_indices(struct frame *frame)
{
	const struct scene *scene = frame->scene;
	struct prepared *p = &frame->prepared;
	struct pool_item *items = calloc((size_t)scene->n_meshes + p->n_instances + 2, sizeof(*items));
	size_t n = scene->n_meshes, of_objects;
	int err;

	if (!items)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t i = 0; i < n; i++)
		items[i] = (struct pool_item){ { scene->meshes[i]->hash[0], scene->meshes[i]->hash[1] },
			                       prepare_index_words(scene->meshes[i]), scene->meshes[i], 0 };
	for (uint32_t i = 0; i < p->n_instances; i++)
		if (frame->extra[i])
			items[n++] = (struct pool_item){ { frame->extra[i]->hash[0], frame->extra[i]->hash[1] },
				                         prepare_index_words(frame->extra[i]), frame->extra[i], 0 };
	of_objects = n;
	if (frame->objects.n)
		items[n++] = (struct pool_item){ { frame->objects.mesh.hash[0], frame->objects.mesh.hash[1] },
			                         prepare_index_words(&frame->objects.mesh), &frame->objects.mesh, 0 };
	err = pool_place(&frame->tr->indices, frame->tr->dev, items, n, prepare_fill_indices);
	n = scene->n_meshes;
	for (uint32_t i = 0; i < p->n_instances && !err; i++) {
		uint32_t mesh = scene->instances[p->instances[i].scene_instance].mesh;
		const struct pool_item *item = frame->extra[i] ? &items[n++] : &items[mesh];
		const struct scene_mesh *from = item->object;

		p->geometries[i].index = item->place;
		p->geometries[i].primitive_draw =
			from->primitive_draw ? item->place + from->primitive_count * (uint32_t)from->kind : SCENE_NONE;
	}
	for (uint32_t i = 0; i < frame->objects.n && !err; i++)
		hook_objects_stand(frame, i, items[of_objects].place);
	free(items);
	return err;
}

static void fill_texels(const void *object, uint32_t *words)
{
	const struct scene_texture *texture = object;

	memcpy(words, texture->texels, texture->n_bytes / 4 * 4);
}

static uint32_t level_words(const struct scene_texture *t, uint32_t level)
{
	uint32_t w = t->width >> level ? t->width >> level : 1, h = t->height >> level ? t->height >> level : 1;
	uint32_t d = t->target == GL_TEXTURE_2D_ARRAY ? t->depth : t->depth >> level ? t->depth >> level : 1;

	w += 2 * t->border;
	h = t->target == GL_TEXTURE_1D ? 1 : h + 2 * t->border;
	d = t->target == GL_TEXTURE_3D ? d + 2 * t->border : t->target == GL_TEXTURE_CUBE_MAP ? 6 : d;
	return w * h * d * (t->floats ? 4 : 1);
}

static int describe_texture(const struct scene_texture *t, uint32_t place, struct texture_image *out)
{
	size_t at = 0;

	*out = (struct texture_image){ t->target, t->base_format, t->width, t->height, t->depth, t->n_levels, t->border,
		                       t->floats ? 4 : 1, { 0 } };
	if (out->n_levels > TEXTURE_MAX_LEVELS)
		out->n_levels = TEXTURE_MAX_LEVELS;
	for (uint32_t level = 0; level < out->n_levels; level++) {
		out->level_first[level] = place + (uint32_t)at;
		at += level_words(t, level);
	}
	if (out->n_levels == 0 || at > t->n_bytes / 4)
		return err_report(ERR_SYSTEM, NULL, "a texture of %u x %u has %zu bytes, not the %zu of its %u levels",
		                  t->width, t->height, t->n_bytes, at * 4, t->n_levels);
	return 0;
}

static int upload_textures(struct frame *frame)
{
	const struct scene *scene = frame->scene;
	struct pool_item *items = calloc(scene->n_textures + (size_t)1, sizeof(*items));
	struct texture_image *images = calloc(scene->n_textures + (size_t)1, sizeof(*images));
	int err = 0;

	if (!items || !images) {
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
		goto done;
	}
	for (uint32_t i = 0; i < scene->n_textures; i++)
		items[i] = (struct pool_item){ { scene->textures[i]->hash[0], scene->textures[i]->hash[1] },
			                       scene->textures[i]->n_bytes / 4, scene->textures[i], 0 };
	err = pool_place(&frame->tr->texels, frame->tr->dev, items, scene->n_textures, fill_texels);
	for (uint32_t i = 0; i < scene->n_textures && !err; i++)
		err = describe_texture(scene->textures[i], items[i].place, &images[i]);
	if (!err)
		err = launch_upload(frame->tr->dev, frame->tr->placed.textures, images, scene->n_textures);
done:
	free(items);
	free(images);
	return err;
}

int upload_state(struct frame *frame)
{
	const struct scene *s = frame->scene;
	struct tracer *tr = frame->tr;
	int err = launch_upload(tr->dev, tr->placed.materials, s->materials, s->n_materials);

	if (!err)
		err = launch_upload(tr->dev, tr->placed.lights, s->lights, s->n_lights);
	if (!err)
		err = launch_upload(tr->dev, tr->placed.units, s->units, s->n_units);
	if (!err)
		err = launch_upload(tr->dev, tr->placed.currents, s->currents, s->n_currents);
	if (!err)
		err = launch_upload(tr->dev, tr->placed.stipples, (const uint32_t *)s->stipples,
		                    32 * (size_t)s->n_stipples);
	if (!err)
		err = launch_upload(tr->dev, tr->placed.programs, s->programs, s->n_programs);
	if (!err)
		err = upload_textures(frame);
	return err;
}

/* Upload one pool of BLASes: the part that is not on the device yet, or all of it if the buffer has to grow. */
static int upload_pool(struct tracer *tr, enum blas_part part, struct device_buffer **buffer)
{
	const struct accel_pool pool = accel_pool(tr->accel, part);
	const size_t size = blas_item_bytes[part];
	size_t from = pool.same;
	int err = 0;

	if (!*buffer || pool.n > tr->tree_room[part]) {
		/* A buffer that grew once will grow again. */
		const size_t room = *buffer ? pool.n + pool.n / 4 : pool.n;

		err = device_reserve(tr->dev, buffer, room * size);
		tr->tree_room[part] = err ? 0 : room;
		from = 0;
	}
	if (err || from == pool.n)
		return err;
	err = device_write(tr->dev, *buffer, from * size, (const char *)pool.items + from * size,
	                   (pool.n - from) * size);
	if (err)
		tr->tree_room[part] = 0;
	return err;
}

/* Upload the pools that the device's kernels traverse. asks_boxes: 1 if a hook traverses binary trees, too */
static int upload_mesh_trees(struct tracer *tr, int asks_boxes)
{
	struct traverse_trees *t = &tr->trees;
	const struct {
		enum blas_part part;
		struct device_buffer **buffer;
		unsigned families;
	} pools[] = {
		{ BLAS_NODES2, &t->nodes2.buffer, 1u << FAMILY_BINARY },
		{ BLAS_TRIANGLES, &t->triangles.buffer, 1u << FAMILY_BINARY },
		{ BLAS_NODES8, &t->nodes8.buffer, 1u << FAMILY_PACKETS },
		{ BLAS_TRIANGLES8, &t->triangles8.buffer, 1u << FAMILY_PACKETS },
		{ BLAS_FACES8, &t->faces8.buffer, 1u << FAMILY_PACKETS },
		{ BLAS_NODES8C, &t->nodes8c.buffer, 1u << FAMILY_COMPRESSED },
		{ BLAS_TRIANGLES8C, &t->triangles8c.buffer, 1u << FAMILY_COMPRESSED },
	};
	int err = 0;

	for (size_t i = 0; i < sizeof(pools) / sizeof(pools[0]) && !err; i++) {
		const int walks = pools[i].families >> device_family(tr->dev) & 1;

		if (!walks)
			tr->tree_room[pools[i].part] = 0; /* frames without the hook do not update it */
		if (walks || (asks_boxes && pools[i].part == BLAS_NODES2))
			err = upload_pool(tr, pools[i].part, pools[i].buffer);
	}
	if (!err)
		accel_copied(tr->accel);
	return err;
}

int upload_trees(struct frame *frame)
{
	struct tracer *tr = frame->tr;
	int err = upload_mesh_trees(tr, frame->options->hook && frame->options->hook->asks_boxes);

	return err ? err :
	             traverse_upload_tlases(tr->dev, tr->accel, frame->prepared.instances, frame->prepared.n_instances,
	                                    &tr->trees);
}
