/* relume record: runs a program with the recorder preloaded. RELUME_* variables pass the options to the recorder. */
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/beside.h"
#include "base/err.h"
#include "base/options.h"
#include "base/verbs.h"
#include "capture/earlier.h"
#include "capture/executable.h"
#include "capture/key.h"
#include "capture/press.h"
#include "capture/format/sidecar.h"
#include "capture/stats.h"
#include "capture/summary.h"
#include "capture/watching.h"

enum { MAX_NUMBER_BYTES = 24, TICKS_A_SECOND = 4, PATIENCE_S = 5, INHERITED_FD = 200 };

struct options {
	char trace[STATS_PATH_BYTES]; /* absolute: the program may change its directory */
	const char *output, *ref, *ref_every, *max_frames, *quit_after, *frame_end;
	uint64_t max_bytes;
	const char *first_frame, *last_frame, *start_key;
	struct press_list press;
	char *press_plan; /* for the recorder; NULL: no keys */
	int no_children, paused, ref_exact;
	char **program;
};

/* --- The command line -------------------------------------------------------------------------------------------- */

/* A whole number from 1 on. */
static int take_count(const struct options_row *row, const char *text, void *out)
{
	char *end;

	errno = 0;
	if (*text < '0' || *text > '9' || strlen(text) >= MAX_NUMBER_BYTES || strtoull(text, &end, 10) == 0 || *end || errno)
		return err_report(ERR_USAGE, NULL, "--%s takes a number of frames, not '%s'", row->name, text);
	return options_text(row, text, out);
}

/* "A", "A-B" or "A-", split in place in argv. */
static int take_frames(const struct options_row *row, const char *text, void *out)
{
	size_t digits = strspn(text, "0123456789"), more = text[digits] == '-' ? strspn(text + digits + 1, "0123456789") : 0;
	const char *last = text + digits + 1;
	struct options *o = out;

	if (digits && digits < MAX_NUMBER_BYTES - 4 && !text[digits]) {
		o->first_frame = o->last_frame = text;
		return 0;
	}
	if (!digits || digits >= MAX_NUMBER_BYTES - 4 || more >= MAX_NUMBER_BYTES - 4 || text[digits] != '-' || last[more] ||
	    (more && strtoull(last, NULL, 10) < strtoull(text, NULL, 10)))
		return err_report(ERR_USAGE, NULL,
		                  "--%s takes one frame, or the first and the last, as in 7, 10-19 or 10-, not '%s'",
		                  row->name, text);
	((char *)text)[digits] = '\0';
	o->first_frame = text;
	o->last_frame = more ? last : NULL;
	return 0;
}

static int take_variable(const struct options_row *row, const char *text, void *out)
{
	(void)out;
	if (!strchr(text, '=') || text[0] == '=')
		return err_report(ERR_USAGE, NULL, "--%s takes NAME=VALUE, not '%s'", row->name, text);
	return putenv((char *)text) ? err_report(ERR_SYSTEM, NULL, "out of memory") : 0;
}

static const char *const frame_ends[] = FRAME_TRIGGER_NAMES;
static const char *const ref_kinds[] = { "color", "depth", "color,depth", "depth,color", NULL };

#define AT(member) .at = offsetof(struct options, member)

