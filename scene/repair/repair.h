/*
 * Meshes without cracks: what rays need and rasterization forgives. Programs draw T-junctions, corners that meet only
 * nearly, faces twice or the wrong way round; light then leaks through, and glass has no inside.
 *
 *   weld        Places nearer to each other than a tolerance become one: the mean of those that differ. Vertices stay
 *               as many as they were, with normals, texture coordinates and colours of their own; only their positions
 *               become equal, bit for bit.
 *   junctions   An edge that other triangles' corners lie on, within the tolerance, gets them as corners of its own.
 *               New vertices lie between the edge's two in all attributes.
 *   drop        Triangles without area, those narrower than the tolerance where the mesh has open edges, and those that
 *               are there twice.
 *   turn        On request: faces of a closed body look outwards, hollows inside it count; those of other meshes all to
 *               one side.
 *   merge       On request: places go where triangles lie in one plane, or meet in a straight edge, and go on evenly
 *               (merge.h).
 *
 * Nothing else is filled: a real opening stays, and is told as a leak. Triangles with a corner that is no number stay
 * as they are and count for nothing. The idea of tracing edges for closed bodies, with junctions mended on the way, is
 * seed B's (a thesis on scene management, 2008).
 */
#pragma once

#include "scene/scene.h"

/* The tolerance, as a share of the mesh's size, where nobody asks for another. */
#define REPAIR_WELD 4e-6f
#define REPAIR_MOST_WELD 0.01f

struct repair_wants {
	float weld; /* the tolerance: a share of the diagonal of the mesh's box, and what floats round; 0: equal
	               positions only. At most REPAIR_MOST_WELD */
	int turn;
	int clockwise; /* 1: faces are seen clockwise from outside; else counter-clockwise */
	int merge;
	int flat;      /* 1: the last vertex of a triangle gives its colour, so new vertices take their triangle's */
};

/* What was done, and what the mesh is now. */
struct repair_found {
	uint32_t welded;    /* vertices that moved */
	uint32_t junctions; /* places that edges got as corners */
	uint32_t dropped, turned; /* triangles */
	uint32_t merged;    /* places that went */
	uint32_t leaks;     /* edges of an odd number of triangles */
	uint32_t twisted;   /* edges of an even number, of which not half run each way: neighbours look to different sides */
	uint32_t shells;    /* parts that hang together by edges of two triangles */
	float leak_at[3];   /* the middle of the longest edge that leaks, in object space */
	int closed;         /* 1: no leaks, nothing twisted, and there are triangles */
	double volume;      /* where closed, in object space; counter-clockwise outside counts as positive */
};

/**
 * @param mesh   of triangles, all w 1; of another one nothing is repaired, and `found` is all 0
 * @param found  filled
 * @param out    receives a copy, to be given to free(): one block; NULL where nothing changed
 * @return 0 or ERR_SYSTEM (reported)
 */
int repair_mesh(const struct scene_mesh *mesh, const struct repair_wants *wants, struct repair_found *found,
                struct scene_mesh **out);
