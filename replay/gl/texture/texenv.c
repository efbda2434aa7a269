/* Texture units: environments (GL 2.1 sec. 3.8.13) and coordinate generation (sec. 2.11.4). */
#include <string.h>

#include "gl_tokens.h"
#include "base/mat4.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/state.h"

/* ---- environments, sec. 3.8.13 ---- */

static int is_source(uint32_t token)
{
	return token == GL_TEXTURE || token == GL_CONSTANT || token == GL_PRIMARY_COLOR || token == GL_PREVIOUS ||
	       token == GL_ZERO || token == GL_ONE || (token >= GL_TEXTURE0 && token < GL_TEXTURE0 + SCENE_MAX_UNITS);
}

static int is_alpha_operand(uint32_t token)
{
	return token == GL_SRC_ALPHA || token == GL_ONE_MINUS_SRC_ALPHA;
}

static int is_rgb_operand(uint32_t token)
{
	return is_alpha_operand(token) || token == GL_SRC_COLOR || token == GL_ONE_MINUS_SRC_COLOR;
}

static int is_alpha_combiner(uint32_t token)
{
	switch (token) {
	case GL_REPLACE:
	case GL_MODULATE:
	case GL_ADD:
	case GL_ADD_SIGNED:
	case GL_INTERPOLATE:
	case GL_SUBTRACT:
	case GL_MODULATE_ADD_ATI:
	case GL_MODULATE_SIGNED_ADD_ATI: case GL_MODULATE_SUBTRACT_ATI:
		return 1;
	default:
		return 0;
	}
}

static int is_rgb_combiner(uint32_t token)
{
	return is_alpha_combiner(token) || token == GL_DOT3_RGB || token == GL_DOT3_RGBA || token == GL_DOT3_RGB_EXT ||
	       token == GL_DOT3_RGBA_EXT;
}

/* Set one of a combiner's tokens. */
static void set_token(struct gls_exec *x, struct gls_state *st, uint32_t *to, uint32_t token,
                      int (*allows)(uint32_t token))
{
	if (!gls_refuses(x, st, !allows(token), GL_INVALID_ENUM))
		*to = token;
}

GLS_FAMILY(glTexEnv, STATE)
{
	struct gls_unit *unit = gls_active_unit(st);
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
		if (!gls_refuses(x, st, v[0] != 0 && v[0] != 1, GL_INVALID_VALUE))
			e->coord_replace = v[0] != 0;
		return;
	}
	if (gls_refuses(x, st, target != GL_TEXTURE_ENV, GL_INVALID_ENUM))
		return;
	const struct { uint32_t first, *tokens; int (*allows)(uint32_t token); } operands[] = {
		{ GL_SOURCE0_RGB, e->source_rgb, is_source }, { GL_SOURCE0_ALPHA, e->source_alpha, is_source },
		{ GL_OPERAND0_RGB, e->operand_rgb, is_rgb_operand }, { GL_OPERAND0_ALPHA, e->operand_alpha, is_alpha_operand },
	};
	for (unsigned i = 0; i < 4; i++)
		if (pname >= operands[i].first && pname < operands[i].first + 4) {
			set_token(x, st, &operands[i].tokens[pname - operands[i].first], token, operands[i].allows);
			return;
		}
	switch (pname) {
	case GL_TEXTURE_ENV_MODE:
		if (token == GL_REPLACE_EXT)
			token = GL_REPLACE;
		if (token != GL_MODULATE && token != GL_DECAL && token != GL_BLEND && token != GL_REPLACE && token != GL_ADD &&
		    token != GL_COMBINE && token != GL_COMBINE4_NV) {
			gls_error(x, st, GL_INVALID_ENUM);
			return;
		}
		e->env_mode = token;
		break;
	case GL_TEXTURE_ENV_COLOR: arg_color(x, c, 2, e->env_color); break;
	case GL_COMBINE_RGB: set_token(x, st, &e->combine_rgb, token, is_rgb_combiner); break;
	case GL_COMBINE_ALPHA: set_token(x, st, &e->combine_alpha, token, is_alpha_combiner); break;
	case GL_RGB_SCALE:
	case GL_ALPHA_SCALE:
		if (gls_refuses(x, st, v[0] != 1 && v[0] != 2 && v[0] != 4, GL_INVALID_VALUE))
			return;
		*(pname == GL_RGB_SCALE ? &e->scale_rgb : &e->scale_alpha) = v[0];
		break;
	default:
		gls_error(x, st, GL_INVALID_ENUM);
	}
}

/* ---- coordinate generation, sec. 2.11.4 ---- */

static void set_generation(struct gls_exec *x, struct gls_state *st, const struct call *c, uint32_t coord)
{
	struct scene_unit *e = &gls_active_unit(st)->value;
	uint32_t mode;
	float v[4] = { 0 }, inverse[16];

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
		gls_sums(st)->transform_plane(e->gen_eye_plane[coord], v, inverse);
		break;
	default:
		gls_error(x, st, GL_INVALID_ENUM);
	}
}

GLS_FAMILY(glTexGen, STATE)
{
	const uint32_t coord = arg_u(c, 0) - GL_S;

	/* OES_texture_cube_map: s, t and r are set together. */
	for (uint32_t i = 0; arg_u(c, 0) == GL_TEXTURE_GEN_STR_OES && i < 3; i++)
		set_generation(x, st, c, i);
	if (arg_u(c, 0) != GL_TEXTURE_GEN_STR_OES && !gls_refuses(x, st, coord > 3, GL_INVALID_ENUM))
		set_generation(x, st, c, coord);
}
