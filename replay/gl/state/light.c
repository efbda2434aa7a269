/* Lighting, materials, shading, fog (GL 2.1 sec. 2.14, 3.10). */
#include <string.h>

#include "gl_tokens.h"
#include "base/mat4.h"
#include "base/norm.h"
#include "replay/gl/geometry/pending.h"
#include "replay/gl/geometry/waiting.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"

/* ---- lights, sec. 2.14.2 ---- */

GLS_FAMILY(glLight, STATE)
{
	uint32_t index = arg_u(c, 0) - GL_LIGHT0, pname = arg_u(c, 1);
	const float *modelview = st->modelview.matrices[st->modelview.depth];
	struct scene_light *light;
	float v[4] = { 0, 0, 0, 0 };
	unsigned n;

	if (gls_refuses(x, st, index >= GLS_MAX_LIGHTS, GL_INVALID_ENUM))
		return;
	light = &st->a.lighting.lights[index].value;
	n = arg_floats(c, 2, v, 4);
	if (pname == GL_AMBIENT || pname == GL_DIFFUSE || pname == GL_SPECULAR)
		for (unsigned i = 0; i < n && gls_commands[x->command].suffix.type == GLS_SUFFIX_I; i++)
			v[i] = norm_int(v[i]); /* table 2.9 */
	switch (pname) {
	case GL_AMBIENT: memcpy(light->ambient, v, 16); break;
	case GL_DIFFUSE: memcpy(light->diffuse, v, 16); break;
	case GL_SPECULAR: memcpy(light->specular, v, 16); break;
	case GL_POSITION: gls_sums(st)->transform(light->position_eye, modelview, v); break;
	case GL_SPOT_DIRECTION: /* the upper left 3x3 */
		for (int r = 0; r < 3; r++)
			light->spot_direction_eye[r] = modelview[r] * v[0] + modelview[4 + r] * v[1] + modelview[8 + r] * v[2];
		break;
	case GL_SPOT_EXPONENT:
		if (!gls_refuses(x, st, !(v[0] >= 0 && v[0] <= 128), GL_INVALID_VALUE))
			light->spot_exponent = v[0];
		break;
	case GL_SPOT_CUTOFF:
		if (!gls_refuses(x, st, !(v[0] >= 0 && v[0] <= 90) && v[0] != 180, GL_INVALID_VALUE))
			light->spot_cutoff_deg = v[0];
		break;
	case GL_CONSTANT_ATTENUATION: case GL_LINEAR_ATTENUATION: case GL_QUADRATIC_ATTENUATION:
		if (!gls_refuses(x, st, !(v[0] >= 0), GL_INVALID_VALUE))
			light->attenuation[pname - GL_CONSTANT_ATTENUATION] = v[0];
		break;
	default:
		gls_error(x, st, GL_INVALID_ENUM);
	}
}

GLS_FAMILY(glLightModel, STATE)
{
	struct gls_lighting *l = &st->a.lighting;
	float v[4] = { 0 };

	arg_floats(c, 1, v, 4);
	switch (arg_u(c, 0)) {
	case GL_LIGHT_MODEL_AMBIENT: arg_color(x, c, 1, l->model_ambient); break;
	case GL_LIGHT_MODEL_LOCAL_VIEWER: l->local_viewer = v[0] != 0; break;
	case GL_LIGHT_MODEL_TWO_SIDE: l->two_side = v[0] != 0; break;
	case GL_LIGHT_MODEL_COLOR_CONTROL:
		if (!gls_refuses(x, st, v[0] != GL_SINGLE_COLOR && v[0] != GL_SEPARATE_SPECULAR_COLOR, GL_INVALID_ENUM))
			l->separate_specular = v[0] == GL_SEPARATE_SPECULAR_COLOR;
		break;
	default:
		gls_error(x, st, GL_INVALID_ENUM);
	}
}

/* ---- materials, sec. 2.14.2: colours that track the current colour cannot be set ---- */

