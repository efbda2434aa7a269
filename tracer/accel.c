#include "tracer/accel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "base/err.h"
#include "tracer/bvh.h"
#include "tracer/soup.h"

/* Most instances in a leaf of a top level. */
#define LEAF_INSTANCES 1
/*
 * Trees are fitted to a mesh that moves from so many triangles on (below, building is as quick), as long as they cost at most so
 * much more than when they were built.
 */
#define REFIT_TRIANGLES 256
#define REFIT_COST 1.25
/* Frames that a BLAS nobody used stays in the pools. */
#define KEEP_FRAMES 16

/* One BLAS: where it lies in the pools. Entries are in the order of the pools. */
struct blas {
	uint64_t hash[2];
	enum accel_kind kind;
	int baked; /* of this frame only */
	uint64_t last_use;
	uint64_t topology[2]; /* hash of the mesh's indices where the tree may be fitted to other vertices; 0 0: it may not */
	uint64_t fitted;      /* frame in which it was fitted to another mesh */
	double built_cost;    /* bvh_cost when the tree was built, not fitted; with a topology only */
	size_t node2_first, n_nodes2, node8_first, n_nodes8, triangle_first, n_triangles, triangle8_first, n_triangles8;
	size_t node8c_first, n_nodes8c, triangle8c_first, n_triangles8c;
	struct bvh_box box;
};

struct accel_cache {
	struct blas *entries;
	size_t n, capacity;
	size_t capacity_nodes2, capacity_nodes8, capacity_triangles, capacity_triangles8, capacity_nodes8c, capacity_triangles8c;
	size_t capacity_top2, capacity_top8, capacity_list;
	uint32_t *table; /* open addressing over entries, SCENE_NONE: free; a power of two */
	size_t table_size;
	uint64_t frame;
};

static int out_of_memory(void)
{
	return err_report(ERR_SYSTEM, NULL, "acceleration structures: out of memory");
}

/* Make room for `more` items behind the first `n`. */
static int grow_array(void **array, size_t *capacity, size_t n, size_t more, size_t item_bytes)
{
	size_t wanted = n + more;
	void *grown;

	if (wanted <= *capacity)
		return 0;
	wanted += wanted / 2;
	grown = realloc(*array, wanted * item_bytes);
	if (!grown)
		return out_of_memory();
	*array = grown;
	*capacity = wanted;
	return 0;
}
#define GROW(array, capacity, n, more) grow_array((void **)&(array), &(capacity), n, more, sizeof(*(array)))

int accel_create(struct accel **out)
{
	struct accel *accel = calloc(1, sizeof(*accel));

	if (accel)
		accel->cache = calloc(1, sizeof(*accel->cache));
	if (!accel || !accel->cache) {
		free(accel);
		return out_of_memory();
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
	free(a->nodes2);
	free(a->nodes8);
	free(a->triangles);
	free(a->triangles8);
	free(a->nodes8c);
	free(a->triangles8c);
	free(a->top2);
	free(a->top8);
	free(a->instance_list);
	free(a->spaces);
	free(a->cache->entries);
	free(a->cache->table);
	free(a->cache);
	free(a);
}

/* --- finding BLASes --- */

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
		uint32_t *table = realloc(cache->table, size * sizeof(*table));

		if (!table)
			return out_of_memory();
		cache->table = table;
		cache->table_size = size;
	}
	memset(cache->table, 0xff, cache->table_size * sizeof(*cache->table));
	for (size_t i = 0; i < cache->n; i++)
		if (!cache->entries[i].baked)
			table_insert(cache, (uint32_t)i);
	return 0;
}

static struct blas *find_blas(const struct accel_cache *cache, const uint64_t hash[2], enum accel_kind kind)
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

