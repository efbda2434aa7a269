/*
 * The scene of one frame: everything the tracer sees. The boundary between replay/ and tracer/.
 *
 * Conventions
 *   matrices   float[16], column-major, column vectors, p' = M p (as OpenGL's own)
 *   eye space  right-handed, the viewer looks along -z; each draw's own modelview leads into it
 *   windows    pixels, origin at the lower left corner, pixel centres at .5; row 0 is the bottom row
 *   colours    GL's display-referred numbers; in [0,1] unless GL itself allows others
 *   tokens     a field marked "GL token" holds the number of a GL enum (0x0B..); scene.h defines no names for them
 *   indices    uint32_t into the arrays of struct scene; SCENE_NONE for none
 *
 * Nothing here points back into the GL state: what a draw saw was copied when it was drawn. Plain structs of 4-byte
 * fields are shared with the kernels unchanged; the host-only part follows at the end.
 *
 * Draw order: instances are sorted by it, as are the primitives of a mesh, and a clear names the instance it precedes.
 * The order number of a primitive is instance.first_primitive + its number in the mesh: unique in the frame, ascending.
 */
#pragma once

#ifdef __OPENCL_VERSION__
typedef uint uint32_t;
typedef int int32_t;
typedef uchar uint8_t;
#else
#include <stddef.h>
#include <stdint.h>
#endif

#define SCENE_MAX_UNITS 8
#define SCENE_MAX_GENERICS 15 /* vertex programs' attributes besides the position */
#define SCENE_MAX_LIGHTS 8
#define SCENE_DRAW_PROGRAMS 2 /* a vertex and a fragment program */
#define SCENE_MAX_CLIP_PLANES 8 /* GL 2.1 requires six; Mesa has eight */
#define SCENE_NONE 0xffffffffu
#define SCENE_SWIZZLED 0x1000u
#define SCENE_SAMPLES 4 /* samples a pixel in multisampled drawables, whatever their own number */

/* One enabled light as the draw saw it (GL 2.1 sec. 2.14.1, table 2.10). */
struct scene_light {
	float ambient[4], diffuse[4], specular[4];
	float position_eye[4];       /* homogeneous; w == 0 is a direction towards the light */
	float spot_direction_eye[3]; /* as GL keeps it: not normalised */
	float spot_exponent;
	float spot_cutoff_deg; /* 180: no spot */
	float attenuation[3];  /* constant, linear, quadratic */
	uint32_t index;        /* 0..7: which GL_LIGHTi */
	float radius; /* radius of the light's sphere, eye-space units; 0: a point; below 0: nothing blocks it. Set by
	                 rules, not by GL */
};

/* Material of one side (GL 2.1 table 2.9). */
struct scene_face {
	float ambient[4], diffuse[4], specular[4], emission[4];
	float shininess;
};

/* Bits of scene_surface.hidden: rays that pass a surface, and parts of it that the beauty picture leaves out. */
#define SCENE_HIDDEN_FROM_LIGHTS 1u  /* casts no shadow */
#define SCENE_HIDDEN_FROM_MIRRORS 2u /* neither mirrored nor seen through glass */
/* passed by light from behind the only side that it shows (look/spare/sides.h) */
#define SCENE_ONE_SIDED 4u
/* with SCENE_ONE_SIDED, if all its triangles agree: in object space, corners of the shown side run counter-clockwise */
#define SCENE_SHOWN_COUNTER 65536u
#define SCENE_SHOWN_CLOCKWISE 131072u
#define SCENE_STOPS_NO_SUN 8u        /* passed by light from infinity */
#define SCENE_CARD 16u               /* shaded by nothing nearer than its own primitive's longest edge */
#define SCENE_FACETED 32u            /* shadow rays start on its faces, whatever surface its normals describe */
#define SCENE_LEFT_OUT 64u           /* omitted: an effect that OpenGL faked, and that traced light produces itself */
#define SCENE_SOLID 128u             /* not blended: blending would mix in the mirror image that the program itself
                                        draws */
#define SCENE_DOME_LIT 256u          /* lit by scene.dome */
#define SCENE_NEAR_MIRROR 512u       /* mirrors nearby surfaces only; rays that meet none keep its own colour */
/* casts no shadow: seen through more than seen, or carved (look/spare/carved.h) */
#define SCENE_FILM 1024u
#define SCENE_UNSHADED 2048u         /* keeps the light that GL gives it, even if something blocks it */
#define SCENE_CREASED 8192u          /* has normals besides GL's, scene_mesh.crease */
/* transparent parts lead into a body, whichever side shows */
#define SCENE_ENTERED 16384u
#define SCENE_BACK_OUTSIDE 32768u    /* the back of transparent parts is outside */
#define SCENE_NO_NORMALS 4096u       /* near mirror that GL does not light: reflects about its faces */

