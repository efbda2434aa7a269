/* Rules (look/rules/rules.h): invalid files, matching, and the effect on a picture. */
#include <malloc.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/err.h"
#include "tests/case.h"
#include "tests/said.h"
#include "tests/truth/scenes.h"
#include "look/apply/apply.h"
#include "look/rules/rules.h"

#define SIZE 32

static char path[] = "/tmp/relume-look-XXXXXX", said[1000];

/* Load text as a file; messages are stored in `said`. */
static int load(const char *text, struct look **out)
{
	struct said reported;
	int err;

	said_write_file(path, text);
	reported = said_begin();
	err = rules_load(path, out);
	said_end(&reported, said, sizeof(said));
	return err;
}

START_TEST(test_wrong_files)
{
	static const struct { const char *text, *said; } wrong[] = {
		{ "surfaces:\n- reflect: 0.5\n  shiny: yes\n", "line 3" },
		{ "surfaces:\n- match: { mesh: abc }\n  reflect: much\n", "line 3" },
		{ "lights:\n- light: 0\n  position: [1, 2, 3]\n", "line 3" },
		{ "lamps:\n- light: 0\n", "line 1" },
		{ "surfaces:\n- reflect: 1.5\n", "reflect is 1.5" },
		{ "surfaces:\n- reflect: 0.6\n  transmit: 0.6\n", "add up to more than 1" },
		{ "surfaces:\n- match: { texture: wood }\n  reflect: 0.6\n", "wood" },
		{ "surfaces:\n- match: { draws: a-b }\n  reflect: 0.6\n", "a-b" },
		{ "lights:\n- radius: 0.2\n", "needs a position" },
		{ "lights:\n- light: 9\n  off: yes\n", "between 0 and 7" },
	};

	for (size_t i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++) {
		struct look *look = NULL;

		ck_assert_int_eq(load(wrong[i].text, &look), ERR_INPUT);
		ck_assert_ptr_null(look);
		ck_assert_msg(strstr(said, wrong[i].said), "case %zu: '%s' is not in: %s", i, wrong[i].said, said);
		ck_assert_ptr_nonnull(strstr(said, path));
		ck_assert_ptr_eq(strchr(said, '\n'), said + strlen(said) - 1); /* one line */
	}
}
END_TEST

/* Four squares with one draw each, and the draws' properties. */
static void make_squares(struct made *t, struct scene_draw *draws)
{
	static const float up[3] = { 0, 1, 0 }, right[3] = { 1, 0, 0 };
	uint32_t lit, plain;

	made_init(t, SIZE, SIZE, 0);
	made_add_light(t, 0, 0, 10, 0);
	lit = made_add_material(t, 0.5f);
	plain = made_add_material(t, 0.5f);
	t->materials[plain].lighting = t->materials[plain].light_count = 0;
	for (uint32_t i = 0; i < 4; i++) {
		made_add_square(t, i % 2 ? plain : lit, (float[3]){ i < 2 ? -0.5f : 0.5f, i % 2 ? -0.5f : 0.5f, -10 }, right,
		                 up, 0.5f, 1);
		t->meshes[i].hash[1] = (uint64_t)6 << 32 | i; /* named below */
		draws[i + 1] = (struct scene_draw){ .call = i < 2 ? "glCallList" : "glEnd", .call_number = i, .list = i < 2 ? 7 : 0 };
	}
	t->scene.draws = draws;
}