/* Take out what was not used for a while, and what was baked for the last frame; close the gaps. */
static int drop_unused(struct accel *accel)
{
	struct accel_cache *cache = accel->cache;
	size_t n = 0, nodes2 = 0, nodes8 = 0, triangles = 0, triangles8 = 0, nodes8c = 0, triangles8c = 0;

	for (size_t i = 0; i < cache->n; i++) {
		struct blas b = cache->entries[i];

		if (b.baked || b.last_use + KEEP_FRAMES < cache->frame)
			continue;
		memmove(accel->nodes2 + nodes2, accel->nodes2 + b.node2_first, b.n_nodes2 * sizeof(*accel->nodes2));
		if (b.n_nodes8) {
			memmove(accel->nodes8 + nodes8, accel->nodes8 + b.node8_first, b.n_nodes8 * sizeof(*accel->nodes8));
			memmove(accel->triangles8 + triangles8, accel->triangles8 + b.triangle8_first,
			        b.n_triangles8 * sizeof(*accel->triangles8));
		}
		memmove(accel->triangles + triangles, accel->triangles + b.triangle_first,
		        b.n_triangles * sizeof(*accel->triangles));
		if (b.n_nodes8c) {
			memmove(accel->nodes8c + nodes8c, accel->nodes8c + b.node8c_first, b.n_nodes8c * sizeof(*accel->nodes8c));
			memmove(accel->triangles8c + triangles8c, accel->triangles8c + b.triangle8c_first,
			        b.n_triangles8c * sizeof(*accel->triangles8c));
		}
		b.node8c_first = nodes8c;
		b.triangle8c_first = triangles8c;
		nodes8c += b.n_nodes8c;
		triangles8c += b.n_triangles8c;
		b.node2_first = nodes2;
		b.node8_first = nodes8;
		b.triangle_first = triangles;
		b.triangle8_first = triangles8;
		nodes2 += b.n_nodes2;
		nodes8 += b.n_nodes8;
		triangles += b.n_triangles;
		triangles8 += b.n_triangles8;
		cache->entries[n++] = b;
	}
	if (n == cache->n)
		return 0;
	cache->n = n;
	accel->n_nodes2 = nodes2;
	accel->n_nodes8 = nodes8;
	accel->n_triangles = triangles;
	accel->n_triangles8 = triangles8;
	accel->n_nodes8c = nodes8c;
	accel->n_triangles8c = triangles8c;
	accel->generation++;
	return table_rebuild(cache);
}

/* --- building BLASes --- */

static void set_triangle8(struct triangle8 *out, const struct triangle *triangles, uint32_t n)
{
	memset(out, 0, sizeof(*out));
	for (uint32_t lane = 0; lane < 8; lane++) {
		out->primitive[lane] = SCENE_NONE;
		if (lane >= n)
			continue;
		for (int a = 0; a < 3; a++) {
			out->v0[a][lane] = triangles[lane].v0[a];
			out->e1[a][lane] = triangles[lane].e1[a];
			out->e2[a][lane] = triangles[lane].e2[a];
		}
		out->primitive[lane] = triangles[lane].primitive;
	}
}

/* The eight-wide tree in rows, out of the binary one. block_first, block_count: room for all triangles */
static int append_rows(struct accel *accel, struct blas *blas, uint32_t *block_first, uint32_t *block_count)
{
	const struct node2 *nodes2 = accel->nodes2 + blas->node2_first;
	const struct triangle *triangles = accel->triangles + blas->triangle_first;
	struct accel_cache *cache = accel->cache;
	uint32_t n_nodes8, n_blocks;
	int err = GROW(accel->nodes8, cache->capacity_nodes8, accel->n_nodes8, blas->n_nodes2);

	if (!err)
		err = bvh_collapse8(nodes2, (uint32_t)blas->n_nodes2, BVH_BLOCKS, accel->nodes8 + accel->n_nodes8, &n_nodes8, block_first,
		                    block_count, &n_blocks);
	if (!err)
		err = GROW(accel->triangles8, cache->capacity_triangles8, accel->n_triangles8, n_blocks);
	if (err)
		return err;
	for (uint32_t i = 0; i < n_blocks; i++)
		set_triangle8(&accel->triangles8[accel->n_triangles8 + i], triangles + block_first[i], block_count[i]);
	blas->n_nodes8 = n_nodes8;
	blas->n_triangles8 = n_blocks;
	return 0;
}

/* The compressed one. */
static int append_compressed(struct accel *accel, struct blas *blas)
{
	struct accel_cache *cache = accel->cache;
	uint32_t n_nodes = 0;
	int err = GROW(accel->nodes8c, cache->capacity_nodes8c, accel->n_nodes8c,
	               BVH_COMPRESSED_NODES(blas->n_nodes2, blas->n_triangles));

	if (!err)
		err = GROW(accel->triangles8c, cache->capacity_triangles8c, accel->n_triangles8c, blas->n_triangles);
	if (!err)
		err = bvh_compress8(accel->nodes2 + blas->node2_first, (uint32_t)blas->n_nodes2, accel->triangles + blas->triangle_first,
		                    (uint32_t)blas->n_triangles, accel->nodes8c + accel->n_nodes8c, &n_nodes,
		                    accel->triangles8c + accel->n_triangles8c);
	blas->n_nodes8c = n_nodes;
	blas->n_triangles8c = blas->n_triangles;
	return err;
}

