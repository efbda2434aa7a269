/*
 * relume reduce: find the smallest recording that still makes a command fail, or still shows the fault of a frame.
 *
 * Calls are left out in ever finer steps (enum level), as long as the command ends with the same exit code as on the
 * whole recording. Calls that belong together (Begin and End, Push and Pop) are left out together.
 */
#include "verbs/recording/reduce.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/err.h"
#include "base/folder.h"
#include "base/memory.h"
#include "base/options.h"
#include "base/plural.h"
#include "base/verbs.h"
#include "replay/machine/commands.h"
#include "replay/trace/reader.h"
#include "replay/trace/trace_out.h"
#include "verbs/recording/parts.h"
#include "verbs/recording/shrink.h"

enum { MOST_AT_ONCE = 64, MOST_NESTED = 256, ALWAYS = 0, MOST_SECONDS = 24 * 3600, MOST_UNITS = 1 << 30 };
#define NO_FRAME UINT64_MAX

/* Size of the units that are left out. */
enum level {
	FRAMES, /* everything a frame draws, and its end */
	DRAWS,  /* a draw; a Begin up to its End */
	BLOCKS, /* a display list; its drawing; pairs; any other call */
	CALLS,  /* also calls between Begin and End, and in display lists */
	PARTS,  /* parts of the remaining calls: primitives, texels (parts.h) */
	N_LEVELS
};
static const char *const level_names[N_LEVELS] = { "frames", "draws", "blocks", "calls", "primitives and images" };

/* A call of the recording. */
struct place {
	uint64_t number; /* call number in the recording */
	int32_t command; /* index in gls_commands, or -1 */
	uint32_t frame;
	uint32_t begin, list, pair; /* index + 1 of the call that begins what this call is in, or ends; 0: none */
	uint32_t parts;  /* parts_count */
};

struct reduce {
	const char *path, *new;
	const char *when;         /* the command; NULL: reduce by a frame */
	uint64_t frame;           /* NO_FRAME: reduce by a command */
	const char *reference;    /* for the frame */
	reduce_note *note_fault;
	reduce_again *again;
	size_t fault;             /* index in `calls` of the fault's call */
	struct planted {
		uint64_t frame, call; /* place of the fault's first call in the last recording written */
		size_t calls;         /* number of calls it has become */
	} planted;
	unsigned at_once, limit_s;
	struct place *calls; /* [n] */
	size_t n, room;
	uint8_t *kept;       /* [n] */
	uint32_t *unit; /* [n]: number of the unit that a call is left out with at this level, or, for PARTS, of its
	                   first part, from 1; ALWAYS: never left out */
	enum level level;
	uint8_t *parts;      /* one per unit of PARTS, once they are known; NULL: calls are not divided */
	char folder[PATH_MAX - 64];
	uint64_t written;    /* number of calls in the last recording written */
	int code;            /* exit code of the command on the whole recording; or of a trial that shows the fault */
	uint64_t trials;
};

/* --- The recording ----------------------------------------------------------------------------------------------- */

static const struct {
	const char *open, *close;
} pairs[] = {
	{ "glBegin", "glEnd" }, { "glNewList", "glEndList" }, { "glPushMatrix", "glPopMatrix" },
	{ "glPushAttrib", "glPopAttrib" }, { "glPushClientAttrib", "glPopClientAttrib" }, { "glPushName", "glPopName" },
};
enum { PAIR_BEGIN, PAIR_LIST, N_PAIRS = sizeof(pairs) / sizeof(pairs[0]) };

/* Unfinished calls, as index + 1, innermost last. */
struct open_calls {
	uint32_t at[MOST_NESTED];
	unsigned n;
};

static void place_call(struct reduce *r, struct open_calls open[N_PAIRS], const char *name)
{
	struct place *p = &r->calls[r->n - 1];

	for (unsigned k = 0; k < N_PAIRS; k++) {
		struct open_calls *o = &open[k];

		if (strcmp(name, pairs[k].open) == 0 && o->n < MOST_NESTED)
			o->at[o->n++] = p->pair = (uint32_t)r->n;
		if (k == PAIR_BEGIN)
			p->begin = o->n ? o->at[0] : 0;
		if (k == PAIR_LIST)
			p->list = o->n ? o->at[0] : 0;
		if (strcmp(name, pairs[k].close) == 0 && o->n)
			p->pair = o->at[--o->n];
	}
}

