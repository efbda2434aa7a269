/*
 * Structs that host and kernels share, beside those of scene.h. C and OpenCL C 1.2 include this file, so structs are
 * plain: fields of 4 bytes, no pointers. SHARED_SIZE asserts their sizes when C includes it.
 *
 * Terms
 *   order      number of a primitive in the frame's draw order (scene.h)
 *   BLAS       bottom level: one mesh's triangles in object space; all BLASes share pools of nodes and triangles
 *   TLAS       top level: instances in eye space; one per view for camera rays, one per eye space for the others
 *   fragment   what one primitive leaves at one pixel centre, before any per-fragment operation
 */
#pragma once

#include "scene/scene.h"

#ifdef __OPENCL_VERSION__
typedef ushort uint16_t;
#define GLOBAL __global
#define SHARED_SIZE(type, bytes)
/* Marks a function that kernels call with constants: each kernel then gets a version of its own, without the branches
 * that its constants rule out. Interpreters of kernels (LANES_PORTABLE, kernels/rays/lanes.h) do not know the
 * attribute. */
#ifdef LANES_PORTABLE
#define INLINED static inline
#else
#define INLINED __attribute__((always_inline)) static inline
#endif
/* A kernel that computes in vectors by itself. Intel's compiler would pack eight or sixteen work items into vectors as
 * well: it takes five times as long for that, and the kernels are no faster. */
#define KERNEL_OF(vector) __kernel __attribute__((vec_type_hint(vector)))
#else
#define GLOBAL
#define SHARED_SIZE(type, bytes) _Static_assert(sizeof(type) == (bytes), #type)
#endif

/* A ray in eye space; d need not be normalised, t counts in its length. */
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
 * perspective-correct; attributes divide by w (GL 2.1 equation 3.6). Where a vertex has no place in the window
 * (window_vertex.w_inv == 0), FRAGMENT_PERSPECTIVE is set and they are weights in the volume, perspective-correct as
 * they stand. fragment_weights knows both.
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
	float w_inv;  /* 1 / clip w; 0 where the vertex lies outside of the view volume or the safe range */
};
SHARED_SIZE(struct window_vertex, 16);

/* Longest path from a root to a leaf, in nodes: the size of the kernels' stacks. Bounds of an empty side. */
#define BVH_MAX_DEPTH 48
#define BVH_EMPTY_LO 1e30f
#define BVH_EMPTY_HI (-1e30f)

/* A binary node: bounds of both children, so that a node is one fetch. */
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
 * An eight-wide node in 80 bytes, five loads of a GPU (Ylitie, Karras and Laine 2017, "Efficient incoherent ray
 * traversal on GPUs through compressed wide BVHs"). The children's boxes lie on a grid of 8 bits an axis over the
 * node's box; each box contains the one it stands for. Slot s holds the child that lies farthest along diagonal s (bit
 * a set: along +a). A ray then meets slots about in the order of s ^ its octant, with nothing to sort.
 * kernels/rays/compressed.h reads it.
 */
struct node8c {
	float origin[3];    /* lower corner of the grid */
	uint32_t exponents; /* bytes: of the grid's steps along x, y, z, as in a float; the last: a bit for each slot
	                       that is a node */
	uint32_t child_first;    /* nodes among the children stand one after the other, in the order of their slots */
	uint32_t triangle_first; /* in triangles8c */
	uint32_t meta[2]; /* a byte a slot, little end first: 0 for a node or nothing; else NODE8C_LEAF | (triangles -
	                     1) << 5 | the first triangle, counted from triangle_first */
	uint32_t lo[3][2], hi[3][2]; /* a byte a slot; nothing: lo 255, hi 0 */
};
SHARED_SIZE(struct node8c, 80);
#define NODE8C_LEAF 128u
#define NODE8C_LEAF_MAX 4u /* triangles; those of a node fit a mask of 32 bits */
#define NODE8C_MAX_DEPTH (BVH_MAX_DEPTH + 4) /* as BVH_MAX_DEPTH; a few more, for leaves that are too large */

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