/* Properties of a surface beyond GL, set by rules and rtMaterialEXT. All zero: as GL drew it. */
struct scene_surface {
	float reflect;   /* share of light mirrored, [0,1] */
	float transmit;  /* share of light let through, [0,1]; together with reflect at most 1 */
	float ior;       /* index of refraction where transmit > 0; 0 counts as 1 */
	float absorb[3]; /* if transmit > 0: absorption in a unit of eye space inside, exp(-absorb x length) */
	float roughness; /* for mirrors: how far directions deviate, as a share of their length */
	uint32_t hidden; /* bits: SCENE_HIDDEN_FROM_LIGHTS and following */
	float emission[3]; /* light it emits besides what GL shows */
	/* 1: besides GL's picture, which stays, the surface is lit at each pixel by scene.lights[light_first ..
	 * +light_count) instead of GL's own; surfaces that GL does not light are then matte, in the colour they show */
	uint32_t relit, light_first, light_count;
	uint32_t parameter_first, parameter_count; /* parameters for hooks: scene.parameters[parameter_first ..
	                                              +parameter_count), later ones win */
	uint32_t light_unit; /* if relit: 1 + the texture unit that holds light, which is then no part of its colour;
	                        SCENE_LIGHT_IN_COLORS; 0: none */
};

/* scene_surface.light_unit: vertex colours hold the light. */
#define SCENE_LIGHT_IN_COLORS 0xfffffffeu

/* Light from all directions. Set by rules, not by GL. */
struct scene_dome {
	float up_eye[3];           /* unit vector; all 0: no direction is up, and light is `light` everywhere */
	float reach; /* reach of occluders that dim it, near ones more, eye-space units; 0: there is no dome */
	float light[3], ground[3]; /* from straight up and straight down; in between, mixed in proportion to the height */
	float lit;                 /* [0,1]: its share where GL lights a surface; the rest is GL's light */
};

/* One stage of the fixed-function stencil, per side (GL 2.1 sec. 4.1.5). */
struct scene_stencil {
	uint32_t func;                /* GL token */
	uint32_t ref, compare_mask, write_mask;
	uint32_t fail, zfail, zpass; /* GL tokens */
};

/* Contents of a drawable with floating-point colours, as bits: floats, or halves that drawing truncates to. Both set:
 * floats. */
#define SCENE_FLOATS 1u
#define SCENE_HALVES 2u

/* All state that GL applies to a draw's vertices and fragments, except matrices, view and current attributes. */
struct scene_material {
	/* lighting, GL 2.1 sec. 2.14 */
	uint32_t lighting; /* 0: vertex colours are used unchanged */
	uint32_t light_first, light_count;
	float light_model_ambient[4];
	uint32_t local_viewer, separate_specular;
	uint32_t two_side; /* 1: back faces have their own colours, by lighting or by a vertex program */
	struct scene_face front, back;
	uint32_t color_material;      /* 0, or GL token: FRONT, BACK, FRONT_AND_BACK */
	uint32_t color_material_mode; /* GL token */
	uint32_t normalize, rescale_normal;
	uint32_t shade_model; /* GL token: FLAT, SMOOTH. Flat takes the colour of each primitive's last vertex */
	uint32_t first_provokes; /* 1: of a line, flat takes the first vertex */

	/* texturing: scene.units[unit_first .. +unit_count), in ascending order of unit */
	uint32_t unit_first, unit_count;
	uint32_t color_sum;

	/* fog, GL 2.1 sec. 3.10 */
	uint32_t fog;
	uint32_t fog_mode; /* GL token */
	uint32_t fog_coord_source; /* GL_FOG_COORD, or the measure of the distance to the viewer:
	                              GL_EYE_PLANE_ABSOLUTE_NV, GL_EYE_PLANE, GL_EYE_RADIAL_NV */
	float fog_density, fog_start, fog_end, fog_color[4];

