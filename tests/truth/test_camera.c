/* Scenes from another camera (look/camera/): invalid files, and pictures with known contents. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/err.h"
#include "base/mat4.h"
#include "look/camera/camera.h"
#include "look/camera/elsewhere.h"
#include "scene/program.h"
#include "tests/case.h"
#include "tests/said.h"
#include "tests/truth/scenes.h"

#define SIZE 64

static char path[] = "/tmp/relume-camera-XXXXXX", said[1000];
static const float right[3] = { 1, 0, 0 }, up[3] = { 0, 1, 0 }, ahead[3] = { 0, 0, -10 };

/* Load text as a file; messages are stored in `said`. */
static int load(const char *text, struct camera **out)
{
	struct said reported;
	int err;

	said_write_file(path, text);
	reported = said_begin();
	err = camera_load(path, out);
	said_end(&reported, said, sizeof(said));
	return err;
}

START_TEST(test_wrong_files)
{
	static const struct { const char *text, *said; } wrong[] = {
		{ "place: [0, 0]\n", "line 1" },
		{ "kind: pinhole\nlens: 50\n", "line 2" },
		{ "place: [0, 0, 0]\nturntable: { about: here }\n", "line 2" },
		{ "kind: fisheye\n", "fisheye" },
		{ "space: object\n", "object" },
		{ "up: [0, 0, 0]\n", "up must not be 0 0 0" },
		{ "place: [1, 2, 3]\nlook_at: [1, 2, 3]\n", "must differ from place" },
		{ "field_of_view: 180\n", "field_of_view is 180" },
		{ "height: 0\n", "height is 0" },
		{ "height: 2\nfield_of_view: 20\n", "cannot be used together" },
		{ "kind: pinhole\nheight: 2\n", "cannot be used with kind pinhole" },
		{ "near: 2\nfar: 1\n", "near is 2" },
		{ "size: [0, 4]\n", "size is 0 x 4" },
		{ "look_at: [0, 0, 1]\nturntable: { frames: 3 }\n", "look_at" },
		{ "turntable: { frames: 0 }\n", "frames is 0" },
		{ "place: [.nan, 0, 0]\n", "line 1" },
	};

	for (size_t i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++) {
		struct camera *camera = NULL;

		ck_assert_msg(load(wrong[i].text, &camera) == ERR_INPUT, "case %zu", i);
		ck_assert_ptr_null(camera);
		ck_assert_msg(strstr(said, wrong[i].said), "case %zu: '%s' is not in: %s", i, wrong[i].said, said);
		ck_assert_ptr_nonnull(strstr(said, path));
		ck_assert_ptr_eq(strchr(said, '\n'), said + strlen(said) - 1); /* one line */
	}
}
END_TEST

/* Render a scene through a file's camera. */
static void render_from(const struct scene *scene, const char *text, uint32_t number, const char *mode,
                        struct image *img)
{
	struct camera *camera = NULL;
	struct elsewhere elsewhere;
	struct made seen = { .err = 0 };

	ck_assert_msg(load(text, &camera) == 0, "%s", said);
	ck_assert_int_eq(elsewhere_make(camera, NULL, scene, number, &elsewhere), 0);
	ck_assert_uint_eq(elsewhere.without, 0);
	seen.scene = elsewhere.scene;
	truth_render(&seen, mode, img);
	elsewhere_release(&elsewhere);
	camera_free(&camera);
}

/* A grey square in front of a light on the viewer's right; another one behind it, to the side. */
static void make_squares(struct made *t, float tangent)
{
	uint32_t grey;

	made_init(t, SIZE, SIZE, tangent);
	made_add_light(t, 6, 2, -4, 1);
	grey = made_add_material(t, 0.75f);
	made_add_square(t, grey, ahead, right, up, 1, 1);
	made_add_square(t, grey, (const float[3]){ -3, 0.5f, -14 }, right, up, 1.5f, 3);
}

