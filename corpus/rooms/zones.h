/*
 * Zones: the spaces that walls and portals close off. A walk over edges finds them. It goes from a face across each
 * edge to the next face: the first one met when turning about the edge through empty space. The faces of a walk are a
 * shell. A shell around empty space is a zone. A shell around solid matter (a floating block) belongs to the zone
 * around it.
 */
#pragma once

#include "mesh.h"

struct zone {
	double volume;   /* cubic metres of emptiness */
	size_t n_shells; /* 1, and as many as there are things that touch nothing in it */
	size_t n_faces;
	struct box box;
};

struct zones {
	struct zone *items;
	size_t n;
	size_t open_edges; /* edges of faces without a face on the other side; 0: every zone is closed */
};

/** Find the zones of a repaired mesh; the faces receive their zones. */
void zones_find(struct mesh *mesh, struct zones *zones);

/** The zone that an empty point is in; zones->n: none. */
size_t zones_at(const struct zones *zones, const struct mesh *mesh, struct vec p);

void zones_free(struct zones *zones);
