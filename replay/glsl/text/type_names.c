#include "replay/glsl/text/type_names.h"

#include <string.h>

#include "replay/glsl/tree/tree.h"

static const struct {
	const char *text;
	uint32_t texture, version;
} samplers[] = {
	{ "1D", GLSL_TEXTURE_1D, 0 }, { "2D", GLSL_TEXTURE_2D, 0 }, { "3D", GLSL_TEXTURE_3D, 0 },
	{ "Cube", GLSL_TEXTURE_CUBE, 0 }, { "1DShadow", GLSL_TEXTURE_1D | PARSE_SHADOW, 0 },
	{ "2DShadow", GLSL_TEXTURE_2D | PARSE_SHADOW, 0 },
	{ "CubeShadow", GLSL_TEXTURE_CUBE | PARSE_SHADOW, 130 }, { "2DRect", GLSL_TEXTURE_RECTANGLE, 0 },
	{ "2DRectShadow", GLSL_TEXTURE_RECTANGLE | PARSE_SHADOW, 0 },
	{ "1DArray", GLSL_TEXTURE_1D | PARSE_LAYERED, 130 },
	{ "2DArray", GLSL_TEXTURE_2D | PARSE_LAYERED, 130 },
	{ "1DArrayShadow", GLSL_TEXTURE_1D | PARSE_LAYERED | PARSE_SHADOW, 130 },
	{ "2DArrayShadow", GLSL_TEXTURE_2D | PARSE_LAYERED | PARSE_SHADOW, 130 },
	{ "Buffer", GLSL_TEXTURE_OTHER, 140 }, { "2DMS", GLSL_TEXTURE_OTHER, 150 },
	{ "CubeArray", GLSL_TEXTURE_CUBE | PARSE_LAYERED, 400 },
	{ "2DMSArray", GLSL_TEXTURE_OTHER | PARSE_LAYERED, 150 },
};

static bool sampler_name(const char *text, struct parse_type_name *found)
{
	const uint32_t kind = text[0] == 'i' ? PARSE_INT_TEXTURE : text[0] == 'u' ? PARSE_UINT_TEXTURE : 0;

	if (strncmp(text + (kind != 0), "sampler", 7) != 0)
		return false;
	for (unsigned i = 0; i < sizeof(samplers) / sizeof(samplers[0]); i++)
		if (strcmp(text + (kind != 0) + 7, samplers[i].text) == 0 &&
		    !(kind && samplers[i].texture & PARSE_SHADOW)) {
			*found = (struct parse_type_name){ GLSL_SAMPLER, 1, 0, samplers[i].texture | kind,
				                           kind ? 130 : samplers[i].version };
			return true;
		}
	return false;
}

static bool matrix_name(const char *text, struct parse_type_name *found)
{
	const uint32_t columns = (uint32_t)(text[3] - '0'), rows = text[4] == 'x' ? (uint32_t)(text[5] - '0') : columns;

	if (columns < 2 || columns > 4 || rows < 2 || rows > 4 || text[text[4] == 'x' ? 6 : 4])
		return false;
	*found = (struct parse_type_name){ GLSL_FLOAT, rows, columns, 0, text[4] ? 120 : 0 };
	return true;
}

bool parse_type_name(const char *text, struct parse_type_name *found)
{
	static const struct {
		const char *text;
		uint32_t kind, version;
	} scalars[] = { { "void", GLSL_VOID, 0 },
		        { "float", GLSL_FLOAT, 0 },
		        { "int", GLSL_INT, 0 },
		        { "uint", GLSL_UINT, 130 },
		        { "bool", GLSL_BOOL, 0 } };
	const char *const vector = strstr(text, "vec");
	uint32_t kind;

	for (unsigned i = 0; i < sizeof(scalars) / sizeof(scalars[0]); i++)
		if (text[0] == scalars[i].text[0] && strcmp(text, scalars[i].text) == 0) {
			*found = (struct parse_type_name){ scalars[i].kind, scalars[i].kind != GLSL_VOID, 0, 0,
				                           scalars[i].version };
			return true;
		}
	if (strncmp(text, "mat", 3) == 0)
		return matrix_name(text, found);
	if (!vector || vector > text + 1)
		return sampler_name(text, found);
	if (vector[3] < '2' || vector[3] > '4' || vector[4] || (vector > text && !strchr("iub", text[0])))
		return false;
	kind = vector == text ? GLSL_FLOAT : text[0] == 'i' ? GLSL_INT : text[0] == 'u' ? GLSL_UINT : GLSL_BOOL;
	*found = (struct parse_type_name){ kind, (uint32_t)(vector[3] - '0'), 0, 0, kind == GLSL_UINT ? 130 : 0 };
	return true;
}
