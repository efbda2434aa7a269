/*
 * Queries of verbs/query/relume-rays.h: their answers compared with tests of all triangles, and their rates with
 * Embree's. A separate program: the command never links Embree.
 *
 * usage: queries [--count N] [--seed N] [--rates 0] [--device NAME] [--models DIR] [--json FILE] [--command TEXT]
 *
 * Two scenes get half of the queries of each kind each: random triangles, with slivers, some without area and some
 * duplicates, near the origin and far from it. Rates: on the bench's scene of 250,000 triangles, incoherent rays and
 * points near surfaces, with as many threads of Embree as ours; medians of five wall times, alternating. Exit code 0 if
 * no answer is wrong.
 */
#include "tests/bench/rtcore.h"
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/err.h"
#include "base/progress.h"
#include "tests/bench/brute.h"
#include "verbs/render/bench/bench.h"

#define N_TRIANGLES 600u
#define MOST 8u
#define N_RATED 1000000u
#define REPEATS 5
#define MAX_THREADS 64
#define SAMPLED 16 /* one box in this many is also sampled along its path */

enum kind { NEAREST, ANY, ALL, DISTANCE, BOX, SPHERE, N_KINDS };
static const char *const kind_names[N_KINDS] = { "nearest hit", "any hit",    "all hits",
	                                         "distance",    "moving box", "moving sphere" };

static uint32_t random_state = 1;

static float chance(float lo, float hi)
{
	random_state = random_state * 1664525u + 1013904223u;
	return lo + (hi - lo) * ((float)(random_state >> 8) / 16777216.0f);
}

/* --- Answers ----------------------------------------------------------------------------------------------------- */

struct world {
	float position[3 * N_TRIANGLES][3];
	uint32_t index[N_TRIANGLES][3];
	float at[3];
	struct relume_rays *rays;
	struct brute brute;
};

struct tally {
	uint64_t asked[N_KINDS], wrong[N_KINDS], found[N_KINDS];
};

static void make_triangle(struct world *w, uint32_t i)
{
	const float size = i % 7 ? 0.4f : 3.0f;
	float (*p)[3] = &w->position[3 * i];

	for (int a = 0; a < 3; a++) {
		p[0][a] = w->at[a] + chance(-4, 4);
		p[1][a] = p[0][a] + chance(-size, size);
		p[2][a] = i % 11 == 5 ? p[1][a] + chance(-1e-4f, 1e-4f) : p[0][a] + chance(-size, size);
		if (i % 53 == 7)
			p[1][a] = p[2][a] = p[0][a];
		else if (i % 53 == 9)
			p[2][a] = p[1][a];
	}
	if (i % 29 == 3 && i > 0)
		memcpy(p, p - 3, 3 * sizeof(*p));
	for (uint32_t k = 0; k < 3; k++)
		w->index[i][k] = 3 * i + k;
}

static int make_world(struct world *w, float far, const char *device)
{
	w->at[0] = far, w->at[1] = -far / 2, w->at[2] = far / 3;
	for (uint32_t i = 0; i < N_TRIANGLES; i++)
		make_triangle(w, i);
	w->brute = (struct brute){ (const float (*)[3])w->position, (const uint32_t (*)[3])w->index, N_TRIANGLES, far + 8 };
	return relume_rays_open_triangles((const float(*)[3])w->position, 3 * N_TRIANGLES,
	                                  (const uint32_t(*)[3])w->index, N_TRIANGLES, device, &w->rays);
}

static struct relume_rays_ray make_ray(const struct world *w, uint32_t i)
{
	struct relume_rays_ray ray = { .nearest = i % 4 ? 0 : chance(0, 1), .farthest = i % 3 ? 1e9f : chance(0, 6) };

	for (int a = 0; a < 3; a++) {
		ray.origin[a] = w->at[a] + chance(-6, 6);
		ray.direction[a] = i % 17 == 4 && a != (int)(i / 17 % 3) ? 0 : chance(-1, 1);
	}
	return ray;
}

