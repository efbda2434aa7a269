/* Objects spared as light blockers (look/spare/spare.h), and others that are not: the share of a surface in shadow. */
#include "base/err.h"
#include "look/apply/apply.h"
#include "look/rules/rules.h"
#include "tests/case.h"
#include "tests/truth/scenes.h"

#define SIZE 64

static const float x_axis[3] = { 1, 0, 0 }, y_axis[3] = { 0, 1, 0 }, z_axis[3] = { 0, 0, 1 };
static const float minus_x[3] = { -1, 0, 0 }, minus_z[3] = { 0, 0, -1 };

/* The share of draw 1's lit pixels that are in shadow. rules: NULL: none */
static float dark_share(struct made *t, const char *rules)
{
	struct look *look = NULL;
	struct scene changed, *kept = malloc(sizeof(*kept));
	struct image img;
	float dark = 0, all = 0;

	ck_assert_ptr_nonnull(kept);
	*kept = t->scene;
	if (rules)
		ck_assert_int_eq(rules_parse("rules", rules, strlen(rules), &look), 0);
	ck_assert_int_eq(look_apply(look, kept, &changed, NULL), 0);
	t->scene = changed;
	truth_render(t, "whitted", &img);
	t->scene = *kept;
	for (uint32_t y = 0; y < SIZE; y++)
		for (uint32_t x = 0; x < SIZE; x++) {
			all += truth_at(&img, "id", x, y) == 1;
			dark += truth_at(&img, "id", x, y) == 1 && truth_at(&img, "shadow.G", x, y) < 1;
		}
	ck_assert_float_gt(all, 50);
	image_free(&img);
	look_release(&changed);
	rules_free(&look);
	free(kept);
	return dark / all;
}

/* A room of six walls that face inwards, with a table top inside. Draw 1 is the floor, 7 the table. */
static void build_room(struct made *t, int two_side, float w)
{
	uint32_t walls;

	made_init(t, SIZE, SIZE, 1);
	made_add_light(t, 4, 8, 3, w);
	walls = made_add_material(t, 0.7f);
	t->materials[walls].two_side = (uint32_t)two_side;
	made_add_square(t, walls, (float[3]){ 0, -3, -2.5f }, z_axis, x_axis, 3, 4);
	made_add_square(t, walls, (float[3]){ 0, 3, -2.5f }, x_axis, z_axis, 3, 4);
	made_add_square(t, walls, (float[3]){ -3, 0, -2.5f }, y_axis, z_axis, 3, 4);
	made_add_square(t, walls, (float[3]){ 3, 0, -2.5f }, z_axis, y_axis, 3, 4);
	made_add_square(t, walls, (float[3]){ 0, 0, -5.5f }, x_axis, y_axis, 3, 4);
	made_add_square(t, walls, (float[3]){ 0, 0, 0.5f }, minus_x, y_axis, 3, 4);
	made_add_square(t, walls, (float[3]){ 0, -2, -4 }, z_axis, x_axis, 0.8f, 1);
}

START_TEST(test_closed_room_is_lit_from_outside)
{
	for (int k = 0; k < 4; k++) {
		struct made t;
		float dark;

		build_room(&t, k & 1, k & 2 ? 1 : 0);
		dark = dark_share(&t, NULL);
		ck_assert_msg(dark > 0.01f && dark < 0.5f,
		              "room %d: %g of the floor is dark, expected only the table's shadow", k, (double)dark);
		ck_assert_float_eq(dark_share(&t, "spare: no\n"), 1);
		ck_assert_float_eq(dark_share(&t, "surfaces:\n- shadows: yes\n"), 1);
		made_free(&t);
	}
}
END_TEST

