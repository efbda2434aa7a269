/*
 * The single list of all kernels and their arguments. Each list generates the kernel's signature in OpenCL C
 * (KERNEL_ARGUMENTS), the fields that its C twin reads (struct LIST_arguments, here) and those that the host sets
 * (struct LIST_launch, tracer/device/launch.h). A kernel's own header says what it computes.
 */
#pragma once

#include "kernels/shared.h"

/* --- Elements: what buffers hold --------------------------------------------------------------------------------- */

/* X(word): struct word. */
#define KERNEL_STRUCTS(X) \
	X(ray) X(hit) X(path) X(fragment) X(shaded) X(frame_pixel) X(view) X(instance) X(geometry) X(texture_image) \
	X(scene_material) X(scene_light) X(scene_unit) X(scene_current) X(shaded_vertex) X(window_vertex) \
	X(node2) X(node8) X(node8c) X(triangle) X(triangle8) X(face8) X(dome_place) X(emitter) \
	X(layer_clear) X(photon) X(query_point) X(query_nearest) X(query_body) X(query_contact) X(hook_answer) X(hook_object)

/* One-word type names, used only in argument lists. Some of these structs are never in a buffer but passed by value. */
#define KERNEL_ELEMENT(word) typedef struct word element_##word;
KERNEL_STRUCTS(KERNEL_ELEMENT)
KERNEL_ELEMENT(scene_clear)
KERNEL_ELEMENT(scene_dome)
KERNEL_ELEMENT(camera_rectangle)
KERNEL_ELEMENT(compose_request)
typedef uint32_t element_uint;
typedef uint16_t element_half;
typedef float element_float;

/* --- Arguments --------------------------------------------------------------------------------------------------- */

/*
 * ARGUMENTS_LIST(IN, OUT, VALUE, GROUP, AND), in the kernel's order:
 *   IN(element, name)     a buffer that is read
 *   OUT(element, name)    a buffer that is written, and also read where noted
 *   VALUE(element, name)  a value
 *   GROUP(list, name)     the arguments of another list, a struct in C
 */

/* A frame's data as shading reads it. */
#define ARGUMENTS_tables(IN, OUT, VALUE, GROUP, AND) \
	IN(geometry, geometries) AND()      /* one per instance */ \
	IN(scene_material, materials) AND() IN(scene_light, lights) AND() IN(scene_unit, units) AND() \
	IN(scene_current, currents) AND() \
	IN(float, attributes) AND()         /* vertex arrays of all meshes */ \
	IN(uint, indices) AND()             /* indices of all meshes */ \
	IN(shaded_vertex, vertices) AND()   /* output of the vertex stage */ \
	IN(float, texcoords) AND()          /* [4] for each vertex and enabled unit */ \
	IN(texture_image, textures) AND() IN(uint, texels) AND() \
	IN(uint, stipples)                  /* 32 rows each */

/* Camera rays: kernels/camera/camera.h. The kernels differ in the type of their trees' nodes. */
#define ARGUMENTS_camera_pass(IN, OUT, VALUE, GROUP, AND) \
	VALUE(uint, view_index) AND() IN(view, views) AND() \
	VALUE(uint, width) AND()            /* drawable's width */ \
	VALUE(uint, height) AND() \
	VALUE(camera_rectangle, rectangle) AND() /* pixels to trace */ \
	VALUE(uint, first_pixel) AND()      /* number of the first pixel in the buffers below */ \
	VALUE(uint, mode) AND()             /* CAMERA_NEAREST_LESS, CAMERA_NEAREST_LEQUAL or CAMERA_COLUMN */ \
	IN(window_vertex, window) AND()     /* at instance.vertex_first */ \
	IN(float, clip) AND()               /* [4]: the same vertices in clip space */ \
	IN(uint, after) AND()               /* one per pixel, for CAMERA_COLUMN; in other modes any buffer */ \
	OUT(fragment, fragments) AND() \
	OUT(uint, counts)                   /* fragments written, one per pixel */
#define ARGUMENTS_CAMERA(IN, OUT, VALUE, GROUP, AND, node, triangle) \
	GROUP(camera_pass, pass) AND() IN(instance, instances) AND() \
	IN(node2, top) AND()                /* accel.top2 */ \
	IN(uint, instance_list) AND() IN(node, nodes) AND() IN(triangle, triangles)
#define ARGUMENTS_camera_packet(IN, OUT, VALUE, GROUP, AND) ARGUMENTS_CAMERA(IN, OUT, VALUE, GROUP, AND, node8, face8)
#define ARGUMENTS_camera_wide(IN, OUT, VALUE, GROUP, AND) ARGUMENTS_CAMERA(IN, OUT, VALUE, GROUP, AND, node2, triangle)
#define ARGUMENTS_camera_compressed(IN, OUT, VALUE, GROUP, AND) \
	ARGUMENTS_CAMERA(IN, OUT, VALUE, GROUP, AND, node8c, triangle)

/* Other rays: kernels/rays/rays.h. _packet and _wide share trees. */
#define ARGUMENTS_RAYS(IN, OUT, VALUE, GROUP, AND, top_node, node, triangle) \
	VALUE(uint, n_rays) AND() IN(ray, rays) AND() \
	VALUE(uint, top_first) AND()        /* accel_space.top8_first; for _binary and _compressed: top2_first */ \
	IN(top_node, top) AND() IN(uint, instance_list) AND() IN(instance, instances) AND() IN(node, nodes) AND() \
	IN(triangle, triangles) AND()
#define ARGUMENTS_OCCLUDE(IN, OUT, VALUE, GROUP, AND, top_node, node, triangle) \
	ARGUMENTS_RAYS(IN, OUT, VALUE, GROUP, AND, top_node, node, triangle) \
	VALUE(uint, to_lights) AND()        /* 1: rays to lights, which pass through some sides: INSTANCE_PASS_* */ \
	OUT(uint, occluded)                 /* 1 if anything stops the ray, else 0; 2: surfaces have to be sampled */
#define ARGUMENTS_INTERSECT(IN, OUT, VALUE, GROUP, AND, top_node, node, triangle) \
	ARGUMENTS_RAYS(IN, OUT, VALUE, GROUP, AND, top_node, node, triangle) \
	VALUE(uint, after) AND()            /* 1: rays continue behind the hits at their t_min; 0: those are any buffer */ \
	IN(hit, last) AND() OUT(hit, hits)
#define ARGUMENTS_occlude_wide(IN, OUT, VALUE, GROUP, AND) \
	IN(uint, opacity) AND()             /* words of the instances that have some: kernels/rays/opacity.h */ \
	ARGUMENTS_OCCLUDE(IN, OUT, VALUE, GROUP, AND, node8, node8, triangle8)
