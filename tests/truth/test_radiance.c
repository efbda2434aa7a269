/*
 * Pictures with every pixel known in closed form: Lambert's law on a square and inside a sphere, the outline of a
 * shadow, a mirror that shows a plane, a lit corner without specks of shadow.
 */
#include <math.h>
#include <stdlib.h>

#include "tests/case.h"
#include "tests/truth/scenes.h"

#define SIZE 96

static float at(const struct image *img, const char *channel, uint32_t x, uint32_t y)
{
	const float *plane = image_channel(img, channel);

	ck_assert_ptr_nonnull(plane);
	return plane[(size_t)y * img->width + x];
}

/* A square at distance 10 under a point light at height h above it: cos(angle), interpolated between fine cells. */
START_TEST(test_square_under_point_light)
{
	struct made t;
	struct image img;
	const float h = 3, albedo = 0.8f;

	made_init(&t, SIZE, SIZE, 0);
	made_add_light(&t, 0, 0, -10 + h, 1);
	made_add_square(&t, made_add_material(&t, albedo), (float[3]){ 0, 0, -10 }, (float[3]){ 1, 0, 0 },
	                 (float[3]){ 0, 1, 0 }, 1, 48);
	truth_render(&t, "whitted", &img);
	for (uint32_t y = 0; y < SIZE; y++)
		for (uint32_t x = 0; x < SIZE; x++) {
			float px = 2 * ((float)x + 0.5f) / SIZE - 1, py = 1 - 2 * ((float)y + 0.5f) / SIZE;
			float truth = albedo * h / sqrtf(px * px + py * py + h * h);

			ck_assert_float_eq_tol(at(&img, "gl.R", x, y), truth, 1e-3f);
			ck_assert_float_eq_tol(at(&img, "R", x, y), truth, 1e-3f);
			ck_assert_float_eq(at(&img, "shadow.R", x, y), 1);
			ck_assert_float_eq_tol(at(&img, "Z", x, y), 10, 1e-4f);
			ck_assert_float_eq(at(&img, "id", x, y), 1);
			ck_assert_float_eq(at(&img, "A", x, y), 1);
		}
	image_free(&img);
	made_free(&t);
}
END_TEST

/* Inside a sphere lit from its centre, light arrives perpendicularly everywhere: all pixels are equal. */
START_TEST(test_enclosing_sphere)
{
	enum { RINGS = 24, SECTORS = 48, N = RINGS * SECTORS * 6 };
	float (*position)[3] = malloc(N * sizeof(*position)), (*normal)[3] = malloc(N * sizeof(*normal));
	static const int corner[6][2] = { { 0, 0 }, { 0, 1 }, { 1, 1 }, { 0, 0 }, { 1, 1 }, { 1, 0 } };
	struct made t;
	struct image img;
	uint32_t n = 0;

	for (int ring = 0; ring < RINGS; ring++)
		for (int sector = 0; sector < SECTORS; sector++)
			for (int k = 0; k < 6; k++, n++) {
				double a = M_PI * (ring + corner[k][0]) / RINGS, b = 2 * M_PI * (sector + corner[k][1]) / SECTORS;
				float d[3] = { (float)(sin(a) * cos(b)), (float)cos(a), (float)(sin(a) * sin(b)) };

				for (int i = 0; i < 3; i++) {
					position[n][i] = 5 * d[i];
					normal[n][i] = -d[i];
				}
			}
	made_init(&t, SIZE, SIZE, 1);
	made_add_light(&t, 0, 0, 0, 1);
	made_add_triangles(&t, made_add_material(&t, 0.5f), (const float (*)[3])position, (const float (*)[3])normal, n);
	truth_render(&t, "whitted", &img);
	for (uint32_t y = 0; y < SIZE; y++)
		for (uint32_t x = 0; x < SIZE; x++) {
			ck_assert_float_eq_tol(at(&img, "gl.G", x, y), 0.5f, 1e-3f);
			ck_assert_float_eq_tol(at(&img, "G", x, y), 0.5f, 1e-3f);
			ck_assert_float_eq(at(&img, "shadow.G", x, y), 1);
		}
	image_free(&img);
	made_free(&t);
	free(position);
	free(normal);
}
END_TEST

