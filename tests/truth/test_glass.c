/*
 * Glass in closed form: Snell's law through a slab that displaces the scene behind it, Fresnel's weights at one
 * boundary, total reflection, Beer's law; and shadows of transparent objects.
 */
#include <math.h>
#include <stdlib.h>

#include "tests/case.h"
#include "tests/truth/scenes.h"

#define SIZE 128

static const float up[3] = { 0, 1, 0 };

/* A purely emissive material. */
static uint32_t add_glow(struct made *t, float emission)
{
	uint32_t m = made_add_material(t, 0);

	for (int c = 0; c < 3; c++)
		t->materials[m].front.emission[c] = t->materials[m].back.emission[c] = emission;
	return m;
}

static uint32_t add_glass(struct made *t, float ior)
{
	uint32_t m = made_add_material(t, 1);

	t->materials[m].surface.transmit = 1;
	t->materials[m].surface.ior = ior;
	return m;
}

/* A square at `centre`, rotated by `angle` about the vertical; its front faces the viewer, or away from them. */
static void add_pane(struct made *t, uint32_t material, const float centre[3], float angle, int away)
{
	float across[3] = { cosf(angle), 0, sinf(angle) }, down[3] = { 0, -1, 0 };

	made_add_square(t, material, centre, across, away ? down : up, 6, 1);
}

static float fresnel(float n1, float n2, float angle)
{
	float ci = cosf(angle), s = n1 / n2 * sinf(angle), ct, across, along;

	if (s >= 1)
		return 1;
	ct = sqrtf(1 - s * s);
	across = (n1 * ci - n2 * ct) / (n1 * ci + n2 * ct);
	along = (n1 * ct - n2 * ci) / (n1 * ct + n2 * ci);
	return (across * across + along * along) / 2;
}

/* Position of the border between a bright left and a dark right half of the picture, in view units. */
static float border(const struct image *img)
{
	uint32_t x = 0;

	while (x < SIZE && truth_at(img, "R", x, SIZE / 2) > 0.4f)
		x++;
	return 2 * (float)x / SIZE - 1;
}

/* A slab of thickness d, rotated by a, displaces a ray by d sin(a - b) / cos(b), sin(b) = sin(a) / n. */
START_TEST(test_snell)
{
	static const float angles_deg[] = { 0, 20, 35, 50, 65 }, iors[] = { 1, 1.33f, 1.5f, 2.4f };

	for (int i = 0; i < 5; i++)
		for (int k = 0; k < 4; k++) {
			float a = angles_deg[i] * 0.0174532925f, b = asinf(sinf(a) / iors[k]), d = 0.8f;
			float half[3] = { -d / 2 * sinf(a), 0, d / 2 * cosf(a) }; /* from the middle to the front, along its normal */
			float moved = d * sinf(a - b) / cosf(b);
			struct made t;
			struct image img;
			uint32_t glass, bright;

			made_init(&t, SIZE, SIZE, 0);
			bright = add_glow(&t, 1);
			glass = add_glass(&t, iors[k]);
			made_add_square(&t, bright, (float[3]){ -4, 0, -30 }, (float[3]){ 1, 0, 0 }, up, 4, 1);
			add_pane(&t, glass, (float[3]){ half[0], half[1], -10 + half[2] }, a, 0);
			add_pane(&t, glass, (float[3]){ -half[0], -half[1], -10 - half[2] }, a, 1);
			truth_render(&t, "whitted", &img);
			/*
			 * rotated to face left: inside, light bends towards the normal, and leaves displaced to the
			 * right
			 */
			ck_assert_float_eq_tol(border(&img), -moved, 1.5f * 2 / SIZE);
			truth_check_closure(&img);
			image_free(&img);
			made_free(&t);
		}
}
END_TEST

/* One boundary in front of an emissive wall, seen from either side: 1 - F is transmitted, and nothing past the
 * critical angle. */
