/*
 * Structs that the host and the kernels share, in addition to those of scene.h. Both C and OpenCL C 1.2 include this
 * file, so structs are plain: 4-byte fields, no pointers. SHARED_SIZE asserts their sizes when C includes it.
 *
 * Terms
 *   order      number of a primitive in the frame's draw order (scene.h)
 *   BLAS       bottom level: one mesh's triangles in object space; all BLASes share pools of nodes and triangles
 *   TLAS       top level: instances in eye space; one per view for camera rays, one per eye space for the others
 *   fragment   one primitive at one pixel centre, before any per-fragment operation
 */
#pragma once

#include "scene/scene.h"

#ifdef __OPENCL_VERSION__
typedef ushort uint16_t;
#define GLOBAL __global
#define SHARED_SIZE(type, bytes)
/* Marks a function that kernels call with constant arguments. Each kernel gets its own specialised copy, without the
 * branches that its constants rule out. Kernel interpreters (LANES_PORTABLE, kernels/rays/lanes.h) do not know the
 * attribute. */
#ifdef LANES_PORTABLE
#define INLINED static inline
#else
#define INLINED __attribute__((always_inline)) static inline
#endif
/* A kernel that is already vectorised. Without the hint, Intel's compiler also packs eight or sixteen work items into
 * vectors, which takes five times as long to compile and makes the kernels no faster. */
#define KERNEL_OF(vector) __kernel __attribute__((vec_type_hint(vector)))
#else
#define GLOBAL
#define SHARED_SIZE(type, bytes) _Static_assert(sizeof(type) == (bytes), #type)
#endif

/* A ray in eye space. d need not be normalised; t is measured in units of its length. */
struct ray {
	float o[3], t_min;
	float d[3], t_max;
};
SHARED_SIZE(struct ray, 32);

/* Nearest hit of a ray. instance == SCENE_NONE: none. b1, b2 weigh vertices 1 and 2 in object space. */
struct hit {
	float t, b1, b2;
	uint32_t instance;  /* index in the frame's instances */
	uint32_t primitive; /* number in the mesh */
};
SHARED_SIZE(struct hit, 20);

/*
 * A primitive at a pixel centre. b1, b2 are weights of vertices 1 and 2 on the SCREEN: linear in window space, not
 * perspective-correct; attributes divide by w (GL 2.1 equation 3.6). If a vertex has no place in the window
 * (window_vertex.w_inv == 0), FRAGMENT_PERSPECTIVE is set and the weights are already perspective-correct, in the
 * volume. fragment_weights handles both cases.
 */
#define FRAGMENT_PERSPECTIVE 0x80000000u
#define FRAGMENT_PRIMITIVE(fragment) ((fragment).primitive & ~FRAGMENT_PERSPECTIVE)

struct fragment {
	uint32_t order;     /* SCENE_NONE: no fragment */
	uint32_t instance;
	uint32_t primitive; /* number in the mesh, and FRAGMENT_PERSPECTIVE */
	float b1, b2;
	float depth;        /* window depth after depth range, before polygon offset, [0,1] */
};
SHARED_SIZE(struct fragment, 24);

/* A vertex in window space, snapped as llvmpipe does; w_inv <= 0 or a NaN: the primitive needs clipping, use clip. */
struct window_vertex {
	int32_t x, y; /* 1/256 pixel, origin lower left, relative to the pixel corner (0,0) of the drawable */
	float z;      /* window depth, after depth range */
	float w_inv;  /* 1 / clip w; 0 if the vertex lies outside the view volume or the safe range */
};
SHARED_SIZE(struct window_vertex, 16);

/* Longest path from a root to a leaf, in nodes: the size of the kernels' stacks. Then the bounds of an empty side. */
#define BVH_MAX_DEPTH 48
#define BVH_EMPTY_LO 1e30f
#define BVH_EMPTY_HI (-1e30f)

/* A binary node. It holds the bounds of both children, so a node is one fetch. */
struct node2 {
	float lo[2][3], hi[2][3];
	uint32_t child[2]; /* inner: index of the node; leaf: index of the first item */
	uint32_t count[2]; /* 0: inner; else the number of items in the leaf. An empty side has lo > hi */
};
SHARED_SIZE(struct node2, 64);

