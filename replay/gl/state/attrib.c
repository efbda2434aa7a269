/* Enables, attribute stacks, initial values (GL 2.1 sec. 6.1.14 and the state tables of chapter 6). */
#include "replay/gl/state/attrib.h"

#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "base/err.h"
#include "base/mat4.h"
#include "replay/gl/dispatch.h"
#include "replay/gl/geometry/eval.h"
#include "replay/gl/geometry/list.h"
#include "replay/gl/geometry/vertex.h"
#include "replay/gl/geometry/vertexarray.h"
#include "replay/gl/texture/texture.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "replay/machine/state.h"
#include "base/table.h"

/* ---- initial values ---- */

static void init_lighting(struct gls_lighting *l)
{
	static const struct scene_face face = {
		.ambient = { 0.2f, 0.2f, 0.2f, 1 }, .diffuse = { 0.8f, 0.8f, 0.8f, 1 }, .specular = { 0, 0, 0, 1 },
		.emission = { 0, 0, 0, 1 }, .shininess = 0,
	};

	l->color_material_face = GL_FRONT_AND_BACK;
	l->color_material_mode = GL_AMBIENT_AND_DIFFUSE;
	l->face[0] = l->face[1] = face;
	for (unsigned i = 0; i < 4; i++)
		l->model_ambient[i] = i < 3 ? 0.2f : 1;
	l->shade_model = GL_SMOOTH;
	for (unsigned i = 0; i < GLS_MAX_LIGHTS; i++) {
		struct scene_light *light = &l->lights[i].value;
		light->index = i;
		light->ambient[3] = light->diffuse[3] = light->specular[3] = 1;
		for (unsigned k = 0; k < 3 && i == 0; k++)
			light->diffuse[k] = light->specular[k] = 1;
		light->position_eye[2] = 1;
		light->spot_direction_eye[2] = -1;
		light->spot_cutoff_deg = 180;
		light->attenuation[0] = 1;
	}
}

static void init_unit(struct gls_unit *unit, uint32_t index)
{
	struct scene_unit *v = &unit->value;

	v->unit = index;
	v->env_mode = GL_MODULATE;
	v->combine_rgb = v->combine_alpha = GL_MODULATE;
	for (unsigned i = 0; i < 4; i++) {
		static const uint32_t sources[] = { GL_TEXTURE, GL_PREVIOUS, GL_CONSTANT, GL_CONSTANT }; /* the fourth as Mesa has it */
		v->source_rgb[i] = v->source_alpha[i] = sources[i];
		v->operand_rgb[i] = i < 2 ? GL_SRC_COLOR : GL_SRC_ALPHA;
		v->operand_alpha[i] = GL_SRC_ALPHA;
	}
	v->scale_rgb = v->scale_alpha = 1;
	for (unsigned i = 0; i < 4; i++)
		v->gen_mode[i] = GL_EYE_LINEAR;
	for (unsigned i = 0; i < 2; i++)
		v->gen_object_plane[i][i] = v->gen_eye_plane[i][i] = 1;
	memcpy(v->matrix, mat4_identity, 64);
}

