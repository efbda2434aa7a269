/*
 * The border between light and shade on round shapes with few faces. A convex shape with smooth normals must not shade
 * itself, for any position of the light and any scale; an object in front does shade it.
 */
#include <math.h>

#include "tests/case.h"
#include "tests/truth/scenes.h"

#define SIZE 96

/* A sphere with few faces and radial normals. */
static void add_sphere(struct made *t, uint32_t material, float z, float radius)
{
	enum { RINGS = 5, SECTORS = 8, N = RINGS * SECTORS * 6 };
	static const int corner[6][2] = { { 0, 0 }, { 1, 1 }, { 0, 1 }, { 0, 0 }, { 1, 0 }, { 1, 1 } };
	float position[N][3], normal[N][3];
	uint32_t n = 0;

	for (int ring = 0; ring < RINGS; ring++)
		for (int sector = 0; sector < SECTORS; sector++)
			for (int k = 0; k < 6; k++, n++) {
				double a = M_PI * (ring + corner[k][0]) / RINGS, b = 2 * M_PI * (sector + corner[k][1]) / SECTORS;
				const float d[3] = { (float)(sin(a) * cos(b)), (float)cos(a), (float)(sin(a) * sin(b)) };

				for (int i = 0; i < 3; i++) {
					normal[n][i] = d[i];
					position[n][i] = radius * d[i] + (i == 2 ? z : 0);
				}
			}
	made_add_triangles(t, material, (const float (*)[3])position, (const float (*)[3])normal, N);
}

/* The sphere's lit pixels that are in shadow; *lit: number of lit pixels. */
static uint32_t shaded_pixels(const struct made *t, uint32_t *lit)
{
	struct image img;
	uint32_t n = 0;

	*lit = 0;
	truth_render(t, "whitted", &img);
	for (uint32_t y = 0; y < SIZE; y++)
		for (uint32_t x = 0; x < SIZE; x++) {
			if (truth_at(&img, "id", x, y) != 1)
				continue;
			n += truth_at(&img, "shadow.G", x, y) < 1;
			*lit += truth_at(&img, "gl.G", x, y) > 0;
		}
	image_free(&img);
	return n;
}

static void set_up(struct made *t, float scale, float angle, float w)
{
	made_init(t, SIZE, SIZE, 0.6f);
	t->view.projection[14] *= scale; /* near and far */
	made_add_light(t, 5 * scale * cosf(angle), 0.7f * scale, scale * (5 * sinf(angle) - 6 * w), w);
	add_sphere(t, made_add_material(t, 0.7f), -6 * scale, 2 * scale);
}

START_TEST(test_round_shape_shades_nothing_of_itself)
{
	static const float scales[] = { 1e-3f, 1, 1e3f };

	for (int i = 0; i < 3; i++)
		for (int k = 0; k < 16; k++) {
			const float w = k & 1 ? 1 : 0;
			struct made t;
			uint32_t lit, dark;

			set_up(&t, scales[i], 0.4f * (float)k, w);
			dark = shaded_pixels(&t, &lit);
			ck_assert_msg(dark == 0, "scale %g, light %d: %u of %u lit pixels are in shadow",
			              (double)scales[i], k, dark, lit);
			made_free(&t);
		}
}
END_TEST

START_TEST(test_others_shade_it_alike_at_any_scale)
{
	static const float scales[] = { 1, 1e-3f, 1e3f };
	uint32_t first = 0;

	for (int i = 0; i < 3; i++) {
		const float s = scales[i];
		struct made t;
		uint32_t lit, dark;

		set_up(&t, s, 0.8f, 0);
		made_add_square(&t, 0, (float[3]){ 2.4f * s, 0.2f * s, -3.4f * s },
		                (float[3]){ 0.7f * s, 0, -0.7f * s }, (float[3]){ 0, s, 0 }, 0.6f, 1);
		dark = shaded_pixels(&t, &lit);
		first = i == 0 ? dark : first;
		ck_assert_uint_gt(dark, 100);
		ck_assert_uint_lt(dark, lit / 2);
		ck_assert_msg(abs((int)dark - (int)first) <= 3, "scale %g: %u pixels in shadow, %u at scale 1",
		              (double)s, dark, first);
		made_free(&t);
	}
}
END_TEST

