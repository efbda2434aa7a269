/* Writes the report's page: data, pictures and film inserted into page.html. */
#include "diff/report/report.h"

#include <errno.h>
#include <inttypes.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/base64.h"
#include "base/err.h"
#include "base/folder.h"
#include "base/part.h"
#include "diff/report/ordered.h"
#include "diff/report/pictures.h"
#include "diff/report/roles.h"
#include "tracer/image/oiio.h"

/* markers in the page for the data and the pictures */
#define DATA_MARKER "/*DATA*/"
#define PICTURES_MARKER "<!--PICTURES-->"

enum { PASSED_SAMPLE = 12, PNG_LEVEL = 6, THUMBNAIL = 80, BLAMED = 3, BLAME_SIZE = 200 };
#define PICTURE_BUDGET ((size_t)64 << 20)
#define PASSED_BUDGET ((size_t)16 << 20) /* for frames that passed, beyond the sample: pages stay quick to open */

static void write_png(const char *name, const uint8_t *png, size_t bytes, FILE *out, size_t *used)
{
	fprintf(out, "%s\n\"%s\": \"data:image/png;base64,", *used ? "," : "", name);
	base64_write(png, bytes, out);
	fputs("\"", out);
	*used += bytes / 3 * 4;
}

/** Encode a picture and write it; frees rgb. */
static int write_picture(const char *name, uint8_t *rgb, uint32_t width, uint32_t height, FILE *out, size_t *used)
{
	uint8_t *png;
	size_t bytes;
	int err = oiio_encode(&(struct oiio_pixels){ rgb, width, height },
	                      &(struct oiio_coding){ "png", .level = PNG_LEVEL }, &png, &bytes);

	free(rgb);
	if (err)
		return err;
	write_png(name, png, bytes, out, used);
	free(png);
	return 0;
}

/*
 * Place a window in a box where it shows most marked pixels: the box of scattered pixels may be mostly empty.
 * @param corner  the box's first pixel; receives the window's
 */
static void place_window(const uint8_t *marked, uint32_t width, const uint32_t box[2], const uint32_t size[2],
                         uint32_t corner[2])
{
	enum { STEP = BLAME_SIZE / 4 };
	const uint32_t first[2] = { corner[0], corner[1] };
	uint64_t most = 0;

	for (uint32_t y = first[1]; y + size[1] <= first[1] + box[1]; y += STEP)
		for (uint32_t x = first[0]; x + size[0] <= first[0] + box[0]; x += STEP) {
			uint64_t count = 0;

			for (uint32_t v = y; v < y + size[1]; v++)
				for (uint32_t u = x; u < x + size[0]; u++)
					count += marked[(size_t)v * width + u];
			if (count > most) {
				most = count;
				corner[0] = x;
				corner[1] = y;
			}
		}
}

/* Write three pictures of a blamed draw's surroundings, side by side: before, now, and failing pixels. */
static int write_blame(const struct picture_frame *frame, const struct score *s, unsigned number, FILE *out,
                       size_t *used)
{
	enum { MARGIN = 12, GAP = 4, SIDES = 3 };
	static const enum picture_kind sides[2][SIDES] = { { PICTURE_REFERENCE, PICTURE_COMPARED, PICTURE_FAILING },
	                                                   { PICTURE_APPROVED, PICTURE_BEAUTY, PICTURE_CHANGED } };
	const struct score_blame *blame = &s->blame[number];
	const int is_of_change = s->gates[GATE_B].state == SCORE_FAILED && frame->change.off;
	const uint8_t *marked = is_of_change ? frame->change.off : frame->maps.failing;
	uint32_t corner[2] = { blame->x0 > MARGIN ? blame->x0 - MARGIN : 0, blame->y0 > MARGIN ? blame->y0 - MARGIN : 0 };
	uint32_t box[2] = { blame->x1 + MARGIN + 1 - corner[0], blame->y1 + MARGIN + 1 - corner[1] }, size[2], width;
	uint8_t *out_rgb;
	char name[16];

	if (!marked)
		return 0;
	for (int k = 0; k < 2; k++) {
		const uint32_t room = (k ? frame->ref.height : frame->ref.width) - corner[k];

		box[k] = box[k] < room ? box[k] : room;
		size[k] = box[k] < BLAME_SIZE ? box[k] : BLAME_SIZE;
	}
	place_window(marked, frame->ref.width, box, size, corner);
	width = SIDES * size[0] + (SIDES - 1) * GAP;
	out_rgb = calloc((size_t)width * size[1], 3);
	if (!out_rgb)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t k = 0; k < SIDES; k++) {
		uint32_t full_width, full_height;
		uint8_t *rgb;
		int err = picture_make(frame, sides[is_of_change][k], &rgb, &full_width, &full_height);

		if (err) {
			free(out_rgb);
			return err;
		}
		for (uint32_t y = 0; rgb && y < size[1]; y++)
			memcpy(out_rgb + 3 * ((size_t)y * width + k * (size[0] + GAP)),
			       rgb + 3 * ((size_t)(corner[1] + y) * full_width + corner[0]), 3 * (size_t)size[0]);
		free(rgb);
	}
	snprintf(name, sizeof(name), "blame %u", number);
	return write_picture(name, out_rgb, width, size[1], out, used);
}

