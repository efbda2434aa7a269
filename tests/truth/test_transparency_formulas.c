/* Transmission of light through surfaces at known values: glass by Fresnel's equations and absorption, stipple;
 * kernels/frame/light/transparency.h. */
#include <math.h>
#include <string.h>

#include "kernels/frame/light/transparency.h"
#include "tests/case.h"

/* A triangle in the plane z = -4 that faces the eye; a ray hits its middle, from the front or from the back, with
 * four units per step. */
struct world {
	struct geometry geometry;
	struct scene_material material;
	struct shaded_vertex vertices[3];
	uint32_t indices[3], stipples[32];
	struct ray ray;
	struct hit hit;
	struct tables tables;
};

static void begin(struct world *w, int back)
{
	static const float corners[3][2] = { { 0, 0 }, { 3, 0 }, { 0, 3 } };

	memset(w, 0, sizeof(*w));
	for (uint32_t i = 0; i < 3; i++) {
		memcpy(w->vertices[i].eye, (float[4]){ corners[i][0], corners[i][1], -4, 1 }, 16);
		memcpy(w->vertices[i].clip, w->vertices[i].eye, 16);
		for (int side = 0; side < 2; side++)
			memcpy(w->vertices[i].color[side], (float[4]){ 0.25f, 1, 0.0625f, 1 }, 16);
		w->indices[i] = i;
	}
	w->material = (struct scene_material){
		.front_face = GL_CCW, .polygon_stipple = SCENE_NONE, .alpha_func = GL_ALWAYS, .shade_model = GL_SMOOTH
	};
	w->geometry.primitive_draw = w->geometry.crease = SCENE_NONE;
	w->ray = (struct ray){
		.o = { 1, 1, back ? -6 : 0 }, .d = { 0, 0, back ? 4 : -4 }, .t_min = back ? 0.25f : 0, .t_max = 10
	};
	w->hit = (struct hit){ .t = back ? 0.5f : 1, .b1 = 1 / 3.0f, .b2 = 1 / 3.0f };
	w->tables = (struct tables){ .geometries = &w->geometry,
		                     .materials = &w->material,
		                     .vertices = w->vertices,
		                     .indices = w->indices,
		                     .stipples = w->stipples };
}

static void check_passes(const struct world *w, float red, float green, float blue, const char *what)
{
	const struct vec3 have = transparency_of_hit(&w->tables, &w->hit, &w->ray, 1);

	ck_assert_msg(fabsf(have.x - red) < 1e-5f && fabsf(have.y - green) < 1e-5f && fabsf(have.z - blue) < 1e-5f,
	              "%s: %g %g %g, not %g %g %g", what, have.x, have.y, have.z, red, green, blue);
}

START_TEST(test_opaque)
{
	struct world w;

	begin(&w, 0);
	check_passes(&w, 0, 0, 0, "an opaque surface");
	w.material.surface.hidden = SCENE_HIDDEN_FROM_LIGHTS;
	check_passes(&w, 1, 1, 1, "one that lights do not see");
	begin(&w, 0);
	w.material.polygon_stipple = 0;
	for (int i = 0; i < 8; i++)
		w.stipples[4 * i] = 0xff00ff00u;
	check_passes(&w, 0.875f, 0.875f, 0.875f, "a stipple of an eighth");
}
END_TEST

/* Glass: the square root of its colour at each of two surfaces, times the share not reflected at normal incidence,
 * and on the way out times the body's transmission. */
START_TEST(test_glass)
{
	for (int back = 0; back < 2; back++) {
		const float through = 0.5f * 0.96f; /* ((1.5 - 1) / (1.5 + 1))^2 is reflected */
		struct world w;

		begin(&w, back);
		w.material.surface.transmit = 0.5f;
		w.material.surface.ior = 1.5f;
		check_passes(&w, 0.5f * through, through, 0.25f * through, back ? "glass from behind" : "glass");
		w.material.surface.absorb[1] = 2;
		check_passes(&w, 0.5f * through, back ? through * expf(-2) : through, 0.25f * through,
		             back ? "glass that absorbs, over a unit of length" : "glass on the way in");
		w.material.surface.ior = 0;
		w.material.surface.transmit = 3;
		check_passes(&w, 0.5f, back ? expf(-2) : 1, 0.25f, "completely transparent, without an index");
	}
}
END_TEST

/* Fresnel's equations: at normal incidence, at Brewster's angle, beyond the critical angle. */
START_TEST(test_fresnel)
{
	const float brewster = atanf(1.5f),
		    across = (cosf(brewster) - 1.5f * sinf(brewster)) / (cosf(brewster) + 1.5f * sinf(brewster));
	float beyond;

	ck_assert_float_eq_tol(glass_fresnel(1 / 1.5f, 1, &beyond), 0.04f, 1e-6f);
	ck_assert_float_eq_tol(beyond, 1, 1e-6f);
	ck_assert_float_eq_tol(glass_fresnel(1.5f, 1, &beyond), 0.04f, 1e-6f);
	ck_assert_float_eq_tol(glass_fresnel(1 / 1.5f, cosf(brewster), &beyond), 0.5f * across * across, 1e-6f);
	ck_assert_float_eq_tol(beyond, sinf(brewster), 1e-6f);
	ck_assert_float_eq_tol(glass_fresnel(1 / 1.5f, 0, &beyond), 1, 1e-6f);
	ck_assert_float_eq(glass_fresnel(1.5f, 0.7f, &beyond), 1);
	ck_assert_float_eq(beyond, 0);
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("transparency formulas");

	tcase_add_test(tcase, test_opaque);
	tcase_add_test(tcase, test_glass);
	tcase_add_test(tcase, test_fresnel);
	return run_case(tcase, "transparency formulas");
}
