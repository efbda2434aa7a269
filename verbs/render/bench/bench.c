/* relume bench: how fast the traversal kernels run here. */
#include "verbs/render/bench/bench.h"

#include <stdio.h>
#include <string.h>

#include "base/err.h"
#include "base/folder.h"
#include "base/options.h"
#include "base/verbs.h"
#include "look/rules/rules.h"
#include "tracer/accel/builders.h"
#include "verbs/render/bench/bench_accel.h"
#include "verbs/render/bench/bench_frame.h"
#include "verbs/render/settings.h"

#define MAX_REPEATS 99
#define ACCEL_WORD(kind, name, ...) name ", "

struct options {
	const char *device, *models, *trace;
	uint64_t frame;
	enum tracer_mode mode;
	unsigned threads, repeats, kinds; /* kinds: bit 1 << enum accel_kind; 0: what is not asked for */
	int json, family;                 /* enum device_family; -1: what suits the device */
	struct look *look;                /* owned */
};

struct figure {
	const char *rays, *kernel_name;
	enum kernel kernel;
	int kind; /* -1: camera */
	double mrays;
};

static int take_kinds(const struct options_row *row, const char *list, void *out)
{
	unsigned *kinds = out;

	(void)row;
	*kinds = 0;
	if (strcmp(list, "all") == 0) {
		*kinds = (1u << N_ACCEL_KINDS) - 1;
		return 0;
	}
	do {
		const size_t n = strcspn(list, ",");
		int kind = 0;

		while (kind < N_ACCEL_KINDS && (strlen(accel_kind_names[kind]) != n || strncmp(accel_kind_names[kind], list, n) != 0))
			kind++;
		if (kind == N_ACCEL_KINDS)
			return err_report(ERR_USAGE, NULL,
			                  "--accel takes " TREE_BUILDERS(ACCEL_WORD) "with commas, or all, not '%.*s'",
			                  (int)n, list);
		*kinds |= 1u << kind;
		list += n + (list[n] == ',');
	} while (*list);
	return 0;
}

static int take_look(const struct options_row *row, const char *file, void *out)
{
	struct look **look = out;

	(void)row;
	rules_free(look);
	return rules_load(file, look);
}

static const struct options_row rows[] = {
	{ "device", 0, "NAME", "number or part of the name of an OpenCL device, or 'reference'", options_text,
	  .at = offsetof(struct options, device) },
	{ "kernels", 0, "FAMILY", "with a recording: packets, binary or compressed, as for relume render", options_word,
	  .at = offsetof(struct options, family), .words = device_family_names },
	{ "threads", 0, "N", "compute threads on a CPU", options_number, .at = offsetof(struct options, threads),
	  .most = 1024 },
	{ "models", 0, "DIR",
	  "folder with stanford-bunny.obj, cow.obj, spot.obj, teapot.obj (default: ../shared/models; bumpy spheres "
	  "replace missing files)",
	  options_text, .at = offsetof(struct options, models), .use = CONFINE_READS },
	{ "accel", 0, "LIST", "kinds of trees to compare: " TREE_BUILDERS(ACCEL_WORD) "with commas, or all",
	  take_kinds, .at = offsetof(struct options, kinds) },
	{ "repeat", 0, "N", "runs of each (default 5)", options_number, .at = offsetof(struct options, repeats),
	  .most = MAX_REPEATS },
	{ "frame", 'f', "N", "which frame of the recording (default 0)", options_frame,
	  .at = offsetof(struct options, frame) },
	{ "mode", 0, "MODE", "as for relume render (default whitted)", options_word,
	  .at = offsetof(struct options, mode), .words = settings_mode_names },
	{ "look", 0, "FILE", "with a recording: rules for its surfaces and lights, as for relume render", take_look,
	  .at = offsetof(struct options, look), .use = CONFINE_READS },
	{ "json", 0, NULL, "as JSON", options_flag, .at = offsetof(struct options, json) },
	{ OPTIONS_NO_SANDBOX },
};

static const struct options_table table = {
	.verb = "bench",
	.head = "usage: relume bench [OPTIONS] [TRACE]\n"
		"\n"
		"With a recording: render one of its frames several times and print what each kernel took, the means "
	        "of all runs\n"
		"but the first. Without: trace a scene of about 250,000 triangles and print millions of rays a second, "
	        "the median\n"
		"of several runs, for camera rays (with all that a frame with a new camera costs), shadow rays to one "
	        "point light,\n"
		"and short incoherent rays; with --accel, the same for trees of several kinds, and what these cost.\n",
	OPTIONS_ROWS(rows),
	.takes = "one recording or none",
	.most = 1,
	.words_use = CONFINE_RECORDING,
};

static int parse(int argc, char **argv, struct options *o)
{
	struct options_line line;
	int err = options_parse(&table, argc, argv, o, &line);

	if (err)
		return err;
	o->trace = line.n_words ? line.words[0] : NULL;
	if (!o->repeats)
		return err_report(ERR_USAGE, NULL, "--repeat takes 1 to %d", MAX_REPEATS);
	if (o->trace && o->kinds)
		return err_report(ERR_USAGE, NULL, "--accel measures a scene of its own, no recording");
	return options_confine(&table, &line, CONFINE_TRACER, NULL);
}