/* All trees over a soup, appended to the pools at the places that *blas says. */
static int append_trees(struct accel *accel, const struct soup *soup, const struct tree *tree, struct blas *blas)
{
	struct accel_cache *cache = accel->cache;
	uint32_t *block_first = malloc(2 * (size_t)(tree->n_order + 1) * sizeof(*block_first));
	uint32_t *block_count = block_first + tree->n_order + 1;
	int err;

	if (!block_first)
		return out_of_memory();
	if ((err = GROW(accel->nodes2, cache->capacity_nodes2, accel->n_nodes2, tree->n_nodes)) ||
	    (err = GROW(accel->triangles, cache->capacity_triangles, accel->n_triangles, tree->n_order)))
		goto done;
	memcpy(accel->nodes2 + accel->n_nodes2, tree->nodes, tree->n_nodes * sizeof(*tree->nodes));
	for (uint32_t i = 0; i < tree->n_order; i++)
		accel->triangles[accel->n_triangles + i] = soup->triangles[tree->order[i]];
	blas->n_nodes2 = tree->n_nodes;
	blas->n_triangles = tree->n_order;
	if (accel->wide & ACCEL_ROWS)
		err = append_rows(accel, blas, block_first, block_count);
	if (!err && accel->wide & ACCEL_COMPRESSED)
		err = append_compressed(accel, blas);
done:
	free(block_first);
	return err;
}

/* By what a mesh of the same triangles with other vertices is known; 0 0 where no tree is to be fitted to it. */
static void find_topology(const struct scene_mesh *mesh, const struct soup *soup, uint64_t out[2])
{
	XXH128_hash_t hash;

	out[0] = out[1] = 0;
	if (soup->n < REFIT_TRIANGLES || soup->n != mesh->primitive_count || !soup->bounded)
		return;
	hash = XXH3_128bits(mesh->index, 3 * (size_t)mesh->primitive_count * sizeof(*mesh->index));
	out[0] = hash.low64;
	out[1] = hash.high64;
}

/*
 * The tree to fit to a mesh that nobody has seen: one of the same triangles, not used in this frame, used last before. Where there are
 * several, meshes find theirs in the order in which they were first drawn, each its own. NULL: there is none.
 */
static struct blas *find_moved(struct accel_cache *cache, const struct blas *blas)
{
	struct blas *best = NULL;

	if (!(blas->topology[0] | blas->topology[1]))
		return NULL;
	for (size_t i = 0; i < cache->n; i++) {
		struct blas *b = &cache->entries[i];

		if (b->kind == blas->kind && b->topology[0] == blas->topology[0] && b->topology[1] == blas->topology[1] &&
		    b->last_use < cache->frame && b->fitted != cache->frame && (!best || b->last_use > best->last_use))
			best = b;
	}
	if (best)
		best->fitted = cache->frame;
	return best;
}

/* The tree of a mesh whose vertices have moved. *out is empty where it is better built. */
static int refit(const struct accel *accel, const struct blas *moved, const struct soup *soup, struct tree *out)
{
	const struct triangle *triangles = accel->triangles + moved->triangle_first;
	struct tree old = { accel->nodes2 + moved->node2_first, malloc(moved->n_triangles * sizeof(*old.order)),
		            (uint32_t)moved->n_nodes2, (uint32_t)moved->n_triangles };
	int err;

	if (!old.order)
		return out_of_memory();
	for (uint32_t i = 0; i < old.n_order; i++)
		old.order[i] = triangles[i].primitive; /* none was left out */
	err = tree_refit(&old, soup, REFIT_COST * moved->built_cost, out);
	free(old.order);
	return err;
}

/*
 * A tree for a soup: fitted, found or built. What moves gets a binned tree, quick to build, and is not kept on disk.
 * store: where it may be kept beyond this run, or NULL.
 */
