/* Enables, hints and attribute stacks (GL 2.1 sec. 6.1.14 and the state tables of chapter 6). */
#include "replay/gl/state/attrib.h"

#include <stddef.h>
#include <string.h>

#include "gl_tokens.h"
#include "replay/gl/geometry/pending.h"
#include "replay/gl/geometry/vertexarray.h"
#include "replay/gl/geometry/waiting.h"
#include "replay/gl/texture/texture.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"

/* ---- enables ---- */

/*
 * Capabilities with a separate word in struct gls_attribs, the most common first: GL_ENABLE_BIT saves all of them,
 * whichever group they belong to.
 */
static const struct { uint32_t cap, offset; } capabilities[] = {
#define CAPABILITY(cap, member) { GL_##cap, offsetof(struct gls_attribs, member) }
	CAPABILITY(BLEND, color.blend), CAPABILITY(LIGHTING, lighting.enabled), CAPABILITY(DEPTH_TEST, depth.enabled),
	CAPABILITY(CULL_FACE, polygon.cull), CAPABILITY(ALPHA_TEST, color.alpha_test), CAPABILITY(FOG, fog.enabled),
	CAPABILITY(COLOR_MATERIAL, lighting.color_material), CAPABILITY(NORMALIZE, transform.normalize),
	CAPABILITY(STENCIL_TEST, stencil.enabled), CAPABILITY(SCISSOR_TEST, scissor.enabled),
	CAPABILITY(AUTO_NORMAL, evaluator.auto_normal), CAPABILITY(COLOR_LOGIC_OP, color.logic_op_enabled),
	CAPABILITY(INDEX_LOGIC_OP, color.index_logic_op_enabled), CAPABILITY(COLOR_SUM, fog.color_sum),
	CAPABILITY(DITHER, color.dither), CAPABILITY(FRAMEBUFFER_SRGB, color.framebuffer_srgb),
	CAPABILITY(LINE_SMOOTH, line.smooth), CAPABILITY(LINE_STIPPLE, line.stipple),
	CAPABILITY(MULTISAMPLE, multisample.enabled), CAPABILITY(SAMPLE_ALPHA_TO_COVERAGE, multisample.alpha_to_coverage),
	CAPABILITY(SAMPLE_ALPHA_TO_ONE, multisample.alpha_to_one), CAPABILITY(SAMPLE_COVERAGE, multisample.coverage),
	CAPABILITY(RESCALE_NORMAL, transform.rescale_normal), CAPABILITY(POINT_SMOOTH, point.smooth),
	CAPABILITY(POINT_SPRITE, point.sprite), CAPABILITY(POLYGON_OFFSET_FILL, polygon.offset_fill),
	CAPABILITY(POLYGON_OFFSET_LINE, polygon.offset_line), CAPABILITY(POLYGON_OFFSET_POINT, polygon.offset_point),
	CAPABILITY(POLYGON_SMOOTH, polygon.smooth), CAPABILITY(POLYGON_STIPPLE, polygon.stipple),
	CAPABILITY(STENCIL_TEST_TWO_SIDE_EXT, stencil.two_side), CAPABILITY(VERTEX_PROGRAM_ARB, programs.vertex),
	CAPABILITY(FRAGMENT_PROGRAM_ARB, programs.fragment), CAPABILITY(VERTEX_PROGRAM_POINT_SIZE, programs.point_size),
	CAPABILITY(VERTEX_PROGRAM_TWO_SIDE, programs.two_side), CAPABILITY(FRAGMENT_SHADER_ATI, programs.ati),
#undef CAPABILITY
};
#define N_CAPABILITIES (sizeof(capabilities) / sizeof(capabilities[0]))

static uint32_t *word_at(struct gls_attribs *a, size_t offset)
{
	return (uint32_t *)((char *)a + offset);
}

/* The word and bit for a capability. NULL: not stored as a bit. */
static uint32_t *bit_of(struct gls_state *st, uint32_t cap, uint32_t *bit)
{
	struct gls_attribs *a = &st->a;
	struct gls_unit *unit = &a->texturing.units[a->texturing.active];
	const struct { uint32_t first, last, *word; } ranges[] = {
		{ GL_CLIP_PLANE0, GL_CLIP_PLANE0 + GLS_MAX_CLIP_PLANES - 1, &a->transform.clip_plane_mask },
		{ GL_TEXTURE_GEN_S, GL_TEXTURE_GEN_Q, &unit->gen_enabled },
		{ GL_MAP1_COLOR_4, GL_MAP1_VERTEX_4, &a->evaluator.map1 },
		{ GL_MAP2_COLOR_4, GL_MAP2_VERTEX_4, &a->evaluator.map2 },
	};

	if (cap == GL_TEXTURE_GEN_STR_OES) { /* OpenGL ES: s, t and r together */
		*bit = 7;
		return &unit->gen_enabled;
	}
	for (unsigned i = 0; i < sizeof(ranges) / sizeof(ranges[0]); i++)
		if (cap >= ranges[i].first && cap <= ranges[i].last) {
			*bit = 1u << (cap - ranges[i].first);
			return ranges[i].word;
		}
	return NULL;
}

