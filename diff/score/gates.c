/* The table of gates, and the calls that record their results. */
#include "diff/score/gates.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#define N_FIGURES(...) (sizeof((struct score_figure[]){ __VA_ARGS__ }) / sizeof(struct score_figure))
#define GATE_INFO(id, name, title, measure, needs_reference, ...) \
	[GATE_##id] = { name, title, needs_reference, N_FIGURES(__VA_ARGS__), { __VA_ARGS__ } },
const struct score_gate_info score_gates[N_GATES] = { SCORE_GATES(GATE_INFO) };

#define EFFECT_NAME(id, name) name,
const char *const score_effect_names[N_SCORE_EFFECTS] = { SCORE_EFFECTS(EFFECT_NAME) };

/** 1 if a value is on the good side of a bound. */
static int is_within(int at_least, double value, double bound)
{
	return at_least ? value >= bound : value <= bound;
}

void gate_measure(const struct gate_frame *f, enum score_gate_id id, int figure, double value)
{
	const struct score_figure *info = &score_gates[id].figures[figure];
	const struct score_options *options = f->options;
	const int at_least = info->at_least;
	struct score_gate *g = &f->score->gates[id];
	enum score_state state = SCORE_PASSED;
	double bar = fmax(info->bar, info->share * (double)((size_t)f->score->width * f->score->height)), warn = NAN,
	       better = NAN;

	for (size_t i = 0; i < options->n_bars; i++) {
		const struct score_bar *b = &options->bars[i];

		if (b->gate != id || b->figure != figure)
			continue;
		bar = isnan(b->bar) ? bar : b->bar;
		warn = isnan(b->warn) ? warn : b->warn;
		better = isnan(b->better) ? better : b->better;
	}
	g->value[figure] = value;
	g->bar[figure] = bar;
	if (!is_within(at_least, value, bar)) {
		state = SCORE_FAILED;
	} else if (!isnan(better) && value != better && is_within(at_least, value, better)) {
		state = SCORE_FAILED;
		g->better_than_expected = 1;
	} else if (!isnan(warn) && !is_within(at_least, value, warn)) {
		state = SCORE_WARNED;
	}
	g->state = state > g->state ? state : g->state;
}

static void set_note(const struct gate_frame *f, enum score_gate_id id, const char *fmt, va_list args)
{
	struct score_gate *g = &f->score->gates[id];

	vsnprintf(g->note, sizeof(g->note), fmt, args);
}

void gate_note(const struct gate_frame *f, enum score_gate_id id, const char *fmt, ...)
{
	va_list args;

	va_start(args, fmt);
	set_note(f, id, fmt, args);
	va_end(args);
}

void gate_fail(const struct gate_frame *f, enum score_gate_id id, const char *fmt, ...)
{
	va_list args;

	f->score->gates[id].state = SCORE_FAILED;
	va_start(args, fmt);
	set_note(f, id, fmt, args);
	va_end(args);
}