/* An eight-wide node in rows, for one ray against eight boxes at once. */
struct node8 {
	float lo[3][8], hi[3][8];
	uint32_t child[8], count[8]; /* as in node2; leaves point to blocks of eight triangles: child is the first block */
};
SHARED_SIZE(struct node8, 256);

/*
 * An eight-wide node in 80 bytes: five 16-byte loads on a GPU (Ylitie, Karras and Laine 2017, "Efficient incoherent ray
 * traversal on GPUs through compressed wide BVHs"). The children's boxes are quantised to a grid of 8 bits per axis
 * over the node's box, and always contain the exact boxes. Slot s holds the child that lies farthest along diagonal s
 * (a set bit means +axis), so visiting slots in the order of s ^ the ray's octant is roughly front to back without
 * sorting. kernels/rays/compressed.h reads it.
 */
struct node8c {
	float origin[3];    /* lower corner of the grid */
	uint32_t exponents; /* a byte each: float exponents of the grid's steps along x, y, z; a mask of slots with nodes */
	uint32_t child_first;    /* index of the first child node; child nodes are consecutive, in slot order */
	uint32_t triangle_first; /* in triangles8c */
	uint32_t meta[2]; /* a byte per slot, little end first: 0 for a node or nothing; else NODE8C_LEAF | (triangles - 1)
                       * << 5 | the first triangle, relative to triangle_first */
	uint32_t lo[3][2], hi[3][2]; /* a byte per slot; empty slots have lo 255, hi 0 */
};
SHARED_SIZE(struct node8c, 80);
#define NODE8C_LEAF 128u
#define NODE8C_LEAF_MAX 4u /* triangles; those of one node fit a 32-bit mask */
#define NODE8C_MAX_DEPTH (BVH_MAX_DEPTH + 4) /* BVH_MAX_DEPTH and a few more, for leaves that are too large */

/* One triangle of a BLAS in leaf order, object space, for geometric tests (Moeller and Trumbore 1997). */
struct triangle {
	float v0[3], e1[3], e2[3];
	uint32_t primitive;
	uint32_t vertex[3]; /* indices in the mesh, for tests on window vertices */
};
SHARED_SIZE(struct triangle, 52);

/* Eight triangles in rows; unused lanes are degenerate (all zero) with primitive SCENE_NONE. */
struct triangle8 {
	float v0[3][8], e1[3][8], e2[3][8];
	uint32_t primitive[8];
};
SHARED_SIZE(struct triangle8, 320);

/* Vertex indices in the mesh of the triangles of a triangle8, in the same lanes, for tests on window vertices. */
struct face8 {
	uint32_t vertex[3][8], primitive[8]; /* unused lanes: 0, and SCENE_NONE */
};
SHARED_SIZE(struct face8, 128);

/* bits of instance.flags */
#define INSTANCE_OPAQUE 1u       /* hides everything behind it: no part of the draw lets light through */
#define INSTANCE_SECONDARY 2u    /* met by secondary rays: depth-tested, and seen or solid (scene/depths.h) */
#define INSTANCE_CULL_FRONT 4u   /* camera rays ignore faces that are front in window space */
#define INSTANCE_CULL_BACK 8u
#define INSTANCE_FRONT_CW 16u    /* front faces run clockwise in window space */
#define INSTANCE_SCREEN 32u      /* geometry in window space (lines, points, pixel rectangles): the BLAS bounds x y in
                                  * pixels, and camera rays test it as points; never secondary */
/* drawn around the viewer before anything with depth: seen by secondary rays that hit nothing */
#define INSTANCE_SKY 128u
#define INSTANCE_PASS_COUNTER 256u   /* rays to lights pass triangles that run counter-clockwise as seen from the ray */
#define INSTANCE_PASS_CLOCKWISE 512u
#define INSTANCE_BAKED 64u       /* the modelview has no inverse or is projective: the BLAS is in eye space */

