#include "verbs/bisect/wrong.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/plural.h"
#include "diff/pictures/set.h"
#include "diff/report/pictures.h"
#include "diff/score/gates.h"
#include "diff/score/picture.h"
#include "diff/score/score.h"
#include "scene/scene.h"
#include "verbs/render/single.h"

/* A frame of a recording, rendered in mode gl. All zero is empty. */
struct rendering {
	struct single single;
	struct score_picture shown; /* its picture as display codes, for scoring */
};

static void free_rendering(struct rendering *v)
{
	score_picture_free(&v->shown);
	single_free(&v->single);
}

/* Execute a trace up to a frame. @return 0, ERR_USAGE (not reported: there is no such frame), or ERR_* (reported) */
static int play(struct replay *rp, uint64_t frame, struct scene **scene)
{
	int rc = 1;

	for (uint64_t f = 0; f <= frame && rc == 1; f++)
		rc = replay_next_frame(rp, f == frame, scene);
	return rc == 1 ? 0 : rc ? rc : ERR_USAGE;
}

/* Render a frame. @return as play */
static int render_frame(const char *trace, uint64_t frame, struct rendering *v)
{
	int err = single_open(trace, NULL, &v->single);

	if (!err)
		err = play(v->single.replay, frame, &v->single.scene);
	if (!err)
		err = single_render(&v->single, "gl,id,layers");
	return err ? err : score_picture_from_image(&v->single.image, "gl", &v->shown);
}

/* The call that drew a pixel; UINT64_MAX: none. */
static uint64_t call_at(const struct rendering *v, size_t pixel)
{
	const uint32_t draw = single_draw_at(&v->single, pixel);

	return draw ? v->single.scene->draws[draw].call_number : UINT64_MAX;
}

/* --- The note: a line "CALL WIDTH HEIGHT", then a line "PIXEL RED GREEN BLUE" for each wrong pixel ---------------- */

enum { MOST_PIXELS = 16 };

/* Find the pixels of a call whose codes differ most from the reference, worst first. @return their number */
static unsigned find_worst(const struct rendering *v, const struct score_picture *ref, uint64_t call,
                           size_t worst[MOST_PIXELS])
{
	int difference[MOST_PIXELS]; /* those of `worst` */
	unsigned n = 0;

	for (size_t i = 0; i < (size_t)ref->width * ref->height; i++) {
		const int d = score_code_difference(v->shown.rgb + 3 * i, ref->rgb + 3 * i);
		unsigned at;

		if (d <= SCORE_CODES || (n == MOST_PIXELS && d <= difference[n - 1]) || call_at(v, i) != call)
			continue;
		/* Insert it in order; the last one is dropped if the list is full. */
		for (at = n < MOST_PIXELS ? n++ : n - 1; at > 0 && difference[at - 1] < d; at--) {
			difference[at] = difference[at - 1];
			worst[at] = worst[at - 1];
		}
		difference[at] = d;
		worst[at] = i;
	}
	return n;
}

/* @param n  receives the number of pixels noted */
static int write_note(const struct rendering *v, const struct score_picture *ref, uint64_t call, const char *path,
                      unsigned *n)
{
	size_t worst[MOST_PIXELS];
	FILE *out = fopen(path, "w");

	if (!out)
		return err_report(ERR_SYSTEM, path, "cannot be written");
	*n = find_worst(v, ref, call, worst);
	fprintf(out, "%" PRIu64 " %u %u\n", call, v->shown.width, v->shown.height);
	for (unsigned i = 0; i < *n; i++) {
		const uint8_t *c = v->shown.rgb + 3 * worst[i];

		fprintf(out, "%zu %u %u %u\n", worst[i], c[0], c[1], c[2]);
	}
	return ferror(out) | fclose(out) ? err_report(ERR_SYSTEM, path, "cannot be written") : 0;
}