/*
 * A small square of side 2 s halfway between a point light and a wall casts a shadow of side 4 s. In a parallel view
 * from the light's side it is hidden behind the square up to 2 s; the rest of the shadow shows around it.
 */
START_TEST(test_shadow_shape)
{
	struct made t;
	struct image img;
	const float s = 0.3f;
	uint32_t material;

	made_init(&t, SIZE, SIZE, 0);
	made_add_light(&t, 0, 0, -2, 1);
	material = made_add_material(&t, 0.9f);
	made_add_square(&t, material, (float[3]){ 0, 0, -10 }, (float[3]){ 1, 0, 0 }, (float[3]){ 0, 1, 0 }, 1, 8);
	made_add_square(&t, material, (float[3]){ 0, 0, -6 }, (float[3]){ 1, 0, 0 }, (float[3]){ 0, 1, 0 }, s, 1);
	truth_render(&t, "whitted", &img);
	for (uint32_t y = 0; y < SIZE; y++)
		for (uint32_t x = 0; x < SIZE; x++) {
			float px = fabsf(2 * ((float)x + 0.5f) / SIZE - 1), py = fabsf(2 * ((float)y + 0.5f) / SIZE - 1);
			float out = fmaxf(px, py);

			if (fabsf(out - s) < 1e-3f || fabsf(out - 2 * s) < 1e-3f)
				continue; /* exactly on an edge */
			ck_assert_float_eq(at(&img, "id", x, y), out < s ? 2 : 1);
			ck_assert_float_eq(at(&img, "shadow.B", x, y), out > s && out < 2 * s ? 0 : 1);
			ck_assert_float_eq_tol(at(&img, "B", x, y), at(&img, "gl.B", x, y) * at(&img, "shadow.B", x, y), 1e-6f);
		}
	image_free(&img);
	made_free(&t);
}
END_TEST

/* A perfect mirror, tilted by 45 degrees, shows a wall on its left, which is lit past the mirror at 45 degrees. */
START_TEST(test_mirror)
{
	struct made t;
	struct image img;
	const float r = sqrtf(0.5f);
	uint32_t matte, mirror;

	made_init(&t, SIZE, SIZE, 0);
	made_add_light(&t, 1, 0, 1, 0);
	matte = made_add_material(&t, 0.6f);
	mirror = made_add_material(&t, 0.2f);
	t.materials[mirror].surface.reflect = 1;
	made_add_square(&t, mirror, (float[3]){ 0, 0, -10 }, (float[3]){ r, 0, r }, (float[3]){ 0, 1, 0 }, 0.5f, 1);
	/* out of view, facing right; the mirror turns -z into -x */
	made_add_square(&t, matte, (float[3]){ -4, 0, -10 }, (float[3]){ 0, 0, -1 }, (float[3]){ 0, 1, 0 }, 3, 4);
	truth_render(&t, "whitted", &img);
	ck_assert_float_eq_tol(at(&img, "R", SIZE / 2, SIZE / 2), 0.6f * r, 1e-3f);
	ck_assert_float_eq_tol(at(&img, "gl.R", SIZE / 2, SIZE / 2) + at(&img, "reflect.R", SIZE / 2, SIZE / 2),
	                       0.6f * r, 1e-3f);
	ck_assert_float_eq(at(&img, "R", 2, 2), 0);
	image_free(&img);
	made_free(&t);
}
END_TEST

/* Rotate a direction about y, then about x. */
static void turn(float turn_y, float turn_x, const float in[3], float out[3])
{
	float x = cosf(turn_y) * in[0] + sinf(turn_y) * in[2], z = cosf(turn_y) * in[2] - sinf(turn_y) * in[0];

	out[0] = x;
	out[1] = cosf(turn_x) * in[1] - sinf(turn_x) * z;
	out[2] = sinf(turn_x) * in[1] + cosf(turn_x) * z;
}

