/*
 * The contact sheet: one row for each of a few frames, one column for each picture, labels above. With a baseline,
 * approved, now and difference come first; the reference's columns follow if one of the frames differs from the
 * reference.
 */
#include "diff/report/report.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "diff/report/pictures.h"
#include "tracer/image/display.h"
#include "tracer/image/oiio.h"

enum { MAX_COLUMNS = 7, MAX_ROWS = 4, GAP = 8, LABEL = 22, LETTERS = 13, MAX_CELL = 640, LABEL_SIZE = 160 };

static const enum picture_kind of_change[] = { PICTURE_APPROVED, PICTURE_BEAUTY, PICTURE_CHANGE };
static const enum picture_kind of_reference[] = { PICTURE_REFERENCE, PICTURE_COMPARED, PICTURE_BEAUTY,
	                                          PICTURE_DIFFERENCE };

struct sheet {
	enum picture_kind columns[MAX_COLUMNS];
	int n_columns;
	uint8_t *rgb;
	uint32_t width, height;       /* size of the sheet */
	uint32_t cell_w, cell_h;      /* size of one picture in it */
};

static void draw_text(struct sheet *sheet, uint32_t x, uint32_t y, const char *text, int warn)
{
	static const uint8_t colors[2][3] = { { 220, 220, 220 }, { 255, 120, 100 } };
	struct oiio_label label = { text, (int)x, (int)(y + LABEL - 6), LETTERS, { 0 } };

	memcpy(label.rgb, colors[warn], sizeof(label.rgb));
	/* draws no label without a font */
	oiio_draw_text(&(struct oiio_pixels){ sheet->rgb, sheet->width, sheet->height }, &label);
}

/** Copy a picture into a cell, reduced by box averages if it is larger. */
static void draw_picture(struct sheet *sheet, uint32_t left, uint32_t top, const uint8_t *rgb, uint32_t width,
                         uint32_t height)
{
	uint32_t w = width < sheet->cell_w ? width : sheet->cell_w, h = height < sheet->cell_h ? height : sheet->cell_h;

	for (uint32_t y = 0; y < h; y++) {
		for (uint32_t x = 0; x < w; x++) {
			uint32_t x0 = (uint32_t)((uint64_t)x * width / w), x1 = (uint32_t)((uint64_t)(x + 1) * width / w);
			uint32_t y0 = (uint32_t)((uint64_t)y * height / h), y1 = (uint32_t)((uint64_t)(y + 1) * height / h);
			uint32_t sum[3] = { 0 }, count = (x1 - x0) * (y1 - y0);
			uint8_t *to = sheet->rgb + 3 * ((size_t)(top + y) * sheet->width + left + x);

			for (uint32_t v = y0; v < y1; v++)
				for (uint32_t u = x0; u < x1; u++)
					for (int c = 0; c < 3; c++)
						sum[c] += rgb[3 * ((size_t)v * width + u) + (size_t)c];
			for (int c = 0; c < 3; c++)
				to[c] = (uint8_t)((sum[c] + count / 2) / count);
		}
	}
}

/** Choose up to MAX_ROWS compared frames: failed ones by lowest fidelity first, then passed ones evenly spread. */
static size_t choose_frames(const struct output_run *run, const struct score *out[MAX_ROWS])
{
	size_t n = 0, passed = 0, seen = 0;

	for (; n < MAX_ROWS; n++) {
		const struct score *worst = NULL;

		for (size_t i = 0; i < run->n_scores; i++) {
			const struct score *s = &run->scores[i];
			int taken = 0;

			for (size_t k = 0; k < n; k++)
				taken |= out[k] == s;
			if (s->outcome == SCORE_FRAME_FAILED && !taken && (!worst || s->fidelity < worst->fidelity))
				worst = s;
		}
		if (!worst)
			break;
		out[n] = worst;
	}
	passed = run->counts[SCORE_FRAME_PASSED];
	for (size_t i = 0, first = n, rows = MAX_ROWS - n; i < run->n_scores && n < MAX_ROWS; i++) {
		if (run->scores[i].outcome != SCORE_FRAME_PASSED)
			continue;
		if (seen * rows >= (n - first) * passed)
			out[n++] = &run->scores[i];
		seen++;
	}
	return n;
}

static int fails_beside(const struct score *s, int reference)
{
	for (int g = 0; g < N_GATES; g++)
		if (s->gates[g].state == SCORE_FAILED && (reference ? g != GATE_B : g == GATE_B))
			return 1;
	return 0;
}

static void choose_columns(const struct output_run *run, const struct score *const *rows, size_t n_rows,
                           struct sheet *sheet)
{
	int shows_reference = !run->baseline, shows_beauty = 0;

