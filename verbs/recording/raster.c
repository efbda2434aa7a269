/*
 * relume raster: make reference frames of a trace with a real OpenGL. apitrace's glretrace replays the trace and saves
 * the back buffer just before the calls that end the frames asked for; our replay finds these calls.
 */
#include "base/plural.h"
#include "base/verbs.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/beside.h"
#include "base/err.h"
#include "base/memory.h"
#include "base/folder.h"
#include "base/frames.h"
#include "base/options.h"
#include "base/progress.h"
#include "replay/replay.h"

struct options {
	const char *trace, *output;
	struct frame_list frames;
};

/* The calls that end the frames asked for. */
struct frame_end {
	uint64_t frame, call;
};
struct frame_ends {
	struct frame_end *ends;
	size_t n, capacity;
	int skipped_first; /* 1: frame 0 was asked for as well */
	int single_buffered; /* 1: some context has no back buffer */
	char visual[64];   /* bits per pixel, in the format of visual.c */
};

static const struct options_row rows[] = {
	{ "frames", 'f', "LIST", "frames, as in 10-60 or 1-500x5 (default: all)", options_frames,
	  .at = offsetof(struct options, frames) },
	{ "output", 'o', "PATTERN", "file names with the frame number as ####, %04d or $F4, ending in .png",
	  options_text, .at = offsetof(struct options, output), .is_required = 1 },
};

static const struct options_table table = {
	.verb = "raster",
	.head = "usage: relume raster [OPTIONS] TRACE -o PATTERN.png\n"
	        "\n"
	        "Make reference frames of a trace with a real OpenGL: apitrace's glretrace, on the current display, or\n"
	        "on Xvfb with Mesa's software rasterizer if there is none. 'relume diff' takes the images as its REF.\n"
	        "Frames have the same bits of depth, stencil and alpha and the same number of samples as the program's,\n"
	        "if the display has such a visual. The first frame of another recorder's trace is left out, because\n"
	        "glretrace does not show it reliably.\n",
	OPTIONS_ROWS(rows),
	.takes = "one trace and -o PATTERN.png",
	.least = 1,
	.most = 1,
};

/** @return 0 go on, 1 help was printed, or ERR_* (reported) */
static int parse_options(int argc, char **argv, struct options *o)
{
	struct options_line line;
	int err = options_parse(&table, argc, argv, o, &line);
	size_t length;

	if (err)
		return err;
	o->trace = line.words[0];
	length = strlen(o->output);
	if (!frame_pattern_has_number(o->output) || length < 4 || strcmp(o->output + length - 4, ".png") != 0)
		return err_report(ERR_USAGE, o->output, "the pattern needs a place for the frame number and the ending .png, "
		                  "as in out/NAME.####.png");
	return 0;
}

static int add_end(struct frame_ends *ends, uint64_t frame, uint64_t call)
{
	if (MEMORY_GROW(ends->ends, ends->capacity, ends->n + 1))
		return ERR_SYSTEM;
	ends->ends[ends->n++] = (struct frame_end){ frame, call };
	return 0;
}

/* Find the visual of the context that draws most. */
static void find_visual(struct replay *rp, struct frame_ends *ends)
{
	const struct replay_context *contexts, *most = NULL;
	size_t n = replay_contexts(rp, &contexts);

	for (size_t i = 0; i < n; i++)
		if (!most || contexts[i].calls > most->calls)
			most = &contexts[i];
	if (most)
		snprintf(ends->visual, sizeof(ends->visual), "%u %u %u %u", most->alpha_bits, most->depth_bits,
		         most->stencil_bits, most->samples);
}

static int find_frame_ends(const struct options *o, struct frame_ends *ends)
{
	const uint64_t last = frame_list_last(&o->frames);
	uint64_t first = 0;
	struct replay *rp = NULL;
	struct scene *scene;
	int rc = replay_open(&rp, o->trace), err = rc;

	while (!err && replay_frame(rp) <= last && (rc = replay_next_frame(rp, 0, &scene)) > 0) {
		uint64_t frame = replay_frame(rp) - 1;

		if (!frame_list_contains(&o->frames, frame))
			continue;
		if (frame == 0 && !replay_is_ours(rp))
			ends->skipped_first = 1;
		else
			err = add_end(ends, frame, replay_call_count(rp) - 1);
	}
	if (!err && rc < 0 && ends->n == 0)
		err = rc; /* a damaged trace provides the frames before the damage */
	if (!err && ends->n == 0 && ends->skipped_first)
		err = err_report(ERR_USAGE, o->trace, "the first frame cannot be made alone: it is not reliable");
	frame_list_next(&o->frames, 0, &first);
	if (!err && ends->n == 0)
		err = frame_report_missing(o->trace, first, replay_frame(rp));
	if (!err && last != UINT64_MAX && replay_frame(rp) <= last)
		err_warn(o->trace, "the trace has %" PRIu64 " frame%s", replay_frame(rp), plural(replay_frame(rp)));
	if (!err) {
		find_visual(rp, ends);
		ends->single_buffered = replay_needs(rp).single_buffered;
	}
	replay_close(&rp);
	return err;
}

