#include "replay/programs/arb_state.h"

#include "replay/machine/state.h"
#include "replay/programs/arb_words.h"
#include "replay/programs/program.h"

struct part {
	const char *name;
	uint32_t number;
};

static const char not_known[] = "an ARB program uses unsupported state";

/* Parse one of the names. @return its number */
static uint32_t take_part(struct arb_words *w, const struct part *parts, uint32_t n)
{
	for (uint32_t i = 0; i < n; i++)
		if (arb_takes_name(w, parts[i].name))
			return parts[i].number;
	arb_fail(w, not_known);
	return 0;
}
#define TAKE_PART(w, parts) take_part(w, parts, sizeof(parts) / sizeof((parts)[0]))

/* Parse a range of numbers in brackets, or one number. @return their count, from *first on */
static uint32_t take_range(struct arb_words *w, uint32_t limit, uint32_t *first)
{
	uint32_t last;

	arb_expect(w, '[');
	*first = last = arb_index(w, limit);
	if (arb_takes(w, '.')) {
		arb_expect(w, '.');
		last = arb_index(w, limit);
	}
	arb_expect(w, ']');
	if (last < *first)
		arb_fail(w, arb_bad_grammar);
	return w->why ? 0 : last - *first + 1;
}

/* Parse .front or .back; the default is front. */
static uint32_t take_face(struct arb_words *w)
{
	if (arb_takes_name(w, "back")) {
		arb_expect(w, '.');
		return 1;
	}
	if (arb_takes_name(w, "front"))
		arb_expect(w, '.');
	return 0;
}

static void take_light(struct arb_words *w, struct program_constant *c)
{
	static const struct part parts[] = {
		{ "ambient", PROGRAM_LIGHT_AMBIENT }, { "diffuse", PROGRAM_LIGHT_DIFFUSE }, { "specular", PROGRAM_LIGHT_SPECULAR },
		{ "position", PROGRAM_LIGHT_POSITION }, { "attenuation", PROGRAM_LIGHT_ATTENUATION }, { "half", PROGRAM_LIGHT_HALF },
	};

	c->source = PROGRAM_LIGHT;
	c->index = arb_subscript(w, GLS_MAX_LIGHTS);
	arb_expect(w, '.');
	if (arb_takes_name(w, "spot")) {
		arb_expect(w, '.');
		if (!arb_takes_name(w, "direction"))
			arb_fail(w, not_known);
		c->part = PROGRAM_LIGHT_DIRECTION;
	} else {
		c->part = TAKE_PART(w, parts);
	}
}

static const struct part colors[] = { { "ambient", GLS_AMBIENT },
	                              { "diffuse", GLS_DIFFUSE },
	                              { "specular", GLS_SPECULAR },
	                              { "emission", GLS_EMISSION },
	                              { "shininess", PROGRAM_SHININESS } };

static void take_light_product(struct arb_words *w, struct program_constant *c)
{
	c->source = PROGRAM_LIGHT_PRODUCT;
	c->index = arb_subscript(w, GLS_MAX_LIGHTS);
	arb_expect(w, '.');
	c->face = take_face(w);
	c->part = take_part(w, colors, 3);
}

static void take_light_model(struct arb_words *w, struct program_constant *c)
{
	arb_expect(w, '.');
	if (arb_takes_name(w, "ambient")) {
		c->source = PROGRAM_LIGHT_MODEL;
		return;
	}
	c->source = PROGRAM_SCENE_COLOR;
	c->index = take_face(w);
	if (!arb_takes_name(w, "scenecolor"))
		arb_fail(w, not_known);
}

/* A matrix, or some of its rows. */
static uint32_t take_matrix(struct arb_words *w, struct program_constant *to, uint32_t room)
{
	static const struct part matrices[] = { { "modelview", PROGRAM_MODELVIEW }, { "projection", PROGRAM_PROJECTION },
		                                { "mvp", PROGRAM_MVP }, { "texture", PROGRAM_TEXTURE_MATRIX },
		                                { "program", PROGRAM_OWN_MATRIX } };
	static const struct part changes[] = { { "inverse", PROGRAM_INVERTED }, { "transpose", PROGRAM_TRANSPOSED },
		                               { "invtrans", PROGRAM_INVERTED | PROGRAM_TRANSPOSED } };
	uint32_t matrix, change = 0, first = 0, n = 4;

	arb_expect(w, '.');
	matrix = TAKE_PART(w, matrices);
	if (arb_peek(w) == '[')
		matrix += arb_subscript(w, matrix == PROGRAM_TEXTURE_MATRIX ? GLS_MAX_UNITS :
		                           matrix == PROGRAM_OWN_MATRIX     ? GLS_MAX_PROGRAM_MATRICES :
		                                                              1);
	if (arb_takes(w, '.') && !arb_takes_name(w, "row")) {
		change = TAKE_PART(w, changes);
		if (arb_takes(w, '.') && !arb_takes_name(w, "row"))
			arb_fail(w, arb_bad_grammar);
	}
	if (arb_peek(w) == '[')
		n = take_range(w, 4, &first);
	if (n > room) {
		arb_fail(w, arb_bad_grammar);
		return 0;
	}
	for (uint32_t i = 0; i < n; i++)
		to[i] = (struct program_constant){ .source = PROGRAM_MATRIX, .index = matrix, .part = change, .row = first + i };
	return w->why ? 0 : n;
}

