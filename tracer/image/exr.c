/* Reading and writing struct image as OpenEXR files, with OpenEXRCore (written against 3.1.5; comments name its
 * pitfalls). */
#define IMATH_HALF_NO_LOOKUP_TABLE
#include <errno.h>
#include <half.h>
#include <openexr.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/err.h"
#include "base/part.h"
#include "tracer/image/exr_out.h"
#include "tracer/image/exr_zip.h"
#include "tracer/image/image.h"
#include "tracer/image/pack.h"

#define MAX_PIXELS ((uint64_t)1 << 30)

/* The library's last message on this thread. It reports through a callback; we report once, with the file's name. */
static _Thread_local char exr_said[160];

static void keep_message(exr_const_context_t context, exr_result_t code, const char *message)
{
	(void)context;
	snprintf(exr_said, sizeof(exr_said), "%s", message ? message : exr_get_default_error_message(code));
}

static exr_context_initializer_t context_setup(void)
{
	exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;

	exr_said[0] = '\0';
	setup.error_handler_fn = keep_message;
	return setup;
}

/* Why a call failed, for a message. */
static const char *reason(exr_result_t rc)
{
	return exr_said[0] ? exr_said : exr_get_default_error_message(rc);
}

/* --- Attributes -------------------------------------------------------------------------------------------------- */

/* Is this a standard attribute with a matrix? In struct image its text is 16 numbers in file order. */
static int is_matrix(const char *name)
{
	return strcmp(name, "worldToCamera") == 0 || strcmp(name, "worldToNDC") == 0;
}

static exr_result_t write_matrix(exr_context_t file, const char *name, const char *text)
{
	exr_attr_m44f_t m;
	const char *at = text;
	char *end;

	for (int i = 0; i < 16; i++, at = end) {
		m.m[i] = strtof(at, &end);
		if (end == at)
			return EXR_ERR_INVALID_ARGUMENT;
	}
	return exr_attr_set_m44f(file, 0, name, &m);
}

static exr_result_t write_attributes(exr_context_t file, const struct image *img)
{
	static const exr_attr_chromaticities_t rec709 = { 0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f };
	exr_result_t rc = exr_attr_set_chromaticities(file, 0, "chromaticities", &rec709);

	for (size_t i = 0; i < img->n_attributes && rc == EXR_ERR_SUCCESS; i++) {
		const struct image_attribute *a = &img->attributes[i];

		rc = is_matrix(a->name) ? write_matrix(file, a->name, a->text) :
		                          exr_attr_set_string(file, 0, a->name, a->text);
	}
	return rc;
}

static int read_attributes(exr_context_t file, struct image *img)
{
	int32_t count = 0;
	int rc = 0;

	exr_get_attribute_count(file, 0, &count);
	for (int32_t i = 0; i < count && !rc; i++) {
		const exr_attribute_t *a;

		if (exr_get_attribute_by_index(file, 0, EXR_ATTR_LIST_FILE_ORDER, i, &a) != EXR_ERR_SUCCESS)
			continue;
		if (a->type == EXR_ATTR_STRING && strcmp(a->name, "type") == 0) /* set by the writer */
			continue;
		if (a->type == EXR_ATTR_STRING) {
			rc = image_set_attribute(img, a->name, "%.*s", (int)a->string->length, a->string->str);
		} else if (a->type == EXR_ATTR_M44F) {
			char text[256];
			size_t at = 0;

			for (int k = 0; k < 16 && at < sizeof(text); k++)
				at += (size_t)snprintf(text + at, sizeof(text) - at, k ? " %.7g" : "%.7g",
				                       (double)a->m44f->m[k]);
			rc = image_set_attribute(img, a->name, "%s", text);
		}
	}
	return rc;
}

/* --- Writing ----------------------------------------------------------------------------------------------------- */

static const struct image_channel *find_channel(const struct image *img, const char *name)
{
	for (size_t i = 0; i < img->n_channels; i++)
		if (strcmp(img->channels[i].name, name) == 0)
			return &img->channels[i];
	return NULL;
}

