/*
 * The formulas of kernels/gl/ at values that the specification gives in closed form (GL 2.1). Kernel and twin share
 * their text, so comparing them cannot show whether it is right; comparisons with a real OpenGL (real/test_panels)
 * check whole draws.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/frame/stages/compose.h"
#include "kernels/gl/stages.h"
#include "tests/case.h"

#define ALMOST 1e-5f

static void check_vec4(struct vec4 have, const float wanted[4], const char *what, size_t row)
{
	const float got[4] = { have.x, have.y, have.z, have.w };

	for (int c = 0; c < 4; c++)
		ck_assert_msg(fabsf(got[c] - wanted[c]) < ALMOST, "%s, row %zu: number %d is %g, not %g", what, row, c,
		              got[c], wanted[c]);
}

/* --- Lighting (sec. 2.14.1) -------------------------------------------------------------------------------------- */

static struct scene_light plain_light(void)
{
	return (struct scene_light){ .ambient = { 0.25f, 0.125f, 0.5f, 1 },
		                     .diffuse = { 0.5f, 0.75f, 1, 1 },
		                     .specular = { 1, 0.5f, 0.25f, 1 },
		                     .position_eye = { 0, 0, 1, 0 },
		                     .spot_direction_eye = { 0, 0, -1 },
		                     .spot_cutoff_deg = 180,
		                     .attenuation = { 1, 0, 0 } };
}

/* Attenuation by distance, spots by angle. */
START_TEST(test_strength)
{
	static const struct { float position[4], at[3], attenuation[3], direction[3], cutoff, exponent, wanted; } rows[] = {
		{ { 0, 0, 3, 1 }, { 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, -1 }, 180, 0, 1 },
		{ { 0, 0, 3, 1 }, { 0, 0, 0 }, { 0.5f, 0, 0 }, { 0, 0, -1 }, 180, 0, 2 },
		{ { 0, 0, 3, 1 }, { 0, 0, 0 }, { 0, 0.5f, 0 }, { 0, 0, -1 }, 180, 0, 1 / 1.5f },
		{ { 0, 0, 3, 1 }, { 0, 0, 0 }, { 0, 0, 0.5f }, { 0, 0, -1 }, 180, 0, 1 / 4.5f },
		{ { 0, 0, 6, 2 }, { 0, 4, 3 }, { 1, 2, 3 }, { 0, 0, -1 }, 180, 0, 1.0f / (1 + 8 + 48) },
		{ { 0, 0, 3, 0 }, { 0, 0, 0 }, { 0, 0.5f, 1 }, { 0, 0, -1 }, 180, 0, 1 }, /* a direction */
		{ { 0, 0, 2, 1 }, { 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, -5 }, 30, 0, 1 },
		{ { 0, 0, 2, 1 }, { 2, 0, 0 }, { 1, 0, 0 }, { 0, 0, -5 }, 50, 0, 1 },
		{ { 0, 0, 2, 1 }, { 2, 0, 0 }, { 1, 0, 0 }, { 0, 0, -5 }, 40, 0, 0 },
		{ { 0, 0, 2, 1 }, { 2, 0, 0 }, { 1, 0, 0 }, { 0, 0, -5 }, 90, 3, 0.35355339f },
		{ { 0, 0, 2, 1 }, { 0, 0, 4 }, { 1, 0, 0 }, { 0, 0, -5 }, 90, 0, 0 },
	};

	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
		struct scene_light light = plain_light();
		struct vec3 to;
		float have;

		memcpy(light.position_eye, rows[i].position, 16);
		memcpy(light.attenuation, rows[i].attenuation, 12);
		memcpy(light.spot_direction_eye, rows[i].direction, 12);
		light.spot_cutoff_deg = rows[i].cutoff;
		light.spot_exponent = rows[i].exponent;
		have = light_strength(&light, v3(rows[i].at[0], rows[i].at[1], rows[i].at[2]), &to);
		ck_assert_msg(fabsf(have - rows[i].wanted) < ALMOST, "row %zu: %g, not %g", i, have, rows[i].wanted);
		ck_assert_float_eq_tol(v3_dot(to, to), 1, ALMOST);
	}
}
END_TEST