	for (size_t i = 0; i < n_rows; i++) {
		shows_reference |= run->reference && fails_beside(rows[i], 1);
		/* else the beauty is the compared layer, or shown already */
		shows_beauty |= !run->baseline && strcmp(rows[i]->layer, "beauty") != 0;
	}
	for (size_t c = 0; run->baseline && c < sizeof(of_change) / sizeof(of_change[0]); c++)
		sheet->columns[sheet->n_columns++] = of_change[c];
	for (size_t c = 0; shows_reference && c < sizeof(of_reference) / sizeof(of_reference[0]); c++)
		if (shows_beauty || of_reference[c] != PICTURE_BEAUTY)
			sheet->columns[sheet->n_columns++] = of_reference[c];
}

/* Write a cell's label. @param picture  name of the row @return 1 if it reports a failure */
static int label(const struct sheet *sheet, int column, const struct score *s, const struct picture_frame *frame,
                 const char *picture, char out[LABEL_SIZE])
{
	const enum picture_kind kind = sheet->columns[column];
	const int is_of_change = sheet->columns[0] == PICTURE_APPROVED, failed = fails_beside(s, kind == PICTURE_DIFFERENCE);
	const char *name = picture_names[kind];

	if (kind == PICTURE_APPROVED)
		name = frame->change.was.rgb                        ? "approved" :
		       s->gates[GATE_B].state == SCORE_NOT_MEASURED ? "nothing approved" :
		                                                      "as approved";
	else if (kind == PICTURE_REFERENCE)
		name = "raster";
	else if (kind == PICTURE_COMPARED)
		name = s->layer;
	else if (kind == PICTURE_BEAUTY && is_of_change)
		name = "now";
	if (kind == PICTURE_CHANGE)
		snprintf(out, LABEL_SIZE, "difference x 8: %s", failed ? "changed" : "as approved");
	else if (kind == PICTURE_DIFFERENCE)
		snprintf(out, LABEL_SIZE, "difference x 8: %s, %.2f %%", failed ? "failed" : score_outcome_names[s->outcome],
		         100 * s->fidelity);
	else if (column == 0)
		snprintf(out, LABEL_SIZE, "%s, %s", name, picture);
	else
		snprintf(out, LABEL_SIZE, "%s", name);
	return failed && (kind == PICTURE_CHANGE || kind == PICTURE_DIFFERENCE);
}

static int draw_row(struct sheet *sheet, size_t row, const struct score *s, const struct picture_sources *from)
{
	struct picture_frame frame = { 0 };
	uint32_t top = GAP + (uint32_t)row * (sheet->cell_h + LABEL + GAP);
	int err = picture_frame_read(from, s->frame, &frame);

	for (int c = 0; !err && c < sheet->n_columns; c++) {
		uint32_t left = GAP + (uint32_t)c * (sheet->cell_w + GAP), width, height;
		char picture[LABEL_SIZE / 2], text[LABEL_SIZE];
		uint8_t *rgb;
		int warns;

		err = picture_make(&frame, sheet->columns[c], &rgb, &width, &height);
		if (err || (!rgb && c > 0))
			continue;
		output_name(from->run, s->frame, picture, sizeof(picture));
		warns = label(sheet, c, s, &frame, picture, text);
		draw_text(sheet, left, top, text, warns);
		if (rgb)
			draw_picture(sheet, left, top + LABEL, rgb, width, height);
		free(rgb);
	}
	picture_frame_free(&frame);
	return err;
}

int sheet_write(const struct picture_sources *from, const char *path)
{
	const struct score *rows[MAX_ROWS];
	const size_t n_rows = choose_frames(from->run, rows);
	struct sheet sheet = { .cell_w = 1, .cell_h = 1 };
	int err = 0;

	for (size_t i = 0; i < n_rows; i++) {
		/* the largest frame, reduced to MAX_CELL with its aspect ratio kept */
		double scale = rows[i]->width > MAX_CELL ? (double)MAX_CELL / rows[i]->width : 1;
		uint32_t w = (uint32_t)(rows[i]->width * scale), h = (uint32_t)(rows[i]->height * scale);

		sheet.cell_w = w > sheet.cell_w ? w : sheet.cell_w;
		sheet.cell_h = h > sheet.cell_h ? h : sheet.cell_h;
	}
	choose_columns(from->run, rows, n_rows, &sheet);
	sheet.width = GAP + (uint32_t)sheet.n_columns * (sheet.cell_w + GAP);
	sheet.height = GAP + (uint32_t)n_rows * (sheet.cell_h + LABEL + GAP);
	sheet.rgb = malloc(3 * (size_t)sheet.width * sheet.height);
	if (!sheet.rgb)
		return err_report(ERR_SYSTEM, path, "out of memory");
	memset(sheet.rgb, 40, 3 * (size_t)sheet.width * sheet.height);
	for (size_t i = 0; !err && i < n_rows; i++)
		err = draw_row(&sheet, i, rows[i], from);
	if (!err)
		err = display_save(&(struct oiio_pixels){ sheet.rgb, sheet.width, sheet.height },
		                   &(struct oiio_coding){ "png", .level = 6 }, path);
	free(sheet.rgb);
	return err;
}
