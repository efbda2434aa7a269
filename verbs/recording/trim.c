/*
 * relume trim: cut some frames of a trace out as a new trace.
 *
 * It keeps all calls of the frames asked for, and, of the frames before them, the calls that create objects and state
 * (early.h). If the frames show what earlier frames drew, the new trace starts early enough to include those as well.
 */
#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/err.h"
#include "base/frames.h"
#include "base/options.h"
#include "base/verbs.h"
#include "capture/format/ref.h"
#include "verbs/recording/early.h"
#include "replay/machine/commands.h"
#include "replay/trace/reader.h"
#include "replay/replay.h"
#include "replay/trace/trace_out.h"

struct trim {
	const char *path, *new;
	uint64_t wanted, first, last; /* frames; wanted: the first one asked for, first: the first one kept */
	struct trace_out *out;
	uint64_t n_calls, n_kept;
};

/* ---- the first frame to keep ---- */

/* Do frames from `from` on need pixels of earlier ones? @return as replay_needs_skipped */
static int needs_earlier(const struct trim *t, uint64_t from)
{
	struct replay *rp = NULL;
	int rc = from ? replay_open(&rp, t->path) : 1;

	rc = rc ? rc : replay_seek(rp, from);
	if (rc == 1 && from)
		rc = replay_needs_skipped(rp, t->last);
	else if (rc >= 0)
		rc = 0;
	replay_close(&rp);
	return rc;
}

/* Step back in growing steps: a program that never clears its window must be kept from its beginning anyway. */
static int find_first(struct trim *t)
{
	struct replay *rp = NULL;
	uint64_t frames, step = 1;
	int damaged, rc = replay_open(&rp, t->path);

	rc = rc ? rc : replay_frame_count(rp, &frames, &damaged);
	replay_close(&rp);
	if (!rc && t->last == UINT64_MAX && t->wanted != UINT64_MAX)
		t->last = t->wanted < frames ? frames - 1 : t->wanted; /* to the end of the trace */
	if (!rc && t->last >= frames)
		rc = frame_report_missing(t->path, t->last, frames);
	t->first = t->wanted;
	while (!rc && (rc = needs_earlier(t, t->first)) == 1) {
		t->first -= step < t->first ? step : t->first;
		step *= 2;
		rc = 0;
	}
	return rc;
}

/* ---- calls ---- */

static int copy_calls(struct trim *t, struct trace_reader *r)
{
	struct early *early = NULL;
	const struct call *call;
	uint64_t frame = 0;
	int rc = early_create(&early, t->out);

	while (!rc && frame <= t->last) {
		int ends;

		rc = trace_reader_next(r, &call);
		if (rc <= 0) {
			rc = rc ? rc : err_report(ERR_INPUT, t->path, "changed while it was being read");
			break;
		}
		ends = call->sig->command >= 0 && gls_commands[call->sig->command].drawing == GLS_ENDS;
		t->n_calls++;
		t->n_kept += frame >= t->first;
		rc = frame < t->first ? early_put(early, call) : trace_out_call(t->out, call);
		frame += (uint64_t)ends;
		if (!rc && ends && frame == t->first)
			rc = early_end(early);
	}
	t->n_kept += early ? early_count(early) : 0;
	early_destroy(&early);
	return rc;
}

/* ---- reference frames ---- */

/* @return 1 copied; 0 there are none; ERR_* (reported) */
static int copy_references(const struct trim *t, const char *from, const char *to)
{
	struct ref_file ref = { 0 };
	int rc;

	if (access(from, F_OK) != 0)
		return 0;
	rc = ref_open(&ref, from);
	if (!rc)
		rc = ref_copy(&ref, t->first, t->last, to);
	ref_close(&ref);
	return rc ? rc : 1;
}

/* ---- the command ---- */

