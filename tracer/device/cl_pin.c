#include "tracer/device/cl_pin.h"

#include <dirent.h>
#include <sched.h>
#include <stdlib.h>
#include <unistd.h>

void cl_pin_begin(struct cl_pin *pin)
{
	DIR *folder = opendir("/proc/self/task");
	const struct dirent *entry;

	pin->n = 0;
	while (folder && pin->n < CL_PIN_MOST && (entry = readdir(folder)))
		if (entry->d_name[0] != '.')
			pin->threads[pin->n++] = (pid_t)atoi(entry->d_name);
	if (folder)
		closedir(folder);
}

static int is_among(const struct cl_pin *pin, pid_t thread)
{
	for (size_t i = 0; i < pin->n; i++)
		if (pin->threads[i] == thread)
			return 1;
	return 0;
}

void cl_pin_end(const struct cl_pin *pin)
{
	struct cl_pin now;
	cpu_set_t all, one;
	size_t n = 0;
	int core = 0;

	cl_pin_begin(&now);
	if (sched_getaffinity(0, sizeof(all), &all) || CPU_COUNT(&all) != sysconf(_SC_NPROCESSORS_ONLN))
		return;
	for (size_t i = 0; i < now.n; i++)
		if (!is_among(pin, now.threads[i]))
			now.threads[n++] = now.threads[i];
	if (n != (size_t)CPU_COUNT(&all))
		return;
	for (size_t i = 0; i < n; i++, core++) {
		while (!CPU_ISSET(core, &all))
			core++;
		CPU_ZERO(&one);
		CPU_SET(core, &one);
		sched_setaffinity(now.threads[i], sizeof(one), &one);
	}
}
