/* Scores one frame: computes the data that the gates share, then runs every gate. */
#include "diff/score/score.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "diff/score/flip.h"
#include "diff/score/measures.h"
#include "diff/score/metrics.h"
#include "diff/score/pair.h"
#include "diff/score/picture.h"

const char *const score_outcome_names[N_SCORE_OUTCOMES] = { "passed", "failed", "flaky", "new", "missing", "extra",
	                                                           "unreadable" };
const char *const score_state_names[N_SCORE_STATES] = { "not measured", "passed", "warned", "failed" };

#define GATE_MEASURE(id, name, title, measure, ...) [GATE_##id] = measure,
static int (*const measures[N_GATES])(struct gate_frame *f) = { SCORE_GATES(GATE_MEASURE) };

/** Copy ignored pixels from the reference, so that measures of whole pictures find no difference there. */
static void copy_ignored(const struct score_picture *ref, const struct score_picture *to)
{
	const size_t n = (size_t)ref->width * ref->height;

	for (size_t i = 0; ref->ignore && i < n; i++)
		if (ref->ignore[i])
			memcpy(to->rgb + 3 * i, ref->rgb + 3 * i, 3);
}

/** Compare the beauty with the reference, for figures that do not affect the outcome. None without a beauty. */
static int measure_beauty(const struct gate_frame *f)
{
	const struct score_picture *ref = f->ref;
	struct score *s = f->score;
	const size_t n = (size_t)ref->width * ref->height;
	struct score_picture beauty = { 0 };
	int err = score_picture_from_image(f->img, "beauty", &beauty);

	if (err)
		return err == ERR_INPUT ? 0 : err; /* ERR_INPUT: there is no such layer */
	if (strcmp(f->layer, "beauty") == 0) /* as the gates compare it: premultiplied if alpha counts */
		memcpy(beauty.rgb, f->traced.rgb, 3 * n);
	copy_ignored(ref, &beauty);
	err = flip_compare(ref->rgb, beauty.rgb, ref->width, ref->height, NULL, &s->info.beauty_flip);
	if (!err)
		err = metric_ms_ssim(ref->rgb, beauty.rgb, ref->width, ref->height, &s->info.beauty_ms_ssim);
	if (!err)
		err = metric_ciede2000_p95(ref->rgb, beauty.rgb, n, &s->info.beauty_ciede_p95);
	s->info.beauty_psnr_db = metric_psnr_db(ref->rgb, beauty.rgb, n);
	score_picture_free(&beauty);
	return err;
}

/** Measure the figures that do not affect the outcome. */
static int measure_info(const struct gate_frame *f)
{
	const struct score_picture *ref = f->ref, *traced = &f->traced;
	const size_t n = (size_t)ref->width * ref->height;
	struct score_info *info = &f->score->info;
	int err = metric_ssim(ref->rgb, traced->rgb, ref->width, ref->height, &info->gl_ssim);

	info->gl_psnr_db = metric_psnr_db(ref->rgb, traced->rgb, n);
	info->gl_rmse = metric_rmse(ref->rgb, traced->rgb, n);
	info->gl_mrse = metric_mrse(ref->rgb, traced->rgb, n);
	if (!err && f->options->yee)
		err = f->options->yee(ref->rgb, traced->rgb, ref->width, ref->height, &info->gl_yee);
	return err ? err : measure_beauty(f);
}

/** Extract the compared layer; fill the maps and counts that several gates use. The caller frees them. */
static int fill_frame(struct gate_frame *f, struct score_picture *ref)
{
	const size_t n = (size_t)f->ref->width * f->ref->height;
	int err = score_picture_from_image(f->img, f->layer, &f->traced);

	if (!err)
		err = score_pair(ref, &f->traced, f->options->ignore_alpha);
	f->blamed = calloc(n ? n : 1, 1);
	if (!err && !f->blamed)
		err = err_report(ERR_SYSTEM, NULL, "out of memory");
	if (!err && f->ref->rgb) {
		copy_ignored(f->ref, &f->traced);
		err = score_make_maps(f->ref, &f->traced, f->options, &f->maps);
		if (err)
			return err;
		memcpy(f->blamed, f->maps.failing, n);
		gate_count_colors(f);
	}
	if (!err)
		gate_count_effects(f);
	return err;
}

/** Measure everything on a valid frame. */
static int measure_frame(struct gate_frame *f, struct score_picture *ref)
{
	int err = fill_frame(f, ref);

	for (int g = GATE_V + 1; !err && g < N_GATES; g++) {
		if (score_gates[g].needs_reference && !f->ref->rgb)
			gate_note(f, (enum score_gate_id)g, "there is no reference");
		else
			err = measures[g](f);
	}
	if (!err && f->ref->rgb)
		err = measure_info(f);
	if (!err)
		err = gate_blame(f);
	if (!err)
		err = gate_programs(f);
	free(f->blamed);
	score_maps_free(&f->maps);
	score_picture_free(&f->traced);
	return err;
}

int score_frame(struct score_picture *ref, const struct image *img, uint64_t frame,
                const struct score_options *options, const struct score_approved *approved, struct score *out)
{
	const float *planes[3];
	struct gate_frame f = { .ref = ref, .img = img, .options = options, .approved = approved, .score = out };
	int err;

	f.layer = options->channel ? options->channel : score_find_layer(img, "gl", planes) ? "gl" : "beauty";
	*out = (struct score){ .frame = frame, .width = ref->width, .height = ref->height };
	/* NAN: not measured */
	out->info = (struct score_info){ NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, { NAN, NAN, NAN, NAN, NAN } };
	snprintf(out->layer, sizeof(out->layer), "%s", f.layer);
	err = measures[GATE_V](&f);
	if (!err && out->gates[GATE_V].state != SCORE_FAILED)
		err = measure_frame(&f, ref);
	else
		for (int g = GATE_V + 1; g < N_GATES; g++)
			gate_note(&f, (enum score_gate_id)g, "the frame is not valid");
	for (int g = 0; g < N_GATES; g++)
		if (out->gates[g].state == SCORE_FAILED)
			out->outcome = SCORE_FRAME_FAILED;
	return err;
}
