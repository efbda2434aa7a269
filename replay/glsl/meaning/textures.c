#include "replay/glsl/meaning/textures.h"

#include <string.h>

#include "replay/glsl/meaning/convert.h"
#include "replay/glsl/text/type_names.h"

/* A texture function, decoded from its name. */
struct sampling {
	enum glsl_operator operation; /* GLSL_OTHER: not supported */
	bool is_shadow, is_old;       /* is_old: named after a kind of texture, as before GLSL 1.30 */
	uint32_t texture;             /* for is_old; with the bits of type_names.h */
};

static bool skips(const char **name, const char *part)
{
	const size_t n = strlen(part);
	const bool is_there = strncmp(*name, part, n) == 0;

	*name += is_there ? n : 0;
	return is_there;
}

/* @return false: not a kind of texture */
static bool read_texture(const char **name, uint32_t *texture)
{
	if (skips(name, "1D"))
		*texture = GLSL_TEXTURE_1D;
	else if (skips(name, "2DRect"))
		*texture = GLSL_TEXTURE_RECTANGLE;
	else if (skips(name, "2D"))
		*texture = GLSL_TEXTURE_2D;
	else if (skips(name, "3D"))
		*texture = GLSL_TEXTURE_3D;
	else if (skips(name, "Cube"))
		*texture = GLSL_TEXTURE_CUBE;
	else
		return false;
	if (skips(name, "Array"))
		*texture |= PARSE_LAYERED;
	return true;
}

static const struct ending {
	const char *text;
	enum glsl_operator operation;
} endings[] = {
	{ "", GLSL_TEXTURE }, { "Proj", GLSL_TEXTURE_PROJ }, { "Lod", GLSL_TEXTURE_LOD },
	{ "ProjLod", GLSL_TEXTURE_PROJ_LOD },
}, other_endings[] = {
	{ "Grad", GLSL_OTHER }, { "ProjGrad", GLSL_OTHER }, { "Offset", GLSL_OTHER },
	{ "ProjOffset", GLSL_OTHER }, { "LodOffset", GLSL_OTHER }, { "ProjLodOffset", GLSL_OTHER },
	{ "GradOffset", GLSL_OTHER }, { "ProjGradOffset", GLSL_OTHER },
};

static bool read_ending(const char *text, bool with_others, enum glsl_operator *operation)
{
	for (unsigned i = 0; i < sizeof(endings) / sizeof(endings[0]); i++)
		if (strcmp(text, endings[i].text) == 0) {
			*operation = endings[i].operation;
			return true;
		}
	for (unsigned i = 0; with_others && i < sizeof(other_endings) / sizeof(other_endings[0]); i++)
		if (strcmp(text, other_endings[i].text) == 0) {
			*operation = GLSL_OTHER;
			return true;
		}
	return false;
}

static bool read_name(const struct parse *p, const char *name, struct sampling *s)
{
	const bool has_lod = p->stage == GLSL_VERTEX_STAGE || parse_has(p, 130, PARSE_TEXTURE_LOD | PARSE_GPU_SHADER4);
	const char *at = name;

	*s = (struct sampling){ .operation = GLSL_OTHER };
	s->is_shadow = skips(&at, "shadow");
	if (!s->is_shadow && strncmp(at, "texelFetch", 10) == 0)
		return parse_has(p, 130, PARSE_GPU_SHADER4);
	if (!s->is_shadow && !skips(&at, "texture"))
		return false;
	s->is_old = read_texture(&at, &s->texture);
	if (!s->is_old)
		return !s->is_shadow && p->version >= 130 &&
		       (read_ending(at, true, &s->operation) || strcmp(at, "Size") == 0 || skips(&at, "Gather") ||
		        skips(&at, "Query"));
	s->texture |= s->is_shadow ? PARSE_SHADOW : 0;
	if (s->texture & PARSE_LAYERED && !(p->extensions & PARSE_GPU_SHADER4))
		return false;
	if (parse_has(p, 999, PARSE_TEXTURE_LOD) && (strcmp(at, "GradARB") == 0 || strcmp(at, "ProjGradARB") == 0))
		return true;
	if (strncmp(at, "Size", 4) == 0)
		return p->extensions & PARSE_GPU_SHADER4;
	if (!read_ending(at, p->extensions & PARSE_GPU_SHADER4, &s->operation))
		return false;
	if (s->operation == GLSL_TEXTURE_LOD || s->operation == GLSL_TEXTURE_PROJ_LOD)
		return has_lod && (s->texture & PARSE_DIMENSION) != GLSL_TEXTURE_RECTANGLE;
	return true;
}

bool parse_is_texture_call(const struct parse *p, const char *name)
{
	struct sampling s;

	return read_name(p, name, &s);
}