static int find_tree(struct accel *accel, const struct soup *soup, struct store *store, struct blas *blas, struct tree *out)
{
	struct blas *moved = find_moved(accel->cache, blas);
	int err = moved ? refit(accel, moved, soup, out) : 0;

	if (err)
		return err;
	if (out->nodes) {
		blas->built_cost = moved->built_cost;
		accel->n_fitted++;
		return 0;
	}
	accel->n_made++;
	err = tree_make(soup, moved ? ACCEL_BVH : blas->kind, blas->hash, moved ? NULL : store, out);
	if (!err && (blas->topology[0] | blas->topology[1]))
		blas->built_cost = bvh_cost(out->nodes, out->n_nodes);
	return err;
}

/* of_frame: the mesh lives for this frame only. */
static int build_blas(struct accel *accel, const struct scene_mesh *mesh, const float (*positions)[4], int baked,
                      int of_frame, enum accel_kind kind, struct blas **out)
{
	struct accel_cache *cache = accel->cache;
	struct soup soup = { NULL };
	struct tree tree = { NULL };
	struct blas blas = { .baked = baked, .kind = kind };
	int err = GROW(cache->entries, cache->capacity, cache->n, 1);

	if (!err)
		err = soup_make(mesh, positions, &soup);
	if (err)
		goto done;
	memcpy(blas.hash, mesh->hash, sizeof(blas.hash));
	blas.node2_first = accel->n_nodes2;
	blas.node8_first = accel->n_nodes8;
	blas.triangle_first = accel->n_triangles;
	blas.triangle8_first = accel->n_triangles8;
	blas.node8c_first = accel->n_nodes8c;
	blas.triangle8c_first = accel->n_triangles8c;
	blas.box = soup.box;
	if (!of_frame)
		find_topology(mesh, &soup, blas.topology);
	err = find_tree(accel, &soup, of_frame ? NULL : accel->store, &blas, &tree);
	if (!err)
		err = append_trees(accel, &soup, &tree, &blas);
	if (err)
		goto done;
	accel->n_nodes2 += blas.n_nodes2;
	accel->n_nodes8 += blas.n_nodes8;
	accel->n_triangles += blas.n_triangles;
	accel->n_triangles8 += blas.n_triangles8;
	accel->n_nodes8c += blas.n_nodes8c;
	accel->n_triangles8c += blas.n_triangles8c;
	accel->generation++;
	*out = &cache->entries[cache->n];
	cache->entries[cache->n++] = blas;
	if (baked)
		goto done;
	if (4 * cache->n > cache->table_size)
		err = table_rebuild(cache);
	else
		table_insert(cache, (uint32_t)(cache->n - 1));
done:
	tree_free(&tree);
	soup_free(&soup);
	return err;
}

/* Does its mesh live for one frame only? */
static int is_of_frame(const struct instance *instance)
{
	return (instance->flags & (INSTANCE_BAKED | INSTANCE_SCREEN)) != 0;
}

static enum accel_kind accel_kind_of(const struct accel *accel, const struct instance *instance)
{
	return is_of_frame(instance) ? ACCEL_BVH : accel->kind;
}

/* The BLAS of one instance; its places go into the instance and its box, in BLAS space, to *box. */
static int place_instance(struct accel *accel, const struct scene_mesh *mesh, const float (*eye_vertices)[4],
                          struct instance *instance, struct bvh_box *box)
{
	const int baked = (instance->flags & INSTANCE_BAKED) != 0;
	struct blas *blas = baked ? NULL : find_blas(accel->cache, mesh->hash, accel_kind_of(accel, instance));
	int err = 0;

	if (mesh->kind != SCENE_TRIANGLES)
		return err_report(ERR_SYSTEM, NULL, "acceleration structures: a mesh of lines or points was not expanded");
	if (!blas)
		err = build_blas(accel, mesh,
		                 baked ? eye_vertices + instance->vertex_first : (const float (*)[4])mesh->position,
		                 baked, is_of_frame(instance), accel_kind_of(accel, instance), &blas);
	if (err)
		return err;
	blas->last_use = accel->cache->frame;
	instance->node2_first = (uint32_t)blas->node2_first;
	instance->node8_first = (uint32_t)blas->node8_first;
	instance->triangle_first = (uint32_t)blas->triangle_first;
	instance->triangle8_first = (uint32_t)blas->triangle8_first;
	instance->node8c_first = (uint32_t)blas->node8c_first;
	instance->triangle8c_first = (uint32_t)blas->triangle8c_first;
	*box = blas->box;
	instance->radius = 0;
	for (int a = 0; a < 3; a++) {
		instance->centre[a] = 0.5f * (box->lo[a] + box->hi[a]);
		instance->radius += 0.5f * (box->hi[a] - box->lo[a]);
	}
	return 0;
}

