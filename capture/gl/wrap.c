/* Runs inside the traced program. Values that depend on GL state. */
#include "capture/gl/wrap.h"

#include <GL/gl.h>
#include <GL/glext.h>

#include "capture/write/content.h"

/* The trace has a buffer of ours bound that holds the pixels of the call to come. */
static __thread int own_pixels __attribute__((tls_model("initial-exec")));

int pixels_in_buffer(void)
{
	return context_has(HAS_PIXEL_BUFFERS) && context_get(GL_PIXEL_UNPACK_BUFFER_BINDING);
}

static void read_layout(struct pixel_layout *layout)
{
	memset(layout, 0, sizeof(*layout));
	layout->alignment = context_get(GL_UNPACK_ALIGNMENT);
	if (!context_has(HAS_DESKTOP))
		return;
	layout->row_length = context_get(GL_UNPACK_ROW_LENGTH);
	layout->skip_rows = context_get(GL_UNPACK_SKIP_ROWS);
	layout->skip_pixels = context_get(GL_UNPACK_SKIP_PIXELS);
	if (context_has(HAS_3D)) {
		layout->image_height = context_get(GL_UNPACK_IMAGE_HEIGHT);
		layout->skip_images = context_get(GL_UNPACK_SKIP_IMAGES);
	}
}

uint8_t *put_image(uint8_t *p, const void *pixels, int dims, unsigned format, unsigned type, int width, int height,
                   int depth)
{
	struct pixel_layout layout;

	if (!pixels || own_pixels)
		return put_null(p);
	if (pixels_in_buffer())
		return put_opaque(p, pixels);
	read_layout(&layout);
	return put_blob(p, pixels, image_bytes(&layout, dims, format, type, width, height, depth));
}

/* Pixels that come again are stored once (content.h): the call is written with an offset in a buffer that holds them. */

void image_used(const void *pixels, int dims, unsigned format, unsigned type, int width, int height, int depth)
{
	struct pixel_layout layout;
	unsigned buffer;
	int bound = 0;

	if (!pixels || !writer_active() || !context_has(HAS_PIXEL_BUFFERS) || !context_has(HAS_FIXED_FUNCTION) || pixels_in_buffer())
		return;
	read_layout(&layout);
	buffer = content_of_memory(context_contents(), GL_PIXEL_UNPACK_BUFFER, pixels,
	                           image_bytes(&layout, dims, format, type, width, height, depth), &bound);
	if (buffer && !bound)
		content_bind(GL_PIXEL_UNPACK_BUFFER, buffer);
	own_pixels = buffer != 0;
}

void image_written(void)
{
	if (own_pixels)
		content_bind(GL_PIXEL_UNPACK_BUFFER, 0);
	own_pixels = 0;
}

long polygon_stipple_count(void)
{
	struct pixel_layout layout;

	read_layout(&layout);
	return image_bytes(&layout, 2, GL_COLOR_INDEX, GL_BITMAP, 32, 32, 1);
}

static int indices_in_buffer(void)
{
	return context_has(HAS_BUFFERS) && context_get(GL_ELEMENT_ARRAY_BUFFER_BINDING);
}

uint8_t *put_indices(uint8_t *p, const void *indices, int count, unsigned type)
{
	if (arrays_own_indices())
		return put_null(p);
	if (!indices || indices_in_buffer())
		return put_opaque(p, indices);
	return put_blob(p, indices, count * type_bytes(type));
}

uint8_t *put_multi_indices(uint8_t *p, const void *const *indices, const int *counts, unsigned type, int draws)
{
	int offsets = indices_in_buffer();

	if (!indices || !counts)
		return put_null(p);
	p = put_array_head(p, draws);
	for (int i = 0; i < draws; i++) {
		p = offsets ? put_opaque(p, indices[i]) : put_blob(p, indices[i], counts[i] * type_bytes(type));
		p = put_room(p);
	}
	return p;
}

long indirect_bytes(int elements, int draws, int stride)
{
	long size = elements ? 20 : 16;

	return draws > 0 && stride >= 0 ? (draws - 1L) * (stride ? stride : size) + size : 0;
}

uint8_t *put_indirect(uint8_t *p, const void *indirect, long bytes)
{
	if (!indirect || (context_has(HAS_INDIRECT) && context_get(GL_DRAW_INDIRECT_BUFFER_BINDING)))
		return put_opaque(p, indirect);
	return put_blob(p, indirect, bytes);
}

enum { MAX_ATTRIBS = 512 };

uint8_t *put_attribs(uint8_t *p, const int *list, int end)
{
	long n = 0;

	while (list && n < MAX_ATTRIBS && list[n] != end)
		n += 2;
	return put_array_s32(p, list, n + 1);
}

uint8_t *put_attribs_wide(uint8_t *p, const long *list, long end)
{
	long n = 0;

	while (list && n < MAX_ATTRIBS && list[n] != end)
		n += 2;
	return put_array_s64(p, (const int64_t *)list, n + 1);
}