static void say(const struct trim *t, uint64_t bytes, uint64_t whole_bytes)
{
	printf("%s: frames %" PRIu64 "-%" PRIu64 " as 0-%" PRIu64 ", %" PRIu64 " of %" PRIu64 " calls, %" PRIu64
	       " of %" PRIu64 " bytes\n",
	       t->new, t->first, t->last, t->last - t->first, t->n_kept, t->n_calls, bytes, whole_bytes);
	if (t->first < t->wanted)
		printf("%s: frame %" PRIu64 " may show what was drawn from frame %" PRIu64
		       " on; those frames are kept as well, and it is now frame %" PRIu64 "\n",
		       t->new, t->wanted, t->first, t->wanted - t->first);
}

static int trim(struct trim *t)
{
	char ref[PATH_MAX], new_ref[PATH_MAX];
	struct trace_reader *r = NULL;
	uint64_t bytes, whole_bytes;
	int rc = trace_reader_open(&r, t->path, gls_command_find), have_ref = 0;

	if (!rc)
		rc = trace_out_open(&t->out, t->new, t->path, r);
	rc = rc ? rc : ref_beside(t->path, ref, sizeof(ref));
	rc = rc ? rc : ref_beside(t->new, new_ref, sizeof(new_ref));
	rc = rc ? rc : find_first(t);
	rc = rc ? rc : copy_calls(t, r);
	if (!rc) {
		whole_bytes = trace_reader_size(r);
		have_ref = copy_references(t, ref, new_ref);
		rc = have_ref < 0 ? have_ref : trace_out_finish(&t->out, &bytes);
		if (have_ref <= 0 || rc)
			unlink(new_ref); /* left by an older recording of that name, or there is no trace for it */
	}
	if (!rc)
		say(t, bytes, whole_bytes);
	trace_out_drop(&t->out);
	trace_reader_close(&r);
	return rc;
}

static int take_frames(const struct options_row *row, const char *text, void *out)
{
	struct trim *t = out;
	struct frame_list list = { 0 };
	int rc = frame_list_parse(text, &list);

	(void)row;
	if (rc)
		return rc;
	if (list.n_ranges == 1 && (list.ranges[0].step == 1 || list.ranges[0].first == list.ranges[0].last)) {
		t->wanted = list.ranges[0].first;
		t->last = list.ranges[0].last;
	} else {
		rc = err_report(ERR_USAGE, NULL, "trim keeps a range of consecutive frames, FIRST-LAST, not '%s'", text);
	}
	frame_list_free(&list);
	return rc;
}

static const struct options_row rows[] = {
	{ "frames", 'f', "RANGE", "the frames to keep: 100-120, or 7", take_frames, .at = 0, .is_required = 1 },
	{ "output", 'o', "FILE", "the recording to write, created when complete",
	  options_text, .at = offsetof(struct trim, new), .is_required = 1, .use = CONFINE_WRITES },
	{ OPTIONS_NO_SANDBOX },
};

static const struct options_table table = {
	.verb = "trim",
	.head = "usage: relume trim -f FIRST-LAST -o NEW TRACE\n"
	        "\n"
	        "Cut a recording down to some of its frames. NEW is self-contained: it holds all calls of these frames,\n"
	        "and the calls of earlier frames that create objects and state, so that it shows the same pictures, here\n"
	        "and in apitrace's tools. Its frames are counted from 0. If FIRST may show what earlier frames drew (a\n"
	        "screen that is not cleared, or is copied), NEW begins early enough to include those frames, and trim\n"
	        "says so. Reference frames beside TRACE (TRACE.ref) are cut to match.\n",
	OPTIONS_ROWS(rows),
	.notes = "Exit codes: 0 done, 2 wrong usage or no such frames, 3 TRACE cannot be read, 5 NEW cannot be "
	         "written.\n",
	.takes = "one trace, -f with the frames and -o with the file to write",
	.least = 1,
	.most = 1,
	.words_use = CONFINE_RECORDING,
};

int trim_main(int argc, char **argv)
{
	struct trim t = { 0 };
	struct options_line line;
	int rc = options_parse(&table, argc, argv, &t, &line);

	if (!rc)
		rc = options_confine(&table, &line, CONFINE_READER, NULL);
	if (!rc) {
		t.path = line.words[0];
		rc = trim(&t);
	}
	return rc > 0 ? 0 : -rc;
}