#define ARGUMENTS_occlude_binary(IN, OUT, VALUE, GROUP, AND) \
	ARGUMENTS_OCCLUDE(IN, OUT, VALUE, GROUP, AND, node2, node2, triangle)
#define ARGUMENTS_occlude_compressed(IN, OUT, VALUE, GROUP, AND) \
	ARGUMENTS_OCCLUDE(IN, OUT, VALUE, GROUP, AND, node2, node8c, triangle)
#define ARGUMENTS_intersect_wide(IN, OUT, VALUE, GROUP, AND) \
	ARGUMENTS_INTERSECT(IN, OUT, VALUE, GROUP, AND, node8, node8, triangle8)
#define ARGUMENTS_intersect_binary(IN, OUT, VALUE, GROUP, AND) \
	ARGUMENTS_INTERSECT(IN, OUT, VALUE, GROUP, AND, node2, node2, triangle)
#define ARGUMENTS_intersect_compressed(IN, OUT, VALUE, GROUP, AND) \
	ARGUMENTS_INTERSECT(IN, OUT, VALUE, GROUP, AND, node2, node8c, triangle)

/* Queries of one tree: kernels/rays/query.h. */
#define ARGUMENTS_QUERY(IN, OUT, VALUE, GROUP, AND) \
	VALUE(uint, n) AND() IN(node2, nodes) AND() IN(triangle, triangles)
#define ARGUMENTS_query_all(IN, OUT, VALUE, GROUP, AND) \
	ARGUMENTS_QUERY(IN, OUT, VALUE, GROUP, AND) AND() IN(ray, rays) AND() \
	VALUE(uint, most) AND()             /* maximum number of hits per ray */ \
	OUT(hit, hits) AND() OUT(uint, counts)
#define ARGUMENTS_query_distance(IN, OUT, VALUE, GROUP, AND) \
	ARGUMENTS_QUERY(IN, OUT, VALUE, GROUP, AND) AND() IN(query_point, points) AND() OUT(query_nearest, nearest)
#define ARGUMENTS_query_box(IN, OUT, VALUE, GROUP, AND) \
	ARGUMENTS_QUERY(IN, OUT, VALUE, GROUP, AND) AND() IN(query_body, bodies) AND() OUT(query_contact, contacts)
#define ARGUMENTS_query_sphere(IN, OUT, VALUE, GROUP, AND) ARGUMENTS_query_box(IN, OUT, VALUE, GROUP, AND)

/* Shading. `n` is the number of work items, and says what each one is, unless noted. */
#define ARGUMENTS_vertex(IN, OUT, VALUE, GROUP, AND) \
	GROUP(tables, tables) AND() IN(view, views) AND() \
	IN(uint, owners) AND()              /* each vertex's instance */ \
	VALUE(uint, height) AND() VALUE(uint, n) AND() \
	OUT(shaded_vertex, shaded) AND()    /* tables.vertices */ \
	OUT(window_vertex, windows) AND() \
	OUT(float, clips) AND()             /* [4] */ \
	OUT(float, coords)                  /* tables.texcoords */
#define ARGUMENTS_vertex_program(IN, OUT, VALUE, GROUP, AND) \
	ARGUMENTS_vertex(IN, OUT, VALUE, GROUP, AND) AND() OUT(uint, programs) /* this and shaded: also read */
#define ARGUMENTS_window(IN, OUT, VALUE, GROUP, AND) \
	IN(geometry, geometries) AND() IN(view, views) AND() IN(uint, owners) AND() IN(float, clips) AND() \
	VALUE(uint, height) AND() VALUE(uint, n) AND() OUT(window_vertex, windows)
#define ARGUMENTS_gather(IN, OUT, VALUE, GROUP, AND) \
	IN(fragment, sparse) AND()          /* `slots` per pixel */ \
	IN(uint, counts) AND()              /* fragments in each pixel's slots */ \
	VALUE(uint, slots) AND() \
	IN(uint, first) AND()               /* index of each pixel's first fragment in the list */ \
	OUT(fragment, list) AND() \
	OUT(uint, pixels) AND()             /* one per fragment in the list */ \
	OUT(uint, after) AND()              /* also read; as in camera_pass */ \
	VALUE(camera_rectangle, rectangle) AND() VALUE(uint, width) AND() \
	VALUE(uint, first_pixel) AND()      /* number of the first pixel in all buffers */ \
	VALUE(uint, n)
#define ARGUMENTS_shade(IN, OUT, VALUE, GROUP, AND) \
	GROUP(tables, tables) AND() IN(view, views) AND() IN(window_vertex, windows) AND() \
	OUT(fragment, fragments) AND()      /* also read */ \
	IN(uint, pixels) AND() VALUE(uint, width) AND() VALUE(uint, height) AND() VALUE(uint, bits) AND() \
	IN(float, visibility) AND()         /* [slot][fragment][3]: fraction of a light that arrives, per colour */ \
	VALUE(uint, n_slots) AND()          /* 0: no rays have been sent to lights yet */ \
	VALUE(uint, transport) AND()        /* TRANSPORT_* */ \
	VALUE(uint, albedo) AND()           /* 0: albedo is not wanted and stays 0 */ \
	VALUE(uint, n) AND()                /* fragments */ \
	OUT(uint, programs) AND()           /* scene.programs: only `program` reads them, and marks those it stopped */ \
	VALUE(uint, output) AND()           /* scene.output */ \
	OUT(shaded, shaded)
#define ARGUMENTS_clear(IN, OUT, VALUE, GROUP, AND) \
	VALUE(scene_clear, clear) AND() VALUE(camera_rectangle, rectangle) AND() VALUE(uint, width) AND() \
	VALUE(uint, bits) AND() VALUE(uint, n) AND() \
	OUT(frame_pixel, frame)             /* also read */
#define ARGUMENTS_resolve(IN, OUT, VALUE, GROUP, AND) \
	GROUP(tables, tables) AND() IN(fragment, fragments) AND() \
	OUT(shaded, shaded) AND()           /* also read */ \
	IN(uint, first) AND() IN(uint, counts) AND() VALUE(camera_rectangle, rectangle) AND() VALUE(uint, width) AND() \
	VALUE(uint, bits) AND() VALUE(uint, n) AND() \
	IN(frame_pixel, cleared) AND()      /* one pixel. This and the next: resolve_packet alone, else any buffers */ \
	/* per row of FRAME_ROW pixels: 0 if they still have to be cleared; also read */ \
	OUT(uint, drawn) AND() \
	OUT(frame_pixel, frame)             /* also read */
#define ARGUMENTS_merge_samples(IN, OUT, VALUE, GROUP, AND) \
	IN(frame_pixel, first) AND() IN(frame_pixel, second) AND() IN(frame_pixel, third) AND() \
	IN(frame_pixel, fourth) AND() VALUE(uint, n) AND() OUT(frame_pixel, frame)