static struct relume_rays_body make_body(const struct world *w, uint32_t i, int is_sphere)
{
	struct relume_rays_body body;
	const float radius = i % 5 ? chance(0, 0.3f) : chance(0, 2);

	for (int a = 0; a < 3; a++) {
		body.centre[a] = w->at[a] + chance(-6, 6);
		body.size[a] = is_sphere ? radius : i % 19 == 2 ? 0 : chance(0, i % 5 ? 0.3f : 2);
		body.move[a] = i % 13 == 6 ? 0 : i % 23 == 6 && a ? 0 : chance(-6, 6);
	}
	return body;
}

static int ask_rays(struct world *w, enum kind kind, uint32_t n, struct tally *t)
{
	struct relume_rays_ray *rays = malloc(n * sizeof(*rays));
	struct relume_rays_hit *hits = malloc((size_t)n * MOST * sizeof(*hits));
	uint32_t *counts = malloc(n * sizeof(*counts));
	int rc = rays && hits && counts ? 0 : 5;

	for (uint32_t i = 0; i < n && !rc; i++)
		rays[i] = make_ray(w, i);
	if (!rc)
		rc = kind == NEAREST ? relume_rays_nearest(w->rays, rays, n, hits) :
		     kind == ANY     ? relume_rays_any(w->rays, rays, n, counts) :
		                       relume_rays_all(w->rays, rays, n, MOST, hits, counts);
	for (uint32_t i = 0; i < n && !rc; i++) {
		if (kind == NEAREST) {
			t->found[kind] += hits[i].triangle != RELUME_RAYS_NONE;
			t->wrong[kind] += !brute_nearest(&w->brute, &rays[i], &hits[i]);
		} else if (kind == ANY) {
			t->found[kind] += counts[i];
			t->wrong[kind] += !brute_any(&w->brute, &rays[i], counts[i]);
		} else {
			t->found[kind] += counts[i] != 0;
			t->wrong[kind] += !brute_all(&w->brute, &rays[i], hits + (size_t)i * MOST,
			                             counts[i] < MOST ? counts[i] : MOST, counts[i]);
		}
	}
	t->asked[kind] += n;
	free(rays);
	free(hits);
	free(counts);
	return rc;
}

static int ask_points(struct world *w, uint32_t n, struct tally *t)
{
	struct relume_rays_point *points = malloc(n * sizeof(*points));
	struct relume_rays_distance *answers = malloc(n * sizeof(*answers));
	int rc = points && answers ? 0 : 5;

	for (uint32_t i = 0; i < n && !rc; i++) {
		for (int a = 0; a < 3; a++)
			points[i].position[a] = w->at[a] + chance(-6, 6);
		points[i].farthest = i % 3 ? 1e18f : chance(0, 2);
	}
	if (!rc)
		rc = relume_rays_distance(w->rays, points, n, answers);
	for (uint32_t i = 0; i < n && !rc; i++) {
		t->found[DISTANCE] += answers[i].triangle != RELUME_RAYS_NONE;
		t->wrong[DISTANCE] += !brute_distance(&w->brute, &points[i], &answers[i]);
	}
	t->asked[DISTANCE] += n;
	free(points);
	free(answers);
	return rc;
}

static int ask_bodies(struct world *w, enum kind kind, uint32_t n, struct tally *t)
{
	struct relume_rays_body *bodies = malloc(n * sizeof(*bodies));
	struct relume_rays_contact *answers = malloc(n * sizeof(*answers));
	int rc = bodies && answers ? 0 : 5;

	for (uint32_t i = 0; i < n && !rc; i++)
		bodies[i] = make_body(w, i, kind == SPHERE);
	if (!rc)
		rc = kind == BOX ? relume_rays_move_box(w->rays, bodies, n, answers) :
		                   relume_rays_move_sphere(w->rays, bodies, n, answers);
	for (uint32_t i = 0; i < n && !rc; i++) {
		t->found[kind] += answers[i].triangle != RELUME_RAYS_NONE;
		t->wrong[kind] += kind == BOX ? !brute_box(&w->brute, &bodies[i], &answers[i], i % SAMPLED == 0)
		                              : !brute_sphere(&w->brute, &bodies[i], &answers[i]);
	}
	t->asked[kind] += n;
	free(bodies);
	free(answers);
	return rc;
}

