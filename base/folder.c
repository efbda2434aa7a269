#include "base/folder.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

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
