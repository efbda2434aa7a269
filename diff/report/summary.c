/* Prints the summary of a comparison, 100 columns wide. */
#include "diff/report/summary.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/plural.h"
#include "diff/report/groups.h"
#include "diff/score/gates.h"

enum { COLUMNS = 100, MOST_GROUPS = 12, MOST_BLAME = 3, MOST_TEXT = 640 };

/* --- The last lines ---------------------------------------------------------------------------------------------- */

static int compare_names(const void *a, const void *b)
{
	return strverscmp(((const struct score_program *)a)->name, ((const struct score_program *)b)->name);
}

/* Print a line for each of the application's own programs, summed over frames. @return 0 or ERR_SYSTEM (reported) */
static int print_programs(const struct output_run *run, FILE *out)
{
	struct score_program *all;
	size_t n = 0;

	for (size_t i = 0; i < run->n_scores; i++)
		n += run->scores[i].n_programs;
	if (!n)
		return 0;
	all = malloc(n * sizeof(*all));
	if (!all)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	n = 0;
	for (size_t i = 0; i < run->n_scores; i++) {
		memcpy(all + n, run->scores[i].programs, run->scores[i].n_programs * sizeof(*all));
		n += run->scores[i].n_programs;
	}
	qsort(all, n, sizeof(*all), compare_names);
	for (size_t i = 0, end; i < n; i = end) {
		struct score_program sum = all[i];

		for (end = i + 1; end < n && strcmp(all[end].name, sum.name) == 0; end++) {
			sum.pixels += all[end].pixels;
			sum.failing += all[end].failing;
		}
		fprintf(out, "%s: %.3f %% of %" PRIu64 " px\n", sum.name,
		        100 * (1 - (double)sum.failing / (double)sum.pixels), sum.pixels);
	}
	free(all);
	return 0;
}

/* Print one line: counts by outcome and the worst frame. */
static void print_counts(const struct output_run *run, FILE *out)
{
	const struct score *worst = NULL;
	char name[256];

	fprintf(out, "%zu frame%s:", run->n_scores, plural(run->n_scores));
	for (int o = 0, n = 0; o < N_SCORE_OUTCOMES; o++)
		if (run->counts[o] || o == SCORE_FRAME_PASSED)
			fprintf(out, "%s %" PRIu64 " %s", n++ ? "," : "", run->counts[o], score_outcome_names[o]);
	for (size_t i = 0; i < run->n_scores; i++) {
		const struct score *s = &run->scores[i];

		if (output_is_compared(s) && (!worst || s->fidelity < worst->fidelity))
			worst = s;
	}
	if (worst && run->reference) {
		output_name(run, worst->frame, name, sizeof(name));
		fprintf(out, "; lowest fidelity %.3f %% (%s)", 100 * worst->fidelity, name);
	}
	if (output_first_wrong(run)) {
		output_name(run, output_first_wrong(run)->frame, name, sizeof(name));
		fprintf(out, "; first wrong %s", name);
	}
	fputc('\n', out);
	if (run->n_unmatched)
		fprintf(out, "not compared: %" PRIu64 " frame%s of %s%s%s that %s lacks; --all demands %s\n", run->n_unmatched,
		        plural(run->n_unmatched), run->reference ? run->reference : "",
		        run->reference && run->baseline ? " or " : "", run->baseline ? run->baseline : "", run->traced,
		        run->n_unmatched == 1 ? "it" : "them");
}

int summary_close(const struct output_run *run, FILE *out)
{
	const int err = print_programs(run, out);

	print_counts(run, out);
	return err;
}

/* --- Lines of 100 columns ---------------------------------------------------------------------------------------- */

/* Columns of UTF-8 text: continuation bytes take none. */
static int columns_of(const char *text, size_t n)
{
	int columns = 0;

	for (size_t i = 0; i < n; i++)
		columns += (text[i] & 0xc0) != 0x80;
	return columns;
}

/* Print text indented by `indent` spaces, broken between words; further lines are indented by two more. A word that is
 * too long gets its own line. */
static void put_text(const char *text, int indent, FILE *out)
{
	int at = fprintf(out, "%*s", indent, "");

	for (int first = 1; *text; first = 0) {
		const size_t n = strcspn(text, " ");
		const int columns = columns_of(text, n);

		if (!first && at + 1 + columns > COLUMNS)
			at = fprintf(out, "\n%*s", indent + 2, "") - 1;
		else if (!first)
			at += fprintf(out, " ");
		fwrite(text, 1, n, out);
		at += columns;
		text += n + (text[n] == ' ');
	}
	fputc('\n', out);
}

/* --- Frames ------------------------------------------------------------------------------------------------------ */

static const char *reason_of(const struct score *s)
{
	switch (s->outcome) {
	case SCORE_FRAME_NEW: return "nobody has approved it";
	case SCORE_FRAME_MISSING: return "there is nothing to compare with the reference or the approved frame";
	case SCORE_FRAME_EXTRA: return "there is no reference for it";
	case SCORE_FRAME_UNREADABLE: return "one of its files cannot be read; the message above says why";
	case SCORE_FRAME_FLAKY: return s->flaky_reason;
	default: return "";
	}
}

