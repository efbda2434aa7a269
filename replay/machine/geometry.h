/* Collected vertices, and how primitives are cut into triangles, lines and points (GL 2.1 sec. 2.6.1). */
#pragma once

#include <stdint.h>

#include "replay/machine/state.h"
#include "scene/scene.h"

struct gls_exec;

#define GLS_MAX_PENDING_VERTICES (1u << 20)

/* Collected vertices. Arrays grow, and are kept when the vertices are forgotten. */
struct gls_geometry {
	enum scene_primitive kind;
	uint32_t n_vertices, room_vertices;
	uint32_t varying; /* attributes that differ between vertices, as scene_mesh.attributes */
	float *position, *attribute[N_GLS_ATTRIBUTES]; /* 4 floats each, whatever the attribute */
	struct scene_face (*face)[2]; /* if `varying` has SCENE_HAS_FACE */
	uint8_t *edge;  /* edge flag of each vertex */
	uint32_t *index, *primitive_draw;
	uint8_t *edge_flags;
	uint32_t n_primitives, room_primitives;
	uint32_t n_draws;        /* Begin..End pairs so far */
	uint32_t begin_vertex;   /* first vertex of the open Begin */
	uint32_t edges_told;     /* any edge flag is off, or any primitive continues another */
	uint32_t quads;          /* 1: all primitives come from GL_QUADS */
	uint32_t touched;        /* attributes that may differ from `constant` by now: 1 << attribute */
	float constant[N_GLS_ATTRIBUTES][4]; /* values of attributes that do not vary */
};

/** Forget all vertices. */
void gls_geometry_clear(struct gls_geometry *g);
void gls_geometry_free(struct gls_geometry *g);
/*
 * What follows returns 0, or ERR_SYSTEM (reported) where memory is short: the replay ends after this call (gls_fail).
 * All that is collected keeps its arrays, and what varies has one.
 */
/** Make room for more vertices with the varying attributes, and for more primitives. */
int gls_geometry_reserve(struct gls_exec *x, struct gls_geometry *g, uint32_t n_vertices, uint32_t n_primitives);
/** Make an attribute vary: vertices so far get `constant`. */
int gls_geometry_vary(struct gls_exec *x, struct gls_geometry *g, unsigned attribute);
/** Make the material vary: vertices so far get `face`, front and back. */
int gls_geometry_vary_face(struct gls_exec *x, struct gls_geometry *g, const struct scene_face face[2]);
/** What a primitive mode is cut into: SCENE_TRIANGLES, LINES or POINTS; 0: GL has no such mode. */
enum scene_primitive gls_mode_kind(uint32_t mode);
/**
 * Cut vertices of a primitive mode as Mesa does, provoking vertex last.
 * @param elements  [count] vertex numbers, NULL: first .. first + count - 1
 * @param first_provokes  1: separate triangles, strips and fans follow FIRST_VERTEX_CONVENTION (ARB_provoking_vertex).
 *                        Lines have a
 *                  direction: whoever draws them decides
 */
int gls_geometry_cut(struct gls_exec *x, struct gls_geometry *g, uint32_t mode, uint32_t first, uint32_t count,
                     const uint32_t *elements, int first_provokes);
/**
 * Cut quads the other way, from the first to the third vertex. The geometry holds nothing but quads. llvmpipe does so
 * with quads that come without indices (hence not from lists), are shaded smoothly and go through none of its
 * stages: they are not stippled, need no clipping, and its setup does offsets and two sides.
 */
void gls_geometry_turn_quads(struct gls_geometry *g);
/**
 * Make lines of line strips that stand beside other strips or lines, each of which starts a stipple anew. The geometry
 * holds nothing but lines, which come from a list: Mesa (22.3.6) has them so.
 */
void gls_geometry_part_strips(struct gls_geometry *g);
/**
 * 1 if quads are cut the other way under this state.
 * @param is_flat  1: they are shaded flat (replay/build/program.h)
 * @param index  [n_primitives][3], as gls_geometry_cut makes them of GL_QUADS: vertices of quads that are not whole do
 * not count
 */
int gls_quads_turn(const struct gls_state *st, int is_flat, const float *position, const uint32_t *index,
                   uint32_t n_primitives);
