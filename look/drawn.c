#include "look/drawn.h"

#include "gl_tokens.h"

int drawn_in_parallel(const struct scene_view *view)
{
	return view->projection[3] == 0 && view->projection[7] == 0 && view->projection[11] == 0;
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