static const struct options_row rows[] = {
	{ "output", 'o', "NAME.trace",
	  "the trace to write, replacing an older one (default: PROGRAM.trace in the current directory)", options_text,
	  AT(output) },
	{ "ref", 0, "KINDS", "save what the program shows in NAME.ref: color, depth, or color,depth", options_text,
	  AT(ref), .words = ref_kinds },
	{ "ref-every", 0, "N", "save only every Nth of these frames", take_count, AT(ref_every) },
	{ "ref-exact", 0, NULL,
	  "switch off Mesa llvmpipe's fast rasterizer (LP_PERF=no_rast_linear): in windows without depth its colours "
	  "are off by up to 2/255; the program then shows the exact ones as well",
	  options_flag, AT(ref_exact) },
	{ "frames", 0, "A-B",
	  "record only the program's frames A to B, counted from 0 (\"A-\": to the end; \"A\": only that one); the trace "
	  "begins with everything they need and numbers them from 0; the program keeps running",
	  take_frames, .at = 0 },
	{ "paused", 0, NULL, "start with recording switched off", options_flag, AT(paused) },
	{ "start-key", 0, "KEY", "as --paused; KEY then switches recording as SIGUSR2 does (an X key name: F9, Pause, r, ...)",
	  options_text, AT(start_key) },
	{ "press", 0, "KEY@FRAME",
	  "press a key (X key name) once the frame before FRAME is shown, as in space@10, Control+s@5, or hold it, as "
	  "in Left@20-30; frames of the program count from 0; may be repeated",
	  press_take, AT(press) },
	{ "frame-end", 0, "CALL",
	  "also end a frame at: flush, finish, clear (of the color buffer), or readpixels after something was drawn (swap: "
	  "nothing else; with OSMesa, flush and finish); such a frame shows the buffer drawn to, front or back; "
	  "glXCopySubBufferMESA always ends one",
	  options_text, AT(frame_end), .words = frame_ends },
	{ "max-frames", 0, "N", "end the recording after N frames; the program keeps running", take_count, AT(max_frames) },
	{ "max-size", 0, "BYTES",
	  "end the recording after the first frame that makes the trace this large (K, M and G count 1024, 1024^2, "
	  "1024^3); the program keeps running",
	  options_bytes, AT(max_bytes) },
	{ "no-children", 0, NULL, "record only this process, not those that it starts", options_flag, AT(no_children) },
	{ "quit-after", 0, "N",
	  "end the recording and the program after N frames, or when nothing more can be recorded; exit with 0",
	  take_count, AT(quit_after) },
	{ "env", 0, "NAME=VALUE", "set a variable for the program; may be repeated", take_variable, .at = 0 },
};

static const struct options_table table = {
	.verb = "record",
	.head = "usage: relume record [OPTIONS] -- PROGRAM [ARGUMENTS]\n"
		"\n"
		"Run a program and record its OpenGL calls (GLX, EGL, OSMesa) into a trace in apitrace's format.\n"
		"Processes that the program starts are recorded as well, into NAME.1.trace and so on.\n"
		"SIGINT, SIGTERM, SIGHUP, SIGQUIT and SIGUSR1 are passed on to the program. SIGUSR2 switches recording "
	        "off and on\n"
		"again at the end of a frame. What the program makes and sets meanwhile is kept, so what follows is "
	        "complete.\n",
	OPTIONS_ROWS(rows),
	.notes = "Exits with the program's code; 2: wrong usage, 5: the program cannot be started, or called no OpenGL "
	         "and did not\n"
		 "fail itself, or the recording or its reference frames stopped early, as on a full disk. The "
	         "recording is whole\n"
		 "up to there, and the program keeps running; with --quit-after it ends.\n",
	.most = -1,
	.stops = 1,
};

static int set_trace(struct options *o, const char *name)
{
	char directory[PATH_MAX] = "";
	const char *base = strrchr(o->program[0], '/');
	int n;

	if (!name)
		name = base ? base + 1 : o->program[0];
	else
		base = NULL;
	if (name[0] != '/' && !getcwd(directory, sizeof(directory)))
		return err_report(ERR_SYSTEM, NULL, "cannot find the current directory: %s", strerror(errno));
	n = snprintf(o->trace, sizeof(o->trace), "%s%s%s%s", directory, directory[0] ? "/" : "", name,
	             base || name == o->program[0] ? ".trace" : "");
	if (n >= (int)sizeof(o->trace))
		return err_report(ERR_USAGE, name, "the name is too long");
	return 0;
}

/* Fills `o`; returns 0, ERR_* (reported), or 1 if the help text was printed. */
static int parse(int argc, char **argv, struct options *o)
{
	struct options_line line;
	int rc = options_parse(&table, argc, argv, o, &line);

	if (rc)
		return rc;
	if (!line.n_words)
		return err_report(ERR_USAGE, NULL, "no program to record; 'relume record --help' shows how");
	if (o->output && (!*o->output || o->output[strlen(o->output) - 1] == '/'))
		return err_report(ERR_USAGE, NULL, "'%s' is not a name for a trace", o->output);
	if (o->ref_exact && !o->ref)
		return err_report(ERR_USAGE, NULL, "--ref-exact is about what --ref keeps; say --ref color as well");
	o->paused |= o->start_key != NULL;
	o->program = line.words;
	return set_trace(o, o->output);
}

