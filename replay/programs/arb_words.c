#include "replay/programs/arb_words.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

const char arb_bad_grammar[] = "an ARB program breaks the grammar",
	   arb_too_much[] = "an ARB program exceeds a limit";

void arb_fail(struct arb_words *w, const char *why)
{
	if (!w->why)
		w->why = why;
	w->at = w->end;
}

char arb_peek(struct arb_words *w)
{
	while (w->at < w->end && (isspace((unsigned char)*w->at) || *w->at == '#')) {
		if (*w->at != '#')
			w->at++;
		else
			while (w->at < w->end && *w->at != '\n' && *w->at != '\r')
				w->at++;
	}
	return w->at < w->end ? *w->at : 0;
}

bool arb_takes(struct arb_words *w, char c)
{
	const bool taken = arb_peek(w) == c && c;

	w->at += taken;
	return taken;
}

void arb_expect(struct arb_words *w, char c)
{
	if (!arb_takes(w, c))
		arb_fail(w, arb_bad_grammar);
}

static size_t name_at(struct arb_words *w)
{
	const char c = arb_peek(w);
	size_t n = 0;

	if (!isalpha((unsigned char)c) && c != '_' && c != '$')
		return 0;
	while (w->at + n < w->end && (isalnum((unsigned char)w->at[n]) || w->at[n] == '_' || w->at[n] == '$'))
		n++;
	return n;
}

size_t arb_name(struct arb_words *w, const char **name)
{
	const size_t n = name_at(w);

	*name = w->at;
	w->at += n;
	return n;
}

bool arb_is(const char *name, size_t n, const char *word)
{
	return strlen(word) == n && memcmp(name, word, n) == 0;
}

bool arb_takes_name(struct arb_words *w, const char *name)
{
	const size_t n = name_at(w);
	const bool taken = n && arb_is(w->at, n, name);

	w->at += taken ? n : 0;
	return taken;
}

uint32_t arb_index(struct arb_words *w, uint32_t limit)
{
	uint32_t value = 0;
	bool any = false;

	arb_peek(w);
	for (; w->at < w->end && isdigit((unsigned char)*w->at); w->at++) {
		value = value * 10 + (uint32_t)(*w->at - '0');
		any = true;
		if (value >= limit)
			break;
	}
	if (any && value < limit)
		return value;
	arb_fail(w, any ? arb_too_much : arb_bad_grammar);
	return 0;
}

uint32_t arb_subscript(struct arb_words *w, uint32_t limit)
{
	uint32_t value;

	arb_expect(w, '[');
	value = arb_index(w, limit);
	arb_expect(w, ']');
	return value;
}

float arb_number(struct arb_words *w)
{
	float sign = arb_takes(w, '-') ? -1.0f : 1.0f, value;
	char text[64], *stop;
	size_t n = 0;

	arb_takes(w, '+');
	arb_peek(w);
	while (n + 1 < sizeof(text) && w->at + n < w->end &&
	       (isdigit((unsigned char)w->at[n]) || w->at[n] == '.' || w->at[n] == 'e' || w->at[n] == 'E' ||
	        ((w->at[n] == '-' || w->at[n] == '+') && n && (w->at[n - 1] == 'e' || w->at[n - 1] == 'E'))))
		n++;
	memcpy(text, w->at, n);
	text[n] = 0;
	value = strtof(text, &stop);
	if (stop == text)
		arb_fail(w, arb_bad_grammar);
	else
		w->at += stop - text;
	return sign * value;
}
