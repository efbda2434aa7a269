/*
 * The vertex stage of kernels/gl/vertex.h, inputs of vertex programs, and queries about points of triangles (point.h,
 * stages.h) at known values: attributes from arrays and current ones, two-sided colours, visible side. As in
 * test_formulas.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/gl/program.h"
#include "kernels/gl/stages.h"
#include "kernels/gl/userclip.h"
#include "kernels/gl/vertex_program.h"
#include "tests/case.h"

#define ALMOST 1e-5f

enum { VERTICES = 3, FIRST = 2, UNITS = 2 }; /* the geometry's first vertex in the frame */

/* A frame with one geometry: its arrays in sequence, not starting at offset 0. */
struct world {
	float attributes[256];
	struct geometry geometry;
	struct scene_material material;
	struct scene_unit units[UNITS];
	struct scene_light light;
	struct scene_current current;
	struct view view;
	struct tables tables;
	uint32_t owners[FIRST + VERTICES];
	struct shaded_vertex shaded[FIRST + VERTICES];
	struct window_vertex windows[FIRST + VERTICES];
	float clips[4 * (FIRST + VERTICES)], coords[4 * (3 + UNITS * VERTICES + 1)];
};

static uint32_t add(struct world *w, uint32_t *at, uint32_t size)
{
	const uint32_t first = *at;

	for (uint32_t i = 0; i < size * VERTICES; i++)
		w->attributes[first + i] = (float)(first + i) / 256;
	*at += size * VERTICES;
	return first;
}

static void begin(struct world *w, uint32_t attributes)
{
	uint32_t at = 5;

	memset(w, 0, sizeof(*w));
	w->geometry = (struct geometry){
		.attributes = attributes, .vertex_first = FIRST, .vertex_count = VERTICES, .texcoord_first = 3
	};
	w->geometry.position = add(w, &at, 4);
	w->geometry.normal = add(w, &at, 3);
	w->geometry.color = add(w, &at, 4);
	w->geometry.secondary = add(w, &at, 4);
	w->geometry.fog_coord = add(w, &at, 1);
	w->geometry.texcoord[0] = add(w, &at, 4);
	w->geometry.texcoord[1] = add(w, &at, 4);
	w->geometry.generics = add(w, &at, 4); /* attributes 2 and 4 */
	add(w, &at, 4);
	for (uint32_t k = 0; k < 16; k++) { /* diagonal matrices, of 2 and of 1/2 */
		w->geometry.eye_from_obj[k] = k % 5 ? 0 : k == 15 ? 1 : 2;
		w->geometry.clip_from_obj[k] = k % 5 ? 0 : k == 15 ? 1 : 0.5f;
		w->units[0].matrix[k] = w->units[1].matrix[k] = k % 5 ? 0 : 1;
	}
	w->geometry.normal_matrix[0] = w->geometry.normal_matrix[5] = w->geometry.normal_matrix[10] = 1;
	w->current = (struct scene_current){ .color = { 0.1f, 0.2f, 0.3f, 0.4f },
		                             .secondary = { 0.5f, 0.6f, 0.7f, 1 },
		                             .normal = { 0, 0, 1 },
		                             .fog_coord = 0.25f };
	for (int u = 0; u < UNITS; u++)
		memcpy(w->current.texcoord[u], (float[4]){ 0.1f, 0.2f, 0.3f, (float)u + 1 }, 16);
	for (int i = 0; i < 6; i++)
		memcpy(w->current.generics[i], (float[4]){ 0.9f, 0.8f, 0.7f, (float)i }, 16);
	w->material = (struct scene_material){ .unit_count = UNITS,
		                               .point_size = 3,
		                               .point_size_max = 64,
		                               .point_attenuation = { 1, 0, 0 },
		                               .fog_coord_source = GL_FOG_COORD,
		                               .front = { .ambient = { 0.25f, 0, 0, 1 }, .diffuse = { 0.5f, 0, 0, 1 } },
		                               .back = { .ambient = { 0, 0.5f, 0, 1 },
		                                         .diffuse = { 0, 0.25f, 0, 1 } } };
	w->units[1].unit = 1;
	w->light = (struct scene_light){ .ambient = { 1, 1, 1, 1 },
		                         .diffuse = { 1, 1, 1, 1 },
		                         .position_eye = { 0, 0, 1, 0 },
		                         .spot_cutoff_deg = 180,
		                         .attenuation = { 1, 0, 0 } };
	w->view = (struct view){ .viewport = { 0, 0, 64, 64 }, .depth_range = { 0, 1 } };
	w->tables = (struct tables){ .attributes = w->attributes,
		                     .geometries = &w->geometry,
		                     .materials = &w->material,
		                     .units = w->units,
		                     .lights = &w->light,
		                     .currents = &w->current };
}

