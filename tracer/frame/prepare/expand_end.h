/*
 * Ends of lines and centres of points: loading, clipping, projection to the window, interpolation.
 */
#pragma once

#include "tracer/frame/prepare/expand.h"

/* A vertex: attributes and window position, with y down as in llvmpipe. */
struct expand_end {
	struct shaded_vertex v;
	float clip_place[4]; /* eye-space position that clip planes are applied to */
	float texcoord[SCENE_MAX_UNITS][4];
	float x, y, z, w_inv;
	int cut;  /* 1: made by clipping */
	int edge; /* for a polygon's corner: 1 if the edge to the next corner (in point mode: this corner) is drawn */
};

/* Clip planes: those of the view volume, then the enabled ones of the program (GL 2.1 sec. 2.12), which clip in eye
 * space. */
enum { EXPAND_VOLUME_PLANES = 6, EXPAND_PLANES = EXPAND_VOLUME_PLANES + SCENE_MAX_CLIP_PLANES };

/** Load vertex v with the colours of one side (0 front, 1 back). Its window position is not computed yet. */
struct expand_end expand_load_end(const struct expand_input *in, uint32_t v, int side);

/** For flat shading: take the colour of another vertex of the primitive. */
void expand_take_color(struct expand_end *e, const struct expand_end *from);

/** Compute the window position, bit for bit as Mesa's vertex stage does, or as its clipper does for the ends that it
 * makes. */
void expand_project(const struct expand_input *in, struct expand_end *e);

/** Signed distance to a plane; 0 if the plane is not enabled. */
float expand_plane_distance(const struct expand_input *in, const struct expand_end *e, int plane);

/** Clip a line to the visible part. @return 0 if nothing is left */
int expand_clip_line(const struct expand_input *in, struct expand_end *a, struct expand_end *b);

/* Most corners of a triangle clipped by all planes. */
enum { EXPAND_CORNERS = 3 + EXPAND_PLANES };

/** 1 if a corner of a triangle lies beyond a plane. */
int expand_is_cut(const struct expand_input *in, const struct expand_end corners[3]);

/**
 * Clip a triangle to the visible part. Edges made by the program's clip planes are drawn, and those made by the view
 * volume are not. This follows Mesa (22.3.6); GL 2.1 sec. 3.5.4 draws neither.
 * @param corners  the triangle's three corners; receives those of the visible part. The first corner stays first if it
 *                 is visible
 * @return number of corners; 0 if nothing is left
 */
int expand_clip_triangle(const struct expand_input *in, struct expand_end corners[EXPAND_CORNERS]);

/** The point at fraction s of a projected line. Attributes are linear in the window, as in Mesa (22.3.6) where it
 * divides lines into dashes. */
struct expand_end expand_line_point(const struct expand_end *a, const struct expand_end *b, float s);
