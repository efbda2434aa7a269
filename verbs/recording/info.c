/* relume info: describe a trace. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/err.h"
#include "base/memory.h"
#include "base/options.h"
#include "base/plural.h"
#include "base/verbs.h"
#include "base/json.h"
#include "replay/replay.h"
#include "scene/release.h"

#define TOP_CALLS 20

/* Frames that may show earlier contents, as ranges. */
struct frame_ranges {
	uint64_t (*ranges)[2];
	size_t n, room;
	uint64_t frames;
};

static int add_frame(struct frame_ranges *r, uint64_t frame)
{
	r->frames++;
	if (r->n && r->ranges[r->n - 1][1] + 1 == frame) {
		r->ranges[r->n - 1][1] = frame;
		return 0;
	}
	if (MEMORY_GROW(r->ranges, r->room, r->n + 1))
		return ERR_SYSTEM;
	r->ranges[r->n][0] = r->ranges[r->n][1] = frame;
	r->n++;
	return 0;
}

static void print_ranges(const struct frame_ranges *r)
{
	printf("feedback    %" PRIu64 " frame%s may show what earlier ones drew:", r->frames, plural(r->frames));
	for (size_t i = 0; i < r->n && i < TOP_CALLS; i++) {
		printf("%s %" PRIu64, i ? "," : "", r->ranges[i][0]);
		if (r->ranges[i][1] > r->ranges[i][0])
			printf("-%" PRIu64, r->ranges[i][1]);
	}
	puts(r->n > TOP_CALLS ? ", ..." : "");
}

struct asked {
	int all, json;
};

static const struct options_row rows[] = {
	{ "all", 'a', NULL, "list every command that was called, not only the most frequent ones", options_flag,
	  .at = offsetof(struct asked, all) },
	{ "json", 'j', NULL, "as JSON", options_flag, .at = offsetof(struct asked, json) },
	{ OPTIONS_NO_SANDBOX },
};

static const struct options_table table = {
	.verb = "info",
	.head = "usage: relume info [OPTIONS] TRACE\n"
	        "\n"
	        "Describe a trace: frames, calls, contexts, drawable size, frames that may show what earlier ones drew\n"
	        "(uncleared screens, screen copies), calls that Relume does not support yet, and the GL errors that the\n"
	        "program itself caused.\n",
	OPTIONS_ROWS(rows),
	.takes = "one trace", .least = 1, .most = 1, .words_use = CONFINE_RECORDING,
};

/* How a recording is rendered, one line for each peculiarity. */
static void print_needs(const struct replay_needs *needs)
{
	if (needs->programs)
		printf("shaders     rendered as fixed function: %" PRIu64
		       " draw%s by shaders or programs that are not run\n",
		       needs->programs, plural(needs->programs));
	if (needs->several_windows)
		puts("windows     several: frames are in the order of their buffer swaps");
	if (needs->single_buffered)
		puts("buffers     one: frames end where the program flushes");
}

static void print_programs(const struct replay_program *programs, size_t n)
{
	if (n)
		puts("\nprograms that draws used");
	for (size_t i = 0; i < n; i++)
		printf("%12" PRIu64 "  %s %" PRIu32 "\n", programs[i].draws, programs[i].kind, programs[i].name);
}

static void print_counts(const char *title, const struct replay_count *counts, size_t n, size_t limit)
{
	if (!n)
		return;
	printf("\n%s\n", title);
	for (size_t i = 0; i < n && i < limit; i++)
		printf("%12" PRIu64 "  %s%s%s\n", counts[i].count, counts[i].name, counts[i].why ? ": " : "",
		       counts[i].why ? counts[i].why : "");
	if (n > limit)
		printf("              and %zu more (--all lists them)\n", n - limit);
}

/* Number of entries at the end that only a renderer supports. */
static size_t count_rendered(const struct replay_count *counts, size_t n)
{
	size_t rendered = 0;

	while (rendered < n && replay_is_rendered(&counts[n - rendered - 1]))
		rendered++;
	return rendered;
}

static void print_text(struct replay *rp, const char *path, size_t limit, const struct frame_ranges *earlier)
{
	const struct replay_count *counts;
	const struct replay_context *contexts;
	const struct replay_program *programs;
	struct replay_needs needs;
	size_t n, n_rendered;

	printf("trace       %s\n", path);
	printf("hash        %s\n", replay_trace_hash(rp));
	if (*replay_program(rp))
		printf("program     %s\n", replay_program(rp));
	printf("frames      %" PRIu64 "\n", replay_frame(rp));
	printf("calls       %" PRIu64 "\n", replay_call_count(rp));
	n = replay_contexts(rp, &contexts);
	for (size_t i = 0; i < n; i++)
		printf("context     0x%" PRIx64 ": %s, drawable %ux%u, %" PRIu64 " call%s%s\n", contexts[i].handle, contexts[i].api,
		       contexts[i].width, contexts[i].height, contexts[i].calls, plural(contexts[i].calls),
		       contexts[i].shares ? ", shares objects" : "");
	if (earlier->n)
		print_ranges(earlier);
	needs = replay_needs(rp);
	print_needs(&needs);
	n = replay_calls(rp, &counts);
	print_counts("calls by name", counts, n, limit);
	n = replay_programs(rp, &programs);
	print_programs(programs, n);
	n = replay_unsupported(rp, &counts);
	n_rendered = count_rendered(counts, n);
	if (n == n_rendered)
		puts("\nevery call is executed");
	print_counts("not supported yet", counts, n - n_rendered, (size_t)-1);
	if (n_rendered)
		print_counts("supported by 'relume render' only", counts + (n - n_rendered), n_rendered, (size_t)-1);
	n = replay_gl_errors(rp, &counts);
	print_counts("GL errors that the program caused", counts, n, (size_t)-1);
}

