/*
 * Lines, points and polygon outlines as quads in the window (tracer/frame/prepare/expand.h; GL 2.1 sec. 3.3, 3.4,
 * 3.5.4, 3.5.5): position, attributes, clipping. The last bits, which follow llvmpipe, are compared by
 * real/test_shapes.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "scene/mesa.h"
#include "tests/case.h"
#include "tracer/frame/prepare/expand.h"

enum { SIDE = 64 };

/* Vertices at places in the window, y up; n of them are drawn. */
struct drawn {
	struct shaded_vertex vertices[4];
	uint32_t index[4], draws[2];
	struct scene_mesh mesh;
	struct scene_material material;
	struct view view;
	struct expand_input in;
	float dashed;
	struct expanded out;
};

static void place(struct drawn *d, uint32_t v, float x, float y, float z)
{
	struct shaded_vertex *s = &d->vertices[v];

	memcpy(s->clip, (float[4]){ x / SIDE * 2 - 1, y / SIDE * 2 - 1, z, 1 }, sizeof(s->clip));
	memcpy(s->eye, (float[4]){ x, y, z, 1 }, sizeof(s->eye));
	memcpy(s->color[0], (float[4]){ x / SIDE, y / SIDE, z, 1 }, sizeof(s->color[0]));
	memcpy(s->color[1], (float[4]){ 0.125f, 0.25f, 0.5f, 0.75f }, sizeof(s->color[1]));
	s->size[0] = 4;
}

static void begin(struct drawn *d, enum scene_primitive kind, enum prepared_shape shape)
{
	static const uint32_t in_order[4] = { 0, 1, 2, 3 };
	const uint32_t each = kind == SCENE_TRIANGLES ? 3 : kind == SCENE_LINES ? 2 : 1;

	memset(d, 0, sizeof(*d));
	memcpy(d->index, in_order, sizeof(in_order));
	d->draws[0] = 7;
	d->draws[1] = 8;
	d->mesh = (struct scene_mesh){ .kind = kind,
		                       .vertex_count = 4,
		                       .primitive_count = each == 2 ? 2 : 1,
		                       .index = d->index,
		                       .primitive_draw = d->draws };
	d->material = (struct scene_material){
		.shade_model = GL_SMOOTH, .front_face = GL_CCW, .line_width = 1, .point_attenuation = { 1, 0, 0 }
	};
	d->view = (struct view){ .viewport = { 0, 0, SIDE, SIDE }, .depth_range = { 0, 1 } };
	d->in = (struct expand_input){
		.mesh = &d->mesh, .material = &d->material, .view = &d->view, .shape = shape, .width = SIDE, .height = SIDE,
		.depth_bits = 24, .vertices = d->vertices, .dashed = &d->dashed
	};
}

static void expand(struct drawn *d, uint32_t quads)
{
	expanded_free(&d->out);
	ck_assert_int_eq(expand_primitives(&d->in, &d->out), 0);
	ck_assert_msg(d->out.n_primitives == 2 * quads, "%u triangles, expected those of %u quads", d->out.n_primitives,
	              quads);
	ck_assert_uint_eq(d->out.n_vertices, 4 * quads);
}

/* The bounding box of a quad must be this one, y up. */
static void check_box(const struct drawn *d, uint32_t quad, float left, float low, float right, float high)
{
	float box[4] = { 1e9f, 1e9f, -1e9f, -1e9f };
	const float wanted[4] = { left, low, right, high };

	for (uint32_t k = 0; k < 4; k++)
		for (int c = 0; c < 2; c++) {
			box[c] = fminf(box[c], d->out.position[4 * quad + k][c]);
			box[2 + c] = fmaxf(box[2 + c], d->out.position[4 * quad + k][c]);
		}
	for (int c = 0; c < 4; c++)
		ck_assert_msg(fabsf(box[c] - wanted[c]) < 0.51f, "quad %u: side %d at %g, not %g", quad, c, box[c], wanted[c]);
}

/* Plain, multisampled and smooth lines, whose width is measured across the major axis or perpendicular to the line;
 * each is a separate draw. */
