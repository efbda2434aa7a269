#include "replay/machine/errors.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"
#include "capture/format/call.h"
#include "replay/machine/commands.h"
#include "replay/machine/machine.h"

#define REPEATED (1u << 16)
#define REPEATED_A_CALL 128
#define MOST_REASONS 64

const char gls_needs_renderer[] = "needs pixels that were drawn: only a renderer has them";
const char gls_programs[] = "programs: drawn as fixed function";

void gls_error(struct gls_exec *x, struct gls_state *st, uint32_t error)
{
	gls_set_error(st, error);
	x->counts.errors[x->command]++;
	x->counts.error_code[x->command] = error;
}

const char *gls_reason(struct gls_exec *x, const char *why)
{
	struct gls_counts *counts = &x->counts;
	char *copy = NULL;

	for (uint32_t i = counts->n_reasons; i-- > 0;)
		if (strcmp(counts->reasons[i], why) == 0)
			return counts->reasons[i];
	if (counts->n_reasons < MOST_REASONS && MEMORY_GROW(counts->reasons, counts->reason_room, counts->n_reasons + 1) == 0)
		copy = strdup(why);
	if (!copy)
		return "a program's shaders do not compile here";
	counts->reasons[counts->n_reasons++] = copy;
	return copy;
}

void gls_unsupported(struct gls_exec *x, const char *why)
{
	x->counts.unsupported[x->command]++;
	if (why != gls_needs_renderer || !x->counts.why[x->command])
		x->counts.why[x->command] = why;
}

void gls_rewind(struct gls_exec *x, const char *why)
{
	struct gls_feedback *f = &x->feedback;

	if (!f->rewind) {
		f->rewind_why = why;
		f->rewind_command = x->command;
		f->rewind_call = x->call ? x->call->number : 0;
	}
	f->rewind = 1;
}

void gls_out_of_memory(struct gls_exec *x, size_t bytes)
{
	if (!x->failed)
		x->failed = err_report(ERR_SYSTEM, x->path, "out of memory for %zu bytes at call %llu (%s)", bytes,
		                       x->call ? (unsigned long long)x->call->number : 0, gls_commands[x->command].name);
}

void gls_fail(struct gls_exec *x)
{
	if (!x->failed)
		x->failed = ERR_SYSTEM;
}

void *gls_scratch(struct gls_exec *x, size_t n)
{
	if (n > x->scratch.room) {
		uint8_t *grown = realloc(x->scratch.bytes, n);
		if (!grown) {
			gls_out_of_memory(x, n);
			return NULL;
		}
		x->scratch.bytes = grown;
		x->scratch.room = n;
	}
	return x->scratch.bytes;
}

void *gls_object_create(struct gls_exec *x, struct table *t, uint64_t name, size_t n)
{
	void *object = calloc(1, n);

	if (object && !table_set(t, name, object))
		return object;
	free(object);
	gls_out_of_memory(x, n);
	return NULL;
}

int gls_is_beyond_measure(struct gls_exec *x, uint64_t n, const char *why)
{
	uint64_t most = REPEATED + REPEATED_A_CALL * x->call->number;

	if (x->repeated_frame != x->frame) {
		x->repeated_frame = x->frame;
		x->repeated = 0;
	}
	if (x->repeated > most || n > most - x->repeated) {
		gls_unsupported(x, why);
		return 1;
	}
	x->repeated += n;
	return 0;
}
