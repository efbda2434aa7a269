#include "diff/report/output.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/part.h"
#include "base/plural.h"
#include "diff/score/gates.h"

/* Indices of scores: frames that did not pass come first; each part is in the order of frames. out has n_scores elements. */
static void order_scores(const struct output_run *run, size_t *out)
{
	size_t n = 0;

	for (int passed = 0; passed < 2; passed++)
		for (size_t i = 0; i < run->n_scores; i++)
			if ((run->scores[i].outcome == SCORE_FRAME_PASSED) == passed) /* what did not pass is of interest */
				out[n++] = i;
}

void output_gate_text(const struct score *s, enum score_gate_id id, char *out, size_t size)
{
	const struct score_gate_info *info = &score_gates[id];
	const struct score_gate *gate = &s->gates[id];
	size_t used = 0;

	out[0] = '\0';
	for (int f = 0; gate->state != SCORE_NOT_MEASURED && f < info->n_figures && used < size; f++) {
		/* a figure that holds is left out where the note says what else is wrong */
		if (gate->state == SCORE_FAILED && gate->note[0] && gate->value[f] == gate->bar[f])
			continue;
		const char *unit = info->figures[f].unit, *space = unit[0] ? " " : "";
		int n = snprintf(out + used, size - used, "%s%s %.6g%s%s (bar %s %.6g%s%s)", f ? ", " : "",
		                 info->figures[f].name, gate->value[f], space, unit,
		                 info->figures[f].at_least ? ">=" : "<=", gate->bar[f], space, unit);

		used += n > 0 ? (size_t)n : 0;
	}
	if (used < size && gate->note[0])
		snprintf(out + used, size - used, "%s%s", used ? "; " : "", gate->note);
}

void output_blame_text(const struct score_blame *b, char *out, size_t size)
{
	size_t n = (size_t)snprintf(out, size, b->draw ? "draw %u" : "the background", b->draw);

	if (b->draw && b->name.call && n < size)
		n += (size_t)snprintf(out + n, size - n, ", %s (call %" PRIu64 ")", b->name.call, b->name.call_number);
	if (b->draw && b->name.list && n < size)
		n += (size_t)snprintf(out + n, size - n, ", list %u", b->name.list);
	if (b->draw && b->name.has_program && n < size)
		n += (size_t)snprintf(out + n, size - n, " with a program object");
	if (b->draw && b->name.texture && n < size)
		n += (size_t)snprintf(out + n, size - n, ", texture %016" PRIx64, b->name.texture);
	if (b->is_approved && n < size)
		n += (size_t)snprintf(out + n, size - n, ", in the approved frame,");
	if (b->draw && b->name.known && n < size)
		snprintf(out + n, size - n, " (known: %s)", b->name.known);
}

int output_is_compared(const struct score *s)
{
	return s->outcome == SCORE_FRAME_PASSED || s->outcome == SCORE_FRAME_FAILED || s->outcome == SCORE_FRAME_FLAKY ||
		s->outcome == SCORE_FRAME_NEW;
}

static int has_warning(const struct score *s)
{
	for (int g = 0; g < N_GATES; g++)
		if (s->gates[g].state == SCORE_WARNED)
			return 1;
	return 0;
}

/* The first frame, by number, that failed or is missing; NULL where none did. */
static const struct score *first_wrong(const struct output_run *run)
{
	for (size_t i = 0; i < run->n_scores; i++)
		if (run->scores[i].outcome == SCORE_FRAME_FAILED || run->scores[i].outcome == SCORE_FRAME_MISSING)
			return &run->scores[i];
	return NULL;
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
		fprintf(out, "          %s holds %.3g %% of %" PRIu64 " failing pixel%s\n", text, share, s->blamed_pixels, plural(s->blamed_pixels));
	}
}

/** The figures that have a column: values, "-" where they were not measured, "!" behind them where the gate failed; or headings. */
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

static int compare_names(const void *a, const void *b)
{
	return strverscmp(((const struct score_program *)a)->name, ((const struct score_program *)b)->name);
}

/* A line for each of the application's own programs: pixels of all frames. @return 0 or ERR_SYSTEM (reported) */
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
		fprintf(out, "%s: %.3f %% of %" PRIu64 " px\n", sum.name, 100 * (1 - (double)sum.failing / (double)sum.pixels), sum.pixels);
	}
	free(all);
	return 0;
}