static void run(struct world *w)
{
	const struct vertex_arguments a = {
		.tables = w->tables, .owners = w->owners, .views = &w->view, .shaded = w->shaded, .windows = w->windows,
		.clips = w->clips, .coords = w->coords, .height = 64
	};

	for (uint32_t i = 0; i < 4 * (3 + UNITS * VERTICES + 1); i++)
		w->coords[i] = -7;
	for (uint32_t i = FIRST; i < FIRST + VERTICES; i++)
		vertex_item(&a, i);
}

static void check_floats(const float *have, const float *wanted, int n, const char *what)
{
	for (int c = 0; c < n; c++)
		ck_assert_msg(fabsf(have[c] - wanted[c]) < ALMOST, "%s: number %d is %g, not %g", what, c, have[c], wanted[c]);
}

/* From arrays, and current values if there is none. */
START_TEST(test_attributes)
{
	for (int arrays = 0; arrays < 2; arrays++) {
		static const uint32_t all = SCENE_HAS_NORMAL | SCENE_HAS_COLOR | SCENE_HAS_SECONDARY |
		                            SCENE_HAS_FOG_COORD | SCENE_HAS_TEXCOORD | SCENE_HAS_TEXCOORD << 1;
		struct world w;

		begin(&w, arrays ? all : 0);
		run(&w);
		for (uint32_t v = 0; v < VERTICES; v++) {
			const struct geometry *g = &w.geometry;
			const float *at = w.attributes + g->position + 4 * v;
			const struct shaded_vertex *out = &w.shaded[FIRST + v];

			check_floats(out->eye, (float[4]){ 2 * at[0], 2 * at[1], 2 * at[2], at[3] }, 4, "eye");
			check_floats(out->clip, (float[4]){ 0.5f * at[0], 0.5f * at[1], 0.5f * at[2], at[3] }, 4, "clip");
			check_floats(w.clips + 4 * (FIRST + v), out->clip, 4, "clip coordinates once more");
			check_floats(out->normal, arrays ? w.attributes + g->normal + 3 * v : w.current.normal, 3, "normal");
			check_floats(out->color[0], arrays ? w.attributes + g->color + 4 * v : w.current.color, 4, "colour");
			check_floats(out->color[1], out->color[0], 4, "the back's colour");
			check_floats(out->secondary[1],
			             arrays ? w.attributes + g->secondary + 4 * v : w.current.secondary, 4,
			             "secondary colour");
			check_floats(&out->fog_coord, arrays ? w.attributes + g->fog_coord + v : &w.current.fog_coord, 1, "fog coordinate");
			ck_assert_float_eq(out->size[0], 3);
			for (uint32_t u = 0; u < UNITS; u++)
				check_floats(w.coords + 4 * (3 + UNITS * v + u),
				             arrays ? w.attributes + g->texcoord[u] + 4 * v : w.current.texcoord[u], 4,
				             "texture coordinates");
		}
		ck_assert_float_eq(w.coords[4 * 3 - 1], -7);
		ck_assert_float_eq(w.coords[4 * (3 + UNITS * VERTICES)], -7); /* nothing is written beyond them */
	}
}
END_TEST

