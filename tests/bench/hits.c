/*
 * Hits of our kernels compared with Embree's, ray by ray, for the same triangles and rays. A separate program: the
 * command never links Embree.
 *
 * usage: hits [--rays N] [--models DIR] [--seed N] [--json FILE] [--command TEXT]
 *
 * Four scenes (the models; random triangles, including slivers and degenerate ones, at three scales) get a quarter of
 * the rays each. The kinds of rays alternate: anywhere, through a vertex, through a point of an edge, along an axis,
 * from a surface, from a surface along an axis, from far away.
 *
 * Every ray is traced through trees of each kind. The first kind is compared with Embree; the others should give
 * exactly its hits, and differing hits are judged in the same way.
 *
 * If the two disagree, geometry in double precision decides. In the plane across the ray, a triangle is sure to be hit
 * where the ray passes at least `band` inside of its outline, sure to be missed at least `band` outside, and on the
 * edge in between. band is ROUNDING times 2^-24 times the largest coordinate of the ray's origin and the triangle, and
 * of their difference: the resolution of single precision.
 *   tie by edge      a triangle that only one side reports has the ray on its edge
 *   tie by distance  both hits have the same distance within rounding (band over the cosine to the surface)
 *   tie by end       the hit is equally close to t_min or t_max
 *   wrong            everything else: the side that lacks a sure, nearer hit or has a sure miss Exit code 0 if ours
 *   is never wrong.
 */
#include "tests/bench/rtcore.h"
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "kernels/rays/rays.h"
#include "tracer/frame/common/traverse.h"
#include "verbs/render/bench/bench.h"

#define ROUNDING 32
#define N_SCENES 4
#define N_KINDS 7
#define BATCH 250000u
#define SOUP_TRIANGLES 20000u

static const char *const kind_names[N_KINDS] = {
	"anywhere", "through a vertex", "through an edge", "along an axis", "from a surface", "from a surface along an axis",
	"from far away",
};
static const char *const scene_names[N_SCENES] = { "models", "triangles by chance", "the same, a ten-thousandth",
	                                           "the same, ten thousand times" };

enum verdict { SAME, TIE_EDGE, TIE_DISTANCE, TIE_END, WRONG_PEER, WRONG_OURS, N_VERDICTS };
static const char *const verdict_names[N_VERDICTS] = { "same",       "tie by edge",  "tie by distance",
	                                               "tie by end", "Embree wrong", "ours wrong" };

static uint32_t random_state;

static float chance(float lo, float hi)
{
	random_state = random_state * 1664525u + 1013904223u;
	return lo + (hi - lo) * ((float)(random_state >> 8) / 16777216.0f);
}

static uint32_t pick(uint32_t n)
{
	random_state = random_state * 1664525u + 1013904223u;
	return (uint32_t)(((uint64_t)random_state * n) >> 32);
}

static void *must(void *p)
{
	if (!p)
		exit(-err_report(ERR_SYSTEM, NULL, "out of memory"));
	return p;
}

/* Random triangles in a cube of edge 4, including slivers, flat ones, ones without area and copies. */
static void make_soup(struct bench_mesh *m, float scale)
{
	m->n_triangles = SOUP_TRIANGLES;
	m->n_vertices = 3 * SOUP_TRIANGLES;
	m->position = must(calloc(m->n_vertices, sizeof(*m->position)));
	m->index = must(calloc(m->n_triangles, sizeof(*m->index)));
	for (uint32_t t = 0; t < m->n_triangles; t++) {
		const float size = t % 7 ? chance(0.02f, 0.2f) : chance(0.2f, 2);
		const float centre[3] = { chance(-2, 2), chance(-2, 2), chance(-2, 2) };

		for (uint32_t i = 0; i < 3; i++) {
			float *p = m->position[3 * t + i];

			for (int a = 0; a < 3; a++)
				p[a] = centre[a] + size * chance(-1, 1);
			if (t % 19 == 5)
				p[t % 3] = centre[t % 3]; /* flat along an axis */
			p[3] = 1;
			m->index[t][i] = 3 * t + i;
		}
		if (t % 17 == 3) /* no area */
			memcpy(m->position[3 * t + 2], m->position[3 * t + 1 - t % 2], sizeof(*m->position));
		if (t % 29 == 4) /* a sliver */
			for (int a = 0; a < 3; a++)
				m->position[3 * t + 2][a] = 0.5f * (m->position[3 * t][a] + m->position[3 * t + 1][a]) + chance(-1e-5f, 1e-5f);
		if (t % 23 == 7) /* a copy of the previous one */
			memcpy(m->index[t], m->index[t - 1], sizeof(*m->index));
	}
	for (uint32_t i = 0; i < m->n_vertices; i++)
		for (int a = 0; a < 3; a++)
			m->position[i][a] *= scale;
}

