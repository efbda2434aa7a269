#include "tracer/device/fault.h"

#include <execinfo.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/err.h"
#include "base/part.h"
#include "base/progress.h"
#include "tracer/device/cl_error.h"

#define MOST_FRAMES 64 /* most frames of a stack that are looked at */
#define IDLE 0.02      /* share of one processor; a process that uses less is idle */

static struct fault_journal unshared; /* journal of a process without a watching parent */
static struct fault_journal *journal = &unshared;
static _Thread_local struct fault_place *inside;

static const int signals[] = { SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGTRAP };
#define N_SIGNALS (sizeof(signals) / sizeof(signals[0]))

static struct {
	int is_watched, refusals;
	atomic_int is_over;   /* a fault is noted, or the process ends on purpose */
	struct sigaction before[N_SIGNALS];
	double cpu_s, idle_s; /* used by fault_look */
} state;

const char *fault_words(const struct fault *fault, char *text, size_t size)
{
	const char *name = fault->kind == FAULT_SIGNAL ? sigabbrev_np(fault->code) : NULL;
	const int n = (int)strnlen(fault->what, sizeof(fault->what));

	switch (fault->kind) {
	case FAULT_SIGNAL: snprintf(text, size, "SIG%s in %.*s", name ? name : "?", n, fault->what); break;
	case FAULT_EXIT: snprintf(text, size, "the driver ended the process in %.*s", n, fault->what); break;
	case FAULT_HUNG: snprintf(text, size, "hung in %.*s", n, fault->what); break;
	case FAULT_REFUSED:
		snprintf(text, size, "%s (%d) for %.*s", cl_error_name(fault->code), fault->code, n, fault->what);
		break;
	default: snprintf(text, size, "unknown"); break;
	}
	return text;
}

/* --- Activity of devices ----------------------------------------------------------------------------------------- */

struct fault_place *fault_open(int device)
{
	for (unsigned i = 0; i < FAULT_PLACES; i++) {
		struct fault_place *p = &journal->places[i];
		unsigned n = atomic_load(&journal->n_places);

		if (atomic_exchange(&p->is_taken, 1))
			continue;
		while (n <= i && !atomic_compare_exchange_weak(&journal->n_places, &n, i + 1))
			;
		p->device = device;
		atomic_store(&p->frame, FAULT_NO_FRAME);
		memset(p->known, 0, sizeof(p->known));
		return p;
	}
	return NULL;
}

void fault_close(struct fault_place **place)
{
	if (*place) {
		fault_done(*place);
		fault_build(*place, NULL);
		atomic_store(&(*place)->is_taken, 0);
	}
	*place = NULL;
}

void fault_set_family(struct fault_place *place, int family)
{
	if (place)
		place->family = family;
}

void fault_set_frame(struct fault_place *place, int64_t frame)
{
	if (place)
		atomic_store(&place->frame, frame);
}

void fault_enter(struct fault_place *place)
{
	inside = place;
	if (place)
		atomic_fetch_add_explicit(&place->calls, 1, memory_order_relaxed);
}

int fault_leave(struct fault_place *place, int err)
{
	if (place)
		atomic_fetch_add_explicit(&place->calls, 1, memory_order_relaxed);
	inside = NULL;
	return err;
}

void fault_build(struct fault_place *place, const char *program)
{
	if (place)
		atomic_store(&place->program, program);
}

void fault_launch(struct fault_place *place, enum kernel kernel)
{
	unsigned n;

	if (!place)
		return;
	n = atomic_load_explicit(&place->n_new, memory_order_relaxed);
	atomic_fetch_add_explicit(&place->launched, 1, memory_order_relaxed);
	if (place->known[kernel] || n == FAULT_NEW)
		return;
	place->known[kernel] = 1;
	place->new[n] = kernel;
	atomic_store_explicit(&place->n_new, n + 1, memory_order_release);
}

void fault_done(struct fault_place *place)
{
	if (!place)
		return;
	atomic_store_explicit(&place->launched, 0, memory_order_relaxed);
	atomic_store_explicit(&place->n_new, 0, memory_order_relaxed);
}

/* --- Noting a fault: called in signal handlers, so nothing here takes a lock or memory --------------------------- */

