/*
 * Embree's time for the camera and shadow rays of a recorded frame: a lower limit for a ray traced frame.
 *
 * usage: frame_rays TRACE FRAME REPEATS
 *
 * All triangles of the frame are in one Embree scene of the best quality, in eye space. One ray goes through each
 * pixel's centre, and from its hit one to each light that the surface faces. Both are laid out beforehand in packets of
 * 4, 8 and 16 and as a stream; the fastest counts. Prints processor milliseconds on one thread, medians: camera,
 * shadow, and the number of rays of each.
 */
#include "tests/bench/rtcore.h"
#include <math.h>
#include <pmmintrin.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <xmmintrin.h>

#include "base/mat4.h"
#include "replay/replay.h"
#include "scene/release.h"
#include "verbs/render/bench/bench.h"

#define MAX_REPEATS 99
#define STREAM 256 /* rays per stream call */
#define FAR 1e30f

/* Rays and hits, laid out as packets of any width; only camera rays have hits. */
struct rays {
	struct RTCRayHit *r;
	size_t n;
	int shadow; /* 1: any hit suffices */
};

enum { CALL_4, CALL_8, CALL_16, CALL_STREAM, N_CALLS };

/* Rays in packets of N: every field of RTCRayHitN is N long, in the same order as in RTCRayHit. */
#define TRACE_N(N)                                                                                                     \
	static void lay_out_##N(const struct rays *rays, void *out)                                                    \
	{                                                                                                              \
		uint32_t *to = out;                                                                                    \
		for (size_t i = 0; i < rays->n; i++) {                                                                 \
			const uint32_t *from = (const uint32_t *)(const void *)&rays->r[i];                            \
			uint32_t *packet = to + i / N * (sizeof(struct RTCRayHit##N) / 4) + i % N;                     \
			for (size_t k = 0; k < sizeof(struct RTCRayHit##N) / 4 / N; k++)                               \
				packet[k * N] = from[k];                                                               \
		}                                                                                                      \
	}                                                                                                              \
	static void trace_##N(RTCScene scene, struct peer_query *query, const struct rays *rays, void *laid_out) \
	{                                                                                                              \
		struct RTCRayHit##N *packets = laid_out;                                                               \
		_Alignas(64) int valid[N];                                                                             \
		memset(valid, 0xff, sizeof(valid));                                                                    \
		for (size_t i = 0; i < rays->n / N; i++)                                                               \
			if (rays->shadow)                                                                              \
				PEER_OCCLUDED(N, valid, scene, query, &packets[i].ray);                                \
			else                                                                                           \
				PEER_INTERSECT(N, valid, scene, query, &packets[i]);                                   \
	}
TRACE_N(4)
TRACE_N(8)
TRACE_N(16)

static void trace_stream(RTCScene scene, struct peer_query *query, const struct rays *rays, struct RTCRayHit *r)
{
	for (size_t i = 0; i < rays->n; i += STREAM) {
		const unsigned n = (unsigned)(rays->n - i < STREAM ? rays->n - i : STREAM);

		if (rays->shadow)
			peer_occluded_stream(scene, query, &r[i].ray, n, sizeof(*r));
		else
			peer_intersect_stream(scene, query, &r[i], n, sizeof(*r));
	}
}

static double cpu_clock_ms(void)
{
	struct timespec t;

	clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
	return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static double trace_once(RTCScene scene, const struct rays *rays, int call, void *laid_out)
{
	struct peer_query query;
	double begin;

	peer_query_init(&query, 1);
	switch (call) {
	case CALL_4:
		lay_out_4(rays, laid_out);
		break;
	case CALL_8:
		lay_out_8(rays, laid_out);
		break;
	case CALL_16:
		lay_out_16(rays, laid_out);
		break;
	default:
		memcpy(laid_out, rays->r, rays->n * sizeof(*rays->r));
	}
	begin = cpu_clock_ms();
	switch (call) {
	case CALL_4:
		trace_4(scene, &query, rays, laid_out);
		break;
	case CALL_8:
		trace_8(scene, &query, rays, laid_out);
		break;
	case CALL_16:
		trace_16(scene, &query, rays, laid_out);
		break;
	default:
		trace_stream(scene, &query, rays, laid_out);
	}
	return cpu_clock_ms() - begin;
}

/* The median of the fastest call. */
static double trace(RTCScene scene, const struct rays *rays, size_t repeats)
{
	void *laid_out = aligned_alloc(64, (rays->n * sizeof(*rays->r) + 64) / 64 * 64);
	double took[N_CALLS][MAX_REPEATS], best = INFINITY;

	for (size_t i = 0; i < repeats; i++)
		for (int call = 0; call < N_CALLS; call++)
			took[call][i] = trace_once(scene, rays, call, laid_out);
	for (int call = 0; call < N_CALLS; call++)
		best = fmin(best, bench_median(took[call], repeats));
	free(laid_out);
	return best;
}

/* --- The frame --------------------------------------------------------------------------------------------------- */

/* One geometry per instance, so that a hit identifies its instance. */
static void add_instance(RTCDevice device, RTCScene to, const struct scene *scene, uint32_t number)
{
	const struct scene_instance *instance = &scene->instances[number];
	const struct scene_mesh *mesh = scene->meshes[instance->mesh];
	RTCGeometry geometry;
	float *vertices;
	unsigned *indices;

	if (mesh->kind != SCENE_TRIANGLES || instance->rectangle)
		return;
	geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
	rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
	vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
	                                   mesh->vertex_count);
	indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned),
	                                  mesh->primitive_count);
	for (uint32_t i = 0; i < mesh->vertex_count; i++) {
		float eye[4];

		mat4_transform(eye, instance->modelview, mesh->position + 4 * (size_t)i);
		for (int c = 0; c < 3; c++)
			vertices[3 * (size_t)i + (size_t)c] = eye[c] / eye[3];
	}
	memcpy(indices, mesh->index, 3 * sizeof(unsigned) * mesh->primitive_count);
	rtcCommitGeometry(geometry);
	rtcAttachGeometryByID(to, geometry, number);
	rtcReleaseGeometry(geometry);
}

static struct RTCRayHit ray_between(const float from[3], const float to[3], float t_min, float t_max)
{
	return (struct RTCRayHit){ .ray = {
		.org_x = from[0], .org_y = from[1], .org_z = from[2], .dir_x = to[0] - from[0], .dir_y = to[1] - from[1],
		.dir_z = to[2] - from[2], .tnear = t_min, .tfar = t_max, .mask = ~0u
	},
		                   .hit = { .geomID = RTC_INVALID_GEOMETRY_ID,
		                            .instID = { RTC_INVALID_GEOMETRY_ID } } };
}

/* From the near plane through pixel centres, in blocks of 4 x 4. */
static void make_camera_rays(const struct scene *scene, struct rays *rays)
{
	const uint32_t columns = scene->width / 4;
	float inverse[16];

	mat4_invert(inverse, scene->views[0].projection);
	rays->n = (size_t)columns * 4 * (scene->height / 4 * 4);
	rays->r = calloc(rays->n, sizeof(*rays->r));
	for (size_t i = 0; i < rays->n; i++) {
		const size_t block = i / 16, x = block % columns * 4 + i % 4, y = block / columns * 4 + i % 16 / 4;
		float clip[4] = { 2 * ((float)x + 0.5f) / (float)scene->width - 1,
			          2 * ((float)y + 0.5f) / (float)scene->height - 1, -1, 1 };
		float ends[2][4];

		for (int k = 0; k < 2; k++, clip[2] = 1) {
			mat4_transform(ends[k], inverse, clip);
			for (int c = 0; c < 3; c++)
				ends[k][c] /= ends[k][3];
		}
		rays->r[i] = ray_between(ends[0], ends[1], 0, 1);
	}
}

/* One ray to each light on the same side of the surface as the camera. */
static void add_shadow_rays(const struct scene *scene, const struct RTCRayHit *hit, struct rays *rays)
{
	const struct scene_material *m;
	const struct RTCRay *r = &hit->ray;
	const float p[3] = { r->org_x + r->tfar * r->dir_x, r->org_y + r->tfar * r->dir_y, r->org_z + r->tfar * r->dir_z };
	float side;

	if (hit->hit.geomID == RTC_INVALID_GEOMETRY_ID)
		return;
	m = &scene->materials[scene->instances[hit->hit.geomID].material];
	side = -(hit->hit.Ng_x * r->dir_x + hit->hit.Ng_y * r->dir_y + hit->hit.Ng_z * r->dir_z);
	for (uint32_t i = m->light_first; m->lighting && i < m->light_first + m->light_count; i++) {
		const float *light = scene->lights[i].position_eye;
		float to[3];

		for (int c = 0; c < 3; c++)
			to[c] = light[3] != 0 ? light[c] / light[3] : p[c] + light[c];
		if (side * (hit->hit.Ng_x * (to[0] - p[0]) + hit->hit.Ng_y * (to[1] - p[1]) + hit->hit.Ng_z * (to[2] - p[2])) > 0)
			rays->r[rays->n++] = ray_between(p, to, 1e-3f, light[3] != 0 ? 1 : FAR);
	}
}

static void make_shadow_rays(const struct scene *scene, RTCScene tree, const struct rays *camera, struct rays *rays)
{
	struct peer_query query;

	rays->shadow = 1;
	rays->r = calloc(camera->n * (scene->n_lights + (size_t)1) + 16, sizeof(*rays->r));
	peer_query_init(&query, 0);
	for (size_t i = 0; i < camera->n; i++) {
		struct RTCRayHit hit = camera->r[i];

		peer_intersect(tree, &query, &hit);
		add_shadow_rays(scene, &hit, rays);
	}
	rays->n -= rays->n % 16;
}

int main(int argc, char **argv)
{
	const size_t repeats = argc == 4 ? strtoul(argv[3], NULL, 10) : 0;
	struct rays camera = { .r = NULL }, shadow = { .r = NULL };
	struct scene *scene = NULL;
	RTCDevice device;
	RTCScene tree;
	double camera_ms, shadow_ms;

	if (repeats < 1 || repeats > MAX_REPEATS) {
		fprintf(stderr, "usage: frame_rays TRACE FRAME REPEATS\n");
		return 2;
	}
	if (replay_one_frame(argv[1], strtoull(argv[2], NULL, 10), &scene))
		return 3;
	_MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
	_MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
	device = rtcNewDevice("threads=1");
	tree = rtcNewScene(device);
	rtcSetSceneBuildQuality(tree, RTC_BUILD_QUALITY_HIGH);
	for (uint32_t i = 0; i < scene->n_instances; i++)
		add_instance(device, tree, scene, i);
	rtcCommitScene(tree);
	make_camera_rays(scene, &camera);
	make_shadow_rays(scene, tree, &camera, &shadow);
	camera_ms = trace(tree, &camera, repeats);
	shadow_ms = trace(tree, &shadow, repeats);
	printf("%.3f %.3f %zu %zu\n", camera_ms, shadow_ms, camera.n, shadow.n);
	free(camera.r);
	free(shadow.r);
	rtcReleaseScene(tree);
	rtcReleaseDevice(device);
	scene_release(&scene);
	return 0;
}
