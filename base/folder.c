#include "base/folder.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/err.h"

/* `path` is changed meanwhile, and whole again afterwards. */
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
	return errno == EEXIST ? 0 : err_report(ERR_SYSTEM, path, "%s", strerror(errno));
}

int folder_make(const char *path)
{
	char copy[PATH_MAX];

	if (snprintf(copy, sizeof(copy), "%s", path) >= (int)sizeof(copy))
		return err_report(ERR_SYSTEM, path, "the name is too long");
	return *copy ? make_all(copy) : 0;
}

int folder_make_for(const char *file)
{
	const char *slash = strrchr(file, '/');
	char copy[PATH_MAX];

	if (!slash || slash == file)
		return 0;
	if (snprintf(copy, sizeof(copy), "%.*s", (int)(slash - file), file) >= (int)sizeof(copy))
		return err_report(ERR_SYSTEM, file, "the name is too long");
	return make_all(copy);
}
