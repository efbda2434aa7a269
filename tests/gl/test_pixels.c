/* Raster position, bitmaps, pixel rectangles, pixel maps, pixels read into buffers (GL 2.1 sec. 2.13, 3.6, 3.7, 4.3):
 * calls in, rectangles and bytes out. */
#include "tests/gl/gl.h"
#include "replay/gl/texture/texture.h"
#include "replay/machine/buffer.h"

static struct gl open_plain(void)
{
	struct gl gl = gl_open();

	gl_call(&gl, "glMatrixMode", "e", GL_PROJECTION);
	gl_call(&gl, "glOrtho", "dddddd", 0.0, 64.0, 0.0, 64.0, -1.0, 1.0);
	gl_call(&gl, "glMatrixMode", "e", GL_MODELVIEW);
	return gl;
}

/* Sec. 2.13: transformed like a vertex; invalid outside the view; with the colours of that moment. */
START_TEST(test_raster_pos)
{
	struct gl gl = open_plain();
	const struct gls_current *c = &gl_state(&gl)->a.current;

	gl_call(&gl, "glColor3f", "fff", 1.0, 0.5, 0.0);
	gl_call(&gl, "glTranslatef", "fff", 1.0, 0.0, 0.0);
	gl_call(&gl, "glRasterPos2i", "ii", 9, 20);
	gl_call(&gl, "glColor3f", "fff", 0.0, 0.0, 0.0);
	ck_assert_uint_eq(c->raster_valid, 1);
	ck_assert_float_eq_tol(c->raster_position[0], 10, 1e-4f);
	ck_assert_float_eq_tol(c->raster_position[1], 20, 1e-4f);
	ck_assert_float_eq_tol(c->raster_position[2], 0.5f, 1e-6f);
	ck_assert_float_eq(c->raster_color[0], 1);
	ck_assert_float_eq(c->raster_color[1], 0.5f);
	gl_call(&gl, "glRasterPos2i", "ii", 70, 20);
	ck_assert_uint_eq(c->raster_valid, 0);
	gl_call(&gl, "glDepthRange", "dd", 0.5, 1.0);
	gl_call(&gl, "glWindowPos3f", "fff", 70.0, -3.0, 0.5);
	ck_assert_uint_eq(c->raster_valid, 1);
	ck_assert_float_eq(c->raster_position[0], 70);
	ck_assert_float_eq(c->raster_position[2], 0.75f);
	gl_call(&gl, "glPushAttrib", "m", GL_CURRENT_BIT);
	gl_call(&gl, "glWindowPos2i", "ii", 1, 1);
	gl_call(&gl, "glPopAttrib", "");
	ck_assert_float_eq(c->raster_position[0], 70);
	gl_close(&gl);
}
END_TEST

