/* Texture objects and their parameters, sampler objects. */
#include "replay/gl/texture/texture.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "capture/format/call.h"
#include "replay/gl/texture/image.h"
#include "replay/gl/texture/texformat.h"
#include "replay/machine/args.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"

#define MAX_SIZE 16384
#define MAX_BYTES ((int64_t)1 << 31) /* llvmpipe (Mesa 22.3) rejects images of this size or more */

int gls_texture_target_of(uint32_t token, unsigned *face)
{
	*face = 0;
	if (token >= GL_TEXTURE_CUBE_MAP_POSITIVE_X && token <= GL_TEXTURE_CUBE_MAP_NEGATIVE_Z) {
		*face = token - GL_TEXTURE_CUBE_MAP_POSITIVE_X;
		return GLS_TEXTURE_CUBE;
	}
	for (uint32_t i = 0; i < N_GLS_TEXTURE_TARGETS; i++)
		if (gls_texture_token(i) == token)
			return (int)i;
	return -1;
}

/* ---- objects, sec. 3.8.12 ---- */

/* Initial values of table 6.17 and similar tables. */
static struct gls_texture_parameters initial_parameters(uint32_t target)
{
	const int rectangle = target == GLS_TEXTURE_RECTANGLE;
	const uint32_t wrap = rectangle ? GL_CLAMP_TO_EDGE : GL_REPEAT;

	return (struct gls_texture_parameters){
		.wrap_s = wrap, .wrap_t = wrap, .wrap_r = wrap,
		.min_filter = rectangle ? GL_LINEAR : GL_NEAREST_MIPMAP_LINEAR, .mag_filter = GL_LINEAR,
		.min_lod = -1000, .max_lod = 1000, .max_level = 1000, .max_anisotropy = 1, .priority = 1,
		.compare_func = GL_LEQUAL, .depth_mode = GL_LUMINANCE, .swizzle = { GL_RED, GL_GREEN, GL_BLUE, GL_ALPHA },
		.srgb_decode = GL_DECODE_EXT,
	};
}

static struct gls_texture *create(uint32_t name, uint32_t target)
{
	struct gls_texture *t = calloc(1, sizeof(*t));

	if (!t)
		return NULL;
	t->name = name;
	t->target = target;
	t->parameters = initial_parameters(target);
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
	scene_release(&t->drawn);
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

/* The bound object; NULL if it has not been created yet. */
static struct gls_texture *bound_if_any(const struct gls_state *st, uint32_t name, unsigned target)
{
	struct gls_texture *t = name ? table_find(&st->share->textures, name) : st->share->defaults[target];

