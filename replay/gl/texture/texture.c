/* Texture objects, their parameters, environments and coordinate generation (GL 2.1 sec. 2.11.4, 3.8). */
#include "replay/gl/texture/texture.h"

#include <stdlib.h>
#include <string.h>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "gl_tokens.h"
#include "base/err.h"
#include "base/mat4.h"
#include "capture/format/trace.h"
#include "replay/gl/dispatch.h"
#include "replay/gl/geometry/buffer.h"
#include "replay/gl/geometry/list.h"
#include "replay/gl/surface/framebuffer.h"
#include "replay/gl/texture/texformat.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "replay/machine/state.h"
#include "base/table.h"

#define IMAGE_KEEP_FRAMES 8                  /* frames that an unused image is kept */
#define IMAGE_KEEP_BYTES ((size_t)64 << 20) /* cache size below which nothing is dropped */

static const uint32_t target_tokens[N_GLS_TEXTURE_TARGETS] = {
	GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP, GL_TEXTURE_RECTANGLE,
};

int gls_texture_target_of(uint32_t token, unsigned *face)
{
	*face = 0;
	if (token >= GL_TEXTURE_CUBE_MAP_POSITIVE_X && token <= GL_TEXTURE_CUBE_MAP_NEGATIVE_Z) {
		*face = token - GL_TEXTURE_CUBE_MAP_POSITIVE_X;
		return GLS_TEXTURE_CUBE;
	}
	for (int i = 0; i < N_GLS_TEXTURE_TARGETS; i++)
		if (target_tokens[i] == token)
			return i;
	return -1;
}

/* ---- objects, sec. 3.8.12 ---- */

static struct gls_texture *create(uint32_t name, uint32_t target)
{
	struct gls_texture *t = calloc(1, sizeof(*t));
	int rectangle = target == GLS_TEXTURE_RECTANGLE;

	if (!t)
		return NULL;
	t->name = name;
	t->target = target;
	t->parameters.wrap_s = t->parameters.wrap_t = t->parameters.wrap_r = rectangle ? GL_CLAMP_TO_EDGE : GL_REPEAT;
	t->parameters.min_filter = rectangle ? GL_LINEAR : GL_NEAREST_MIPMAP_LINEAR;
	t->parameters.mag_filter = GL_LINEAR;
	t->parameters.min_lod = -1000;
	t->parameters.max_lod = 1000;
	t->parameters.max_level = 1000;
	t->parameters.max_anisotropy = 1;
	t->parameters.priority = 1;
	t->parameters.compare_func = GL_LEQUAL;
	t->parameters.depth_mode = GL_LUMINANCE;
	memcpy(t->parameters.swizzle, (uint32_t[]){ GL_RED, GL_GREEN, GL_BLUE, GL_ALPHA }, sizeof(t->parameters.swizzle));
	t->parameters.srgb_decode = GL_DECODE_EXT;
	t->dirty = 1;
	return t;
}

void gls_texture_free(struct gls_texture *t)
{
	if (!t)
		return;
	for (unsigned face = 0; face < 6; face++)
		for (unsigned level = 0; level < GLS_MAX_LEVELS; level++)
			free(t->levels[face][level].texels);
	gls_texture_image_release(t->image);
	free(t);
}

struct gls_texture *gls_texture_bound(struct gls_exec *x, struct gls_state *st, unsigned unit, unsigned target)
{
	uint32_t name = st->a.texturing.units[unit].bound[target];
	struct gls_texture *t = name ? table_find(&st->share->textures, name) : NULL;

	if (t && t->target == target)
		return t;
	if (!st->share->defaults[target]) {
		st->share->defaults[target] = create(0, target);
		if (!st->share->defaults[target])
			gls_out_of_memory(x, sizeof(*t));
	}
	return st->share->defaults[target];
}

/* What is bound, without making what was never asked for. */
static struct gls_texture *bound_if_any(const struct gls_state *st, uint32_t name, unsigned target)
{
	struct gls_texture *t = name ? table_find(&st->share->textures, name) : st->share->defaults[target];

	return t && t->target == target ? t : NULL;
}

