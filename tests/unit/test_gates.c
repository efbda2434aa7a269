/*
 * Gates of the scorer: a good frame passes all of them, each fault fails its own gate, and harmless differences fail
 * none. The frames are synthetic: three draws of known colour, depth and number over a background.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "diff/score/gates.h"
#include "diff/score/maps.h"
#include "diff/score/picture.h"
#include "tests/case.h"

enum { WIDTH = 160, HEIGHT = 120, N = WIDTH * HEIGHT };

/* Contents of a frame; tests change it before they make a frame. */
struct drawing {
	int box, disc, bar;       /* 1: drawn */
	int shift_x;              /* whole picture, in pixels */
	int texel_shift;          /* the box's texture */
	int other_texture;
	double depth_offset, disc_grow;
	int disc_as_background;   /* the disc has the background's colour */
	int mirrored;
};
static const struct drawing all = { .box = 1, .disc = 1, .bar = 1 };

struct sample {
	uint8_t rgb[3];
	float depth;
	int id;
};

static struct sample sample_at(const struct drawing *d, int x, int y)
{
	struct sample s = { { 10, 12, 20 }, 1, 0 };
	double u, v;

	if (d->mirrored)
		x = WIDTH - 1 - x;
	x -= d->shift_x;
	if (d->box && x >= 20 && x < 100 && y >= 20 && y < 100) {
		int texel = (x + d->texel_shift) / 4 + y / 4;
		static const uint8_t colors[2][3] = { { 180, 60, 40 }, { 60, 160, 90 } };

		memcpy(s.rgb, colors[texel % 2], 3);
		if (d->other_texture) {
			s.rgb[0] = (uint8_t)(40 + (x * 5 + y * 3) % 160);
			s.rgb[2] = 200;
		}
		s.depth = (float)(0.5 + 0.001 * x + 0.0005 * y + d->depth_offset);
		s.id = 1;
	}
	u = x + 0.5 - 110;
	v = y + 0.5 - 60;
	if (d->disc && u * u + v * v < (30 + d->disc_grow) * (30 + d->disc_grow)) {
		s.rgb[0] = (uint8_t)(d->disc_as_background ? 10 : 40);
		s.rgb[1] = (uint8_t)(d->disc_as_background ? 12 : 90 + x / 4);
		s.rgb[2] = (uint8_t)(d->disc_as_background ? 20 : 200);
		s.depth = (float)(0.4 + 0.0007 * (x - 80) + d->depth_offset);
		s.id = 2;
	}
	if (d->bar && x >= 125 && x < 137 && y >= 100 && y < 108) {
		memcpy(s.rgb, (uint8_t[]){ 250, 240, 30 }, 3);
		s.depth = (float)(0.3 + d->depth_offset);
		s.id = 3;
	}
	return s;
}

static struct image reference, traced;
static struct score_picture picture;
static struct score_options options;
static struct score score;

static float *add(struct image *img, const char *name)
{
	float *plane = image_add_channel(img, name, 1);

	ck_assert_ptr_nonnull(plane);
	return plane;
}

/* In the form that set_read gives to a .ref file. */
static void make_reference(const struct drawing *d, int with_depth)
{
	float *rgb[3], *depth = NULL;

	reference = (struct image){ .width = WIDTH, .height = HEIGHT };
	for (int c = 0; c < 3; c++)
		rgb[c] = add(&reference, (const char[]){ "RGB"[c], 0 });
	if (with_depth)
		depth = add(&reference, "gl.depth");
	for (int i = 0; i < N; i++) {
		struct sample s = sample_at(d, i % WIDTH, i / WIDTH);

		for (int c = 0; c < 3; c++)
			rgb[c][i] = (float)s.rgb[c] / 255;
		if (depth)
			depth[i] = s.depth;
	}
	ck_assert_int_eq(image_set_attribute(&reference, "relume:encoding", "display"), 0);
	ck_assert_int_eq(score_picture_from_image(&reference, "beauty", &picture), 0);
}

/* A complete traced frame: a shadow falls on part of the box, and the disc is a mirror. */
static void make_traced(const struct drawing *d)
{
	float *beauty[3], *gl[3], *shadow[3], *reflect[3], *depth, *id;

	traced = (struct image){ .width = WIDTH, .height = HEIGHT };
	for (int c = 0; c < 3; c++) {
		char name[16];

		beauty[c] = add(&traced, (const char[]){ "RGB"[c], 0 });
		snprintf(name, sizeof(name), "gl.%c", "RGB"[c]);
		gl[c] = add(&traced, name);
		snprintf(name, sizeof(name), "shadow.%c", "RGB"[c]);
		shadow[c] = add(&traced, name);
		snprintf(name, sizeof(name), "reflect.%c", "RGB"[c]);
		reflect[c] = add(&traced, name);
	}
	depth = add(&traced, "gl.depth");
	id = add(&traced, "id");
	for (int i = 0; i < N; i++) {
		struct sample s = sample_at(d, i % WIDTH, i / WIDTH);

		for (int c = 0; c < 3; c++) {
			gl[c][i] = image_linear_from_display((float)s.rgb[c] / 255);
			shadow[c][i] = s.id == 1 && i % WIDTH < 40 ? 0.25f : 1;
			reflect[c][i] = s.id == 2 ? 0.05f : 0;
			beauty[c][i] = gl[c][i] * shadow[c][i] + reflect[c][i];
		}
		depth[i] = s.depth;
		id[i] = (float)s.id;
	}
	ck_assert_int_eq(image_set_attribute(&traced, "relume:frame", "%d", 12), 0);
}

