/*
 * Ends of lines and centres of points on their way into the window: loaded, clipped, projected, mixed.
 */
#pragma once

#include "tracer/frame/expand.h"

/* A vertex: attributes, and its place in the window, y down as llvmpipe counts. */
struct expand_end {
	struct shaded_vertex v;
	float clip_place[4]; /* by which clip planes clip, in eye space */
	float texcoord[SCENE_MAX_UNITS][4];
	float x, y, z, w_inv;
	int cut;  /* clipping made it */
	int edge; /* of a polygon's corner: the edge to the next corner, and in point mode this corner, are drawn */
};

/* The planes that cut: the view volume's, then those of the program that are enabled (GL 2.1 sec. 2.12), which cut in
 * eye space. */
enum { EXPAND_VOLUME_PLANES = 6, EXPAND_PLANES = EXPAND_VOLUME_PLANES + SCENE_MAX_CLIP_PLANES };

/** Vertex v with the colours of one side (0 front, 1 back); its place in the window stays to be found. */
struct expand_end expand_load_end(const struct expand_input *in, uint32_t v, int side);

/** Flat shading: the colour of another vertex of the primitive. */
void expand_take_color(struct expand_end *e, const struct expand_end *from);

/** Find the place in the window, to the bits of Mesa's vertex stage, or of its clipper for ends that it made. */
void expand_project(const struct expand_input *in, struct expand_end *e);

/** Signed distance to a plane; 0 for one that is not enabled. */
float expand_plane_distance(const struct expand_input *in, const struct expand_end *e, int plane);

/** Cut a line to what can be seen. @return 0 where nothing is left */
int expand_clip_line(const struct expand_input *in, struct expand_end *a, struct expand_end *b);

/* Corners that a triangle may have when all planes have cut it. */
enum { EXPAND_CORNERS = 3 + EXPAND_PLANES };

/** 1 if a corner of a triangle lies beyond a plane. */
int expand_is_cut(const struct expand_input *in, const struct expand_end corners[3]);

/**
 * Cut a triangle to what can be seen. Of the edges that the planes make, those along the program's own are drawn, those
 * along the view volume's are not: Mesa (22.3.6) has it so, GL 2.1 sec. 3.5.4 draws none of either.
 * @param corners  the triangle's three; replaced by what is left, of which the first is still the first if it is there
 * @return how many corners; 0 where nothing is left
 */
int expand_clip_triangle(const struct expand_input *in, struct expand_end corners[EXPAND_CORNERS]);

/** The point at share s of a projected line. Mesa (22.3.6) has attributes linear in the window where it cuts lines into
 * dashes. */
struct expand_end expand_line_point(const struct expand_end *a, const struct expand_end *b, float s);