static const struct scene_face face = { { 0.5f, 0.25f, 1, 0.5f },
	                                { 0.25f, 0.5f, 0.125f, 0.75f },
	                                { 0.5f, 1, 0.5f, 0.25f },
	                                { 0.0625f, 0.03125f, 0, 1 },
	                                2 };

/* One light from the side, seen from the front: n.l = 0.6, n.h = 0.89443 or less. */
static struct lit lit_by(struct scene_material *m, struct scene_light *light, uint32_t back)
{
	m->light_count = 1;
	return light_vertex(m, light, light_list(0, 1), 0, v4(0, 0, -5, 1), v3(0, 0, 1), &face,
	                    v4(0.375f, 0.875f, 0.625f, 0.0625f), (int)back, (const struct vec3 *)0);
}

static struct scene_material grey_material(void)
{
	return (struct scene_material){ .light_model_ambient = { 0.25f, 0.5f, 0.125f, 1 },
		                        .color_material_mode = GL_AMBIENT_AND_DIFFUSE };
}

/* Emission, ambient, diffuse and specular terms; those that use the vertex colour; separate specular colour. */
START_TEST(test_light_terms)
{
	static const struct { uint32_t face, mode, tracked; } rows[] = {
		{ 0, GL_DIFFUSE, 0 }, { GL_FRONT, GL_AMBIENT, 1 }, { GL_FRONT, GL_DIFFUSE, 2 },
		{ GL_FRONT_AND_BACK, GL_SPECULAR, 4 }, { GL_FRONT, GL_EMISSION, 8 }, { GL_FRONT, GL_AMBIENT_AND_DIFFUSE, 3 },
		{ GL_BACK, GL_AMBIENT_AND_DIFFUSE, 0 },
	};
	static const float vertex[4] = { 0.375f, 0.875f, 0.625f, 0.0625f };

	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
		for (unsigned kind = 0; kind < 8; kind++) {
			const int apart = kind & 1, back = kind >> 1 & 1, local = kind >> 2;
			struct scene_material m = grey_material();
			struct scene_light light = plain_light();
			const unsigned tracked = rows[i].face == GL_FRONT_AND_BACK || rows[i].face == (back ? GL_BACK : GL_FRONT) ?
			                                 rows[i].mode == GL_AMBIENT_AND_DIFFUSE ? 3 : rows[i].tracked : 0;
			const float *ambient = tracked & 1 ? vertex : face.ambient, *diffuse = tracked & 2 ? vertex : face.diffuse;
			const float *specular = tracked & 4 ? vertex : face.specular, *emission = tracked & 8 ? vertex : face.emission;
			float color[4], gloss[4] = { 0 };
			struct lit lit;

			m.color_material = rows[i].face;
			m.color_material_mode = rows[i].mode;
			m.separate_specular = (uint32_t)apart;
			m.local_viewer = (uint32_t)local;
			memcpy(light.position_eye, (float[4]){ 0.8f, 0, 0.6f, 0 }, 16);
			lit = lit_by(&m, &light, (uint32_t)back);
			/* the half vector is (0.8, 0, 1.6) for any viewer, because the vertex is on the axis */
			for (int c = 0; c < 3; c++) {
				const float shine = powf(1.6f / sqrtf(3.2f), face.shininess);

				color[c] = emission[c] + ambient[c] * m.light_model_ambient[c] +
				           ambient[c] * light.ambient[c] + 0.6f * diffuse[c] * light.diffuse[c];
				gloss[c] = shine * specular[c] * light.specular[c];
				if (!apart) {
					color[c] += gloss[c];
					gloss[c] = 0;
				}
				color[c] = fminf(color[c], 1);
			}
			color[3] = diffuse[3];
			check_vec4(lit.color, color, "colour", 8 * i + kind);
			check_vec4(lit.secondary, gloss, "secondary colour", 8 * i + kind);
			ck_assert_uint_eq(lit.lights, 1);
		}
}
END_TEST

