/*
 * The state of one GL context, grouped like the state tables of the GL 2.1 specification (chapter 6).
 *
 * Tokens have their GL values (build/gen/gl_tokens.h). Matrices follow scene.h. Objects are referred to by name, not by
 * pointer: a name is looked up in the share group when it is used.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "scene/scene.h"
#include "base/mat4.h"
#include "base/table.h"

#define GLS_MAX_UNITS SCENE_MAX_UNITS
#define GLS_MAX_LIGHTS SCENE_MAX_LIGHTS
#define GLS_MAX_CLIP_PLANES SCENE_MAX_CLIP_PLANES
#define GLS_MAX_MATRICES 32
#define GLS_MAX_TEXTURE_MATRICES 10
#define GLS_MAX_ATTRIB_DEPTH 16
#define GLS_MAX_PROGRAM_PARAMETERS 256 /* per context and target */
#define GLS_MAX_PROGRAM_LOCALS 2048    /* per assembly program, as in llvmpipe */
#define GLS_MAX_PROGRAM_MATRICES 8

/* Vertex attributes; the conventional ones are in the order of scene_current. */
enum gls_attribute {
	GLS_ATTR_NORMAL, GLS_ATTR_COLOR, GLS_ATTR_SECONDARY, GLS_ATTR_FOG_COORD, GLS_ATTR_TEXCOORD,
	GLS_ATTR_GENERIC = GLS_ATTR_TEXCOORD + GLS_MAX_UNITS, /* attribute 1 of vertex programs; the others follow */
	N_GLS_ATTRIBUTES = GLS_ATTR_GENERIC + SCENE_MAX_GENERICS
};
/* As bits of scene_mesh.attributes: 1 << attribute. */

/* Tables 6.5, 6.6: current values. attribute[][4]: the normal uses 3 components, the fog coordinate 1. */
struct gls_current {
	float attribute[N_GLS_ATTRIBUTES][4];
	float generic0[4]; /* attribute 0 as set by VertexAttrib outside Begin and End, where it is not a vertex */
	uint32_t edge_flag;
	float index;
	/* current raster position (sec. 2.13) */
	float raster_position[4]; /* window coordinates and clip w */
	float raster_color[4], raster_secondary[4], raster_texcoord[GLS_MAX_UNITS][4];
	uint32_t raster_valid;
};

/* Table 6.8: transformation (the stacks themselves are not in an attribute group). */
struct gls_transform {
	uint32_t matrix_mode;
	uint32_t normalize, rescale_normal;
	uint32_t clip_plane_mask;
	float clip_plane_eye[GLS_MAX_CLIP_PLANES][4];
};

struct gls_viewport {
	float rect[4];
	float depth_range[2];
};

/* Tables 6.9, 6.10, 6.11. */
struct gls_light {
	uint32_t enabled;
	struct scene_light value; /* index and radius are set once */
};
struct gls_lighting {
	uint32_t enabled;
	uint32_t color_material, color_material_face, color_material_mode;
	struct scene_face face[2]; /* front, back */
	float model_ambient[4];
	uint32_t local_viewer, two_side, separate_specular;
	uint32_t shade_model;
	uint32_t first_provokes; /* 1: FIRST_VERTEX_CONVENTION (ARB_provoking_vertex) */
	uint32_t clamp;          /* clamping of vertex colours (ARB_color_buffer_float): FIXED_ONLY, or a boolean */
	struct gls_light lights[GLS_MAX_LIGHTS];
};

/* Table 6.8, fog. */
struct gls_fog {
	uint32_t enabled, mode, coord_source, distance_mode, color_sum;
	float density, start, end, color[4], index;
};