static void take_fog(struct arb_words *w, struct program_constant *c)
{
	static const struct part parts[] = { { "color", PROGRAM_FOG_COLOR }, { "params", PROGRAM_FOG_NUMBERS } };

	arb_expect(w, '.');
	c->source = TAKE_PART(w, parts);
}

static void take_env_color(struct arb_words *w, struct program_constant *c)
{
	c->source = PROGRAM_ENV_COLOR;
	c->index = arb_peek(w) == '[' ? arb_subscript(w, GLS_MAX_UNITS) : 0;
	arb_expect(w, '.');
	if (!arb_takes_name(w, "color"))
		arb_fail(w, not_known);
}

static void take_clip_plane(struct arb_words *w, struct program_constant *c)
{
	c->source = PROGRAM_CLIP_PLANE;
	c->index = arb_subscript(w, GLS_MAX_CLIP_PLANES);
	arb_expect(w, '.');
	if (!arb_takes_name(w, "plane"))
		arb_fail(w, not_known);
}

static void take_point(struct arb_words *w, struct program_constant *c)
{
	static const struct part parts[] = { { "size", PROGRAM_POINT_NUMBERS }, { "attenuation", PROGRAM_POINT_ATTENUATION } };

	arb_expect(w, '.');
	c->source = TAKE_PART(w, parts);
}

static void take_generated(struct arb_words *w, struct program_constant *c)
{
	static const struct part planes[] = { { "eye", 0 }, { "object", 1 } };
	static const struct part rows[] = { { "s", 0 }, { "t", 1 }, { "r", 2 }, { "q", 3 } };

	c->source = PROGRAM_TEXGEN;
	c->index = arb_peek(w) == '[' ? arb_subscript(w, GLS_MAX_UNITS) : 0;
	arb_expect(w, '.');
	c->part = TAKE_PART(w, planes);
	arb_expect(w, '.');
	c->row = TAKE_PART(w, rows);
}

uint32_t arb_state(struct arb_words *w, int is_vertex, struct program_constant *to, uint32_t room)
{
	*to = (struct program_constant){ 0 };
	if (arb_takes_name(w, "matrix"))
		return take_matrix(w, to, room);
	if (arb_takes_name(w, "material")) {
		arb_expect(w, '.');
		to->source = PROGRAM_MATERIAL;
		to->index = take_face(w);
		to->part = TAKE_PART(w, colors);
	} else if (arb_takes_name(w, "light")) {
		take_light(w, to);
	} else if (arb_takes_name(w, "lightmodel")) {
		take_light_model(w, to);
	} else if (arb_takes_name(w, "lightprod")) {
		take_light_product(w, to);
	} else if (is_vertex && arb_takes_name(w, "clip")) {
		take_clip_plane(w, to);
	} else if (is_vertex && arb_takes_name(w, "point")) {
		take_point(w, to);
	} else if (is_vertex && arb_takes_name(w, "texgen")) {
		take_generated(w, to);
	} else if (!is_vertex && arb_takes_name(w, "texenv")) {
		take_env_color(w, to);
	} else if (arb_takes_name(w, "fog")) {
		take_fog(w, to);
	} else if (!is_vertex && arb_takes_name(w, "depth")) {
		to->source = PROGRAM_DEPTH_RANGE;
		arb_expect(w, '.');
		if (!arb_takes_name(w, "range"))
			arb_fail(w, not_known);
	} else {
		arb_fail(w, not_known);
	}
	return w->why ? 0 : 1;
}

uint32_t arb_parameters(struct arb_words *w, struct program_constant *to, uint32_t room)
{
	const enum program_source source = arb_takes_name(w, "env") ? PROGRAM_ENV : PROGRAM_LOCAL;
	uint32_t first = 0, n;

	if (source == PROGRAM_LOCAL && !arb_takes_name(w, "local"))
		arb_fail(w, arb_bad_grammar);
	n = take_range(w, source == PROGRAM_ENV ? GLS_MAX_PROGRAM_PARAMETERS : GLS_MAX_PROGRAM_LOCALS, &first);
	if (n > room) {
		arb_fail(w, arb_bad_grammar);
		return 0;
	}
	for (uint32_t i = 0; i < n; i++)
		to[i] = (struct program_constant){ .source = source, .index = first + i };
	return n;
}
