/* relume scene: the scene of a frame, as text or JSON. */
#include <getopt.h>
#include <stdio.h>

#include "base/err.h"
#include "base/frames.h"
#include "base/verbs.h"
#include "replay/replay.h"
#include "scene/json.h"

static void print_help(void)
{
	puts("usage: relume scene [OPTIONS] TRACE\n"
	     "\n"
	     "Print what one frame draws: views, clears, instances with their meshes and materials, textures.\n"
	     "\n"
	     "  -f, --frame N   which frame, from 0 (default 0)\n"
	     "  -j, --json      everything, as JSON; otherwise one line per instance\n"
	     "  -v, --vertices  with --json: the meshes' arrays too\n"
	     "  -h, --help      this text");
}

int scene_main(int argc, char **argv)
{
	static const struct option options[] = {
		{ "frame", required_argument, NULL, 'f' }, { "json", no_argument, NULL, 'j' },
		{ "vertices", no_argument, NULL, 'v' },    { "help", no_argument, NULL, 'h' }, { 0 },
	};
	struct scene *scene = NULL;
	uint64_t frame = 0;
	int json = 0, vertices = 0, opt, rc;

	while ((opt = getopt_long(argc, argv, "f:jvh", options, NULL)) != -1) {
		switch (opt) {
		case 'f':
			if (frame_number_parse(optarg, &frame))
				return -ERR_USAGE;
			break;
		case 'j':
			json = 1;
			break;
		case 'v':
			vertices = 1;
			break;
		case 'h':
			print_help();
			return 0;
		default:
			return -ERR_USAGE;
		}
	}
	if (argc - optind != 1)
		return -err_report(ERR_USAGE, NULL, "scene takes one trace; 'relume help scene' says more");
	rc = replay_one_frame(argv[optind], frame, &scene);
	if (rc)
		return -rc;
	if (json)
		scene_write_json(stdout, scene, vertices);
	else
		scene_write_text(stdout, scene);
	scene_release(&scene);
	return 0;
}
