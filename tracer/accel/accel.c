#include "tracer/accel/accel.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/hash.h"
#include "base/memory.h"
#include "tracer/accel/builders.h"
#include "tracer/accel/bvh.h"
#include "tracer/accel/soup.h"
#include "tracer/accel/tlas.h"

/*
 * A moving mesh with at least this many triangles keeps its tree, with refitted boxes, while that costs at most
 * REFIT_COST times the tree as built. Smaller trees are rebuilt just as fast.
 */
#define REFIT_TRIANGLES 256
#define REFIT_COST 1.25
/* An unused BLAS is kept for KEEP_FRAMES frames, and longer while unused BLASes are at most this share of all: closing
 * a gap moves everything after it. */
#define KEEP_FRAMES 16
#define KEEP_SMALL_FRAMES 2 /* for BLASes with fewer than SHARE_TRIANGLES, which are quick to rebuild */
#define UNUSED_SHARE 0.5

/* BLASes with fewer triangles are not shared: each worker builds its own as fast as it would wait. */
#define SHARE_TRIANGLES 256

/* A BLAS in the pools. Entries have the same order as the pools. */
struct placed_blas {
	uint64_t hash[2];
	enum accel_kind kind;
	int baked; /* for this frame only */
	uint64_t last_use;
	uint64_t fitted; /* last frame when another mesh took over its tree */
	size_t first[N_BLAS_PARTS];
	struct blas blas; /* without its parts, which are in the pools */
};

struct accel_cache {
	struct placed_blas *entries;
	size_t n, capacity;
	size_t capacities[N_BLAS_PARTS]; /* capacity of each pool, in items */
	uint32_t *table; /* hash table, open addressing: indices of entries, SCENE_NONE: free; a power of two */
	size_t table_size;
	uint64_t frame;
};

/* One of the pools of struct accel. */
struct pool {
	void **items;
	size_t *n;
};

static struct pool pool_of(struct accel *a, int part)
{
	const struct pool pools[N_BLAS_PARTS] = {
		[BLAS_NODES2] = { (void **)&a->nodes2, &a->n_nodes2 },
		[BLAS_TRIANGLES] = { (void **)&a->triangles, &a->n_triangles },
		[BLAS_NODES8] = { (void **)&a->nodes8, &a->n_nodes8 },
		[BLAS_TRIANGLES8] = { (void **)&a->triangles8, &a->n_triangles8 },
		[BLAS_FACES8] = { (void **)&a->faces8, &a->n_faces8 },
		[BLAS_NODES8C] = { (void **)&a->nodes8c, &a->n_nodes8c },
		[BLAS_TRIANGLES8C] = { (void **)&a->triangles8c, &a->n_triangles8c },
	};

	return pools[part];
}

int accel_create(struct accel **out)
{
	struct accel *accel = calloc(1, sizeof(*accel));

	if (accel)
		accel->cache = calloc(1, sizeof(*accel->cache));
	if (!accel || !accel->cache) {
		free(accel);
		return err_report(ERR_SYSTEM, NULL, "acceleration structures: out of memory");
	}
	accel->wide = ACCEL_ROWS;
	*out = accel;
	return 0;
}

void accel_destroy(struct accel **accel)
{
	struct accel *a = *accel;

	*accel = NULL;
	if (!a)
		return;
	for (int part = 0; part < N_BLAS_PARTS; part++)
		free(*pool_of(a, part).items);
	free(a->top2);
	free(a->top8);
	free(a->instance_list);
	free(a->spaces);
	free(a->cache->entries);
	free(a->cache->table);
	free(a->cache);
	free(a);
}

struct accel_pool accel_pool(const struct accel *accel, enum blas_part part)
{
	const struct pool pool = pool_of((struct accel *)accel, part);

	return (struct accel_pool){ *pool.items, *pool.n, accel->same[part] };
}

void accel_copied(struct accel *accel)
{
	for (int part = 0; part < N_BLAS_PARTS; part++)
		accel->same[part] = *pool_of(accel, part).n;
}

/* --- finding BLASes ---------------------------------------------------------------------------------------------- */

static size_t table_slot(const struct accel_cache *cache, const uint64_t hash[2])
{
	return (size_t)(hash[0] ^ hash[1] * 0x9e3779b97f4a7c15u) & (cache->table_size - 1);
}

static void table_insert(struct accel_cache *cache, uint32_t entry)
{
	size_t slot = table_slot(cache, cache->entries[entry].hash);

	while (cache->table[slot] != SCENE_NONE)
		slot = (slot + 1) & (cache->table_size - 1);
	cache->table[slot] = entry;
}