	/* rasterization, GL 2.1 sec. 3.3 - 3.5 */
	uint32_t cull_face;  /* 0, or GL token: FRONT, BACK, FRONT_AND_BACK */
	uint32_t front_face; /* GL token: CW, CCW */
	uint32_t polygon_mode_front, polygon_mode_back; /* GL tokens */
	uint32_t polygon_offset; /* bits: 1 point, 2 line, 4 fill */
	float polygon_offset_factor, polygon_offset_units;
	uint32_t polygon_stipple; /* index of 32 rows in scene.stipples, or SCENE_NONE */
	uint32_t line_stipple;    /* factor << 16 | pattern; 0: off */
	float line_width, point_size;
	uint32_t line_smooth, point_smooth, polygon_smooth;
	uint32_t point_sprite; /* 0; 1: t = 0 at the top; 2: at the bottom */
	float point_attenuation[3], point_size_min, point_size_max, point_fade_threshold;
	/*
	 * Multisampling (sec. 3.2.1, 4.1.3); all 0 if disabled or if the drawable has one sample a pixel. Smoothing of
	 * lines, points and polygons is then off. samples_off: samples that SAMPLE_COVERAGE leaves out, a bit each.
	 */
	uint32_t multisample, samples_off, alpha_to_coverage, alpha_to_one;

	/* user clip planes in eye space (sec. 2.12): mask of enabled ones */
	uint32_t clip_plane_mask;
	float clip_plane_eye[SCENE_MAX_CLIP_PLANES][4];
	uint32_t clip_by_program; /* 1: planes clip by SCENE_RESULT_CLIP_VERTEX of the vertex program, if faces have
	                             only one colour */

	/* per-fragment operations, GL 2.1 sec. 4.1 (scissor: see the view) */
	uint32_t alpha_test, alpha_func; /* GL token */
	float alpha_ref;
	uint32_t stencil_test;
	struct scene_stencil stencil_front, stencil_back;
	uint32_t depth_test, depth_func, depth_write; /* func: GL token */
	uint32_t blend;
	uint32_t blend_equation_rgb, blend_equation_alpha;                       /* GL tokens */
	uint32_t blend_src_rgb, blend_dst_rgb, blend_src_alpha, blend_dst_alpha; /* GL tokens */
	float blend_color[4];
	uint32_t logic_op;   /* 0: off; else a GL token */
	uint32_t color_mask; /* bits: 1 red, 2 green, 4 blue, 8 alpha */
	uint32_t floats;     /* SCENE_FLOATS or SCENE_HALVES: drawn into such a drawable, without rounding to 8 bits; else 0 */
	uint32_t srgb;       /* 1: colours are encoded as sRGB, and blended in linear light (EXT_framebuffer_sRGB) */
	uint32_t unclamped;  /* bits: colours that may leave [0,1] (ARB_color_buffer_float): 1 of fragments, 2 of vertices */

	struct scene_surface surface;
	uint32_t program; /* 1: the draw used a program object or an ARB program */
	uint32_t fragment_program; /* 0: shaded by fixed function; else 1 + offset of the fragment program in scene.programs */
	uint32_t vertex_program;   /* the same for its vertices; `lighting` is then 0, and the lights are those that its
	                              programs read */
	uint32_t program_normals;  /* 1: the vertex program reads normals: unless it moves vertices, their normals are
	                              the surface's, as if lit */
};

/* One enabled texture unit as the draw saw it (GL 2.1 sec. 3.8). */
struct scene_unit {
	uint32_t unit;    /* number of the texture unit, from 0 */
	uint32_t texture; /* index into scene.textures; never SCENE_NONE (an incomplete texture disables its unit) */
	uint32_t wrap_s, wrap_t, wrap_r, min_filter, mag_filter; /* GL tokens */
	float border_color[4];
	float lod_bias, min_lod, max_lod; /* bias: texture object's plus unit's */
	float max_anisotropy;
	uint32_t compare_mode, compare_func, depth_mode; /* GL tokens; depth textures */
	/* 0, or SCENE_SWIZZLED and 3 bits for each of R G B A, R lowest: source channel of the sample; 4: zero, 5:
	 * one */
	uint32_t swizzle;
	/* environment, sec. 3.8.13 */
	uint32_t env_mode; /* GL token */
	float env_color[4];
	uint32_t combine_rgb, combine_alpha;                         /* GL tokens */
	uint32_t source_rgb[4], source_alpha[4];                     /* GL tokens; the fourth: NV_texture_env_combine4 */
	uint32_t operand_rgb[4], operand_alpha[4];                   /* GL tokens */
	float scale_rgb, scale_alpha;
	/* coordinate generation, sec. 2.11.4: per coordinate s t r q; mode 0: off, else GL token */
	uint32_t gen_mode[4];
	float gen_object_plane[4][4], gen_eye_plane[4][4];
	float matrix[16];
	uint32_t coord_replace; /* point sprites */
};