/*
 * If the recorder for 32-bit programs is there as well, the loader picks one: in the program and each process that it
 * starts, it replaces $LIB, on Debian with lib/x86_64-linux-gnu or lib/i386-linux-gnu.
 */
static void prefer_both(char *recorder, size_t size)
{
	static const char *const folders[] = { "lib/x86_64-linux-gnu", "lib/i386-linux-gnu", "$LIB" };
	const int folder = (int)(strrchr(recorder, '/') - recorder);
	char path[PATH_MAX];

	for (size_t i = 0; i < sizeof(folders) / sizeof(folders[0]); i++)
		if (snprintf(path, sizeof(path), "%.*s/%s/librelume.so", folder, recorder, folders[i]) >= (int)size ||
		    (folders[i][0] != '$' && access(path, R_OK)))
			return;
	strcpy(recorder, path);
}

static int find_recorder(char *out, size_t size)
{
	int rc = beside_find("librelume.so", out, size);

	if (!rc && strpbrk(out, " :"))
		rc = err_report(ERR_SYSTEM, out, "a library whose path holds a space or a colon cannot be preloaded; "
		                "install Relume elsewhere");
	if (!rc)
		prefer_both(out, size);
	return rc;
}

/* The statistics are in an anonymous file, which the program opens through our process. Nothing is left behind. */
struct figures {
	struct recorder_stats *stats;
	int fd;
};

static int make_figures(struct figures *out)
{
	void (*old)(int) = signal(SIGXFSZ, SIG_IGN);
	int rc = (out->fd = memfd_create("relume", MFD_CLOEXEC)) < 0 || ftruncate(out->fd, sizeof(*out->stats));

	if (!rc)
		out->stats = mmap(NULL, sizeof(*out->stats), PROT_READ | PROT_WRITE, MAP_SHARED, out->fd, 0);
	signal(SIGXFSZ, old);
	if (rc || out->stats == MAP_FAILED)
		return err_report(ERR_SYSTEM, NULL, "cannot map memory for the figures: %s", strerror(errno));
	return 0;
}

static void set_or_unset(const char *name, const char *value)
{
	if (value)
		setenv(name, value, 1);
	else
		unsetenv(name);
}

static void set_number(const char *name, uint64_t value)
{
	char text[MAX_NUMBER_BYTES];

	snprintf(text, sizeof(text), "%" PRIu64, value);
	set_or_unset(name, value ? text : NULL);
}

/* In the child, before it becomes the program. */
static void set_environment(const struct options *o, const char *recorder, int figures)
{
	const char *others = getenv("LD_PRELOAD");
	char preload[2 * PATH_MAX], path[64];
	/* a user namespace of its own (unshare -r) may not look into our process */
	int inherited = fcntl(figures, F_DUPFD, INHERITED_FD);

	snprintf(preload, sizeof(preload), "%s%s%s", recorder, others && *others ? ":" : "", others ? others : "");
	setenv("LD_PRELOAD", preload, 1);
	setenv("RELUME_TRACE", o->trace, 1);
	snprintf(path, sizeof(path), "/proc/%d/fd/%d", (int)getppid(), figures);
	setenv("RELUME_STATS", path, 1);
	set_number("RELUME_STATS_FD", inherited > 0 ? (uint64_t)inherited : 0);
	set_or_unset("RELUME_REF", o->ref);
	set_or_unset("RELUME_REF_EVERY", o->ref_every);
	if (o->ref_exact)
		setenv("LP_PERF", "no_rast_linear", 0);
	/* Qt keeps compiled shaders from run to run, as binaries of one driver: no recording could be replayed elsewhere */
	setenv("QT_DISABLE_SHADER_DISK_CACHE", "1", 0);
	set_or_unset("RELUME_MAX_FRAMES", o->max_frames);
	set_or_unset("RELUME_QUIT_AFTER", o->quit_after);
	set_or_unset("RELUME_FRAME_END", o->frame_end);
	set_or_unset("RELUME_FIRST_FRAME", o->first_frame);
	set_or_unset("RELUME_LAST_FRAME", o->last_frame);
	set_or_unset("RELUME_PRESS", o->press_plan);
	set_or_unset("RELUME_PAUSED", o->paused ? "1" : NULL);
	set_number("RELUME_MAX_SIZE", o->max_bytes);
	set_number("RELUME_ONLY_PROCESS", o->no_children ? (uint64_t)getpid() : 0);
}