void gls_texture_save_parameters(const struct gls_state *st, struct gls_saved_texture saved[GLS_MAX_UNITS][N_GLS_TEXTURE_TARGETS])
{
	for (unsigned u = 0; u < GLS_MAX_UNITS; u++)
		for (unsigned target = 0; target < N_GLS_TEXTURE_TARGETS; target++) {
			uint32_t name = st->a.texturing.units[u].bound[target];
			const struct gls_texture *t = bound_if_any(st, name, target);

			if (t)
				saved[u][target] = (struct gls_saved_texture){ 1, name, t->parameters };
		}
}

void gls_texture_restore_parameters(struct gls_state *st,
                                    const struct gls_saved_texture saved[GLS_MAX_UNITS][N_GLS_TEXTURE_TARGETS])
{
	for (unsigned u = 0; u < GLS_MAX_UNITS; u++)
		for (unsigned target = 0; target < N_GLS_TEXTURE_TARGETS; target++) {
			const struct gls_saved_texture *s = &saved[u][target];
			struct gls_texture *t = s->there ? bound_if_any(st, s->name, target) : NULL;

			if (!t || memcmp(&t->parameters, &s->parameters, sizeof(s->parameters)) == 0)
				continue;
			t->parameters = s->parameters;
			t->dirty = 1;
		}
}

static struct gls_unit *active_unit(struct gls_state *st)
{
	return &st->a.texturing.units[st->a.texturing.active];
}

/* The object that a call with a target argument changes, or NULL (error set). */
static struct gls_texture *addressed(struct gls_exec *x, struct gls_state *st, uint32_t token)
{
	unsigned face;
	int target = gls_texture_target_of(token, &face);

	if (target >= 0)
		return gls_texture_bound(x, st, st->a.texturing.active, (unsigned)target);
	if (token >= GL_TEXTURE_1D_ARRAY && token <= GL_TEXTURE_2D_MULTISAMPLE_ARRAY)
		gls_unsupported(x, "texture targets of later GL");
	else
		gls_error(x, st, GL_INVALID_ENUM);
	return NULL;
}

GLS_HANDLER(glActiveTexture, STATE)
{
	uint32_t unit = arg_u(c, 0) - GL_TEXTURE0;

	if (unit < GLS_MAX_UNITS)
		st->a.texturing.active = unit;
	else if (unit < 32)
		gls_unsupported(x, "texture units beyond the eighth");
	else
		gls_error(x, st, GL_INVALID_ENUM);
}

GLS_HANDLER(glBindTexture, STATE)
{
	uint32_t token = arg_u(c, 0), name = arg_u(c, 1);
	unsigned face;
	int target = gls_texture_target_of(token, &face);
	struct gls_texture *t;

	if (target < 0 || token != target_tokens[target]) {
		addressed(x, st, token == GL_TEXTURE_1D_ARRAY ? token : 0);
		return;
	}
	t = name ? table_find(&st->share->textures, name) : NULL;
	if (t && t->target != (uint32_t)target) {
		gls_error(x, st, GL_INVALID_OPERATION);
		return;
	}
	if (name && !t) {
		t = create(name, (uint32_t)target);
		if (!t || table_set(&st->share->textures, name, t)) {
			gls_texture_free(t);
			gls_out_of_memory(x, sizeof(*t));
			return;
		}
	}
	active_unit(st)->bound[target] = name;
}

GLS_HANDLER(glDeleteTextures, NOW)
{
	uint64_t n;
	const struct trace_value *names = arg_items(c, 1, &n);
	struct gls_texture *t;

	gls_flush(x);
	st->dirty |= GLS_DIRTY_MATERIAL;
	for (uint64_t i = 0; i < n; i++) {
		uint32_t name = (uint32_t)gls_value_int(&names[i]);
		if (!name)
			continue;
		gls_texture_detach(x, st, name);
		t = table_remove(&st->share->textures, name);
		st->share->epoch += t != NULL;
		gls_texture_free(t);
		for (unsigned u = 0; u < GLS_MAX_UNITS; u++)
			for (unsigned target = 0; target < N_GLS_TEXTURE_TARGETS; target++)
				if (st->a.texturing.units[u].bound[target] == name)
					st->a.texturing.units[u].bound[target] = 0;
	}
}

