/*
 * Convex polygons as points, counter-clockwise as seen from the front of their plane: what brushes are made of and cut
 * by.
 */
#pragma once

#include "vec.h"

enum { WINDING_MAX = 64 };

/* Nearer than this to a plane is on it. */
#define ON_PLANE 1e-5

struct winding {
	int n; /* 0: nothing is left */
	struct vec p[WINDING_MAX];
};

/** A square in the plane, so large that it holds every level. */
struct winding winding_of_plane(struct plane plane);

/**
 * Cut a winding by a plane.
 * @param front, back  receive the parts; empty where there is none. A winding in the plane is in neither. Either may be
 * NULL.
 * @return 1 where both parts are there
 */
int winding_split(const struct winding *w, struct plane plane, struct winding *front, struct winding *back);

struct winding winding_reverse(const struct winding *w);
struct vec winding_centre(const struct winding *w);
double winding_area(const struct winding *w);
struct plane winding_plane(const struct winding *w);
struct box winding_box(const struct winding *w);
