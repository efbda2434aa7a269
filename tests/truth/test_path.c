/*
 * Light across many surfaces in closed form, which takes many samples: an integrating sphere, mirrors in a furnace; and
 * the effect of clamping samples.
 */
#include <math.h>

#include "tests/case.h"
#include "tests/truth/scenes.h"

#define SIZE 32

static struct tracer_options options_of(unsigned samples)
{
	return (struct tracer_options){ .mode = TRACER_PATH, .display = 1, .depth = 4, .samples = samples };
}

static void glow(struct made *t, uint32_t m, float emission)
{
	for (int c = 0; c < 3; c++)
		t->materials[m].front.emission[c] = t->materials[m].back.emission[c] = emission;
}

/* Half of a ball of radius 5 around the viewer, with reversed faces. side: -1: in front of the viewer, 1: behind */
static void add_half_ball(struct made *t, uint32_t material, float side)
{
	enum { CELLS = 32, N = CELLS * CELLS * 6 };
	static const int corner[6][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 0 }, { 1, 1 }, { 0, 1 } };
	static float position[N][3], normal[N][3];

	for (uint32_t v = 0; v < N; v++) {
		const float across = (float)M_PI * (float)(v / 6 % CELLS + (uint32_t)corner[v % 6][side < 0]) / CELLS;
		const float down = (float)M_PI * (float)(v / 6 / CELLS + (uint32_t)corner[v % 6][side > 0]) / CELLS;
		const float d[3] = { sinf(down) * cosf(across), -cosf(down), sinf(down) * sinf(across) * side };

		for (int i = 0; i < 3; i++) {
			position[v][i] = 5 * d[i];
			normal[v][i] = -d[i];
		}
	}
	made_add_triangles(t, material, (const float (*)[3])position, (const float (*)[3])normal, N);
}

/*
 * Points of a sphere send each other the same share of their light from any position (the principle of the integrating
 * sphere). One half is emissive; the other, which the viewer sees, receives the mean. Random numbers of different
 * bounces must be independent: each pixel has the same value.
 */
START_TEST(test_integrating_sphere)
{
	const float e = 0.9f, a = 0.7f;
	struct tracer_options options = options_of(64);
	const float truth = a * e / 2 * (1 - powf(a, (float)options.depth)) / (1 - a);
	double sum = 0, squares = 0;
	uint32_t dark, bright;
	struct image img;
	struct made t;

	made_init(&t, SIZE, SIZE, 1);
	dark = made_add_material(&t, a);
	bright = made_add_material(&t, a);
	glow(&t, bright, e);
	add_half_ball(&t, dark, -1);
	add_half_ball(&t, bright, 1);
	truth_render_with(&t, &options, &img);
	for (uint32_t y = 0; y < SIZE; y++)
		for (uint32_t x = 0; x < SIZE; x++) {
			const double off = (double)(truth_at(&img, "R", x, y) - truth);

			sum += off;
			squares += off * off;
		}
	sum /= SIZE * SIZE;
	squares = sqrt(squares / (SIZE * SIZE));
	ck_assert_msg(fabs(sum) < 0.004 * (double)truth && squares < 0.07 * (double)truth,
	              "off by %g on average, by %g per pixel; truth %g", sum, squares, (double)truth);
	truth_check_closure(&img);
	image_free(&img);
	made_free(&t);
}
END_TEST

/* Inside a ball with emission e and specular share r, sharp or rough, that scatters a of the rest, each bounce
 * retains r + (1 - r) a. */
START_TEST(test_furnace_with_mirror)
{
	const float e = 0.3f, a = 0.5f, r = 0.6f, keep = r + (1 - r) * a;

	for (unsigned depth = 1; depth < 8; depth += depth + 1) {
		struct tracer_options options = options_of(64);
		const float truth = (1 - r) * e * (1 - powf(keep, (float)depth + 1)) / (1 - keep);
		struct image img;
		struct made t;
		uint32_t m;
		double sum = 0;

		made_init(&t, SIZE, SIZE, 1);
		m = made_add_material(&t, a);
		glow(&t, m, e);
		t.materials[m].surface.reflect = r;
		t.materials[m].surface.roughness = depth > 1 ? 0.3f : 0;
		made_add_ball(&t, m, (float[3]){ 0, 0, 0 }, 5, 32, 1);
		options.depth = depth;
		truth_render_with(&t, &options, &img);
		for (uint32_t y = 0; y < SIZE; y++)
			for (uint32_t x = 0; x < SIZE; x++) {
				ck_assert_float_eq_tol(truth_at(&img, "R", x, y), truth, 0.15f * truth + 1e-3f);
				sum += (double)truth_at(&img, "R", x, y) / (SIZE * SIZE);
			}
		ck_assert_double_eq_tol(sum, (double)truth, 0.004 * (double)truth + 5e-4);
		truth_check_closure(&img);
		image_free(&img);
		made_free(&t);
	}
}
END_TEST

