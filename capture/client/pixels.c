/* Runs inside the traced program. */
#include "capture/client/pixels.h"

#include <GL/gl.h>
#include <GL/glext.h>

#include "capture/client/content.h"
#include "capture/format/sizes.h"
#include "capture/gl/context.h"
#include "capture/write/values.h"
#include "capture/write/writer.h"

/* The trace has a buffer of ours bound that holds the pixels of the next call. */
static __thread int own_pixels __attribute__((tls_model("initial-exec")));

static const struct layout_names {
	unsigned alignment, row_length, skip_rows, skip_pixels, image_height, skip_images;
} unpack = { GL_UNPACK_ALIGNMENT,   GL_UNPACK_ROW_LENGTH,   GL_UNPACK_SKIP_ROWS,
	     GL_UNPACK_SKIP_PIXELS, GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_IMAGES },
  pack = { GL_PACK_ALIGNMENT,   GL_PACK_ROW_LENGTH,   GL_PACK_SKIP_ROWS,
	   GL_PACK_SKIP_PIXELS, GL_PACK_IMAGE_HEIGHT, GL_PACK_SKIP_IMAGES };

static struct pixel_layout read_layout(const struct layout_names *names)
{
	struct pixel_layout layout = { .alignment = context_get(names->alignment) };

	if (context_has(HAS_DESKTOP)) {
		layout.row_length = context_get(names->row_length);
		layout.skip_rows = context_get(names->skip_rows);
		layout.skip_pixels = context_get(names->skip_pixels);
	}
	if (context_has(HAS_3D)) {
		layout.image_height = context_get(names->image_height);
		layout.skip_images = context_get(names->skip_images);
	}
	return layout;
}

/* Handed over */

int pixels_in_buffer(void)
{
	return context_has(HAS_PIXEL_BUFFERS) && context_get(GL_PIXEL_UNPACK_BUFFER_BINDING);
}

uint8_t *put_image(uint8_t *p, const void *pixels, const struct pixel_box *box)
{
	struct pixel_layout layout;

	if (!pixels || own_pixels)
		return put_null(p);
	if (pixels_in_buffer())
		return put_opaque(p, pixels);
	layout = read_layout(&unpack);
	return put_blob(p, pixels, image_bytes(&layout, box));
}

void pixels_used(const void *pixels, const struct pixel_box *box)
{
	struct pixel_layout layout;
	unsigned buffer;
	int bound = 0;

	if (!pixels || !writer_active() || !context_has(HAS_PIXEL_BUFFERS) || !context_has(HAS_FIXED_FUNCTION) ||
	    pixels_in_buffer())
		return;
	layout = read_layout(&unpack);
	buffer = content_of_memory(GL_PIXEL_UNPACK_BUFFER, pixels, image_bytes(&layout, box), &bound);
	if (buffer && !bound)
		content_bind(GL_PIXEL_UNPACK_BUFFER, buffer);
	own_pixels = buffer != 0;
}

void pixels_written(void)
{
	if (own_pixels)
		content_bind(GL_PIXEL_UNPACK_BUFFER, 0);
	own_pixels = 0;
}

long pixels_stipple_count(void)
{
	struct pixel_layout layout = read_layout(&unpack);

	return image_bytes(&layout, &(struct pixel_box){ 2, GL_COLOR_INDEX, GL_BITMAP, 32, 32, 1 });
}

/* Read back */

static int is_packed_in_buffer(void)
{
	return context_has(HAS_PIXEL_BUFFERS) && context_get(GL_PIXEL_PACK_BUFFER_BINDING);
}

uint8_t *put_returned(uint8_t *p, const void *data, long bytes)
{
	return bytes < 0 ? put_opaque(p, data) : put_blob(p, data, bytes);
}

static long packed_bytes(const struct pixel_box *box)
{
	struct pixel_layout layout;

	if (is_packed_in_buffer() || !context_current())
		return -1;
	layout = read_layout(&pack);
	return image_bytes(&layout, box);
}

long pixels_read_bytes(unsigned format, unsigned type, int width, int height)
{
	return packed_bytes(&(struct pixel_box){ 2, format, type, width, height, 1 });
}

/* If the program's call was an error, these queries may be errors, too. */
long pixels_texture_bytes(unsigned target, int level, unsigned format, unsigned type)
{
	struct pixel_box box = { .dims = 2, .format = format, .type = type, .depth = 1 };

	if (!context_has(HAS_DESKTOP))
		return -1;
	context_errors_before();
	box.width = context_get_level(target, level, GL_TEXTURE_WIDTH);
	box.height = context_get_level(target, level, GL_TEXTURE_HEIGHT);
	if (target == GL_TEXTURE_1D)
		box.dims = 1;
	else if (target == GL_TEXTURE_3D || target == GL_TEXTURE_2D_ARRAY || target == GL_TEXTURE_CUBE_MAP_ARRAY)
		box.dims = 3;
	if (box.dims == 3 && context_has(HAS_3D))
		box.depth = context_get_level(target, level, GL_TEXTURE_DEPTH);
	context_errors_after();
	return packed_bytes(&box);
}

long pixels_compressed_bytes(unsigned target, int level)
{
	int bytes = 0;

	if (is_packed_in_buffer() || !context_has(HAS_DESKTOP))
		return -1;
	context_errors_before();
	if (context_get_level(target, level, GL_TEXTURE_COMPRESSED))
		bytes = context_get_level(target, level, GL_TEXTURE_COMPRESSED_IMAGE_SIZE);
	context_errors_after();
	return bytes;
}
