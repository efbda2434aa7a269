/* relume pick: what a pixel of a frame shows, and a rule for it. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/err.h"
#include "base/options.h"
#include "base/plural.h"
#include "base/verbs.h"
#include "look/apply/alone.h"
#include "scene/describe.h"
#include "scene/drawn.h"
#include "verbs/render/single.h"

struct asked {
	uint64_t frame;
	const char *device;
};

static const struct options_row rows[] = {
	{ "frame", 'f', "N", "which frame, from 0 (default 0)", options_frame, .at = offsetof(struct asked, frame) },
	{ "device", 'd', "DEVICE",
	  "a number from 'relume devices', cpu, gpu, accelerator, part of a name, or reference (default: the first GPU, "
	  "else CPU)",
	  options_text, .at = offsetof(struct asked, device) },
	{ OPTIONS_NO_SANDBOX },
};

static const struct options_table table = {
	.verb = "pick",
	.head = "usage: relume pick TRACE -f N X,Y\n"
		"\n"
		"Say what a pixel of a frame shows: its draw and call, its mesh and textures with their hashes, its\n"
		"material, and a rule for relume render --look that matches this surface and no other of the frame.\n"
		"\n"
		"X,Y  the pixel, counted from 0 at the upper left corner, as programs that show pictures count them\n",
	OPTIONS_ROWS(rows),
	.notes = "The output is a file of rules: write it to FILE.yaml, change what the surface is made of ('relume help\n"
		 "look-file' lists the keys), and render with --look FILE.yaml. 'relume look --sheet' shows all surfaces\n"
		 "of a frame at once.\n"
		 "Exit codes: 0 done, 2 wrong usage, or nothing is drawn there, 3 the recording cannot be read, 5 the\n"
		 "device or the system failed.\n",
	.takes = "a trace and a pixel X,Y",
	.least = 2,
	.most = 2,
	.words_use = CONFINE_RECORDING,
};

static int parse_pixel(const char *text, uint32_t *x, uint32_t *y)
{
	char behind;

	if (*text >= '0' && *text <= '9' && sscanf(text, "%" SCNu32 ",%" SCNu32 "%c", x, y, &behind) == 2)
		return 0;
	return err_report(ERR_USAGE, NULL, "'%s' is no pixel; write X,Y, as in 320,240", text);
}

static int write_rule(const struct scene *scene, uint32_t instance)
{
	char keys[ALONE_BYTES];
	const int others = alone_find(scene, instance, keys);

	if (others < 0)
		return others;
	if (others)
		printf("# without `draws` the rule matches %d other%s of the same mesh and texture; draw numbers hold "
		       "in this frame alone\n",
		       others, plural((uint64_t)others));
	printf("surfaces:\n"
	       "  - match: %s\n"
	       "    reflect: 0.3\n", keys);
	return 0;
}

static int tell(const struct single *single, const char *trace, uint32_t x, uint32_t y)
{
	const struct scene *scene = single->scene;
	const struct image *img = &single->image;
	uint32_t draw, instance;

	if (x >= img->width || y >= img->height)
		return err_report(ERR_USAGE, trace, "frame %" PRIu64 " has %u x %u pixels; %u,%u is not there",
		                  scene->frame, img->width, img->height, x, y);
	draw = single_draw_at(single, (size_t)y * img->width + x);
	instance = draw ? scene_instance_of(scene, draw) : SCENE_NONE;
	if (instance == SCENE_NONE)
		return err_report(ERR_USAGE, trace, "frame %" PRIu64 ": nothing is drawn at %u,%u", scene->frame, x, y);
	printf("# frame %" PRIu64 ", pixel %u,%u of %u x %u\n", scene->frame, x, y, img->width, img->height);
	scene_describe(stdout, scene, instance, "# ");
	return write_rule(scene, instance);
}

int pick_main(int argc, char **argv)
{
	struct asked asked = { .frame = 0 };
	struct options_line line;
	struct single single = { .scene = NULL };
	uint32_t x = 0, y = 0;
	int err = options_parse(&table, argc, argv, &asked, &line);

	if (!err)
		err = parse_pixel(line.words[1], &x, &y);
	if (err)
		return err == 1 ? 0 : -err;
	line.n_words = 1; /* the pixel is no file */
	err = options_confine(&table, &line, CONFINE_TRACER, NULL);
	if (!err)
		err = single_open(line.words[0], asked.device, &single);
	if (!err)
		err = replay_take_frame(single.replay, line.words[0], asked.frame, &single.scene);
	if (!err)
		err = single_render(&single, "id");
	if (!err)
		err = tell(&single, line.words[0], x, y);
	single_free(&single);
	return -err;
}
