#include "verbs/bisect/page.h"

#include <inttypes.h>
#include <limits.h>
#include <string.h>

#include "base/err.h"
#include "base/folder.h"
#include "base/part.h"
#include "base/plural.h"

static const char *const side_names[N_SIDES] = { "good", "bad" };

enum { MOST_LINE = 240 /* bytes of a call's text: a page of numbers says no more than its first ones */ };

/* Print text, escaped for HTML or as it is. */
static void put(const char *text, size_t most, int is_html, FILE *out)
{
	for (size_t i = 0; text[i] && i < most; i++) {
		if (is_html && (text[i] == '<' || text[i] == '>' || text[i] == '&' || text[i] == '"'))
			fprintf(out, "&#%d;", text[i]);
		else
			fputc(text[i], out);
	}
	if (strlen(text) > most)
		fputs(" ...", out);
}

static void put_sight(const struct sight *s, FILE *out)
{
	if (s->is_found)
		fprintf(out,
		        "first picture that differs: frame %zu of good, %zu of bad: %" PRIu64 " of %" PRIu64
		        " pixels, by up to %u of 255\n",
		        s->frame[GOOD], s->frame[BAD], s->differing, s->pixels, s->worst);
	else if (s->left)
		fprintf(out, "pictures: the same in the %zu frame%s that were compared; %zu more were not\n", s->looked,
		        plural(s->looked), s->left);
	else
		fprintf(out, "pictures: the same in all %zu frame%s from there on\n", s->looked, plural(s->looked));
}

/* Lines of the state, each behind a prefix. */
static void put_state(const char *state, FILE *out)
{
	for (const char *line = state; line && *line; line = strchr(line, '\n') + 1) {
		fputs("    state  ", out);
		fprintf(out, "%.*s\n", (int)strcspn(line, "\n"), line);
	}
}

static void put_parting(const struct parting *p, FILE *out)
{
	for (int s = 0; s < N_SIDES; s++) {
		fprintf(out, "    %-5s  ", side_names[s]);
		if (!p->count[s]) {
			fprintf(out, "nothing after call %" PRIu64 " (frame %zu)\n", p->number[s], p->frame[s]);
			continue;
		}
		fprintf(out, "%" PRIu64 " ", p->number[s]);
		put(p->text[s], MOST_LINE, 0, out);
		if (p->count[s] > 1)
			fprintf(out, " and %zu call%s more", p->count[s] - 1, plural(p->count[s] - 1));
		fprintf(out, " (frame %zu)\n", p->frame[s]);
	}
	if (p->argument)
		fprintf(out, "    differs in  %s\n", p->argument);
	put_state(p->state, out);
	if (p->effect)
		fprintf(out, "    changes  %s\n", p->effect);
	else if (!p->state)
		fputs("    changes nothing of the state\n", out);
}

void page_table(const struct findings *f, FILE *out)
{
	const struct partings *p = f->partings;

	for (int s = 0; s < N_SIDES; s++)
		fprintf(out, "%-4s  %s: %zu frame%s, %zu calls that count\n", side_names[s], f->recordings[s]->path,
		        f->recordings[s]->n_ended, plural(f->recordings[s]->n_ended), f->recordings[s]->n);
	if (!p->n) {
		fputs("they are the same\n", out);
		return;
	}
	for (size_t i = 0; i < p->n; i++) {
		fputs(i == 0 ? "they diverge first at\n" : "then at\n", out);
		put_parting(&p->list[i], out);
	}
	if (p->is_cut)
		fputs("and perhaps at more places\n", out);
	if (f->sight)
		put_sight(f->sight, out);
}

static void put_row(const struct parting *p, FILE *out)
{
	fputs("<tr>", out);
	for (int s = 0; s < N_SIDES; s++) {
		fprintf(out, "<td>%zu</td><td>%" PRIu64 "</td><td><code>", p->frame[s], p->number[s]);
		put(p->count[s] ? p->text[s] : "-", MOST_LINE, 1, out);
		if (p->count[s] > 1)
			fprintf(out, "</code> and %zu call%s more<code>", p->count[s] - 1, plural(p->count[s] - 1));
		fputs("</code></td>", out);
	}
	fputs("<td>", out);
	put(p->argument ? p->argument : "", MOST_LINE, 1, out);
	fputs("</td><td><pre>", out);
	put(p->state ? p->state : "", SIZE_MAX, 1, out);
	fprintf(out, "</pre>%s</td></tr>\n", p->effect ? p->effect : "");
}

int page_write(const struct findings *f, const char *folder)
{
	struct part_file file;
	char path[PATH_MAX];
	int err = folder_make(folder);

	if (!err && snprintf(path, sizeof(path), "%s/index.html", folder) >= (int)sizeof(path))
		err = err_report(ERR_USAGE, folder, "the name is too long");
	if (!err)
		err = part_open(&file, path);
	if (err)
		return err;
	fputs("<!doctype html><meta charset=\"utf-8\"><title>relume bisect</title>\n"
	      "<style>body{font:14px sans-serif;margin:1em}table{border-collapse:collapse}td,th{border:1px solid "
	      "#bbb;padding:.3em;text-align:left;"
	      "vertical-align:top}pre{margin:0}img{max-width:32%;image-rendering:pixelated}</style>\n<h1>relume "
	      "bisect</h1>\n<p>good ",
	      file.stream);
	put(f->recordings[GOOD]->path, SIZE_MAX, 1, file.stream);
	fputs(", bad ", file.stream);
	put(f->recordings[BAD]->path, SIZE_MAX, 1, file.stream);
	fprintf(file.stream, "</p>\n<table><tr><th colspan=3>good: frame, call<th colspan=3>bad: frame, "
	                     "call<th>argument<th>state and more that differs</tr>\n");
	for (size_t i = 0; i < f->partings->n; i++)
		put_row(&f->partings->list[i], file.stream);
	fputs("</table>\n", file.stream);
	if (f->sight) {
		fputs("<p>", file.stream);
		put_sight(f->sight, file.stream);
		fputs(f->sight->is_found ? "</p>\n<p><img src=\"good.png\" alt=\"good\"> <img src=\"bad.png\" "
		                           "alt=\"bad\"> <img src=\"difference.png\" "
		                           "alt=\"where they differ\"></p>\n" :
		                           "</p>\n",
		      file.stream);
	}
	return part_close(&file, 0);
}
