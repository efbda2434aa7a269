#include "capture/summary.h"

#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "base/err.h"
#include "base/plural.h"
#include "capture/executable.h"
#include "capture/format/sidecar.h"

/* Explain why a recording has no frame, and which option gives it some. */
static void explain_no_frame(const struct stats_process *p)
{
	static const char *const names[] = FRAME_TRIGGER_NAMES;
	static const enum frame_trigger order[] = { FRAME_FLUSH, FRAME_FINISH, FRAME_READPIXELS, FRAME_CLEAR };

	if (p->ends[FRAME_SWAP]) {
		err_warn(p->path, "the program ended after %" PRIu64 " frame%s, before the first that was to be recorded",
		         p->ends[FRAME_SWAP], plural(p->ends[FRAME_SWAP]));
		return;
	}
	for (size_t i = 0; i < sizeof(order) / sizeof(order[0]); i++)
		if (p->ends[order[i]]) {
			err_warn(p->path, "the program swapped no buffers, so there is no frame; record it with --frame-end %s, which ends %"
			         PRIu64, names[order[i]], p->ends[order[i]]);
			return;
		}
	if (p->calls && !p->contexts) {
		err_warn(p->path, "the program asked for OpenGL but made no context, so it drew nothing; 'glxinfo -B' "
		                  "shows whether the display has OpenGL");
		return;
	}
	err_warn(p->path, p->calls ? "the program swapped no buffers, so there is no frame" : "the program drew nothing");
}

/* Warn about features that matter for rendering. */
static void explain_needs(const struct stats_process *p)
{
	if (p->programs)
		err_warn(p->path, "the program uses shaders; 'relume info' lists any that Relume cannot run");
	if (p->contexts > 1)
		err_warn(p->path, "the program uses a core profile of OpenGL 3 or later; Relume renders OpenGL 1 and "
		                  "2, 'relume info' lists the calls that it leaves out");
	if (p->windows > 1)
		err_warn(p->path, "its frames come from several windows, in the order of their swaps");
}

/* Size of the reference frames beside a trace; 0: there are none. */
static uint64_t reference_bytes(const char *trace)
{
	char path[PATH_MAX];
	struct stat st;

	sidecar_name(path, sizeof(path), trace, ".ref");
	return stat(path, &st) == 0 && S_ISREG(st.st_mode) ? (uint64_t)st.st_size : 0;
}

void summary_print(const struct recorder_stats *stats)
{
	const uint32_t n = stats_processes(stats);
	const uint32_t n_unknown = stats->n_unknown < STATS_MAX_UNKNOWN ? stats->n_unknown : STATS_MAX_UNKNOWN;
	uint64_t unknown = 0;

	for (uint32_t i = 0; i < n_unknown; i++)
		unknown += stats->unknown[i].calls;
	for (uint32_t i = 0; i < n; i++) {
		const struct stats_process *p = &stats->processes[i];
		const uint64_t references = reference_bytes(p->path);

		fprintf(stderr, "relume: %s: %" PRIu64 " frame%s, %" PRIu64 " call%s, %" PRIu64 " bytes, ", p->path, p->frames,
		        plural(p->frames), p->calls, plural(p->calls), p->bytes);
		if (references)
			fprintf(stderr, "%" PRIu64 " bytes of reference frames%s, ", references,
			        p->lost_references && !p->failed ? " (stopped early)" : "");
		if (p->failed)
			fprintf(stderr, "stopped early: %s\n", strerror(p->failed));
		else
			fprintf(stderr, "%" PRIu64 " call%s not recorded\n", i == 0 ? unknown : 0, plural(i == 0 ? unknown : 0));
		if (p->frames == 0)
			explain_no_frame(p);
		explain_needs(p);
	}
	for (uint32_t i = 0; i < n_unknown; i++)
		fprintf(stderr, "relume: not recorded: %s, %" PRIu64 " call%s\n", stats->unknown[i].name, stats->unknown[i].calls,
		        plural(stats->unknown[i].calls));
}

/* --- Nothing was recorded ---------------------------------------------------------------------------------------- */