static void init_attribs(struct gls_attribs *a)
{
	for (unsigned i = 0; i < 4; i++)
		a->current.attribute[GLS_ATTR_COLOR][i] = 1;
	a->lighting.clamp = GL_TRUE;
	a->color.clamp = GL_FIXED_ONLY;
	a->current.attribute[GLS_ATTR_NORMAL][2] = 1;
	a->current.attribute[GLS_ATTR_NORMAL][3] = 1;
	a->current.attribute[GLS_ATTR_SECONDARY][3] = 1;
	a->current.attribute[GLS_ATTR_FOG_COORD][3] = 1;
	for (unsigned u = 0; u < GLS_MAX_UNITS; u++) {
		a->current.attribute[GLS_ATTR_TEXCOORD + u][3] = 1;
		a->current.raster_texcoord[u][3] = 1;
		init_unit(&a->texturing.units[u], u);
	}
	a->current.edge_flag = 1;
	a->current.index = 1;
	a->current.raster_position[3] = 1;
	for (unsigned i = 0; i < 4; i++)
		a->current.raster_color[i] = 1;
	a->current.raster_valid = 1;
	a->transform.matrix_mode = GL_MODELVIEW;
	a->viewport.depth_range[1] = 1;
	init_lighting(&a->lighting);
	a->fog = (struct gls_fog){ .mode = GL_EXP, .coord_source = GL_FRAGMENT_DEPTH, .density = 1, .end = 1 };
	a->point = (struct gls_point){ .size = 1, .size_max = 255, .fade_threshold = 1, .attenuation = { 1 },
	                               .sprite_origin = GL_UPPER_LEFT };
	a->line = (struct gls_line){ .width = 1, .stipple_pattern = 0xffff, .stipple_factor = 1 };
	a->polygon.cull_face = GL_BACK;
	a->polygon.front_face = GL_CCW;
	a->polygon.mode[0] = a->polygon.mode[1] = GL_FILL;
	memset(a->polygon_stipple, 0xff, sizeof(a->polygon_stipple));
	a->multisample = (struct gls_multisample){ .enabled = 1, .coverage_value = 1 };
	for (unsigned side = 0; side < 2; side++)
		a->stencil.side[side] = (struct scene_stencil){ .func = GL_ALWAYS, .compare_mask = ~0u, .write_mask = ~0u,
		                                                .fail = GL_KEEP, .zfail = GL_KEEP, .zpass = GL_KEEP };
	a->stencil.active_face = GL_FRONT;
	a->depth = (struct gls_depth){ .func = GL_LESS, .write = 1, .clear = 1 };
	a->color = (struct gls_color_buffer){ .alpha_func = GL_ALWAYS, .equation_rgb = GL_FUNC_ADD,
	                                      .equation_alpha = GL_FUNC_ADD, .src_rgb = GL_ONE, .dst_rgb = GL_ZERO,
	                                      .src_alpha = GL_ONE, .dst_alpha = GL_ZERO, .logic_op = GL_COPY, .dither = 1,
	                                      .mask = 15, .draw_buffer = GL_BACK };
	for (unsigned i = 0; i < 4; i++)
		a->pixel.scale[i] = 1;
	a->pixel.depth_scale = 1;
	a->pixel.zoom[0] = a->pixel.zoom[1] = 1;
	a->pixel.read_buffer = GL_BACK;
	a->evaluator.grid1[1] = a->evaluator.grid2[1] = a->evaluator.grid2[3] = 1;
	a->evaluator.grid1_segments = a->evaluator.grid2_segments[0] = a->evaluator.grid2_segments[1] = 1;
	a->hint = (struct gls_hint){ GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE };
}

static void init_stack(struct gls_matrix_stack *stack, unsigned max)
{
	memcpy(stack->matrices[0], mat4_identity, 64);
	stack->max = max;
}

int gls_state_init(struct gls_state *st)
{
	memset(st, 0, sizeof(*st));
	st->attrib_stack = calloc(GLS_MAX_ATTRIB_DEPTH, sizeof(*st->attrib_stack));
	st->client_stack = calloc(GLS_MAX_ATTRIB_DEPTH, sizeof(*st->client_stack));
	if (!st->attrib_stack || !st->client_stack)
		return err_report(ERR_SYSTEM, NULL, "out of memory for a context");
	init_attribs(&st->a);
	init_stack(&st->modelview, GLS_MAX_MATRICES);
	init_stack(&st->projection, GLS_MAX_MATRICES);
	init_stack(&st->color_matrix, 4);
	for (unsigned u = 0; u < GLS_MAX_UNITS; u++)
		init_stack(&st->texture[u], GLS_MAX_TEXTURE_MATRICES);
	gls_arrays_init(st->client.arrays);
	st->client.pack.alignment = st->client.unpack.alignment = 4;
	st->render_mode = GL_RENDER;
	st->dirty = GLS_DIRTY_ALL;
	st->depth_bits = 24;
	st->stencil_bits = 8;
	st->double_buffered = 1;
	return 0;
}

void gls_state_free(struct gls_state *st)
{
	gls_maps_free(st->maps);
	for (unsigned i = 0; i < N_GLS_ARRAYS; i++)
		free(st->client.arrays[i].client);
	for (size_t i = 0; i < st->vertex_arrays.room; i++)
		gls_vertex_array_free(st->vertex_arrays.entries[i].value);
	table_free(&st->vertex_arrays);
	if (st->list)
		gls_list_free(st->list);
	free(st->attrib_stack);
	free(st->client_stack);
	if (st->share)
		gls_share_release(st->share);
	memset(st, 0, sizeof(*st));
}

/* ---- enables ---- */

