/* relume repair: save the intact part of a truncated or damaged trace as a new trace. */
#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <unistd.h>

#include "base/err.h"
#include "base/options.h"
#include "base/plural.h"
#include "base/verbs.h"
#include "capture/format/ref.h"
#include "replay/machine/commands.h"
#include "replay/trace/reader.h"
#include "replay/trace/trace_out.h"

struct asked {
	const char *new;
};

static const struct options_row rows[] = {
	{ "output", 'o', "FILE", "the recording to write, created when complete",
	  options_text, .at = offsetof(struct asked, new), .is_required = 1, .use = CONFINE_WRITES },
	{ OPTIONS_NO_SANDBOX },
};

static const struct options_table table = {
	.verb = "repair",
	.head = "usage: relume repair -o NEW TRACE\n"
	        "\n"
	        "Save what can be read of a recording that was cut short (a full disk, a machine that went down) or\n"
	        "damaged: every call that had returned before that point. NEW is complete and packed in Snappy chunks,\n"
	        "whatever TRACE was packed in. Nothing after the damage can be read, because calls depend on what comes\n"
	        "before them. Damage that changes bytes but leaves them readable goes unnoticed, as recordings have no\n"
	        "checksums. If another recording follows in the same file, only the first is kept, and a line says how\n"
	        "many bytes the other one has.\n",
	OPTIONS_ROWS(rows),
	.notes = "Exit codes: 0 NEW is a complete recording, 3 nothing could be saved.\n",
	.takes = "one trace and -o with the file to write",
	.least = 1,
	.most = 1,
	.words_use = CONFINE_RECORDING,
};

struct saved {
	uint64_t calls, frames;
	uint64_t bytes; /* unpacked bytes up to the end of the last call kept */
};

/* @return 0 at the end of what can be read, or ERR_SYSTEM */
static int save_calls(struct trace_reader *r, struct trace_out *out, struct saved *saved)
{
	struct trace_place place;
	const struct call *call;
	int rc;

	while ((rc = trace_reader_next(r, &call)) == 1) {
		if (call->incomplete)
			continue;
		rc = trace_out_call(out, call);
		if (rc)
			return rc;
		trace_reader_place(r, &place);
		saved->calls++;
		saved->frames += call->sig->command >= 0 && gls_commands[call->sig->command].drawing == GLS_ENDS;
		saved->bytes = place.offset;
	}
	return rc == ERR_SYSTEM ? rc : 0;
}

/* Reference frames are found by the recording's name: say how the new one gets those of the old. */
static void tell_references(const char *path, const char *new)
{
	char from[PATH_MAX], to[PATH_MAX];

	if (ref_beside(path, from, sizeof(from)) || ref_beside(new, to, sizeof(to)))
		return;
	if (access(from, F_OK) == 0 && access(to, F_OK) != 0)
		printf("refs  %s has the reference frames: cp %s %s, or name it: relume diff %s FRAMES\n", from, from, to, from);
}

static int repair(const char *path, const char *new)
{
	struct saved saved = { 0 };
	struct trace_reader *r = NULL;
	struct trace_out *out = NULL;
	struct trace_place end;
	uint64_t unread, unfinished, behind;
	int rc = trace_reader_open(&r, path, gls_command_find);

	if (!rc)
		rc = trace_out_open(&out, new, path, r);
	if (!rc)
		rc = save_calls(r, out, &saved);
	if (!rc && saved.calls == 0)
		rc = err_report(ERR_INPUT, path, "it has no complete call; there is nothing to save");
	if (!rc)
		rc = trace_out_finish(&out, NULL);
	if (!rc) {
		trace_reader_place(r, &end);
		behind = trace_reader_behind(r);
		unread = behind ? 0 : trace_reader_size(r) - trace_reader_offset(r);
		unfinished = end.number > saved.calls ? end.number - saved.calls : 0;
		printf("kept  %" PRIu64 " call%s, %" PRIu64 " frame%s, %" PRIu64 " bytes unpacked\n", saved.calls,
		       plural(saved.calls), saved.frames, plural(saved.frames), saved.bytes);
		printf("lost  %" PRIu64 " call%s that had not returned, %" PRIu64 " bytes unpacked, and %" PRIu64
		       " of the file's %" PRIu64 " bytes that cannot be read\n",
		       unfinished, plural(unfinished), end.offset - saved.bytes, unread, trace_reader_size(r));
		if (behind)
			printf("left  %" PRIu64
			       " bytes of another recording, which follows in the file: tail -c %" PRIu64
			       " %s > SECOND.trace\n",
			       behind, behind, path);
		tell_references(path, new);
	}
	trace_out_drop(&out);
	trace_reader_close(&r);
	return rc;
}

int repair_main(int argc, char **argv)
{
	struct asked o = { 0 };
	struct options_line line;
	int rc = options_parse(&table, argc, argv, &o, &line);

	if (!rc)
		rc = options_confine(&table, &line, CONFINE_READER, NULL);
	if (!rc)
		rc = repair(line.words[0], o.new);
	return rc > 0 ? 0 : -rc;
}