/* Whether a pixel shows a wall inside the room, not its extension behind another wall. */
static int inside(const struct image *img, uint32_t x, uint32_t y, const float middle[3], float e[3][3], float scale)
{
	float p[3] = { at(img, "P.X", x, y), at(img, "P.Y", x, y), at(img, "P.Z", x, y) };

	if (at(img, "id", x, y) == 0)
		return 0;
	for (int i = 0; i < 3; i++) {
		float along = (p[0] - middle[0]) * e[i][0] + (p[1] - middle[1]) * e[i][1] + (p[2] - middle[2]) * e[i][2];

		if (along < -1.001f * scale)
			return 0;
	}
	return 1;
}

/*
 * Three walls that meet in a corner and extend past each other by `overlap`, with a light on the inside: every pixel
 * sees the light, including those along the edges, whose shadow rays start next to another wall.
 * @return pixels in shadow
 */
static uint32_t corner_specks(float turn_y, float turn_x, float overlap, uint32_t cells, float scale)
{
	static const float axis[3][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
	const float middle[3] = { 0, 0, -4 * scale }, half = (1 + overlap) * scale;
	float e[3][3];
	struct made t;
	struct image img;
	uint32_t material, specks = 0;

	for (int i = 0; i < 3; i++)
		turn(turn_y, turn_x, axis[i], e[i]);
	made_init(&t, SIZE, SIZE, 0.6f);
	t.view.projection[14] *= scale; /* near and far */
	made_add_light(&t, middle[0] + 0.3f * scale * (e[0][0] + e[1][0] + e[2][0]),
	                middle[1] + 0.3f * scale * (e[0][1] + e[1][1] + e[2][1]),
	                middle[2] + 0.3f * scale * (e[0][2] + e[1][2] + e[2][2]), 1);
	material = made_add_material(&t, 0.7f);
	for (int i = 0; i < 3; i++) { /* the wall at -1 on axis i; from -overlap to beyond it on the others */
		float centre[3];

		for (int k = 0; k < 3; k++)
			centre[k] = middle[k] - scale * (e[i][k] + overlap * (e[(i + 1) % 3][k] + e[(i + 2) % 3][k]));
		made_add_square(&t, material, centre, e[(i + 1) % 3], e[(i + 2) % 3], half, cells);
	}
	truth_render(&t, "whitted", &img);
	for (uint32_t y = 0; y < SIZE; y++)
		for (uint32_t x = 0; x < SIZE; x++)
			specks += inside(&img, x, y, middle, e, scale) && at(&img, "shadow.G", x, y) < 1;
	image_free(&img);
	made_free(&t);
	return specks;
}

START_TEST(test_corner_without_specks)
{
	static const float overlaps[] = { 0, 0.25f }, scales[] = { 1, 20 };

	for (int i = 0; i < 6; i++)
		for (uint32_t k = 0; k < 8; k++) {
			float turn_y = -0.6f - 0.07f * (float)i, turn_x = 0.4f + 0.09f * (float)i;
			uint32_t specks = corner_specks(turn_y, turn_x, overlaps[k & 1], k & 2 ? 7 : 1, scales[k >> 2]);

			ck_assert_msg(specks == 0, "%u dark pixels: turned by %g and %g, overlap %g, case %u", specks,
			              (double)turn_y, (double)turn_x, (double)overlaps[k & 1], k);
		}
}
END_TEST

/*
 * A wall on a floor with a light on one side: at any scale, the floor is dark up to the wall on the far side and bright
 * up to it on the near side; and the corner above has no specks.
 */
START_TEST(test_shadows_at_any_scale)
{
	static const float scales[] = { 1e-3f, 1e-2f, 1, 1e3f, 1e5f };

	for (int i = 0; i < 5; i++) {
		const float s = scales[i];
		uint32_t floor, dark = 0, bright = 0;
		struct made t;
		struct image img;

		made_init(&t, SIZE, SIZE, 0.6f);
		t.view.projection[14] *= s; /* near and far */
		made_add_light(&t, 2 * s, 1 * s, -6 * s, 1);
		floor = made_add_material(&t, 0.7f);
		made_add_square(&t, floor, (float[3]){ 0, -1 * s, -6 * s }, (float[3]){ 0, 0, s }, (float[3]){ s, 0, 0 }, 3, 5);
		made_add_square(&t, floor, (float[3]){ 0, -0.25f * s, -6 * s }, (float[3]){ 0, 0, 12 * s },
		                (float[3]){ 0, 0.75f * s, 0 }, 1, 1);
		truth_render(&t, "whitted", &img);
		for (uint32_t y = 0; y < SIZE; y++)
			for (uint32_t x = 0; x < SIZE; x++) {
				float from_wall = at(&img, "P.X", x, y) / s;

				/* rays start at 2^-14 of six units; closer to the wall nothing is guaranteed */
				if (at(&img, "id", x, y) != 1 || fabsf(from_wall) < 1e-3f)
					continue;
				ck_assert_msg(at(&img, "shadow.G", x, y) == (from_wall > 0), "scale %g: shadow %g at %g", (double)s,
				              (double)at(&img, "shadow.G", x, y), (double)from_wall);
				dark += from_wall < 0;
				bright += from_wall > 0;
			}
		ck_assert_uint_gt(dark, SIZE);
		ck_assert_uint_gt(bright, SIZE);
		image_free(&img);
		made_free(&t);
		ck_assert_uint_eq(corner_specks(-0.67f, 0.49f, 0.25f, 7, s), 0);
	}
}
END_TEST

/*
 * A smooth line one pixel wide has a triangular profile, two pixels wide: the coverages of a column of pixels across a
 * horizontal line sum to 1, and across a 45-degree line between two pixels' centres to 2 - sqrt(1/2). Here: a square of
 * two by two pieces, split into triangles, alpha 1, no blending; a column that crosses three horizontal lines and two
 * diagonals, all at different places.
 */
START_TEST(test_smooth_lines_cover_their_width)
{
	struct tracer_options options = { .mode = TRACER_GL, .display = 1 };
	struct device *dev = NULL;
	struct tracer *tracer = NULL;
	struct image img = { .width = 0 };
	struct made t;
	uint32_t material;
	float *alpha, sum = 0, partial = 0;

	made_init(&t, SIZE, SIZE, 0);
	material = made_add_material(&t, 0.7f);
	made_add_square(&t, material, (float[3]){ 0, 0.0123f, -10 }, (float[3]){ 1, 0, 0 }, (float[3]){ 0, 1, 0 }, 0.5f, 2);
	t.materials[material].polygon_mode_front = t.materials[material].polygon_mode_back = GL_LINE;
	t.materials[material].line_smooth = 1;
	ck_assert_int_eq(device_open("reference", 0, &dev), 0);
	ck_assert_int_eq(tracer_create(&tracer, dev), 0);
	ck_assert_int_eq(tracer_render(tracer, &t.scene, &options, &img), 0);
	alpha = image_channel(&img, "gl.A");
	ck_assert_ptr_nonnull(alpha);
	for (uint32_t y = 0; y < img.height; y++) {
		float a = alpha[(size_t)y * img.width + img.width / 2 + 8];

		sum += a;
		partial += a > 0.01f && a < 0.99f;
	}
	ck_assert_float_eq_tol(sum, 3 + 2 * (2 - sqrtf(0.5f)), 0.02f);
	ck_assert_float_gt(partial, 1);
	image_free(&img);
	tracer_destroy(&tracer);
	device_close(&dev);
	made_free(&t);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("radiance");

	tcase_set_timeout(tests, 120);
	tcase_add_test(tests, test_square_under_point_light);
	tcase_add_test(tests, test_enclosing_sphere);
	tcase_add_test(tests, test_shadow_shape);
	tcase_add_test(tests, test_mirror);
	tcase_add_test(tests, test_corner_without_specks);
	tcase_add_test(tests, test_shadows_at_any_scale);
	tcase_add_test(tests, test_smooth_lines_cover_their_width);
	return run_case(tests, "radiance");
}