/* Each side has its own material and normal if both are lit, else the front's colour. */
START_TEST(test_sides)
{
	struct world w;

	begin(&w, 0);
	w.material.lighting = 1;
	w.material.light_count = 1;
	run(&w);
	check_floats(w.shaded[FIRST].color[0], (float[4]){ 0.75f, 0, 0, 1 }, 4, "front");
	check_floats(w.shaded[FIRST].color[1], (float[4]){ 0.75f, 0, 0, 1 }, 4, "one side alone");
	ck_assert_uint_eq(w.shaded[FIRST].lit[0], 1);
	w.material.two_side = 1;
	run(&w);
	check_floats(w.shaded[FIRST].color[0], (float[4]){ 0.75f, 0, 0, 1 }, 4, "front");
	check_floats(w.shaded[FIRST].color[1], (float[4]){ 0, 0.5f, 0, 1 }, 4, "back, from behind");
	ck_assert_uint_eq(w.shaded[FIRST].lit[1], 0);
	w.light.position_eye[2] = -1;
	run(&w);
	check_floats(w.shaded[FIRST].color[0], (float[4]){ 0.25f, 0, 0, 1 }, 4, "front, from behind");
	check_floats(w.shaded[FIRST].color[1], (float[4]){ 0, 0.75f, 0, 1 }, 4, "back");
	w.material.surface.hidden = SCENE_UNSHADED;
	run(&w);
	ck_assert_uint_eq(w.shaded[FIRST].lit[1], 0);
	w.material.lighting = 0;
	run(&w);
	check_floats(w.shaded[FIRST].color[1], w.current.color, 4, "not lit");
}
END_TEST

/* Inputs of vertex programs: numbered attributes, current ones if there is no array. */
START_TEST(test_inputs)
{
	struct world w;
	struct vec4 have;
	const struct geometry *g = &w.geometry;

	begin(&w, SCENE_HAS_NORMAL | SCENE_HAS_COLOR | SCENE_HAS_FOG_COORD | SCENE_HAS_TEXCOORD << 1 |
	                  SCENE_HAS_GENERIC << 1 | SCENE_HAS_GENERIC << 3);
	for (uint32_t input = 0; input < N_SCENE_VERTEX_INPUTS; input++) {
		const uint32_t v = 2, unit = input - SCENE_VERTEX_TEXCOORD, generic = input - SCENE_VERTEX_GENERIC;
		float wanted[4] = { 0, 0, 0, 1 };

		if (input >= SCENE_VERTEX_GENERIC && generic >= 6)
			break;
		if (input == SCENE_VERTEX_POSITION)
			memcpy(wanted, w.attributes + g->position + 4 * v, 16);
		else if (input == SCENE_VERTEX_NORMAL)
			memcpy(wanted, w.attributes + g->normal + 3 * v, 12);
		else if (input == SCENE_VERTEX_COLOR)
			memcpy(wanted, w.attributes + g->color + 4 * v, 16);
		else if (input == SCENE_VERTEX_SECONDARY)
			memcpy(wanted, w.current.secondary, 16);
		else if (input == SCENE_VERTEX_FOG)
			wanted[0] = w.attributes[g->fog_coord + v];
		else if (input < SCENE_VERTEX_GENERIC)
			memcpy(wanted, unit == 1 ? w.attributes + g->texcoord[1] + 4 * v : w.current.texcoord[unit], 16);
		else
			memcpy(wanted,
			       generic == 1 || generic == 3 ?
			               w.attributes + g->generics + 4 * (VERTICES * (generic == 3) + v) :
			               w.current.generics[generic],
			       16);
		have = vertex_input(&w.tables, g, v, input);
		check_floats((float[4]){ have.x, have.y, have.z, have.w }, wanted, 4, "input");
	}
}
END_TEST

