/* relume render: scene -> accel -> image -> EXR. */
#include <errno.h>
#include <getopt.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/folder.h"
#include "base/frames.h"
#include "base/progress.h"
#include "base/verbs.h"
#include "replay/replay.h"
#include "tracer/device.h"
#include "tracer/image.h"
#include "tracer/trace.h"

#define RELUME_VERSION "0.1"
#define MAX_PATH_BYTES 4096

struct options {
	const char *trace, *output, *device;
	unsigned threads;
	struct frame_list frames;
	struct tracer_options tracer;
};

static void print_help(FILE *out)
{
	fputs("usage: relume render TRACE [-f FRAMES] -o PATTERN [OPTIONS]\n"
	      "\n"
	      "Ray trace frames of a recording to OpenEXR.\n"
	      "\n"
	      "  -f, --frames LIST    frames, counted from 0: \"7\", \"1-500\", \"1-500x5\", with commas (default: all)\n"
	      "  -o, --output PATTERN file names: #### or %04d or $F4 stand for the frame number\n"
	      "      --device NAME    number or part of the name as 'relume devices' lists it; \"reference\": no OpenCL\n"
	      "      --threads N      compute threads of a CPU device (default: all cores)\n"
	      "      --mode MODE      whitted (default), gl (GL's picture alone), normals\n"
	      "      --encoding E     linear (default) or display (GL's own numbers)\n"
	      "      --aov LIST       channel groups beside R G B A: gl,shadow,relight,reflect,refract,Z,N,P,albedo,id,\n"
	      "                       layers (default: all)\n"
	      "      --depth N        mirror bounces at most (default 4)\n"
	      "  -h, --help           this text\n",
	      out);
}

static int parse_number(const char *text, const char *option, unsigned most, unsigned *out)
{
	char *end;
	unsigned long value;

	errno = 0;
	value = strtoul(text, &end, 10);
	if (errno || end == text || *end || *text == '-' || value > most)
		return err_report(ERR_USAGE, NULL, "%s takes a number up to %u, not '%s'", option, most, text);
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
	return err_report(ERR_USAGE, NULL, "%s does not know '%s'; see 'relume help render'", option, text);
}

/* @return 0, ERR_*, or 1 where help was printed */
static int parse_options(int argc, char **argv, struct options *o)
{
	static const struct option longs[] = {
		{ "frames", required_argument, NULL, 'f' }, { "output", required_argument, NULL, 'o' },
		{ "device", required_argument, NULL, 'd' }, { "threads", required_argument, NULL, 't' },
		{ "mode", required_argument, NULL, 'm' },   { "encoding", required_argument, NULL, 'e' },
		{ "aov", required_argument, NULL, 'a' },    { "depth", required_argument, NULL, 'n' },
		{ "help", no_argument, NULL, 'h' },         { NULL, 0, NULL, 0 }
	};
	static const char *const modes[] = { "whitted", "gl", "normals", NULL };
	static const char *const encodings[] = { "linear", "display", NULL };
	int c, err = 0, word = 0;

	o->tracer.depth = 4;
	optind = 1;
	while (!err && (c = getopt_long(argc, argv, "f:o:h", longs, NULL)) != -1) {
		switch (c) {
		case 'f': err = frame_list_parse(optarg, &o->frames); break;
		case 'o': o->output = optarg; break;
		case 'd': o->device = optarg; break;
		case 't': err = parse_number(optarg, "--threads", 1024, &o->threads); break;
		case 'm':
			err = parse_word(optarg, "--mode", modes, &word);
			o->tracer.mode = (enum tracer_mode)word;
			break;
		case 'e': err = parse_word(optarg, "--encoding", encodings, &o->tracer.display); break;
		case 'a':
			o->tracer.aov = optarg;
			err = tracer_check_aov(optarg);
			break;
		case 'n': err = parse_number(optarg, "--depth", 64, &o->tracer.depth); break;
		case 'h': print_help(stdout); return 1;
		default: return ERR_USAGE;
		}
	}
	if (err)
		return err;
	if (argc - optind != 1 || !o->output) {
		print_help(stderr);
		return ERR_USAGE;
	}
	o->trace = argv[optind];
	return 0;
}

/* --- Writing files while the next frame is traced ----------------------------------------------------------------- */

struct writer {
	pthread_t thread;
	int busy; /* the thread runs and owns image */
	int err;
	struct image image;
	char path[MAX_PATH_BYTES];
};

static void *write_image(void *arg)
{
	struct writer *w = arg;

	w->err = image_write_exr(&w->image, w->path);
	image_free(&w->image);
	return NULL;
}

/* Wait for the file that is being written. @return its error, once */
static int writer_finish(struct writer *w)
{
	int err;

	if (w->busy)
		pthread_join(w->thread, NULL);
	err = w->err;
	w->busy = w->err = 0;
	return err;
}

