/*
 * Mixes of two frames' materials, views and meshes, for a moment between them. Numbers change linearly; enumerants
 * and switches are the base's. Each pair is mixed once.
 */
#pragma once

#include "base/table.h"
#include "scene/scene.h"

struct mixer {
	const struct scene *base, *other; /* the two frames (bridge.h); borrowed */
	int is_back;       /* 1: the base is the second in time */
	double at;         /* [0,1], from the first to the second */
	float share;       /* weight of the other frame's numbers, [0,1] */
	struct scene *out; /* owns its arrays, with the capacities below; starts as a copy of the base */
	uint32_t room_materials, room_units, room_lights, room_currents, room_views, room_meshes, room_programs;
	void **owned; /* arrays and structs used by mixed meshes */
	size_t n_owned, room_owned;
	struct table materials, currents, views, meshes, programs; /* pairs -> number + 1 */
	const double *camera;   /* motion of static things in eye space, from first to second frame; NULL: unknown */
	double camera_part[16]; /* its part up to this moment */
};

/**
 * Mix a pair, or find it if it was mixed before.
 * @param base   index in the base
 * @param other  index in the other frame
 * @return index in out; SCENE_NONE: no memory (reported)
 */
uint32_t mixed_material(struct mixer *m, uint32_t base, uint32_t other);
uint32_t mixed_current(struct mixer *m, uint32_t base, uint32_t other);
uint32_t mixed_view(struct mixer *m, uint32_t base, uint32_t other);

/** Meshes with the same points give the base's; compatible ones give a new mesh. */
uint32_t mixed_mesh(struct mixer *m, uint32_t base, uint32_t other);

/** 1 if two meshes have the same points, whatever else differs. */
int mixed_same_points(const struct scene_mesh *a, const struct scene_mesh *b);

/** 1 if two meshes are compatible: they differ in points alone and have the same triangles, attributes and texture
 * coordinates. */
int mixed_suits(const struct scene_mesh *a, const struct scene_mesh *b);

/** Mix the colours of clears, if both frames have the same number. */
void mixed_clears(struct mixer *m);

/** Free the tables; out's arrays and `owned` stay. */
void mixed_end(struct mixer *m);
