/* relume hook: tries a user's hook on small scenes, in a process of its own. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/options.h"
#include "base/verbs.h"
#include "tracer/device/outcome.h"
#include "tracer/hook/host.h"
#include "verbs/render/check/apart.h"
#include "verbs/render/check/check_scene.h"

#define WIDTH 48u
#define HEIGHT 36u
#define RINGS 12u
#define SECONDS 60

struct asked {
	int check;
	const char *device;
	unsigned seconds;
};

static const struct options_row rows[] = {
	{ "check", 'c', NULL, "read FILE, compile it, and run its functions on two small scenes", options_flag,
	  .at = offsetof(struct asked, check), .is_required = 1 },
	{ "device", 'd', "DEVICE",
	  "a number from 'relume devices', cpu, gpu, accelerator, or part of a name (default: the first GPU, else CPU)",
	  options_text, .at = offsetof(struct asked, device) },
	{ "seconds", 's', "N", "how long compiling and running may take, for each scene (default 60)", options_number,
	  .at = offsetof(struct asked, seconds), .most = 86400 },
	{ OPTIONS_NO_SANDBOX },
};

static const struct options_table table = {
	.verb = "hook",
	.head = "usage: relume hook --check FILE.cl\n"
		"\n"
		"Try a hook: OpenCL C whose functions take the place of stages of the ray tracer (relume render --hook "
	        "FILE.cl).\n",
	OPTIONS_ROWS(rows),
	.notes = "The stages that there are:\n"
		 "  struct relume_ray ray_generation(struct relume_pixel, struct relume_parameters)    a pixel's first "
	         "ray\n"
		 "  struct relume_box bounds(struct relume_object, struct relume_parameters)           the box of a "
	         "draw's new shape\n"
		 "  struct relume_request intersection(struct relume_crossing, struct relume_parameters)  where a ray "
	         "meets that shape\n"
		 "  struct relume_request any_hit(struct relume_hit, struct relume_parameters)         whether what a "
	         "ray meets counts\n"
		 "  struct relume_request closest_hit(struct relume_hit, struct relume_parameters)     what a ray hit "
	         "first\n"
		 "  struct relume_request miss(struct relume_miss, struct relume_parameters)           a ray that hit "
	         "nothing\n"
		 "  struct relume_request light(struct relume_beam, struct relume_parameters)          how much of a "
	         "light arrives\n"
		 "'relume help hook-file' has the structs, how to find accesses out of bounds, and examples.\n"
		 "Errors have the file's own lines.\n"
		 "Exit codes: 0 it runs, 2 wrong usage, 3 it does not compile, does not end or ends the process, 5 the "
	         "device failed.\n",
	.takes = "--check and one FILE.cl",
	.least = 1,
	.most = 1,
	.words_use = CONFINE_READS,
};

/* State shared by the process that tries the hook and the one that waits. */
struct trial {
	const struct hook *hook;
	const char *device;
	const struct options_line *line;
	int step, err;
};

/* Integer parameters that default to 0 are switches: set all of them to 1. @return their number */
static uint32_t turn_on(const struct hook *hook, struct scene_parameter list[HOOK_MAX_PARAMETERS])
{
	uint32_t n = 0;

	for (unsigned i = 0; i < hook->n_parameters; i++)
		if (hook->parameters[i].type == HOOK_INT && hook->parameters[i].initial[0] == 0)
			list[n++] = (struct scene_parameter){ .name = hook->parameters[i].name, .value = { 1 }, .count = 1 };
	return n;
}

/* is_on: with what its parameters turn on */
static int draw(struct tracer *tracer, const struct hook *hook, enum check_scene scene, int is_on)
{
	struct scene_parameter list[HOOK_MAX_PARAMETERS];
	const uint32_t n = is_on ? turn_on(hook, list) : 0;
	struct check_world *world = malloc(sizeof(*world));
	struct image img = { .width = 0 };
	int err = world ? check_world_make(scene, WIDTH, HEIGHT, RINGS, world) : err_report(ERR_SYSTEM, NULL, "out of memory");

	if (!err) {
		world->options.hook = hook;
		world->made.scene.parameters = list;
		world->made.scene.n_parameters = world->made.scene.n_shared_parameters = n;
		err = tracer_render(tracer, &world->made.scene, &world->options, &img);
		image_free(&img);
		check_world_free(world);
	}
	free(world);
	return err;
}

static void try_apart(void *user)
{
	struct trial *t = user;
	struct device *dev = NULL;
	struct tracer *tracer = NULL;
	int err;

	err = options_confine(&table, t->line, CONFINE_TRACER, NULL); /* here: who waits must be able to end this process */
	if (!err)
		err = device_open(t->device, 0, &dev);
	if (!err)
		err = outcome_choose_known(dev);
	if (!err)
		err = device_take_hook(dev, t->hook);
	if (!err)
		err = tracer_create(&tracer, dev);
	if (!err)
		err = draw(tracer, t->hook, CHECK_OPAQUE, 0);
	t->step = 1;
	if (!err)
		err = draw(tracer, t->hook, CHECK_MIRROR, 1);
	t->err = err;
	t->step = 2;
	tracer_destroy(&tracer);
	device_close(&dev);
}

static void describe(const struct hook *h)
{
	int n = 0;

	printf("%s: ", h->path);
	for (int i = 0; i < N_HOOK_STAGES; i++)
		if (h->stages >> i & 1)
			printf("%s%s", n++ ? ", " : "", hook_stage_names[i]);
	for (unsigned i = 0; i < h->n_parameters; i++)
		printf("%s%s %s", i ? ", " : "; parameters: ", hook_type_names[h->parameters[i].type], h->parameters[i].name);
	printf("; it runs\n");
}

static int check(const struct asked *o, const struct options_line *line, const struct hook *hook)
{
	const unsigned seconds = o->seconds ? o->seconds : SECONDS;
	struct trial *t = apart_alloc(sizeof(*t));
	enum apart_end end;
	int err;

	if (!t)
		return ERR_SYSTEM;
	*t = (struct trial){ .hook = hook, .device = o->device, .line = line };
	end = apart_run(try_apart, t, &t->step, seconds);
	err = t->err;
	if (end == APART_LATE)
		err = err_report(ERR_INPUT, hook->path,
		                 "did not end within %u s; is there an endless loop? (--seconds gives it more)",
		                 seconds);
	else if (end == APART_DIED && t->step < 2)
		err = err_report(ERR_INPUT, hook->path,
		                 "ended the process that ran it; an access out of bounds? Oclgrind would tell");
	else if (!err)
		describe(hook);
	apart_free(t, sizeof(*t));
	return err;
}

int hook_main(int argc, char **argv)
{
	struct asked o = { .device = NULL };
	struct options_line line;
	struct hook *hook = NULL;
	int err = options_parse(&table, argc, argv, &o, &line);

	if (!err)
		err = hook_load(line.words[0], &hook);
	if (!err && device_is_reference(o.device))
		err = hook_compile_host(hook);
	if (!err)
		err = check(&o, &line, hook);
	hook_free(&hook);
	return err > 0 ? 0 : -err;
}