#define ARGUMENTS_add_pass(IN, OUT, VALUE, GROUP, AND) \
	IN(frame_pixel, frame) AND() \
	VALUE(uint, turn) AND()             /* selects the pass's pixels (sample_takes_part) */ \
	VALUE(uint, first) AND()            /* 1: nothing has been summed yet */ \
	VALUE(uint, first_pixel) AND()      /* number of the frame's first pixel in the sums */ \
	VALUE(uint, radiant) AND()          /* as in compose_request */ \
	VALUE(uint, n) AND() \
	OUT(float, sums)                    /* [PASS_PARTS]; also read */
#define ARGUMENTS_compose(IN, OUT, VALUE, GROUP, AND) \
	GROUP(tables, tables) AND() IN(window_vertex, windows) AND() IN(frame_pixel, frame) AND() \
	/* as resolve left them; compose_packet alone; for others, any buffers */ \
	IN(frame_pixel, cleared) AND() IN(uint, drawn) AND() \
	IN(float, sums) AND() VALUE(uint, first_pixel) AND()      /* as in add_pass */ \
	VALUE(compose_request, request) AND() \
	VALUE(uint, n) AND()                /* pixels */ \
	OUT(half, halves) AND() OUT(float, floats)

/* Additional arguments for frames of several looks. */
#define ARGUMENTS_layers(IN, OUT, VALUE, GROUP, AND) \
	IN(uint, counts) AND()              /* at the offset that plain_look_first returns */ \
	VALUE(uint, n_looks) AND() \
	/* a bit for each look that returns columns; a bit for each look whose fragments send rays */ \
	VALUE(uint, columns) AND() VALUE(uint, asking) AND() \
	VALUE(uint, round) AND()            /* PLAIN_BEGINS and the like */ \
	IN(layer_clear, clears) AND() VALUE(uint, n_clears) AND() /* in order; those of this round */ \
	/* [PLAIN_KEPT] per pixel, row by row of blocks: left by the last round; for the next one */ \
	IN(float, before) AND() OUT(float, after) AND() \
	OUT(uint, unknown) AND()            /* as in layered_picture, beginning with the round that ends */ \
	/* 1: light leaves fragments that mirror or refract. 0: the remaining arguments are any buffers */ \
	VALUE(uint, mirrors) AND() \
	/* [n / PLAIN_WIDTH]: a bit for each such visible fragment; written by layered, read by the others */ \
	OUT(uint, leaving) AND() \
	/* [n / PLAIN_WIDTH]: where they start in the next three; layered_shadow, layered_mirror */ \
	IN(uint, list_first) AND() \
	/* from layered_shadow, for the kernels of paths */ \
	OUT(fragment, list) AND() OUT(uint, list_pixels) AND() OUT(shaded, list_shaded)

/* Plain frames: kernels/frame/plain/plain.h. */
#define ARGUMENTS_plain(IN, OUT, VALUE, GROUP, AND) \
	GROUP(tables, tables) AND() IN(view, views) AND() IN(window_vertex, windows) AND() \
	IN(fragment, sparse) AND()          /* one per pixel of the band, at its place in the rectangle */ \
	VALUE(camera_rectangle, rectangle) AND() /* relative to the band's first row */ \
	VALUE(uint, width) AND() VALUE(uint, height) AND() /* size of the drawable */ \
	VALUE(uint, first_pixel) AND()      /* number of the band's first pixel */ \
	VALUE(uint, bits) AND() \
	IN(frame_pixel, cleared) AND()      /* one pixel: each pixel's value before drawing */ \
	VALUE(compose_request, request) AND() /* request.height: rows of the band */ \
	IN(float, visibility) AND()         /* [slot][n][3]; for plain, any buffer */ \
	VALUE(uint, n_slots) AND()          /* light slots with rays; 0: none. plain_program before plain: 0 */ \
	/* each block's place; SCENE_NONE: it has no fragments. GPUs: any buffer, the place is the block's number */ \
	IN(uint, blocks) AND() \
	VALUE(uint, n) AND()                /* places for rays per slot: the pixels of blocks that have a place */ \
	/* [n]: fragments that are shaded one by one or by programs; also read */ \
	OUT(fragment, fragments) AND() OUT(uint, pixels) AND() OUT(shaded, shaded) AND() \
	OUT(ray, rays) AND()                /* [slot][n] */ \
	OUT(uint, programs) AND()           /* plain_program alone; also read */ \
	VALUE(scene_dome, dome) AND()       /* reach 0: there is no dome, and the next four are any buffers */ \
	IN(float, directions) AND() VALUE(uint, samples) AND() /* as in dome_find. This and the next two: plain_dome alone */ \
	OUT(dome_place, places) AND()       /* [n]; also read */ \
	OUT(ray, looks) AND()               /* [sample][n] */ \
	IN(float, factors) AND()            /* as dome_light leaves them; plain_shadow alone */ \
	/* layered, layered_shadow and layered_mirror alone, which do not need rectangle */ \
	GROUP(layers, layers) AND() \
	OUT(half, halves) AND() OUT(float, floats)

/* How a round of looks takes over an earlier picture. */
#define ARGUMENTS_layered_start(IN, OUT, VALUE, GROUP, AND) \
	IN(uint, colors) AND() IN(uint, depths) AND() /* as layered_picture leaves them */ \
	VALUE(uint, width) AND() VALUE(uint, height) AND() VALUE(uint, bits) AND() /* size of the band */ \
	OUT(float, kept)                    /* same layout as layers.before */

/* The result of the last round, in the format of GL's frame buffer. */
#define ARGUMENTS_layered_picture(IN, OUT, VALUE, GROUP, AND) \
	/* as in layered_start */ \
	IN(float, kept) AND() VALUE(uint, width) AND() VALUE(uint, height) AND() VALUE(uint, bits) AND() \
	/* per pixel: colour, red in the lowest byte; depth in the buffer's steps (24 significant bits) */ \
	OUT(uint, colors) AND() OUT(uint, depths) AND() \
	OUT(uint, unknown)                  /* [PLAIN_WIDTH pixels of a row]: a bit for each pixel of unknown colour */

/* Plain frames without rays: camera pass and planes in one kernel. */
#define ARGUMENTS_plain_whole(IN, OUT, VALUE, GROUP, AND) \
	/* fragments and counts: written by the twin alone; as for a band of request.height rows */ \
	ARGUMENTS_camera_packet(IN, OUT, VALUE, GROUP, AND) AND() \
	GROUP(tables, tables) AND() VALUE(uint, bits) AND() \
	IN(frame_pixel, cleared) AND() VALUE(compose_request, request) AND() /* as in plain */ \
	/* [pixels of the band]: fragments that are shaded one by one; also read */ \
	OUT(fragment, alone) AND() OUT(uint, pixels) AND() OUT(shaded, shaded) AND() \
	OUT(half, halves) AND() OUT(float, floats)

