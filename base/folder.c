#include "base/folder.h"

#include <errno.h>
#include <ftw.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/err.h"

/* Changes `path` while it runs, and restores it. @return 0 or errno */
static int make_all(char *path)
{
	struct stat st;

	for (char *p = path + 1; *p; p++) {
		if (*p != '/')
			continue;
		*p = '\0';
		mkdir(path, 0777); /* only the last one's result matters */
		*p = '/';
	}
	if (mkdir(path, 0777) == 0)
		return 0;
	if (errno == EEXIST && stat(path, &st) == 0 && !S_ISDIR(st.st_mode))
		errno = ENOTDIR;
	return errno == EEXIST ? 0 : errno;
}

int folder_try(const char *path)
{
	char copy[PATH_MAX];

	if (snprintf(copy, sizeof(copy), "%s", path) >= (int)sizeof(copy))
		return ENAMETOOLONG;
	return *copy ? make_all(copy) : 0;
}

int folder_nearest(const char *path, char *out, size_t size)
{
	int n = snprintf(out, size, "%s%s", *path == '/' ? "" : "./", path);
	char *slash;

	if (n >= (int)size)
		return 0;
	while (n > 1 && out[n - 1] == '/')
		out[--n] = '\0';
	while (access(out, F_OK) != 0 && (slash = strrchr(out, '/')) > out)
		*slash = '\0';
	if (access(out, F_OK) != 0)
		out[1] = '\0'; /* the root */
	return 1;
}

/* A folder made early: its path, with a '/', and how much of that path already existed. */
struct early {
	struct early *next;
	size_t old;
	int on_success;
	char path[PATH_MAX];
};

static struct early *early;

static void drop_empty(int code, void *unused)
{
	(void)unused;
	for (struct early *e = early; e; e = e->next)
		while ((code || e->on_success) && strlen(e->path) > e->old && rmdir(e->path) == 0)
			*strrchr(e->path, '/') = '\0';
}

void folder_drop_early(void)
{
	drop_empty(1, NULL);
}

int folder_try_early(const char *path, int on_success)
{
	struct early *e = calloc(1, sizeof(*e));
	char nearest[PATH_MAX];
	int failed = e ? 0 : ENOMEM;

	if (!failed && !folder_nearest(path, nearest, sizeof(nearest)))
		failed = ENAMETOOLONG;
	if (!failed)
		failed = folder_try(path);
	if (failed || !folder_nearest(path, e->path, sizeof(e->path)) || strcmp(e->path, nearest) == 0 ||
	    (!early && on_exit(drop_empty, NULL))) {
		free(e);
		return failed;
	}
	e->old = strlen(nearest);
	e->on_success = on_success;
	e->next = early;
	early = e;
	return 0;
}

int folder_make(const char *path)
{
	int failed = folder_try(path);

	return failed ? err_report(ERR_SYSTEM, path, "%s", strerror(failed)) : 0;
}

int folder_make_for(const char *file)
{
	const char *slash = strrchr(file, '/');
	char copy[PATH_MAX];

	if (!slash || slash == file)
		return 0;
	if (snprintf(copy, sizeof(copy), "%.*s", (int)(slash - file), file) >= (int)sizeof(copy))
		return err_report(ERR_SYSTEM, file, "the name is too long");
	return folder_make(copy);
}

int folder_caches(char *out, size_t size)
{
	const char *caches = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
	int n = -1;

	if (caches && *caches)
		n = snprintf(out, size, "%s", caches);
	else if (home && *home)
		n = snprintf(out, size, "%s/.cache", home);
	return n > 0 && (size_t)n < size;
}

int folder_cached(const char *name, char *out, size_t size)
{
	char caches[PATH_MAX];

	return folder_caches(caches, sizeof(caches)) && (size_t)snprintf(out, size, "%s/relume/%s", caches, name) < size;
}

static int remove_one(const char *path, const struct stat *st, int kind, struct FTW *at)
{
	(void)st, (void)kind, (void)at;
	return remove(path);
}

void folder_remove(const char *path)
{
	if (nftw(path, remove_one, 16, FTW_DEPTH | FTW_PHYS))
		err_warn(path, "cannot be removed: %s", strerror(errno));
}