/* --- both sides -------------------------------------------------------------------------------------------------- */

struct world {
	struct bench_mesh mesh;
	float size; /* the scene's, roughly */
	struct accel *accel;
	struct scene scene;
	struct scene_mesh scene_mesh;
	const struct scene_mesh *mesh_list[1];
	struct scene_instance scene_instance;
	struct scene_view scene_view;
	struct instance instance;
	struct view view;
	const struct accel_space *spaces;
	uint32_t n_spaces;
	struct traverse_trees trees;
	union buffer_ray rays;
	union buffer_hit hits;
	union buffer_uint occluded;
	RTCScene peer;
};

static int open_ours(struct device *dev, struct world *w)
{
	int err;

	w->scene_mesh = (struct scene_mesh){ .hash = { 1, 1 }, .kind = SCENE_TRIANGLES, .vertex_count = w->mesh.n_vertices,
		                             .primitive_count = w->mesh.n_triangles, .position = w->mesh.position[0],
		                             .index = w->mesh.index[0] };
	w->mesh_list[0] = &w->scene_mesh;
	w->scene.meshes = w->mesh_list;
	w->scene.instances = &w->scene_instance;
	w->scene.views = &w->scene_view;
	w->scene.n_meshes = w->scene.n_instances = w->scene.n_views = 1;
	w->instance.flags = INSTANCE_OPAQUE | INSTANCE_SECONDARY;
	for (int i = 0; i < 3; i++)
		w->instance.eye_from_obj[5 * i] = w->instance.obj_from_eye[5 * i] = 1;
	err = accel_create(&w->accel);
	for (int kind = 0; kind < N_ACCEL_KINDS && !err; kind++) {
		w->accel->kind = (enum accel_kind)kind;
		err = accel_build_frame(w->accel, &w->scene, NULL, NULL, &w->instance, 1, &w->view, &w->spaces, &w->n_spaces);
	}
	return err ? err : traverse_upload_pools(dev, w->accel, &w->trees);
}

/* Results for a batch of rays in one kind of tree. */
struct outcome {
	struct hit hits[BATCH];
	uint32_t occluded[BATCH];
};

static int trace_ours(struct device *dev, struct world *w, enum accel_kind kind, const struct ray *rays, uint32_t n,
                      struct outcome *out)
{
	struct traverse_rays r;
	int err;

	/* The trees exist; only the top level and the instance change. */
	w->accel->kind = kind;
	if ((err = accel_build_frame(w->accel, &w->scene, NULL, NULL, &w->instance, 1, &w->view, &w->spaces, &w->n_spaces)) ||
	    (err = traverse_upload_tlases(dev, w->accel, &w->instance, 1, &w->trees)) ||
	    (err = launch_upload(dev, w->rays, rays, n)) || (err = launch_reserve(dev, w->hits, n)) ||
	    (err = launch_reserve(dev, w->occluded, n)))
		return err;
	r = (struct traverse_rays){
		.space = &w->spaces[0], .n = n, .rays = w->rays, .occluded = w->occluded, .hits = w->hits
	};
	for (int any = 0; any < 2 && !err; any++)
		err = traverse_rays(dev, any ? KERNEL_occlude_packet : KERNEL_intersect_packet, &w->trees, &r);
	if (!err)
		err = device_read(dev, w->hits.buffer, 0, out->hits, n * sizeof(out->hits[0]));
	return err ? err : device_read(dev, w->occluded.buffer, 0, out->occluded, n * sizeof(out->occluded[0]));
}

/* Robust mode: Embree's own solution for rays through edges. */
static void open_peer(RTCDevice peer, struct world *w)
{
	const struct bench_mesh *m = &w->mesh;
	RTCGeometry geometry = rtcNewGeometry(peer, RTC_GEOMETRY_TYPE_TRIANGLE);
	float *vertices = must(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
	                                               3 * sizeof(float), m->n_vertices));
	unsigned *indices = must(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
	                                                 3 * sizeof(unsigned), m->n_triangles));

	for (uint32_t i = 0; i < m->n_vertices; i++)
		memcpy(vertices + 3 * (size_t)i, m->position[i], 3 * sizeof(float));
	memcpy(indices, m->index, m->n_triangles * sizeof(*m->index));
	w->peer = rtcNewScene(peer);
	rtcSetSceneFlags(w->peer, RTC_SCENE_FLAG_ROBUST);
	rtcCommitGeometry(geometry);
	rtcAttachGeometry(w->peer, geometry);
	rtcReleaseGeometry(geometry);
	rtcCommitScene(w->peer);
}

