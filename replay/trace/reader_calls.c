#include "replay/trace/reader_calls.h"

#include <stdlib.h>

#include "base/err.h"
#include "replay/trace/container.h"
#include "replay/trace/cut.h"
#include "replay/trace/reader_sigs.h"
#include "replay/trace/reader_values.h"

#define MAX_PENDING 1024       /* maximum number of calls that have not returned */
#define ARENA_KEEP (64u << 20) /* memory of a call that is kept for the next one */

/* ---- details ---- */

static void skip_backtrace(struct trace_reader *r, struct arena *a)
{
	uint64_t n = reader_uint(r);

	for (uint64_t i = 0; i < n && r->status == 0; i++) {
		if (!reader_frame_sig(r))
			continue;
		for (unsigned tag = reader_byte(r); tag != TRACE_FRAME_END && r->status == 0; tag = reader_byte(r)) {
			if (tag <= TRACE_FRAME_FILE)
				reader_string(r, a, NULL);
			else if (tag <= TRACE_FRAME_OFFSET)
				reader_uint(r);
			else
				reader_fail(r, "a stack frame of unknown form");
		}
	}
}

static void read_details(struct trace_reader *r, struct reader_call *p)
{
	struct call *call = &p->call;

	for (;;) {
		unsigned tag = reader_byte(r);
		uint64_t index;
		if (r->status)
			return;
		switch (tag) {
		case TRACE_DETAIL_END:
			return;
		case TRACE_DETAIL_ARGUMENT:
			index = reader_uint(r);
			if (index >= READER_MAX_ARGS) {
				reader_fail(r, "an argument number that is too large");
				return;
			}
			for (; call->n_args <= index; call->n_args++)
				p->args[call->n_args].type = TRACE_NONE;
			reader_value(r, &p->arena, &p->args[index], 0);
			if (r->status)
				p->args[index].type = TRACE_NONE;
			break;
		case TRACE_DETAIL_RESULT:
			reader_value(r, &p->arena, &call->ret, 0);
			if (r->status)
				call->ret.type = TRACE_NONE;
			break;
		case TRACE_DETAIL_BACKTRACE:
			skip_backtrace(r, &p->arena);
			break;
		case TRACE_DETAIL_FLAGS:
			call->flags |= (uint32_t)reader_uint(r);
			break;
		default:
			reader_fail(r, "a detail of unknown kind");
		}
		if (r->status)
			return;
	}
}

/* Mark arguments from `first` on as not recorded so far. */
static inline void forget_args(struct reader_call *p, uint32_t first)
{
	for (; first < p->call.n_args; first++)
		p->args[first].type = TRACE_NONE;
}

/*
 * Read details at p as long as they have the common, short form.
 * @param known  number of arguments that are set; the others are set when this returns
 * @param whole  receives 1: these were all; 0: read_details must continue
 * @return the position after them
 */
static inline const uint8_t *quick_details(struct trace_reader *r, const uint8_t *p, struct reader_call *pending,
                                           uint32_t known, int *whole)
{
	const uint8_t *next, *const end = r->end;
	const uint32_t n_args = pending->call.n_args < 0x80 ? pending->call.n_args : 0x80;
	struct trace_value *v;

	*whole = 0;
	while (end - p >= READER_QUICK_BYTES + 2) {
		if (*p == TRACE_DETAIL_ARGUMENT && p[1] < n_args) {
			for (; known < p[1]; known++)
				pending->args[known].type = TRACE_NONE;
			v = &pending->args[p[1]];
			next = p + 2;
		} else if (*p == TRACE_DETAIL_RESULT) {
			v = &pending->call.ret;
			next = p + 1;
		} else {
			*whole = *p == TRACE_DETAIL_END;
			p += *whole;
			break;
		}
		if (*next == TRACE_FLOAT)
			next = reader_quick_float(next + 1, v);
		else if (*next == TRACE_ARRAY)
			next = reader_quick_array(r, next, &pending->arena, v);
		else
			next = reader_quick_scalar(r, next, v);
		if (!next)
			break;
		known += v == &pending->args[known];
		p = next;
	}
	forget_args(pending, known);
	return p;
}

/* ---- events ---- */

static struct reader_call *another_pending(struct trace_reader *r)
{
	struct reader_call **grown, *p;

	for (size_t i = 0; i < r->n_pending; i++)
		if (!r->pending[i]->in_use)
			return r->entered = r->pending[i];
	if (r->n_pending == MAX_PENDING) {
		reader_fail(r, "too many calls that never returned");
		return NULL;
	}
	grown = realloc(r->pending, (r->n_pending + 1) * sizeof(*grown));
	if (grown)
		r->pending = grown;
	p = grown ? calloc(1, sizeof(*p)) : NULL;
	if (!p) {
		r->status = err_report(ERR_SYSTEM, r->path, "out of memory");
		return NULL;
	}
	r->pending[r->n_pending++] = p;
	return r->entered = p;
}

static inline struct reader_call *new_pending(struct trace_reader *r)
{
	return r->entered && !r->entered->in_use ? r->entered : another_pending(r);
}

void reader_release_call(struct reader_call *p)
{
	if (p->arena.current)
		arena_reset(&p->arena, ARENA_KEEP);
	p->in_use = 0;
}

