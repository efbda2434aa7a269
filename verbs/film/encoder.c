#include "verbs/film/encoder.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/err.h"
#include "base/part.h"
#include "verbs/film/matroska.h"

extern char **environ;

struct encoder {
	const char *path;
	char part[PATH_MAX + 128];
	size_t frame_bytes;
	unsigned fps;
	uint64_t n_pictures; /* written */
	pid_t child;
	int pipe; /* its standard input */
};

/* ffmpeg's options for each kind of file. All are 8 bits, 4:2:0, which every player and browser shows. */
static const struct kind {
	const char *ending;
	const char *options[16];
} kinds[] = {
	{ ".webm",
	  { "-f", "webm", "-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-deadline", "realtime", "-cpu-used", "6",
	    "-row-mt", "1", NULL } },
	{ ".mp4",
	  { "-f", "mp4", "-c:v", "libx264", "-crf", "17", "-preset", "medium", "-movflags", "+faststart", "-strict",
	    "unofficial", NULL } }, /* unofficial: marks panoramas as such */
	{ ".mkv", { "-f", "matroska", "-c:v", "libx264", "-crf", "17", "-preset", "medium", NULL } },
};
#define N_KINDS (sizeof(kinds) / sizeof(kinds[0]))

static const struct kind *kind_of(const char *path)
{
	const size_t n = strlen(path);

	for (size_t i = 0; i < N_KINDS; i++) {
		const size_t m = strlen(kinds[i].ending);

		if (n > m && strcasecmp(path + n - m, kinds[i].ending) == 0)
			return &kinds[i];
	}
	return NULL;
}

int encoder_knows(const char *path)
{
	if (kind_of(path))
		return 1;
	err_report(ERR_USAGE, NULL, "'%s' names no kind of film: end it in .webm, .mp4 or .mkv", path);
	return 0;
}

/* Start the child with `input` as its standard input. @return 0 or an errno */
static int spawn(char *const *argv, int input, pid_t *child)
{
	posix_spawn_file_actions_t actions;
	posix_spawnattr_t attributes;
	sigset_t pipes;
	int err;

	sigemptyset(&pipes);
	sigaddset(&pipes, SIGPIPE);
	posix_spawnattr_init(&attributes);
	posix_spawnattr_setsigdefault(&attributes, &pipes);
	posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
	posix_spawn_file_actions_init(&actions);
	posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
	err = posix_spawnp(child, argv[0], &actions, &attributes, argv, environ);
	posix_spawn_file_actions_destroy(&actions);
	posix_spawnattr_destroy(&attributes);
	return err;
}

static int start(struct encoder *e)
{
	/* Pictures are sRGB; players assume BT.709: set its matrix and range. Odd sizes get one more row or column. */
	static char filter[] = "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv,format=yuv420p";
	char rate[16];
	char *argv[64] = { "ffmpeg",       "-hide_banner", "-nostdin",
		           "-loglevel",    "error",        "-y",
		           "-f",           "matroska",     "-r",
		           rate,           "-i",           "pipe:0",
		           "-vf",          filter,
		           "-colorspace",  "bt709",        "-color_primaries",
		           "bt709",        "-color_trc",   "iec61966-2-1",
		           "-color_range", "tv",           "-fflags",
		           "+bitexact",    "-flags:v",     "+bitexact",
		           "-an" };
	size_t n = 0;
	int fds[2], err;

	snprintf(rate, sizeof(rate), "%u", e->fps);
	while (argv[n])
		n++;
	for (const char *const *o = kind_of(e->path)->options; *o; o++)
		argv[n++] = (char *)*o;
	argv[n++] = e->part;
	if (pipe2(fds, O_CLOEXEC))
		return err_report(ERR_SYSTEM, "ffmpeg", "%s", strerror(errno));
	err = spawn(argv, fds[0], &e->child);
	close(fds[0]);
	e->pipe = fds[1];
	if (!err)
		return 0;
	close(fds[1]);
	return err == ENOENT ?
	               err_report(ERR_SYSTEM, NULL,
	                          "ffmpeg, which makes films, is not installed; it is the Debian package ffmpeg") :
	               err_report(ERR_SYSTEM, "ffmpeg", "cannot start: %s", strerror(err));
}

/* @return 0 or ERR_SYSTEM (reported) */
static int send(struct encoder *e, const uint8_t *bytes, size_t size)
{
	for (size_t done = 0; done < size;) {
		const ssize_t n = write(e->pipe, bytes + done, size - done);

		if (n < 0 && errno != EINTR)
			return err_report(ERR_SYSTEM, e->path, "ffmpeg takes no more pictures: %s", strerror(errno));
		done += n > 0 ? (size_t)n : 0;
	}
	return 0;
}

int encoder_open(const char *path, uint32_t width, uint32_t height, unsigned fps, const struct matroska_view *view,
                 struct encoder **out)
{
	struct encoder *e = *out = calloc(1, sizeof(*e));
	uint8_t head[MATROSKA_HEADER_BYTES];
	int err;

	if (!e)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	e->path = path;
	e->frame_bytes = (size_t)width * height * 3;
	e->fps = fps;
	signal(SIGPIPE, SIG_IGN); /* if ffmpeg ends early, encoder_write fails */
	err = part_begin(path, e->part, sizeof(e->part));
	if (!err) {
		err = start(e);
		if (err)
			part_drop(e->part);
	}
	if (err) {
		free(e);
		*out = NULL;
	}
	return err ? err : send(e, head, matroska_begin(head, width, height, view));
}

int encoder_write(struct encoder *encoder, const uint8_t *rgb)
{
	uint8_t head[MATROSKA_PICTURE_BYTES];
	const double seconds = (double)encoder->n_pictures++ / encoder->fps;
	int err = send(encoder, head, matroska_picture(head, encoder->frame_bytes, seconds));

	return err ? err : send(encoder, rgb, encoder->frame_bytes);
}

int encoder_close(struct encoder **encoder, int err)
{
	struct encoder *e = *encoder;
	int status = 0;

	*encoder = NULL;
	if (!e)
		return err;
	close(e->pipe);
	while (waitpid(e->child, &status, 0) < 0 && errno == EINTR)
		;
	if (!err && !(WIFEXITED(status) && WEXITSTATUS(status) == 0))
		err = err_report(ERR_SYSTEM, e->path, "ffmpeg could not make it");
	if (err)
		part_drop(e->part);
	else
		err = part_finish(e->part, e->path);
	free(e);
	return err;
}