static int table_rebuild(struct accel_cache *cache)
{
	size_t size = 64;

	while (size < 4 * cache->n)
		size *= 2;
	if (size > cache->table_size) {
		if (memory_resize(&cache->table, size, sizeof(*cache->table)))
			return ERR_SYSTEM;
		cache->table_size = size;
	}
	memset(cache->table, 0xff, cache->table_size * sizeof(*cache->table));
	for (size_t i = 0; i < cache->n; i++)
		if (!cache->entries[i].baked)
			table_insert(cache, (uint32_t)i);
	return 0;
}

static struct placed_blas *find_blas(const struct accel_cache *cache, const uint64_t hash[2], enum accel_kind kind)
{
	if (!cache->table_size)
		return NULL;
	for (size_t slot = table_slot(cache, hash);; slot = (slot + 1) & (cache->table_size - 1)) {
		uint32_t entry = cache->table[slot];

		if (entry == SCENE_NONE)
			return NULL;
		if (cache->entries[entry].kind == kind && memcmp(cache->entries[entry].hash, hash, 2 * sizeof(*hash)) == 0)
			return &cache->entries[entry];
	}
}

/* Move a BLAS down to directly after those kept so far, and advance `ends` past it. */
static void move_down(struct accel *accel, struct placed_blas *placed, size_t ends[N_BLAS_PARTS])
{
	for (int part = 0; part < N_BLAS_PARTS; part++) {
		const size_t bytes = blas_item_bytes[part], n = placed->blas.n[part];
		char *items = *pool_of(accel, part).items;

		if (n && placed->first[part] != ends[part]) {
			memmove(items + ends[part] * bytes, items + placed->first[part] * bytes, n * bytes);
			accel->same[part] = ends[part] < accel->same[part] ? ends[part] : accel->same[part];
		}
		placed->first[part] = ends[part];
		ends[part] += n;
	}
}

static int is_unused(const struct accel_cache *cache, const struct placed_blas *b)
{
	return b->last_use + (b->blas.n[BLAS_TRIANGLES] < SHARE_TRIANGLES ? KEEP_SMALL_FRAMES : KEEP_FRAMES) < cache->frame;
}

/* Do BLASes that have gone unused for a while exceed their share? n_baked receives the number baked for the last
 * frame */
static int much_is_unused(const struct accel *accel, size_t *n_baked)
{
	const struct accel_cache *cache = accel->cache;
	size_t unused = 0;

	*n_baked = 0;
	for (size_t i = 0; i < cache->n; i++) {
		if (is_unused(cache, &cache->entries[i]))
			unused += cache->entries[i].blas.n[BLAS_TRIANGLES];
		*n_baked += cache->entries[i].baked != 0;
	}
	return (double)unused > UNUSED_SHARE * (double)accel->n_triangles;
}

/* Remove the BLASes baked for the last frame and, if they exceed their share, those that have gone unused for a while.
 * Close the gaps. */
static int drop_unused(struct accel *accel)
{
	struct accel_cache *cache = accel->cache;
	size_t n = 0, n_baked, ends[N_BLAS_PARTS] = { 0 };
	const int drop = much_is_unused(accel, &n_baked);

	if (!drop && !n_baked)
		return 0;

	for (size_t i = 0; i < cache->n; i++) {
		struct placed_blas b = cache->entries[i];

		if (b.baked || (drop && is_unused(cache, &b)))
			continue;
		move_down(accel, &b, ends);
		cache->entries[n++] = b;
	}
	if (n == cache->n)
		return 0;
	cache->n = n;
	for (int part = 0; part < N_BLAS_PARTS; part++) {
		*pool_of(accel, part).n = ends[part];
		accel->same[part] = ends[part] < accel->same[part] ? ends[part] : accel->same[part];
	}
	accel->generation++;
	return table_rebuild(cache);
}

/* --- building BLASes --------------------------------------------------------------------------------------------- */

/* Copy a BLAS to the ends of the pools. */
static int append(struct accel *accel, const struct blas *blas, struct placed_blas *placed)
{
	int err = 0;

	for (int part = 0; part < N_BLAS_PARTS && !err; part++) {
		const struct pool pool = pool_of(accel, part);
		const size_t bytes = blas_item_bytes[part], wanted = *pool.n + blas->n[part];
		size_t *capacity = &accel->cache->capacities[part];

		placed->first[part] = *pool.n;
		if (wanted > *capacity)
			*capacity = memory_grow(pool.items, *capacity, wanted, bytes);
		err = wanted > *capacity ? ERR_SYSTEM : 0;
		if (!err && blas->n[part])
			memcpy((char *)*pool.items + *pool.n * bytes, blas->parts[part], blas->n[part] * bytes);
	}
	for (int part = 0; part < N_BLAS_PARTS && !err; part++)
		*pool_of(accel, part).n += blas->n[part];
	placed->blas = *blas;
	memset(placed->blas.parts, 0, sizeof(placed->blas.parts));
	return err;
}