/* The flag that a capability switches; *bit is 0 for a whole word. NULL: no capability. */
static uint32_t *enable_flag(struct gls_state *st, uint32_t cap, uint32_t *bit)
{
	struct gls_attribs *a = &st->a;
	struct gls_unit *unit = &a->texturing.units[a->texturing.active];

	*bit = 0;
	if (cap >= GL_LIGHT0 && cap < GL_LIGHT0 + GLS_MAX_LIGHTS)
		return &a->lighting.lights[cap - GL_LIGHT0].enabled;
	if (cap >= GL_CLIP_PLANE0 && cap < GL_CLIP_PLANE0 + GLS_MAX_CLIP_PLANES) {
		*bit = 1u << (cap - GL_CLIP_PLANE0);
		return &a->transform.clip_plane_mask;
	}
	if (cap >= GL_TEXTURE_GEN_S && cap <= GL_TEXTURE_GEN_Q) {
		*bit = 1u << (cap - GL_TEXTURE_GEN_S);
		return &unit->gen_enabled;
	}
	if (cap >= GL_MAP1_COLOR_4 && cap <= GL_MAP1_VERTEX_4) {
		*bit = 1u << (cap - GL_MAP1_COLOR_4);
		return &a->evaluator.map1;
	}
	if (cap >= GL_MAP2_COLOR_4 && cap <= GL_MAP2_VERTEX_4) {
		*bit = 1u << (cap - GL_MAP2_COLOR_4);
		return &a->evaluator.map2;
	}
	switch (cap) {
	case GL_TEXTURE_1D:
		*bit = 1u << GLS_TEXTURE_1D;
		return &unit->enabled;
	case GL_TEXTURE_2D:
		*bit = 1u << GLS_TEXTURE_2D;
		return &unit->enabled;
	case GL_TEXTURE_3D:
		*bit = 1u << GLS_TEXTURE_3D;
		return &unit->enabled;
	case GL_TEXTURE_CUBE_MAP:
		*bit = 1u << GLS_TEXTURE_CUBE;
		return &unit->enabled;
	case GL_TEXTURE_RECTANGLE:
		*bit = 1u << GLS_TEXTURE_RECTANGLE;
		return &unit->enabled;
	case GL_ALPHA_TEST:
		return &a->color.alpha_test;
	case GL_AUTO_NORMAL:
		return &a->evaluator.auto_normal;
	case GL_BLEND:
		return &a->color.blend;
	case GL_COLOR_LOGIC_OP:
		return &a->color.logic_op_enabled;
	case GL_INDEX_LOGIC_OP:
		return &a->color.index_logic_op_enabled;
	case GL_COLOR_MATERIAL:
		return &a->lighting.color_material;
	case GL_COLOR_SUM:
		return &a->fog.color_sum;
	case GL_CULL_FACE:
		return &a->polygon.cull;
	case GL_DEPTH_TEST:
		return &a->depth.enabled;
	case GL_DITHER:
		return &a->color.dither;
	case GL_FOG:
		return &a->fog.enabled;
	case GL_LIGHTING:
		return &a->lighting.enabled;
	case GL_LINE_SMOOTH:
		return &a->line.smooth;
	case GL_LINE_STIPPLE:
		return &a->line.stipple;
	case GL_MULTISAMPLE:
		return &a->multisample.enabled;
	case GL_SAMPLE_ALPHA_TO_COVERAGE:
		return &a->multisample.alpha_to_coverage;
	case GL_SAMPLE_ALPHA_TO_ONE:
		return &a->multisample.alpha_to_one;
	case GL_SAMPLE_COVERAGE:
		return &a->multisample.coverage;
	case GL_NORMALIZE:
		return &a->transform.normalize;
	case GL_RESCALE_NORMAL:
		return &a->transform.rescale_normal;
	case GL_POINT_SMOOTH:
		return &a->point.smooth;
	case GL_POINT_SPRITE:
		return &a->point.sprite;
	case GL_POLYGON_OFFSET_FILL:
		return &a->polygon.offset_fill;
	case GL_POLYGON_OFFSET_LINE:
		return &a->polygon.offset_line;
	case GL_POLYGON_OFFSET_POINT:
		return &a->polygon.offset_point;
	case GL_POLYGON_SMOOTH:
		return &a->polygon.smooth;
	case GL_POLYGON_STIPPLE:
		return &a->polygon.stipple;
	case GL_SCISSOR_TEST:
		return &a->scissor.enabled;
	case GL_STENCIL_TEST:
		return &a->stencil.enabled;
	case GL_STENCIL_TEST_TWO_SIDE_EXT:
		return &a->stencil.two_side;
	case GL_VERTEX_PROGRAM_ARB:
		return &st->arb_vertex_enabled;
	case GL_FRAGMENT_PROGRAM_ARB:
		return &st->arb_fragment_enabled;
	case GL_RASTERIZER_DISCARD:
		return &st->rasterizer_discard;
	default:
		return NULL;
	}
}