/* Start a call; its arguments are not read yet. */
static inline void begin_call(struct reader_call *p, uint64_t thread, const struct call_sig *sig)
{
	p->call = (struct call){
		.thread = thread, .sig = sig, .n_args = sig->n_args, .args = p->args, .ret.type = TRACE_NONE
	};
}

/* Read the details of an ENTER event from r->p on, up to its end. */
static void end_enter(struct trace_reader *r, struct reader_call *p)
{
	read_details(r, p);
	if (r->status) {
		reader_release_call(p);
		return;
	}
	p->call.number = r->next_number++;
	p->in_use = 1;
}

static void read_enter(struct trace_reader *r)
{
	struct reader_call *p = new_pending(r);
	const struct call_sig *sig;
	uint64_t thread;

	if (!p)
		return;
	thread = r->version >= 4 ? reader_uint(r) : 0;
	sig = reader_call_sig(r);
	if (!sig)
		return;
	begin_call(p, thread, sig);
	forget_args(p, 0);
	end_enter(r, p);
}

/* @return the call that has returned, or NULL: reading failed, or its ENTER is unknown */
static struct reader_call *read_leave(struct trace_reader *r)
{
	uint64_t number = reader_uint(r);
	struct reader_call *p = NULL, unknown;

	if (r->entered && r->entered->in_use && r->entered->call.number == number)
		p = r->entered;
	for (size_t i = 0; i < r->n_pending && !p; i++)
		if (r->pending[i]->in_use && r->pending[i]->call.number == number)
			p = r->pending[i];
	if (p) {
		read_details(r, p);
		/* Truncated within the return: the call itself is complete, and end_of_calls delivers it. */
		return r->status ? NULL : p;
	}
	memset(&unknown, 0, sizeof(unknown));
	read_details(r, &unknown);
	arena_free(&unknown.arena);
	return NULL;
}

/*
 * The fast path for a call whose ENTER has the common form and whose LEAVE follows immediately. Otherwise reading
 * continues at r->p with the general functions.
 * @return the call that has returned, or NULL: read the next event, or reading failed
 */
static struct reader_call *quick_call(struct trace_reader *r)
{
	const uint8_t *p = r->p;
	const struct call_sig *sig;
	struct reader_call *entered;
	uint64_t thread, number;
	int whole;

	if (r->end - p < READER_QUICK_BYTES || *p != TRACE_ENTER || r->version < 4)
		return NULL;
	p = reader_quick_uint(p + 1, &thread);
	p = p ? reader_quick_uint(p, &number) : NULL;
	sig = p ? reader_known_sig(r, TRACE_SIG_CALL, number) : NULL;
	entered = sig ? new_pending(r) : NULL;
	if (!entered)
		return NULL;
	begin_call(entered, thread, sig);
	p = quick_details(r, p, entered, 0, &whole);
	if (whole) {
		entered->call.number = r->next_number++;
		entered->in_use = 1;
	} else {
		r->p = p;
		end_enter(r, entered);
		if (r->status)
			return NULL;
		p = r->p;
	}
	r->p = p;
	if (r->end - p < READER_QUICK_BYTES || *p != TRACE_LEAVE || !(p = reader_quick_uint(p + 1, &number)) ||
	    number != entered->call.number)
		return NULL;
	p = quick_details(r, p, entered, entered->call.n_args, &whole);
	r->p = p;
	if (!whole)
		read_details(r, entered);
	return r->status ? NULL : entered;
}

/* At the end: deliver calls that were entered and never returned, in order. */
static struct reader_call *end_of_calls(struct trace_reader *r)
{
	struct reader_call *oldest = NULL;

	if (r->status == 1 && !r->ended) {
		r->ended = 1;
		r->cut |= container_is_cut(r->container);
		if (r->cut)
			trace_warn_cut(r->path, r->next_number);
		else if (container_behind(r->container))
			err_warn(r->path,
			         "%llu bytes follow the recording after call %llu, and are not read; 'relume repair' "
			         "tells them apart",
			         (unsigned long long)container_behind(r->container),
			         (unsigned long long)r->next_number);
	}
	for (size_t i = 0; i < r->n_pending; i++)
		if (r->pending[i]->in_use && (!oldest || r->pending[i]->call.number < oldest->call.number))
			oldest = r->pending[i];
	if (oldest)
		oldest->call.incomplete = 1;
	return oldest;
}

/* Read any event. @return the call that it completes, or NULL */
static struct reader_call *read_event(struct trace_reader *r)
{
	unsigned event = reader_byte(r);

	if (event == TRACE_LEAVE)
		return read_leave(r);
	if (event == TRACE_ENTER)
		read_enter(r);
	else
		reader_fail(r, "an event of unknown kind");
	return NULL;
}

struct reader_call *reader_next_call(struct trace_reader *r)
{
	struct reader_call *p = NULL;

	while (!p && r->status == 0) {
		if (r->p == r->end && !reader_refill(r))
			break;
		p = quick_call(r);
		if (!p && r->status == 0 && r->p != r->end)
			p = read_event(r);
		if (r->status == 1)
			r->cut = 1;
	}
	return !p && r->status == 1 ? end_of_calls(r) : p;
}