/* One line: counts by outcome and the worst frame. */
static void print_summary(const struct output_run *run, FILE *out)
{
	const struct score *worst = NULL;

	fprintf(out, "%zu frame%s:", run->n_scores, plural(run->n_scores));
	for (int o = 0, n = 0; o < N_SCORE_OUTCOMES; o++)
		if (run->counts[o] || o == SCORE_FRAME_PASSED)
			fprintf(out, "%s %" PRIu64 " %s", n++ ? "," : "", run->counts[o], score_outcome_names[o]);
	for (size_t i = 0; i < run->n_scores; i++) {
		const struct score *s = &run->scores[i];

		if (output_is_compared(s) && (!worst || s->fidelity < worst->fidelity))
			worst = s;
	}
	if (worst && run->reference)
		fprintf(out, "; lowest fidelity %.3f %% (frame %" PRIu64 ")", 100 * worst->fidelity, worst->frame);
	if (first_wrong(run))
		fprintf(out, "; first wrong frame %" PRIu64, first_wrong(run)->frame);
	fputc('\n', out);
	if (run->n_unmatched)
		fprintf(out, "not compared: %" PRIu64 " frame%s that the reference or the baseline has, and TRACED has not; --all "
		        "demands %s\n", run->n_unmatched, plural(run->n_unmatched), run->n_unmatched == 1 ? "it" : "them");
}

/* What the table says of a frame, but for its number. */
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
	fputc('\n', out);
	if (s->outcome == SCORE_FRAME_FAILED || s->outcome == SCORE_FRAME_FLAKY || has_warning(s))
		print_failure(s, out);
}

/* Frames in a row that failed alike. */
struct rows {
	uint64_t first, last;
	char *text; /* NULL: none */
};

static void end_rows(struct rows *rows, FILE *out)
{
	char range[48];

	if (!rows->text)
		return;
	snprintf(range, sizeof(range), rows->last > rows->first ? "%" PRIu64 "-%" PRIu64 : "%" PRIu64, rows->first, rows->last);
	fprintf(out, "%7s%s", range, rows->text);
	free(rows->text);
	rows->text = NULL;
}

/* One row for frames that follow each other and fail with the same figures. Each frame that passed has its own. */
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

int output_table(const struct output_run *run, FILE *out)
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

	/* How it was measured: notes of the first frame that was compared, where gates were not measured or by other means. */
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
	if (!err)
		err = print_programs(run, out);
	print_summary(run, out);
	return err;
}

/* JSON. */

static void json_string(const char *text, FILE *out)
{
	fputc('"', out);
	for (const unsigned char *p = (const unsigned char *)text; *p; p++) {
		/* "<" is written as an escape too, so that the text may stand inside an HTML script */
		if (*p == '"' || *p == '\\')
			fprintf(out, "\\%c", *p);
		else if (*p < 0x20 || *p == '<')
			fprintf(out, "\\u%04x", *p);
		else
			fputc(*p, out);
	}
	fputc('"', out);
}

static void json_number(const char *name, double value, FILE *out)
{
	if (isfinite(value))
		fprintf(out, "\"%s\": %.9g", name, value);
	else
		fprintf(out, "\"%s\": null", name);
}

static void json_gate(const struct score_gate *gate, const struct score_gate_info *info, FILE *out)
{
	fprintf(out, "\"%s\": {\"title\": \"%s\", \"state\": \"%s\", \"figures\": [", info->name, info->title,
	        score_state_names[gate->state]);
	for (int f = 0; gate->state != SCORE_NOT_MEASURED && f < info->n_figures; f++) {
		fprintf(out, "%s{\"name\": \"%s\", \"unit\": \"%s\", ", f ? ", " : "", info->figures[f].name,
		        info->figures[f].unit);
		json_number("value", gate->value[f], out);
		fputs(", ", out);
		json_number("bar", gate->bar[f], out);
		fprintf(out, ", \"bound\": \"%s\"}", info->figures[f].at_least ? "at least" : "at most");
	}
	fputs("], \"note\": ", out);
	json_string(gate->note, out);
	fputc('}', out);
}

static const struct {
	const char *name;
	size_t at; /* in struct score_info */
} infos[] = {
#define INFO(name) { #name, offsetof(struct score_info, name) }
	INFO(gl_psnr_db), INFO(gl_ssim), INFO(gl_rmse), INFO(gl_mrse), INFO(gl_yee), INFO(beauty_flip), INFO(beauty_psnr_db),
	INFO(beauty_ms_ssim), INFO(beauty_ciede_p95),
};

static void json_blame(const struct score_blame *by, FILE *out)
{
	fprintf(out, "{\"draw\": %u, \"pixels\": %" PRIu64 ", \"approved\": %s, \"box\": [%u, %u, %u, %u]", by->draw, by->pixels,
	        by->is_approved ? "true" : "false", by->x0, by->y0, by->x1, by->y1);
	if (by->name.call)
		fprintf(out, ", \"call\": \"%s\", \"call_number\": %" PRIu64 ", \"program\": %s", by->name.call, by->name.call_number,
		        by->name.has_program ? "true" : "false");
	if (by->name.call && by->name.list)
		fprintf(out, ", \"list\": %u", by->name.list);
	if (by->name.call && by->name.texture)
		fprintf(out, ", \"texture\": \"%016" PRIx64 "\"", by->name.texture);
	if (by->name.call && by->name.known)
		fprintf(out, ", \"known\": \"%s\"", by->name.known);
	fputc('}', out);
}