GLS_HANDLER(glPrioritizeTextures, STATE) {} /* residence of textures; nothing is drawn differently */

/* ---- parameters, sec. 3.8.4 ---- */

static int is_wrap(const struct gls_texture *t, uint32_t wrap)
{
	int any = wrap == GL_CLAMP || wrap == GL_CLAMP_TO_EDGE || wrap == GL_CLAMP_TO_BORDER;

	return any || (t->target != GLS_TEXTURE_RECTANGLE &&
	               (wrap == GL_REPEAT || wrap == GL_MIRRORED_REPEAT || wrap == GL_MIRROR_CLAMP_EXT ||
	                wrap == GL_MIRROR_CLAMP_TO_EDGE || wrap == GL_MIRROR_CLAMP_TO_BORDER_EXT));
}

static int is_swizzle(uint32_t token)
{
	return token == GL_ZERO || token == GL_ONE || (token >= GL_RED && token <= GL_ALPHA);
}

static void set_parameter_of(struct gls_exec *x, struct gls_state *st, struct gls_texture *t, const struct call *c, int normalized)
{
	float v[4] = { 0 };
	uint32_t token;

	if (!t)
		return;
	arg_floats(c, 2, v, 4);
	token = token_of_float(v[0]);
	switch (arg_u(c, 1)) {
	case GL_TEXTURE_WRAP_S:
	case GL_TEXTURE_WRAP_T:
	case GL_TEXTURE_WRAP_R:
		if (!is_wrap(t, token)) {
			gls_error(x, st, GL_INVALID_ENUM);
			return;
		}
		*(arg_u(c, 1) == GL_TEXTURE_WRAP_S ? &t->parameters.wrap_s : arg_u(c, 1) == GL_TEXTURE_WRAP_T ? &t->parameters.wrap_t : &t->parameters.wrap_r) =
			token;
		break;
	case GL_TEXTURE_MIN_FILTER:
		if (token != GL_NEAREST && token != GL_LINEAR &&
		    (token < GL_NEAREST_MIPMAP_NEAREST || token > GL_LINEAR_MIPMAP_LINEAR || t->target == GLS_TEXTURE_RECTANGLE)) {
			gls_error(x, st, GL_INVALID_ENUM);
			return;
		}
		t->parameters.min_filter = token;
		t->dirty = 1;
		break;
	case GL_TEXTURE_MAG_FILTER:
		if (token != GL_NEAREST && token != GL_LINEAR) {
			gls_error(x, st, GL_INVALID_ENUM);
			return;
		}
		t->parameters.mag_filter = token;
		break;
	case GL_TEXTURE_BORDER_COLOR:
		for (unsigned i = 0; i < 4; i++)
			t->parameters.border_color[i] = normalized ? (float)((2.0 * v[i] + 1) / 4294967295.0) : v[i];
		break;
	case GL_TEXTURE_PRIORITY:
		t->parameters.priority = v[0];
		break;
	case GL_TEXTURE_MIN_LOD:
		t->parameters.min_lod = v[0];
		break;
	case GL_TEXTURE_MAX_LOD:
		t->parameters.max_lod = v[0];
		break;
	case GL_TEXTURE_BASE_LEVEL:
	case GL_TEXTURE_MAX_LEVEL:
		if (v[0] < 0) {
			gls_error(x, st, GL_INVALID_VALUE);
			return;
		}
		*(arg_u(c, 1) == GL_TEXTURE_BASE_LEVEL ? &t->parameters.base_level : &t->parameters.max_level) = token;
		t->dirty = 1;
		break;
	case GL_TEXTURE_LOD_BIAS:
		t->parameters.lod_bias = v[0];
		break;
	case GL_GENERATE_MIPMAP:
		t->parameters.generate_mipmap = v[0] != 0;
		break;
	case GL_TEXTURE_COMPARE_MODE:
		t->parameters.compare_mode = token;
		break;
	case GL_TEXTURE_COMPARE_FUNC:
		t->parameters.compare_func = token;
		break;
	case GL_DEPTH_TEXTURE_MODE:
		t->parameters.depth_mode = token;
		break;
	case GL_TEXTURE_SRGB_DECODE_EXT:
		t->parameters.srgb_decode = token;
		t->dirty = 1;
		break;
	case GL_TEXTURE_SWIZZLE_R:
	case GL_TEXTURE_SWIZZLE_G:
	case GL_TEXTURE_SWIZZLE_B:
	case GL_TEXTURE_SWIZZLE_A:
		if (!is_swizzle(token))
			gls_error(x, st, GL_INVALID_ENUM);
		else
			t->parameters.swizzle[arg_u(c, 1) - GL_TEXTURE_SWIZZLE_R] = token;
		break;
	case GL_TEXTURE_SWIZZLE_RGBA:
		for (unsigned i = 0; i < 4; i++)
			if (!(v[i] >= 0.0f) || !is_swizzle(token_of_float(v[i]))) {
				gls_error(x, st, GL_INVALID_ENUM);
				return;
			}
		for (unsigned i = 0; i < 4; i++)
			t->parameters.swizzle[i] = token_of_float(v[i]);
		break;
	case GL_TEXTURE_MAX_ANISOTROPY_EXT:
		if (!(v[0] >= 1))
			gls_error(x, st, GL_INVALID_VALUE);
		else
			t->parameters.max_anisotropy = v[0];
		break;
	default:
		gls_error(x, st, GL_INVALID_ENUM);
	}
}

