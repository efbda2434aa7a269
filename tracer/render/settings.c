#include "tracer/render/settings.h"

#include <errno.h>
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "base/err.h"
#include "tracer/accel/builders.h"

#define ACCEL_LINE(kind, name, build, spare, keep_from, help) "                         " name ": " help "\n"
static const char help[] =
	"usage: relume render TRACE [-f FRAMES] -o PATTERN [OPTIONS]\n"
	"\n"
	"Ray trace frames of a recording to OpenEXR.\n"
	"\n"
	"What:\n"
	"  -f, --frames LIST    frames, counted from 0: \"7\", \"1-500\", \"1-500x5\", with commas (default: all)\n"
	"      --chunk I/N      only the I-th of N parts of them, as for a task of a farm\n"
	"  -o, --output PATTERN file names: ####, %04d, $F4 or {frame} stand for the frame number\n"
	"      --skip-existing  leave out frames whose file is whole and of the same trace, settings and version\n"
	"      --force          render all, the opposite of --skip-existing (default)\n"
	"      --dry-run        only say what would be done, a line for each frame\n"
	"How the picture is made:\n"
	"      --mode MODE      whitted: GL's picture with shadows, mirrors and glass (default); gl: GL's picture alone;\n"
	"                       normals; ao: how open surfaces are; ao-phong: the same over GL's picture;\n"
	"                       diffuse: whitted, and one bounce of light between surfaces; path: all bounces\n"
	"      --encoding E     linear (default) or display (GL's own numbers)\n"
	"      --aov LIST       channel groups beside R G B A: gl,shadow,relight,reflect,refract,Z,N,P,albedo,id,\n"
	"                       layers (default: all)\n"
	"      --depth N        bounces at most (default 4)\n"
	"      --samples N      samples of a pixel, spread otherwise in each, of which it is the mean (default 1); gl, Z, N,\n"
	"                       P, albedo and id stay those of pixel centres\n"
	"      --rays N         rays to each light that has a radius, and around each point in the ao modes, a sample\n"
	"                       (default 16)\n"
	"      --reach X        how far the ao modes look, in units of eye space (default: without end)\n"
	"      --look FILE      rules, YAML: what surfaces are made of, lights added, moved, off or with a size\n"
	"                       (look/look.h shows all keys)\n"
	"      --accel KIND     how trees of meshes are built (default: kd from where the program calls rtBuildKdTreeEXT, else\n"
	"                       bvh). What moves gets a binned one. The picture is the same\n"
	TREE_BUILDERS(ACCEL_LINE)
	"      --relight        light each pixel (Phong), not vertices: channel relight tells the difference\n"
	"On what:\n"
	"      --device LIST    devices that share the frames, by number, type or part of the name as 'relume devices' lists\n"
	"                       them, with commas; \"all\"; \"reference\": no OpenCL (default: the first GPU, else CPU)\n"
	"      --kernels FAMILY traversal kernels: packets (default on a CPU), binary, compressed (default on a GPU);\n"
	"                       the pictures are the same\n"
	"      --threads N      compute threads of a CPU device (default: all cores)\n"
	"  -j, --jobs N         frames on their way at once on each device (default: by the number of cores)\n"
	"      --limit-memory M memory to keep to, as 800M or 4G: fewer frames on their way at once; a frame that needs\n"
	"                       more by itself ends the run\n"
	"      --cache DIR      where trees of large meshes, and compiled kernels, are kept for other runs; processes and machines\n"
	"                       may share it (default: relume/trees and relume/kernels in $XDG_CACHE_HOME, or in ~/.cache;\n"
	"                       PoCL keeps kernels itself)\n"
	"      --cache-size M   what that folder may hold: unused trees go first (default 2G)\n"
	"      --no-cache       keep nothing, and look for nothing\n"
	"      --timeout-per-frame S  give up a frame after so many seconds, and go on with the next\n"
	"      --progress WORD  bar, lines, json (on standard output) or none (default: bar on a terminal, else lines)\n"
	"  -h, --help           this text\n"
	"\n"
	"Files appear whole or not at all. On SIGINT or SIGTERM files that are being written are finished, frames that are\n"
	"being traced are dropped, and the exit code is 130 or 143; the same command with --skip-existing goes on from there.\n"
	"Exit codes: 0 every frame is there, 2 wrong usage, 3 the trace cannot be read, 5 a device, the disk or the system\n"
	"failed, or a frame was given up, 130 SIGINT, 143 SIGTERM.\n";

