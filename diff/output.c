#include "diff/output.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/err.h"

int output_open(struct output_file *file, const char *path)
{
	*file = (struct output_file){ .path = strdup(path) };
	if (!file->path || asprintf(&file->temporary, "%s.%ld.tmp", path, (long)getpid()) < 0) {
		file->temporary = NULL;
		err_report(ERR_SYSTEM, path, "out of memory");
		goto fail;
	}
	file->stream = fopen(file->temporary, "wb");
	if (!file->stream) {
		err_report(ERR_SYSTEM, path, "%s", strerror(errno));
		goto fail;
	}
	return 0;
fail:
	free(file->path);
	free(file->temporary);
	*file = (struct output_file){ 0 };
	return ERR_SYSTEM;
}

int output_close(struct output_file *file, int keep)
{
	int err = 0;

	if (!file->stream)
		return 0;
	if ((ferror(file->stream) | fclose(file->stream)) && keep)
		err = err_report(ERR_SYSTEM, file->path, "cannot be written whole: %s", strerror(errno));
	else if (keep && rename(file->temporary, file->path) != 0)
		err = err_report(ERR_SYSTEM, file->path, "%s", strerror(errno));
	if (!keep || err)
		unlink(file->temporary);
	free(file->path);
	free(file->temporary);
	*file = (struct output_file){ 0 };
	return err;
}

void output_order(const struct output_run *run, size_t *out)
{
	size_t n = 0;

	for (int passed = 0; passed < 2; passed++)
		for (size_t i = 0; i < run->n_scores; i++)
			if ((run->scores[i].outcome == SCORE_FRAME_PASSED) == passed)
				out[n++] = i;
}

void output_gate_text(const struct score_gate *gate, const struct score_gate_info *info, char *out, size_t size)
{
	size_t used = 0;

	out[0] = '\0';
	for (int f = 0; gate->state != SCORE_NOT_MEASURED && f < info->n_figures && used < size; f++) {
		const char *unit = info->figures[f].unit, *space = unit[0] ? " " : "";
		int n = snprintf(out + used, size - used, "%s%s %.6g%s%s (bar %s %.6g%s%s)", f ? ", " : "",
		                 info->figures[f].name, gate->value[f], space, unit,
		                 info->figures[f].at_least ? ">=" : "<=", gate->bar[f], space, unit);

		used += n > 0 ? (size_t)n : 0;
	}
	if (used < size && gate->note[0])
		snprintf(out + used, size - used, "%s%s", used ? "; " : "", gate->note);
}

static void print_failure(const struct score *s, FILE *out)
{
	char text[512];

	for (int g = 0; g < N_GATES; g++) {
		if (s->gates[g].state != SCORE_FAILED)
			continue;
		output_gate_text(&s->gates[g], &score_gates[g], text, sizeof(text));
		fprintf(out, "          %-3s %s: %s\n", score_gates[g].name, score_gates[g].title, text);
	}
	for (uint32_t b = 0; b < s->n_blame && b < 3; b++) {
		double share = 100 * (double)s->blame[b].pixels / (double)s->failing_pixels;

		if (!s->blame[b].draw)
			fputs("          the background", out);
		else if (s->blame[b].call)
			fprintf(out, "          draw %u, %s (call %" PRIu64 "),", s->blame[b].draw, s->blame[b].call,
			        s->blame[b].call_number);
		else
			fprintf(out, "          draw %u", s->blame[b].draw);
		fprintf(out, " holds %.3g %% of %" PRIu64 " failing pixels\n", share, s->failing_pixels);
	}
}

/** Value of a gate's figure in a column, "-" where it was not measured, "!" behind it where it failed. */
static void print_figure(const struct score *s, enum score_gate_id g, int figure, FILE *out)
{
	char text[32] = "- ";

	if (s->gates[g].state != SCORE_NOT_MEASURED)
		snprintf(text, sizeof(text), "%.4g%c", s->gates[g].value[figure],
		         s->gates[g].state == SCORE_FAILED ? '!' : ' ');
	fprintf(out, " %9s", text);
}

