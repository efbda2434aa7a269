/*
 * The compose kernels on each device against their C twins: random pixels, including equal, unusual and huge colours,
 * in pictures whose rows are not whole packets; and the packets against the kernel with one pixel per work item, bit by
 * bit.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/gl/tables.h"
#include "kernels/frame/stages/compose.h"
#include "tests/case.h"
#include "tests/check/on_devices.h"
#include "tracer/device/launch.h"

#define WIDTH 21u
#define HEIGHT 21u
#define PIXELS (WIDTH * HEIGHT)
#define ROWS (2u * HEIGHT) /* in FRAME_ROW pixels */
#define GUARD 64u
#define N_HALVES (N_COMPOSE_HALVES * PIXELS + GUARD)
#define N_FLOATS (N_COMPOSE_FLOATS * PIXELS + GUARD)

struct planes {
	uint16_t halves[N_HALVES];
	float floats[N_FLOATS];
};

struct content {
	uint32_t random;
	struct frame_pixel frame[PIXELS]; /* the part not drawn to is cleared */
	struct frame_pixel unwritten[PIXELS]; /* the same for the part drawn to */
	struct frame_pixel cleared;
	uint32_t drawn[ROWS];
	float sums[PIXELS * PASS_PARTS];
	struct geometry geometry;
	struct scene_material material;
	uint32_t indices[3];
	struct shaded_vertex vertices[3];
	struct window_vertex windows[3];
};

static float next_random(struct content *c)
{
	c->random = c->random * 1664525u + 1013904223u;
	return (float)(c->random >> 8) / 16777216.0f;
}

static float next_color(struct content *c)
{
	const float strange[] = { 0, -0.0f, 1, 2, 1e9f, -0.5f, 0.5f / 255, 100.5f / 255 };
	const float x = next_random(c), which = next_random(c);

	return which < 0.2f ? strange[(int)(x * 8)] : x;
}

static void fill(struct content *c)
{
	memset(c, 0, sizeof(*c));
	c->random = 7;
	for (uint32_t i = 0; i < PIXELS; i++) {
		struct frame_pixel *p = &c->frame[i];
		float *parts[] = { p->shadowed, p->direct, p->mirrored, p->beauty };

		for (int k = 0; k < 3; k++) {
			p->gl[k] = next_color(c);
			p->albedo[k] = next_color(c);
			for (int part = 0; part < 4; part++)
				parts[part][k] = next_random(c) < 0.6f ? (part ? parts[part - 1][k] : p->gl[k]) : next_color(c);
		}
		p->gl[3] = next_random(c);
		p->depth_exact = next_random(c);
		p->id = i % 5;
		p->layers = i % 3;
		p->unknown = i % 7 ? 0 : PIXEL_BEFORE;
		p->surface = (struct fragment){ i % 4 ? SCENE_NONE : 0, 0, 0, next_random(c) * 0.5f, next_random(c) * 0.5f, 0.5f };
		for (uint32_t k = 0; k < PASS_PARTS; k++)
			c->sums[i * PASS_PARTS + k] = 2 * next_color(c);
	}
	for (uint32_t i = 0; i < 3; i++) {
		c->indices[i] = i;
		c->vertices[i].eye[i] = 2;
		c->vertices[i].eye[2] -= 3;
		c->vertices[i].eye[3] = 1;
		c->windows[i] = (struct window_vertex){ i == 1 ? 2560 : 0, i == 2 ? 2560 : 0, 0.5f, 1 + (float)i };
	}
}

/* Rows without any drawing. */
static void leave_undrawn(struct content *c)
{
	c->cleared = c->frame[0];
	for (uint32_t i = 0; i < ROWS; i++)
		c->drawn[i] = i % 3 != 0;
	memcpy(c->unwritten, c->frame, sizeof(c->frame));
	for (uint32_t i = 0; i < PIXELS; i++) {
		if (c->drawn[i / WIDTH * frame_columns(WIDTH) + i % WIDTH / FRAME_ROW])
			continue;
		c->frame[i] = c->cleared;
		memset(&c->unwritten[i], 0xee, sizeof(c->unwritten[i]));
	}
}

static void run(struct device *dev, const struct content *c, const struct compose_request *request, int packets,
                struct planes *out)
{
	const uint32_t n = PIXELS;
	struct device_buffer *b[] = {
		make_buffer(dev, &c->geometry, sizeof(c->geometry)), make_buffer(dev, &c->material, sizeof(c->material)),
		make_buffer(dev, c->indices, sizeof(c->indices)), make_buffer(dev, c->vertices, sizeof(c->vertices)),
		make_buffer(dev, c->windows, sizeof(c->windows)),
		make_buffer(dev, packets ? c->unwritten : c->frame, sizeof(c->frame)), make_buffer(dev, c->sums, sizeof(c->sums)),
		NULL, NULL, make_buffer(dev, &c->cleared, sizeof(c->cleared)), make_buffer(dev, c->drawn, sizeof(c->drawn)),
	};
	const struct tables_launch tables = *LAUNCH(tables, .geometries = { b[0] }, .materials = { b[1] }, .lights = { b[0] },
	                                            .units = { b[0] }, .currents = { b[0] }, .attributes = { b[0] },
	                                            .indices = { b[2] }, .vertices = { b[3] }, .texcoords = { b[0] },
	                                            .textures = { b[0] }, .texels = { b[0] }, .stipples = { b[0] });
	const struct compose_launch *a;

