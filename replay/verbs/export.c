/* relume export: a frame as glTF 2.0. */
#include <errno.h>
#include <getopt.h>
#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "base/err.h"
#include "base/folder.h"
#include "base/frames.h"
#include "base/part.h"
#include "base/verbs.h"
#include "scene/gltf.h"
#include "replay/replay.h"

static void print_help(void)
{
	puts("usage: relume export [OPTIONS] -o FILE.glb TRACE\n"
	     "\n"
	     "Write one frame as binary glTF 2.0, for modellers and other renderers: meshes, materials, textures,\n"
	     "cameras and lights. What glTF has no words for is left out and named.\n"
	     "\n"
	     "  -f, --frame N      which frame, from 0 (default 0)\n"
	     "  -o, --output FILE  the file; appears when it is whole\n"
	     "  -h, --help         this text");
}

static void report_losses(const char *where, const struct gltf_losses *l)
{
	const struct {
		uint32_t n;
		const char *what;
	} losses[] = {
		{ l->no_color, "draws write no colour: left out" },
		{ l->texgen, "draws generate texture coordinates: exported without that texture" },
		{ l->more_units, "draws use several textures: exported with one" },
		{ l->blended, "draws blend otherwise than by source alpha: exported as blended by source alpha" },
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
	char part[PATH_MAX];
	FILE *out;
	int rc = folder_make_for(path);

	if (!rc)
		rc = part_begin(path, part, sizeof(part));
	if (rc)
		return rc;
	out = fopen(part, "wb");
	if (!out)
		return err_report(ERR_SYSTEM, path, "cannot be written: %s", strerror(errno));
	rc = gltf_write(out, path, scene, &losses);
	if (fclose(out) && !rc)
		rc = err_report(ERR_SYSTEM, path, "cannot be written: %s", strerror(errno));
	if (rc) {
		part_drop(part);
		return rc;
	}
	report_losses(path, &losses);
	return part_finish(part, path);
}

int export_main(int argc, char **argv)
{
	static const struct option options[] = {
		{ "frame", required_argument, NULL, 'f' },
		{ "output", required_argument, NULL, 'o' },
		{ "help", no_argument, NULL, 'h' },
		{ 0 },
	};
	struct scene *scene = NULL;
	const char *output = NULL;
	uint64_t frame = 0;
	int opt, rc;

	while ((opt = getopt_long(argc, argv, "f:o:h", options, NULL)) != -1) {
		switch (opt) {
		case 'f':
			if (frame_number_parse(optarg, &frame))
				return -ERR_USAGE;
			break;
		case 'o':
			output = optarg;
			break;
		case 'h':
			print_help();
			return 0;
		default:
			return -ERR_USAGE;
		}
	}
	if (argc - optind != 1 || !output)
		return -err_report(ERR_USAGE, NULL, "export takes one trace and -o FILE.glb; 'relume help export' says more");
	rc = replay_one_frame(argv[optind], frame, &scene);
	if (!rc)
		rc = write_file(output, scene);
	scene_release(&scene);
	return -rc;
}
