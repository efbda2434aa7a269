/*
 * Area lights, ambient occlusion and light between surfaces in closed form: width and profile of a penumbra, a plane
 * under a disk, a white furnace; pixels averaged over several pictures; lighting per pixel instead of per vertex.
 */
#include <math.h>
#include <stdlib.h>

#include "tests/case.h"
#include "tests/truth/scenes.h"

#define SIZE 64

static const float right[3] = { 1, 0, 0 }, up[3] = { 0, 1, 0 };

static struct tracer_options options_of(enum tracer_mode mode)
{
	return (struct tracer_options){ .mode = mode, .display = 1, .depth = 4 };
}

/* Share of a unit disk on the side x < a. */
static float disk_part(float a)
{
	a = fminf(fmaxf(a, -1), 1);
	return (float)(0.5 + (asin(a) + a * sqrt(1 - a * a)) / M_PI);
}

/*
 * A half plane between a spherical light and a floor: the penumbra's width is (receiver - blocker) / blocker x light
 * width, with distances from the light; the light inside follows the visible share of the light's disk.
 */
START_TEST(test_penumbra)
{
	static const float blockers[] = { 40, 60, 80 };
	const float receiver = 100, radius = 0.4f;

	for (int i = 0; i < 3; i++) {
		float blocker = blockers[i], width = (receiver - blocker) / blocker * 2 * radius;
		struct tracer_options options = options_of(TRACER_WHITTED);
		struct made t;
		struct image img;
		uint32_t matte;

		made_init(&t, SIZE, SIZE, 0);
		made_add_light(&t, 0, 0, receiver - 10, 1);
		t.lights[0].radius = radius;
		options.rays = 256;
		matte = made_add_material(&t, 1);
		made_add_square(&t, matte, (float[3]){ 0, 0, -10 }, right, up, 2, 1);
		/* its edge is at x = 0; behind the viewer, so that the picture shows only the floor */
		made_add_square(&t, matte, (float[3]){ -20, 0, receiver - 10 - blocker }, right, up, 20, 1);
		truth_render_with(&t, &options, &img);
		for (uint32_t x = 0; x < SIZE; x++) {
			float px = 2 * ((float)x + 0.5f) / SIZE - 1, shadow = truth_at(&img, "shadow.R", x, SIZE / 2);

			ck_assert_float_eq_tol(shadow, disk_part(px / (width / 2)), 0.02f);
			if (px < -width / 2 - 0.01f)
				ck_assert_float_eq(shadow, 0);
			if (px > width / 2 + 0.01f)
				ck_assert_float_eq(shadow, 1);
		}
		truth_check_closure(&img);
		image_free(&img);
		made_free(&t);
	}
}
END_TEST

/* Under the middle of a disk of radius r at height h, a plane's openness is h^2 / (r^2 + h^2). */
START_TEST(test_openness_under_disk)
{
	enum { SEGMENTS = 96, SIDE = 16 };
	static const float heights[] = { 0.7f, 1.5f, 4 };
	float (*position)[3] = calloc(3 * SEGMENTS, sizeof(*position)), (*normal)[3] = calloc(3 * SEGMENTS, sizeof(*normal));

	for (int i = 0; i < 3; i++) {
		const float h = heights[i] + 9, r = 10; /* the disk is behind the viewer */
		struct tracer_options options = options_of(TRACER_AO);
		struct made t;
		struct image img;
		uint32_t matte;

		for (int s = 0; s < SEGMENTS; s++)
			for (int k = 0; k < 3; k++) {
				double a = 2 * M_PI * (s + k - 1) / SEGMENTS;

				position[3 * s + k][0] = k ? r * (float)cos(a) : 0;
				position[3 * s + k][1] = k ? r * (float)sin(a) : 0;
				position[3 * s + k][2] = -10 + h;
				normal[3 * s + k][2] = -1;
			}
		made_init(&t, SIDE, SIDE, 0);
		t.view.projection[0] = t.view.projection[5] = 20; /* the view is a tenth of a unit wide */
		options.rays = 1024;
		matte = made_add_material(&t, 1);
		made_add_square(&t, matte, (float[3]){ 0, 0, -10 }, right, up, 1, 1);
		made_add_triangles(&t, matte, (const float (*)[3])position, (const float (*)[3])normal, 3 * SEGMENTS);
		truth_render_with(&t, &options, &img);
		ck_assert_float_eq_tol(truth_at(&img, "R", SIDE / 2, SIDE / 2), h * h / (r * r + h * h), 0.005f);
		truth_check_closure(&img);
		image_free(&img);
		options.reach = h * 0.9f; /* no object within reach */
		truth_render_with(&t, &options, &img);
		ck_assert_float_eq(truth_at(&img, "R", SIDE / 2, SIDE / 2), 1);
		image_free(&img);
		made_free(&t);
	}
	free(position);
	free(normal);
}
END_TEST

