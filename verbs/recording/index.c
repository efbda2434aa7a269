/* relume index: build, describe or check the index of a trace. */
#include <inttypes.h>
#include <stdio.h>
#include <sys/stat.h>

#include "base/err.h"
#include "base/hash.h"
#include "base/options.h"
#include "base/verbs.h"
#include "base/json.h"
#include "replay/index/index_build.h"
#include "replay/index/index_check.h"
#include "replay/play/player.h"

struct asked {
	int force, check, json;
};

static const struct options_row rows[] = {
	{ "force", 0, NULL, "rebuild it even if it is up to date", options_flag,
	  .at = offsetof(struct asked, force) },
	{ "check", 0, NULL,
	  "compare the state that each checkpoint restores with the state that replaying the calls reaches (exit "
	  "code 1 if they differ)",
	  options_flag, .at = offsetof(struct asked, check) },
	{ "json", 'j', NULL, "as JSON", options_flag, .at = offsetof(struct asked, json) },
	{ OPTIONS_NO_SANDBOX },
};

static const struct options_table table = {
	.verb = "index",
	.head = "usage: relume index [OPTIONS] TRACE\n"
	        "\n"
	        "Build the index of a recording, which lets 'relume render' start at any frame at once. It is built on\n"
	        "first need anyway, and rebuilt if it is damaged or the recording has changed. The file is TRACE.index\n"
	        "beside the recording, or in $XDG_CACHE_HOME/relume (~/.cache/relume) if that folder is not writable.\n",
	OPTIONS_ROWS(rows),
	.takes = "one trace",
	.least = 1,
	.most = 1,
	.words_use = CONFINE_WRITES,
};

static uint64_t file_bytes(const char *path)
{
	struct stat info;

	return stat(path, &info) ? 0 : (uint64_t)info.st_size;
}

static void print_text(const char *trace, const struct index_facts *f)
{
	uint64_t bytes = file_bytes(trace);

	printf("trace        %s\n", trace);
	printf("index        %s\n", f->path ? f->path : "not saved");
	printf("frames       %" PRIu64 "%s\n", f->frames, f->damaged ? "; the trace is damaged after these" : "");
	printf("calls        %" PRIu64 "\n", f->calls);
	printf("checkpoints  %" PRIu64 ", sharing %" PRIu64 " blobs\n", f->checkpoints, f->blobs);
	printf("bytes        %" PRIu64 ", %.2f %% of the trace's\n", f->bytes,
	       bytes ? 100.0 * (double)f->bytes / (double)bytes : 0.0);
	if (f->build_s > 0)
		printf("built in     %.3f s\n", f->build_s);
}

static void print_json(const char *trace, const struct index_facts *f)
{
	struct json j = { .out = stdout };

	json_begin(&j, '{');
	json_key_string(&j, "trace", trace);
	json_key_string(&j, "index", f->path ? f->path : "");
	json_key_uint(&j, "frames", f->frames);
	json_key_uint(&j, "calls", f->calls);
	json_key_uint(&j, "damaged", (uint64_t)f->damaged);
	json_key_uint(&j, "checkpoints", f->checkpoints);
	json_key_uint(&j, "blobs", f->blobs);
	json_key_uint(&j, "bytes", f->bytes);
	json_key_uint(&j, "trace_bytes", file_bytes(trace));
	json_key_uint(&j, "build_us", (uint64_t)(f->build_s * 1e6));
	json_end(&j, '}');
	putchar('\n');
}

int index_main(int argc, char **argv)
{
	struct asked o = { 0 };
	struct options_line line;
	struct index *index = NULL;
	struct index_facts facts;
	struct player player = { 0 };
	char hash[33];
	int rc = options_parse(&table, argc, argv, &o, &line);

	if (!rc)
		rc = options_confine(&table, &line, CONFINE_READER, NULL);
	if (!rc)
		rc = player_open(&player, line.words[0]);
	if (!rc)
		rc = hash_name(line.words[0], trace_reader_size(player.reader), hash);
	if (!rc)
		rc = index_open(&index, line.words[0], hash, o.force ? INDEX_FORCE : INDEX_KEEP, &player);
	if (!rc) {
		facts = index_facts(index);
		if (o.json)
			print_json(line.words[0], &facts);
		else
			print_text(line.words[0], &facts);
		if (!facts.path)
			rc = err_report(ERR_SYSTEM, line.words[0], "its index could not be saved");
		else if (o.check)
			rc = index_check(index);
	}
	index_close(&index);
	player_close(&player);
	return rc > 0 ? 0 : -rc;
}
