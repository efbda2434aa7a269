#include "diff/report/markdown.h"

#include <errno.h>
#include <inttypes.h>
#include <string.h>

#include "base/err.h"
#include "diff/score/gates.h"

enum { MOST_FRAMES = 20, MOST_TEXT = 512 };

/* Text in a cell of a table. */
static void put(const char *text, FILE *out)
{
	for (; *text; text++) {
		if (strchr("|<>&\\`*_[]", *text))
			fputc('\\', out);
		fputc(*text == '\n' ? ' ' : *text, out);
	}
}

static void put_frame(const struct score *s, FILE *out)
{
	char text[MOST_TEXT];
	const char *between = "";

	fprintf(out, "| %" PRIu64 " | %s | ", s->frame, score_outcome_names[s->outcome]);
	for (int g = 0; g < N_GATES && output_is_compared(s); g++) {
		if (s->gates[g].state != SCORE_FAILED)
			continue;
		output_gate_text(s, (enum score_gate_id)g, text, sizeof(text));
		fprintf(out, "%s**%s** ", between, score_gates[g].name);
		put(text, out);
		between = "<br>";
	}
	fputs(" | ", out);
	if (s->n_blame) {
		output_blame_text(&s->blame[0], text, sizeof(text));
		put(text, out);
	}
	fputs(" |\n", out);
}

static void put_run(const struct output_run *run, const char *report, FILE *out)
{
	size_t n = 0, left = 0;

	fputs("### relume diff: ", out);
	put(run->name, out);
	fputs("\n\n", out);
	for (int o = 0; o < N_SCORE_OUTCOMES; o++)
		if (run->counts[o] || o == SCORE_FRAME_PASSED)
			fprintf(out, "%s%" PRIu64 " %s", n++ ? ", " : "", run->counts[o], score_outcome_names[o]);
	fprintf(out, " of %zu frame%s", run->n_scores, run->n_scores == 1 ? "" : "s");
	if (report)
		fprintf(out, "; [page](%s/index.html)", report);
	fputs("\n", out);
	n = 0;
	for (size_t i = 0; i < run->n_scores; i++) {
		if (run->scores[i].outcome == SCORE_FRAME_PASSED)
			continue;
		if (n == 0)
			fputs("\n| frame | outcome | what failed | blamed |\n|---|---|---|---|\n", out);
		if (n++ < MOST_FRAMES)
			put_frame(&run->scores[i], out);
		else
			left++;
	}
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
