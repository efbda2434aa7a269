/* Judges frames over several runs, proposes flaky entries, and lists allowances that no run needed. */
#include "diff/runs/runs.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <time.h>

#include "base/err.h"
#include "base/memory.h"
#include "base/plural.h"
#include "diff/report/pictures.h"
#include "diff/score/gates.h"

/* Gates that use only the compared layer and depth, so that a composite can be scored by them. */
static const unsigned composed = 1u << GATE_R1 | 1u << GATE_R1B | 1u << GATE_R2 | 1u << GATE_R3 | 1u << GATE_R4 |
                                 1u << GATE_R5 | 1u << GATE_P;

/* --- Verdicts ---------------------------------------------------------------------------------------------------- */

static unsigned failed_gates(const struct score *s)
{
	unsigned gates = 0;

	for (int g = 0; g < N_GATES; g++)
		gates |= s->gates[g].state == SCORE_FAILED ? 1u << g : 0;
	return gates;
}

static void count(const struct runs *r, size_t frame, struct runs_frame *out)
{
	*out = (struct runs_frame){ .frame = r->frames[frame] };
	for (size_t i = 0; i < r->n; i++) {
		const struct score *s = &r->runs[i].scores[frame];
		const unsigned gates = failed_gates(s);

		for (int g = 0; g < N_GATES; g++)
			out->n_failed[g] += gates >> g & 1;
		out->missing += s->outcome == SCORE_FRAME_MISSING || s->outcome == SCORE_FRAME_UNREADABLE;
		out->failing += s->outcome == SCORE_FRAME_MISSING || s->outcome == SCORE_FRAME_UNREADABLE || gates;
		out->unknown_gates |= s->outcome == SCORE_FRAME_FAILED ? gates : 0;
	}
	for (int g = 0; g < N_GATES; g++)
		if (out->n_failed[g] && out->n_failed[g] == r->n - out->missing && !(composed >> g & 1))
			out->steady_gates |= 1u << g;
}

/* The run nearest to the reference; it supplies the data of gates that look at more than colours and depth. */
static size_t best_run(const struct runs *r, size_t frame)
{
	size_t best = r->n;

	for (size_t i = 0; i < r->n; i++)
		if (output_is_compared(&r->runs[i].scores[frame]) &&
		    (best == r->n || r->runs[i].scores[frame].fidelity > r->runs[best].scores[frame].fidelity))
			best = i;
	return best;
}

/* One frame in all runs. */
struct shown {
	const struct runs *runs;
	size_t frame, best;
	struct image *images; /* [runs->n]; empty if a run lacks it */
};

/* Score the composite of the runs. */
static int judge_common(const struct shown *f, struct runs_frame *out)
{
	static const struct baseline none = { .dir = NULL };
	const struct runs *r = f->runs;
	const struct output_run *best = &r->runs[f->best];
	const struct scoring all = { r->ref, &r->sets[f->best], &none, best };
	struct image reference = { 0 };
	struct score_rules_frame settings = { 0 };
	struct score_picture ref = { 0 };
	struct score score;
	int err = set_read(r->ref, set_find(r->ref, out->frame), &reference);

	if (!err)
		err = picture_take_reference(&reference, best->options->channel, &ref);
	if (!err)
		err = score_rules_for_frame(best->settings, best->name, out->frame, best->options,
		                            (uint32_t[]){ ref.width, ref.height }, &settings);
	if (!err)
		err = composite_make(&f->images[f->best], best->scores[f->frame].layer, &ref, f->images, r->n, SCORE_CODES,
		                     settings.options.ignore_alpha, &out->varying);
	if (!err)
		err = scoring_image(&all, out->frame, &ref, &f->images[f->best], &score);
	if (!err)
		out->steady_gates |= failed_gates(&score) & composed;
	score_rules_frame_free(&settings);
	score_picture_free(&ref);
	image_free(&reference);
	return err;
}