static void set_parameter(struct gls_exec *x, struct gls_state *st, const struct call *c, int normalized)
{
	set_parameter_of(x, st, addressed(x, st, arg_u(c, 0)), c, normalized);
}

GLS_HANDLER(glTexParameterf, STATE) { set_parameter(x, st, c, 0); }
GLS_HANDLER(glTexParameterfv, STATE) { set_parameter(x, st, c, 0); }
GLS_HANDLER(glTexParameteri, STATE) { set_parameter(x, st, c, 0); }
GLS_HANDLER(glTexParameteriv, STATE) { set_parameter(x, st, c, 1); }

/* ---- sampler objects, GL 3.3 sec. 3.8.2 ---- */

/* They have the parameters of textures, and lie in the table of textures beyond all names of textures. */
#define SAMPLER_KEY(name) ((uint64_t)1 << 32 | (name))

const struct gls_texture *gls_texture_sampler(const struct gls_state *st, unsigned unit, const struct gls_texture *t)
{
	uint32_t name = st->a.texturing.units[unit].sampler;
	const struct gls_texture *sampler = name ? table_find(&st->share->textures, SAMPLER_KEY(name)) : NULL;

	return sampler ? sampler : t;
}

static struct gls_texture *find_sampler(struct gls_exec *x, struct gls_state *st, uint32_t name)
{
	struct gls_texture *sampler = name ? table_find(&st->share->textures, SAMPLER_KEY(name)) : NULL;

	if (sampler || !name)
		return sampler;
	sampler = create(name, GLS_TEXTURE_2D);
	if (!sampler || table_set(&st->share->textures, SAMPLER_KEY(name), sampler)) {
		gls_texture_free(sampler);
		gls_out_of_memory(x, sizeof(*sampler));
		return NULL;
	}
	return sampler;
}

GLS_HANDLER(glBindSampler, STATE)
{
	if (arg_u(c, 0) >= GLS_MAX_UNITS) {
		gls_unsupported(x, "texture units beyond the eighth");
		return;
	}
	find_sampler(x, st, arg_u(c, 1));
	st->a.texturing.units[arg_u(c, 0)].sampler = arg_u(c, 1);
}

GLS_HANDLER(glDeleteSamplers, NOW)
{
	uint64_t n;
	const struct trace_value *names = arg_items(c, 1, &n);

	gls_flush(x);
	st->dirty |= GLS_DIRTY_MATERIAL;
	for (uint64_t i = 0; i < n; i++) {
		uint32_t name = (uint32_t)gls_value_int(&names[i]);

		if (!name)
			continue;
		gls_texture_free(table_remove(&st->share->textures, SAMPLER_KEY(name)));
		for (unsigned u = 0; u < GLS_MAX_UNITS; u++)
			if (st->a.texturing.units[u].sampler == name)
				st->a.texturing.units[u].sampler = 0;
	}
}

