#include "base/folder_bound.h"

#include <dirent.h>
#include <fcntl.h>
#include <fnmatch.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/memory.h"

struct kept {
	struct timespec used;
	uint64_t bytes;
	char name[NAME_MAX + 1];
};

static int compare_kept(const void *a, const void *b)
{
	const struct kept *x = a, *y = b;

	if (x->used.tv_sec != y->used.tv_sec)
		return x->used.tv_sec < y->used.tv_sec ? -1 : 1;
	return (x->used.tv_nsec > y->used.tv_nsec) - (x->used.tv_nsec < y->used.tv_nsec);
}

/* List the files. @return their number, in an array that the caller frees; 0 also if memory is short (reported) */
static size_t list_kept(DIR *dir, const char *pattern, struct kept **out)
{
	size_t n = 0, room = 0;
	struct dirent *entry;

	*out = NULL;
	while ((entry = readdir(dir))) {
		struct stat info;

		if (fnmatch(pattern, entry->d_name, 0) ||
		    fstatat(dirfd(dir), entry->d_name, &info, AT_SYMLINK_NOFOLLOW) || !S_ISREG(info.st_mode))
			continue;
		if (MEMORY_GROW(*out, room, n + 1))
			return 0;
		(*out)[n].used = info.st_mtim;
		(*out)[n].bytes = (uint64_t)info.st_size;
		memcpy((*out)[n++].name, entry->d_name, strlen(entry->d_name) + 1);
	}
	return n;
}

int folder_keep_bound(const char *folder, const char *pattern, uint64_t most, uint64_t left)
{
	DIR *dir = opendir(folder);
	uint64_t bytes = 0;
	struct kept *kept;
	size_t n;

	if (!dir)
		return 0;
	n = list_kept(dir, pattern, &kept);
	for (size_t i = 0; i < n; i++)
		bytes += kept[i].bytes;
	if (kept && bytes > most) {
		qsort(kept, n, sizeof(*kept), compare_kept);
		for (size_t i = 0; i < n && bytes > left; i++) {
			unlinkat(dirfd(dir), kept[i].name, 0);
			bytes -= kept[i].bytes;
		}
	}
	free(kept);
	closedir(dir);
	return 1;
}
