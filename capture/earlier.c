#include "capture/earlier.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/err.h"
#include "base/folder.h"
#include "capture/format/sidecar.h"

#define ASIDE ".earlier"
#define TRACE_MAGIC "at" /* how apitrace's files begin when compressed with snappy, as recordings are */

/*
 * Do something to each file of a recording, under its name and the one that it has when set aside: the traces of its
 * processes, numbered from 1 after the first, and their reference frames. act: returns 1 if the file was there
 */
static void for_each(const char *trace, int (*act)(const char *name, const char *aside))
{
	char name[PATH_MAX], aside[PATH_MAX + sizeof(ASIDE)], suffix[32];
	int is_there = 1;

	for (unsigned process = 0; process < 2 || is_there; process++)
		for (int is_trace = 0; is_trace < 2; is_trace++) {
			if (process)
				snprintf(suffix, sizeof(suffix), ".%u%s", process, is_trace ? ".trace" : ".ref");
			if (process || !is_trace)
				sidecar_name(name, sizeof(name), trace, process ? suffix : ".ref");
			else
				snprintf(name, sizeof(name), "%s", trace);
			snprintf(aside, sizeof(aside), "%s" ASIDE, name);
			is_there = act(name, aside);
		}
}

static int set_aside(const char *name, const char *aside)
{
	struct stat st;

	return lstat(name, &st) == 0 && S_ISREG(st.st_mode) && rename(name, aside) == 0;
}

static int put_back(const char *name, const char *aside)
{
	return rename(aside, name) == 0;
}

static int remove_aside(const char *name, const char *aside)
{
	(void)name;
	return unlink(aside) == 0;
}

/* 1 if a file is a recording, or empty, as one that was never written to. */
static int is_recording(const char *path)
{
	char magic[sizeof(TRACE_MAGIC) - 1];
	int fd = open(path, O_RDONLY | O_CLOEXEC);
	ssize_t n = fd < 0 ? -1 : read(fd, magic, sizeof(magic));

	if (fd >= 0)
		close(fd);
	return n == 0 || (n == sizeof(magic) && memcmp(magic, TRACE_MAGIC, sizeof(magic)) == 0);
}

int earlier_set_aside(const char *trace)
{
	struct stat st;
	const int is_there = stat(trace, &st) == 0;
	int fd;

	if (is_there && !S_ISREG(st.st_mode))
		return err_report(ERR_SYSTEM, trace, "exists and is not a file");
	if (is_there && !is_recording(trace))
		return err_report(ERR_USAGE, trace, "exists and is no recording; give the new recording another name");
	if (folder_make_for(trace))
		return ERR_SYSTEM;
	for_each(trace, set_aside);
	fd = open(trace, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
	if (fd >= 0) {
		close(fd);
		unlink(trace);
		return 0;
	}
	err_report(ERR_SYSTEM, trace, errno == EEXIST ? "cannot be replaced" : "cannot write: %s", strerror(errno));
	for_each(trace, put_back);
	return ERR_SYSTEM;
}

void earlier_remove(const char *trace)
{
	for_each(trace, remove_aside);
}

void earlier_put_back(const char *trace)
{
	for_each(trace, put_back);
}
