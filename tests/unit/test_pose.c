/* look/between/pose: fractions of motions against closed forms. */
#include <math.h>
#include <string.h>

#include "look/between/pose.h"
#include "look/draws/matrix.h"
#include "tests/case.h"

#define PI 3.14159265358979323846

/* A rotation about a line along y through (x, z), with a translation along it. */
static void screw(double out[16], double angle, double x, double z, double up)
{
	const double c = cos(angle), s = sin(angle);
	const double m[16] = { c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, x - c * x - s * z, up, z + s * x - c * z, 1 };

	memcpy(out, m, sizeof(m));
}

static void check_same(const double a[16], const double b[16])
{
	for (int i = 0; i < 16; i++)
		ck_assert_double_eq_tol(a[i], b[i], 1e-9);
}

START_TEST(test_a_screw_goes_on_evenly)
{
	for (int step = -99; step < 100; step++)
		for (int part = 0; part <= 4; part++) {
			double motion[16], wanted[16], found[16];

			screw(motion, PI * step / 100, 3, -2, 5);
			screw(wanted, PI * step / 100 * part / 4, 3, -2, 5 * part / 4.0);
			ck_assert(pose_part(found, motion, part / 4.0));
			check_same(found, wanted);
		}
}
END_TEST

START_TEST(test_slides_are_straight)
{
	double motion[16], found[16];

	memcpy(motion, matrix_identity, sizeof(motion));
	motion[12] = 8;
	motion[14] = -4;
	ck_assert(pose_part(found, motion, 0.25));
	motion[12] = 2;
	motion[14] = -1;
	check_same(found, motion);
}
END_TEST

/* Two successive parts make up the whole. */
START_TEST(test_rigid_parts_add_up)
{
	double a[16], b[16], motion[16], first[16], second[16], both[16];

	screw(a, 1.1, 2, 1, 0.5);
	screw(b, -0.7, 0, 4, 1);
	/* about x instead of y */
	for (int i = 0; i < 16; i++)
		motion[i] = b[(i / 4 < 3 ? (i / 4 + 1) % 3 : 3) * 4 + (i % 4 < 3 ? (i % 4 + 1) % 3 : 3)];
	matrix_mul(b, a, motion);
	ck_assert(pose_part(first, b, 0.3));
	ck_assert(pose_part(second, b, 0.7));
	matrix_mul(both, second, first);
	check_same(both, b);
}
END_TEST

START_TEST(test_stretching_ends_where_it_should)
{
	double motion[16], found[16], middle[4];
	const double still[4] = { 3, 2, -2, 1 };

	screw(motion, 0.8, 3, -2, 0);
	for (int i = 0; i < 12; i++)
		motion[i] *= i < 4 ? 1.5 : 0.75;
	ck_assert(pose_part(found, motion, 1));
	check_same(found, motion);
	/* scaling only: about the fixed point */
	memcpy(motion, matrix_identity, sizeof(motion));
	for (int k = 0; k < 3; k++) {
		motion[5 * k] = 2;
		motion[12 + k] = -still[k];
	}
	ck_assert(pose_part(found, motion, 0.5));
	matrix_transform(middle, found, still);
	for (int k = 0; k < 3; k++)
		ck_assert_double_eq_tol(middle[k], still[k], 1e-9);
	ck_assert_double_eq_tol(found[0], 1.5, 1e-9);
}
END_TEST

START_TEST(test_no_motion)
{
	double motion[16], out[16];

	memcpy(motion, matrix_identity, sizeof(motion));
	motion[10] = -1;
	ck_assert(!pose_part(out, motion, 0.5));
	motion[10] = 0;
	ck_assert(!pose_part(out, motion, 0.5));
	motion[10] = 1;
	motion[11] = 0.5;
	ck_assert(!pose_part(out, motion, 0.5));
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("pose");

	tcase_add_test(tcase, test_a_screw_goes_on_evenly);
	tcase_add_test(tcase, test_slides_are_straight);
	tcase_add_test(tcase, test_rigid_parts_add_up);
	tcase_add_test(tcase, test_stretching_ends_where_it_should);
	tcase_add_test(tcase, test_no_motion);
	return run_case(tcase, "pose");
}