/* Rays to lights and into the surroundings: kernels/frame/light/shadow.h. */
#define ARGUMENTS_shadow_ray(IN, OUT, VALUE, GROUP, AND) \
	GROUP(tables, tables) AND() IN(view, views) AND() IN(window_vertex, windows) AND() IN(fragment, fragments) AND() \
	IN(uint, pixels) AND() VALUE(uint, width) AND() IN(shaded, shaded) AND() VALUE(uint, sample) AND() \
	VALUE(uint, frame) AND() \
	VALUE(uint, n) AND()                /* fragments */ \
	VALUE(uint, n_rays) AND()           /* n for each light slot */ \
	OUT(ray, rays)
#define ARGUMENTS_hit_ray(IN, OUT, VALUE, GROUP, AND) \
	GROUP(tables, tables) AND() IN(hit, hits) AND() IN(ray, rays) AND() IN(path, paths) AND() IN(uint, pixels) AND() \
	OUT(uint, wanted) AND()             /* per hit: a bit for each light slot; hit_ray: set by want_lights */ \
	VALUE(uint, transport) AND() VALUE(uint, sample) AND() VALUE(uint, frame) AND() \
	VALUE(uint, n) AND()                /* hits */ \
	VALUE(uint, n_rays) AND()           /* n for each light slot */ \
	OUT(ray, out)
#define ARGUMENTS_ao_ray(IN, OUT, VALUE, GROUP, AND) \
	GROUP(tables, tables) AND() IN(view, views) AND() IN(window_vertex, windows) AND() IN(fragment, fragments) AND() \
	IN(uint, pixels) AND() VALUE(uint, width) AND() IN(shaded, shaded) AND() VALUE(uint, sample) AND() \
	VALUE(float, reach) AND() VALUE(uint, n) AND() OUT(ray, rays)
#define ARGUMENTS_shadow_sum(IN, OUT, VALUE, GROUP, AND) \
	IN(ray, rays) AND() VALUE(float, weight) AND() \
	VALUE(uint, first) AND()            /* 1: visibility is not initialised yet */ \
	VALUE(uint, through) AND()          /* 1: surfaces that stop a ray may let light through */ \
	VALUE(uint, n) AND() \
	OUT(uint, occluded) AND()           /* also read; 1 if the ray continues, else 0 */ \
	OUT(float, visibility)              /* [3] per ray; also read */
#define ARGUMENTS_shadow_start(IN, OUT, VALUE, GROUP, AND) \
	IN(uint, occluded) AND() \
	IN(uint, places) AND()              /* per ray: its place in the list if it was stopped and continues */ \
	IN(ray, rays) AND() VALUE(float, weight) AND() VALUE(uint, n) AND() OUT(ray, shadow_rays) AND() \
	OUT(path, shadow_paths)
#define ARGUMENTS_shadow_walk(IN, OUT, VALUE, GROUP, AND) \
	GROUP(tables, tables) AND() IN(hit, hits) AND() IN(ray, rays) AND() IN(path, paths) AND() \
	VALUE(uint, to_lights) AND()        /* 1: rays to lights; 0: into the surroundings */ \
	VALUE(float, least) AND()           /* a ray that carries no more light ends */ \
	VALUE(uint, after) AND()            /* 1: the rays continued behind the hits `last`; 0: those are any buffer */ \
	IN(hit, last) AND() VALUE(uint, n) AND() \
	OUT(float, visibility) AND()        /* also read */ \
	OUT(ray, next_rays) AND() OUT(path, next_paths) AND() \
	OUT(uint, counts)                   /* per path: 1 if it continues */
#define ARGUMENTS_ao_shade(IN, OUT, VALUE, GROUP, AND) \
	IN(float, visibility) AND() VALUE(uint, over_gl) AND() VALUE(uint, n) AND() \
	OUT(shaded, shaded)                 /* also read */

/* Light from all around: kernels/frame/dome/dome.h. */
#define ARGUMENTS_dome_find(IN, OUT, VALUE, GROUP, AND) \
	GROUP(tables, tables) AND() IN(view, views) AND() IN(window_vertex, windows) AND() IN(fragment, fragments) AND() \
	IN(uint, pixels) AND() VALUE(uint, width) AND() IN(shaded, shaded) AND() VALUE(scene_dome, dome) AND() \
	IN(float, directions) AND()         /* [sample][pixel of a block][4]: direction about z, then how far to look */ \
	VALUE(uint, samples) AND() VALUE(uint, n) AND() \
	OUT(dome_place, places) AND() \
	OUT(ray, rays)                      /* [sample][n] */
#define ARGUMENTS_dome_sum(IN, OUT, VALUE, GROUP, AND) \
	IN(dome_place, places) AND() IN(ray, rays) AND() IN(float, visibility) AND() VALUE(scene_dome, dome) AND() \
	VALUE(uint, samples) AND() \
	VALUE(uint, is_first) AND()         /* 1: nothing has been summed yet */ \
	VALUE(uint, n) AND() \
	OUT(float, sums)                    /* [4] per fragment: light r g b, number of rays; also read */
#define ARGUMENTS_dome_light(IN, OUT, VALUE, GROUP, AND) \
	IN(dome_place, places) AND() IN(float, sums) AND() IN(uint, pixels) AND() \
	IN(uint, first) AND() IN(uint, counts) AND() /* per pixel of the band: its first fragment in the list; how many */ \
	VALUE(camera_rectangle, rectangle) AND() /* rectangle of first and counts, relative to the band's first row */ \
	VALUE(uint, width) AND() \
	VALUE(uint, first_pixel) AND()      /* number of the band's first pixel */ \
	VALUE(scene_dome, dome) AND() \
	/* 1: a plain frame's fragments; pixels, first, counts and shaded are any buffers; 0: blocks and factors are */ \
	VALUE(uint, in_blocks) AND() \
	IN(uint, blocks) AND()              /* as in plain */ \
	VALUE(uint, n) AND() \
	OUT(shaded, shaded) AND()           /* also read */ \
	OUT(float, factors)                 /* [3][n]: factors of colours, 1 where the dome's light does not apply */

/* Emissive surfaces: kernels/frame/light/emitter.h. */
#define ARGUMENTS_emission(IN, OUT, VALUE, GROUP, AND) \
	IN(emitter, emitters) AND() VALUE(uint, emitter_first) AND() \
	VALUE(uint, n_emitters) AND()       /* 0: emitters is any buffer */ \
	VALUE(float, emitted)               /* sum of their areas times emitter_strength */
#define ARGUMENTS_leave_ray(IN, OUT, VALUE, GROUP, AND) \
	GROUP(tables, tables) AND() IN(view, views) AND() IN(window_vertex, windows) AND() IN(fragment, fragments) AND() \
	IN(uint, pixels) AND() VALUE(uint, width) AND() IN(shaded, shaded) AND() GROUP(emission, emission) AND() \
	VALUE(uint, sample) AND() \
	VALUE(uint, frame) AND() VALUE(uint, n) AND() OUT(ray, rays)