int wrong_again(const char *note, const char *trace, uint64_t frame, uint64_t call)
{
	struct rendering v = { .shown = { .width = 0 } };
	FILE *in = fopen(note, "r");
	uint64_t noted; /* the call's number in the note's recording, which may differ from this one's */
	unsigned width, height, c[3];
	size_t i;
	int err = in && fscanf(in, "%" SCNu64 " %u %u", &noted, &width, &height) == 3 ?
	                  0 :
	                  err_report(ERR_SYSTEM, note, "cannot be read"),
	    same = 0;

	if (!err)
		err = render_frame(trace, frame, &v);
	if (!err)
		same = v.shown.width == width && v.shown.height == height;
	while (same && fscanf(in, "%zu %u %u %u", &i, &c[0], &c[1], &c[2]) == 4) {
		const uint8_t *shown = v.shown.rgb + 3 * i;

		same = call_at(&v, i) == call && shown[0] == c[0] && shown[1] == c[1] && shown[2] == c[2];
	}
	free_rendering(&v);
	if (in && ferror(in) && !err)
		err = err_report(ERR_SYSTEM, note, "cannot be read");
	if (in)
		fclose(in);
	/* Without the frame, there is no such fault. */
	return err == ERR_USAGE ? 0 : err ? err : same;
}

/* --- The fault --------------------------------------------------------------------------------------------------- */

/* Print the failed gates and the call to blame. */
static void print_fault(const struct score *s, const struct scene_draw *draw)
{
	fprintf(stderr, "frame %" PRIu64 " fails", s->frame);
	for (int g = 0; g < N_GATES; g++)
		if (s->gates[g].state == SCORE_FAILED)
			fprintf(stderr, " %s", score_gates[g].name);
	fprintf(stderr, "; %s (call %" PRIu64 ") is to blame for %" PRIu64 " pixel%s\n", draw->call, draw->call_number,
	        s->blame[0].pixels, plural(s->blame[0].pixels));
}

/* Score a frame; note and print the fault of the draw that is blamed first. @return as reduce_note */
static int find_fault(const struct rendering *v, struct score_picture *ref, uint64_t frame, const char *trace,
                 const char *note)
{
	static const struct score_options options = { .channel = "gl" };
	struct score score = { .frame = frame };
	uint32_t draw;
	unsigned pixels = 0;
	int err;

	if (ref->width != v->shown.width || ref->height != v->shown.height)
		return err_report(ERR_USAGE, trace, "frame %" PRIu64 " and its reference have different sizes", frame);
	err = score_frame(ref, &v->single.image, frame, &options, NULL, &score);
	if (err)
		return err;
	if (score.outcome == SCORE_FRAME_PASSED)
		return err_report(ERR_USAGE, trace, "frame %" PRIu64 " passes all gates: there is nothing to look for", frame);
	draw = score.n_blame ? score.blame[0].draw : 0;
	if (!draw || draw > v->single.scene->n_draws)
		return err_report(ERR_USAGE, trace,
		                  "frame %" PRIu64 " fails, but no draw is to blame; say what to look for with --when",
		                  frame);
	err = write_note(v, ref, v->single.scene->draws[draw].call_number, note, &pixels);
	if (!err && !pixels)
		err = err_report(ERR_USAGE, trace,
		                 "frame %" PRIu64
		                 " fails only by depth or shapes, not by colours; say what to look for with --when",
		                 frame);
	if (!err)
		print_fault(&score, &v->single.scene->draws[draw]);
	return err;
}

int wrong_note(const char *trace, const char *reference, uint64_t frame, const char *note)
{
	struct set ref = { .name = NULL };
	struct image image = { .width = 0 };
	struct score_picture picture = { .width = 0 };
	struct rendering v = { .shown = { .width = 0 } };
	const struct set_entry *entry;
	int err = set_open(reference, &ref);

	if (!err) {
		entry = ref.is_single ? ref.entries : set_find(&ref, frame);
		err = entry ? set_read(&ref, entry, &image) : err_report(ERR_USAGE, ref.name, "has no frame %" PRIu64, frame);
	}
	if (!err)
		err = picture_take_reference(&image, NULL, &picture);
	if (!err) {
		err = render_frame(trace, frame, &v);
		if (err == ERR_USAGE)
			err_report(err, trace, "has no frame %" PRIu64, frame);
	}
	if (!err)
		err = find_fault(&v, &picture, frame, trace, note);
	free_rendering(&v);
	score_picture_free(&picture);
	image_free(&image);
	set_free(&ref);
	return err;
}
