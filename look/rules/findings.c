#include "look/rules/findings.h"

#include <assert.h>
#include <inttypes.h>
#include <stdarg.h>
#include <stdlib.h>

#include "base/err.h"
#include "base/hash.h"
#include "base/memory.h"

/* The tests of a match are broken after TESTS_BEFORE_BREAK if there are more than fit in a line. */
enum { TESTS_IN_A_LINE = 6, TESTS_BEFORE_BREAK = 5 };

static const struct {
	const char *key, *begin, *indent; /* begin: precedes the first line of a rule; indent: precedes the others */
	int is_always; /* 1: the key is written even if its list is empty */
} lists[N_FINDINGS_LISTS] = {
	[FINDINGS_SURFACES] = { "surfaces", "  - ", "    ", 1 }, [FINDINGS_UNSEEN] = { "unseen", "  - ", "    ", 0 },
	[FINDINGS_LIGHTS] = { "lights", "  - ", "    ", 1 },     [FINDINGS_SKY] = { "sky", "  ", "  ", 0 },
	[FINDINGS_GLOSS] = { "gloss", "  ", "  ", 0 },           [FINDINGS_WORLD] = { "world", "  - ", "    ", 0 },
};

const char *findings_key(enum findings_list list)
{
	return lists[list].key;
}

/* --- Collecting -------------------------------------------------------------------------------------------------- */

static void add_value(struct finding *f, const struct finding_value *v, int is_match)
{
	if (!v->key)
		return;
	assert(f->n < FINDING_MOST_VALUES);
	f->values[f->n] = *v;
	f->values[f->n++].is_match = is_match;
}

void finding_set(struct finding *f, const struct finding_value *values, size_t n)
{
	for (size_t i = 0; i < n; i++)
		add_value(f, &values[i], 0);
}

void finding_match(struct finding *f, const struct finding_value *values, size_t n)
{
	for (size_t i = 0; i < n; i++)
		add_value(f, &values[i], 1);
}

__attribute__((format(printf, 4, 0))) static void add_text(struct finding *f, const char *key, enum finding_type type,
                                                           const char *format, va_list args)
{
	struct finding_value v = { .key = key, .type = type };

	if (vasprintf(&v.text, format, args) < 0)
		v.text = NULL;
	add_value(f, &v, 0);
}

static void drop_texts(struct finding *f)
{
	for (unsigned i = 0; i < f->n; i++)
		free(f->values[i].text);
	f->n = 0;
}

struct finding *findings_add(struct findings *findings, enum findings_list list, const char *role, ...)
{
	const int err = MEMORY_GROW(findings->list, findings->room, findings->n + 1);
	struct finding *f = err ? &findings->lost : &findings->list[findings->n++];
	va_list args;

	if (err) {
		findings->err = err;
		drop_texts(f);
	}
	f->list = list;
	f->n = 0;
	va_start(args, role);
	if (role)
		add_text(f, "role", FINDING_TEXT, role, args);
	va_end(args);
	return f;
}

void finding_explain(struct finding *f, double confidence, const char *why, ...)
{
	va_list args;

	FINDING_SET(f, FINDING_NUMBER("confidence", -2, confidence));
	va_start(args, why);
	add_text(f, "why", FINDING_QUOTED, why, args);
	va_end(args);
}

void finding_say(struct finding *f, const char *why, ...)
{
	va_list args;

	va_start(args, why);
	add_text(f, "why", FINDING_QUOTED, why, args);
	va_end(args);
}

int findings_check(const struct findings *findings)
{
	for (size_t i = 0; i < findings->n; i++)
		for (unsigned k = 0; k < findings->list[i].n; k++) {
			const struct finding_value *v = &findings->list[i].values[k];

			if ((v->type == FINDING_TEXT || v->type == FINDING_QUOTED) && !v->text)
				return err_report(ERR_SYSTEM, NULL, "out of memory");
		}
	return findings->err;
}

void findings_free(struct findings *findings)
{
	for (size_t i = 0; i < findings->n; i++)
		drop_texts(&findings->list[i]);
	drop_texts(&findings->lost);
	free(findings->list);
	*findings = (struct findings){ .n = 0 };
}

