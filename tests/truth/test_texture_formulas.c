/* Sampling of kernels/gl/texture.h at known values: wraps, levels and filters, elliptical footprints (GL 2.1 sec.
 * 3.8.7, 3.8.8). As in test_formulas. */
#include <math.h>
#include <string.h>

#include "kernels/gl/gauss.h"
#include "kernels/gl/stages.h"
#include "tests/case.h"

/* The nearest of four texels, for coordinates below, inside and beyond the image. */
START_TEST(test_wraps)
{
	enum { OUT = TEXTURE_OUTSIDE };
	static const float at[6] = { -0.3f, -0.1f, 0.1f, 0.6f, 1.1f, 1.7f };
	static const struct { uint32_t wrap, border; int wanted[6]; } rows[] = {
		{ GL_REPEAT, 0, { 2, 3, 0, 2, 0, 2 } }, { GL_MIRRORED_REPEAT, 0, { 1, 0, 0, 2, 3, 1 } },
		{ GL_CLAMP_TO_EDGE, 0, { 0, 0, 0, 2, 3, 3 } }, { GL_CLAMP, 0, { 0, 0, 0, 2, 3, 3 } },
		{ GL_CLAMP, 1, { 0, 0, 0, 2, 3, 3 } }, { GL_CLAMP_TO_BORDER, 0, { OUT, OUT, 0, 2, OUT, OUT } },
		{ GL_CLAMP_TO_BORDER, 1, { -1, -1, 0, 2, 4, 4 } }, { GL_MIRROR_CLAMP_TO_EDGE_EXT, 0, { 1, 0, 0, 2, 3, 3 } },
		{ GL_MIRROR_CLAMP_EXT, 0, { 1, 0, 0, 2, 3, 3 } }, { GL_MIRROR_CLAMP_TO_BORDER_EXT, 0, { 1, 0, 0, 2, OUT, OUT } },
	};

	for (size_t r = 0; r < sizeof(rows) / sizeof(rows[0]); r++)
		for (int i = 0; i < 6; i++)
			for (int normalized = 0; normalized < 2; normalized++) {
				int i0, i1;
				float weight;

				texture_wrap(rows[r].wrap, normalized ? at[i] : 4 * at[i], normalized, 4, rows[r].border, 0, &i0, &i1, &weight);
				ck_assert_msg(i0 == rows[r].wanted[i], "wrap %#x, border %u, at %g: %d, not %d",
				              rows[r].wrap, rows[r].border, at[i], i0, rows[r].wanted[i]);
			}
	for (int i = 0; i < 5; i++) { /* between two texels, weighted */
		static const struct {
			float s;
			int i0, i1;
			float weight;
		} linear[5] = { { 0.125f, 0, 1, 0 },
			        { 0.25f, 0, 1, 0.5f },
			        { 0.0625f, 3, 0, 0.75f },
			        { 0.9375f, 3, 0, 0.25f },
			        { 0.5f, 1, 2, 0.5f } };
		int i0, i1;
		float weight;

		texture_wrap(GL_REPEAT, linear[i].s, 1, 4, 0, 1, &i0, &i1, &weight);
		ck_assert(i0 == linear[i].i0 && i1 == linear[i].i1 && fabsf(weight - linear[i].weight) < 1e-6f);
	}
}
END_TEST

enum { SIDE = 8, LEVELS = 4, TEXELS = 64 + 16 + 4 + 1 };

struct world {
	uint32_t texels[TEXELS];
	struct texture_image image;
	struct scene_unit unit;
	struct tables tables;
};

/* Levels with 8, 4, 2 and 1 texels per side, each with a shade of its own. */
static void begin(struct world *w)
{
	memset(w, 0, sizeof(*w));
	w->image = (struct texture_image){ .target = GL_TEXTURE_2D,
		                           .base_format = GL_RGBA,
		                           .width = SIDE,
		                           .height = SIDE,
		                           .depth = 1,
		                           .n_levels = LEVELS,
		                           .words = 1,
		                           .level_first = { 0, 64, 80, 84 } };
	for (uint32_t i = 0; i < TEXELS; i++)
		w->texels[i] = 0x01010101u * (i < 64 ? 10u : i < 80 ? 60u : i < 84 ? 110u : 160u);
	w->unit = (struct scene_unit){
		.wrap_s = GL_CLAMP_TO_EDGE, .wrap_t = GL_CLAMP_TO_EDGE, .wrap_r = GL_CLAMP_TO_EDGE, .mag_filter = GL_LINEAR,
		.min_filter = GL_LINEAR, .min_lod = -1000, .max_lod = 1000, .max_anisotropy = 1
	};
	w->tables = (struct tables){ .texels = w->texels, .textures = &w->image };
}

static float shade(const struct world *w, const struct texture_slope *slope, float s, float t)
{
	return texture_sample(&w->tables, &w->unit, v4(s, t, 0, 1), slope).x * 255;
}