static void json_counts(struct json *j, const char *name, const struct replay_count *counts, size_t n, const char *why)
{
	json_key_begin(j, name, '[');
	for (size_t i = 0; i < n; i++) {
		json_begin(j, '{');
		json_key_string(j, "call", counts[i].name);
		json_key_uint(j, "count", counts[i].count);
		if (why && counts[i].why)
			json_key_string(j, why, counts[i].why);
		json_end(j, '}');
	}
	json_end(j, ']');
}

static void print_json(struct replay *rp, const char *path, const struct frame_ranges *earlier)
{
	struct json j = { .out = stdout };
	const struct replay_count *counts;
	const struct replay_context *contexts;
	const struct replay_program *programs;
	struct replay_needs needs;
	size_t n;

	json_begin(&j, '{');
	json_key_string(&j, "trace", path);
	json_key_string(&j, "hash", replay_trace_hash(rp));
	json_key_string(&j, "program", replay_program(rp));
	json_key_uint(&j, "frames", replay_frame(rp));
	json_key_uint(&j, "calls", replay_call_count(rp));
	json_key_begin(&j, "show_earlier", '[');
	for (size_t i = 0; i < earlier->n; i++) {
		json_begin(&j, '[');
		json_uint(&j, earlier->ranges[i][0]);
		json_uint(&j, earlier->ranges[i][1]);
		json_end(&j, ']');
	}
	json_end(&j, ']');
	json_key_begin(&j, "contexts", '[');
	n = replay_contexts(rp, &contexts);
	for (size_t i = 0; i < n; i++) {
		json_begin(&j, '{');
		json_key_uint(&j, "handle", contexts[i].handle);
		json_key_string(&j, "api", contexts[i].api);
		json_key_uint(&j, "width", contexts[i].width);
		json_key_uint(&j, "height", contexts[i].height);
		json_key_uint(&j, "calls", contexts[i].calls);
		json_key_uint(&j, "shares", (uint64_t)contexts[i].shares);
		json_end(&j, '}');
	}
	json_end(&j, ']');
	needs = replay_needs(rp);
	json_key_begin(&j, "needs", '{');
	json_key_uint(&j, "program_draws", needs.programs);
	json_key_uint(&j, "several_windows", (uint64_t)needs.several_windows);
	json_key_uint(&j, "single_buffered", (uint64_t)needs.single_buffered);
	json_end(&j, '}');
	n = replay_programs(rp, &programs);
	json_key_begin(&j, "programs", '[');
	for (size_t i = 0; i < n; i++) {
		json_begin(&j, '{');
		json_key_string(&j, "kind", programs[i].kind);
		json_key_uint(&j, "name", programs[i].name);
		json_key_uint(&j, "draws", programs[i].draws);
		json_end(&j, '}');
	}
	json_end(&j, ']');
	n = replay_calls(rp, &counts);
	json_counts(&j, "calls_by_name", counts, n, NULL);
	n = replay_unsupported(rp, &counts);
	json_counts(&j, "unsupported", counts, n, "why");
	n = replay_gl_errors(rp, &counts);
	json_counts(&j, "gl_errors", counts, n, "error");
	json_end(&j, '}');
	putchar('\n');
}

int info_main(int argc, char **argv)
{
	struct asked o = { 0 };
	struct options_line line;
	struct frame_ranges earlier = { 0 };
	struct replay *rp = NULL;
	struct scene *scene = NULL;
	int rc = options_parse(&table, argc, argv, &o, &line);

	if (!rc)
		rc = options_confine(&table, &line, CONFINE_READER, NULL);
	if (!rc)
		rc = replay_open(&rp, line.words[0]);
	if (rc)
		return rc > 0 ? 0 : -rc;
	/* Build the frames, so that unsupported drawing is found as well. */
	while ((rc = replay_next_frame(rp, 1, &scene)) == 1) {
		/* The first frame starts with an empty window. */
		rc = scene->frame && (scene->needs_previous || scene->shows_earlier) ? add_frame(&earlier, scene->frame) : 0;
		scene_release(&scene);
		if (rc)
			break;
	}
	if (rc == 0 || replay_frame(rp)) {
		if (o.json)
			print_json(rp, line.words[0], &earlier);
		else
			print_text(rp, line.words[0], o.all ? (size_t)-1 : TOP_CALLS, &earlier);
	}
	if (rc == 0 && replay_lacks_counts(rp))
		rc = ERR_SYSTEM;
	replay_close(&rp);
	free(earlier.ranges);
	return -rc;
}
