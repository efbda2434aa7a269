#include "capture/format/sizes.h"

#include <GL/gl.h>
#include <GL/glext.h>

enum { TEXTURE_CROP_RECT_OES = 0x8B9D }; /* OES_draw_texture, which desktop headers lack */

long count_of_pname(unsigned pname)
{
	switch (pname) {
	case GL_MODELVIEW_MATRIX: case GL_PROJECTION_MATRIX: case GL_TEXTURE_MATRIX: case GL_COLOR_MATRIX:
	case GL_TRANSPOSE_MODELVIEW_MATRIX: case GL_TRANSPOSE_PROJECTION_MATRIX: case GL_TRANSPOSE_TEXTURE_MATRIX:
	case GL_TRANSPOSE_COLOR_MATRIX:
		return 16;
	/* Lights, materials, fog, texture environment and generation */
	case GL_AMBIENT: case GL_DIFFUSE: case GL_SPECULAR: case GL_POSITION: case GL_EMISSION: case GL_AMBIENT_AND_DIFFUSE:
	case GL_LIGHT_MODEL_AMBIENT: case GL_FOG_COLOR: case GL_TEXTURE_ENV_COLOR: case GL_TEXTURE_BORDER_COLOR:
	case GL_TEXTURE_SWIZZLE_RGBA: case GL_TEXTURE_COMPARE_FAIL_VALUE_ARB: case GL_OBJECT_PLANE: case GL_EYE_PLANE:
	case GL_CONSTANT_COLOR0_NV: case GL_CONSTANT_COLOR1_NV: case GL_CULL_VERTEX_EYE_POSITION_EXT:
	case GL_CULL_VERTEX_OBJECT_POSITION_EXT:
	/* Imaging */
	case GL_CONVOLUTION_BORDER_COLOR: case GL_CONVOLUTION_FILTER_SCALE: case GL_CONVOLUTION_FILTER_BIAS:
	case GL_COLOR_TABLE_SCALE: case GL_COLOR_TABLE_BIAS:
	/* Queries */
	case TEXTURE_CROP_RECT_OES:
	case GL_VIEWPORT:
	case GL_SCISSOR_BOX:
	case GL_COLOR_CLEAR_VALUE:
	case GL_ACCUM_CLEAR_VALUE:
	case GL_BLEND_COLOR:
	case GL_COLOR_WRITEMASK: case GL_CURRENT_COLOR: case GL_CURRENT_SECONDARY_COLOR: case GL_CURRENT_TEXTURE_COORDS:
	case GL_CURRENT_RASTER_COLOR: case GL_CURRENT_RASTER_POSITION: case GL_CURRENT_RASTER_TEXTURE_COORDS:
	case GL_CURRENT_RASTER_SECONDARY_COLOR: case GL_CURRENT_VERTEX_ATTRIB: case GL_MAP2_GRID_DOMAIN:
		return 4;
	case GL_SPOT_DIRECTION: case GL_COLOR_INDEXES: case GL_POINT_DISTANCE_ATTENUATION: case GL_CURRENT_NORMAL:
		return 3;
	case GL_DEPTH_RANGE: case GL_POINT_SIZE_RANGE: case GL_LINE_WIDTH_RANGE: case GL_ALIASED_POINT_SIZE_RANGE:
	case GL_ALIASED_LINE_WIDTH_RANGE: case GL_POLYGON_MODE: case GL_MAX_VIEWPORT_DIMS: case GL_MAP1_GRID_DOMAIN:
	case GL_MAP2_GRID_SEGMENTS: case GL_DEPTH_BOUNDS_EXT:
		return 2;
	default:
		return 1;
	}
}

/* Components of a pixel format; 0: no such format. */
static long components(unsigned format)
{
	switch (format) {
	case GL_COLOR_INDEX: case GL_STENCIL_INDEX: case GL_DEPTH_COMPONENT: case GL_RED: case GL_GREEN: case GL_BLUE:
	case GL_ALPHA: case GL_LUMINANCE: case GL_INTENSITY: case GL_RED_INTEGER: case GL_GREEN_INTEGER:
	case GL_BLUE_INTEGER: case GL_ALPHA_INTEGER_EXT: case GL_LUMINANCE_INTEGER_EXT:
		return 1;
	case GL_LUMINANCE_ALPHA: case GL_RG: case GL_RG_INTEGER: case GL_LUMINANCE_ALPHA_INTEGER_EXT: case GL_DEPTH_STENCIL:
	case GL_DUDV_ATI: case GL_YCBCR_MESA: case GL_422_EXT: case GL_422_REV_EXT:
		return 2;
	case GL_RGB: case GL_BGR: case GL_RGB_INTEGER: case GL_BGR_INTEGER:
		return 3;
	case GL_RGBA: case GL_BGRA: case GL_ABGR_EXT: case GL_CMYK_EXT: case GL_RGBA_INTEGER: case GL_BGRA_INTEGER:
		return 4;
	case GL_CMYKA_EXT:
		return 5;
	default:
		return 0;
	}
}