/* The recorded camera, written out in full, gives the recorded picture to the last bit. */
START_TEST(test_own_camera)
{
	static const char *const own[] = { "space: eye\n", "place: [0, 0, 0]\nlook_at: [0, 0, -3]\nup: [0, 2, 0]\n",
		                           "turntable: { frames: 7 }\nplace: [0, 0, 0]\n" };

	for (int i = 0; i < 6; i++) {
		struct image a, b;
		struct made t;

		make_squares(&t, i % 2 ? 0 : 0.5f);
		t.scene.n_instances = i >= 4 ? 1 : 2; /* a turntable's centre is straight ahead for only one of them */
		truth_render(&t, "whitted", &a);
		render_from(&t.scene, own[i / 2], 0, "whitted", &b);
		ck_assert_uint_eq(a.n_channels, b.n_channels);
		for (size_t c = 0; c < a.n_channels; c++)
			ck_assert_msg(memcmp(image_values(&a, c), image_values(&b, c), SIZE * SIZE * sizeof(float)) ==
			                      0,
			              "case %d: %s", i, a.channels[c].name);
		image_free(&a);
		image_free(&b);
		made_free(&t);
	}
}
END_TEST

/* Count the lit pixels inside and outside a rectangle [x0, x1) x [y0, y1). */
static void count_lit(const struct image *img, int x0, int x1, int y0, int y1, int *in, int *out)
{
	*in = *out = 0;
	for (uint32_t y = 0; y < img->height; y++)
		for (uint32_t x = 0; x < img->width; x++)
			if (truth_at(img, "G", x, y) > 0.02f)
				++*((int)x >= x0 && (int)x < x1 && (int)y >= y0 && (int)y < y1 ? in : out);
}

/* A square of 2 units, in a view 4 units high with 64 pixels, covers 32 x 32 of them at any distance. */
START_TEST(test_orthographic)
{
	static const struct { const char *text; int x0, x1, y0, y1;
	} views[] = {
		{ "kind: orthographic\nheight: 4\n", 16, 48, 16, 48 },
		{ "height: 4\nplace: [0.5, -0.25, 20]\nlook_at: [0.5, -0.25, 0]\n", 8, 40, 12, 44 },
		{ "height: 4\nplace: [0, 0, -30]\nlook_at: [0, 0, -10]\n", 16, 48, 16, 48 },      /* from behind */
		/* as large as in perspective, where the view is 10 units high */
		{ "kind: orthographic\nlook_at: [0, 0, -10]\n", 32 - 6, 32 + 6, 32 - 6, 32 + 6 },
		{ "height: 4\nsize: [96, 48]\n", 48 - 12, 48 + 12, 24 - 12, 24 + 12 },
		{ "height: 4\nnear: 11\n", 0, 0, 0, 0 },
		{ "height: 4\nfar: 9\n", 0, 0, 0, 0 },
	};

	for (size_t i = 0; i < sizeof(views) / sizeof(views[0]); i++) {
		struct image img;
		struct made t;
		int in, out;

		make_squares(&t, 0.5f);
		t.scene.n_instances = 1;
		t.materials[0].two_side = 1;
		t.materials[0].back.emission[1] = 0.5f;
		render_from(&t.scene, views[i].text, 0, "gl", &img);
		count_lit(&img, views[i].x0, views[i].x1, views[i].y0, views[i].y1, &in, &out);
		ck_assert_msg(out == 0, "case %zu: %d pixels outside", i, out);
		ck_assert_int_ge(in, (views[i].x1 - views[i].x0 - (i == 3)) * (views[i].y1 - views[i].y0 - (i == 3)));
		image_free(&img);
		made_free(&t);
	}
}
END_TEST

/* The diffuse light from the middle of a square does not depend on the camera, because its light is fixed. Seen from
 * the side it is a line, from behind dark. */