static int ask_all_kinds(uint32_t n, const char *device, struct tally *t)
{
	static const float far[2] = { 0, 300 };
	static struct world w;
	int rc = 0;

	for (int scene = 0; scene < 2 && !rc; scene++) {
		rc = make_world(&w, far[scene], device);
		for (int kind = NEAREST; kind < N_KINDS && !rc; kind++)
			rc = kind == DISTANCE ? ask_points(&w, n / 2, t) :
			     kind < DISTANCE  ? ask_rays(&w, kind, n / 2, t) :
			                        ask_bodies(&w, kind, n / 2, t);
		relume_rays_close(&w.rays);
	}
	return rc;
}

/* --- Rates ------------------------------------------------------------------------------------------------------- */

struct peer {
	RTCScene scene;
	const struct bench_mesh *mesh;
	struct RTCRayHit *rays; /* [N_RATED] */
	const struct relume_rays_point *points;
	float *distances;       /* [N_RATED] */
	uint32_t first, last;
};

static void *trace_share(void *user)
{
	struct peer *p = user;

	for (uint32_t i = p->first; i < p->last; i += 256) {
		struct peer_query query;

		peer_query_init(&query, 0);
		peer_intersect_stream(p->scene, &query, &p->rays[i], p->last - i < 256 ? p->last - i : 256, sizeof(*p->rays));
	}
	return NULL;
}

/* The nearest point of a triangle by regions (Ericson 2005, section 5.1.5): the fast method, for triangles with an
 * area. */
static float region_distance2(const float p[3], const float a[3], const float b[3], const float c[3])
{
	float ab[3], ac[3], ap[3], bp[3], cp[3], at[3], d1 = 0, d2 = 0, d3 = 0, d4 = 0, d5 = 0, d6 = 0, va, vb, vc, s,
							t, sum = 0;

	for (int i = 0; i < 3; i++) {
		ab[i] = b[i] - a[i], ac[i] = c[i] - a[i], ap[i] = p[i] - a[i], bp[i] = p[i] - b[i], cp[i] = p[i] - c[i];
		d1 += ab[i] * ap[i], d2 += ac[i] * ap[i], d3 += ab[i] * bp[i], d4 += ac[i] * bp[i], d5 += ab[i] * cp[i],
			d6 += ac[i] * cp[i];
	}
	vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
	if (d1 <= 0 && d2 <= 0)
		s = t = 0;
	else if (d3 >= 0 && d4 <= d3)
		s = 1, t = 0;
	else if (vc <= 0 && d1 >= 0 && d3 <= 0)
		s = d1 / (d1 - d3), t = 0;
	else if (d6 >= 0 && d5 <= d6)
		s = 0, t = 1;
	else if (vb <= 0 && d2 >= 0 && d6 <= 0)
		s = 0, t = d2 / (d2 - d6);
	else if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
		t = (d4 - d3) / (d4 - d3 + d5 - d6), s = 1 - t;
	else
		s = vb / (va + vb + vc), t = vc / (va + vb + vc);
	for (int i = 0; i < 3; i++) {
		at[i] = ap[i] - s * ab[i] - t * ac[i];
		sum += at[i] * at[i];
	}
	return sum;
}

static bool near_triangle(struct RTCPointQueryFunctionArguments *args)
{
	const struct bench_mesh *mesh = *(const struct bench_mesh **)args->userPtr;
	const uint32_t *index = mesh->index[args->primID];
	const float p[3] = { args->query->x, args->query->y, args->query->z };
	const float d2 = region_distance2(p, mesh->position[index[0]], mesh->position[index[1]], mesh->position[index[2]]);

	if (d2 >= args->query->radius * args->query->radius)
		return false;
	args->query->radius = sqrtf(d2);
	return true;
}

