#include "look/study/world.h"

#include <inttypes.h>

enum { MAX_ANCHORS = 64, ANCHORS_OF_A_FRAME = 4 };

/* Of shapes that change in most of their frames. */
static size_t count_deforming(const struct motion *m)
{
	size_t n = 0;

	for (size_t i = 0; i < m->n_shapes; i++)
		n += m->shapes[i].frames > 1 && 2 * m->shapes[i].changed >= m->shapes[i].frames;
	return n;
}

void world_report(const struct motion *m, FILE *out)
{
	size_t still = 0, moving = 0, carried = 0, once = 0, moved = 0, known = 0;
	double share = 0;

	for (size_t i = 0; i < m->n_frames; i++) {
		moved += (size_t)m->cameras[i].moved;
		known += (size_t)m->cameras[i].witnessed;
		share += m->cameras[i].share;
	}
	for (size_t i = 0; i < m->n_things; i++) {
		const struct motion_thing *t = &m->things[i];

		if (!t->again)
			once++;
		else if (t->still == t->again)
			still++;
		else if (2 * t->carried >= t->again)
			carried++;
		else
			moving++;
	}
	if (!known)
		fprintf(out, "# camera: unknown, as no mesh was drawn twice\n");
	else
		fprintf(out,
		        "# camera: followed through %zu of %zu frames, moves in %zu; %.0f %% of what is seen again, by "
		        "size, stands still\n",
		        known, m->n_frames, moved, 100 * share / (double)known);
	fprintf(out,
	        "# meshes: %zu static, %zu moving, %zu with the viewer, %zu seen in one frame; %zu deforming shapes\n",
	        still, moving, carried, once, count_deforming(m));
}

static void write_anchor(const struct motion_thing *t, const uint64_t hash[2], int *begun, FILE *out)
{
	if (!*begun)
		fprintf(out, "world:\n");
	*begun = 1;
	fprintf(out, "  - mesh: \"%016" PRIx64 "%016" PRIx64 "\"\n    at: [", hash[1], hash[0]);
	for (int i = 0; i < 16; i++)
		fprintf(out, "%s%.9g", i ? ", " : "", t->world[i]);
	fprintf(out, "]\n    part: %u\n", t->part);
}

/* Those seen in most frames first; then each that shows a frame which has too few. */
void world_write(const struct motion *m, FILE *out)
{
	unsigned have[MOTION_MAX_FRAMES] = { 0 }, n = 0;
	int begun = 0;

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
			write_anchor(t, t->mesh, &begun, out);
			if (t->turned[0] | t->turned[1])
				write_anchor(t, t->turned, &begun, out);
			n++;
		}
}