static void begin(void)
{
	make_reference(&all, 1);
	make_traced(&all);
	options = (struct score_options){ .n_ranges = 0 };
}

static void end(void)
{
	score_picture_free(&picture);
	image_free(&reference);
	image_free(&traced);
}

static void run(void)
{
	ck_assert_int_eq(score_frame(&picture, &traced, 12, &options, NULL, &score), 0);
}

static enum score_state state(enum score_gate_id gate)
{
	return score.gates[gate].state;
}

static void remake_traced(const struct drawing *d)
{
	image_free(&traced);
	make_traced(d);
}

static void remake_reference(const struct drawing *d, int with_depth)
{
	score_picture_free(&picture);
	image_free(&reference);
	make_reference(d, with_depth);
}

static void expect_failed(enum score_gate_id gate)
{
	run();
	ck_assert_msg(state(gate) == SCORE_FAILED, "%s did not fail: %g", score_gates[gate].name, score.gates[gate].value[0]);
	ck_assert_int_eq(score.outcome, SCORE_FRAME_FAILED);
}

static void expect_all_passed(void)
{
	run();
	for (int g = 0; g < N_GATES; g++)
		ck_assert_msg(state((enum score_gate_id)g) != SCORE_FAILED, "%s failed: %g (%s)", score_gates[g].name,
		              score.gates[g].value[0], score.gates[g].note);
	ck_assert_int_eq(score.outcome, SCORE_FRAME_PASSED);
}

START_TEST(good_frame_passes_every_gate)
{
	expect_all_passed();
	for (int g = 0; g < N_GATES; g++)
		/* not measured: there are no layers, ranges, normals or approved frames */
		if (g != GATE_R1B && g != GATE_E3 && g != GATE_N && g != GATE_B)
			ck_assert_msg(state((enum score_gate_id)g) == SCORE_PASSED, "%s", score_gates[g].name);
	ck_assert_double_eq(score.fidelity, 1);
	ck_assert_double_eq(score.gates[GATE_P].value[0], 0);
	ck_assert_double_eq(score.gates[GATE_R4].value[0], 1);
	ck_assert_double_eq(score.gates[GATE_R4].value[1], 0);
	ck_assert_double_gt(score.info.beauty_flip, 0);
	ck_assert_double_gt(score.info.effect_share[EFFECT_SHADOW], 0.05);
}
END_TEST

/* Values that fit halves (11 bits), stored as such or as floats. */
static void check_halves(int full_float)
{
	for (size_t c = 0; c < traced.n_channels; c++) {
		if (strcmp(traced.channels[c].name, "gl.depth") == 0 || strcmp(traced.channels[c].name, "id") == 0)
			continue;
		traced.channels[c].full_float = full_float;
		for (int i = 0; i < N; i++) {
			int exponent;
			float m = frexpf(traced.channels[c].values[i], &exponent);

			traced.channels[c].values[i] = ldexpf(rintf(m * 2048) / 2048, exponent);
		}
	}
	expect_all_passed();
}

START_TEST(half_channels_pass)
{
	check_halves(0);
	remake_traced(&all);
	check_halves(1);
}
END_TEST

/* V */

START_TEST(one_nan_in_any_channel)
{
	for (size_t c = 0; c < traced.n_channels; c++) {
		float kept = traced.channels[c].values[777];

		traced.channels[c].values[777] = c % 2 ? NAN : INFINITY;
		expect_failed(GATE_V);
		ck_assert_ptr_nonnull(strstr(score.gates[GATE_V].note, traced.channels[c].name));
		ck_assert_double_eq(score.fidelity, 0);
		traced.channels[c].values[777] = kept;
	}
	expect_all_passed();
}
END_TEST

START_TEST(wrong_size)
{
	traced.height--;
	expect_failed(GATE_V);
	ck_assert_int_eq(state(GATE_R1), SCORE_NOT_MEASURED);
}
END_TEST

START_TEST(wrong_frame_number)
{
	ck_assert_int_eq(image_set_attribute(&traced, "relume:frame", "13"), 0);
	expect_failed(GATE_V);
}
END_TEST

START_TEST(missing_channels)
{
	strcpy(traced.channels[0].name, "other"); /* was R */
	expect_failed(GATE_V);
	strcpy(traced.channels[0].name, "R");
	options.channel = "albedo";
	expect_failed(GATE_V);
}
END_TEST

/* R1, R1b */

static void shift_codes(int first_row, int last_row, int by)
{
	for (int c = 0; c < 3; c++) {
		float *gl = image_channel(&traced, (const char[]){ 'g', 'l', '.', "RGB"[c], 0 });
		float *beauty = image_channel(&traced, (const char[]){ "RGB"[c], 0 });
		const float *shadow = image_channel(&traced, (const char *[]){ "shadow.R", "shadow.G", "shadow.B" }[c]);
		const float *reflect = image_channel(&traced, (const char *[]){ "reflect.R", "reflect.G", "reflect.B" }[c]);

		for (int i = first_row * WIDTH; i < last_row * WIDTH; i++) {
			gl[i] = image_linear_from_display((float)(score_code_from_linear(gl[i]) + by) / 255);
			beauty[i] = gl[i] * shadow[i] + reflect[i];
		}
	}
}