static void json_score(const struct score *s, FILE *out)
{
	fprintf(out, "    {\"frame\": %" PRIu64 ", \"outcome\": \"%s\", \"width\": %u, \"height\": %u, ", s->frame,
	        score_outcome_names[s->outcome], s->width, s->height);
	fputs("\"layer\": ", out);
	json_string(s->layer, out);
	fputs(", ", out);
	json_number("fidelity", s->fidelity, out);
	fprintf(out, ", \"failing_pixels\": %" PRIu64 ", \"worst_code\": %u,\n     \"gates\": {", s->failing_pixels, s->worst);
	for (int g = 0; g < N_GATES; g++) {
		fputs(g ? ",\n       " : "", out);
		json_gate(&s->gates[g], &score_gates[g], out);
	}
	fputs("},\n     \"info\": {", out);
	for (size_t i = 0; i < sizeof(infos) / sizeof(infos[0]); i++) {
		fputs(i ? ", " : "", out);
		json_number(infos[i].name, *(const double *)((const char *)&s->info + infos[i].at), out);
	}
	fputs(", \"effect_share\": {", out);
	for (int e = 0; e < N_SCORE_EFFECTS; e++) {
		fputs(e ? ", " : "", out);
		json_number(score_effect_names[e], s->info.effect_share[e], out);
	}
	fprintf(out, "}},\n     \"blamed_pixels\": %" PRIu64 ", ", s->blamed_pixels);
	if (s->flaky_reason) {
		fputs("\"flaky_reason\": ", out);
		json_string(s->flaky_reason, out);
		fputs(", ", out);
	}
	fputs("\"blame\": [", out);
	for (uint32_t b = 0; b < s->n_blame; b++) {
		fputs(b ? ", " : "", out);
		json_blame(&s->blame[b], out);
	}
	if (s->n_programs)
		fputs("], \"programs\": [", out);
	for (uint32_t i = 0; i < s->n_programs; i++) {
		fputs(i ? ", {\"name\": " : "{\"name\": ", out);
		json_string(s->programs[i].name, out);
		fprintf(out, ", \"pixels\": %" PRIu64 ", \"failing\": %" PRIu64 "}", s->programs[i].pixels, s->programs[i].failing);
	}
	fputs("]}", out);
}

void output_json_stream(const struct output_run *run, FILE *out)
{
	fputs("{\"format\": \"relume-diff\", \"version\": 1,\n \"reference\": ", out);
	json_string(run->reference ? run->reference : "", out);
	fputs(", \"traced\": ", out);
	json_string(run->traced, out);
	fputs(", \"baseline\": ", out);
	json_string(run->baseline ? run->baseline : "", out);
	fputs(",\n \"name\": ", out);
	json_string(run->name, out);
	fputs(", \"command\": ", out);
	json_string(run->command, out);
	fputs(", \"channel\": ", out);
	json_string(run->options->channel ? run->options->channel : "", out);
	fprintf(out, ", \"seconds\": %.3f,", run->seconds);
	if (first_wrong(run))
		fprintf(out, " \"first_wrong_frame\": %" PRIu64 ",", first_wrong(run)->frame);
	fputs("\n \"counts\": {", out);
	for (int o = 0; o < N_SCORE_OUTCOMES; o++)
		fprintf(out, "%s\"%s\": %" PRIu64, o ? ", " : "", score_outcome_names[o], run->counts[o]);
	fputs("},\n \"frames\": [", out);
	for (size_t i = 0; i < run->n_scores; i++) {
		fputs(i ? ",\n" : "\n", out);
		json_score(&run->scores[i], out);
	}
	fputs("\n ]}\n", out);
}

int output_json(const struct output_run *run, const char *path)
{
	struct part_file file;

	if (strcmp(path, "-") == 0) {
		output_json_stream(run, stdout);
		return fflush(stdout) == 0 ? 0 : err_report(ERR_SYSTEM, "standard output", "%s", strerror(errno));
	}
	if (part_open(&file, path) != 0)
		return ERR_SYSTEM;
	output_json_stream(run, file.stream);
	return part_close(&file, 0);
}

/* JUnit. */