#define ARGUMENTS_bounce_ray(IN, OUT, VALUE, GROUP, AND) \
	GROUP(tables, tables) AND() IN(hit, hits) AND() IN(ray, rays) AND() IN(path, paths) AND() IN(uint, pixels) AND() \
	GROUP(emission, emission) AND() VALUE(uint, sample) AND() VALUE(uint, frame) AND() \
	VALUE(uint, depth) AND()            /* maximum number of bounces */ \
	VALUE(uint, first) AND()            /* index of their first ray in out */ \
	VALUE(uint, n) AND() OUT(ray, out)

/* Paths: kernels/frame/light/path.h. */
#define ARGUMENTS_leave(IN, OUT, VALUE, GROUP, AND) \
	GROUP(tables, tables) AND() IN(view, views) AND() IN(window_vertex, windows) AND() IN(fragment, fragments) AND() \
	IN(uint, pixels) AND() VALUE(uint, width) AND() VALUE(uint, transport) AND() VALUE(uint, sample) AND() \
	VALUE(uint, frame) AND() GROUP(emission, emission) AND() IN(float, visibility) AND() \
	VALUE(uint, n) AND() \
	OUT(shaded, shaded) AND()           /* also read */ \
	OUT(ray, next_rays) AND()           /* PATHS_PER_FRAGMENT per fragment */ \
	OUT(path, next_paths) AND() \
	OUT(uint, counts)                   /* rays per fragment */
#define ARGUMENTS_gather_paths(IN, OUT, VALUE, GROUP, AND) \
	IN(ray, next_rays) AND()            /* `slots` per item */ \
	IN(path, next_paths) AND() IN(uint, counts) AND() IN(uint, places) AND() VALUE(uint, slots) AND() \
	VALUE(uint, n) AND() OUT(ray, rays) AND() OUT(path, paths)
#define ARGUMENTS_gather_hits(IN, OUT, VALUE, GROUP, AND) \
	IN(hit, hits) AND() IN(uint, counts) AND() IN(uint, places) AND() VALUE(uint, n) AND() OUT(hit, last)
#define ARGUMENTS_sky_ray(IN, OUT, VALUE, GROUP, AND) \
	IN(hit, hits) AND() IN(ray, rays) AND() VALUE(uint, n) AND() OUT(ray, out)
#define ARGUMENTS_want_lights(IN, OUT, VALUE, GROUP, AND) \
	GROUP(tables, tables) AND() IN(hit, hits) AND() IN(ray, rays) AND() VALUE(uint, transport) AND() \
	VALUE(uint, n) AND() OUT(uint, wanted)
#define ARGUMENTS_shade_hit(IN, OUT, VALUE, GROUP, AND) \
	GROUP(tables, tables) AND() IN(hit, hits) AND() IN(hit, sky) AND() \
	VALUE(uint, has_sky) AND()          /* 0: sky is any buffer */ \
	IN(ray, rays) AND() IN(path, paths) AND() IN(uint, pixels) AND() IN(float, visibility) AND() \
	VALUE(uint, n_slots) AND() VALUE(uint, transport) AND() VALUE(uint, sample) AND() VALUE(uint, frame) AND() \
	GROUP(emission, emission) AND() \
	VALUE(uint, depth) AND()            /* maximum number of bounces */ \
	VALUE(float, most) AND()            /* upper bound of the light of a path (hit_bound); 0: no bound */ \
	IN(float, background) AND()         /* [4] */ \
	IN(shaded, shaded) AND()            /* those of the fragments that paths start from */ \
	VALUE(uint, n) AND() \
	OUT(float, radiance) AND()          /* [3] per path */ \
	OUT(ray, next_rays) AND()           /* PATHS_PER_HIT per path */ \
	OUT(path, next_paths) AND() OUT(uint, counts)
#define ARGUMENTS_credit(IN, OUT, VALUE, GROUP, AND) \
	IN(path, paths) AND() IN(float, radiance) AND() VALUE(uint, transport) AND() VALUE(uint, n) AND() \
	OUT(shaded, shaded)                 /* also read */
#define ARGUMENTS_photon(IN, OUT, VALUE, GROUP, AND) \
	GROUP(tables, tables) AND() IN(hit, hits) AND() IN(ray, rays) AND() IN(path, paths) AND() \
	VALUE(uint, depth) AND()            /* maximum number of mirror and glass bounces */ \
	VALUE(uint, pass) AND() VALUE(uint, n) AND() \
	OUT(photon, photons) AND() \
	OUT(ray, next_rays) AND()           /* PATHS_PER_HIT per path */ \
	OUT(path, next_paths) AND() OUT(uint, counts)

/* Hooks: kernels/frame/hook/hook.h. */
#define ARGUMENTS_hook_trees(IN, OUT, VALUE, GROUP, AND) /* binary trees of an eye space */ \
	VALUE(uint, top_first) AND()        /* accel_space.top2_first; SCENE_NONE: the space is empty */ \
	IN(node2, top) AND() IN(uint, instance_list) AND() IN(instance, instances) AND() IN(node2, nodes)
#define ARGUMENTS_hook_ray(IN, OUT, VALUE, GROUP, AND) \
	IN(view, views) AND() VALUE(uint, view_index) AND() VALUE(uint, width) AND() VALUE(uint, height) AND() \
	VALUE(camera_rectangle, rectangle) AND() /* relative to the band's first row */ \
	VALUE(uint, first_pixel) AND()      /* number of the band's first pixel */ \
	VALUE(uint, turn) AND()             /* selects the pass's pixels (sample_takes_part) */ \
	VALUE(uint, sample) AND() VALUE(uint, frame_number) AND() \
	IN(float, parameters) AND() VALUE(uint, row) AND() /* row: start of the frame's own parameters */ \
	VALUE(uint, n) AND() \
	OUT(uint, pixels) AND() OUT(shaded, shaded) AND() OUT(ray, next_rays) AND() OUT(path, next_paths) AND() \
	OUT(uint, counts)
#define ARGUMENTS_hook_see(IN, OUT, VALUE, GROUP, AND) \
	GROUP(tables, tables) AND() IN(hit, hits) AND() IN(ray, rays) AND() IN(path, paths) AND() IN(uint, pixels) AND() \
	VALUE(uint, first_pixel) AND() \
	VALUE(uint, n) AND() \
	OUT(frame_pixel, frame)             /* also read */
#define ARGUMENTS_hook_store(IN, OUT, VALUE, GROUP, AND) \
	IN(shaded, shaded) AND() IN(uint, pixels) AND() VALUE(uint, first_pixel) AND() VALUE(uint, n) AND() \
	OUT(frame_pixel, frame)             /* also read */