START_TEST(interior_colour)
{
	shift_codes(0, 1, 2); /* two codes on a row are within the limit */
	expect_all_passed();
	shift_codes(0, 1, 1);
	expect_failed(GATE_R1);
	ck_assert_double_gt(score.gates[GATE_R1].value[0], 0.1);
	ck_assert_uint_eq(score.blame[0].draw, 0);
}
END_TEST

START_TEST(few_interior_pixels_may_exceed)
{
	float *gl = image_channel(&traced, "gl.R"), *beauty = image_channel(&traced, "R");

	for (int i = 0; i < 10; i++) { /* out of about 17,000; in the lit part of the box */
		int at = 70 * WIDTH + 50 + 2 * i;

		gl[at] = beauty[at] =
			image_linear_from_display((float)(score_code_from_linear(gl[at]) + 20) / 255);
	}
	expect_all_passed();
	ck_assert_uint_eq(score.failing_pixels, 10);
}
END_TEST

START_TEST(blended_pixels_have_a_bar_of_their_own)
{
	float *layers = add(&traced, "layers");

	for (int i = 0; i < 2 * WIDTH; i++)
		layers[i] = 2;
	shift_codes(0, 2, 3);
	run();
	ck_assert_int_eq(state(GATE_R1), SCORE_PASSED);
	ck_assert_int_eq(state(GATE_R1B), SCORE_PASSED);
	shift_codes(0, 2, 1);
	expect_failed(GATE_R1B);
	ck_assert_int_eq(state(GATE_R1), SCORE_PASSED);
}
END_TEST

/* R2 */

START_TEST(edges_may_move_by_a_rounding)
{
	struct drawing d = all;

	d.disc_grow = 0.02; /* a few scattered pixels */
	remake_traced(&d);
	run();
	ck_assert_int_eq(state(GATE_R1), SCORE_PASSED);
	ck_assert_int_eq(state(GATE_R2), SCORE_PASSED);
	ck_assert_int_eq(state(GATE_R3), SCORE_PASSED);
	ck_assert_int_eq(state(GATE_R4), SCORE_PASSED);
}
END_TEST

START_TEST(wrong_edges)
{
	/* a halo: edge pixels in a colour that no neighbour has */
	const float *id = image_channel(&traced, "id");

	for (int i = WIDTH + 1; i < N - WIDTH; i++)
		if (id[i] == 2 && (id[i - 1] != 2 || id[i + 1] != 2))
			image_channel(&traced, "gl.G")[i] = image_channel(&traced, "G")[i] = 0.9f;
	expect_failed(GATE_R2);
}
END_TEST

/* R3, R4: geometry and textures */

START_TEST(missing_draw)
{
	struct drawing d = all;

	d.bar = 0;
	remake_traced(&d);
	expect_failed(GATE_R3);
	ck_assert_int_eq(state(GATE_R4), SCORE_FAILED);
	ck_assert_double_eq(score.gates[GATE_R4].value[1], 12 * 8);
}
END_TEST

START_TEST(wrong_texture)
{
	struct drawing d = all;

	d.other_texture = 1;
	remake_traced(&d);
	expect_failed(GATE_R1);
	ck_assert_int_eq(state(GATE_R3), SCORE_FAILED);
	ck_assert_int_eq(state(GATE_R4), SCORE_PASSED);
	ck_assert_uint_eq(score.blame[0].draw, 1);
	ck_assert_double_gt((double)score.blame[0].pixels / (double)score.failing_pixels, 0.9);
}
END_TEST

START_TEST(texture_off_by_one_texel)
{
	struct drawing d = all;

	d.texel_shift = 4;
	remake_traced(&d);
	expect_failed(GATE_R1);
	ck_assert_int_eq(state(GATE_P), SCORE_FAILED);
}
END_TEST

START_TEST(shifted_by_one_pixel)
{
	struct drawing d = all;

	d.shift_x = 1;
	remake_traced(&d);
	expect_failed(GATE_R1);
	ck_assert_int_eq(state(GATE_R4), SCORE_FAILED);
	ck_assert_int_eq(state(GATE_R5), SCORE_FAILED);
}
END_TEST

START_TEST(mirrored)
{
	struct drawing d = all;

	d.mirrored = 1;
	remake_traced(&d);
	expect_failed(GATE_R4);
}
END_TEST

START_TEST(missing_draw_of_the_background_s_colour)
{
	struct drawing d = all;

	d.disc_as_background = 1;
	remake_reference(&d, 1);
	d.disc = 0;
	remake_traced(&d);
	expect_failed(GATE_R4); /* only depth differs */
}
END_TEST

START_TEST(silhouette_without_depth_reference)
{
	struct drawing d = all;

	remake_reference(&all, 0);
	expect_all_passed();
	ck_assert_int_eq(state(GATE_R5), SCORE_NOT_MEASURED);
	ck_assert_int_eq(state(GATE_R4), SCORE_PASSED);
	ck_assert_ptr_nonnull(strstr(score.gates[GATE_R4].note, "no depth reference"));
	d.disc = 0;
	remake_traced(&d);
	expect_failed(GATE_R4);
}
END_TEST

/* R5 */