/*
 * The flag of a capability; *bit is 0 if it is a whole word. NULL: not a capability. The most common ones are found
 * first.
 */
static uint32_t *enable_flag(struct gls_state *st, uint32_t cap, uint32_t *bit)
{
	static const uint32_t targets[] = {
		GL_TEXTURE_1D,       GL_TEXTURE_2D,        GL_TEXTURE_3D,
		GL_TEXTURE_CUBE_MAP, GL_TEXTURE_RECTANGLE, /* in the order of enum gls_texture_target */
	};

	for (unsigned i = 0; i < sizeof(targets) / sizeof(*targets); i++)
		if (cap == targets[i]) {
			*bit = 1u << i;
			return &st->a.texturing.units[st->a.texturing.active].enabled;
		}
	*bit = 0;
	if (cap >= GL_LIGHT0 && cap < GL_LIGHT0 + GLS_MAX_LIGHTS)
		return &st->a.lighting.lights[cap - GL_LIGHT0].enabled;
	for (size_t i = 0; i < N_CAPABILITIES; i++)
		if (capabilities[i].cap == cap)
			return word_at(&st->a, capabilities[i].offset);
	switch (cap) {
	case GL_RASTERIZER_DISCARD: return &st->rasterizer_discard;
	default: return bit_of(st, cap, bit);
	}
}

int gls_is_switched(struct gls_state *st, uint32_t cap, int on)
{
	uint32_t bit;
	const uint32_t *flag = enable_flag(st, cap, &bit);

	return flag && ((bit ? *flag & bit : *flag) != 0) == on;
}

/* Capabilities without effect here. */
static int is_harmless_cap(uint32_t cap)
{
	switch (cap) {
	case GL_DEBUG_OUTPUT: case GL_DEBUG_OUTPUT_SYNCHRONOUS: case GL_TEXTURE_CUBE_MAP_SEAMLESS:
		return 1;
	default:
		return 0;
	}
}

