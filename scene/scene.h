/*
 * The scene of one frame: all that the tracer gets to see. The boundary between replay/ and tracer/.
 *
 * Conventions
 *   matrices   float[16], column-major, column vectors, p' = M p (as OpenGL's own)
 *   eye space  right-handed, the viewer looks along -z; each draw's own modelview leads into it
 *   windows    pixels, origin at the lower left corner, pixel centres at .5; row 0 is the bottom row
 *   colours    GL's display-referred numbers; [0,1] unless GL itself lets them out of it
 *   tokens     a field that says "GL token" holds the number of the GL enum (0x0B..); scene.h names none of them
 *   indices    uint32_t into the arrays of struct scene; SCENE_NONE where there is nothing
 *
 * Nothing here points back into the GL state: what a draw saw was copied when it was drawn. Plain structs of 4-byte
 * fields are shared with the kernels as they stand; the host-only part follows at the end.
 *
 * Draw order: instances are sorted by it, primitives of a mesh are in it, and a clear names the instance it precedes.
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
#define SCENE_MAX_GENERICS 15 /* vertex programs' attributes beside the position */
#define SCENE_MAX_LIGHTS 8
#define SCENE_DRAW_PROGRAMS 2 /* of vertices and of fragments */
#define SCENE_MAX_CLIP_PLANES 8 /* GL 2.1 wants six; Mesa has eight */
#define SCENE_NONE 0xffffffffu
#define SCENE_SWIZZLED 0x1000u
#define SCENE_SAMPLES 4 /* of a pixel, where it has several, whatever their number was */

/* One enabled light as the draw saw it (GL 2.1 sec. 2.14.1, table 2.10). */
struct scene_light {
	float ambient[4], diffuse[4], specular[4];
	float position_eye[4];       /* homogeneous; w == 0 is a direction towards the light */
	float spot_direction_eye[3]; /* as GL keeps it: not normalised */
	float spot_exponent;
	float spot_cutoff_deg; /* 180: no spot */
	float attenuation[3];  /* constant, linear, quadratic */
	uint32_t index;        /* 0..7: which GL_LIGHTi */
	float radius; /* of the light's sphere, eye-space units; 0: a point; below 0: nothing stops it. Set by rules,
	                 not by GL */
};

/* Material of one side (GL 2.1 table 2.9). */
struct scene_face {
	float ambient[4], diffuse[4], specular[4], emission[4];
	float shininess;
};

/* What a surface is hidden from, and what of it the beauty goes without. */
#define SCENE_HIDDEN_FROM_LIGHTS 1u  /* casts no shadow */
#define SCENE_HIDDEN_FROM_MIRRORS 2u /* is not seen in mirrors and through glass */
/* light that comes from behind the only side that it shows passes (look/sides.h) */
#define SCENE_ONE_SIDED 4u
/* nothing: with the last, corners of the shown side run counter-clockwise in object space, on all triangles */
#define SCENE_SHOWN_COUNTER 65536u
#define SCENE_SHOWN_CLOCKWISE 131072u
#define SCENE_STOPS_NO_SUN 8u        /* light at infinity passes */
#define SCENE_CARD 16u               /* nothing nearer than its own primitive's longest edge shades it */
#define SCENE_FACETED 32u            /* rays to lights start on its faces, whatever surface its normals mean */
#define SCENE_LEFT_OUT 64u           /* all: a trick that OpenGL drew; traced light does the same */
#define SCENE_SOLID 128u             /* its blending: that mixes in what stands for a mirror's picture */
#define SCENE_DOME_LIT 256u          /* nothing: scene.dome lights it */
#define SCENE_NEAR_MIRROR 512u       /* nothing: it mirrors what is there, and keeps its own colour where nothing is */
/* lights: it casts no shadow, as it is more seen through than seen, or carved (look/carved.h) */
#define SCENE_FILM 1024u
#define SCENE_UNSHADED 2048u         /* nothing: it keeps the light that GL gives it, whatever stands in its way */
#define SCENE_CREASED 8192u          /* nothing: its mesh has normals beside GL's, scene_mesh.crease */
/* nothing: what lets light through here leads into a body, whichever side is shown */
#define SCENE_ENTERED 16384u
#define SCENE_BACK_OUTSIDE 32768u    /* nothing: what lets light through here has its back outside */
#define SCENE_NO_NORMALS 4096u       /* nothing: a near mirror that GL does not light turns rays about its faces */

