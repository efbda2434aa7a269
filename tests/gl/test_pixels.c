/* Raster position, bitmaps, pixel rectangles, pixel maps (GL 2.1 sec. 2.13, 3.6, 3.7, 4.3.3): calls in, rectangles out. */
#include "tests/gl/gl.h"

static struct gl open_plain(void)
{
	struct gl gl = gl_open();

	gl_call(&gl, "glMatrixMode", "e", GL_PROJECTION);
	gl_call(&gl, "glOrtho", "dddddd", 0.0, 64.0, 0.0, 64.0, -1.0, 1.0);
	gl_call(&gl, "glMatrixMode", "e", GL_MODELVIEW);
	return gl;
}

/* Sec. 2.13: to the window as a vertex goes; invalid outside of the view; colours of that moment. */
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

/* Sec. 3.7: bits as the unpack state of that moment reads them, also out of a list; the position moves on. */
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

/* A rectangle's fragments go through texturing, fog and the rest, but not once more through lighting and generation. */
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

/* ARB_pixel_buffer_object: maps and stipples out of the bound buffer; beyond its end nothing is drawn. */
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

/* Depths that are no numbers are 0, as Mesa clamps them; indices and maps of any floats have a defined meaning (SAN=undefined). */
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

/* What is read into a buffer object is data of later calls; what is read into the program's memory is not our affair. */
START_TEST(test_read_into_buffer)
{
	struct gl gl = gl_open();
	uint8_t bytes[64] = { 0 };

	gl_call(&gl, "glReadPixels", "iiiieep", 0, 0, 4, 4, GL_RGBA, GL_UNSIGNED_BYTE, (uint64_t)0x1000);
	gl_call(&gl, "glGetTexImage", "eieep", GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, (uint64_t)0x1000);
	ck_assert_uint_eq(gl_unsupported(&gl), 0);
	gl_call(&gl, "glBindBuffer", "eu", GL_PIXEL_PACK_BUFFER, 5u);
	gl_call(&gl, "glBufferData", "eibe", GL_PIXEL_PACK_BUFFER, 64, sizeof(bytes), bytes, GL_STREAM_READ);
	gl_call(&gl, "glReadPixels", "iiiieep", 0, 0, 4, 4, GL_RGBA, GL_UNSIGNED_BYTE, (uint64_t)0);
	gl_call(&gl, "glGetTexImage", "eieep", GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, (uint64_t)0);
	ck_assert_uint_eq(gl_unsupported(&gl), 2);
	gl_close(&gl);
}
END_TEST

GL_TESTS("pixels", test_read_into_buffer, test_no_numbers, test_pixel_buffer, test_raster_pos, test_bitmap, test_draw_pixels, test_state_of_rectangles)
