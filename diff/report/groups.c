/* Groups consecutive frames with the same result. */
#include "diff/report/groups.h"

#include "diff/score/gates.h"

const char *groups_comparison(int gate)
{
	return gate == GATE_B ? "not as approved" : score_gates[gate].needs_reference ? "not as the reference" : "by itself";
}

static unsigned failed_gates(const struct score *s)
{
	unsigned failed = 0;

	for (int g = 0; g < N_GATES && output_is_compared(s); g++)
		failed |= s->gates[g].state == SCORE_FAILED ? 1u << g : 0;
	return failed;
}

static int is_worse(const struct score *a, const struct score *b)
{
	return a->fidelity < b->fidelity ||
	       (a->fidelity <= b->fidelity && a->gates[GATE_B].value[0] > b->gates[GATE_B].value[0]);
}

/* @return 1 if the frame continues a group */
static int goes_on(const struct output_run *run, struct group *group, const struct score *s)
{
	if (output_is_named(run, s->frame) || s->frame != group->last + 1 || s->outcome != group->worst->outcome ||
	    failed_gates(s) != group->failed)
		return 0;
	group->last = s->frame;
	if (is_worse(s, group->worst))
		group->worst = s;
	return 1;
}

size_t groups_make(const struct output_run *run, struct group *out, size_t most, uint64_t *left)
{
	size_t n = 0;

	*left = 0;
	for (size_t i = 0; i < run->n_scores; i++) {
		const struct score *s = &run->scores[i];

		if (s->outcome == SCORE_FRAME_PASSED || (n && !*left && goes_on(run, &out[n - 1], s)))
			continue;
		if (n < most)
			out[n++] = (struct group){ s->frame, s->frame, s, failed_gates(s) };
		else
			*left += 1;
	}
	return n;
}
