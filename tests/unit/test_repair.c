/*
 * scene/repair: closed meshes, broken at random, are closed again with their volume; whole meshes are unchanged, and
 * open ones stay open.
 *
 *   test_repair          as `make check` runs it
 *   test_repair COUNT    COUNT meshes, and the figures of `make show-rooms`
 */
#include <stdio.h>
#include <time.h>

#include "scene/repair/holds.h"
#include "scene/repair/repair.h"
#include "tests/case.h"
#include "tests/unit/broken.h"

enum { FEW = 120 };

/* Maximum error of volumes, relative. */
#define VOLUME 1e-5

struct score {
	unsigned closed, exact, broken; /* meshes; closed ones, and those with their volume; those with a leak or
	                                   wrong volume before */
	double worst;
};

static int is_closed(const struct scene_mesh *mesh, double *volume)
{
	const struct repair_wants none = { .weld = 0 };
	struct repair_found found;
	struct scene_mesh *again = NULL;

	if (repair_mesh(mesh, &none, &found, &again))
		return 0;
	free(again);
	*volume = found.volume;
	return found.closed && !found.junctions && !found.dropped;
}

/* The result is analysed again as a mesh of its own: by equal positions, without tolerance. */
static void score_one(uint64_t seed, struct score *score, int tells)
{
	const struct repair_wants wants = { .weld = REPAIR_WELD, .turn = 1 };
	struct repair_found found;
	struct scene_mesh *repaired;
	struct broken b;
	double volume, is, was;
	const struct scene_mesh *mesh = broken_random(&b, seed, REPAIR_WELD, &volume);
	int closed;

	score->broken += !is_closed(mesh, &was);
	if (repair_mesh(mesh, &wants, &found, &repaired))
		repaired = NULL;
	closed = is_closed(repaired ? repaired : mesh, &is);
	score->closed += closed != 0;
	score->exact += closed && fabs(is / volume - 1) <= VOLUME;
	if (closed)
		score->worst = fmax(score->worst, fabs(is / volume - 1));
	if (tells && !(closed && fabs(is / volume - 1) <= VOLUME))
		fprintf(stderr,
		        "mesh %u of kind %u, %u triangles: %s, volume off by %.2g; welded %u, junctions %u, dropped "
		        "%u, turned %u, leaks %u, twisted %u\n",
		        (unsigned)seed, (unsigned)(seed % BROKEN_KINDS), mesh->primitive_count,
		        closed ? "closed" : "open", is / volume - 1, found.welded, found.junctions, found.dropped,
		        found.turned, found.leaks, found.twisted);
	free(repaired);
	broken_free(&b);
}

START_TEST(test_broken)
{
	struct score score = { .worst = 0 };

	for (uint64_t seed = 0; seed < FEW; seed++)
		score_one(seed, &score, 1);
	ck_assert_msg(score.broken > FEW * 9 / 10, "%u were broken", score.broken);
	ck_assert_uint_eq(score.closed, FEW);
	ck_assert_msg(score.exact == FEW, "%u have the right volume; the largest error is %g", score.exact,
	              score.worst);
}
END_TEST

/* Every kind of whole mesh needs no repair. */
START_TEST(test_whole)
{
	const struct repair_wants wants = { .weld = REPAIR_WELD, .turn = 1 };

	for (uint64_t seed = 0; seed < 60; seed++) {
		struct broken b;
		struct repair_found found;
		struct scene_mesh *out;

		broken_init(&b, seed);
		broken_make(&b, (uint32_t)(seed % BROKEN_KINDS));
		broken_place(&b);
		ck_assert_int_eq(repair_mesh(broken_mesh(&b), &wants, &found, &out), 0);
		ck_assert_msg(!out && found.closed, "mesh %u: leaks %u, twisted %u, turned %u", (unsigned)seed,
		              found.leaks, found.twisted, found.turned);
		ck_assert_double_eq_tol(found.volume, broken_volume(&b), 1e-9 * found.volume);
		broken_free(&b);
	}
}
END_TEST

