/* Prints the full table of a comparison. */
#include "diff/report/table.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/plural.h"
#include "diff/report/summary.h"
#include "diff/score/gates.h"

/* Sort indices of scores: frames that did not pass first, each part by frame. out has n_scores elements. */
static void order_scores(const struct output_run *run, size_t *out)
{
	size_t n = 0;

	for (int passed = 0; passed < 2; passed++)
		for (size_t i = 0; i < run->n_scores; i++)
			if ((run->scores[i].outcome == SCORE_FRAME_PASSED) == passed) /* frames that did not pass matter most */
				out[n++] = i;
}

static void print_failure(const struct score *s, FILE *out)
{
	char text[512];

	for (int g = 0; g < N_GATES; g++) {
		if (s->gates[g].state < SCORE_WARNED)
			continue;
		output_gate_text(s, (enum score_gate_id)g, text, sizeof(text));
		fprintf(out, "          %-3s %s%s: %s\n", score_gates[g].name,
		        s->gates[g].state == SCORE_WARNED ? "(warning) " : "", score_gates[g].title, text);
	}
	if (s->outcome == SCORE_FRAME_FLAKY)
		fprintf(out, "          known to be flaky: %s\n", s->flaky_reason);
	for (uint32_t b = 0; b < s->n_blame && b < 3; b++) {
		double share = 100 * (double)s->blame[b].pixels / (double)s->blamed_pixels;

		output_blame_text(&s->blame[b], text, sizeof(text));
		fprintf(out, "          %s holds %.3g %% of %" PRIu64 " failing pixel%s\n", text, share, s->blamed_pixels,
		        plural(s->blamed_pixels));
	}
}

/** Print the figures that have a column: values, "-" if not measured, "!" after them if the gate failed; or
 * headings. */
static void print_columns(const struct score *s, FILE *out)
{
	for (int g = 0; g < N_GATES; g++)
		for (int f = 0; f < score_gates[g].n_figures; f++) {
			const char *column = score_gates[g].figures[f].column;
			char text[32] = "- ";

			if (s && s->gates[g].state != SCORE_NOT_MEASURED)
				snprintf(text, sizeof(text), "%.4g%c", s->gates[g].value[f], s->gates[g].state == SCORE_FAILED ? '!' : ' ');
			if (column)
				fprintf(out, " %9s", s ? text : column);
		}
}

/* Print the meaning of the columns. */
static void print_legend(FILE *out)
{
	fputs("legend: - not measured; ! failed; fidelity: pixels that pass R1, R1b or R2; beauty: FLIP of the beauty "
	      "against the reference\n",
	      out);
	for (int g = 0; g < N_GATES; g++)
		for (int f = 0; f < score_gates[g].n_figures; f++) {
			const struct score_figure *info = &score_gates[g].figures[f];

			if (info->column)
				fprintf(out, "  %-7s %s: %s, %s %g%s%s\n", info->column, score_gates[g].title,
				        info->name, info->at_least ? "by default at least" : "by default at most",
				        info->bar, info->unit[0] ? " " : "", info->unit);
		}
}

/* Print a frame's row, without its number. */
static void print_row(const struct output_run *run, const struct score *s, FILE *out)
{
	fprintf(out, " %-10s", score_outcome_names[s->outcome]);
	if (output_is_compared(s)) {
		if (run->reference)
			fprintf(out, " %8.3f%%", 100 * s->fidelity);
		else
			fprintf(out, " %9s", "- ");
		print_columns(s, out);
		if (isnan(s->info.beauty_flip))
			fprintf(out, " %9s", "- ");
		else
			fprintf(out, " %8.4g ", s->info.beauty_flip);
	}
	if (output_is_named(run, s->frame)) {
		char name[256];

		output_name(run, s->frame, name, sizeof(name));
		fprintf(out, " %s", name);
	}
	fputc('\n', out);
	if (s->outcome == SCORE_FRAME_FAILED || s->outcome == SCORE_FRAME_FLAKY || output_has_warning(s))
		print_failure(s, out);
}

/* Consecutive frames that failed alike. */
struct rows {
	uint64_t first, last;
	char *text; /* NULL: none */
};

static void end_rows(struct rows *rows, FILE *out)
{
	char range[48];

	if (!rows->text)
		return;
	snprintf(range, sizeof(range), rows->last > rows->first ? "%" PRIu64 "-%" PRIu64 : "%" PRIu64, rows->first,
	         rows->last);
	fprintf(out, "%7s%s", range, rows->text);
	free(rows->text);
	rows->text = NULL;
}

/* Add a row for consecutive frames that fail with the same figures. Each frame that passed has its own. */
static int add_row(struct rows *rows, const struct output_run *run, const struct score *s, FILE *out)
{
	size_t size;
	char *text = NULL;
	FILE *row = open_memstream(&text, &size);

	if (row)
		print_row(run, s, row);
	if (!row || fclose(row) != 0) {
		free(text);
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	}
	if (rows->text && s->outcome != SCORE_FRAME_PASSED && s->frame == rows->last + 1 && strcmp(text, rows->text) == 0) {
		rows->last = s->frame;
		free(text);
		return 0;
	}
	end_rows(rows, out);
	*rows = (struct rows){ s->frame, s->frame, text };
	return 0;
}

int table_write(const struct output_run *run, FILE *out)
{
	size_t *order = malloc((run->n_scores ? run->n_scores : 1) * sizeof(*order));
	struct rows rows = { .text = NULL };
	int err = 0;

	if (!order)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	order_scores(run, order);
	fprintf(out, "%7s %-10s %9s", "frame", "outcome", "fidelity");
	print_columns(NULL, out);
	fprintf(out, " %9s\n", "beauty");
	for (size_t i = 0; i < run->n_scores && !err; i++)
		err = add_row(&rows, run, &run->scores[order[i]], out);
	end_rows(&rows, out);
	free(order);

	/* Notes on the method, from the first compared frame: gates not measured, or measured by other means. */
	for (size_t i = 0; i < run->n_scores; i++) {
		const struct score *s = &run->scores[i];

		if (!output_is_compared(s))
			continue;
		if (s->gates[GATE_V].state != SCORE_PASSED)
			continue;
		for (int g = 0; g < N_GATES; g++)
			if (s->gates[g].state == SCORE_NOT_MEASURED)
				fprintf(out, "not measured: %s %s: %s\n", score_gates[g].name, score_gates[g].title,
				        s->gates[g].note);
		if (s->gates[GATE_R4].state != SCORE_NOT_MEASURED)
			fprintf(out, "R4 %s: %s\n", score_gates[GATE_R4].title, s->gates[GATE_R4].note);
		break;
	}
	print_legend(out);
	return err ? err : summary_close(run, out);
}
