/* Numbers of finished pictures: halves as OpenEXR rounds them, sRGB's curve as computed by the C library. */
#define IMATH_HALF_NO_LOOKUP_TABLE
#include <half.h>
#include <math.h>

#include "kernels/frame/stages/compose.h"
#include "tests/case.h"
#include "tracer/image/image.h"

START_TEST(test_halves)
{
	for (uint64_t bits = 0; bits < 1ull << 32; bits += 1999) {
		float x = common_float((uint32_t)bits);
		uint16_t ours = (uint16_t)compose_half(x), theirs = imath_float_to_half(x);

		if (isnan(x)) {
			ck_assert(isnan(imath_half_to_float(ours)));
			continue;
		}
		/* infinite from 65520 on; both conversions always agree */
		ck_assert_msg(ours == theirs, "%a: %04x, not %04x", (double)x, ours, theirs);
		if (fabsf(x) <= 65504)
			ck_assert_float_eq(compose_rounded(x), imath_half_to_float(theirs));
	}
}
END_TEST

START_TEST(test_linear)
{
	for (uint32_t bits = 0; bits < 0x42000000u; bits += 3011) { /* up to 32 */
		float x = common_float(bits), want = image_linear_from_display(x), got = encode_linear(x);

		ck_assert_msg(fabsf(got - want) <= 1e-6f * want + 1e-40f, "%a: %a, not %a", (double)x, (double)got, (double)want);
		ck_assert_float_eq(encode_linear(-x), -got);
	}
	ck_assert_float_eq(encode_linear(0), 0);
	for (float x = 1e-9f; x < 1e9f; x *= 1.37f) {
		const float want = image_display_from_linear(x), got = encode_display(x);

		ck_assert_float_eq_tol(got, want, 3e-6f * want);
		ck_assert_float_eq_tol(encode_linear(got), x, 1e-5f * x);
		ck_assert_float_eq(encode_display(-x), -got);
	}
	ck_assert_float_eq(encode_display(0), 0);
	ck_assert_float_eq_tol(encode_linear(1), 1, 1e-6f);
	ck_assert(compose_half(encode_linear(INFINITY)) == 0x7c00);
}
END_TEST

/* Display codes survive the conversion to and from linear light, however close they are to a rounding border. */
START_TEST(test_codes)
{
	for (int code = 0; code < 255; code++)
		for (int i = -40; i <= 40; i++) {
			float gl = ((float)code + 0.5f + 0.002f * (float)i) / 255.0f, want = rintf(gl * 255.0f),
			      settled = compose_nudged(gl);
			float linear = compose_rounded(encode_linear(settled)), plain = compose_rounded(settled);

			ck_assert_float_eq(rintf(image_display_from_linear(linear) * 255.0f), want);
			ck_assert_float_eq(rintf(plain * 255.0f), want);
			ck_assert_float_le(fabsf(settled - gl), 0.08f / 255.0f);
		}
	ck_assert_float_eq(compose_nudged(0.25f), 0.25f);
	ck_assert_float_eq(compose_nudged(1.5f), 1.5f);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("compose");

	tcase_set_timeout(tests, 60);
	tcase_add_test(tests, test_halves);
	tcase_add_test(tests, test_linear);
	tcase_add_test(tests, test_codes);
	return run_case(tests, "compose");
}
