/* Texture images, completeness, parameters (GL 2.1 sec. 3.6, 3.8). */
#include <math.h>

#include "tests/gl/gl.h"

static void draw(struct gl *gl)
{
	gl_call(gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0);
}

/* A 2x1 texture with a given format; its texels in the scene must be these. */
static void check_texels(uint32_t internal, uint32_t format, uint32_t type, size_t n, const void *pixels,
                         const uint8_t wanted[8])
{
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glEnable", "e", GL_TEXTURE_2D);
	gl_call(&gl, "glTexParameteri", "eee", GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	gl_call(&gl, "glTexImage2D", "eieiiieeb", GL_TEXTURE_2D, 0, internal, 2, 1, 0, format, type, n, pixels);
	draw(&gl);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_textures, 1);
	ck_assert_uint_eq(s->textures[0]->n_bytes, 8);
	ck_assert_mem_eq(s->textures[0]->texels, wanted, 8);
	scene_release(&s);
	gl_close(&gl);
}

/* Tables 3.5, 3.8, 3.15, 3.20. */
START_TEST(test_formats)
{
	static const uint8_t bytes[8] = { 10, 20, 30, 40, 50, 60, 70, 80 };
	static const uint16_t rgb565[2] = { 0xf800, 0x07ff };
	static const float floats[2] = { 0.5f, 2.0f };

	check_texels(GL_RGBA, GL_RGBA, GL_UNSIGNED_BYTE, 8, bytes, (uint8_t[]){ 10, 20, 30, 40, 50, 60, 70, 80 });
	check_texels(GL_RGBA, GL_BGRA, GL_UNSIGNED_BYTE, 8, bytes, (uint8_t[]){ 30, 20, 10, 40, 70, 60, 50, 80 });
	check_texels(GL_RGB, GL_RGB, GL_UNSIGNED_BYTE, 8, bytes, (uint8_t[]){ 10, 20, 30, 255, 40, 50, 60, 255 });
	check_texels(GL_ALPHA, GL_ALPHA, GL_UNSIGNED_BYTE, 4, bytes, (uint8_t[]){ 0, 0, 0, 10, 0, 0, 0, 20 });
	check_texels(GL_LUMINANCE, GL_LUMINANCE, GL_UNSIGNED_BYTE, 4, bytes, (uint8_t[]){ 10, 10, 10, 255, 20, 20, 20, 255 });
	check_texels(GL_LUMINANCE_ALPHA, GL_LUMINANCE_ALPHA, GL_UNSIGNED_BYTE, 4, bytes,
	             (uint8_t[]){ 10, 10, 10, 20, 30, 30, 30, 40 });
	check_texels(GL_INTENSITY, GL_LUMINANCE, GL_UNSIGNED_BYTE, 4, bytes, (uint8_t[]){ 10, 10, 10, 10, 20, 20, 20, 20 });
	check_texels(GL_RGB, GL_RGB, GL_UNSIGNED_SHORT_5_6_5, 4, rgb565, (uint8_t[]){ 255, 0, 0, 255, 0, 255, 255, 255 });
	check_texels(GL_LUMINANCE, GL_LUMINANCE, GL_FLOAT, 8, floats, (uint8_t[]){ 128, 128, 128, 255, 255, 255, 255, 255 });
	check_texels(3, GL_RGBA, GL_UNSIGNED_INT_8_8_8_8_REV, 8, bytes, (uint8_t[]){ 10, 20, 30, 255, 50, 60, 70, 255 });
}
END_TEST

