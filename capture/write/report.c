/* Runs inside the traced program. */
#include "capture/write/report.h"

#include <errno.h>
#include <fcntl.h>
#include <link.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "capture/stats.h"
#include "capture/write/tables.h"
#include "tables/commands.h"

static struct recorder_stats *stats;
static struct stats_process own_process; /* used if the command has mapped no statistics file */

void report_say(const char *fmt, ...)
{
	char text[512];
	int saved = errno, n;
	va_list args;

	va_start(args, fmt);
	n = snprintf(text, sizeof(text), "relume: ");
	n += vsnprintf(text + n, sizeof(text) - (size_t)n - 1, fmt, args);
	va_end(args);
	if (n > (int)sizeof(text) - 2)
		n = (int)sizeof(text) - 2;
	text[n++] = '\n';
	if (write(STDERR_FILENO, text, (size_t)n) < 0)
		errno = saved; /* nobody reads it */
	errno = saved;
}

/* The command's memory file under its number: only such a file has seals. */
static int inherited(const char *descriptor)
{
	int fd = descriptor ? atoi(descriptor) : -1;

	return fd > STDERR_FILENO && fcntl(fd, F_GET_SEALS) >= 0 ? fcntl(fd, F_DUPFD_CLOEXEC, 0) : -1;
}

void report_open(const char *path, const char *descriptor)
{
	int fd = open(path, O_RDWR | O_CLOEXEC);
	struct stat st;
	void *p;

	if (fd < 0)
		fd = inherited(descriptor);
	if (fd < 0)
		return;
	if (fstat(fd, &st) == 0 && (size_t)st.st_size >= sizeof(*stats)) {
		p = mmap(NULL, sizeof(*stats), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
		stats = p == MAP_FAILED ? NULL : p;
	}
	close(fd);
	if (stats)
		stats->seen |= SEEN_RECORDER;
}

static int look_at_library(struct dl_phdr_info *info, size_t size, void *nothing)
{
	(void)size;
	(void)nothing;
	stats->seen |= stats_library(info->dlpi_name);
	return 0;
}

/* For a program that made no call: note which libraries it has loaded. */
__attribute__((destructor)) static void report_libraries(void)
{
	if (stats)
		dl_iterate_phdr(look_at_library, NULL);
}

struct stats_process *report_new_process(void)
{
	uint32_t slot = stats ? atomic_fetch_add(&stats->n_processes, 1) : STATS_MAX_PROCESSES;

	return slot < STATS_MAX_PROCESSES ? &stats->processes[slot] : &own_process;
}

void report_unknown(unsigned command)
{
	static _Atomic uint8_t slots[N_COMMANDS]; /* 1-based index in the statistics, 255: the table is full */
	uint8_t slot = slots[command];

	if (!stats || slot == 255)
		return;
	if (!slot) {
		uint32_t n = atomic_fetch_add(&stats->n_unknown, 1);

		slot = n < STATS_MAX_UNKNOWN ? (uint8_t)(n + 1) : 255;
		slots[command] = slot;
		if (slot == 255)
			return;
		snprintf(stats->unknown[n].name, STATS_NAME_BYTES, "%s", commands[command].name);
	}
	stats->unknown[slot - 1].calls++;
}

unsigned report_toggles(void)
{
	return stats ? stats->toggles : 0;
}

void report_key(int is_taken)
{
	if (stats)
		atomic_fetch_add(is_taken ? &stats->keys_pressed : &stats->keys_lost, 1);
}