/* One instance as the kernels see it. */
struct instance {
	float eye_from_obj[12]; /* 3 rows of 4 */
	float obj_from_eye[12];
	uint32_t node2_first, node8_first, triangle_first, triangle8_first; /* start of its BLAS in each pool */
	uint32_t node8c_first, triangle8c_first;
	uint32_t vertex_first;    /* its first vertex in the frame's vertex buffers */
	uint32_t primitive_first; /* order number of its first primitive */
	uint32_t flags;
	float pad; /* added to its boxes for camera rays, object units: snapping moves edges by 1/256 pixel */
	uint32_t material, view;  /* indices in scene.h's arrays */
	uint32_t draw;
	uint32_t scene_instance;  /* index in scene.instances (screen geometry may be split into several instances) */
	uint32_t opacity;         /* how it stops rays to lights: kernels/rays/opacity.h */
	float centre[3], radius;  /* centre of its BLAS's box, object space; half of width + height + depth */
};
SHARED_SIZE(struct instance, 172);

/* One view as the camera kernels see it. */
struct view {
	float projection[16], inverse[16];
	float viewport[4];
	float depth_range[2];
	int32_t scissor[4];
	uint32_t tlas_first;    /* its TLAS: first node2 in the pool of top nodes. Leaves list instances */
	uint32_t tlas_count;    /* number of nodes; 0: nothing to hit */
	uint32_t screen_first;  /* screen instances of the view: instances[screen_first .. +screen_count) */
	uint32_t screen_count;
	int32_t sample[2];      /* sample position in each pixel, relative to its centre: 1/256 pixel to the right and up */
};
SHARED_SIZE(struct view, 192);

/**
 * Weights of a fragment's three vertices for attributes that are interpolated with perspective (GL 2.1 equation 3.6):
 * value = out[0] * a0 + out[1] * a1 + out[2] * a2.
 *
 * @param w_inv0, w_inv1, w_inv2  of the triangle's window vertices; ignored if FRAGMENT_PERSPECTIVE is set
 * @param out                     float[3], sum 1
 */
static inline void fragment_weights(struct fragment f, float w_inv0, float w_inv1, float w_inv2, float *out)
{
	const int perspective = (f.primitive & FRAGMENT_PERSPECTIVE) != 0;
	const float c0 = (1.0f - f.b1 - f.b2) * (perspective ? 1.0f : w_inv0);
	const float c1 = f.b1 * (perspective ? 1.0f : w_inv1);
	const float c2 = f.b2 * (perspective ? 1.0f : w_inv2);
	const float sum = c0 + c1 + c2;

	out[0] = c0 / sum;
	out[1] = c1 / sum;
	out[2] = c2 / sum;
}

/* --- Shading ----------------------------------------------------------------------------------------------------- */

/* Output of the vertex stage for one vertex of one instance. For texture coordinates, see geometry.texcoord_first. */
struct shaded_vertex {
	float clip[4];
	float eye[4];          /* homogeneous; w is 1 unless the modelview is projective */
	float color[2][4];     /* front and back side, clamped; [1] is the clip vertex if clip_by_program is set */
	float secondary[2][4]; /* rgb that "color sum" adds; [3] unused */
	float normal[3];       /* eye space, normalised only where GL does */
	float fog_coord;
	uint32_t lit[2];       /* per side, bit i: light i of the material's list adds diffuse or specular light here */
	float size[2]; /* points: [0] is the size after attenuation, before rounding; smooth lines: see below */
};
SHARED_SIZE(struct shaded_vertex, 128);

/* bits of geometry.flags */
#define GEOMETRY_EXPANDED 1u /* lines or points made into triangles after the vertex stage: not lit again */
/*
 * Smooth lines and points. Nothing else uses their vertices' color[1], so it holds what the coverage needs
 * (stage_coverage):
 *   line   pixels across the line; half its width and a half; pixels along it from its middle; half its length and a
 *          half. For lines shorter than a pixel the last two are smaller, so that lines fade as they get shorter.
 *          size[] holds the corner's window position in pixels, y from the top, not snapped; taken from clip it would
 *          lose its last bits
 *   point  x and y in its circle of radius 1; where its rim begins, as the square of a radius
 */
#define GEOMETRY_SMOOTH_LINE 2u
#define GEOMETRY_SMOOTH_POINT 4u
/* Smooth lines whose coverage of a pixel is limited to their length. */
#define GEOMETRY_LENGTH_COVERS 32u
/* Bitmaps and pixel rectangles: color[1] holds the pixel's column and row, the texture's number, and the kind
 * (SCENE_BITMAP ..). */