/* Capabilities that change nothing that is drawn here. */
static int is_harmless_cap(uint32_t cap)
{
	switch (cap) {
	case GL_DEBUG_OUTPUT:
	case GL_DEBUG_OUTPUT_SYNCHRONOUS:
	case GL_TEXTURE_CUBE_MAP_SEAMLESS:
	case GL_VERTEX_PROGRAM_POINT_SIZE:
	case GL_FRAMEBUFFER_SRGB: /* the window has no sRGB buffer */
		return 1;
	default:
		return 0;
	}
}

static int client_array_of(const struct gls_state *st, uint32_t cap)
{
	switch (cap) {
	case GL_VERTEX_ARRAY:
		return GLS_ARRAY_VERTEX;
	case GL_NORMAL_ARRAY:
		return GLS_ATTR_NORMAL;
	case GL_COLOR_ARRAY:
		return GLS_ATTR_COLOR;
	case GL_SECONDARY_COLOR_ARRAY:
		return GLS_ATTR_SECONDARY;
	case GL_FOG_COORD_ARRAY:
		return GLS_ATTR_FOG_COORD;
	case GL_TEXTURE_COORD_ARRAY:
		return GLS_ATTR_TEXCOORD + (int)st->client.active_texture;
	case GL_EDGE_FLAG_ARRAY:
		return GLS_ARRAY_EDGE_FLAG;
	case GL_INDEX_ARRAY:
		return GLS_ARRAY_INDEX;
	default:
		return -1;
	}
}

static void enable_client(struct gls_exec *x, struct gls_state *st, uint32_t cap, uint32_t on)
{
	int array = client_array_of(st, cap);

	if (cap == GL_PRIMITIVE_RESTART_NV)
		st->client.restart = on;
	else if (array >= 0)
		st->client.arrays[array].enabled = on;
	else
		gls_error(x, st, GL_INVALID_ENUM);
}

void gls_enable(struct gls_exec *x, struct gls_state *st, uint32_t cap, int on)
{
	uint32_t bit, *flag = enable_flag(st, cap, &bit);

	if (!flag) {
		if (is_harmless_cap(cap))
			return;
		if (cap == GL_PRIMITIVE_RESTART || cap == GL_PRIMITIVE_RESTART_FIXED_INDEX) {
			*(cap == GL_PRIMITIVE_RESTART ? &st->client.restart : &st->client.restart_fixed) = on != 0;
			return;
		}
		if (client_array_of(st, cap) >= 0 || cap == GL_PRIMITIVE_RESTART_NV) { /* not by the letter, but Mesa and others take it, and old programs use it */
			enable_client(x, st, cap, (uint32_t)on);
			return;
		}
		if (cap == GL_HISTOGRAM || cap == GL_MINMAX || cap == GL_CONVOLUTION_1D || cap == GL_CONVOLUTION_2D ||
		    cap == GL_SEPARABLE_2D || cap == GL_COLOR_TABLE)
			gls_unsupported(x, "the imaging subset");
		else
			gls_error(x, st, GL_INVALID_ENUM);
		return;
	}
	if (bit)
		*flag = on ? *flag | bit : *flag & ~bit;
	else
		*flag = on != 0;
	if (cap == GL_COLOR_MATERIAL && on)
		gls_color_changed(st);
}

GLS_HANDLER(glEnable, STATE) { gls_enable(x, st, arg_u(c, 0), 1); }
GLS_HANDLER(glDisable, STATE) { gls_enable(x, st, arg_u(c, 0), 0); }

GLS_HANDLER(glEnableClientState, CLIENT) { enable_client(x, st, arg_u(c, 0), 1); }
GLS_HANDLER(glDisableClientState, CLIENT) { enable_client(x, st, arg_u(c, 0), 0); }