START_TEST(test_turntable)
{
	struct camera *camera = NULL;
	struct made t;
	float first = 0;

	make_squares(&t, 0.5f);
	t.scene.n_instances = 1;
	t.materials[0].two_side = 1;
	ck_assert_int_eq(load("turntable: {}\n", &camera), 0);
	ck_assert_uint_eq(camera_pictures(camera), 48);
	camera_free(&camera);
	for (uint32_t k = 0; k < 12; k++) {
		struct image img;
		float middle;

		render_from(&t.scene,
		            k % 2 ? "turntable: { frames: 12 }\n" :
		                    "turntable: { frames: 6, about: [0, 0, -10], degrees: -360 }\n",
		            k % 2 ? k : (12 - k) / 2, "whitted", &img);
		middle = truth_at(&img, "G", SIZE / 2, SIZE / 2);
		first = k ? first : middle;
		if (k == 0)
			ck_assert_float_ge(middle, 0.3f);
		else if (k < 3 || k > 9)
			ck_assert_float_eq_tol(middle, first, 0.02f); /* a pixel's centre is elsewhere on the square */
		else if (k > 3 && k < 9)
			ck_assert_float_eq_tol(middle, 0, 1e-6f); /* the light is on the other side */
		image_free(&img);
	}
	made_free(&t);
}
END_TEST

/* A light's shadow stays in place on the surface that receives it. */
START_TEST(test_shadow)
{
	static const char *const from[] = { "place: [0, 0, 0]\nlook_at: [0, 0, -20]\n",
		                            "place: [8, 0, -8]\nlook_at: [0, 0, -20]\n" };
	float shadow[2][2];

	for (int k = 0; k < 2; k++) {
		struct image img;
		struct made t;
		uint32_t grey;

		made_init(&t, SIZE, SIZE, 0.5f);
		made_add_light(&t, -12, 0, -8, 1);
		grey = made_add_material(&t, 0.75f);
		made_add_square(&t, grey, (const float[3]){ 0, 0, -20 }, right, up, 6, 1);
		/* between the light and the middle of the other */
		made_add_square(&t, grey, (const float[3]){ -6, 0, -14 }, right, up, 1, 1);
		render_from(&t.scene, from[k], 0, "whitted", &img);
		shadow[k][0] = truth_at(&img, "shadow.G", SIZE / 2, SIZE / 2);
		shadow[k][1] = truth_at(&img, "shadow.G", SIZE / 2 + 14, SIZE / 2);
		image_free(&img);
		made_free(&t);
	}
	for (int k = 0; k < 2; k++) {
		ck_assert_float_eq_tol(shadow[k][0], 0, 1e-6f);
		ck_assert_float_eq_tol(shadow[k][1], 1, 1e-6f);
	}
}
END_TEST

/* HUDs are omitted, the background is kept; a sky stays around the viewer; a ground without depth is part of the
 * world. */
START_TEST(test_what_stays)
{
	struct scene_view views[2];
	struct scene_instance *in;
	struct elsewhere e;
	struct camera *camera = NULL;
	struct made t;
	uint32_t flat, deep;

	made_init(&t, SIZE, SIZE, 0.5f);
	flat = made_add_material(&t, 0.5f);
	t.materials[flat].lighting = t.materials[flat].depth_test = 0;
	deep = made_add_material(&t, 0.5f);
	made_add_square(&t, flat, (const float[3]){ 0, 0, -1 }, right, up, 1, 1);   /* a gradient as background */
	made_add_ball(&t, flat, (const float[3]){ 0, 0, 0 }, 5, 4, 1);              /* a sky */
	made_add_square(&t, flat, (const float[3]){ 0, 0, 0 }, right, ahead, 2, 1); /* a ground */
	made_add_square(&t, deep, ahead, right, up, 1, 1);
	made_add_square(&t, flat, (const float[3]){ 0, 0, -1 }, right, up, 1, 1);   /* a HUD */
	views[0] = views[1] = t.view;
	memset(views[1].projection, 0, sizeof(views[1].projection));
	for (int k = 0; k < 4; k++)
		views[1].projection[5 * k] = k == 2 ? -1 : 1;
	t.scene.views = views;
	t.scene.n_views = 2;
	t.instances[0].view = t.instances[4].view = 1;
	t.instances[2].modelview[13] = -2;
	ck_assert_int_eq(load("place: [3, 0, 0]\n", &camera), 0);
	ck_assert_int_eq(elsewhere_make(camera, NULL, &t.scene, 0, &e), 0);
	ck_assert_uint_eq(e.scene.n_instances, 4);
	in = e.scene.instances;
	for (uint32_t i = 0; i < 4; i++)
		ck_assert_uint_eq(in[i].draw, i + 1);
	ck_assert_float_eq(in[0].modelview[12], 0);
	ck_assert_float_eq(in[1].modelview[12], 0);
	ck_assert_float_eq(in[2].modelview[12], -3);
	ck_assert_float_eq(in[3].modelview[12], -3);
	ck_assert_mem_eq(e.scene.views[1].projection, views[1].projection, sizeof(views[1].projection));
	ck_assert_ptr_nonnull(strstr(e.placement, "at 3 0 0, towards 0 0 -1, up 0 1 0"));
	elsewhere_release(&e);
	camera_free(&camera);
	made_free(&t);
}
END_TEST