/* Tables 6.12, 6.13: rasterization. */
struct gls_point {
	float size, size_min, size_max, fade_threshold, attenuation[3];
	uint32_t smooth, sprite, sprite_origin;
};
struct gls_line {
	float width;
	uint32_t smooth, stipple, stipple_pattern, stipple_factor;
};
struct gls_polygon {
	uint32_t cull, cull_face, front_face, mode[2], smooth;
	uint32_t offset_point, offset_line, offset_fill;
	float offset_factor, offset_units;
	uint32_t stipple;
};
struct gls_multisample {
	uint32_t enabled, alpha_to_coverage, alpha_to_one, coverage;
	float coverage_value;
	uint32_t coverage_invert;
};

/* Tables 6.14 - 6.18: texturing. */
enum gls_texture_target {
	GLS_TEXTURE_1D, GLS_TEXTURE_2D, GLS_TEXTURE_3D, GLS_TEXTURE_CUBE, GLS_TEXTURE_RECTANGLE,
	GLS_TEXTURE_2D_ARRAY, /* programs alone look it up (EXT_texture_array) */
	N_GLS_TEXTURE_TARGETS
};
struct gls_unit {
	uint32_t enabled;                       /* bits 1 << gls_texture_target */
	uint32_t bound[N_GLS_TEXTURE_TARGETS];  /* names; 0: the default texture */
	uint32_t gen_enabled;                   /* bits 1 << (s t r q) */
	uint32_t sampler;                       /* name of a sampler object; 0: the texture's own parameters */
	struct scene_unit value;                /* env_*, combine_*, source_*, operand_*, scale_*, gen_*, coord_replace */
	float lod_bias;
};
struct gls_texturing {
	uint32_t active; /* unit */
	struct gls_unit units[GLS_MAX_UNITS];
};

/* The draw buffers are not in ascending order. */
#define GLS_OUT_OF_ORDER (1u << 31)

/* Tables 6.19 - 6.21: per-fragment operations and the framebuffer. */
struct gls_scissor {
	uint32_t enabled;
	int32_t rect[4];
};
struct gls_stencil {
	uint32_t enabled, two_side, active_face; /* two_side and active_face: EXT_stencil_two_side */
	struct scene_stencil side[2];            /* front, back */
	uint32_t clear;
};
struct gls_depth {
	uint32_t enabled, func, write;
	float clear;
};
struct gls_color_buffer {
	uint32_t alpha_test, alpha_func;
	float alpha_ref;
	uint32_t blend, equation_rgb, equation_alpha, src_rgb, dst_rgb, src_alpha, dst_alpha;
	float blend_color[4];
	uint32_t logic_op_enabled, index_logic_op_enabled, logic_op;
	uint32_t dither;
	uint32_t mask; /* bits: 1 red, 2 green, 4 blue, 8 alpha */
	uint32_t draw_buffer;
	uint32_t also_drawn; /* further colour attachments drawn to: 1 << number; or GLS_OUT_OF_ORDER */
	uint32_t framebuffer_srgb; /* 1: colours are encoded when written to an sRGB buffer (EXT_framebuffer_sRGB) */
	uint32_t clamp; /* clamping of fragment colours, as gls_lighting.clamp */
	float clear[4];
};
struct gls_accum {
	float clear[4];
};

/* Table 6.25: pixel transfer. */
struct gls_pixel {
	float scale[4], bias[4], depth_scale, depth_bias;
	int32_t index_shift, index_offset;
	uint32_t map_color, map_stencil;
	float zoom[2];
	uint32_t read_buffer;
};

/* Table 6.26: a pixel map; these are in no attribute group. Initially one element, 0 (sec. 3.6.3). */
#define GLS_MAX_PIXEL_MAP 256
enum { N_GLS_PIXEL_MAPS = 10 }; /* in the order of their tokens, PIXEL_MAP_I_TO_I first */
struct gls_pixel_map {
	uint32_t size; /* 0: the initial state */
	float values[GLS_MAX_PIXEL_MAP];
};

