/*
 * vertex_packet against vertex on each device and on the twins, bit by bit: meshes of a few to many vertices, under
 * random lights, materials, matrices and normals.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "kernels/gl/tables.h"
#include "tests/case.h"
#include "tests/check/on_devices.h"
#include "tracer/device/launch.h"

#define MESHES 400u
#define LONGEST 90u /* in vertices */
#define MATERIALS 128u
#define LIGHTS 8u
#define UNITS 2u
#define VIEWS 4u
#define CURRENTS 4u
#define VERTICES (MESHES * LONGEST)
/* numbers per vertex */
#define EACH (4u + 3u + 4u + 4u + 1u + UNITS * 4u + sizeof(struct scene_face) / sizeof(float) * 2u)
#define HEIGHT 480u

struct content {
	struct geometry geometries[MESHES];
	struct scene_material materials[MATERIALS];
	struct scene_light lights[LIGHTS];
	struct scene_unit units[MATERIALS * UNITS];
	struct scene_current currents[CURRENTS];
	struct view views[VIEWS];
	float attributes[VERTICES * EACH];
	uint32_t owners[VERTICES];
	uint32_t n_vertices, n_coords;
};

struct result {
	struct shaded_vertex shaded[VERTICES];
	struct window_vertex windows[VERTICES];
	float clips[VERTICES][4], coords[VERTICES * UNITS][4];
};

static uint32_t random_state = 11;

static uint32_t next_below(uint32_t n)
{
	random_state = random_state * 1664525u + 1013904223u;
	return (random_state >> 8) % n;
}

static float between(float lo, float hi)
{
	return lo + (hi - lo) * (float)next_below(1u << 20) / (float)(1u << 20);
}

/* Numbers around 0 and 1, and sometimes special values of arithmetic. */
static float next_number(void)
{
	static const float strange[] = { 0, -0.0f, 1, -1, 2, 1e-30f, 1e30f, NAN, INFINITY };

	return next_below(60) ? between(-1, 1.5f) : strange[next_below(9)];
}

static void fill_numbers(float *numbers, size_t n)
{
	for (size_t i = 0; i < n; i++)
		numbers[i] = next_number();
}

static void fill_light(struct scene_light *l, uint32_t i)
{
	fill_numbers(l->ambient, 12);
	for (int k = 0; k < 4; k++)
		l->position_eye[k] = between(-3, 3);
	if (i % 2)
		l->position_eye[3] = 0;
	for (int k = 0; k < 3; k++)
		l->spot_direction_eye[k] = between(-1, 1);
	l->spot_cutoff_deg = i % 4 < 2 ? 180 : between(10, 90);
	l->spot_exponent = i % 8 < 4 ? 0 : between(0, 20);
	l->attenuation[0] = 1;
	l->attenuation[1] = i % 3 ? 0 : 0.3f;
	l->attenuation[2] = i % 3 ? 0 : 0.1f;
	l->radius = i == 5 ? -1 : 0;
}

static uint32_t one_of(const uint32_t *of, uint32_t n)
{
	return of[next_below(n)];
}
#define ONE_OF(...) \
	one_of((const uint32_t[]){ __VA_ARGS__ }, sizeof((const uint32_t[]){ __VA_ARGS__ }) / sizeof(uint32_t))

static void fill_material(struct content *c, uint32_t i)
{
	struct scene_material *m = &c->materials[i];

	m->lighting = next_below(4) != 0;
	m->light_first = next_below(3);
	m->light_count = next_below(LIGHTS - 2);
	m->two_side = next_below(2);
	m->local_viewer = next_below(2);
	m->normalize = next_below(2);
	m->separate_specular = next_below(2);
	m->color_material = ONE_OF(0, GL_FRONT, GL_BACK, GL_FRONT_AND_BACK);
	m->color_material_mode = ONE_OF(GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_EMISSION, GL_AMBIENT_AND_DIFFUSE);
	fill_numbers(m->front.ambient, 16);
	fill_numbers(m->back.ambient, 16);
	if (next_below(2))
		memset(m->front.specular, 0, sizeof(m->front.specular));
	m->front.shininess = next_below(4) ? between(0, 128) : 0;
	m->back.shininess = next_below(4) ? between(0, 128) : 0;
	fill_numbers(m->light_model_ambient, 4);
	m->fog_coord_source = ONE_OF(GL_FOG_COORD, GL_EYE_RADIAL_NV, GL_EYE_PLANE, GL_EYE_PLANE_ABSOLUTE_NV);
	m->unclamped = next_below(8) ? 0 : 2;
	m->surface.hidden = next_below(8) ? 0 : SCENE_UNSHADED;
	m->point_size = between(1, 10);
	m->point_size_min = between(0, 3);
	m->point_size_max = between(3, 10);
	m->point_attenuation[0] = 1;
	m->point_attenuation[1] = next_below(2) ? 0 : next_number();
	m->point_attenuation[2] = next_below(2) ? 0 : next_number();
	m->unit_first = i * UNITS;
	m->unit_count = next_below(UNITS + 1);
	for (uint32_t u = 0; u < m->unit_count; u++) {
		struct scene_unit *unit = &c->units[m->unit_first + u];

		unit->unit = u;
		fill_numbers(unit->matrix, 16);
		unit->gen_mode[next_below(4)] = next_below(6) ? 0 : ONE_OF(GL_OBJECT_LINEAR, GL_EYE_LINEAR, GL_SPHERE_MAP);
		fill_numbers(unit->gen_object_plane[0], 16);
		fill_numbers(unit->gen_eye_plane[0], 16);
	}
}

