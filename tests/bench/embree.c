/*
 * Our traversal kernels against Embree's on the same triangles and rays, in one alternating run. A separate program:
 * the command never links Embree.
 *
 * usage: embree [--bars 1] [--isa avx2] [--json FILE] [--models DIR] [--repeat N] [--command TEXT]
 *
 * Embree runs at its best: highest build quality; the fastest of its single-ray, packet (4, 8, 16) and stream calls
 * with the flag that suits the rays; flush-to-zero and denormals-are-zero set; as many threads as ours; its own choice
 * of vector units (--isa restricts it to narrower ones); rays laid out beforehand for each call. Camera rays are
 * generated while tracing on both sides; ours also include the cost of a new camera for a frame. Figures are medians of
 * wall time; the ratio of processor times is printed beside them, for busy machines. With --bars: exit code 0 if all
 * kinds of rays reach their bars on both scenes, 1 if not.
 */
#include "tests/bench/rtcore.h"
#include <math.h>
#include <pthread.h>
#include <pmmintrin.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <xmmintrin.h>

#include "base/err.h"
#include "base/progress.h"
#include "tests/bench/hall_mesh.h"
#include "verbs/render/bench/bench.h"

#define WIDTH 1600
#define HEIGHT 1200
#define MAX_REPEATS 99
#define MAX_THREADS 64
#define TASK_RAYS 4096 /* rays per thread and task: a multiple of 16 */

/* Embree's calls that are compared. */
enum call { CALL_1, CALL_4, CALL_8, CALL_16, CALL_1M, N_CALLS };
static const char *const call_names[N_CALLS] = { "1", "4", "8", "16", "1M" };

/* Rays to trace: the camera's, or one of the bench's kinds. */
enum work { WORK_CAMERA, WORK_SHADOW, WORK_AMBIENT, N_WORKS };

struct peer {
	RTCDevice device;
	RTCScene scene;
	const struct bench *bench;
	unsigned threads;
	const char *isa; /* restriction of Embree's vector units, or NULL */
	double build_s;
};

/* One timed pass over all rays of a kind. */
struct pass {
	const struct peer *peer;
	enum work work;
	enum call call;
	size_t n;
	const struct ray *rays; /* NULL: camera rays */
	void *laid_out;         /* occlusion rays in the call's layout */
	struct hit *hits;       /* for camera rays */
	atomic_size_t next, n_hits;
};

/* Direction of camera ray i, in blocks of 4 x 2 pixels like our kernel's. */
static inline void camera_direction(const struct bench *b, size_t i, float d[3])
{
	const size_t block = i / 8, lane = i % 8, columns = b->width / 4;
	const float x = (float)(block % columns * 4 + lane % 4) + 0.5f, y = (float)(block / columns * 2 + lane / 4) + 0.5f;

	d[0] = (2 * x / (float)b->width - 1) * b->view.inverse[0];
	d[1] = (2 * y / (float)b->height - 1) * b->view.inverse[5];
	d[2] = -1;
}

static void camera_1(struct pass *p, struct peer_query *query, size_t first, size_t last)
{
	for (size_t i = first; i < last; i++) {
		struct RTCRayHit r = { .ray = { .tnear = 0.1f, .tfar = 1e30f, .mask = ~0u }, .hit = { .geomID = ~0u } };
		float d[3];

		camera_direction(p->peer->bench, i, d);
		r.ray.dir_x = d[0], r.ray.dir_y = d[1], r.ray.dir_z = d[2];
		r.hit.instID[0] = ~0u;
		peer_intersect(p->peer->scene, query, &r);
		p->hits[i] = (struct hit){ r.ray.tfar, r.hit.u, r.hit.v, r.hit.geomID, r.hit.primID };
	}
}