/* What rules and rtMaterialEXT say about a surface beyond GL. All zero: what GL drew, nothing else. */
struct scene_surface {
	float reflect;   /* share of light mirrored, [0,1] */
	float transmit;  /* share of light let through, [0,1]; together with reflect at most 1 */
	float ior;       /* index of refraction where transmit > 0; 0 counts as 1 */
	float absorb[3]; /* where transmit > 0: what a unit of eye space inside takes of the light, exp(-absorb x length) */
	float roughness; /* of mirrors: how far directions stray, as a share of the direction's length */
	uint32_t hidden; /* bits: SCENE_HIDDEN_FROM_LIGHTS and what follows it */
	float emission[3]; /* light of its own beside what GL shows */
	/* 1: beside GL's picture, which stays, the surface is lit at each pixel by scene.lights[light_first .. +light_count)
	   instead of GL's own; what GL does not light is then matte, of the colour it shows */
	uint32_t relit, light_first, light_count;
	uint32_t parameter_first, parameter_count; /* of hooks: scene.parameters[parameter_first .. +parameter_count),
	                                              the last one last */
	uint32_t light_unit; /* of what is relit: 1 + the texture unit that holds light, and is no part of its colour;
	                        SCENE_LIGHT_IN_COLORS; 0: none */
};

/* scene_surface.light_unit: vertex colours hold the light. */
#define SCENE_LIGHT_IN_COLORS 0xfffffffeu

/* Light from all around. Set by rules, not by GL. */
struct scene_dome {
	float up_eye[3];           /* unit vector; all 0: no direction is up, and all are `light` */
	float reach; /* things dim it up to this distance, eye-space units, near ones more; 0: there is no dome */
	float light[3], ground[3]; /* from straight up and from straight down; in between in proportion to the height */
	float lit;                 /* [0,1]: how much of it counts where GL lights a surface, and the rest is GL's */
};

/* One stage of the fixed-function stencil, per side (GL 2.1 sec. 4.1.5). */
struct scene_stencil {
	uint32_t func;                /* GL token */
	uint32_t ref, compare_mask, write_mask;
	uint32_t fail, zfail, zpass; /* GL tokens */
};

/* What a drawable of floats holds: floats, or in all of its colours halves, of which drawing cuts off what they have no
 * room for. Bits: both is floats. */
#define SCENE_FLOATS 1u
#define SCENE_HALVES 2u

/* Everything GL looks at for a fragment or vertex of this draw, but for matrices, view and current attributes. */
struct scene_material {
	/* lighting, GL 2.1 sec. 2.14 */
	uint32_t lighting; /* 0: colours are taken as they are */
	uint32_t light_first, light_count;
	float light_model_ambient[4];
	uint32_t local_viewer, separate_specular;
	uint32_t two_side; /* 1: back faces have colours of their own, by lighting or a vertex program */
	struct scene_face front, back;
	uint32_t color_material;      /* 0, or GL token: FRONT, BACK, FRONT_AND_BACK */
	uint32_t color_material_mode; /* GL token */
	uint32_t normalize, rescale_normal;
	uint32_t shade_model; /* GL token: FLAT, SMOOTH. Flat takes the last vertex of each primitive */
	uint32_t first_provokes; /* 1: but of a line the first one */

	/* texturing: scene.units[unit_first .. +unit_count), in ascending order of unit */
	uint32_t unit_first, unit_count;
	uint32_t color_sum;

	/* fog, GL 2.1 sec. 3.10 */
	uint32_t fog;
	uint32_t fog_mode; /* GL token */
	uint32_t fog_coord_source; /* GL_FOG_COORD, or how far from the viewer: GL_EYE_PLANE_ABSOLUTE_NV, GL_EYE_PLANE,
	                              GL_EYE_RADIAL_NV */
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
	 * Multisampling (sec. 3.2.1, 4.1.3), all 0 where the drawable has one sample a pixel or it is disabled. Then no
	 * smoothing of lines, points or polygons is asked for. samples_off: samples that SAMPLE_COVERAGE leaves out, a
	 * bit each.
	 */
	uint32_t multisample, samples_off, alpha_to_coverage, alpha_to_one;

	/* user clip planes in eye space (sec. 2.12): mask of enabled ones */
	uint32_t clip_plane_mask;
	float clip_plane_eye[SCENE_MAX_CLIP_PLANES][4];
	uint32_t clip_by_program; /* 1: they clip by what the vertex program says (SCENE_RESULT_CLIP_VERTEX), where
	                             faces have one colour alone */

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
	uint32_t logic_op;   /* 0: off; else GL token */
	uint32_t color_mask; /* bits: 1 red, 2 green, 4 blue, 8 alpha */
	uint32_t floats;     /* SCENE_FLOATS or SCENE_HALVES: into a drawable of such, and nothing is rounded to 8 bits; 0 */
	uint32_t srgb;       /* 1: colours are encoded as sRGB, and blended in linear light (EXT_framebuffer_sRGB) */
	uint32_t unclamped;  /* bits: colours that may leave [0,1] (ARB_color_buffer_float): 1 of fragments, 2 of vertices */