	memset(out, 0xa5, sizeof(*out));
	b[7] = make_buffer(dev, out->halves, sizeof(out->halves));
	b[8] = make_buffer(dev, out->floats, sizeof(out->floats));
	a = LAUNCH(compose, .tables = tables, .windows = { b[4] }, .frame = { b[5] },
	            .cleared = { b[9] }, .drawn = { b[10] }, .sums = { b[6] }, .first_pixel = 0,
	            .request = *request, .n = n, .halves = { b[7] }, .floats = { b[8] });
	if (packets)
		ck_assert_int_eq(launch_compose_packet(dev, compose_items(request->width, request->height), a), 0);
	else
		ck_assert_int_eq(launch_compose(dev, n, a), 0);
	ck_assert_int_eq(device_read(dev, b[7], 0, out->halves, sizeof(out->halves)), 0);
	ck_assert_int_eq(device_read(dev, b[8], 0, out->floats, sizeof(out->floats)), 0);
	for (size_t i = 0; i < sizeof(b) / sizeof(b[0]); i++)
		device_release(dev, &b[i]);
	for (uint32_t i = 0; i < GUARD; i++) {
		ck_assert_msg(out->halves[N_HALVES - GUARD + i] == 0xa5a5u, "compose writes past the halves' end");
		ck_assert(memcmp(&out->floats[N_FLOATS - GUARD + i], "\xa5\xa5\xa5\xa5", 4) == 0);
	}
}

/* Devices that divide less exactly than the twins may differ by one half-float step, and where a contribution
 * becomes too small to count. */
static void check_close(const struct planes *a, const struct planes *b, const char *name)
{
	uint32_t differ = 0;

	for (uint32_t i = 0; i < N_HALVES; i++)
		differ += abs((int)a->halves[i] - (int)b->halves[i]) > 1;
	for (uint32_t i = 0; i < N_FLOATS; i++)
		differ += a->floats[i] != b->floats[i] && !(fabsf(a->floats[i] - b->floats[i]) <= 1e-6f * fabsf(a->floats[i]));
	ck_assert_msg(differ <= N_HALVES / 1000, "%u numbers differ on %s", differ, name);
}

START_TEST(test_packets_and_twins)
{
	static const struct {
		uint32_t n_passes, display, normals, without; /* without: a plane that is not requested */
	} cases[] = { { 1, 0, 0, N_COMPOSE_HALVES },
		      { 3, 0, 0, COMPOSE_RELIGHT + 1 },
		      { 1, 1, 0, 0 },
		      { 1, 0, 1, COMPOSE_NORMAL } };
	struct content *c = malloc(sizeof(*c));
	struct planes *twin = malloc(sizeof(*twin)), *one = malloc(sizeof(*one)), *packets = malloc(sizeof(*packets));
	struct device_description *devices = NULL;
	struct device *reference = NULL, *dev = NULL;
	size_t n = 0;

	ck_assert(c && twin && one && packets);
	fill(c);
	leave_undrawn(c);
	ck_assert_int_eq(device_open("reference", 1, &reference), 0);
	device_list(&devices, &n);
	for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
		struct compose_request r = { .width = WIDTH, .height = HEIGHT, .n_passes = cases[i].n_passes,
			                     .display = cases[i].display, .normals = cases[i].normals };

		for (uint32_t k = 0; k < N_COMPOSE_HALVES; k++)
			r.half_plane[k] = k == cases[i].without ? SCENE_NONE : r.n_halves++ * WIDTH * HEIGHT;
		for (uint32_t k = 0; k < N_COMPOSE_FLOATS; k++)
			r.float_plane[k] = r.n_floats++ * WIDTH * HEIGHT;
		run(reference, c, &r, 0, twin);
		run(reference, c, &r, 1, packets);
		ck_assert_msg(memcmp(twin, packets, sizeof(*twin)) == 0, "the twins differ in case %zu", i);
		for (size_t d = 0; d < n; d++) {
			char number[24];

			snprintf(number, sizeof(number), "%zu", d);
			ck_assert_int_eq(device_open(number, 0, &dev), 0);
			run(dev, c, &r, 0, one);
			run(dev, c, &r, 1, packets);
			ck_assert_msg(memcmp(one, packets, sizeof(*one)) == 0, "packets differ on %s in case %zu", device_name(dev), i);
			check_close(twin, one, device_name(dev));
			device_close(&dev);
		}
	}
	device_close(&reference);
	free(devices);
	free(c);
	free(twin);
	free(one);
	free(packets);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("devices");

	tcase_set_timeout(tests, 240);
	tcase_add_test(tests, test_packets_and_twins);
	return run_case(tests, "compose");
}
