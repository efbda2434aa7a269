/* Writes JUnit XML. */
#include "diff/report/junit.h"

#include <inttypes.h>
#include <string.h>

#include "base/err.h"
#include "base/part.h"
#include "diff/report/groups.h"
#include "diff/score/gates.h"

enum { MOST_TEXT = 640 };

static void put_escaped(const char *text, FILE *out)
{
	for (const unsigned char *p = (const unsigned char *)text; *p; p++) {
		switch (*p) {
		case '&': fputs("&amp;", out); break;
		case '<': fputs("&lt;", out); break;
		case '>': fputs("&gt;", out); break;
		case '"': fputs("&quot;", out); break;
		default: fputc(*p < 0x20 ? ' ' : *p, out); /* XML allows no other control characters */
		}
	}
}

static void put_attribute(const char *name, const char *value, FILE *out)
{
	fprintf(out, " %s=\"", name);
	put_escaped(value, out);
	fputc('"', out);
}

/* Write the message for the first gate that failed: "not as approved: pixels off from the approved frame 6.5 % (bar <=
 * 0.01 %)". */
static void put_message(const struct score *s, FILE *out)
{
	char text[MOST_TEXT];

	for (int g = 0, n = 0; g < N_GATES; g++) {
		if (s->gates[g].state != SCORE_FAILED)
			continue;
		if (n++) {
			fprintf(out, "; also %s %s", score_gates[g].name, score_gates[g].title);
			continue;
		}
		output_gate_text(s, (enum score_gate_id)g, text, sizeof(text));
		fprintf(out, "%s: %s %s: ", groups_comparison(g), score_gates[g].name, score_gates[g].title);
		put_escaped(text, out);
	}
}

static void put_files(const struct output_run *run, uint64_t frame, FILE *out)
{
	const char *reference = output_file(run->ref, frame), *file = output_file(run->set, frame);

	fputs("recording: ", out);
	put_escaped(run->name, out);
	fputs("\npicture: ", out);
	put_escaped(file ? file : "none", out);
	if (reference) {
		fputs("\nreference: ", out);
		put_escaped(reference, out);
	}
	if (run->baseline) {
		fputs("\napproved: in ", out);
		put_escaped(run->baseline, out);
	}
	fputc('\n', out);
}

/* Write all gates that failed, and the draw to blame. */
static void put_failure(const struct output_run *run, const struct score *s, FILE *out)
{
	char text[MOST_TEXT];

	fputs("      <failure message=\"", out);
	put_message(s, out);
	fputs("\">", out);
	for (int g = 0; g < N_GATES; g++) {
		if (s->gates[g].state != SCORE_FAILED)
			continue;
		output_gate_text(s, (enum score_gate_id)g, text, sizeof(text));
		fprintf(out, "%s: %s %s: ", groups_comparison(g), score_gates[g].name, score_gates[g].title);
		put_escaped(text, out);
		fputc('\n', out);
	}
	if (s->n_blame) {
		output_blame_text(&s->blame[0], text, sizeof(text));
		fputs("blamed: ", out);
		put_escaped(text, out);
		fputc('\n', out);
	}
	put_files(run, s->frame, out);
	fputs("</failure>\n", out);
}

static void put_case(const struct output_run *run, const struct score *s, FILE *out)
{
	static const char *const reasons[N_SCORE_OUTCOMES] = {
		[SCORE_FRAME_NEW] = "nobody has approved this frame",
		[SCORE_FRAME_MISSING] = "there is no picture to compare",
		[SCORE_FRAME_EXTRA] = "there is no reference for this picture",
		[SCORE_FRAME_UNREADABLE] = "the picture or its reference cannot be read",
	};
	const char *file = output_file(run->set, s->frame);
	const char *element = s->outcome == SCORE_FRAME_UNREADABLE ? "error" : "failure";
	char name[256];

	output_name(run, s->frame, name, sizeof(name));
	fputs("    <testcase", out);
	put_attribute("classname", run->name, out);
	put_attribute("name", name, out);
	if (file)
		put_attribute("file", file, out);
	if (s->outcome == SCORE_FRAME_PASSED) {
		fputs("/>\n", out);
		return;
	}
	fputs(">\n", out);
	if (s->outcome == SCORE_FRAME_FAILED) {
		put_failure(run, s, out);
	} else if (s->outcome == SCORE_FRAME_FLAKY) {
		fputs("      <skipped", out);
		put_attribute("message", s->flaky_reason, out);
		fputs("/>\n", out);
	} else {
		fprintf(out, "      <%s message=\"%s\">", element, reasons[s->outcome]);
		put_files(run, s->frame, out);
		fprintf(out, "</%s>\n", element);
	}
	fputs("    </testcase>\n", out);
}

int junit_write(const struct output_run *run, const char *path)
{
	const uint64_t errors = run->counts[SCORE_FRAME_UNREADABLE], skipped = run->counts[SCORE_FRAME_FLAKY];
	const uint64_t failures = run->n_scores - run->counts[SCORE_FRAME_PASSED] - errors - skipped;
	struct part_file file;

	if (part_open(&file, path) != 0)
		return ERR_SYSTEM;
	fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n  <testsuite", file.stream);
	fputs(" name=\"relume diff ", file.stream);
	put_escaped(run->name, file.stream);
	fprintf(file.stream, "\" tests=\"%zu\" failures=\"%" PRIu64 "\" errors=\"%" PRIu64 "\" skipped=\"%" PRIu64
	        "\" time=\"%.3f\">\n", run->n_scores, failures, errors, skipped, run->seconds);
	fputs("    <properties>\n", file.stream);
	for (int i = 0; i < 4; i++) {
		const char *const properties[][2] = { { "recording", run->name },
			                              { "pictures", run->traced },
			                              { "reference", run->reference },
			                              { "approved", run->baseline } };

		if (!properties[i][1])
			continue;
		fputs("      <property", file.stream);
		put_attribute("name", properties[i][0], file.stream);
		put_attribute("value", properties[i][1], file.stream);
		fputs("/>\n", file.stream);
	}
	fputs("    </properties>\n", file.stream);
	for (size_t i = 0; i < run->n_scores; i++)
		put_case(run, &run->scores[i], file.stream);
	fputs("  </testsuite>\n</testsuites>\n", file.stream);
	return part_close(&file, 0);
}