/* Number of texture coordinates, including the layer and the depth to compare with. */
static uint32_t place_size(uint32_t texture)
{
	static const uint32_t sizes[] = {
		[GLSL_TEXTURE_1D] = 1,   [GLSL_TEXTURE_2D] = 2,        [GLSL_TEXTURE_3D] = 3,
		[GLSL_TEXTURE_CUBE] = 3, [GLSL_TEXTURE_RECTANGLE] = 2, [GLSL_TEXTURE_OTHER] = 1
	};
	const uint32_t n = sizes[texture & PARSE_DIMENSION] + (texture & PARSE_LAYERED ? 1 : 0);

	if (!(texture & PARSE_SHADOW))
		return n;
	return n < 2 ? 3 : n + 1; /* 1D coordinates leave the second component unused */
}

static bool is_place(uint32_t texture, bool divided, uint32_t n)
{
	const uint32_t size = place_size(texture);

	if (!divided)
		return n == size;
	if ((texture & PARSE_DIMENSION) == GLSL_TEXTURE_CUBE || texture & PARSE_LAYERED)
		return false;
	return n == 4 || (n == size + 1 && !(texture & PARSE_SHADOW));
}

static const struct parse_type *result_of(struct parse *p, const struct sampling *s, uint32_t texture)
{
	const enum glsl_kind kind = texture & PARSE_INT_TEXTURE  ? GLSL_INT :
	                            texture & PARSE_UINT_TEXTURE ? GLSL_UINT :
	                                                           GLSL_FLOAT;

	return parse_type(p, kind, texture & PARSE_SHADOW && !s->is_old ? 1 : 4, 0);
}

/* Unsupported functions: only their result types are needed, to parse what follows. */
static struct parse_node *other_call(struct parse *p, const char *name, const struct sampling *s,
                                     const struct parse_nodes *arguments)
{
	const uint32_t texture = arguments->at[0]->type->texture;
	const struct parse_type *type = result_of(p, s, texture);
	uint32_t n = place_size(texture & ~PARSE_SHADOW);

	if (strstr(name, "Size"))
		type = parse_type(p, GLSL_INT, (texture & PARSE_DIMENSION) == GLSL_TEXTURE_CUBE ? n - 1 : n, 0);
	else if (strstr(name, "Query"))
		type = parse_type(p, GLSL_FLOAT, 2, 0);
	else if (strstr(name, "Gather"))
		type = parse_type(p, type->kind, 4, 0);
	return parse_node_of(p, GLSL_OTHER, type, arguments);
}

struct parse_node *parse_texture_call(struct parse *p, const char *name, const struct parse_nodes *arguments)
{
	struct parse_nodes converted = { 0 };
	struct sampling s;
	bool divided, levelled;
	uint32_t texture, n;

	if (!read_name(p, name, &s) || !arguments->n || arguments->at[0]->type->kind != GLSL_SAMPLER)
		return NULL;
	texture = arguments->at[0]->type->texture;
	if (s.is_old && (s.texture & (PARSE_DIMENSION | PARSE_LAYERED | PARSE_SHADOW)) !=
	                        (texture & (PARSE_DIMENSION | PARSE_LAYERED | PARSE_SHADOW)))
		return NULL;
	if (s.operation == GLSL_OTHER)
		return other_call(p, name, &s, arguments);
	divided = s.operation == GLSL_TEXTURE_PROJ || s.operation == GLSL_TEXTURE_PROJ_LOD;
	levelled = s.operation == GLSL_TEXTURE_LOD || s.operation == GLSL_TEXTURE_PROJ_LOD;
	n = arguments->n > 1 && arguments->at[1]->type->kind < GLSL_BOOL && !arguments->at[1]->type->columns ?
	            arguments->at[1]->type->rows :
	            0;
	if (!is_place(texture, divided, n) || arguments->n < 2u + levelled || arguments->n > 3)
		return NULL;
	if (arguments->n == 3 && !levelled &&
	    (p->stage != GLSL_FRAGMENT_STAGE || (texture & PARSE_DIMENSION) == GLSL_TEXTURE_RECTANGLE))
		return NULL;
	for (uint32_t i = 0; i < arguments->n; i++) {
		const struct parse_type *type = i ? parse_type(p, GLSL_FLOAT, i == 1 ? n : 1, 0) :
		                                    arguments->at[0]->type;

		if (!parse_may_convert(p, arguments->at[i]->type, type))
			return NULL;
		parse_nodes_add(p, &converted, parse_convert_to(p, arguments->at[i], type));
	}
	return parse_node_of(p, s.operation, result_of(p, &s, texture), &converted);
}
