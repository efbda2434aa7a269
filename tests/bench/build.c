/*
 * Our builders of acceleration structures against Embree's on the same triangles, in one alternating run. A separate
 * program: the command never links Embree.
 *
 * usage: build [--json FILE] [--models DIR] [--repeat N] [--command TEXT] [--bars 0|1]
 *
 * Both sides build binary trees over the same boxes, with leaves of at most four triangles and the same costs of nodes
 * and triangles, on all processors; bvh_cost measures both trees. The time of a scene for Embree's own traversal is
 * printed as well. Figures are medians; times are wall times, with processor time beside them. Exit code 0 if the bars
 * hold, 1 if not.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/err.h"
#include "base/progress.h"
#include "tests/bench/embree_build.h"
#include "tests/bench/hall_mesh.h"
#include "tracer/accel/builders.h"
#include "tracer/accel/bvh.h"

#define LEAF_MAX 4
#define MAX_REPEATS 99
#define N_SCENES 2

/* A comparison: one of our builders and the corresponding quality of Embree's. */
static const struct contest {
	const char *name, *quality_name;
	enum RTCBuildQuality quality;
	double time_bar, cost_bar; /* maximum ratios to the peer */
} contests[] = {
	{ "binned SAH", "medium", RTC_BUILD_QUALITY_MEDIUM, 0.5, 1.05 },
	{ "SBVH", "high", RTC_BUILD_QUALITY_HIGH, 1.0, 1.0 },
};
#define N_CONTESTS (int)(sizeof(contests) / sizeof(contests[0]))

struct side {
	double wall_s[MAX_REPEATS], cpu_s[MAX_REPEATS];
	double wall, cpu; /* medians */
	double cost;
};

struct result {
	const char *scene;
	uint32_t triangles;
	struct side ours, peer, peer_scene;
};

/* The triangles in our builders' format, and memory for the results. */
struct input {
	struct bench_mesh mesh;
	struct bvh_box *boxes;
	struct triangle *triangles;
	struct node2 *nodes;
	uint32_t *order, n_nodes;
};

static double processor_s(void)
{
	struct timespec t;

	clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int make_input(int scene, const char *models, struct input *in)
{
	int err = scene ? hall_mesh_create(&in->mesh) : bench_mesh_create(models, &in->mesh);

	if (err)
		return err;
	in->boxes = malloc(in->mesh.n_triangles * sizeof(*in->boxes));
	in->triangles = malloc(in->mesh.n_triangles * sizeof(*in->triangles));
	in->nodes = malloc(2 * in->mesh.n_triangles * sizeof(*in->nodes));
	in->order = malloc(2 * in->mesh.n_triangles * sizeof(*in->order));
	if (!in->boxes || !in->triangles || !in->nodes || !in->order)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t i = 0; i < in->mesh.n_triangles; i++) {
		bvh_box_clear(&in->boxes[i]);
		for (int k = 0; k < 3; k++) {
			struct bvh_box corner;

			memcpy(corner.lo, in->mesh.position[in->mesh.index[i][k]], sizeof(corner.lo));
			memcpy(corner.hi, corner.lo, sizeof(corner.hi));
			bvh_box_join(&in->boxes[i], &corner);
		}
		for (int a = 0; a < 3; a++) {
			const float v0 = in->mesh.position[in->mesh.index[i][0]][a];

			in->triangles[i].v0[a] = v0;
			in->triangles[i].e1[a] = in->mesh.position[in->mesh.index[i][1]][a] - v0;
			in->triangles[i].e2[a] = in->mesh.position[in->mesh.index[i][2]][a] - v0;
		}
	}
	return 0;
}

static void free_input(struct input *in)
{
	bench_mesh_free(&in->mesh);
	free(in->boxes);
	free(in->triangles);
	free(in->nodes);
	free(in->order);
}