/* Share of the hemisphere above a point that a parallel square fills, directly above: of the given half side, at a
 * height. */
static double square_part(double half, double height)
{
	const double a = half / height, b = sqrt(1 + a * a);

	return 4 * a / b * atan(a / b) / M_PI;
}

/* Share of the hemisphere (z) above the origin that a polygon fills, entirely above it (J. H. Lambert,
 * "Photometria", 1760). */
static double polygon_part(const double (*corner)[3], int n)
{
	double sum = 0;

	for (int i = 0; i < n; i++) {
		const double *a = corner[i], *b = corner[(i + 1) % n];
		const double cross[3] = { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
		const double sine = sqrt(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]);

		sum += atan2(sine, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) * cross[2] / sine;
	}
	return fabs(sum) / (2 * M_PI);
}

/*
 * A sheet lit at an angle by a square beside it, wherever its mesh has its origin, even at a corner; a square behind it
 * lights its other side, and leaves this one unchanged.
 */
START_TEST(test_squares_beside_and_behind)
{
	enum { SIDE = 8 };
	static const float x[3] = { 1, 0, 0 }, y[3] = { 0, 1, 0 }, z[3] = { 0, 0, 1 };
	/* from the sheet's middle */
	static const double beside[4][3] = { { 4, -1.5, 0.5 }, { 4, 1.5, 0.5 }, { 4, 1.5, 3.5 }, { 4, -1.5, 3.5 } };
	const float albedo = 0.8f, e = 0.9f, truth = albedo * e * (float)polygon_part(beside, 4);

	for (int i = 0; i < 4; i++) {
		const int is_behind = i % 2, is_moved = i / 2;
		struct tracer_options options = options_of(64);
		double sum = 0;
		uint32_t lamp;
		struct image img;
		struct made t;

		made_init(&t, SIDE, SIDE, 0);
		t.view.projection[0] = t.view.projection[5] = 20; /* the view is a tenth of a unit wide */
		made_add_square(&t, made_add_material(&t, albedo), (float[3]){ 0, 0, -10 }, x, y, 3, 1);
		lamp = made_add_material(&t, 0);
		glow(&t, lamp, e);
		made_add_square(&t, lamp, is_moved ? (float[3]){ 0, 1.5f, 1.5f } : (float[3]){ 4, 0, -8 }, y, z, 1.5f, 1);
		for (int k = 0; k < 3 && is_moved; k++)
			t.instances[1].modelview[12 + k] = (float[3]){ 4, -1.5f, -9.5f }[k];
		if (is_behind)
			made_add_square(&t, lamp, (float[3]){ 0.5f, 0, -12 }, x, y, 1, 1);
		options.depth = 1;
		truth_render_with(&t, &options, &img);
		for (uint32_t at = 0; at < SIDE * SIDE; at++)
			sum += (double)truth_at(&img, "R", at % SIDE, at / SIDE) / (SIDE * SIDE);
		ck_assert_double_eq_tol(sum, (double)truth, 0.01 * (double)truth);
		truth_check_closure(&img);
		image_free(&img);
		made_free(&t);
	}
}
END_TEST

/* A floor under an emissive square, far and near, by its own material and by a rule, in OpenGL's codes and in linear
 * light. */
