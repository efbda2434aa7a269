/* relume bench: how fast the traversal kernels run here. */
#include "tracer/bench/bench.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/verbs.h"
#include "tracer/accel/builders.h"
#include "tracer/bench/bench_accel.h"
#include "tracer/bench/bench_frame.h"
#include "tracer/render/settings.h"

#define MAX_REPEATS 99

#define ACCEL_WORD(kind, name, ...) name ", "
static const char help[] =
	"usage: relume bench [OPTIONS] [TRACE]\n"
	"\n"
	"With a recording: render one of its frames several times and print what each kernel took, the\n"
	"means of all runs but the first. Without: trace a scene of about 250,000 triangles and print millions of rays a second, the median of\n"
	"several runs, for camera rays (with all that a frame with a new camera costs), shadow rays to\n"
	"one point light, and short incoherent rays; with --accel, the same for trees of several kinds, and what these cost.\n"
	"\n"
	"  --device NAME    number or part of the name of an OpenCL device, or 'reference'\n"
	"  --kernels FAMILY with a recording: packets, binary or compressed, as for relume render\n"
	"  --threads N      compute threads on a CPU\n"
	"  --models DIR     folder with stanford-bunny.obj, cow.obj, spot.obj, teapot.obj\n"
	"                   (default: ../shared/models; bumpy spheres stand in where they are missing)\n"
	"  --accel LIST     kinds of trees, side by side: " TREE_BUILDERS(ACCEL_WORD) "with commas, or all\n"
	"  --repeat N       runs of each (default 5)\n"
	"  -f, --frame N    which frame of the recording (default 0)\n"
	"  --mode MODE      as for relume render (default whitted)\n"
	"  --json           as JSON\n";

struct options {
	const char *device, *models, *trace;
	uint64_t frame;
	enum tracer_mode mode;
	unsigned threads, kinds; /* kinds: bit 1 << enum accel_kind; 0: what is not asked for */
	size_t repeats;
	int json, has_family;
	enum device_family family;
};

struct figure {
	const char *rays, *kernel_name;
	enum device_kernel kernel;
	int kind; /* -1: camera */
	double mrays;
};

static int parse_kinds(const char *list, unsigned *kinds)
{
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
			return err_report(ERR_USAGE, NULL, "--accel takes " TREE_BUILDERS(ACCEL_WORD) "with commas, or all, not '%.*s'", (int)n, list);
		*kinds |= 1u << kind;
		list += n + (list[n] == ',');
	} while (*list);
	return 0;
}