/* Sec. 3.7: bits are read with the current unpack state, also from a list; the position advances. */
START_TEST(test_bitmap)
{
	static const uint8_t bits[8] = { 0x80, 0, 0, 0, 0x41, 0, 0, 0 };
	struct gl gl = open_plain();
	struct scene *s;

	gl_call(&gl, "glNewList", "ue", 1u, GL_COMPILE);
	gl_call(&gl, "glBitmap", "iiffffb", 8, 2, 1.0, 0.5, 10.0, 2.0, sizeof(bits), bits);
	gl_call(&gl, "glEndList", "");
	gl_call(&gl, "glPixelStorei", "ei", GL_UNPACK_ALIGNMENT, 1);
	gl_call(&gl, "glPixelStorei", "ei", GL_UNPACK_LSB_FIRST, 1);
	gl_call(&gl, "glRasterPos2f", "ff", 5.7, 6.2);
	gl_call(&gl, "glCallList", "u", 1u);
	gl_call(&gl, "glCallList", "u", 1u);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 2);
	ck_assert_uint_eq(s->n_rectangles, 2);
	ck_assert_uint_eq(s->instances[0].rectangle, 1);
	ck_assert_uint_eq(s->rectangles[0].kind, SCENE_BITMAP);
	ck_assert_float_eq(s->meshes[s->instances[0].mesh]->position[0], 4);
	ck_assert_float_eq(s->meshes[s->instances[0].mesh]->position[1], 5);
	ck_assert_float_eq(s->meshes[s->instances[1].mesh]->position[0], 14);
	ck_assert_float_eq(s->meshes[s->instances[1].mesh]->position[1], 7);
	ck_assert_uint_eq(s->textures[s->rectangles[0].texture]->texels[0], 255);
	ck_assert_uint_eq(s->textures[s->rectangles[0].texture]->texels[4], 0);
	ck_assert_uint_eq(s->textures[s->rectangles[0].texture]->texels[4 * 9], 255);
	ck_assert_uint_eq(s->textures[s->rectangles[0].texture]->texels[4 * 15], 255);
	ck_assert_uint_eq(gl_unsupported(&gl), 0);
	scene_release(&s);
	gl_call(&gl, "glRasterPos2f", "ff", -1.0, 6.2);
	gl_call(&gl, "glCallList", "u", 1u); /* invalid position: nothing */
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Sec. 3.6.3, 3.6.5: scale, bias and maps; indices become colours. */
START_TEST(test_draw_pixels)
{
	static const uint8_t rgba[4] = { 255, 0, 51, 255 }, index = 1;
	static const float turned[2] = { 1, 0 }, same[2] = { 0, 1 }, red[2] = { 0.2f, 1 };
	static const uint32_t maps[3] = { GL_PIXEL_MAP_G_TO_G, GL_PIXEL_MAP_B_TO_B, GL_PIXEL_MAP_A_TO_A };
	struct gl gl = open_plain();
	struct scene *s;

	gl_call(&gl, "glPixelZoom", "ff", 2.0, -3.0);
	gl_call(&gl, "glPixelTransferf", "ef", GL_BLUE_SCALE, 2.0);
	gl_call(&gl, "glDrawPixels", "iieeb", 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, sizeof(rgba), rgba);
	gl_call(&gl, "glPixelTransferf", "ef", GL_BLUE_SCALE, 1.0);
	gl_call(&gl, "glPixelMapfv", "eiF", GL_PIXEL_MAP_R_TO_R, 2, 2, turned);
	for (int i = 0; i < 3; i++)
		gl_call(&gl, "glPixelMapfv", "eiF", maps[i], 2, 2, same);
	gl_call(&gl, "glPixelTransferi", "ei", GL_MAP_COLOR, 1);
	gl_call(&gl, "glDrawPixels", "iieeb", 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, sizeof(rgba), rgba);
	gl_call(&gl, "glPixelTransferi", "ei", GL_MAP_COLOR, 0);
	gl_call(&gl, "glPixelMapfv", "eiF", GL_PIXEL_MAP_I_TO_R, 2, 2, red);
	gl_call(&gl, "glDrawPixels", "iieeb", 1, 1, GL_COLOR_INDEX, GL_UNSIGNED_BYTE, (size_t)1, &index);
	gl_call(&gl, "glPixelMapfv", "eiF", GL_PIXEL_MAP_I_TO_R, 3, 3, (float[3]){ 0 });
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_rectangles, 3);
	ck_assert_float_eq(s->rectangles[0].zoom[1], -3);
	ck_assert_mem_eq(s->textures[s->rectangles[0].texture]->texels, ((uint8_t[4]){ 255, 0, 102, 255 }), 4);
	ck_assert_mem_eq(s->textures[s->rectangles[1].texture]->texels, ((uint8_t[4]){ 0, 0, 0, 255 }), 4);
	ck_assert_mem_eq(s->textures[s->rectangles[2].texture]->texels, ((uint8_t[4]){ 255, 0, 0, 0 }), 4);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/*
 * A rectangle's fragments are textured and fogged as usual, but not lit again, and texture coordinates are not
 * generated again.
 */
