/*
 * Runs inside the traced program. What the program reads back: how much of it there is.
 *
 * Readers of the trace need none of it to draw, but whoever studies a program does. Asked after the call, from the driver.
 */
#include <GL/gl.h>
#include <GL/glext.h>

#include "capture/gl/wrap.h"

static int in_buffer(void)
{
	return context_has(HAS_PIXEL_BUFFERS) && context_get(GL_PIXEL_PACK_BUFFER_BINDING);
}

uint8_t *put_returned(uint8_t *p, const void *data, long bytes)
{
	return bytes < 0 ? put_opaque(p, data) : put_blob(p, data, bytes);
}

static long packed_bytes(int dims, unsigned format, unsigned type, int width, int height, int depth)
{
	struct pixel_layout layout = { .alignment = context_get(GL_PACK_ALIGNMENT) };

	if (in_buffer() || !context_is_current())
		return -1;
	if (context_has(HAS_DESKTOP)) {
		layout.row_length = context_get(GL_PACK_ROW_LENGTH);
		layout.skip_rows = context_get(GL_PACK_SKIP_ROWS);
		layout.skip_pixels = context_get(GL_PACK_SKIP_PIXELS);
	}
	if (context_has(HAS_3D)) {
		layout.image_height = context_get(GL_PACK_IMAGE_HEIGHT);
		layout.skip_images = context_get(GL_PACK_SKIP_IMAGES);
	}
	return image_bytes(&layout, dims, format, type, width, height, depth);
}

long read_pixels_bytes(unsigned format, unsigned type, int width, int height)
{
	return packed_bytes(2, format, type, width, height, 1);
}

static int level_get(unsigned target, int level, unsigned pname)
{
	int value = 0;

	real_glGetTexLevelParameteriv(target, level, pname, &value);
	return value;
}

/* The questions may be errors, where the program's call was one. */
long texture_image_bytes(unsigned target, int level, unsigned format, unsigned type)
{
	int width, height, depth = 1, dims = 2;

	if (!context_has(HAS_DESKTOP))
		return -1;
	context_errors_before();
	width = level_get(target, level, GL_TEXTURE_WIDTH);
	height = level_get(target, level, GL_TEXTURE_HEIGHT);
	if (context_has(HAS_3D))
		depth = level_get(target, level, GL_TEXTURE_DEPTH);
	context_errors_after();
	if (target == GL_TEXTURE_1D)
		dims = 1;
	else if (target == GL_TEXTURE_3D || target == GL_TEXTURE_2D_ARRAY || target == GL_TEXTURE_CUBE_MAP_ARRAY)
		dims = 3;
	return packed_bytes(dims, format, type, width, height, dims == 3 ? depth : 1);
}

long compressed_image_bytes(unsigned target, int level)
{
	int bytes = 0;

	if (in_buffer() || !context_has(HAS_DESKTOP))
		return -1;
	context_errors_before();
	if (level_get(target, level, GL_TEXTURE_COMPRESSED))
		bytes = level_get(target, level, GL_TEXTURE_COMPRESSED_IMAGE_SIZE);
	context_errors_after();
	return bytes;
}
