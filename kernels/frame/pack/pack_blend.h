/*
 * Per-fragment operations on sixteen pixels of a row at once, one per lane, with results that are bit-identical to
 * pixel.h and blend.h. OpenCL C only. No stencil test, logic operations, multisampling or float frame buffers.
 */
#pragma once

#include "kernels/frame/pack/pack_vector.h"
#include "kernels/gl/pixel.h"

#include "kernels/sixteen_lanes.h"
#include "kernels/gl/blend_lanes.h"
#include "kernels/gl/pixel_lanes.h"
#include "kernels/one_lanes.h"

/* When a pair of blend factors leaves nothing of the destination: 0 never, 1 always, 2 if the source's alpha is 1. */
static inline int pack_blend_covers(uint source, uint destination)
{
	switch (source) {
	case GL_DST_COLOR:
	case GL_ONE_MINUS_DST_COLOR:
	case GL_DST_ALPHA:
	case GL_ONE_MINUS_DST_ALPHA:
	case GL_SRC_ALPHA_SATURATE: return 0;
	default: return destination == GL_ZERO ? 1 : destination == GL_ONE_MINUS_SRC_ALPHA ? 2 : 0;
	}
}

/* The same for all colours below fragments of a material. */
static inline int pack_covers(__global const struct scene_material *m)
{
	int rgb, alpha;

	if ((m->color_mask & 15) != 15 || m->surface.hidden & SCENE_LEFT_OUT)
		return 0;
	if (!m->blend)
		return 1;
	rgb = pack_blend_covers(m->blend_src_rgb, m->blend_dst_rgb);
	alpha = pack_blend_covers(m->blend_src_alpha, m->blend_dst_alpha);
	return m->blend_equation_rgb != GL_FUNC_ADD || m->blend_equation_alpha != GL_FUNC_ADD || !rgb || !alpha ?
	               0 :
	               max(rgb, alpha);
}