/* Write a thumbnail of the current frame: the beauty if it differs from the approved one, else the compared layer. */
static int write_thumbnail(const struct picture_frame *frame, FILE *out, size_t *used)
{
	const struct score_picture *shown = frame->change.off || !frame->compared.rgb ? &frame->change.now : &frame->compared;
	const uint32_t width = shown->width, height = shown->height;
	const uint32_t step = width / THUMBNAIL > 1 ? width / THUMBNAIL : 1, w = width / step, h = height / step;
	uint8_t *rgb = shown->rgb ? malloc(3 * (size_t)w * h + 1) : NULL;

	if (!shown->rgb)
		return 0;
	if (!rgb)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (uint32_t y = 0; y < h; y++)
		for (uint32_t x = 0; x < w; x++)
			for (uint32_t c = 0; c < 3; c++) {
				uint32_t sum = 0;

				for (uint32_t v = 0; v < step; v++)
					for (uint32_t u = 0; u < step; u++)
						sum += shown->rgb[3 * ((size_t)(y * step + v) * width + x * step + u) + c];
				rgb[3 * ((size_t)y * w + x) + c] = (uint8_t)((sum + step * step / 2) / (step * step));
			}
	return write_picture("thumbnail", rgb, w, h, out, used);
}

/* Write text with the characters that JSON and HTML accept unescaped. */
static void write_text(const char *text, FILE *out)
{
	for (; *text; text++)
		if (strchr("\"\\<>&", *text) || (unsigned char)*text < ' ')
			fprintf(out, "\\u%04x", (unsigned char)*text);
		else
			fputc(*text, out);
}

/* Write the rules' findings for the frame, each with a picture. */
static int write_roles(const struct picture_frame *frame, FILE *out, size_t *used)
{
	struct role role;
	int err = 0;

	for (unsigned i = 0; !err && roles_read(frame, i, &role); i++) {
		char name[24];
		uint8_t *rgb;

		snprintf(name, sizeof(name), "role %u", i);
		err = roles_paint(frame, &role, &rgb);
		if (!err && rgb)
			err = write_picture(name, rgb, frame->image.width, frame->image.height, out, used);
		fprintf(out, "%s\n\"finding %u\": [\"%s\"", *used ? "," : "", i, role.is_light ? "light" : "surface");
		for (int k = 0; k < 3; k++) {
			fputs(", \"", out);
			write_text(k == 0 ? role.role : k == 1 ? role.confidence : role.why, out);
			fputs("\"", out);
		}
		fputs("]", out);
	}
	return err;
}

/* Frames with pictures on the page; those that did not pass come first. */
struct pictures {
	const struct picture_sources *from;
	const struct score **scores;
	size_t n_first; /* number shown first: all that did not pass, and an evenly spread sample of those that passed */
	size_t n;
};

/**
 * Write one frame's pictures as a block of JSON, which the page reads only when the frame is viewed. Without `whole`,
 * only the thumbnail. *used: size of the pictures.
 */
static int write_pictures(const struct pictures *p, const struct score *s, int whole, FILE *out, size_t *used)
{
	struct picture_frame frame = { 0 };
	int err = picture_frame_read(p->from, s->frame, &frame);

	*used = 0;
	if (err)
		goto fail;
	fprintf(out, "<script type=\"application/json\" id=\"p%" PRIu64 "\">{", s->frame);
	err = write_thumbnail(&frame, out, used);
	for (int kind = 0; whole && !err && kind < N_PICTURES; kind++) {
		uint8_t *rgb;
		uint32_t width, height;

		err = picture_make(&frame, (enum picture_kind)kind, &rgb, &width, &height);
		if (!err && rgb)
			err = write_picture(picture_names[kind], rgb, width, height, out, used);
	}
	for (unsigned b = 0; whole && !err && b < s->n_blame && b < BLAMED; b++)
		err = write_blame(&frame, s, b, out, used);
	if (whole && !err)
		err = write_roles(&frame, out, used);
	fputs("}</script>\n", out);
fail:
	picture_frame_free(&frame);
	return err;
}

