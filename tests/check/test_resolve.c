/*
 * resolve_packet against resolve on each device and on the twins, bit by bit: random fragments, of materials with all
 * factors, equations and masks, over random pixels. Some rows of pixels are still to be cleared, which resolve_packet
 * does before it draws.
 */
#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "kernels/gl/tables.h"
#include "tests/case.h"
#include "tests/check/on_devices.h"
#include "tracer/device/launch.h"

#define WIDTH 70u /* rows end inside a row of FRAME_ROW */
#define HEIGHT 48u
#define PIXELS (WIDTH * HEIGHT)
#define ROWS (5u * HEIGHT)
#define LAYERS 3u
#define FRAGMENTS (LAYERS * PIXELS)
#define MATERIALS 1024u

struct content {
	struct geometry geometries[MATERIALS];
	struct scene_material materials[MATERIALS];
	struct fragment fragments[FRAGMENTS];
	struct shaded shaded[FRAGMENTS];
	uint32_t first[PIXELS], counts[PIXELS];
	struct frame_pixel frame[PIXELS]; /* the part not drawn to is cleared */
	uint32_t drawn[ROWS];
	struct frame_pixel cleared;
};

struct result {
	struct shaded shaded[FRAGMENTS];
	struct frame_pixel frame[PIXELS];
};

static uint32_t random_state = 7;

static uint32_t next_below(uint32_t n)
{
	random_state = random_state * 1664525u + 1013904223u;
	return (random_state >> 8) % n;
}

static float next_number(void)
{
	const float strange[] = { 0, -0.0f, 1, 2, 1e9f, -0.5f, 0.5f / 255, 100.5f / 255 };
	const float x = (float)next_below(1u << 20) / (float)(1u << 20);

	return next_below(5) ? x : strange[next_below(8)];
}

static uint32_t next_factor(void)
{
	static const uint32_t factors[] = {
		GL_ZERO, GL_ONE, GL_SRC_COLOR, GL_ONE_MINUS_SRC_COLOR, GL_DST_COLOR, GL_ONE_MINUS_DST_COLOR, GL_SRC_ALPHA,
		GL_ONE_MINUS_SRC_ALPHA, GL_DST_ALPHA, GL_ONE_MINUS_DST_ALPHA, GL_CONSTANT_COLOR, GL_ONE_MINUS_CONSTANT_COLOR,
		GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA, GL_SRC_ALPHA_SATURATE
	};

	return factors[next_below(sizeof(factors) / sizeof(factors[0]))];
}

static uint32_t next_equation(void)
{
	static const uint32_t equations[] = { GL_FUNC_ADD, GL_FUNC_SUBTRACT, GL_FUNC_REVERSE_SUBTRACT, GL_MIN, GL_MAX };

	return equations[next_below(5)];
}

static void fill_material(struct scene_material *m)
{
	m->blend = next_below(4) != 0;
	m->blend_equation_rgb = next_equation();
	m->blend_src_rgb = next_factor();
	m->blend_dst_rgb = next_factor();
	m->blend_equation_alpha = next_below(2) ? m->blend_equation_rgb : next_equation();
	m->blend_src_alpha = next_below(2) ? m->blend_src_rgb : next_factor();
	m->blend_dst_alpha = next_below(2) ? m->blend_dst_rgb : next_factor();
	for (int i = 0; i < 4; i++)
		m->blend_color[i] = next_number();
	m->logic_op = next_below(16) ? 0 : GL_XOR;
	m->floats = next_below(16) == 0;
	m->color_mask = next_below(3) ? 15 : next_below(16);
	m->alpha_to_one = next_below(8) == 0;
	m->depth_test = 1;
	m->depth_func = next_below(3) ? GL_LEQUAL : GL_ALWAYS;
	m->depth_write = next_below(2);
	m->surface.transmit = next_below(4) ? 0 : 0.5f;
	m->surface.hidden = (next_below(6) ? 0 : SCENE_SOLID) | (next_below(6) ? 0 : SCENE_LEFT_OUT);
}

static void fill_numbers(float *numbers, size_t n)
{
	for (size_t i = 0; i < n; i++)
		numbers[i] = next_number();
}

/* The row of FRAME_ROW pixels that contains a pixel. */
static uint32_t row_of(uint32_t pixel)
{
	return pixel / WIDTH * frame_columns(WIDTH) + pixel % WIDTH / FRAME_ROW;
}

static void fill(struct content *c)
{
	memset(c, 0, sizeof(*c));
	for (uint32_t i = 0; i < MATERIALS; i++) {
		fill_material(&c->materials[i]);
		c->geometries[i].material = i;
		c->geometries[i].draw = i + 1;
		c->geometries[i].primitive_draw = SCENE_NONE;
	}
	for (uint32_t i = 0; i < FRAGMENTS; i++) {
		struct shaded *s = &c->shaded[i];

		c->fragments[i] = (struct fragment){ .order = i, .instance = next_below(MATERIALS) };
		fill_numbers(s->gl, (sizeof(*s) - sizeof(s->flags)) / sizeof(float));
		s->flags = next_below(16) ? SHADED_THERE : 0;
	}
	for (uint32_t i = 0; i < PIXELS; i++) {
		c->first[i] = i * LAYERS;
		c->counts[i] = row_of(i) % 5 ? next_below(LAYERS + 1) : 0;
		fill_numbers(c->frame[i].gl, 16);
		fill_numbers(c->frame[i].albedo, 3);
		c->frame[i].depth_exact = next_number();
		c->frame[i].depth = next_below(1u << 24);
		c->frame[i].surface.order = next_below(2) ? SCENE_NONE : 0;
	}
	c->cleared = c->frame[0];
	for (uint32_t i = 0; i < ROWS; i++)
		c->drawn[i] = next_below(2);
	for (uint32_t i = 0; i < PIXELS; i++)
		if (!c->drawn[row_of(i)])
			c->frame[i] = c->cleared;
}

