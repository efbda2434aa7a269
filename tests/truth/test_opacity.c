/* Opacity that is known before rays are traced (tracer/frame/place/opacity_words.h) against sampling the surface
 * (kernels/frame/light/transparency.h): random surfaces, hit at random places from random directions. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "gl_tokens.h"
#include "kernels/frame/light/transparency.h"
#include "kernels/rays/opacity.h"
#include "tests/case.h"
#include "tracer/frame/place/opacity_sides.h"
#include "tracer/frame/place/opacity_words.h"

#define SURFACES 3000
#define HITS 300
#define MOST_SIZE 40

static uint32_t state;

static uint32_t below(uint32_t n)
{
	state = state * 1664525u + 1013904223u;
	return (uint32_t)((uint64_t)(state >> 8) * n >> 24);
}

static float between(float lo, float hi)
{
	return lo + (hi - lo) * (float)below(1u << 24) / (float)(1u << 24);
}

#define ONE_OF(...) ((const uint32_t[]){ __VA_ARGS__ })[below(sizeof((const uint32_t[]){ __VA_ARGS__ }) / 4)]

/* A triangle with one texture, for both sides: as replay and look describe it, and as the vertex kernel leaves it. */
struct world {
	uint8_t texels[MOST_SIZE * MOST_SIZE * 4];
	struct scene_texture texture;
	const struct scene_texture *textures[1];
	struct scene_unit unit;
	struct scene_material material;
	struct scene_current current;
	struct scene_mesh mesh;
	float position[3][4], normal[3][3], color[3][4], texcoord[3][4];
	uint32_t index[3];
	struct scene scene;
	struct instance instance;

	struct geometry geometry;
	struct texture_image image;
	struct shaded_vertex vertices[3];
	float texcoords[3][4];
	struct tables tables;
};

/* Texels: islands of one alpha, as in leaves, with some noise in a few. */
static void paint(struct world *w)
{
	const uint32_t width = 1 + below(MOST_SIZE), height = 1 + below(MOST_SIZE), noise = below(3) ? 0 : below(64);
	const uint8_t back = (uint8_t)ONE_OF(0, 255, 128), front = (uint8_t)ONE_OF(0, 255, 40, 254);
	const float x = between(0, (float)width), y = between(0, (float)height), radius = between(0, 20);

	for (uint32_t i = 0; i < width * height; i++) {
		const float dx = (float)(i % width) - x, dy = (float)(i / width) - y;

		for (int c = 0; c < 4; c++)
			w->texels[4 * i + (uint32_t)c] = dx * dx + dy * dy < radius * radius ? front : back;
		if (below(64) < noise)
			w->texels[4 * i + 3] = (uint8_t)below(256);
	}
	w->texture = (struct scene_texture){ .target = GL_TEXTURE_2D,
		                             .base_format = ONE_OF(GL_RGBA, GL_RGBA, GL_ALPHA, GL_LUMINANCE_ALPHA,
		                                                   GL_INTENSITY, GL_RGB, GL_LUMINANCE),
		                             .width = width, .height = height, .depth = 1, .n_levels = 1,
		                             .texels = w->texels, .n_bytes = 4 * (size_t)width * height };
	w->image = (struct texture_image){ GL_TEXTURE_2D, w->texture.base_format, width, height, 1, 1, 0, 1, { 0 } };
}

