/*
 * tiny DEVICE FAMILY: scenes of a few pixels that use every kernel, for slow tools that check running kernels (make
 * show-oclgrind). FAMILY: "packets", "binary" or "compressed", the traversal kernels to use. Prints a line for each
 * picture, with a hash of its channels.
 */
#include <stdio.h>
#include <xxhash.h>

#include "tests/truth/scenes.h"

static const float right[3] = { 1, 0, 0 }, up[3] = { 0, 1, 0 };

/* Texels are selected by generated object coordinates. */
static void add_unit(struct made *t, struct scene_unit *unit)
{
	truth_add_texture(t, unit);
	unit->gen_mode[0] = unit->gen_mode[1] = GL_OBJECT_LINEAR;
	unit->gen_object_plane[0][0] = unit->gen_object_plane[1][1] = 0.7f;
}

/* A sky, a textured floor, a mirror, glass, a film and a leaf with holes, also as lines and points. */
static void make_scene(struct made *t, struct scene_unit *unit, uint32_t size)
{
	uint32_t sky, floor, mirror, glass, film, leaf, wire;

	made_init(t, size, size, 0.6f);
	add_unit(t, unit);
	made_add_light(t, 2, 3, -2, 1);
	t->lights[0].specular[0] = 1;
	t->lights[0].radius = 0.3f;
	made_add_light(t, -1, 1, 1, 0);
	t->lights[1].radius = 0.1f;
	sky = made_add_material(t, 0.3f);
	t->materials[sky].lighting = t->materials[sky].depth_write = t->materials[sky].depth_test = 0;
	floor = made_add_material(t, 0.7f);
	t->materials[floor].unit_count = 1;
	t->materials[floor].fog = 1;
	t->materials[floor].fog_mode = GL_EXP;
	t->materials[floor].fog_density = 0.02f;
	mirror = made_add_material(t, 0.4f);
	t->materials[mirror].surface.reflect = 0.6f;
	t->materials[mirror].surface.roughness = 0.05f;
	glass = made_add_material(t, 0.9f);
	t->materials[glass].surface.transmit = 0.9f;
	t->materials[glass].surface.ior = 1.5f;
	t->materials[glass].surface.absorb[1] = 0.2f;
	film = made_add_material(t, 0.9f);
	t->materials[film].blend = 1;
	t->materials[film].blend_src_rgb = t->materials[film].blend_src_alpha = GL_DST_COLOR;
	t->materials[film].blend_dst_rgb = t->materials[film].blend_dst_alpha = GL_ONE;
	leaf = made_add_material(t, 0.5f);
	t->materials[leaf].unit_count = 1;
	t->materials[leaf].alpha_test = 1;
	t->materials[leaf].alpha_func = GL_GREATER;
	t->materials[leaf].alpha_ref = 0.5f;
	wire = made_add_material(t, 0.5f);
	t->materials[wire].polygon_mode_front = GL_LINE;
	t->materials[wire].polygon_mode_back = GL_POINT;
	made_add_square(t, sky, (float[3]){ 0, 0, -40 }, right, up, 30, 1);
	made_add_square(t, floor, (float[3]){ 0, 0, -12 }, right, up, 6, 2);
	made_add_square(t, mirror, (float[3]){ -1, -1, -8 }, (float[3]){ 0.7f, 0, 0.7f }, up, 1.3f, 1);
	made_add_square(t, glass, (float[3]){ 1.2f, 0.6f, -7 }, right, (float[3]){ 0, 0.7f, 0.7f }, 0.8f, 1);
	made_add_square(t, film, (float[3]){ 0.3f, -0.5f, -5 }, right, up, 0.9f, 1);
	made_add_square(t, leaf, (float[3]){ -0.5f, 0.9f, -6 }, right, up, 0.9f, 1);
	made_add_square(t, wire, (float[3]){ 0, 0, -4 }, right, up, 0.5f, 1);
}

static uint64_t hash_of(const struct image *img)
{
	uint64_t hash = 0;

	for (uint32_t i = 0; i < img->n_channels; i++)
		hash = XXH64(image_values(img, i), sizeof(float) * img->width * img->height, hash);
	return hash;
}

static const char *choice, *family;

START_TEST(render_pictures)
{
	static const struct { const char *name; enum tracer_mode mode; int relight; } pictures[] = {
		{ "whitted", TRACER_WHITTED, 0 }, { "relight", TRACER_WHITTED, 1 }, { "ao", TRACER_AO, 0 },
		{ "diffuse", TRACER_DIFFUSE, 0 }, { "path", TRACER_PATH, 0 }
	};
	struct device *dev = NULL;
	struct tracer *tracer = NULL;
	enum device_family kernels = 0;
	struct made t;
	struct scene_unit unit;

	make_scene(&t, &unit, 7);
	ck_assert_int_eq(device_open(choice, 1, &dev), 0);
	while (kernels < N_DEVICE_FAMILIES && strcmp(family, device_family_names[kernels]) != 0)
		kernels++;
	ck_assert_int_lt(kernels, N_DEVICE_FAMILIES);
	device_choose_family(dev, kernels);
	ck_assert_int_eq(tracer_create(&tracer, dev), 0);
	for (size_t i = 0; i < sizeof(pictures) / sizeof(pictures[0]); i++) {
		struct tracer_options options = { .mode = pictures[i].mode, .relight = pictures[i].relight, .display = 1,
			                          .depth = 3, .rays = 2 };
		struct image img = { .width = 0 };

		ck_assert_int_eq(tracer_render(tracer, &t.scene, &options, &img), 0);
		printf("%s %s: %g, all channels %016llx\n", family, pictures[i].name, (double)truth_at(&img, "R", 3, 3),
		       (unsigned long long)hash_of(&img));
		fflush(stdout);
		image_free(&img);
	}
	tracer_destroy(&tracer);
	device_close(&dev);
	made_free(&t);
}
END_TEST

int main(int argc, char **argv)
{
	Suite *suite = suite_create("tiny");
	TCase *tests = tcase_create("tiny");
	SRunner *runner;
	int failed;

	if (argc != 3) {
		fprintf(stderr, "usage: tiny DEVICE packets|binary|compressed\n");
		return 2;
	}
	choice = argv[1];
	family = argv[2];
	tcase_add_test(tests, render_pictures);
	suite_add_tcase(suite, tests);
	runner = srunner_create(suite);
	srunner_set_fork_status(runner, CK_NOFORK); /* device simulators do not survive a fork */
	srunner_run_all(runner, CK_NORMAL);
	failed = srunner_ntests_failed(runner);
	srunner_free(runner);
	return failed != 0;
}