struct gls_evaluator {
	uint32_t map1, map2; /* bits of enabled maps, GL_MAP1_COLOR_4 is bit 0 */
	uint32_t auto_normal;
	float grid1[2], grid2[4];
	int32_t grid1_segments, grid2_segments[2];
};

/*
 * Which programs are enabled, and vertex programs' point size and two-sided lighting (ARB_vertex_program, table X.6;
 * ATI_fragment_shader).
 */
struct gls_programs {
	uint32_t vertex, fragment, point_size, two_side, ati;
};

struct gls_hint {
	uint32_t fog, perspective, point, line, polygon, mipmap;
};

/* Everything that PushAttrib can save: one sub-struct per group of table 6.1 ff. */
struct gls_attribs {
	struct gls_current current;
	struct gls_transform transform;
	struct gls_viewport viewport;
	struct gls_lighting lighting;
	struct gls_fog fog;
	struct gls_point point;
	struct gls_line line;
	struct gls_polygon polygon;
	uint32_t polygon_stipple[32];
	struct gls_multisample multisample;
	struct gls_texturing texturing;
	struct gls_scissor scissor;
	struct gls_stencil stencil;
	struct gls_depth depth;
	struct gls_color_buffer color;
	struct gls_accum accum;
	struct gls_pixel pixel;
	struct gls_evaluator evaluator;
	struct gls_hint hint;
	struct gls_programs programs;
	uint32_t list_base;
};

/* Table 6.23: pixel storage. */
struct gls_pixel_store {
	int32_t swap_bytes, lsb_first, row_length, image_height, skip_rows, skip_pixels, skip_images, alignment;
	uint32_t buffer; /* bound pixel pack or unpack buffer */
};

/* Tables 6.6, 6.7: vertex arrays. */
struct gls_array {
	uint32_t enabled;
	int32_t size;
	uint32_t type;
	int32_t stride;    /* as given; 0: tight */
	uint32_t buffer;   /* name of the array buffer bound when the pointer was given, 0: client memory */
	uint64_t offset;   /* in the buffer */
	uint32_t normalized;
	uint8_t *client;   /* owned copy of the client memory, as recorded */
	size_t client_bytes, client_room;
	uint64_t version;  /* changes with the contents of `client` */
};
enum gls_array_index {
	GLS_ARRAY_VERTEX = N_GLS_ATTRIBUTES, GLS_ARRAY_GENERIC0, GLS_ARRAY_EDGE_FLAG, GLS_ARRAY_INDEX, GLS_ARRAY_POINT_SIZE,
	N_GLS_ARRAYS
};
struct gls_client_attribs {
	struct gls_pixel_store pack, unpack;
	struct gls_array arrays[N_GLS_ARRAYS]; /* 0 .. N_GLS_ATTRIBUTES-1: as gls_attribute */
	uint32_t active_texture;               /* client active unit */
	uint32_t vertex_array;                 /* name of the vertex array object that `arrays` belongs to; 0: none */
	uint32_t array_buffer, element_buffer, copy_read_buffer, copy_write_buffer, indirect_buffer;
	uint32_t lock_first, lock_count;
	uint32_t restart, restart_fixed, restart_index; /* an index that restarts the primitive: NV_primitive_restart,
	                                                   GL 3.1 */
};

/* A vertex array object that is not bound. All 0 while bound: its contents are then in struct gls_client_attribs. */
struct gls_vertex_array {
	struct gls_array arrays[N_GLS_ARRAYS];
	uint32_t element_buffer;
};

struct gls_matrix_stack {
	float matrices[GLS_MAX_MATRICES][16];
	unsigned depth, max; /* depth: index of the current matrix */
};

