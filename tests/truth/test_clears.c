/*
 * Clears before all draws (GL 2.1 sec. 4.2.3): any of colour, depth and stencil, under masks and scissors, executed in
 * sequence with whole ones combined, against a simple simulation.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/case.h"
#include "tests/truth/scenes.h"

enum { WIDTH = 7, HEIGHT = 5, PIXELS = WIDTH * HEIGHT, MOST = 4, ROUNDS = 400 };

struct account {
	uint8_t rgba[4 * PIXELS], stencil[PIXELS];
	uint32_t depth[PIXELS];
};

static uint32_t next_random(uint32_t *state)
{
	*state = *state * 1664525u + 1013904223u;
	return *state >> 8;
}

static struct scene_clear random_clear(uint32_t *seed)
{
	static const uint32_t color_masks[] = { 15, 15, 15, 7, 5, 0 }, stencil_masks[] = { 0xffffffffu, 255, 255, 15 };
	struct scene_clear c = { .scissor = { 0, 0, WIDTH, HEIGHT }, .depth = (float)(next_random(seed) % 5) / 4.0f };

	c.buffers = next_random(seed) % 8;
	c.color_mask = color_masks[next_random(seed) % 6];
	c.stencil_mask = stencil_masks[next_random(seed) % 4];
	c.stencil = next_random(seed) % 256;
	c.target = next_random(seed) % 8 == 0;
	for (int i = 0; i < 4; i++)
		c.color[i] = (float)(next_random(seed) % 256) / 255.0f;
	if (next_random(seed) % 4 == 0)
		c.scissor[next_random(seed) % 4]++; /* smaller at the left or bottom; parts outside do not count */
	if (next_random(seed) % 4 == 0)
		c.scissor[2 + next_random(seed) % 2] -= 2;
	return c;
}

static void keep_account(const struct scene_clear *c, struct account *a)
{
	for (int p = 0; p < PIXELS && c->target == 0; p++) {
		int x = p % WIDTH, y = p / WIDTH;

		if (x < c->scissor[0] || x >= c->scissor[0] + c->scissor[2] || y < c->scissor[1] ||
		    y >= c->scissor[1] + c->scissor[3])
			continue;
		for (int i = 0; i < 4; i++)
			if (c->buffers & 1 && c->color_mask >> i & 1)
				a->rgba[4 * p + i] = (uint8_t)lrintf(c->color[i] * 255);
		if (c->buffers & 2)
			a->depth[p] = (uint32_t)lrintf(c->depth * 16777215);
		if (c->buffers & 4)
			a->stencil[p] = (uint8_t)((a->stencil[p] & ~c->stencil_mask) | (c->stencil & c->stencil_mask));
	}
}

START_TEST(test_clears_against_account)
{
	const char *choice = getenv("RELUME_TEST_DEVICE");
	struct device *dev = NULL;
	struct tracer *tracer = NULL;
	struct scene_clear clears[MOST];
	struct account found, expected;
	struct scene_picture picture = { .width = WIDTH,
		                         .height = HEIGHT,
		                         .depth_bits = 24,
		                         .rgba = found.rgba,
		                         .depth = found.depth,
		                         .stencil = found.stencil };
	struct made t;
	uint32_t seed = 20;

	made_init(&t, WIDTH, HEIGHT, 1);
	t.scene.alpha_bits = 8;
	t.scene.clears = clears;
	ck_assert_int_eq(device_open(choice ? choice : "reference", 0, &dev), 0);
	ck_assert_int_eq(tracer_create(&tracer, dev), 0);
	for (int round = 0; round < ROUNDS; round++) {
		memset(&expected, 0, sizeof(expected)); /* initial values, also of depth */
		t.scene.n_clears = 1 + next_random(&seed) % MOST;
		for (uint32_t i = 0; i < t.scene.n_clears; i++) {
			clears[i] = random_clear(&seed);
			keep_account(&clears[i], &expected);
		}
		ck_assert_int_eq(tracer_render_picture(tracer, &t.scene, &picture), 0);
		ck_assert_msg(memcmp(found.rgba, expected.rgba, sizeof(found.rgba)) == 0, "colours of round %d", round);
		ck_assert_msg(memcmp(found.depth, expected.depth, sizeof(found.depth)) == 0, "depths of round %d", round);
		ck_assert_msg(memcmp(found.stencil, expected.stencil, sizeof(found.stencil)) == 0, "stencil of round %d", round);
	}
	tracer_destroy(&tracer);
	device_close(&dev);
	made_free(&t);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("clears");

	tcase_add_test(tests, test_clears_against_account);
	return run_case(tests, "clears");
}
