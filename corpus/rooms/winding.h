/*
 * Convex polygons as lists of points, counter-clockwise seen from the front of their plane. The sides of brushes, and
 * the results of cutting them. Lengths are metres.
 */
#pragma once

#include "vec.h"

enum { WINDING_MAX = 64 }; /* most points; further ones are dropped */

/* A point closer than this to a plane lies on it. */
#define ON_PLANE 1e-5

struct winding {
	int n; /* 0: empty */
	struct vec p[WINDING_MAX];
};

/** A square in the plane, large enough to contain every level. */
struct winding winding_of_plane(struct plane plane);

/**
 * Cut a winding by a plane.
 * @param front, back  receive the parts, which may be empty. A winding in the plane is in neither. Either may be NULL.
 * @return 1 if both parts exist
 */
int winding_split(const struct winding *w, struct plane plane, struct winding *front, struct winding *back);

/** The same polygon seen from behind. */
struct winding winding_reverse(const struct winding *w);

/** The mean of the points; at least one. */
struct vec winding_centre(const struct winding *w);
double winding_area(const struct winding *w);

/** The plane that contains a winding, with its front; the area must not be 0. */
struct plane winding_plane(const struct winding *w);
struct box winding_box(const struct winding *w);
