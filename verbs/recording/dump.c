/* relume dump: print a trace's calls as text, in the style of `apitrace dump`. */
#include <inttypes.h>
#include <stdio.h>

#include "base/err.h"
#include "base/frames.h"
#include "base/options.h"
#include "base/plural.h"
#include "base/verbs.h"
#include "replay/trace/reader.h"
#include "replay/trace/text.h"

static void print_call(FILE *out, const struct call *c)
{
	fprintf(out, "%" PRIu64 " ", c->number);
	if (c->thread)
		fprintf(out, "@%" PRIu64 " ", c->thread);
	text_call(out, c);
	fputc('\n', out);
}

struct dump {
	struct frame_list calls;
};

static int take_calls(const struct options_row *row, const char *value, void *out)
{
	(void)row;
	frame_list_free(out);
	return frame_list_parse_of(value, "range of calls", out);
}

static const struct options_row rows[] = {
	{ "calls", 'c', "LIST", "only these calls: \"100\", \"0-50\", \"0-1000x10\", or several with commas",
	  take_calls, .at = offsetof(struct dump, calls) },
	{ OPTIONS_NO_SANDBOX },
};

static const struct options_table table = {
	.verb = "dump",
	.head = "usage: relume dump [OPTIONS] TRACE\n"
	        "\n"
	        "Print one line per call: number, thread (@n, unless it is 0), name and arguments.\n",
	OPTIONS_ROWS(rows),
	.takes = "one trace", .least = 1, .most = 1, .words_use = CONFINE_RECORDING,
};

int dump_main(int argc, char **argv)
{
	struct dump o = { 0 };
	struct options_line line;
	struct trace_reader *reader = NULL;
	const struct call *call;
	uint64_t last, first = 0, seen = 0, printed = 0;
	int rc = options_parse(&table, argc, argv, &o, &line);

	if (!rc)
		rc = options_confine(&table, &line, CONFINE_READER, NULL);
	if (!rc)
		rc = trace_reader_open(&reader, line.words[0], NULL);
	if (rc)
		goto done;
	last = frame_list_last(&o.calls);
	while ((rc = trace_reader_next(reader, &call)) == 1) {
		seen++;
		if (frame_list_contains(&o.calls, call->number)) {
			print_call(stdout, call);
			printed++;
		}
		/* Calls are ordered by their return: earlier calls of other threads may still follow. */
		if (last < UINT64_MAX && call->number > last + 1024)
			break;
	}
	frame_list_next(&o.calls, 0, &first);
	if (!rc && !printed && o.calls.n_ranges)
		rc = err_report(ERR_USAGE, line.words[0], "there is no call %" PRIu64 "; the trace has %" PRIu64 " call%s, from 0 on",
		                first, seen, plural(seen));
	if (rc == 1)
		rc = 0;
	if (fflush(stdout) || ferror(stdout))
		rc = err_report(ERR_SYSTEM, NULL, "standard output cannot be written");
done:
	trace_reader_close(&reader);
	frame_list_free(&o.calls);
	return rc > 0 ? 0 : -rc;
}
