/*
 * A tile's faces in draw order. OpenCL C only.
 *
 * Columns that continue from an earlier launch are often deep. Their tiles first list all faces, then draw them in draw
 * order until no pixel has room. Faces that come too early or too late are not set up.
 */
#pragma once

#include "kernels/camera/tile.h"

/* Test whether any open pixel has room in its column. */
WIDE_VECTORS static inline int has_room(const struct tile *t)
{
	packi room = 0;

	for (int y = 0; y < TILE_BLOCKS; y++)
		for (int x = 0; x < TILE_BLOCKS; x++) {
			const struct camera_pack *p = &t->packs[y][x];

			room |= (p->first != SCENE_NONE) & (p->counts < CAMERA_COLUMN_MAX) & ~(t->off_x[x] | t->off_y[y]);
		}
	return any_pack(room);
}

/* Move a key down the heap to its place. */
static inline void sink(struct listed *l, uint at)
{
	const ulong key = l->key[at];

	for (uint child = 2 * at + 1; child < l->n; child = 2 * at + 1) {
		child += child + 1 < l->n && l->key[child + 1] < l->key[child];
		if (l->key[child] >= key)
			break;
		l->key[at] = l->key[child];
		at = child;
	}
	l->key[at] = key;
}

/* Queue up to sixteen of the list's first faces, of instances with the same flags. A face that is in several leaves is
 * queued once. */
static inline void take_listed(struct tile *t)
{
	struct pending *pending = &t->pending;
	struct listed *l = &t->listed;
	uint last = SCENE_NONE;

	while (l->n && pending->n < 16) {
		const uint order = (uint)(l->key[0] >> 32), entry = (uint)l->key[0], index = l->instance[entry],
			   lane = l->place[entry] % 8;
		__global const struct face8 *faces = &t->faces[l->place[entry] / 8];
		__global const struct instance *instance = &t->instances[index];

		if (pending->n && instance->flags != pending->flags)
			return;
		if (order != last) {
			pending->flags = instance->flags;
			pending->instance[pending->n] = index;
			pending->primitive[pending->n] = faces->primitive[lane];
			for (int i = 0; i < 3; i++)
				pending->vertex[i][pending->n] = instance->vertex_first + faces->vertex[i][lane];
			pending->n++;
		}
		last = order;
		l->key[0] = l->key[--l->n];
		sink(l, 0);
	}
}

/* Draw the list, as far as it can still fit into columns. Faces found afterwards may precede what was drawn. */
static inline void draw_listed(struct tile *t)
{
	struct listed *l = &t->listed;

	for (uint i = l->n / 2; i-- > 0;)
		sink(l, i);
	while (l->n && (l->is_drawn || has_room(t))) {
		take_listed(t);
		draw_pending(t);
	}
	l->is_drawn = 1;
	l->n = 0;
}

/* Add a block of an instance's faces to the list. place: index among all blocks */
static inline void list_faces(struct tile *t, uint index, uint place)
{
	const uint first = t->instances[index].primitive_first;
	__global const struct face8 *faces = &t->faces[place];
	struct listed *l = &t->listed;

	if (l->n + 8 > LISTED_FULL)
		draw_listed(t);
	for (uint lane = 0; lane < 8; lane++) {
		if (faces->primitive[lane] == SCENE_NONE || first + faces->primitive[lane] < l->least)
			continue;
		l->key[l->n] = (ulong)(first + faces->primitive[lane]) << 32 | l->n;
		l->instance[l->n] = index;
		l->place[l->n++] = 8 * place + lane;
	}
}

/* --- columns ----------------------------------------------------------------------------------------------------- */

/* The least order numbers that a block's pixels accept. after: per pixel, as in camera.h */
static inline packu columns_begin(const struct tile *t, int x, int y, __global const uint *after)
{
	packu first = SCENE_NONE;

	for (int lane = 0; lane < 16; lane++) {
		const int px = BLOCK * x + lane % BLOCK, py = BLOCK * y + lane / BLOCK;

		if (px >= t->open.x0 && px < t->open.x1 && py >= t->open.y0 && py < t->open.y1)
			((uint *)&first)[lane] = after[place_of(t, px, py)];
	}
	return first;
}

static inline void clear_columns(struct tile *t, __global const uint *after)
{
	packu least = SCENE_NONE;

	for (int y = 0; y < TILE_BLOCKS; y++)
		for (int x = 0; x < TILE_BLOCKS; x++) {
			struct camera_pack *p = &t->packs[y][x];

			p->first = columns_begin(t, x, y, after);
			p->last = SCENE_NONE;
			p->counts = 0;
			least = min(least, p->first);
		}
	t->listed.least = SCENE_NONE;
	for (int lane = 0; lane < 16; lane++)
		t->listed.least = min(t->listed.least, ((const uint *)&least)[lane]);
	t->listed.is_used = t->listed.least > 0;
	t->listed.is_drawn = 0;
	t->listed.n = 0;
}