GLS_HANDLER(glHint, STATE)
{
	struct gls_hint *h = &st->a.hint;
	uint32_t mode = arg_u(c, 1);

	if (mode != GL_DONT_CARE && mode != GL_FASTEST && mode != GL_NICEST) {
		gls_error(x, st, GL_INVALID_ENUM);
		return;
	}
	switch (arg_u(c, 0)) {
	case GL_FOG_HINT:
		h->fog = mode;
		break;
	case GL_PERSPECTIVE_CORRECTION_HINT:
		h->perspective = mode;
		break;
	case GL_POINT_SMOOTH_HINT:
		h->point = mode;
		break;
	case GL_LINE_SMOOTH_HINT:
		h->line = mode;
		break;
	case GL_POLYGON_SMOOTH_HINT:
		h->polygon = mode;
		break;
	case GL_GENERATE_MIPMAP_HINT:
		h->mipmap = mode;
		break;
	case GL_TEXTURE_COMPRESSION_HINT:
	case GL_FRAGMENT_SHADER_DERIVATIVE_HINT:
	case GL_CLIP_VOLUME_CLIPPING_HINT_EXT:
		break;
	default:
		gls_error(x, st, GL_INVALID_ENUM);
	}
}

/* The program asked for its errors: it has seen them, and the next one counts as the first again. */
GLS_HANDLER(glGetError, NOW)
{
	st->error = 0;
}

GLS_HANDLER(glRenderMode, NOW)
{
	uint32_t mode = arg_u(c, 0);

	if (mode != GL_RENDER && mode != GL_SELECT && mode != GL_FEEDBACK) {
		gls_error(x, st, GL_INVALID_ENUM);
		return;
	}
	gls_flush(x);
	st->render_mode = mode;
}

/* ---- attribute stacks, sec. 6.1.14, table 6.2 ---- */

GLS_HANDLER(glPushAttrib, STATE)
{
	struct gls_saved_attribs *saved;

	if (st->attrib_depth == GLS_MAX_ATTRIB_DEPTH) {
		gls_error(x, st, GL_STACK_OVERFLOW);
		return;
	}
	saved = &st->attrib_stack[st->attrib_depth++];
	saved->mask = arg_u(c, 0);
	saved->attribs = st->a;
	memset(saved->textures, 0, sizeof(saved->textures));
	if (saved->mask & GL_TEXTURE_BIT)
		gls_texture_save_parameters(st, saved->textures);
}

/* GL_ENABLE_BIT: every capability, whichever group it belongs to. */
static void restore_enables(struct gls_state *st, struct gls_attribs *old)
{
	static const uint32_t caps[] = {
		GL_ALPHA_TEST, GL_AUTO_NORMAL, GL_BLEND, GL_COLOR_LOGIC_OP, GL_INDEX_LOGIC_OP, GL_COLOR_MATERIAL, GL_COLOR_SUM,
		GL_CULL_FACE, GL_DEPTH_TEST, GL_DITHER, GL_FOG, GL_LIGHTING, GL_LINE_SMOOTH, GL_LINE_STIPPLE, GL_MULTISAMPLE,
		GL_SAMPLE_ALPHA_TO_COVERAGE, GL_SAMPLE_ALPHA_TO_ONE, GL_SAMPLE_COVERAGE, GL_NORMALIZE, GL_RESCALE_NORMAL,
		GL_POINT_SMOOTH, GL_POINT_SPRITE, GL_POLYGON_OFFSET_FILL, GL_POLYGON_OFFSET_LINE, GL_POLYGON_OFFSET_POINT,
		GL_POLYGON_SMOOTH, GL_POLYGON_STIPPLE, GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_STENCIL_TEST_TWO_SIDE_EXT,
	};

	for (size_t i = 0; i < sizeof(caps) / sizeof(caps[0]); i++) {
		uint32_t bit, *flag = enable_flag(st, caps[i], &bit);
		/* The same place in the saved copy: the flags of these all lie in st->a. */
		*flag = *(uint32_t *)((char *)old + ((char *)flag - (char *)&st->a));
	}
	for (unsigned i = 0; i < GLS_MAX_LIGHTS; i++)
		st->a.lighting.lights[i].enabled = old->lighting.lights[i].enabled;
	for (unsigned u = 0; u < GLS_MAX_UNITS; u++) {
		st->a.texturing.units[u].enabled = old->texturing.units[u].enabled;
		st->a.texturing.units[u].gen_enabled = old->texturing.units[u].gen_enabled;
	}
	st->a.transform.clip_plane_mask = old->transform.clip_plane_mask;
	st->a.evaluator.map1 = old->evaluator.map1;
	st->a.evaluator.map2 = old->evaluator.map2;
}