/* The walls drawn again, to depth only: they count as solid, and are spared as well. */
START_TEST(test_depth_of_a_closed_room)
{
	struct made t;
	uint32_t depth, n;
	float once, twice;

	build_room(&t, 0, 1);
	once = dark_share(&t, NULL);
	depth = made_add_material(&t, 0.7f);
	t.materials[depth].lighting = 0;
	t.materials[depth].color_mask = 0;
	n = t.scene.n_instances;
	for (uint32_t i = 0; i < n - 1; i++) { /* all but the table */
		const uint32_t copy = made_add_square(&t, depth, (float[3]){ 0, 0, 0 }, x_axis, y_axis, 1, 1);

		t.instances[copy].mesh = t.instances[i].mesh;
	}
	twice = dark_share(&t, NULL);
	ck_assert_msg(fabsf(once - twice) < 0.02f, "%g of the floor is dark, %g with the walls' depth", (double)once,
	              (double)twice);
	ck_assert_float_eq(dark_share(&t, "spare: no\n"), 1);
	made_free(&t);
}
END_TEST

/* Ways to draw a roof above a floor. */
static void lit_below(struct scene_material *m)
{
	(void)m;
}

static void lit_on_both_sides(struct scene_material *m)
{
	m->two_side = 1;
}

static void culled_above(struct scene_material *m)
{
	m->lighting = 0;
	m->cull_face = GL_BACK;
}

static void culled_below(struct scene_material *m)
{
	m->cull_face = GL_FRONT;
}

static void unlit(struct scene_material *m)
{
	m->lighting = 0;
}

/* Light from above passes a roof that shows only its underside, and is blocked by any other. */
START_TEST(test_roofs)
{
	static const struct {
		void (*draw)(struct scene_material *);
		int turned, shades; /* its normals and front face upwards */
	} roofs[] = {
		{ lit_below, 0, 0 }, { lit_below, 1, 1 },    { lit_on_both_sides, 0, 1 }, { culled_above, 0, 0 },
		{ culled_above, 1, 1 }, { culled_below, 0, 1 }, { culled_below, 1, 0 },      { unlit, 0, 1 },
	};

	for (int k = 0; k < 8; k++) {
		const float *u = roofs[k].turned ? z_axis : x_axis, *v = roofs[k].turned ? x_axis : z_axis;
		struct made t;
		float with;

		made_init(&t, SIZE, SIZE, 0.6f);
		made_add_light(&t, 0, 1, 0, 0);
		made_add_material(&t, 0.7f);
		roofs[k].draw(&t.materials[made_add_material(&t, 0.7f)]);
		made_add_square(&t, 0, (float[3]){ 0, -2, -7 }, z_axis, x_axis, 3, 8);
		made_add_square(&t, 1, (float[3]){ -1, -0.5f, -7 }, u, v, 1, 2);
		with = dark_share(&t, NULL);
		ck_assert_msg(roofs[k].shades ? with > 0.03f : with == 0, "roof %d: %g of the floor is dark", k, (double)with);
		ck_assert_float_gt(dark_share(&t, "spare: no\n"), 0.03f);
		made_free(&t);
	}
}
END_TEST

/* Unlit walls around a small lit square are a backdrop. The same wall inside a lit plane is an object. */
START_TEST(test_unlit_walls)
{
	struct made t;
	uint32_t unlit;

	made_init(&t, SIZE, SIZE, 0.6f);
	made_add_light(&t, 1, 0.5f, 0.2f, 0);
	made_add_material(&t, 0.7f);
	unlit = made_add_material(&t, 0.7f);
	t.materials[unlit].lighting = 0;
	made_add_square(&t, 0, (float[3]){ 0, 0, -6 }, z_axis, x_axis, 0.7f, 4);
	memcpy(t.instances[0].modelview, (float[16]){ 1, 0, 0, 0, 0, 0.8f, 0.6f, 0, 0, -0.6f, 0.8f, 0, 0, -4, -1, 1 },
	       sizeof(t.instances[0].modelview));
	made_add_square(&t, unlit, (float[3]){ 3, 0, -6 }, minus_z, y_axis, 6, 1);
	for (uint32_t blend = 0; blend < 2; blend++) {
		t.materials[unlit].blend = blend; /* with an alpha of 1, still opaque */
		t.materials[unlit].blend_src_rgb = t.materials[unlit].blend_src_alpha = GL_SRC_ALPHA;
		t.materials[unlit].blend_dst_rgb = t.materials[unlit].blend_dst_alpha = GL_ONE_MINUS_SRC_ALPHA;
		ck_assert_float_eq(dark_share(&t, NULL), 0);
		ck_assert_float_eq(dark_share(&t, "spare: no\n"), 1);
	}
	made_free(&t);

	made_init(&t, SIZE, SIZE, 0.6f);
	made_add_light(&t, 1, 0.5f, 0.2f, 0);
	made_add_material(&t, 0.7f);
	unlit = made_add_material(&t, 0.7f);
	t.materials[unlit].lighting = 0;
	made_add_square(&t, 0, (float[3]){ 0, -2, -10 }, z_axis, x_axis, 8, 8);
	made_add_square(&t, unlit, (float[3]){ 1, -1, -6 }, minus_z, y_axis, 1, 1);
	ck_assert_float_gt(dark_share(&t, NULL), 0.05f);
	made_free(&t);
}
END_TEST