static void *measure_share(void *user)
{
	struct peer *p = user;
	struct RTCPointQueryContext context;

	for (uint32_t i = p->first; i < p->last; i++) {
		struct RTCPointQuery query = { p->points[i].position[0], p->points[i].position[1],
			                       p->points[i].position[2], 0, INFINITY };
		const struct bench_mesh *mesh = p->mesh;

		rtcInitPointQueryContext(&context);
		rtcPointQuery(p->scene, &query, &context, near_triangle, &mesh);
		p->distances[i] = query.radius;
	}
	return NULL;
}

/* @return seconds */
static double run_peer(const struct peer *p, unsigned threads, void *(*share)(void *))
{
	pthread_t ids[MAX_THREADS];
	struct peer parts[MAX_THREADS];
	const double start = progress_clock_s();

	for (unsigned i = 0; i < threads; i++) {
		parts[i] = *p;
		parts[i].first = (uint32_t)((uint64_t)N_RATED * i / threads);
		parts[i].last = (uint32_t)((uint64_t)N_RATED * (i + 1) / threads);
		pthread_create(&ids[i], NULL, share, &parts[i]);
	}
	for (unsigned i = 0; i < threads; i++)
		pthread_join(ids[i], NULL);
	return progress_clock_s() - start;
}

struct rates {
	double ray[2], point[2]; /* seconds: ours, Embree's */
	double apart;            /* the largest difference of two distances */
	uint32_t hits_differ;
};

static RTCScene peer_scene(RTCDevice device, const struct bench_mesh *mesh)
{
	RTCScene scene = rtcNewScene(device);
	RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);

	rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh->position, 0, 16,
	                           mesh->n_vertices);
	rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh->index, 0, 12,
	                           mesh->n_triangles);
	rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
	rtcCommitGeometry(geometry);
	rtcAttachGeometry(scene, geometry);
	rtcReleaseGeometry(geometry);
	rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
	rtcCommitScene(scene);
	return scene;
}

/* Points up to 0.1 from surfaces, and rays from there in all directions. */
static void make_rated(const struct bench_mesh *mesh, struct relume_rays_point *points, struct relume_rays_ray *rays)
{
	for (uint32_t i = 0; i < N_RATED; i++) {
		const float *vertex = mesh->position[(uint32_t)(chance(0, 1) * (float)(mesh->n_vertices - 1))];

		points[i].farthest = 1e18f;
		rays[i].nearest = 1e-3f;
		rays[i].farthest = 1e9f;
		for (int a = 0; a < 3; a++) {
			rays[i].origin[a] = points[i].position[a] = vertex[a] + chance(-0.1f, 0.1f);
			rays[i].direction[a] = chance(-1, 1);
		}
	}
}

static void copy_rays(const struct relume_rays_ray *rays, struct RTCRayHit *out)
{
	for (uint32_t i = 0; i < N_RATED; i++)
		out[i] = (struct RTCRayHit){ .ray = {
			.org_x = rays[i].origin[0], .org_y = rays[i].origin[1], .org_z = rays[i].origin[2], .tnear = rays[i].nearest,
			.dir_x = rays[i].direction[0], .dir_y = rays[i].direction[1], .dir_z = rays[i].direction[2],
			.tfar = rays[i].farthest, .mask = ~0u
		},
			                     .hit = { .geomID = ~0u, .instID = { ~0u } } };
}

struct rated {
	struct relume_rays_point *points;
	struct relume_rays_ray *rays;
	struct relume_rays_hit *hits;
	struct relume_rays_distance *answers;
	struct peer peer;
	double seconds[4][REPEATS];
};