/* From behind there is only ambient light; unclamped colours; a viewer that is not on the axis. */
START_TEST(test_light_sides)
{
	struct scene_material m = grey_material();
	struct scene_light light = plain_light();
	struct lit lit;

	memcpy(light.position_eye, (float[4]){ 0, 0.8f, -0.6f, 0 }, 16);
	lit = lit_by(&m, &light, 0);
	check_vec4(lit.color,
	           (float[4]){ 0.0625f + 0.125f + 0.125f, 0.03125f + 0.125f + 0.03125f, 0.125f + 0.5f, 0.75f },
	           "from behind", 0);
	ck_assert_uint_eq(lit.lights, 0);
	light = plain_light();
	light.diffuse[0] = 20;
	lit = lit_by(&m, &light, 0);
	ck_assert_float_eq(lit.color.x, 1);
	m.unclamped = 2;
	lit = lit_by(&m, &light, 0);
	ck_assert_float_eq_tol(lit.color.x, 0.0625f + 0.125f + 0.125f + 5 + 0.5f, ALMOST);
	m.local_viewer = 1; /* from (4, 0, 3) over 5: half vector (-0.8, 0, 1.6) */
	lit = light_vertex(&m, &light, light_list(0, 1), 0, v4(4, 0, -3, 1), v3(0, 0, 1), &face, v4(0, 0, 0, 0), 0,
	                   (const struct vec3 *)0);
	ck_assert_float_eq_tol(lit.color.x, 0.0625f + 0.125f + 0.125f + 5 + 0.5f * 0.8f, ALMOST);
}
END_TEST

/* --- Generated coordinates, point sizes (sec. 2.11.4, 3.3) ------------------------------------------------------ */

START_TEST(test_generated)
{
	static const struct { uint32_t mode; float wanted[4]; } rows[] = {
		{ 0, { 0.125f, 0.25f, 0.375f, 0.5f } }, { GL_OBJECT_LINEAR, { 12, 13, 14, 15 } },
		{ GL_EYE_LINEAR, { 16, 18, 20, 22 } },
		/* u = (0, 0.6, -0.8), n = (0, 0, 1): r = (0, 0.6, 0.8), m = 2 sqrt(0.36 + 3.24) */
		{ GL_SPHERE_MAP, { 0.5f, 0.5f + 0.6f / 3.7947332f, 0, 0 } }, { GL_REFLECTION_MAP, { 0, 0.6f, 0.8f, 0 } },
		{ GL_NORMAL_MAP, { 0, 0, 1, 0 } },
	};

	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
		for (uint32_t c = 0; c < (rows[i].mode == GL_SPHERE_MAP                                      ? 2u :
		                          rows[i].mode == GL_REFLECTION_MAP || rows[i].mode == GL_NORMAL_MAP ? 3u :
		                                                                                               4u);
		     c++) {
			struct scene_unit unit = { .unit = 0 };
			float have;

			for (uint32_t k = 0; k < 4; k++) {
				unit.gen_mode[k] = rows[i].mode;
				memcpy(unit.gen_object_plane[k], (float[4]){ 1, 1, 2, (float)k }, 16);
				memcpy(unit.gen_eye_plane[k], (float[4]){ 1, 1, 1, (float)k }, 16);
			}
			have = vertex_generate(&unit, c, 0.125f * (float)(c + 1), v4(1, 1, 5, 1), v4(4, 5, 7, 2),
			                       v3(0, 0.6f, -0.8f), v3(0, 0, 1));
			ck_assert_msg(fabsf(have - rows[i].wanted[c]) < ALMOST, "mode %#x, coordinate %u: %g, not %g",
			              rows[i].mode, c, have, rows[i].wanted[c]);
		}
}
END_TEST