/* The corners of the triangles of a triangle8, in the same lanes, for tests on window vertices: indices in the mesh. */
struct face8 {
	uint32_t vertex[3][8], primitive[8]; /* unused lanes: 0, and SCENE_NONE */
};
SHARED_SIZE(struct face8, 128);

/* bits of instance.flags */
#define INSTANCE_OPAQUE 1u       /* hides what lies behind it: nothing of the draw lets light through */
#define INSTANCE_SECONDARY 2u    /* met by secondary rays: depth-tested, and seen or solid (scene/depths.h) */
#define INSTANCE_CULL_FRONT 4u   /* camera rays pass faces that are front in window space */
#define INSTANCE_CULL_BACK 8u
#define INSTANCE_FRONT_CW 16u    /* front faces run clockwise in window space */
#define INSTANCE_SCREEN 32u      /* geometry in window space (lines, points, pixel rectangles): the BLAS bounds x y in
                                    pixels, camera rays meet it as points; never secondary */
/* drawn before all depth, around the viewer: seen by secondary rays that hit nothing */
#define INSTANCE_SKY 128u
#define INSTANCE_PASS_COUNTER 256u   /* rays to lights pass triangles whose corners they see run counter-clockwise */
#define INSTANCE_PASS_CLOCKWISE 512u
#define INSTANCE_BAKED 64u       /* the modelview has no inverse or is projective: the BLAS is in eye space */

/* One instance as the kernels see it. */
struct instance {
	float eye_from_obj[12]; /* 3 rows of 4 */
	float obj_from_eye[12];
	uint32_t node2_first, node8_first, triangle_first, triangle8_first; /* where its BLAS lies in the pools */
	uint32_t node8c_first, triangle8c_first;
	uint32_t vertex_first;    /* its first vertex in the frame's vertex buffers */
	uint32_t primitive_first; /* order number of its first primitive */
	uint32_t flags;
	float pad; /* by how much camera rays widen its boxes, object units: snapping moves edges by 1/256 pixel */
	uint32_t material, view;  /* in scene.h's arrays */
	uint32_t draw;
	uint32_t scene_instance;  /* index in scene.instances (screen geometry may split one up) */
	float centre[3], radius;  /* of its BLAS, object space: half the box's width, height and depth together */
};
SHARED_SIZE(struct instance, 168);

/* One view as the camera kernels see it. */
struct view {
	float projection[16], inverse[16];
	float viewport[4];
	float depth_range[2];
	int32_t scissor[4];
	uint32_t tlas_first;    /* its TLAS: first node2 in the pool of top nodes; leaves list instances */
	uint32_t tlas_count;    /* nodes in it; 0: nothing to hit */
	uint32_t screen_first;  /* screen instances of the view: instances[screen_first .. +screen_count) */
	uint32_t screen_count;
	int32_t sample[2];      /* where in its pixels it looks: 1/256 pixel right of and above their centres */
};
SHARED_SIZE(struct view, 192);

/**
 * Weights of a fragment's three vertices for attributes that are interpolated with perspective (GL 2.1 equation 3.6):
 * value = out[0] * a0 + out[1] * a1 + out[2] * a2.
 *
 * @param w_inv0, w_inv1, w_inv2  of the triangle's window vertices; not looked at where FRAGMENT_PERSPECTIVE is set
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

/* What the vertex stage leaves of one vertex of one instance. Texture coordinates: see geometry.texcoord_first. */
struct shaded_vertex {
	float clip[4];
	float eye[4];          /* homogeneous; w is 1 unless the modelview is projective */
	float color[2][4];     /* front and back side, clamped; [1] is the clip vertex where clip_by_program says so */
	float secondary[2][4]; /* rgb after which "color sum" asks; [3] unused */
	float normal[3];       /* eye space, normalised only where GL does */
	float fog_coord;
	uint32_t lit[2];       /* per side, bit i: light i of the material's list adds diffuse or specular light here */
	float size[2]; /* of a point: [0], after attenuation, before rounding. Of a smooth line's corner: its place, see
	                  below */
};
SHARED_SIZE(struct shaded_vertex, 128);