/* Write an image in the background, taking it over. */
static int writer_start(struct writer *w, struct image *img)
{
	w->image = *img;
	memset(img, 0, sizeof(*img));
	if (pthread_create(&w->thread, NULL, write_image, w) != 0)
		write_image(w);
	else
		w->busy = 1;
	return 0;
}

/* --- The run ------------------------------------------------------------------------------------------------------- */

struct run {
	const struct options *options;
	struct replay *replay;
	struct device *device;
	struct tracer *tracer;
	struct writer writer;
	struct progress progress;
};

static int describe(const struct run *run, struct image *img)
{
	int err = image_set_attribute(img, "relume:trace", "%s", replay_trace_hash(run->replay));

	return err ? err : image_set_attribute(img, "relume:version", "%s", RELUME_VERSION);
}

static int render_frame(struct run *run, const struct scene *scene)
{
	struct image img = { .width = 0 };
	double start = progress_clock_s();
	char text[64];
	int err = tracer_render(run->tracer, scene, &run->options->tracer, &img);

	if (!err)
		err = describe(run, &img);
	if (!err)
		err = writer_finish(&run->writer);
	if (!err)
		err = frame_pattern_expand(run->options->output, scene->frame, run->writer.path, sizeof(run->writer.path));
	if (!err)
		err = folder_make_for(run->writer.path);
	if (!err)
		err = writer_start(&run->writer, &img);
	image_free(&img);
	if (!err) {
		snprintf(text, sizeof(text), "%.2f s", progress_clock_s() - start);
		progress_step(&run->progress, scene->frame, text);
	}
	return err;
}

static int render_frames(struct run *run)
{
	const struct frame_list *frames = &run->options->frames;
	uint64_t last = frame_list_last(frames);
	struct scene *scene = NULL;
	int more = 1, err = 0;

	while (more == 1 && !err && replay_frame(run->replay) <= last) {
		int want = frame_list_contains(frames, replay_frame(run->replay));

		more = replay_next_frame(run->replay, want, &scene);
		if (more == 1 && want)
			err = render_frame(run, scene);
		scene_release(&scene);
	}
	if (more < 0)
		err = err ? err : more;
	return err;
}

/* Frames asked for that the trace does not have: wrong usage, and say what there is. */
static int check_range(const struct run *run)
{
	const struct frame_list *frames = &run->options->frames;
	uint64_t end = replay_frame(run->replay);

	if (frames->n_ranges && frame_list_last(frames) >= end)
		return err_report(ERR_USAGE, run->options->trace, "has %llu frames, numbered from 0; frame %llu is not there",
		                  (unsigned long long)end, (unsigned long long)frame_list_last(frames));
	if (end == 0)
		return err_report(ERR_INPUT, run->options->trace, "holds no whole frame");
	return 0;
}

static void report(const struct run *run)
{
	const struct tracer_undrawn *u = tracer_undrawn(run->tracer);

	replay_report_unsupported(run->replay, run->options->trace, 20);
	if (u->targets)
		err_warn(run->options->trace, "not drawn yet: %llu draws to other targets than the window",
		         (unsigned long long)u->targets);
	if (u->smooth)
		err_warn(run->options->trace, "not smoothed yet: %llu draws of smooth lines or points are drawn plain",
		         (unsigned long long)u->smooth);
}

static int render(const struct options *o)
{
	struct run run = { .options = o };
	int err = replay_open(&run.replay, o->trace), late;

	if (err)
		return err;
	err = device_open(o->device, o->threads, &run.device);
	if (!err)
		err = tracer_create(&run.tracer, run.device);
	if (err)
		goto done;
	progress_begin(&run.progress, "rendered", o->frames.n_ranges && frame_list_last(&o->frames) != UINT64_MAX ?
	               frame_list_count(&o->frames, frame_list_last(&o->frames) + 1) : 0);
	err = render_frames(&run);
	late = writer_finish(&run.writer);
	err = err ? err : late;
	progress_end(&run.progress);
	if (!err)
		err = check_range(&run);
	report(&run);
done:
	tracer_destroy(&run.tracer);
	if (run.device)
		device_close(&run.device);
	replay_close(&run.replay);
	return err;
}

int render_main(int argc, char **argv)
{
	struct options o = { .trace = NULL };
	int err = parse_options(argc, argv, &o);

	if (!err && !frame_pattern_has_number(o.output) &&
	    !(o.frames.n_ranges == 1 && o.frames.ranges[0].first == o.frames.ranges[0].last))
		err = err_report(ERR_USAGE, NULL, "'%s' holds no place for the frame number (####, %%04d or $F4)", o.output);
	if (!err)
		err = render(&o);
	frame_list_free(&o.frames);
	return err == 1 ? 0 : -err;
}
