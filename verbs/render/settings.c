#include "verbs/render/settings.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "base/err.h"
#include "base/hash.h"
#include "base/options.h"
#include "look/camera/camera.h"
#include "look/camera/lens.h"
#include "look/camera/scaled.h"
#include "look/rules/join.h"
#include "look/rules/rules.h"
#include "tracer/accel/builders.h"
#include "tracer/hook/host.h"
#include "verbs/film/filter.h"
#include "verbs/film/oidn.h"

/* Effect of an option. A row that does not name one affects the picture. */
enum effect {
	PICTURE,      /* the picture, by its text */
	PICTURE_FILE, /* the picture, by the content of the file it names */
	RUN           /* frames, files, devices: never a pixel */
};

const char *const settings_mode_names[] = { "whitted", "gl", "normals", "ao", "ao-phong", "diffuse", "path", NULL };
static const char *const encoding_names[] = { "linear", "display", NULL };

/* --- Values ------------------------------------------------------------------------------------------------------ */

static int take_chunk(const struct options_row *row, const char *value, void *out)
{
	struct settings *s = out;

	(void)row;
	return frame_chunk_parse(value, &s->chunk, &s->n_chunks);
}

/* 1 if a list's word is one of ours; then the flag is set. */
static int take_word(const char *at, size_t length, const char *word, int *flag)
{
	const int is_it = length == strlen(word) && strncmp(at, word, length) == 0;

	*flag |= is_it;
	return is_it;
}

/* The groups that the tracer makes; if there are none, it makes all. Cryptomatte comes from channel id, motion from
 * id and P. */
static int take_aov(const struct options_row *row, const char *value, void *out)
{
	struct settings *s = out;
	size_t n = 0, groups = 0;

	(void)row;
	free(s->aov);
	s->cryptomatte = s->motion = s->caustics = 0;
	s->aov = malloc(strlen(value) + sizeof(",id,P,N,P,albedo"));
	if (!s->aov)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (const char *at = value; *at; at += *at == ',') {
		const size_t length = strcspn(at, ",");
		const int is_ours = take_word(at, length, "cryptomatte", &s->cryptomatte) ||
		                    take_word(at, length, "motion", &s->motion) ||
		                    take_word(at, length, "caustics", &s->caustics);

		if (!is_ours)
			n += (size_t)sprintf(s->aov + n, "%s%.*s", groups++ ? "," : "", (int)length, at);
		at += length;
	}
	s->aov[n] = '\0';
	s->tracer.aov = groups || !(s->cryptomatte || s->motion || s->caustics) ? s->aov : NULL;
	if (tracer_check_aov(s->aov))
		return ERR_USAGE;
	if (groups && (s->cryptomatte || s->motion))
		strcat(s->aov, s->motion ? ",id,P" : ",id");
	if (groups && s->caustics)
		strcat(s->aov, ",N,P,albedo");
	return 0;
}

static int take_length(const struct options_row *row, const char *value, void *out)
{
	float *length = out;
	char *end;

	*length = strtof(value, &end);
	if (end == value || *end || !(*length > 0) || *length > 1e30f)
		return err_report(ERR_USAGE, NULL, "--%s takes a length above 0, not '%s'", row->name, value);
	return 0;
}

static int take_seconds(const struct options_row *row, const char *value, void *out)
{
	double *seconds = out;
	char *end;

	*seconds = strtod(value, &end);
	if (end == value || *end || !(*seconds > 0) || *seconds > 1e9)
		return err_report(ERR_USAGE, NULL, "--%s takes seconds, not '%s'", row->name, value);
	return 0;
}

static int take_look(const struct options_row *row, const char *value, void *out)
{
	struct settings *s = out;
	struct look *more = NULL;
	int err;

	if (s->n_looks == SETTINGS_MOST_LOOKS)
		return err_report(ERR_USAGE, NULL, "--%s: at most %d of them", row->name, SETTINGS_MOST_LOOKS);
	s->looks[s->n_looks++] = value;
	if (strcmp(value, "auto") == 0) {
		s->look_auto = 1;
		return 0;
	}
	err = rules_load(value, &more);
	if (!err)
		err = rules_join(s->look_auto ? &s->look_after : &s->look, &more);
	rules_free(&more);
	return err;
}