#define CAMERA_N(N)                                                                                                    \
	static void camera_##N(struct pass *p, struct peer_query *query, size_t first, size_t last)         \
	{                                                                                                              \
		_Alignas(64) int valid[N];                                                                             \
		for (int k = 0; k < N; k++)                                                                            \
			valid[k] = -1;                                                                                 \
		for (size_t i = first; i < last; i += N) {                                                             \
			_Alignas(64) struct RTCRayHit##N r;                                                            \
			for (int k = 0; k < N; k++) {                                                                  \
				float d[3];                                                                            \
				camera_direction(p->peer->bench, i + (size_t)k, d);                                    \
				r.ray.org_x[k] = r.ray.org_y[k] = r.ray.org_z[k] = 0;                                  \
				r.ray.dir_x[k] = d[0], r.ray.dir_y[k] = d[1], r.ray.dir_z[k] = d[2];                   \
				r.ray.tnear[k] = 0.1f, r.ray.tfar[k] = 1e30f, r.ray.time[k] = 0;                       \
				r.ray.mask[k] = ~0u, r.ray.id[k] = r.ray.flags[k] = 0;                                 \
				r.hit.geomID[k] = r.hit.instID[0][k] = ~0u;                                            \
			}                                                                                              \
			PEER_INTERSECT(N, valid, p->peer->scene, query, &r);                                           \
			for (int k = 0; k < N; k++)                                                                    \
				p->hits[i + (size_t)k] = (struct hit){ r.ray.tfar[k], r.hit.u[k], r.hit.v[k],          \
					                               r.hit.geomID[k], r.hit.primID[k] };             \
		}                                                                                                      \
	}
CAMERA_N(4)
CAMERA_N(8)
CAMERA_N(16)

static void camera_1m(struct pass *p, struct peer_query *query, size_t first, size_t last)
{
	struct RTCRayHit r[256];

	for (size_t i = first; i < last; i += 256) {
		const size_t n = last - i < 256 ? last - i : 256;

		for (size_t k = 0; k < n; k++) {
			float d[3];

			camera_direction(p->peer->bench, i + k, d);
			r[k] = (struct RTCRayHit){ .ray = { .tnear = 0.1f, .tfar = 1e30f, .mask = ~0u }, .hit = { .geomID = ~0u } };
			r[k].ray.dir_x = d[0], r[k].ray.dir_y = d[1], r[k].ray.dir_z = d[2];
			r[k].hit.instID[0] = ~0u;
		}
		peer_intersect_stream(p->peer->scene, query, r, (unsigned)n, sizeof(*r));
		for (size_t k = 0; k < n; k++)
			p->hits[i + k] = (struct hit){ r[k].ray.tfar, r[k].hit.u, r[k].hit.v, r[k].hit.geomID, r[k].hit.primID };
	}
}