START_TEST(test_state_of_rectangles)
{
	static const uint8_t depth[4] = { 0, 0, 0, 63 };
	struct gl gl = open_plain();
	const struct scene_material *m;
	struct scene *s;

	gl_call(&gl, "glEnable", "e", GL_LIGHTING);
	gl_call(&gl, "glEnable", "e", GL_BLEND);
	gl_call(&gl, "glEnable", "e", GL_CLIP_PLANE0);
	gl_call(&gl, "glDrawPixels", "iieeb", 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, sizeof(depth), depth);
	gl_call(&gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 2);
	m = &s->materials[s->instances[0].material];
	ck_assert_uint_eq(m->lighting, 0);
	ck_assert_uint_eq(m->clip_plane_mask, 0);
	ck_assert_uint_eq(m->blend, 1);
	ck_assert_uint_eq(s->rectangles[0].kind, SCENE_DEPTH_PIXELS);
	ck_assert_uint_eq(s->materials[s->instances[1].material].lighting, 1);
	ck_assert_uint_eq(s->instances[1].rectangle, 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* ARB_pixel_buffer_object: maps and stipples from the bound buffer; nothing is drawn from beyond its end. */
START_TEST(test_pixel_buffer)
{
	static const uint16_t map[2] = { 0, 0xffff };
	uint8_t bytes[128];
	struct gl gl = gl_open();
	struct scene *s;

	for (unsigned i = 0; i < 128; i++)
		bytes[i] = (uint8_t)i;
	gl_call(&gl, "glBindBuffer", "eu", GL_PIXEL_UNPACK_BUFFER, 1);
	gl_call(&gl, "glBufferData", "eibe", GL_PIXEL_UNPACK_BUFFER, 128, sizeof(bytes), bytes, GL_STATIC_DRAW);
	gl_call(&gl, "glPolygonStipple", "p", (uint64_t)0);
	ck_assert_uint_eq(gl_state(&gl)->a.polygon_stipple[1], 0x04050607);
	gl_call(&gl, "glDrawPixels", "iieep", 5, 7, GL_RGBA, GL_UNSIGNED_BYTE, (uint64_t)0);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_OPERATION);
	gl_call(&gl, "glDrawPixels", "iieep", 4, 8, GL_RGBA, GL_UNSIGNED_BYTE, (uint64_t)0);
	gl_call(&gl, "glBufferData", "eibe", GL_PIXEL_UNPACK_BUFFER, 4, sizeof(map), map, GL_STATIC_DRAW);
	gl_call(&gl, "glPixelMapusv", "eip", GL_PIXEL_MAP_I_TO_R, 2, (uint64_t)0);
	ck_assert_float_eq(gl_state(&gl)->pixel_maps[GL_PIXEL_MAP_I_TO_R - GL_PIXEL_MAP_I_TO_I].values[1], 1);
	ck_assert_uint_eq(gl_unsupported(&gl), 0);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_rectangles, 1);
	ck_assert_uint_eq(s->rectangles[0].height, 8);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* NaN depths become 0, as Mesa clamps them; indices and maps of any floats are well defined (SAN=undefined). */
START_TEST(test_no_numbers)
{
	static const float wild[4] = { NAN, INFINITY, -1e30f, 4.6e30f };
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glRasterPos2f", "ff", 0.0, 0.0);
	gl_call(&gl, "glDrawPixels", "iieeb", 4, 1, GL_DEPTH_COMPONENT, GL_FLOAT, sizeof(wild), wild);
	for (unsigned i = 0; i < 4; i++)
		gl_call(&gl, "glPixelMapfv", "eiF", GL_PIXEL_MAP_I_TO_R + i, 4, 4, wild);
	gl_call(&gl, "glPixelMapfv", "eiF", GL_PIXEL_MAP_S_TO_S, 4, 4, wild);
	gl_call(&gl, "glPixelTransferi", "ei", GL_MAP_STENCIL, 1);
	gl_call(&gl, "glDrawPixels", "iieeb", 4, 1, GL_COLOR_INDEX, GL_FLOAT, sizeof(wild), wild);
	gl_call(&gl, "glDrawPixels", "iieeb", 4, 4, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, sizeof(wild), wild);
	gl_call(&gl, "glAccum", "ef", GL_RETURN, (double)NAN);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_rectangles, 4);
	ck_assert_mem_eq(s->textures[s->rectangles[0].texture]->texels, ((float[4]){ 0, 1, 0, 1 }), 16);
	ck_assert_mem_eq(s->textures[s->rectangles[1].texture]->texels, ((uint8_t[4]){ 0, 0, 0, 0 }), 4);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* A supplier with the same value for every pixel: 10 20 200 100, depth one half, stencil 7. */
static int paint(void *user, const struct scene *scene, struct scene_picture *picture)
{
	(void)user;
	for (size_t i = 0; i < (size_t)scene->width * scene->height; i++) {
		memcpy(picture->rgba + 4 * i, (const uint8_t[4]){ 10, 20, 200, 100 }, 4);
		picture->depth[i] = 0x800000;
		picture->stencil[i] = 7;
	}
	picture->unknown = 0;
	return 0;
}

enum { ROOM = 96 };

/* A buffer of bytes 0xee, bound as the target of reads. */
static struct gl open_buffer(int renders)
{
	struct gl gl = open_plain();
	uint8_t bytes[ROOM];

	memset(bytes, 0xee, sizeof(bytes));
	gl.x->feedback.supply = renders ? paint : NULL;
	gl_call(&gl, "glClear", "m", GL_COLOR_BUFFER_BIT);
	gl_call(&gl, "glBindBuffer", "eu", GL_PIXEL_PACK_BUFFER, 5u);
	gl_call(&gl, "glBufferData", "eibe", GL_PIXEL_PACK_BUFFER, ROOM, sizeof(bytes), bytes, GL_STREAM_READ);
	return gl;
}

static const struct gls_buffer *buffer_of(struct gl *gl)
{
	return gls_buffer_find(gl_state(gl), 5);
}

static void read_pixels(struct gl *gl, int width, int height, uint32_t format, uint32_t type, uint64_t offset)
{
	gl_call(gl, "glReadPixels", "iiiieep", 0, 0, width, height, format, type, offset);
}

/* Sec. 4.3.2: each format and type as in Mesa; luminance is a sum. */
START_TEST(test_read_formats)
{
	static const struct { uint32_t format, type; uint8_t n, bytes[16]; } all[] = {
		{ GL_RGBA, GL_UNSIGNED_BYTE, 4, { 10, 20, 200, 100 } },
		{ GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, 4, { 200, 20, 10, 100 } },
		{ GL_ABGR_EXT, GL_UNSIGNED_BYTE, 4, { 100, 200, 20, 10 } },
		{ GL_RG, GL_UNSIGNED_SHORT, 4, { 10, 10, 20, 20 } },
		{ GL_BLUE, GL_BYTE, 1, { 100 } },
		{ GL_BLUE, GL_UNSIGNED_INT, 4, { 200, 200, 200, 200 } },
		{ GL_LUMINANCE, GL_UNSIGNED_BYTE, 1, { 230 } },
		{ GL_LUMINANCE_ALPHA, GL_UNSIGNED_BYTE, 2, { 230, 100 } },
		{ GL_RGB, GL_UNSIGNED_SHORT_5_6_5, 2, { 0xb8, 0x08 } },
		{ GL_ALPHA, GL_FLOAT, 4, { 0xc9, 0xc8, 0xc8, 0x3e } },
		{ GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT, 2, { 0x00, 0x80 } },
		{ GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, 4, { 0x80, 0x00, 0x00, 0x80 } },
		{ GL_DEPTH_COMPONENT, GL_FLOAT, 4, { 0x01, 0x00, 0x00, 0x3f } },
		{ GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, 1, { 7 } },
		{ GL_STENCIL_INDEX, GL_FLOAT, 4, { 0, 0, 0xe0, 0x40 } },
		{ GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8, 4, { 7, 0, 0, 0x80 } },
	};
	struct gl gl = open_buffer(1);

	for (size_t i = 0; i < sizeof(all) / sizeof(all[0]); i++) {
		read_pixels(&gl, 1, 1, all[i].format, all[i].type, 0);
		ck_assert_msg(!memcmp(buffer_of(&gl)->data, all[i].bytes, all[i].n), "format %x, type %x",
		              all[i].format, all[i].type);
	}
	ck_assert_uint_eq(gl_error(&gl), 0);
	ck_assert_uint_eq(gl_unsupported(&gl), 0);
	read_pixels(&gl, 1, 1, GL_RGB, GL_UNSIGNED_INT_5_9_9_9_REV, 0);
	ck_assert_uint_eq(gl_unsupported(&gl), 1);
	gl_close(&gl);
}
END_TEST

/* Sec. 4.3.2, table 4.5: rows, alignment, swapped bytes, and pixel transfer state; bytes between rows are unchanged. */
START_TEST(test_read_storage)
{
	struct gl gl = open_buffer(1);
	const uint8_t *data;

	gl_call(&gl, "glPixelStorei", "ei", GL_PACK_ROW_LENGTH, 3);
	gl_call(&gl, "glPixelStorei", "ei", GL_PACK_SKIP_ROWS, 1);
	gl_call(&gl, "glPixelStorei", "ei", GL_PACK_SKIP_PIXELS, 1);
	gl_call(&gl, "glPixelStorei", "ei", GL_PACK_ALIGNMENT, 8);
	read_pixels(&gl, 2, 2, GL_RGB, GL_UNSIGNED_BYTE, 1); /* rows of 9 bytes start 16 apart: at 1 + 16 + 3 */
	data = buffer_of(&gl)->data;
	ck_assert_mem_eq(data + 19, ((uint8_t[8]){ 0xee, 10, 20, 200, 10, 20, 200, 0xee }), 8);
	ck_assert_mem_eq(data + 35, ((uint8_t[8]){ 0xee, 10, 20, 200, 10, 20, 200, 0xee }), 8);
	gl_call(&gl, "glPixelStorei", "ei", GL_PACK_ROW_LENGTH, 0);
	gl_call(&gl, "glPixelStorei", "ei", GL_PACK_SKIP_ROWS, 0);
	gl_call(&gl, "glPixelStorei", "ei", GL_PACK_SKIP_PIXELS, 0);
	gl_call(&gl, "glPixelStorei", "ei", GL_PACK_SWAP_BYTES, 1);
	gl_call(&gl, "glPixelTransferf", "ef", GL_RED_SCALE, 2.0);
	read_pixels(&gl, 1, 1, GL_RGBA, GL_UNSIGNED_SHORT_5_5_5_1, 0);
	ck_assert_mem_eq(data, ((uint8_t[2]){ 0x10, 0xb0 }), 2);
	/* only one pixel is on the screen */
	gl_call(&gl, "glReadPixels", "iiiieep", -1, 63, 2, 2, GL_GREEN, GL_UNSIGNED_BYTE, (uint64_t)64);
	ck_assert_mem_eq(data + 64, ((uint8_t[10]){ 0xee, 20, 0xee, 0xee, 0xee, 0xee, 0xee, 0xee, 0xee, 0xee }), 10);
	ck_assert_uint_eq(gl_error(&gl), 0);
	gl_close(&gl);
}
END_TEST

/*
 * ARB_pixel_buffer_object: nothing is written beyond the buffer's end or at unaligned offsets, even for huge numbers.
 */
START_TEST(test_read_beyond)
{
	static const struct { int width, height; uint32_t type; uint64_t offset; } wrong[] = {
		{ 5, 5, GL_UNSIGNED_BYTE, 0 }, { 4, 6, GL_UNSIGNED_BYTE, 1 }, { 1, 1, GL_UNSIGNED_BYTE, UINT64_MAX - 3 },
		{ 1, 1, GL_FLOAT, 2 }, { INT32_MAX, INT32_MAX, GL_FLOAT, 0 }, { 1, INT32_MAX, GL_UNSIGNED_BYTE, 0 },
		{ INT32_MAX, 1, GL_UNSIGNED_BYTE, 0 },
	};
	struct gl gl = open_buffer(1);

	for (size_t i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++) {
		read_pixels(&gl, wrong[i].width, wrong[i].height, GL_RGBA, wrong[i].type, wrong[i].offset);
		ck_assert_uint_eq(gl_error(&gl), GL_INVALID_OPERATION);
	}
	gl_call(&gl, "glPixelStorei", "ei", GL_PACK_SKIP_ROWS, 1 << 24);
	gl_call(&gl, "glPixelStorei", "ei", GL_PACK_ROW_LENGTH, 1 << 24);
	read_pixels(&gl, 1, 1, GL_RGBA, GL_FLOAT, 0);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_OPERATION);
	read_pixels(&gl, -1, 1, GL_RGBA, GL_FLOAT, 0);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE);
	for (size_t i = 0; i < ROOM; i++)
		ck_assert_uint_eq(buffer_of(&gl)->data[i], 0xee);
	gl_close(&gl);
}
END_TEST

