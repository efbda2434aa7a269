#include "base/beside.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/err.h"

int beside_find(const char *name, char *out, size_t size)
{
	static const char *const folders[] = { ".", "../lib/relume" };
	char command[PATH_MAX];
	ssize_t n = readlink("/proc/self/exe", command, sizeof(command) - 1);

	if (n < 0)
		return err_report(ERR_SYSTEM, NULL, "cannot find this command's own folder: %s", strerror(errno));
	command[n] = '\0';
	*strrchr(command, '/') = '\0';
	for (size_t i = 0; i < sizeof(folders) / sizeof(folders[0]); i++)
		if (snprintf(out, size, "%s/%s/%s", command, folders[i], name) < (int)size && access(out, R_OK) == 0)
			return 0;
	return err_report(ERR_SYSTEM, name, "is neither in %s nor in %s/%s; reinstall Relume", command, command, folders[1]);
}