	struct scene_surface surface;
	uint32_t program; /* 1: the draw used a program object or ARB program */
	uint32_t fragment_program; /* 0, or 1 + where in scene.programs the program that shades it begins; else it is
	                              rendered as fixed function */
	uint32_t vertex_program;   /* the same of its vertices; `lighting` is 0 then, and lights are those that its
	                              programs read */
	uint32_t program_normals;  /* 1: that one reads normals: those of vertices that it does not move are the
	                              surface's, as of a lit one */
};

/* One enabled texture unit as a draw saw it (GL 2.1 sec. 3.8). */
struct scene_unit {
	uint32_t unit;    /* 0..: which texture unit */
	uint32_t texture; /* index into scene.textures; never SCENE_NONE (an incomplete texture disables its unit) */
	uint32_t wrap_s, wrap_t, wrap_r, min_filter, mag_filter; /* GL tokens */
	float border_color[4];
	float lod_bias, min_lod, max_lod; /* bias: texture object's plus unit's */
	float max_anisotropy;
	uint32_t compare_mode, compare_func, depth_mode; /* GL tokens; depth textures */
	/* 0, or SCENE_SWIZZLED and 3 bits for each of R G B A, R lowest: which channel of the sample it is; 4: zero, 5: one */
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

/* Attributes that no array or vertex gave: the current values when the draw was made (sec. 2.7). */
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
	int32_t scissor[4];   /* x y w h, pixels, already cut to the target; the whole target where the test is off */
	uint32_t target;      /* 0: the window. Others: scene.targets (render to texture) */
	uint32_t space;       /* views with the same number share their eye space: secondary rays see all of it */
	uint32_t x87;         /* 1: GL multiplied the projection and the modelview matrix as mat4_sums[1] does (base/mat4.h) */
};

/* One mesh at one place in one draw. */
struct scene_instance {
	uint32_t mesh;     /* scene.meshes */
	uint32_t material; /* scene.materials */
	uint32_t view;     /* scene.views */
	uint32_t current;  /* scene.currents */
	uint32_t draw;     /* draw number of its first primitive, counted from 1 in each frame */
	uint32_t first_primitive; /* see "Draw order" above */
	float modelview[16]; /* object to eye space; may be singular or projective (planar shadows) */
	/*
	 * 0, or 1 + the index in scene.rectangles of what each vertex of the mesh (points, in WINDOW coordinates:
	 * matrices count for nothing) is the first pixel's outer corner of. Then current attributes are final: lit,
	 * generated, transformed.
	 */
	uint32_t rectangle;
};

/* A bitmap or pixel rectangle (GL 2.1 sec. 3.6.4, 3.7): pixel (n, m) covers what the corner + zoom * (n..n+1, m..m+1)
 * does. */
#define SCENE_BITMAP 1u         /* fragments where alpha is not 0, of the current colour */
#define SCENE_COLOR_PIXELS 2u   /* fragments of the texels' colours */
#define SCENE_DEPTH_PIXELS 3u   /* fragments of the texels' depth (a float each) and the current colour */
#define SCENE_STENCIL_PIXELS 4u /* no fragments: values (an integer each) written under the stencil mask */
#define SCENE_FLOAT_PIXELS 5u   /* as SCENE_COLOR_PIXELS, but that the texels are floats */
struct scene_rectangle {
	uint32_t kind;
	uint32_t texture; /* scene.textures: one level, rows from the first (m = 0) on */
	uint32_t width, height;
	float zoom[2];    /* pixels of the window a pixel of the rectangle; may be negative */
	uint32_t from_top; /* 1: rows are counted from the last. Rounds otherwise where a zoom puts the middle of a
	                      pixel on the border of two rows */
};
#define SCENE_FROM_TOP 8u /* added to the kind of such a rectangle in its corners' colours */