static int take_hook(const struct options_row *row, const char *value, void *out)
{
	struct settings *s = out;

	(void)row;
	hook_free(&s->hook);
	return hook_load(value, &s->hook);
}

static int take_size(const struct options_row *row, const char *value, void *out)
{
	uint32_t *size = out;
	char end;

	if (sscanf(value, "%5" SCNu32 "x%5" SCNu32 "%c", &size[0], &size[1], &end) == 2 && size[0] && size[1] &&
	    size[0] <= SCALED_MOST && size[1] <= SCALED_MOST)
		return 0;
	return err_report(ERR_USAGE, NULL, "--%s takes WIDTHxHEIGHT, up to %ux%u, not '%s'", row->name, SCALED_MOST,
	                  SCALED_MOST, value);
}

static int take_camera(const struct options_row *row, const char *value, void *out)
{
	struct settings *s = out;

	(void)row;
	camera_free(&s->camera);
	return camera_load(value, &s->camera);
}

static int take_accel(const struct options_row *row, const char *value, void *out)
{
	struct tracer_options *tracer = out;

	tracer->accel_asked = 1;
	return options_word(row, value, &tracer->accel);
}

static int take_folder(const struct options_row *row, const char *value, void *out)
{
	options_text(row, value, out);
	return *value ? 0 : err_report(ERR_USAGE, NULL, "--%s takes a folder, not an empty name", row->name);
}

static int take_progress(const struct options_row *row, const char *value, void *out)
{
	const int style = progress_style_of(value);

	if (style < 0)
		return err_report(ERR_USAGE, NULL, "--%s takes bar, lines, json or none, not '%s'", row->name, value);
	*(enum progress_style *)out = (enum progress_style)style;
	return 0;
}

/* As of 'relume devices --check'. Compilers of OpenCL take 20 s for a program, and several times that on slow
 * machines. */
#define DRIVER_S 300

/* Most samples of a pixel; the default if sampling may stop earlier. */
#define MOST_SAMPLES 65536

/* --- The options ------------------------------------------------------------------------------------------------- */

#define ACCEL_TEXT(kind, name, build, spare, keep_from, help) name " (" help "), "
#define AT(member) .at = offsetof(struct settings, member)

