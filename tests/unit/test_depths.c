/* Which draws are solid by depth alone (scene/depths.h). */
#include "scene/depths.h"

#include "gl_tokens.h"
#include "scene/scene.h"
#include "tests/case.h"

enum { DEPTH, LIGHT, N };

/* A body drawn to depth only, then with colour: [0] and [1]. Tests change the request. */
struct body {
	struct scene_instance instances[N];
	struct scene_material materials[N];
	struct scene_view view;
	struct scene_mesh mesh;
	struct scene_clear clear;
	const struct scene_mesh *meshes[1];
	struct scene scene;
};

static void make(struct body *b)
{
	static const float position[12] = { 0, 0, 0, 1, 1, 0, 0, 1, 0, 1, 0, 1 };
	static const uint32_t index[3] = { 0, 1, 2 };

	*b = (struct body){ .instances = { [LIGHT] = { .material = LIGHT } },
		            .view = { .depth_range = { 0, 1 } },
		            .mesh = { .kind = SCENE_TRIANGLES, .vertex_count = 3, .primitive_count = 1 },
		            .clear = { .before_instance = N, .buffers = 2, .scissor = { 0, 0, 64, 48 } } };
	b->mesh.position = position;
	b->mesh.index = index;
	b->meshes[0] = &b->mesh;
	b->materials[DEPTH] = (struct scene_material){ .depth_test = 1, .depth_write = 1, .depth_func = GL_LESS };
	b->materials[LIGHT] = (struct scene_material){ .depth_test = 1, .depth_func = GL_EQUAL, .color_mask = 15, .blend = 1,
		                                       .blend_src_rgb = GL_ONE, .blend_dst_rgb = GL_ONE };
	b->scene = (struct scene){ .width = 64, .height = 48, .instances = b->instances, .n_instances = N,
		                   .materials = b->materials, .n_materials = N, .views = &b->view, .n_views = 1,
		                   .meshes = b->meshes, .n_meshes = 1, .clears = &b->clear };
}

static unsigned is_solid(const struct body *b)
{
	uint8_t depths[N] = { 0 };

	scene_find_depths(&b->scene, depths);
	ck_assert_uint_eq(depths[LIGHT], 0);
	return depths[DEPTH];
}

/* Change a field of a new body, then ask. */
#define CHANGED(field, value) (make(&b), b.field = (value), is_solid(&b))

START_TEST(test_depths)
{
	struct body b;

	make(&b);
	ck_assert_uint_eq(is_solid(&b), 1);
	ck_assert_uint_eq(CHANGED(materials[DEPTH].color_mask, 15), 0);
	ck_assert_uint_eq(CHANGED(materials[DEPTH].depth_write, 0), 0);
	ck_assert_uint_eq(CHANGED(materials[DEPTH].stencil_test, 1), 0);
	ck_assert_uint_eq(CHANGED(materials[DEPTH].depth_func, GL_ALWAYS), 0);
	ck_assert_uint_eq(CHANGED(materials[DEPTH].depth_func, GL_LEQUAL), 1);
	ck_assert_uint_eq(CHANGED(view.depth_range[0], 1), 0);  /* a mask at the far plane */
	ck_assert_uint_eq(CHANGED(view.target, 1), 0);
	ck_assert_uint_eq(CHANGED(scene.n_clears, 1), 0);       /* its depth is cleared later */
	make(&b);
	b.scene.n_clears = 1;
	b.clear.scissor[2] = 32;                                /* only part of it */
	ck_assert_uint_eq(is_solid(&b), 1);
}
END_TEST

START_TEST(test_seen_through)
{
	struct body b;

	ck_assert_uint_eq(CHANGED(materials[LIGHT].blend_dst_rgb, GL_ONE_MINUS_SRC_ALPHA), 0);
	ck_assert_uint_eq(CHANGED(materials[LIGHT].blend, 0), 0); /* a pre-pass for geometry that is then drawn
	                                                             normally */
	b.instances[LIGHT].modelview[12] = 1;                   /* another body */
	ck_assert_uint_eq(is_solid(&b), 1);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("depths");

	tcase_add_test(tests, test_depths);
	tcase_add_test(tests, test_seen_through);
	return run_case(tests, "depths");
}
