#include "replay/glsl/text/directive.h"

#include <string.h>

#include "replay/glsl/text/condition.h"
#include "replay/glsl/text/lexer.h"
#include "replay/glsl/text/macro.h"

/* An #if without its #endif so far. */
struct parse_condition {
	struct parse_condition *outer;
	bool skips, done, in_else; /* skips: this part is skipped; done: a part was taken, or none may be */
};

/* Extensions of Mesa (22.3.6) that only add names or unsupported features, and those that the parser checks for. */
static const struct {
	const char *name;
	uint32_t bit;
} extensions[] = {
	{ "GL_ARB_texture_rectangle", PARSE_PLAIN_EXTENSION }, { "GL_ARB_draw_buffers", PARSE_PLAIN_EXTENSION },
	{ "GL_ARB_shader_texture_lod", PARSE_TEXTURE_LOD }, { "GL_EXT_gpu_shader4", PARSE_GPU_SHADER4 },
	{ "GL_ARB_explicit_attrib_location", PARSE_LOCATIONS },
	{ "GL_ARB_explicit_uniform_location", PARSE_LOCATIONS },
	{ "GL_ARB_shading_language_420pack", PARSE_PACK }, { "GL_AMD_shader_trinary_minmax", PARSE_TRINARY },
	{ "GL_ARB_arrays_of_arrays", PARSE_ARRAYS }, { "GL_ARB_gpu_shader5", PARSE_GPU_SHADER5 },
	{ "GL_ARB_draw_instanced", PARSE_INSTANCED }, { "GL_EXT_draw_instanced", PARSE_PLAIN_EXTENSION },
	{ "GL_ARB_fragment_coord_conventions", PARSE_COORD_LAYOUT },
	{ "GL_ARB_uniform_buffer_object", PARSE_BLOCKS },
	{ "GL_EXT_texture_array", PARSE_GPU_SHADER4 }, { "GL_ARB_separate_shader_objects", PARSE_LOCATIONS },
	{ "GL_ARB_conservative_depth", PARSE_COORD_LAYOUT },
	{ "GL_AMD_conservative_depth", PARSE_COORD_LAYOUT },
	{ "GL_ARB_shader_bit_encoding", PARSE_PLAIN_EXTENSION },
	{ "GL_ARB_shading_language_packing", PARSE_PLAIN_EXTENSION },
	{ "GL_ARB_texture_cube_map_array", PARSE_PLAIN_EXTENSION },
	{ "GL_ARB_texture_gather", PARSE_PLAIN_EXTENSION },
	{ "GL_ARB_texture_multisample", PARSE_PLAIN_EXTENSION },
	{ "GL_ARB_texture_query_lod", PARSE_PLAIN_EXTENSION },
	{ "GL_ARB_derivative_control", PARSE_PLAIN_EXTENSION },
	{ "GL_ARB_sample_shading", PARSE_PLAIN_EXTENSION }, { "GL_ARB_enhanced_layouts", PARSE_LOCATIONS },
	{ "GL_ARB_shader_atomic_counters", PARSE_PLAIN_EXTENSION },
	{ "GL_ARB_shader_image_load_store", PARSE_PLAIN_EXTENSION },
	{ "GL_ARB_shader_storage_buffer_object", PARSE_PLAIN_EXTENSION },
	{ "GL_ARB_shader_viewport_layer_array", PARSE_PLAIN_EXTENSION },
	{ "GL_AMD_vertex_shader_layer", PARSE_PLAIN_EXTENSION },
	{ "GL_AMD_vertex_shader_viewport_index", PARSE_PLAIN_EXTENSION },
	{ "GL_ARB_viewport_array", PARSE_PLAIN_EXTENSION }, { "GL_ARB_cull_distance", PARSE_PLAIN_EXTENSION },
	{ "GL_MESA_shader_integer_functions", PARSE_GPU_SHADER5 },
	{ "GL_KHR_blend_equation_advanced", PARSE_PLAIN_EXTENSION },
	{ "GL_EXT_shader_integer_mix", PARSE_PLAIN_EXTENSION }, { "GL_ARB_shader_stencil_export", PARSE_PLAIN_EXTENSION },
	{ "GL_EXT_shader_framebuffer_fetch", PARSE_PLAIN_EXTENSION },
};

/* The other tokens of a directive's line. */
static struct parse_tokens line_of(struct parse *p)
{
	struct parse_tokens list = { 0 };
	struct parse_place before = p->place;
	struct parse_token token;