static int ends_frame(const struct place *p)
{
	return p->command >= 0 && gls_commands[p->command].drawing == GLS_ENDS;
}

static int read_calls(struct reduce *r)
{
	struct open_calls open[N_PAIRS] = { { .n = 0 } };
	struct trace_reader *reader = NULL;
	const struct call *call;
	uint32_t frame = 0;
	int rc = trace_reader_open(&reader, r->path, gls_command_find);

	while (!rc && (rc = trace_reader_next(reader, &call)) == 1) {
		rc = MEMORY_GROW(r->calls, r->room, r->n + 1);
		if (rc)
			break;
		r->calls[r->n++] = (struct place){ .number = call->number, .command = call->sig->command, .frame = frame,
		                                   .parts = (uint32_t)parts_count(call) };
		place_call(r, open, call->sig->name);
		frame += ends_frame(&r->calls[r->n - 1]);
	}
	trace_reader_close(&reader);
	r->kept = malloc(r->n + 1);
	r->unit = calloc(r->n + 1, sizeof(*r->unit));
	if (!rc && (!r->kept || !r->unit))
		rc = err_report(ERR_SYSTEM, NULL, "out of memory");
	if (!rc)
		memset(r->kept, 1, r->n);
	return rc;
}

/* The remaining parts of a call. NULL: it is complete, or left out */
static const uint8_t *parts_in(const struct reduce *r, const uint8_t *in, size_t i)
{
	return in && r->level == PARTS && r->unit[i] != ALWAYS ? in + (r->unit[i] - 1) : NULL;
}

/*
 * in: units; NULL: everything kept. @return number of calls that a call becomes: 0 or 1, or any number for a draw
 * without some primitives
 */
static size_t becomes(const struct reduce *r, const uint8_t *in, size_t i, const struct call *call)
{
	const uint8_t *parts = parts_in(r, in, i);

	return parts ? parts_calls(call, parts) : r->kept[i] && (!in || r->unit[i] == ALWAYS || in[r->unit[i] - 1]);
}

/* Write the recording without the calls of units that are not in `in`. Notes the place of the fault's call. */
static int write_calls(struct reduce *r, const uint8_t *in, const char *path, uint64_t *bytes)
{
	struct trace_reader *reader = NULL;
	uint64_t frame = 0, written = 0;
	struct trace_out *out = NULL;
	const struct call *call;
	int rc = trace_reader_open(&reader, r->path, gls_command_find);

	if (!rc)
		rc = trace_out_open(&out, path, r->path, reader);
	for (size_t i = 0; i < r->n && !rc; i++) {
		const uint8_t *parts = parts_in(r, in, i);
		size_t n;

		rc = trace_reader_next(reader, &call);
		if (rc != 1) {
			rc = rc ? rc : err_report(ERR_INPUT, r->path, "changed while it was being read");
			break;
		}
		n = becomes(r, in, i, call);
		if (i == r->fault)
			r->planted = (struct planted){ frame, written, n };
		written += n;
		frame += n && ends_frame(&r->calls[i]);
		rc = !n ? 0 : parts ? parts_write(out, call, parts) : trace_out_call(out, call);
	}
	r->written = written;
	if (!rc)
		rc = trace_out_finish(&out, bytes);
	trace_out_drop(&out);
	trace_reader_close(&reader);
	return rc;
}

/* --- Trials ------------------------------------------------------------------------------------------------------ */

static void trial_path(const struct reduce *r, size_t i, const char *name, char out[PATH_MAX])
{
	snprintf(out, PATH_MAX, "%s/%zu%s", r->folder, i, name);
}

static void note_path(const struct reduce *r, char out[PATH_MAX])
{
	snprintf(out, PATH_MAX, "%s/fault", r->folder);
}

/* Does the last trial recording show the fault? A draw that was split is not looked at. @return as reduce_again */
static int ask(const struct reduce *r, const char *trace)
{
	char note[PATH_MAX];

	note_path(r, note);
	return r->planted.calls == 1 ? r->again(note, trace, r->planted.frame, r->planted.call) : 0;
}

/* Fork a process that dies with this one. @return its process; 0 in the child; ERR_SYSTEM (reported) */
static pid_t start_process(void)
{
	const pid_t pid = fork();

	if (pid < 0)
		return err_report(ERR_SYSTEM, "fork", "%s", strerror(errno));
	if (!pid) {
		prctl(PR_SET_PDEATHSIG, SIGKILL);
		setpgid(0, 0);
	}
	return pid;
}