GLS_HANDLER(glSamplerParameterf, STATE) { set_parameter_of(x, st, find_sampler(x, st, arg_u(c, 0)), c, 0); }
GLS_HANDLER(glSamplerParameterfv, STATE) { set_parameter_of(x, st, find_sampler(x, st, arg_u(c, 0)), c, 0); }
GLS_HANDLER(glSamplerParameteri, STATE) { set_parameter_of(x, st, find_sampler(x, st, arg_u(c, 0)), c, 0); }
GLS_HANDLER(glSamplerParameteriv, STATE) { set_parameter_of(x, st, find_sampler(x, st, arg_u(c, 0)), c, 1); }

/* ---- environments, sec. 3.8.13 ---- */

static void set_env(struct gls_exec *x, struct gls_state *st, const struct call *c, int normalized)
{
	struct gls_unit *unit = active_unit(st);
	struct scene_unit *e = &unit->value;
	uint32_t target = arg_u(c, 0), pname = arg_u(c, 1), token;
	float v[4] = { 0 };

	arg_floats(c, 2, v, 4);
	token = token_of_float(v[0]);
	if (target == GL_TEXTURE_FILTER_CONTROL && pname == GL_TEXTURE_LOD_BIAS) {
		unit->lod_bias = v[0];
		return;
	}
	if (target == GL_POINT_SPRITE && pname == GL_COORD_REPLACE) {
		e->coord_replace = v[0] != 0;
		return;
	}
	if (target != GL_TEXTURE_ENV) {
		gls_error(x, st, GL_INVALID_ENUM);
		return;
	}
	if (pname >= GL_SOURCE0_RGB && pname < GL_SOURCE0_RGB + 4) {
		e->source_rgb[pname - GL_SOURCE0_RGB] = token;
		return;
	}
	if (pname >= GL_SOURCE0_ALPHA && pname < GL_SOURCE0_ALPHA + 4) {
		e->source_alpha[pname - GL_SOURCE0_ALPHA] = token;
		return;
	}
	if (pname >= GL_OPERAND0_RGB && pname < GL_OPERAND0_RGB + 4) {
		e->operand_rgb[pname - GL_OPERAND0_RGB] = token;
		return;
	}
	if (pname >= GL_OPERAND0_ALPHA && pname < GL_OPERAND0_ALPHA + 4) {
		e->operand_alpha[pname - GL_OPERAND0_ALPHA] = token;
		return;
	}
	switch (pname) {
	case GL_TEXTURE_ENV_MODE:
		if (token != GL_MODULATE && token != GL_DECAL && token != GL_BLEND && token != GL_REPLACE && token != GL_ADD &&
		    token != GL_COMBINE && token != GL_COMBINE4_NV) {
			gls_error(x, st, GL_INVALID_ENUM);
			return;
		}
		e->env_mode = token;
		break;
	case GL_TEXTURE_ENV_COLOR:
		for (unsigned i = 0; i < 4; i++)
			e->env_color[i] = normalized ? (float)((2.0 * v[i] + 1) / 4294967295.0) : v[i];
		break;
	case GL_COMBINE_RGB:
		e->combine_rgb = token;
		break;
	case GL_COMBINE_ALPHA:
		e->combine_alpha = token;
		break;
	case GL_RGB_SCALE:
	case GL_ALPHA_SCALE:
		if (v[0] != 1 && v[0] != 2 && v[0] != 4) {
			gls_error(x, st, GL_INVALID_VALUE);
			return;
		}
		*(pname == GL_RGB_SCALE ? &e->scale_rgb : &e->scale_alpha) = v[0];
		break;
	default:
		gls_error(x, st, GL_INVALID_ENUM);
	}
}

