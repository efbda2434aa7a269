/* Culling: finds the walls that may be visible from a viewpoint, in five ways. None drops a visible wall. */
#pragma once

#include "bsp.h"
#include "octree.h"
#include "zones.h"

enum culling { CULL_NONE, CULL_FRUSTUM, CULL_PORTAL, CULL_BSP, CULL_OCTREE, N_CULLINGS };

extern const char *const culling_names[N_CULLINGS];

enum { FRUSTUM_MAX_PLANES = WINDING_MAX };

/* A visible space: in front of all planes. */
struct frustum {
	struct plane planes[FRUSTUM_MAX_PLANES];
	int n_planes;
};

struct view {
	struct vec eye;
	double yaw_deg, pitch_deg, field_deg, aspect; /* yaw 0 looks along -z, 90 along +x; the field is vertical */
};

/* A level with everything computed from it. */
struct world {
	struct mesh mesh;
	struct zones zones;
	struct bsp bsp;
	struct octree octree;
};

/** The space that a view shows, without near and far planes. */
struct frustum frustum_of(const struct view *view);

/**
 * Find the faces to draw.
 * @param visible  [n_faces] receives 1 for faces to draw, 0 for others and for portals
 * @return number of faces to draw
 */
size_t cull(const struct world *world, const struct view *view, enum culling how, unsigned char *visible);