/* Sec. 6.1.4: texels as in table 6.1, without pixel transfer. */
START_TEST(test_read_texels)
{
	static const uint8_t texels[8] = { 10, 20, 200, 100, 255, 0, 51, 1 };
	struct gl gl = open_buffer(0);
	const uint8_t *data = buffer_of(&gl)->data;

	gl_call(&gl, "glTexImage2D", "eieiiieeb", GL_TEXTURE_2D, 0, GL_RGBA, 2, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE,
	        sizeof(texels), texels);
	gl_call(&gl, "glPixelTransferf", "ef", GL_RED_SCALE, 0.5);
	gl_call(&gl, "glGetTexImage", "eieep", GL_TEXTURE_2D, 0, GL_BGRA, GL_UNSIGNED_BYTE, (uint64_t)4);
	ck_assert_mem_eq(data + 4, ((uint8_t[8]){ 200, 20, 10, 100, 51, 0, 255, 1 }), 8);
	gl_call(&gl, "glGetTexImage", "eieep", GL_TEXTURE_2D, 0, GL_LUMINANCE, GL_UNSIGNED_BYTE, (uint64_t)0);
	ck_assert_mem_eq(data, ((uint8_t[2]){ 10, 255 }), 2);
	gl_call(&gl, "glPixelTransferf", "ef", GL_RED_SCALE, 1.0);
	gl_call(&gl, "glTexImage2D", "eieiiieeb", GL_TEXTURE_2D, 0, GL_LUMINANCE_ALPHA, 2, 1, 0, GL_RGBA,
	        GL_UNSIGNED_BYTE, sizeof(texels), texels);
	gl_call(&gl, "glGetTexImage", "eieep", GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, (uint64_t)0);
	ck_assert_mem_eq(data, ((uint8_t[8]){ 10, 0, 0, 100, 255, 0, 0, 1 }), 8);
	ck_assert_uint_eq(gl_error(&gl), 0);
	gl_call(&gl, "glGetTexImage", "eieep", GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, GL_FLOAT, (uint64_t)0);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_OPERATION);
	gl_call(&gl, "glGetTexImage", "eieep", GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, (uint64_t)(ROOM - 4));
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_OPERATION);
	ck_assert_uint_eq(gl_unsupported(&gl), 0);
	gl_call(&gl, "glGetCompressedTexImage", "eip", GL_TEXTURE_2D, 0, (uint64_t)0);
	ck_assert_uint_eq(gl_unsupported(&gl), 1);
	gl_close(&gl);
}
END_TEST

