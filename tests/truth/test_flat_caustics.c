/* Light through flat mirrors and glass (tracer/frame/light/photons.h), in closed form. */
#include "tests/case.h"
#include "tests/truth/caustics.h"

/* A square off the wall's middle, displaced along `to`, with its normal n in the plane of x and z. */
static void add_square(struct made *t, uint32_t material, const double to[3], double distance, const double n[3],
                       float r)
{
	const float centre[3] = { (float)(to[0] * distance), (float)(to[1] * distance), (float)(WALL + to[2] * distance) };

	made_add_square(t, material, centre, (float[3]){ (float)n[2], 0, (float)-n[0] }, (float[3]){ 0, 1, 0 }, r, 4);
}

/* Photons on the wall against the true value at each place: total light within 1 %, and the root mean square error
 * of pixels. */
static void check_wall(struct made *t, double (*truth)(double x, double y), double noise)
{
	const struct tracer_options options = options_of(1u << 19);
	double sum = 0, all = 0, squares = 0;
	struct image img;

	truth_render_with(t, &options, &img);
	for (uint32_t y = 0; y < SIZE; y++)
		for (uint32_t x = 0; x < SIZE; x++) {
			const double is = (double)truth_at(&img, "caustics.G", x, y), ought = truth(wall_at(x), -wall_at(y));

			squares += (is / ought - 1) * (is / ought - 1);
			sum += is;
			all += ought;
		}
	ck_assert_double_eq_tol(sum, all, 0.01 * all);
	ck_assert_double_le(sqrt(squares / SIZE / SIZE), noise);
	truth_check_closure(&img);
	image_free(&img);
}

/* Parallel light straight through a plate: the light reflected at neither side, or twice inside (two refractions,
 * two reflections: depth 4). */
static double behind_plate(double x, double y)
{
	const double r = (IOR - 1) * (IOR - 1) / ((IOR + 1) * (IOR + 1));

	(void)x;
	(void)y;
	return ALBEDO * 0.8 * (1 - r) * (1 - r) * (1 + r * r);
}

START_TEST(test_plate)
{
	static const double to[3] = { 0.6, 0, 0.8 }, from[3] = { -0.6, 0, -0.8 };
	uint32_t glass;
	struct made t;

	begin(&t, 0.6f, 0, 0.8f, 0);
	glass = add_material(&t, 0, 1);
	add_square(&t, glass, to, 15.5, to, 6);
	add_square(&t, glass, to, 15, from, 6);
	check_wall(&t, behind_plate, 0.04);
	made_free(&t);
}
END_TEST

/*
 * A flat mirror creates a virtual light behind it, with the mirror's share of the light's strength, at the distance of
 * the whole path. The light falls with the square of the distance, from 1 at 50.
 */
static double by_mirror(double x, double y)
{
	const double light[3] = { 0.6 * 50, 0, 0.8 * 50 },
		     square = (light[0] - x) * (light[0] - x) + y * y + light[2] * light[2];

	return ALBEDO * 0.7 * 2500 / square * light[2] / sqrt(square);
}

START_TEST(test_mirror)
{
	/* from the wall's middle; from the mirror to the light */
	static const double to[3] = { 0.6, 0, 0.8 }, on[3] = { -0.8, 0, 0.6 };
	double n[3], light[3], size = 0;
	struct made t;

	for (int i = 0; i < 3; i++) {
		n[i] = on[i] - to[i];
		size += n[i] * n[i];
		light[i] = to[i] * 15 + on[i] * 35 + (i == 2 ? WALL : 0);
	}
	for (int i = 0; i < 3; i++)
		n[i] /= sqrt(size);
	begin(&t, (float)light[0], (float)light[1], (float)light[2], 1);
	t.lights[0].attenuation[0] = 0;
	t.lights[0].attenuation[2] = 1 / 2500.0f;
	add_square(&t, add_material(&t, 0.7f, 0), to, 15, n, 3);
	check_wall(&t, by_mirror, 0.1);
	made_free(&t);
}
END_TEST

/* Share of a unit disk on the side x < a. */
static double disk_part(double a)
{
	a = fmin(fmax(a, -1), 1);
	return 0.5 + (asin(a) + a * sqrt(1 - a * a)) / M_PI;
}

/*
 * The same mirror, but low, with a light of some size: there is a penumbra above and below, where part of the light is
 * visible in the mirror. Another mirror before it sends its light away: each has its own random numbers, and each
 * photon its own place on the light and direction.
 */
START_TEST(test_penumbra_of_a_mirror)
{
	static const double to[3] = { 0.6, 0, 0.8 }, on[3] = { -0.8, 0, 0.6 };
	const double half = 0.7, radius = 1.4, near = 15, far = 35;
	const float up[3] = { 0, (float)half / 3, 0 };
	const struct tracer_options options = options_of(1u << 19);
	double n[3], light[3], size = 0;
	uint32_t mirror;
	struct image img;
	struct made t;

	for (int i = 0; i < 3; i++) {
		n[i] = on[i] - to[i];
		size += n[i] * n[i];
		light[i] = to[i] * near + on[i] * far + (i == 2 ? WALL : 0);
	}
	for (int i = 0; i < 3; i++)
		n[i] /= sqrt(size);
	begin(&t, (float)light[0], (float)light[1], (float)light[2], 1);
	t.lights[0].radius = (float)radius;
	mirror = add_material(&t, 0.7f, 0);
	made_add_square(&t, mirror, (float[3]){ (float)light[0], 30, (float)light[2] }, (float[3]){ 0.7f, -0.7f, 0 },
	                (float[3]){ 0, 0, 1 }, 3, 1);
	made_add_square(&t, mirror, (float[3]){ (float)(to[0] * near), 0, (float)(WALL + to[2] * near) },
	                (float[3]){ (float)n[2], 0, (float)-n[0] }, up, 3, 4);
	truth_render_with(&t, &options, &img);
	for (uint32_t y = 0; y < SIZE; y++) {
		const double ought = disk_part((half - fabs(wall_at(y)) * far / (near + far)) / (radius * near / (near + far)));
		double is = 0, whole = 0;

		for (uint32_t x = 0; x < SIZE; x++) {
			is += (double)truth_at(&img, "caustics.G", x, y);
			whole += (double)truth_at(&img, "caustics.G", x, SIZE / 2);
		}
		ck_assert_double_eq_tol(is / whole, ought, 0.06); /* the penumbra is 10 rows; photons are gathered
		                                                     around each place */
	}
	image_free(&img);
	made_free(&t);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("flat caustics");

	tcase_set_timeout(tests, 180);
	tcase_add_test(tests, test_plate);
	tcase_add_test(tests, test_mirror);
	tcase_add_test(tests, test_penumbra_of_a_mirror);
	return run_case(tests, "flat caustics");
}
