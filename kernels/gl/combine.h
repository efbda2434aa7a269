/* Texture environments and combiners (GL 2.1 sec. 3.8.13): a unit changes the colour that reaches it. */
#pragma once

#include "gl_tokens.h"
#include "kernels/common.h"

/* Whether a texture of this base format changes colour and alpha (table 3.20; the others pass through). */
static inline int combine_has_color(uint32_t base_format)
{
	return base_format != GL_ALPHA;
}

static inline int combine_has_alpha(uint32_t base_format)
{
	return base_format == GL_ALPHA || base_format == GL_LUMINANCE_ALPHA || base_format == GL_INTENSITY ||
	       base_format == GL_RGBA;
}

/* Functions whose result must be clamped. Mesa clamps those that can leave [0,1] even if their arguments do not. */
static inline int combine_leaves_range(uint32_t function)
{
	return function != GL_REPLACE && function != GL_MODULATE && function != GL_INTERPOLATE;
}

#include "kernels/gl/combine_lanes.h"