#define ARGUMENTS_hook_shade(IN, OUT, VALUE, GROUP, AND) \
	GROUP(tables, tables) AND() IN(view, views) AND() IN(window_vertex, windows) AND() IN(fragment, fragments) AND() \
	IN(uint, pixels) AND() VALUE(uint, width) AND() IN(float, visibility) AND() VALUE(uint, n_slots) AND() \
	VALUE(uint, transport) AND() \
	IN(float, parameters) AND() VALUE(uint, words) AND() /* one row per material */ \
	GROUP(hook_trees, trees) AND() VALUE(uint, n) AND() \
	OUT(shaded, shaded) AND()           /* also read */ \
	OUT(hook_answer, answers)
#define ARGUMENTS_hook_ways(IN, OUT, VALUE, GROUP, AND) \
	GROUP(tables, tables) AND() IN(view, views) AND() IN(window_vertex, windows) AND() IN(fragment, fragments) AND() \
	IN(uint, pixels) AND() VALUE(uint, width) AND() IN(hook_answer, answers) AND() VALUE(uint, transport) AND() \
	VALUE(uint, n) AND() \
	OUT(shaded, shaded) AND() OUT(ray, next_rays) AND() OUT(path, next_paths) AND() OUT(uint, counts)
#define ARGUMENTS_hook_hit(IN, OUT, VALUE, GROUP, AND) \
	GROUP(tables, tables) AND() IN(hit, hits) AND() IN(ray, rays) AND() IN(path, paths) AND() IN(float, visibility) AND() \
	VALUE(uint, n_slots) AND() VALUE(uint, transport) AND() VALUE(uint, depth) AND() \
	IN(float, parameters) AND() VALUE(uint, words) AND() VALUE(uint, row) AND() GROUP(hook_trees, trees) AND() \
	VALUE(uint, n) AND() \
	OUT(float, radiance) AND()          /* [3] per path; also read */ \
	OUT(ray, next_rays) AND() OUT(path, next_paths) AND() OUT(uint, counts)
#define ARGUMENTS_hook_walk(IN, OUT, VALUE, GROUP, AND) \
	GROUP(tables, tables) AND() IN(hit, hits) AND() IN(ray, rays) AND() IN(path, paths) AND() \
	VALUE(uint, transport) AND() \
	IN(float, parameters) AND() VALUE(uint, words) AND() VALUE(uint, n) AND() \
	OUT(ray, next_rays) AND() OUT(path, next_paths) AND() OUT(uint, counts)
#define ARGUMENTS_hook_light(IN, OUT, VALUE, GROUP, AND) \
	GROUP(tables, tables) AND() IN(window_vertex, windows) AND() IN(fragment, fragments) AND() \
	IN(ray, rays) AND()                 /* the rays that were sent to lights */ \
	VALUE(uint, transport) AND() IN(float, parameters) AND() VALUE(uint, words) AND() VALUE(uint, n) AND() \
	VALUE(uint, n_rays) AND()           /* n for each light slot */ \
	OUT(float, visibility)              /* also read */
#define ARGUMENTS_hook_light_hit(IN, OUT, VALUE, GROUP, AND) \
	GROUP(tables, tables) AND() IN(hit, hits) AND() IN(ray, path_rays) AND() IN(ray, rays) AND() \
	VALUE(uint, transport) AND() IN(float, parameters) AND() VALUE(uint, words) AND() VALUE(uint, n) AND() \
	VALUE(uint, n_rays) AND() \
	OUT(float, visibility)              /* also read */
#define ARGUMENTS_hook_bounds(IN, OUT, VALUE, GROUP, AND) \
	IN(float, parameters) AND() VALUE(uint, words) AND() VALUE(uint, n) AND() \
	OUT(hook_object, objects)           /* also read */
#define ARGUMENTS_hook_intersect(IN, OUT, VALUE, GROUP, AND) \
	GROUP(tables, tables) AND() IN(view, views) AND() IN(hook_object, objects) AND() VALUE(uint, n_objects) AND() \
	IN(ray, rays) AND() \
	VALUE(uint, after) AND()            /* 1: rays continue behind their last hits */ \
	IN(float, parameters) AND() VALUE(uint, words) AND() \
	VALUE(uint, alone) AND()            /* 1: there are no triangles, so no hits yet */ \
	VALUE(uint, first_slot) AND()       /* first of the triangles that represent these rays' hits */ \
	VALUE(uint, n) AND() \
	OUT(hit, hits) AND()                /* also read */ \
	OUT(shaded_vertex, made) AND()      /* tables.vertices; also read */ \
	OUT(float, made_coords) AND()       /* tables.texcoords */ \
	OUT(window_vertex, windows)
#define ARGUMENTS_hook_occlude(IN, OUT, VALUE, GROUP, AND) \
	IN(hook_object, objects) AND() VALUE(uint, n_objects) AND() IN(ray, rays) AND() IN(float, parameters) AND() \
	VALUE(uint, words) AND() \
	VALUE(uint, alone) AND() VALUE(uint, n) AND() \
	OUT(uint, occluded)                 /* also read */

/* Prefix sums: kernels/frame/stages/scan.h. */
#define ARGUMENTS_scan_sum(IN, OUT, VALUE, GROUP, AND) \
	IN(uint, counts) AND() VALUE(uint, n) AND() VALUE(uint, full) AND() OUT(uint, sums)
#define ARGUMENTS_scan_place(IN, OUT, VALUE, GROUP, AND) \
	IN(uint, counts) AND() VALUE(uint, n) AND() IN(uint, before) AND() OUT(uint, places)

/* X(list): lists that other lists include, and lists of kernels. */
#define KERNEL_GROUPS(X) X(tables) X(layers) X(camera_pass) X(emission) X(hook_trees)
#define KERNEL_LISTS(X) \
	X(camera_packet) X(camera_wide) X(camera_compressed) X(occlude_wide) X(occlude_binary) X(occlude_compressed) \
	X(intersect_wide) X(intersect_binary) X(intersect_compressed) X(query_all) X(query_distance) X(query_box) \
	X(query_sphere) \
	X(vertex) X(vertex_program) X(window) X(gather) X(shade) X(shadow_ray) X(hit_ray) X(ao_ray) \
	X(shadow_sum) X(shadow_start) X(shadow_walk) X(scan_sum) X(scan_place) X(gather_paths) X(gather_hits) \
	X(leave) X(sky_ray) X(want_lights) \
	X(shade_hit) X(leave_ray) X(bounce_ray) X(credit) X(photon) X(ao_shade) X(dome_find) X(dome_sum) X(dome_light) \
	X(plain) X(layered_start) X(layered_picture) X(plain_whole) X(clear) X(resolve) X(merge_samples) X(add_pass) \
	X(compose) \
	HOOK_LISTS(X)