#define GEOMETRY_PIXELS 8u
/*
 * Lines: color[1] of each corner holds the window position of its end (x, y from the top, depth), then 0 for the first
 * end or 1 for the second. secondary[1] limits which pixels are drawn: first column, first and last row from the top.
 */
#define GEOMETRY_LINE 16u

/* scene_instance.given in geometry.attributes: the same bits times this. */
#define GEOMETRY_GIVEN SCENE_HAS_FACE

/* One instance as the vertex and fragment stages see it, at the same index as its struct instance. */
struct geometry {
	float eye_from_obj[16], clip_from_obj[16];
	float normal_matrix[12]; /* 3 rows of 4: inverse transpose of the modelview, rescaled if GL rescales it */
	uint32_t attributes;     /* as scene_mesh.attributes; GEOMETRY_GIVEN .. */
	uint32_t position, normal, color, secondary, fog_coord; /* start of each array in the pool of floats */
	uint32_t texcoord[SCENE_MAX_UNITS], face;
	uint32_t generics;        /* start of each generic array that `attributes` has, in order */
	uint32_t crease;         /* start of the creases in the pool of floats; SCENE_NONE: none */
	uint32_t index;          /* start of its indices in the pool, 3 per primitive, relative to vertex_first */
	uint32_t primitive_draw; /* start of its draw numbers in the pool of indices; SCENE_NONE: a single draw */
	uint32_t vertex_first;   /* its first vertex in the frame's vertex buffers */
	uint32_t vertex_count;
	uint32_t texcoord_first; /* its first [4] in the frame's texture coordinates: unit_count of them per vertex */
	uint32_t material, view, current, draw, flags;
	float away; /* largest absolute eye coordinate of the object space's origin */
};
SHARED_SIZE(struct geometry, 288);

#define TEXTURE_MAX_LEVELS 16

/* One texture image as the samplers see it. */
struct texture_image {
	uint32_t target, base_format; /* GL tokens */
	uint32_t width, height, depth, n_levels, border;
	uint32_t words; /* four-byte words per texel: 4 for floats, else 1 */
	uint32_t level_first[TEXTURE_MAX_LEVELS]; /* first word in the pool of texels */
};
SHARED_SIZE(struct texture_image, 96);

/* A fragment's colours as the per-fragment operations read them. */
struct shaded {
	float gl[4];       /* GL's own colour: after texturing, colour sum and fog, clamped */
	float shadowed[3]; /* gl with the visibility of its lights applied */
	float direct[3];   /* shadowed, but lit per pixel if requested, and with light from other surfaces */
	float mirrored[3]; /* direct with mirror reflections */
	float beauty[3];   /* mirrored with refractions */
	float albedo[3];   /* the surface under white light, without fog */
	float depth;       /* window depth after polygon offset, [0,1] */
	uint32_t flags;    /* SHADED_*; 0: there is no fragment */
};
SHARED_SIZE(struct shaded, 84);

#define SHADED_THERE 1u
#define SHADED_FRONT 2u
#define SHADED_DRAWN 8u   /* it passed all tests on the first sample; see PIXEL_FOLLOWS */
#define SHADED_STENCIL 4u /* not a fragment but a value for the stencil buffer, held in depth */
#define SHADED_WANTS(slot) (0x100u << (slot)) /* light `slot` of the material's list needs a shadow ray */

/*
 * A path from a fragment: the weight of the radiance it finds, and where it is added. Its ray is in a separate buffer,
 * at the same index.
 */
struct path {
	float weight[3];
	uint32_t target; /* fragment in the list; for rays to lights: slot * n + item */
	uint32_t kind;   /* PATH_*: part of the fragment that it adds to; for rays to lights: as in shadow_walk */
	uint32_t depth;  /* bounces so far, not counting the fragment's own */
	uint32_t medium; /* material of the body it travels in, or SCENE_NONE */
	float density;   /* density of the scattered directions, per steradian; 0: not sampled */
};
SHARED_SIZE(struct path, 32);

