/*
 * Conditions that packs do not support (kernels/packs.txt): for each of them a surface that meets it, drawn by the
 * packets' kernels, which then process its points one by one, and by others. All channels must be the same.
 *
 * Compiling the kernels of both takes nearly two minutes of one core with AVX2. limit: 300 s
 */
#include <xxhash.h>

#include "packs.h"
#include "tests/case.h"
#include "tests/driver.h"
#include "tests/truth/scenes.h"

#define WIDTH 24
#define HEIGHT 16

static const float right[3] = { 1, 0, 0 }, up[3] = { 0, 1, 0 };

/* A floor with a texture and a mirror in front of it: the surfaces that the conditions are tried on. */
struct world {
	struct made made;
	struct scene_unit unit;
	struct scene_material *floor, *mirror;
	struct scene_light *light;
	uint32_t stipple[32];
};

static void make(struct world *w)
{
	struct made *t = &w->made;
	uint32_t floor, mirror;

	made_init(t, WIDTH, HEIGHT, 0.6f);
	truth_add_texture(t, &w->unit);
	w->unit.combine_rgb = w->unit.combine_alpha = GL_MODULATE;
	for (int i = 0; i < 3; i++) {
		w->unit.source_rgb[i] = w->unit.source_alpha[i] = (const uint32_t[]){ GL_TEXTURE, GL_PREVIOUS, GL_CONSTANT }[i];
		w->unit.operand_rgb[i] = GL_SRC_COLOR;
		w->unit.operand_alpha[i] = GL_SRC_ALPHA;
	}
	for (int i = 0; i < 32; i++)
		w->stipple[i] = 0x55555555u << i % 2;
	t->scene.stipples = &w->stipple;
	t->scene.n_stipples = 1;
	made_add_light(t, 2, 3, -2, 1);
	floor = made_add_material(t, 0.7f);
	mirror = made_add_material(t, 0.4f);
	made_add_square(t, floor, (float[3]){ 0, 0, -12 }, right, up, 6, 2);
	made_add_square(t, mirror, (float[3]){ -1, -1, -8 }, (float[3]){ 0.7f, 0, 0.7f }, up, 1.3f, 1);
	w->floor = &t->materials[floor];
	w->mirror = &t->materials[mirror];
	w->light = &t->lights[0];
	w->floor->unit_count = 1;
	w->mirror->surface.reflect = 0.6f;
}

/* A condition: how to meet it, and which predicate holds then. */
struct twist {
	const char *member; /* as in packs.txt */
	void (*apply)(struct world *w);
	int (*refused)(const struct world *w);
};

#define TWIST(name, change) \
	static void name(struct world *w) \
	{ \
		change; \
	}
#define REFUSED(name, predicate) \
	static int name(const struct world *w) \
	{ \
		return predicate; \
	}
REFUSED(by_shade, pack_refuses_shade(w->floor))
REFUSED(by_unit, pack_refuses_shade_unit(&w->unit))
REFUSED(by_rays, pack_refuses_rays(w->floor))
REFUSED(by_light, pack_refuses_rays_light(w->light))
REFUSED(by_hits, pack_refuses_hits(w->floor))
REFUSED(by_bounces, pack_refuses_bounces(w->floor))
REFUSED(by_plain, pack_refuses_plain(w->floor))
REFUSED(by_layers, pack_refuses_layers(w->floor, 1, 0))
REFUSED(by_fog, pack_refuses_fog(w->floor) && pack_refuses_shade(w->floor))
REFUSED(by_vertices, pack_refuses_vertices(w->floor) && pack_refuses_shade(w->floor))
REFUSED(by_vertices_unit, pack_refuses_vertices_unit(&w->unit))

TWIST(fog_exp, w->floor->fog = 1; w->floor->fog_mode = GL_EXP; w->floor->fog_density = 0.02f)
TWIST(fog_exp2, w->floor->fog = 1; w->floor->fog_mode = GL_EXP2; w->floor->fog_density = 0.02f)
TWIST(stippled, w->floor->polygon_stipple = 0)
TWIST(samples_off, w->floor->multisample = 1; w->floor->samples_off = 1)
TWIST(alpha_to_coverage, w->floor->alpha_to_coverage = 1)
TWIST(alpha_to_one, w->floor->alpha_to_one = 1)
TWIST(clipped, w->floor->clip_plane_mask = 1; w->floor->clip_plane_eye[0][0] = 1)
TWIST(alpha_tested, w->floor->alpha_test = 1; w->floor->alpha_func = GL_GREATER; w->floor->alpha_ref = 0.5f)
TWIST(stencil_tested, w->floor->stencil_test = 1; w->floor->stencil_front.func = GL_ALWAYS;
      w->floor->stencil_back.func = GL_ALWAYS)