/* Bytes of a whole pixel of a packed type; 0 where the type is per component. */
static long packed_bytes(unsigned type)
{
	switch (type) {
	case GL_UNSIGNED_BYTE_3_3_2:
	case GL_UNSIGNED_BYTE_2_3_3_REV:
		return 1;
	case GL_UNSIGNED_SHORT_5_6_5: case GL_UNSIGNED_SHORT_5_6_5_REV: case GL_UNSIGNED_SHORT_4_4_4_4:
	case GL_UNSIGNED_SHORT_4_4_4_4_REV: case GL_UNSIGNED_SHORT_5_5_5_1: case GL_UNSIGNED_SHORT_1_5_5_5_REV:
	case GL_UNSIGNED_SHORT_8_8_MESA: case GL_UNSIGNED_SHORT_8_8_REV_MESA:
		return 2;
	case GL_UNSIGNED_INT_8_8_8_8: case GL_UNSIGNED_INT_8_8_8_8_REV: case GL_UNSIGNED_INT_10_10_10_2:
	case GL_UNSIGNED_INT_2_10_10_10_REV: case GL_INT_2_10_10_10_REV: case GL_UNSIGNED_INT_24_8:
	case GL_UNSIGNED_INT_10F_11F_11F_REV: case GL_UNSIGNED_INT_5_9_9_9_REV:
		return 4;
	case GL_FLOAT_32_UNSIGNED_INT_24_8_REV:
		return 8;
	default:
		return 0;
	}
}

long type_bytes(unsigned type)
{
	switch (type) {
	case GL_BYTE: case GL_UNSIGNED_BYTE: return 1;
	case GL_SHORT: case GL_UNSIGNED_SHORT: case GL_HALF_FLOAT: case GL_2_BYTES: return 2;
	case GL_3_BYTES: return 3;
	case GL_INT: case GL_UNSIGNED_INT: case GL_FLOAT: case GL_FIXED: case GL_4_BYTES: return 4;
	case GL_DOUBLE: return 8;
	default: return packed_bytes(type);
	}
}

long image_pixel_bytes(unsigned format, unsigned type)
{
	long packed = packed_bytes(type);

	return packed ? packed : components(format) * type_bytes(type);
}

long image_bytes(const struct pixel_layout *layout, const struct pixel_box *box)
{
	long long bits = box->type == GL_BITMAP ? components(box->format) : 8 * image_pixel_bytes(box->format, box->type);
	long long pixels = layout->row_length > 0 ? layout->row_length : box->width;
	long long rows = box->dims > 2 && layout->image_height > 0 ? layout->image_height : box->height;
	long long row_bytes, lines, last_bytes, bytes;
	long out;

	if (box->width <= 0 || box->height <= 0 || box->depth <= 0 || bits <= 0 || layout->alignment < 1 ||
	    layout->skip_pixels < 0 || layout->skip_rows < 0 || layout->skip_images < 0)
		return 0;
	row_bytes = (pixels * bits + 7) / 8;
	row_bytes = (row_bytes + layout->alignment - 1) / layout->alignment * layout->alignment;
	/* Below 2^63, as two products of ints are. Their bytes need not be. */
	lines = (box->dims > 1 ? layout->skip_rows : 0) + (box->dims > 2 ? layout->skip_images * rows : 0) +
	        (box->depth - 1) * rows + box->height - 1;
	last_bytes = ((layout->skip_pixels + (long long)box->width) * bits + 7) / 8;
	return __builtin_mul_overflow(lines, row_bytes, &bytes) || __builtin_add_overflow(bytes, last_bytes, &out) ? 0 : out;
}

long call_lists_bytes(int n, unsigned type)
{
	long out;

	return n > 0 && !__builtin_mul_overflow(n, type_bytes(type), &out) ? out : 0;
}

long clear_buffer_count(unsigned buffer)
{
	return buffer == GL_COLOR ? 4 : 1;
}

/* Values of one control point. */
static long map_components(unsigned target)
{
	/* COLOR_4, INDEX, NORMAL, TEXTURE_COORD_1 .. 4, VERTEX_3, VERTEX_4 */
	static const long sizes[] = { 4, 1, 3, 1, 2, 3, 4, 3, 4 };

	if (target >= GL_MAP1_COLOR_4 && target <= GL_MAP1_VERTEX_4)
		return sizes[target - GL_MAP1_COLOR_4];
	if (target >= GL_MAP2_COLOR_4 && target <= GL_MAP2_VERTEX_4)
		return sizes[target - GL_MAP2_COLOR_4];
	/* maps of generic attributes (GL_NV_vertex_program) */
	return (target >= GL_MAP1_VERTEX_ATTRIB0_4_NV && target <= GL_MAP1_VERTEX_ATTRIB15_4_NV) ||
	       (target >= GL_MAP2_VERTEX_ATTRIB0_4_NV && target <= GL_MAP2_VERTEX_ATTRIB15_4_NV) ? 4 : 0;
}

long map1_count(unsigned target, int stride, int order)
{
	long n = map_components(target), out;

	return n && order > 0 && stride >= n && !__builtin_add_overflow((order - 1LL) * stride, n, &out) ? out : 0;
}

long map2_count(unsigned target, int ustride, int uorder, int vstride, int vorder)
{
	long n = map_components(target), out;

	return n && uorder > 0 && vorder > 0 && ustride >= n && vstride >= n &&
	       !__builtin_add_overflow((uorder - 1LL) * ustride + (vorder - 1LL) * vstride, n, &out) ? out : 0;
}