#define OCCLUDE_N(N)                                                                                                   \
	static size_t occlude_##N(struct pass *p, struct peer_query *query, size_t first, size_t last)      \
	{                                                                                                              \
		struct RTCRay##N *rays = p->laid_out;                                                                  \
		_Alignas(64) int valid[N];                                                                             \
		for (int k = 0; k < N; k++)                                                                            \
			valid[k] = -1;                                                                                 \
		for (size_t i = first; i < last; i += N)                                                               \
			PEER_OCCLUDED(N, valid, p->peer->scene, query, &rays[i / N]);                                  \
		return 0;                                                                                              \
	}                                                                                                              \
	static void lay_out_##N(const struct ray *rays, size_t n, void *out)                                           \
	{                                                                                                              \
		struct RTCRay##N *r = out;                                                                             \
		for (size_t i = 0; i < n; i++) {                                                                       \
			struct RTCRay##N *to = &r[i / N];                                                              \
			const size_t k = i % N;                                                                        \
			to->org_x[k] = rays[i].o[0], to->org_y[k] = rays[i].o[1], to->org_z[k] = rays[i].o[2];         \
			to->dir_x[k] = rays[i].d[0], to->dir_y[k] = rays[i].d[1], to->dir_z[k] = rays[i].d[2];         \
			to->tnear[k] = rays[i].t_min, to->tfar[k] = rays[i].t_max;                                     \
			to->time[k] = 0, to->mask[k] = ~0u, to->id[k] = to->flags[k] = 0;                              \
		}                                                                                                      \
	}                                                                                                              \
	static float far_##N(const void *rays, size_t i)                                                               \
	{                                                                                                              \
		return ((const struct RTCRay##N *)rays)[i / N].tfar[i % N];                                            \
	}
OCCLUDE_N(4)
OCCLUDE_N(8)
OCCLUDE_N(16)

static void occlude_1(struct pass *p, struct peer_query *query, size_t first, size_t last)
{
	struct RTCRay *rays = p->laid_out;

	for (size_t i = first; i < last; i++)
		peer_occluded(p->peer->scene, query, &rays[i]);
}

static void occlude_1m(struct pass *p, struct peer_query *query, size_t first, size_t last)
{
	struct RTCRay *rays = p->laid_out;

	peer_occluded_stream(p->peer->scene, query, &rays[first], (unsigned)(last - first), sizeof(*rays));
}

static void lay_out_1(const struct ray *rays, size_t n, void *out)
{
	struct RTCRay *r = out;

	for (size_t i = 0; i < n; i++)
		r[i] = (struct RTCRay){ .org_x = rays[i].o[0], .org_y = rays[i].o[1], .org_z = rays[i].o[2],
			                .dir_x = rays[i].d[0], .dir_y = rays[i].d[1], .dir_z = rays[i].d[2],
			                .tnear = rays[i].t_min, .tfar = rays[i].t_max, .mask = ~0u };
}

static void lay_out(struct pass *p)
{
	switch (p->call) {
	case CALL_4:
		lay_out_4(p->rays, p->n, p->laid_out);
		break;
	case CALL_8:
		lay_out_8(p->rays, p->n, p->laid_out);
		break;
	case CALL_16:
		lay_out_16(p->rays, p->n, p->laid_out);
		break;
	default:
		lay_out_1(p->rays, p->n, p->laid_out);
	}
}

static float far_of(const struct pass *p, size_t i)
{
	switch (p->call) {
	case CALL_4:
		return far_4(p->laid_out, i);
	case CALL_8:
		return far_8(p->laid_out, i);
	case CALL_16:
		return far_16(p->laid_out, i);
	default:
		return ((const struct RTCRay *)p->laid_out)[i].tfar;
	}
}

static void do_task(struct pass *p, struct peer_query *query, size_t first, size_t last)
{
	const int camera = p->work == WORK_CAMERA;

	switch (p->call) {
	case CALL_1:
		camera ? camera_1(p, query, first, last) : occlude_1(p, query, first, last);
		break;
	case CALL_4:
		camera ? camera_4(p, query, first, last) : (void)occlude_4(p, query, first, last);
		break;
	case CALL_8:
		camera ? camera_8(p, query, first, last) : (void)occlude_8(p, query, first, last);
		break;
	case CALL_16:
		camera ? camera_16(p, query, first, last) : (void)occlude_16(p, query, first, last);
		break;
	default:
		camera ? camera_1m(p, query, first, last) : occlude_1m(p, query, first, last);
	}
}

static void *run_thread(void *arg)
{
	struct pass *p = arg;
	struct peer_query query;

	_MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
	_MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
	peer_query_init(&query, p->work != WORK_AMBIENT);
	for (;;) {
		const size_t first = atomic_fetch_add(&p->next, TASK_RAYS);

		if (first >= p->n)
			return NULL;
		do_task(p, &query, first, first + TASK_RAYS < p->n ? first + TASK_RAYS : p->n);
	}
}

/* A pass' wall time and the processor time of all threads. */
struct took {
	double wall, cpu;
};

static double cpu_clock_s(void)
{
	struct timespec t;

	clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* One pass of Embree. */
static struct took run_peer(struct pass *p)
{
	pthread_t threads[MAX_THREADS];
	unsigned started = 0;
	struct took start;

	if (p->work != WORK_CAMERA)
		lay_out(p);
	p->next = 0;
	start = (struct took){ progress_clock_s(), cpu_clock_s() };
	for (unsigned i = 1; i < p->peer->threads; i++)
		started += pthread_create(&threads[started], NULL, run_thread, p) == 0;
	run_thread(p);
	while (started)
		pthread_join(threads[--started], NULL);
	return (struct took){ progress_clock_s() - start.wall, cpu_clock_s() - start.cpu };
}

static size_t count_peer_hits(const struct pass *p)
{
	size_t hits = 0;

	for (size_t i = 0; i < p->n; i++)
		hits += p->work == WORK_CAMERA ? p->hits[i].instance != ~0u : far_of(p, i) < 0;
	return hits;
}

static int open_peer(const struct bench *b, struct peer *peer)
{
	char config[64];
	RTCGeometry geometry;
	float *vertices;
	unsigned *indices;

	snprintf(config, sizeof(config), "threads=%u%s%s", peer->threads, peer->isa ? ",isa=" : "",
	         peer->isa ? peer->isa : "");
	_MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
	_MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
	peer->bench = b;
	peer->device = rtcNewDevice(config);
	peer->scene = rtcNewScene(peer->device);
	rtcSetSceneBuildQuality(peer->scene, RTC_BUILD_QUALITY_HIGH);
	geometry = rtcNewGeometry(peer->device, RTC_GEOMETRY_TYPE_TRIANGLE);
	rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
	vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
	                                   b->mesh.n_vertices);
	indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned),
	                                  b->mesh.n_triangles);
	if (!vertices || !indices)
		return err_report(ERR_SYSTEM, "Embree", "out of memory");
	for (uint32_t i = 0; i < b->mesh.n_vertices; i++)
		memcpy(vertices + 3 * (size_t)i, b->mesh.position[i], 3 * sizeof(float));
	memcpy(indices, b->mesh.index, b->mesh.n_triangles * sizeof(*b->mesh.index));
	rtcCommitGeometry(geometry);
	rtcAttachGeometry(peer->scene, geometry);
	rtcReleaseGeometry(geometry);
	peer->build_s = progress_clock_s();
	rtcCommitScene(peer->scene);
	peer->build_s = progress_clock_s() - peer->build_s;
	return rtcGetDeviceError(peer->device) ? err_report(ERR_SYSTEM, "Embree", "building failed") : 0;
}