/* Kernels for hooks. Each list has a kernel of the same name, whose body is KERNEL_ITEMS. */
#define HOOK_LISTS(X) \
	X(hook_ray) X(hook_see) X(hook_store) X(hook_shade) X(hook_ways) X(hook_hit) X(hook_walk) X(hook_light) \
	X(hook_light_hit) X(hook_bounds) X(hook_intersect) X(hook_occlude)

/* --- Structs and signatures -------------------------------------------------------------------------------------- */

#define KERNEL_FIELD_IN(element, name) GLOBAL const element_##element *name;
#define KERNEL_FIELD_OUT(element, name) GLOBAL element_##element *name;
#define KERNEL_FIELD_VALUE(element, name) element_##element name;
#define KERNEL_FIELD_GROUP(list, name) struct list name;
#define KERNEL_NOTHING()
#define KERNEL_FIELDS(list) \
	ARGUMENTS_##list(KERNEL_FIELD_IN, KERNEL_FIELD_OUT, KERNEL_FIELD_VALUE, KERNEL_FIELD_GROUP, KERNEL_NOTHING)

/* A group is a struct with the list's name. */
#define KERNEL_GROUP_STRUCT(list) struct list { KERNEL_FIELDS(list) };
#define KERNEL_LIST_STRUCT(list) struct list##_arguments { KERNEL_FIELDS(list) };
KERNEL_GROUPS(KERNEL_GROUP_STRUCT)
KERNEL_LISTS(KERNEL_LIST_STRUCT)

#ifdef __OPENCL_VERSION__

/* A kernel's signature: __kernel void name(KERNEL_ARGUMENTS(list)). */
#define KERNEL_PARAMETER_IN(element, name) __global const element_##element *name
#define KERNEL_PARAMETER_OUT(element, name) __global element_##element *name
#define KERNEL_PARAMETER_VALUE(element, name) element_##element name
#define KERNEL_PARAMETER_GROUP(list, name) \
	ARGUMENTS_##list(KERNEL_PARAMETER_IN, KERNEL_PARAMETER_OUT, KERNEL_PARAMETER_VALUE, KERNEL_PARAMETER_GROUP, \
	KERNEL_COMMA)
#define KERNEL_COMMA() ,
#define KERNEL_ARGUMENTS(list) \
	ARGUMENTS_##list(KERNEL_PARAMETER_IN, KERNEL_PARAMETER_OUT, KERNEL_PARAMETER_VALUE, KERNEL_PARAMETER_GROUP, \
	KERNEL_COMMA)