static const struct options_row rows[] = {
	{ .help = "What:" },
	{ "frames", 'f', "LIST",
	  "frames, counted from 0: \"7\", \"1-500\", \"55-\" to the end, \"1-500x5\", with commas (default: all)",
	  options_frames, AT(frames), .kind = RUN },
	{ "chunk", 0, "I/N", "only the I-th of N parts of them, as for a task of a farm", take_chunk, .at = 0,
	  .kind = RUN },
	{ "output", 'o', "PATTERN",
	  "file names: ####, %04d, $F4 or {frame} stand for the frame number; .exr holds all channels, .png and .jpg "
	  "a picture to look at",
	  options_text, AT(output), .kind = RUN, .is_required = 1, .use = CONFINE_MAKES },
	{ "preview", 0, "PATTERN",
	  "file that shows a frame's picture while samples still come in: .exr, .png or .jpg, always complete, "
	  "rewritten each time their number has grown by half",
	  options_text, AT(preview), .kind = RUN, .use = CONFINE_MAKES },
	{ "skip-existing", 0, NULL, "leave out frames whose file is whole and of the same trace, settings and version",
	  options_flag, AT(skip_existing), .kind = RUN },
	{ "force", 0, NULL, "render all, the opposite of --skip-existing (default)", options_clear, AT(skip_existing),
	  .kind = RUN },
	{ "allow-incomplete", 0, NULL, "exit with 0 where draws that Relume does not do are missing", options_flag,
	  AT(allow_incomplete), .kind = RUN },
	{ "dry-run", 0, NULL, "only say what would be done, a line for each frame", options_flag, AT(dry_run),
	  .kind = RUN, .use = CONFINE_DRY },
	{ .help = "How the picture is made:" },
	{ "mode", 0, "MODE",
	  "whitted: GL's picture with shadows, mirrors and glass (default); gl: GL's picture alone; normals; ao: how open "
	  "surfaces are; ao-phong: the same over GL's picture; diffuse: whitted, and one bounce of light between surfaces; "
	  "path: all bounces, followed in linear light (with --encoding display in GL's own numbers)",
	  options_word, AT(tracer.mode), .words = settings_mode_names },
	{ "encoding", 0, "E", "linear (default) or display (GL's own numbers)", options_word, AT(tracer.display),
	  .words = encoding_names },
	{ "aov", 0, "LIST",
	  "channel groups beside R G B A: gl,shadow,relight,reflect,refract,Z,N,P,albedo,id,layers (default: all; gl is "
	  "enough for scratch frames); with cryptomatte, which draw, mesh and texture a pixel shows, as compositors read "
	  "it; with motion, by how many pixels right and down what a pixel shows has moved since the frame before; with "
	  "caustics, the light that mirrors and glass send to matte surfaces (modes whitted, diffuse and path; no part of R "
	  "G B)",
	  take_aov, .at = 0 },
	{ "photons", 0, "N", "how many find --aov caustics (default 1048576)", options_number, AT(photons), .least = 1,
	  .most = 1u << 30 },
	{ "depth", 0, "N", "bounces at most (default 4)", options_number, AT(tracer.depth), .most = 64 },
	{ "samples", 0, "N",
	  "samples of a pixel, each spread differently; the pixel is their mean (default 1); gl, Z, N, P, albedo "
	  "and id stay those of pixel centres",
	  options_number, AT(tracer.samples), .least = 1, .most = MOST_SAMPLES },
	{ "noise", 0, "X",
	  "stop sampling a frame once its noise, the root mean square of its pixels' standard errors over the mean "
	  "brightness, is at most X, as 0.02; --samples is the most (then 65536 by default)",
	  options_real, AT(tracer.noise), .low = 0, .high = 1e30 },
	{ "time", 0, "S",
	  "begin no sample of a frame that would end later than S seconds after its first; one there is always. How "
	  "many they are is in "
	  "attribute relume:samples, and another run may take more or fewer; with --noise, whichever stops first",
	  take_seconds, AT(tracer.seconds) },
	{ "denoise", 0, NULL,
	  "denoise each frame separately; relume denoise does better if there are several frames",
	  options_flag, AT(denoise) },
	{ "oidn", 0, NULL, "--denoise with Intel's Open Image Denoise 2, if it is installed", options_flag, AT(oidn) },
	{ "rays", 0, "N",
	  "rays of a sample: to each light that has a radius, and around each point in the ao modes (default 16)",
	  options_number, AT(tracer.rays), .least = 1, .most = 4096 },
	{ "clamp", 0, "X",
	  "mode path: no bounce brings a sample more than X times white, but for one in a mirror or glass: that spares "
	  "bright dots, and takes their light; 0: no bound (default 10)",
	  options_real, AT(tracer.clamp), .low = 0, .high = 1e30 },
	{ "reach", 0, "X", "how far the ao modes look, in units of eye space (default: without end)", take_length,
	  AT(tracer.reach) },
	{ "look", 0, "FILE",
	  "rules, YAML: what surfaces are made of, which flat faces are meant round (crease), which meshes have cracks "
	  "(repair), lights added, moved, off or with a "
	  "size ('relume help look-file' lists all keys); \"auto\": those that relume look finds; several apply in "
	  "order, later rules count",
	  take_look, .at = 0, .kind = PICTURE_FILE, .use = CONFINE_READS },
	{ "hook", 0, "FILE",
	  "OpenCL C whose functions take the place of stages: ray_generation (other cameras), bounds and intersection "
	  "(other shapes; modes whitted and path), any_hit, closest_hit, miss, light (modes whitted, diffuse and path). "
	  "'relume hook --check' tries them; 'relume help hook-file' explains them",
	  take_hook, .at = 0, .kind = PICTURE_FILE, .use = CONFINE_READS },
	{ "camera", 0, "FILE",
	  "another camera, YAML: a recorded frame from elsewhere, in perspective or not, with lights and objects in "
	  "place, or many pictures of one frame around it (turntable; -f names the frame, the pictures are numbered from "
	  "0). HUDs are left out. 'relume help camera-file' lists all keys",
	  take_camera, .at = 0, .kind = PICTURE_FILE, .use = CONFINE_READS },
	{ "scale", 0, "X",
	  "as in a window X times the size of the recorded one, HUDs, lines and points included: 4 makes 2560x1920 "
	  "of 640x480. A warning names whatever keeps its pixels",
	  options_real, AT(scale), .low = 1.f / 64, .high = 64 },
	{ "size", 0, "WxH",
	  "as in a window of this size. One of another shape shows more to the sides, or above and below, and has "
	  "HUDs in the middle",
	  take_size, AT(size) },
	{ "fps", 0, "N",
	  "N pictures a second, numbered from 0, from the first frame of -f to the last. Between recorded frames things, "
	  "camera and lights go from where they were to where they are, but for cuts",
	  options_real, AT(fps), .low = 0.01f, .high = 10000 },
	{ "recorded-fps", 0, "N",
	  "with --fps: the recording has N frames a second (default: by the program's clock when it was recorded)",
	  options_real, AT(recorded_fps), .low = 0.01f, .high = 10000 },
	{ "shutter", 0, "X",
	  "motion blur: samples are spread over X of the time from a picture to the next, its own moment in the middle: "
	  "0.5 is a film camera's. What --samples leaves as it is stays that of the moment",
	  options_real, AT(shutter), .low = 0, .high = 1 },
	/* No hit depends on the tree that found it (kernels/rays/rays.h). */
	{ "accel", 0, "KIND",
	  "how trees of meshes are built: " TREE_BUILDERS(
		  ACCEL_TEXT) "by default kd from where the program calls "
	                      "rtBuildKdTreeEXT, else bvh. What moves gets a binned one. The picture is the same",
	  take_accel, AT(tracer), .words = accel_kind_names, .kind = RUN },
	{ "relight", 0, NULL, "light pixels (Phong) instead of vertices; channel relight holds the difference",
	  options_flag, AT(tracer.relight) },
	{ .help = "Pictures to look at (.png, .jpg; sRGB, dithered but in mode gl):" },
	{ "exposure", 0, "STOPS", "brighten by this many stops (default 0), the same for all frames", options_real,
	  AT(display.exposure), .low = -30, .high = 30 },
	{ "white", 0, "X",
	  "the brightness that is shown as white; below it, highlights are compressed (default 1: what GL drew looks as it "
	  "did; 4 in the modes diffuse and path)",
	  options_real, AT(display.white), .low = 1, .high = 10000 },
	{ .help = "On what:" },
	{ "device", 0, "LIST",
	  "devices that share the frames, by number, type or part of the name as 'relume devices' lists them, "
	  "with commas; \"all\"; \"reference\": no OpenCL (default: the first GPU, else CPU)",
	  options_text, AT(device), .kind = RUN },
	{ "kernels", 0, "FAMILY",
	  "traversal kernels: packets, binary or compressed; the pictures are the same (default: the fastest that "
	  "'relume devices --check' found right; where it has not been run, packets on a CPU, compressed on a GPU)",
	  options_word, AT(family), .words = device_family_names, .kind = RUN },
	{ "threads", 0, "N", "compute threads of a CPU device (default: all cores)", options_number, AT(threads),
	  .most = 1024, .kind = RUN },
	{ "jobs", 'j', "N", "frames in flight on each device (default: by the number of cores)", options_number,
	  AT(jobs), .least = 1, .most = 64, .kind = RUN },
	{ "limit-memory", 0, "M",
	  "memory limit, such as 800M or 4G: fewer frames are in flight; a single frame that needs more ends the "
	  "run",
	  options_bytes, AT(memory_bytes), .kind = RUN },
	{ "cache", 0, "DIR",
	  "folder that keeps trees of large meshes, compiled kernels, results of 'relume devices --check' and pixels that "
	  "later frames begin with for other runs; processes and machines may share it (default: relume/trees, kernels, "
	  "devices and pixels in $XDG_CACHE_HOME, or in ~/.cache; PoCL keeps kernels itself)",
	  take_folder, AT(cache), .kind = RUN, .use = CONFINE_FILLS },
	{ "cache-size", 0, "M", "size limit of that folder: unused trees are removed first (default 2G)", options_bytes,
	  AT(cache_bytes), .kind = RUN },
	{ "no-cache", 0, NULL, "use no cache", options_flag, AT(no_cache), .kind = RUN },
	{ "timeout-per-frame", 0, "S", "give up a frame after this many seconds and go on with the next", take_seconds,
	  AT(frame_s), .kind = RUN },
	{ "timeout-driver", 0, "S",
	  "a call of OpenCL that has taken S seconds (default 300) counts as hung where it used as much processor time to "
	  "compile, or the process used none for a fifth of S; the run goes on with another family of kernels",
	  take_seconds, AT(driver_s), .kind = RUN },
	{ "progress", 0, "WORD",
	  "bar, lines, json (on standard output) or none (default: bar on a terminal, else lines)", take_progress,
	  AT(progress), .kind = RUN },
	{ OPTIONS_NO_SANDBOX, .kind = RUN },
};