	for (parse_lex(p, &p->place, &token); token.kind != PARSE_END && !token.first;
	     parse_lex(p, &p->place, &token)) {
		parse_tokens_add(p, &list, &token);
		before = p->place;
	}
	p->place = before;
	return list;
}

static uint32_t number_of(struct parse *p, const struct parse_token *token)
{
	const struct parse_literal number = token->kind == PARSE_NUMBER ? parse_literal(p, token) :
	                                                                  (struct parse_literal){ GLSL_FLOAT, 0 };

	if (number.kind == GLSL_FLOAT || number.value < 0)
		parse_error(p, "a directive lacks an integer");
	return (uint32_t)number.value;
}

/* --- Versions and extensions -------------------------------------------------------------------------------------- */

static void set_version(struct parse *p, const struct parse_token *tokens, uint32_t n)
{
	static const uint16_t known[] = { 100, 110, 120, 130, 140, 150, 300, 310, 320,
		                          330, 400, 410, 420, 430, 440, 450, 460 };
	const uint32_t version = n ? number_of(p, &tokens[0]) : 0;
	const bool es = n > 1 && parse_is_word(&tokens[1], "es");
	bool is_known = false;

	for (unsigned i = 0; i < sizeof(known) / sizeof(known[0]); i++)
		is_known |= known[i] == version;
	if (!is_known || (version >= 300 && version < 330) != es || n > 2 || (n == 2 && version < 150) ||
	    (n == 2 && !es && !parse_is_word(&tokens[1], "core") && !parse_is_word(&tokens[1], "compatibility")))
		parse_error(p, "'#version' has an unknown version");
	p->version = version;
	p->is_es = es || version == 100;
	p->is_core = p->is_es || (version >= 150 && !(n == 2 && parse_is_word(&tokens[1], "compatibility")));
}

static void set_extension(struct parse *p, const struct parse_token *tokens, uint32_t n)
{
	const struct parse_token *behaviour = &tokens[2];
	uint32_t bits = 0;
	bool enables;

	if (n != 3 || tokens[0].kind != PARSE_NAME || !parse_is_sign(&tokens[1], ':'))
		parse_error(p, "'#extension' is not NAME : BEHAVIOUR");
	enables = parse_is_word(behaviour, "require") || parse_is_word(behaviour, "enable") ||
	          parse_is_word(behaviour, "warn");
	if (!enables && !parse_is_word(behaviour, "disable"))
		parse_error(p, "'#extension' has an unknown behaviour");
	if (parse_is_word(&tokens[0], "all")) {
		if (enables && !parse_is_word(behaviour, "warn"))
			parse_error(p, "'#extension all' can only warn or disable");
		bits = ~0u;
	}
	for (unsigned i = 0; i < sizeof(extensions) / sizeof(extensions[0]); i++)
		if (parse_is_word(&tokens[0], extensions[i].name))
			bits = extensions[i].bit;
	if (!bits && parse_is_word(behaviour, "require"))
		parse_error(p, "the extension '%s' is unknown", tokens[0].name->text);
	p->extensions = enables ? p->extensions | bits : p->extensions & ~bits;
}

/* --- Conditions --------------------------------------------------------------------------------------------------- */

static void open_condition(struct parse *p, bool holds)
{
	struct parse_condition *c = parse_alloc(p, sizeof(*c));
	const bool outside = p->conditions && p->conditions->skips;

	*c = (struct parse_condition){ .outer = p->conditions, .skips = outside || !holds, .done = outside || holds };
	p->conditions = c;
}

static bool is_defined(struct parse *p, const struct parse_tokens *line)
{
	if (line->n < 2 || line->at[1].kind != PARSE_NAME)
		parse_error(p, "'#ifdef' lacks a name");
	return line->at[1].name->macro != NULL;
}

/* @return true: it was one of these directives */
static bool read_condition(struct parse *p, const struct parse_tokens *line)
{
	const struct parse_token *word = &line->at[0];
	struct parse_condition *c = p->conditions;
	const bool outside = c && c->skips, is_elif = parse_is_word(word, "elif"),
	           is_else = parse_is_word(word, "else");

	if (parse_is_word(word, "if")) {
		open_condition(p, !outside && parse_condition(p, line->at + 1, line->n - 1));
	} else if (parse_is_word(word, "ifdef") || parse_is_word(word, "ifndef")) {
		open_condition(p, !outside && is_defined(p, line) == parse_is_word(word, "ifdef"));
	} else if (is_elif || is_else || parse_is_word(word, "endif")) {
		if (!c || (c->in_else && (is_elif || is_else)))
			parse_error(p, "'#%s' has no '#if'", word->name->text);
		if (!is_elif && !is_else) {
			p->conditions = c->outer;
			return true;
		}
		c->in_else = is_else;
		c->skips = c->done || !(is_else || parse_condition(p, line->at + 1, line->n - 1));
		c->done |= !c->skips;
	} else {
		return false;
	}
	return true;
}