START_TEST(test_matches)
{
	static const struct { const char *match; unsigned bits; } cases[] = {
		{ "{ }", 15 }, { "{ draws: \"2-3\" }", 6 }, { "{ call: glEnd }", 12 }, { "{ list: 7 }", 3 },
		{ "{ lit: yes }", 5 }, { "{ lit: no, list: 7 }", 2 }, { "{ blended: yes }", 0 },
		{ "{ mesh: \"0000000600000002\" }", 4 }, { "{ textured: yes }", 0 }, { "{ depth_tested: yes }", 15 },
		{ "{ program: yes }", 0 }, { "{ alpha_tested: no }", 15 },
	};
	struct scene_draw draws[5];
	struct made t;

	make_squares(&t, draws);
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct look *look;
		struct scene changed;
		char text[200];

		snprintf(text, sizeof(text), "surfaces:\n- match: %s\n  reflect: 0.25\n  mirrors: no\n", cases[i].match);
		ck_assert_msg(load(text, &look) == 0, "%s", said);
		ck_assert_int_eq(look_apply(look, &t.scene, &changed, NULL), 0);
		for (uint32_t k = 0; k < 4; k++) {
			const struct scene_material *m = &changed.materials[changed.instances[k].material];

			ck_assert_msg((m->surface.reflect == 0.25f) == (cases[i].bits >> k & 1), "%s: square %u", cases[i].match, k);
			ck_assert_uint_eq(m->surface.hidden & SCENE_HIDDEN_FROM_MIRRORS,
			                  m->surface.reflect > 0 ? SCENE_HIDDEN_FROM_MIRRORS : 0u);
		}
		look_release(&changed);
		rules_free(&look);
	}
	made_free(&t);
}
END_TEST

/* A lightmap is replaced by OpenGL's own lights if no rule is about lights: each surface has room for a list of
 * them. */
START_TEST(test_lightmap_under_own_lights)
{
	struct scene_draw draws[5];
	struct look *look;
	struct scene changed;
	struct made t;

	make_squares(&t, draws);
	ck_assert_msg(load("surfaces:\n- match: { lit: yes }\n  lightmap: 1\n", &look) == 0, "%s", said);
	ck_assert_int_eq(look_apply(look, &t.scene, &changed, NULL), 0);
	ck_assert_uint_eq(changed.n_lights, t.scene.n_lights + 2);
	ck_assert_uint_ge(malloc_usable_size((void *)changed.lights) / sizeof(*changed.lights), changed.n_lights);
	look_release(&changed);
	rules_free(&look);
	made_free(&t);
}
END_TEST

/* The middle of each quadrant of the picture: lit above, unlit below. */
static float corner(const struct image *img, const char *channel, int square)
{
	return truth_at(img, channel, square < 2 ? SIZE / 4 : 3 * SIZE / 4, square % 2 ? 3 * SIZE / 4 : SIZE / 4);
}

static void render_under(const struct made *t, const char *text, struct image *img)
{
	struct tracer_options options = { .mode = TRACER_WHITTED, .display = 1, .depth = 4 };
	struct made changed = *t;
	struct look *look;

	ck_assert_msg(load(text, &look) == 0, "%s", said);
	ck_assert_int_eq(look_apply(look, &t->scene, &changed.scene, NULL), 0);
	truth_render_with(&changed, &options, img);
	truth_check_closure(img);
	look_release(&changed.scene);
	rules_free(&look);
}

/* Light from straight ahead: Lambert's cosine is 1. OpenGL's own picture is 0.5 above, and the white current colour
 * below. */
START_TEST(test_lights)
{
	struct scene_draw draws[5];
	struct made t;
	struct image img;

	make_squares(&t, draws);
	/* GL's light off, replaced by one of 0.4 that also lights surfaces GL does not light */
	render_under(&t, "surfaces:\n- match: { draws: \"2\" }\n  lit: yes\nlights:\n- light: 0\n  off: yes\n"
	             "- position: [0, 0, 1, 0]\n  diffuse: [0.4, 0.2, 0]\n", &img);
	for (int i = 0; i < 4; i++)
		ck_assert_float_eq_tol(corner(&img, "gl.R", i), i % 2 ? 1 : 0.5f, 1e-3f);
	ck_assert_float_eq_tol(corner(&img, "R", 0), 0.2f, 1e-3f);
	ck_assert_float_eq_tol(corner(&img, "G", 0), 0.1f, 1e-3f);
	ck_assert_float_eq_tol(corner(&img, "relight.R", 0), -0.3f, 1e-3f);
	ck_assert_float_eq_tol(corner(&img, "R", 1), 0.4f, 1e-3f);
	ck_assert_float_eq_tol(corner(&img, "B", 1), 0, 1e-3f);
	ck_assert_float_eq_tol(corner(&img, "R", 3), 1, 1e-3f); /* no rule, no light */
	image_free(&img);
	/* GL's light moved to an angle of 60 degrees */
	render_under(&t, "lights:\n- light: 0\n  position: [1.7320508, 0, 1, 0]\n", &img);
	ck_assert_float_eq_tol(corner(&img, "R", 0), 0.25f, 1e-3f);
	image_free(&img);
	/* emission in addition to GL's colours, in its own channel */
	render_under(&t, "surfaces:\n- emission: [0.125, 0, 0]\n", &img);
	ck_assert_float_eq_tol(corner(&img, "relight.R", 0), 0.125f, 1e-3f);
	ck_assert_float_eq_tol(corner(&img, "R", 2), 0.625f, 1e-3f);
	image_free(&img);
	made_free(&t);
}
END_TEST