/* Clip planes, planes for texture coordinates, spots and sky light are in eye space, and move with it. */
START_TEST(test_state)
{
	struct scene_unit unit = { .gen_mode = { GL_EYE_LINEAR }, .gen_eye_plane = { { 1, 2, 3, 4 } } };
	struct elsewhere e;
	struct camera *camera = NULL;
	struct made t;
	const float *plane, *position, *made;

	make_squares(&t, 0.5f);
	t.materials[0].clip_plane_mask = 1;
	memcpy(t.materials[0].clip_plane_eye[0], (const float[4]){ 0, 1, 0, 0.25f }, 4 * sizeof(float));
	t.scene.units = &unit;
	t.scene.n_units = 1;
	memcpy(t.scene.dome.up_eye, (const float[3]){ 1, 0, 0 }, sizeof(t.scene.dome.up_eye));
	t.scene.start = NULL;
	t.scene.needs_previous = 1;
	t.scene.n_clears = 0;
	ck_assert_int_eq(load("place: [0, 0, -20]\nlook_at: [0, 0, -10]\nup: [-1, 0, 0]\n", &camera), 0);
	ck_assert_int_eq(elsewhere_make(camera, NULL, &t.scene, 0, &e), 0);
	/* x is -y there, y is -x, z is -z - 20 */
	plane = e.scene.materials[0].clip_plane_eye[0];
	ck_assert(plane[0] == -1 && plane[1] == 0 && plane[2] == 0 && plane[3] == 0.25f);
	made = e.scene.units[0].gen_eye_plane[0];
	ck_assert(made[0] == -2 && made[1] == -1 && made[2] == -3 && made[3] == 4 - 60);
	position = e.scene.lights[0].position_eye;
	ck_assert(position[0] == -2 && position[1] == -6 && position[2] == 4 - 20 && position[3] == 1);
	ck_assert(e.scene.lights[0].spot_direction_eye[2] == 1);
	ck_assert(e.scene.dome.up_eye[0] == 0 && e.scene.dome.up_eye[1] == -1);
	ck_assert_uint_eq(e.scene.needs_previous, 0);
	ck_assert_uint_eq(e.scene.n_clears, 1); /* no clear applies to this view */
	ck_assert(e.scene.clears[0].buffers == 7 && e.scene.clears[0].depth == 1 && e.scene.clears[0].scissor[2] == SIZE);
	elsewhere_release(&e);
	camera_free(&camera);
	made_free(&t);
}
END_TEST

/* A program that puts its camera into the projection matrix: the camera is relative to that camera's space. */
START_TEST(test_camera_in_projection)
{
	static const char text[] = "place: [2, 0, 1]\nlook_at: [0, 0, -10]\n";
	/* eye space as it would be, relative to that of the draws */
	static const float world[16] = { 0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 3, -2, 5, 1 };
	static const float back[16] = { 0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, -5, 2, 3, 1 };
	struct image a, b;
	struct made t;
	int apart = 0;

	make_squares(&t, 0.5f);
	render_from(&t.scene, text, 0, "whitted", &a);
	for (uint32_t i = 0; i < t.scene.n_instances; i++)
		memcpy(t.instances[i].modelview, back, sizeof(back));
	mat4_mul(t.view.projection, t.view.projection, world);
	mat4_transform(t.lights[0].position_eye, back, (const float[4]){ 6, 2, -4, 1 });
	render_from(&t.scene, text, 0, "whitted", &b);
	for (uint32_t i = 0; i < SIZE * SIZE; i++)
		apart += fabsf(truth_at(&a, "G", i % SIZE, i / SIZE) - truth_at(&b, "G", i % SIZE, i / SIZE)) > 0.01f;
	ck_assert_int_le(apart, 4);
	image_free(&a);
	image_free(&b);
	made_free(&t);
}
END_TEST

