#include "verbs/render/check/made.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "base/err.h"
#include "gl_tokens.h"

static const float pi = 3.14159265f;

static void project(float p[16], float aspect, float tangent)
{
	const float near = 1, far = 100;

	if (tangent > 0) {
		p[0] = 1 / tangent;
		p[5] = aspect / tangent;
		p[10] = -(far + near) / (far - near);
		p[14] = -2 * far * near / (far - near);
		p[11] = -1;
	} else {
		p[0] = 1;
		p[5] = aspect;
		p[10] = -2 / (far - near);
		p[14] = -(far + near) / (far - near);
		p[15] = 1;
	}
}

void made_init(struct made *made, uint32_t width, uint32_t height, float tangent)
{
	struct scene *s = &made->scene;

	memset(made, 0, sizeof(*made));
	s->width = width;
	s->height = height;
	s->depth_bits = 24;
	s->stencil_bits = 8;
	s->instances = made->instances;
	s->materials = made->materials;
	s->lights = made->lights;
	s->views = &made->view;
	s->currents = &made->current;
	s->clears = &made->clear;
	s->meshes = made->mesh_list;
	s->n_views = s->n_currents = s->n_clears = 1;
	project(made->view.projection, (float)width / (float)height, tangent);
	made->view.viewport[2] = (float)width;
	made->view.viewport[3] = (float)height;
	made->view.scissor[2] = (int32_t)width;
	made->view.scissor[3] = (int32_t)height;
	made->view.depth_range[1] = 1;
	made->current.color[0] = made->current.color[1] = made->current.color[2] = made->current.color[3] = 1;
	made->current.normal[2] = 1;
	for (int u = 0; u < SCENE_MAX_UNITS; u++)
		made->current.texcoord[u][3] = 1;
	made->clear = (struct scene_clear){ .buffers = 7, .scissor = { 0, 0, (int32_t)width, (int32_t)height }, .depth = 1,
		                            .color_mask = 15, .stencil_mask = 255 };
}

void made_free(struct made *made)
{
	for (uint32_t i = 0; i < made->scene.n_meshes; i++) {
		free((void *)made->meshes[i].position);
		free((void *)made->meshes[i].normal);
		free((void *)made->meshes[i].index);
	}
	made->scene.n_meshes = 0;
}

/* The place for one more. If all are taken: the last one, with made->err set. */
static uint32_t take_place(struct made *made, uint32_t *n)
{
	if (*n == MADE_MAX) {
		made->err = err_report(ERR_SYSTEM, NULL, "a scene made by hand holds at most %d of each thing", MADE_MAX);
		return MADE_MAX - 1;
	}
	return (*n)++;
}

uint32_t made_add_material(struct made *made, float diffuse)
{
	const uint32_t number = take_place(made, &made->scene.n_materials);
	struct scene_material *m = &made->materials[number];

	m->lighting = 1;
	m->light_count = made->scene.n_lights;
	m->front.diffuse[0] = m->front.diffuse[1] = m->front.diffuse[2] = diffuse;
	m->front.diffuse[3] = 1;
	m->back = m->front;
	m->shade_model = GL_SMOOTH;
	m->front_face = GL_CCW;
	m->polygon_mode_front = m->polygon_mode_back = GL_FILL;
	m->polygon_stipple = SCENE_NONE;
	m->fog_coord_source = GL_EYE_PLANE_ABSOLUTE_NV;
	m->line_width = m->point_size = 1;
	m->point_size_max = 64;
	m->point_attenuation[0] = 1;
	m->alpha_func = GL_ALWAYS;
	m->depth_test = m->depth_write = 1;
	m->depth_func = GL_LESS;
	m->blend_equation_rgb = m->blend_equation_alpha = GL_FUNC_ADD;
	m->color_mask = 15;
	return number;
}

uint32_t made_add_light(struct made *made, float x, float y, float z, float w)
{
	const uint32_t number = take_place(made, &made->scene.n_lights);

	made->lights[number] = (struct scene_light){ .diffuse = { 1, 1, 1, 1 }, .position_eye = { x, y, z, w },
		                                     .spot_direction_eye = { 0, 0, -1 }, .spot_cutoff_deg = 180,
		                                     .attenuation = { 1, 0, 0 }, .index = number };
	return number;
}

