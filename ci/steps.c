/* Records, renders and compares one program, each by a relume command in a process of its own. */
#include "ci/steps.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/err.h"
#include "base/folder.h"
#include "base/part.h"
#include "base/plural.h"
#include "base/program.h"
#include "ci/server.h"
#include "ci/watched.h"

enum { MOST_WORDS = 24 };

struct steps {
	const struct ci_run *run;
	const struct ci_program *program;
	char out[PATH_MAX / 2]; /* KEPT/NAME */
	char trace[PATH_MAX];
	uint64_t n_frames;      /* frames in the recording */
};

static char *path_in(const struct steps *s, const char *name, char out[PATH_MAX])
{
	snprintf(out, PATH_MAX, "%s/%s", s->out, name);
	return out;
}

static void say(const struct steps *s, const char *step)
{
	printf("%s: %s", s->program->name, step);
}

/* Remove the results of an earlier run, which would pass for those of this one. */
static void clear_results(const struct steps *s)
{
	static const char *const files[] = { "junit.xml", "scores.json", "summary.md" };
	char path[PATH_MAX];

	for (size_t i = 0; i < sizeof(files) / sizeof(files[0]); i++)
		unlink(path_in(s, files[i], path));
	if (access(path_in(s, "report", path), F_OK) == 0)
		folder_remove(path);
}

/* Report a failed step as a result, so that the server shows it along with failed frames. */
static void write_error(const struct steps *s, const char *step, int code)
{
	char path[PATH_MAX];
	struct part_file file;

	if (access(path_in(s, "junit.xml", path), F_OK) == 0)
		return;
	server_mark_failure(s->program, step, code);
	if (!part_open(&file, path_in(s, "summary.md", path))) {
		fprintf(file.stream, "### relume ci %s\n\n%s failed with exit code %d; the log says why\n\n",
		        s->program->name, step, code);
		part_close(&file, 0);
	}
	if (part_open(&file, path_in(s, "junit.xml", path)))
		return;
	fprintf(file.stream,
	        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n"
	        "  <testsuite name=\"relume ci %s\" tests=\"1\" failures=\"0\" errors=\"1\">\n"
	        "    <testcase classname=\"relume.ci.%s\" name=\"%s\">\n"
	        "      <error message=\"exit code %d; the log says why\"/>\n"
	        "    </testcase>\n  </testsuite>\n</testsuites>\n", s->program->name, s->program->name, step, code);
	part_close(&file, 0);
}

/* --- Record ------------------------------------------------------------------------------------------------------ */

/* Lock the display for this process (F_WRLCK), or unlock it (F_UNLCK). */
static void hold_display(const struct steps *s, short type)
{
	struct flock lock = { .l_type = type, .l_whence = SEEK_SET };

	while (s->run->display_lock >= 0 && fcntl(s->run->display_lock, F_SETLKW, &lock) && errno == EINTR)
		;
}

static size_t put_words(char **argv, size_t n, const char *option, char *const *values, uint32_t n_values)
{
	for (uint32_t i = 0; i < n_values; i++) {
		if (option)
			argv[n++] = (char *)option;
		argv[n++] = values[i];
	}
	return n;
}

static int record(const struct steps *s)
{
	const struct ci_program *p = s->program;
	const size_t most = 2 * ((size_t)p->n_environment + p->n_press) + p->n_command + MOST_WORDS;
	char **argv = calloc(most, sizeof(*argv)), frames[16];
	char *display[] = { "xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -nolisten tcp" };
	char *first[] = {
		(char *)s->run->relume, "record", "-o", (char *)s->trace, "--ref", "color,depth", "--quit-after", frames,
	};
	size_t n = 0;
	int code;

	if (!argv)
		return -err_report(ERR_SYSTEM, NULL, "out of memory");
	snprintf(frames, sizeof(frames), "%u", p->frames);
	if (s->run->own_displays)
		n = put_words(argv, n, NULL, display, sizeof(display) / sizeof(*display));
	n = put_words(argv, n, NULL, first, sizeof(first) / sizeof(*first));
	n = put_words(argv, n, "--env", p->environment, p->n_environment);
	n = put_words(argv, n, "--press", p->press, p->n_press);
	argv[n++] = (char *)"--";
	put_words(argv, n, NULL, p->command, p->n_command);
	hold_display(s, F_WRLCK);
	code = program_run(argv);
	hold_display(s, F_UNLCK);
	free(argv);
	if (code < 0)
		return -code;
	/* Either the program's own code, or that of 'relume record', which has reported the reason. */
	return code ? -err_report(ERR_SYSTEM, p->name, "'%s' was not recorded: 'relume record' ended with exit code %d",
	                          p->command[0], code) :
	              0;
}

static void say_watched(const struct steps *s, const struct watched *w)
{
	say(s, "");
	printf("watched: %zu file%s, listed in %s/inputs; other files that the program opens are not watched: "
	       "name them with --data\n", w->n_files, plural(w->n_files), s->out);
	if (w->not_watched[0]) {
		say(s, "");
		printf("not watched: folders named by its arguments (%s)\n", w->not_watched);
	}
}

/*
 * Record, unless all watched inputs are as they were. An input that changes while it is recorded counts as changed next
 * time.
 */