static int judge(const struct runs *r, size_t frame, struct runs_frame *out)
{
	struct shown shown = { r, frame, best_run(r, frame), calloc(r->n, sizeof(struct image)) };
	int err = shown.images ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");

	for (size_t i = 0; i < r->n && shown.best < r->n && !err; i++)
		if (output_is_compared(&r->runs[i].scores[frame]))
			err = set_read(&r->sets[i], set_find(&r->sets[i], r->frames[frame]), &shown.images[i]);
	if (!err && shown.best < r->n)
		err = judge_common(&shown, out);
	for (size_t i = 0; shown.images && i < r->n; i++)
		image_free(&shown.images[i]);
	free(shown.images);
	out->verdict = out->steady_gates || out->missing == r->n ? RUNS_REGRESSION : RUNS_FLAKY;
	return err;
}

int runs_judge(const struct runs *r, struct runs_frame *out)
{
	int err = 0;

	for (size_t i = 0; i < r->n_frames && !err; i++) {
		count(r, i, &out[i]);
		if (out[i].failing)
			err = judge(r, i, &out[i]);
	}
	return err;
}

/* --- Output ------------------------------------------------------------------------------------------------------ */

static void put_gates(const struct runs_frame *f, FILE *out)
{
	const char *between = "";

	for (int g = 0; g < N_GATES; g++)
		if (f->n_failed[g]) {
			fprintf(out, "%s%s (%u%s)", between, score_gates[g].name, f->n_failed[g],
			        f->steady_gates >> g & 1 ? ", always" : "");
			between = ", ";
		}
	if (f->missing)
		fprintf(out, "%smissing (%u)", between, f->missing);
}

void runs_table(const struct runs *r, const struct runs_frame *frames, FILE *out)
{
	static const char *const words[] = { "steady", "flaky", "regression" };
	size_t counts[3] = { 0, 0, 0 };

	fprintf(out, "%7s %-11s %8s  %s\n", "frame", "verdict", "failing",
	        "gates (runs that fail); pixels that vary between runs");
	for (size_t i = 0; i < r->n_frames; i++) {
		const struct runs_frame *f = &frames[i];
		const struct composite_varying *v = &f->varying;
		char name[256];

		counts[f->verdict]++;
		if (f->verdict == RUNS_STEADY)
			continue;
		if (output_is_named(&r->runs[0], f->frame))
			output_name(&r->runs[0], f->frame, name, sizeof(name));
		else
			snprintf(name, sizeof(name), "%" PRIu64, f->frame);
		fprintf(out, "%7s %-11s %3u of %zu  ", name, words[f->verdict], f->failing, r->n);
		put_gates(f, out);
		if (v->pixels)
			fprintf(out, "; %" PRIu64 " within %u,%u to %u,%u", v->pixels, v->x0, v->y0, v->x1, v->y1);
		fputc('\n', out);
	}
	fprintf(out, "%zu frame%s in %zu runs: %zu steady, %zu flaky (%.3g %%), %zu regression%s\n", r->n_frames,
	        plural(r->n_frames), r->n, counts[RUNS_STEADY], counts[RUNS_FLAKY],
	        100 * (double)counts[RUNS_FLAKY] / (double)r->n_frames, counts[RUNS_REGRESSION],
	        plural(counts[RUNS_REGRESSION]));
}

/* List the frames from `first` on that fail the same gates; each is listed only once. */
static void put_alike(const struct runs *r, const struct runs_frame *frames, size_t first, uint8_t *done, FILE *out)
{
	const char *between = "";

	for (size_t i = first; i < r->n_frames; i++) {
		size_t last = i;

		if (done[i] || frames[i].unknown_gates != frames[first].unknown_gates)
			continue;
		while (last + 1 < r->n_frames && !done[last + 1] && frames[last + 1].unknown_gates == frames[first].unknown_gates &&
		       frames[last + 1].frame == frames[last].frame + 1)
			last++;
		fprintf(out, last > i ? "%s%" PRIu64 "-%" PRIu64 : "%s%" PRIu64, between, frames[i].frame, frames[last].frame);
		between = ",";
		for (; i <= last; i++)
			done[i] = 1;
		i--;
	}
}