static int parse(int argc, char **argv, struct options *o)
{
	static const struct option options[] = {
		{ "device", required_argument, NULL, 'd' }, { "threads", required_argument, NULL, 't' },
		{ "models", required_argument, NULL, 'm' }, { "repeat", required_argument, NULL, 'r' },
		{ "json", no_argument, NULL, 'j' },         { "help", no_argument, NULL, 'h' },
		{ "frame", required_argument, NULL, 'f' },  { "mode", required_argument, NULL, 'M' },
		{ "kernels", required_argument, NULL, 'k' }, { "accel", required_argument, NULL, 'a' },
		{ NULL, 0, NULL, 0 }
	};
	int option, err = 0;

	while (!err && (option = getopt_long(argc, argv, "f:h", options, NULL)) != -1) {
		switch (option) {
		case 'd':
			o->device = optarg;
			break;
		case 't':
			o->threads = (unsigned)strtoul(optarg, NULL, 10);
			break;
		case 'm':
			o->models = optarg;
			break;
		case 'r':
			o->repeats = strtoul(optarg, NULL, 10);
			if (o->repeats < 1 || o->repeats > MAX_REPEATS)
				return err_report(ERR_USAGE, NULL, "--repeat takes 1 to %d", MAX_REPEATS);
			break;
		case 'j':
			o->json = 1;
			break;
		case 'f':
			o->frame = strtoull(optarg, NULL, 10);
			break;
		case 'M':
			err = settings_parse_mode(optarg, &o->mode);
			break;
		case 'a':
			err = parse_kinds(optarg, &o->kinds);
			break;
		case 'k':
			o->has_family = 1;
			err = device_parse_family(optarg, &o->family);
			break;
		case 'h':
			fputs(help, stdout);
			exit(0);
		default:
			return ERR_USAGE;
		}
	}
	if (err)
		return err;
	if (optind < argc)
		o->trace = argv[optind++];
	if (o->trace && o->kinds)
		return err_report(ERR_USAGE, NULL, "--accel measures the scene of its own, no recording");
	if (optind < argc)
		return err_report(ERR_USAGE, NULL, "bench takes one recording; what is '%s'?", argv[optind]);
	return 0;
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

int bench_main(int argc, char **argv)
{
	struct figure figures[] = {
		{ "camera", "camera_packet", KERNEL_camera_packet, -1, 0 },
		{ "camera", "camera_wide", KERNEL_camera_wide, -1, 0 },
		{ "camera", "camera_compressed", KERNEL_camera_compressed, -1, 0 },
		{ "shadow", "occlude_packet", KERNEL_occlude_packet, BENCH_SHADOW, 0 },
		{ "shadow", "occlude_wide", KERNEL_occlude_wide, BENCH_SHADOW, 0 },
		{ "shadow", "occlude_binary", KERNEL_occlude_binary, BENCH_SHADOW, 0 },
		{ "shadow", "occlude_compressed", KERNEL_occlude_compressed, BENCH_SHADOW, 0 },
		{ "shadow, nearest hit", "intersect_packet", KERNEL_intersect_packet, BENCH_SHADOW, 0 },
		{ "shadow, nearest hit", "intersect_wide", KERNEL_intersect_wide, BENCH_SHADOW, 0 },
		{ "shadow, nearest hit", "intersect_binary", KERNEL_intersect_binary, BENCH_SHADOW, 0 },
		{ "shadow, nearest hit", "intersect_compressed", KERNEL_intersect_compressed, BENCH_SHADOW, 0 },
		{ "incoherent", "occlude_packet", KERNEL_occlude_packet, BENCH_AMBIENT, 0 },
		{ "incoherent", "occlude_wide", KERNEL_occlude_wide, BENCH_AMBIENT, 0 },
		{ "incoherent", "occlude_binary", KERNEL_occlude_binary, BENCH_AMBIENT, 0 },
		{ "incoherent", "occlude_compressed", KERNEL_occlude_compressed, BENCH_AMBIENT, 0 },
		{ "incoherent, nearest hit", "intersect_packet", KERNEL_intersect_packet, BENCH_AMBIENT, 0 },
		{ "incoherent, nearest hit", "intersect_wide", KERNEL_intersect_wide, BENCH_AMBIENT, 0 },
		{ "incoherent, nearest hit", "intersect_binary", KERNEL_intersect_binary, BENCH_AMBIENT, 0 },
		{ "incoherent, nearest hit", "intersect_compressed", KERNEL_intersect_compressed, BENCH_AMBIENT, 0 },
	};
	const size_t n = sizeof(figures) / sizeof(figures[0]);
	struct options o = { .models = "../shared/models", .repeats = 5 };
	struct device *dev = NULL;
	struct bench *b = NULL;
	int err = parse(argc, argv, &o);

	if (err)
		return -err;
	err = device_open(o.device, o.threads, &dev);
	if (!err && o.has_family)
		device_choose_family(dev, o.family);
	if (!err && o.trace) {
		err = bench_frame(dev, o.trace, o.frame, o.mode, o.repeats, o.json);
		goto done;
	}
	if (!err)
		err = bench_create(dev, o.models, 1600, 1200, &b);
	if (!err && o.kinds) {
		err = bench_accel(b, o.kinds, o.repeats, o.json);
		goto done;
	}
	for (size_t i = 0; i < n && !err; i++)
		err = measure(b, &figures[i], o.repeats);
	if (err)
		goto done;
	if (o.json)
		printf("{\"device\": \"%s\", \"triangles\": %u, \"models\": \"%s\", \"build_s\": %.4f, \"figures\": [\n",
		       device_name(dev), b->mesh.n_triangles, b->mesh.source, b->build_s);
	else
		printf("%s\n%u triangles (%s), built in %.3f s; %ux%u\n", device_name(dev), b->mesh.n_triangles,
		       b->mesh.source, b->build_s, b->width, b->height);
	for (size_t i = 0; i < n; i++)
		if (o.json)
			printf("  {\"rays\": \"%s\", \"kernel\": \"%s\", \"mrays_per_s\": %.2f}%s\n", figures[i].rays,
			       figures[i].kernel_name, figures[i].mrays, i + 1 < n ? "," : "");
		else
			printf("%-24s %-20s %8.2f Mrays/s\n", figures[i].rays, figures[i].kernel_name, figures[i].mrays);
	if (o.json)
		puts("]}");
done:
	bench_destroy(&b);
	device_close(&dev);
	return -err;
}
