#include "verbs/render/cryptomatte.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/hash.h"
#include "base/memory.h"
#include "base/table.h"
#include "scene/drawn.h"

enum kind { DRAWS, MESHES, TEXTURES, N_KINDS };

static const char *const layers[N_KINDS] = { "CryptoDraw", "CryptoMesh", "CryptoTexture" };

/* --- Hashes: MurmurHash3_x86_32 (A. Appleby) with seed 0 --------------------------------------------------------- */

static uint32_t rotate_left(uint32_t x, unsigned bits)
{
	return x << bits | x >> (32 - bits);
}

static uint32_t mix_block(uint32_t block)
{
	return rotate_left(block * 0xcc9e2d51u, 15) * 0x1b873593u;
}

static uint32_t murmur(const char *name)
{
	const size_t n = strlen(name);
	uint32_t h = 0, block = 0;

	for (size_t i = 0; i < n; i++) {
		block |= (uint32_t)(unsigned char)name[i] << 8 * (i % 4);
		if (i % 4 == 3) {
			h = rotate_left(h ^ mix_block(block), 13) * 5 + 0xe6546b64u;
			block = 0;
		}
	}
	h ^= mix_block(block); /* the last bytes, fewer than 4; if there are none, this is 0 */
	h ^= (uint32_t)n;
	h = (h ^ h >> 16) * 0x85ebca6bu;
	h = (h ^ h >> 13) * 0xc2b2ae35u;
	return h ^ h >> 16;
}

uint32_t cryptomatte_hash(const char *name)
{
	const uint32_t h = murmur(name), exponent = h >> 23 & 255;

	return exponent == 0 || exponent == 255 ? h ^ 1u << 23 : h;
}

static float as_float(uint32_t bits)
{
	float f;

	memcpy(&f, &bits, sizeof(f));
	return f;
}

/* --- Names ------------------------------------------------------------------------------------------------------- */

/*
 * The name of what a draw shows: by kind, its number, its mesh's hash, or the hash of the texture on its first unit.
 */
static void name_object(const struct scene *scene, enum kind kind, uint32_t draw, char name[64])
{
	const uint32_t number = scene_instance_of(scene, draw);
	const struct scene_instance *instance = number == SCENE_NONE ? NULL : &scene->instances[number];
	const struct scene_material *m = instance ? &scene->materials[instance->material] : NULL;
	const uint64_t *hash = NULL;

	if (kind == MESHES && instance)
		hash = scene->meshes[instance->mesh]->hash;
	if (kind == TEXTURES && m && m->unit_count)
		hash = scene->textures[scene->units[m->unit_first].texture]->hash;
	if (kind == DRAWS)
		snprintf(name, 64, "draw %u", draw);
	else if (hash)
		hash_text(hash, name);
	else
		snprintf(name, 64, "%s", kind == TEXTURES ? "untextured" : "no mesh");
}

/* --- Channels ---------------------------------------------------------------------------------------------------- */

/* A layer under construction: one kind of object. */
struct layer {
	uint32_t *ids;      /* [n_draws + 1] cryptomatte_hash of each draw's object; 0: no pixel has shown the draw yet */
	struct table named; /* set of the ids that the manifest has */
	char *manifest;     /* a JSON object from name to id, without its braces */
	size_t n, room;     /* bytes of the manifest: written, allocated */
};

static int add_name(struct layer *layer, const char *name, uint32_t id)
{
	enum { ENTRY_BYTES = 96 }; /* a name has at most 63 */

	if (table_find(&layer->named, id)) /* another draw of the same mesh or texture */
		return 0;
	if (table_set(&layer->named, id, layer) || MEMORY_GROW(layer->manifest, layer->room, layer->n + ENTRY_BYTES))
		return ERR_SYSTEM;
	layer->n += (size_t)snprintf(layer->manifest + layer->n, ENTRY_BYTES, "%s\"%s\":\"%08x\"", layer->n ? "," : "",
	                             name, id);
	return 0;
}

/* Find the ids of all draws that pixels show. */
static int find_objects(const struct scene *scene, enum kind kind, const float *draws, size_t n_pixels,
                        struct layer *layer)
{
	int err = 0;

	for (size_t i = 0; i < n_pixels && !err; i++) {
		const uint32_t draw = (uint32_t)draws[i];
		char name[64];

		if (draw == 0 || draw > scene->n_draws || layer->ids[draw])
			continue;
		name_object(scene, kind, draw, name);
		layer->ids[draw] = cryptomatte_hash(name);
		err = add_name(layer, name, layer->ids[draw]);
	}
	return err;
}

/* Set a layer's metadata. Its key is the first seven hex digits of its name's hash. */
static int set_metadata(const char *name, const char *manifest, struct image *img)
{
	char key[64];
	const uint32_t id = murmur(name) >> 4;
	int err;

	snprintf(key, sizeof(key), "cryptomatte/%07x/name", id);
	err = image_set_attribute(img, key, "%s", name);
	snprintf(key, sizeof(key), "cryptomatte/%07x/hash", id);
	if (!err)
		err = image_set_attribute(img, key, "MurmurHash3_32");
	snprintf(key, sizeof(key), "cryptomatte/%07x/conversion", id);
	if (!err)
		err = image_set_attribute(img, key, "uint32_to_float32");
	snprintf(key, sizeof(key), "cryptomatte/%07x/manifest", id);
	return err ? err : image_set_attribute(img, key, "{%s}", manifest ? manifest : "");
}

/* Add a layer's channels. Rank 00 has two pairs: R and G are the id and its coverage, which is all; B and A stay 0. */
static int add_layer(const struct scene *scene, enum kind kind, struct image *img)
{
	const size_t n_pixels = (size_t)img->width * img->height;
	struct layer layer = { .ids = calloc((size_t)scene->n_draws + 1, sizeof(*layer.ids)) };
	const float *draws = image_channel(img, "id");
	float *planes[4];
	int err = layer.ids && draws ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");

	if (!err)
		err = find_objects(scene, kind, draws, n_pixels, &layer);
	for (int c = 0; c < 4 && !err; c++) {
		char name[32];

		snprintf(name, sizeof(name), "%s00.%c", layers[kind], "RGBA"[c]);
		planes[c] = image_add_channel(img, name, 1);
		if (!planes[c])
			err = ERR_SYSTEM;
	}
	for (size_t i = 0; i < n_pixels && !err; i++) {
		const uint32_t draw = (uint32_t)draws[i], id = draw <= scene->n_draws ? layer.ids[draw] : 0;

		planes[0][i] = as_float(id);
		planes[1][i] = id ? 1 : 0;
	}
	if (!err)
		err = set_metadata(layers[kind], layer.manifest, img);
	free(layer.ids);
	free(layer.manifest);
	table_free(&layer.named);
	return err;
}

int cryptomatte_add(const struct scene *scene, struct image *img)
{
	int err = 0;

	for (int kind = 0; kind < N_KINDS && !err; kind++)
		err = add_layer(scene, (enum kind)kind, img);
	return err;
}