/* A triangle in the plane z = -4, seen from the front. */
static struct point point_of(struct world *w)
{
	static const float corners[3][2] = { { 0, 0 }, { 4, 0 }, { 0, 4 } };
	struct point p = { .geometry = &w->geometry,
		           .material = &w->material,
		           .number = { 0, 1, 2 },
		           .weight = { 0.25f, 0.25f, 0.5f },
		           .front = 1 };

	w->material.front_face = GL_CCW;
	for (uint32_t i = 0; i < 3; i++) {
		p.vertex[i] = &w->shaded[i];
		memcpy(w->shaded[i].eye, (float[4]){ corners[i][0], corners[i][1], -4, 1 }, 16);
		memcpy(w->shaded[i].normal, (float[3]){ 0.6f, 0, 0.8f }, 12);
	}
	return p;
}

/* The normal has length 1 and points to the visible side: from the vertices if the draw is lit, else from the plane. */
START_TEST(test_normals)
{
	struct world w;
	struct point p;
	struct vec3 n;

	begin(&w, 0);
	p = point_of(&w);
	for (unsigned i = 0; i < 16; i++) {
		const int lit = i & 1, back = i >> 1 & 1, turned = i >> 2 & 1, clockwise = i >> 3;
		/* a clockwise front is visible from where the plane's normal points away */
		const float side = back == clockwise ? 1 : -1;

		w.material.lighting = (uint32_t)lit;
		w.material.front_face = clockwise ? GL_CW : GL_CCW;
		p.front = !back;
		for (uint32_t k = 0; k < 3; k++)
			memcpy(w.shaded[k].normal, (float[3]){ turned ? -0.6f : 0.6f, 0, turned ? -0.8f : 0.8f }, 12);
		n = point_normal(&p);
		check_floats((float[3]){ n.x, n.y, n.z },
		             (float[3]){ lit ? 0.6f * side : 0, 0, (lit ? 0.8f : 1) * side }, 3, "normal");
	}
	for (uint32_t k = 0; k < 3; k++)
		memset(w.shaded[k].normal, 0, 12);
	w.material.lighting = 1;
	w.material.front_face = GL_CCW;
	p.front = 1;
	n = point_normal(&p);
	check_floats((float[3]){ n.x, n.y, n.z }, (float[3]){ 0, 0, 1 }, 3, "without normals");
	n = point_position(&p);
	check_floats((float[3]){ n.x, n.y, n.z }, (float[3]){ 1, 2, -4 }, 3, "place");
}
END_TEST

/* The other pixels of a quad use the same triangle, each at its own centre; the fragment's own pixel is unchanged. */
START_TEST(test_neighbours)
{
	static const float corners[3][2] = { { -1, -1 }, { 1, -1 }, { -1, 1 } };
	const struct point_quad quad = { .x = 10, .y = 20 };
	struct world w;

	begin(&w, 0);
	for (uint32_t own = 0; own < 4; own++) {
		struct program_fragment f = { .own = own };

		f.p = point_of(&w);
		f.window.view = &w.view;
		f.window.height = 64;
		for (uint32_t i = 0; i < 3; i++)
			memcpy(w.shaded[i].clip, (float[4]){ corners[i][0], corners[i][1], 0, 1 }, 16);
		for (uint32_t k = 0; k < 4; k++) {
			const struct point p = program_neighbour(&f, &quad, k);
			const float x = (10.5f + (float)(k & 1)) / 64, y = 1 - (20.5f + (float)(k >> 1)) / 64;

			check_floats(p.weight, k == own ? f.p.weight : (float[3]){ 1 - x - y, x, y }, 3, "weights");
		}
	}
}
END_TEST