/* A ball inside a ball, broken and repaired: points between them are inside, those in the cavity are not. */
START_TEST(test_inside)
{
	const double how[3] = { 1, 1, 1 }, half[3] = { 0.5, 0.5, 0.5 };
	const struct repair_wants wants = { .weld = REPAIR_WELD, .turn = 1 };
	struct repair_found found;
	struct scene_mesh *out;
	struct broken b;

	broken_init(&b, 3);
	broken_rings(&b, 60, 60, 0, broken_on_ball, how);
	broken_rings(&b, 60, 60, 0, broken_on_ball, half);
	broken_cut(&b, 0.2);
	ck_assert_int_eq(repair_mesh(broken_mesh(&b), &wants, &found, &out), 0);
	ck_assert(out && found.closed && found.shells == 2 && found.turned);
	for (int i = 0; i < 1000; i++) {
		const float at[3] = { (float)(2.4 * broken_next(&b) - 1.2), (float)(2.4 * broken_next(&b) - 1.2),
			              (float)(2.4 * broken_next(&b) - 1.2) };
		const float far = sqrtf(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]);

		if (fabsf(far - 1) > 0.01f && fabsf(far - 0.5f) > 0.01f) /* faces are slightly inside the balls */
			ck_assert_int_eq(holds_place(out, at), far > 0.5f && far < 1);
	}
	free(out);
	broken_free(&b);
}
END_TEST

/* A box of twelve triangles; the first two are its bottom. */
static const float cube[8][4] = { { 0, 0, 0, 1 }, { 1, 0, 0, 1 }, { 1, 1, 0, 1 }, { 0, 1, 0, 1 },
	                          { 0, 0, 1, 1 }, { 1, 0, 1, 1 }, { 1, 1, 1, 1 }, { 0, 1, 1, 1 } };
static const uint32_t sides[12][3] = { { 0, 3, 2 }, { 0, 2, 1 }, { 4, 5, 6 }, { 4, 6, 7 }, { 0, 1, 5 }, { 0, 5, 4 },
	                               { 2, 3, 7 }, { 2, 7, 6 }, { 1, 2, 6 }, { 1, 6, 5 }, { 3, 0, 4 }, { 3, 4, 7 } };

/* An opening remains and is reported; the facing is not changed unless requested. */
START_TEST(test_openings)
{
	const struct scene_mesh box = { .kind = SCENE_TRIANGLES,
		                        .vertex_count = 8,
		                        .primitive_count = 10,
		                        .position = cube[0],
		                        .index = sides[2] };
	uint32_t turned[12][3];
	struct scene_mesh whole = box, *out;
	struct repair_found found;

	ck_assert_int_eq(repair_mesh(&box, &(struct repair_wants){ .weld = REPAIR_WELD }, &found, &out), 0);
	ck_assert_ptr_null(out);
	ck_assert(!found.closed && found.leaks == 4 && found.shells == 1 && found.leak_at[2] == 0);
	memcpy(turned, sides, sizeof(turned));
	memcpy(turned[5], (uint32_t[3]){ 4, 5, 0 }, sizeof(turned[5]));
	whole.index = turned[0];
	whole.primitive_count = 12;
	ck_assert_int_eq(repair_mesh(&whole, &(struct repair_wants){ .weld = REPAIR_WELD }, &found, &out), 0);
	ck_assert(!out && !found.closed && !found.leaks && found.twisted == 3);
	ck_assert_int_eq(repair_mesh(&whole, &(struct repair_wants){ .weld = REPAIR_WELD, .turn = 1, .clockwise = 1 },
	                             &found, &out),
	                 0);
	ck_assert(out && found.closed && found.turned == 11);
	ck_assert_double_eq_tol(found.volume, -1, 1e-12);
	for (int f = 0; f < 12; f++)
		ck_assert_uint_eq(out->index[3 * f + 2], turned[f][2]); /* the last vertex gives the colour under
		                                                           flat shading */
	free(out);
}
END_TEST