static int record_if_changed(const struct steps *s, const char *program)
{
	char kept[PATH_MAX], why[PATH_MAX + 64];
	struct watched w = { 0 };
	int code = -watched_collect(s->program, program, &w), changed = 1;

	path_in(s, "inputs", kept);
	if (!code && s->run->when_changed) {
		changed = watched_changed(&w, kept, why, sizeof(why));
		if (!changed && access(s->trace, R_OK) != 0) {
			snprintf(why, sizeof(why), "its recording is gone");
			changed = 1;
		}
		say_watched(s, &w);
	}
	if (!code && !changed) {
		say(s, "recorded nothing: no watched input has changed\n");
	} else if (!code) {
		say(s, "record");
		printf(s->run->when_changed ? " %u frame%s: %s\n" : " %u frame%s\n", s->program->frames,
		       plural(s->program->frames), why);
		unlink(kept);
		code = record(s);
		if (!code)
			code = -watched_keep(&w, kept);
	}
	watched_free(&w);
	return code;
}

/* --- Render ------------------------------------------------------------------------------------------------------ */

static int count_frames(struct steps *s)
{
	char *text = NULL;
	const int code = program_read((char *[]){ (char *)s->run->relume, "info", "--json", s->trace, NULL }, 0, &text);
	const char *at = text ? strstr(text, "\"frames\": ") : NULL;

	if (at)
		s->n_frames = strtoull(at + strlen("\"frames\": "), NULL, 10);
	free(text);
	if (code)
		return code < 0 ? -code : code;
	return s->n_frames ? 0
		: -err_report(ERR_SYSTEM, s->program->name, "'%s' showed no frame", s->program->command[0]);
}

/* Parse the number in NAME.0012.exr. @return 1; 0 for any other file */
static int parse_frame(const struct steps *s, const char *name, uint64_t *frame)
{
	const size_t n = strlen(s->program->name);
	char *end;

	if (strncmp(name, s->program->name, n) != 0 || name[n] != '.' || !isdigit((unsigned char)name[n + 1]))
		return 0;
	*frame = strtoull(name + n + 1, &end, 10);
	return strcmp(end, ".exr") == 0;
}

/* Remove frames of a longer, earlier recording, which would be proposed for approval. */
static void remove_stale_frames(const struct steps *s)
{
	char folder[PATH_MAX], path[PATH_MAX + NAME_MAX + 2];
	DIR *dir = opendir(path_in(s, "frames", folder));
	uint64_t frame;

	for (struct dirent *entry; dir && (entry = readdir(dir));)
		if (parse_frame(s, entry->d_name, &frame) && frame >= s->n_frames) {
			snprintf(path, sizeof(path), "%s/%s", folder, entry->d_name);
			if (unlink(path))
				err_warn(path, "a frame of an earlier recording cannot be removed");
		}
	if (dir)
		closedir(dir);
}

static int render(const struct steps *s)
{
	char pattern[PATH_MAX + NAME_MAX];
	int code;

	snprintf(pattern, sizeof(pattern), "%s/frames/%s.####.exr", s->out, s->program->name);
	code = program_run((char *[]){ (char *)s->run->relume, "render", (char *)s->trace, "-o", pattern, "--skip-existing",
	                               "--allow-incomplete", NULL });
	return code < 0 ? -code : code;
}

/* --- Compare ----------------------------------------------------------------------------------------------------- */

static int compare(const struct steps *s)
{
	char report[PATH_MAX], junit[PATH_MAX], scores[PATH_MAX], summary[PATH_MAX], frames[PATH_MAX];
	char baseline[PATH_MAX], list[32];
	const char *config = s->program->config;
	char *argv[MOST_WORDS] = {
		(char *)s->run->relume, "diff", "--all", "-f", list, "--baseline", baseline,
		"--report", path_in(s, "report", report), "--junit", path_in(s, "junit.xml", junit), "--json",
		path_in(s, "scores.json", scores), "--markdown", path_in(s, "summary.md", summary),
	};
	size_t n = 0;
	int code;

	/* Ignore approved frames beyond those requested; an approved frame below that limit is missing if not drawn. */
	snprintf(list, sizeof(list), "0-%u", s->program->frames - 1);
	snprintf(baseline, sizeof(baseline), "%s/%s", s->run->baseline, s->program->name);
	while (argv[n])
		n++;
	if (server_reads_commands())
		argv[n++] = (char *)"--annotations";
	if (config) {
		argv[n++] = (char *)"--config";
		argv[n++] = (char *)config;
	}
	argv[n++] = (char *)s->trace;
	argv[n++] = path_in(s, "frames", frames);
	code = program_run(argv);
	if (code < 0)
		return -code;
	if (access(report, F_OK) == 0) {
		say(s, "");
		printf("page: %s/index.html\n", report);
	}
	if (code == -ERR_BASELINE) {
		say(s, "");
		printf("not all of these frames are approved; once they are right, run: relume approve %s %s\n", frames,
		       baseline);
	}
	return code;
}

int ci_run_program(const struct ci_run *run, const struct ci_program *program)
{
	struct steps s = { .run = run, .program = program };
	const char *step = "record";
	char path[PATH_MAX];
	int code;

	if (snprintf(s.out, sizeof(s.out), "%s/%s", run->kept, program->name) >= (int)sizeof(s.out) - NAME_MAX - 16)
		return -err_report(ERR_USAGE, run->kept, "the name is too long");
	snprintf(s.trace, sizeof(s.trace), "%s/%s.trace", s.out, program->name);
	code = -folder_make(s.out);
	if (code)
		return code;
	clear_results(&s);
	if (program_find(program->command[0], path, sizeof(path)))
		code = record_if_changed(&s, path);
	else
		code = -err_report(ERR_SYSTEM, program->name, "program not found: '%s'", program->command[0]);
	if (!code)
		code = count_frames(&s);
	if (!code) {
		step = "render";
		remove_stale_frames(&s);
		code = render(&s);
	}
	if (!code) {
		step = "diff";
		code = compare(&s);
	}
	if (code)
		write_error(&s, step, code);
	fflush(stdout);
	return code;
}