TWIST(blended, w->floor->blend = 1; w->floor->blend_src_rgb = w->floor->blend_src_alpha = GL_SRC_ALPHA;
      w->floor->blend_dst_rgb = w->floor->blend_dst_alpha = GL_ONE_MINUS_SRC_ALPHA)
TWIST(logic_op, w->floor->logic_op = GL_XOR)
TWIST(colorless, w->floor->color_mask = 8)
TWIST(redless, w->floor->color_mask = 14)
TWIST(floats, w->floor->floats = SCENE_FLOATS)
TWIST(srgb, w->floor->srgb = 1)
TWIST(unclamped, w->floor->unclamped = 3)
TWIST(reflecting, w->floor->surface.reflect = 0.3f)
TWIST(transmitting, w->floor->surface.transmit = 0.5f; w->floor->surface.ior = 1.3f; blended(w))
TWIST(rough, w->floor->surface.reflect = 0.3f; w->floor->surface.roughness = 0.05f)
TWIST(creased, w->floor->surface.hidden |= SCENE_CREASED)
TWIST(card, w->floor->surface.hidden |= SCENE_CARD)
TWIST(unmirrored, w->floor->surface.hidden |= SCENE_HIDDEN_FROM_MIRRORS)
TWIST(wrap_s, w->unit.wrap_s = GL_MIRRORED_REPEAT)
TWIST(wrap_t, w->unit.wrap_t = GL_CLAMP)
TWIST(nearest_linear, w->unit.mag_filter = GL_NEAREST)
TWIST(linear_nearest, w->unit.min_filter = GL_NEAREST)
TWIST(mipmap_nearest, w->unit.min_filter = GL_NEAREST_MIPMAP_NEAREST)
TWIST(mipmap_linear, w->unit.min_filter = GL_NEAREST_MIPMAP_LINEAR)
TWIST(swizzled, w->unit.swizzle = SCENE_SWIZZLED | 2 | 1 << 3 | 0 << 6 | 3 << 9)
TWIST(combine4, w->unit.env_mode = GL_COMBINE4_NV; w->unit.combine_rgb = w->unit.combine_alpha = GL_ADD;
      w->unit.source_rgb[3] = w->unit.source_alpha[3] = GL_ZERO; w->unit.operand_rgb[3] = GL_SRC_COLOR;
      w->unit.operand_alpha[3] = GL_SRC_ALPHA)
TWIST(dot3, w->unit.env_mode = GL_COMBINE; w->unit.combine_alpha = GL_DOT3_RGB)
TWIST(dot3_alpha, w->unit.env_mode = GL_COMBINE; w->unit.combine_alpha = GL_DOT3_RGBA)
TWIST(generated, w->unit.gen_mode[0] = w->unit.gen_mode[1] = GL_OBJECT_LINEAR;
      w->unit.gen_object_plane[0][0] = w->unit.gen_object_plane[1][1] = 0.7f)
TWIST(wide_light, w->light->radius = 0.3f)