static volatile sig_atomic_t child_pid;
static struct recorder_stats *shared; /* for the handler */

/* SIGALRM only wakes wait_for_child. */
static void forward(int signal)
{
	if (signal == SIGUSR2)
		shared->toggles++;
	else if (signal != SIGALRM && child_pid > 0)
		kill((pid_t)child_pid, signal);
}

/* SIGUSR2 is taken, not forwarded. */
static const int forwarded[] = { SIGALRM, SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2 };
enum { N_FORWARDED = sizeof(forwarded) / sizeof(forwarded[0]) };

/* 1 if a recorder has ended its program. */
static int was_told_to_quit(const struct recorder_stats *stats)
{
	for (uint32_t i = 0; i < stats_processes(stats); i++)
		if (stats->processes[i].quit)
			return 1;
	return 0;
}

/* 1 once a recording has calls, or at least their file's header. */
static int has_begun(const char *trace)
{
	struct stat st;

	return stat(trace, &st) == 0 && st.st_size > 0;
}

/*
 * Wait for the program, and watch it while it draws nothing; kill it some time after the recorder has ended it. Once it
 * has begun a recording, remove the earlier one.
 */
static int wait_for_child(const char *trace, const struct recorder_stats *stats, struct watching *watching)
{
	struct itimerval tick = { { 0, 1000000 / TICKS_A_SECOND }, { 0, 1000000 / TICKS_A_SECOND } },
			 off = { { 0, 0 }, { 0, 0 } };
	int status = 0, ticks = 0, begun = 0;

	setitimer(ITIMER_REAL, &tick, NULL);
	while (waitpid((pid_t)child_pid, &status, 0) < 0 && errno == EINTR) {
		if (!begun && (begun = has_begun(trace)))
			earlier_remove(trace);
		if (!stats->n_processes)
			watching_look((pid_t)child_pid, watching);
		else if (was_told_to_quit(stats) && ++ticks == PATIENCE_S * TICKS_A_SECOND)
			kill((pid_t)child_pid, SIGKILL);
	}
	setitimer(ITIMER_REAL, &off, NULL);
	return status;
}

/* Returns the program's wait status, or -1 with errno if it cannot be started. */
static int run_program(const struct options *o, const char *recorder, const struct figures *figures,
                       struct watching *watching)
{
	struct sigaction action = { .sa_handler = forward }, old[N_FORWARDED];
	char file[PATH_MAX];
	int pipe_fds[2],
		error = 0, status = 0,
		no_new_rights = executable_find(o->program[0], file, sizeof(file)) && executable_has_rights(file);
	pid_t watcher = -1;

	if (no_new_rights)
		err_warn(o->program[0], "runs without the rights of its file's owner or group: with them it cannot be recorded");
	if (pipe2(pipe_fds, O_CLOEXEC))
		return -1;
	/* Signals wait until the child has put the old handlers back and we know its number. */
	sigset_t all, before;
	sigfillset(&all);
	sigprocmask(SIG_BLOCK, &all, &before);
	for (int i = 0; i < N_FORWARDED; i++)
		sigaction(forwarded[i], &action, &old[i]);
	child_pid = fork();
	if (child_pid == 0) {
		for (int i = 0; i < N_FORWARDED; i++)
			sigaction(forwarded[i], &old[i], NULL);
		sigprocmask(SIG_SETMASK, &before, NULL);
		set_environment(o, recorder, figures->fd);
		if (no_new_rights)
			prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
		execvp(o->program[0], o->program);
		error = errno;
		if (write(pipe_fds[1], &error, sizeof(error)) < 0)
			_exit(127);
		_exit(127);
	}
	sigprocmask(SIG_SETMASK, &before, NULL);
	close(pipe_fds[1]);
	if (child_pid < 0) {
		close(pipe_fds[0]);
		return -1;
	}
	if (read(pipe_fds[0], &error, sizeof(error)) != sizeof(error))
		error = 0;
	close(pipe_fds[0]);
	if (!error && o->start_key)
		watcher = key_watch(o->start_key, SIGUSR2);
	status = wait_for_child(o->trace, figures->stats, watching);
	child_pid = 0;
	key_forget(watcher);
	for (int i = 0; i < N_FORWARDED; i++)
		sigaction(forwarded[i], &old[i], NULL);
	errno = error;
	return error ? -1 : status;
}

