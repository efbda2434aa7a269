#include "replay/machine/commands.h"

#include <string.h>

int32_t gls_command_find(const char *name)
{
	uint32_t lo = 0, hi = n_gls_commands;

	while (lo < hi) {
		uint32_t mid = (lo + hi) / 2;
		int order = strcmp(name, gls_commands[mid].name);
		if (order == 0)
			return (int32_t)mid;
		if (order < 0)
			hi = mid;
		else
			lo = mid + 1;
	}
	return -1;
}