/* Compute a hash that is equal for meshes with the same triangles but other vertices. 0 0: the tree must not be
 * refitted. */
static void find_topology(const struct scene_mesh *mesh, const struct soup *soup, uint64_t out[2])
{
	out[0] = out[1] = 0;
	if (soup->n >= REFIT_TRIANGLES && soup->n == mesh->primitive_count && soup->bounded)
		hash_bytes(mesh->index, 3 * (size_t)mesh->primitive_count * sizeof(*mesh->index), out);
}

/*
 * Find a BLAS whose tree can be refitted to a new mesh: it has the same triangles and is not used in this frame; the
 * most recently used one is taken. If there are several, meshes get them in the order they were first drawn. NULL:
 * there is none.
 */
static struct placed_blas *find_moved(struct accel_cache *cache, enum accel_kind kind, const uint64_t topology[2])
{
	struct placed_blas *best = NULL;

	if (!(topology[0] | topology[1]))
		return NULL;
	for (size_t i = 0; i < cache->n; i++) {
		struct placed_blas *b = &cache->entries[i];

		if (b->kind == kind && b->blas.topology[0] == topology[0] && b->blas.topology[1] == topology[1] &&
		    b->last_use < cache->frame && b->fitted != cache->frame && (!best || b->last_use > best->last_use))
			best = b;
	}
	if (best)
		best->fitted = cache->frame;
	return best;
}

/* Refit the tree of a moved mesh. *out stays empty if building is better. */
static int refit(const struct accel *accel, const struct placed_blas *moved, const struct soup *soup, struct tree *out)
{
	const struct triangle *triangles = accel->triangles + moved->first[BLAS_TRIANGLES];
	const size_t n = moved->blas.n[BLAS_TRIANGLES];
	struct tree old = { accel->nodes2 + moved->first[BLAS_NODES2], malloc(n * sizeof(*old.order)),
		            (uint32_t)moved->blas.n[BLAS_NODES2], (uint32_t)n };
	int err;

	if (!old.order)
		return err_report(ERR_SYSTEM, NULL, "acceleration structures: out of memory");
	for (uint32_t i = 0; i < old.n_order; i++)
		old.order[i] = triangles[i].primitive; /* no triangle was left out */
	err = tree_refit(&old, soup, REFIT_COST * moved->blas.built_cost, out);
	free(old.order);
	return err;
}

/* A BLAS to build. */
struct order {
	const struct scene_mesh *mesh;
	const float (*positions)[4];
	int baked, of_frame; /* of_frame: the mesh lives for this frame only */
	enum accel_kind kind;
};

/*
 * Get a tree for a soup: refit, load or build one. Moving meshes get a binned tree, which is quick to build and is not
 * stored on disk.
 * @param own  receives 1 if the tree depends on earlier frames of this accel
 */
static int find_tree(struct accel *accel, const struct soup *soup, const struct order *order, struct blas *blas,
                     struct tree *out, int *own)
{
	struct placed_blas *moved = find_moved(accel->cache, order->kind, blas->topology);
	int err = moved ? refit(accel, moved, soup, out) : 0;

	*own = moved != NULL;
	if (err)
		return err;
	if (out->nodes) {
		blas->built_cost = moved->blas.built_cost;
		accel->n_fitted++;
		return 0;
	}
	accel->n_made++;
	err = builders_make_tree(soup, moved ? ACCEL_BVH : order->kind, order->mesh->hash,
	                         moved || order->of_frame ? NULL : accel->store, out);
	if (!err && (blas->topology[0] | blas->topology[1]))
		blas->built_cost = bvh_cost(out->nodes, out->n_nodes);
	return err;
}

/* @param own as in find_tree. @param out free with blas_free, also after an error */
static int make_blas(struct accel *accel, const struct order *order, struct blas *out, int *own)
{
	struct soup soup;
	struct tree tree = { NULL };
	int err = soup_make(order->mesh, order->positions, &soup);

	if (!err && !order->of_frame)
		find_topology(order->mesh, &soup, out->topology);
	if (!err)
		err = find_tree(accel, &soup, order, out, &tree, own);
	if (!err)
		err = blas_make(&soup, &tree, accel->wide, out);
	tree_free(&tree);
	soup_free(&soup);
	return err;
}

