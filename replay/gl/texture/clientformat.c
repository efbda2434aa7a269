#include "replay/gl/texture/clientformat.h"

#include "gl_tokens.h"
#include "capture/format/sizes.h"

const struct gls_client_format *gls_client_format_find(uint32_t token)
{
	static const struct gls_client_format formats[] = {
		{ GL_RED, 1, { 0 } },         { GL_GREEN, 1, { 1 } },        { GL_BLUE, 1, { 2 } },
		{ GL_ALPHA, 1, { 3 } },       { GL_RGB, 3, { 0, 1, 2 } },    { GL_BGR, 3, { 2, 1, 0 } },
		{ GL_RGBA, 4, { 0, 1, 2, 3 } }, { GL_BGRA, 4, { 2, 1, 0, 3 } }, { GL_ABGR_EXT, 4, { 3, 2, 1, 0 } },
		{ GL_LUMINANCE, 1, { 4 } },   { GL_LUMINANCE_ALPHA, 2, { 4, 3 } }, { GL_DEPTH_COMPONENT, 1, { 5 } },
		{ GL_RG, 2, { 0, 1 } },       { GL_DEPTH_STENCIL, 1, { 5 } },
	};

	for (size_t i = 0; i < sizeof(formats) / sizeof(formats[0]); i++)
		if (formats[i].token == token)
			return &formats[i];
	return NULL;
}

const struct gls_packed *gls_packed_find(uint32_t token)
{
	static const struct gls_packed types[] = {
		{ GL_UNSIGNED_BYTE_3_3_2, 1, 3, { 3, 3, 2 }, 0 },
		{ GL_UNSIGNED_BYTE_2_3_3_REV, 1, 3, { 3, 3, 2 }, 1 },
		{ GL_UNSIGNED_SHORT_5_6_5, 2, 3, { 5, 6, 5 }, 0 },
		{ GL_UNSIGNED_SHORT_5_6_5_REV, 2, 3, { 5, 6, 5 }, 1 },
		{ GL_UNSIGNED_SHORT_4_4_4_4, 2, 4, { 4, 4, 4, 4 }, 0 },
		{ GL_UNSIGNED_SHORT_4_4_4_4_REV, 2, 4, { 4, 4, 4, 4 }, 1 },
		{ GL_UNSIGNED_SHORT_5_5_5_1, 2, 4, { 5, 5, 5, 1 }, 0 },
		{ GL_UNSIGNED_SHORT_1_5_5_5_REV, 2, 4, { 5, 5, 5, 1 }, 1 },
		{ GL_UNSIGNED_INT_8_8_8_8, 4, 4, { 8, 8, 8, 8 }, 0 },
		{ GL_UNSIGNED_INT_8_8_8_8_REV, 4, 4, { 8, 8, 8, 8 }, 1 },
		{ GL_UNSIGNED_INT_10_10_10_2, 4, 4, { 10, 10, 10, 2 }, 0 },
		{ GL_UNSIGNED_INT_2_10_10_10_REV, 4, 4, { 10, 10, 10, 2 }, 1 },
	};

	for (size_t i = 0; i < sizeof(types) / sizeof(types[0]); i++)
		if (types[i].token == token)
			return &types[i];
	return NULL;
}

size_t gls_component_bytes(uint32_t type)
{
	int is_depth = type == GL_UNSIGNED_INT_24_8 || type == GL_FLOAT_32_UNSIGNED_INT_24_8_REV;

	return type <= GL_FLOAT || type == GL_HALF_FLOAT || is_depth ? (size_t)type_bytes(type) : 0;
}
