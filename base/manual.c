#include "base/manual.h"

#include <stddef.h>
#include <string.h>

const struct manual_text *manual_find(const struct manual_text *texts, const char *name)
{
	for (; texts->name; texts++)
		if (strcmp(texts->name, name) == 0)
			return texts;
	return NULL;
}