/* Child processes and their output. */

/** Run a command with its output in a file, and wait for it. @return its exit code, 128 + signal, or ERR_SYSTEM */
static int run_command(char *const argv[], const char *log)
{
	pid_t pid = fork();
	int status;

	if (pid < 0)
		return err_report(ERR_SYSTEM, argv[0], "%s", strerror(errno));
	if (pid == 0) {
		int fd = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0666);

		dup2(fd, STDOUT_FILENO);
		dup2(fd, STDERR_FILENO);
		execvp(argv[0], argv);
		_exit(errno == ENOENT ? 127 : 126);
	}
	while (waitpid(pid, &status, 0) < 0)
		if (errno != EINTR)
			return err_report(ERR_SYSTEM, argv[0], "%s", strerror(errno));
	return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/** The last line of a file that is not empty. */
static void last_line(const char *path, char *out, size_t size)
{
	char line[512];
	FILE *f = fopen(path, "r");

	snprintf(out, size, "no output");
	while (f && fgets(line, sizeof(line), f)) {
		line[strcspn(line, "\r\n")] = '\0';
		if (line[0])
			snprintf(out, size, "%s", line);
	}
	if (f)
		fclose(f);
}

/**
 * Start an X server on a display number that it chooses; sets DISPLAY.
 * @return its process, or -1 (reported)
 */
static pid_t start_display(void)
{
	char number[16] = "", text[24];
	ssize_t n = 0, got;
	int fds[2];
	pid_t pid;

	if (pipe(fds) != 0 || (pid = fork()) < 0) {
		err_report(ERR_SYSTEM, "Xvfb", "%s", strerror(errno));
		return -1;
	}
	if (pid == 0) {
		int quiet = open("/dev/null", O_RDWR);

		close(fds[0]);
		dup2(quiet, STDOUT_FILENO);
		dup2(quiet, STDERR_FILENO);
		snprintf(text, sizeof(text), "%d", fds[1]);
		execlp("Xvfb", "Xvfb", "-displayfd", text, "-noreset", "-nolisten", "tcp", "-screen", "0", "2560x1600x24",
		       (char *)NULL);
		_exit(127);
	}
	close(fds[1]);
	/* The server writes the number and a newline when it is ready; the pipe ends if it fails to start. */
	while (n < (ssize_t)sizeof(number) - 1 && !memchr(number, '\n', (size_t)n) &&
	       (got = read(fds[0], number + n, sizeof(number) - 1 - (size_t)n)) > 0)
		n += got;
	close(fds[0]);
	if (n <= 1) {
		waitpid(pid, NULL, 0);
		err_report(ERR_SYSTEM, NULL, "there is no display, and Xvfb failed to start; set DISPLAY, or install the "
		           "Debian package xvfb");
		return -1;
	}
	number[strcspn(number, "\n")] = '\0';
	snprintf(text, sizeof(text), ":%s", number);
	setenv("DISPLAY", text, 1);
	setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
	return pid;
}

static void stop_display(pid_t pid)
{
	if (pid <= 0)
		return;
	kill(pid, SIGTERM);
	waitpid(pid, NULL, 0);
}

/** Write the calls for glretrace, as a file with one list. */
static int write_call_set(const struct frame_ends *ends, const char *path)
{
	FILE *f = fopen(path, "w");

	if (!f)
		return err_report(ERR_SYSTEM, path, "%s", strerror(errno));
	for (size_t i = 0; i < ends->n; i++)
		fprintf(f, "%" PRIu64 "\n", ends->ends[i].call);
	if (ferror(f) | fclose(f))
		return err_report(ERR_SYSTEM, path, "%s", strerror(errno));
	return 0;
}

