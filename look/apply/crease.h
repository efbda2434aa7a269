/* Smooth normals for round meshes that a program shades flat. */
#pragma once

#include "scene/scene.h"

/**
 * Make a mesh with normals for the corners of its flat faces (scene_mesh.crease). A normal is the mean of the faces
 * that meet there at no more than an angle, weighted by their angles at the corner (Thuermer and Wuethrich,
 * "Computing Vertex Normals from Polygonal Facets", 1998). Sharper edges stay. Corners meet if their positions are
 * equal, whatever their vertices. A face is flat if its corners have the same normal.
 *
 * @param flat   1: all faces are flat, as under glShadeModel(GL_FLAT)
 * @param angle  degrees
 * @param out    receives a copy that borrows the mesh's arrays, to be given to free(); NULL: there is nothing to
 * smooth
 * @return 0 or ERR_SYSTEM (reported)
 */
int crease_smooth(const struct scene_mesh *mesh, int flat, float angle, struct scene_mesh **out);