static void choose_unit(struct world *w)
{
	struct scene_unit *u = &w->unit;

	u->wrap_s = ONE_OF(GL_REPEAT, GL_CLAMP_TO_EDGE, GL_CLAMP, GL_MIRRORED_REPEAT, GL_CLAMP_TO_BORDER);
	u->wrap_t = ONE_OF(GL_REPEAT, GL_CLAMP_TO_EDGE, GL_CLAMP, GL_MIRRORED_REPEAT);
	u->wrap_r = GL_REPEAT;
	u->min_filter = u->mag_filter = ONE_OF(GL_LINEAR, GL_NEAREST);
	u->border_color[3] = between(0, 1);
	u->max_anisotropy = 1;
	u->env_mode = below(2) ? GL_MODULATE : ONE_OF(GL_REPLACE, GL_DECAL, GL_BLEND, GL_ADD, GL_COMBINE);
	u->env_color[3] = below(2) ? 1 : between(0, 1);
	u->combine_rgb = ONE_OF(GL_REPLACE, GL_MODULATE, GL_DOT3_RGBA);
	u->combine_alpha = ONE_OF(GL_REPLACE, GL_MODULATE, GL_ADD);
	for (int i = 0; i < 3; i++) {
		u->source_rgb[i] = GL_TEXTURE;
		u->operand_rgb[i] = GL_SRC_COLOR;
		u->source_alpha[i] = ONE_OF(GL_TEXTURE, GL_PREVIOUS, GL_CONSTANT, GL_PRIMARY_COLOR);
		u->operand_alpha[i] = ONE_OF(GL_SRC_ALPHA, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	}
	u->scale_rgb = 1;
	u->scale_alpha = (float)ONE_OF(1, 1, 2);
	for (int i = 0; i < 4; i++)
		u->matrix[5 * i] = i < 2 ? between(0.2f, 3) : 1;
	u->matrix[4] = between(-0.5f, 0.5f);
	u->matrix[12] = between(-3, 3);
	u->gen_mode[0] = below(8) ? 0 : GL_OBJECT_LINEAR;
}

static void choose_material(struct world *w)
{
	struct scene_material *m = &w->material;

	*m = (struct scene_material){ .polygon_stipple = SCENE_NONE, .shade_model = ONE_OF(GL_SMOOTH, GL_SMOOTH, GL_FLAT),
		                      .front_face = ONE_OF(GL_CW, GL_CCW), .cull_face = ONE_OF(0, 0, GL_FRONT, GL_BACK),
		                      .lighting = below(2), .two_side = !below(4), .normalize = below(2), .unit_count = below(5) != 0,
		                      .color_material = below(3) ? 0 : GL_FRONT_AND_BACK,
		                      .color_material_mode = ONE_OF(GL_DIFFUSE, GL_AMBIENT, GL_AMBIENT_AND_DIFFUSE),
		                      .alpha_test = below(3) != 0,
		                      .alpha_func = below(2) ? GL_GREATER :
		                                               ONE_OF(GL_GEQUAL, GL_LESS, GL_LEQUAL, GL_NOTEQUAL, GL_EQUAL,
		                                                      GL_ALWAYS, GL_NEVER),
		                      .alpha_ref = (float)ONE_OF(0, 1, 128, 255) / 255, .depth_write = 1, .blend = below(2),
		                      .blend_equation_rgb = GL_FUNC_ADD, .blend_equation_alpha = GL_FUNC_ADD,
		                      .blend_src_rgb = ONE_OF(GL_SRC_ALPHA, GL_SRC_ALPHA, GL_ONE),
		                      .blend_dst_rgb = ONE_OF(GL_ONE_MINUS_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ZERO),
		                      .blend_src_alpha = GL_ONE, .blend_dst_alpha = GL_ZERO, .color_mask = 15 };
	if (m->alpha_func == GL_GREATER && below(2))
		m->alpha_ref = 0.5f;
	m->surface.hidden = ONE_OF(0, SCENE_ONE_SIDED, SCENE_ONE_SIDED, SCENE_ONE_SIDED | SCENE_STOPS_NO_SUN, SCENE_SOLID);
	m->front.diffuse[3] = below(3) ? 1 : between(0, 1);
	m->back.diffuse[3] = below(3) ? 1 : between(0, 1);
}

/* An object-to-eye matrix: mostly a turned and scaled one, maybe mirrored or sheared. */
static void choose_matrix(struct world *w, float m[12])
{
	const float a = between(-3, 3), b = between(-3, 3), scale = between(0.5f, 2) * (below(2) ? 1 : -1);
	const float turn[3][3] = { { cosf(a), -sinf(a), 0 },
		                   { sinf(a) * cosf(b), cosf(a) * cosf(b), -sinf(b) },
		                   { sinf(a) * sinf(b), cosf(a) * sinf(b), cosf(b) } };

	(void)w;
	for (int row = 0; row < 3; row++) {
		for (int col = 0; col < 3; col++)
			m[4 * row + col] = scale * turn[row][col];
		m[4 * row + 3] = between(-3, 3);
	}
	if (!below(4))
		m[1] += between(-2, 2);
}

/* The vertex stage: to eye space, with the normals that GL gives them, and a colour whose alpha lighting has chosen. */
static void shade(struct world *w, uint32_t i, const float m[12])
{
	struct shaded_vertex *v = &w->vertices[i];
	const struct scene_material *material = &w->material;
	const int tracks = material->color_material && material->color_material_mode != GL_AMBIENT;
	float cofactor[3][3], length = 0;

	for (int row = 0; row < 3; row++) {
		v->eye[row] = m[4 * row] * w->position[i][0] + m[4 * row + 1] * w->position[i][1] +
		              m[4 * row + 2] * w->position[i][2] + m[4 * row + 3];
		for (int col = 0; col < 3; col++) {
			const int r1 = (row + 1) % 3, r2 = (row + 2) % 3, c1 = (col + 1) % 3, c2 = (col + 2) % 3;

			cofactor[row][col] = m[4 * r1 + c1] * m[4 * r2 + c2] - m[4 * r1 + c2] * m[4 * r2 + c1];
		}
	}
	v->eye[3] = 1;
	for (int row = 0; row < 3; row++) {
		v->normal[row] = 0;
		for (int col = 0; col < 3; col++)
			v->normal[row] += cofactor[row][col] * w->normal[i][col];
	}
	/* the inverse transpose is the cofactors divided by the determinant */
	if (m[0] * cofactor[0][0] + m[1] * cofactor[0][1] + m[2] * cofactor[0][2] < 0)
		for (int row = 0; row < 3; row++)
			v->normal[row] = -v->normal[row];
	for (int row = 0; row < 3; row++)
		length += v->normal[row] * v->normal[row];
	for (int row = 0; row < 3 && material->normalize; row++)
		v->normal[row] /= sqrtf(length);
	for (int side = 0; side < 2; side++) {
		for (int c = 0; c < 3; c++)
			v->color[side][c] = w->color[i][c];
		v->color[side][3] = !material->lighting || tracks       ? w->color[i][3] :
		                    side && material->two_side ? material->back.diffuse[3] :
		                                                          material->front.diffuse[3];
	}
	for (int row = 0; row < 4; row++)
		w->texcoords[i][row] = w->unit.matrix[row] * w->texcoord[i][0] + w->unit.matrix[4 + row] * w->texcoord[i][1] +
		                       w->unit.matrix[8 + row] * w->texcoord[i][2] + w->unit.matrix[12 + row] * w->texcoord[i][3];
	if (w->unit.gen_mode[0])
		w->texcoords[i][0] = w->unit.matrix[0] * between(-2, 2);
}

static void make(struct world *w)
{
	const float wide = between(0, 4), constant_alpha = below(3) ? (float)below(2) : -1;
	const int by_vertex = below(2) != 0;
	float m[12];

	memset(w, 0, sizeof(*w));
	paint(w);
	choose_unit(w);
	choose_material(w);
	choose_matrix(w, m);
	for (uint32_t i = 0; i < 3; i++) {
		w->index[i] = i;
		for (int a = 0; a < 3; a++) {
			w->position[i][a] = between(-2, 2);
			w->normal[i][a] = between(-1, 1) + (a == 2 ? 1.5f : 0);
			w->color[i][a] = between(0, 1);
		}
		w->position[i][3] = w->texcoord[i][3] = 1;
		w->color[i][3] = constant_alpha >= 0 ? constant_alpha : between(0, 1);
		w->texcoord[i][0] = between(-wide, wide);
		w->texcoord[i][1] = between(-wide, wide);
		if (!by_vertex)
			memcpy(w->color[i], w->color[0], sizeof(w->color[0]));
	}
	memcpy(w->current.color, w->color[0], sizeof(w->current.color));
	for (uint32_t i = 0; i < 3; i++)
		shade(w, i, m);
	w->textures[0] = &w->texture;
	w->mesh = (struct scene_mesh){ .kind = SCENE_TRIANGLES, .vertex_count = 3, .primitive_count = 1,
		                       .position = w->position[0], .normal = w->normal[0],
		                       .color = by_vertex ? w->color[0] : NULL, .index = w->index };
	w->mesh.texcoord[0] = w->texcoord[0];
	w->scene = (struct scene){ .textures = w->textures, .n_textures = 1, .units = &w->unit, .n_units = 1 };
	memcpy(w->instance.eye_from_obj, m, sizeof(m));
	w->geometry.primitive_draw = w->geometry.crease = SCENE_NONE;
	w->tables = (struct tables){ .geometries = &w->geometry, .materials = &w->material, .units = &w->unit,
		                     .currents = &w->current, .vertices = w->vertices, .indices = w->index,
		                     .texcoords = w->texcoords[0], .textures = &w->image,
		                     .texels = (const uint32_t *)w->texels };
}

/* Hits from all around: what is known must be what sampling gives. @return how many hits something is known of */
static uint32_t check_hits(const struct world *w, const uint32_t *words, uint32_t surface)
{
	uint32_t known = 0;

	for (uint32_t k = 0; k < HITS; k++) {
		const float across = between(0, 1), up = between(0, 1) * (1 - across);
		const struct hit hit = { .t = 1, .b1 = across, .b2 = up };
		const uint32_t to_lights = below(2);
		struct ray ray = { .d = { between(-1, 1), between(-1, 1), between(-1, 1) },
			           .t_max = below(2) ? 1 : 1e30f };
		const float *m = w->instance.eye_from_obj;
		const struct vec3 e1 = v3_sub(v3_load(w->position[1]), v3_load(w->position[0]));
		const struct vec3 e2 = v3_sub(v3_load(w->position[2]), v3_load(w->position[0]));
		struct vec3 d, have;
		uint32_t side, does;

		/* chosen in object space, traced in eye space */
		d = v3_load(ray.d);
		for (int row = 0; row < 3; row++)
			ray.d[row] = m[4 * row] * d.x + m[4 * row + 1] * d.y + m[4 * row + 2] * d.z;
		side = rays_side(v3_dot(e1, v3_cross(d, e2)));
		does = opacity_sides(words[0], to_lights) & side ? OPACITY_PASSES :
		                                                   opacity_at(words, OPACITY_WORDS, words[0], hit.b1, hit.b2);
		have = transparency_of_hit(&w->tables, &hit, &ray, to_lights);
		known += does != OPACITY_ASK;
		ck_assert_msg(does != OPACITY_PASSES || (have.x == 1 && have.y == 1 && have.z == 1),
		              "surface %u at %g %g: light should pass, but sampling gives %g %g %g", surface, across, up, have.x,
		              have.y, have.z);
		ck_assert_msg(does != OPACITY_STOPS || v3_most(have) <= OPACITY_LEAST,
		              "surface %u at %g %g: light should stop, but sampling gives %g %g %g", surface, across, up, have.x,
		              have.y, have.z);
	}
	return known;
}

START_TEST(what_is_known_is_what_sampling_gives)
{
	struct world *w = malloc(sizeof(*w));
	uint32_t known = 0, mapped = 0, sided = 0;

	for (uint32_t i = 0; i < SURFACES; i++) {
		struct opacity_surface s;
		struct opacity_blocks blocks = { 0 };
		uint32_t *words;

		make(w);
		s = (struct opacity_surface){ &w->scene, &w->mesh, &w->material, &w->current,
			                      opacity_unit(&w->scene, &w->material), NULL };
		if (transparency_is_none(&w->material))
			continue; /* it has no words */
		if (s.unit != SCENE_NONE) {
			opacity_blocks_make(&w->texture, &blocks);
			s.blocks = &blocks;
		}
		words = malloc(opacity_words_count(&s) * sizeof(*words));
		opacity_words_fill(&s, opacity_turn_of(&w->instance), words);
		known += check_hits(w, words, i);
		mapped += (words[0] & 3) == OPACITY_MAP;
		sided += (words[0] & OPACITY_SIDES) != 0;
		opacity_blocks_free(&blocks);
		free(words);
	}
	printf("known of %u of %u hits; %u maps, %u surfaces that light passes on one side\n", known, SURFACES * HITS, mapped,
	       sided);
	ck_assert_uint_gt(known, SURFACES * HITS / 4);
	ck_assert_uint_gt(mapped, SURFACES / 50);
	ck_assert_uint_gt(sided, SURFACES / 20);
	free(w);
}
END_TEST

int main(void)
{
	const char *seed = getenv("RELUME_SEED");
	TCase *tcase = tcase_create("opacity");

	state = seed ? (uint32_t)strtoul(seed, NULL, 10) : (uint32_t)time(NULL);
	printf("seed %u\n", state);
	fflush(stdout);
	tcase_set_timeout(tcase, 120);
	tcase_add_test(tcase, what_is_known_is_what_sampling_gives);
	return run_case(tcase, "opacity");
}
