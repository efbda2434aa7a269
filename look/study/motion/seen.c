#include "look/study/motion/seen.h"

#include <stdlib.h>

#include "base/err.h"
#include "base/memory.h"
#include "look/draws/drawn.h"
#include "look/draws/modelview.h"
#include "look/draws/solid.h"

/* The scenes of at most this many frames are kept while others are rendered. */
enum { MOST_FRAMES = 32 };

/* 0 for reflected draws and the like: they stand still too, but in a world that does not exist. */
static int is_world(const struct scene *s, const struct scene_instance *in)
{
	return solid_is(s, in) && !s->materials[in->material].stencil_test &&
	       modelview_kind_of(in->modelview) == MODELVIEW_PLAIN && !drawn_in_parallel(&s->views[in->view]);
}

int seen_add(struct seen *seen, const struct scene *scene, const struct motion *motion)
{
	if (MEMORY_GROW(seen->draws, seen->room, seen->n + scene->n_instances + 1))
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t i = 0; i < scene->n_instances; i++)
		if (motion->of_instance[i] != SCENE_NONE && is_world(scene, &scene->instances[i]))
			seen->draws[seen->n++] = (struct seen_draw){ motion->of_instance[i], scene->instances[i].draw,
				                                     (uint32_t)motion->n_frames - 1 };
	return 0;
}

void seen_free(struct seen *seen)
{
	free(seen->draws);
	*seen = (struct seen){ .draws = NULL };
}

/* Only the recording's main part is used; in the others, positions relative to it are unknown. */
struct asked {
	const struct motion *motion;
	uint32_t part, frames;  /* frames: the number of frames in this part */
	unsigned char *covered; /* [things] 1: an `unseen` rule draws it */
};

static int is_wanted(const struct asked *a, uint32_t thing)
{
	const struct motion_thing *t = &a->motion->things[thing];

	return !a->covered[thing] && motion_is_static(t) && t->part == a->part && t->frames < a->frames;
}

/* Find the frame that draws the most things not covered so far. @return their number */
static size_t find_best(const struct seen *seen, const struct asked *a, uint32_t *best)
{
	size_t most = 0, n = 0;

	for (size_t i = 0; i < seen->n; i++) {
		n = i && seen->draws[i].frame == seen->draws[i - 1].frame ? n : 0;
		n += (size_t)is_wanted(a, seen->draws[i].thing);
		if (n > most) {
			most = n;
			*best = seen->draws[i].frame;
		}
	}
	return most;
}

/* A frame's draws as ranges, to be freed; marks the things they draw as covered. NULL: out of memory */
static char *draws_of(const struct seen *seen, const struct asked *a, uint32_t frame)
{
	char *text = NULL;
	size_t size;
	FILE *out = open_memstream(&text, &size);
	uint32_t first = 0, last = 0;
	const char *comma = "";

	for (size_t i = 0; i < seen->n && out; i++) {
		const struct seen_draw *d = &seen->draws[i];

		if (d->frame != frame || !is_wanted(a, d->thing))
			continue;
		a->covered[d->thing] = 1;
		if (first && d->draw == last + 1) {
			last++;
			continue;
		}
		if (first)
			fprintf(out, "%s%u-%u", comma, first, last);
		comma = first ? "," : "";
		first = last = d->draw;
	}
	if (!out)
		return NULL;
	fprintf(out, "%s%u-%u", comma, first, last);
	if (fclose(out)) {
		free(text);
		text = NULL;
	}
	return text;
}

int seen_find(const struct seen *seen, const struct motion *m, struct findings *out)
{
	struct asked a = { .motion = m, .covered = calloc(m->n_things + 1, 1) };
	uint32_t frame = 0;

	if (!a.covered)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	a.part = motion_main_part(m, &a.frames);
	for (int i = 0; i < MOST_FRAMES; i++) {
		const size_t n = find_best(seen, &a, &frame);
		struct finding *rule;

		if (!n)
			break;
		rule = findings_add(out, FINDINGS_UNSEEN, "out of sight");
		finding_say(rule, "%zu meshes stand still, and some frames leave them out", n);
		FINDING_SET(rule, FINDING_COUNTED("frame", m->cameras[frame].frame),
		            { .key = "draws", .type = FINDING_QUOTED, .text = draws_of(seen, &a, frame) });
	}
	free(a.covered);
	return 0;
}
