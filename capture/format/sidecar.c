#include "capture/format/sidecar.h"

#include <stdio.h>
#include <string.h>

int sidecar_name(char *out, size_t size, const char *trace, const char *suffix)
{
	size_t stem = strlen(trace);

	if (stem > 6 && strcmp(trace + stem - 6, ".trace") == 0)
		stem -= 6;
	return snprintf(out, size, "%.*s%s", (int)stem, trace, suffix) < (int)size;
}
