/* The table of relations, and the program that rewrites a recording under one of them. */
#include "tests/same/relations.h"

#include <stdio.h>

#include "tests/same/story.h"

#define RUNS RELATION_RUNS
#define EVERY (RELATION_RUNS | RELATION_ALL | RELATION_ROUNDS)
#define FAR (EVERY | RELATION_COVERS)
#define NO_DRAWS "it would change no draw"
#define NO_TRIANGLES "no triangles are drawn"
#define NO_CLEAR "the window is not cleared"
#define NO_DEPTH "no depth-tested draw follows a clear"
#define NO_FRAME "no frame ends in the window"

const struct relation relations[] = {
	/* ways to draw */
	{ "immediate", "all vertices between Begin and End", NO_DRAWS, RUNS, .base = "-", .run = run_plain },
	{ "lists", "each draw in a display list", NO_DRAWS, RUNS, .run = run_listed },
	{ "arrays", "each draw from arrays", NO_DRAWS, RUNS, .run = run_arrays },
	{ "elements", "each draw by indices", NO_DRAWS, RUNS, 1, .run = run_arrays },
	{ "triangles", "strips, fans, quads as separate triangles", "all draws are triangles already", RUNS,
	  .run = run_cut },
	{ "strips", "triangles as one strip, joined by degenerate ones", NO_TRIANGLES, RUNS, .run = run_strip },
	{ "split", "each triangle a separate draw", "no draw has two triangles", RUNS, .run = run_split },
	{ "joined", "adjacent draws as one", "no draws are adjacent", RUNS, .run = run_join, .call = call_join },
	{ "loaded", "matrices loaded before each draw", NO_DRAWS, RUNS, .run = run_loaded },
	{ "undone", "state changed and restored, set again, pushed and popped", NO_DRAWS, 0, .call = call_undone },
	{ "asked", "queries, and calls that are errors", NO_DRAWS, 0, .call = call_asked },
	{ "wound", "triangles and front face reversed", NO_TRIANGLES, RUNS | RELATION_ROUNDS,
	  .run = run_wound },
	{ "culled", "front face and culled side exchanged", NO_DRAWS, RUNS, .run = run_culled },
	{ "doubled", "solid draws twice", "nothing solid is drawn", RUNS, .run = run_doubled },
	/* another world: the bases have their vertices rounded as in the moved world */
	{ "near-base", "", NO_DRAWS, EVERY, -1, .run = run_moved, .base = "" },
	{ "near", "the world moved by the distance of its objects from the eye", NO_DRAWS, EVERY, 1, "near-base",
	  .run = run_moved },
	{ "far-base", "", NO_DRAWS, EVERY, -256, .run = run_moved, .base = "" },
	{ "far", "moved 256 times as far", NO_DRAWS, FAR, 256, "far-base", .run = run_moved },
	{ "farther-base", "", NO_DRAWS, EVERY, -4096, .run = run_moved, .base = "" },
	{ "farther", "moved 4,096 times as far", NO_DRAWS, FAR | RELATION_COARSE, 4096, "farther-base",
	  .run = run_moved },
	{ "small", "the world scaled by 2^-10", NO_DRAWS, EVERY, 0x1p-10, .run = run_eye, .call = call_eye },
	{ "large", "the world scaled by 2^17", NO_DRAWS, EVERY, 0x1p17, .run = run_eye, .call = call_eye },
	{ "mirrored", "eye space mirrored, undone by the projection", NO_DRAWS, EVERY, 0, .run = run_eye,
	  .call = call_eye },
	{ "turned", "eye space rotated, undone by the projection", NO_DRAWS, EVERY, -1, .run = run_eye,
	  .call = call_eye },
	/* passes */
	{ "prepass", "depth first, then colour", "nothing solid is drawn, or by stencil", RUNS | RELATION_PASSES,
	  .run = run_prepass, .call = call_prepass },
	{ "lights-base", "a quarter of the light", NO_DRAWS, RUNS, .base = "", .run = run_plain, .call = call_dimmed },
	{ "lights", "one light at a time, added", "nothing solid is lit, or a draw covers it",
	  RUNS | RELATION_PASSES | RELATION_SATURATES, .base = "lights-base", .run = run_lights, .call = call_lights },
	/* beside the world */
	{ "behind", "a sheet behind everything, without depth", NO_CLEAR, 0, 0, .cleared = cleared_behind },
	{ "behind-depth", "a sheet behind everything, with depth", NO_CLEAR, 0, 1, .cleared = cleared_behind },
	{ "behind-far", "a sheet before the far plane, without depth", NO_DEPTH, RUNS, 0, .first = first_sky },
	{ "sky", "a sky of one draw, and a clear of depth", NO_DEPTH, RUNS, 1, .first = first_sky },
	{ "skies", "a sky of 24 draws, and a clear of depth", NO_DEPTH, RUNS, 24, .first = first_sky },
	{ "unseen", "sheets that GL does not show", NO_DEPTH, RUNS, .first = first_unseen },
	{ "hud", "a HUD of clear glass", NO_FRAME, 0, .frame = frame_hud },
	{ "lamps", "a body around the light", "no light has a place", RUNS | RELATION_COVERS, .run = run_lamps,
	  .cleared = cleared_lamps },
	/* another window */
	{ "blit", "a framebuffer object, blitted", NO_FRAME, 0, 0, .call = call_target, .frame = frame_target },
	{ "quad", "a framebuffer object, as a textured quad", NO_FRAME, 0, 1, .call = call_target,
	  .frame = frame_target },
	{ "thrice", "the window three times as large", NO_DRAWS, RELATION_ROUNDS | RELATION_TRIPLES,
	  .call = call_thrice },
};
const unsigned n_relations = sizeof(relations) / sizeof(relations[0]);

/* ---- the program ---- */

static const struct relation measured = { "", "", "measured", RUNS, .run = run_measured };

static int usage(void)
{
	fputs("usage: relations | relations RELATION FROM.trace TO.trace\n"
	      "Without arguments: a line for each relation, NAME BASE FLAGS WHAT.\n"
	      "Exits with 77 and a reason where it does not apply.\n", stderr);
	return 2;
}

int main(int argc, char **argv)
{
	static struct story s, first = { .relation = &measured }; /* their memory is released when the program exits */
	int rc;

	for (unsigned i = 0; i < n_relations && argc == 1; i++) {
		const struct relation *r = &relations[i];
		const char *base = r->base ? r->base : r->flags & RUNS ? "immediate" : "-";

		printf("%s\t%s\t%u\t%s\n", r->name, base, r->flags, r->what);
	}
	if (argc == 1)
		return 0;
	for (unsigned i = 0; i < n_relations && argc == 4; i++)
		if (strcmp(relations[i].name, argv[1]) == 0)
			s.relation = &relations[i];
	if (!s.relation)
		return usage();
	if (s.relation->run == run_moved) { /* writes nothing, since it never applies */
		rc = story_tell(&first, argv[2], argv[3]);
		s.distance = first.distance;
	}
	rc = story_tell(&s, argv[2], argv[3]);
	if (rc == 1)
		puts(s.why_not);
	else if (rc == 0)
		printf("%llu\n", (unsigned long long)s.n_changes);
	return rc == 1 ? 77 : -rc;
}
