#include "diff/report.h"

#include <inttypes.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/folder.h"
#include "diff/oiio.h"
#include "diff/pictures.h"

/* Where the data goes in the page. */
#define DATA_MARKER "/*DATA*/"

enum { PASSED_SAMPLE = 12, PNG_LEVEL = 6 };
#define PICTURE_BUDGET ((size_t)64 << 20)

static void write_base64(const uint8_t *bytes, size_t n, FILE *out)
{
	static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

	for (size_t i = 0; i < n; i += 3) {
		uint32_t v = (uint32_t)bytes[i] << 16 | (i + 1 < n ? (uint32_t)bytes[i + 1] << 8 : 0) |
			(i + 2 < n ? bytes[i + 2] : 0u);
		char text[4] = { digits[v >> 18], digits[v >> 12 & 63], i + 1 < n ? digits[v >> 6 & 63] : '=',
		                 i + 2 < n ? digits[v & 63] : '=' };

		fwrite(text, 1, sizeof(text), out);
	}
}

/** One frame's pictures as members of the page's table of pictures; *used grows by what they take. */
static int write_pictures(struct set *ref, struct set *traced, uint64_t number, const struct output_run *run,
                          FILE *out, size_t *used)
{
	struct picture_frame frame = { 0 };
	int err = picture_frame_read(ref, traced, number, run, &frame);

	if (err)
		goto fail;
	fprintf(out, "pictures[%" PRIu64 "] = {", number);
	for (int kind = 0; !err && kind < N_PICTURES; kind++) {
		uint8_t *rgb, *png;
		uint32_t width, height;
		size_t bytes;

		err = picture_make(&frame, (enum picture_kind)kind, &rgb, &width, &height);
		if (err || !rgb)
			continue;
		err = oiio_encode_png(rgb, width, height, 3, PNG_LEVEL, &png, &bytes);
		free(rgb);
		if (err)
			continue;
		fprintf(out, "\n\"%s\": \"data:image/png;base64,", picture_names[kind]);
		write_base64(png, bytes, out);
		fputs("\",", out);
		free(png);
		*used += bytes / 3 * 4;
	}
	fputs("};\n", out);
fail:
	picture_frame_free(&frame);
	/* a frame that cannot be read has been scored as such: the page goes on without its pictures */
	return err == ERR_INPUT ? 0 : err;
}

static int was_compared(const struct score *s)
{
	return s->outcome == SCORE_FRAME_PASSED || s->outcome == SCORE_FRAME_FAILED;
}

/** Pictures of failed frames until the budget is spent, then of frames that passed, evenly spread. */
static int write_all_pictures(const struct output_run *run, struct set *ref, struct set *traced, FILE *out)
{
	uint64_t n_passed = run->counts[SCORE_FRAME_PASSED], seen = 0, taken = 0;
	size_t used = 0;
	int err = 0;

	for (size_t i = 0; !err && i < run->n_scores && used < PICTURE_BUDGET; i++)
		if (run->scores[i].outcome == SCORE_FRAME_FAILED)
			err = write_pictures(ref, traced, run->scores[i].frame, run, out, &used);
	for (size_t i = 0; !err && i < run->n_scores && used < PICTURE_BUDGET; i++) {
		const struct score *s = &run->scores[i];

		if (s->outcome != SCORE_FRAME_PASSED)
			continue;
		/* the k-th sample is taken at place k * n / SAMPLE */
		if (n_passed <= PASSED_SAMPLE || seen * PASSED_SAMPLE >= taken * n_passed) {
			err = write_pictures(ref, traced, s->frame, run, out, &used);
			taken++;
		}
		seen++;
	}
	return err;
}

static int write_page(const struct output_run *run, struct set *ref, struct set *traced, const char *path)
{
	const char *marker = strstr(report_page, DATA_MARKER);
	struct output_file file;
	int err;

	if (output_open(&file, path) != 0)
		return ERR_SYSTEM;
	fwrite(report_page, 1, (size_t)(marker - report_page), file.stream);
	fputs("const run = ", file.stream);
	output_json_stream(run, file.stream);
	fputs(";\nconst pictures = {};\n", file.stream);
	err = write_all_pictures(run, ref, traced, file.stream);
	fputs(marker + strlen(DATA_MARKER), file.stream);
	if (err) {
		output_close(&file, 0);
		return err;
	}
	return output_close(&file, 1);
}

int report_write(const struct output_run *run, struct set *ref, struct set *traced, const char *dir)
{
	char path[PATH_MAX];
	int compared = 0;
	int err = folder_make(dir);

	if (err)
		return err;
	for (size_t i = 0; i < run->n_scores; i++)
		compared |= was_compared(&run->scores[i]);
	if (snprintf(path, sizeof(path), "%s/index.html", dir) >= (int)sizeof(path))
		return err_report(ERR_SYSTEM, dir, "the name is too long");
	err = write_page(run, ref, traced, path);
	if (err || !compared)
		return err;
	if (snprintf(path, sizeof(path), "%s/sheet.png", dir) >= (int)sizeof(path))
		return err_report(ERR_SYSTEM, dir, "the name is too long");
	return sheet_write(run, ref, traced, path);
}