/* A Clear: an event between draws (GL 2.1 sec. 4.2.3). */
struct scene_clear {
	uint32_t before_instance; /* happens before scene.instances[before_instance], after the one in front of it */
	uint32_t draw;            /* its number in the draw count */
	uint32_t target;          /* as in scene_view */
	uint32_t buffers;         /* bits: 1 colour, 2 depth, 4 stencil */
	int32_t scissor[4];       /* as in scene_view */
	float color[4], depth;
	uint32_t stencil;
	uint32_t color_mask;   /* as in the material */
	uint32_t stencil_mask; /* write mask */
	uint32_t floats;       /* not 0: as in the material: the colour may be beyond [0,1] */
};

enum { /* bits of scene_mesh.attributes; SCENE_HAS_TEXCOORD << unit, SCENE_HAS_GENERIC << (number - 1) */
	SCENE_HAS_NORMAL = 1, SCENE_HAS_COLOR = 2, SCENE_HAS_SECONDARY = 4, SCENE_HAS_FOG_COORD = 8,
	SCENE_HAS_TEXCOORD = 16, SCENE_HAS_GENERIC = SCENE_HAS_TEXCOORD << SCENE_MAX_UNITS,
	SCENE_HAS_FACE = SCENE_HAS_GENERIC << SCENE_MAX_GENERICS
};

#ifndef __OPENCL_VERSION__

/*
 * Of a primitive's edge flags. CONTINUES: a line stipple does not start anew, the primitive belongs to the strip, quad
 * or polygon of the one drawn before it. EARLIER: drawn as lines or points it comes before the primitive in front of
 * it, as Mesa has the halves of quad strips.
 */
enum { SCENE_CONTINUES = 8, SCENE_EARLIER = 16 };

enum scene_primitive { SCENE_POINTS = 1, SCENE_LINES = 2, SCENE_TRIANGLES = 3 }; /* = vertices per primitive */

/*
 * Geometry in object space, found by content: equal bytes are one mesh for as long as it is in use. Quads, strips, fans
 * and polygons are cut into triangles the way Mesa's llvmpipe cuts them, with the provoking vertex last.
 * Owned by the replay's cache; valid until scene_release. `hash` is what other caches (acceleration structures) key on.
 */
struct scene_mesh {
	uint64_t hash[2]; /* XXH3-128 over kind, attributes and all arrays below */
	enum scene_primitive kind;
	uint32_t vertex_count, primitive_count;
	uint32_t attributes;
	const float *position;                   /* [vertex][4], w given or 1 */
	const float *normal;                     /* [vertex][3] or NULL */
	const float *color;                      /* [vertex][4] or NULL */
	const float *secondary;                  /* [vertex][4] or NULL */
	const float *fog_coord;                  /* [vertex] or NULL */
	const float *crease; /* [primitive][3][3] or NULL: its corners' normals for light beyond GL's, no part of the
	                        hash. Set by rules */
	const float *texcoord[SCENE_MAX_UNITS];  /* [vertex][4] or NULL */
	const float *generics[SCENE_MAX_GENERICS]; /* [vertex][4] or NULL: vertex programs' attributes 1 and up */
	const struct scene_face (*face)[2];      /* [vertex] front and back, or NULL: those of the instance's material */
	const uint32_t *index;                   /* [primitive][kind] */
	const uint32_t *primitive_draw;          /* [primitive], to be added to instance.draw; NULL: all 0 */
	const uint8_t *edge_flags; /* [primitive], bit i: edge from vertex i to i+1 is drawn; SCENE_CONTINUES ..; NULL:
	                              all 7 */
};

/*
 * Texture image, found by content. Texels are RGBA, 8 bits each, as GL expands them for sampling (table 3.20: alpha
 * textures give 0,0,0,A, luminance L,L,L,1, intensity I,I,I,I), or four floats; depth textures hold one float each.
 */
struct scene_texture {
	uint64_t hash[2];
	uint32_t target;      /* GL token: TEXTURE_1D, 2D, 3D, CUBE_MAP, RECTANGLE */
	uint32_t base_format; /* GL token: ALPHA, LUMINANCE, LUMINANCE_ALPHA, INTENSITY, RED, RG, RGB, RGBA, DEPTH_COMPONENT */
	uint32_t width, height, depth; /* of level 0, without border; powers of two or not */
	uint32_t n_levels;             /* complete ones only */
	uint32_t border;               /* 1: each level has a border of one texel around it, kept in the data */
	uint32_t floats;               /* 1: texels are four floats, which may be beyond [0,1] */
	const uint8_t *texels; /* all levels, finest first, one after the other; faces of a level in GL's order; rows
	                          from t = 0 up */
	size_t n_bytes;
};

/*
 * Pixels of a drawable as GL's frame buffer holds them after each operation: rounded to its bits. Row 0 is the bottom
 * row. Arrays are [height][width]; what a drawable has not (depth_bits 0) is there all the same and means nothing.
 */