GLS_HANDLER(glTexEnvf, STATE) { set_env(x, st, c, 0); }
GLS_HANDLER(glTexEnvfv, STATE) { set_env(x, st, c, 0); }
GLS_HANDLER(glTexEnvi, STATE) { set_env(x, st, c, 0); }
GLS_HANDLER(glTexEnviv, STATE) { set_env(x, st, c, 1); }

/* ---- coordinate generation, sec. 2.11.4 ---- */

static void set_gen(struct gls_exec *x, struct gls_state *st, const struct call *c)
{
	struct scene_unit *e = &active_unit(st)->value;
	uint32_t coord = arg_u(c, 0) - GL_S, mode;
	float v[4] = { 0 }, inverse[16];

	if (coord > 3) {
		gls_error(x, st, GL_INVALID_ENUM);
		return;
	}
	arg_floats(c, 2, v, 4);
	mode = token_of_float(v[0]);
	switch (arg_u(c, 1)) {
	case GL_TEXTURE_GEN_MODE:
		if (mode != GL_OBJECT_LINEAR && mode != GL_EYE_LINEAR && (mode != GL_SPHERE_MAP || coord > 1) &&
		    ((mode != GL_REFLECTION_MAP && mode != GL_NORMAL_MAP) || coord > 2)) {
			gls_error(x, st, GL_INVALID_ENUM);
			return;
		}
		e->gen_mode[coord] = mode;
		break;
	case GL_OBJECT_PLANE:
		memcpy(e->gen_object_plane[coord], v, 16);
		break;
	case GL_EYE_PLANE:
		mat4_invert(inverse, st->modelview.matrices[st->modelview.depth]);
		mat4_transform_plane(e->gen_eye_plane[coord], v, inverse);
		break;
	default:
		gls_error(x, st, GL_INVALID_ENUM);
	}
}

GLS_HANDLER(glTexGend, STATE) { set_gen(x, st, c); }
GLS_HANDLER(glTexGendv, STATE) { set_gen(x, st, c); }
GLS_HANDLER(glTexGenf, STATE) { set_gen(x, st, c); }
GLS_HANDLER(glTexGenfv, STATE) { set_gen(x, st, c); }
GLS_HANDLER(glTexGeni, STATE) { set_gen(x, st, c); }
GLS_HANDLER(glTexGeniv, STATE) { set_gen(x, st, c); }

/* ---- completeness (sec. 3.8.10) and images ---- */

static uint32_t half(uint32_t size)
{
	return size > 1 ? size / 2 : 1;
}

static int is_mipmapped(uint32_t filter)
{
	return filter != GL_NEAREST && filter != GL_LINEAR;
}

/* Levels from the base level on that continue each other; 0: no base image. */
static uint32_t count_levels(const struct gls_texture *t, unsigned face)
{
	const struct gls_level *base, *level;
	uint32_t w, h, d, n;

	if (t->parameters.base_level >= GLS_MAX_LEVELS || t->parameters.base_level > t->parameters.max_level)
		return 0;
	base = &t->levels[face][t->parameters.base_level];
	if (!base->texels)
		return 0;
	w = base->width - 2 * base->border;
	h = t->target == GLS_TEXTURE_1D ? 1 : base->height - 2 * base->border;
	d = t->target == GLS_TEXTURE_3D ? base->depth - 2 * base->border : 1;
	if (!w || !h || !d)
		return 0; /* nothing but borders */
	for (n = 1; t->parameters.base_level + n < GLS_MAX_LEVELS && t->parameters.base_level + n <= t->parameters.max_level && (w > 1 || h > 1 || d > 1); n++) {
		w = half(w);
		h = half(h);
		d = half(d);
		level = base + n;
		if (!level->texels || level->border != base->border || level->internal_format != base->internal_format ||
		    level->width != w + 2 * base->border ||
		    (t->target != GLS_TEXTURE_1D && level->height != h + 2 * base->border) ||
		    (t->target == GLS_TEXTURE_3D && level->depth != d + 2 * base->border))
			return n | 0x80000000u; /* the chain breaks off */
	}
	return n;
}

