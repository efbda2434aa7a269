/*
 * Zones: spaces enclosed by walls and portals, found by walking over edges. A walk goes from a face across each edge to
 * the next face: the first one met when turning about the edge through empty space. The faces of a walk are a shell. A
 * shell around empty space is a zone. A shell around solid matter (a floating block) belongs to the zone around it.
 */
#pragma once

#include "mesh.h"

struct zone {
	double volume;   /* empty space, cubic metres */
	size_t n_shells; /* 1, plus one for each object in it that touches nothing */
	size_t n_faces;
	struct box box;
};

struct zones {
	struct zone *items;
	size_t n;
	size_t open_edges; /* edges with a face on one side only; 0: every zone is closed */
};

/** Find the zones of a repaired mesh, and set those of its faces. */
void zones_find(struct mesh *mesh, struct zones *zones);

/** The zone that contains an empty point; zones->n: none. */
size_t zones_at(const struct zones *zones, const struct mesh *mesh, struct vec p);

void zones_free(struct zones *zones);
