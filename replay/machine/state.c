#include "replay/machine/state.h"

#include <string.h>

#include "gl_tokens.h"
#include "scene/mesa.h"

struct gls_matrix_stack *gls_current_stack(struct gls_state *st)
{
	const uint32_t own = st->a.transform.matrix_mode - GL_MATRIX0_ARB;

	if (own < GLS_MAX_PROGRAM_MATRICES)
		return &st->program_matrix[own];
	switch (st->a.transform.matrix_mode) {
	case GL_PROJECTION: return &st->projection;
	case GL_TEXTURE: return &st->texture[st->a.texturing.active];
	case GL_COLOR: return &st->color_matrix;
	default: return &st->modelview;
	}
}

int gls_is_face(uint32_t token)
{
	return token == GL_FRONT || token == GL_BACK || token == GL_FRONT_AND_BACK;
}

int gls_is_compare_func(uint32_t token)
{
	return token >= GL_NEVER && token <= GL_ALWAYS;
}

unsigned gls_face_colors(uint32_t parameter)
{
	switch (parameter) {
	case GL_AMBIENT: return GLS_AMBIENT;
	case GL_DIFFUSE: return GLS_DIFFUSE;
	case GL_AMBIENT_AND_DIFFUSE: return GLS_AMBIENT | GLS_DIFFUSE;
	case GL_SPECULAR: return GLS_SPECULAR;
	case GL_EMISSION: return GLS_EMISSION;
	default: return 0;
	}
}

unsigned gls_tracked_colors(const struct gls_lighting *l, unsigned side)
{
	return l->color_material_face == (side ? GL_FRONT : GL_BACK) ? 0 : gls_face_colors(l->color_material_mode);
}

void gls_set_face_colors(struct scene_face *face, unsigned colors, const float value[4])
{
	if (colors & GLS_AMBIENT)
		memcpy(face->ambient, value, sizeof(face->ambient));
	if (colors & GLS_DIFFUSE)
		memcpy(face->diffuse, value, sizeof(face->diffuse));
	if (colors & GLS_SPECULAR)
		memcpy(face->specular, value, sizeof(face->specular));
	if (colors & GLS_EMISSION)
		memcpy(face->emission, value, sizeof(face->emission));
}

int gls_is_beyond_clip_planes(const struct gls_attribs *a, const float eye[4])
{
	for (unsigned i = 0; i < GLS_MAX_CLIP_PLANES; i++) {
		const float *p = a->transform.clip_plane_eye[i];

		if (a->transform.clip_plane_mask >> i & 1 &&
		    p[0] * eye[0] + p[1] * eye[1] + p[2] * eye[2] + p[3] * eye[3] < 0)
			return 1;
	}
	return 0;
}

int gls_draws_by_stages(const struct gls_attribs *a)
{
	return a->polygon.mode[0] != GL_FILL || a->polygon.mode[1] != GL_FILL || a->point.smooth || a->line.smooth ||
	       (a->line.stipple && a->line.stipple_pattern != 0xffff);
}

int gls_is_mesa(const struct gls_state *st)
{
	return !(st->mesa & SCENE_MESA_IS_OTHER);
}