/** Frames beyond the budget only get a thumbnail. */
static int make_pictures(void *context, size_t i, size_t spent, FILE *out, size_t *cost)
{
	const struct pictures *p = context;

	return write_pictures(p, p->scores[i], spent < (i < p->n_first ? PICTURE_BUDGET : PASSED_BUDGET), out, cost);
}

/* Add frames that passed: an evenly spread sample (is_sample), or all others. */
static void add_passed(const struct output_run *run, int is_sample, struct pictures *p)
{
	const uint64_t n_passed = run->counts[SCORE_FRAME_PASSED];
	uint64_t seen = 0;

	for (size_t i = 0; i < run->n_scores; i++) {
		if (run->scores[i].outcome != SCORE_FRAME_PASSED)
			continue;
		/* the k-th sample is taken at position k * n / SAMPLE */
		if ((n_passed <= PASSED_SAMPLE || seen * PASSED_SAMPLE % n_passed < PASSED_SAMPLE) == is_sample)
			p->scores[p->n++] = &run->scores[i];
		seen++;
	}
}

/* Without a reference and without approved frames there are figures, but no pictures to show side by side. */
static int has_pictures(const struct output_run *run)
{
	return run->reference || run->baseline;
}

static int write_all_pictures(const struct picture_sources *from, FILE *out)
{
	const struct output_run *run = from->run;
	struct pictures p = { .from = from };
	int err;

	if (!has_pictures(run))
		return 0;
	p.scores = calloc(run->n_scores + 1, sizeof(*p.scores));
	if (!p.scores)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	for (size_t i = 0; i < run->n_scores; i++)
		if (output_is_compared(&run->scores[i]) && run->scores[i].outcome != SCORE_FRAME_PASSED)
			p.scores[p.n++] = &run->scores[i];
	add_passed(run, 1, &p);
	p.n_first = p.n;
	add_passed(run, 0, &p);
	err = ordered_write(p.n, make_pictures, &p, out);
	free(p.scores);
	return err;
}

/* Write the film of the frames, for the page to play. */
static int write_film(const char *path, FILE *out)
{
	const size_t n = strlen(path);
	const char *kind = n > 4 && strcasecmp(path + n - 4, ".mp4") == 0 ? "mp4" : "webm";
	uint8_t piece[3 * 4096]; /* complete base64 groups */
	FILE *film = fopen(path, "rb");
	size_t got;
	int err = 0;

	if (!film)
		return err_report(ERR_INPUT, path, "%s", strerror(errno));
	fprintf(out, "<script type=\"application/json\" id=\"film\">\"data:video/%s;base64,", kind);
	while ((got = fread(piece, 1, sizeof(piece), film)))
		base64_write(piece, got, out);
	fputs("\"</script>\n", out);
	if (ferror(film))
		err = err_report(ERR_SYSTEM, path, "cannot be read: %s", strerror(errno));
	fclose(film);
	return err;
}

static int write_page(const struct picture_sources *from, const char *path)
{
	const struct output_run *run = from->run;
	const char *marker = strstr(report_page, DATA_MARKER), *place = strstr(marker, PICTURES_MARKER), *rest;
	struct part_file file;
	int err = part_open(&file, path);

	if (err)
		return err;
	fwrite(report_page, 1, (size_t)(marker - report_page), file.stream);
	fputs("const run = ", file.stream);
	output_json_stream(run, file.stream);
	fputs(";\n", file.stream);
	rest = marker + strlen(DATA_MARKER);
	fwrite(rest, 1, (size_t)(place - rest), file.stream);
	err = write_all_pictures(from, file.stream);
	if (!err && run->film)
		err = write_film(run->film, file.stream);
	fputs(place + strlen(PICTURES_MARKER), file.stream);
	return part_close(&file, err);
}

int report_write(const struct picture_sources *from, const char *dir)
{
	const struct output_run *run = from->run;
	char path[PATH_MAX];
	int compared = 0;
	int err = folder_make(dir);

	if (err)
		return err;
	for (size_t i = 0; i < run->n_scores; i++)
		compared |= has_pictures(run) && output_is_compared(&run->scores[i]);
	if (snprintf(path, sizeof(path), "%s/index.html", dir) >= (int)sizeof(path))
		return err_report(ERR_SYSTEM, dir, "the name is too long");
	err = write_page(from, path);
	if (err || !compared)
		return err;
	if (snprintf(path, sizeof(path), "%s/sheet.png", dir) >= (int)sizeof(path))
		return err_report(ERR_SYSTEM, dir, "the name is too long");
	return sheet_write(from, path);
}