static uint32_t trace_peer(const struct world *w, const struct ray *ray)
{
	struct peer_query query;
	struct RTCRayHit r = { .ray = {
		.org_x = ray->o[0], .org_y = ray->o[1], .org_z = ray->o[2], .dir_x = ray->d[0], .dir_y = ray->d[1],
		.dir_z = ray->d[2], .tnear = ray->t_min, .tfar = ray->t_max, .mask = ~0u
	},
		               .hit = { .geomID = RTC_INVALID_GEOMETRY_ID } };

	peer_query_init(&query, 0);
	peer_intersect(w->peer, &query, &r);
	return r.hit.geomID == RTC_INVALID_GEOMETRY_ID ? SCENE_NONE : r.hit.primID;
}

/* --- rays -------------------------------------------------------------------------------------------------------- */

static struct ray make_ray(const struct world *w, uint32_t kind)
{
	const uint32_t *index = w->mesh.index[pick(w->mesh.n_triangles)];
	const float *p[3] = { w->mesh.position[index[0]], w->mesh.position[index[1]], w->mesh.position[index[2]] };
	const float b1 = kind == 1 ? 0 : chance(0, 1), b2 = kind == 1 || kind == 2 ? 0 : chance(0, 1 - b1);
	struct ray r = { .t_min = 0, .t_max = INFINITY };
	float at[3];

	for (int a = 0; a < 3; a++) {
		at[a] = p[0][a] + b1 * (p[1][a] - p[0][a]) + b2 * (p[2][a] - p[0][a]);
		r.o[a] = w->size * chance(-1, 1) + (kind == 0 ? 0 : at[a]);
		r.d[a] = kind == 0 ? chance(-1, 1) : at[a] - r.o[a];
	}
	if (kind == 3 || kind == 5) {
		const uint32_t axis = pick(3);
		const float way = pick(2) ? 1 : -1;

		for (uint32_t a = 0; a < 3; a++) {
			r.d[a] = a == axis ? way : pick(2) ? 0.0f : -0.0f;
			r.o[a] = kind == 3 && a == axis ? at[a] - way * w->size : at[a];
		}
	}
	if (kind == 4)
		for (int a = 0; a < 3; a++) {
			r.o[a] = at[a];
			r.d[a] = chance(-1, 1);
		}
	if (kind == 6)
		for (int a = 0; a < 3; a++)
			r.o[a] -= 1e4f * r.d[a];
	if (pick(4) == 0)
		r.t_max = chance(0, kind == 0 || kind == 4 ? 2 * w->size : 2);
	return r;
}

/* --- judging ----------------------------------------------------------------------------------------------------- */

/* A triangle and a ray in double precision. */
struct meeting {
	double t, inside, band, t_band; /* inside: distance inside the outline, across the ray; negative: outside */
};