START_TEST(depth)
{
	struct drawing d = all;

	d.depth_offset = 3e-6; /* slopes are 0.0007 to 0.0015 per pixel; 1/256 of that is allowed */
	remake_traced(&d);
	run();
	ck_assert_double_gt(score.gates[GATE_R5].value[0], 0); /* the lower limit: 2^-23 */
	d.bar = 0;
	d.depth_offset = 2e-6;
	remake_reference(&(struct drawing){ .box = 1, .disc = 1 }, 1);
	remake_traced(&d);
	expect_all_passed();
	d.depth_offset = 2e-5;
	remake_traced(&d);
	expect_failed(GATE_R5);
	ck_assert_int_eq(state(GATE_R1), SCORE_PASSED);
}
END_TEST

START_TEST(depth_of_16_bits)
{
	float *depth = image_channel(&reference, "gl.depth");

	for (int i = 0; i < N; i++)
		depth[i] = rintf(depth[i] * 65535) / 65535;
	run();
	ck_assert_int_eq(state(GATE_R5), SCORE_PASSED);
	ck_assert_int_eq(state(GATE_R1), SCORE_PASSED);
	ck_assert_double_gt(score.fidelity, 0.99);
}
END_TEST

/* E */

START_TEST(channels_that_do_not_add_up)
{
	image_channel(&traced, "G")[60 * WIDTH + 30] *= 1.001f; /* in the shadow */
	expect_failed(GATE_E1);
	ck_assert_int_eq(state(GATE_E2), SCORE_PASSED);
}
END_TEST

START_TEST(unexplained_difference)
{
	image_channel(&traced, "G")[5] += 0.1f; /* background: no effect there */
	expect_failed(GATE_E2);
	ck_assert_double_eq(score.gates[GATE_E2].value[0], 1);
}
END_TEST

START_TEST(effects_within_their_range)
{
	options.ranges[0] = (struct score_range){ EFFECT_SHADOW, 0.01, 0.5 };
	options.ranges[1] = (struct score_range){ EFFECT_REFRACT, NAN, 0 };
	options.ranges[2] = (struct score_range){ EFFECT_SHADOW, 0.9, 1 }; /* not requested */
	options.n_ranges = 2;
	expect_all_passed();
	ck_assert_int_eq(state(GATE_E3), SCORE_PASSED);
	for (int c = 0; c < 3; c++) { /* all shadows are missing, consistently in the channels */
		const char *shadow = (const char *[]){ "shadow.R", "shadow.G", "shadow.B" }[c];
		const char *gl = (const char *[]){ "gl.R", "gl.G", "gl.B" }[c];
		const char *reflect = (const char *[]){ "reflect.R", "reflect.G", "reflect.B" }[c];

		for (int i = 0; i < N; i++) {
			image_channel(&traced, shadow)[i] = 1;
			image_channel(&traced, (const char[]){ "RGB"[c], 0 })[i] =
				image_channel(&traced, gl)[i] + image_channel(&traced, reflect)[i];
		}
	}
	expect_failed(GATE_E3);
	ck_assert_int_eq(state(GATE_E1), SCORE_PASSED);
	options.ranges[1] = (struct score_range){ EFFECT_REFLECT, NAN, 0 };
	expect_failed(GATE_E3);
	ck_assert_double_eq(score.gates[GATE_E3].value[0], 2);
	for (int k = 0; k < 2; k++) /* both are named */
		ck_assert_ptr_nonnull(strstr(score.gates[GATE_E3].note, score_effect_names[options.ranges[k].effect]));
}
END_TEST

/* N */

/* Give the traced frame surfaces that all face the viewer; `fold`: the box' plane is turned away from the light that
 * its normals face. */
static void add_surfaces(int fold)
{
	static const char *const names[9] = { "albedo.R", "albedo.G", "albedo.B", "N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z" };
	const float *id = image_channel(&traced, "id");
	float *plane[9];

	for (int k = 0; k < 9; k++)
		plane[k] = add(&traced, names[k]);
	for (int i = 0; i < N; i++) {
		const float x = (float)(i % WIDTH),
			    at[6] = { 0, 0, 1, x, (float)(-i / WIDTH), fold && id[i] == 1 ? 0.5f * x : -10 * id[i] };

		for (int k = 0; k < 9; k++)
			plane[k][i] = k < 3 ? 0.5f : at[k - 3];
	}
	ck_assert_int_eq(image_set_attribute(&traced, "relume:lights", "%s", "1 0 0.25 0"), 0);
}

/* Reduce the light to a share of itself where `where` says so, consistently in the channels. */
static void darken(float share, int where(int i))
{
	for (int i = 0; i < N; i++)
		for (int c = 0; c < 3; c++) {
			char names[3][16];
			float *shadow, beauty;

			snprintf(names[0], sizeof(names[0]), "shadow.%c", "RGB"[c]);
			snprintf(names[1], sizeof(names[1]), "gl.%c", "RGB"[c]);
			snprintf(names[2], sizeof(names[2]), "reflect.%c", "RGB"[c]);
			shadow = image_channel(&traced, names[0]);
			shadow[i] = where(i) ? share : 1;
			beauty = image_channel(&traced, names[1])[i] * shadow[i] + image_channel(&traced, names[2])[i];
			image_channel(&traced, (const char[]){ "RGB"[c], 0 })[i] = beauty;
		}
}

static int on_box(int i)
{
	return image_channel(&traced, "id")[i] == 1;
}

static int on_half_of_box(int i)
{
	return on_box(i) && i % WIDTH < 60;
}