GLS_HANDLER(glPopAttrib, STATE)
{
	struct gls_attribs *old, *a = &st->a;
	uint32_t mask, keep_sum;

	if (st->attrib_depth == 0) {
		gls_error(x, st, GL_STACK_UNDERFLOW);
		return;
	}
	mask = st->attrib_stack[--st->attrib_depth].mask;
	old = &st->attrib_stack[st->attrib_depth].attribs;
	if (mask & GL_CURRENT_BIT) {
		a->current = old->current;
		x->pending.geometry.touched = ~0u >> (32 - N_GLS_ATTRIBUTES);
	}
	if (mask & GL_POINT_BIT)
		a->point = old->point;
	if (mask & GL_LINE_BIT)
		a->line = old->line;
	if (mask & GL_POLYGON_BIT)
		a->polygon = old->polygon;
	if (mask & GL_POLYGON_STIPPLE_BIT)
		memcpy(a->polygon_stipple, old->polygon_stipple, sizeof(a->polygon_stipple));
	if (mask & GL_PIXEL_MODE_BIT)
		a->pixel = old->pixel;
	if (mask & GL_LIGHTING_BIT)
		a->lighting = old->lighting;
	if (mask & GL_FOG_BIT) {
		keep_sum = a->fog.color_sum;
		a->fog = old->fog;
		a->fog.color_sum = mask & GL_ENABLE_BIT ? keep_sum : old->fog.color_sum;
	}
	if (mask & GL_DEPTH_BUFFER_BIT)
		a->depth = old->depth;
	if (mask & GL_ACCUM_BUFFER_BIT)
		a->accum = old->accum;
	if (mask & GL_STENCIL_BUFFER_BIT)
		a->stencil = old->stencil;
	if (mask & GL_VIEWPORT_BIT)
		a->viewport = old->viewport;
	if (mask & GL_TRANSFORM_BIT)
		a->transform = old->transform;
	if (mask & GL_COLOR_BUFFER_BIT)
		a->color = old->color;
	if (mask & GL_HINT_BIT)
		a->hint = old->hint;
	if (mask & GL_EVAL_BIT)
		a->evaluator = old->evaluator;
	if (mask & GL_LIST_BIT)
		a->list_base = old->list_base;
	if (mask & GL_TEXTURE_BIT) {
		a->texturing = old->texturing;
		gls_texture_restore_parameters(st, st->attrib_stack[st->attrib_depth].textures);
	}
	if (mask & GL_SCISSOR_BIT)
		a->scissor = old->scissor;
	if (mask & GL_MULTISAMPLE_BIT)
		a->multisample = old->multisample;
	if (mask & GL_ENABLE_BIT)
		restore_enables(st, old);
	if (a->lighting.color_material)
		gls_color_changed(st);
}

GLS_HANDLER(glPushClientAttrib, NOW)
{
	struct gls_saved_client *saved;

	if (st->client_depth == GLS_MAX_ATTRIB_DEPTH) {
		gls_error(x, st, GL_STACK_OVERFLOW);
		return;
	}
	saved = &st->client_stack[st->client_depth++];
	saved->mask = arg_u(c, 0);
	saved->client = st->client;
}

GLS_HANDLER(glPopClientAttrib, NOW)
{
	struct gls_saved_client *saved;

	if (st->client_depth == 0) {
		gls_error(x, st, GL_STACK_UNDERFLOW);
		return;
	}
	saved = &st->client_stack[--st->client_depth];
	if (saved->mask & GL_CLIENT_PIXEL_STORE_BIT) {
		st->client.pack = saved->client.pack;
		st->client.unpack = saved->client.unpack;
	}
	if (!(saved->mask & GL_CLIENT_VERTEX_ARRAY_BIT))
		return;
	gls_vertex_array_bind(x, st, saved->client.vertex_array);
	for (unsigned i = 0; i < N_GLS_ARRAYS; i++) {
		struct gls_array now = st->client.arrays[i], *array = &st->client.arrays[i];
		*array = saved->client.arrays[i];
		array->client = now.client; /* memory stays with the array that owns it */
		array->client_bytes = now.client_bytes;
		array->client_room = now.client_room;
		array->version = now.version;
	}
	st->client.active_texture = saved->client.active_texture;
	st->client.array_buffer = saved->client.array_buffer;
	st->client.element_buffer = saved->client.element_buffer;
	st->client.lock_first = saved->client.lock_first;
	st->client.lock_count = saved->client.lock_count;
}
