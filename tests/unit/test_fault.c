/* Assigning blame when a process that uses OpenCL ends or hangs, and the resulting outcome for families. */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "tests/case.h"
#include "tests/driver.h"
#include "tracer/device/outcome.h"
#include "verbs/render/check/apart.h"

enum ending {
	IN_DRIVER,
	IN_BUILD,
	BETWEEN,
	EXITS_IN_DRIVER,
	EXITS_BETWEEN,
	ON_PURPOSE,
	IS_SENT,
	REFUSED,
	REFUSED_IN_VAIN,
	N_ENDINGS
};

static void end(enum ending how, struct fault_journal *journal)
{
	struct fault_place *place;

	fault_begin(journal, how != REFUSED_IN_VAIN);
	place = fault_open(3);
	fault_set_family(place, FAMILY_BINARY);
	fault_enter(place);
	fault_launch(place, KERNEL_vertex);
	fault_done(place);
	fault_launch(place, KERNEL_vertex);
	fault_launch(place, KERNEL_camera_packet);
	if (how == IN_DRIVER)
		abort();
	if (how == IN_BUILD)
		fault_build(place, "a.cl");
	if (how == IN_BUILD)
		*(volatile char *volatile)NULL = 0;
	if (how == EXITS_IN_DRIVER)
		exit(0);
	if (how == REFUSED || how == REFUSED_IN_VAIN)
		fault_refuse(place, -11, 1, "b.cl");
	if (how == IS_SENT)
		kill(getpid(), SIGSTOP); /* and the parent sends SIGABRT */
	fault_leave(place, 0);
	if (how == EXITS_BETWEEN)
		exit(0);
	if (how == ON_PURPOSE)
		fault_end();
	fault_enter(how == ON_PURPOSE ? place : NULL);
	abort();
}

START_TEST(test_blame)
{
	static const struct { int kind, code, is_build; const char *words; } want[N_ENDINGS] = {
		[IN_DRIVER] = { FAULT_SIGNAL, SIGABRT, 0, "SIGABRT in camera_packet" },
		[IN_BUILD] = { FAULT_SIGNAL, SIGSEGV, 1, "SIGSEGV in a.cl" },
		[EXITS_IN_DRIVER] = { FAULT_EXIT, 0, 0, "the driver ended the process in camera_packet" },
		[REFUSED] = { FAULT_REFUSED, -11, 1, "CL_BUILD_PROGRAM_FAILURE (-11) for b.cl" },
	};
	struct fault_journal *journal = apart_alloc(sizeof(*journal));
	char words[160];
	int status;
	pid_t child;

	ck_assert_ptr_nonnull(journal);
	child = fork();
	if (child == 0)
		end((enum ending)_i, journal);
	if (_i == IS_SENT) {
		ck_assert_int_eq(waitpid(child, &status, WUNTRACED), child);
		kill(child, SIGABRT);
		kill(child, SIGCONT);
	}
	ck_assert_int_eq(waitpid(child, &status, 0), child);
	ck_assert_int_eq(journal->fault.kind, want[_i].kind);
	if (want[_i].kind) {
		ck_assert_int_eq(journal->fault.code, want[_i].code);
		ck_assert_int_eq(journal->fault.device, 3);
		ck_assert_int_eq(journal->fault.family, FAMILY_BINARY);
		ck_assert_int_eq(journal->fault.is_build, want[_i].is_build);
		ck_assert_str_eq(fault_words(&journal->fault, words, sizeof(words)), want[_i].words);
	}
	if (_i == BETWEEN) { /* our handler is more precise than a guess; without it, a kernel may have been
	                        compiling */
		ck_assert(WIFSIGNALED(status));
		fault_guess(journal, WTERMSIG(status));
		ck_assert_int_eq(journal->fault.kind, FAULT_NONE);
		atomic_store(&journal->is_judged, 0);
		fault_guess(journal, SIGKILL);
		ck_assert_int_eq(journal->fault.kind, FAULT_NONE);
		fault_guess(journal, WTERMSIG(status));
		ck_assert_str_eq(fault_words(&journal->fault, words, sizeof(words)), "SIGABRT in camera_packet");
	}
	apart_free(journal, sizeof(*journal));
}
END_TEST

/* Use this much processor time. */
static void compute(double seconds)
{
	const clock_t begun = clock();

	while ((double)(clock() - begun) / CLOCKS_PER_SEC < seconds)
		;
}

/* A call that takes half a second: an idle one counts as hung, a busy one only if it compiles, and one that has
 * ended does not. */