/* Light that mirrors and glass redirected meets a surface that receives it (kernels/frame/light/photon.h). */
struct photon {
	float position[3], length;    /* eye space; of its whole path from the light */
	float direction[3];           /* unit direction of travel on arrival */
	uint32_t number;              /* index among the photons sent; SCENE_NONE: none arrived here */
	float weight[3];              /* the share of its light that is left for the surface to scatter */
	uint32_t material;            /* the surface's material */
};
SHARED_SIZE(struct photon, 48);

/* Queries: kernels/rays/query.h. A point and its search radius. */
struct query_point {
	float p[3], most;
};
SHARED_SIZE(struct query_point, 16);

/* The surface nearest to a point. */
struct query_nearest {
	float distance;
	float p[3];         /* the nearest point */
	uint32_t primitive; /* SCENE_NONE: nothing is within the radius, and the other fields are not set */
};
SHARED_SIZE(struct query_nearest, 20);

/* An axis-aligned box, or a sphere, that moves from `centre` to `centre` + `move`. */
struct query_body {
	float centre[3];
	float size[3]; /* half the box's edges; size[0]: the sphere's radius */
	float move[3];
};
SHARED_SIZE(struct query_body, 36);

/* The first contact of a body. */
struct query_contact {
	float t;            /* [0,1], share of its movement; 0 if it touches something before it moves */
	uint32_t primitive; /* SCENE_NONE: no contact */
};
SHARED_SIZE(struct query_contact, 8);

/* A hook's answer for a fragment: kernels/frame/hook/hook.h. */
struct hook_answer {
	float color[3], direction[3], weight[3]; /* direction, weight: those of the ray that continues */
	uint32_t what;                           /* bits: RELUME_* */
};
SHARED_SIZE(struct hook_answer, 40);

/* The object that a hook's intersection function represents: an instance whose triangles no ray meets. */
struct hook_object {
	float obj_from_eye[12];    /* 3 rows of 4 */
	float lower[3], upper[3];  /* its box, object space */
	uint32_t instance, material, draw;
};
SHARED_SIZE(struct hook_object, 84);

/* An emissive triangle, in the list of all in its eye space. */
struct emitter {
	float end;               /* cumulative share of the list's light up to and including this triangle: rises to 1 */
	uint32_t instance, primitive; /* as in struct hit */
};
SHARED_SIZE(struct emitter, 12);

#define PATH_DIFFUSE 0u
#define PATH_REFLECT 1u
#define PATH_REFRACT 2u
/* as PATH_REFLECT; if it hits nothing, the fragment's own colour replaces what it would find */
#define PATH_NEAR 3u

/* Maximum number of rays that leave a fragment, and a hit: mirrored, transmitted, scattered. */
#define PATHS_PER_FRAGMENT 3u
#define PATHS_PER_HIT 2u

/* How a point is lit and which rays it sends. */
#define TRANSPORT_GL 0u      /* GL's lighting, from the vertices; mirrors and glass */
#define TRANSPORT_RELIGHT 1u /* the same, but lit per pixel */
#define TRANSPORT_DIFFUSE 2u /* GL's lighting and one bounce between surfaces */
#define TRANSPORT_PATH 3u    /* no ambient light, but light between surfaces in its place; in GL's numbers */
#define TRANSPORT_LINEAR 4u  /* the same in linear light, which GL's colours are taken to be */

/* How a pixel's surface receives light from the dome. */
struct dome_place {
	float from[3];   /* rays start here, eye space */
	float strength;  /* share of its colour that is not fog; 0: it receives none of this light */
	float normal[3]; /* on the visible side */
	float padding;   /* pads the struct to the size of a ray */
};
SHARED_SIZE(struct dome_place, 32);

/* A rectangle of pixels: x0 <= x < x1, y0 <= y < y1; empty ones have x0 == x1. */
struct camera_rectangle {
	int32_t x0, y0, x1, y1;
};

/* A depth clear between looks (kernels/frame/plain/plain.h), limited to a rectangle of the band. */
struct layer_clear {
	uint32_t look; /* the look that follows it */
	int32_t x0, y0, x1, y1;
	uint32_t depth; /* in the depth buffer's format */
	float depth_exact;
};
SHARED_SIZE(struct layer_clear, 28);

