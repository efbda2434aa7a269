/* Scenes built by hand for the truth tests: meshes, materials and views without a recording. */
#pragma once

#include <check.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "scene/scene.h"
#include "tracer/device/device.h"
#include "tracer/image/image.h"
#include "tracer/frame/trace.h"

#define TRUTH_MAX 8

/* A scene that owns everything it points to; free with truth_free. */
struct truth {
	struct scene scene;
	struct scene_instance instances[TRUTH_MAX];
	struct scene_material materials[TRUTH_MAX];
	struct scene_light lights[TRUTH_MAX];
	struct scene_view view;
	struct scene_current current;
	struct scene_clear clear;
	struct scene_mesh meshes[TRUTH_MAX];
	const struct scene_mesh *mesh_list[TRUTH_MAX];
};

/** An empty frame with a perspective of the given half-angle tangent (0: parallel, 2 units wide), near 1, far 100. */
static inline void truth_init(struct truth *t, uint32_t width, uint32_t height, float tangent)
{
	const float near = 1, far = 100;
	float *p = t->view.projection;

	memset(t, 0, sizeof(*t));
	t->scene.width = width;
	t->scene.height = height;
	t->scene.depth_bits = 24;
	t->scene.stencil_bits = 8;
	t->scene.instances = t->instances;
	t->scene.materials = t->materials;
	t->scene.lights = t->lights;
	t->scene.views = &t->view;
	t->scene.currents = &t->current;
	t->scene.clears = &t->clear;
	t->scene.meshes = t->mesh_list;
	t->scene.n_views = t->scene.n_currents = t->scene.n_clears = 1;
	if (tangent > 0) {
		p[0] = 1 / tangent;
		p[5] = (float)width / (float)height / tangent;
		p[10] = -(far + near) / (far - near);
		p[14] = -2 * far * near / (far - near);
		p[11] = -1;
	} else {
		p[0] = 1;
		p[5] = (float)width / (float)height;
		p[10] = -2 / (far - near);
		p[14] = -(far + near) / (far - near);
		p[15] = 1;
	}
	t->view.viewport[2] = (float)width;
	t->view.viewport[3] = (float)height;
	t->view.scissor[2] = (int32_t)width;
	t->view.scissor[3] = (int32_t)height;
	t->view.depth_range[1] = 1;
	t->current.color[0] = t->current.color[1] = t->current.color[2] = t->current.color[3] = 1;
	t->current.normal[2] = 1;
	t->clear = (struct scene_clear){ .buffers = 7, .scissor = { 0, 0, (int32_t)width, (int32_t)height }, .depth = 1,
		                         .color_mask = 15, .stencil_mask = 255 };
}

static inline void truth_free(struct truth *t)
{
	for (uint32_t i = 0; i < t->scene.n_meshes; i++) {
		free((void *)t->meshes[i].position);
		free((void *)t->meshes[i].normal);
		free((void *)t->meshes[i].index);
	}
}

/** A matte material of this grey, lit by all lights that were added before. @return its index */
static inline uint32_t truth_add_material(struct truth *t, float diffuse)
{
	struct scene_material *m = &t->materials[t->scene.n_materials];

	ck_assert_uint_lt(t->scene.n_materials, TRUTH_MAX);
	m->lighting = 1;
	m->light_count = t->scene.n_lights;
	m->front.diffuse[0] = m->front.diffuse[1] = m->front.diffuse[2] = diffuse;
	m->front.diffuse[3] = 1;
	m->back = m->front;
	m->shade_model = GL_SMOOTH;
	m->front_face = GL_CCW;
	m->polygon_mode_front = m->polygon_mode_back = GL_FILL;
	m->polygon_stipple = SCENE_NONE;
	m->fog_coord_source = GL_FRAGMENT_DEPTH;
	m->line_width = m->point_size = 1;
	m->point_size_max = 64;
	m->point_attenuation[0] = 1;
	m->alpha_func = GL_ALWAYS;
	m->depth_test = m->depth_write = 1;
	m->depth_func = GL_LESS;
	m->blend_equation_rgb = m->blend_equation_alpha = GL_FUNC_ADD;
	m->color_mask = 15;
	return t->scene.n_materials++;
}

/** A white light; position in eye space, homogeneous. @return its index */
static inline uint32_t truth_add_light(struct truth *t, float x, float y, float z, float w)
{
	struct scene_light *l = &t->lights[t->scene.n_lights];

	ck_assert_uint_lt(t->scene.n_lights, TRUTH_MAX);
	*l = (struct scene_light){ .diffuse = { 1, 1, 1, 1 }, .position_eye = { x, y, z, w },
		                   .spot_direction_eye = { 0, 0, -1 }, .spot_cutoff_deg = 180,
		                   .attenuation = { 1, 0, 0 }, .index = t->scene.n_lights };
	return t->scene.n_lights++;
}

/**
 * Triangles in eye space.
 * @param position  [n][3]  @param normal [n][3]; n a multiple of 3; both are copied
 */
