/*
 * A glass ball's light (tracer/frame/light/photons.h) against a path tracer for this one scene, which works backwards
 * from the wall with formulas instead of triangles. RELUME_CAUSTICS_SAMPLES sets its number of paths per pixel.
 */
#include "tests/case.h"
#include "tests/truth/caustics.h"

/*
 * Out of view, between the wall's middle and a light, a disk facing the ball: photons start there uniformly, and each
 * point of it emits the same in all directions.
 */
static const double ball[3] = { 3, 0, WALL + 3 }, lamp[3] = { 12, 0, WALL + 12 };
#define BALL 0.8
#define LAMP 0.5
#define BLOCK 4 /* pixels */

struct way {
	double at[3], d[3];
};

static double dot(const double a[3], const double b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* A number in [0,1) (G. Marsaglia's xorshift, 2003). */
static double chance(uint64_t *state)
{
	*state ^= *state << 13;
	*state ^= *state >> 7;
	*state ^= *state << 17;
	return (double)(*state >> 11) * 0x1p-53;
}

/* Distance along a path to the ball's surface, beyond a minimum; negative if it is missed. */
static double ball_along(const struct way *w)
{
	const double off[3] = { w->at[0] - ball[0], w->at[1] - ball[1], w->at[2] - ball[2] };
	const double b = dot(off, w->d), root = b * b - dot(off, off) + BALL * BALL;

	if (root < 0)
		return -1;
	return -b - sqrt(root) > 1e-9 ? -b - sqrt(root) : -b + sqrt(root) > 1e-9 ? -b + sqrt(root) : -1;
}

/* Reflect or refract at the ball's surface, with the probabilities of Fresnel's equations for unpolarised light. */
static void bend(struct way *w, uint64_t *state)
{
	double n[3], cosine, eta = 1 / IOR, beyond, across, along, share = 1;

	for (int i = 0; i < 3; i++)
		n[i] = (w->at[i] - ball[i]) / BALL;
	cosine = -dot(n, w->d);
	if (cosine < 0) { /* leaving the ball */
		eta = IOR;
		cosine = -cosine;
		for (int i = 0; i < 3; i++)
			n[i] = -n[i];
	}
	beyond = 1 - eta * eta * (1 - cosine * cosine);
	if (beyond > 0) {
		beyond = sqrt(beyond);
		across = (eta * cosine - beyond) / (eta * cosine + beyond);
		along = (cosine - eta * beyond) / (cosine + eta * beyond);
		share = (across * across + along * along) / 2;
	}
	if (chance(state) < share)
		for (int i = 0; i < 3; i++)
			w->d[i] += 2 * cosine * n[i];
	else
		for (int i = 0; i < 3; i++)
			w->d[i] = eta * w->d[i] + (eta * cosine - beyond) * n[i];
}

/* Contribution of one path from a point of the wall to the lamp, relative to its disk's brightness: 1 over the
 * cosine there, or 0. */
static double follow(struct way w, uint64_t *state)
{
	double axis[3], size, toward, t, off = 0;
	int bends = 0;

	for (;; bends++) {
		const double along = ball_along(&w);

		if (along < 0)
			break;
		if (bends == 4)
			return 0;
		for (int i = 0; i < 3; i++)
			w.at[i] += along * w.d[i];
		bend(&w, state);
	}
	if (bends == 0)
		return 0;
	for (int i = 0; i < 3; i++)
		axis[i] = ball[i] - lamp[i];
	size = sqrt(dot(axis, axis));
	toward = -dot(w.d, axis) / size;
	if (toward <= 1e-6)
		return 0;
	t = 0;
	for (int i = 0; i < 3; i++)
		t -= (lamp[i] - w.at[i]) * axis[i] / size;
	t /= toward;
	for (int i = 0; i < 3; i++) {
		const double x = w.at[i] + t * w.d[i] - lamp[i];

		off += x * x;
	}
	return t > 0 && off < LAMP * LAMP ? 1 / toward : 0;
}

/* Light that reaches a point of the wall: paths distributed uniformly over the cone around the ball. The lamp's
 * power: 1 at 17, falling with the square. */
static double by_ball(double x, double y, unsigned samples, uint64_t *state)
{
	const double axis[3] = { ball[0] - x, ball[1] - y, ball[2] - WALL }, distance = sqrt(dot(axis, axis));
	const double least = sqrt(1 - BALL * BALL / (distance * distance)), solid = 2 * M_PI * (1 - least);
	const double z[3] = { axis[0] / distance, axis[1] / distance, axis[2] / distance },
		     size = sqrt(z[0] * z[0] + z[2] * z[2]);
	const double u[3] = { z[2] / size, 0, -z[0] / size }, v[3] = { z[1] * u[2], z[2] * u[0] - z[0] * u[2], -z[1] * u[0] };
	double sum = 0;

	for (unsigned i = 0; i < samples; i++) {
		const double cosine = 1 - ((double)i + chance(state)) / samples * (1 - least), sine = sqrt(1 - cosine * cosine);
		const double angle = 2 * M_PI * chance(state);
		struct way w = { .at = { x, y, WALL } };

		for (int k = 0; k < 3; k++)
			w.d[k] = cosine * z[k] + sine * (cos(angle) * u[k] + sin(angle) * v[k]);
		sum += w.d[2] > 0 ? w.d[2] * follow(w, state) : 0;
	}
	return ALBEDO * sum / samples * solid * 17 * 17 / (M_PI * LAMP * LAMP);
}

static void check_ball(struct made *t, unsigned photons, const double (*ought)[SIZE], unsigned samples)
{
	const struct tracer_options options = options_of(photons);
	double sum = 0, all = 0, off = 0, off_blocks = 0, block[SIZE / BLOCK][SIZE / BLOCK] = { { 0 } };
	struct image img;

	truth_render_with(t, &options, &img);
	for (uint32_t y = 0; y < SIZE; y++)
		for (uint32_t x = 0; x < SIZE; x++) {
			const double is = (double)truth_at(&img, "caustics.G", x, y);

			sum += is;
			all += ought[y][x];
			off += fabs(is - ought[y][x]);
			block[y / BLOCK][x / BLOCK] += is - ought[y][x];
		}
	for (int i = 0; i < SIZE / BLOCK * (SIZE / BLOCK); i++)
		off_blocks += fabs(block[i / (SIZE / BLOCK)][i % (SIZE / BLOCK)]);
	printf("a glass ball's caustic, %u photons, against %u paths per pixel: energy %+.2f %%; mean error: pixels "
	       "%.2f %%, blocks of %d x %d %.2f %%\n",
	       photons, samples, 100 * (sum / all - 1), 100 * off / all, BLOCK, BLOCK, 100 * off_blocks / all);
	fflush(stdout);
	ck_assert_double_eq_tol(sum, all, 0.01 * all);
	ck_assert_double_le(off_blocks, 0.06 * all);
	image_free(&img);
}

START_TEST(test_ball)
{
	const char *asked = getenv("RELUME_CAUSTICS_SAMPLES");
	const unsigned samples = asked ? (unsigned)atoi(asked) : 16384;
	static double ought[SIZE][SIZE];
	uint64_t state = 88172645463325252u;
	struct made t;

	for (uint32_t y = 0; y < SIZE; y++)
		for (uint32_t x = 0; x < SIZE; x++)
			ought[y][x] = by_ball(wall_at(x), -wall_at(y), samples, &state);
	begin(&t, (float)lamp[0], (float)lamp[1], (float)lamp[2], 1);
	t.lights[0].attenuation[0] = 0;
	t.lights[0].attenuation[2] = 1 / (17 * 17.0f);
	t.lights[0].radius = (float)LAMP;
	made_add_ball(&t, add_material(&t, 0, 1), (float[3]){ (float)ball[0], (float)ball[1], (float)ball[2] },
	              (float)BALL, 128, 0);
	for (unsigned photons = 1u << 20; photons <= (asked ? 1u << 23 : 1u << 20); photons *= 8)
		check_ball(&t, photons, (const double (*)[SIZE])ought, samples);
	made_free(&t);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("caustics");

	tcase_set_timeout(tests, 180);
	tcase_add_test(tests, test_ball);
	return run_case(tests, "caustics");
}
