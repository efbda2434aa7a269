#include "verbs/render/bench/bench_accel.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/err.h"
#include "tracer/frame/common/traverse.h"

enum { BUILD_S, BUILD_CPU_S, CAMERA_S, SHADOW_S, INCOHERENT_S, N_TIMES };

/* Measurements of one kind; times are [n] each. */
struct row {
	double *times[N_TIMES];
	struct bench_tree tree;
};

/* Build one kind and send all rays through it. */
static int measure(struct bench *b, enum accel_kind kind, size_t slot, struct row *row)
{
	const struct traverse_family *kernels = &traverse_families[device_family(b->dev)];
	double first;
	int err;

	if ((err = bench_rebuild(b, kind, &row->tree)) ||
	    /* The first camera rays wait for the tree to be on the device. */
	    (err = bench_camera(b, kernels->camera, &first)) ||
	    (err = bench_camera(b, kernels->camera, &row->times[CAMERA_S][slot])) ||
	    (err = bench_rays(b, kernels->occlude, BENCH_SHADOW, &row->times[SHADOW_S][slot])))
		return err;
	row->times[BUILD_S][slot] = row->tree.build_s;
	row->times[BUILD_CPU_S][slot] = row->tree.build_cpu_s;
	return bench_rays(b, kernels->intersect, BENCH_AMBIENT, &row->times[INCOHERENT_S][slot]);
}

static void print_row(const struct bench *b, enum accel_kind kind, size_t n, struct row *row, int json, int last)
{
	const double rays[N_TIMES] = { 0, 0, (double)b->width * b->height, b->n_rays[BENCH_SHADOW], b->n_rays[BENCH_AMBIENT] };
	const double build_s = bench_median(row->times[BUILD_S], n), cpu_s = bench_median(row->times[BUILD_CPU_S], n);
	const double share = (double)row->tree.n_items / b->mesh.n_triangles;
	double mrays[N_TIMES];

	for (int k = CAMERA_S; k < N_TIMES; k++)
		mrays[k] = rays[k] / bench_median(row->times[k], n) * 1e-6;
	if (json)
		printf("  {\"accel\": \"%s\", \"build_s\": %.5f, \"build_cpu_s\": %.5f, \"sah_cost\": %.3f, "
		       "\"items_per_triangle\": %.3f, \"bytes\": %zu, "
		       "\"camera_mrays_per_s\": %.3f, \"shadow_mrays_per_s\": %.3f, \"incoherent_mrays_per_s\": "
		       "%.3f}%s\n",
		       accel_kind_names[kind], build_s, cpu_s, row->tree.cost, share, row->tree.bytes, mrays[CAMERA_S],
		       mrays[SHADOW_S], mrays[INCOHERENT_S], last ? "" : ",");
	else
		printf("%-6s %9.1f ms %9.1f ms %9.2f %9.2f %7.1f MB %9.2f %9.2f %11.2f\n", accel_kind_names[kind],
		       1e3 * build_s, 1e3 * cpu_s, row->tree.cost, share, (double)row->tree.bytes * 1e-6,
		       mrays[CAMERA_S], mrays[SHADOW_S], mrays[INCOHERENT_S]);
}

static void print_all(const struct bench *b, unsigned kinds, size_t n, struct row *rows, int json)
{
	if (json)
		printf("{\"device\": \"%s\", \"triangles\": %u, \"models\": \"%s\", \"runs\": %zu, \"trees\": [\n",
		       device_name(b->dev), b->mesh.n_triangles, b->mesh.source, n);
	else
		printf("%s\n%u triangles (%s); %ux%u; millions of rays a second, medians of %zu runs in turn\n"
		       "tree        build    processors  SAH cost     items     memory    camera    shadow  incoherent\n",
		       device_name(b->dev), b->mesh.n_triangles, b->mesh.source, b->width, b->height, n);
	for (int kind = 0; kind < N_ACCEL_KINDS; kind++)
		if (kinds >> kind & 1)
			print_row(b, (enum accel_kind)kind, n, &rows[kind], json, !(kinds >> kind >> 1));
	if (json)
		puts("]}");
}

int bench_accel(struct bench *b, unsigned kinds, size_t n, int json)
{
	double *times = calloc(N_ACCEL_KINDS * N_TIMES * (n + 1), sizeof(*times));
	struct row rows[N_ACCEL_KINDS] = { { .times = { NULL } } };
	int err = times ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");

	/* One run more, the first, which compiles the kernels: the next one goes over its times. */
	for (size_t i = 0; i <= n && !err; i++)
		for (int kind = 0; kind < N_ACCEL_KINDS && !err; kind++) {
			if (!(kinds >> kind & 1))
				continue;
			for (int t = 0; t < N_TIMES; t++)
				rows[kind].times[t] = times + ((size_t)kind * N_TIMES + (size_t)t) * (n + 1);
			err = measure(b, (enum accel_kind)kind, i ? i - 1 : 0, &rows[kind]);
		}
	if (!err)
		print_all(b, kinds, n, rows, json);
	free(times);
	return err;
}
