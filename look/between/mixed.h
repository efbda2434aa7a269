/*
 * Mixes of two frames' materials, views and meshes, for a moment between them. Numbers change linearly; enumerants and
 * switches are the base's. Each pair is mixed once.
 */
#pragma once

#include "base/table.h"
#include "scene/scene.h"

struct mixer {
	const struct scene *base, *other; /* the scene's base; the other frame */
	int is_back;       /* 1: the base is the second in time */
	double at;         /* [0,1], from the first to the second */
	float share;       /* share of the other frame */
	struct scene *out; /* arrays its own, with rooms below; begins as the base */
	uint32_t room_materials, room_units, room_lights, room_currents, room_views, room_meshes, room_programs;
	void **owned; /* arrays and structs that mixed meshes need */
	size_t n_owned, room_owned;
	struct table materials, currents, views, meshes, programs; /* pairs -> number + 1 */
	const double *camera; /* motion of still things in eye space; NULL: unknown */
	double camera_part[16]; /* its part at this moment */
};

/* base: index in the base; other: in the other frame. @return index in out; SCENE_NONE: no memory (reported) */
uint32_t mixed_material(struct mixer *m, uint32_t base, uint32_t other);
uint32_t mixed_current(struct mixer *m, uint32_t base, uint32_t other);
uint32_t mixed_view(struct mixer *m, uint32_t base, uint32_t other);

/** Meshes with the same points give the base's, others that suit each other a new one. */
uint32_t mixed_mesh(struct mixer *m, uint32_t base, uint32_t other);

/** 1 if all points of two meshes are the same, whatever else is not. */
int mixed_same_points(const struct scene_mesh *a, const struct scene_mesh *b);

/** 1 if two meshes differ by their points alone: the same triangles, attributes and texture coordinates. */
int mixed_suits(const struct scene_mesh *a, const struct scene_mesh *b);

/** Mix the colours of clears, if both frames have as many. */
void mixed_clears(struct mixer *m);

/** Free the tables; out's arrays and `owned` stay. */
void mixed_end(struct mixer *m);