static void append(char *out, size_t size, const char *text)
{
	const size_t n = strlen(out);

	for (size_t i = 0; n + i + 1 < size && text[i]; i++) {
		out[n + i] = text[i];
		out[n + i + 1] = '\0';
	}
}

/* Add the kernels that a place may be compiling to the description of a fault. */
static void name_new(const struct fault_place *place, struct fault *f)
{
	const unsigned n = atomic_load(&place->n_new);

	for (unsigned i = 0; i < n && i < FAULT_NEW; i++) {
		const char *name = kernel_entries[place->new[i]].name;

		if (strstr(f->what, name))
			continue;
		append(f->what, sizeof(f->what), f->what[0] ? ", " : "");
		append(f->what, sizeof(f->what), name);
	}
}

/* Rank of a place by what it may be doing, highest first: building a program, compiling kernels, other launches,
 * nothing. */
#define COMPILES 2

static unsigned telling(const struct fault_place *p)
{
	return atomic_load(&p->program) ? COMPILES + 1 : atomic_load(&p->n_new) ? COMPILES : atomic_load(&p->launched) != 0;
}

/* is_sure: 1 if the fault is at this place, and at no other of the same device */
static void describe(const struct fault_place *place, int is_sure, enum fault_kind kind, int code, struct fault *f)
{
	const char *program = atomic_load(&place->program);

	f->code = code;
	f->device = place->device;
	f->family = place->family;
	f->frame = atomic_load(&place->frame);
	f->is_build = program != NULL;
	f->what[0] = '\0';
	if (program)
		append(f->what, sizeof(f->what), program);
	else
		name_new(place, f);
	for (size_t i = 0; i < atomic_load(&journal->n_places) && !program && !is_sure; i++)
		if (journal->places[i].device == place->device && telling(&journal->places[i]) && &journal->places[i] != place) {
			name_new(&journal->places[i], f);
			f->frame = FAULT_NO_FRAME;
		}
	if (!f->what[0])
		append(f->what, sizeof(f->what),
		       place->device < 0             ? "the list of devices" :
		       atomic_load(&place->launched) ? "kernels that had run before" :
		                                       "a call of OpenCL");
	f->kind = kind;
}

static void note(const struct fault_place *place, enum fault_kind kind, int code)
{
	if (state.is_watched && !atomic_exchange(&state.is_over, 1))
		describe(place, place == inside || kind == FAULT_HUNG, kind, code, &journal->fault);
}

/* The place with the highest rank, which must be at least `least`; NULL: there is none. */
static const struct fault_place *find_busy(unsigned least)
{
	const struct fault_place *best = NULL;

	for (size_t i = 0; i < atomic_load(&journal->n_places); i++)
		if (telling(&journal->places[i]) > (best ? telling(best) : least - 1))
			best = &journal->places[i];
	return best;
}

/* Symbols from the linker: bounds of the code of this program or library. */
extern const char __ehdr_start[] __attribute__((visibility("hidden"))), etext[] __attribute__((visibility("hidden")));

__attribute__((noinline)) static int is_own_thread(void)
{
	void *frames[MOST_FRAMES];
	const int n = backtrace(frames, MOST_FRAMES), own = 2; /* the innermost are this function and the handler */

	for (int i = own; i < n; i++)
		if ((const char *)frames[i] >= __ehdr_start && (const char *)frames[i] < etext)
			return 1;
	return n == MOST_FRAMES; /* the rest of the stack is unknown */
}

static void take_signal(int number, siginfo_t *info, void *context)
{
	const int was_sent = info->si_code <= 0, is_ours = !was_sent || info->si_pid == getpid();
	const struct sigaction by_default = { .sa_handler = SIG_DFL };
	const struct fault_place *place = inside;

	(void)context;
	atomic_store(&journal->is_judged, 1);
	for (size_t i = 0; i < N_SIGNALS; i++) /* a driver's handler might not end the process for a sent signal */
		sigaction(signals[i], was_sent ? &by_default : &state.before[i], NULL);
	if (is_ours && !place && !is_own_thread())
		place = find_busy(1);
	if (is_ours && place)
		note(place, FAULT_SIGNAL, number);
	if (was_sent)
		raise(number); /* delivered once this handler returns; other signals recur */
}