static int run_ours(struct input *in, const struct contest *c, struct side *side, size_t slot)
{
	const double wall = progress_clock_s(), cpu = processor_s();
	const uint32_t n = in->mesh.n_triangles;
	const struct bvh_input input = { in->boxes, in->triangles, n, LEAF_MAX, n + n / 4, 0 };
	struct tree tree = { .nodes = in->nodes, .order = in->order };
	int err = (c->quality == RTC_BUILD_QUALITY_HIGH ? bvh_build_sbvh : bvh_build_sah)(&input, &tree);

	in->n_nodes = tree.n_nodes;
	side->wall_s[slot] = progress_clock_s() - wall;
	side->cpu_s[slot] = processor_s() - cpu;
	return err;
}

/* seconds: as reported by the peer, without preparation. */
static int run_peer(struct embree_build *peer, const struct contest *c, int scene, struct side *side, size_t slot)
{
	const double cpu = processor_s();
	int err = scene ? embree_build_scene(peer, c->quality, &side->wall_s[slot])
	                : embree_build_tree(peer, c->quality, LEAF_MAX, NULL, NULL, &side->wall_s[slot]);

	side->cpu_s[slot] = processor_s() - cpu;
	return err;
}

static int peer_cost(struct embree_build *peer, const struct contest *c, double *cost)
{
	struct node2 *nodes = NULL;
	uint32_t n_nodes;
	double seconds;
	int err = embree_build_tree(peer, c->quality, LEAF_MAX, &nodes, &n_nodes, &seconds);

	if (!err)
		*cost = bvh_cost(nodes, n_nodes);
	free(nodes);
	return err;
}

static int compare(struct input *in, struct embree_build *peer, const struct contest *c, size_t repeats,
                   struct result *r)
{
	int err = 0;

	r->scene = in->mesh.source;
	r->triangles = in->mesh.n_triangles;
	for (size_t i = 0; i <= repeats && !err; i++) {
		const size_t slot = i ? i - 1 : 0; /* the first round is a warm-up */

		err = run_ours(in, c, &r->ours, slot);
		if (!err)
			err = run_peer(peer, c, 0, &r->peer, slot);
		if (!err)
			err = run_peer(peer, c, 1, &r->peer_scene, slot);
	}
	if (!err)
		err = peer_cost(peer, c, &r->peer.cost);
	r->ours.cost = bvh_cost(in->nodes, in->n_nodes);
	for (struct side *side = &r->ours; side <= &r->peer_scene; side++) {
		side->wall = bench_median(side->wall_s, repeats);
		side->cpu = bench_median(side->cpu_s, repeats);
	}
	return err;
}

static int holds(const struct contest *c, const struct result *r)
{
	return r->ours.wall <= c->time_bar * r->peer.wall && r->ours.cost <= c->cost_bar * r->peer.cost;
}

static void print(const struct contest *c, const struct result *r)
{
	printf("%s, %s, %u triangles\n", c->name, r->scene, r->triangles);
	printf("  time %7.1f ms (processors %7.1f)  Embree %s %7.1f ms (%7.1f)  ratio %.2f (processors %.2f), bar %.2f\n",
	       1e3 * r->ours.wall, 1e3 * r->ours.cpu, c->quality_name, 1e3 * r->peer.wall, 1e3 * r->peer.cpu,
	       r->ours.wall / r->peer.wall, r->ours.cpu / r->peer.cpu, c->time_bar);
	printf("  cost %7.3f  Embree %7.3f  ratio %.4f, bar %.2f%s\n", r->ours.cost, r->peer.cost, r->ours.cost / r->peer.cost,
	       c->cost_bar, holds(c, r) ? "" : "  A BAR DOES NOT HOLD");
	printf("  Embree's own scene, ready to trace: %.1f ms (%.1f)\n", 1e3 * r->peer_scene.wall, 1e3 * r->peer_scene.cpu);
}