/* Put a BLAS into the pools: one that workers share, or one built here. */
static int place_blas(struct accel *accel, const struct order *order, struct placed_blas *placed)
{
	struct blas_cache *cache = order->of_frame || order->mesh->primitive_count < SHARE_TRIANGLES ? NULL : accel->shared;
	const struct blas_key key = { { order->mesh->hash[0], order->mesh->hash[1] }, order->kind, accel->wide };
	const struct blas *shared = NULL;
	struct blas blas = { .n = { 0 } };
	int own = 0, err = cache ? blas_cache_acquire(cache, &key, &shared) : 0;

	if (err)
		return err;
	if (!shared) {
		err = make_blas(accel, order, &blas, &own);
		if (cache && (err || own))
			blas_cache_abandon(cache, &key);
		else if (cache)
			shared = blas_cache_publish(cache, &key, &blas);
	}
	if (!err)
		err = append(accel, shared ? shared : &blas, placed);
	if (shared)
		blas_cache_release(cache, shared);
	blas_free(&blas);
	return err;
}

static int add_blas(struct accel *accel, const struct order *order, struct placed_blas **out)
{
	struct accel_cache *cache = accel->cache;
	struct placed_blas placed = { .baked = order->baked, .kind = order->kind };
	int err = MEMORY_GROW(cache->entries, cache->capacity, cache->n + 1);

	memcpy(placed.hash, order->mesh->hash, sizeof(placed.hash));
	if (!err)
		err = place_blas(accel, order, &placed);
	if (err)
		return err;
	accel->generation++;
	*out = &cache->entries[cache->n];
	cache->entries[cache->n++] = placed;
	if (order->baked)
		return 0;
	if (4 * cache->n > cache->table_size)
		return table_rebuild(cache);
	table_insert(cache, (uint32_t)(cache->n - 1));
	return 0;
}

/* Does the instance's mesh live for one frame only? */
static int is_of_frame(const struct instance *instance)
{
	return (instance->flags & (INSTANCE_BAKED | INSTANCE_SCREEN)) != 0;
}

static enum accel_kind accel_kind_of(const struct accel *accel, const struct instance *instance)
{
	return is_of_frame(instance) ? ACCEL_BVH : accel->kind;
}

/* Find or add an instance's BLAS. Set the instance's offsets into the pools, and *box to the BLAS's box in BLAS
 * space. */
static int place_instance(struct accel *accel, const struct scene_mesh *mesh, const float (*eye_vertices)[4],
                          struct instance *instance, struct bvh_box *box)
{
	const int baked = (instance->flags & INSTANCE_BAKED) != 0;
	const struct order order = { mesh,
		                     baked ? eye_vertices + instance->vertex_first : (const float(*)[4])mesh->position,
		                     baked, is_of_frame(instance), accel_kind_of(accel, instance) };
	struct placed_blas *placed = baked ? NULL : find_blas(accel->cache, mesh->hash, order.kind);
	int err = 0;

	if (mesh->kind != SCENE_TRIANGLES)
		return err_report(ERR_SYSTEM, NULL, "acceleration structures: a mesh of lines or points was not expanded");
	if (!placed)
		err = add_blas(accel, &order, &placed);
	if (err)
		return err;
	placed->last_use = accel->cache->frame;
	instance->node2_first = (uint32_t)placed->first[BLAS_NODES2];
	instance->node8_first = (uint32_t)placed->first[BLAS_NODES8];
	instance->triangle_first = (uint32_t)placed->first[BLAS_TRIANGLES];
	instance->triangle8_first = (uint32_t)placed->first[BLAS_TRIANGLES8];
	instance->node8c_first = (uint32_t)placed->first[BLAS_NODES8C];
	instance->triangle8c_first = (uint32_t)placed->first[BLAS_TRIANGLES8C];
	*box = placed->blas.box;
	instance->radius = 0;
	for (int a = 0; a < 3; a++) {
		instance->centre[a] = 0.5f * (box->lo[a] + box->hi[a]);
		instance->radius += 0.5f * (box->hi[a] - box->lo[a]);
	}
	return 0;
}

int accel_build_frame(struct accel *accel, const struct scene *scene, const struct scene_mesh *const *extra,
                      const float (*eye_vertices)[4], struct instance *instances, uint32_t n, struct view *views,
                      const struct accel_space **spaces, uint32_t *n_spaces)
{
	struct bvh_box *boxes = malloc((n + 1) * sizeof(*boxes));
	int err = 0;

	if (!boxes)
		return err_report(ERR_SYSTEM, NULL, "acceleration structures: out of memory");
	accel->cache->frame++;
	err = drop_unused(accel);
	for (uint32_t i = 0; i < n && !err; i++) {
		const struct scene_mesh *mesh = extra && extra[i] ? extra[i]
			: scene->meshes[scene->instances[instances[i].scene_instance].mesh];

		err = place_instance(accel, mesh, eye_vertices, &instances[i], &boxes[i]);
	}
	if (!err)
		err = tlas_build(accel, scene, instances, n, boxes, views);
	free(boxes);
	*spaces = accel->spaces;
	*n_spaces = (uint32_t)accel->n_spaces;
	return err;
}