/* Attributes that no array or vertex gave: the current values at the time of the draw (sec. 2.7). */
struct scene_current {
	float color[4], secondary[4];
	float normal[4]; /* xyz */
	float texcoord[SCENE_MAX_UNITS][4];
	float fog_coord;
	float generics[SCENE_MAX_GENERICS][4]; /* vertex programs' attributes 1 and up */
};

/* One projection onto one target. */
struct scene_view {
	float projection[16];
	float viewport[4];    /* x y w h, pixels */
	float depth_range[2]; /* near, far */
	int32_t scissor[4];   /* x y w h, pixels, already cut to the target; the whole target if the test is off */
	uint32_t target;      /* 0: the window; else index into scene.targets (render to texture) */
	uint32_t space;       /* views with the same number share their eye space: secondary rays see all of it */
	uint32_t x87;         /* 1: GL multiplied projection and modelview as mat4_sums[1] does (base/mat4.h) */
};

/* One mesh in one place in one draw. */
struct scene_instance {
	uint32_t mesh;     /* scene.meshes */
	uint32_t material; /* scene.materials */
	uint32_t view;     /* scene.views */
	uint32_t current;  /* scene.currents */
	uint32_t draw;     /* draw number of its first primitive, counted from 1 in each frame */
	uint32_t first_primitive; /* see "Draw order" above */
	uint32_t given; /* SCENE_HAS_COLOR, SCENE_HAS_SECONDARY: the program gave each vertex its own colour, even if all
	                   are alike; llvmpipe then interpolates it, with rounding errors */
	float modelview[16]; /* object to eye space; may be singular or projective (planar shadows) */
	/*
	 * 0, or 1 + index into scene.rectangles. Each vertex of the mesh, a point, is then the outer corner of a
	 * rectangle's first pixel, in WINDOW coordinates: matrices are ignored. Current attributes are then final: lit,
	 * generated, transformed.
	 */
	uint32_t rectangle;
};

/* A bitmap or pixel rectangle (GL 2.1 sec. 3.6.4, 3.7): pixel (n, m) covers corner + zoom * (n..n+1, m..m+1). */
#define SCENE_BITMAP 1u         /* fragments of the current colour where alpha is not 0 */
#define SCENE_COLOR_PIXELS 2u   /* fragments with the texels' colours */
#define SCENE_DEPTH_PIXELS 3u   /* fragments with the texels' depth (one float each) and the current colour */
#define SCENE_STENCIL_PIXELS 4u /* no fragments: values (one integer each) written under the stencil mask */
#define SCENE_FLOAT_PIXELS 5u   /* as SCENE_COLOR_PIXELS, with texels of floats */
struct scene_rectangle {
	uint32_t kind;
	uint32_t texture; /* scene.textures: one level, rows from the first (m = 0) up */
	uint32_t width, height;
	float zoom[2];    /* window pixels per pixel of the rectangle; may be negative */
	uint32_t from_top; /* 1: rows are counted from the last, which rounds differently if a zoom puts a pixel's
	                      middle between two rows */
};
#define SCENE_FROM_TOP 8u /* added to the kind in the colours of such a rectangle's corners */

/* A Clear: an event between draws (GL 2.1 sec. 4.2.3). */
struct scene_clear {
	uint32_t before_instance; /* happens before scene.instances[before_instance], and after the preceding instance */
	uint32_t draw;            /* its draw number */
	uint32_t target;          /* as in scene_view */
	uint32_t buffers;         /* bits: 1 colour, 2 depth, 4 stencil */
	int32_t scissor[4];       /* as in scene_view */
	float color[4], depth;
	uint32_t stencil;
	uint32_t color_mask;   /* as in the material */
	uint32_t stencil_mask; /* write mask */
	uint32_t floats;       /* not 0: as in the material, so the colour may leave [0,1] */
};

enum { /* bits of scene_mesh.attributes; SCENE_HAS_TEXCOORD << unit, SCENE_HAS_GENERIC << (number - 1) */
	SCENE_HAS_NORMAL = 1, SCENE_HAS_COLOR = 2, SCENE_HAS_SECONDARY = 4, SCENE_HAS_FOG_COORD = 8,
	SCENE_HAS_TEXCOORD = 16, SCENE_HAS_GENERIC = SCENE_HAS_TEXCOORD << SCENE_MAX_UNITS,
	SCENE_HAS_FACE = SCENE_HAS_GENERIC << SCENE_MAX_GENERICS
};