/* A sheet drawn from both sides is kept; a NaN vertex changes nothing around it. */
START_TEST(test_sheets)
{
	static const uint32_t both[4][3] = { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 2, 1 }, { 0, 3, 2 } };
	struct scene_mesh sheet = { .kind = SCENE_TRIANGLES,
		                    .vertex_count = 4,
		                    .primitive_count = 4,
		                    .position = cube[0],
		                    .index = both[0] },
			  *out;
	float with_nan[9][4];
	uint32_t index[13][3];
	struct repair_found found;

	ck_assert_int_eq(repair_mesh(&sheet, &(struct repair_wants){ .weld = REPAIR_WELD }, &found, &out), 0);
	ck_assert(!out && !found.dropped && found.closed && found.volume == 0);
	memcpy(with_nan, cube, sizeof(cube));
	memcpy(with_nan[8], (float[4]){ NAN, 0, INFINITY, 1 }, sizeof(with_nan[8]));
	with_nan[1][0] = 1.000001f;
	memcpy(index, sides, sizeof(sides));
	memcpy(index[12], (uint32_t[3]){ 0, 8, 1 }, sizeof(index[12]));
	sheet = (struct scene_mesh){ .kind = SCENE_TRIANGLES,
		                     .vertex_count = 9,
		                     .primitive_count = 13,
		                     .position = with_nan[0],
		                     .index = index[0] };
	ck_assert_int_eq(repair_mesh(&sheet, &(struct repair_wants){ .weld = REPAIR_WELD, .turn = 1 }, &found, &out), 0);
	ck_assert(!out && found.closed);
	with_nan[0][3] = 2; /* homogeneous: not repaired */
	ck_assert_int_eq(repair_mesh(&sheet, &(struct repair_wants){ .weld = REPAIR_WELD }, &found, &out), 0);
	ck_assert(!out && !found.closed);
}
END_TEST

/* A wall that two smaller ones meet: its edge gets their vertex, with all attributes interpolated; under flat
 * shading the wall keeps its colour. */
START_TEST(test_attributes)
{
	static const float position[6][4] = { { 0, 0, 0, 1 }, { 4, 0, 0, 1 }, { 0, 4, 0, 1 },
		                              { 4, 0, 0, 1 }, { 1, 0, 0, 1 }, { 2, -3, 0, 1 } };
	static const float color[6][4] = { { 0, 0, 0, 1 }, { 1, 1, 1, 1 }, { 0.5f, 0, 0, 1 },
		                           { 0, 0, 1, 1 }, { 0, 0, 1, 1 }, { 0, 0, 1, 1 } };
	static const float texcoord[6][4] = { { 0, 0, 0, 1 }, { 8, 0, 0, 1 } };
	static const uint32_t index[3][3] = { { 0, 1, 2 }, { 4, 5, 3 }, { 0, 5, 4 } };
	const struct scene_mesh mesh = { .hash = { 1, 2 },
		                         .kind = SCENE_TRIANGLES,
		                         .vertex_count = 6,
		                         .primitive_count = 3,
		                         .position = position[0],
		                         .color = color[0],
		                         .texcoord = { texcoord[0] },
		                         .index = index[0] };
	const uint32_t same[2][3] = { { 0, 6, 2 }, { 6, 1, 2 } };
	struct repair_found found;
	struct scene_mesh *out;

	for (int flat = 0; flat < 2; flat++) {
		ck_assert_int_eq(repair_mesh(&mesh, &(struct repair_wants){ .weld = REPAIR_WELD, .flat = flat }, &found, &out), 0);
		ck_assert(out && found.junctions == 1 && out->primitive_count == 4 && out->vertex_count == 7);
		ck_assert(out->hash[0] != mesh.hash[0] && out->hash[1] != mesh.hash[1]);
		ck_assert_int_eq(memcmp(out->index, same, sizeof(same)), 0);
		ck_assert_int_eq(memcmp(out->position, position, sizeof(position)), 0);
		ck_assert_int_eq(memcmp(out->position + 24, position[4], sizeof(position[4])), 0);
		ck_assert_float_eq(out->texcoord[0][24], 2);
		ck_assert_float_eq(out->color[24], flat ? 0.5f : 0.25f);
		free(out);
	}
}
END_TEST

/* Boxes of many squares with cracks are merged into few triangles if texture coordinates are continuous; otherwise,
 * and on round bodies, no triangles are merged. */