/* A ball of radius 3 around `centre`, seen from outside or, with reversed faces, from inside. */
static void add_ball(struct made *t, uint32_t material, const float centre[3], float r, int inside)
{
	enum { RINGS = 16, SECTORS = 32, N = RINGS * SECTORS * 6 };
	static const int corner[6][2] = { { 0, 0 }, { 0, 1 }, { 1, 1 }, { 0, 0 }, { 1, 1 }, { 1, 0 } };
	float (*position)[3] = malloc(N * sizeof(*position)), (*normal)[3] = malloc(N * sizeof(*normal));
	uint32_t n = 0;

	for (int ring = 0; ring < RINGS; ring++)
		for (int sector = 0; sector < SECTORS; sector++)
			for (int k = 0; k < 6; k++, n++) {
				double a = M_PI * (ring + corner[k][0]) / RINGS, b = 2 * M_PI * (sector + corner[k][1]) / SECTORS;
				float d[3] = { (float)(sin(a) * cos(b)), (float)cos(a), (float)(sin(a) * sin(b)) };

				for (int i = 0; i < 3; i++) {
					position[n][i] = centre[i] + r * d[i];
					normal[n][i] = inside ? -d[i] : d[i];
				}
			}
	made_add_triangles(t, material, (const float (*)[3])position, (const float (*)[3])normal, N);
	free(position);
	free(normal);
}

static void glow(struct made *t, uint32_t m, float emission)
{
	for (int c = 0; c < 3; c++)
		t->materials[m].front.emission[c] = t->materials[m].back.emission[c] = emission;
}

/* A ball in white surroundings returns its reflectance, at any position; a mirror and a glass ball return
 * everything. */
START_TEST(test_white_furnace)
{
	struct tracer_options options = options_of(TRACER_PATH);

	for (int kind = 0; kind < 3; kind++) {
		float albedo = kind ? 1 : 0.7f;
		double sum = 0;
		uint32_t matte, n = 0;
		struct made t;
		struct image img;

		made_init(&t, SIZE, SIZE, 0);
		for (int c = 0; c < 3; c++)
			t.clear.color[c] = 1;
		options.depth = kind == 2 ? 32 : 4; /* many reflections inside glass */
		matte = made_add_material(&t, albedo);
		t.materials[matte].surface.reflect = kind == 1;
		t.materials[matte].surface.transmit = kind == 2;
		t.materials[matte].surface.ior = 1.5f;
		add_ball(&t, matte, (float[3]){ 0, 0, -10 }, 0.9f, 0);
		truth_render_with(&t, &options, &img);
		for (uint32_t y = 0; y < SIZE; y++)
			for (uint32_t x = 0; x < SIZE; x++) {
				if (truth_at(&img, "id", x, y) == 0)
					continue;
				sum += (double)truth_at(&img, "R", x, y);
				n++;
				if (kind < 2)
					ck_assert_float_eq_tol(truth_at(&img, "R", x, y), albedo, 1e-3f);
			}
		ck_assert_uint_gt(n, SIZE * SIZE / 2);
		ck_assert_double_eq_tol(sum / n, (double)albedo, 5e-3);
		truth_check_closure(&img);
		image_free(&img);
		made_free(&t);
	}
}
END_TEST

/* Inside a ball with emission e and reflectance a: e (1 + a + a^2 + ...), with as many terms as bounces, and one in
 * `diffuse`. */
START_TEST(test_glowing_ball)
{
	const float e = 0.2f, a = 0.6f;

	for (unsigned depth = 0; depth < 6; depth++) {
		struct tracer_options options = options_of(TRACER_PATH);
		struct made t;
		struct image img;
		uint32_t matte;
		float truth = e * (1 - powf(a, (float)depth + 1)) / (1 - a);

		made_init(&t, SIZE, SIZE, 1);
		matte = made_add_material(&t, a);
		glow(&t, matte, e);
		add_ball(&t, matte, (float[3]){ 0, 0, 0 }, 5, 1);
		options.depth = depth;
		truth_render_with(&t, &options, &img);
		for (uint32_t y = 0; y < SIZE; y += 7)
			for (uint32_t x = 0; x < SIZE; x += 7)
				ck_assert_float_eq_tol(truth_at(&img, "R", x, y), truth, 2e-3f);
		truth_check_closure(&img);
		image_free(&img);
		options = options_of(TRACER_DIFFUSE);
		truth_render_with(&t, &options, &img);
		ck_assert_float_eq_tol(truth_at(&img, "R", SIZE / 3, SIZE / 3), e + a * e, 2e-3f);
		ck_assert_float_eq_tol(truth_at(&img, "relight.R", SIZE / 3, SIZE / 3), a * e, 2e-3f);
		image_free(&img);
		made_free(&t);
	}
}
END_TEST

