/* The words of an ARB assembly program, one at a time. A failure sticks: all that follows does nothing. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Failures that are OpenGL's errors, too: the text is wrong. */
extern const char arb_bad_grammar[], arb_too_much[];

struct arb_words {
	const char *at, *end;
	const char *why; /* the first failure, a static string; NULL: none yet */
};

/** Pass over blanks and comments. @return the next character; 0: the end */
char arb_peek(struct arb_words *w);

/** Take a character if it comes next. @return 1 if so */
bool arb_takes(struct arb_words *w, char c);

/** The same where it must come. */
void arb_expect(struct arb_words *w, char c);

/** Take a name: letters, digits, _ and $. @return its length; 0: there is none */
size_t arb_name(struct arb_words *w, const char **name);

/** Take the name if it is this one. @return 1 if so */
bool arb_takes_name(struct arb_words *w, const char *name);

/** Take a whole number below `limit`, which must come. @return it; 0 after a failure */
uint32_t arb_index(struct arb_words *w, uint32_t limit);

/** The same in brackets. */
uint32_t arb_subscript(struct arb_words *w, uint32_t limit);

/** Take a number with or without a sign, which must come. */
float arb_number(struct arb_words *w);

void arb_fail(struct arb_words *w, const char *why);

/** 1 where a name of n letters is this one. */
bool arb_is(const char *name, size_t n, const char *word);