static const struct options_table table = {
	.verb = "render",
	.head = "usage: relume render TRACE [-f FRAMES] -o PATTERN [OPTIONS]\n"
		"\n"
		"Ray trace frames of a recording to OpenEXR, or to pictures to look at.\n",
	OPTIONS_ROWS(rows),
	.notes = "Files appear whole or not at all. SIGINT and SIGTERM finish the files being written, drop the frames\n"
		 "being traced and end with exit code 130 or 143; the same command with --skip-existing goes on from\n"
		 "there.\n"
		 "An OpenCL driver that crashes, hangs (--timeout-driver) or refuses a program costs a line: the frames\n"
		 "go to the next family of kernels, in a new process, and later runs with this driver and these\n"
		 "kernels take that one at once ('relume devices' names it, 'relume devices --check' looks again). A\n"
		 "frame that no family can draw fails alone. --kernels takes no other family.\n"
		 "Exit codes: 0 every frame is there, 2 wrong usage, 3 the trace cannot be read, 5 a device, the disk "
	         "or the system\n"
		 "failed, or a frame was given up, 6 every frame is there, but draws that Relume does not do are "
	         "missing,\n"
		 "130 SIGINT, 143 SIGTERM.\n",
	.takes = "one trace and -o PATTERN",
	.least = 1,
	.most = 1,
	.words_use = CONFINE_RECORDING,
};