/* The same in linear light: GL's values are taken as display codes, and a mean of samples is a mean of light. */
START_TEST(test_glowing_ball_in_linear_light)
{
	const float e = 0.5f, a = 0.8f, e_lin = image_linear_from_display(e), a_lin = image_linear_from_display(a);

	for (unsigned depth = 0; depth < 6; depth += depth + 1)
		for (unsigned samples = 1; samples < 4; samples += 2) {
			struct tracer_options options = options_of(TRACER_PATH);
			const float truth = e_lin * (1 - powf(a_lin, (float)depth + 1)) / (1 - a_lin);
			struct made t;
			struct image img;
			uint32_t matte;

			made_init(&t, SIZE, SIZE, 1);
			matte = made_add_material(&t, a);
			glow(&t, matte, e);
			add_ball(&t, matte, (float[3]){ 0, 0, 0 }, 5, 1);
			options.depth = depth;
			options.samples = samples;
			options.display = 0;
			truth_render_with(&t, &options, &img);
			for (uint32_t y = 0; y < SIZE; y += 7)
				for (uint32_t x = 0; x < SIZE; x += 7)
					ck_assert_float_eq_tol(truth_at(&img, "R", x, y), truth, 2e-3f);
			truth_check_closure(&img);
			image_free(&img);
			made_free(&t);
		}
}
END_TEST

/*
 * A plane under a light, seen from above: under perpendicular light, linear light shows GL's colours; at an angle, the
 * cosine dims light instead of codes. A pixel that is half lit on average is half as bright, not half the code.
 */
START_TEST(test_light_falls_in_linear_light)
{
	struct tracer_options options = options_of(TRACER_PATH);
	const float h = 0.5f, albedo = 0.8f, edge = 2 * (SIZE / 2 + 0.5f) / SIZE - 1;
	struct made t;
	struct image img;
	uint32_t bright;

	options.display = 0;
	made_init(&t, SIZE, SIZE, 0);
	made_add_light(&t, 0, 0, -10 + h, 1);
	made_add_square(&t, made_add_material(&t, albedo), (float[3]){ 0, 0, -10 }, right, up, 1, 1);
	truth_render_with(&t, &options, &img);
	for (uint32_t x = 0; x < SIZE; x++) {
		const float px = 2 * ((float)x + 0.5f) / SIZE - 1, py = 1 - 2 * ((float)SIZE / 2 + 0.5f) / SIZE;
		const float truth = image_linear_from_display(albedo) * h / sqrtf(px * px + py * py + h * h);

		ck_assert_float_eq_tol(truth_at(&img, "R", x, SIZE / 2), truth, 2e-3f);
	}
	image_free(&img);
	made_free(&t);

	made_init(&t, SIZE, SIZE, 0);
	bright = made_add_material(&t, 0);
	glow(&t, bright, 1);
	made_add_square(&t, bright, (float[3]){ edge - 2, 0, -10 }, right, up, 2, 1);
	options.samples = 64;
	truth_render_with(&t, &options, &img);
	ck_assert_float_eq_tol(truth_at(&img, "R", SIZE / 2, SIZE / 3), 0.5f, 0.04f);
	image_free(&img);
	made_free(&t);
}
END_TEST

/* A pixel covered to 30 % by a vertical edge is 30 % bright on average; GL's own picture is still sampled at pixel
 * centres. */