/* bits of geometry.flags */
#define GEOMETRY_EXPANDED 1u /* lines or points made into triangles after the vertex stage: nothing to light again */
/*
 * Smooth ones: nothing else uses their vertices' color[1], so it holds their place for the coverage (stage_coverage).
 *   line   pixels across the line; half its width and a half; pixels along it from its middle; half its length and a
 *          half. For lines shorter than a pixel the last two are smaller, so that lines fade as they get shorter.
 *          size[] holds the corner's place in the window, in pixels, y from the top, not snapped: clip would lose the
 *          last bits
 *   point  x and y in its circle of radius 1; where its rim begins, as the square of a radius
 */
#define GEOMETRY_SMOOTH_LINE 2u
#define GEOMETRY_SMOOTH_POINT 4u
/* Smooth lines of which a pixel is covered no more than they are long. */
#define GEOMETRY_LENGTH_COVERS 32u
/* Bitmaps and pixel rectangles: color[1] holds the pixel's column and row, the texture's number, and the kind
 * (SCENE_BITMAP ..). */
#define GEOMETRY_PIXELS 8u
/*
 * Lines: color[1] of each corner holds its end's place in the window (x, y from the top, depth), then 0 at the first
 * end, 1 at the second. secondary[1] says which pixels are drawn at all: first column, first and last row from the top.
 */
#define GEOMETRY_LINE 16u

/* One instance as the vertex and fragment stages see it; the same index as its struct instance. */
struct geometry {
	float eye_from_obj[16], clip_from_obj[16];
	float normal_matrix[12]; /* 3 rows of 4: inverse transpose of the modelview, rescaled where GL does */
	uint32_t attributes;     /* as scene_mesh.attributes */
	uint32_t position, normal, color, secondary, fog_coord; /* where its arrays start in the pool of floats */
	uint32_t texcoord[SCENE_MAX_UNITS], face;
	uint32_t generics;        /* those that `attributes` has, one after the other */
	uint32_t crease;         /* the same; SCENE_NONE: there are none */
	uint32_t index;          /* where its indices start in the pool of indices, 3 a primitive, relative to vertex_first */
	uint32_t primitive_draw; /* where its draw numbers start in the pool of indices, or SCENE_NONE: all of one draw */
	uint32_t vertex_first;   /* its first vertex in the frame's vertex buffers */
	uint32_t vertex_count;
	uint32_t texcoord_first; /* its first [4] in the frame's texture coordinates: unit_count of them each vertex */
	uint32_t material, view, current, draw, flags;
	float away; /* largest coordinate of object space's origin in eye space */
};
SHARED_SIZE(struct geometry, 288);

#define TEXTURE_MAX_LEVELS 16

/* One texture image as the samplers see it. */
struct texture_image {
	uint32_t target, base_format; /* GL tokens */
	uint32_t width, height, depth, n_levels, border;
	uint32_t words; /* of four bytes that a texel is: 4 where it is floats, else 1 */
	uint32_t level_first[TEXTURE_MAX_LEVELS]; /* first word in the pool of texels */
};
SHARED_SIZE(struct texture_image, 96);

/* The fragment's colours as the per-fragment operations take them. */
struct shaded {
	float gl[4];       /* GL's own: texturing, colour sum and fog done, clamped */
	float shadowed[3]; /* gl with the visibility of its lights */
	float direct[3];   /* the same lit per pixel, where that is asked for, and by light from other surfaces */
	float mirrored[3]; /* direct with mirror reflections */
	float beauty[3];   /* mirrored with refractions */
	float albedo[3];   /* the surface under white light, without fog */
	float depth;       /* window depth after polygon offset, [0,1] */
	uint32_t flags;    /* SHADED_*; 0: there is no fragment */
};
SHARED_SIZE(struct shaded, 84);

#define SHADED_THERE 1u
#define SHADED_FRONT 2u
#define SHADED_DRAWN 8u   /* it passed all tests on the first sample: see PIXEL_FOLLOWS */
#define SHADED_STENCIL 4u /* no fragment but a value for the stencil buffer, in depth */
#define SHADED_WANTS(slot) (0x100u << (slot)) /* light `slot` of the material's list needs a shadow ray */