START_TEST(test_point_sizes)
{
	static const struct { float fade[3], least, most, wanted; } rows[] = {
		{ { 1, 0, 0 }, 0, 100, 8 }, { { 4, 0, 0 }, 0, 100, 4 }, { { 0, 0.8f, 0 }, 0, 100, 4 },
		{ { 0, 0, 0.16f }, 0, 100, 4 }, { { 1, 0.2f, 0.08f }, 0, 100, 4 }, { { 1, 0, 0 }, 9, 100, 9 },
		{ { 1, 0, 0 }, 0, 5, 5 }, { { 0.25f, 0, 0 }, 0, 12, 12 }, { { 0, 0, 0 }, 0, 100, 8 },
	};

	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) { /* at depth 5, which Mesa uses as the distance */
		struct scene_material m = { .point_size = 8, .point_size_min = rows[i].least, .point_size_max = rows[i].most };
		float have;

		memcpy(m.point_attenuation, rows[i].fade, 12);
		have = vertex_point_size(&m, v4(0, 3, -5, 1));
		ck_assert_msg(fabsf(have - rows[i].wanted) < ALMOST, "row %zu: %g, not %g", i, have, rows[i].wanted);
	}
	ck_assert_float_eq(vertex_fog_distance(GL_EYE_RADIAL_NV, v4(2, 3, -6, 1)), 7);
	ck_assert_float_eq(vertex_fog_distance(GL_EYE_PLANE, v4(2, 3, -6, 1)), -6);
	ck_assert_float_eq(vertex_fog_distance(GL_EYE_PLANE_ABSOLUTE_NV, v4(2, 3, -6, 1)), 6);
}
END_TEST

/* Position of clip coordinates in the window, y down. */
START_TEST(test_window)
{
	const struct view view = { .viewport = { 10, 20, 60, 40 } };
	float at[2];

	clip_place(&view, v4(0, 0, 0, 1), 100, at);
	ck_assert(fabsf(at[0] - 40) < ALMOST && fabsf(at[1] - 60) < ALMOST);
	clip_place(&view, v4(-2, 2, 0, 2), 100, at);
	ck_assert(fabsf(at[0] - 10) < ALMOST && fabsf(at[1] - 40) < ALMOST);
	clip_place(&view, v4(1, -0.5f, 0, 2), 100, at);
	ck_assert(fabsf(at[0] - 55) < ALMOST && fabsf(at[1] - 65) < ALMOST);
}
END_TEST

/* --- Texture environments (tables 3.22 to 3.25) ------------------------------------------------------------------ */

START_TEST(test_environments)
{
	static const uint32_t formats[] = { GL_ALPHA, GL_LUMINANCE, GL_LUMINANCE_ALPHA, GL_INTENSITY, GL_RGB, GL_RGBA,
		                            GL_RED,   GL_RG };
	static const uint32_t modes[] = { GL_REPLACE, GL_MODULATE, GL_DECAL, GL_BLEND, GL_ADD };
	static const float p[4] = { 0.2f, 0.4f, 0.6f, 0.8f }, s[4] = { 0.5f, 0.25f, 0.75f, 0.3f },
			   e[4] = { 0.1f, 0.9f, 0.3f, 0.7f };

	for (size_t i = 0; i < 8 * 5; i++) {
		const uint32_t format = formats[i % 8], mode = modes[i / 8];
		const int colors = format != GL_ALPHA, alphas = format == GL_ALPHA || format == GL_LUMINANCE_ALPHA ||
		                                                format == GL_INTENSITY || format == GL_RGBA;
		float wanted[4];

		if (mode == GL_DECAL && (format == GL_ALPHA || format == GL_LUMINANCE || format == GL_LUMINANCE_ALPHA ||
		                         format == GL_INTENSITY))
			continue; /* undefined */
		for (int c = 0; c < 4; c++) {
			const int there = c < 3 ? colors : alphas;

			wanted[c] = p[c];
			if (mode == GL_DECAL)
				wanted[c] = c == 3 ? p[3] : format == GL_RGBA ? p[c] * 0.7f + s[c] * 0.3f : s[c];
			else if (there && mode == GL_REPLACE)
				wanted[c] = s[c];
			else if (there && mode == GL_BLEND && (c < 3 || format == GL_INTENSITY))
				wanted[c] = p[c] * (1 - s[c]) + e[c] * s[c];
			else if (there && mode == GL_ADD && (c < 3 || format == GL_INTENSITY))
				wanted[c] = fminf(p[c] + s[c], 1);
			else if (there)
				wanted[c] = p[c] * s[c];
		}
		check_vec4(combine_plain(mode, format, v4_load(p), v4_load(s), v4_load(e)), wanted, "environment", i);
	}
}
END_TEST