START_TEST(test_fresnel)
{
	for (int i = 0; i < 2; i++)
		for (float deg = 0; deg < 80; deg += 9) {
			float a = deg * 0.0174532925f, n1 = i ? 1.5f : 1, n2 = i ? 1 : 1.5f, f = fresnel(n1, n2, a);
			struct made t;
			struct image img;
			uint32_t glass, bright;

			made_init(&t, SIZE, SIZE, 0);
			bright = add_glow(&t, 1);
			glass = add_glass(&t, 1.5f);
			made_add_square(&t, bright, (float[3]){ 0, 0, -90 }, (float[3]){ 1, 0, 0 }, up, 89, 1);
			add_pane(&t, glass, (float[3]){ 0, 0, -10 }, a, i);
			truth_render(&t, "whitted", &img);
			if (f < 1) /* all refracted rays hit the wall */
				ck_assert_float_eq_tol(truth_at(&img, "refract.R", SIZE / 2, SIZE / 2), 1 - f, 2e-3f);
			else
				ck_assert_float_eq(truth_at(&img, "refract.R", SIZE / 2, SIZE / 2), 0);
			truth_check_closure(&img);
			image_free(&img);
			made_free(&t);
		}
}
END_TEST

/* Past the critical angle, a boundary is a perfect mirror from inside. */
START_TEST(test_total_reflection)
{
	const float a = 0.7853981634f; /* 45 degrees: beyond asin(1 / 1.5) */
	struct made t;
	struct image img;
	uint32_t glass, bright;

	made_init(&t, SIZE, SIZE, 0);
	bright = add_glow(&t, 0.7f);
	glass = add_glass(&t, 1.5f);
	/* the pane reflects -z to -x */
	made_add_square(&t, bright, (float[3]){ -20, 0, -10 }, (float[3]){ 0, 0, -1 }, up, 15, 1);
	add_pane(&t, glass, (float[3]){ 0, 0, -10 }, a, 1);
	truth_render(&t, "whitted", &img);
	ck_assert_float_eq_tol(truth_at(&img, "reflect.R", SIZE / 2, SIZE / 2), 0.7f, 1e-3f);
	ck_assert_float_eq(truth_at(&img, "refract.R", SIZE / 2, SIZE / 2), 0);
	truth_check_closure(&img);
	image_free(&img);
	made_free(&t);
}
END_TEST

/* A slab across the view: (1 - F)^2 exp(-absorb x thickness), and the light reflected inside. At any scale. */
START_TEST(test_beer)
{
	static const float scales[] = { 1e-3f, 1, 1e3f };
	const float f = fresnel(1, 1.5f, 0), absorb = 0.9f, d = 0.7f;

	for (int i = 0; i < 3; i++) {
		const float s = scales[i], one = expf(-absorb * d);
		float truth = (1 - f) * (1 - f) * one;
		struct made t;
		struct image img;
		uint32_t glass, bright;

		made_init(&t, SIZE, SIZE, 0.1f);
		t.view.projection[14] *= s; /* near and far move with the scene */
		bright = add_glow(&t, 1);
		glass = add_glass(&t, 1.5f);
		for (int c = 0; c < 3; c++)
			t.materials[glass].surface.absorb[c] = c == 1 ? 0 : absorb / s;
		made_add_square(&t, bright, (float[3]){ 0, 0, -30 * s }, (float[3]){ 1, 0, 0 }, up, 10 * s, 1);
		made_add_square(&t, glass, (float[3]){ 0, 0, -10 * s }, (float[3]){ 1, 0, 0 }, up, 3 * s, 1);
		made_add_square(&t, glass, (float[3]){ 0, 0, (-10 - d) * s }, (float[3]){ 1, 0, 0 },
		                 (float[3]){ 0, -1, 0 }, 3 * s, 1);
		truth_render(&t, "whitted", &img);
		for (uint32_t y = 0; y < SIZE; y++)
			for (uint32_t x = 0; x < SIZE; x++) {
				ck_assert_float_eq_tol(truth_at(&img, "R", x, y), truth, 3e-3f);
				ck_assert_float_eq_tol(truth_at(&img, "G", x, y), (1 - f) * (1 - f), 3e-3f);
			}
		image_free(&img);
		made_free(&t);
	}
}
END_TEST

