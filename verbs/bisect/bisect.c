/*
 * relume bisect: finds the first call where two recordings of a program diverge.
 *
 * Frames are aligned, then calls (partners.h). Both recordings are executed side by side (walk.h): each difference
 * between calls is printed with the differences in state. Then frames are drawn as OpenGL drew them, until a picture
 * differs (sights.h).
 */
#include <stdio.h>
#include <string.h>

#include "base/err.h"
#include "base/options.h"
#include "base/verbs.h"
#include "verbs/bisect/page.h"

enum { SAME = 0, PARTS = 1, CANNOT_TELL = 125 }; /* exit codes of `git bisect run` */
enum by { BY_CALLS, BY_PICTURES };

static const char *const by_words[] = { "calls", "pictures", NULL };

struct asked {
	const char *good, *bad, *ignore, *report, *device;
	unsigned most, pictures;
	int all;
	enum by by;
};

#define AT(member) .at = offsetof(struct asked, member)

static const struct options_row rows[] = {
	{ "by", 0, "WHAT", "let calls (default) or pictures determine the exit code", options_word, AT(by),
	  .words = by_words },
	{ "all", 'a', NULL,
	  "compare queries and waits, too (glGetError, glFinish): programs may differ in them and yet draw the same",
	  options_flag, AT(all) },
	{ "ignore", 0, "LIST", "ignore these commands, too: shell patterns with commas, as in 'glRotate*,glColor4f'",
	  options_text, AT(ignore) },
	{ "most", 'n', "N", "places to show at most (default 10)", options_number, AT(most), .most = 10000 },
	{ "pictures", 'p', "N", "frames to draw at most, from the first one that diverges (default 20; 0: none)",
	  options_number, AT(pictures), .most = 1000000 },
	{ "report", 0, "DIR", "DIR/index.html, with the first pictures that differ", options_text, AT(report),
	  .use = CONFINE_FILLS },
	{ "device", 0, "NAME", "OpenCL device that draws, as for 'relume render'", options_text, AT(device) },
	{ OPTIONS_NO_SANDBOX },
};

static const struct options_table table = {
	.verb = "bisect",
	.head = "usage: relume bisect [OPTIONS] GOOD BAD\n"
		"\n"
		"Find the first call where two recordings of a program, of a good and a bad build, diverge: its frame, "
	        "its arguments in\n"
		"both, the OpenGL state that differs because of it, and the first picture that differs. Calls are "
	        "aligned, so an added\n"
		"or removed call does not affect later ones. Textures, lists and other objects may be numbered "
	        "differently.\n"
		"\n"
		"A program that moves with the clock diverges in every frame: record both with a fixed step, or "
	        "--ignore what moves.\n"
		"\n"
		"With git, where good.trace was recorded from a good build:\n"
		"\n"
		"    git bisect run sh -c 'make || exit 125; xvfb-run -a relume record -o now.trace -- ./program || "
	        "exit 125;\n"
		"        relume bisect --by pictures good.trace now.trace'\n",
	OPTIONS_ROWS(rows),
	.notes = "Exit codes: 0 the same, 1 they diverge, 2 wrong usage, 125 cannot be determined: a recording cannot "
	         "be read, or\n"
		 "frames were left that --pictures excludes.\n",
	.takes = "two recordings",
	.least = 2,
	.most = 2,
	.words_use = CONFINE_RECORDING,
};

/* The first frame of the good recording that can look different. */
static size_t first_frame(const struct partings *p)
{
	size_t first = p->list[0].frame[GOOD];

	for (size_t i = 1; i < p->n; i++)
		first = p->list[i].frame[GOOD] < first ? p->list[i].frame[GOOD] : first;
	return first;
}

/* @return an exit code, or ERR_* (reported) */
static int judge(const struct asked *o, struct findings *f, const struct partners *partners, struct sight *sight)
{
	int err = 0;

	if (f->partings->n && o->pictures) {
		err = sight_find(partners, f->recordings[GOOD], f->recordings[BAD], first_frame(f->partings),
		                 o->pictures, o->device, sight);
		f->sight = err ? NULL : sight;
	}
	page_table(f, stdout);
	if (fflush(stdout) || ferror(stdout))
		return err_report(ERR_SYSTEM, NULL, "standard output cannot be written");
	if (o->report && !err)
		err = page_write(f, o->report);
	if (o->report && !err && sight->is_found)
		err = sight_write(sight, o->report);
	if (err && o->by == BY_CALLS && !f->sight)
		err = 0; /* reported; the calls are enough */
	if (err || !f->partings->n)
		return err;
	if (o->by == BY_CALLS || sight->is_found)
		return PARTS;
	return sight->left || !f->sight ? CANNOT_TELL : SAME;
}

static int bisect(const struct asked *o)
{
	struct recording good = { .path = NULL }, bad = { .path = NULL };
	struct partners partners = { .n = 0 };
	struct partings partings = { .n = 0 };
	struct sight sight = { .looked = 0 };
	struct findings found = { .recordings = { &good, &bad }, .partings = &partings };
	int rc = recording_read(&good, o->good, o->ignore, o->all);

	if (!rc)
		rc = recording_read(&bad, o->bad, o->ignore, o->all);
	if (!rc)
		rc = partners_find(&partners, &good, &bad);
	if (!rc)
		rc = walk_both(&partners, &good, &bad, o->most, &partings);
	if (!rc)
		rc = judge(o, &found, &partners, &sight);
	sight_free(&sight);
	partings_free(&partings);
	partners_free(&partners);
	recording_free(&good);
	recording_free(&bad);
	return rc < 0 ? CANNOT_TELL : rc;
}

int bisect_main(int argc, char **argv)
{
	struct asked o = { .most = 10, .pictures = 20 };
	struct options_line line;
	int err = options_parse(&table, argc, argv, &o, &line);

	if (err)
		return err > 0 ? 0 : -err;
	if (!o.most)
		return -err_report(ERR_USAGE, NULL, "--most 0 shows nothing");
	o.good = line.words[0];
	o.bad = line.words[1];
	err = options_confine(&table, &line, CONFINE_TRACER, NULL);
	return err ? -err : bisect(&o);
}
