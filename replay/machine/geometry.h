/* Collected vertices, and how primitives are split into triangles, lines and points (GL 2.1 sec. 2.6.1). */
#pragma once

#include <stdint.h>

#include "replay/machine/state.h"
#include "scene/scene.h"

struct gls_exec;

#define GLS_MAX_PENDING_VERTICES (1u << 20)

/* Collected vertices. Arrays grow, and are kept when the vertices are cleared. */
struct gls_geometry {
	enum scene_primitive kind;
	uint32_t n_vertices, room_vertices;
	uint32_t varying; /* attributes that differ between vertices, as scene_mesh.attributes */
	float *position, *attribute[N_GLS_ATTRIBUTES]; /* 4 floats per vertex, for every attribute */
	struct scene_face (*face)[2]; /* if `varying` has SCENE_HAS_FACE */
	uint8_t *edge;  /* edge flag of each vertex */
	uint32_t *index, *primitive_draw;
	uint8_t *edge_flags;
	uint32_t n_primitives, room_primitives;
	uint32_t n_draws;        /* Begin..End pairs so far */
	uint32_t begin_vertex;   /* first vertex of the current Begin */
	uint32_t edges_told;     /* 1: an edge flag is off, or a primitive continues another */
	uint32_t quads;          /* 1: all primitives come from GL_QUADS */
	uint32_t touched;        /* bit set of attributes that may differ from `constant` by now: 1 << attribute */
	uint32_t given;          /* attributes that vertices have of their own in Mesa's vertex store, even if all alike: as
	                            gls_event.given */
	float constant[N_GLS_ATTRIBUTES][4]; /* values of the attributes that do not vary */
};

/** Forget all vertices. */
void gls_geometry_clear(struct gls_geometry *g);
void gls_geometry_free(struct gls_geometry *g);
/*
 * The following functions return 0, or ERR_SYSTEM (reported) if memory runs out; the replay then ends after this call
 * (gls_fail). On failure the geometry stays valid: existing arrays are kept, and every varying attribute has one.
 */
/** Make room for more vertices with the varying attributes, and for more primitives. */
int gls_geometry_reserve(struct gls_exec *x, struct gls_geometry *g, uint32_t n_vertices, uint32_t n_primitives);
/** Make an attribute vary: vertices so far get `constant`. */
int gls_geometry_vary(struct gls_exec *x, struct gls_geometry *g, unsigned attribute);
/** Make the material vary: vertices so far get `face`, front and back. */
int gls_geometry_vary_face(struct gls_exec *x, struct gls_geometry *g, const struct scene_face face[2]);
/** The kind that a primitive mode is split into: SCENE_TRIANGLES, LINES or POINTS; 0: not a GL mode. */
enum scene_primitive gls_mode_kind(uint32_t mode);
/**
 * Split vertices of a primitive mode as Mesa does, provoking vertex last.
 * @param elements  [count] vertex numbers, NULL: first .. first + count - 1
 * @param first_provokes  1: separate triangles, strips and fans follow FIRST_VERTEX_CONVENTION (ARB_provoking_vertex).
 *                        Lines keep their direction; the renderer decides
 */
int gls_geometry_cut(struct gls_exec *x, struct gls_geometry *g, uint32_t mode, uint32_t first, uint32_t count,
                     const uint32_t *elements, int first_provokes);
/**
 * Split quads along the other diagonal, from the first to the third vertex. The geometry must hold only quads. llvmpipe
 * does so for quads that are drawn without indices (hence not from lists), are smooth shaded and pass through none of
 * its pipeline stages: they are not stippled, need no clipping, and its setup handles offsets and two sides.
 */
void gls_geometry_turn_quads(struct gls_geometry *g);
/**
 * Turn line strips into separate lines if they follow or precede other strips or lines; each line then restarts the
 * stipple pattern. The geometry must hold only lines, all from a list: Mesa (22.3.6) treats them this way.
 */
void gls_geometry_part_strips(struct gls_geometry *g);
/**
 * 1 if quads are split along the other diagonal in this state.
 * @param is_flat  1: they are flat shaded (replay/build/program.h)
 * @param index  [n_primitives][3], as gls_geometry_cut makes them from GL_QUADS; vertices of incomplete quads are
 * ignored
 */
int gls_quads_turn(const struct gls_state *st, int is_flat, const float *position, const uint32_t *index,
                   uint32_t n_primitives);
