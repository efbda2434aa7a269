#include "replay/machine/state.h"

#include <string.h>

#include "gl_tokens.h"

struct gls_matrix_stack *gls_current_stack(struct gls_state *st)
{
	switch (st->a.transform.matrix_mode) {
	case GL_PROJECTION:
		return &st->projection;
	case GL_TEXTURE:
		return &st->texture[st->a.texturing.active];
	case GL_COLOR:
		return &st->color_matrix;
	default:
		return &st->modelview;
	}
}

void gls_track_color(const struct gls_lighting *l, unsigned side, const float color[4], struct scene_face *face)
{
	if (l->color_material_face == (side ? GL_FRONT : GL_BACK))
		return;
	switch (l->color_material_mode) {
	case GL_EMISSION:
		memcpy(face->emission, color, 16);
		break;
	case GL_SPECULAR:
		memcpy(face->specular, color, 16);
		break;
	case GL_AMBIENT:
		memcpy(face->ambient, color, 16);
		break;
	case GL_DIFFUSE:
		memcpy(face->diffuse, color, 16);
		break;
	default: /* GL_AMBIENT_AND_DIFFUSE */
		memcpy(face->ambient, color, 16);
		memcpy(face->diffuse, color, 16);
	}
}