/* --- The file ---------------------------------------------------------------------------------------------------- */

void finding_print_number(const struct finding_value *v, unsigned i, char out[64])
{
	if (v->is_place && i == 3)
		snprintf(out, 64, "%g", v->numbers[i]);
	else if (v->digits < 0)
		snprintf(out, 64, "%.*f", -v->digits, v->numbers[i]);
	else
		snprintf(out, 64, "%.*g", v->digits, v->numbers[i]);
}

static void write_value(const struct finding_value *v, FILE *out)
{
	char text[64];

	fprintf(out, "%s: ", v->key);
	if (v->type == FINDING_TRUTH)
		fputs(v->count ? "yes" : "no", out);
	if (v->type == FINDING_COUNT)
		fprintf(out, "%" PRIu64, v->count);
	if (v->type == FINDING_WORD || v->type == FINDING_TEXT)
		fputs(v->type == FINDING_WORD ? v->word : v->text, out);
	if (v->type == FINDING_QUOTED)
		fprintf(out, "\"%s\"", v->text);
	if (v->type == FINDING_HASH) {
		hash_text(v->hash, text);
		fprintf(out, "\"%s\"", text);
	}
	if (v->type != FINDING_NUMBERS)
		return;
	for (unsigned i = 0; i < v->n || i == 0; i++) {
		finding_print_number(v, i, text);
		fprintf(out, "%s%s", i ? ", " : v->n ? "[" : "", text);
	}
	fputs(v->n ? "]" : "", out);
}

/* Write the tests of `match`, values[0 .. n-1], as one mapping in braces. */
static void write_match(const struct finding_value *values, unsigned n, FILE *out)
{
	fputs("match: { ", out);
	for (unsigned i = 0; i < n; i++) {
		if (i)
			fputs(n > TESTS_IN_A_LINE && i == TESTS_BEFORE_BREAK ? ",\n             " : ", ", out);
		write_value(&values[i], out);
	}
	fputs(" }", out);
}

static void write_finding(const struct finding *f, FILE *out)
{
	unsigned n_tests;

	for (unsigned i = 0; i < f->n; i += n_tests ? n_tests : 1) {
		fputs(i ? lists[f->list].indent : lists[f->list].begin, out);
		for (n_tests = 0; i + n_tests < f->n && f->values[i + n_tests].is_match;)
			n_tests++;
		if (n_tests)
			write_match(&f->values[i], n_tests, out);
		else
			write_value(&f->values[i], out);
		fputc('\n', out);
	}
}

static void write_summary(const struct findings_summary *s, const char *trace, FILE *out)
{
	fprintf(out, "# Rules for %s, written by relume look after it studied %zu frames", trace, s->frames);
	if (s->frames)
		fprintf(out, " (%" PRIu64 " to %" PRIu64 ")", s->first, s->last);
	fprintf(out, ".\n# relume render --look FILE reads them. Change what you like: this file decides.\n");
	if (!s->known)
		fprintf(out, "# camera: unknown, as no mesh was drawn twice\n");
	else
		fprintf(out,
		        "# camera: followed through %zu of %zu frames, moves in %zu; %.0f %% of what is seen again, by "
		        "size, stands still\n",
		        s->known, s->frames, s->moved, s->percent);
	fprintf(out,
	        "# meshes: %zu static, %zu moving, %zu with the viewer, %zu seen in one frame; %zu deforming shapes\n",
	        s->still, s->moving, s->carried, s->once, s->deforming);
}

void findings_write(const struct findings *findings, const char *trace, FILE *out)
{
	write_summary(&findings->summary, trace, out);
	fprintf(out, "replace: yes # no: tricks stay as they are\n");
	for (int l = 0; l < N_FINDINGS_LISTS; l++) {
		size_t n = 0;

		for (size_t i = 0; i < findings->n; i++)
			n += (int)findings->list[i].list == l;
		if (n)
			fprintf(out, "%s:\n", lists[l].key);
		else if (lists[l].is_always)
			fprintf(out, "%s: []\n", lists[l].key);
		for (size_t i = 0; i < findings->n && n; i++)
			if ((int)findings->list[i].list == l)
				write_finding(&findings->list[i], out);
	}
}