static int run_rates(struct relume_rays *ours, struct rated *r, unsigned threads)
{
	int rc = 0;

	for (int k = -1; k < REPEATS && !rc; k++) { /* the first run is a warm-up */
		const int at = k < 0 ? 0 : k;
		double start = progress_clock_s();

		rc = relume_rays_nearest(ours, r->rays, N_RATED, r->hits);
		r->seconds[0][at] = progress_clock_s() - start;
		copy_rays(r->rays, r->peer.rays);
		r->seconds[1][at] = run_peer(&r->peer, threads, trace_share);
		start = progress_clock_s();
		if (!rc)
			rc = relume_rays_distance(ours, r->points, N_RATED, r->answers);
		r->seconds[2][at] = progress_clock_s() - start;
		r->seconds[3][at] = run_peer(&r->peer, threads, measure_share);
	}
	return rc;
}

static int measure(const char *models, const char *device, struct rates *out)
{
	const unsigned threads = (unsigned)sysconf(_SC_NPROCESSORS_ONLN) < MAX_THREADS ?
	                                 (unsigned)sysconf(_SC_NPROCESSORS_ONLN) :
	                                 MAX_THREADS;
	RTCDevice embree = rtcNewDevice(NULL);
	struct bench_mesh mesh;
	struct relume_rays *ours = NULL;
	struct rated r = { .points = malloc(N_RATED * sizeof(*r.points)),
		           .rays = malloc(N_RATED * sizeof(*r.rays)),
		           .hits = malloc(N_RATED * sizeof(*r.hits)),
		           .answers = malloc(N_RATED * sizeof(*r.answers)),
		           .peer = { .rays = aligned_alloc(64, N_RATED * sizeof(*r.peer.rays)),
		                     .distances = malloc(N_RATED * sizeof(float)) } };
	float (*position)[3];
	int rc = -bench_mesh_create(models, &mesh);

	if (rc)
		return rc;
	position = malloc(mesh.n_vertices * sizeof(*position));
	for (uint32_t i = 0; i < mesh.n_vertices; i++)
		memcpy(position[i], mesh.position[i], sizeof(*position));
	make_rated(&mesh, r.points, r.rays);
	r.peer.mesh = &mesh;
	r.peer.points = r.points;
	r.peer.scene = peer_scene(embree, &mesh);
	rc = relume_rays_open_triangles((const float(*)[3])position, mesh.n_vertices, (const uint32_t(*)[3])mesh.index,
	                                mesh.n_triangles, device, &ours);
	if (!rc)
		rc = run_rates(ours, &r, threads);
	for (uint32_t i = 0; i < N_RATED && !rc; i++) {
		out->apart = fmax(out->apart, fabs((double)r.answers[i].distance - r.peer.distances[i]));
		out->hits_differ += (r.hits[i].triangle == RELUME_RAYS_NONE) !=
		                            (r.peer.rays[i].hit.geomID == RTC_INVALID_GEOMETRY_ID) ||
		                    (r.hits[i].triangle != RELUME_RAYS_NONE &&
		                     fabsf(r.hits[i].t - r.peer.rays[i].ray.tfar) > 1e-3f);
	}
	for (int k = 0; k < 2; k++) {
		out->ray[k] = bench_median(r.seconds[k], REPEATS);
		out->point[k] = bench_median(r.seconds[2 + k], REPEATS);
	}
	relume_rays_close(&ours);
	rtcReleaseScene(r.peer.scene);
	rtcReleaseDevice(embree);
	bench_mesh_free(&mesh);
	free(position);
	free(r.points);
	free(r.rays);
	free(r.hits);
	free(r.answers);
	free(r.peer.rays);
	free(r.peer.distances);
	return rc;
}

/* --- The report -------------------------------------------------------------------------------------------------- */

