/* Text of figures, names and blame for all reports; JSON; workflow commands. */
#include "diff/report/output.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/part.h"
#include "diff/score/gates.h"

void output_gate_text(const struct score *s, enum score_gate_id id, char *out, size_t size)
{
	const struct score_gate_info *info = &score_gates[id];
	const struct score_gate *gate = &s->gates[id];
	size_t used = 0;

	out[0] = '\0';
	for (int f = 0; gate->state != SCORE_NOT_MEASURED && f < info->n_figures && used < size; f++) {
		/* omit a figure that passes if the note gives another reason */
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

const char *output_file(const struct set *set, uint64_t frame)
{
	const struct set_entry *entry = set ? set_find(set, frame) : NULL;

	return entry ? entry->path ? entry->path : set->name : NULL;
}

/* Name of a picture that was matched by name; NULL: it has a number. */
static const char *name_of(const struct output_run *run, uint64_t frame)
{
	const struct set_entry *entry = run->set ? set_find(run->set, frame) : NULL;

	if (!entry && run->ref)
		entry = set_find(run->ref, frame);
	return entry ? entry->name : NULL;
}

int output_is_named(const struct output_run *run, uint64_t frame)
{
	return name_of(run, frame) != NULL;
}

void output_name(const struct output_run *run, uint64_t frame, char *out, size_t size)
{
	if (name_of(run, frame))
		snprintf(out, size, "%s", name_of(run, frame));
	else
		snprintf(out, size, "frame %" PRIu64, frame);
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

int output_has_warning(const struct score *s)
{
	for (int g = 0; g < N_GATES; g++)
		if (s->gates[g].state == SCORE_WARNED)
			return 1;
	return 0;
}

const struct score *output_first_wrong(const struct output_run *run)
{
	for (size_t i = 0; i < run->n_scores; i++)
		if (run->scores[i].outcome == SCORE_FRAME_FAILED || run->scores[i].outcome == SCORE_FRAME_MISSING)
			return &run->scores[i];
	return NULL;
}

/* --- JSON -------------------------------------------------------------------------------------------------------- */

static void json_string(const char *text, FILE *out)
{
	fputc('"', out);
	for (const unsigned char *p = (const unsigned char *)text; *p; p++) {
		/* "<" is escaped as well, so that the text may be embedded in an HTML script */
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
	size_t at; /* offset in struct score_info */
} infos[] = {
#define INFO(name) { #name, offsetof(struct score_info, name) }
	INFO(gl_psnr_db), INFO(gl_ssim), INFO(gl_rmse), INFO(gl_mrse), INFO(gl_yee), INFO(beauty_flip), INFO(beauty_psnr_db),
	INFO(beauty_ms_ssim), INFO(beauty_ciede_p95),
};

static void json_blame(const struct score_blame *by, FILE *out)
{
	fprintf(out, "{\"draw\": %u, \"pixels\": %" PRIu64 ", \"approved\": %s, \"box\": [%u, %u, %u, %u]", by->draw,
	        by->pixels, by->is_approved ? "true" : "false", by->x0, by->y0, by->x1, by->y1);
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

static void json_score(const struct output_run *run, const struct score *s, FILE *out)
{
	fprintf(out, "    {\"frame\": %" PRIu64 ", \"outcome\": \"%s\", \"width\": %u, \"height\": %u, ", s->frame,
	        score_outcome_names[s->outcome], s->width, s->height);
	if (output_is_named(run, s->frame)) {
		fputs("\"name\": ", out);
		json_string(name_of(run, s->frame), out);
		fputs(", ", out);
	}
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
	if (output_first_wrong(run))
		fprintf(out, " \"first_wrong_frame\": %" PRIu64 ",", output_first_wrong(run)->frame);
	fputs("\n \"counts\": {", out);
	for (int o = 0; o < N_SCORE_OUTCOMES; o++)
		fprintf(out, "%s\"%s\": %" PRIu64, o ? ", " : "", score_outcome_names[o], run->counts[o]);
	fputs("},\n \"frames\": [", out);
	for (size_t i = 0; i < run->n_scores; i++) {
		fputs(i ? ",\n" : "\n", out);
		json_score(run, &run->scores[i], out);
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

/* --- Annotations ------------------------------------------------------------------------------------------------- */

/** Write text as the value of a workflow command: %, CR and LF are escaped. */
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

/** Write text as a property's value: separators of properties are escaped as well. */
static void annotation_property(const char *text, FILE *out)
{
	for (; *text; text++)
		if (*text == ':' || *text == ',')
			fprintf(out, "%%%02X", *text);
		else
			annotation_text((const char[]){ *text, 0 }, out);
}

void output_annotations(const struct output_run *run, FILE *out)
{
	for (size_t i = 0; i < run->n_scores; i++) {
		const struct score *s = &run->scores[i];
		const char *kind = s->outcome == SCORE_FRAME_FLAKY || s->outcome == SCORE_FRAME_PASSED ? "warning" : "error";
		char text[512];

		if (s->outcome == SCORE_FRAME_PASSED && !output_has_warning(s))
			continue;
		output_name(run, s->frame, text, sizeof(text));
		fprintf(out, "::%s title=relume diff%%3A ", kind);
		annotation_property(text, out);
		fprintf(out, " %s::", s->outcome == SCORE_FRAME_PASSED ? "warns" : score_outcome_names[s->outcome]);
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
