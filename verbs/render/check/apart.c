#include "verbs/render/check/apart.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/err.h"
#include "base/progress.h"

void *apart_alloc(size_t bytes)
{
	void *memory = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);

	if (memory != MAP_FAILED)
		return memory;
	err_report(ERR_SYSTEM, NULL, "out of memory");
	return NULL;
}

void apart_free(void *memory, size_t bytes)
{
	if (memory)
		munmap(memory, bytes);
}

/* Whether a process holds more than half of the machine's memory: some kernel compilers take all of it. */
static int is_greedy(pid_t process)
{
	char path[64];
	long pages = 0;
	FILE *file;

	snprintf(path, sizeof(path), "/proc/%ld/statm", (long)process);
	file = fopen(path, "re");
	if (!file || fscanf(file, "%*d %ld", &pages) != 1)
		pages = 0;
	if (file)
		fclose(file);
	return pages > sysconf(_SC_PHYS_PAGES) / 2;
}

enum apart_end apart_run(void (*function)(void *user), void *user, const volatile int *step, double seconds)
{
	double end_s = progress_clock_s() + seconds;
	int status, before = *step;
	pid_t child;

	fflush(NULL);
	child = fork();
	if (child < 0) {
		err_report(ERR_SYSTEM, NULL, "no process to check a device in: %s", strerror(errno));
		return APART_DIED;
	}
	if (child == 0) {
		prctl(PR_SET_PDEATHSIG, SIGKILL);
		function(user);
		fflush(NULL);
		_exit(0);
	}
	while (waitpid(child, &status, WNOHANG) == 0) {
		if (*step != before) {
			before = *step;
			end_s = progress_clock_s() + seconds;
		}
		if (progress_clock_s() > end_s || is_greedy(child)) {
			kill(child, SIGKILL);
			waitpid(child, &status, 0);
			return APART_LATE;
		}
		nanosleep(&(struct timespec){ 0, 10000000 }, NULL);
	}
	return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? APART_DONE : APART_DIED;
}