static int is_cube_complete(const struct gls_texture *t)
{
	const struct gls_level *first = &t->levels[0][t->parameters.base_level];

	for (unsigned face = 0; face < 6; face++) {
		const struct gls_level *base = &t->levels[face][t->parameters.base_level];
		if (!base->texels || base->width != base->height || base->width != first->width ||
		    base->internal_format != first->internal_format)
			return 0;
	}
	return 1;
}

static void decode_srgb(uint8_t *to, const uint8_t *from, size_t n_texels)
{
	uint8_t linear[256];

	for (unsigned i = 0; i < 256; i++)
		linear[i] = (uint8_t)(gls_linear_from_srgb((float)i / 255) * 255 + 0.5f);
	for (size_t i = 0; i < 4 * n_texels; i++)
		to[i] = i % 4 == 3 ? from[i] : linear[from[i]];
}

static struct gls_texture_image *build_image(struct gls_exec *x, const struct gls_texture *t, uint32_t n_levels)
{
	const struct gls_level *base = &t->levels[0][t->parameters.base_level];
	unsigned n_faces = t->target == GLS_TEXTURE_CUBE ? 6 : 1;
	const struct gls_format *format = gls_format_find(base->internal_format);
	int srgb = format && format->srgb && t->parameters.srgb_decode != GL_SKIP_DECODE_EXT;
	uint32_t head[9] = { target_tokens[t->target], base->base_format, base->width - 2 * base->border,
	                     t->target == GLS_TEXTURE_1D ? 1 : base->height - 2 * base->border,
	                     t->target == GLS_TEXTURE_3D ? base->depth - 2 * base->border : 1, n_levels, base->border, (uint32_t)srgb,
	                     base->texel_bytes };
	struct gls_texture_image *image;
	XXH3_state_t state;
	XXH128_hash_t hash;
	uint64_t key;
	size_t bytes = 0, n;
	uint8_t *at;

	XXH3_128bits_reset(&state);
	XXH3_128bits_update(&state, head, sizeof(head));
	for (uint32_t l = 0; l < n_levels; l++)
		for (unsigned face = 0; face < n_faces; face++) {
			const struct gls_level *level = &t->levels[face][t->parameters.base_level + l];
			n = level->texel_bytes * gls_level_count(level);
			XXH3_128bits_update(&state, level->texels, n);
			bytes += n;
		}
	hash = XXH3_128bits_digest(&state);
	for (key = hash.low64; (image = table_find(&x->caches.images, key)); key++)
		if (image->texture.hash[1] == hash.high64 && image->texture.hash[0] == hash.low64) {
			atomic_fetch_add(&image->refs, 1);
			return image;
		}
	image = calloc(1, sizeof(*image) + bytes);
	if (!image || table_set(&x->caches.images, key, image)) {
		free(image);
		gls_out_of_memory(x, bytes);
		return NULL;
	}
	atomic_init(&image->refs, 2); /* the cache's and the caller's */
	image->texture = (struct scene_texture){ .hash = { hash.low64, hash.high64 }, .target = head[0],
		.base_format = head[1], .width = head[2], .height = head[3], .depth = head[4], .n_levels = n_levels,
		.border = base->border, .floats = base->texel_bytes == 16, .n_bytes = bytes };
	image->texture.texels = at = (uint8_t *)(image + 1);
	for (uint32_t l = 0; l < n_levels; l++)
		for (unsigned face = 0; face < n_faces; face++) {
			const struct gls_level *level = &t->levels[face][t->parameters.base_level + l];
			if (srgb)
				decode_srgb(at, level->texels, gls_level_count(level));
			else
				memcpy(at, level->texels, level->texel_bytes * gls_level_count(level));
			at += level->texel_bytes * gls_level_count(level);
		}
	x->caches.image_bytes += bytes;
	return image;
}

struct gls_texture_image *gls_texture_image_find(struct gls_exec *x, uint32_t width, uint32_t height, uint32_t texel_bytes,
                                                 const uint8_t *texels)
{
	struct gls_texture t = { .target = GLS_TEXTURE_2D };
	struct gls_texture_image *image;

	t.levels[0][0] = (struct gls_level){ .width = width, .height = height, .depth = 1, .base_format = GL_RGBA,
		                             .texel_bytes = texel_bytes, .texels = (uint8_t *)(uintptr_t)texels,
		                             .bytes = (size_t)width * height * texel_bytes };
	image = build_image(x, &t, 1);
	if (image)
		image->used_frame = x->frame;
	return image;
}