/* --- The name of the settings ------------------------------------------------------------------------------------ */

static int hash_value(XXH3_state_t *state, const struct options_row *row, const char *value)
{
	if (row->kind == PICTURE_FILE && strcmp(value, "auto") != 0)
		return hash_file(value, UINT64_MAX, state);
	XXH3_128bits_update(state, value, strlen(value) + 1);
	return 0;
}

static int name_settings(struct settings *s, const struct options_line *line)
{
	XXH3_state_t *state = XXH3_createState();
	XXH128_hash_t hash;
	int err = 0;

	if (!state)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	XXH3_128bits_reset(state);
	for (size_t i = 0; i < table.n_rows && !err; i++) {
		const int is_look = rows[i].set == take_look;
		const int is_start = s->fps > 0 && rows[i].set == options_frames; /* pictures are counted from there */

		if (!line->given[i] || (rows[i].kind == RUN && !is_start))
			continue;
		XXH3_128bits_update(state, rows[i].name, strlen(rows[i].name) + 1);
		for (unsigned k = 0; k < (is_look ? s->n_looks : 1) && !err; k++)
			err = hash_value(state, &rows[i], is_look ? s->looks[k] : line->given[i]);
	}
	hash = XXH3_128bits_digest(state);
	snprintf(s->hash, sizeof(s->hash), "%016llx%016llx", (unsigned long long)hash.high64, (unsigned long long)hash.low64);
	XXH3_freeState(state);
	return err;
}

/* --- The command line -------------------------------------------------------------------------------------------- */

/* The next word of a comma-separated list. */
static const char *next_word(const char *list)
{
	list += strcspn(list, ",");
	return list + (*list == ',');
}