static void write_row(FILE *out, const struct contest *c, const struct result *r, int time, int last)
{
	const double ours = time ? r->ours.wall : r->ours.cost, peer = time ? r->peer.wall : r->peer.cost;
	const double bar = time ? c->time_bar : c->cost_bar;

	fprintf(out, "    { \"what\": \"%s, %s: %s\", \"figure\": \"%.3f times\", \"bar\": \"%.2f times\", \"passed\": %s,\n",
	        c->name, r->scene, time ? "build time" : "SAH cost", ours / peer, bar, ours <= bar * peer ? "true" : "false");
	fprintf(out,
	        "      \"peer\": \"Embree %s, rtcBuildBVH, %s quality\", \"triangles\": %u, \"ours\": %.6g, "
	        "\"theirs\": %.6g, ",
	        RTC_VERSION_STRING, c->quality_name, r->triangles, ours, peer);
	fprintf(out, "\"ours_processor_s\": %.6g, \"theirs_processor_s\": %.6g, \"their_scene_s\": %.6g }%s\n",
	        r->ours.cpu, r->peer.cpu, r->peer_scene.wall, last ? "" : ",");
}

/* The format of tests/show/table.py; the figure is the worst time ratio of the first contest. */
static int write_json(const char *path, struct result results[N_CONTESTS][N_SCENES], const char *command)
{
	FILE *out = fopen(path, "w");
	double worst = 0;

	if (!out)
		return err_report(ERR_SYSTEM, path, "cannot be written");
	for (int s = 0; s < N_SCENES; s++)
		worst = results[0][s].ours.wall / results[0][s].peer.wall > worst ?
		                results[0][s].ours.wall / results[0][s].peer.wall :
		                worst;
	fprintf(out, "{\n  \"name\": \"build\",\n  \"command\": \"%s\",\n  \"figure\": %.3f,\n  \"bar\": %.2f,\n",
	        command, worst, contests[0].time_bar);
	fprintf(out,
	        "  \"unit\": \"times the peer's build time, binned\",\n  \"peer\": \"Embree\",\n  \"peer_version\": "
	        "\"%s\",\n",
	        RTC_VERSION_STRING);
	fprintf(out, "  \"rows\": [\n");
	for (int c = 0; c < N_CONTESTS; c++)
		for (int s = 0; s < N_SCENES; s++)
			for (int time = 1; time >= 0; time--)
				write_row(out, &contests[c], &results[c][s], time, c + 1 == N_CONTESTS && s + 1 == N_SCENES && !time);
	fprintf(out, "  ]\n}\n");
	return fclose(out) ? err_report(ERR_SYSTEM, path, "cannot be written") : 0;
}

int main(int argc, char **argv)
{
	static struct result results[N_CONTESTS][N_SCENES];
	const char *json = NULL, *models = "../shared/models", *command = "build";
	const long cores = sysconf(_SC_NPROCESSORS_ONLN);
	size_t repeats = 5;
	int err = 0, bars = 0, failed = 0;

	for (int i = 1; i + 1 < argc; i += 2) {
		if (strcmp(argv[i], "--json") == 0)
			json = argv[i + 1];
		else if (strcmp(argv[i], "--models") == 0)
			models = argv[i + 1];
		else if (strcmp(argv[i], "--command") == 0)
			command = argv[i + 1];
		else if (strcmp(argv[i], "--bars") == 0)
			bars = atoi(argv[i + 1]);
		else if (strcmp(argv[i], "--repeat") == 0)
			repeats = strtoul(argv[i + 1], NULL, 10);
		else
			return -err_report(ERR_USAGE, NULL, "no option %s", argv[i]);
	}
	if (repeats < 1 || repeats > MAX_REPEATS)
		return -err_report(ERR_USAGE, NULL, "--repeat takes 1 to %d", MAX_REPEATS);
	for (int s = 0; s < N_SCENES && !err; s++) {
		struct embree_build *peer = NULL;
		struct input in = { .boxes = NULL };

		err = make_input(s, models, &in);
		if (!err)
			err = embree_build_create(&in.mesh, cores < 1 ? 1 : (unsigned)cores, &peer);
		for (int c = 0; c < N_CONTESTS && !err; c++) {
			err = compare(&in, peer, &contests[c], repeats, &results[c][s]);
			if (err)
				break;
			results[c][s].scene = s ? "hall" : "meshes";
			print(&contests[c], &results[c][s]);
			failed |= !holds(&contests[c], &results[c][s]);
		}
		embree_build_destroy(&peer);
		free_input(&in);
	}
	if (!err && json)
		err = write_json(json, results, command);
	return err ? -err : bars && failed ? -ERR_FAILED : 0;
}