START_TEST(test_hangs)
{
	const int is_idle = _i & 1, compiles = _i & 2, ends = _i & 4;
	struct fault_journal *journal = apart_alloc(sizeof(*journal));
	struct fault_place *place;
	int found = 0;

	ck_assert_ptr_nonnull(journal);
	fault_begin(journal, 1);
	place = fault_open(0);
	fault_enter(place);
	if (compiles)
		fault_build(place, "a.cl");
	for (int i = 0; i < 6; i++) {
		if (!is_idle)
			compute(0.1);
		if (ends) {
			fault_leave(place, 0);
			fault_enter(place);
		}
		found |= fault_look(0.4, 0.1);
	}
	ck_assert_int_eq(found, !ends && (is_idle || compiles));
	ck_assert_int_eq(journal->fault.kind, found ? FAULT_HUNG : FAULT_NONE);
}
END_TEST

START_TEST(test_best_family)
{
	static const struct { int states[N_DEVICE_FAMILIES], best; } cases[] = {
		{ { OUTCOME_UNTRIED, OUTCOME_UNTRIED, OUTCOME_UNTRIED }, FAMILY_PACKETS },
		{ { OUTCOME_FAILED, OUTCOME_UNTRIED, OUTCOME_UNTRIED }, FAMILY_BINARY },
		{ { OUTCOME_FAILED, OUTCOME_LATE, OUTCOME_UNTRIED }, FAMILY_COMPRESSED },
		{ { OUTCOME_FAILED, OUTCOME_LATE, OUTCOME_WRONG }, -1 },
		{ { OUTCOME_UNTRIED, OUTCOME_UNTRIED, OUTCOME_RIGHT }, FAMILY_COMPRESSED },
		{ { OUTCOME_RIGHT, OUTCOME_RIGHT, OUTCOME_RIGHT }, FAMILY_BINARY }, /* the fastest */
		{ { OUTCOME_PASSED_OVER, OUTCOME_FAILED, OUTCOME_FAILED }, -1 },
	};
	struct outcome outcome = { .families = { { .frame_s = 3 }, { .frame_s = 1 }, { .frame_s = 2 } } };

	for (int i = 0; i < N_DEVICE_FAMILIES; i++)
		outcome.families[i].state = (uint32_t)cases[_i].states[i];
	ck_assert_int_eq(outcome_best(&outcome, FAMILY_PACKETS), cases[_i].best);
}
END_TEST

/* Compiler faults are stored at once, other faults once there is a picture; with another device none is stored. */
START_TEST(test_remembered)
{
	struct outcome_run run = { .n = 3, .faults = { { FAULT_SIGNAL, SIGABRT, 0, FAMILY_PACKETS, -1, 1, "a.cl" },
	                                               { FAULT_HUNG, 0, 0, FAMILY_BINARY, 7, 0, "vertex" },
	                                               { FAULT_HUNG, 0, 1, FAMILY_COMPRESSED, 7, 0, "vertex" } } };
	char folder[] = "/tmp/relume-fault-XXXXXX", command[64];
	struct outcome outcome;
	struct device *dev = NULL;

	ck_assert_ptr_nonnull(mkdtemp(folder));
	ck_assert_int_eq(device_open("0", 0, &dev), 0);
	outcome_remember_builds(dev, folder, &run);
	ck_assert(outcome_read(folder, device_describe(dev), &outcome));
	ck_assert_int_eq(outcome.families[FAMILY_PACKETS].state, OUTCOME_FAILED);
	ck_assert_str_eq(outcome.families[FAMILY_PACKETS].where, "SIGABRT in a.cl");
	ck_assert_int_eq(outcome.families[FAMILY_BINARY].state, OUTCOME_UNTRIED);
	ck_assert_int_eq(outcome_choose(dev, -1, folder, &run), 0);
	ck_assert_int_eq(device_family(dev), FAMILY_COMPRESSED);
	ck_assert(!outcome_is_hopeless(dev, -1, folder, &run));
	ck_assert(outcome_is_hopeless(dev, FAMILY_BINARY, folder, &run));
	outcome_confirm(dev, folder, &run);
	ck_assert(outcome_read(folder, device_describe(dev), &outcome));
	ck_assert_int_eq(outcome.families[FAMILY_BINARY].state, OUTCOME_LATE);
	ck_assert_int_eq(outcome.families[FAMILY_COMPRESSED].state, OUTCOME_UNTRIED);
	run.faults[2].device = 0;
	ck_assert(outcome_is_hopeless(dev, -1, folder, &run));
	device_close(&dev);
	snprintf(command, sizeof(command), "rm -r %s", folder);
	ck_assert_int_eq(system(command), 0);
}
END_TEST

int main(void)
{
	TCase *tests = tcase_create("fault");

	tcase_add_loop_test(tests, test_blame, 0, N_ENDINGS);
	tcase_add_loop_test(tests, test_hangs, 0, 8);
	tcase_add_loop_test(tests, test_best_family, 0, 7);
	if (!lacks_driver())
		tcase_add_test(tests, test_remembered);
	tcase_set_timeout(tests, 60);
	return run_case(tests, "fault");
}