START_TEST(test_combiners)
{
	static const struct { uint32_t function; float wanted[4]; } rows[] = {
		{ GL_REPLACE, { 0.2f, 0.4f, 0.6f, 0.8f } }, { GL_MODULATE, { 0.1f, 0.1f, 0.45f, 0.24f } },
		{ GL_ADD, { 0.7f, 0.65f, 1.35f, 1.1f } }, { GL_ADD_SIGNED, { 0.2f, 0.15f, 0.85f, 0.6f } },
		{ GL_INTERPOLATE, { 0.47f, 0.385f, 0.705f, 0.65f } }, { GL_SUBTRACT, { -0.3f, 0.15f, -0.15f, 0.5f } },
		{ GL_DOT3_RGB, { 0.2f, 0.2f, 0.2f, 0.2f } }, { GL_DOT3_RGBA, { 0.2f, 0.2f, 0.2f, 0.2f } },
		{ GL_MODULATE_ADD_ATI, { 0.52f, 0.61f, 0.93f, 0.86f } },
		{ GL_MODULATE_SIGNED_ADD_ATI, { 0.02f, 0.11f, 0.43f, 0.36f } },
		{ GL_MODULATE_SUBTRACT_ATI, { -0.48f, 0.11f, -0.57f, 0.26f } },
	};
	const struct vec4 a = v4(0.2f, 0.4f, 0.6f, 0.8f), b = v4(0.5f, 0.25f, 0.75f, 0.3f),
			  c = v4(0.1f, 0.9f, 0.3f, 0.7f), none = v4(0, 0, 0, 0);
	const struct vec4 samples[SCENE_MAX_UNITS] = { none, none, b };

	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
		check_vec4(combine_function(rows[i].function, a, b, c), rows[i].wanted, "function", i);
	check_vec4(combine_argument(GL_PREVIOUS, GL_SRC_COLOR, a, b, c, none, samples),
	           (float[4]){ 0.2f, 0.4f, 0.6f, 0.8f }, "argument", 0);
	check_vec4(combine_argument(GL_TEXTURE, GL_SRC_ALPHA, a, b, c, none, samples),
	           (float[4]){ 0.3f, 0.3f, 0.3f, 0.3f }, "argument", 1);
	check_vec4(combine_argument(GL_PRIMARY_COLOR, GL_ONE_MINUS_SRC_COLOR, a, b, c, none, samples),
	           (float[4]){ 0.9f, 0.1f, 0.7f, 0.3f }, "argument", 2);
	check_vec4(combine_argument(GL_CONSTANT, GL_ONE_MINUS_SRC_ALPHA, a, b, c, a, samples),
	           (float[4]){ 0.2f, 0.2f, 0.2f, 0.2f }, "argument", 3);
	check_vec4(combine_argument(GL_TEXTURE0 + 2, GL_SRC_COLOR, a, none, c, none, samples),
	           (float[4]){ 0.5f, 0.25f, 0.75f, 0.3f }, "argument", 4);
}
END_TEST

/* --- Textures (sec. 3.8.8) --------------------------------------------------------------------------------------- */

START_TEST(test_levels)
{
	struct scene_unit unit = { .min_lod = -1000, .max_lod = 1000, .max_anisotropy = 4 };
	struct texture_slope slope = { .right = { 0, 8, 0, 0 }, .down = { 2, 0, 0, 0 } };

	for (int k = -20; k <= 20; k++)
		ck_assert_float_eq(texture_half_log2(ldexpf(1, 2 * k)), (float)k);
	ck_assert_float_eq(texture_half_log2(1.5f), 0.25f);
	ck_assert_float_eq(texture_half_log2(0), -100); /* values below 1e-30 count as zero */
	ck_assert_float_eq(texture_half_log2(0.99e-30f), -100);
	ck_assert_float_eq_tol(texture_half_log2(1.01e-30f), -49.8f, 0.1f);
	ck_assert_float_eq(texture_half_log2(INFINITY), 100);
	ck_assert_float_eq(texture_lod(&unit, &slope, 0), 3);
	/* the short axis, 2 texels: the long one is at most four times as long */
	ck_assert_float_eq(texture_lod(&unit, &slope, 1), 1);
	unit.max_anisotropy = 2;
	ck_assert_float_eq(texture_lod(&unit, &slope, 1), 2);
	unit.lod_bias = -1.5f;
	ck_assert_float_eq(texture_lod(&unit, &slope, 0), 1.5f);
	unit.max_lod = 1;
	ck_assert_float_eq(texture_lod(&unit, &slope, 0), 1);
	unit.min_lod = unit.max_lod = 2.25f;
	ck_assert_float_eq(texture_lod(&unit, &slope, 0), 2.25f);
}
END_TEST