/* A mesh's arrays, as prepare_layout arranges them. */
static uint32_t fill_attributes(struct content *c, struct geometry *g, uint32_t at)
{
	const uint32_t n = g->vertex_count, from = at;

	g->attributes = next_below(2) * SCENE_HAS_NORMAL | next_below(2) * SCENE_HAS_COLOR |
	                next_below(2) * SCENE_HAS_SECONDARY | next_below(2) * SCENE_HAS_FOG_COORD |
	                (next_below(8) ? 0 : SCENE_HAS_FACE) | next_below(2) * SCENE_HAS_TEXCOORD |
	                next_below(2) * (SCENE_HAS_TEXCOORD << 1);
	g->position = at;
	g->normal = at += 4 * n;
	g->color = at += g->attributes & SCENE_HAS_NORMAL ? 3 * n : 0;
	g->secondary = at += g->attributes & SCENE_HAS_COLOR ? 4 * n : 0;
	g->fog_coord = at += g->attributes & SCENE_HAS_SECONDARY ? 4 * n : 0;
	g->texcoord[0] = at += g->attributes & SCENE_HAS_FOG_COORD ? n : 0;
	g->texcoord[1] = at += g->attributes & SCENE_HAS_TEXCOORD ? 4 * n : 0;
	g->face = at += g->attributes & (SCENE_HAS_TEXCOORD << 1) ? 4 * n : 0;
	at += g->attributes & SCENE_HAS_FACE ? (uint32_t)(2 * sizeof(struct scene_face) / sizeof(float)) * n : 0;
	fill_numbers(&c->attributes[from], at - from);
	for (uint32_t i = 0; i < 4 * n; i++) /* most vertices are in the view volume */
		c->attributes[from + i] = i % 4 == 3 ? 1 : next_below(200) ? between(-0.6f, 0.6f) : next_number();
	if (next_below(2)) /* short and long normals */
		for (uint32_t i = g->normal; i < g->color; i++)
			c->attributes[i] *= (float[]){ 1e-20f, 300, 1e-30f }[g->vertex_count % 3];
	return at;
}

static void fill_geometry(struct content *c, uint32_t i, uint32_t *at)
{
	struct geometry *g = &c->geometries[i];

	g->vertex_first = c->n_vertices;
	g->vertex_count = next_below(3) ? 1 + next_below(LONGEST) : 1 + next_below(5);
	g->texcoord_first = c->n_coords;
	g->material = next_below(MATERIALS);
	g->view = next_below(VIEWS);
	g->current = next_below(CURRENTS);
	for (int k = 0; k < 16; k++) {
		g->eye_from_obj[k] = between(-1, 1);
		g->clip_from_obj[k] = between(-0.3f, 0.3f) + (k % 5 == 0);
		g->normal_matrix[k % 12] = between(-1, 1);
	}
	for (uint32_t v = 0; v < g->vertex_count; v++)
		c->owners[c->n_vertices++] = i;
	c->n_coords += g->vertex_count * c->materials[g->material].unit_count;
	*at = fill_attributes(c, g, *at);
}

static void fill(struct content *c)
{
	uint32_t at = 0;

	memset(c, 0, sizeof(*c));
	for (uint32_t i = 0; i < LIGHTS; i++)
		fill_light(&c->lights[i], i);
	for (uint32_t i = 0; i < MATERIALS; i++)
		fill_material(c, i);
	for (uint32_t i = 0; i < CURRENTS; i++)
		fill_numbers(c->currents[i].color, sizeof(c->currents[i]) / sizeof(float));
	for (uint32_t i = 0; i < VIEWS; i++) {
		const struct view view = { .viewport = { between(-5, 50), between(-5, 50), between(100, 600), between(100, 400) },
			                   .depth_range = { between(0, 0.2f), between(0.7f, 1) } };

		c->views[i] = view;
	}
	for (uint32_t i = 0; i < MESHES; i++)
		fill_geometry(c, i, &at);
}