/* Embree's vector units: the given ones, or the widest that it was built for and that this processor has. */
static const char *peer_isa(const char *held)
{
	if (held)
		return held;
	__builtin_cpu_init();
	if (__builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
		return "AVX-512";
	return __builtin_cpu_supports("avx2") ? "AVX2" : __builtin_cpu_supports("avx") ? "AVX" : "SSE";
}

/* One kind of rays, both sides. */
struct result {
	const char *name, *call, *kernel_name;
	double ours, peer; /* Mrays/s */
	double cpu_ratio;  /* ratio of rays per processor second */
	size_t n, our_hits, peer_hits;
};

static const struct {
	const char *name;
	double bar;
	struct {
		const char *name;
		enum kernel kernel;
	} kernels[2];
} works[N_WORKS] = {
	{ "camera", 3, { { "camera_packet", KERNEL_camera_packet }, { NULL, 0 } } },
	{ "shadow", 2.5, { { "occlude_packet", KERNEL_occlude_packet }, { "occlude_wide", KERNEL_occlude_wide } } },
	{ "incoherent", 1.2, { { "occlude_packet", KERNEL_occlude_packet }, { "occlude_wide", KERNEL_occlude_wide } } },
};

static int run_ours(struct bench *b, enum work work, enum kernel kernel, struct took *took)
{
	const double start = cpu_clock_s();
	int err = work == WORK_CAMERA ? bench_camera(b, kernel, &took->wall)
	                              : bench_rays(b, kernel, work == WORK_SHADOW ? BENCH_SHADOW : BENCH_AMBIENT, &took->wall);

	took->cpu = cpu_clock_s() - start;
	return err;
}

/* Medians of both times. */
static struct took medians(const struct took *took, size_t n)
{
	double wall[MAX_REPEATS], cpu[MAX_REPEATS];

	for (size_t i = 0; i < n; i++) {
		wall[i] = took[i].wall;
		cpu[i] = took[i].cpu;
	}
	return (struct took){ bench_median(wall, n), bench_median(cpu, n) };
}

/* Alternate between our kernels and all of Embree's calls; the best median of each side counts. */
static int compare(struct bench *b, struct peer *peer, enum work work, size_t repeats, struct result *r)
{
	struct took ours[2][MAX_REPEATS], theirs[N_CALLS][MAX_REPEATS], took;
	double rate, our_cpu = 0, peer_cpu = 0;
	struct pass pass = { .peer = peer, .work = work };
	uint32_t hits = 0;
	int err = 0;

	pass.n = work == WORK_CAMERA ? (size_t)WIDTH * HEIGHT : b->n_rays[work == WORK_SHADOW ? BENCH_SHADOW : BENCH_AMBIENT];
	/* Whole packets of 16, so that no call has a remainder. */
	pass.n -= pass.n % 16;
	pass.rays = work == WORK_CAMERA ? NULL : b->rays[work == WORK_SHADOW ? BENCH_SHADOW : BENCH_AMBIENT];
	pass.hits = calloc(pass.n, sizeof(*pass.hits));
	pass.laid_out = aligned_alloc(64, (pass.n * sizeof(struct RTCRay) + 64) / 64 * 64);
	if (!pass.hits || !pass.laid_out) {
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
		goto done;
	}
	r->name = works[work].name;
	r->n = pass.n;
	for (size_t i = 0; i <= repeats && !err; i++) {
		const size_t slot = i ? i - 1 : 0; /* the first round is a warm-up */

		for (int k = 0; k < 2 && works[work].kernels[k].name && !err; k++)
			err = run_ours(b, work, works[work].kernels[k].kernel, &ours[k][slot]);
		for (int c = 0; c < N_CALLS && !err; c++) {
			pass.call = (enum call)c;
			theirs[c][slot] = run_peer(&pass);
		}
	}
	for (int k = 0; k < 2 && works[work].kernels[k].name && !err; k++) {
		const uint32_t n = work == WORK_CAMERA ? (uint32_t)pass.n :
		                                         b->n_rays[work == WORK_SHADOW ? BENCH_SHADOW : BENCH_AMBIENT];

		took = medians(ours[k], repeats);
		rate = n / took.wall * 1e-6;
		our_cpu = fmax(our_cpu, n / took.cpu);
		if (rate > r->ours) {
			r->ours = rate;
			r->kernel_name = works[work].kernels[k].name;
		}
	}
	for (int c = 0; c < N_CALLS && !err; c++) {
		took = medians(theirs[c], repeats);
		rate = (double)pass.n / took.wall * 1e-6;
		peer_cpu = fmax(peer_cpu, (double)pass.n / took.cpu);
		if (rate > r->peer) {
			r->peer = rate;
			r->call = call_names[c];
		}
	}
	r->cpu_ratio = our_cpu / peer_cpu;
	r->peer_hits = count_peer_hits(&pass);
	if (!err)
		err = work == WORK_CAMERA ?
		              bench_count_camera_hits(b, &hits) :
		              bench_count_ray_hits(b, KERNEL_occlude_wide,
		                                   work == WORK_SHADOW ? BENCH_SHADOW : BENCH_AMBIENT, &hits);
	r->our_hits = hits;
done:
	free(pass.hits);
	free(pass.laid_out);
	return err;
}

#define N_SCENES 2

/* Figures of one scene. */
struct scene_results {
	struct result works[N_WORKS];
	uint32_t n_triangles;
	char source[64];
};

/* The least ratio of a figure to its bar. */
static double least_share(const struct scene_results *scenes)
{
	double least = INFINITY;

	for (int s = 0; s < N_SCENES; s++)
		for (int i = 0; i < N_WORKS; i++)
			least = fmin(least, scenes[s].works[i].ours / scenes[s].works[i].peer / works[i].bar);
	return least;
}

/* One object: the least share of a bar, a row for each scene and kind of rays (tests/show/table.py), and all
 * figures. */
static int write_json(const char *path, const struct device *dev, const struct peer *peer,
                      const struct scene_results *scenes, int bars, const char *command)
{
	const char *isa = peer_isa(peer->isa);
	FILE *out = fopen(path, "w");

	if (!out)
		return err_report(ERR_SYSTEM, path, "cannot be written");
	fprintf(out, "{\n  \"name\": \"rays\",\n  \"command\": \"%s\",\n  \"figure\": %.3f,\n  \"bar\": %s,\n", command,
	        least_share(scenes), bars ? "1" : "null");
	fprintf(out, "  \"unit\": \"of its bar, the kind of rays that is farthest from it\",\n");
	fprintf(out, "  \"peer\": \"Embree\",\n  \"peer_version\": \"%s, %s\",\n", RTC_VERSION_STRING, isa);
	fprintf(out, "  \"device\": \"%s\",\n  \"threads\": %u,\n  \"rows\": [\n", device_name(dev), peer->threads);
	for (int s = 0; s < N_SCENES; s++)
		for (int i = 0; i < N_WORKS; i++) {
			const struct result *r = &scenes[s].works[i];

			fprintf(out, "    { \"what\": \"%s rays, %u triangles (%s)\", \"figure\": \"%.2f times\", ", r->name,
			        scenes[s].n_triangles, scenes[s].source, r->ours / r->peer);
			if (bars)
				fprintf(out, "\"bar\": \"%.2f times\", \"passed\": %s, ", works[i].bar,
				        r->ours >= works[i].bar * r->peer ? "true" : "false");
			else
				fprintf(out, "\"bar\": null, \"passed\": null, ");
			fprintf(out, "\"peer\": \"Embree %s %s, rtc*%s\",\n", RTC_VERSION_STRING, isa, r->call);
			fprintf(out, "      \"n\": %zu, \"ours_mrays_per_s\": %.2f, \"kernel\": \"%s\", \"peer_mrays_per_s\": %.2f, "
			             "\"ratio\": %.3f, \"ratio_by_processor_time\": %.3f, \"our_hits\": %zu, \"peer_hits\": %zu }%s\n",
			        r->n, r->ours, r->kernel_name, r->peer, r->ours / r->peer, r->cpu_ratio, r->our_hits, r->peer_hits,
			        s + 1 < N_SCENES || i + 1 < N_WORKS ? "," : "");
		}
	fprintf(out, "  ]\n}\n");
	return fclose(out) ? err_report(ERR_SYSTEM, path, "cannot be written") : 0;
}

static int run_scene(struct device *dev, const char *models, int hall, struct peer peer, size_t repeats, int bars,
                     struct scene_results *out)
{
	struct bench_mesh mesh;
	struct bench *b = NULL;
	int err = hall ? hall_mesh_create(&mesh) : bench_mesh_create(models, &mesh);

	if (!err)
		err = bench_create_of(dev, &mesh, WIDTH, HEIGHT, &b);
	if (!err)
		err = open_peer(b, &peer);
	for (int i = 0; i < N_WORKS && !err; i++)
		err = compare(b, &peer, (enum work)i, repeats, &out->works[i]);
	if (!err) {
		out->n_triangles = b->mesh.n_triangles;
		memcpy(out->source, b->mesh.source, sizeof(out->source));
		printf("%u triangles (%s)\n", out->n_triangles, out->source);
	}
	for (int i = 0; i < N_WORKS && !err; i++) {
		const struct result *r = &out->works[i];

		printf("  %-11s %7.2f Mrays/s (%s)  Embree %7.2f (rtc*%s)  ratio %.2f (by processor time %.2f)%s\n", r->name, r->ours,
		       r->kernel_name, r->peer, r->call, r->ours / r->peer, r->cpu_ratio,
		       !bars ? "" : r->ours >= works[i].bar * r->peer ? "  reaches the bar" : "  BELOW THE BAR");
	}
	if (peer.scene)
		rtcReleaseScene(peer.scene);
	if (peer.device)
		rtcReleaseDevice(peer.device);
	bench_destroy(&b);
	return err;
}

int main(int argc, char **argv)
{
	struct scene_results scenes[N_SCENES] = { 0 };
	const char *json = NULL, *models = "../shared/models", *command = "embree";
	struct device *dev = NULL;
	size_t repeats = 5;
	int bars = 0, err;
	long cores = sysconf(_SC_NPROCESSORS_ONLN);
	struct peer peer = { .threads = cores < 1 ? 1 : cores > MAX_THREADS ? MAX_THREADS : (unsigned)cores };

	for (int i = 1; i + 1 < argc; i += 2) {
		if (strcmp(argv[i], "--json") == 0)
			json = argv[i + 1];
		else if (strcmp(argv[i], "--models") == 0)
			models = argv[i + 1];
		else if (strcmp(argv[i], "--bars") == 0)
			bars = atoi(argv[i + 1]);
		else if (strcmp(argv[i], "--command") == 0)
			command = argv[i + 1];
		else if (strcmp(argv[i], "--isa") == 0)
			peer.isa = argv[i + 1];
		else if (strcmp(argv[i], "--repeat") == 0)
			repeats = strtoul(argv[i + 1], NULL, 10);
		else
			return -err_report(ERR_USAGE, NULL, "no option %s", argv[i]);
	}
	if (repeats < 1 || repeats > MAX_REPEATS)
		return -err_report(ERR_USAGE, NULL, "--repeat takes 1 to %d", MAX_REPEATS);
	err = device_open(NULL, 0, &dev);
	if (!err)
		printf("%ux%u, median of %zu\nours: %s\npeer: Embree %s on %s, %u threads\n", WIDTH, HEIGHT, repeats,
		       device_name(dev), RTC_VERSION_STRING, peer_isa(peer.isa), peer.threads);
	for (int s = 0; s < N_SCENES && !err; s++)
		err = run_scene(dev, models, s, peer, repeats, bars, &scenes[s]);
	if (!err && bars)
		printf("bars: camera %.1f, shadow %.1f, incoherent %.1f\n", works[0].bar, works[1].bar, works[2].bar);
	if (!err && json)
		err = write_json(json, dev, &peer, scenes, bars, command);
	if (!err && bars && least_share(scenes) < 1)
		err = ERR_FAILED;
	device_close(&dev);
	return -err;
}