/* "frames 3-5: failed, fidelity 93.1 % in the worst, frame 4: out/f.0004.exr" */
static void put_heading(const struct output_run *run, const struct group *group, FILE *out)
{
	const struct score *s = group->worst;
	const char *file = output_file(run->set, s->frame), *outcome = score_outcome_names[s->outcome];
	char name[256], text[MOST_TEXT + 4096];
	size_t n;

	output_name(run, group->first, name, sizeof(name));
	if (group->last > group->first)
		snprintf(name, sizeof(name), "frames %" PRIu64 "-%" PRIu64, group->first, group->last);
	n = (size_t)snprintf(text, sizeof(text), "%s: %s", name, outcome);
	if (*reason_of(s))
		n += (size_t)snprintf(text + n, sizeof(text) - n, ": %.512s", reason_of(s));
	if (output_is_compared(s) && run->reference)
		n += (size_t)snprintf(text + n, sizeof(text) - n, ", fidelity %.3f %%", 100 * s->fidelity);
	if (group->last > group->first && group->failed)
		n += (size_t)snprintf(text + n, sizeof(text) - n, " in the worst, frame %" PRIu64, s->frame);
	if (file && n < sizeof(text))
		snprintf(text + n, sizeof(text) - n, " (%s)", file);
	put_text(text, 0, out);
}

static void put_gates(const struct score *s, enum score_state state, FILE *out)
{
	const char *comparison = "";
	char text[MOST_TEXT];

	for (int g = 0; g < N_GATES; g++) {
		int n;

		if (s->gates[g].state != state)
			continue;
		if (strcmp(comparison, groups_comparison(g)) != 0) {
			comparison = groups_comparison(g);
			fprintf(out, "  %s%s\n", state == SCORE_WARNED ? "warning: " : "", comparison);
		}
		n = snprintf(text, sizeof(text), "%s %s: ", score_gates[g].name, score_gates[g].title);
		output_gate_text(s, (enum score_gate_id)g, text + n, sizeof(text) - (size_t)n);
		put_text(text, 4, out);
	}
}

static void put_blame(const struct score *s, FILE *out)
{
	char text[MOST_TEXT];

	for (uint32_t b = 0; b < s->n_blame && b < MOST_BLAME; b++) {
		size_t n;

		output_blame_text(&s->blame[b], text, sizeof(text));
		n = strlen(text);
		snprintf(text + n, sizeof(text) - n, " holds %.3g %% of %" PRIu64 " failing pixel%s",
		         100 * (double)s->blame[b].pixels / (double)s->blamed_pixels, s->blamed_pixels, plural(s->blamed_pixels));
		put_text(text, 4, out);
	}
}

static void put_group(const struct output_run *run, const struct group *group, FILE *out)
{
	put_heading(run, group, out);
	if (output_is_compared(group->worst)) {
		put_gates(group->worst, SCORE_FAILED, out);
		put_gates(group->worst, SCORE_WARNED, out);
		put_blame(group->worst, out);
	}
	fputc('\n', out);
}

static void put_warnings(const struct output_run *run, FILE *out)
{
	for (size_t i = 0; i < run->n_scores; i++) {
		const struct score *s = &run->scores[i];

		if (s->outcome == SCORE_FRAME_PASSED && output_has_warning(s))
			put_group(run, &(struct group){ s->frame, s->frame, s, 0 }, out);
	}
}

/* --- What to do -------------------------------------------------------------------------------------------------- */

/* List the frames that a person may approve, "3-5,9", up to some number of ranges. @return 0: there are none */
static int list_approvable(const struct output_run *run, char *out, size_t size)
{
	size_t n = 0;

	out[0] = '\0';
	for (size_t i = 0; i < run->n_scores; i++) {
		size_t last = i;

		if (run->scores[i].outcome != SCORE_FRAME_NEW && run->scores[i].gates[GATE_B].state != SCORE_FAILED)
			continue;
		while (last + 1 < run->n_scores && run->scores[last + 1].frame == run->scores[last].frame + 1 &&
		       (run->scores[last + 1].outcome == SCORE_FRAME_NEW ||
		        run->scores[last + 1].gates[GATE_B].state == SCORE_FAILED))
			last++;
		if (n + 48 > size)
			return snprintf(out, size, "FRAMES") > 0;
		n += (size_t)snprintf(out + n, size - n, "%s%" PRIu64, n ? "," : "", run->scores[i].frame);
		if (last > i)
			n += (size_t)snprintf(out + n, size - n, "-%" PRIu64, run->scores[last].frame);
		i = last;
	}
	return n > 0;
}

static void put_advice(const struct output_run *run, const char *report, FILE *out)
{
	const uint64_t n_failed = run->counts[SCORE_FRAME_FAILED] + run->counts[SCORE_FRAME_FLAKY];
	char text[MOST_TEXT + 4096], list[MOST_TEXT];

	if (report)
		snprintf(text, sizeof(text), "Look at them: %s/index.html", report);
	else
		snprintf(text, sizeof(text),
		         "Look at them: once more with --report DIR, then open DIR/index.html. All figures: --table.");
	if (n_failed || run->counts[SCORE_FRAME_NEW])
		put_text(text, 0, out);
	if (run->baseline && list_approvable(run, list, sizeof(list))) {
		snprintf(text, sizeof(text), "If they are right: relume approve -f %s %s %s", list, run->traced, run->baseline);
		put_text(text, 0, out);
	}
	if (run->counts[SCORE_FRAME_EXTRA])
		put_text("A frame without a reference is checked by nobody: add one to REF, or name the frames to "
		         "compare by -f.",
		         0, out);
}

int summary_write(const struct output_run *run, const char *report, FILE *out)
{
	struct group groups[MOST_GROUPS];
	uint64_t left;
	const size_t n = groups_make(run, groups, MOST_GROUPS, &left);

	for (size_t i = 0; i < n; i++)
		put_group(run, &groups[i], out);
	if (left)
		fprintf(out, "and %" PRIu64 " more frame%s (--table shows all)\n\n", left, plural(left));
	put_warnings(run, out);
	if (n)
		put_advice(run, report, out);
	return summary_close(run, out);
}