static int measure(struct bench *b, struct figure *f, size_t repeats)
{
	const double n = f->kind < 0 ? (double)b->width * b->height : b->n_rays[f->kind];
	double seconds[MAX_REPEATS];
	int err = 0;

	/* One run more, the first, which compiles the kernel. */
	for (size_t i = 0; i <= repeats && !err; i++) {
		double *out = &seconds[i ? i - 1 : 0];

		err = f->kind < 0 ? bench_camera(b, f->kernel, out) : bench_rays(b, f->kernel, (enum bench_ray_kind)f->kind, out);
	}
	f->mrays = err ? 0 : n / bench_median(seconds, repeats) * 1e-6;
	return err;
}

/* Kernels in vectors of eight and more, which compilers for GPUs take minutes for. */
static int is_in_vectors(enum kernel kernel)
{
	return kernel == KERNEL_camera_packet || kernel == KERNEL_occlude_packet || kernel == KERNEL_occlude_wide ||
	       kernel == KERNEL_intersect_packet || kernel == KERNEL_intersect_wide;
}

#define FIGURE(rays, kernel, kind) { rays, #kernel, KERNEL_##kernel, kind, 0 }

/* All kernels on the scene of our own; those in vectors on CPUs alone. */
static int measure_all(struct bench *b, size_t repeats, int json)
{
	struct figure figures[] = {
		FIGURE("camera", camera_packet, -1),
		FIGURE("camera", camera_wide, -1),
		FIGURE("camera", camera_compressed, -1),
		FIGURE("shadow", occlude_packet, BENCH_SHADOW),
		FIGURE("shadow", occlude_wide, BENCH_SHADOW),
		FIGURE("shadow", occlude_binary, BENCH_SHADOW),
		FIGURE("shadow", occlude_compressed, BENCH_SHADOW),
		FIGURE("shadow, nearest hit", intersect_packet, BENCH_SHADOW),
		FIGURE("shadow, nearest hit", intersect_wide, BENCH_SHADOW),
		FIGURE("shadow, nearest hit", intersect_binary, BENCH_SHADOW),
		FIGURE("shadow, nearest hit", intersect_compressed, BENCH_SHADOW),
		FIGURE("incoherent", occlude_packet, BENCH_AMBIENT),
		FIGURE("incoherent", occlude_wide, BENCH_AMBIENT),
		FIGURE("incoherent", occlude_binary, BENCH_AMBIENT),
		FIGURE("incoherent", occlude_compressed, BENCH_AMBIENT),
		FIGURE("incoherent, nearest hit", intersect_packet, BENCH_AMBIENT),
		FIGURE("incoherent, nearest hit", intersect_wide, BENCH_AMBIENT),
		FIGURE("incoherent, nearest hit", intersect_binary, BENCH_AMBIENT),
		FIGURE("incoherent, nearest hit", intersect_compressed, BENCH_AMBIENT),
	};
	const struct device_description *device = device_describe(b->dev);
	size_t n = 0;
	int err = 0;

	for (size_t i = 0; i < sizeof(figures) / sizeof(figures[0]); i++)
		if (!device || device->type == DEVICE_CPU || !is_in_vectors(figures[i].kernel))
			figures[n++] = figures[i];
	for (size_t i = 0; i < n && !err; i++)
		err = measure(b, &figures[i], repeats);
	if (err)
		return err;
	printf(json ? "{\"device\": \"%s\", \"triangles\": %u, \"models\": \"%s\", \"build_s\": %.4f, \"figures\": "
	              "[\n" :
	              "%s\n%u triangles (%s), built in %.3f s; ",
	       device_name(b->dev), b->mesh.n_triangles, b->mesh.source, b->build_s);
	if (!json)
		printf("%ux%u\n", b->width, b->height);
	for (size_t i = 0; i < n; i++)
		if (json)
			printf("  {\"rays\": \"%s\", \"kernel\": \"%s\", \"mrays_per_s\": %.2f}%s\n", figures[i].rays,
			       figures[i].kernel_name, figures[i].mrays, i + 1 < n ? "," : "");
		else
			printf("%-24s %-20s %8.2f Mrays/s\n", figures[i].rays, figures[i].kernel_name, figures[i].mrays);
	if (json)
		puts("]}");
	return 0;
}

int bench_main(int argc, char **argv)
{
	struct options o = { .models = "../shared/models", .repeats = 5, .family = -1 };
	struct device *dev = NULL;
	struct bench *b = NULL;
	char folder[4096];
	int err = parse(argc, argv, &o);

	if (err) {
		rules_free(&o.look);
		return err > 0 ? 0 : -err;
	}
	err = device_open(o.device, o.threads, &dev);
	if (!err && o.family >= 0)
		device_choose_family(dev, (enum device_family)o.family);
	if (!err && folder_cached("kernels", folder, sizeof(folder)))
		device_keep_programs(dev, folder, 0);
	if (!err && !o.trace)
		err = bench_create(dev, o.models, 1600, 1200, &b);
	if (!err && o.trace)
		err = bench_frame(dev, &(struct bench_frame){ o.trace, o.frame, o.look, o.mode, o.repeats, o.json });
	else if (!err && o.kinds)
		err = bench_accel(b, o.kinds, o.repeats, o.json);
	else if (!err)
		err = measure_all(b, o.repeats, o.json);
	if (err == ERR_MEMORY)
		err = device_report_lack(dev);
	bench_destroy(&b);
	device_close(&dev);
	rules_free(&o.look);
	return -err;
}