static void at_exit(void)
{
	const struct fault_place *place = inside;

	if (atomic_load(&state.is_over))
		return;
	if (!place && !is_own_thread())
		place = find_busy(1);
	if (place)
		note(place, FAULT_EXIT, 0);
}

void fault_arm(void)
{
	const struct sigaction action = { .sa_sigaction = take_signal, .sa_flags = SA_SIGINFO };
	struct sigaction now;

	if (!state.is_watched)
		return;
	for (size_t i = 0; i < N_SIGNALS; i++)
		if (sigaction(signals[i], NULL, &now) == 0 && now.sa_sigaction != take_signal) {
			state.before[i] = now;
			sigaction(signals[i], &action, NULL);
		}
}

void fault_begin(struct fault_journal *of, int refusals)
{
	void *frame;

	memset(of->places, 0, atomic_load(&of->n_places) * sizeof(of->places[0]));
	atomic_store(&of->n_places, 0);
	atomic_store(&of->is_judged, 0);
	backtrace(&frame, 1); /* the first call loads libraries, which a handler must not do */
	journal = of;
	state.is_watched = 1;
	state.refusals = refusals;
	fault_arm();
	atexit(at_exit);
}

void fault_guess(struct fault_journal *of, int number)
{
	const struct fault_place *place;

	journal = of;
	place = atomic_load(&of->is_judged) ? NULL : find_busy(COMPILES);
	for (size_t i = 0; place && i < N_SIGNALS; i++)
		if (signals[i] == number)
			describe(place, 0, FAULT_SIGNAL, number, &of->fault);
}

void fault_end(void)
{
	atomic_store(&state.is_over, 1);
}

void fault_refuse(struct fault_place *place, int code, int is_build, const char *what)
{
	const int is_short = code == CL_DEVICE_NOT_AVAILABLE || code == CL_MEM_OBJECT_ALLOCATION_FAILURE ||
	                     code == CL_OUT_OF_RESOURCES || code == CL_OUT_OF_HOST_MEMORY;
	const int is_lost = code == CL_INVALID_COMMAND_QUEUE || code == CL_INVALID_CONTEXT || code == CL_INVALID_DEVICE;

	if (!state.is_watched || !state.refusals || !place || (is_build && (is_short || is_lost)))
		return;
	fault_build(place, is_build ? what : NULL);
	note(place, FAULT_REFUSED, code);
	part_drop_all();
	_exit(-ERR_SYSTEM);
}

/* --- Calls that hang --------------------------------------------------------------------------------------------- */

static int is_hung(struct fault_place *p, double most_s, double passed_s)
{
	const unsigned calls = atomic_load(&p->calls);
	const int compiles = atomic_load(&p->program) != NULL || atomic_load(&p->n_new) != 0;

	if (calls % 2 == 0 || calls != p->seen) {
		p->seen = calls;
		p->age_s = 0;
		p->begun_cpu_s = state.cpu_s;
		return 0;
	}
	p->age_s += passed_s;
	return p->age_s >= most_s && (state.idle_s >= most_s / 5 || (compiles && state.cpu_s - p->begun_cpu_s >= most_s));
}

int fault_look(double most_s, double passed_s)
{
	const double cpu_s = progress_processor_s();
	const struct fault_place *hung = NULL;

	if (!state.is_watched)
		return 0;
	fault_arm();
	state.idle_s = cpu_s - state.cpu_s < IDLE * passed_s ? state.idle_s + passed_s : 0;
	state.cpu_s = cpu_s;
	for (size_t i = 0; i < atomic_load(&journal->n_places); i++)
		if (is_hung(&journal->places[i], most_s, passed_s) && (!hung || telling(&journal->places[i]) > telling(hung)))
			hung = &journal->places[i];
	if (hung)
		note(hung, FAULT_HUNG, 0);
	return hung != NULL;
}

int fault_hang(void)
{
	const struct fault_place *longest = NULL;

	for (size_t i = 0; i < atomic_load(&journal->n_places); i++) {
		const struct fault_place *p = &journal->places[i];

		if (atomic_load(&p->calls) % 2 && (!longest || p->age_s > longest->age_s))
			longest = p;
	}
	if (!longest || !state.is_watched)
		return 0;
	note(longest, FAULT_HUNG, 0);
	return 1;
}
