#include "scene/release.h"
#include "verbs/render/bench/bench_frame.h"

#include <stdio.h>
#include <string.h>

#include "base/progress.h"
#include "look/apply/apply.h"
#include "replay/replay.h"

/* One line of the table: means of n runs. */
static void print_row(const char *name, const struct device_spent *s, double n, int json, struct device_spent *sum)
{
	sum->wall_s += s->wall_s;
	sum->cpu_s += s->cpu_s;
	if (!s->count)
		return;
	if (json)
		printf("  {\"what\": \"%s\", \"wall_ms\": %.3f, \"cpu_ms\": %.3f, \"count\": %.1f, \"amount\": %.0f},\n", name,
		       1e3 * s->wall_s / n, 1e3 * s->cpu_s / n, (double)s->count / n, (double)s->amount / n);
	else
		printf("%-18s %9.2f %9.2f %8.1f %12.0f\n", name, 1e3 * s->wall_s / n, 1e3 * s->cpu_s / n, (double)s->count / n,
		       (double)s->amount / n);
}

static void print_profile(const struct device *dev, const struct device_profile *p, const struct device_spent *whole,
                          uint32_t width, uint32_t height, int json)
{
	struct device_spent sum = { 0, 0, 0, 0 }, host = *whole;
	double n = (double)whole->count;

	if (json)
		printf("{\"device\": \"%s\", \"width\": %u, \"height\": %u, \"runs\": %.0f, \"spent\": [\n", device_name(dev), width,
		       height, n);
	else
		printf("%s, %ux%u, %.0f runs\n%-18s %9s %9s %8s %12s\n", device_name(dev), width, height, n,
		       "ms a frame", "wall", "cpu", "count", "items, bytes");
	for (int i = 0; i < N_KERNELS; i++)
		print_row(device_kernel_name((enum kernel)i), &p->kernels[i], n, json, &sum);
	print_row("(copies to it)", &p->writes, n, json, &sum);
	print_row("(copies from it)", &p->reads, n, json, &sum);
	host.wall_s -= sum.wall_s;
	host.cpu_s -= sum.cpu_s;
	print_row("(host)", &host, n, json, &sum);
	if (json)
		printf("  {\"what\": \"(whole)\", \"wall_ms\": %.3f, \"cpu_ms\": %.3f}\n]}\n", 1e3 * whole->wall_s / n,
		       1e3 * whole->cpu_s / n);
	else
		printf("%-18s %9.2f %9.2f\n", "(whole)", 1e3 * whole->wall_s / n, 1e3 * whole->cpu_s / n);
}

/* The scene is rendered 1 + n times: the first compiles kernels and builds what is kept. */
static int measure(struct device *dev, const struct bench_frame *what, const struct scene *scene)
{
	const struct tracer_options options = { .mode = what->mode, .depth = 4, .samples = 1 };
	struct device_profile profile;
	struct device_spent whole = { 0, 0, 0, 0 };
	struct tracer *tracer = NULL;
	int err = tracer_create(&tracer, dev);

	for (size_t i = 0; i <= what->n && !err; i++) {
		struct image img = { .width = 0 };
		double wall, cpu;

		if (i == 1) {
			memset(&profile, 0, sizeof(profile));
			device_set_profile(dev, &profile);
		}
		wall = progress_clock_s();
		cpu = progress_processor_s();
		err = tracer_render(tracer, scene, &options, &img);
		if (i) {
			whole.wall_s += progress_clock_s() - wall;
			whole.cpu_s += progress_processor_s() - cpu;
			whole.count++;
		}
		image_free(&img);
	}
	device_set_profile(dev, NULL);
	if (!err)
		print_profile(dev, &profile, &whole, scene->width, scene->height, what->json);
	tracer_destroy(&tracer);
	return err;
}

int bench_frame(struct device *dev, const struct bench_frame *what)
{
	struct scene *scene = NULL, changed = { .instances = NULL };
	int err = replay_one_frame(what->trace, what->frame, &scene);

	if (!err)
		err = look_apply(what->look, scene, &changed, NULL);
	if (!err)
		err = measure(dev, what, what->mode == TRACER_GL ? scene : &changed);
	if (changed.instances)
		look_release(&changed);
	scene_release(&scene);
	return err;
}
