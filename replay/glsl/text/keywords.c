#include "replay/glsl/text/keywords.h"

#include <string.h>

#include "replay/glsl/text/type_names.h"

static const struct {
	const char *text;
	uint32_t keyword, version;
} keywords[] = {
	{ "attribute", PARSE_ATTRIBUTE, 0 }, { "const", PARSE_CONST, 0 }, { "uniform", PARSE_UNIFORM, 0 },
	{ "varying", PARSE_VARYING, 0 }, { "centroid", PARSE_CENTROID, 120 }, { "flat", PARSE_FLAT, 130 },
	{ "smooth", PARSE_SMOOTH, 130 }, { "noperspective", PARSE_NOPERSPECTIVE, 130 },
	{ "layout", PARSE_LAYOUT, 140 }, { "in", PARSE_IN, 0 }, { "out", PARSE_OUT, 0 },
	{ "inout", PARSE_INOUT, 0 }, { "invariant", PARSE_INVARIANT, 120 },
	{ "precision", PARSE_PRECISION, 130 }, { "precise", PARSE_PRECISE, 400 }, { "break", PARSE_BREAK, 0 },
	{ "continue", PARSE_CONTINUE, 0 }, { "do", PARSE_DO, 0 }, { "for", PARSE_FOR, 0 },
	{ "while", PARSE_WHILE, 0 }, { "switch", PARSE_SWITCH, 130 }, { "case", PARSE_CASE, 130 },
	{ "default", PARSE_DEFAULT, 130 }, { "if", PARSE_IF, 0 }, { "else", PARSE_ELSE, 0 },
	{ "discard", PARSE_DISCARD, 0 }, { "return", PARSE_RETURN, 0 }, { "struct", PARSE_STRUCT, 0 },
	{ "true", PARSE_TRUE, 0 }, { "false", PARSE_FALSE, 0 }, { "unsigned", PARSE_UNSIGNED, 0 },
	{ "lowp", PARSE_LOWP, 130 }, { "mediump", PARSE_LOWP, 130 }, { "highp", PARSE_LOWP, 130 },
	{ "subroutine", PARSE_SUBROUTINE, 400 },
};

/* Reserved in all versions. GLSL 1.30 reserves more, which programs that run do not use as names. */
static const char reserved[] =
	" asm class union enum typedef template this packed goto inline noinline volatile public static extern"
	" external interface long short half fixed input output hvec2 hvec3 hvec4 fvec2 fvec3 fvec4"
	" sampler3DRect sizeof cast namespace using ";

static int is_among(const char *words, const char *text)
{
	const size_t n = strlen(text);

	for (const char *at = words; (at = strstr(at, text)) != NULL; at++)
		if (at > words && at[-1] == ' ' && at[n] == ' ')
			return 1;
	return 0;
}

uint32_t parse_keyword_of(const char *text)
{
	struct parse_type_name found;

	for (unsigned i = 0; i < sizeof(keywords) / sizeof(keywords[0]); i++)
		if (text[0] == keywords[i].text[0] && strcmp(text, keywords[i].text) == 0)
			return keywords[i].keyword;
	if (parse_type_name(text, &found))
		return PARSE_TYPE_NAME;
	return text[0] >= 'a' && is_among(reserved, text) ? PARSE_RESERVED : PARSE_NO_KEYWORD;
}

uint32_t parse_keyword_version(uint32_t keyword)
{
	for (unsigned i = 0; i < sizeof(keywords) / sizeof(keywords[0]); i++)
		if (keywords[i].keyword == keyword)
			return keywords[i].version;
	return 0;
}
