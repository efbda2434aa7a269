#include "base/part.h"

#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "base/err.h"

#define MAX_PARTS 256 /* under way at once; more than that are not removed by part_drop_all */
#define STALE_S 60

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static char *parts[MAX_PARTS];
static atomic_ulong counter;

static void host_name(char *out, size_t size)
{
	if (gethostname(out, size) != 0 || !*out)
		snprintf(out, size, "host");
	out[size - 1] = '\0';
}

int part_begin(const char *path, char *part, size_t size)
{
	char host[64];
	int n;

	host_name(host, sizeof(host));
	n = snprintf(part, size, "%s.%s-%ld-%lu.part", path, host, (long)getpid(), atomic_fetch_add(&counter, 1));
	if (n < 0 || (size_t)n >= size)
		return err_report(ERR_SYSTEM, path, "cannot be written: the name is too long");
	pthread_mutex_lock(&lock);
	for (size_t i = 0; i < MAX_PARTS; i++)
		if (!parts[i]) {
			parts[i] = strdup(part);
			break;
		}
	pthread_mutex_unlock(&lock);
	return 0;
}

static void forget(const char *part)
{
	pthread_mutex_lock(&lock);
	for (size_t i = 0; i < MAX_PARTS; i++)
		if (parts[i] && strcmp(parts[i], part) == 0) {
			free(parts[i]);
			parts[i] = NULL;
		}
	pthread_mutex_unlock(&lock);
}

int part_finish(const char *part, const char *path)
{
	int err = 0;

	if (rename(part, path) != 0) {
		err = err_report(ERR_SYSTEM, path, "cannot be renamed into place: %s", strerror(errno));
		unlink(part);
	}
	forget(part);
	return err;
}

void part_drop(const char *part)
{
	unlink(part);
	forget(part);
}

int part_open(struct part_file *file, const char *path)
{
	int err = part_begin(path, file->part, sizeof(file->part));

	if (err)
		return err;
	file->path = path;
	file->stream = fopen(file->part, "wb");
	if (file->stream)
		return 0;
	err = err_report(ERR_SYSTEM, path, "cannot be written: %s", strerror(errno));
	forget(file->part);
	return err;
}

int part_close(struct part_file *file, int err)
{
	if (ferror(file->stream) | fclose(file->stream) && !err)
		err = err_report(ERR_SYSTEM, file->path, "cannot be written: %s", strerror(errno));
	if (!err)
		return part_finish(file->part, file->path);
	part_drop(file->part);
	return err;
}

void part_drop_all(void)
{
	pthread_mutex_lock(&lock); /* never unlocked, so that nobody begins another one */
	for (size_t i = 0; i < MAX_PARTS; i++)
		if (parts[i])
			unlink(parts[i]);
}

/* The PID in "FINAL.HOST-PID-N.part" if HOST is this machine, else 0. */
static long process_of(const char *name, const char *host)
{
	const char *end = strstr(name, ".part"), *dash, *at;
	size_t n = strlen(host);
	char *rest;
	long pid;

	if (!end || end[5] || end == name)
		return 0;
	for (dash = end; dash > name && *dash != '-'; dash--)
		;
	for (at = dash - 1; at > name && *at != '-'; at--)
		;
	if (at <= name || (size_t)(at - name) < n + 1 || strncmp(at - n, host, n) != 0 || at[-(long)n - 1] != '.')
		return 0;
	pid = strtol(at + 1, &rest, 10);
	return rest == dash && pid > 0 ? pid : 0;
}

/* Should a process's file be removed? gone: a process known to have ended; 0: not known */
static int is_left_over(const struct stat *info, long process, long gone)
{
	if (!process || gone)
		return process && process == gone;
	return kill((pid_t)process, 0) != 0 && errno == ESRCH && info->st_mtime + STALE_S < time(NULL);
}

static void sweep(const char *path, long gone)
{
	const char *slash = strrchr(path, '/');
	char folder[PATH_MAX], host[64];
	struct dirent *entry;
	struct stat info;
	DIR *dir;

	snprintf(folder, sizeof(folder), "%.*s", slash ? (int)(slash - path + (slash == path)) : 1, slash ? path : ".");
	host_name(host, sizeof(host));
	dir = opendir(folder);
	if (!dir)
		return;
	while ((entry = readdir(dir)))
		if (fstatat(dirfd(dir), entry->d_name, &info, 0) == 0 && is_left_over(&info, process_of(entry->d_name, host), gone))
			unlinkat(dirfd(dir), entry->d_name, 0);
	closedir(dir);
}

void part_sweep(const char *path)
{
	sweep(path, 0);
}

void part_sweep_of(const char *path, long process)
{
	sweep(path, process);
}
