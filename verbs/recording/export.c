/* relume export: write a frame as glTF 2.0. */

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "base/err.h"
#include "base/folder.h"
#include "base/part.h"
#include "base/options.h"
#include "base/verbs.h"
#include "scene/gltf.h"
#include "replay/replay.h"
#include "scene/release.h"

struct export {
	uint64_t frame;
	const char *output;
};

static const struct options_row rows[] = {
	{ "frame", 'f', "N", "which frame, from 0 (default 0)", options_frame, .at = offsetof(struct export, frame) },
	{ "output", 'o', "FILE", "the file, created when complete", options_text,
	  .at = offsetof(struct export, output), .is_required = 1, .use = CONFINE_MAKES },
	{ OPTIONS_NO_SANDBOX },
};

static const struct options_table table = {
	.verb = "export",
	.head = "usage: relume export [OPTIONS] -o FILE.glb TRACE\n"
	        "\n"
	        "Write one frame as binary glTF 2.0, for modellers and other renderers: meshes, materials, textures,\n"
	        "cameras and lights. What glTF cannot express is left out and listed.\n",
	OPTIONS_ROWS(rows),
	.takes = "one trace and -o FILE.glb", .least = 1, .most = 1, .words_use = CONFINE_RECORDING,
};

static void report_losses(const char *where, const struct gltf_losses *l)
{
	const struct {
		uint32_t n;
		const char *what;
	} losses[] = {
		{ l->no_color, "draws write no colour: left out" },
		{ l->texgen, "draws generate texture coordinates: exported without that texture" },
		{ l->more_units, "draws use several textures: exported with one" },
		{ l->blended, "draws use other blending than source alpha: exported with source alpha" },
		{ l->fogged, "draws are in fog: exported without" },
		{ l->infinite, "vertices are at infinity or behind it: their primitives are left out" },
	};

	for (size_t i = 0; i < sizeof(losses) / sizeof(losses[0]); i++)
		if (losses[i].n)
			err_warn(where, "%u %s", losses[i].n, losses[i].what);
}

static int write_file(const char *path, const struct scene *scene)
{
	struct gltf_losses losses;
	struct part_file file;
	struct stat info;
	int rc = folder_make_for(path);

	if (!rc)
		rc = part_open(&file, path);
	if (!rc)
		rc = part_close(&file, gltf_write(file.stream, path, scene, &losses));
	if (rc)
		return rc;
	report_losses(path, &losses);
	if (stat(path, &info) == 0)
		fprintf(stderr, "%s: frame %" PRIu64 ", %.2g MiB\n", path, scene->frame, (double)info.st_size / (1 << 20));
	return 0;
}

/* Binary glTF is the only form that is written. */
static int check_name(const char *path)
{
	const char *ending = strrchr(path, '.');

	return ending && strcasecmp(ending, ".glb") == 0 ?
	               0 :
	               err_report(ERR_USAGE, NULL, "'%s' is not a binary glTF file; its name must end in .glb", path);
}

int export_main(int argc, char **argv)
{
	struct export o = { 0 };
	struct options_line line;
	struct scene *scene = NULL;
	int rc = options_parse(&table, argc, argv, &o, &line);

	if (!rc)
		rc = check_name(o.output);
	if (!rc)
		rc = options_confine(&table, &line, CONFINE_READER, NULL);
	if (!rc)
		rc = replay_one_frame(line.words[0], o.frame, &scene);
	if (!rc)
		rc = write_file(o.output, scene);
	scene_release(&scene);
	return rc > 0 ? 0 : -rc;
}