#ifndef __OPENCL_VERSION__

/*
 * Bits of a primitive's edge flags. CONTINUES: a line stipple continues, as the primitive belongs to the same strip,
 * quad or polygon as the one before it. EARLIER: drawn as lines or points, it precedes the primitive before it, as Mesa
 * orders the halves of quad strips.
 */
enum { SCENE_CONTINUES = 8, SCENE_EARLIER = 16 };

enum scene_primitive { SCENE_POINTS = 1, SCENE_LINES = 2, SCENE_TRIANGLES = 3 }; /* = vertices per primitive */

/*
 * Geometry in object space, shared by content: meshes with equal bytes are one for as long as it is in use. Quads,
 * strips, fans and polygons are cut into triangles as Mesa's llvmpipe cuts them, with the provoking vertex last.
 * Owned by the replay's cache; valid until scene_release. Other caches (acceleration structures) use `hash` as key.
 */
struct scene_mesh {
	uint64_t hash[2]; /* XXH3-128 over kind, attributes and all arrays below */
	enum scene_primitive kind;
	uint32_t vertex_count, primitive_count;
	uint32_t attributes;
	const float *position;                   /* [vertex][4], w as given or 1 */
	const float *normal;                     /* [vertex][3] or NULL */
	const float *color;                      /* [vertex][4] or NULL */
	const float *secondary;                  /* [vertex][4] or NULL */
	const float *fog_coord;                  /* [vertex] or NULL */
	const float *crease; /* [primitive][3][3] or NULL: normals of its corners for light beyond GL's; not part of the
	                        hash. Set by rules */
	const float *texcoord[SCENE_MAX_UNITS];  /* [vertex][4] or NULL */
	const float *generics[SCENE_MAX_GENERICS]; /* [vertex][4] or NULL: vertex programs' attributes 1 and up */
	const struct scene_face (*face)[2];      /* [vertex] front and back, or NULL: as in the instance's material */
	const uint32_t *index;                   /* [primitive][kind] */
	const uint32_t *primitive_draw;          /* [primitive], added to instance.draw; NULL: all 0 */
	const uint8_t *edge_flags; /* [primitive], bit i: the edge from vertex i to i+1 is drawn; SCENE_CONTINUES ..;
	                              NULL: all 7 */
};

/*
 * Texture image, shared by content. Texels are RGBA, 8 bits each, as GL expands them for sampling (table 3.20: alpha
 * textures give 0,0,0,A, luminance L,L,L,1, intensity I,I,I,I), or four floats; depth textures hold one float each.
 */
struct scene_texture {
	uint64_t hash[2];
	uint32_t target;      /* GL token: TEXTURE_1D, 2D, 3D, CUBE_MAP, RECTANGLE */
	uint32_t base_format; /* GL token: ALPHA, LUMINANCE, LUMINANCE_ALPHA, INTENSITY, RED, RG, RGB, RGBA, DEPTH_COMPONENT */
	uint32_t width, height, depth; /* size of level 0, without border; powers of two or not */
	uint32_t n_levels;             /* complete ones only */
	uint32_t border;               /* 1: each level has a border of one texel around it, kept in the data */
	uint32_t floats;               /* 1: texels are four floats, which may leave [0,1] */
	const uint8_t *texels; /* all levels in order, finest first; faces of a level in GL's order; rows from t = 0 up */
	size_t n_bytes;
};

/*
 * Pixels of a drawable as GL's frame buffer holds them after each operation, rounded to its bits. Row 0 is the bottom
 * row. Arrays are [height][width]; those the drawable lacks (depth_bits 0) exist as well, with arbitrary contents.
 */
struct scene_picture {
	uint32_t width, height;
	uint32_t depth_bits; /* depth bits of the drawable, at most 24 */
	uint8_t *rgba;    /* 4 bytes each; alpha is 255 if the drawable has none */
	float *colors;    /* for drawables of floats: 4 floats each, not clamped; else NULL */
	uint32_t *depth;  /* in steps of the drawable's depth bits, at most 24 of them */
	uint8_t *stencil;
	uint32_t unknown; /* pixels that show, or whose tests read, pixels from before the scene that it does not hold */
	/* [SCENE_SAMPLES], a picture of each sample; `rgba` and `colors` are their means. NULL: one sample a pixel */
	struct scene_picture *samples;
};