void output_table(const struct output_run *run, FILE *out)
{
	size_t *order = malloc((run->n_scores ? run->n_scores : 1) * sizeof(*order));

	if (!order) {
		err_report(ERR_SYSTEM, NULL, "out of memory");
		return;
	}
	output_order(run, order);
	fprintf(out, "%7s %-10s %9s %9s %9s %9s %9s %9s %9s %9s %9s %9s\n", "frame", "outcome", "fidelity", "R1 %", "R2 %",
	        "R3 px", "R4 IoU", "R5 px", "E1 px", "E2 px", "P FLIP", "beauty");
	for (size_t i = 0; i < run->n_scores; i++) {
		const struct score *s = &run->scores[order[i]];

		fprintf(out, "%7" PRIu64 " %-10s", s->frame, score_outcome_names[s->outcome]);
		if (s->outcome == SCORE_FRAME_PASSED || s->outcome == SCORE_FRAME_FAILED) {
			fprintf(out, " %8.3f%%", 100 * s->fidelity);
			print_figure(s, GATE_R1, 0, out);
			print_figure(s, GATE_R2, 0, out);
			print_figure(s, GATE_R3, 0, out);
			print_figure(s, GATE_R4, 0, out);
			print_figure(s, GATE_R5, 0, out);
			print_figure(s, GATE_E1, 0, out);
			print_figure(s, GATE_E2, 0, out);
			print_figure(s, GATE_P, 0, out);
			if (isnan(s->info.beauty_flip))
				fprintf(out, " %9s", "- ");
			else
				fprintf(out, " %8.4g ", s->info.beauty_flip);
		}
		fputc('\n', out);
		if (s->outcome == SCORE_FRAME_FAILED)
			print_failure(s, out);
	}
	free(order);

	/* How it was measured: notes of the first frame that was compared, where gates were not measured or by other means. */
	for (size_t i = 0; i < run->n_scores; i++) {
		const struct score *s = &run->scores[i];

		if (s->outcome != SCORE_FRAME_PASSED && s->outcome != SCORE_FRAME_FAILED)
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
	output_summary(run, out);
}

void output_summary(const struct output_run *run, FILE *out)
{
	const struct score *worst = NULL;

	fprintf(out, "%zu frame%s:", run->n_scores, run->n_scores == 1 ? "" : "s");
	for (int o = 0, n = 0; o < N_SCORE_OUTCOMES; o++)
		if (run->counts[o] || o == SCORE_FRAME_PASSED)
			fprintf(out, "%s %" PRIu64 " %s", n++ ? "," : "", run->counts[o], score_outcome_names[o]);
	for (size_t i = 0; i < run->n_scores; i++) {
		const struct score *s = &run->scores[i];

		if (s->outcome <= SCORE_FRAME_FAILED && (!worst || s->fidelity < worst->fidelity))
			worst = s;
	}
	if (worst)
		fprintf(out, "; lowest fidelity %.3f %% (frame %" PRIu64 ")", 100 * worst->fidelity, worst->frame);
	fputc('\n', out);
}

/* JSON. */

void output_json_string(const char *text, FILE *out)
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
	static const char *const states[] = { "not measured", "passed", "failed" };

	fprintf(out, "\"%s\": {\"title\": \"%s\", \"state\": \"%s\", \"figures\": [", info->name, info->title,
	        states[gate->state]);
	for (int f = 0; gate->state != SCORE_NOT_MEASURED && f < info->n_figures; f++) {
		fprintf(out, "%s{\"name\": \"%s\", \"unit\": \"%s\", ", f ? ", " : "", info->figures[f].name,
		        info->figures[f].unit);
		json_number("value", gate->value[f], out);
		fputs(", ", out);
		json_number("bar", gate->bar[f], out);
		fprintf(out, ", \"bound\": \"%s\"}", info->figures[f].at_least ? "at least" : "at most");
	}
	fputs("], \"note\": ", out);
	output_json_string(gate->note, out);
	fputc('}', out);
}

