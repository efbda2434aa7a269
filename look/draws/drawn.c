#include "look/draws/drawn.h"

#include "gl_tokens.h"

int drawn_in_parallel(const struct scene_view *view)
{
	return view->projection[3] == 0 && view->projection[7] == 0 && view->projection[11] == 0;
}

int drawn_mirrored(const struct scene_view *view)
{
	const float *m = view->projection;
	const double xy = (double)m[0] * m[5] - (double)m[1] * m[4];

	if (drawn_in_parallel(view))
		return xy < 0;
	/* the determinant of x, y and w as functions of x, y and z; w grows along -z */
	return m[3] * ((double)m[4] * m[9] - (double)m[5] * m[8]) - m[7] * ((double)m[0] * m[9] - (double)m[1] * m[8]) +
	       m[11] * xy > 0;
}

int drawn_multiplies(const struct scene_material *m)
{
	return m->blend && ((m->blend_src_rgb == GL_DST_COLOR && m->blend_dst_rgb == GL_ZERO) ||
	                    (m->blend_src_rgb == GL_ZERO && m->blend_dst_rgb == GL_SRC_COLOR));
}

int drawn_with_environment(const struct scene *s, const struct scene_material *m)
{
	for (uint32_t i = 0; i < m->unit_count; i++)
		for (int c = 0; c < 3; c++) {
			uint32_t mode = s->units[m->unit_first + i].gen_mode[c];

			if (mode == GL_SPHERE_MAP || mode == GL_REFLECTION_MAP)
				return 1;
		}
	return 0;
}