/* Vertices positioned by a program move like all others. */
START_TEST(test_programs)
{
	static const char text[] = "place: [4, 1, -2]\nlook_at: [0, 0, -11]\n";
	struct image a, b;
	struct made t;
	int apart = 0, lit = 0;
	uint32_t *words = calloc(4000, sizeof(*words));
	struct scene_program *head = (struct scene_program *)words;
	struct scene_instruction *at = (struct scene_instruction *)(head + 1);

	ck_assert_ptr_nonnull(words);
	make_squares(&t, 0.5f);
	t.materials[0].lighting = 0;
	render_from(&t.scene, text, 0, "gl", &a);
	/* position = projection . vertex, as four sums; the vertex is in eye space. Then its colour */
	*head = (struct scene_program){ .n_instructions = 5,
		                        .n_constants = 20,
		                        .n_registers = SCENE_VERTEX_FIRST,
		                        .inputs = 1u << SCENE_VERTEX_POSITION,
		                        .outputs = 1u << SCENE_RESULT_POSITION };
	for (uint32_t c = 0; c < 4; c++)
		at[c] = (struct scene_instruction){
			.operation = SCENE_OP_MAD, .n = 4, .flags = SCENE_STEP_B | SCENE_STEP_C, .to = SCENE_VERTEX_RESULTS,
			.a = 4 * SCENE_VERTEX_POSITION + c, .b = SCENE_PROGRAM_CONSTANT + 4 * c, .c = SCENE_VERTEX_RESULTS
		};
	at[4] = (struct scene_instruction){ .operation = SCENE_OP_MOVE,
		                            .n = 4,
		                            .flags = SCENE_STEP_A,
		                            .to = SCENE_VERTEX_RESULTS + 4 * SCENE_RESULT_COLOR,
		                            .a = SCENE_PROGRAM_CONSTANT + 16 };
	memcpy(at + 5, t.view.projection, sizeof(t.view.projection));
	for (int c = 0; c < 4; c++)
		((float *)(at + 5))[16 + c] = 1;
	t.scene.programs = words;
	t.scene.n_programs = (uint32_t)((sizeof(*head) + 5 * sizeof(*at) + 20 * sizeof(float)) / sizeof(*words));
	t.materials[0].vertex_program = 1;
	t.materials[0].program = 1;
	render_from(&t.scene, text, 0, "gl", &b);
	for (uint32_t i = 0; i < SIZE * SIZE; i++) {
		apart += fabsf(truth_at(&a, "G", i % SIZE, i / SIZE) - truth_at(&b, "G", i % SIZE, i / SIZE)) > 0.01f;
		lit += truth_at(&a, "G", i % SIZE, i / SIZE) > 0.1f;
	}
	ck_assert_int_ge(lit, 200);
	ck_assert_int_le(apart, 4);
	image_free(&a);
	image_free(&b);
	made_free(&t);
	free(words);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("camera");
	int fd = mkstemp(path), failed;

	if (fd < 0)
		return 1;
	close(fd);
	tcase_add_test(tests, test_wrong_files);
	tcase_add_test(tests, test_own_camera);
	tcase_add_test(tests, test_orthographic);
	tcase_add_test(tests, test_turntable);
	tcase_add_test(tests, test_shadow);
	tcase_add_test(tests, test_what_stays);
	tcase_add_test(tests, test_state);
	tcase_add_test(tests, test_camera_in_projection);
	tcase_add_test(tests, test_programs);
	failed = run_case(tests, "camera");
	unlink(path);
	return failed;
}