START_TEST(test_lines)
{
	static const struct { float ax, ay, bx, by, wide, across; } lines[] = {
		{ 8, 20, 40, 20, 5, 0 }, { 40, 20, 8, 20, 5, 0 }, { 20, 8, 20, 40, 5, 0 }, { 8, 8, 40, 40, 4, 0.7071f },
		{ 40, 10, 10, 40, 8, 0.7071f }, { 10, 40, 40, 30, 1, 0.3f },
	};

	for (unsigned kind = 0; kind < 3; kind++)
		for (size_t i = 0; i < sizeof(lines) / sizeof(lines[0]); i++) {
			const float ax = lines[i].ax, ay = lines[i].ay, bx = lines[i].bx, by = lines[i].by, half = 0.5f * lines[i].wide;
			const int steep = fabsf(by - ay) > fabsf(bx - ax);
			const float length = hypotf(bx - ax, by - ay), dx = (bx - ax) / length, dy = (by - ay) / length;
			/*
			 * multisampled and smooth ones are perpendicular; smooth ones are longer and wider by half a
			 * pixel
			 */
			const float more = kind == 2 ? 0.5f : 0, side = kind == 2 && lines[i].wide <= 1 ? 1 : half + more;
			const float x = kind  ? fabsf(dy) * side + fabsf(dx) * more :
			                steep ? half :
			                        0,
				    y = kind  ? fabsf(dx) * side + fabsf(dy) * more :
			                steep ? 0 :
			                        half;
			struct drawn d;

			begin(&d, SCENE_LINES, PREPARED_LINES);
			d.material.line_width = lines[i].wide;
			d.material.multisample = kind == 1;
			d.material.line_smooth = kind == 2;
			place(&d, 0, ax, ay, 0);
			place(&d, 1, bx, by, 0);
			place(&d, 2, ax, ay, 0.5f);
			place(&d, 3, bx, by, 0.5f);
			expand(&d, 2);
			for (uint32_t quad = 0; quad < 2; quad++) {
				check_box(&d, quad, fminf(ax, bx) - x, fminf(ay, by) - y, fmaxf(ax, bx) + x, fmaxf(ay, by) + y);
				ck_assert_uint_eq(d.out.primitive_draw[2 * quad], 7 + quad);
				ck_assert_uint_eq(d.out.primitive_draw[2 * quad + 1], 7 + quad);
				ck_assert_float_eq_tol(d.out.vertices[4 * quad].clip[2] /
				                               d.out.vertices[4 * quad].clip[3],
				                       0.5f * (float)quad, 1e-6f);
			}
			expanded_free(&d.out);
		}
}
END_TEST

/* A line without length draws nothing, nor does one outside the view or behind a clip plane. */
START_TEST(test_nothing_left)
{
	struct drawn d;

	begin(&d, SCENE_LINES, PREPARED_LINES);
	for (uint32_t v = 0; v < 4; v++)
		place(&d, v, 20, 30, 0);
	expand(&d, 0);
	d.material.multisample = 1;
	expand(&d, 0);
	place(&d, 1, 40, 30, 0);
	expand(&d, 1);
	place(&d, 0, 70, 30, 0);
	place(&d, 1, 90, 30, 0);
	expand(&d, 0);
	place(&d, 0, 10, 30, 0);
	place(&d, 1, 50, 30, 0);
	memcpy(d.material.clip_plane_eye[3], (float[4]){ 1, 0, 0, -30 }, 16);
	expand(&d, 1);
	check_box(&d, 0, 10, 29.5f, 50, 30.5f); /* a plane that is not enabled */
	d.material.clip_plane_mask = 8;
	expand(&d, 1);
	check_box(&d, 0, 30, 29.5f, 50, 30.5f);
	d.material.clip_plane_eye[3][3] = -60;
	expand(&d, 0);
	expanded_free(&d.out);
}
END_TEST

/* With samples, a line shorter than a pixel is drawn if its rectangle crosses the left or lower border of one, in
 * any direction. */
START_TEST(test_short_lines)
{
	uint32_t seed = 1, drawn = 0, tried = 0;

	for (int i = 0; i < 4000; i++) {
		float r[4], box[2][2] = { { 1e9f, -1e9f }, { 1e9f, -1e9f } }, dx, dy, length;
		struct drawn d;
		int near = 0, wanted;

		for (int k = 0; k < 4; k++) {
			seed = seed * 1664525u + 1013904223u;
			r[k] = (float)(seed >> 8) / 16777216.0f;
		}
		dx = 0.5f * (r[2] - 0.5f);
		dy = 0.5f * (r[3] - 0.5f);
		length = hypotf(dx, dy);
		if (length < 0.02f)
			continue;
		for (int k = 0; k < 4; k++) {
			const float along = k & 1, side = k & 2 ? 0.5f : -0.5f;
			const float at[2] = { 20 + r[0] + along * dx - side * dy / length, 20 + r[1] + along * dy + side * dx / length };

			for (int c = 0; c < 2; c++) {
				box[c][0] = fminf(box[c][0], at[c]);
				box[c][1] = fmaxf(box[c][1], at[c]);
				near |= fabsf(at[c] - rintf(at[c])) < 0.02f; /* snapped to 1/256 */
			}
		}
		if (near)
			continue;
		wanted = ceilf(box[0][1]) > ceilf(box[0][0]) && floorf(box[1][1]) > floorf(box[1][0]);
		begin(&d, SCENE_LINES, PREPARED_LINES);
		d.mesh.primitive_count = 1;
		d.material.multisample = 1;
		place(&d, 0, 20 + r[0], 20 + r[1], 0);
		place(&d, 1, 20 + r[0] + dx, 20 + r[1] + dy, 0);
		ck_assert_int_eq(expand_primitives(&d.in, &d.out), 0);
		tried++;
		drawn += d.out.n_primitives != 0;
		ck_assert_msg((d.out.n_primitives != 0) == wanted, "line %d, of %g %g by %g %g", i, r[0], r[1], dx, dy);
		expanded_free(&d.out);
	}
	ck_assert(tried > 1000 && drawn > 100 && drawn < tried);
}
END_TEST