/* Pixels still to be cleared, whose memory is uninitialised, are filled with other values in `from`. */
static void forget_cleared(const struct content *c, struct frame_pixel *from)
{
	memcpy(from, c->frame, sizeof(c->frame));
	for (uint32_t i = 0; i < PIXELS; i++)
		if (!c->drawn[row_of(i)])
			memset(&from[i], 0xee, sizeof(from[i]));
}

/* A packet's rows still to be cleared have no fragments and were not written: clear them. */
static void clear_rest(const struct content *c, const uint32_t *drawn, struct frame_pixel *frame)
{
	struct frame_pixel unwritten;

	memset(&unwritten, 0xee, sizeof(unwritten));
	for (uint32_t i = 0; i < PIXELS; i++) {
		if (drawn[row_of(i)])
			continue;
		ck_assert_msg(c->counts[i] == 0 && memcmp(&frame[i], &unwritten, sizeof(unwritten)) == 0,
		              "row %u is reported as undrawn", row_of(i));
		frame[i] = c->cleared;
	}
}

static void run(struct device *dev, const struct content *c, uint32_t bits, int packet, struct result *out)
{
	struct device_buffer *b[] = {
		make_buffer(dev, c->geometries, sizeof(c->geometries)), make_buffer(dev, c->materials, sizeof(c->materials)),
		make_buffer(dev, c->fragments, sizeof(c->fragments)), make_buffer(dev, c->shaded, sizeof(c->shaded)),
		make_buffer(dev, c->first, sizeof(c->first)), make_buffer(dev, c->counts, sizeof(c->counts)),
		make_buffer(dev, packet ? out->frame : c->frame, sizeof(c->frame)), make_buffer(dev, &c->cleared, sizeof(c->cleared)),
		make_buffer(dev, c->drawn, sizeof(c->drawn)),
	};
	uint32_t drawn[ROWS];
	const struct tables_launch tables = *LAUNCH(tables, .geometries = { b[0] }, .materials = { b[1] }, .lights = { b[0] },
	                                            .units = { b[0] }, .currents = { b[0] }, .attributes = { b[0] },
	                                            .indices = { b[0] }, .vertices = { b[0] }, .texcoords = { b[0] },
	                                            .textures = { b[0] }, .texels = { b[0] }, .stipples = { b[0] });
	const struct camera_rectangle whole = { 0, 0, WIDTH, HEIGHT };
	const struct resolve_launch *a =
		LAUNCH(resolve, .tables = tables, .fragments = { b[2] }, .shaded = { b[3] }, .first = { b[4] }, .counts = { b[5] },
		       .rectangle = whole, .width = WIDTH, .bits = bits,
		       .n = packet ? ROWS : PIXELS, .cleared = { b[7] }, .drawn = { b[8] }, .frame = { b[6] });

	ck_assert_int_eq(packet ? launch_resolve_packet(dev, ROWS, a) : launch_resolve(dev, PIXELS, a), 0);
	ck_assert_int_eq(device_read(dev, b[3], 0, out->shaded, sizeof(out->shaded)), 0);
	ck_assert_int_eq(device_read(dev, b[6], 0, out->frame, sizeof(out->frame)), 0);
	ck_assert_int_eq(device_read(dev, b[8], 0, drawn, sizeof(drawn)), 0);
	if (packet)
		clear_rest(c, drawn, out->frame);
	for (size_t i = 0; i < sizeof(b) / sizeof(b[0]); i++)
		device_release(dev, &b[i]);
}

static void check_device(struct device *dev, void *user)
{
	const struct content *c = user;
	struct result *one = malloc(sizeof(*one)), *packet = malloc(sizeof(*packet));

	ck_assert(one && packet);
	for (uint32_t alpha_bits = 0; alpha_bits <= 8; alpha_bits += 8) {
		run(dev, c, 24 | 8u << 8 | alpha_bits << 16, 0, one);
		forget_cleared(c, packet->frame);
		run(dev, c, 24 | 8u << 8 | alpha_bits << 16, 1, packet);
		ck_assert_msg(memcmp(one->frame, c->frame, sizeof(c->frame)) != 0, "%s draws nothing", device_name(dev));
		for (uint32_t i = 0; i < PIXELS; i++)
			ck_assert_msg(memcmp(&one->frame[i], &packet->frame[i], sizeof(one->frame[i])) == 0,
			              "pixel %u differs on %s", i, device_name(dev));
		ck_assert(memcmp(one->shaded, packet->shaded, sizeof(one->shaded)) == 0);
	}
	free(one);
	free(packet);
}

START_TEST(test_packet_and_single)
{
	struct content *c = malloc(sizeof(*c));

	ck_assert_ptr_nonnull(c);
	fill(c);
	on_each_device(check_device, c);
	free(c);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("devices");

	tcase_set_timeout(tests, 240);
	tcase_add_test(tests, test_packet_and_single);
	return run_case(tests, "resolve");
}