static void put_escaped(const char *text, FILE *out)
{
	for (const unsigned char *p = (const unsigned char *)text; *p; p++) {
		switch (*p) {
		case '&': fputs("&amp;", out); break;
		case '<': fputs("&lt;", out); break;
		case '>': fputs("&gt;", out); break;
		case '"': fputs("&quot;", out); break;
		default: fputc(*p < 0x20 ? ' ' : *p, out); /* other control characters are no XML at all */
		}
	}
}

static void junit_case(const struct score *s, FILE *out)
{
	fprintf(out, "    <testcase classname=\"relume.diff\" name=\"frame %" PRIu64 "\"", s->frame);
	switch (s->outcome) {
	case SCORE_FRAME_PASSED:
		fputs("/>\n", out);
		return;
	case SCORE_FRAME_FAILED:
		break;
	case SCORE_FRAME_FLAKY:
		fputs(">\n      <skipped message=\"", out);
		put_escaped(s->flaky_reason, out);
		fputs("\"/>\n    </testcase>\n", out);
		return;
	case SCORE_FRAME_UNREADABLE:
		fputs(">\n      <error message=\"unreadable\"/>\n    </testcase>\n", out);
		return;
	default:
		fprintf(out, ">\n      <failure message=\"%s\"/>\n    </testcase>\n",
		        s->outcome == SCORE_FRAME_MISSING ? "there is no traced frame"
		        : s->outcome == SCORE_FRAME_NEW ? "there is no approved frame" : "there is no reference");
		return;
	}
	fputs(">\n      <failure message=\"", out);
	for (int g = 0, n = 0; g < N_GATES; g++)
		if (s->gates[g].state == SCORE_FAILED)
			fprintf(out, "%s%s %s", n++ ? ", " : "", score_gates[g].name, score_gates[g].title);
	fputs("\">", out);
	for (int g = 0; g < N_GATES; g++) {
		char text[512];

		if (s->gates[g].state != SCORE_FAILED)
			continue;
		output_gate_text(s, (enum score_gate_id)g, text, sizeof(text));
		fprintf(out, "%s ", score_gates[g].name);
		put_escaped(text, out);
		fputc('\n', out);
	}
	fputs("</failure>\n    </testcase>\n", out);
}

int output_junit(const struct output_run *run, const char *path)
{
	uint64_t errors = run->counts[SCORE_FRAME_UNREADABLE];
	uint64_t skipped = run->counts[SCORE_FRAME_FLAKY];
	uint64_t failures = run->n_scores - run->counts[SCORE_FRAME_PASSED] - errors - skipped;
	struct part_file file;

	if (part_open(&file, path) != 0)
		return ERR_SYSTEM;
	fprintf(file.stream, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n  <testsuite name=\"relume diff ");
	put_escaped(run->traced, file.stream);
	fprintf(file.stream, "\" tests=\"%zu\" failures=\"%" PRIu64 "\" errors=\"%" PRIu64 "\" skipped=\"%" PRIu64
	        "\" time=\"%.3f\">\n", run->n_scores, failures, errors, skipped, run->seconds);
	for (size_t i = 0; i < run->n_scores; i++)
		junit_case(&run->scores[i], file.stream);
	fputs("  </testsuite>\n</testsuites>\n", file.stream);
	return part_close(&file, 0);
}

/* Annotations. */

/** Text as the value of a workflow command: %, CR and LF are escaped. */
static void annotation_text(const char *text, FILE *out)
{
	for (const char *p = text; *p; p++) {
		if (*p == '%')
			fputs("%25", out);
		else if (*p == '\n')
			fputs("%0A", out);
		else if (*p == '\r')
			fputs("%0D", out);
		else
			fputc(*p, out);
	}
}

void output_annotations(const struct output_run *run, FILE *out)
{
	for (size_t i = 0; i < run->n_scores; i++) {
		const struct score *s = &run->scores[i];
		const char *kind = s->outcome == SCORE_FRAME_FLAKY || s->outcome == SCORE_FRAME_PASSED ? "warning" : "error";
		char text[512];

		if (s->outcome == SCORE_FRAME_PASSED && !has_warning(s))
			continue;
		fprintf(out, "::%s title=relume diff%%3A frame %" PRIu64 " %s::", kind, s->frame,
		        s->outcome == SCORE_FRAME_PASSED ? "warns" : score_outcome_names[s->outcome]);
		annotation_text(run->traced, out);
		for (int g = 0; g < N_GATES; g++) {
			if (s->gates[g].state < SCORE_WARNED)
				continue;
			output_gate_text(s, (enum score_gate_id)g, text, sizeof(text));
			fprintf(out, "%%0A%s %s: ", score_gates[g].name, score_gates[g].title);
			annotation_text(text, out);
		}
		if (s->n_blame) {
			output_blame_text(&s->blame[0], text, sizeof(text));
			fputs("%0A", out);
			annotation_text(text, out);
		}
		fputc('\n', out);
	}
}
