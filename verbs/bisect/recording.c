#include "verbs/bisect/recording.h"

#include <fnmatch.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "base/err.h"
#include "base/memory.h"
#include "base/table.h"
#include "replay/machine/commands.h"
#include "replay/trace/reader.h"
#include "verbs/bisect/names.h"

/* Reasons in replay/overlay.txt for commands that change nothing: queries and waits. */
static const char *const idle[] = {
	"a query", "only the program sees how many samples were counted", "nothing is ever pending",
	"time does not pass in a replay", "it manages memory of the program",
	"it changes which events the program gets, not what it draws",
};

/* Facts about a command, kept by signature. */
enum { COUNTS = 1, IS_IDLE, IS_MARKER };

static int matches(const char *patterns, const char *name)
{
	char *copy = strdup(patterns), *rest = copy;
	int found = 0;

	for (char *word = strsep(&rest, ","); word && !found; word = strsep(&rest, ","))
		found = fnmatch(word, name, 0) == 0;
	free(copy);
	return found;
}

static uintptr_t judge(const struct call_sig *sig, const char *ignore, int all)
{
	const char *excuse = sig->command >= 0 ? gls_commands[sig->command].excuse : NULL;

	if (ignore && matches(ignore, sig->name))
		return IS_IDLE;
	if (!all && strcmp(sig->name, "glGetError") == 0)
		return IS_IDLE;
	for (size_t i = 0; !all && excuse && i < sizeof(idle) / sizeof(idle[0]); i++)
		if (strcmp(excuse, idle[i]) == 0)
			return IS_IDLE;
	return strcmp(sig->name, "glStringMarkerGREMEDY") == 0 ? IS_MARKER : COUNTS;
}

/* The recorder notes the time of each frame. */
static int tells_time(const struct call *c)
{
	return c->n_args > 1 && c->args[1].type == TRACE_STRING && strncmp(c->args[1].str, "relume:time", 11) == 0;
}

static int add_call(struct recording *r, const struct call *c)
{
	struct recording_call *call;

	if (MEMORY_GROW(r->calls, r->room, r->n + 1))
		return ERR_SYSTEM;
	call = &r->calls[r->n++];
	*call = (struct recording_call){ names_hash(c), XXH3_64bits(c->sig->name, strlen(c->sig->name)), r->n_all };
	if (c->sig->command < 0 || gls_commands[c->sig->command].drawing != GLS_ENDS)
		return 0;
	r->n_ended++;
	r->n_frames++;
	if (MEMORY_GROW(r->frames, r->frames_room, r->n_frames + 2))
		return ERR_SYSTEM;
	r->frames[r->n_frames] = r->n;
	return 0;
}

int recording_read(struct recording *r, const char *path, const char *ignore, int all)
{
	struct trace_reader *reader = NULL;
	struct table known = { .n = 0 };
	const struct call *c;
	int rc;

	*r = (struct recording){ .path = path };
	rc = MEMORY_GROW(r->frames, r->frames_room, 2);
	if (!rc)
		r->frames[0] = 0;
	if (!rc)
		rc = trace_reader_open(&reader, path, gls_command_find);
	for (; !rc && (rc = trace_reader_next(reader, &c)) == 1; r->n_all++) {
		uintptr_t what = (uintptr_t)table_find(&known, (uintptr_t)c->sig);

		rc = 0;
		if (!what) {
			what = judge(c->sig, ignore, all);
			rc = table_set(&known, (uintptr_t)c->sig, (void *)what);
		}
		if (!rc && (what == COUNTS || (what == IS_MARKER && !tells_time(c))))
			rc = add_call(r, c);
	}
	if (!rc && r->frames[r->n_frames] < r->n)
		r->frames[++r->n_frames] = r->n;
	if (!rc && !r->n)
		rc = err_report(ERR_INPUT, path, "holds no calls that count");
	table_free(&known);
	trace_reader_close(&reader);
	return rc;
}

void recording_free(struct recording *r)
{
	free(r->calls);
	free(r->frames);
	*r = (struct recording){ .path = NULL };
}

size_t recording_frame(const struct recording *r, size_t call)
{
	size_t low = 0, high = r->n_frames;

	while (low + 1 < high) {
		const size_t middle = (low + high) / 2;

		if (r->frames[middle] <= call)
			low = middle;
		else
			high = middle;
	}
	return low;
}