/* Two cards crossed at their middle do not shade each other; a wall beside them shades both. */
static void build_cards(struct made *t, int wall)
{
	static const struct scene_unit unit = { .min_filter = GL_NEAREST,
		                                .mag_filter = GL_NEAREST,
		                                .wrap_s = GL_REPEAT,
		                                .wrap_t = GL_REPEAT,
		                                .wrap_r = GL_REPEAT,
		                                .env_mode = GL_MODULATE,
		                                .max_lod = 1000,
		                                .matrix = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 } };
	static const uint8_t white[4] = { 255, 255, 255, 255 };
	static const struct scene_texture texture = { .hash = { 7, 7 },
		                                      .target = GL_TEXTURE_2D,
		                                      .base_format = GL_RGBA,
		                                      .width = 1,
		                                      .height = 1,
		                                      .depth = 1,
		                                      .n_levels = 1,
		                                      .texels = white,
		                                      .n_bytes = 4 };
	static const struct scene_texture *textures[] = { &texture };
	uint32_t cards, opaque;

	made_init(t, SIZE, SIZE, 0.6f);
	t->scene.units = (struct scene_unit *)(uintptr_t)&unit;
	t->scene.textures = textures;
	t->scene.n_units = t->scene.n_textures = 1;
	made_add_light(t, 1, 0.1f, 0.6f, 0);
	cards = made_add_material(t, 0.7f);
	opaque = made_add_material(t, 0.7f);
	t->materials[cards].unit_count = 1;
	t->materials[cards].alpha_test = 1;
	t->materials[cards].alpha_func = GL_GREATER;
	t->materials[cards].alpha_ref = 0.5f;
	t->materials[cards].two_side = 1;
	made_add_square(t, cards, (float[3]){ 0, 0, -6 }, x_axis, y_axis, 1.5f, 1);
	made_add_square(t, cards, (float[3]){ 0, 0, -6 }, minus_z, y_axis, 1.5f, 1);
	if (wall)
		made_add_square(t, opaque, (float[3]){ 10, 0, -1 }, minus_z, y_axis, 4, 1);
}

START_TEST(test_crossed_cards)
{
	struct made t;

	build_cards(&t, 0);
	ck_assert_float_eq(dark_share(&t, NULL), 0);
	ck_assert_float_gt(dark_share(&t, "spare: no\n"), 0.3f);
	made_free(&t);
	build_cards(&t, 1);
	ck_assert_float_gt(dark_share(&t, NULL), 0.9f);
	made_free(&t);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("spare");

	tcase_set_timeout(tests, 60);
	tcase_add_test(tests, test_closed_room_is_lit_from_outside);
	tcase_add_test(tests, test_depth_of_a_closed_room);
	tcase_add_test(tests, test_roofs);
	tcase_add_test(tests, test_unlit_walls);
	tcase_add_test(tests, test_crossed_cards);
	return run_case(tests, "spare");
}