/*
 * --- Other directives ----------------------------------------------------------------------------------------------
 */

static void set_line(struct parse *p, const struct parse_tokens *line)
{
	const struct parse_tokens list = parse_macro_expand(p, line->at + 1, line->n - 1);

	if (!list.n || list.n > 2)
		parse_error(p, "'#line' lacks its number");
	if (list.n == 2)
		number_of(p, &list.at[1]);
	p->place.line = number_of(p, &list.at[0]) - 1; /* the end of this line counts as well */
}

static void undefine(struct parse *p, const struct parse_tokens *line)
{
	if (line->n != 2 || line->at[1].kind != PARSE_NAME)
		parse_error(p, "'#undef' lacks a name");
	if (strncmp(line->at[1].name->text, "__", 2) == 0 || strncmp(line->at[1].name->text, "GL_", 3) == 0)
		parse_error(p, "'%s' cannot be undefined", line->at[1].name->text);
	line->at[1].name->macro = NULL;
}

static void read_directive(struct parse *p, bool may_be_version)
{
	const struct parse_tokens line = line_of(p);
	const struct parse_token *word = line.at;

	if (!line.n || read_condition(p, &line) || (p->conditions && p->conditions->skips))
		return;
	if (parse_is_word(word, "define") && line.n > 1)
		parse_macro_define(p, line.at + 1, line.n - 1);
	else if (parse_is_word(word, "undef"))
		undefine(p, &line);
	else if (parse_is_word(word, "extension"))
		set_extension(p, line.at + 1, line.n - 1);
	else if (parse_is_word(word, "line"))
		set_line(p, &line);
	else if (parse_is_word(word, "error"))
		parse_error(p, "#error %.*s",
		            line.n > 1 ? (int)(line.at[line.n - 1].text + line.at[line.n - 1].n - line.at[1].text) : 0,
		            line.n > 1 ? line.at[1].text : "");
	else if (parse_is_word(word, "version") && !may_be_version)
		parse_error(p, "'#version' is not at the beginning");
	else if (!parse_is_word(word, "pragma") && !parse_is_word(word, "version"))
		parse_error(p, "'#%.*s' is not a directive", (int)word->n, word->text);
}

void parse_directive_read(struct parse *p, struct parse_token *token)
{
	for (;;) {
		const bool begins = p->line == 0;

		parse_lex(p, &p->place, token);
		p->line = token->line;
		if (token->kind == PARSE_END && p->conditions)
			parse_error(p, "an '#if' has no '#endif'");
		if (parse_is_sign(token, '#') && token->first)
			read_directive(p, begins);
		else if (token->kind == PARSE_END || !p->conditions || !p->conditions->skips)
			return;
	}
}

void parse_directive_begin(struct parse *p, const char *text)
{
	struct parse_token token, word;

	p->place = (struct parse_place){ parse_lines(p, text), 1, true };
	p->version = 110;
	p->extensions = 0;
	p->is_core = p->is_es = false;
	p->conditions = NULL;
	p->input = NULL;
	p->read = parse_directive_read;
	struct parse_place begin = p->place;

	parse_lex(p, &p->place, &token);
	if (parse_is_sign(&token, '#')) {
		const struct parse_tokens line = line_of(p);

		p->line = token.line;
		word = line.n ? line.at[0] : token;
		if (parse_is_word(&word, "version"))
			set_version(p, line.at + 1, line.n - 1);
	}
	p->place = begin;
	p->line = 0;
	parse_macro_set(p, "__LINE__", 0);
	parse_macro_set(p, "__FILE__", 0);
	parse_macro_set(p, "__VERSION__", p->version);
	if (p->is_es)
		parse_macro_set(p, "GL_ES", 1);
	else if (p->version >= 150)
		parse_macro_set(p, p->is_core ? "GL_core_profile" : "GL_compatibility_profile", 1);
	for (unsigned i = 0; i < sizeof(extensions) / sizeof(extensions[0]); i++)
		parse_macro_set(p, extensions[i].name, 1);
}