/* --- top levels --- */

/* Eye-space box of an instance whose BLAS has box `obj`, widened by the instance's pad where that is asked for. */
static void eye_box(const struct instance *instance, const struct bvh_box *obj, float pad, struct bvh_box *out)
{
	for (int row = 0; row < 3; row++) {
		const float *m = instance->eye_from_obj + 4 * row;
		double lo = m[3], hi = m[3];

		for (int a = 0; a < 3; a++) {
			double x = (double)m[a] * (obj->lo[a] - pad), y = (double)m[a] * (obj->hi[a] + pad);

			lo += x < y ? x : y;
			hi += x < y ? y : x;
		}
		/* Room for what rounding does to a ray on its way into object space. */
		lo -= 1e-6 * (fabs(lo) + (hi - lo));
		hi += 1e-6 * (fabs(hi) + (hi - lo));
		out->lo[row] = (float)(lo > -SOUP_UNBOUNDED ? lo : -SOUP_UNBOUNDED);
		out->hi[row] = (float)(hi < SOUP_UNBOUNDED ? hi : SOUP_UNBOUNDED);
	}
}

/* What a top level is built from. */
struct top {
	struct bvh_box *boxes;
	uint32_t *items; /* instances */
	uint32_t *order;
	uint32_t n;
};

static void top_add(struct top *top, uint32_t item, const struct instance *instance, const struct bvh_box *obj,
                    float pad)
{
	struct bvh_box *box = &top->boxes[top->n];

	if (obj->lo[0] > obj->hi[0])
		return; /* an empty mesh */
	eye_box(instance, obj, pad, box);
	/* A matrix that is not finite leaves nothing to hit. */
	for (int a = 0; a < 3; a++)
		if (!(box->lo[a] <= box->hi[a]))
			return;
	top->items[top->n++] = item;
}

/* Append a binary tree over `top`, and a wide one when asked for. */
static int build_top(struct accel *accel, struct top *top, int wide)
{
	struct accel_cache *cache = accel->cache;
	uint32_t n_nodes2, n_nodes8;
	struct node2 *nodes2;
	int err = GROW(accel->top2, cache->capacity_top2, accel->n_top2, top->n);

	if (!err)
		err = GROW(accel->instance_list, cache->capacity_list, accel->n_instance_list, top->n);
	if (err)
		return err;
	nodes2 = accel->top2 + accel->n_top2;
	err = bvh_build_sah(top->boxes, top->n, LEAF_INSTANCES, 0, nodes2, &n_nodes2, top->order);
	if (err)
		return err;
	for (uint32_t i = 0; i < n_nodes2; i++)
		for (int side = 0; side < 2; side++)
			if (nodes2[i].count[side])
				nodes2[i].child[side] += (uint32_t)accel->n_instance_list;
	for (uint32_t i = 0; i < top->n; i++)
		accel->instance_list[accel->n_instance_list + i] = top->items[top->order[i]];
	accel->n_instance_list += top->n;
	accel->n_top2 += n_nodes2;
	if (!wide)
		return 0;
	err = GROW(accel->top8, cache->capacity_top8, accel->n_top8, n_nodes2);
	if (!err)
		err = bvh_collapse8(nodes2, n_nodes2, BVH_ITEMS, accel->top8 + accel->n_top8, &n_nodes8, NULL, NULL, NULL);
	if (!err)
		accel->n_top8 += n_nodes8;
	return err;
}

static int build_view_top(struct accel *accel, uint32_t view_index, const struct instance *instances, uint32_t n,
                          const struct bvh_box *boxes, struct top *top, struct view *view)
{
	int err;

	top->n = 0;
	for (uint32_t i = 0; i < n; i++)
		if (instances[i].view == view_index && !(instances[i].flags & INSTANCE_SCREEN))
			top_add(top, i, &instances[i], &boxes[i], instances[i].pad);
	view->tlas_first = (uint32_t)accel->n_top2;
	view->tlas_count = 0;
	if (top->n == 0)
		return 0;
	err = build_top(accel, top, 0);
	view->tlas_count = (uint32_t)accel->n_top2 - view->tlas_first;
	return err;
}

