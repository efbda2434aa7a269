/* Shows the differences found: a table for the terminal, and an HTML page beside the pictures. */
#pragma once

#include <stdio.h>

#include "verbs/bisect/sights.h"

struct findings {
	const struct recording *recordings[N_SIDES];
	const struct partings *partings;
	const struct sight *sight; /* NULL: no pictures were compared */
};

/** Print the table. */
void page_table(const struct findings *f, FILE *out);

/** Write DIR/index.html, which shows DIR/good.png and so on (sight_write). @return 0 or ERR_SYSTEM (reported) */
int page_write(const struct findings *f, const char *folder);