/* What an option decides about. */
enum effect {
	PICTURE,      /* the picture, by its text */
	PICTURE_FILE, /* the picture, by the content of the file it names */
	RUN           /* which frames, where to, on what: never a pixel */
};

enum key { FRAMES, CHUNK, OUTPUT, SKIP, FORCE, DRY, MODE, ENCODING, AOV, DEPTH, SAMPLES, RAYS, REACH, LOOK, ACCEL, RELIGHT,
	   DEVICE, KERNELS, THREADS, JOBS, MEMORY, CACHE, CACHE_SIZE, NO_CACHE, TIMEOUT, PROGRESS, HELP, N_KEYS };

#define FIRST_KEY 256 /* what getopt_long returns for the first row */

static const struct row {
	const char *name;
	int has_arg;
	enum effect effect;
	char letter;
} rows[N_KEYS] = {
	[FRAMES] = { "frames", required_argument, RUN, 'f' },
	[CHUNK] = { "chunk", required_argument, RUN, 0 },
	[OUTPUT] = { "output", required_argument, RUN, 'o' },
	[SKIP] = { "skip-existing", no_argument, RUN, 0 },
	[FORCE] = { "force", no_argument, RUN, 0 },
	[DRY] = { "dry-run", no_argument, RUN, 0 },
	[MODE] = { "mode", required_argument, PICTURE, 0 },
	[ENCODING] = { "encoding", required_argument, PICTURE, 0 },
	[AOV] = { "aov", required_argument, PICTURE, 0 },
	[DEPTH] = { "depth", required_argument, PICTURE, 0 },
	[SAMPLES] = { "samples", required_argument, PICTURE, 0 },
	[RAYS] = { "rays", required_argument, PICTURE, 0 },
	[REACH] = { "reach", required_argument, PICTURE, 0 },
	[LOOK] = { "look", required_argument, PICTURE_FILE, 0 },
	[ACCEL] = { "accel", required_argument, RUN, 0 }, /* no hit depends on the tree that found it (kernels/rays/rays.h) */
	[RELIGHT] = { "relight", no_argument, PICTURE, 0 },
	[DEVICE] = { "device", required_argument, RUN, 0 },
	[KERNELS] = { "kernels", required_argument, RUN, 0 },
	[THREADS] = { "threads", required_argument, RUN, 0 },
	[JOBS] = { "jobs", required_argument, RUN, 'j' },
	[MEMORY] = { "limit-memory", required_argument, RUN, 0 },
	[CACHE] = { "cache", required_argument, RUN, 0 },
	[CACHE_SIZE] = { "cache-size", required_argument, RUN, 0 },
	[NO_CACHE] = { "no-cache", no_argument, RUN, 0 },
	[TIMEOUT] = { "timeout-per-frame", required_argument, RUN, 0 },
	[PROGRESS] = { "progress", required_argument, RUN, 0 },
	[HELP] = { "help", no_argument, RUN, 'h' },
};

/* --- Values -------------------------------------------------------------------------------------------------------- */

static int parse_number(const char *text, const char *option, unsigned most, unsigned *out)
{
	char *end;
	unsigned long value;

	errno = 0;
	value = strtoul(text, &end, 10);
	if (errno || end == text || *end || *text == '-' || value > most)
		return err_report(ERR_USAGE, NULL, "--%s takes a number up to %u, not '%s'", option, most, text);
	*out = (unsigned)value;
	return 0;
}