/* The level as a function of slopes, filter and anisotropy. */
START_TEST(test_levels)
{
	static const struct { uint32_t filter; float lod, anisotropy, wanted; } rows[] = {
		{ GL_LINEAR, 1.5f, 1, 10 }, { GL_NEAREST, 1.5f, 1, 10 }, { GL_NEAREST_MIPMAP_NEAREST, 1.25f, 1, 60 },
		{ GL_NEAREST_MIPMAP_NEAREST, 1.75f, 1, 110 }, { GL_LINEAR_MIPMAP_NEAREST, 2.75f, 1, 160 },
		{ GL_LINEAR_MIPMAP_NEAREST, 9, 1, 160 }, { GL_NEAREST_MIPMAP_LINEAR, 1.5f, 1, 85 },
		{ GL_LINEAR_MIPMAP_LINEAR, 0.5f, 1, 35 }, { GL_LINEAR_MIPMAP_LINEAR, 5, 1, 160 },
		{ GL_LINEAR_MIPMAP_LINEAR, -2, 1, 10 }, { GL_NEAREST_MIPMAP_NEAREST, -2, 1, 10 },
		/* elongated footprint: the level is that of its short side, one level if an ellipse is averaged */
		{ GL_LINEAR, 3, 4, 10 }, { GL_LINEAR_MIPMAP_NEAREST, 3, 4, 60 }, { GL_LINEAR_MIPMAP_LINEAR, 3, 4, 60 },
		{ GL_LINEAR_MIPMAP_LINEAR, 3, 2, 110 }, { GL_NEAREST, 3, 4, 10 },
	};

	for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
		struct texture_slope slope = { .right = { 0, 0, 0, 0 }, .down = { 0, 0, 0, 0 } };
		struct world w;
		float have;

		begin(&w);
		w.unit.min_filter = rows[i].filter;
		w.unit.max_anisotropy = rows[i].anisotropy;
		/* llvmpipe's logarithm is linear between powers of its square */
		slope.right.x = rows[i].anisotropy > 1 ? exp2f(rows[i].lod) :
		                                         sqrtf(exp2f(floorf(2 * rows[i].lod)) *
		                                               (1 + 2 * rows[i].lod - floorf(2 * rows[i].lod)));
		slope.down.y = rows[i].anisotropy > 1 ? exp2f(rows[i].lod) / 4 : 0;
		have = shade(&w, &slope, 0.4f, 0.6f);
		ck_assert_msg(fabsf(have - rows[i].wanted) < 0.51f, "row %zu: %g, not %g", i, have, rows[i].wanted);
	}
}
END_TEST

/* An ellipse of texels under a Gaussian, summed here by Heckbert's method. */
START_TEST(test_ellipses)
{
	static const float slopes[][4] = {
		{ 4, 0, 0, 1 }, { 0, 4, 1, 0 }, { 3, 2, -0.5f, 0.75f }, { 0.5f, 0.25f, 3, -3 }, { 1, 0, 0, 1 }
	};

	for (size_t i = 0; i < sizeof(slopes) / sizeof(slopes[0]); i++) {
		const double ux = slopes[i][0], vx = slopes[i][1], uy = slopes[i][2], vy = slopes[i][3];
		const double a = vx * vx + vy * vy + 1, b = -2 * (ux * vx + uy * vy), c = ux * ux + uy * uy + 1,
			     f = a * c - b * b / 4;
		const struct texture_slope slope = { { (float)ux, (float)vx, 0, 0 }, { (float)uy, (float)vy, 0, 0 } };
		double sum = 0, weights = 0;
		struct world w;

		begin(&w);
		w.unit.max_anisotropy = 16;
		for (uint32_t k = 0; k < 64; k++)
			w.texels[k] = 0x01010101u * (k * 37 % 251);
		for (int y = -SIDE; y < 2 * SIDE; y++) /* edge texels continue outside */
			for (int x = -SIDE; x < 2 * SIDE; x++) {
				const double u = x + 0.5 - 0.4 * SIDE, v = y + 0.5 - 0.6 * SIDE, q = (a * u * u + b * u * v + c * v * v) / f;

				if (q < 1) {
					const int column = x < 0 ? 0 : x < SIDE ? x : SIDE - 1, row = y < 0 ? 0 : y < SIDE ? y : SIDE - 1;

					sum += exp(-2 * q) * (w.texels[row * SIDE + column] & 255);
					weights += exp(-2 * q);
				}
			}
		ck_assert_msg(fabs(shade(&w, &slope, 0.4f, 0.6f) - sum / weights) < 0.25, "ellipse %zu: %g, not %g", i,
		              shade(&w, &slope, 0.4f, 0.6f), sum / weights);
	}
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("texture formulas");

	tcase_add_test(tcase, test_wraps);
	tcase_add_test(tcase, test_levels);
	tcase_add_test(tcase, test_ellipses);
	return run_case(tcase, "texture formulas");
}
