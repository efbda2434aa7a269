#include "base/caches.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/err.h"
#include "base/folder.h"

/* @return 0, or the errno of why it cannot be written */
static int try_cache(const char *caches, const char *name)
{
	char path[PATH_MAX];
	int failed;

	if (snprintf(path, sizeof(path), "%s/%s", caches, name) >= (int)sizeof(path))
		return ENAMETOOLONG;
	failed = folder_try_early(path, 1);
	return failed ? failed : access(path, W_OK | X_OK) ? errno : 0;
}

/*
 * Make a folder that only this user can read, under a name that later runs find; under a random name if another user
 * has taken that one. @return 1 if it exists now
 */
static int make_own(char *path, size_t size)
{
	const char *tmp = getenv("TMPDIR");
	struct stat st;

	if (snprintf(path, size, "%s/relume-caches-%u", tmp && *tmp ? tmp : "/tmp", (unsigned)geteuid()) >= (int)size - 8)
		return 0;
	if (mkdir(path, 0700) == 0)
		return 1;
	if (lstat(path, &st) == 0 && S_ISDIR(st.st_mode) && st.st_uid == geteuid() && !(st.st_mode & 077))
		return 1;
	strcat(path, "-XXXXXX");
	return mkdtemp(path) != NULL;
}

void caches_find(void)
{
	char caches[PATH_MAX], own[PATH_MAX];
	const int has_home = folder_caches(caches, sizeof(caches));
	int failed = has_home ? try_cache(caches, "relume") : ENOENT;

	if (!failed && !getenv("POCL_CACHE_DIR"))
		failed = try_cache(caches, "pocl");
	if (!failed || failed == ENOMEM /* not the folder's fault */ || !make_own(own, sizeof(own)))
		return;
	err_warn(has_home ? caches : "~/.cache",
	         "cannot be written (%s); caches are in %s instead: set XDG_CACHE_HOME to a folder that can be",
	         strerror(failed), own);
	setenv("XDG_CACHE_HOME", own, 1);
}