START_TEST(test_mixed_texels)
{
	for (uint32_t weight = 0; weight < 256; weight += 51)
		for (int c = 0; c < 4; c++) { /* each channel separately */
			const uint32_t a = 200u << 8 * c, b = 40u << 8 * c, have = texture_mix_8(a, b, weight);

			ck_assert_uint_eq(have, ((200 * (256 - weight) + 40 * weight + 128) >> 8) << 8 * c);
		}
	ck_assert_uint_eq(texture_mix_8(0xff00ff00u, 0x00ff00ffu, 128), 0x80808080u);
}
END_TEST

/* Adjacent pixels' lists, and the place where a full column continues. */
START_TEST(test_gathered)
{
	uint32_t counts[4] = { 1, 0, 2, 1 }, first[4] = { 0, 1, 1, 3 }, pixels[4], after[4];
	struct fragment sparse[8], list[4];
	struct gather_arguments a = { .counts = counts,
		                      .first = first,
		                      .sparse = sparse,
		                      .slots = 2,
		                      .list = list,
		                      .pixels = pixels,
		                      .after = after,
		                      .width = 2,
		                      .rectangle = { 0, 0, 2, 2 },
		                      .first_pixel = 100 };

	for (uint32_t i = 0; i < 8; i++)
		sparse[i] = (struct fragment){ .order = 10 * i };
	for (uint32_t i = 0; i < 4; i++)
		gather_item(&a, i);
	ck_assert(list[0].order == 0 && list[1].order == 40 && list[2].order == 50 && list[3].order == 60);
	ck_assert(pixels[0] == 100 && pixels[1] == 102 && pixels[2] == 102 && pixels[3] == 103);
	ck_assert(after[0] == SCENE_NONE && after[1] == SCENE_NONE && after[2] == 51 && after[3] == SCENE_NONE);
}
END_TEST

/* Passes add up, and the first one starts; pixels of other turns keep their values. */
START_TEST(test_passes)
{
	struct frame_pixel frame[64];
	float sums[64 * PASS_PARTS];
	unsigned parts = 0;

	memset(frame, 0, sizeof(frame));
	for (uint32_t i = 0; i < 64; i++)
		frame[i].beauty[1] = 0.5f;
	for (uint32_t turn = 0; turn <= SAMPLE_TURNS; turn++) {
		struct add_pass_arguments a = { .frame = frame, .turn = turn, .sums = sums, .first = 1 };

		for (uint32_t i = 0; i < 64 * PASS_PARTS; i++)
			sums[i] = 7;
		for (uint32_t pass = 0; pass < 2; pass++, a.first = 0)
			for (uint32_t i = 0; i < 64; i++)
				add_pass_item(&a, i);
		for (uint32_t i = 0; i < 64; i++) {
			const int taken = turn == SAMPLE_TURNS || sample_turn(i) == turn;

			parts += (unsigned)taken;
			ck_assert_float_eq(sums[i * PASS_PARTS + 10], taken ? 1 : 7);
			ck_assert_float_eq(sums[i * PASS_PARTS], taken ? 0 : 7);
		}
	}
	ck_assert_uint_eq(parts, 2 * 64);
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("formulas");

	tcase_add_test(tcase, test_strength);
	tcase_add_test(tcase, test_light_terms);
	tcase_add_test(tcase, test_light_sides);
	tcase_add_test(tcase, test_generated);
	tcase_add_test(tcase, test_point_sizes);
	tcase_add_test(tcase, test_window);
	tcase_add_test(tcase, test_environments);
	tcase_add_test(tcase, test_combiners);
	tcase_add_test(tcase, test_levels);
	tcase_add_test(tcase, test_mixed_texels);
	tcase_add_test(tcase, test_gathered);
	tcase_add_test(tcase, test_passes);
	return run_case(tcase, "formulas");
}