struct gls_texture_image *gls_texture_image_of(struct gls_exec *x, struct gls_texture *t, uint32_t min_filter)
{
	uint32_t n, n_face;

	if (!t->dirty && t->mipmapped == (uint32_t)is_mipmapped(min_filter))
		return t->image;
	t->mipmapped = (uint32_t)is_mipmapped(min_filter);
	gls_texture_image_release(t->image);
	t->image = NULL;
	t->dirty = 0;
	n = count_levels(t, 0);
	if (!n || (t->target == GLS_TEXTURE_CUBE && !is_cube_complete(t)))
		return NULL;
	for (unsigned face = 1; face < 6 && t->target == GLS_TEXTURE_CUBE; face++) {
		n_face = count_levels(t, face);
		if ((n_face & 0x7fffffffu) < (n & 0x7fffffffu))
			n = n_face | 0x80000000u;
	}
	if (t->mipmapped && n & 0x80000000u)
		return NULL;
	t->image = build_image(x, t, t->mipmapped ? n & 0x7fffffffu : 1);
	return t->image;
}

uint32_t gls_texture_missing(const struct gls_texture *t)
{
	for (unsigned face = 0; face < (t->target == GLS_TEXTURE_CUBE ? 6u : 1u); face++)
		for (unsigned level = 0; level < GLS_MAX_LEVELS; level++)
			if (t->levels[face][level].missing)
				return t->levels[face][level].missing;
	return 0;
}

void gls_texture_image_release(struct gls_texture_image *image)
{
	if (image && atomic_fetch_sub(&image->refs, 1) == 1)
		free(image);
}

/* Screen copies make a new image each frame: drop those that the cache alone holds and nobody drew for a while. */
void gls_image_cache_trim(struct gls_exec *x)
{
	if (x->caches.image_bytes < IMAGE_KEEP_BYTES || x->frame % IMAGE_KEEP_FRAMES)
		return;
	for (size_t i = 0; i < x->caches.images.room;) {
		struct table_entry e = x->caches.images.entries[i];
		struct gls_texture_image *image = e.value;
		if (!image || atomic_load(&image->refs) > 1 || image->used_frame + IMAGE_KEEP_FRAMES > x->frame) {
			i++;
			continue;
		}
		x->caches.image_bytes -= image->texture.n_bytes;
		table_remove(&x->caches.images, e.key); /* may move another one into this place: look again */
		gls_texture_image_release(image);
	}
}

void gls_image_cache_free(struct gls_exec *x)
{
	for (size_t i = 0; i < x->caches.images.room; i++)
		gls_texture_image_release(x->caches.images.entries[i].value);
	table_free(&x->caches.images);
}

/* ---- the end of a share group ---- */

void gls_share_release(struct gls_share *share)
{
	if (--share->refs)
		return;
	for (size_t i = 0; i < share->lists.room; i++)
		if (share->lists.entries[i].value)
			gls_list_free(share->lists.entries[i].value);
	for (size_t i = 0; i < share->textures.room; i++)
		gls_texture_free(share->textures.entries[i].value);
	for (size_t i = 0; i < share->buffers.room; i++) {
		struct gls_buffer *b = share->buffers.entries[i].value;
		if (b)
			free(b->data);
		free(b);
	}
	for (unsigned i = 0; i < N_GLS_TEXTURE_TARGETS; i++)
		gls_texture_free(share->defaults[i]);
	table_free(&share->lists);
	table_free(&share->textures);
	table_free(&share->buffers);
	for (size_t i = 0; i < share->framebuffers.room; i++)
		gls_framebuffer_free(share->framebuffers.entries[i].value);
	for (size_t i = 0; i < share->renderbuffers.room; i++)
		gls_renderbuffer_free(share->renderbuffers.entries[i].value);
	table_free(&share->programs);
	table_free(&share->framebuffers);
	table_free(&share->renderbuffers);
	free(share);
}