static int check_caustics(struct settings *s)
{
	if (!s->caustics)
		return s->photons ? err_report(ERR_USAGE, NULL, "--photons is for --aov caustics") : 0;
	if (s->tracer.mode != TRACER_WHITTED && s->tracer.mode != TRACER_DIFFUSE && s->tracer.mode != TRACER_PATH)
		return err_report(ERR_USAGE, NULL, "--aov caustics: mode %s follows no light", settings_mode_names[s->tracer.mode]);
	s->tracer.photons = s->photons ? s->photons : 1u << 20;
	return 0;
}

/* Whether what is to be denoised is there. */
static int check_denoised(struct settings *s)
{
	if (s->tracer.mode == TRACER_GL || s->tracer.mode == TRACER_NORMALS)
		return err_report(ERR_USAGE, NULL, "--denoise: mode %s has no noise", settings_mode_names[s->tracer.mode]);
	for (const char *needed = FILTER_NEEDS; *needed && s->tracer.aov; needed = next_word(needed)) {
		const size_t length = strcspn(needed, ",");
		int is_there = 0;

		for (const char *at = s->tracer.aov; *at && !is_there; at = next_word(at))
			is_there = strcspn(at, ",") == length && strncmp(at, needed, length) == 0;
		if (!is_there)
			return err_report(ERR_USAGE, NULL, "--denoise needs %s; --aov leaves out %.*s", FILTER_NEEDS, (int)length, needed);
	}
	return 0;
}

/* Check that the options a camera needs are given, and none that it cannot have. */
static int check_camera(const struct settings *s)
{
	if (!s->camera)
		return 0;
	if (s->motion)
		return err_report(ERR_USAGE, NULL, "--camera: no motion is known from elsewhere (--aov motion)");
	if (camera_is_in_world(s->camera) && !s->look && !s->look_auto)
		return err_report(ERR_USAGE, s->camera->path,
		                  "space is world: --look with a list `world`, or --look auto, says where that is");
	return 0;
}

int settings_resize(const struct settings *s)
{
	return s->scale > 0 || s->size[0];
}

/* The recorded size changes nothing: the files are the same as without the option. */
static void drop_scale(struct settings *s)
{
	s->scale = 0;
	for (size_t i = 0; i < table.n_rows; i++)
		if (rows[i].name && strcmp(rows[i].name, "scale") == 0)
			s->line.given[i] = NULL;
}

static int check_scale(struct settings *s)
{
	if (s->scale > 0 && s->size[0])
		return err_report(ERR_USAGE, NULL, "--scale and --size say the same: leave out one");
	if (s->scale == 1)
		drop_scale(s);
	if (settings_resize(s) && s->motion)
		return err_report(ERR_USAGE, NULL, "--%s: motion is known of recorded pixels alone (--aov motion)",
		                  s->scale > 0 ? "scale" : "size");
	return 0;
}

static int check_moments(const struct settings *s)
{
	if (s->recorded_fps > 0 && !(s->fps > 0))
		return err_report(ERR_USAGE, NULL, "--recorded-fps is for --fps");
	if (s->fps > 0 && camera_pictures(s->camera))
		return err_report(ERR_USAGE, s->camera->path, "a turntable shows one frame: there is no --fps");
	if (s->shutter > 0 && camera_pictures(s->camera))
		return err_report(ERR_USAGE, s->camera->path, "a turntable shows one moment: there is no --shutter");
	if (s->shutter > 0 && s->tracer.samples < 2)
		return err_report(ERR_USAGE, NULL, "--shutter spreads samples over time: --samples says how many, as 32");
	return 0;
}

static int check_preview(const struct settings *s)
{
	if (!s->preview)
		return 0;
	if (display_kind_of(s->preview) == DISPLAY_NONE)
		return display_refuse(s->preview);
	if (strcmp(s->preview, s->output) == 0)
		return err_report(ERR_USAGE, s->preview, "is the frame's own name; a preview needs another");
	if (frame_pattern_has_number(s->output) && !frame_pattern_has_number(s->preview))
		return err_report(ERR_USAGE, s->preview, "several frames need previews named with #### or {frame}");
	return 0;
}

/* A camera without a projection is a hook of its own. */
static int add_lens(struct settings *s)
{
	char *text = NULL;
	int err = s->camera ? lens_text(s->camera, &text) : 0;

	if (!err && text && s->hook)
		err = err_report(ERR_USAGE, s->camera->path, "its kind or aperture sends rays of its own: there is no --hook");
	if (!err && text)
		err = hook_make(s->camera->path, text, &s->hook);
	free(text);
	return err;
}