/* Clip planes remove points behind any enabled plane. */
START_TEST(test_clip_planes)
{
	struct world w;
	struct point p;

	begin(&w, 0);
	p = point_of(&w); /* at (1, 2) */
	memcpy(w.material.clip_plane_eye[1], (float[4]){ 1, 0, 0, -0.9f }, 16);
	memcpy(w.material.clip_plane_eye[4], (float[4]){ 0, -1, 0, 1.9f }, 16);
	ck_assert_int_eq(point_clipped(&p), 0);
	w.material.clip_plane_mask = 2;
	ck_assert_int_eq(point_clipped(&p), 0);
	w.material.clip_plane_eye[1][3] = -1.1f;
	ck_assert_int_eq(point_clipped(&p), 1);
	w.material.clip_plane_mask = 16;
	ck_assert_int_eq(point_clipped(&p), 1);
	w.material.clip_plane_eye[4][3] = 2.1f;
	ck_assert_int_eq(point_clipped(&p), 0);
}
END_TEST

/* Clipping a polygon by a plane: cut sides get a new vertex; a polygon that crosses the plane too often is limited
 * to the room. */
START_TEST(test_cut_polygons)
{
	const struct userclip_plane plane = { { 1, -1, -1 } };
	const struct view view = { .viewport = { 0, 0, 64, 64 }, .depth_range = { 0, 1 } };
	struct clip_corner in[USERCLIP_CORNERS], out[USERCLIP_CORNERS + 1];

	for (uint32_t i = 0; i < USERCLIP_CORNERS; i++)
		in[i] = (struct clip_corner){ .clip = v4(0, 0, 0, 1), .number = i, .b1 = i & 1 ? 1 : 0 };
	out[USERCLIP_CORNERS].number = 77;
	ck_assert_uint_eq(userclip_by(&view, 64, &plane, in, USERCLIP_CORNERS, out), USERCLIP_CORNERS);
	ck_assert_uint_eq(out[USERCLIP_CORNERS].number, 77);
	ck_assert_uint_eq(userclip_by(&view, 64, &plane, in, 2, out), 3); /* one inside, two cuts */
	ck_assert_uint_eq(out[0].number, 0);
	for (uint32_t i = 0; i < 3; i++)
		in[i].b1 = 0.25f;
	ck_assert_uint_eq(userclip_by(&view, 64, &plane, in, 3, out), 3);
	in[1].b1 = 0.75f;
	ck_assert_uint_eq(userclip_by(&view, 64, &plane, in, 3, out), 4);
	ck_assert(out[0].number == 0 && out[3].number == 2);
	ck_assert_float_eq_tol(out[1].b1, 0.5f, ALMOST);
	ck_assert_float_eq_tol(out[2].b1, 0.5f, ALMOST);
	for (uint32_t i = 0; i < 3; i++)
		in[i].b1 = 0.75f;
	ck_assert_uint_eq(userclip_by(&view, 64, &plane, in, 3, out), 0);
}
END_TEST

/* The visible side follows from window positions, at any distance; from clip space if a vertex has none. */
START_TEST(test_sides_of_triangles)
{
	struct window_vertex windows[3] = { { 0, 0, 0, 0.01f }, { 256, 0, 0, 0.01f }, { 0, 256, 0, 0.01f } };
	struct world w;
	struct point p;

	begin(&w, 0);
	p = point_of(&w);
	memcpy(w.shaded[0].clip, (float[4]){ 0, 0, 0, 1 }, 16);
	memcpy(w.shaded[1].clip, (float[4]){ 0, 1, 0, 1 }, 16);
	memcpy(w.shaded[2].clip, (float[4]){ 1, 0, 0, 1 }, 16); /* reversed */
	ck_assert_int_eq(point_shows_front(&p, windows), 1);
	w.material.front_face = GL_CW;
	ck_assert_int_eq(point_shows_front(&p, windows), 0);
	windows[1].w_inv = 0;
	ck_assert_int_eq(point_shows_front(&p, windows), 1);
	w.material.front_face = GL_CCW;
	ck_assert_int_eq(point_shows_front(&p, windows), 0);
}
END_TEST

/* Which draws have vertices lit again by a program: lit draws of a program that no rule lights, with requested
 * lights. */