uint32_t made_add_triangles(struct made *made, uint32_t material, const float (*position)[3], const float (*normal)[3],
                            uint32_t n)
{
	const uint32_t i = made->scene.n_meshes;
	float *positions = malloc(n * 4 * sizeof(float)), *normals = malloc(n * 3 * sizeof(float));
	uint32_t *index = malloc(n * sizeof(uint32_t));

	if (!positions || !normals || !index || i == MADE_MAX) {
		free(positions);
		free(normals);
		free(index);
		made->err = err_report(ERR_SYSTEM, NULL, "no room for %u triangles", n / 3);
		return 0;
	}
	for (uint32_t v = 0; v < n; v++) {
		memcpy(positions + 4 * v, position[v], 3 * sizeof(float));
		positions[4 * v + 3] = 1;
		memcpy(normals + 3 * v, normal[v], 3 * sizeof(float));
		index[v] = v;
	}
	made->meshes[i] = (struct scene_mesh){ .kind = SCENE_TRIANGLES, .vertex_count = n, .primitive_count = n / 3,
		                               .attributes = SCENE_HAS_NORMAL, .position = positions, .normal = normals,
		                               .index = index };
	made->meshes[i].hash[0] = XXH3_64bits(positions, n * 4 * sizeof(float));
	made->meshes[i].hash[1] = XXH3_64bits(normals, n * 3 * sizeof(float));
	made->mesh_list[i] = &made->meshes[i];
	made->instances[i] = (struct scene_instance){ .mesh = i, .material = material, .draw = i + 1,
		                                      .first_primitive = made->scene.n_primitives };
	for (int k = 0; k < 4; k++)
		made->instances[i].modelview[5 * k] = 1;
	made->scene.n_meshes = made->scene.n_instances = made->scene.n_draws = i + 1;
	made->scene.n_primitives += n / 3;
	return i;
}

/* The corners of a cell's two triangles. */
static const int corners[6][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 0 }, { 1, 1 }, { 0, 1 } };

/* A surface over a grid of cells. @param point  where it is at (x, y) of the grid, and its normal there */
static uint32_t add_grid(struct made *made, uint32_t material, uint32_t columns, uint32_t rows, const void *user,
                         void (*point)(const void *user, float x, float y, float position[3], float normal[3]))
{
	const uint32_t n = columns * rows * 6;
	float (*position)[3] = malloc(n * sizeof(*position)), (*normal)[3] = malloc(n * sizeof(*normal));
	uint32_t at = 0, i = 0;

	for (uint32_t cell = 0; cell < columns * rows && position && normal; cell++) {
		const uint32_t column = cell % columns, row = cell / columns;

		for (int k = 0; k < 6; k++, at++)
			point(user, (float)(column + (uint32_t)corners[k][0]) / (float)columns,
			      (float)(row + (uint32_t)corners[k][1]) / (float)rows, position[at], normal[at]);
	}
	if (at)
		i = made_add_triangles(made, material, (const float (*)[3])position, (const float (*)[3])normal, n);
	else
		made->err = err_report(ERR_SYSTEM, NULL, "out of memory");
	free(position);
	free(normal);
	return i;
}

struct square {
	const float *centre, *u, *v;
	float r;
};

static void point_of_square(const void *user, float x, float y, float position[3], float normal[3])
{
	const struct square *s = user;
	const float a = s->r * (2 * x - 1), b = s->r * (2 * y - 1);

	for (int i = 0; i < 3; i++) {
		position[i] = s->centre[i] + s->u[i] * a + s->v[i] * b;
		normal[i] = s->u[(i + 1) % 3] * s->v[(i + 2) % 3] - s->u[(i + 2) % 3] * s->v[(i + 1) % 3];
	}
}

uint32_t made_add_square(struct made *made, uint32_t material, const float centre[3], const float u[3],
                         const float v[3], float r, uint32_t cells)
{
	return add_grid(made, material, cells, cells, &(struct square){ centre, u, v, r }, point_of_square);
}

struct ball {
	const float *centre;
	float r;
	int inside;
};

static void point_of_ball(const void *user, float x, float y, float position[3], float normal[3])
{
	const struct ball *ball = user;
	const float across = (ball->inside ? 2 : -2) * pi * x, down = pi * y;
	const float d[3] = { sinf(down) * cosf(across), -cosf(down), sinf(down) * sinf(across) };

	for (int i = 0; i < 3; i++) {
		position[i] = ball->centre[i] + ball->r * d[i];
		normal[i] = ball->inside ? -d[i] : d[i];
	}
}

uint32_t made_add_ball(struct made *made, uint32_t material, const float centre[3], float r, uint32_t rings, int inside)
{
	return add_grid(made, material, 2 * rings, rings, &(struct ball){ centre, r, inside }, point_of_ball);
}
