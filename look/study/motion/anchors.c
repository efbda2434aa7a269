#include "look/study/motion/anchors.h"

#include <string.h>

enum { MAX_ANCHORS = 64, ANCHORS_OF_A_FRAME = 4 };

/* The number of shapes that change in most of their frames. */
static size_t count_deforming(const struct motion *m)
{
	size_t n = 0;

	for (size_t i = 0; i < m->n_shapes; i++)
		n += m->shapes[i].frames > 1 && 2 * m->shapes[i].changed >= m->shapes[i].frames;
	return n;
}

void anchors_summarize(const struct motion *m, struct findings_summary *out)
{
	double share = 0;

	*out = (struct findings_summary){ .frames = m->n_frames, .deforming = count_deforming(m) };
	if (m->n_frames) {
		out->first = m->cameras[0].frame;
		out->last = m->cameras[m->n_frames - 1].frame;
	}
	for (size_t i = 0; i < m->n_frames; i++) {
		out->moved += (size_t)m->cameras[i].moved;
		out->known += (size_t)m->cameras[i].witnessed;
		share += m->cameras[i].share;
	}
	if (out->known)
		out->percent = 100 * share / (double)out->known;
	for (size_t i = 0; i < m->n_things; i++) {
		const struct motion_thing *t = &m->things[i];

		if (!t->again)
			out->once++;
		else if (t->still == t->again)
			out->still++;
		else if (2 * t->carried >= t->again)
			out->carried++;
		else
			out->moving++;
	}
}

static void add_anchor(const struct motion_thing *t, const uint64_t hash[2], struct findings *out)
{
	struct finding *rule = findings_add(out, FINDINGS_WORLD, NULL);
	struct finding_value at = { .key = "at", .type = FINDING_NUMBERS, .digits = 9, .n = 16 };

	memcpy(at.numbers, t->world, sizeof(at.numbers));
	FINDING_SET(rule, FINDING_HASHED("mesh", hash), at, FINDING_COUNTED("part", t->part));
}

/* Meshes seen in the most frames come first, then those that bring a frame up to ANCHORS_OF_A_FRAME. */
void anchors_find(const struct motion *m, struct findings *out)
{
	unsigned have[MOTION_MAX_FRAMES] = { 0 }, n = 0;

	for (uint32_t least = (uint32_t)m->n_frames; least > 0 && n < MAX_ANCHORS; least--)
		for (size_t i = 0; i < m->n_things && n < MAX_ANCHORS; i++) {
			const struct motion_thing *t = &m->things[i];
			int helps = 0;

			if (t->frames != least || !(m->n_frames == 1 ? t->votes : (uint32_t)motion_is_static(t)))
				continue;
			for (size_t f = 0; f < m->n_frames; f++)
				helps |= (t->seen[f / 64] >> f % 64 & 1) && have[f] < ANCHORS_OF_A_FRAME;
			if (!helps)
				continue;
			for (size_t f = 0; f < m->n_frames; f++)
				have[f] += t->seen[f / 64] >> f % 64 & 1;
			add_anchor(t, t->mesh, out);
			if (t->turned[0] | t->turned[1])
				add_anchor(t, t->turned, out);
			n++;
		}
}