/* Light transmitted through a caster above a floor, seen from below: material -> shadow.R, shadow.G. */
static void check_shadow(void (*change)(struct scene_material *m), float red, float green)
{
	struct made t;
	struct image img;
	uint32_t floor, caster;

	made_init(&t, SIZE, SIZE, 0);
	made_add_light(&t, 0, 0, 50, 1);
	floor = made_add_material(&t, 1);
	caster = made_add_material(&t, 1);
	change(&t.materials[caster]);
	made_add_square(&t, floor, (float[3]){ 0, 0, -10 }, (float[3]){ 1, 0, 0 }, up, 3, 1);
	/* nearer than the viewer's near plane: invisible, but in the light's path */
	made_add_square(&t, caster, (float[3]){ 0, 0, 10 }, (float[3]){ 1, 0, 0 }, up, 5, 1);
	truth_render(&t, "whitted", &img);
	ck_assert_float_eq_tol(truth_at(&img, "shadow.R", SIZE / 2, SIZE / 2), red, 2e-3f);
	ck_assert_float_eq_tol(truth_at(&img, "shadow.G", SIZE / 2, SIZE / 2), green, 2e-3f);
	truth_check_closure(&img);
	image_free(&img);
	made_free(&t);
}

static void change_nothing(struct scene_material *m) { (void)m; }

static void change_blended(struct scene_material *m)
{
	m->front.diffuse[3] = m->back.diffuse[3] = 0.3f;
	m->blend = 1;
	m->blend_src_rgb = m->blend_src_alpha = GL_SRC_ALPHA;
	m->blend_dst_rgb = m->blend_dst_alpha = GL_ONE_MINUS_SRC_ALPHA;
}

static void change_film(struct scene_material *m)
{
	change_blended(m);
	m->depth_write = 0;
}

/*
 * Multiplicative blending: GL tints the background with the film's colour. Unlit, so that the current colour is used.
 */
static void change_filter(struct scene_material *m)
{
	m->lighting = 1;
	m->front.emission[0] = 0.25f;
	m->front.emission[1] = 0.75f;
	m->light_count = 0;
	m->blend = 1;
	m->blend_src_rgb = m->blend_src_alpha = GL_ZERO;
	m->blend_dst_rgb = m->blend_dst_alpha = GL_SRC_COLOR;
}

static void change_hole(struct scene_material *m)
{
	m->front.diffuse[3] = m->back.diffuse[3] = 0.2f;
	m->alpha_test = 1;
	m->alpha_func = GL_GREATER;
	m->alpha_ref = 0.5f;
}

static void change_solid(struct scene_material *m)
{
	change_hole(m);
	m->front.diffuse[3] = m->back.diffuse[3] = 0.9f;
}

static void change_glass(struct scene_material *m)
{
	m->surface.transmit = 0.8f;
	m->surface.ior = 1.5f;
	m->front.diffuse[1] = m->back.diffuse[1] = 0.25f;
}

static void change_hidden(struct scene_material *m)
{
	m->surface.hidden = 1;
}

START_TEST(test_shadows_of_what_lets_light_through)
{
	float through = 0.8f * (1 - fresnel(1, 1.5f, 0));

	check_shadow(change_nothing, 0, 0);
	check_shadow(change_blended, 0.7f, 0.7f);
	check_shadow(change_film, 1, 1);
	check_shadow(change_filter, 0.25f, 0.75f);
	check_shadow(change_hole, 1, 1);
	check_shadow(change_solid, 0, 0);
	check_shadow(change_glass, through, through * 0.5f); /* a quarter after both surfaces of a body: half at each */
	check_shadow(change_hidden, 1, 1);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("glass");

	tcase_set_timeout(tests, 120);
	tcase_add_test(tests, test_snell);
	tcase_add_test(tests, test_fresnel);
	tcase_add_test(tests, test_total_reflection);
	tcase_add_test(tests, test_beer);
	tcase_add_test(tests, test_shadows_of_what_lets_light_through);
	return run_case(tests, "glass");
}