/* A position in an object's space moves with the object. */
/* GL's light or an added one, from the side on a wall with a plate in front: the plate casts a shadow unless nothing
 * blocks the light. */
START_TEST(test_light_that_nothing_stops)
{
	static const float right[3] = { 1, 0, 0 }, up[3] = { 0, 1, 0 };
	struct made t;

	made_init(&t, SIZE, SIZE, 0);
	made_add_light(&t, 0.6f, 0, 1, 0);
	made_add_square(&t, made_add_material(&t, 0.5f), (float[3]){ 0, 0, -10 }, right, up, 1, 1);
	made_add_square(&t, 0, (float[3]){ 0, 0, -9 }, right, up, 0.2f, 1);
	for (int way = 0; way < 4; way++) {
		const char *const shadows = way & 1 ? "yes" : "no";
		char text[200];
		struct image img;
		int dark = 0;

		if (way & 2)
			snprintf(text, sizeof(text),
			         "lights:\n- light: 0\n  off: yes\n- position: [0.6, 0, 1, 0]\n  shadows: %s\n",
			         shadows);
		else
			snprintf(text, sizeof(text), "lights:\n- light: 0\n  shadows: %s\n", shadows);
		render_under(&t, text, &img);
		for (uint32_t i = 0; i < SIZE * SIZE; i++)
			dark += truth_at(&img, "R", i % SIZE, i / SIZE) < 0.2f;
		ck_assert_msg(way & 1 ? dark > 10 : dark == 0, "%s: %d pixels are in shadow", text, dark);
		image_free(&img);
	}
	made_free(&t);
}
END_TEST

START_TEST(test_light_of_an_object)
{
	struct scene_draw draws[5];
	struct made t;
	struct scene changed;
	struct look *look;
	const struct scene_light *light;

	make_squares(&t, draws);
	t.instances[2].modelview[12] = 3; /* moved by 3 along x */
	ck_assert_int_eq(load("lights:\n- position: [1, 2, 3, 1]\n  object: \"0000000600000002\"\n", &look), 0);
	ck_assert_int_eq(look_apply(look, &t.scene, &changed, NULL), 0);
	light = &changed.lights[changed.materials[changed.instances[0].material].surface.light_first + 1];
	ck_assert_float_eq(light->position_eye[0], 4);
	ck_assert_float_eq(light->position_eye[1], 2);
	look_release(&changed);
	rules_free(&look);
	made_free(&t);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("look");
	int failed, file = mkstemp(path);

	if (file < 0)
		return 1;
	close(file);
	tcase_set_timeout(tests, 60);
	tcase_add_test(tests, test_wrong_files);
	tcase_add_test(tests, test_matches);
	tcase_add_test(tests, test_lightmap_under_own_lights);
	tcase_add_test(tests, test_lights);
	tcase_add_test(tests, test_light_that_nothing_stops);
	tcase_add_test(tests, test_light_of_an_object);
	failed = run_case(tests, "look");
	unlink(path);
	return failed != 0;
}