START_TEST(dark_without_an_edge)
{
	add_surfaces(0);
	darken(0.2f, on_half_of_box); /* an edge in the middle of the box: a shadow */
	expect_all_passed();
	ck_assert_int_eq(state(GATE_N), SCORE_PASSED);
	darken(0.2f, on_box); /* all of it, up to its outline */
	expect_failed(GATE_N);
	ck_assert_double_gt(score.gates[GATE_N].value[0], 20);
	ck_assert_double_eq(score.gates[GATE_N].value[1], 0);
}
END_TEST

/* A drawn shadow is where the traced one falls: albedo is that of the black film, and does not reveal the floor's
 * light. */
START_TEST(dark_below_a_film)
{
	static const char *const albedo[3] = { "albedo.R", "albedo.G", "albedo.B" };
	float *layers = add(&traced, "layers");

	add_surfaces(0);
	darken(0.2f, on_half_of_box);
	for (int i = 0; i < N; i++)
		for (int c = 0; c < 3; c++) {
			layers[i] = on_half_of_box(i);
			image_channel(&traced, albedo[c])[i] = on_half_of_box(i) ? 0 : 0.5f;
		}
	expect_all_passed();
	ck_assert_int_eq(state(GATE_N), SCORE_PASSED);
	darken(0.2f, on_box); /* the film covers half of it; the dark area ends at no edge anyway */
	expect_failed(GATE_N);
}
END_TEST

/* A drawn shadow replaced by the traced one has another position and normal; both end where the floor is lit. */
START_TEST(dark_in_place_of_a_trick)
{
	static const char *const place[3] = { "P.X", "P.Y", "P.Z" };

	add_surfaces(0);
	darken(0.2f, on_half_of_box);
	for (int i = 0; i < N; i++)
		if (on_half_of_box(i)) {
			image_channel(&traced, place[2])[i] -= 5 + (float)(i % 7);
			image_channel(&traced, "id")[i] = 2;
		}
	expect_failed(GATE_N);
	ck_assert_int_eq(image_set_attribute(&traced, "relume:left-out", "%s", "2"), 0);
	expect_all_passed();
	ck_assert_int_eq(image_set_attribute(&traced, "relume:left-out", "%s", "3-9"), 0);
	expect_failed(GATE_N);
}
END_TEST

START_TEST(dark_faces_with_lit_normals)
{
	add_surfaces(1);
	darken(0.2f, on_half_of_box);
	expect_failed(GATE_N);
	ck_assert_double_gt(score.gates[GATE_N].value[1], 10);
	/* Ambient occlusion may remove this much. */
	ck_assert_int_eq(image_set_attribute(&traced, "relume:dimmed", "%s", "0.51"), 0);
	run();
	ck_assert_double_gt(score.gates[GATE_N].value[1], 10);
	darken(0.4f, on_half_of_box);
	run();
	ck_assert_double_eq(score.gates[GATE_N].value[1], 0);
}
END_TEST

START_TEST(named_faults)
{
	add_surfaces(0);
	darken(0.2f, on_half_of_box);
	ck_assert_int_eq(image_set_attribute(&traced, "relume:cards", "%s", "2-3"), 0);
	expect_all_passed(); /* the box is draw 1 */
	ck_assert_int_eq(image_set_attribute(&traced, "relume:cards", "%s", "1"), 0);
	expect_failed(GATE_N);
	ck_assert_int_eq(image_set_attribute(&traced, "relume:cards", "%s", ""), 0);
	expect_all_passed();
	ck_assert_int_eq(image_set_attribute(&traced, "relume:targets", "%s", "3,1"), 0);
	expect_failed(GATE_N);
}
END_TEST

/* Add white light where `where` says so, instead of shadows, consistently in the channels. */
static void brighten(float light, int where(int i))
{
	darken(1, on_box);
	for (int c = 0; c < 3; c++) {
		char name[16];
		float *relight;

		snprintf(name, sizeof(name), "relight.%c", "RGB"[c]);
		relight = add(&traced, name);
		for (int i = 0; i < N; i++) {
			relight[i] = where(i) ? light : 0;
			image_channel(&traced, (const char[]){ "RGB"[c], 0 })[i] += relight[i];
		}
	}
}

/* Give the box a single colour, in OpenGL's picture and as its surface. */
static void color_box(float red, float other)
{
	static const char *const names[3][3] = { { "gl.R", "gl.G", "gl.B" },
		                                 { "albedo.R", "albedo.G", "albedo.B" },
		                                 { "R", "G", "B" } };

	for (int i = 0; i < N; i++)
		for (int layer = 0; layer < 3 && on_box(i); layer++)
			for (int c = 0; c < 3; c++)
				image_channel(&traced, names[layer][c])[i] = c ? other : red;
}

static enum score_state harm_of_light(float red, float other, float light, int where(int i))
{
	remake_traced(&all);
	add_surfaces(0);
	color_box(red, other);
	brighten(light, where);
	run();
	return state(GATE_N);
}

static int on_corner_of_box(int i)
{
	return on_box(i) && i % WIDTH < 30 && i / WIDTH < 35;
}

static int on_edge_of_box(int i)
{
	return on_box(i) && i % WIDTH < 40;
}