static inline void truth_add_triangles(struct truth *t, uint32_t material, const float (*position)[3], const float (*normal)[3],
                         uint32_t n)
{
	uint32_t i = t->scene.n_meshes;
	float *positions = malloc(n * 4 * sizeof(float)), *normals = malloc(n * 3 * sizeof(float));
	uint32_t *index = malloc(n * sizeof(uint32_t));

	ck_assert_uint_lt(i, TRUTH_MAX);
	for (uint32_t v = 0; v < n; v++) {
		memcpy(positions + 4 * v, position[v], 3 * sizeof(float));
		positions[4 * v + 3] = 1;
		memcpy(normals + 3 * v, normal[v], 3 * sizeof(float));
		index[v] = v;
	}
	t->meshes[i] = (struct scene_mesh){ .hash = { i + 1, (uint64_t)n << 32 | i }, .kind = SCENE_TRIANGLES,
		                            .vertex_count = n, .primitive_count = n / 3, .attributes = SCENE_HAS_NORMAL,
		                            .position = positions, .normal = normals, .index = index };
	t->mesh_list[i] = &t->meshes[i];
	t->instances[i] = (struct scene_instance){ .mesh = i, .material = material, .draw = i + 1,
		                                   .first_primitive = t->scene.n_primitives };
	for (int k = 0; k < 4; k++)
		t->instances[i].modelview[5 * k] = 1;
	t->scene.n_meshes = t->scene.n_instances = t->scene.n_draws = i + 1;
	t->scene.n_primitives += n / 3;
}

/** A square of side 2 r around a centre: corners centre +- u r +- v r, normal u x v, cut into cells x cells squares. */
static inline void truth_add_square(struct truth *t, uint32_t material, const float centre[3], const float u[3], const float v[3],
                      float r, uint32_t cells)
{
	uint32_t n = cells * cells * 6, at = 0;
	float (*position)[3] = malloc(n * sizeof(*position)), (*normal)[3] = malloc(n * sizeof(*normal));
	static const int corner[6][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 0 }, { 1, 1 }, { 0, 1 } };

	for (uint32_t y = 0; y < cells; y++)
		for (uint32_t x = 0; x < cells; x++)
			for (int k = 0; k < 6; k++, at++) {
				float a = r * (2 * (float)(x + (uint32_t)corner[k][0]) / (float)cells - 1);
				float b = r * (2 * (float)(y + (uint32_t)corner[k][1]) / (float)cells - 1);

				for (int i = 0; i < 3; i++) {
					position[at][i] = centre[i] + u[i] * a + v[i] * b;
					normal[at][i] = u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3];
				}
			}
	truth_add_triangles(t, material, (const float (*)[3])position, (const float (*)[3])normal, n);
	free(position);
	free(normal);
}

/** One number of a channel; x from the left, y from the top. */
static inline float truth_at(const struct image *img, const char *channel, uint32_t x, uint32_t y)
{
	const float *plane = image_channel(img, channel);

	ck_assert_ptr_nonnull(plane);
	return plane[(size_t)y * img->width + x];
}

/** Beauty is what its parts say, at every pixel. */
static inline void truth_check_closure(const struct image *img)
{
	static const char letters[] = "RGB";

	for (int c = 0; c < 3; c++)
		for (uint32_t y = 0; y < img->height; y++)
			for (uint32_t x = 0; x < img->width; x++) {
				float part[6];
				static const char *const names[] = { "", "gl.", "shadow.", "relight.", "reflect.", "refract." };

				for (int i = 0; i < 6; i++) {
					char name[16];

					snprintf(name, sizeof(name), "%s%c", names[i], letters[c]);
					part[i] = truth_at(img, name, x, y);
				}
				ck_assert_float_eq_tol(part[0], part[1] * part[2] + part[3] + part[4] + part[5],
				                       fabsf(part[0]) * 0x1p-9f + 1e-6f);
			}
}

/** Render on the device that environment RELUME_TEST_DEVICE names ("reference" where it names none). */
static inline void truth_render_with(const struct truth *t, const struct tracer_options *options, struct image *img)
{
	const char *choice = getenv("RELUME_TEST_DEVICE");
	struct device *dev = NULL;
	struct tracer *tracer = NULL;

	memset(img, 0, sizeof(*img));
	ck_assert_int_eq(device_open(choice ? choice : "reference", 0, &dev), 0);
	ck_assert_int_eq(tracer_create(&tracer, dev), 0);
	ck_assert_int_eq(tracer_render(tracer, &t->scene, options, img), 0);
	tracer_destroy(&tracer);
	device_close(&dev);
}

static inline void truth_render(const struct truth *t, const char *mode, struct image *img)
{
	struct tracer_options options = { .mode = strcmp(mode, "gl") == 0 ? TRACER_GL : TRACER_WHITTED, .display = 1,
		                          .depth = 4 };

	truth_render_with(t, &options, img);
}