START_TEST(test_merge)
{
	for (uint64_t seed = 0; seed < 30; seed++) {
		const struct repair_wants wants = { .weld = REPAIR_WELD, .turn = 1, .merge = 1 };
		const uint32_t kind = seed % 3 == 0 ? 0 : 3;
		struct repair_found found;
		struct scene_mesh *out;
		struct broken b;
		float (*texcoord)[4];
		double was, is;

		broken_init(&b, seed);
		broken_make(&b, kind);
		broken_place(&b);
		was = broken_volume(&b);
		broken_cut(&b, kind == 0 ? 0 : 0.3);
		broken_mesh(&b);
		texcoord = calloc(b.n_points, sizeof(*texcoord));
		for (uint32_t p = 0; p < b.n_points; p++)
			for (int k = 0; k < 3; k++) {
				texcoord[p][k] = (float)((b.points[p][0] + (k + 1) * b.points[p][1] - b.points[p][2]) / cbrt(was));
				texcoord[p][k] += seed % 3 == 2 ? (float)broken_next(&b) : 0;
			}
		b.mesh.texcoord[0] = texcoord[0];
		b.mesh.hash[0] = b.mesh.hash[1] = seed + 1;
		ck_assert_int_eq(repair_mesh(&b.mesh, &wants, &found, &out), 0);
		if (seed % 3 == 1) {
			ck_assert_msg(out && out->primitive_count <= 16, "%u triangles of %u, %u places merged",
			              out ? out->primitive_count : 0, b.n_triangles, found.merged);
			ck_assert(is_closed(out, &is) && out->hash[0] != seed + 1 && out->hash[1] != seed + 1);
			ck_assert_double_eq_tol(is, was, VOLUME * was);
		} else {
			ck_assert_uint_eq(found.merged, 0);
		}
		free(out);
		free(texcoord);
		broken_free(&b);
	}
}
END_TEST

/* A large mesh with duplicated vertices: the cost of repair is about linear in its size. */
START_TEST(test_large)
{
	const struct repair_wants wants = { .weld = REPAIR_WELD, .turn = 1 };
	const double thin = 0.4;
	struct broken b;
	struct repair_found found;
	struct scene_mesh *out;
	clock_t begin;

	broken_init(&b, 1);
	free(b.points);
	free(b.index);
	b.points = malloc(1200000 * sizeof(*b.points));
	b.index = malloc(1200000 * sizeof(*b.index));
	broken_rings(&b, 250, 500, 1, broken_on_torus, &thin);
	broken_place(&b);
	broken_cut(&b, 0.02);
	broken_split(&b, 0.5);
	broken_mesh(&b);
	begin = clock();
	ck_assert_int_eq(repair_mesh(&b.mesh, &wants, &found, &out), 0);
	fprintf(stderr, "%u triangles: %.2f s\n", b.mesh.primitive_count, (double)(clock() - begin) / CLOCKS_PER_SEC);
	ck_assert(out && found.closed && found.shells == 1 && b.mesh.primitive_count > 250000);
	ck_assert_msg(clock() - begin < 20 * CLOCKS_PER_SEC, "it takes %g s", (double)(clock() - begin) / CLOCKS_PER_SEC);
	free(out);
	broken_free(&b);
}
END_TEST

static int show(unsigned count)
{
	struct score score = { .worst = 0 };

	for (uint64_t seed = 0; seed < count; seed++)
		score_one(seed, &score, 1);
	printf("%u of %u meshes closed, %u with their volume within %g; the worst volume is off by %.2g; %u were "
	       "broken\n",
	       score.closed, count, score.exact, VOLUME, score.worst, score.broken);
	return score.exact != count;
}

int main(int argc, char **argv)
{
	TCase *tests = tcase_create("repair");

	if (argc > 1)
		return show((unsigned)strtoul(argv[1], NULL, 10));
	tcase_set_timeout(tests, 60);
	tcase_add_test(tests, test_broken);
	tcase_add_test(tests, test_whole);
	tcase_add_test(tests, test_inside);
	tcase_add_test(tests, test_openings);
	tcase_add_test(tests, test_sheets);
	tcase_add_test(tests, test_attributes);
	tcase_add_test(tests, test_merge);
	tcase_add_test(tests, test_large);
	return run_case(tests, "repair");
}