START_TEST(burnt_out)
{
	ck_assert_int_eq(harm_of_light(0.6f, 0.1f, 0.45f, on_corner_of_box), SCORE_PASSED); /* a highlight */
	ck_assert_double_gt(score.gates[GATE_N].value[2], 0);
	ck_assert_int_eq(harm_of_light(0.6f, 0.1f, 0.45f, on_box), SCORE_FAILED);
	ck_assert_double_gt(score.gates[GATE_N].value[2], 20);
	ck_assert_double_eq(score.gates[GATE_N].value[0], 0);
	ck_assert_int_gt(score.n_blame, 0);
	ck_assert_uint_eq(score.blame[0].draw, 1);
	ck_assert_int_eq(harm_of_light(0.6f, 0.1f, 0.3f, on_box), SCORE_PASSED); /* brighter, but no channel is full */
	ck_assert_int_eq(harm_of_light(0.5f, 0.5f, 0.5f, on_box), SCORE_FAILED); /* grey becomes white */
	ck_assert_int_eq(harm_of_light(1, 1, 0.5f, on_box), SCORE_PASSED);       /* it was already white */
	for (int by = 15; by <= 16; by++) { /* codes that differ visibly */
		const float dark = image_linear_from_display((float)(253 - by) / 255),
			    light = image_linear_from_display(253.0f / 255);

		ck_assert_int_eq(harm_of_light(dark, dark, light - dark, on_box), by == 16 ? SCORE_FAILED : SCORE_PASSED);
	}
}
END_TEST

/* A moving lamp: overexposure in one place replaces that in another. Full red is a colour, and not overexposed. */
START_TEST(burnt_elsewhere)
{
	static const char *const shadow[3] = { "shadow.R", "shadow.G", "shadow.B" }, *const gl[3] = { "gl.R", "gl.G", "gl.B" };

	ck_assert_int_eq(harm_of_light(0.6f, 0.1f, 0.45f, on_edge_of_box), SCORE_FAILED);
	for (int i = 0; i < N; i++)
		for (int c = 0; c < 3 && on_box(i) && !on_edge_of_box(i); c++) {
			image_channel(&traced, gl[c])[i] = c ? 0.55f : 1.05f;
			image_channel(&traced, shadow[c])[i] = c ? 0.1f / 0.55f : 0.6f / 1.05f;
		}
	run();
	ck_assert_double_eq(score.gates[GATE_N].value[2], 0);
	remake_traced(&all);
	add_surfaces(0);
	color_box(0.6f, 0.01f);
	brighten(0, on_box);
	for (int i = 0; i < N; i++)
		image_channel(&traced, "relight.R")[i] = on_box(i) ? 0.5f : 0;
	run();
	ck_assert_double_eq(score.gates[GATE_N].value[2], 0);
}
END_TEST

/* P */

START_TEST(drift_that_no_pixel_shows)
{
	struct score_bar bar = { GATE_P, 0, 0.01, NAN, NAN };

	shift_codes(0, HEIGHT, 2); /* no pixel differs by more than R1 allows: FLIP is reported, but does not decide */
	expect_all_passed();
	ck_assert_double_gt(score.gates[GATE_P].value[0], 0.02);
	ck_assert_str_eq(score.gates[GATE_P].note, "over its bar, but no pixel is off by more than R1 allows");
	options.bars = &bar; /* a bar makes it decide */
	options.n_bars = 1;
	expect_failed(GATE_P);
	options.n_bars = 0;
	for (int i = 0; i < 3; i++) /* a pixel beyond R1, which tolerates 0.1 % */
		image_channel(&traced, (const char *[]){ "gl.R", "gl.G", "gl.B" }[i])[777] = 0.5f;
	expect_failed(GATE_P);
	ck_assert_int_eq(state(GATE_R1), SCORE_PASSED);
}
END_TEST

START_TEST(gamma_twice)
{
	for (int c = 0; c < 3; c++)
		for (int i = 0; i < N; i++) {
			float *v = &image_channel(&traced, (const char *[]){ "gl.R", "gl.G", "gl.B" }[c])[i];

			*v = image_display_from_linear(*v);
		}
	expect_failed(GATE_R1);
	ck_assert_int_eq(state(GATE_P), SCORE_FAILED);
}
END_TEST

/* Plain pictures */

START_TEST(plain_pictures_are_compared_by_colour)
{
	struct score_picture against = { 0 };

	ck_assert_int_eq(score_picture_from_image(&reference, "beauty", &against), 0);
	against.depth = NULL;
	strcpy(reference.channels[3].name, "unused"); /* was gl.depth */
	ck_assert_int_eq(score_frame(&against, &reference, 3, &options, NULL, &score), 0);
	ck_assert_int_eq(score.outcome, SCORE_FRAME_PASSED);
	ck_assert_int_eq(state(GATE_R1), SCORE_PASSED);
	ck_assert_int_eq(state(GATE_R2), SCORE_NOT_MEASURED);
	ck_assert_int_eq(state(GATE_R5), SCORE_NOT_MEASURED);
	ck_assert_int_eq(state(GATE_E1), SCORE_NOT_MEASURED);
	against.rgb[3 * 777 + 1] ^= 64;
	against.rgb[3 * 778 + 1] ^= 64;
	memset(against.rgb, 200, 3 * 30);
	ck_assert_int_eq(score_frame(&against, &reference, 3, &options, NULL, &score), 0);
	ck_assert_int_eq(score.outcome, SCORE_FRAME_FAILED);
	score_picture_free(&against);
}
END_TEST

/* Bars of a configuration, masks */