struct scene_picture {
	uint32_t width, height;
	uint32_t depth_bits; /* of the drawable, at most 24 */
	uint8_t *rgba;    /* 4 bytes each; alpha is 255 where the drawable has none */
	float *colors;    /* of a drawable of floats the same as 4 of them each, not clamped; else NULL */
	uint32_t *depth;  /* in steps of the drawable's depth bits, of which at most 24 count */
	uint8_t *stencil;
	uint32_t unknown; /* pixels that show, or whose tests looked at, something from before the scene that it does
	                     not hold */
	/* [SCENE_SAMPLES], a picture of each sample; `rgba` and `colors` are their means. NULL: one sample a pixel. */
	struct scene_picture *samples;
};

/* A parameter of a user's hook, as rules set it. */
struct scene_parameter {
	const char *name;
	float value[4];
	uint32_t count; /* of values */
};

struct scene {
	uint64_t frame;         /* number in the trace, from 0 */
	uint64_t serial;        /* different for each scene of a process; one that grows keeps it */
	uint32_t width, height; /* of the drawable; the frame's picture */
	uint32_t depth_bits, stencil_bits, alpha_bits; /* of the drawable */
	uint32_t samples; /* of a pixel; 0 counts as 1, more as SCENE_SAMPLES. Where they are: tracer/frame/trace.c */
	uint32_t floats;  /* not 0: its colours are floats (ARB_color_buffer_float) */
	uint32_t output;  /* which of the colours of programs that draw to several buffers it shows, from 0
	                     (scene_program.data) */
	uint32_t mesa;    /* enum scene_mesa: what the Mesa that drew the reference does otherwise than 22.3 */
	uint32_t samples_from_below; /* 1: their rows count from the bottom, as llvmpipe has it in framebuffer objects */

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
	const struct scene_mesh **meshes;       /* the array is the scene's, the meshes are the cache's */
	const struct scene_texture **textures;
	uint32_t n_instances, n_materials, n_units, n_lights, n_currents, n_views, n_clears, n_stipples, n_meshes,
		n_textures;
	uint32_t n_primitives; /* in all instances */
	struct scene_dome dome;
	const struct scene_parameter *parameters; /* [n_parameters], the rules'; those of all surfaces come first */
	uint32_t n_parameters, n_shared_parameters;
	uint32_t kd_tree; /* 1: of what drew here, some program has called rtBuildKdTreeEXT before */
	uint32_t n_draws;
	uint64_t time_ns; /* when the program ended the frame, by a clock that never runs backwards; 0: the recording
	                     does not tell */
	/* 1: something was drawn, or looked at, before the whole buffer was cleared: `start` shows through where
	 * nothing covers it */
	uint32_t needs_previous;
	uint32_t is_first; /* 1: there was nothing before it: black, depth 0 and stencil 0 are what shows through */
	uint32_t keeps_depth; /* 1: depth may be that of frames before; what looks at it sets needs_previous, too */
	uint32_t untraced_draw; /* a draw that shows a framebuffer object's lit picture, of which the scene was left
	                           out; 0: none */
	uint32_t shows_earlier; /* 1: a texture or buffer lacks what an earlier frame drew, as nothing renders during
	                           this replay */
	const struct scene_picture *start; /* what was there before the first event; NULL: all 0, not known, or not made */
	struct scene_before *before; /* the scene that shows `start`, which is not made yet (before.h); NULL: there is
	                                none */

	/* What became of each draw number: the call's name and number in the trace, for blame. [n_draws + 1], 0 unused */
	struct scene_draw {
		const char *call; /* a static string */
		uint64_t call_number;
		uint32_t list; /* the display list that it came from, as the program called it; 0: none */
		struct scene_draw_program {
			const char *kind; /* "program object", "vertex program", "fragment program": a static string;
			                     NULL: there is none, nor another */
			uint32_t name;
		} programs[SCENE_DRAW_PROGRAMS]; /* that it ran */
	} *draws;

	void (*release)(struct scene *scene); /* how its maker takes a reference back (release.h); NULL: nobody counts */
};

/**
 * Makes pixels of a scene for who needs them back: what GL itself drew, from what it begins with on where that is
 * there.
 * @param scene    part of a frame, or a whole one; borrowed
 * @param picture  of the scene's size, arrays there and undefined; to be filled
 * @return 0 or ERR_* (reported)
 */
typedef int scene_supply(void *user, const struct scene *scene, struct scene_picture *picture);

#endif