/*
 * Start the command, or the search for the fault, on the last trial recording. @return its process; below 0: ERR_SYSTEM
 * (reported)
 */
static pid_t start(const struct reduce *r, size_t i)
{
	char trace[PATH_MAX], folder[PATH_MAX];
	const pid_t pid = start_process();
	int quiet;

	if (pid)
		return pid;
	trial_path(r, i, "/x.trace", trace);
	quiet = open("/dev/null", O_RDWR);
	dup2(quiet, STDIN_FILENO);
	dup2(quiet, STDOUT_FILENO);
	dup2(quiet, STDERR_FILENO);
	if (!r->when)
		_exit(ask(r, trace) == 1);
	setenv("TRACE", trace, 1);
	trial_path(r, i, "", folder);
	if (chdir(folder))
		_exit(127);
	execl("/bin/sh", "sh", "-c", r->when, (char *)NULL);
	_exit(127);
}

/* Wait for a process. @return its exit code, 128 + signal, or -1: it took too long, or cannot be waited for */
static int finish(pid_t pid, time_t until)
{
	int status = 0, late = 0;
	pid_t done;

	while ((done = waitpid(pid, &status, WNOHANG)) == 0) {
		if (time(NULL) > until && !late++)
			kill(-pid, SIGKILL);
		nanosleep(&(struct timespec){ .tv_nsec = 2000000 }, NULL);
	}
	if (done < 0 || late)
		return -1;
	return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

static void clear(const struct reduce *r, size_t i)
{
	char path[PATH_MAX];

	trial_path(r, i, "", path);
	folder_remove(path);
}

/* Run the command on some sets in parallel. codes: receive exit codes, as finish */
static int run_all(struct reduce *r, uint8_t *const *sets, size_t n, int *codes)
{
	pid_t pids[MOST_AT_ONCE];
	char path[PATH_MAX];
	size_t started = 0;
	int err = 0;

	for (; started < n && !err; started++) {
		trial_path(r, started, "", path);
		if (mkdir(path, 0777))
			err = err_report(ERR_SYSTEM, path, "%s", strerror(errno));
		trial_path(r, started, "/x.trace", path);
		if (!err)
			err = write_calls(r, sets[started], path, NULL);
		pids[started] = err ? err : start(r, started);
		err = pids[started] < 0 ? ERR_SYSTEM : err;
	}
	for (size_t i = 0; i < started; i++) {
		codes[i] = pids[i] < 0 ? -1 : finish(pids[i], time(NULL) + r->limit_s);
		clear(r, i);
	}
	r->trials += n;
	return err;
}

static int test(void *user, uint8_t *const *sets, size_t n, int *fails)
{
	struct reduce *r = user;
	int err = run_all(r, sets, n, fails);

	for (size_t i = 0; i < n; i++)
		fails[i] = fails[i] == r->code;
	return err;
}

/* Note the fault of the frame, in a process of its own because a device does not survive a fork. */
static int note_fault(struct reduce *r)
{
	const pid_t pid = start_process();
	uint64_t call = 0;
	char note[PATH_MAX];
	FILE *in;
	int code;

	note_path(r, note);
	if (!pid)
		_exit(-r->note_fault(r->path, r->reference ? r->reference : r->path, r->frame, note));
	code = pid < 0 ? -pid : finish(pid, time(NULL) + MOST_SECONDS);
	if (code)
		return code > 0 && code <= -ERR_SYSTEM ?
		               -code :
		               err_report(ERR_SYSTEM, r->path,
		                          "the frame's fault was not found: its process ended with %d", code);
	in = fopen(note, "r");
	if (!in || fscanf(in, "%" SCNu64, &call) != 1)
		code = err_report(ERR_SYSTEM, note, "cannot be read");
	if (in)
		fclose(in);
	while (r->fault < r->n && r->calls[r->fault].number != call)
		r->fault++;
	return code ? code : r->fault < r->n ? 0 : err_report(ERR_INPUT, r->path, "has no call %" PRIu64, call);
}

/* Run the command on the whole recording, twice. */
static int find_fault(struct reduce *r)
{
	const time_t begin = time(NULL);
	uint8_t *const all[2] = { NULL, NULL };
	int codes[2], err = r->when ? 0 : note_fault(r);

	r->limit_s = r->limit_s ? r->limit_s : MOST_SECONDS;
	if (!err)
		err = run_all(r, all, 1, codes);
	if (!err)
		err = run_all(r, all + 1, 1, codes + 1);
	if (err)
		return err;
	if (!r->when && !(codes[0] == 1 && codes[1] == 1))
		return err_report(ERR_USAGE, r->path, "frame %" PRIu64 " shows its fault in the recording but not in a copy of it",
		                  r->frame);
	if (codes[0] == 0)
		return err_report(
			ERR_USAGE, r->path,
			"the command ends with exit code 0 on the whole recording: there is nothing to look for");
	if (codes[0] != codes[1] || codes[0] < 0 || codes[0] == 127)
		return err_report(ERR_USAGE, r->path,
		                  "the command ends with exit code %d and then with %d on the same recording", codes[0],
		                  codes[1]);
	r->code = codes[0];
	if (r->limit_s == MOST_SECONDS)
		r->limit_s = (unsigned)(10 + 5 * (time(NULL) - begin));
	return 0;
}

/* --- Levels ------------------------------------------------------------------------------------------------------ */

static int draws(const struct place *p)
{
	return p->begin || (p->command >= 0 && gls_commands[p->command].drawing);
}

/* The call that identifies the unit of a call, as index + 1. */
static uint32_t name_of(const struct reduce *r, size_t i, enum level level)
{
	const struct place *p = &r->calls[i];

	switch (level) {
	case FRAMES: return draws(p) && !p->list ? p->frame + 1 : ALWAYS;
	case DRAWS: return p->list || !draws(p) ? ALWAYS : p->begin ? p->begin : (uint32_t)i + 1;
	case BLOCKS: return p->list ? p->list : p->begin ? p->begin : p->pair ? p->pair : (uint32_t)i + 1;
	case CALLS: return p->pair ? p->pair : (uint32_t)i + 1;
	default: return p->parts ? (uint32_t)i + 1 : ALWAYS;
	}
}

/*
 * Number the units of what is kept. numbers: room for one per call @return number of units; SIZE_MAX: out of memory
 * (reported)
 */
static size_t number_units(struct reduce *r, enum level level)
{
	uint32_t *numbers = calloc(r->n + 2, sizeof(*numbers));
	size_t n = 0;

	if (!numbers) {
		err_report(ERR_SYSTEM, NULL, "out of memory");
		return SIZE_MAX;
	}
	for (size_t i = 0; i < r->n; i++) {
		const uint32_t name = name_of(r, i, level);

		r->unit[i] = ALWAYS;
		if (!r->kept[i] || name == ALWAYS || n > MOST_UNITS)
			continue;
		if (!numbers[name]) {
			numbers[name] = (uint32_t)n + 1;
			n += level == PARTS ? r->calls[i].parts : 1;
		}
		r->unit[i] = numbers[name];
	}
	free(numbers);
	return n;
}

static size_t count(const uint8_t *in, size_t n)
{
	size_t sum = 0;

	for (size_t i = 0; i < n; i++)
		sum += in[i];
	return sum;
}

static int reduce_level(struct reduce *r, enum level level)
{
	const size_t n = number_units(r, level);
	uint8_t *in = n < SIZE_MAX ? malloc(n + 1) : NULL;
	int err = in ? 0 : ERR_SYSTEM;

	r->level = level;
	if (!err) {
		memset(in, 1, n);
		err = shrink(in, n, r->at_once, test, r);
	}
	for (size_t i = 0; i < r->n && !err && level < PARTS; i++)
		r->kept[i] = r->kept[i] && (r->unit[i] == ALWAYS || in[r->unit[i] - 1]);
	if (!err)
		fprintf(stderr, "%s: %zu of %zu needed; %" PRIu64 " trials\n", level_names[level], count(in, n), n, r->trials);
	if (level == PARTS)
		r->parts = in;
	else
		free(in);
	return err;
}

/* --- The command ------------------------------------------------------------------------------------------------- */

static int reduce(struct reduce *r)
{
	const char *tmp = getenv("TMPDIR");
	const time_t begin = time(NULL);
	char still[64] = "the fault is still there";
	uint64_t bytes = 0;
	int err = read_calls(r);

	if (!err && snprintf(r->folder, sizeof(r->folder), "%s/relume-reduce-XXXXXX", tmp && *tmp ? tmp : "/tmp") >=
	                    (int)sizeof(r->folder))
		err = err_report(ERR_SYSTEM, tmp, "the name is too long");
	if (!err && !mkdtemp(r->folder))
		err = err_report(ERR_SYSTEM, r->folder, "%s", strerror(errno));
	if (err)
		return err;
	err = find_fault(r);
	for (int level = 0; level < N_LEVELS && !err; level++)
		err = reduce_level(r, (enum level)level);
	folder_remove(r->folder);
	if (!err)
		err = write_calls(r, r->parts, r->new, &bytes);
	if (!err && r->when)
		snprintf(still, sizeof(still), "the command ends with exit code %d", r->code);
	if (!err)
		printf("%s: %" PRIu64 " of %zu calls, %" PRIu64 " bytes; %s; %" PRIu64 " trial%s in %ld s\n", r->new,
		       r->written, r->n, bytes, still, r->trials, plural(r->trials), (long)(time(NULL) - begin));
	return err;
}

#define AT(member) .at = offsetof(struct reduce, member)

static const struct options_row rows[] = {
	{ "when", 'w', "COMMAND",
	  "a shell command that fails on the recording $TRACE; it runs in a temporary folder",
	  options_text, AT(when) },
	{ "frame", 'f', "N", "instead of a command: reduce to the fault of a frame that fails its gates in mode gl",
	  options_frame, AT(frame) },
	{ "ref", 0, "REF",
	  "reference to compare the frame with, as for 'relume diff' (default: TRACE's own reference frames)", options_text,
	  AT(reference) },
	{ "output", 'o', "FILE", "the recording to write, created when complete", options_text, AT(new),
	  .is_required = 1 },
	{ "jobs", 'j', "N", "number of commands to run at once (default: one per core)", options_number, AT(at_once),
	  .most = MOST_AT_ONCE },
	{ "timeout", 0, "S",
	  "seconds until a command counts as passed (default: ten plus five times as long as the whole recording)",
	  options_number, AT(limit_s), .most = 86400 },
};

static const struct options_table table = {
	.verb = "reduce",
	.head = "usage: relume reduce TRACE --when COMMAND -o NEW\n"
	        "       relume reduce TRACE --frame N [--ref REF] -o NEW\n"
	        "\n"
	        "Find the smallest recording that still makes a command fail: leave out frames, then draws, calls,\n"
	        "primitives of draws from arrays and texels of images, as long as COMMAND ends with the same exit code\n"
	        "as on TRACE. apitrace's tools can play NEW as they can TRACE. None of its calls can be left out alone.\n"
	        "\n"
	        "For a frame that fails its gates, the draw to blame is looked for: it must keep showing the same colours\n"
	        "at the sixteen worst pixels. This keeps whatever makes a program's picture wrong. If Relume itself treats\n"
	        "a call wrongly, its picture may not need that call; a command that also draws with a real OpenGL keeps it.\n"
	        "\n"
	        "An example of a command: does the last frame still look different on Mesa?\n"
	        "\n"
	        "    relume reduce x.trace -o small.trace --when 'relume raster \"$TRACE\" -o r.####.png &&\n"
	        "        relume render \"$TRACE\" --mode gl --aov gl -o g.####.exr && relume diff r.####.png g.####.exr'\n",
	OPTIONS_ROWS(rows),
	.notes = "Exit codes: 0 done, 2 wrong usage or TRACE does not fail, 3 an input cannot be read, 5 the system "
	         "failed.\n",
	.takes = "one trace, --when with a command or --frame with a number, and -o with the file to write",
	.least = 1,
	.most = 1,
};

int reduce_main(int argc, char **argv, reduce_note *note, reduce_again *again)
{
	struct reduce r = { .frame = NO_FRAME, .note_fault = note, .again = again };
	struct options_line line;
	int err = options_parse(&table, argc, argv, &r, &line);

	if (!err && ((r.when != NULL) == (r.frame != NO_FRAME) || (r.reference && r.when)))
		err = options_misuse(&table);
	if (!err) {
		const long cores = sysconf(_SC_NPROCESSORS_ONLN);

		r.path = line.words[0];
		r.at_once = r.at_once ? r.at_once : cores > MOST_AT_ONCE ? MOST_AT_ONCE : (unsigned)cores;
		err = reduce(&r);
	}
	free(r.calls);
	free(r.kept);
	free(r.unit);
	free(r.parts);
	return err > 0 ? 0 : -err;
}