static const struct twist twists[] = {
	{ "fog_mode", fog_exp, by_fog },
	{ "fog_mode", fog_exp2, by_fog },
	{ "polygon_stipple", stippled, by_shade },
	{ "samples_off", samples_off, by_layers },
	{ "alpha_to_coverage", alpha_to_coverage, by_layers },
	{ "alpha_to_one", alpha_to_one, by_layers },
	{ "alpha_to_one", alpha_to_one, by_plain },
	{ "clip_plane_mask", clipped, by_shade },
	{ "alpha_test", alpha_tested, by_hits },
	{ "alpha_test", alpha_tested, by_bounces },
	{ "stencil_test", stencil_tested, by_layers },
	{ "blend", blended, by_hits },
	{ "blend", blended, by_bounces },
	{ "logic_op", logic_op, by_layers },
	{ "color_mask", colorless, by_hits },
	{ "color_mask", redless, by_plain },
	{ "floats", floats, by_layers },
	{ "srgb", srgb, by_layers },
	{ "unclamped", unclamped, by_vertices },
	{ "surface.reflect", reflecting, by_bounces },
	{ "surface.transmit", transmitting, by_layers },
	{ "surface.roughness", rough, by_hits },
	{ "surface.hidden", creased, by_shade },
	{ "surface.hidden", card, by_rays },
	{ "surface.hidden", unmirrored, by_hits },
	{ "wrap_s", wrap_s, by_unit },
	{ "wrap_t", wrap_t, by_unit },
	{ "min_filter", nearest_linear, by_unit },
	{ "min_filter", linear_nearest, by_unit },
	{ "min_filter", mipmap_nearest, by_unit },
	{ "min_filter", mipmap_linear, by_unit },
	{ "swizzle", swizzled, by_unit },
	{ "env_mode", combine4, by_unit },
	{ "combine_alpha", dot3, by_unit },
	{ "combine_alpha", dot3_alpha, by_unit },
	{ "gen_mode", generated, by_vertices_unit },
	{ "radius", wide_light, by_light },
};
#define N_TWISTS (sizeof(twists) / sizeof(twists[0]))

/* Every member with a condition is tried. */
START_TEST(all_conditions_are_tried)
{
	FILE *list = fopen("kernels/packs.txt", "r");
	char line[256], member[64], kind[64];
	int conditions = 0;

	ck_assert_ptr_nonnull(list);
	while (fgets(line, sizeof(line), list)) {
		int found = 0;

		if (line[0] == '#' || strncmp(line, "kind ", 5) == 0 || sscanf(line, "%63s %63[a-z]:", member, kind) != 2 ||
		    strcmp(member, "struct") == 0)
			continue;
		conditions++;
		for (size_t i = 0; i < N_TWISTS; i++)
			found |= strcmp(twists[i].member, member) == 0;
		ck_assert_msg(found, "packs refuse some %s, but no picture here has them", member);
	}
	fclose(list);
	ck_assert_int_gt(conditions, 20);
}
END_TEST

static uint64_t draw(struct tracer *tracer, const struct world *w, enum tracer_mode mode)
{
	struct tracer_options options = { .mode = mode, .display = 1, .depth = 3, .rays = 2 };
	struct image img = { .width = 0 };
	uint64_t hash = 0;

	ck_assert_int_eq(tracer_render(tracer, &w->made.scene, &options, &img), 0);
	for (uint32_t i = 0; i < img.n_channels; i++)
		hash = XXH64(image_values(&img, i), sizeof(float) * img.width * img.height, hash);
	image_free(&img);
	return hash;
}

START_TEST(refused_points_look_the_same)
{
	static const enum device_family families[] = { FAMILY_PACKETS, FAMILY_BINARY };
	static const enum tracer_mode modes[] = { TRACER_GL, TRACER_WHITTED, TRACER_PATH };
	struct tracer *tracers[2] = { NULL, NULL };
	struct device *devices[2];

	for (int k = 0; k < 2; k++) {
		ck_assert_int_eq(device_open("0", 0, &devices[k]), 0);
		device_choose_family(devices[k], families[k]);
		ck_assert_int_eq(tracer_create(&tracers[k], devices[k]), 0);
	}
	for (const struct twist *twist = twists; twist < twists + N_TWISTS; twist++) {
		struct world w;

		make(&w);
		ck_assert_msg(!twist->refused(&w), "%s: refused without the condition", twist->member);
		twist->apply(&w);
		ck_assert_msg(twist->refused(&w), "%s: not refused", twist->member);
		for (size_t i = 0; i < sizeof(modes) / sizeof(modes[0]); i++)
			ck_assert_msg(draw(tracers[0], &w, modes[i]) == draw(tracers[1], &w, modes[i]),
			              "%s: packets draw another picture in mode %d", twist->member, modes[i]);
		made_free(&w.made);
	}
	for (int k = 0; k < 2; k++) {
		tracer_destroy(&tracers[k]);
		device_close(&devices[k]);
	}
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("packs");

	tcase_set_timeout(tcase, 300);
	tcase_add_test(tcase, all_conditions_are_tried);
	if (!lacks_driver())
		tcase_add_test(tcase, refused_points_look_the_same);
	return run_case(tcase, "packs");
}