static int parse_word(const char *text, const char *option, const char *const *words, int *out)
{
	for (int i = 0; words[i]; i++)
		if (strcmp(text, words[i]) == 0) {
			*out = i;
			return 0;
		}
	return err_report(ERR_USAGE, NULL, "--%s does not know '%s'; see 'relume help render'", option, text);
}

static int parse_bytes(const char *text, const char *option, uint64_t *out)
{
	static const char units[] = "KMGT";
	char *end;
	double value = strtod(text, &end);
	const char *unit = *end ? strchr(units, *end & ~0x20) : NULL;

	if (end == text || !(value > 0) || (*end && (!unit || end[1])) || value > 1e15)
		return err_report(ERR_USAGE, NULL, "--%s takes a size as 800M or 4G, not '%s'", option, text);
	for (const char *u = units; unit && u <= unit; u++)
		value *= 1024;
	*out = (uint64_t)value;
	return 0;
}

static int parse_seconds(const char *text, double *out)
{
	char *end;

	*out = strtod(text, &end);
	if (end == text || *end || !(*out > 0) || *out > 1e9)
		return err_report(ERR_USAGE, NULL, "--timeout-per-frame takes seconds, not '%s'", text);
	return 0;
}

static int parse_length(const char *text, const char *option, float *out)
{
	char *end;

	*out = strtof(text, &end);
	if (end == text || *end || !(*out > 0) || *out > 1e30f)
		return err_report(ERR_USAGE, NULL, "--%s takes a length above 0, not '%s'", option, text);
	return 0;
}

int settings_parse_mode(const char *word, enum tracer_mode *out)
{
	static const char *const modes[] = { "whitted", "gl", "normals", "ao", "ao-phong", "diffuse", "path", NULL };
	int mode = 0, err = parse_word(word, rows[MODE].name, modes, &mode);

	*out = (enum tracer_mode)mode;
	return err;
}

static int parse_option(struct settings *s, enum key key, const char *value)
{
	static const char *const encodings[] = { "linear", "display", NULL };
	const char *name = rows[key].name;
	int err = 0, word = 0;

	switch (key) {
	case FRAMES:
		frame_list_free(&s->frames);
		return frame_list_parse(value, &s->frames);
	case CHUNK: return frame_chunk_parse(value, &s->chunk, &s->n_chunks);
	case OUTPUT: s->output = value; return 0;
	case SKIP: s->skip_existing = 1; return 0;
	case FORCE: s->skip_existing = 0; return 0;
	case DRY: s->dry_run = 1; return 0;
	case MODE: return settings_parse_mode(value, &s->tracer.mode);
	case ENCODING: return parse_word(value, name, encodings, &s->tracer.display);
	case AOV: s->tracer.aov = value; return tracer_check_aov(value);
	case DEPTH: return parse_number(value, name, 64, &s->tracer.depth);
	case SAMPLES: return parse_number(value, name, 65536, &s->tracer.samples);
	case RAYS: return parse_number(value, name, 4096, &s->tracer.rays);
	case REACH: return parse_length(value, name, &s->tracer.reach);
	case LOOK:
		look_free(&s->look);
		err = look_load(value, &s->look);
		s->tracer.look = s->look;
		return err;
	case ACCEL:
		err = parse_word(value, name, accel_kind_names, &word);
		s->tracer.accel = (enum accel_kind)word;
		s->tracer.accel_asked = 1;
		return err;
	case RELIGHT: s->tracer.relight = 1; return 0;
	case DEVICE: s->device = value; return 0;
	case KERNELS: s->has_family = 1; return device_parse_family(value, &s->family);
	case THREADS: return parse_number(value, name, 1024, &s->threads);
	case JOBS: return parse_number(value, name, 64, &s->jobs);
	case MEMORY: return parse_bytes(value, name, &s->memory_bytes);
	case CACHE:
		s->cache = value;
		return *value ? 0 : err_report(ERR_USAGE, NULL, "--cache takes a folder, not an empty name");
	case CACHE_SIZE: return parse_bytes(value, name, &s->cache_bytes);
	case NO_CACHE: s->no_cache = 1; return 0;
	case TIMEOUT: return parse_seconds(value, &s->frame_s);
	case PROGRESS:
		word = progress_style_of(value);
		if (word < 0)
			return err_report(ERR_USAGE, NULL, "--progress takes bar, lines, json or none, not '%s'", value);
		s->progress = (enum progress_style)word;
		return 0;
	default: return 0;
	}
}