/* Parameters of a texture or sampler object (table 6.16). */
struct gls_texture_parameters {
	uint32_t wrap_s, wrap_t, wrap_r, min_filter, mag_filter;
	float border_color[4], min_lod, max_lod, lod_bias, max_anisotropy, priority;
	uint32_t base_level, max_level, generate_mipmap;
	uint32_t compare_mode, compare_func, depth_mode;
	int32_t crop[4];     /* x, y, width, height of the part that DrawTex shows, in texels (OES_draw_texture) */
	uint32_t swizzle[4], srgb_decode; /* GL tokens (EXT_texture_swizzle, EXT_texture_sRGB_decode) */
};
struct gls_saved_texture {
	uint32_t there, name; /* there: 0 if there was no object */
	struct gls_texture_parameters parameters;
};

struct gls_saved_attribs {
	uint32_t mask;
	struct gls_attribs attribs;
	struct gls_saved_texture textures[GLS_MAX_UNITS][N_GLS_TEXTURE_TARGETS]; /* all 0 unless the mask has TEXTURE_BIT */
};
struct gls_saved_client {
	uint32_t mask;
	struct gls_client_attribs client; /* without client memory: the trace supplies it again at the draw */
};

/* State changed since the last draw looked at it: bits of gls_state.dirty. */
enum { GLS_DIRTY_MATERIAL = 1, GLS_DIRTY_VIEW = 2, GLS_DIRTY_ALL = 3 };

struct gls_share;

/* See waiting.h. */
struct gls_waiting {
	uint32_t set[2]; /* colours set by glMaterial since the store was emptied: GLS_AMBIENT and so on, by side */
	struct scene_face face[2];
	uint32_t touched;        /* 1: an attribute was set since the store was last read */
	uint32_t recolored;      /* 1: the current colour has changed since then */
	uint32_t stored;         /* 1: the next state change empties the store, because it has vertices or was read */
	uint32_t placed;         /* 1: vertices were specified since it was emptied */
	uint32_t colored;        /* 1: they have colours */
	uint32_t covers;         /* 1: waiting parameters have replaced the colours that COLOR_MATERIAL had copied */
	uint8_t room[N_GLS_ATTRIBUTES];   /* number of components the store has room for, by attribute; 0: not in the store */
	uint8_t filled[N_GLS_ATTRIBUTES]; /* number of components they were last reduced to */
};

struct gls_state {
	uint32_t error; /* first one since GetError; 0: none */
	uint32_t dirty;
	struct gls_attribs a;
	struct gls_client_attribs client;

	struct gls_matrix_stack modelview, projection, color_matrix, texture[GLS_MAX_UNITS];
	struct gls_saved_attribs *attrib_stack; /* [GLS_MAX_ATTRIB_DEPTH], owned */
	struct gls_saved_client *client_stack;  /* [GLS_MAX_ATTRIB_DEPTH], owned */
	unsigned attrib_depth, client_depth;
	struct table vertex_arrays; /* name (0: none bound) -> struct gls_vertex_array, owned */

	struct gls_pixel_map pixel_maps[N_GLS_PIXEL_MAPS];
	struct gls_maps *maps; /* evaluator maps (eval.c), owned; NULL: none defined yet */
	uint32_t render_mode; /* GL_RENDER, GL_SELECT, GL_FEEDBACK */
	uint32_t rasterizer_discard; /* GL 3.0 sec. 3.1: draws and clears are discarded */
	uint32_t conditional, left_out; /* 1: within conditional rendering; 1: draws are discarded by it */
	uint32_t answered, answer;      /* 1: the recorder knows the result of the next conditional's query; that result */
	uint32_t begin_mode;  /* 1 + primitive mode between Begin and End, otherwise 0 */
	struct gls_waiting waiting;
	uint32_t program, arb_vertex, arb_fragment, ati_fragment;
	uint32_t ati_open;        /* 1: between Begin and EndFragmentShaderATI */
	float ati_constants[8][4]; /* for fragment shaders that do not set their own */
	float program_env[2][GLS_MAX_PROGRAM_PARAMETERS][4]; /* environment parameters of ARB programs: fragment, vertex */
	struct gls_matrix_stack program_matrix[GLS_MAX_PROGRAM_MATRICES];
	uint32_t draw_framebuffer, read_framebuffer, renderbuffer;
	struct gls_share *share;
	struct scene_surface surface;  /* set by the program through rtMaterialEXT */
	uint32_t kd_tree;              /* 1: the program has called rtBuildKdTreeEXT */
	uint32_t depth_used;           /* 1: depth was cleared or the depth test enabled, so depth is no longer in its
	                                  initial state */

