/* What has to be drawn: walls that may be seen from a place, found in five ways. None leaves out a wall that shows. */
#pragma once

#include "bsp.h"
#include "octree.h"
#include "zones.h"

enum culling { CULL_NONE, CULL_FRUSTUM, CULL_PORTAL, CULL_BSP, CULL_OCTREE, N_CULLINGS };

extern const char *const culling_names[N_CULLINGS];

enum { FRUSTUM_MAX_PLANES = WINDING_MAX };

/* The space that is looked into: in front of all planes. */
struct frustum {
	struct plane planes[FRUSTUM_MAX_PLANES];
	int n_planes;
};

struct view {
	struct vec eye;
	double yaw_deg, pitch_deg, field_deg, aspect; /* yaw 0 looks along -z, 90 along +x; the field is vertical */
};

/* A level with all that was made of it. */
struct world {
	struct mesh mesh;
	struct zones zones;
	struct bsp bsp;
	struct octree octree;
};

struct frustum frustum_of(const struct view *view);

/**
 * @param visible  [n_faces] receives 1 for what is to be drawn, 0 for the rest and for portals
 * @return how many
 */
size_t cull(const struct world *world, const struct view *view, enum culling how, unsigned char *visible);