START_TEST(warnings_and_improvements)
{
	struct score_bar bars[2] = { { GATE_P, 0, NAN, 0.001, NAN }, { GATE_R1, 0, NAN, NAN, 1e-6 } };

	options.bars = bars;
	options.n_bars = 1;
	expect_all_passed();
	ck_assert_int_eq(state(GATE_P), SCORE_PASSED);
	shift_codes(0, 10, 1); /* a twelfth of the picture: a FLIP of 0.0025 */
	expect_all_passed();
	ck_assert_int_eq(state(GATE_P), SCORE_WARNED);
	bars[0].bar = 0.001;
	expect_failed(GATE_P);
	bars[0] = (struct score_bar){ GATE_R1, 0, NAN, NAN, 0.5 }; /* 0 is stricter than the default */
	bars[0].better = 0.05;
	expect_failed(GATE_R1);
	ck_assert(score.gates[GATE_R1].better_than_expected);
}
END_TEST

START_TEST(ignored_pixels_do_not_count)
{
	static uint8_t ignore[N];
	struct drawing d = all;

	d.bar = 0;
	remake_traced(&d);
	expect_failed(GATE_R3);
	for (int y = 99; y < 109; y++)
		memset(ignore + y * WIDTH + 124, 1, 14);
	picture.ignore = ignore;
	expect_all_passed();
	ck_assert_uint_eq(score.failing_pixels, 0);
	ck_assert_double_eq(score.gates[GATE_P].value[0], 0);
	d.disc = 0; /* pixels that are not ignored still count */
	remake_traced(&d);
	expect_failed(GATE_R3);
}
END_TEST

START_TEST(demanded_channels)
{
	static const char *const names[] = { "shadow.R", "refract.G" };

	options.channels = names;
	options.n_channels = 1;
	expect_all_passed();
	options.n_channels = 2;
	expect_failed(GATE_V);
	ck_assert_ptr_nonnull(strstr(score.gates[GATE_V].note, "refract.G"));
}
END_TEST

/* 0: effects were disabled; 1: the beauty was denoised. */
START_TEST(left_out_effects_are_not_measured)
{
	static const char *const why[][2] = { { "relume:aov", "gl,reflect,relight,refract" }, { "relume:denoised", "1" } };

	for (size_t c = 0; c < traced.n_channels; c++)
		if (strncmp(traced.channels[c].name, "shadow", 6) == 0)
			traced.channels[c].name[0] = 'x';
	expect_failed(GATE_E1);
	ck_assert_int_eq(image_set_attribute(&traced, why[_i][0], "%s", why[_i][1]), 0);
	expect_all_passed();
	ck_assert_int_eq(state(GATE_E1), SCORE_NOT_MEASURED);
	ck_assert_int_eq(state(GATE_E2), SCORE_NOT_MEASURED);
}
END_TEST

/* B */

static struct image before;

/* Make an approved frame from the drawing, and its comparison with the traced frame. */
static void approve(const struct drawing *d, struct score_approved *approved)
{
	struct image kept = traced;

	traced = (struct image){ 0 };
	make_traced(d);
	before = traced;
	traced = kept;
	*approved = (struct score_approved){ .image = &before, .same_channels = 1 };
}

static void run_approved(const struct score_approved *approved)
{
	ck_assert_int_eq(score_frame(&picture, &traced, 12, &options, approved, &score), 0);
}

START_TEST(baseline_by_hash)
{
	struct score_approved approved = { .same_hashes = 1, .same_device = 1, .same_channels = 1 };

	run_approved(&approved);
	ck_assert_int_eq(state(GATE_B), SCORE_PASSED);
	approved.same_hashes = 0; /* the same device must give the same bytes; otherwise something has changed */
	run_approved(&approved);
	ck_assert_int_eq(state(GATE_B), SCORE_FAILED);
	approved.same_device = 0; /* no frame to compare with */
	run_approved(&approved);
	ck_assert_int_eq(state(GATE_B), SCORE_NOT_MEASURED);
}
END_TEST

START_TEST(baseline_of_another_device)
{
	struct score_approved approved;
	float *red = image_channel(&traced, "R");

	approve(&all, &approved);
	for (int i = 0; i < N; i++)
		red[i] *= 1 + 0x1p-11f; /* different last bits */
	run_approved(&approved);
	ck_assert_int_eq(state(GATE_B), SCORE_PASSED);
	red[7] += 0.01f; /* 1 of 19,200 pixels is 0.005 % */
	run_approved(&approved);
	ck_assert_int_eq(state(GATE_B), SCORE_PASSED);
	red[8] += 0.01f;
	run_approved(&approved);
	ck_assert_int_eq(state(GATE_B), SCORE_FAILED);
	approved.same_channels = 0;
	red[7] -= 0.01f;
	run_approved(&approved);
	ck_assert_int_eq(state(GATE_B), SCORE_FAILED);
	image_free(&before);
}
END_TEST

START_TEST(baseline_sees_lost_shadows_and_names_the_draw)
{
	struct score_approved approved;

	approve(&all, &approved);
	for (int c = 0; c < 3; c++) {
		float *shadow = image_channel(&traced, (const char *[]){ "shadow.R", "shadow.G", "shadow.B" }[c]);
		float *beauty = image_channel(&traced, (const char[]){ "RGB"[c], 0 });

		for (int i = 0; i < N; i++) {
			beauty[i] /= shadow[i];
			shadow[i] = 1;
		}
	}
	run_approved(&approved);
	ck_assert_int_eq(state(GATE_B), SCORE_FAILED);
	ck_assert_int_eq(state(GATE_E1), SCORE_PASSED);
	ck_assert_double_gt(score.gates[GATE_B].value[1], 0.01);
	ck_assert_uint_eq(score.blame[0].draw, 1);
	ck_assert_uint_eq(score.blame[0].x0, 20);
	ck_assert_uint_eq(score.blame[0].x1, 39);
	image_free(&before);
}
END_TEST