/* Stipple: runs of the pattern's bits, each repeated by the factor, from the line's first end on; strips continue
 * the pattern. */
START_TEST(test_stipples)
{
	static const uint8_t goes_on[2] = { 0, SCENE_CONTINUES };
	struct drawn d;

	begin(&d, SCENE_LINES, PREPARED_LINES);
	d.material.line_stipple = 2 << 16 | 0x0f06; /* off 2, on 4, off 10, on 8, off 8 */
	place(&d, 0, 10, 40, 0);
	place(&d, 1, 35, 40, 0.75f);
	place(&d, 2, 10, 20, 0);
	place(&d, 3, 35, 20, 0);
	expand(&d, 4);
	check_box(&d, 0, 12, 39.5f, 16, 40.5f);
	check_box(&d, 1, 26, 39.5f, 34, 40.5f);
	check_box(&d, 2, 12, 19.5f, 16, 20.5f);
	ck_assert_float_eq_tol(d.out.windows[4].z, 0.5f + 0.5f * 0.75f * 16 / 25, 1e-3f);
	ck_assert_float_eq_tol(d.out.vertices[4].color[0][0], 26.0f / SIDE, 1e-3f);
	d.index[1] = d.index[2] = 1; /* 10 to 35, and down to 20 */
	d.index[3] = 3;
	expand(&d, 4);
	check_box(&d, 2, 34.5f, 34, 35.5f, 38); /* separate lines restart, even if they share a vertex */
	d.mesh.edge_flags = goes_on;
	expand(&d, 3);
	check_box(&d, 2, 34.5f, 27, 35.5f, 31); /* 25 are used up: 7 and 2 are off, then 4 are on */
	expanded_free(&d.out);
}
END_TEST

/* Edges of a polygon, the last one first as in Mesa: those with edge flags; flat ones have the last vertex' colour;
 * polygon offset shifts their depth. */
START_TEST(test_outlines)
{
	static const uint8_t flags[] = { 5 };
	struct drawn d;

	begin(&d, SCENE_TRIANGLES, PREPARED_LINES);
	place(&d, 0, 10, 10, 0);
	place(&d, 1, 50, 10, 0);
	place(&d, 2, 10, 40, 0);
	expand(&d, 3);
	check_box(&d, 0, 9.5f, 10, 10.5f, 40);
	check_box(&d, 1, 10, 9.5f, 50, 10.5f);
	ck_assert_float_eq(d.out.vertices[0].color[0][0], 10.0f / SIDE);
	d.material.shade_model = GL_FLAT;
	expand(&d, 3);
	for (uint32_t v = 0; v < 12; v++)
		ck_assert_float_eq(d.out.vertices[v].color[0][1], 40.0f / SIDE);
	d.mesh.edge_flags = flags;
	expand(&d, 2);
	d.material.polygon_offset = 2;
	d.material.polygon_offset_units = 1 << 20;
	d.view.depth_range[0] = 0.25f;
	expand(&d, 2);
	for (uint32_t v = 0; v < 8; v++) {
		ck_assert_float_eq_tol(d.out.windows[v].z, 0.625f + 0.0625f, 1e-5f);
		ck_assert_float_eq_tol(d.out.vertices[v].clip[2], 0.0625f / 0.375f, 1e-5f);
	}
	d.material.polygon_offset = 1; /* the offset for points */
	expand(&d, 2);
	ck_assert_float_eq_tol(d.out.windows[0].z, 0.625f, 1e-5f);
	d.in.cull = INSTANCE_CULL_FRONT;
	expand(&d, 0);
	d.in.cull = INSTANCE_CULL_BACK;
	expand(&d, 2);
	d.material.front_face = GL_CW;
	expand(&d, 0);
	d.in.cull = 0;
	d.material.two_side = 1;
	expand(&d, 2);
	ck_assert_float_eq(d.out.vertices[0].color[0][3], 0.75f); /* the back's */
	expanded_free(&d.out);
}
END_TEST