/* Sec. 3.6.1, 3.6.4: row length, skips, alignment. */
START_TEST(test_unpack)
{
	uint8_t bytes[64];
	struct gl gl = gl_open();
	struct scene *s;

	for (unsigned i = 0; i < 64; i++)
		bytes[i] = (uint8_t)i;
	gl_call(&gl, "glEnable", "e", GL_TEXTURE_2D);
	gl_call(&gl, "glTexParameteri", "eee", GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	gl_call(&gl, "glPixelStorei", "ei", GL_UNPACK_ROW_LENGTH, 5);
	gl_call(&gl, "glPixelStorei", "ei", GL_UNPACK_SKIP_ROWS, 1);
	gl_call(&gl, "glPixelStorei", "ei", GL_UNPACK_SKIP_PIXELS, 2);
	gl_call(&gl, "glTexImage2D", "eieiiieeb", GL_TEXTURE_2D, 0, GL_LUMINANCE, 2, 2, 0, GL_LUMINANCE, GL_UNSIGNED_BYTE,
	        sizeof(bytes), bytes);
	draw(&gl);
	s = gl_swap(&gl);
	/* rows of five bytes start at multiples of four, so every eight */
	ck_assert_uint_eq(s->textures[0]->texels[0], 10);
	ck_assert_uint_eq(s->textures[0]->texels[4], 11);
	ck_assert_uint_eq(s->textures[0]->texels[8], 18);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Sec. 3.8.10: an incomplete texture disables its unit; generated and specified levels complete it. */
START_TEST(test_completeness)
{
	static const uint8_t white[64] = { 255, 255, 255, 255, 0, 0, 0, 255, 255, 255, 255, 255, 0, 0, 0, 255 };
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glEnable", "e", GL_TEXTURE_2D);
	draw(&gl); /* no image at all */
	gl_call(&gl, "glTexImage2D", "eieiiieeb", GL_TEXTURE_2D, 0, GL_RGBA, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE,
	        sizeof(white), white);
	draw(&gl); /* the default filter needs mipmaps */
	gl_call(&gl, "glTexParameteri", "eee", GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	draw(&gl);
	gl_call(&gl, "glBindTexture", "eu", GL_TEXTURE_2D, 8u);
	gl_call(&gl, "glTexParameteri", "eei", GL_TEXTURE_2D, GL_GENERATE_MIPMAP, 1);
	gl_call(&gl, "glTexImage2D", "eieiiieeb", GL_TEXTURE_2D, 0, GL_RGBA, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE,
	        sizeof(white), white);
	draw(&gl);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_instances, 4);
	ck_assert_uint_eq(s->materials[s->instances[0].material].unit_count, 0);
	ck_assert_uint_eq(s->materials[s->instances[1].material].unit_count, 0);
	ck_assert_uint_eq(s->materials[s->instances[2].material].unit_count, 1);
	ck_assert_uint_eq(s->n_textures, 2);
	ck_assert_uint_eq(s->textures[0]->n_levels, 1);
	ck_assert_uint_eq(s->textures[1]->n_levels, 2);
	ck_assert_mem_eq(s->textures[1]->texels + 16, ((uint8_t[]){ 128, 128, 128, 255 }), 4);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* A part is replaced; a texture with the same contents under another name is the same. */
START_TEST(test_sub_image_and_content)
{
	static const uint8_t dark[16] = { 0 }, light[4] = { 9, 9, 9, 9 };
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glEnable", "e", GL_TEXTURE_2D);
	for (unsigned name = 1; name <= 3; name++) {
		gl_call(&gl, "glBindTexture", "eu", GL_TEXTURE_2D, name);
		gl_call(&gl, "glTexParameteri", "eee", GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
		gl_call(&gl, "glTexImage2D", "eieiiieeb", GL_TEXTURE_2D, 0, GL_RGBA, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE,
		        sizeof(dark), dark);
		if (name == 3)
			gl_call(&gl, "glTexSubImage2D", "eiiiiieeb", GL_TEXTURE_2D, 0, 1, 1, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE,
			        sizeof(light), light);
		draw(&gl);
	}
	gl_call(&gl, "glTexSubImage2D", "eiiiiieeb", GL_TEXTURE_2D, 0, 2, 1, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, sizeof(light),
	        light);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_textures, 2);
	ck_assert_uint_eq(s->textures[1]->texels[8], 0);
	ck_assert_uint_eq(s->textures[1]->texels[12], 9);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Sec. 2.11.4: eye planes are transformed by the inverse modelview matrix. */
START_TEST(test_texgen)
{
	static const float plane[4] = { 1, 0, 0, 0 };
	struct gl gl = gl_open();
	const struct scene_unit *u = &gl_state(&gl)->a.texturing.units[0].value;

	gl_call(&gl, "glTranslatef", "fff", 3.0, 0.0, 0.0);
	gl_call(&gl, "glTexGenfv", "eeF", GL_S, GL_EYE_PLANE, 4, plane);
	gl_call(&gl, "glTexGenfv", "eeF", GL_S, GL_OBJECT_PLANE, 4, plane);
	ck_assert_floats(4, u->gen_eye_plane[0], 1, 0, 0, -3);
	ck_assert_floats(4, u->gen_object_plane[0], 1, 0, 0, 0);
	gl_call(&gl, "glTexGeni", "eee", GL_R, GL_TEXTURE_GEN_MODE, GL_SPHERE_MAP);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_ENUM);
	gl_close(&gl);
}
END_TEST

/* PushAttrib(TEXTURE_BIT) saves bindings, and the parameters of bound objects that still exist (sec. 6.1.14, table
 * 6.16). */
START_TEST(test_pushed_parameters)
{
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glEnable", "e", GL_TEXTURE_2D);
	for (unsigned name = 5; name > 2; name--) {
		gl_call(&gl, "glBindTexture", "eu", GL_TEXTURE_2D, name);
		gl_call(&gl, "glTexImage2D", "eieiiieep", GL_TEXTURE_2D, 0, GL_RGBA, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, (uint64_t)0);
		gl_call(&gl, "glTexParameteri", "eee", GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	}
	gl_call(&gl, "glPushAttrib", "m", GL_TEXTURE_BIT);
	gl_call(&gl, "glTexParameteri", "eee", GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP);
	gl_call(&gl, "glTexParameteri", "eee", GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_LINEAR); /* incomplete
	                                                                                                         */
	gl_call(&gl, "glBindTexture", "eu", GL_TEXTURE_2D, 4u);
	gl_call(&gl, "glTexParameteri", "eee", GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
	gl_call(&gl, "glPopAttrib", "");
	draw(&gl);
	gl_call(&gl, "glBindTexture", "eu", GL_TEXTURE_2D, 4u); /* was not bound at that time */
	draw(&gl);
	gl_call(&gl, "glPushAttrib", "m", GL_TEXTURE_BIT);
	gl_call(&gl, "glDeleteTextures", "iU", 1, 1, (uint32_t[]){ 4 });
	gl_call(&gl, "glPopAttrib", "");
	gl_call(&gl, "glBindTexture", "eu", GL_TEXTURE_2D, 3u);
	gl_call(&gl, "glPushAttrib", "m", GL_ENABLE_BIT);
	gl_call(&gl, "glTexParameteri", "eee", GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP);
	gl_call(&gl, "glPopAttrib", "");
	draw(&gl);
	ck_assert_uint_eq(gl_error(&gl), 0);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_units, 3);
	ck_assert_uint_eq(s->units[0].wrap_s, GL_REPEAT);
	ck_assert_uint_eq(s->units[0].min_filter, GL_LINEAR);
	ck_assert_uint_eq(s->units[1].wrap_s, GL_CLAMP_TO_EDGE);
	ck_assert_uint_eq(s->units[2].wrap_s, GL_CLAMP);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Sampler objects (GL 3.3 sec. 3.8.2) replace the parameters of the texture bound to their unit, also for
 * completeness. */
START_TEST(test_samplers)
{
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glEnable", "e", GL_TEXTURE_2D);
	gl_call(&gl, "glTexImage2D", "eieiiieep", GL_TEXTURE_2D, 0, GL_RGBA, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, (uint64_t)0);
	draw(&gl); /* its own filter needs levels that are missing */
	gl_call(&gl, "glSamplerParameteri", "uee", 4, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	gl_call(&gl, "glSamplerParameteri", "uee", 4, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
	gl_call(&gl, "glBindSampler", "uu", 0, 4);
	draw(&gl);
	gl_call(&gl, "glDeleteSamplers", "iU", 1, 1, (uint32_t[]){ 4 });
	draw(&gl);
	s = gl_swap(&gl);
	ck_assert_uint_eq(gl_error(&gl), 0);
	ck_assert_uint_eq(s->materials[s->instances[0].material].unit_count, 0);
	ck_assert_uint_eq(s->materials[s->instances[1].material].unit_count, 1);
	ck_assert_uint_eq(s->units[0].wrap_s, GL_CLAMP_TO_EDGE);
	ck_assert_uint_eq(s->units[0].min_filter, GL_LINEAR);
	ck_assert_uint_eq(s->materials[s->instances[2].material].unit_count, 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Sec. 2.5: requests beyond memory give OUT_OF_MEMORY, at llvmpipe's limit. It accepts 16384 by 16384 texels. */
START_TEST(test_largest)
{
	struct gl gl = gl_open();

	gl_call(&gl, "glTexStorage3D", "eieiii", GL_TEXTURE_3D, 1, GL_RGBA8, 1024, 1024, 512);
	ck_assert_uint_eq(gl_error(&gl), GL_OUT_OF_MEMORY);
	gl_call(&gl, "glTexStorage2D", "eieii", GL_TEXTURE_2D, 1, GL_RGBA32F, 16384, 8192);
	ck_assert_uint_eq(gl_error(&gl), GL_OUT_OF_MEMORY);
	gl_call(&gl, "glTexStorage2D", "eieii", GL_TEXTURE_2D, 1, GL_RGBA8, 16384, 16384);
	ck_assert_uint_eq(gl_error(&gl), GL_NO_ERROR);
	gl_close(&gl);
}
END_TEST

/* Sec. 3.8.1: an image is at least as large as its borders; one of exactly that size has no texels. */
START_TEST(test_borders_only)
{
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glEnable", "e", GL_TEXTURE_2D);
	gl_call(&gl, "glTexParameteri", "eee", GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	gl_call(&gl, "glTexImage2D", "eieiiieep", GL_TEXTURE_2D, 0, GL_RGBA8, 4, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, (uint64_t)0);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE);
	gl_call(&gl, "glTexImage2D", "eieiiieep", GL_TEXTURE_2D, 0, GL_RGBA8, 1, 4, 1, GL_RGBA, GL_UNSIGNED_BYTE, (uint64_t)0);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE);
	gl_call(&gl, "glTexImage3D", "eieiiiieep", GL_TEXTURE_3D, 0, GL_RGBA8, 4, 4, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE,
	        (uint64_t)0);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE);
	gl_call(&gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0);
	gl_call(&gl, "glTexImage2D", "eieiiieep", GL_TEXTURE_2D, 0, GL_RGBA8, 4, 2, 1, GL_RGBA, GL_UNSIGNED_BYTE, (uint64_t)0);
	ck_assert_uint_eq(gl_error(&gl), GL_NO_ERROR);
	gl_call(&gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_textures, 0);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Borders (sec. 3.8.1) surround each dimension of a texture. */
START_TEST(test_borders)
{
	static const uint8_t texels[64] = { 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20 };
	static const uint32_t targets[3] = { GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_3D };
	struct gl gl = gl_open();
	struct scene *s;

	gl_call(&gl, "glPixelStorei", "ei", GL_UNPACK_ALIGNMENT, 1);
	for (unsigned i = 0; i < 3; i++) {
		gl_call(&gl, "glEnable", "e", targets[i]);
		gl_call(&gl, "glTexParameteri", "eee", targets[i], GL_TEXTURE_MIN_FILTER, GL_NEAREST);
		if (i == 0)
			gl_call(&gl, "glTexImage1D", "eieiieeb", targets[i], 0, GL_ALPHA, 6, 1, GL_ALPHA,
			        GL_UNSIGNED_BYTE, (size_t)6, texels);
		else if (i == 1)
			gl_call(&gl, "glTexImage2D", "eieiiieeb", targets[i], 0, GL_ALPHA, 4, 3, 1, GL_ALPHA,
			        GL_UNSIGNED_BYTE, (size_t)12, texels);
		else
			gl_call(&gl, "glTexImage3D", "eieiiiieeb", targets[i], 0, GL_ALPHA, 3, 4, 4, 1, GL_ALPHA,
			        GL_UNSIGNED_BYTE, (size_t)48, texels);
		draw(&gl);
	}
	ck_assert_uint_eq(gl_error(&gl), GL_NO_ERROR);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_textures, 3);
	for (unsigned i = 0; i < 3; i++) {
		static const uint32_t sizes[3][3] = { { 4, 1, 1 }, { 2, 1, 1 }, { 1, 2, 2 } }, bytes[3] = { 6, 12, 48 };
		const struct scene_texture *t = s->textures[i];

		ck_assert_uint_eq(t->width, sizes[i][0]);
		ck_assert_uint_eq(t->height, sizes[i][1]);
		ck_assert_uint_eq(t->depth, sizes[i][2]);
		ck_assert_uint_eq(t->border, 1);
		ck_assert_uint_eq(t->n_bytes, 4 * bytes[i]);
		ck_assert_uint_eq(t->texels[4 * 5 + 3], 6);
	}
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Generated levels of 3D textures average eight texels (sec. 3.8.8), for each kind of format that is averaged
 * differently. */
START_TEST(test_levels_of_volumes)
{
	static const uint32_t formats[] = { GL_RGBA8, GL_RGBA32F, GL_RGB9_E5, GL_LUMINANCE8 };
	static const float wanted[8] = { 28, 36, 32, 40, 92, 100, 96, 104 };
	float texels[64];

	for (unsigned i = 0; i < 64; i++)
		texels[i] = (float)(4 * (i % 4) + 2 * (i / 4 % 4) + 32 * (i / 16) + 9) / 255;
	for (unsigned f = 0; f < sizeof(formats) / sizeof(formats[0]); f++) {
		const float scale = formats[f] == GL_RGBA32F || formats[f] == GL_RGB9_E5 ? 255 : 1;
		struct gl gl = gl_open();
		float scaled[64];
		struct scene *s;

		for (unsigned i = 0; i < 64; i++)
			scaled[i] = texels[i] * scale;
		gl_call(&gl, "glEnable", "e", GL_TEXTURE_3D);
		gl_call(&gl, "glTexParameteri", "eei", GL_TEXTURE_3D, GL_GENERATE_MIPMAP, 1);
		gl_call(&gl, "glTexParameteri", "eee", GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
		gl_call(&gl, "glTexImage3D", "eieiiiieeb", GL_TEXTURE_3D, 0, formats[f], 4, 4, 4, 0, GL_RED, GL_FLOAT,
		        sizeof(scaled), scaled);
		draw(&gl);
		s = gl_swap(&gl);
		ck_assert_uint_eq(s->textures[0]->n_levels, 3);
		for (unsigned i = 0; i < 8; i++) {
			const uint8_t *t = s->textures[0]->texels + (s->textures[0]->floats ? 16 : 4) * (64 + i);
			float first = *t;

			if (s->textures[0]->floats)
				memcpy(&first, t, sizeof(first));
			ck_assert_msg(fabsf(first - wanted[i]) < 1e-3f, "format %#x, texel %u: %g, not %g", formats[f], i, first, wanted[i]);
		}
		scene_release(&s);
		gl_close(&gl);
	}
}
END_TEST

GL_TESTS("textures", test_borders, test_levels_of_volumes, test_borders_only, test_pushed_parameters, test_samplers,
         test_formats, test_unpack, test_completeness, test_sub_image_and_content, test_largest, test_texgen)