/* Whether the mode has the hook's stages. */
static int check_hook(struct settings *s)
{
	const enum tracer_mode mode = s->tracer.mode;

	s->tracer.hook = s->hook;
	if (!s->hook || mode == TRACER_WHITTED || mode == TRACER_PATH ||
	    (mode == TRACER_DIFFUSE && !(s->hook->stages & (HOOK_RAY_GENERATION | HOOK_INTERSECTION))))
		return s->hook && device_is_reference(s->device) ? hook_compile_host(s->hook) : 0;
	return err_report(ERR_USAGE, NULL, "--hook: mode %s has no stage for %s", settings_mode_names[mode],
	                  mode == TRACER_DIFFUSE ? "ray_generation and intersection" : "hooks");
}

/* Choose the kind of file, and check that the other options suit it. */
static int choose_kind(struct settings *s)
{
	const int has_bounces = s->tracer.mode == TRACER_DIFFUSE || s->tracer.mode == TRACER_PATH;
	const int is_asked = s->display.white > 0 || s->display.exposure != 0;

	s->kind = display_kind_of(s->output);
	if (s->kind == DISPLAY_NONE)
		return display_refuse(s->output);
	if (s->kind == DISPLAY_EXR && is_asked)
		return err_report(ERR_USAGE, NULL,
		                  "--exposure and --white are for .png and .jpg; OpenEXR keeps the light of the scene");
	if (s->kind != DISPLAY_EXR && s->aov)
		return err_report(ERR_USAGE, NULL, "--aov is for .exr; .png and .jpg have no channels but red, green and blue");
	if (s->kind != DISPLAY_EXR)
		s->tracer.aov = s->denoise ? FILTER_NEEDS : "";
	s->display.rounds = s->tracer.mode == TRACER_GL;
	if (!(s->display.white > 0))
		s->display.white = has_bounces ? 4 : 1;
	return 0;
}

int settings_parse(struct settings *s, int argc, char **argv)
{
	int err;

	s->driver_s = DRIVER_S;
	s->tracer.depth = 4;
	s->tracer.counts = 1;
	s->tracer.clamp = 10;
	s->family = -1;
	err = options_parse(&table, argc, argv, s, &s->line);
	if (err)
		return err;
	s->trace = s->line.words[0];
	if (!s->tracer.samples && (s->tracer.noise > 0 || s->tracer.seconds > 0))
		s->tracer.samples = MOST_SAMPLES;
	s->denoise |= s->oidn;
	err = choose_kind(s);
	if (!err)
		err = add_lens(s);
	if (!err)
		err = check_hook(s);
	if (!err)
		err = check_caustics(s);
	if (!err)
		err = check_camera(s);
	if (!err)
		err = check_scale(s);
	if (!err)
		err = check_moments(s);
	if (!err && s->denoise)
		err = check_denoised(s);
	if (!err)
		err = check_preview(s);
	if (!err)
		err = name_settings(s, &s->line);
	return err;
}

int settings_confine(const struct settings *s)
{
	int err = s->oidn ? oidn_open() : 0;

	return err ? err : options_confine(&table, &s->line, CONFINE_TRACER, NULL);
}

int settings_number_pictures(const struct settings *s)
{
	return s->fps > 0 || camera_pictures(s->camera);
}

int settings_mixes(const struct settings *s)
{
	return s->fps > 0 || s->shutter > 0;
}

uint64_t settings_recorded_frame(const struct settings *s, uint64_t number)
{
	return moments_nearest(&s->moments, number);
}

int settings_denoise(const struct settings *s, struct image *img)
{
	if (!s->denoise)
		return 0;
	return s->oidn ? oidn_denoise(img, NULL) : filter_alone(img);
}

void settings_free(struct settings *s)
{
	frame_list_free(&s->frames);
	rules_free(&s->look);
	rules_free(&s->look_after);
	camera_free(&s->camera);
	hook_free(&s->hook);
	moments_free(&s->moments);
	free(s->aov);
}