/*
 * A path from a fragment: the share of the radiance it finds that counts, and where to. Its ray stands in a buffer of
 * its own, at the same place.
 */
struct path {
	float weight[3];
	uint32_t target; /* fragment in the list; for rays to lights: slot * n + item */
	uint32_t kind;   /* PATH_*: the part of the fragment that its radiance belongs to; for rays to lights: as
	                    shadow_walk has it */
	uint32_t depth;  /* bounces so far, without the fragment's own */
	uint32_t medium; /* material of the body it travels in, or SCENE_NONE */
	float density;   /* of directions where it was scattered, a steradian; 0: its direction is not one of many */
};
SHARED_SIZE(struct path, 32);

/* Where light that mirrors and glass sent met a surface that takes it (kernels/frame/photon.h). */
struct photon {
	float position[3], length;    /* eye space; of its whole way from the light */
	float direction[3];           /* that it came along, of length 1 */
	uint32_t number;              /* which of the photons that were sent; SCENE_NONE: none came here */
	float weight[3];              /* what of its light is left for the surface to scatter */
	uint32_t material;            /* of the surface */
};
SHARED_SIZE(struct photon, 48);

/* Queries: kernels/rays/query.h. A point, and how far from it things count. */
struct query_point {
	float p[3], most;
};
SHARED_SIZE(struct query_point, 16);

/* What is nearest to a point. */
struct query_nearest {
	float distance;
	float p[3];         /* the nearest point */
	uint32_t primitive; /* SCENE_NONE: nothing is so near, and nothing else is said */
};
SHARED_SIZE(struct query_nearest, 20);

/* A box along the axes, or a sphere, on its way from `centre` to `centre` + `move`. */
struct query_body {
	float centre[3];
	float size[3]; /* half the box's edges; size[0]: the sphere's radius */
	float move[3];
};
SHARED_SIZE(struct query_body, 36);

/* What a body meets first. */
struct query_contact {
	float t;            /* [0,1], of its way; 0 where it touches something before it moves */
	uint32_t primitive; /* SCENE_NONE: it meets nothing */
};
SHARED_SIZE(struct query_contact, 8);

/* What a hook said of a fragment: kernels/frame/hook.h. */
struct hook_answer {
	float color[3], direction[3], weight[3]; /* direction, weight: of the ray that goes on */
	uint32_t what;                           /* bits: RELUME_* */
};
SHARED_SIZE(struct hook_answer, 40);

/* What a hook's intersection stands for: an instance whose triangles no ray meets. */
struct hook_object {
	float obj_from_eye[12];    /* 3 rows of 4 */
	float lower[3], upper[3];  /* its box, object space */
	uint32_t instance, material, draw;
};
SHARED_SIZE(struct hook_object, 84);

/* A triangle that shines, in a list of all in its space. */
struct emitter {
	float end;               /* share of the list's light that is its or comes before: rises to 1 */
	uint32_t instance, primitive; /* as in struct hit */
};
SHARED_SIZE(struct emitter, 12);

#define PATH_DIFFUSE 0u
#define PATH_REFLECT 1u
#define PATH_REFRACT 2u
/* as PATH_REFLECT; where it meets nothing, the fragment's own colour stands for what it would find */
#define PATH_NEAR 3u

/* Upper bounds of the rays that leave a fragment, and a hit: mirrored, let through, scattered. */
#define PATHS_PER_FRAGMENT 3u
#define PATHS_PER_HIT 2u

/* How a point is lit and where its rays go. */
#define TRANSPORT_GL 0u      /* light as GL has it, from its vertices; mirrors and glass */
#define TRANSPORT_RELIGHT 1u /* the same lit at each pixel */
#define TRANSPORT_DIFFUSE 2u /* as GL, and one bounce from surface to surface */
#define TRANSPORT_PATH 3u    /* no ambient light; what surfaces send each other takes its place; in GL's numbers */
#define TRANSPORT_LINEAR 4u  /* the same in linear light, as which GL's colours are taken */

/* Where a pixel's surface takes light from all around. */
struct dome_place {
	float from[3];   /* rays start here, eye space */
	float strength;  /* share of its colour that is not fog's; 0: nothing there is lit so */
	float normal[3]; /* on the side that is seen */
	float padding;   /* to the size of a ray */
};
SHARED_SIZE(struct dome_place, 32);

