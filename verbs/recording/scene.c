/* relume scene: print the scene of a frame, as text or JSON. */
#include <stdio.h>

#include "base/options.h"
#include "base/verbs.h"
#include "replay/replay.h"
#include "scene/json.h"
#include "scene/release.h"

struct asked {
	uint64_t frame;
	int json, vertices;
};

static const struct options_row rows[] = {
	{ "frame", 'f', "N", "which frame, from 0 (default 0)", options_frame, .at = offsetof(struct asked, frame) },
	{ "json", 'j', NULL, "everything, as JSON; otherwise one line per instance", options_flag,
	  .at = offsetof(struct asked, json) },
	{ "vertices", 'v', NULL, "with --json: include the meshes' arrays", options_flag,
	  .at = offsetof(struct asked, vertices) },
	{ OPTIONS_NO_SANDBOX },
};

static const struct options_table table = {
	.verb = "scene",
	.head = "usage: relume scene [OPTIONS] TRACE\n"
	        "\n"
	        "Print what one frame draws: views, clears, instances with their meshes and materials, textures.\n",
	OPTIONS_ROWS(rows),
	.takes = "one trace", .least = 1, .most = 1, .words_use = CONFINE_RECORDING,
};

int scene_main(int argc, char **argv)
{
	struct asked o = { 0 };
	struct options_line line;
	struct scene *scene = NULL;
	int rc = options_parse(&table, argc, argv, &o, &line);

	if (!rc)
		rc = options_confine(&table, &line, CONFINE_READER, NULL);
	if (!rc)
		rc = replay_one_frame(line.words[0], o.frame, &scene);
	if (!rc && o.json)
		scene_write_json(stdout, scene, o.vertices);
	else if (!rc)
		scene_write_text(stdout, scene);
	scene_release(&scene);
	return rc > 0 ? 0 : -rc;
}
