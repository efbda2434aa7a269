#include "base/folder.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/err.h"

/* `path` is changed meanwhile, and whole again afterwards. @return 0 or errno */
static int make_all(char *path)
{
	struct stat st;

	for (char *p = path + 1; *p; p++) {
		if (*p != '/')
			continue;
		*p = '\0';
		mkdir(path, 0777); /* what matters is whether the last one is there */
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

/* A folder made early, and how much of its path was there before. */
struct early {
	struct early *next;
	size_t old;
	int on_success;
	char path[];
};

static struct early *early;

static void drop_empty(int code, void *unused)
{
	(void)unused;
	for (struct early *e = early; e; e = e->next)
		while ((code == 0 ? e->on_success : 1) && strlen(e->path) > e->old && rmdir(e->path) == 0)
			*strrchr(e->path, '/') = '\0';
}

/* How much of a path is there: bytes, up to a '/' or its end. */
static size_t there(char *path)
{
	for (char *slash; (slash = strrchr(path, '/')) && access(path, F_OK) != 0;)
		*slash = '\0';
	return access(path, F_OK) == 0 ? strlen(path) : 0;
}

int folder_try_early(const char *path, int on_success)
{
	struct early *e;
	char copy[PATH_MAX];
	size_t old;
	int failed;

	if (snprintf(copy, sizeof(copy), "%s", path) >= (int)sizeof(copy))
		return ENAMETOOLONG;
	while (*copy && copy[1] && copy[strlen(copy) - 1] == '/')
		copy[strlen(copy) - 1] = '\0';
	e = calloc(1, sizeof(*e) + strlen(copy) + 1);
	if (!e)
		return ENOMEM;
	strcpy(e->path, copy);
	old = there(copy);
	failed = folder_try(e->path);
	if (failed || old == strlen(e->path) || (!early && on_exit(drop_empty, NULL))) {
		free(e);
		return failed;
	}
	e->old = old;
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

int folder_cached(const char *name, char *out, size_t size)
{
	const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
	int n = -1;

	if (cache && *cache)
		n = snprintf(out, size, "%s/relume/%s", cache, name);
	else if (home && *home)
		n = snprintf(out, size, "%s/.cache/relume/%s", home, name);
	return n > 0 && (size_t)n < size;
}