/* --- The name of the settings -------------------------------------------------------------------------------------- */

static int hash_file(XXH3_state_t *state, const char *path)
{
	FILE *file = fopen(path, "rb");
	char piece[4096];
	size_t n;

	if (!file)
		return err_report(ERR_INPUT, path, "%s", strerror(errno));
	while ((n = fread(piece, 1, sizeof(piece), file)))
		XXH3_128bits_update(state, piece, n);
	fclose(file);
	return 0;
}

/* given[key]: the last value of each option, "" for one without, NULL where it was not given. */
static int name_settings(struct settings *s, const char *const given[N_KEYS])
{
	XXH3_state_t *state = XXH3_createState();
	XXH128_hash_t hash;
	int err = 0;

	if (!state)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	XXH3_128bits_reset(state);
	for (int key = 0; key < N_KEYS && !err; key++) {
		if (!given[key] || rows[key].effect == RUN)
			continue;
		XXH3_128bits_update(state, rows[key].name, strlen(rows[key].name) + 1);
		if (rows[key].effect == PICTURE_FILE)
			err = hash_file(state, given[key]);
		else
			XXH3_128bits_update(state, given[key], strlen(given[key]) + 1);
	}
	hash = XXH3_128bits_digest(state);
	snprintf(s->hash, sizeof(s->hash), "%016llx%016llx", (unsigned long long)hash.high64, (unsigned long long)hash.low64);
	XXH3_freeState(state);
	return err;
}

/* --- The command line ---------------------------------------------------------------------------------------------- */

static enum key key_of(int c)
{
	if (c >= FIRST_KEY)
		return (enum key)(c - FIRST_KEY);
	for (int key = 0; key < N_KEYS; key++)
		if (rows[key].letter == c)
			return (enum key)key;
	return N_KEYS;
}

int settings_parse(struct settings *s, int argc, char **argv)
{
	struct option longs[N_KEYS + 1] = { { 0 } };
	const char *given[N_KEYS] = { NULL };
	int c, err = 0;

	for (int key = 0; key < N_KEYS; key++)
		longs[key] = (struct option){ rows[key].name, rows[key].has_arg, NULL, FIRST_KEY + key };
	s->tracer.depth = 4;
	optind = 1;
	while (!err && (c = getopt_long(argc, argv, "f:o:j:h", longs, NULL)) != -1) {
		enum key key = key_of(c);

		if (key == N_KEYS)
			return ERR_USAGE;
		if (key == HELP) {
			fputs(help, stdout);
			return 1;
		}
		given[key] = optarg ? optarg : "";
		err = parse_option(s, key, given[key]);
	}
	if (err)
		return err;
	if (argc - optind != 1 || !s->output) {
		fputs(help, stderr);
		return ERR_USAGE;
	}
	s->trace = argv[optind];
	if (!frame_pattern_has_number(s->output) &&
	    !(s->frames.n_ranges == 1 && s->frames.ranges[0].first == s->frames.ranges[0].last))
		return err_report(ERR_USAGE, NULL, "'%s' holds no place for the frame number (####, %%04d, $F4 or {frame})",
		                  s->output);
	return name_settings(s, given);
}

void settings_free(struct settings *s)
{
	frame_list_free(&s->frames);
	look_free(&s->look);
}