	return t && t->target == target ? t : NULL;
}

void gls_texture_save_parameters(const struct gls_state *st,
                                 struct gls_saved_texture saved[GLS_MAX_UNITS][N_GLS_TEXTURE_TARGETS])
{
	for (unsigned u = 0; u < GLS_MAX_UNITS; u++)
		for (unsigned target = 0; target < N_GLS_TEXTURE_TARGETS; target++) {
			uint32_t name = st->a.texturing.units[u].bound[target];
			const struct gls_texture *t = bound_if_any(st, name, target);

			if (t || !name) /* a default object that has not been created yet has its initial state */
				saved[u][target] = (struct gls_saved_texture){ 1, name, t ? t->parameters : initial_parameters(target) };
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

/* Targets of GL 3.0 and later, which Mesa and others accept in any context. */
static int is_later_target(uint32_t token)
{
	switch (token) {
	case GL_TEXTURE_1D_ARRAY: case GL_TEXTURE_CUBE_MAP_ARRAY: case GL_TEXTURE_BUFFER:
	case GL_TEXTURE_2D_MULTISAMPLE: case GL_TEXTURE_2D_MULTISAMPLE_ARRAY:
		return 1;
	default:
		return 0;
	}
}

void gls_texture_no_target(struct gls_exec *x, struct gls_state *st, uint32_t token)
{
	if (is_later_target(token))
		gls_unsupported(x, "texture targets of later GL");
	else
		gls_error(x, st, GL_INVALID_ENUM);
}

/* The object that a call with a target argument changes, or NULL (error set). */
static struct gls_texture *addressed(struct gls_exec *x, struct gls_state *st, uint32_t token)
{
	unsigned face;
	int target = gls_texture_target_of(token, &face);

	if (target >= 0)
		return gls_texture_bound(x, st, st->a.texturing.active, (unsigned)target);
	gls_texture_no_target(x, st, token);
	return NULL;
}

GLS_HANDLER(glActiveTexture, STATE, SELECT)
{
	uint32_t unit = arg_u(c, 0) - GL_TEXTURE0;

	if (unit < GLS_MAX_UNITS)
		st->a.texturing.active = unit;
	else if (unit < 32)
		gls_unsupported(x, "texture units beyond the eighth");
	else
		gls_error(x, st, GL_INVALID_ENUM);
}

GLS_HANDLER(glBindTexture, STATE, BIND_TEXTURE)
{
	uint32_t token = arg_u(c, 0), name = arg_u(c, 1);
	unsigned face;
	int target = gls_texture_target_of(token, &face);
	struct gls_texture *t;

	if (target < 0 || token != gls_texture_token((uint32_t)target)) {
		gls_texture_no_target(x, st, token);
		return;
	}
	t = name ? table_find(&st->share->textures, name) : NULL;
	if (gls_refuses(x, st, t && t->target != (uint32_t)target, GL_INVALID_OPERATION))
		return;
	if (name && !t) {
		t = create(name, (uint32_t)target);
		if (!t || table_set(&st->share->textures, name, t)) {
			gls_texture_free(t);
			gls_out_of_memory(x, sizeof(*t));
			return;
		}
	}
	gls_active_unit(st)->bound[target] = name;
}

GLS_HANDLER(glPrioritizeTextures, STATE) {} /* texture residence; does not affect drawing */

/* ---- parameters, sec. 3.8.4 ---- */

static int is_wrap(const struct gls_texture *t, float value)
{
	uint32_t wrap = token_of_float(value);
	int any = wrap == GL_CLAMP || wrap == GL_CLAMP_TO_EDGE || wrap == GL_CLAMP_TO_BORDER;

	return any || (t->target != GLS_TEXTURE_RECTANGLE &&
	               (wrap == GL_REPEAT || wrap == GL_MIRRORED_REPEAT || wrap == GL_MIRROR_CLAMP_EXT ||
	                wrap == GL_MIRROR_CLAMP_TO_EDGE || wrap == GL_MIRROR_CLAMP_TO_BORDER_EXT));
}

static int is_mag_filter(const struct gls_texture *t __attribute__((unused)), float value)
{
	uint32_t filter = token_of_float(value);

	return filter == GL_NEAREST || filter == GL_LINEAR;
}

static int is_min_filter(const struct gls_texture *t, float value)
{
	uint32_t filter = token_of_float(value);

	return is_mag_filter(t, value) || (filter >= GL_NEAREST_MIPMAP_NEAREST && filter <= GL_LINEAR_MIPMAP_LINEAR &&
	                                   t->target != GLS_TEXTURE_RECTANGLE);
}

static int is_swizzle(const struct gls_texture *t __attribute__((unused)), float value)
{
	uint32_t token = token_of_float(value);

	return token == GL_ZERO || token == GL_ONE || (token >= GL_RED && token <= GL_ALPHA);
}

static int is_compare_mode(const struct gls_texture *t __attribute__((unused)), float value)
{
	return token_of_float(value) == GL_NONE || token_of_float(value) == GL_COMPARE_R_TO_TEXTURE;
}

static int is_compare_func(const struct gls_texture *t __attribute__((unused)), float value)
{
	return gls_is_compare_func(token_of_float(value));
}

static int is_depth_mode(const struct gls_texture *t __attribute__((unused)), float value)
{
	uint32_t mode = token_of_float(value);

	return mode == GL_LUMINANCE || mode == GL_INTENSITY || mode == GL_ALPHA || mode == GL_RED;
}

static int is_not_negative(const struct gls_texture *t __attribute__((unused)), float value)
{
	return !(value < 0);
}

static int is_at_least_one(const struct gls_texture *t __attribute__((unused)), float value)
{
	return value >= 1;
}

/* A parameter with one number: its place in struct gls_texture_parameters, and its valid values. */
struct parameter {
	uint32_t name;
	enum { TOKEN, FLOAT, BOOLEAN } kind;
	size_t place;
	int (*allows)(const struct gls_texture *t, float value); /* NULL: anything */
	uint32_t error;                                          /* for invalid values */
	uint32_t changes_image;
};

static const struct parameter *find_parameter(uint32_t name)
{
#define AT(field) offsetof(struct gls_texture_parameters, field)
	static const struct parameter parameters[] = {
		{ GL_TEXTURE_WRAP_S, TOKEN, AT(wrap_s), is_wrap, GL_INVALID_ENUM, 0 },
		{ GL_TEXTURE_WRAP_T, TOKEN, AT(wrap_t), is_wrap, GL_INVALID_ENUM, 0 },
		{ GL_TEXTURE_WRAP_R, TOKEN, AT(wrap_r), is_wrap, GL_INVALID_ENUM, 0 },
		{ GL_TEXTURE_MIN_FILTER, TOKEN, AT(min_filter), is_min_filter, GL_INVALID_ENUM, 1 },
		{ GL_TEXTURE_MAG_FILTER, TOKEN, AT(mag_filter), is_mag_filter, GL_INVALID_ENUM, 0 },
		{ GL_TEXTURE_PRIORITY, FLOAT, AT(priority), NULL, 0, 0 },
		{ GL_TEXTURE_MIN_LOD, FLOAT, AT(min_lod), NULL, 0, 0 },
		{ GL_TEXTURE_MAX_LOD, FLOAT, AT(max_lod), NULL, 0, 0 },
		{ GL_TEXTURE_BASE_LEVEL, TOKEN, AT(base_level), is_not_negative, GL_INVALID_VALUE, 1 },
		{ GL_TEXTURE_MAX_LEVEL, TOKEN, AT(max_level), is_not_negative, GL_INVALID_VALUE, 1 },
		{ GL_TEXTURE_LOD_BIAS, FLOAT, AT(lod_bias), NULL, 0, 0 },
		{ GL_GENERATE_MIPMAP, BOOLEAN, AT(generate_mipmap), NULL, 0, 0 },
		{ GL_TEXTURE_COMPARE_MODE, TOKEN, AT(compare_mode), is_compare_mode, GL_INVALID_ENUM, 0 },
		{ GL_TEXTURE_COMPARE_FUNC, TOKEN, AT(compare_func), is_compare_func, GL_INVALID_ENUM, 0 },
		{ GL_DEPTH_TEXTURE_MODE, TOKEN, AT(depth_mode), is_depth_mode, GL_INVALID_ENUM, 0 },
		{ GL_TEXTURE_SRGB_DECODE_EXT, TOKEN, AT(srgb_decode), NULL, 0, 1 },
		{ GL_TEXTURE_SWIZZLE_R, TOKEN, AT(swizzle[0]), is_swizzle, GL_INVALID_ENUM, 0 },
		{ GL_TEXTURE_SWIZZLE_G, TOKEN, AT(swizzle[1]), is_swizzle, GL_INVALID_ENUM, 0 },
		{ GL_TEXTURE_SWIZZLE_B, TOKEN, AT(swizzle[2]), is_swizzle, GL_INVALID_ENUM, 0 },
		{ GL_TEXTURE_SWIZZLE_A, TOKEN, AT(swizzle[3]), is_swizzle, GL_INVALID_ENUM, 0 },
		{ GL_TEXTURE_MAX_ANISOTROPY_EXT, FLOAT, AT(max_anisotropy), is_at_least_one, GL_INVALID_VALUE, 0 },
	};
#undef AT

	for (size_t i = 0; i < sizeof(parameters) / sizeof(parameters[0]); i++)
		if (parameters[i].name == name)
			return &parameters[i];
	return NULL;
}

static void set_number(struct gls_exec *x, struct gls_state *st, struct gls_texture *t, const struct parameter *p,
                       float value)
{
	uint32_t word = p->kind == BOOLEAN ? value != 0 : token_of_float(value);

	if (p->allows && !p->allows(t, value)) {
		gls_error(x, st, p->error);
		return;
	}
	memcpy((uint8_t *)&t->parameters + p->place, p->kind == FLOAT ? (const void *)&value : &word, sizeof(word));
	t->dirty |= p->changes_image;
}

static void set_swizzles(struct gls_exec *x, struct gls_state *st, struct gls_texture *t, const float v[4])
{
	for (unsigned i = 0; i < 4; i++)
		if (gls_refuses(x, st, !(v[i] >= 0.0f) || !is_swizzle(t, v[i]), GL_INVALID_ENUM))
			return;
	for (unsigned i = 0; i < 4; i++)
		t->parameters.swizzle[i] = token_of_float(v[i]);
}

static void set_parameter(struct gls_exec *x, struct gls_state *st, struct gls_texture *t, const struct call *c)
{
	const struct parameter *p = find_parameter(arg_u(c, 1));
	float v[4] = { 0 };

	if (!t)
		return;
	arg_floats(c, 2, v, 4);
	if (p)
		set_number(x, st, t, p, v[0]);
	else if (arg_u(c, 1) == GL_TEXTURE_BORDER_COLOR)
		arg_color(x, c, 2, t->parameters.border_color);
	else if (arg_u(c, 1) == GL_TEXTURE_CROP_RECT_OES)
		for (unsigned i = 0; i < 4; i++)
			t->parameters.crop[i] = (int32_t)v[i];
	else if (arg_u(c, 1) == GL_TEXTURE_SWIZZLE_RGBA)
		set_swizzles(x, st, t, v);
	else
		gls_error(x, st, GL_INVALID_ENUM);
}

GLS_FAMILY(glTexParameter, STATE) { set_parameter(x, st, addressed(x, st, arg_u(c, 0)), c); }

/* ---- sampler objects, GL 3.3 sec. 3.8.2 ---- */

/* A sampler object is a texture without levels. Its key in the table of textures is above all texture names. */
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

GLS_HANDLER(glDeleteSamplers, OBJECT)
{
	uint64_t at = 0;

	for (uint32_t name; (name = arg_next_name(c, 1, &at));) {
		gls_texture_free(table_remove(&st->share->textures, SAMPLER_KEY(name)));
		for (unsigned u = 0; u < GLS_MAX_UNITS; u++)
			if (st->a.texturing.units[u].sampler == name)
				st->a.texturing.units[u].sampler = 0;
	}
}

GLS_FAMILY(glSamplerParameter, STATE) { set_parameter(x, st, find_sampler(x, st, arg_u(c, 0)), c); }

/* ---- levels, sec. 3.8.1 ---- */

/* 1D textures are not compressed. */
static uint32_t uncompressed(uint32_t internal_format)
{
	switch (internal_format) {
	case GL_COMPRESSED_RGB: return GL_RGB;
	case GL_COMPRESSED_RGBA: return GL_RGBA;
	case GL_COMPRESSED_SRGB: return GL_SRGB;
	case GL_COMPRESSED_SRGB_ALPHA: return GL_SRGB_ALPHA;
	default: return internal_format;
	}
}

struct gls_level *gls_texture_specify(struct gls_exec *x, struct gls_state *st, struct gls_texture *t, unsigned face,
                                      int64_t level, const struct gls_level_form *form)
{
	struct gls_level *l = &t->levels[face][level];
	uint32_t internal_format = t->target == GLS_TEXTURE_1D ? uncompressed(form->internal_format) : form->internal_format;
	int64_t width = form->width, height = form->height, depth = form->depth, least = form->border == 1 ? 2 : 0;
	size_t bytes;

	if (!gls_base_format(internal_format)) {
		/*
		 * Mesa accepts more formats than GL 2.1 has; the others have no colours that fixed function could use.
		 */
		gls_unsupported(x, "textures of this internal format");
		return NULL;
	}
	if (width < least || height < (t->target == GLS_TEXTURE_1D ? 0 : least) ||
	    depth < (t->target == GLS_TEXTURE_3D ? least : 0) || width > MAX_SIZE + 2 || height > MAX_SIZE + 2 ||
	    depth > MAX_SIZE + 2 || (form->border != 0 && form->border != 1)) {
		gls_error(x, st, GL_INVALID_VALUE);
		return NULL;
	}
	if (gls_refuses(x, st, width * height * depth * gls_texel_bytes(internal_format) >= MAX_BYTES, GL_OUT_OF_MEMORY))
		return NULL;
	bytes = (size_t)(width * height * depth) *
	        (gls_texel_bytes(internal_format) + (gls_format_stencil_bits(internal_format) ? 1 : 0));
	free(l->texels);
	*l = (struct gls_level){ .width = (uint32_t)width, .height = (uint32_t)height, .depth = (uint32_t)depth,
		.border = (uint32_t)form->border, .internal_format = internal_format, .base_format = gls_base_format(internal_format),
		.bytes = bytes, .texel_bytes = gls_texel_bytes(internal_format) };
	gls_texture_changed(t);
	if (!bytes)
		return NULL;
	l->texels = calloc(1, bytes);
	if (!l->texels)
		gls_out_of_memory(x, bytes);
	return l->texels ? l : NULL;
}

uint32_t gls_texture_missing(const struct gls_texture *t)
{
	for (unsigned face = 0; face < (t->target == GLS_TEXTURE_CUBE ? 6u : 1u); face++)
		for (unsigned level = 0; level < GLS_MAX_LEVELS; level++)
			if (t->levels[face][level].missing)
				return t->levels[face][level].missing;
	return 0;
}
