/* Writes a comparison as Markdown. */
#include "diff/report/markdown.h"

#include <errno.h>
#include <inttypes.h>
#include <string.h>

#include "base/err.h"
#include "base/plural.h"
#include "diff/report/groups.h"
#include "diff/score/gates.h"

enum { MOST_GROUPS = 20, MOST_TEXT = 512 };

/* Write text for a table cell. */
static void put(const char *text, FILE *out)
{
	for (; *text; text++) {
		if (strchr("|<>&\\`*_[]", *text))
			fputc('\\', out);
		fputc(*text == '\n' ? ' ' : *text, out);
	}
}

static void put_single(const struct output_run *run, const struct score *s, FILE *out)
{
	char name[MOST_TEXT];

	output_name(run, s->frame, name, sizeof(name));
	fputs("| ", out);
	if (output_is_named(run, s->frame))
		put(name, out);
	else
		fprintf(out, "%" PRIu64, s->frame);
	fprintf(out, " | %s | ", score_outcome_names[s->outcome]);
}

static void put_group(const struct output_run *run, const struct group *group, FILE *out)
{
	const struct score *s = group->worst;
	const char *comparison = "";
	char text[MOST_TEXT];

	if (group->last > group->first)
		fprintf(out, "| %" PRIu64 "-%" PRIu64 " | %s | ", group->first, group->last, score_outcome_names[s->outcome]);
	else
		put_single(run, s, out);
	for (int g = 0; g < N_GATES; g++) {
		if (!(group->failed & 1u << g))
			continue;
		output_gate_text(s, (enum score_gate_id)g, text, sizeof(text));
		if (*comparison)
			fputs("<br>", out);
		if (strcmp(comparison, groups_comparison(g)) != 0)
			fprintf(out, "%s: ", groups_comparison(g));
		fprintf(out, "**%s** ", score_gates[g].name);
		put(text, out);
		comparison = groups_comparison(g);
	}
	if (group->last > group->first && group->failed)
		fprintf(out, " (frame %" PRIu64 ", the worst)", s->frame);
	fputs(" | ", out);
	if (s->n_blame) {
		output_blame_text(&s->blame[0], text, sizeof(text));
		put(text, out);
	}
	fputs(" |\n", out);
}

static void put_run(const struct output_run *run, const char *report, FILE *out)
{
	struct group groups[MOST_GROUPS];
	uint64_t left;
	size_t n = 0;

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
	n = groups_make(run, groups, MOST_GROUPS, &left);
	if (n)
		fputs("\n| frames | outcome | what failed | blamed |\n|---|---|---|---|\n", out);
	for (size_t i = 0; i < n; i++)
		put_group(run, &groups[i], out);
	if (left)
		fprintf(out, "\nand %" PRIu64 " more\n", left);
	fputs("\n", out);
}

int markdown_write(const struct output_run *run, const char *report, const char *path)
{
	FILE *out = fopen(path, "a");
	int failed;

	if (!out)
		return err_report(ERR_SYSTEM, path, "%s", strerror(errno));
	put_run(run, report, out);
	failed = ferror(out);
	return fclose(out) == 0 && !failed ? 0 : err_report(ERR_SYSTEM, path, "%s", strerror(errno));
}
