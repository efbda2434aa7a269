#include "diff/report/markdown.h"

#include <errno.h>
#include <inttypes.h>
#include <string.h>

#include "base/err.h"
#include "base/plural.h"
#include "diff/score/gates.h"

enum { MOST_GROUPS = 20, MOST_TEXT = 512 };

/* Text in a cell of a table. */
static void put(const char *text, FILE *out)
{
	for (; *text; text++) {
		if (strchr("|<>&\\`*_[]", *text))
			fputc('\\', out);
		fputc(*text == '\n' ? ' ' : *text, out);
	}
}

/* Which comparison a gate belongs to. */
static const char *comparison_of(int gate)
{
	return gate == GATE_B ? "not as approved: " : score_gates[gate].needs_reference ? "not as the program showed it: " : "by itself: ";
}

/* Frames in a row that failed the same gates; */
struct group {
	uint64_t first, last;
	const struct score *worst; /* NULL: none */
	unsigned failed;           /* bit g: gate g */
	char blamed[MOST_TEXT];    /* the worst one's first draw */
};

static unsigned failed_gates(const struct score *s)
{
	unsigned failed = 0;

	for (int g = 0; g < N_GATES && output_is_compared(s); g++)
		failed |= s->gates[g].state == SCORE_FAILED ? 1u << g : 0;
	return failed;
}

/* How far a frame is from what it should be: the lowest fidelity, then most pixels off from the approved frame. */
static int is_worse(const struct score *a, const struct score *b)
{
	return a->fidelity < b->fidelity || (a->fidelity <= b->fidelity && a->gates[GATE_B].value[0] > b->gates[GATE_B].value[0]);
}

static void put_group(const struct group *group, FILE *out)
{
	const struct score *s = group->worst;
	const char *comparison = "";
	char text[MOST_TEXT];

	if (group->last > group->first)
		fprintf(out, "| %" PRIu64 "-%" PRIu64 " | %s | ", group->first, group->last, score_outcome_names[s->outcome]);
	else
		fprintf(out, "| %" PRIu64 " | %s | ", group->first, score_outcome_names[s->outcome]);
	for (int g = 0; g < N_GATES; g++) {
		if (!(group->failed & 1u << g))
			continue;
		output_gate_text(s, (enum score_gate_id)g, text, sizeof(text));
		fprintf(out, "%s%s**%s** ", *comparison ? "<br>" : "", strcmp(comparison, comparison_of(g)) ? comparison_of(g) : "", score_gates[g].name);
		put(text, out);
		comparison = comparison_of(g);
	}
	if (group->last > group->first && group->failed)
		fprintf(out, " (frame %" PRIu64 ", the worst)", s->frame);
	fputs(" | ", out);
	put(group->blamed, out);
	fputs(" |\n", out);
}

/* @return 1 where the frame begins another group than the one before it */
static int add_frame(struct group *group, const struct score *s, FILE *out)
{
	const unsigned failed = failed_gates(s);
	char blamed[MOST_TEXT] = "";

	if (s->n_blame)
		output_blame_text(&s->blame[0], blamed, sizeof(blamed));
	if (group->worst && s->frame == group->last + 1 && s->outcome == group->worst->outcome && failed == group->failed) {
		group->last = s->frame;
		if (is_worse(s, group->worst)) {
			group->worst = s;
			strcpy(group->blamed, blamed);
		}
		return 0;
	}
	if (group->worst)
		put_group(group, out);
	*group = (struct group){ s->frame, s->frame, s, failed, "" };
	strcpy(group->blamed, blamed);
	return 1;
}

static void put_run(const struct output_run *run, const char *report, FILE *out)
{
	struct group group = { .worst = NULL };
	size_t n = 0, left = 0;

	fputs("### relume diff: ", out);
	put(run->name, out);
	fputs("\n\n", out);
	for (int o = 0; o < N_SCORE_OUTCOMES; o++)
		if (run->counts[o] || o == SCORE_FRAME_PASSED)
			fprintf(out, "%s%" PRIu64 " %s", n++ ? ", " : "", run->counts[o], score_outcome_names[o]);
	fprintf(out, " of %zu frame%s", run->n_scores, plural(run->n_scores));
	if (report)
		fprintf(out, "; [page](%s/index.html), [%s](%s/sheet.png)", report,
		        run->baseline ? "approved, now and difference" : "contact sheet", report);
	fputs("\n", out);
	n = 0;
	for (size_t i = 0; i < run->n_scores; i++) {
		if (run->scores[i].outcome == SCORE_FRAME_PASSED)
			continue;
		if (n == 0)
			fputs("\n| frames | outcome | what failed | blamed |\n|---|---|---|---|\n", out);
		if (n < MOST_GROUPS)
			n += (size_t)add_frame(&group, &run->scores[i], out);
		else
			left++;
	}
	if (group.worst)
		put_group(&group, out);
	if (left)
		fprintf(out, "\nand %zu more\n", left);
	fputs("\n", out);
}

int markdown_write(const struct output_run *run, const char *report, const char *path)
{
	FILE *out = fopen(path, "a");

	if (!out)
		return err_report(ERR_SYSTEM, path, "%s", strerror(errno));
	put_run(run, report, out);
	return !ferror(out) & (fclose(out) == 0) ? 0 : err_report(ERR_SYSTEM, path, "%s", strerror(errno));
}