START_TEST(test_samples)
{
	struct tracer_options options = options_of(TRACER_WHITTED);
	const float edge = 2 * (SIZE / 2 + 0.3f) / SIZE - 1; /* 30 % into the pixel right of the middle */
	struct made t;
	struct image one, many, again;
	uint32_t bright;

	made_init(&t, SIZE, SIZE, 0);
	bright = made_add_material(&t, 0);
	glow(&t, bright, 1);
	made_add_square(&t, bright, (float[3]){ edge - 2, 0, -10 }, right, up, 2, 1);
	truth_render_with(&t, &options, &one);
	options.samples = 64;
	truth_render_with(&t, &options, &many);
	truth_render_with(&t, &options, &again);
	for (uint32_t y = 0; y < SIZE; y++) {
		ck_assert_float_eq(truth_at(&one, "R", SIZE / 2, y), 0);
		ck_assert_float_eq_tol(truth_at(&many, "R", SIZE / 2, y), 0.3f, 0.03f);
		ck_assert_float_eq(truth_at(&many, "R", SIZE / 2 - 1, y), 1);
		ck_assert_float_eq(truth_at(&many, "R", SIZE / 2 + 1, y), 0);
	}
	for (size_t i = 0; i < one.n_channels; i++) {
		const float *a = image_channel(&many, one.channels[i].name), *b = image_channel(&again, one.channels[i].name);

		ck_assert_mem_eq(a, b, SIZE * SIZE * sizeof(float));
		if (one.channels[i].name[0] == 'g' || one.channels[i].name[0] == 'i')
			ck_assert_mem_eq(a, image_values(&one, i), SIZE * SIZE * sizeof(float));
	}
	truth_check_closure(&many);
	image_free(&one);
	image_free(&many);
	image_free(&again);
	made_free(&t);
}
END_TEST

/*
 * The same edge with four samples: pixels along it use different samples, so that a column shows all quarters about as
 * often as uniform samples would, and has the right mean; with the same offset everywhere, all pixels would be equal.
 */
START_TEST(test_samples_differ_from_pixel_to_pixel)
{
	struct tracer_options options = options_of(TRACER_WHITTED);
	const float edge = 2 * (SIZE / 2 + 0.4f) / SIZE - 1;
	uint32_t bright, seen[5] = { 0 }, kinds = 0;
	struct made t;
	struct image img;
	float mean = 0;

	made_init(&t, SIZE, SIZE, 0);
	bright = made_add_material(&t, 0);
	glow(&t, bright, 1);
	made_add_square(&t, bright, (float[3]){ edge - 2, 0, -10 }, right, up, 2, 1);
	options.samples = 4;
	truth_render_with(&t, &options, &img);
	for (uint32_t y = 0; y < SIZE; y++) {
		float share = truth_at(&img, "R", SIZE / 2, y);

		seen[(int)lrintf(4 * share)]++;
		ck_assert_float_eq_tol(share * 4, rintf(share * 4), 1e-3f);
		mean += share / SIZE;
	}
	for (int i = 0; i < 5; i++)
		kinds += seen[i] > 0;
	ck_assert_uint_ge(kinds, 2);
	ck_assert_float_eq_tol(mean, 0.4f * 0.75f, 0.15f); /* the sample at the centre misses it */
	image_free(&img);
	made_free(&t);
}
END_TEST

/* One square with a light close above: between its corners OpenGL shows none of it, Phong shading does. */
START_TEST(test_relight)
{
	struct tracer_options options = options_of(TRACER_WHITTED);
	const float h = 0.5f;
	struct made t;
	struct image img;
	uint32_t matte;

	made_init(&t, SIZE, SIZE, 0);
	made_add_light(&t, 0, 0, -10 + h, 1);
	matte = made_add_material(&t, 0.8f);
	made_add_square(&t, matte, (float[3]){ 0, 0, -10 }, right, up, 1, 1);
	options.relight = 1;
	truth_render_with(&t, &options, &img);
	for (uint32_t y = 0; y < SIZE; y++)
		for (uint32_t x = 0; x < SIZE; x++) {
			float px = 2 * ((float)x + 0.5f) / SIZE - 1, py = 1 - 2 * ((float)y + 0.5f) / SIZE;
			float truth = 0.8f * h / sqrtf(px * px + py * py + h * h), gl = 0.8f * h / sqrtf(2 + h * h);

			ck_assert_float_eq_tol(truth_at(&img, "R", x, y), truth, 1e-3f);
			ck_assert_float_eq_tol(truth_at(&img, "gl.R", x, y), gl, 1e-3f);
			ck_assert_float_eq_tol(truth_at(&img, "relight.R", x, y), truth - gl, 2e-3f);
		}
	truth_check_closure(&img);
	image_free(&img);
	made_free(&t);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("modes");

	tcase_set_timeout(tests, 180);
	tcase_add_test(tests, test_penumbra);
	tcase_add_test(tests, test_openness_under_disk);
	tcase_add_test(tests, test_white_furnace);
	tcase_add_test(tests, test_glowing_ball);
	tcase_add_test(tests, test_glowing_ball_in_linear_light);
	tcase_add_test(tests, test_light_falls_in_linear_light);
	tcase_add_test(tests, test_samples);
	tcase_add_test(tests, test_samples_differ_from_pixel_to_pixel);
	tcase_add_test(tests, test_relight);
	return run_case(tests, "modes");
}