static int client_array_of(const struct gls_state *st, uint32_t cap)
{
	switch (cap) {
	case GL_VERTEX_ARRAY: return GLS_ARRAY_VERTEX;
	case GL_NORMAL_ARRAY: return GLS_ATTR_NORMAL;
	case GL_COLOR_ARRAY: return GLS_ATTR_COLOR;
	case GL_SECONDARY_COLOR_ARRAY: return GLS_ATTR_SECONDARY;
	case GL_FOG_COORD_ARRAY: return GLS_ATTR_FOG_COORD;
	case GL_TEXTURE_COORD_ARRAY: return GLS_ATTR_TEXCOORD + (int)st->client.active_texture;
	case GL_EDGE_FLAG_ARRAY: return GLS_ARRAY_EDGE_FLAG;
	case GL_INDEX_ARRAY: return GLS_ARRAY_INDEX;
	case GL_POINT_SIZE_ARRAY_OES: return GLS_ARRAY_POINT_SIZE;
	default: return -1;
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
		/* not in the specification, but Mesa and others accept it, and old programs use it */
		if (client_array_of(st, cap) >= 0 || cap == GL_PRIMITIVE_RESTART_NV) {
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
	if (cap == GL_COLOR_MATERIAL && on != (int)*flag) {
		gls_waiting_take(st, 0);
		if (on)
			gls_color_changed(st);
	}
	if (bit)
		*flag = on ? *flag | bit : *flag & ~bit;
	else
		*flag = on != 0;
	st->depth_used |= st->a.depth.enabled;
}

GLS_HANDLER(glEnable, STATE) { enable(x, st, arg_u(c, 0), 1); }
GLS_HANDLER(glDisable, STATE) { enable(x, st, arg_u(c, 0), 0); }

GLS_HANDLER(glEnableClientState, CLIENT) { enable_client(x, st, arg_u(c, 0), 1); }
GLS_HANDLER(glDisableClientState, CLIENT) { enable_client(x, st, arg_u(c, 0), 0); }

GLS_HANDLER(glHint, STATE)
{
	struct gls_hint *h = &st->a.hint;
	uint32_t mode = arg_u(c, 1);

	if (gls_refuses(x, st, mode != GL_DONT_CARE && mode != GL_FASTEST && mode != GL_NICEST, GL_INVALID_ENUM))
		return;
	const struct { uint32_t name, *word; } hints[] = {
		{ GL_FOG_HINT, &h->fog }, { GL_PERSPECTIVE_CORRECTION_HINT, &h->perspective }, { GL_POINT_SMOOTH_HINT, &h->point },
		{ GL_LINE_SMOOTH_HINT, &h->line }, { GL_POLYGON_SMOOTH_HINT, &h->polygon }, { GL_GENERATE_MIPMAP_HINT, &h->mipmap },
		{ GL_TEXTURE_COMPRESSION_HINT, NULL }, { GL_FRAGMENT_SHADER_DERIVATIVE_HINT, NULL },
		{ GL_CLIP_VOLUME_CLIPPING_HINT_EXT, NULL },
	};
	for (size_t i = 0; i < sizeof(hints) / sizeof(hints[0]); i++)
		if (hints[i].name == arg_u(c, 0)) {
			if (hints[i].word)
				*hints[i].word = mode;
			return;
		}
	gls_error(x, st, GL_INVALID_ENUM);
}

GLS_HANDLER(glRenderMode, OBJECT)
{
	uint32_t mode = arg_u(c, 0);

	if (gls_refuses(x, st, mode != GL_RENDER && mode != GL_SELECT && mode != GL_FEEDBACK, GL_INVALID_ENUM))
		return;
	st->render_mode = mode;
}

/* ---- attribute stacks, sec. 6.1.14, table 6.2 ---- */

GLS_HANDLER(glPushAttrib, STATE)
{
	struct gls_saved_attribs *saved;

	if (gls_refuses(x, st, st->attrib_depth == GLS_MAX_ATTRIB_DEPTH, GL_STACK_OVERFLOW))
		return;
	gls_waiting_take(st, 0);
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
	for (size_t i = 0; i < N_CAPABILITIES; i++)
		*word_at(&st->a, capabilities[i].offset) = *word_at(old, capabilities[i].offset);
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

/* Table 6.2. */
static const struct { uint32_t bit, offset, bytes; } groups[] = {
#define GROUP(bit, member) \
	{ GL_##bit##_BIT, offsetof(struct gls_attribs, member), sizeof(((struct gls_attribs *)0)->member) }
	GROUP(CURRENT, current), GROUP(POINT, point), GROUP(LINE, line), GROUP(POLYGON, polygon),
	GROUP(POLYGON_STIPPLE, polygon_stipple), GROUP(PIXEL_MODE, pixel), GROUP(LIGHTING, lighting), GROUP(FOG, fog),
	GROUP(DEPTH_BUFFER, depth), GROUP(ACCUM_BUFFER, accum), GROUP(STENCIL_BUFFER, stencil), GROUP(VIEWPORT, viewport),
	GROUP(TRANSFORM, transform), GROUP(COLOR_BUFFER, color), GROUP(HINT, hint), GROUP(EVAL, evaluator),
	GROUP(LIST, list_base), GROUP(TEXTURE, texturing), GROUP(SCISSOR, scissor), GROUP(MULTISAMPLE, multisample),
#undef GROUP
};

GLS_HANDLER(glPopAttrib, STATE, SELECT)
{
	const uint32_t tracked = st->a.lighting.color_material;
	struct gls_attribs *old;
	uint32_t mask;

	if (gls_refuses(x, st, st->attrib_depth == 0, GL_STACK_UNDERFLOW))
		return;
	mask = st->attrib_stack[--st->attrib_depth].mask;
	old = &st->attrib_stack[st->attrib_depth].attribs;
	for (size_t i = 0; i < sizeof(groups) / sizeof(groups[0]); i++)
		if (mask & groups[i].bit)
			memcpy((char *)&st->a + groups[i].offset, (char *)old + groups[i].offset, groups[i].bytes);
	if (mask & GL_CURRENT_BIT)
		x->pending.geometry.touched = ~0u >> (32 - N_GLS_ATTRIBUTES);
	if (mask & GL_TEXTURE_BIT)
		gls_texture_restore_parameters(st, st->attrib_stack[st->attrib_depth].textures);
	if (mask & GL_ENABLE_BIT)
		restore_enables(st, old);
	if (!st->a.lighting.color_material)
		return;
	/* In Mesa, materials do not track a restored colour; they do if only COLOR_MATERIAL is restored. */
	if (!gls_is_mesa(st) || (!tracked && !(mask & GL_LIGHTING_BIT)))
		gls_color_changed(st);
	else
		st->waiting.covers = 1;
}

GLS_HANDLER(glPushClientAttrib, NOW)
{
	struct gls_saved_client *saved;

	if (gls_refuses(x, st, st->client_depth == GLS_MAX_ATTRIB_DEPTH, GL_STACK_OVERFLOW))
		return;
	saved = &st->client_stack[st->client_depth++];
	saved->mask = arg_u(c, 0);
	saved->client = st->client;
}

GLS_HANDLER(glPopClientAttrib, NOW)
{
	struct gls_saved_client *saved;

	if (gls_refuses(x, st, st->client_depth == 0, GL_STACK_UNDERFLOW))
		return;
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