/* A rectangle of pixels: x0 <= x < x1, y0 <= y < y1; empty ones have x0 == x1. */
struct camera_rectangle {
	int32_t x0, y0, x1, y1;
};

/* A clear of depth between looks (kernels/frame/plain.h): a rectangle of the band. */
struct layer_clear {
	uint32_t look; /* before this one */
	int32_t x0, y0, x1, y1;
	uint32_t depth; /* as the depth buffer has it */
	float depth_exact;
};
SHARED_SIZE(struct layer_clear, 28);

/* One pixel of the frame while it is being drawn. */
struct frame_pixel {
	float gl[4], shadowed[3], direct[3], mirrored[3], beauty[3]; /* as in struct shaded */
	uint32_t depth;    /* as the depth buffer holds it: in steps of its bits */
	float depth_exact; /* the same before it was quantised, [0,1] */
	uint32_t stencil;
	uint32_t id;       /* draw number that wrote the colour last; 0: cleared only */
	struct fragment surface; /* of the nearest visible surface; order SCENE_NONE: none */
	float albedo[3];         /* its */
	uint32_t layers;         /* fragments blended into the colour since it was last cleared or written over */
	uint32_t unknown;        /* PIXEL_UNKNOWN_* */
};
SHARED_SIZE(struct frame_pixel, 124);

/* What of a pixel is from before the scene, and unknown. */
#define PIXEL_UNKNOWN_COLOR 1u
#define PIXEL_UNKNOWN_DEPTH 2u
#define PIXEL_UNKNOWN_STENCIL 4u
#define PIXEL_UNKNOWN_TEST 8u /* a test compared with it */
#define PIXEL_BEFORE 16u      /* its colour comes from before the scene, and is known; cleared with the colour only */

/*
 * Planes of a finished picture, as the kernel compose leaves them, top row first: some as halves, the others as floats.
 * tracer/frame/compose.c names them.
 */
#define COMPOSE_BEAUTY 0u /* R G B A */
#define COMPOSE_GL 4u     /* R G B A */
#define COMPOSE_SHADOW 8u /* R G B, as all up to ALBEDO but for the normal's X Y Z */
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

/* What the kernel compose is to make of the frame. */
struct compose_request {
	uint32_t half_plane[N_COMPOSE_HALVES];  /* where a plane begins in the buffer of halves; SCENE_NONE: not wanted */
	uint32_t float_plane[N_COMPOSE_FLOATS]; /* in the buffer of floats */
	uint32_t n_halves, n_floats; /* planes in each: they stand one behind the other */
	uint32_t width, height; /* of the planes */
	uint32_t n_passes; /* the parts are means of so many */
	uint32_t display;  /* 1: GL's own numbers, 0: linear light */
	uint32_t normals;  /* 1: the beauty shows normals as colours */
	uint32_t radiant;  /* 1: means of passes are those of linear light */
};
SHARED_SIZE(struct compose_request, 164);

/* Pixels of a row that a work item of resolve_packet takes; and rows of them that one of compose_packet does. */
#define FRAME_ROW 16u
#define COMPOSE_ROWS 8u

/* How many of these a picture's row takes. */
static inline uint32_t frame_columns(uint32_t width)
{
	return (width + FRAME_ROW - 1u) / FRAME_ROW;
}

/* Fragments of a work item of shade_packet, and rays of one of shadow_ray_packet: where each pixel has one fragment, a
 * block of the list (tracer/frame/segment.c). And triangles that it keeps, by number: neighbours mostly have numbers
 * close together. */
#define SHADE_PACKET 64u
#define SHADE_TRIANGLES 8u

/* Vertices of a work item of vertex_packet. */
#define VERTEX_PACKET 256u

/* Pixels of a work item of plain and plain_shadow: columns, rows. */
#define PLAIN_WIDTH 16u
#define PLAIN_ROWS 4u

/* Numbers of a pixel that are means of all passes: shadowed, direct, mirrored, beauty. */
#define PASS_PARTS 12u