/* A parameter of a user's hook, set by rules. */
struct scene_parameter {
	const char *name;
	float value[4];
	uint32_t count; /* number of values */
};

struct scene {
	uint64_t frame;         /* frame number in the trace, from 0 */
	uint64_t serial;        /* unique among the scenes of a process; a scene that grows keeps it */
	uint32_t width, height; /* size of the drawable and of the frame's picture */
	uint32_t depth_bits, stencil_bits, alpha_bits; /* bits of the drawable */
	uint32_t samples; /* samples a pixel; 0 counts as 1, more as SCENE_SAMPLES. Their positions: tracer/frame/trace.c */
	uint32_t floats;  /* not 0: colours are floats (ARB_color_buffer_float) */
	uint32_t output;  /* index, from 0, of the colour that the picture shows if programs draw to several buffers
	                     (scene_program.data) */
	uint32_t mesa;    /* enum scene_mesa: differences from 22.3 of the Mesa that drew the reference */
	uint32_t samples_from_below; /* 1: rows of samples count from the bottom, as in llvmpipe's framebuffer objects */

	/* Flat arrays, owned by the scene. */
	struct scene_instance *instances;
	struct scene_material *materials; /* equal ones stored once */
	struct scene_unit *units;
	struct scene_light *lights;
	struct scene_current *currents;
	struct scene_view *views;
	struct scene_clear *clears;
	uint32_t (*stipples)[32];
	struct scene_rectangle *rectangles;
	uint32_t n_rectangles;
	uint32_t *programs;   /* words of all programs (program.h) */
	uint32_t n_programs;  /* words */
	const struct scene_mesh **meshes;       /* the array belongs to the scene, the meshes to the cache */
	const struct scene_texture **textures;
	uint32_t n_instances, n_materials, n_units, n_lights, n_currents, n_views, n_clears, n_stipples, n_meshes,
		n_textures;
	uint32_t n_primitives; /* sum over all instances */
	struct scene_dome dome;
	const struct scene_parameter *parameters; /* [n_parameters], owned by the rules; those that apply to all
	                                             surfaces come first */
	uint32_t n_parameters, n_shared_parameters;
	uint32_t kd_tree; /* 1: a program that drew here has called rtBuildKdTreeEXT before */
	uint32_t n_draws;
	uint64_t time_ns; /* time of the frame's end in the program, by a monotonic clock; 0: not in the recording */
	/* 1: the frame drew or read something before it cleared the whole buffer, so `start` shows where nothing covers
	 * it */
	uint32_t needs_previous;
	uint32_t is_first; /* 1: the first frame: uncovered pixels are black, with depth 0 and stencil 0 */
	uint32_t keeps_depth; /* 1: depth may come from earlier frames; events that read it also set needs_previous */
	uint32_t untraced_draw; /* draw that shows a framebuffer object's lit picture whose scene was omitted; 0: none */
	uint32_t shows_earlier; /* 1: a texture or buffer lacks what an earlier frame drew, as this replay renders nothing */
	const struct scene_picture *start; /* pixels before the first event; NULL: all 0, unknown, or not rendered */
	struct scene_before *before; /* the scene that shows `start`, if not yet rendered (before.h); NULL: none */

	/* Source of each draw number: the name and number of its call in the trace, for blame. [n_draws + 1], 0
	 * unused */
	struct scene_draw {
		const char *call; /* a static string */
		uint64_t call_number;
		uint32_t list; /* display list that made the call, by the program's name; 0: none */
		struct scene_draw_program {
			const char *kind; /* "program object", "vertex program", "fragment program": a static string;
			                     NULL: no program, and none follows */
			uint32_t name;
		} programs[SCENE_DRAW_PROGRAMS]; /* programs that the draw ran */
	} *draws;

	void (*release)(struct scene *scene); /* takes a reference back for the maker (release.h); NULL: not counted */
};

/**
 * Renders a scene's pixels for a caller that needs them back, as GL itself drew them, over its initial pixels if it has
 * them.
 * @param scene    part of a frame, or a whole one; borrowed
 * @param picture  of the scene's size, arrays allocated but undefined; to be filled
 * @return 0 or ERR_* (reported)
 */
typedef int scene_supply(void *user, const struct scene *scene, struct scene_picture *picture);

#endif