	/* list being compiled */
	struct gls_list *list;
	uint32_t list_name, list_mode;

	uint64_t handle; /* handle of the context */
	uint32_t drawn_program[2], drawn_links[2]; /* by enum gls_stage: the program object of the last draw, 0: none;
	                                              its link count, as in struct gls_stages */

	/* drawable */
	uint64_t drawable, read_drawable;
	uint32_t ever_current;
	uint32_t alpha_bits, depth_bits, stencil_bits, samples, double_buffered;
	uint32_t lacks_accum; /* 1: the drawable has no accumulation buffer */
	uint32_t x87;  /* 1: the GL library computed sums as mat4_sums[1] does */
	uint32_t mesa; /* enum scene_mesa: differences of the recorded Mesa from 22.3 */
	uint32_t srgb; /* 1: the drawable can hold sRGB colours */
};

/* Objects that contexts share. */
struct gls_share {
	unsigned refs;
	struct table lists, textures, buffers; /* name -> struct gls_list, gls_texture, gls_buffer */
	struct table programs;                 /* programs/program.h: key -> struct gls_program */
	struct table shaders; /* programs/glsl/object.h: name -> struct gls_shader, shaders and programs of GLSL */
	struct table framebuffers, renderbuffers; /* name (0: the window) -> struct gls_framebuffer, gls_renderbuffer */
	struct gls_texture *defaults[N_GLS_TEXTURE_TARGETS];
	uint64_t epoch; /* changes when a texture is deleted, or a list that another list's effect was derived from */
};

/** The active texture unit. */
static inline struct gls_unit *gls_active_unit(struct gls_state *st)
{
	return &st->a.texturing.units[st->a.texturing.active];
}

/** How the recorded GL library computes sums in matrix calculations. */
static inline const struct mat4_sums *gls_sums(const struct gls_state *st)
{
	return &mat4_sums[st->x87];
}

/* The stack that matrix commands change. */
struct gls_matrix_stack *gls_current_stack(struct gls_state *st);

/** 1 for FRONT, BACK and FRONT_AND_BACK. */
int gls_is_face(uint32_t token);
/** 1 for NEVER to ALWAYS. */
int gls_is_compare_func(uint32_t token);
/** 1 if an enabled clip plane rejects a point in eye space. */
int gls_is_beyond_clip_planes(const struct gls_attribs *a, const float eye[4]);
/** 1 if llvmpipe handles offsets and two sides in its pipeline stages instead of its triangle setup. */
int gls_draws_by_stages(const struct gls_attribs *a);
/** 1 if Mesa made the recording, or the recording does not say (scene/mesa.h): its behaviour is followed. */
int gls_is_mesa(const struct gls_state *st);
enum { GLS_AMBIENT = 1, GLS_DIFFUSE = 2, GLS_SPECULAR = 4, GLS_EMISSION = 8 };
/** The colours of a face that a material parameter sets. @return 0: none */
unsigned gls_face_colors(uint32_t parameter);
/**
 * The colours that follow the current colour if COLOR_MATERIAL is enabled (GL 2.1 sec. 2.14.3). side: 0 front, 1 back
 */
unsigned gls_tracked_colors(const struct gls_lighting *l, unsigned side);
void gls_set_face_colors(struct scene_face *face, unsigned colors, const float value[4]);

/** Record a GL error of the program (sec. 2.5): the first one is kept. */
static inline void gls_set_error(struct gls_state *st, uint32_t error)
{
	if (!st->error)
		st->error = error;
}