/* Points: squares of their size around their position, whole pixels if plain; polygon vertices. */
START_TEST(test_points)
{
	struct drawn d;

	begin(&d, SCENE_POINTS, PREPARED_POINTS);
	place(&d, 0, 20, 30, 0.5f);
	expand(&d, 1);
	check_box(&d, 0, 18, 28, 22, 32);
	ck_assert_float_eq(d.out.windows[0].z, 0.75f);
	d.material.multisample = 1;
	d.vertices[0].size[0] = 7;
	expand(&d, 1);
	check_box(&d, 0, 16.5f, 26.5f, 23.5f, 33.5f);
	d.material.point_smooth = 1;
	expand(&d, 1);
	check_box(&d, 0, 16.5f, 26.5f, 23.5f, 33.5f);
	place(&d, 0, 65, 30, 0); /* its centre is outside */
	expand(&d, 0);
	expanded_free(&d.out);
	begin(&d, SCENE_TRIANGLES, PREPARED_POINTS);
	place(&d, 0, 10, 10, 0);
	place(&d, 1, 50, 10, 0);
	place(&d, 2, 10, 40, 0);
	expand(&d, 3);
	check_box(&d, 1, 48, 8, 52, 12);
	expanded_free(&d.out);
}
END_TEST

/* Rules of later Mesa versions: ends exactly on a pixel's centre; widths and positions half way between; sprites;
 * smooth lines of nearly no length. */
START_TEST(test_versions_of_mesa)
{
	struct scene_unit unit = { .coord_replace = 1 };
	static const float texcoords[4][4];
	struct drawn d;

	begin(&d, SCENE_LINES, PREPARED_LINES);
	d.mesh.primitive_count = 1;
	place(&d, 0, 10.25f, 20.5f, 0);
	place(&d, 1, 20.5f, 20.5f, 0);
	for (int after = 0; after < 2; after++) {
		d.in.mesa = after ? SCENE_MESA_LINE_ENDS : 0;
		expand(&d, 1);
		ck_assert_int_eq(d.out.windows[1].x, after ? 20 * 256 + 128 : 20 * 256);
		d.material.line_width = 2.5f;
		d.in.mesa = after ? SCENE_MESA_ROUNDS_TO_EVEN : 0;
		expand(&d, 1);
		ck_assert_int_eq(abs(d.out.windows[3].y - d.out.windows[0].y), after ? 2 * 256 : 3 * 256);
		d.material.line_width = 1;
	}
	d.material.line_smooth = 1;
	place(&d, 1, 10.5f, 20.5f, 0);
	for (int after = 0; after < 2; after++) {
		d.in.mesa = after ? SCENE_MESA_SMOOTH_LINES : 0;
		expand(&d, 1);
		ck_assert_float_eq_tol(d.out.vertices[0].color[1][3], after ? 0.625f : 0.25f, 1e-4f);
	}
	place(&d, 1, 10.25f, 20.5f, 0);
	expand(&d, 0);
	d.in.mesa = 0;
	expand(&d, 1);
	expanded_free(&d.out);

	begin(&d, SCENE_POINTS, PREPARED_POINTS);
	place(&d, 0, 20, 30, 0);
	d.material.multisample = d.material.point_sprite = 1;
	d.material.unit_count = 1;
	d.in.units = &unit;
	d.in.texcoords = texcoords;
	for (int after = 0; after < 2; after++) {
		d.in.mesa = after ? SCENE_MESA_SPRITES : 0;
		expand(&d, 1);
		ck_assert_float_eq(d.out.texcoords[0][0], after ? 0 : 0.125f);
	}
	expanded_free(&d.out);
}
END_TEST

int main(void)
{
	TCase *tcase = tcase_create("expand");

	tcase_add_test(tcase, test_lines);
	tcase_add_test(tcase, test_nothing_left);
	tcase_add_test(tcase, test_short_lines);
	tcase_add_test(tcase, test_stipples);
	tcase_add_test(tcase, test_outlines);
	tcase_add_test(tcase, test_points);
	tcase_add_test(tcase, test_versions_of_mesa);
	return run_case(tcase, "expand");
}