START_TEST(test_square_over_floor)
{
	static const float x[3] = { 1, 0, 0 }, y[3] = { 0, 1, 0 };
	const float albedo = 0.8f, height = 12, e = 0.5f;

	for (int i = 0; i < 12; i++) {
		struct tracer_options options = options_of(16);
		const float half = (float[3]){ 0.3f, 4, 60 }[i % 3];
		const int by_rule = i / 3 % 2, linear = i / 6;
		float truth = (float)square_part((double)half, (double)height);
		double sum = 0;
		uint32_t lamp;
		struct image img;
		struct made t;

		truth *= linear ? image_linear_from_display(albedo) * image_linear_from_display(e) : albedo * e;
		made_init(&t, SIZE, SIZE, 0);
		t.view.projection[0] = t.view.projection[5] = 20; /* the view is a tenth of a unit wide */
		made_add_square(&t, made_add_material(&t, albedo), (float[3]){ 0, 0, -10 }, x, y, 1, 1);
		lamp = made_add_material(&t, 0);
		if (by_rule)
			t.materials[lamp].surface.emission[0] = t.materials[lamp].surface.emission[1] =
				t.materials[lamp].surface.emission[2] = e;
		else
			glow(&t, lamp, e);
		made_add_square(&t, lamp, (float[3]){ 0, 0, height - 10 }, y, x, half, 3);
		options.depth = 1;
		options.display = !linear;
		truth_render_with(&t, &options, &img);
		for (uint32_t at = 0; at < SIZE * SIZE; at++) {
			ck_assert_float_eq_tol(truth_at(&img, "R", at % SIZE, at / SIZE), truth, 0.12f * truth);
			sum += (double)truth_at(&img, "R", at % SIZE, at / SIZE) / (SIZE * SIZE);
		}
		ck_assert_double_eq_tol(sum, (double)truth, 0.005 * (double)truth);
		truth_check_closure(&img);
		image_free(&img);
		made_free(&t);
	}
}
END_TEST

/* A spherical light over a floor: directly below, the same as OpenGL's point light; half of that if an edge hides
 * half of the sphere. */
START_TEST(test_sphere_over_floor)
{
	static const float x[3] = { 1, 0, 0 }, y[3] = { 0, 1, 0 };
	const float albedo = 0.8f;

	for (int hidden = 0; hidden < 2; hidden++) {
		struct tracer_options options = options_of(64);
		double sum = 0;
		struct image img;
		struct made t;

		made_init(&t, SIZE, SIZE, 0);
		t.view.projection[0] = t.view.projection[5] = 2000;
		made_add_light(&t, 0, 0, 10, 1);
		t.lights[0].radius = 1;
		made_add_square(&t, made_add_material(&t, albedo), (float[3]){ 0, 0, -10 }, x, y, 1, 1);
		if (hidden)
			made_add_square(&t, made_add_material(&t, 0), (float[3]){ 20, 0, 1 }, x, y, 20, 1);
		truth_render_with(&t, &options, &img);
		for (uint32_t at = 0; at < SIZE * SIZE; at++)
			sum += (double)truth_at(&img, "R", at % SIZE, at / SIZE) / (SIZE * SIZE);
		ck_assert_double_eq_tol(sum, (double)albedo * (hidden ? 0.5 : 1), 0.004);
		image_free(&img);
		made_free(&t);
	}
}
END_TEST

/* Clamping keeps a surface's own light, and limits the light of each bounce. */
START_TEST(test_clamp)
{
	const float e = 0.5f, a = 1, most = 0.1f;
	struct tracer_options options = options_of(1);
	struct image img;
	struct made t;
	uint32_t m;

	made_init(&t, SIZE, SIZE, 1);
	m = made_add_material(&t, a);
	glow(&t, m, e);
	made_add_ball(&t, m, (float[3]){ 0, 0, 0 }, 5, 16, 1);
	options.clamp = most;
	truth_render_with(&t, &options, &img);
	ck_assert_float_eq_tol(truth_at(&img, "R", SIZE / 2, SIZE / 3), e + 4 * most, 2e-3f);
	image_free(&img);
	options.clamp = 0;
	truth_render_with(&t, &options, &img);
	ck_assert_float_eq_tol(truth_at(&img, "R", SIZE / 2, SIZE / 3), 5 * e, 2e-3f);
	image_free(&img);
	made_free(&t);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("path");

	tcase_set_timeout(tests, 180);
	tcase_add_test(tests, test_integrating_sphere);
	tcase_add_test(tests, test_furnace_with_mirror);
	tcase_add_test(tests, test_squares_beside_and_behind);
	tcase_add_test(tests, test_square_over_floor);
	tcase_add_test(tests, test_sphere_over_floor);
	tcase_add_test(tests, test_clamp);
	return run_case(tests, "path");
}
