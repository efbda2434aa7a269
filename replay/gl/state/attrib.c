/* Enables, hints and attribute stacks (GL 2.1 sec. 6.1.14 and the state tables of chapter 6). */
#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "base/err.h"
#include "base/mat4.h"
#include "base/table.h"
#include "replay/gl/geometry/pending.h"
#include "replay/gl/geometry/vertexarray.h"
#include "replay/gl/texture/texture.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "replay/machine/state.h"

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

static void enable(struct gls_exec *x, struct gls_state *st, uint32_t cap, int on)
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

GLS_HANDLER(glEnable, STATE) { enable(x, st, arg_u(c, 0), 1); }
GLS_HANDLER(glDisable, STATE) { enable(x, st, arg_u(c, 0), 0); }

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

GLS_HANDLER(glRenderMode, OBJECT)
{
	uint32_t mode = arg_u(c, 0);

	if (mode != GL_RENDER && mode != GL_SELECT && mode != GL_FEEDBACK) {
		gls_error(x, st, GL_INVALID_ENUM);
		return;
	}
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

GLS_HANDLER(glPopAttrib, STATE, SELECT)
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
