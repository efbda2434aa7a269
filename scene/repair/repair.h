/*
 * Closes cracks in meshes, which rays need and rasterization does not. Programs draw T-junctions, corners that only
 * nearly meet, and faces twice or wound the wrong way; light then leaks through, and glass has no inside.
 *
 *   weld        Places closer together than a tolerance become one, at the mean of those that differ. The vertices
 *               remain, with their own normals, texture coordinates and colours; only their positions become equal,
 *               bit for bit.
 *   junctions   An edge that other triangles' corners lie on, within the tolerance, gets these corners. New vertices
 *               interpolate all attributes of the edge's ends.
 *   drop        Triangles without area and duplicates are dropped, as are triangles narrower than the tolerance if the
 *               mesh has open edges.
 *   turn        On request: faces of a closed body are turned outwards, taking hollows into account; those of other
 *               meshes all to one side.
 *   merge       On request: places are removed where triangles lie in one plane, or meet in a straight edge, and
 *               attributes are linear (merge.h).
 *
 * Nothing else is filled: a real opening stays, and is reported as a leak. Triangles with a NaN or infinite corner are
 * left as they are and ignored. Tracing edges to find closed bodies, and mending junctions on the way, follows seed B
 * (a thesis on scene management, 2008).
 */
#pragma once

#include "scene/scene.h"

/* Default tolerance, as a share of the mesh's size. */
#define REPAIR_WELD 4e-6f
#define REPAIR_MOST_WELD 0.01f

struct repair_wants {
	float weld; /* tolerance: a share of the diagonal of the mesh's box, plus float rounding; 0: equal positions
	               only. At most REPAIR_MOST_WELD */
	int turn;
	int clockwise; /* 1: faces wind clockwise seen from outside; else counter-clockwise */
	int merge;
	int flat;      /* 1: a triangle's last vertex gives its colour, so new vertices take their triangle's */
};

/* The repairs made, and the resulting mesh. */
struct repair_found {
	uint32_t welded;    /* vertices that moved */
	uint32_t junctions; /* places inserted into edges */
	uint32_t dropped, turned; /* triangles */
	uint32_t merged;    /* places removed */
	uint32_t leaks;     /* edges with an odd number of triangles */
	uint32_t twisted;   /* edges with an even number, not half each way: neighbours face different sides */
	uint32_t shells;    /* parts connected by edges of two triangles */
	float leak_at[3];   /* middle of the longest leaking edge, in object space */
	int closed;         /* 1: has triangles, no leaks, nothing twisted */
	double volume;      /* if closed, in object space; positive if counter-clockwise outside */
};

/**
 * Repair a mesh.
 * @param mesh   triangles, all w 1; any other mesh is not repaired, and `found` is all 0
 * @param found  filled
 * @param out    receives a copy in one block, freed by free(); NULL if nothing changed
 * @return 0 or ERR_SYSTEM (reported)
 */
int repair_mesh(const struct scene_mesh *mesh, const struct repair_wants *wants, struct repair_found *found,
                struct scene_mesh **out);
