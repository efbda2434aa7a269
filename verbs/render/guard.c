#include "verbs/render/guard.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/err.h"

/* End as the worker did. */
static void end_by(int number)
{
	const struct rlimit none = { 0, 0 };
	sigset_t all;

	setrlimit(RLIMIT_CORE, &none); /* the worker has left its own */
	signal(number, SIG_DFL);
	sigfillset(&all);
	raise(number);
	sigprocmask(SIG_UNBLOCK, &all, NULL);
	_exit(128 + number);
}

/* Wait for the worker's end, and pass signals on. @return waitpid's status */
static int wait_for(pid_t worker, const sigset_t *awaited)
{
	int status;

	while (waitpid(worker, &status, WNOHANG) == 0) {
		const int number = sigwaitinfo(awaited, NULL);

		if (number == SIGINT || number == SIGTERM)
			sigqueue(worker, number, (union sigval){ .sival_int = 0 });
	}
	return status;
}

/* After a worker's end: return if another one is to start. */
static void end_or_go_on(struct guard *guard, int status)
{
	if (WIFSIGNALED(status) && guard->journal.fault.kind == FAULT_NONE)
		fault_guess(&guard->journal, WTERMSIG(status));
	guard->last = guard->journal.fault;
	guard->journal.fault.kind = FAULT_NONE;
	if (guard->last.kind != FAULT_NONE && !atomic_load(&guard->is_over))
		return;
	if (WIFEXITED(status))
		_exit(WEXITSTATUS(status));
	if (atomic_load(&guard->is_over)) /* a driver crashed while the process ended */
		_exit(guard->code);
	end_by(WTERMSIG(status));
}

int guard_run(struct guard *guard, int (*function)(void *user), void *user)
{
	const pid_t parent = getpid();
	sigset_t awaited, before;

	sigemptyset(&awaited);
	sigaddset(&awaited, SIGINT);
	sigaddset(&awaited, SIGTERM);
	sigaddset(&awaited, SIGCHLD);
	signal(SIGCHLD, SIG_DFL); /* ignored, it would leave no status */
	sigprocmask(SIG_BLOCK, &awaited, &before);
	fflush(NULL);
	for (;;) {
		pid_t worker;

		guard->attempt++;
		worker = fork();
		if (worker <= 0) {
			sigprocmask(SIG_SETMASK, &before, NULL);
			if (worker < 0)
				guard->attempt = 0;
			else if (prctl(PR_SET_PDEATHSIG, SIGKILL) || getppid() != parent)
				_exit(-ERR_SYSTEM);
			guard->code = function(user);
			atomic_store(&guard->is_over, 1);
			return guard->code;
		}
		end_or_go_on(guard, wait_for(worker, &awaited));
		guard->gone = worker;
	}
}

int guard_is_passed_on(const struct guard *guard, int si_code)
{
	return guard->attempt && si_code == SI_QUEUE;
}