START_TEST(pixels_of_programs_are_counted)
{
	struct drawing d = all;

	d.other_texture = 1;
	remake_traced(&d);
	ck_assert_int_eq(image_set_attribute(&traced, "relume:programs", "%s",
	                                     "program object 7=1-1;vertex program 3=2-2;program object "
	                                     "9=1-2;odd;none=900-901;fragment program 1="),
	                 0);
	run();
	ck_assert_uint_eq(score.n_programs, 3);
	ck_assert_str_eq(score.programs[0].name, "program object 7");
	ck_assert_str_eq(score.programs[1].name, "vertex program 3");
	ck_assert_uint_gt(score.programs[0].failing, score.programs[0].pixels / 2);
	ck_assert_uint_eq(score.programs[1].failing, 0);
	ck_assert_uint_gt(score.programs[1].pixels, 0);
	ck_assert_uint_eq(score.programs[2].pixels, score.programs[0].pixels + score.programs[1].pixels);
	ck_assert_uint_eq(score.programs[2].failing, score.programs[0].failing);
}
END_TEST

START_TEST(blame_of_a_missing_draw_by_the_approved_frame)
{
	struct score_approved approved;
	struct drawing d = all;

	approve(&all, &approved);
	d.bar = 0;
	remake_traced(&d);
	run_approved(&approved);
	ck_assert_uint_eq(score.blame[0].draw, 3);
	ck_assert(score.blame[0].is_approved);
	image_free(&before);
}
END_TEST

START_TEST(codes_round_trip)
{
	for (int i = 0; i < 256; i++)
		ck_assert_int_eq(score_code_from_linear(image_linear_from_display((float)i / 255)), i);
	for (uint32_t bits = 0; bits < 0x40000000; bits += 977) {
		float linear, display;

		memcpy(&linear, &bits, sizeof(linear));
		display = 255 * fminf(image_display_from_linear(linear), 1);
		ck_assert_msg(score_code_from_linear(linear) == (int)lrintf(display), "%.9g: %d, %.9g", (double)linear,
		              score_code_from_linear(linear), (double)display);
	}
	ck_assert_int_eq(score_code_from_linear(NAN), 0);
	ck_assert_int_eq(score_code_from_linear(-1), 0);
	ck_assert_int_eq(score_code_from_linear(7), 255);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("gates");

	tcase_add_checked_fixture(tests, begin, end);
	tcase_add_test(tests, good_frame_passes_every_gate);
	tcase_add_test(tests, half_channels_pass);
	tcase_add_test(tests, one_nan_in_any_channel);
	tcase_add_test(tests, wrong_size);
	tcase_add_test(tests, wrong_frame_number);
	tcase_add_test(tests, missing_channels);
	tcase_add_test(tests, interior_colour);
	tcase_add_test(tests, few_interior_pixels_may_exceed);
	tcase_add_test(tests, blended_pixels_have_a_bar_of_their_own);
	tcase_add_test(tests, edges_may_move_by_a_rounding);
	tcase_add_test(tests, wrong_edges);
	tcase_add_test(tests, missing_draw);
	tcase_add_test(tests, wrong_texture);
	tcase_add_test(tests, texture_off_by_one_texel);
	tcase_add_test(tests, shifted_by_one_pixel);
	tcase_add_test(tests, mirrored);
	tcase_add_test(tests, missing_draw_of_the_background_s_colour);
	tcase_add_test(tests, silhouette_without_depth_reference);
	tcase_add_test(tests, depth);
	tcase_add_test(tests, depth_of_16_bits);
	tcase_add_test(tests, channels_that_do_not_add_up);
	tcase_add_test(tests, unexplained_difference);
	tcase_add_test(tests, effects_within_their_range);
	tcase_add_test(tests, dark_without_an_edge);
	tcase_add_test(tests, dark_below_a_film);
	tcase_add_test(tests, dark_in_place_of_a_trick);
	tcase_add_test(tests, dark_faces_with_lit_normals);
	tcase_add_test(tests, named_faults);
	tcase_add_test(tests, burnt_out);
	tcase_add_test(tests, burnt_elsewhere);
	tcase_add_test(tests, drift_that_no_pixel_shows);
	tcase_add_test(tests, gamma_twice);
	tcase_add_test(tests, plain_pictures_are_compared_by_colour);
	tcase_add_test(tests, warnings_and_improvements);
	tcase_add_test(tests, ignored_pixels_do_not_count);
	tcase_add_test(tests, demanded_channels);
	tcase_add_loop_test(tests, left_out_effects_are_not_measured, 0, 2);
	tcase_add_test(tests, baseline_by_hash);
	tcase_add_test(tests, baseline_of_another_device);
	tcase_add_test(tests, baseline_sees_lost_shadows_and_names_the_draw);
	tcase_add_test(tests, pixels_of_programs_are_counted);
	tcase_add_test(tests, blame_of_a_missing_draw_by_the_approved_frame);
	tcase_add_test(tests, codes_round_trip);
	return run_case(tests, "gates");
}