static uint64_t print(const struct tally *t, const struct rates *rates, int with_rates)
{
	uint64_t wrong = 0;

	for (int kind = 0; kind < N_KINDS; kind++) {
		printf("%-14s %9llu queries, %9llu with a result, %llu wrong (bar: 0)\n", kind_names[kind],
		       (unsigned long long)t->asked[kind], (unsigned long long)t->found[kind],
		       (unsigned long long)t->wrong[kind]);
		wrong += t->wrong[kind];
	}
	if (with_rates) {
		printf("nearest hit    %.2f million per second, %.2f times rtcIntersect1M; "
		       "%u of %u differ by more than 0.001\n",
		       N_RATED / rates->ray[0] / 1e6, rates->ray[1] / rates->ray[0], rates->hits_differ, N_RATED);
		printf("distance       %.2f million per second, %.2f times rtcPointQuery; apart by at most %.2g\n",
		       N_RATED / rates->point[0] / 1e6, rates->point[1] / rates->point[0], rates->apart);
	}
	return wrong;
}

static int write_json(const char *path, const char *command, const struct tally *t, const struct rates *rates,
                      uint64_t wrong)
{
	FILE *out = fopen(path, "w");

	if (!out)
		return err_report(ERR_SYSTEM, path, "cannot be written");
	fprintf(out,
	        "{\n  \"name\": \"query\",\n  \"command\": \"%s\",\n  \"figure\": %llu,\n  \"bar\": 0,\n  \"unit\": "
	        "\"answers that are wrong\",\n",
	        command, (unsigned long long)wrong);
	fprintf(out, "  \"peer\": \"Embree\",\n  \"peer_version\": \"%s\",\n  \"rows\": [\n", RTC_VERSION_STRING);
	for (int kind = 0; kind < N_KINDS; kind++)
		fprintf(out,
		        "    { \"what\": \"%s\", \"figure\": \"%llu of %llu wrong\", \"bar\": \"0\", \"passed\": %s "
		        "},\n",
		        kind_names[kind], (unsigned long long)t->wrong[kind], (unsigned long long)t->asked[kind],
		        t->wrong[kind] ? "false" : "true");
	fprintf(out,
	        "    { \"what\": \"nearest hit, rate against rtcIntersect1M\", \"figure\": %.3f, \"bar\": null, "
	        "\"passed\": null },\n",
	        rates->ray[0] > 0 ? rates->ray[1] / rates->ray[0] : 0);
	fprintf(out,
	        "    { \"what\": \"distance, rate against rtcPointQuery\", \"figure\": %.3f, \"bar\": null, "
	        "\"passed\": null }\n  ]\n}\n",
	        rates->point[0] > 0 ? rates->point[1] / rates->point[0] : 0);
	return fclose(out) ? err_report(ERR_SYSTEM, path, "cannot be written") : 0;
}

int main(int argc, char **argv)
{
	const char *json = NULL, *models = "../shared/models", *command = "queries", *device = NULL;
	struct tally tally = { 0 };
	struct rates rates = { 0 };
	uint32_t n = 1000000;
	int with_rates = 1, rc;
	uint64_t wrong;

	for (int i = 1; i + 1 < argc; i += 2) {
		if (strcmp(argv[i], "--json") == 0)
			json = argv[i + 1];
		else if (strcmp(argv[i], "--models") == 0)
			models = argv[i + 1];
		else if (strcmp(argv[i], "--command") == 0)
			command = argv[i + 1];
		else if (strcmp(argv[i], "--device") == 0)
			device = argv[i + 1];
		else if (strcmp(argv[i], "--count") == 0)
			n = (uint32_t)strtoul(argv[i + 1], NULL, 10);
		else if (strcmp(argv[i], "--seed") == 0)
			random_state = (uint32_t)strtoul(argv[i + 1], NULL, 10);
		else if (strcmp(argv[i], "--rates") == 0)
			with_rates = strcmp(argv[i + 1], "0") != 0;
		else
			return -err_report(ERR_USAGE, NULL, "no option %s", argv[i]);
	}
	rc = ask_all_kinds(n, device, &tally);
	if (!rc && with_rates)
		rc = measure(models, device, &rates);
	if (rc)
		return rc;
	wrong = print(&tally, &rates, with_rates);
	if (json)
		rc = -write_json(json, command, &tally, &rates, wrong);
	return rc ? rc : wrong != 0;
}
