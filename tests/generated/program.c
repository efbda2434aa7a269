/* program NUMBER[:STEP,...]...: draws programs, one per frame, each in a window and a context of its own. Program
 * NUMBER is the same in each run and on each machine; with steps it consists of those only, which serves to reduce
 * failures. program --list NUMBER: the steps of a program; program --kinds: the number of kinds of steps. */
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/generated/generated.h"

enum { LEAST_STEPS = 6, MOST_STEPS = 30 };

static const struct kind {
	const char *name;
	step *run;
	unsigned weight;
} kinds[] = {
	{ "draw", step_draw, 24 },
	{ "projection", step_projection, 1 },
	{ "matrix", step_matrix, 2 },
	{ "viewport", step_viewport, 1 },
	{ "scissor", step_scissor, 1 },
	{ "clip_plane", step_clip_plane, 1 },
	{ "light", step_light, 4 },
	{ "material", step_material, 4 },
	{ "light_model", step_light_model, 2 },
	{ "fog", step_fog, 1 },
	{ "alpha_test", step_alpha_test, 1 },
	{ "blend", step_blend, 2 },
	{ "depth", step_depth, 3 },
	{ "stencil", step_stencil, 1 },
	{ "mask", step_mask, 1 },
	{ "clear", step_clear, 1 },
	{ "logic", step_logic, 1 },
	{ "polygon", step_polygon, 2 },
	{ "line", step_line, 1 },
	{ "point", step_point, 1 },
	{ "shade_model", step_shade_model, 1 },
	{ "texture", step_texture, 5 },
	{ "texture_change", step_texture_change, 1 },
	{ "texture_environment", step_texture_environment, 2 },
	{ "texture_generation", step_texture_generation, 1 },
	{ "texture_matrix", step_texture_matrix, 1 },
	{ "texture_copy", step_texture_copy, 1 },
	{ "list", step_list, 3 },
	{ "call_lists", step_call_lists, 2 },
	{ "evaluator", step_evaluator, 2 },
	{ "rectangle", step_rectangle, 2 },
	{ "attributes", step_attributes, 2 },
	{ "draw_pixels", step_draw_pixels, 1 },
	{ "bitmap", step_bitmap, 1 },
	{ "copy_pixels", step_copy_pixels, 1 },
	{ "accumulate", step_accumulate, 1 },
	{ "framebuffer", step_framebuffer, 1 },
};

enum { N_KINDS = sizeof(kinds) / sizeof(kinds[0]) };

/* A sequence for a step of a program. */
static struct chance begin_chance(uint64_t program, uint64_t step)
{
	struct chance chance = { program * 0x100000001b3u + step };

	chance.state = chance_next(&chance);
	return chance;
}

static unsigned choose_kind(struct chance *chance)
{
	unsigned sum = 0, at;

	for (unsigned i = 0; i < N_KINDS; i++)
		sum += kinds[i].weight;
	at = chance_below(chance, sum);
	for (unsigned i = 0;; i++) {
		if (at < kinds[i].weight)
			return i;
		at -= kinds[i].weight;
	}
}

static unsigned count_steps(struct chance *chance)
{
	return LEAST_STEPS + chance_below(chance, MOST_STEPS - LEAST_STEPS + 1);
}

static int is_wanted(const char *list, unsigned step)
{
	while (list && *list) {
		char *end;

		if (strtoul(list, &end, 10) == step)
			return 1;
		list = *end ? end + 1 : end;
	}
	return list == NULL;
}

static void run_program(uint64_t number, int width, int height, const char *wanted)
{
	struct program program = { .width = width, .height = height, .target_width = width, .target_height = height };
	struct chance chance = begin_chance(number, 0);
	unsigned n = count_steps(&chance);
	GLfloat color[4];

	chance_color(&chance, color);
	glClearColor(color[0] * 0.5f, color[1] * 0.5f, color[2] * 0.5f, color[3]);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT | GL_ACCUM_BUFFER_BIT);
	glViewport(0, 0, width, height);
	glEnable(GL_DEPTH_TEST);
	step_projection(&chance, &program);
	for (unsigned i = 1; i <= n; i++) {
		chance = begin_chance(number, i);
		if (is_wanted(wanted, i))
			kinds[choose_kind(&chance)].run(&chance, &program);
	}
}

/* Windows with and without alpha and accumulation buffer. */
static XVisualInfo *choose_visual(Display *display, struct chance *chance)
{
	int alpha = chance_of(chance, 2) ? 8 : 0, accum = chance_of(chance, 2) ? 16 : 0;
	int attributes[] = { GLX_RGBA, GLX_DOUBLEBUFFER,   GLX_DEPTH_SIZE, 24,  GLX_STENCIL_SIZE, 8, GLX_ALPHA_SIZE,
		             alpha,    GLX_ACCUM_RED_SIZE, accum,          None };
	XVisualInfo *visual = glXChooseVisual(display, DefaultScreen(display), attributes);

	attributes[9] = 0;
	return visual ? visual : glXChooseVisual(display, DefaultScreen(display), attributes);
}

static void show_program(Display *display, const char *which)
{
	char *wanted;
	uint64_t number = strtoull(which, &wanted, 10);
	struct chance chance = begin_chance(number, UINT32_MAX);
	XVisualInfo *visual = choose_visual(display, &chance);
	int width = (int)(64 + chance_below(&chance, 100)), height = (int)(64 + chance_below(&chance, 80));
	XSetWindowAttributes set = { 0 };
	Window window;
	GLXContext context;

	if (!visual) {
		fprintf(stderr, "skipped: no such window here\n");
		exit(77);
	}
	set.colormap = XCreateColormap(display, DefaultRootWindow(display), visual->visual, AllocNone);
	window = XCreateWindow(display, DefaultRootWindow(display), 0, 0, (unsigned)width, (unsigned)height, 0,
	                       visual->depth, InputOutput, visual->visual, CWColormap, &set);
	context = glXCreateContext(display, visual, NULL, True);
	XMapWindow(display, window);
	if (!context || !glXMakeCurrent(display, window, context))
		exit(1);
	run_program(number, width, height, *wanted == ':' ? wanted + 1 : NULL);
	glXSwapBuffers(display, window);
	glXMakeCurrent(display, None, NULL);
	glXDestroyContext(display, context);
	XDestroyWindow(display, window);
	XFreeColormap(display, set.colormap);
	XFree(visual);
}

static void list_steps(uint64_t number)
{
	struct chance chance = begin_chance(number, 0);
	unsigned n = count_steps(&chance);

	for (unsigned i = 1; i <= n; i++) {
		chance = begin_chance(number, i);
		printf("%u %s\n", i, kinds[choose_kind(&chance)].name);
	}
}

int main(int argc, char **argv)
{
	Display *display;

	if (argc == 3 && strcmp(argv[1], "--list") == 0) {
		list_steps(strtoull(argv[2], NULL, 10));
		return 0;
	}
	if (argc == 2 && strcmp(argv[1], "--kinds") == 0) {
		printf("%d\n", N_KINDS);
		return 0;
	}
	if (argc < 2) {
		fprintf(stderr, "usage: program NUMBER[:STEP,...]...\n       program --list NUMBER\n");
		return 2;
	}
	display = XOpenDisplay(NULL);
	if (!display)
		return 1;
	for (int i = 1; i < argc; i++)
		show_program(display, argv[i]);
	XCloseDisplay(display);
	return 0;
}
