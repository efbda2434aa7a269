/* The command: finds the verb, nothing else. */
#include <stdio.h>
#include <string.h>

#include "base/err.h"
#include "base/manual.h"
#include "base/memory.h"
#include "base/nearest.h"
#include "base/verbs.h"
#include "base/version.h"
#include "diff/diff.h"
#include "replay/draw_names.h"
#include "verbs/bisect/wrong.h"
#include "verbs/recording/reduce.h"

/* diff/ opens no replay: replay/ tells it what draws were. */
static int diff_with_names(int argc, char **argv)
{
	return diff_main(argc, argv, replay_name_draws);
}

/* nor does replay/ render and score. */
static int reduce_with_pictures(int argc, char **argv)
{
	return reduce_main(argc, argv, wrong_note, wrong_again);
}

/* The groups of `relume help`, in its order. */
enum group { GROUP_FIRST, GROUP_INSPECT, GROUP_RENDER, GROUP_COMPARE, GROUP_FARM, GROUP_RESEARCH, N_GROUPS };

static const char *const group_titles[N_GROUPS] = {
	[GROUP_FIRST] = "First steps",
	[GROUP_INSPECT] = "Record and inspect",
	[GROUP_RENDER] = "Render",
	[GROUP_COMPARE] = "Compare",
	[GROUP_FARM] = "Farm",
	[GROUP_RESEARCH] = "Research",
};

static const struct verb {
	enum group group;
	const char *name;
	int (*main)(int argc, char **argv);
	const char *summary;
} verbs[] = {
	{ GROUP_FIRST, "record", record_main, "run a program and record its OpenGL calls" },
	{ GROUP_FIRST, "info", info_main, "show what a recording holds: frames, calls, what is not supported" },
	{ GROUP_FIRST, "render", render_main, "ray trace frames of a recording to OpenEXR, PNG or JPEG" },
	{ GROUP_FIRST, "look", look_main, "study a recording: write rules about lights and surfaces for render" },
	{ GROUP_FIRST, "film", film_main, "make a film of rendered frames, beside what the program showed" },
	{ GROUP_FIRST, "diff", diff_with_names, "score traced frames against rasterized ones, or any two sets" },
	{ GROUP_FIRST, "approve", approve_main, "make traced frames the baseline that later ones are compared with" },
	{ GROUP_FIRST, "ci", ci_main, "record programs, render what they drew, and gate the frames" },

	{ GROUP_INSPECT, "index", index_main, "index a recording, so that rendering starts at any frame at once" },
	{ GROUP_INSPECT, "dump", dump_main, "print a recording's calls as text" },
	{ GROUP_INSPECT, "scene", scene_main, "print the scene of a frame" },
	{ GROUP_INSPECT, "export", export_main, "write a frame as glTF, for other programs" },
	{ GROUP_INSPECT, "trim", trim_main, "cut a recording down to some frames" },
	{ GROUP_INSPECT, "repair", repair_main, "save what can be read of a truncated or damaged recording" },

	{ GROUP_RENDER, "pick", pick_main, "say what a pixel of a frame shows, and write a rule for it" },
	{ GROUP_RENDER, "denoise", denoise_main, "take the noise out of rendered frames" },
	{ GROUP_RENDER, "devices", devices_main, "list the OpenCL devices, and check what they draw" },

	{ GROUP_COMPARE, "raster", raster_main, "rasterize frames of a recording with a real OpenGL" },
	{ GROUP_COMPARE, "bisect", bisect_main, "find the first call where two recordings of a program diverge" },
	{ GROUP_COMPARE, "reduce", reduce_with_pictures,
	  "find the smallest recording that still makes a frame or a command fail" },

	{ GROUP_FARM, "farm", farm_main, "render on many machines, by Slurm array jobs or scripts" },

	{ GROUP_RESEARCH, "hook", hook_main, "try your own functions for stages of the ray tracer" },
	{ GROUP_RESEARCH, "query", query_main, "ask what rays hit, how far surfaces are, what moving bodies meet" },
	{ GROUP_RESEARCH, "bench", bench_main, "measure the tracer's kernels" },
};