/* 1 if a server listens at this machine's X display of that number, or the display is on another machine. */
static int display_answers(const char *display)
{
	struct sockaddr_un address = { .sun_family = AF_UNIX };
	int fd, answers, number;

	if (sscanf(display, ":%d", &number) != 1 && sscanf(display, "unix:%d", &number) != 1)
		return 1;
	snprintf(address.sun_path, sizeof(address.sun_path), "/tmp/.X11-unix/X%d", number);
	fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
	answers = fd < 0 || connect(fd, (struct sockaddr *)&address, sizeof(address)) == 0;
	if (fd >= 0)
		close(fd);
	return answers;
}

/* Advice for a missing display; "" if there is one. */
static void find_display(char *out, size_t size)
{
	const char *x = getenv("DISPLAY"), *wayland = getenv("WAYLAND_DISPLAY");

	out[0] = '\0';
	if (wayland && *wayland)
		return;
	if (!x || !*x)
		snprintf(out, size,
		         "; there is no display (DISPLAY and WAYLAND_DISPLAY are not set): 'xvfb-run -a relume record "
		         "...' makes one");
	else if (!display_answers(x))
		snprintf(out, size,
		         "; no X server answers at DISPLAY=%s: start one, or let 'xvfb-run -a relume record ...' make "
		         "one",
		         x);
}

/* A process that ran without the recorder. */
static void explain_stranger(const char *program, const struct watching *w)
{
	if (w->stranger_rights)
		err_report(ERR_SYSTEM, program,
		           "nothing was recorded: process '%s' has the rights of its file's owner or group, so no recorder is "
		           "loaded into it; 'relume record -- ' before that file itself runs it without them",
		           w->name);
	else if (w->kind == EXECUTABLE_STATIC)
		err_report(ERR_SYSTEM, program,
		           "nothing was recorded: process '%s' is linked statically, so no recorder can be loaded into it; link it "
		           "dynamically",
		           w->name);
	else if (w->kind == EXECUTABLE_32)
		err_report(ERR_SYSTEM, program,
		           "nothing was recorded: process '%s' is a 32-bit program; 'make i386' builds the "
		           "recorder for it, 'make deb-i386' its package relume32",
		           w->name);
	else
		err_report(ERR_SYSTEM, program,
		           "nothing was recorded: process '%s' ran without the recorder: its environment was cleared (env -i, "
		           "sudo), or a sandbox hides Relume's files; put 'relume record -- ' behind that, before the program "
		           "itself",
		           w->name);
}

void summary_explain_nothing(const char *program, const struct recorder_stats *stats, const struct watching *w)
{
	const unsigned seen = stats->seen | w->seen;
	char path[PATH_MAX], display[200];

	find_display(display, sizeof(display));
	if (executable_find(program, path, sizeof(path)) && executable_kind(path) == EXECUTABLE_STATIC &&
	    !(seen & SEEN_RECORDER))
		err_report(ERR_SYSTEM, program,
		           "nothing was recorded: the program is linked statically, so no recorder can be loaded into "
		           "it; link it dynamically");
	else if (w->stranger && (w->stranger_seen || !(seen & (SEEN_GL | SEEN_VULKAN))))
		explain_stranger(program, w);
	else if (!(seen & SEEN_RECORDER))
		err_report(
			ERR_SYSTEM, program,
			"nothing was recorded: the recorder was loaded into no process: the environment was cleared "
		        "(env -i, sudo), or a "
			"sandbox hides Relume's files; put 'relume record -- ' behind that, before the program itself");
	else if (seen & SEEN_GL)
		err_report(ERR_SYSTEM, program,
		           "nothing was recorded: the program loaded OpenGL and ended without calling it%s", display);
	else if (seen & SEEN_VULKAN)
		err_report(ERR_SYSTEM, program,
		           "nothing was recorded: the program draws with Vulkan, but Relume records OpenGL; choose the program's "
		           "OpenGL renderer, if it has one");
	else
		err_report(ERR_SYSTEM, program,
		           "nothing was recorded: the program loaded no OpenGL (libGL, libEGL or libOSMesa)%s",
		           display);
}