static void json_score(const struct score *s, FILE *out)
{
	fprintf(out, "    {\"frame\": %" PRIu64 ", \"outcome\": \"%s\", \"width\": %u, \"height\": %u, ", s->frame,
	        score_outcome_names[s->outcome], s->width, s->height);
	fputs("\"layer\": ", out);
	output_json_string(s->layer, out);
	fputs(", ", out);
	json_number("fidelity", s->fidelity, out);
	fprintf(out, ", \"failing_pixels\": %" PRIu64 ", \"worst_code\": %u,\n     \"gates\": {", s->failing_pixels, s->worst);
	for (int g = 0; g < N_GATES; g++) {
		fputs(g ? ",\n       " : "", out);
		json_gate(&s->gates[g], &score_gates[g], out);
	}
	fputs("},\n     \"info\": {", out);
	json_number("gl_psnr_db", s->info.gl_psnr_db, out);
	fputs(", ", out);
	json_number("gl_ssim", s->info.gl_ssim, out);
	fputs(", ", out);
	json_number("beauty_flip", s->info.beauty_flip, out);
	fputs(", ", out);
	json_number("beauty_psnr_db", s->info.beauty_psnr_db, out);
	fputs(", ", out);
	json_number("beauty_ms_ssim", s->info.beauty_ms_ssim, out);
	fputs(", ", out);
	json_number("beauty_ciede_p95", s->info.beauty_ciede_p95, out);
	fputs(", \"effect_share\": {", out);
	for (int e = 0; e < N_SCORE_EFFECTS; e++) {
		fputs(e ? ", " : "", out);
		json_number(score_effect_names[e], s->info.effect_share[e], out);
	}
	fputs("}},\n     \"blame\": [", out);
	for (uint32_t b = 0; b < s->n_blame; b++) {
		fprintf(out, "%s{\"draw\": %u, \"pixels\": %" PRIu64, b ? ", " : "", s->blame[b].draw, s->blame[b].pixels);
		if (s->blame[b].call)
			fprintf(out, ", \"call\": \"%s\", \"call_number\": %" PRIu64, s->blame[b].call, s->blame[b].call_number);
		fputc('}', out);
	}
	fputs("]}", out);
}

void output_json_stream(const struct output_run *run, FILE *out)
{
	fputs("{\"format\": \"relume-diff\", \"version\": 1,\n \"reference\": ", out);
	output_json_string(run->reference, out);
	fputs(", \"traced\": ", out);
	output_json_string(run->traced, out);
	fputs(",\n \"channel\": ", out);
	output_json_string(run->channel ? run->channel : "", out);
	fprintf(out, ", \"seconds\": %.3f,\n \"counts\": {", run->seconds);
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
	struct output_file file;

	if (strcmp(path, "-") == 0) {
		output_json_stream(run, stdout);
		return fflush(stdout) == 0 ? 0 : err_report(ERR_SYSTEM, "standard output", "%s", strerror(errno));
	}
	if (output_open(&file, path) != 0)
		return ERR_SYSTEM;
	output_json_stream(run, file.stream);
	return output_close(&file, 1);
}

/* JUnit. */

void output_escaped(const char *text, FILE *out)
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
	case SCORE_FRAME_UNREADABLE:
		fputs(">\n      <error message=\"unreadable\"/>\n    </testcase>\n", out);
		return;
	default:
		fprintf(out, ">\n      <failure message=\"%s\"/>\n    </testcase>\n",
		        s->outcome == SCORE_FRAME_MISSING ? "there is no traced frame" : "there is no reference");
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
		output_gate_text(&s->gates[g], &score_gates[g], text, sizeof(text));
		fprintf(out, "%s ", score_gates[g].name);
		output_escaped(text, out);
		fputc('\n', out);
	}
	fputs("</failure>\n    </testcase>\n", out);
}

int output_junit(const struct output_run *run, const char *path)
{
	uint64_t errors = run->counts[SCORE_FRAME_UNREADABLE];
	uint64_t failures = run->n_scores - run->counts[SCORE_FRAME_PASSED] - errors;
	struct output_file file;

	if (output_open(&file, path) != 0)
		return ERR_SYSTEM;
	fprintf(file.stream, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n  <testsuite name=\"relume diff ");
	output_escaped(run->traced, file.stream);
	fprintf(file.stream, "\" tests=\"%zu\" failures=\"%" PRIu64 "\" errors=\"%" PRIu64 "\" skipped=\"0\" time=\"%.3f\">\n",
	        run->n_scores, failures, errors, run->seconds);
	for (size_t i = 0; i < run->n_scores; i++)
		junit_case(&run->scores[i], file.stream);
	fputs("  </testsuite>\n</testsuites>\n", file.stream);
	return output_close(&file, 1);
}