/* One pixel of the frame while it is being drawn. */
struct frame_pixel {
	float gl[4], shadowed[3], direct[3], mirrored[3], beauty[3]; /* as in struct shaded */
	uint32_t depth;    /* as the depth buffer holds it: in integer steps */
	float depth_exact; /* the same before quantisation, [0,1] */
	uint32_t stencil;
	uint32_t id;       /* draw that last wrote the colour; 0: cleared only */
	struct fragment surface; /* the nearest visible surface; order SCENE_NONE: none */
	float albedo[3];         /* the surface's albedo */
	uint32_t layers;         /* fragments blended into the colour since it was last cleared or overwritten */
	uint32_t unknown;        /* PIXEL_UNKNOWN_* */
};
SHARED_SIZE(struct frame_pixel, 124);

/* Parts of a pixel that date from before the scene and are unknown. */
#define PIXEL_UNKNOWN_COLOR 1u
#define PIXEL_UNKNOWN_DEPTH 2u
#define PIXEL_UNKNOWN_STENCIL 4u
#define PIXEL_UNKNOWN_TEST 8u /* a test compared with an unknown value */
#define PIXEL_BEFORE 16u      /* its colour dates from before the scene, but is known; cleared only with the colour */

/*
 * Planes of a finished picture, as the kernel compose writes them, top row first: some as halves, the others as floats.
 * tracer/frame/picture/compose.c names them.
 */
#define COMPOSE_BEAUTY 0u /* R G B A */
#define COMPOSE_GL 4u     /* R G B A */
#define COMPOSE_SHADOW 8u /* R G B, like all planes up to ALBEDO except the normal's X Y Z */
#define COMPOSE_RELIGHT 11u
#define COMPOSE_REFLECT 14u
#define COMPOSE_REFRACT 17u
#define COMPOSE_NORMAL 20u
#define COMPOSE_ALBEDO 23u
#define N_COMPOSE_HALVES 26u
#define COMPOSE_DEPTH 0u /* floats: gl.depth */
#define COMPOSE_Z 1u
#define COMPOSE_POSITION 2u /* X Y Z */
#define COMPOSE_ID 5u
#define COMPOSE_LAYERS 6u
#define N_COMPOSE_FLOATS 7u

/* The planes that the kernel compose is asked for, and how. */
struct compose_request {
	uint32_t half_plane[N_COMPOSE_HALVES];  /* start of each plane in the buffer of halves; SCENE_NONE: not wanted */
	uint32_t float_plane[N_COMPOSE_FLOATS]; /* the same in the buffer of floats */
	uint32_t n_halves, n_floats; /* number of planes in each buffer, where they are consecutive */
	uint32_t width, height; /* size of the planes in pixels */
	uint32_t n_passes; /* number of passes that the parts are the means of */
	uint32_t display;  /* 1: GL's numbers, 0: linear light */
	uint32_t normals;  /* 1: the beauty shows normals as colours */
	uint32_t radiant;  /* 1: passes are averaged in linear light */
};
SHARED_SIZE(struct compose_request, 164);

/*
 * Pixels of a row that one work item of resolve_packet handles, and the number of such rows that one of compose_packet
 * handles.
 */
#define FRAME_ROW 16u
#define COMPOSE_ROWS 8u

/* Number of these blocks in a row of the picture. */
static inline uint32_t frame_columns(uint32_t width)
{
	return (width + FRAME_ROW - 1u) / FRAME_ROW;
}

/* Fragments per work item of shade_packet, and rays per work item of shadow_ray_packet: in frames with one fragment per
 * pixel, a block of the list (tracer/frame/bands/segment.c). Also the number of triangles that a work item caches by
 * number, as neighbours mostly have close numbers. */
#define SHADE_PACKET 64u
#define SHADE_TRIANGLES 8u

/* Vertices per work item of vertex_packet. */
#define VERTEX_PACKET 256u

/* Pixels per work item of plain and plain_shadow: columns, rows. */
#define PLAIN_WIDTH 16u
#define PLAIN_ROWS 4u

/* Values of a pixel that are averaged over all passes: shadowed, direct, mirrored, beauty. */
#define PASS_PARTS 12u