static double along(const double a[3], const double b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void across(const double a[3], const double b[3], double out[3])
{
	out[0] = a[1] * b[2] - a[2] * b[1];
	out[1] = a[2] * b[0] - a[0] * b[2];
	out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Distance of the origin from the segment a b, in two dimensions. */
static double segment_distance(const double a[2], const double b[2])
{
	const double e[2] = { b[0] - a[0], b[1] - a[1] }, length = e[0] * e[0] + e[1] * e[1];
	const double s = length > 0 ? fmin(fmax(-(a[0] * e[0] + a[1] * e[1]) / length, 0), 1) : 0;

	return hypot(a[0] + s * e[0], a[1] + s * e[1]);
}

static struct meeting meet(const struct world *w, const struct ray *ray, uint32_t primitive)
{
	const uint32_t *index = w->mesh.index[primitive];
	const double d[3] = { ray->d[0], ray->d[1], ray->d[2] }, length = sqrt(along(d, d));
	double v[3][3], flat[3][2], x[3], y[3], n[3], e1[3], e2[3], largest = 0, distance = INFINITY, sign[3];
	const int least = fabs(d[0]) <= fabs(d[1]) && fabs(d[0]) <= fabs(d[2]) ? 0 : fabs(d[1]) <= fabs(d[2]) ? 1 : 2;
	const double axis[3] = { least == 0, least == 1, least == 2 };
	struct meeting m;

	across(d, axis, x);
	across(d, x, y);
	for (int i = 0; i < 3; i++) {
		for (int a = 0; a < 3; a++) {
			v[i][a] = (double)w->mesh.position[index[i]][a] - ray->o[a];
			largest = fmax(largest, fmax(fabs(v[i][a]), fmax(fabs((double)ray->o[a]),
			                                                 fabs((double)w->mesh.position[index[i]][a]))));
		}
		flat[i][0] = along(v[i], x) / sqrt(along(x, x));
		flat[i][1] = along(v[i], y) / sqrt(along(y, y));
	}
	for (int i = 0; i < 3; i++) {
		const double *a = flat[i], *b = flat[(i + 1) % 3];

		distance = fmin(distance, segment_distance(a, b));
		sign[i] = a[0] * b[1] - a[1] * b[0];
	}
	for (int a = 0; a < 3; a++) {
		e1[a] = v[1][a] - v[0][a];
		e2[a] = v[2][a] - v[0][a];
	}
	across(e1, e2, n);
	m.t = along(v[0], n) / along(d, n);
	m.inside = (sign[0] > 0 && sign[1] > 0 && sign[2] > 0) || (sign[0] < 0 && sign[1] < 0 && sign[2] < 0) ?
	                   distance :
	                   -distance;
	m.band = ROUNDING * 0x1p-24 * largest;
	m.t_band = m.band * sqrt(along(n, n)) / fabs(along(d, n)) + m.band / length;
	return m;
}

/* Whether t is at an end of the ray, within rounding. */
static int at_end(const struct ray *ray, const struct meeting *m)
{
	return fabs(m->t - ray->t_min) <= m->t_band || fabs(m->t - ray->t_max) <= m->t_band;
}

static enum verdict judge(const struct world *w, const struct ray *ray, uint32_t ours, uint32_t theirs)
{
	struct meeting a = { 0 }, b = { 0 };

	if (ours == theirs)
		return SAME;
	if (ours != SCENE_NONE)
		a = meet(w, ray, ours);
	if (theirs != SCENE_NONE)
		b = meet(w, ray, theirs);
	/* If t is not finite (no area, or edge-on), only the outline determines whether the triangle may be hit. */
	if (ours != SCENE_NONE && theirs != SCENE_NONE && fabs(a.t - b.t) <= a.t_band + b.t_band)
		return TIE_DISTANCE;
	if ((ours != SCENE_NONE && at_end(ray, &a)) || (theirs != SCENE_NONE && at_end(ray, &b)))
		return TIE_END;
	if ((ours != SCENE_NONE && fabs(a.inside) <= a.band) || (theirs != SCENE_NONE && fabs(b.inside) <= b.band))
		return TIE_EDGE;
	if (ours != SCENE_NONE && (a.inside < 0 || a.t < ray->t_min || a.t > ray->t_max))
		return WRONG_OURS;
	if (theirs != SCENE_NONE && (b.inside < 0 || b.t < ray->t_min || b.t > ray->t_max))
		return WRONG_PEER;
	return ours == SCENE_NONE || (theirs != SCENE_NONE && b.t < a.t) ? WRONG_OURS : WRONG_PEER;
}

/* --- the run ----------------------------------------------------------------------------------------------------- */

struct tally {
	uint64_t n[N_SCENES][N_KINDS][N_VERDICTS], occluded_wrong, shown[N_VERDICTS];
	/* rays whose hit in trees of a kind differs from that in the first kind; wrong hits among them */
	uint64_t differ[N_ACCEL_KINDS], wrong[N_ACCEL_KINDS];
};

static void count(struct tally *tally, const struct world *w, uint32_t scene, uint32_t kind, const struct ray *ray,
                  const struct hit *hit, uint32_t occluded)
{
	const uint32_t ours = hit->instance == SCENE_NONE ? SCENE_NONE : hit->primitive, theirs = trace_peer(w, ray);
	const enum verdict verdict = judge(w, ray, ours, theirs);

	tally->n[scene][kind][verdict]++;
	tally->wrong[0] += verdict == WRONG_OURS;
	/* Any hit and nearest hit must agree for each ray. */
	tally->occluded_wrong += occluded != (ours != SCENE_NONE);
	if (verdict != SAME && tally->shown[verdict]++ < 5)
		printf("%s: %s, %s: o %.9g %.9g %.9g d %.9g %.9g %.9g t %.9g .. %.9g: ours %d, Embree %d\n", verdict_names[verdict],
		       scene_names[scene], kind_names[kind], ray->o[0], ray->o[1], ray->o[2], ray->d[0], ray->d[1], ray->d[2],
		       ray->t_min, ray->t_max, (int)ours, (int)theirs);
}

/* Trees of the other kinds. */
static void count_others(struct tally *tally, const struct world *w, const struct ray *ray, uint32_t i,
                         struct outcome *const out[N_ACCEL_KINDS])
{
	for (int a = 1; a < N_ACCEL_KINDS; a++) {
		const struct hit *hit = &out[a]->hits[i];
		const uint32_t ours = hit->instance == SCENE_NONE ? SCENE_NONE : hit->primitive;

		tally->occluded_wrong += out[a]->occluded[i] != (ours != SCENE_NONE);
		if (memcmp(hit, &out[0]->hits[i], sizeof(*hit)) == 0)
			continue;
		if (tally->differ[a]++ < 5)
			printf("%s is not %s: o %.9g %.9g %.9g d %.9g %.9g %.9g t %.9g .. %.9g: %d, %d\n",
			       accel_kind_names[a], accel_kind_names[0], ray->o[0], ray->o[1], ray->o[2], ray->d[0],
			       ray->d[1], ray->d[2], ray->t_min, ray->t_max, (int)ours, (int)out[0]->hits[i].primitive);
		tally->wrong[a] += judge(w, ray, ours, trace_peer(w, ray)) == WRONG_OURS;
	}
}

static int run_scene(struct device *dev, RTCDevice peer, struct world *w, uint32_t scene, uint64_t n,
                     struct tally *tally)
{
	struct ray *rays = must(malloc(BATCH * sizeof(*rays)));
	struct outcome *out[N_ACCEL_KINDS];
	int err = open_ours(dev, w);

	for (int a = 0; a < N_ACCEL_KINDS; a++)
		out[a] = must(malloc(sizeof(*out[a])));

	if (!err)
		open_peer(peer, w);
	for (uint64_t done = 0; done < n && !err; done += BATCH) {
		const uint32_t batch = n - done < BATCH ? (uint32_t)(n - done) : BATCH;

		for (uint32_t i = 0; i < batch; i++)
			rays[i] = make_ray(w, i % N_KINDS);
		for (int a = 0; a < N_ACCEL_KINDS && !err; a++)
			err = trace_ours(dev, w, (enum accel_kind)a, rays, batch, out[a]);
		for (uint32_t i = 0; i < batch && !err; i++) {
			count(tally, w, scene, i % N_KINDS, &rays[i], &out[0]->hits[i], out[0]->occluded[i]);
			count_others(tally, w, &rays[i], i, out);
		}
	}
	if (w->peer)
		rtcReleaseScene(w->peer);
	device_release(dev, &w->rays.buffer);
	device_release(dev, &w->hits.buffer);
	device_release(dev, &w->occluded.buffer);
	traverse_release(dev, &w->trees);
	accel_destroy(&w->accel);
	free(rays);
	for (int a = 0; a < N_ACCEL_KINDS; a++)
		free(out[a]);
	return err;
}

static uint64_t total(const struct tally *tally, int kind, int verdict)
{
	uint64_t sum = 0;

	for (int s = 0; s < N_SCENES; s++)
		for (int k = 0; k < N_KINDS; k++)
			for (int v = 0; v < N_VERDICTS; v++)
				if ((kind < 0 || k == kind) && (verdict < 0 || v == verdict))
					sum += tally->n[s][k][v];
	return sum;
}

static uint64_t total_wrong(const struct tally *tally)
{
	uint64_t sum = tally->occluded_wrong;

	for (int a = 0; a < N_ACCEL_KINDS; a++)
		sum += tally->wrong[a];
	return sum;
}

static int write_json(const char *path, const struct tally *tally, const char *device, const char *command)
{
	const uint64_t wrong = total_wrong(tally);
	FILE *out = fopen(path, "w");

	if (!out)
		return err_report(ERR_SYSTEM, path, "cannot be written");
	fprintf(out, "{\n  \"name\": \"hits\",\n  \"command\": \"%s\",\n  \"figure\": %llu,\n  \"bar\": 0,\n", command,
	        (unsigned long long)wrong);
	fprintf(out,
	        "  \"unit\": \"rays whose hit is wrong\",\n  \"peer\": \"Embree\",\n  \"peer_version\": \"%s, "
	        "robust\",\n",
	        RTC_VERSION_STRING);
	fprintf(out, "  \"device\": \"%s\",\n  \"rays\": %llu,\n  \"rows\": [\n", device,
	        (unsigned long long)total(tally, -1, -1));
	for (int v = SAME; v < N_VERDICTS; v++)
		fprintf(out, "    { \"what\": \"%s\", \"figure\": \"%llu rays\", \"bar\": %s, \"passed\": %s },\n", verdict_names[v],
		        (unsigned long long)total(tally, -1, v), v == WRONG_OURS ? "\"0\"" : "null",
		        v == WRONG_OURS ? (total(tally, -1, v) ? "false" : "true") : "null");
	for (int a = 1; a < N_ACCEL_KINDS; a++)
		fprintf(out,
		        "    { \"what\": \"hits of %s that are not those of %s to the bit\", \"figure\": \"%llu rays, %llu "
		        "wrong\", \"bar\": \"0 wrong\", \"passed\": %s },\n",
		        accel_kind_names[a], accel_kind_names[0], (unsigned long long)tally->differ[a],
		        (unsigned long long)tally->wrong[a], tally->wrong[a] ? "false" : "true");
	fprintf(out,
	        "    { \"what\": \"any hit and nearest hit disagree\", \"figure\": \"%llu rays\", \"bar\": \"0\", "
	        "\"passed\": %s }\n  ]\n}\n",
	        (unsigned long long)tally->occluded_wrong, tally->occluded_wrong ? "false" : "true");
	return fclose(out) ? err_report(ERR_SYSTEM, path, "cannot be written") : 0;
}

int main(int argc, char **argv)
{
	const char *json = NULL, *models = "../shared/models", *command = "hits";
	static struct tally tally;
	uint64_t n = 10000000;
	struct device *dev = NULL;
	RTCDevice peer;
	int err;

	random_state = 1;
	for (int i = 1; i + 1 < argc; i += 2) {
		if (strcmp(argv[i], "--json") == 0)
			json = argv[i + 1];
		else if (strcmp(argv[i], "--models") == 0)
			models = argv[i + 1];
		else if (strcmp(argv[i], "--command") == 0)
			command = argv[i + 1];
		else if (strcmp(argv[i], "--rays") == 0)
			n = strtoull(argv[i + 1], NULL, 10);
		else if (strcmp(argv[i], "--seed") == 0)
			random_state = (uint32_t)strtoul(argv[i + 1], NULL, 10);
		else
			return -err_report(ERR_USAGE, NULL, "no option %s", argv[i]);
	}
	err = device_open(NULL, 0, &dev);
	peer = rtcNewDevice("threads=1");
	for (uint32_t scene = 0; scene < N_SCENES && !err; scene++) {
		static const float scales[N_SCENES] = { 1, 1, 1e-4f, 1e4f };
		struct world w = { .size = 4 * scales[scene] };

		if (scene == 0)
			err = bench_mesh_create(models, &w.mesh);
		else
			make_soup(&w.mesh, scales[scene]);
		if (!err)
			err = run_scene(dev, peer, &w, scene, n / N_SCENES, &tally);
		bench_mesh_free(&w.mesh);
	}
	rtcReleaseDevice(peer);
	if (err)
		goto done;
	printf("%-30s", "");
	for (int v = 0; v < N_VERDICTS; v++)
		printf(" %15s", verdict_names[v]);
	for (int k = -1; k < N_KINDS; k++) {
		printf("\n%-30s", k < 0 ? "all rays" : kind_names[k]);
		for (int v = 0; v < N_VERDICTS; v++)
			printf(" %15llu", (unsigned long long)total(&tally, k, v));
	}
	printf("\nany hit and nearest hit disagree: %llu; bar: 0 of ours wrong, 0 of these\n",
	       (unsigned long long)tally.occluded_wrong);
	for (int a = 1; a < N_ACCEL_KINDS; a++)
		printf("%s: %llu hits differ from those of %s, %llu of them wrong; bar: 0 wrong\n", accel_kind_names[a],
		       (unsigned long long)tally.differ[a], accel_kind_names[0], (unsigned long long)tally.wrong[a]);
	if (json)
		err = write_json(json, &tally, device_name(dev), command);
	if (!err && total_wrong(&tally))
		err = ERR_FAILED;
done:
	device_close(&dev);
	return -err;
}
