/* Normals of round surfaces for meshes that a program shades flat, face by face. */
#pragma once

#include "scene/scene.h"

/**
 * A mesh with normals for the corners of its flat faces (scene_mesh.crease): the mean of the faces that meet there at
 * no more than an angle, by their angles at the corner (Thuermer and Wuethrich, "Computing Vertex Normals from
 * Polygonal Facets", 1998). Sharper edges stay. Corners meet where they are in one place, whatever vertices they have.
 * A face is flat where its corners have one normal.
 *
 * @param flat   1: all faces are, as under glShadeModel(GL_FLAT)
 * @param angle  degrees
 * @param out    receives a copy that borrows the mesh's arrays, to be given to free(); NULL: nothing is to be smoothed
 * @return 0 or ERR_SYSTEM (reported)
 */
int crease_smooth(const struct scene_mesh *mesh, int flat, float angle, struct scene_mesh **out);