/* The same arguments as a struct: const struct list_arguments a = KERNEL_STRUCT(list). */
#define KERNEL_NAME(element, name) name
#define KERNEL_NAME_GROUP(list, name) \
	{ ARGUMENTS_##list(KERNEL_NAME, KERNEL_NAME, KERNEL_NAME, KERNEL_NAME_GROUP, KERNEL_COMMA) }
#define KERNEL_STRUCT(list) { ARGUMENTS_##list(KERNEL_NAME, KERNEL_NAME, KERNEL_NAME, KERNEL_NAME_GROUP, KERNEL_COMMA) }

/* Body of a kernel that calls NAME_item(&arguments, item) for each of `count` work items. */
#define KERNEL_ITEMS(name, count) \
	{ \
		const struct name##_arguments a = KERNEL_STRUCT(name); \
\
		if (get_global_id(0) < (count)) \
			name##_item(&a, (uint32_t)get_global_id(0)); \
	}

#else

/* --- Kernels ----------------------------------------------------------------------------------------------------- */

/*
 * X(name, list): kernel NAME in a .cl file, twin NAME_c in kernels/ref/. OpenCL rounds the global size up to whole work
 * groups; work items beyond the list's count do nothing.
 */
#define KERNELS(X) \
	/* camera rays, one 32 x 32 tile per work item, eight-wide trees; nearest fragment or a column of fragments */ \
	X(camera_packet, camera_packet) \
	X(camera_wide, camera_wide)     /* the same, one pixel per work item (GPUs) */ \
	X(camera_compressed, camera_compressed) /* the same, compressed nodes */ \
	/* shadow and other short rays, one packet of consecutive rays per work item, 8-wide nodes */ \
	X(occlude_packet, occlude_wide) \
	X(occlude_wide, occlude_wide)   /* the same, one ray per work item */ \
	X(intersect_packet, intersect_wide) /* nearest hit, one packet per work item */ \
	X(intersect_wide, intersect_wide) /* the same, one ray per work item */ \
	X(occlude_binary, occlude_binary) /* one ray per work item, scalar (GPUs): BVH2 */ \
	X(intersect_binary, intersect_binary) \
	X(occlude_compressed, occlude_compressed) /* the same, compressed nodes */ \
	X(intersect_compressed, intersect_compressed) \
	X(query_all, query_all)         /* one ray per work item: all its hits */ \
	X(query_distance, query_distance) /* one point per work item: the nearest surface */ \
	X(query_box, query_box)         /* one moving box per work item: its first contact */ \
	X(query_sphere, query_sphere)   /* the same, a sphere */ \
	X(vertex, vertex)               /* GL's vertex stage: one vertex of one instance per work item */ \
	X(vertex_packet, vertex)        /* the same, VERTEX_PACKET consecutive vertices per work item (CPUs) */ \
	/* after either, for vertex programs: four vertices of an instance per work item */ \
	X(vertex_program, vertex_program) \
	X(window, window)               /* one vertex per work item: its place in a window that has moved */ \
	X(gather, gather)               /* one pixel per work item: compacts its fragments into a dense list */ \
	X(shade, shade)                 /* one fragment per work item: its GL colour, and the shadow rays it needs */ \
	X(shade_packet, shade)          /* the same, SHADE_PACKET consecutive fragments per work item (CPUs) */ \
	/* after either, for fragment programs: one fragment per work item, coloured by its program */ \
	X(program, shade) \
	X(program_packet, shade)        /* the same, SHADE_PACKET consecutive fragments per work item (CPUs) */ \
	X(shadow_ray, shadow_ray)       /* one fragment per work item: its ray to one light */ \
	X(shadow_ray_packet, shadow_ray) /* the same, SHADE_PACKET consecutive fragments per work item (CPUs) */ \
	X(hit_ray, hit_ray)             /* one path hit per work item: its ray to one light */ \
	/* want_lights, and rays to all lights, SHADE_PACKET consecutive hits per work item (CPUs) */ \
	X(hit_ray_packet, hit_ray) \
	X(ao_ray, ao_ray)               /* one fragment per work item: an ambient occlusion ray */ \
	X(shadow_sum, shadow_sum)       /* one light ray per work item: full visibility if nothing stopped it */ \
	X(shadow_start, shadow_start)   /* one stopped light ray per work item: listed, to pass what lets light through */ \
	X(shadow_walk, shadow_walk)     /* one listed ray per work item: continues it beyond its hit */ \
	X(scan_sum, scan_sum)           /* one chunk of counts per work item: their sum */ \
	X(scan_place, scan_place)       /* the same: the place of each count's results */ \
	X(gather_paths, gather_paths)   /* one path per work item: compacts its next rays into a dense list */ \
	X(gather_hits, gather_hits)     /* the same for the hits that rays to lights continue behind */ \
	X(leave, leave)                 /* one fragment per work item: its mirrored, refracted and scattered rays */ \
	X(leave_packet, leave)          /* the same, SHADE_PACKET consecutive fragments per work item (CPUs) */ \
	X(sky_ray, sky_ray)             /* one path per work item: its ray to the sky if it hit nothing */ \
	X(want_lights, want_lights)     /* one path per work item: the lights needed at its hit */ \
	X(shade_hit, shade_hit)         /* one path per work item: the radiance it found and its next rays */ \
	X(shade_hit_packet, shade_hit)  /* the same, SHADE_PACKET consecutive paths per work item (CPUs) */ \
	X(leave_ray, leave_ray)         /* one fragment per work item: its ray to an emissive surface */ \
	X(bounce_ray, bounce_ray)       /* one path hit per work item: the same */ \
	X(credit, credit)               /* one path per work item: adds its radiance to its fragment */ \
	X(photon, photon)               /* one photon per work item: where it landed, and its next ray */ \
	X(ao_shade, ao_shade)           /* one fragment per work item: its openness as its colour */ \
	/* one fragment per work item: where it receives the dome's light, and its dome rays */ \
	X(dome_find, dome_find) \
	X(dome_find_packet, dome_find)  /* the same, SHADE_PACKET consecutive fragments per work item (CPUs) */ \
	X(dome_sum, dome_sum)           /* one fragment per work item: the light that its dome rays found */ \
	X(dome_light, dome_light)       /* the same: applies its own and its neighbours' light to its colours */ \
	X(dome_light_packet, dome_light) /* the same, a tile of DOME_WIDTH x CAMERA_TILE pixels per work item (CPUs) */ \
	X(clear, clear)                 /* one pixel per work item: a Clear */ \
	X(resolve, resolve)             /* one pixel per work item: per-fragment operations in draw order */ \
	/* the same, FRAME_ROW pixels of a row per work item, all colours of a pixel at once (CPUs) */ \
	X(resolve_packet, resolve) \
	X(merge_samples, merge_samples) /* one pixel per work item: merges its samples */ \
	X(add_pass, add_pass)           /* one pixel per work item: adds a pass to the sum of passes */ \
	X(plain_program, plain)         /* before either of the next two, if there are programs: their colours */ \
	/* a block of a plain frame per work item: all planes except shadows, and rays to lights (CPUs) */ \
	X(plain, plain) \
	/* replaces camera_packet and plain if no rays are sent: one                                                          \
	 * tile of CAMERA_TILE x CAMERA_TILE pixels per work item (CPUs) */                                                   \
	X(plain_whole, plain_whole) \
	/* replaces plain if there is a dome: a block's rays, to lights and to the dome */ \
	X(plain_dome, plain) \
	X(plain_shadow, plain)          /* the same: planes of pixels that are in shadow */ \
	/* plain's first step where a block's place is its                                                                   \
	 * number, one pixel per work item (GPUs): its colour */                                                             \
	X(plain_color, plain) \
	X(plain_ask, plain)             /* its second step, one ray per work item, n per slot */ \
	X(plain_show, plain)            /* its third step, one pixel per work item: its planes */ \
	X(plain_color_dimmed, plain)    /* plain_shadow's two steps, the same */ \
	X(plain_show_dimmed, plain) \
	/* before the next, if frames begin with a picture: PLAIN_WIDTH pixels of a row per work item */ \
	X(layered_start, layered_start) \
	X(layered, plain)               /* as plain, for several looks */ \
	X(layered_shadow, plain)        /* as plain_shadow; also lists the fragments that light leaves */ \
	X(layered_mirror, plain)        /* planes of pixels with such fragments, including what their paths found */ \
	/* after the last round, if a picture is wanted instead of planes: PLAIN_WIDTH pixels of a row per work item */ \
	X(layered_picture, layered_picture) \
	X(compose, compose)             /* one pixel per work item: the planes of the finished picture */ \
	X(compose_packet, compose)      /* the same, FRAME_ROW pixels of COMPOSE_ROWS rows per work item (CPUs) */ \
	X(hook_ray, hook_ray)           /* one pixel per work item: its first ray, from a hook */ \
	X(hook_see, hook_see)           /* one such ray per work item: its hit becomes the pixel's surface */ \
	X(hook_store, hook_store)       /* one pixel per work item: what its rays found */ \
	X(hook_shade, hook_shade)       /* one fragment per work item: its colour, from a hook */ \
	X(hook_ways, hook_ways)         /* the same: its rays */ \
	X(hook_hit, hook_hit)           /* one path per work item: the light it found and its rays, from a hook */ \
	X(hook_walk, hook_walk)         /* one stopped light ray per work item: continues if a hook says so */ \
	/* one light ray of a fragment per work item: how much of the light a hook lets arrive */ \
	X(hook_light, hook_light) \
	X(hook_light_hit, hook_light_hit) /* the same for a hit */ \
	X(hook_bounds, hook_bounds)     /* one hook object per work item: its box */ \
	X(hook_intersect, hook_intersect) /* one ray per work item: its hit among these objects */ \
	X(hook_occlude, hook_occlude)   /* the same, for any hit */

enum kernel {
#define KERNEL_ENUM(name, list) KERNEL_##name,
	KERNELS(KERNEL_ENUM)
	N_KERNELS
};

/* The twins: each runs work items first .. last-1. */
#define KERNEL_DECLARE_TWIN(name, list) void name##_c(const struct list##_arguments *a, size_t first, size_t last);
KERNELS(KERNEL_DECLARE_TWIN)

/* The twin of a kernel whose body is KERNEL_ITEMS. count: name of a field */
#define KERNEL_TWIN(name, count) \
	void name##_c(const struct name##_arguments *a, size_t first, size_t last) \
	{ \
		for (size_t i = first; i < last && i < a->count; i++) \
			name##_item(a, (uint32_t)i); \
	}

/**
 * A twin that takes its arguments one by one.
 * @param arguments  in the list's order, groups in place: a buffer's memory, or the address of a value
 */
typedef void kernel_twin(void *const *arguments, size_t first, size_t last);

/* All kernels (kernels/ref/twins.c). */
extern const struct kernel_entry {
	const char *name;
	kernel_twin *twin;
} kernel_entries[N_KERNELS];

#endif