GLS_FAMILY(glMaterial, INSIDE, MATERIAL)
{
	uint32_t face = arg_u(c, 0), pname = arg_u(c, 1);
	const unsigned colors = gls_face_colors(pname);
	float v[4] = { 0 };

	if (gls_refuses(x, st, !gls_is_face(face), GL_INVALID_ENUM))
		return;
	arg_floats(c, 2, v, 4);
	for (unsigned i = 0; i < 4 && colors && gls_commands[x->command].suffix.type == GLS_SUFFIX_I; i++)
		v[i] = norm_int(v[i]);
	if (gls_refuses(x, st, pname == GL_SHININESS && !(v[0] >= 0 && v[0] <= 128), GL_INVALID_VALUE))
		return;
	gls_before_material(x, st);
	for (unsigned side = 0; side < 2; side++) {
		struct scene_face *f = &st->a.lighting.face[side];
		if (face == (side ? GL_FRONT : GL_BACK))
			continue;
		const unsigned free = st->a.lighting.color_material ? colors & ~gls_tracked_colors(&st->a.lighting, side) : colors;

		gls_set_face_colors(f, free, v);
		gls_waiting_set(st, side, free, v);
		if (pname == GL_SHININESS) {
			f->shininess = v[0];
			gls_waiting_touch(st, 0, 0);
		}
	}
	if (!colors && pname != GL_SHININESS && pname != GL_COLOR_INDEXES) /* colour index mode only */
		gls_error(x, st, GL_INVALID_ENUM);
}

GLS_HANDLER(glColorMaterial, STATE)
{
	uint32_t face = arg_u(c, 0), mode = arg_u(c, 1);

	if (gls_refuses(x, st, !gls_is_face(face) || !gls_face_colors(mode), GL_INVALID_ENUM))
		return;
	if (st->a.lighting.color_material_face == face && st->a.lighting.color_material_mode == mode)
		return;
	st->a.lighting.color_material_face = face;
	st->a.lighting.color_material_mode = mode;
	if (st->a.lighting.color_material) {
		gls_waiting_take(st, 0);
		gls_color_changed(st);
	}
}

GLS_HANDLER(glShadeModel, STATE)
{
	uint32_t model = arg_u(c, 0);

	if (!gls_refuses(x, st, model != GL_FLAT && model != GL_SMOOTH, GL_INVALID_ENUM))
		st->a.lighting.shade_model = model;
}

/* ARB_provoking_vertex (GL 3.2 sec. 2.21): the vertex of a primitive that determines its colour under FLAT. */
GLS_HANDLER(glProvokingVertex, STATE)
{
	uint32_t mode = arg_u(c, 0);

	if (!gls_refuses(x, st, mode != GL_FIRST_VERTEX_CONVENTION && mode != GL_LAST_VERTEX_CONVENTION, GL_INVALID_ENUM))
		st->a.lighting.first_provokes = mode == GL_FIRST_VERTEX_CONVENTION;
}

/* ---- fog, sec. 3.10 ---- */

GLS_FAMILY(glFog, STATE)
{
	struct gls_fog *fog = &st->a.fog;
	float v[4] = { 0 };
	uint32_t token;

	arg_floats(c, 1, v, 4);
	token = token_of_float(v[0]);
	switch (arg_u(c, 0)) {
	case GL_FOG_MODE:
		if (!gls_refuses(x, st, token != GL_LINEAR && token != GL_EXP && token != GL_EXP2, GL_INVALID_ENUM))
			fog->mode = token;
		break;
	case GL_FOG_DENSITY:
		if (!gls_refuses(x, st, !(v[0] >= 0), GL_INVALID_VALUE))
			fog->density = v[0];
		break;
	case GL_FOG_START: fog->start = v[0]; break;
	case GL_FOG_END: fog->end = v[0]; break;
	case GL_FOG_INDEX: fog->index = v[0]; break;
	case GL_FOG_COLOR: /* clamped when it is used, but Mesa's shaders see the clamped value */
		arg_color(x, c, 1, fog->color);
		break;
	case GL_FOG_COORD_SRC:
		if (!gls_refuses(x, st, token != GL_FOG_COORD && token != GL_FRAGMENT_DEPTH, GL_INVALID_ENUM))
			fog->coord_source = token;
		break;
	case GL_FOG_DISTANCE_MODE_NV:
		if (!gls_refuses(x, st,
		                 token != GL_EYE_RADIAL_NV && token != GL_EYE_PLANE &&
		                         token != GL_EYE_PLANE_ABSOLUTE_NV,
		                 GL_INVALID_ENUM))
			fog->distance_mode = token;
		break;
	default:
		gls_error(x, st, GL_INVALID_ENUM);
	}
}