/* Reads into the program's memory need nothing. In a buffer, without a renderer or in skipped frames, pixels are
 * missing until all are written. */
START_TEST(test_read_missing)
{
	uint8_t bytes[ROOM] = { 0 };
	struct gl gl = open_buffer(0);

	read_pixels(&gl, 2, 2, GL_RGBA, GL_UNSIGNED_BYTE, 8);
	ck_assert_uint_eq(gl_unsupported(&gl), 1); /* needs a renderer */
	ck_assert_uint_eq(buffer_of(&gl)->missing, 1);
	gl_call(&gl, "glBufferSubData", "eiib", GL_PIXEL_PACK_BUFFER, 9, 15, (size_t)15, bytes);
	ck_assert_uint_eq(buffer_of(&gl)->missing, 1);
	gl_call(&gl, "glBufferSubData", "eiib", GL_PIXEL_PACK_BUFFER, 8, 16, (size_t)16, bytes);
	ck_assert_uint_eq(buffer_of(&gl)->missing, 0);
	gl.x->feedback.supply = paint;
	gl.x->want = 0;
	read_pixels(&gl, 2, 2, GL_RGBA, GL_UNSIGNED_BYTE, 8);
	gl_call(&gl, "glBindBuffer", "eu", GL_PIXEL_UNPACK_BUFFER, 5);
	gl_call(&gl, "glTexImage2D", "eieiiieep", GL_TEXTURE_2D, 0, GL_RGBA, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, (uint64_t)8);
	ck_assert_uint_eq(gls_texture_missing(gls_texture_bound(gl.x, gl_state(&gl), 0, GLS_TEXTURE_2D)), 1);
	ck_assert_int_eq(gl.x->feedback.rewind, 0);
	gl.x->want = 1;
	gl_call(&gl, "glDrawPixels", "iieep", 2, 2, GL_RGBA, GL_UNSIGNED_BYTE, (uint64_t)8);
	ck_assert_int_eq(gl.x->feedback.rewind, 1);
	read_pixels(&gl, 2, 2, GL_RGBA, GL_UNSIGNED_BYTE, 8);
	ck_assert_uint_eq(buffer_of(&gl)->missing, 0);
	gl_call(&gl, "glTexSubImage2D", "eiiiiieep", GL_TEXTURE_2D, 0, 0, 0, 2, 2, GL_RGBA, GL_UNSIGNED_BYTE, (uint64_t)8);
	ck_assert_uint_eq(gls_texture_missing(gls_texture_bound(gl.x, gl_state(&gl), 0, GLS_TEXTURE_2D)), 0);
	gl_call(&gl, "glBindBuffer", "eu", GL_PIXEL_PACK_BUFFER, 0u);
	read_pixels(&gl, 4, 4, GL_RGBA, GL_UNSIGNED_BYTE, 0x1000);
	gl_call(&gl, "glGetTexImage", "eieep", GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, (uint64_t)0x1000);
	ck_assert_uint_eq(gl_unsupported(&gl), 1);
	gl_close(&gl);
}
END_TEST

GL_TESTS("pixels", test_read_formats, test_read_storage, test_read_beyond, test_read_texels, test_read_missing,
         test_no_numbers, test_pixel_buffer, test_raster_pos, test_bitmap, test_draw_pixels, test_state_of_rectangles)