static int build_space_top(struct accel *accel, const struct scene *scene, const struct instance *instances, uint32_t n,
                           const struct bvh_box *boxes, struct top *top, struct accel_space *space)
{
	int err;

	top->n = 0;
	for (uint32_t i = 0; i < n; i++)
		if (scene->views[instances[i].view].space == space->space &&
		    (instances[i].flags & (space->sky ? INSTANCE_SKY : INSTANCE_SECONDARY)) &&
		    !(instances[i].flags & INSTANCE_SCREEN))
			top_add(top, i, &instances[i], &boxes[i], 0);
	space->top2_first = (uint32_t)accel->n_top2;
	space->top8_first = (uint32_t)accel->n_top8;
	space->n_nodes = 0;
	if (top->n == 0)
		return 0;
	err = build_top(accel, top, 1);
	space->n_nodes = (uint32_t)accel->n_top2 - space->top2_first;
	return err;
}

/* The eye spaces of the scene's views, each once, and once more for its skies. */
static int list_spaces(struct accel *accel, const struct scene *scene, const struct instance *instances, uint32_t n)
{
	uint32_t skies = 0;

	for (uint32_t i = 0; i < n; i++)
		skies |= instances[i].flags & INSTANCE_SKY;
	free(accel->spaces);
	accel->n_spaces = 0;
	accel->spaces = calloc(2 * (size_t)scene->n_views + 1, sizeof(*accel->spaces));
	if (!accel->spaces)
		return out_of_memory();
	for (uint32_t i = 0; i < scene->n_views; i++) {
		size_t k = 0;

		while (k < accel->n_spaces && accel->spaces[k].space != scene->views[i].space)
			k++;
		if (k < accel->n_spaces)
			continue;
		for (int sky = 0; sky <= (skies != 0); sky++) {
			accel->spaces[accel->n_spaces].space = scene->views[i].space;
			accel->spaces[accel->n_spaces++].sky = sky;
		}
	}
	return 0;
}

static int build_tops(struct accel *accel, const struct scene *scene, const struct instance *instances, uint32_t n,
                      const struct bvh_box *boxes, struct view *views)
{
	struct top top = { NULL, NULL, NULL, 0 };
	int err = list_spaces(accel, scene, instances, n);

	if (err)
		return err;
	accel->n_top2 = accel->n_top8 = accel->n_instance_list = 0;
	top.boxes = malloc((n + 1) * sizeof(*top.boxes));
	top.items = malloc((n + 1) * sizeof(*top.items));
	top.order = malloc((n + 1) * sizeof(*top.order));
	if (!top.boxes || !top.items || !top.order)
		err = out_of_memory();
	for (uint32_t i = 0; i < scene->n_views && !err; i++)
		err = build_view_top(accel, i, instances, n, boxes, &top, &views[i]);
	for (size_t i = 0; i < accel->n_spaces && !err; i++)
		err = build_space_top(accel, scene, instances, n, boxes, &top, &accel->spaces[i]);
	free(top.boxes);
	free(top.items);
	free(top.order);
	return err;
}

int accel_build_frame(struct accel *accel, const struct scene *scene, const struct scene_mesh *const *extra,
                      const float (*eye_vertices)[4], struct instance *instances, uint32_t n, struct view *views,
                      const struct accel_space **spaces, uint32_t *n_spaces)
{
	struct bvh_box *boxes = malloc((n + 1) * sizeof(*boxes));
	int err = 0;

	if (!boxes)
		return out_of_memory();
	accel->cache->frame++;
	err = drop_unused(accel);
	for (uint32_t i = 0; i < n && !err; i++) {
		const struct scene_mesh *mesh = extra && extra[i] ? extra[i]
			: scene->meshes[scene->instances[instances[i].scene_instance].mesh];

		err = place_instance(accel, mesh, eye_vertices, &instances[i], &boxes[i]);
	}
	if (!err)
		err = build_tops(accel, scene, instances, n, boxes, views);
	free(boxes);
	*spaces = accel->spaces;
	*n_spaces = (uint32_t)accel->n_spaces;
	return err;
}