/* A single sheet with fin-like normals, which point to both of its sides. It must not shade itself for any position
 * of the light. */
START_TEST(test_thin_sheet_shades_nothing_of_itself)
{
	static const float corners[3][3] = { { -2, -1.5f, -6 }, { 2, -1, -6 }, { 0, 2, -6 } };
	static const float normals[4][3][3] = {
		{ { -0.3f, 0.5f, 0.8f }, { 0.1f, -0.9f, -0.4f }, { 0.5f, -0.4f, -0.8f } },
		{ { 0, 0.3f, 0.95f }, { 0.9f, 0, -0.4f }, { -0.9f, 0, -0.4f } },
		{ { 0, 0, 1 }, { 0, 0, -1 }, { 0, 1, 0 } },
		{ { -0.7f, 0.7f, 0.2f }, { 0.7f, 0.7f, 0.2f }, { 0, -0.9f, -0.4f } },
	};
	uint32_t lit, seen = 0;

	for (int i = 0; i < 4; i++)
		for (int k = 0; k < 16; k++) {
			struct made t;
			uint32_t dark;

			made_init(&t, SIZE, SIZE, 0.6f);
			made_add_light(&t, 5 * cosf(0.2f + 0.4f * (float)k), 3, 5 * sinf(0.2f + 0.4f * (float)k), 0);
			made_add_triangles(&t, made_add_material(&t, 0.7f), corners, normals[i], 3);
			dark = shaded_pixels(&t, &lit);
			ck_assert_msg(dark == 0, "normals %d, light %d: %u of %u lit pixels are in shadow", i, k, dark,
			              lit);
			seen += lit;
			made_free(&t);
		}
	ck_assert_uint_gt(seen, 10000);
}
END_TEST

/* In mode path, an emissive surface behind a wall lights nothing on the visible side, whichever way the wall's
 * normals lean. */
START_TEST(test_lamp_behind_lights_nothing)
{
	static const float wall[3][3] = { { -4, -4, -6 }, { 4, -4, -6 }, { 0, 6, -6 } };
	static const float lean[3][2] = { { 0, 1 }, { 0.95f, 0.3f }, { 0.95f, -0.3f } }; /* x and z */

	for (int i = 0; i < 3; i++) {
		const float normals[3][3] = { { lean[i][0], 0, lean[i][1] },
			                      { lean[i][0], 0, lean[i][1] },
			                      { lean[i][0], 0, lean[i][1] } };
		const struct tracer_options options = { .mode = TRACER_PATH, .display = 1, .depth = 1, .rays = 16 };
		uint32_t lamp;
		struct image img;
		struct made t;

		made_init(&t, SIZE, SIZE, 0.3f);
		made_add_triangles(&t, made_add_material(&t, 0.8f), wall, normals, 3);
		lamp = made_add_material(&t, 0);
		for (int c = 0; c < 3; c++)
			t.materials[lamp].surface.emission[c] = 0.5f;
		made_add_square(&t, lamp, (float[3]){ 2, 0, -8 }, (float[3]){ 1, 0, 0 }, (float[3]){ 0, 1, 0 }, 1, 1);
		truth_render_with(&t, &options, &img);
		for (uint32_t at = 0; at < SIZE * SIZE; at++)
			ck_assert_float_eq(truth_at(&img, "R", at % SIZE, at / SIZE), 0);
		image_free(&img);
		made_free(&t);
	}
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("terminator");

	tcase_set_timeout(tests, 60);
	tcase_add_test(tests, test_round_shape_shades_nothing_of_itself);
	tcase_add_test(tests, test_others_shade_it_alike_at_any_scale);
	tcase_add_test(tests, test_thin_sheet_shades_nothing_of_itself);
	tcase_add_test(tests, test_lamp_behind_lights_nothing);
	return run_case(tests, "terminator");
}