static exr_result_t define_part(exr_context_t file, const struct image *img, const struct pack *pack)
{
	int part;
	exr_result_t rc = exr_add_part(file, "", EXR_STORAGE_SCANLINE, &part);

	if (rc == EXR_ERR_SUCCESS)
		rc = exr_initialize_required_attr_simple(file, part, (int32_t)img->width, (int32_t)img->height,
		                                         EXR_COMPRESSION_ZIP);
	/* NOLINTNEXTLINE(clang-analyzer-core.NullDereference): packed when it is written */
	for (size_t i = 0; i < pack->n_channels && rc == EXR_ERR_SUCCESS; i++)
		rc = exr_add_channel(file, part, pack->sorted[i]->name,
		                     pack->sorted[i]->full_float ? EXR_PIXEL_FLOAT : EXR_PIXEL_HALF,
		                     EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
	return rc;
}

static exr_result_t write_chunks(exr_context_t file, const struct pack *pack)
{
	exr_result_t rc = EXR_ERR_SUCCESS;

	for (uint32_t i = 0; i < pack->n_chunks && rc == EXR_ERR_SUCCESS; i++)
		rc = exr_write_scanline_chunk(file, 0, (int)(i * PACK_ROWS), pack->chunks[i].bytes, pack->chunks[i].n);
	return rc;
}

static exr_result_t write_part(exr_context_t file, const struct image *img, const struct pack *pack)
{
	exr_result_t rc = define_part(file, img, pack);

	if (rc == EXR_ERR_SUCCESS)
		rc = write_attributes(file, img);
	if (rc == EXR_ERR_SUCCESS)
		rc = exr_write_header(file);
	return rc == EXR_ERR_SUCCESS ? write_chunks(file, pack) : rc;
}

/* Write a packed picture under a temporary name. */
static int write_file(const struct image *img, const struct pack *pack, const char *temporary, const char *path)
{
	exr_context_initializer_t setup = context_setup();
	struct exr_out *out = malloc(sizeof(*out));
	exr_context_t file = NULL;
	exr_result_t rc = EXR_ERR_SUCCESS, closed;
	int err = 0;

	if (!out)
		return err_report(ERR_SYSTEM, path, "out of memory");
	if (exr_out_open(out, temporary, &setup)) {
		err = err_report(ERR_SYSTEM, path, "cannot be written: %s", strerror(out->reason));
	} else {
		rc = exr_start_write(&file, temporary, EXR_WRITE_FILE_DIRECTLY, &setup);
		if (rc == EXR_ERR_SUCCESS)
			rc = write_part(file, img, pack);
		closed = file ? exr_finish(&file) : EXR_ERR_SUCCESS;
		rc = rc == EXR_ERR_SUCCESS ? closed : rc;
		if (exr_out_close(out) || rc != EXR_ERR_SUCCESS)
			err = err_report(ERR_SYSTEM, path, "cannot be written: %s", out->reason ? strerror(out->reason) : reason(rc));
	}
	free(out);
	return err;
}

int image_write_exr(const struct image *img, const char *path)
{
	struct pack *made = NULL;
	struct stat status;
	char temporary[4096];
	int err = 0;

	if (img->width == 0 || img->height == 0 || img->n_channels == 0)
		return err_report(ERR_SYSTEM, path, "an empty image cannot be written");
	if (stat(path, &status) == 0 && S_ISDIR(status.st_mode))
		return err_report(ERR_SYSTEM, path, "cannot be written: it is a directory");
	if (!img->pack)
		err = pack_create(img, 1, &made);
	if (made)
		err = pack_until(made, img, NULL, 0, img->height);
	if (!err)
		err = part_begin(path, temporary, sizeof(temporary));
	if (!err) {
		err = write_file(img, made ? made : img->pack, temporary, path);
		if (err)
			part_drop(temporary);
		else
			err = part_finish(temporary, path);
	}
	pack_destroy(&made);
	return err;
}

/* --- Reading ----------------------------------------------------------------------------------------------------- */

/* Read size and channels; reject files that struct image cannot represent. */
static int read_layout(exr_context_t file, struct image *img, const char *path, int32_t *y_first)
{
	const exr_attr_chlist_t *channels;
	exr_attr_box2i_t window;
	exr_storage_t storage;
	int parts = 0;
	int64_t width, height;

	if (exr_get_count(file, &parts) != EXR_ERR_SUCCESS || parts != 1 ||
	    exr_get_storage(file, 0, &storage) != EXR_ERR_SUCCESS || storage != EXR_STORAGE_SCANLINE)
		return err_report(ERR_INPUT, path, "is not an OpenEXR file of one scan-line part");
	if (exr_get_data_window(file, 0, &window) != EXR_ERR_SUCCESS ||
	    exr_get_channels(file, 0, &channels) != EXR_ERR_SUCCESS)
		return err_report(ERR_INPUT, path, "has no usable header: %s", reason(EXR_ERR_MISSING_REQ_ATTR));
	width = (int64_t)window.max.x - window.min.x + 1;
	height = (int64_t)window.max.y - window.min.y + 1;
	if (width < 1 || height < 1 || (uint64_t)width * (uint64_t)height > MAX_PIXELS)
		return err_report(ERR_INPUT, path, "has an impossible size");
	img->width = (uint32_t)width;
	img->height = (uint32_t)height;
	*y_first = window.min.y;
	for (int i = 0; i < channels->num_channels; i++) {
		const exr_attr_chlist_entry_t *c = &channels->entries[i];

		if (c->x_sampling != 1 || c->y_sampling != 1)
			return err_report(ERR_INPUT, path, "is not supported: channel %s is subsampled", c->name.str);
		if (c->name.length >= (int)sizeof(img->channels->name))
			return err_report(ERR_INPUT, path, "channel name %s is too long", c->name.str);
		if (!image_add_channel(img, c->name.str, c->pixel_type != EXR_PIXEL_HALF))
			return ERR_SYSTEM;
	}
	return 0;
}

/* Convert unsigned integers to floats in place: OpenEXRCore's pipeline does not. */
static void floats_from_uints(float *values, size_t n)
{
	for (size_t i = 0; i < n; i++) {
		uint32_t u;

		memcpy(&u, &values[i], sizeof(u));
		values[i] = (float)u;
	}
}

static exr_result_t read_chunk(exr_context_t file, const struct image *img, exr_decode_pipeline_t *decode,
                               struct exr_zip *zip, int32_t y_first, int32_t row)
{
	exr_compression_t compression;
	exr_chunk_info_t chunk;
	exr_result_t rc = exr_read_scanline_chunk_info(file, 0, y_first + row, &chunk);

	if (rc != EXR_ERR_SUCCESS)
		return rc;
	rc = row ? exr_decoding_update(file, 0, &chunk, decode) : exr_decoding_initialize(file, 0, &chunk, decode);
	if (rc != EXR_ERR_SUCCESS)
		return rc;
	for (int i = 0; i < decode->channel_count; i++) {
		exr_coding_channel_info_t *c = &decode->channels[i];
		float *values = find_channel(img, c->channel_name)->values;

		c->user_data_type = c->data_type == EXR_PIXEL_UINT ? EXR_PIXEL_UINT : EXR_PIXEL_FLOAT;
		c->user_bytes_per_element = sizeof(float);
		c->user_pixel_stride = sizeof(float);
		c->user_line_stride = (int32_t)(img->width * sizeof(float));
		c->decode_to_ptr = (uint8_t *)(values + (size_t)row * img->width);
	}
	if (row == 0) {
		rc = exr_decoding_choose_default_routines(file, 0, decode);
		if (rc == EXR_ERR_SUCCESS)
			rc = exr_get_compression(file, 0, &compression);
		if (rc != EXR_ERR_SUCCESS)
			return rc;
		if (compression == EXR_COMPRESSION_ZIP || compression == EXR_COMPRESSION_ZIPS)
			exr_zip_decode_with(decode, zip);
	}
	rc = exr_decoding_run(file, 0, decode);
	for (int i = 0; i < decode->channel_count && rc == EXR_ERR_SUCCESS; i++)
		if (decode->channels[i].data_type == EXR_PIXEL_UINT)
			floats_from_uints((float *)(void *)decode->channels[i].decode_to_ptr,
			                  (size_t)img->width * (size_t)chunk.height);
	return rc;
}

static exr_result_t read_chunks(exr_context_t file, const struct image *img, int32_t y_first)
{
	/* OpenEXR 3.4's initializer sets only the size, which GCC warns about. */
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
	exr_decode_pipeline_t decode = EXR_DECODE_PIPELINE_INITIALIZER;
#pragma GCC diagnostic pop
	struct exr_zip zip = { 0 };
	int32_t rows = 1;
	exr_result_t rc = exr_get_scanlines_per_chunk(file, 0, &rows);

	for (int32_t row = 0; row < (int32_t)img->height && rc == EXR_ERR_SUCCESS; row += rows)
		rc = read_chunk(file, img, &decode, &zip, y_first, row);
	exr_decoding_destroy(file, &decode);
	exr_zip_free(&zip);
	return rc;
}

int image_check_exr(const char *path)
{
	exr_context_initializer_t setup = context_setup();
	exr_context_t file = NULL;
	exr_result_t rc = exr_start_read(&file, path, &setup);

	if (rc != EXR_ERR_SUCCESS)
		return err_report(ERR_INPUT, path, "is not a readable OpenEXR file: %s", reason(rc));
	exr_finish(&file);
	return 0;
}

int image_exr_is_dwa(const char *path)
{
	exr_context_initializer_t setup = context_setup();
	exr_compression_t compression;
	exr_context_t file = NULL;
	int is_dwa;

	if (exr_start_read(&file, path, &setup) != EXR_ERR_SUCCESS)
		return 0;
	is_dwa = exr_get_compression(file, 0, &compression) == EXR_ERR_SUCCESS &&
		(compression == EXR_COMPRESSION_DWAA || compression == EXR_COMPRESSION_DWAB);
	exr_finish(&file);
	return is_dwa;
}

int image_exr_text(const char *path, const char *attribute, char *text, size_t size)
{
	exr_context_initializer_t setup = context_setup();
	exr_context_t file = NULL;
	const char *found;
	int32_t length;
	int is_there;

	if (exr_start_read(&file, path, &setup) != EXR_ERR_SUCCESS)
		return 0;
	is_there = exr_attr_get_string(file, 0, attribute, &length, &found) == EXR_ERR_SUCCESS && (size_t)length < size;
	if (is_there) {
		memcpy(text, found, (size_t)length);
		text[length] = '\0';
	}
	exr_finish(&file);
	return is_there;
}

/* Read the windows for place.h. @return 0 or ERR_SYSTEM (reported) */
static int read_windows(exr_context_t file, struct image *img)
{
	exr_attr_box2i_t data, display;

	if (exr_get_data_window(file, 0, &data) != EXR_ERR_SUCCESS ||
	    exr_get_display_window(file, 0, &display) != EXR_ERR_SUCCESS)
		return 0;
	if (memcmp(&data, &display, sizeof(data)) == 0)
		return image_attribute(img, "relume:window") ? image_set_attribute(img, "relume:window", "%s", "") : 0;
	return image_set_attribute(img, "relume:window", "%lld %lld %lld %lld", (long long)data.min.x - display.min.x,
	                           (long long)data.min.y - display.min.y, (long long)display.max.x - display.min.x + 1,
	                           (long long)display.max.y - display.min.y + 1);
}

int image_read_exr(struct image *img, const char *path)
{
	exr_context_initializer_t setup = context_setup();
	exr_context_t file = NULL;
	struct stat status;
	exr_result_t rc;
	int32_t y_first = 0;
	int result;

	if (stat(path, &status) != 0)
		return err_report(ERR_INPUT, path, "%s", strerror(errno));
	if (!S_ISREG(status.st_mode))
		return err_report(ERR_INPUT, path, "is not a file");
	rc = exr_start_read(&file, path, &setup);
	if (rc == EXR_ERR_OUT_OF_MEMORY)
		return err_report(ERR_SYSTEM, path, "out of memory");
	if (rc != EXR_ERR_SUCCESS)
		return err_report(ERR_INPUT, path, "is not a readable OpenEXR file: %s", reason(rc));
	result = read_layout(file, img, path, &y_first);
	if (!result)
		result = read_attributes(file, img);
	if (!result)
		result = read_windows(file, img);
	if (!result) {
		rc = read_chunks(file, img, y_first);
		if (rc == EXR_ERR_OUT_OF_MEMORY)
			result = err_report(ERR_SYSTEM, path, "out of memory");
		else if (rc != EXR_ERR_SUCCESS)
			result = err_report(ERR_INPUT, path, "%s: %s",
			                    rc == EXR_ERR_FEATURE_NOT_IMPLEMENTED ? "is not supported" : "is damaged",
			                    reason(rc));
	}
	exr_finish(&file);
	if (result)
		image_free(img);
	return result;
}