static void print_help(FILE *out)
{
	fputs("usage: relume VERB [OPTIONS] ...\n"
	      "\n"
	      "Ray trace what a legacy OpenGL program draws, from a recording.\n"
	      "\n",
	      out);
	for (size_t i = 0; i < sizeof(verbs) / sizeof(verbs[0]); i++) {
		if (i == 0 || verbs[i].group != verbs[i - 1].group)
			fprintf(out, "%s%s:\n\n", i ? "\n" : "", group_titles[verbs[i].group]);
		fprintf(out, "  %-9s %s\n", verbs[i].name, verbs[i].summary);
	}
	fputs("\n"
	      "Help:\n"
	      "\n"
	      "  help      this text, or 'relume help VERB' for a verb's own\n"
	      "\n"
	      "Formats of files, for 'relume help':\n"
	      "\n",
	      out);
	for (const struct manual_text *format = manual_formats; format->name; format++)
		fprintf(out, "  %-12s %s\n", format->name, format->summary);
	fputs("\n"
	      "relume --version prints the version.\n"
	      "\n"
	      "Exit codes: 0 done and passed, 1 compared and failed, 2 wrong usage, 3 input unreadable,\n"
	      "4 baseline new or missing, 5 a device or the system failed, 6 rendered, but draws are missing.\n"
	      "\n"
	      "Examples:\n",
	      out);
	fputs(manual_find(manual_examples, "relume")->text, out);
}

static const struct verb *find_verb(const char *name)
{
	for (size_t i = 0; i < sizeof(verbs) / sizeof(verbs[0]); i++)
		if (strcmp(verbs[i].name, name) == 0)
			return &verbs[i];
	return NULL;
}

static int refuse(const char *typed, int is_help)
{
	struct nearest nearest = { .typed = typed };

	for (size_t i = 0; i < sizeof(verbs) / sizeof(verbs[0]); i++)
		nearest_try(&nearest, verbs[i].name);
	for (const struct manual_text *format = manual_formats; is_help && format->name; format++)
		nearest_try(&nearest, format->name);
	return err_report(ERR_USAGE, NULL, "unknown %s '%s'; %s%s%s'relume help' lists them",
	                  is_help ? "topic" : "command", typed, nearest.word ? "did you mean '" : "",
	                  nearest.word ? nearest.word : "", nearest.word ? "'? " : "");
}

/* Buffered output may not be written yet: a full disk must show in the exit code. */
static int finish(int code)
{
	if ((fflush(stdout) || ferror(stdout)) && code == 0)
		return -err_report(ERR_SYSTEM, NULL, "standard output cannot be written");
	return code;
}

int main(int argc, char **argv)
{
	const struct manual_text *format;
	const struct verb *verb;
	int wants_help;

	memory_use_large_pages();
	if (argc < 2) {
		print_help(stderr);
		return -ERR_USAGE;
	}
	wants_help = strcmp(argv[1], "help") == 0;
	if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0 ||
	    (wants_help && (argc == 2 || strcmp(argv[2], "help") == 0))) {
		print_help(stdout);
		return 0;
	}
	if (strcmp(argv[1], "--version") == 0 || strcmp(argv[1], "-V") == 0) {
		printf("relume %s\n", RELUME_VERSION);
		return 0;
	}
	format = wants_help ? manual_find(manual_formats, argv[2]) : NULL;
	if (format) {
		fputs(format->text, stdout);
		return finish(0);
	}
	verb = find_verb(argv[wants_help ? 2 : 1]);
	if (!verb)
		return -refuse(argv[wants_help ? 2 : 1], wants_help);
	if (wants_help)
		return finish(verb->main(2, (char *[]){ argv[2], "--help", NULL }));
	return finish(verb->main(argc - 1, argv + 1));
}