START_TEST(test_lit_by_programs)
{
	for (unsigned i = 0; i < 32; i++) {
		struct scene_material m = { .vertex_program = i & 1, .light_count = i >> 1 & 1, .surface = { .relit = i >> 2 & 1 } };
		const struct shade_arguments a = { .n_slots = i >> 3 & 1 };
		const int wanted = (i & 1) && (i & 2) && !(i & 4) && (i & 8) && !(i & 16);

		ck_assert_int_eq(stage_is_lit_by_program(&a, &m, i & 16 ? GEOMETRY_EXPANDED : 0) != 0, wanted);
		ck_assert_int_eq(stage_is_by_program(&a, &m, i & 16 ? GEOMETRY_EXPANDED : 0) != 0, wanted);
		m.fragment_program = 1;
		ck_assert_int_eq(stage_is_by_program(&a, &m, i & 16 ? GEOMETRY_EXPANDED : 0) != 0, 1);
	}
}
END_TEST

/* Lights that receive shadow rays: those that light the vertices, or the point if it is lit again; in mode path all
 * in front of it. */
START_TEST(test_asked_lights)
{
	struct scene_light lights[4];
	struct world w;
	struct point p;

	begin(&w, 0);
	p = point_of(&w);
	for (int i = 0; i < 4; i++) {
		lights[i] = w.light;
		lights[i].diffuse[0] = lights[i].diffuse[1] = lights[i].diffuse[2] = i == 2;
	}
	lights[1].radius = -1;          /* no object blocks it */
	lights[3].position_eye[2] = -1; /* behind */
	w.tables.lights = lights;
	w.material.lighting = 1;
	w.material.light_count = 4;
	ck_assert_uint_eq(stage_lights(&w.tables, &p, TRANSPORT_GL, 16), 16);
	ck_assert_uint_eq(stage_lights(&w.tables, &p, TRANSPORT_DIFFUSE, 16), 16);
	ck_assert_uint_eq(stage_lights(&w.tables, &p, TRANSPORT_RELIGHT, 16), 16 | 4);
	ck_assert_uint_eq(stage_lights(&w.tables, &p, TRANSPORT_PATH, 16), 1 | 4);
	ck_assert_uint_eq(stage_lights(&w.tables, &p, TRANSPORT_LINEAR, 16), 1 | 4);
	w.material.surface.hidden = SCENE_UNSHADED;
	ck_assert_uint_eq(stage_lights(&w.tables, &p, TRANSPORT_PATH, 16), 0);
}
END_TEST

/* Pixels of a line that are not drawn: before the first column or row, after the last row. */
START_TEST(test_undrawn)
{
	struct world w;
	struct point p;

	begin(&w, 0);
	p = point_of(&w);
	memcpy(w.shaded[0].secondary[1], (float[3]){ 5, 6, 8 }, 12);
	for (uint32_t x = 3; x < 8; x++)
		for (uint32_t row = 4; row < 11; row++) {
			w.geometry.flags = GEOMETRY_EXPANDED;
			ck_assert_int_eq(stage_undrawn(&p, x, row) != 0, 0);
			w.geometry.flags = GEOMETRY_EXPANDED | GEOMETRY_LINE;
			ck_assert_int_eq(stage_undrawn(&p, x, row) != 0, x < 5 || row < 6 || row > 8);
		}
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("vertex formulas");

	tcase_add_test(tcase, test_attributes);
	tcase_add_test(tcase, test_sides);
	tcase_add_test(tcase, test_inputs);
	tcase_add_test(tcase, test_normals);
	tcase_add_test(tcase, test_neighbours);
	tcase_add_test(tcase, test_clip_planes);
	tcase_add_test(tcase, test_cut_polygons);
	tcase_add_test(tcase, test_sides_of_triangles);
	tcase_add_test(tcase, test_lit_by_programs);
	tcase_add_test(tcase, test_asked_lights);
	tcase_add_test(tcase, test_undrawn);
	return run_case(tcase, "vertex formulas");
}
