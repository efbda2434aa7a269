/* Scanner for ARB assembly programs. A failure is kept: after it, every function does nothing. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Failures that are GL errors as well: the text is invalid. */
extern const char arb_bad_grammar[], arb_too_much[];

struct arb_words {
	const char *at, *end;
	const char *why; /* the first failure, a static string; NULL: none yet */
};

/** Skip white space and comments. @return the next character; 0: the end */
char arb_peek(struct arb_words *w);

/** Consume a character if it is next. @return 1 if so */
bool arb_takes(struct arb_words *w, char c);

/** As arb_takes, but the character is required. */
void arb_expect(struct arb_words *w, char c);

/** Consume a name: letters, digits, _ and $. @return its length; 0: there is none */
size_t arb_name(struct arb_words *w, const char **name);

/** Consume the next name if it is this one. @return 1 if so */
bool arb_takes_name(struct arb_words *w, const char *name);

/** Consume an integer below `limit`, which is required. @return it; 0 after a failure */
uint32_t arb_index(struct arb_words *w, uint32_t limit);

/** As arb_index, in brackets. */
uint32_t arb_subscript(struct arb_words *w, uint32_t limit);

/** Consume a number with an optional sign, which is required. */
float arb_number(struct arb_words *w);

void arb_fail(struct arb_words *w, const char *why);

/** 1 if a name of n letters equals a word. */
bool arb_is(const char *name, size_t n, const char *word);
