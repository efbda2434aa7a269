/*
 * What `relume help` prints besides the tables of options: the formats of files, and examples. packaging/manual.py makes both lists
 * from the headers that document the formats and from packaging/examples.txt.
 */
#pragma once

struct manual_text {
	const char *name;    /* "look-file"; of examples: the verb's */
	const char *summary; /* one line; of examples: NULL */
	const char *text;    /* whole lines */
};

/* Both end with a NULL name. */
extern const struct manual_text manual_formats[], manual_examples[];

/** @return the text of this name, or NULL */
const struct manual_text *manual_find(const struct manual_text *texts, const char *name);