/*
 * The exit code, as ERR_*. A recording cut short outweighs the program's own exit code: the program keeps running, and
 * may well succeed.
 */
static int exit_code(const struct recorder_stats *stats, int status)
{
	for (uint32_t i = 0; i < stats_processes(stats); i++)
		if (stats->processes[i].failed || stats->processes[i].lost_references)
			return ERR_SYSTEM;
	if (was_told_to_quit(stats))
		return 0; /* however it reacted to the signal */
	return WIFSIGNALED(status) ? -(128 + WTERMSIG(status)) : -WEXITSTATUS(status);
}

/* Keys did not reach the program: this is not the run that the user asked to record. */
static int check_keys(const struct options *o, const struct recorder_stats *stats)
{
	if (stats->keys_lost)
		return err_report(ERR_SYSTEM, o->program[0],
		                  "--press: %u of %zu keys were lost: its window takes no key events of X (it may use "
		                  "Wayland, or XInput 2 alone)",
		                  stats->keys_lost, o->press.n);
	return stats->keys_pressed >= o->press.n ?
	               0 :
	               err_report(ERR_SYSTEM, o->program[0],
	                          "--press: %u of %zu keys were pressed: the program or the recording ended before "
	                          "the frames of the others",
	                          stats->keys_pressed, o->press.n);
}

/* A 32-bit program without a recorder: the loader would only warn, and nothing would be recorded. */
static int check_class(const char *program, const char *recorder)
{
	char path[PATH_MAX];

	if (strstr(recorder, "/$LIB/") || !executable_find(program, path, sizeof(path)) ||
	    executable_kind(path) != EXECUTABLE_32)
		return 0;
	return err_report(
		ERR_SYSTEM, program,
		"is a 32-bit program, but only the 64-bit recorder is installed; 'make i386' builds the other one, 'make "
		"deb-i386' its package relume32");
}

/* No recorder has reported. As exit_code, but never success without a recording. */
static int explain_nothing(const struct options *o, const struct recorder_stats *stats, const struct watching *watching,
                           int is_recorded, int status)
{
	const int code = exit_code(stats, status);

	if (!is_recorded) {
		summary_explain_nothing(o->program[0], stats, watching);
		return code ? code : ERR_SYSTEM;
	}
	err_warn(o->trace, "was recorded, but a sandbox kept the figures; 'relume info' shows what it holds");
	return o->quit_after && (code == -128 - SIGTERM) ? 0 : code; /* this is how the recorder ends a program */
}

static int record(int argc, char **argv, struct options *o)
{
	struct figures figures = { MAP_FAILED, -1 };
	struct watching watching = { 0 };
	char recorder[PATH_MAX];
	struct key_code key;
	int status, is_recorded, rc = parse(argc, argv, o);

	if (rc)
		return rc > 0 ? 0 : -rc;
	if (o->start_key && (rc = key_find("--start-key", o->start_key, &key)))
		return -rc;
	/* Only a recording that begins with the program counts its frames. */
	if ((rc = press_plan(&o->press, o->quit_after && !o->first_frame && !o->paused ? strtoull(o->quit_after, NULL, 10) : 0,
	                     &o->press_plan)))
		return -rc;
	if ((rc = find_recorder(recorder, sizeof(recorder))) || (rc = check_class(o->program[0], recorder)) ||
	    (rc = make_figures(&figures)))
		return -rc;
	if ((rc = earlier_set_aside(o->trace)))
		goto done;
	shared = figures.stats;
	status = run_program(o, recorder, &figures, &watching);
	if (status < 0)
		rc = err_report(ERR_SYSTEM, o->program[0], "cannot start: %s", strerror(errno));
	is_recorded = has_begun(o->trace);
	if (is_recorded)
		earlier_remove(o->trace);
	else
		earlier_put_back(o->trace);
	if (rc)
		goto done;
	summary_print(figures.stats);
	rc = figures.stats->n_processes ? exit_code(figures.stats, status) :
	                                  explain_nothing(o, figures.stats, &watching, is_recorded, status);
	if (!rc && o->press.n)
		rc = check_keys(o, figures.stats);
done:
	munmap(figures.stats, sizeof(*figures.stats));
	return -rc;
}

int record_main(int argc, char **argv)
{
	struct options o = { 0 };
	const int code = record(argc, argv, &o);

	press_free(&o.press);
	free(o.press_plan);
	return code;
}
