/*
 * Texts that `relume help` prints besides option tables: file formats and examples. packaging/manual.py generates both
 * lists from the headers that document the formats and from packaging/examples.txt.
 */
#pragma once

struct manual_text {
	const char *name;    /* "look-file"; for examples, the verb's name */
	const char *summary; /* one line; NULL for examples */
	const char *text;    /* whole lines */
};

/* Both end with a NULL name. */
extern const struct manual_text manual_formats[], manual_examples[];

/** @return the text of this name, or NULL */
const struct manual_text *manual_find(const struct manual_text *texts, const char *name);