static void run(struct device *dev, const struct content *c, int packet, struct result *out)
{
	struct device_buffer *b[] = {
		make_buffer(dev, c->geometries, sizeof(c->geometries)), make_buffer(dev, c->materials, sizeof(c->materials)),
		make_buffer(dev, c->lights, sizeof(c->lights)), make_buffer(dev, c->units, sizeof(c->units)),
		make_buffer(dev, c->currents, sizeof(c->currents)), make_buffer(dev, c->attributes, sizeof(c->attributes)),
		make_buffer(dev, c->views, sizeof(c->views)), make_buffer(dev, c->owners, sizeof(c->owners)),
		make_buffer(dev, out->shaded, sizeof(out->shaded)), make_buffer(dev, out->windows, sizeof(out->windows)),
		make_buffer(dev, out->clips, sizeof(out->clips)), make_buffer(dev, out->coords, sizeof(out->coords)),
	};
	const struct tables_launch tables = *LAUNCH(tables, .geometries = { b[0] }, .materials = { b[1] }, .lights = { b[2] },
	                                            .units = { b[3] }, .currents = { b[4] }, .attributes = { b[5] },
	                                            .indices = { b[7] }, .vertices = { b[8] }, .texcoords = { b[11] },
	                                            .textures = { b[0] }, .texels = { b[0] }, .stipples = { b[0] });
	const struct vertex_launch *a = LAUNCH(vertex, .tables = tables, .views = { b[6] }, .owners = { b[7] },
	                                       .height = HEIGHT, .n = c->n_vertices, .shaded = { b[8] },
	                                       .windows = { b[9] }, .clips = { b[10] }, .coords = { b[11] });

	ck_assert_int_eq(packet ? launch_vertex_packet(dev, (c->n_vertices + VERTEX_PACKET - 1) / VERTEX_PACKET, a) :
	                          launch_vertex(dev, c->n_vertices, a), 0);
	ck_assert_int_eq(device_read(dev, b[8], 0, out->shaded, sizeof(out->shaded)), 0);
	ck_assert_int_eq(device_read(dev, b[9], 0, out->windows, sizeof(out->windows)), 0);
	ck_assert_int_eq(device_read(dev, b[10], 0, out->clips, sizeof(out->clips)), 0);
	ck_assert_int_eq(device_read(dev, b[11], 0, out->coords, sizeof(out->coords)), 0);
	for (size_t i = 0; i < sizeof(b) / sizeof(b[0]); i++)
		device_release(dev, &b[i]);
}

/* The bits must be equal, or both NaN. */
static void check_words(const char *device, const char *what, const void *one, const void *packet, size_t bytes,
                        size_t each)
{
	const uint32_t *a = one, *b = packet;

	for (size_t i = 0; i < bytes / 4; i++) {
		const int are_nan = (a[i] & 0x7FFFFFFF) > 0x7F800000 && (b[i] & 0x7FFFFFFF) > 0x7F800000;

		ck_assert_msg(a[i] == b[i] || are_nan, "%s: %s %zu, number %zu: 0x%08x and 0x%08x", device, what,
		              i / (each / 4), i % (each / 4), a[i], b[i]);
	}
}

static void check_device(struct device *dev, void *user)
{
	const struct content *c = user;
	struct result *one = malloc(sizeof(*one)), *packet = malloc(sizeof(*packet));
	uint32_t there = 0, lit = 0;

	ck_assert(one && packet);
	memset(one, 0xee, sizeof(*one));
	memset(packet, 0xee, sizeof(*packet));
	run(dev, c, 0, one);
	run(dev, c, 1, packet);
	for (uint32_t i = 0; i < c->n_vertices; i++) {
		there += one->windows[i].w_inv > 0;
		lit += one->shaded[i].lit[0] != 0;
	}
	ck_assert_msg(there > c->n_vertices / 4 && lit > c->n_vertices / 16, "%u vertices: %u in the window, %u lit",
	              c->n_vertices, there, lit);
	check_words(device_name(dev), "vertex", one->shaded, packet->shaded, sizeof(one->shaded), sizeof(one->shaded[0]));
	check_words(device_name(dev), "window vertex", one->windows, packet->windows, sizeof(one->windows),
	            sizeof(one->windows[0]));
	check_words(device_name(dev), "clip vertex", one->clips, packet->clips, sizeof(one->clips), sizeof(one->clips[0]));
	check_words(device_name(dev), "coordinate", one->coords, packet->coords, sizeof(one->coords), sizeof(one->coords[0]));
	free(one);
	free(packet);
}

START_TEST(test_packet_and_single)
{
	struct content *c = malloc(sizeof(*c));

	ck_assert_ptr_nonnull(c);
	fill(c);
	on_each_device(check_device, c);
	free(c);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("devices");

	tcase_set_timeout(tests, 240);
	tcase_add_test(tests, test_packet_and_single);
	return run_case(tests, "vertex");
}
