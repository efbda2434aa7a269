#include "look/rules/matched.h"

#include <inttypes.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"
#include "base/plural.h"
#include "look/rules/rules.h"

enum { MOST_LINES = 20 };

/* Draws and frames that a rule has matched. */
struct count {
	const char *file; /* one of `names` */
	uint32_t rule;    /* in its file, from 1 */
	_Atomic uint64_t draws, frames;
};

struct matched {
	struct count *counts;
	size_t n;
	char **names; /* [n_names] of the rule files */
	size_t n_names;
	_Atomic uint64_t frames; /* frames of the run so far */
};

int matched_create(const char *name, uint32_t n_rules, struct matched **out)
{
	struct matched *m = calloc(1, sizeof(*m));

	*out = m;
	if (m) {
		m->counts = calloc(n_rules + (size_t)1, sizeof(*m->counts));
		m->names = calloc(1, sizeof(*m->names));
	}
	if (m && m->names && (m->names[0] = strdup(name)))
		m->n_names = 1;
	if (!m || !m->counts || !m->n_names) {
		matched_destroy(out);
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	}
	for (; m->n < n_rules; m->n++) {
		m->counts[m->n].file = m->names[0];
		m->counts[m->n].rule = (uint32_t)m->n + 1;
	}
	return 0;
}

void matched_destroy(struct matched **matched)
{
	struct matched *m = *matched;

	for (size_t i = 0; m && i < m->n_names; i++)
		free(m->names[i]);
	if (m) {
		free(m->names);
		free(m->counts);
	}
	free(m);
	*matched = NULL;
}

int matched_append(struct matched *to, struct matched **more)
{
	struct matched *from = *more;
	int err = memory_resize(&to->counts, to->n + from->n + 1, sizeof(*to->counts));

	if (!err)
		err = memory_resize(&to->names, to->n_names + from->n_names, sizeof(*to->names));
	if (err)
		return err;
	memcpy(to->counts + to->n, from->counts, from->n * sizeof(*to->counts));
	memcpy(to->names + to->n_names, from->names, from->n_names * sizeof(*to->names));
	to->n += from->n;
	to->n_names += from->n_names;
	from->n_names = 0;
	matched_destroy(more);
	return 0;
}

void matched_add(struct matched *m, const uint32_t *draws)
{
	m->frames++;
	for (size_t i = 0; i < m->n; i++) {
		m->counts[i].draws += draws[i];
		m->counts[i].frames += draws[i] > 0;
	}
}

/* 1 if a rule replaces a trick, but the rules say `replace: no`. */
static int is_off(const struct rules *rules, const struct surface_rule *r)
{
	return rules->replace && !*rules->replace && (r->left_out || r->solid || r->shadow_unit);
}

void matched_report(const struct look *look, int quiet)
{
	const struct matched *m = look ? look->matched : NULL;
	unsigned lines = 0;

	for (size_t i = 0; m && m->frames && i < m->n && lines <= MOST_LINES; i++) {
		const struct count *c = &m->counts[i];

		if (look->rules->surfaces[i].reason.role || is_off(look->rules, &look->rules->surfaces[i]))
			continue;
		if (quiet && c->draws)
			continue;
		if (lines++ == MOST_LINES)
			fprintf(stderr, "  and more rules\n");
		else if (c->draws)
			fprintf(stderr,
			        "  %s: rule %" PRIu32 " matches %" PRIu64 " draw%s in %" PRIu64 " of %" PRIu64
			        " frame%s\n",
			        c->file, c->rule, c->draws, plural(c->draws), c->frames, m->frames, plural(m->frames));
		else
			err_warn(c->file,
			         "surfaces, rule %" PRIu32 " matches nothing in %" PRIu64
			         " frame%s; 'relume scene --json' shows hashes and draws",
			         c->rule, m->frames, plural(m->frames));
	}
}