/* Preload visual.c, so that glretrace uses visuals with the program's bits. */
static int set_visual(const char *visual)
{
	const char *others = getenv("LD_LIBRARY_PATH");
	char library[PATH_MAX], path[2 * PATH_MAX];
	int err = beside_find("visual/libGL.so.1", library, sizeof(library));

	if (err)
		return err;
	*strrchr(library, '/') = '\0';
	snprintf(path, sizeof(path), "%s%s%s", library, others ? ":" : "", others ? others : "");
	setenv("LD_LIBRARY_PATH", path, 1);
	setenv("RELUME_VISUAL", visual, 1);
	return 0;
}

static int run_glretrace(const struct options *o, const struct frame_ends *ends, const char *folder)
{
	char prefix[PATH_MAX], calls[PATH_MAX], log[PATH_MAX], said[512];
	char *argv[] = { "glretrace", "--headless", "-s", prefix, "-S", calls, (char *)o->trace, NULL };
	int code;

	snprintf(prefix, sizeof(prefix), "%s/", folder);
	snprintf(calls, sizeof(calls), "@%s/calls", folder);
	snprintf(log, sizeof(log), "%s/log", folder);
	/*
	 * llvmpipe's fast rasterizer for windows without depth is off by up to 2/255, and differs from frame to frame.
	 */
	setenv("LP_PERF", "no_rast_linear", 0);
	code = set_visual(ends->visual);
	if (!code)
		code = run_command(argv, log);
	if (code == 127)
		return err_report(ERR_SYSTEM, "glretrace", "not found; install the Debian package apitrace");
	if (code < 0)
		return code;
	if (code != 0) {
		last_line(log, said, sizeof(said));
		return err_report(ERR_SYSTEM, "glretrace", "ended with code %d: %s", code, said);
	}
	return 0;
}

/** Rename the snapshots to their frames' names. */
static int name_frames(const struct options *o, const struct frame_ends *ends, const char *folder)
{
	struct progress progress;
	int err = 0;

	progress_begin(&progress, "rasterized", ends->n);
	for (size_t i = 0; !err && i < ends->n; i++) {
		char from[PATH_MAX + 32], to[PATH_MAX];

		snprintf(from, sizeof(from), "%s/%010" PRIu64 ".png", folder, ends->ends[i].call);
		err = frame_pattern_expand(o->output, ends->ends[i].frame, to, sizeof(to));
		if (!err && rename(from, to) != 0)
			err = err_report(ERR_SYSTEM, to, "glretrace gave no picture at call %" PRIu64 " (%s)", ends->ends[i].call,
			                 strerror(errno));
		if (!err)
			progress_step(&progress, ends->ends[i].frame, to);
	}
	progress_end(&progress);
	return err;
}

/** Create the output's folder, and a scratch folder beside the output so that pictures can be moved by rename. */
static int make_scratch(const char *output, char *out, size_t size)
{
	const char *slash = strrchr(output, '/');
	int err = folder_make_for(output);

	if (err)
		return err;
	if (snprintf(out, size, "%.*s.raster-XXXXXX", slash ? (int)(slash - output) + 1 : 0, output) >= (int)size)
		return err_report(ERR_USAGE, output, "the file name is too long");
	if (!mkdtemp(out))
		return err_report(ERR_SYSTEM, output, "%s", strerror(errno));
	return 0;
}

static int raster(const struct options *o, const struct frame_ends *ends)
{
	const char *display = getenv("DISPLAY");
	char folder[PATH_MAX - 64], calls[PATH_MAX];
	pid_t server = 0;
	int err = make_scratch(o->output, folder, sizeof(folder));

	if (err)
		return err;
	snprintf(calls, sizeof(calls), "%s/calls", folder);
	err = write_call_set(ends, calls);
	if (!err && !(display && display[0]) && (server = start_display()) < 0)
		err = ERR_SYSTEM;
	if (!err)
		err = run_glretrace(o, ends, folder);
	if (!err)
		err = name_frames(o, ends, folder);
	stop_display(server);
	folder_remove(folder);
	return err;
}

int raster_main(int argc, char **argv)
{
	struct options o = { 0 };
	struct frame_ends ends = { 0 };
	int err = parse_options(argc, argv, &o);

	if (!err)
		err = find_frame_ends(&o, &ends);
	if (!err && ends.skipped_first)
		err_warn(o.trace, "frame 0 is left out: the first frame of a replay is not reliable");
	if (!err && ends.single_buffered)
		err_warn(o.trace, "the program draws to a single-buffered window; glretrace may save black pictures of it; "
		         "'relume record --ref color' keeps what it showed");
	if (!err)
		err = raster(&o, &ends);
	free(ends.ends);
	frame_list_free(&o.frames);
	return err > 0 ? 0 : -err;
}