size_t runs_quarantine(const struct runs *r, const struct runs_frame *frames, unsigned days, FILE *out)
{
	const time_t end = time(NULL) + (time_t)days * 24 * 3600;
	uint8_t *done = calloc(r->n_frames, 1);
	char day[16];
	size_t n = 0;

	strftime(day, sizeof(day), "%Y-%m-%d", gmtime(&end));
	for (size_t i = 0; done && i < r->n_frames; i++)
		done[i] = frames[i].verdict != RUNS_FLAKY || !frames[i].unknown_gates ||
			output_is_named(&r->runs[0], frames[i].frame); /* entries list numbers, which named pictures lack */
	for (size_t i = 0; done && i < r->n_frames; i++) {
		const struct runs_frame *f = &frames[i];
		const char *between = "";

		if (done[i])
			continue;
		fputs("- {", out);
		if (r->match)
			fprintf(out, "match: \"%s\", ", r->match);
		fputs("frames: \"", out);
		put_alike(r, frames, i, done, out);
		fputs("\", gates: [", out);
		for (int g = 0; g < N_GATES; g++)
			if (f->unknown_gates >> g & 1) {
				fprintf(out, "%s%s", between, score_gates[g].name);
				between = ", ";
			}
		fprintf(out,
		        "], reason: \"frame %" PRIu64 " failed in %u of %zu runs, %" PRIu64
		        " pixels vary\", expires: %s}\n",
		        f->frame, f->failing, r->n, f->varying.pixels, day);
		n++;
	}
	free(done);
	return n;
}

/* --- Allowances that are not needed ------------------------------------------------------------------------------ */

struct use {
	struct score_rules_entry entry;
	uint64_t frames; /* number of frames it applied to, over all runs */
	double worst;    /* for a bar: the worst figure */
	int is_needed;
};

struct uses {
	struct use *list;
	size_t n, room;
	const struct score *score;
	int err;
};

/* 1 if a figure is beyond a bar. */
static int is_beyond(const struct score_figure *figure, double value, double bar)
{
	return figure->at_least ? !(value >= bar) : !(value <= bar);
}

static void note(void *user, const struct score_rules_entry *entry)
{
	struct uses *u = user;
	const struct score_gate *gate = &u->score->gates[entry->gate];
	const struct score_figure *figure = &score_gates[entry->gate].figures[entry->figure];
	const double share = figure->share * u->score->width * u->score->height,
		     usual = figure->bar > share ? figure->bar : share;
	size_t i = 0;

	if (!entry->reason && !(isfinite(entry->fail) && is_beyond(figure, entry->fail, usual)))
		return; /* it is no looser than the default */
	while (i < u->n && u->list[i].entry.key != entry->key)
		i++;
	if (i == u->n) {
		if (MEMORY_GROW(u->list, u->room, u->n + 1)) {
			u->err = ERR_SYSTEM;
			return;
		}
		u->list[u->n++] = (struct use){ .entry = *entry, .worst = figure->at_least ? INFINITY : -INFINITY };
	}
	u->list[i].frames++;
	if (entry->reason) {
		u->list[i].is_needed |= (failed_gates(u->score) & entry->flaky_gates) != 0;
	} else if (gate->state != SCORE_NOT_MEASURED) {
		u->list[i].is_needed |= is_beyond(figure, gate->value[entry->figure], usual);
		if (is_beyond(figure, gate->value[entry->figure], u->list[i].worst))
			u->list[i].worst = gate->value[entry->figure];
	}
}

int runs_unneeded(const struct runs *r, FILE *out)
{
	struct uses u = { .n = 0 };

	for (size_t i = 0; i < r->n; i++)
		for (size_t f = 0; f < r->n_frames; f++) {
			u.score = &r->runs[i].scores[f];
			if (output_is_compared(u.score))
				score_rules_visit(r->runs[i].settings, r->runs[i].name, u.score->frame, note, &u);
		}
	for (size_t i = 0; i < u.n; i++) {
		const struct score_rules_entry *e = &u.list[i].entry;

		if (u.list[i].is_needed)
			continue;
		if (e->reason)
			fprintf(out,
			        "no longer needed: the flaky entry \"%s\": none of its gates failed in %" PRIu64
			        " pictures\n",
			        e->reason, u.list[i].frames);
		else
			fprintf(out,
			        "no longer needed: %s's bar %g for %s: the worst of %" PRIu64
			        " pictures is %g, the usual bar %g\n",
			        e->of, e->fail, score_gates[e->gate].name, u.list[i].frames, u.list[i].worst,
			        score_gates[e->gate].figures[e->figure].bar);
	}
	free(u.list);
	return u.err;
}
