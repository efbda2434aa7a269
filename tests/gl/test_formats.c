/*
 * Internal formats other than 8-bit RGBA: small ones, red and green alone, sRGB, packed depth and stencil, compressed
 * blocks; swizzles and border colours (EXT_texture_sRGB, EXT_packed_depth_stencil, EXT_texture_compression_s3tc,
 * 3DFX_texture_compression_FXT1, EXT_texture_swizzle; GL 2.1 sec. 3.8.1, 3.8.3, 3.8.8).
 */
#include "replay/gl/texture/unpack.h"
#include "tests/gl/gl.h"

static void draw(struct gl *gl)
{
	gl_call(gl, "glRectf", "ffff", 0.0, 0.0, 1.0, 1.0);
}

static struct gl begin(void)
{
	struct gl gl = gl_open();

	gl_call(&gl, "glEnable", "e", GL_TEXTURE_2D);
	gl_call(&gl, "glTexParameteri", "eee", GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	gl_call(&gl, "glPixelStorei", "ei", GL_UNPACK_ALIGNMENT, 1);
	return gl;
}

/* One texel of a format as the scene shows it. */
static void check_texel(uint32_t internal, uint32_t format, uint32_t type, size_t n, const void *pixel, uint32_t base,
                        const uint8_t wanted[4])
{
	struct gl gl = begin();
	struct scene *s;

	gl_call(&gl, "glTexImage2D", "eieiiieeb", GL_TEXTURE_2D, 0, internal, 1, 1, 0, format, type, n, pixel);
	draw(&gl);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_textures, 1);
	ck_assert_uint_eq(s->textures[0]->base_format, base);
	ck_assert_mem_eq(s->textures[0]->texels, wanted, 4);
	ck_assert_uint_eq(gl_unsupported(&gl), 0);
	scene_release(&s);
	gl_close(&gl);
}

START_TEST(test_texels)
{
	static const uint8_t rgba[4] = { 100, 150, 200, 90 };

	check_texel(GL_RED, GL_RGBA, GL_UNSIGNED_BYTE, 4, rgba, GL_RED, (uint8_t[]){ 100, 0, 0, 255 });
	check_texel(GL_RG, GL_RG, GL_UNSIGNED_BYTE, 2, rgba, GL_RG, (uint8_t[]){ 100, 150, 0, 255 });
	check_texel(GL_RGBA4, GL_RGBA, GL_UNSIGNED_BYTE, 4, rgba, GL_RGBA, (uint8_t[]){ 102, 153, 204, 85 });
	check_texel(GL_RGB5_A1, GL_RGBA, GL_UNSIGNED_BYTE, 4, rgba, GL_RGBA, (uint8_t[]){ 99, 148, 198, 0 });
	check_texel(GL_R3_G3_B2, GL_RGBA, GL_UNSIGNED_BYTE, 4, rgba, GL_RGB, (uint8_t[]){ 109, 146, 170, 255 });
	check_texel(GL_COMPRESSED_RGB, GL_RGBA, GL_UNSIGNED_BYTE, 4, rgba, GL_RGB, (uint8_t[]){ 99, 150, 206, 255 });
}
END_TEST

/* One texel of a floating-point format as the scene shows it, and copied over another one (sec. 3.8.2). */
static void check_numbers(uint32_t internal, uint32_t type, const void *pixel, const float wanted[4])
{
	const size_t n = type == GL_FLOAT ? 16 : 8;
	uint8_t two[32];
	struct gl gl = begin();
	struct scene *s;

	memset(two, 0, sizeof(two));
	memcpy(two, pixel, n);
	gl_call(&gl, "glTexImage2D", "eieiiieeb", GL_TEXTURE_2D, 0, internal, 2, 1, 0, GL_RGBA, type, 2 * n, two);
	gl_call(&gl, "glTexSubImage2D", "eiiiiieeb", GL_TEXTURE_2D, 0, 1, 0, 1, 1, GL_RGBA, type, n, pixel);
	draw(&gl);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_textures, 1);
	ck_assert_uint_eq(s->textures[0]->floats, 1);
	for (unsigned i = 0; i < 2; i++)
		ck_assert_floats(4, (const float *)(const void *)s->textures[0]->texels + 4 * i, wanted[0], wanted[1],
		                 wanted[2], wanted[3]);
	ck_assert_uint_eq(gl_unsupported(&gl), 0);
	scene_release(&s);
	gl_close(&gl);
}

/* Colours of EXT_texture_sRGB become linear light, within llvmpipe's half a code of 0.1274, 0.3050 and 0.5776; alpha
 * is not converted. */
START_TEST(test_linear_light)
{
	static const uint8_t rgba[4] = { 100, 150, 200, 90 };
	struct gl gl = begin();
	struct scene *s;

	gl_call(&gl, "glTexImage2D", "eieiiieeb", GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE,
	        (size_t)4, rgba);
	draw(&gl);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->textures[0]->floats, 1);
	ck_assert_floats(4, (const float *)(const void *)s->textures[0]->texels, 0.128293f, 0.305337f, 0.576576f, 90 / 255.0f);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* ARB_texture_float, EXT_packed_float, EXT_texture_shared_exponent, EXT_texture_snorm. */
START_TEST(test_numbers)
{
	static const uint16_t halves[4] = { 0x3800, 0xbc00, 0x4200, 0x3400 }; /* 0.5 -1 3 0.25 */
	static const float numbers[4] = { 0.1f, 1.3f, 10, -0.25f };

	check_numbers(GL_RGBA32F, GL_FLOAT, numbers, (float[]){ 0.1f, 1.3f, 10, -0.25f });
	check_numbers(GL_INTENSITY32F_ARB, GL_FLOAT, numbers, (float[]){ 0.1f, 0.1f, 0.1f, 0.1f });
	check_numbers(GL_RGBA16F, GL_HALF_FLOAT, halves, (float[]){ 0.5f, -1, 3, 0.25f });
	check_numbers(GL_RGBA16F, GL_FLOAT, numbers, (float[]){ 0.0999756f, 1.299805f, 10, -0.25f });
	check_numbers(GL_R11F_G11F_B10F, GL_FLOAT, numbers, (float[]){ 0.0996094f, 1.296875f, 10, 1 });
	check_numbers(GL_RGB9_E5, GL_FLOAT, numbers, (float[]){ 0.09375f, 1.3125f, 10, 1 });
	check_numbers(GL_RGBA8_SNORM, GL_FLOAT, numbers, (float[]){ 13 / 127.0f, 1, 1, -32 / 127.0f });
	check_numbers(GL_LUMINANCE_ALPHA16F_ARB, GL_HALF_FLOAT, halves, (float[]){ 0.5f, 0.5f, 0.5f, 0.25f });
}
END_TEST

static void copy_image(struct gl *gl, uint32_t from, uint32_t to, int x, int width)
{
	gl_call(gl, "glCopyImageSubData", "ueiiiiueiiiiiii", from, GL_TEXTURE_2D, 0, 0, 0, 0, to, GL_TEXTURE_2D, 0, x,
	        1, 0, width, 1, 1);
}

/* ARB_copy_image: unconverted texels, between textures and within one; regions outside an image are errors. */
START_TEST(test_copy_image)
{
	static const uint8_t bytes[4] = { 10, 20, 30, 40 };
	struct gl gl = begin();
	struct scene *s;

	for (uint32_t name = 1; name < 4; name++) {
		gl_call(&gl, "glBindTexture", "eu", GL_TEXTURE_2D, name);
		gl_call(&gl, "glTexParameteri", "eee", GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
		gl_call(&gl, "glTexImage2D", "eieiiieeb", GL_TEXTURE_2D, 0, name < 3 ? GL_ALPHA : GL_ALPHA32F_ARB, 2, 2,
		        0, GL_ALPHA, GL_UNSIGNED_BYTE, (size_t)4, bytes);
	}
	gl_call(&gl, "glBindTexture", "eu", GL_TEXTURE_2D, 2u);
	draw(&gl);
	copy_image(&gl, 1, 2, 0, 2);
	draw(&gl);
	copy_image(&gl, 2, 2, 1, 1); /* 10 where 20 was */
	ck_assert_uint_eq(gl_error(&gl), 0);
	draw(&gl);
	copy_image(&gl, 1, 2, 1, 2);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE);
	copy_image(&gl, 1, 7, 0, 1);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE);
	ck_assert_uint_eq(gl_unsupported(&gl), 0);
	copy_image(&gl, 1, 3, 0, 1);
	ck_assert_uint_eq(gl_unsupported(&gl), 1);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->n_textures, 3);
	ck_assert_mem_eq(s->textures[0]->texels, ((uint8_t[]){ 0, 0, 0, 10, 0, 0, 0, 20, 0, 0, 0, 30, 0, 0, 0, 40 }), 16);
	ck_assert_mem_eq(s->textures[1]->texels, ((uint8_t[]){ 0, 0, 0, 10, 0, 0, 0, 20, 0, 0, 0, 10, 0, 0, 0, 20 }), 16);
	ck_assert_mem_eq(s->textures[2]->texels, ((uint8_t[]){ 0, 0, 0, 10, 0, 0, 0, 20, 0, 0, 0, 10, 0, 0, 0, 10 }), 16);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Sec. 3.6.4: SKIP_IMAGES applies only to three dimensions. */
START_TEST(test_skipped_images)
{
	static const uint8_t bytes[2] = { 50, 60 };
	struct gl gl = begin();
	struct scene *s;

	gl_call(&gl, "glPixelStorei", "ei", GL_UNPACK_SKIP_IMAGES, 1);
	gl_call(&gl, "glTexImage2D", "eieiiieeb", GL_TEXTURE_2D, 0, GL_ALPHA, 1, 1, 0, GL_ALPHA, GL_UNSIGNED_BYTE,
	        (size_t)2, bytes);
	draw(&gl);
	gl_call(&gl, "glEnable", "e", GL_TEXTURE_3D);
	gl_call(&gl, "glTexParameteri", "eee", GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	gl_call(&gl, "glTexImage3D", "eieiiiieeb", GL_TEXTURE_3D, 0, GL_ALPHA, 1, 1, 1, 0, GL_ALPHA, GL_UNSIGNED_BYTE,
	        (size_t)2, bytes);
	draw(&gl);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->textures[0]->texels[3], 50);
	ck_assert_uint_eq(s->textures[1]->texels[3], 60);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Indices through the maps (sec. 3.6.5), levels without texels (ARB_texture_storage), a single value everywhere
 * (ARB_clear_texture). */
START_TEST(test_other_images)
{
	static const float zero_one[2] = { 0, 1 };
	static const uint8_t bits = 0x40, pixel[4] = { 9, 8, 7, 6 };
	struct gl gl = begin();
	struct scene *s;

	gl_call(&gl, "glPixelMapfv", "eiF", GL_PIXEL_MAP_I_TO_G, 2, 2, zero_one);
	gl_call(&gl, "glTexImage2D", "eieiiieeb", GL_TEXTURE_2D, 0, GL_RGB, 2, 1, 0, GL_COLOR_INDEX, GL_BITMAP,
	        (size_t)1, &bits);
	draw(&gl);
	gl_call(&gl, "glBindTexture", "eu", GL_TEXTURE_2D, 5);
	gl_call(&gl, "glTexStorage2D", "eieii", GL_TEXTURE_2D, 3, GL_RGBA8, 4, 2);
	gl_call(&gl, "glClearTexImage", "uieeb", 5, 1, GL_RGBA, GL_UNSIGNED_BYTE, (size_t)4, pixel);
	draw(&gl);
	ck_assert_uint_eq(gl_unsupported(&gl), 0);
	ck_assert_uint_eq(gl_error(&gl), 0);
	s = gl_swap(&gl);
	ck_assert_mem_eq(s->textures[0]->texels, ((uint8_t[]){ 0, 0, 0, 255, 0, 255, 0, 255 }), 8);
	ck_assert_uint_eq(s->textures[1]->n_levels, 3); /* 4x2, 2x1, 1x1 */
	ck_assert_uint_eq(s->textures[1]->texels[0], 0);
	ck_assert_mem_eq(s->textures[1]->texels + 32, ((uint8_t[]){ 9, 8, 7, 6, 9, 8, 7, 6, 0, 0, 0, 0 }), 12);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

START_TEST(test_srgb_as_it_is)
{
	static const uint8_t rgba[4] = { 100, 150, 200, 90 };
	struct gl gl = begin();
	struct scene *s;

	gl_call(&gl, "glTexImage2D", "eieiiieeb", GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE,
	        (size_t)4, rgba);
	gl_call(&gl, "glTexParameteri", "eee", GL_TEXTURE_2D, GL_TEXTURE_SRGB_DECODE_EXT, GL_SKIP_DECODE_EXT);
	draw(&gl);
	s = gl_swap(&gl);
	ck_assert_mem_eq(s->textures[0]->texels, rgba, 4);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Generated levels of sRGB colours average linear light; alpha is averaged directly. */
START_TEST(test_srgb_levels)
{
	static const uint8_t half[16] = { 255, 255, 255, 255, 0, 0, 0, 0, 255, 255, 255, 255, 0, 0, 0, 0 };
	struct gl gl = begin();
	struct scene *s;

	gl_call(&gl, "glTexParameteri", "eei", GL_TEXTURE_2D, GL_GENERATE_MIPMAP, 1);
	gl_call(&gl, "glTexParameteri", "eee", GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
	gl_call(&gl, "glTexParameteri", "eee", GL_TEXTURE_2D, GL_TEXTURE_SRGB_DECODE_EXT, GL_SKIP_DECODE_EXT);
	gl_call(&gl, "glTexImage2D", "eieiiieeb", GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, 2, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE,
	        sizeof(half), half);
	draw(&gl);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->textures[0]->n_levels, 2);
	for (unsigned c = 0; c < 4; c++)
		ck_assert_int_le(abs(s->textures[0]->texels[16 + c] - (c < 3 ? 188 : 128)), 1);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* An image of one block as the scene shows it. */
static struct scene *show_block(struct gl *gl, uint32_t internal, int width, int height, size_t n, const void *block)
{
	gl_call(gl, "glCompressedTexImage2D", "eieiiiib", GL_TEXTURE_2D, 0, internal, width, height, 0, (int)n, n, block);
	draw(gl);
	return gl_swap(gl);
}

/* Independent channels (ARB_texture_compression_rgtc): 8 levels, or 6 and both ends; signed ones range from -1 to 1. */
START_TEST(test_rgtc)
{
	/* texels 0..3 of the first row are codes 0 1 2 6 */
	static const uint8_t blocks[16] = { 0xf0, 0x10, 0x88, 0x0c, 0, 0, 0, 0, 0x10, 0x70, 0x88, 0x0c, 0, 0, 0, 0 };
	struct gl gl = begin();
	struct scene *s = show_block(&gl, GL_COMPRESSED_RG_RGTC2, 4, 4, 16, blocks);

	ck_assert_mem_eq(s->textures[0]->texels,
	                 ((uint8_t[]){ 240, 16, 0, 255, 16, 112, 0, 255, 208, 35, 0, 255, 80, 0, 0, 255 }), 16);
	scene_release(&s);
	s = show_block(&gl, GL_COMPRESSED_SIGNED_LUMINANCE_LATC1_EXT, 4, 4, 8, blocks);
	for (unsigned i = 0; i < 4; i++) {
		static const float l[4] = { -16 / 127.0f, 16 / 127.0f, -10 / 127.0f, -1 };

		ck_assert_floats(4, (const float *)(const void *)s->textures[0]->texels + 4 * i, l[i], l[i], l[i], 1);
	}
	scene_release(&s);
	ck_assert_uint_eq(gl_unsupported(&gl), 0);
	gl_close(&gl);
}
END_TEST

START_TEST(test_s3tc)
{
	/* interpolation in steps of 1/256, rounded down, with the middle rounded up, as in llvmpipe */
	/* red 31 and blue 31; texels 0..3 of the first row are codes 0 1 2 3, all others code 0 */
	static const uint8_t four[8] = { 0x00, 0xf8, 0x1f, 0x00, 0xe4, 0, 0, 0 },
			     three[8] = { 0x1f, 0x00, 0x00, 0xf8, 0xe4, 0, 0, 0 };
	static const uint8_t dxt3[16] = { 0x10, 0x32, 0, 0, 0, 0, 0, 0, 0x1f, 0x00, 0x00, 0xf8, 0xe4, 0, 0, 0 };
	static const uint8_t dxt5[16] = { 70, 0, 0x88, 0x0c, 0, 0, 0, 0, 0x1f, 0x00, 0x00, 0xf8, 0xe4, 0, 0, 0 };
	struct gl gl = begin();
	struct scene *s = show_block(&gl, GL_COMPRESSED_RGB_S3TC_DXT1_EXT, 4, 4, 8, four);
	const uint8_t *t = s->textures[0]->texels;

	ck_assert_mem_eq(
		t, ((uint8_t[]){ 255, 0, 0, 255, 0, 0, 255, 255, 170, 0, 84, 255, 85, 0, 169, 255, 255, 0, 0, 255 }),
		20);
	scene_release(&s);
	s = show_block(&gl, GL_COMPRESSED_RGBA_S3TC_DXT1_EXT, 4, 4, 8, three);
	t = s->textures[0]->texels;
	ck_assert_mem_eq(t, ((uint8_t[]){ 0, 0, 255, 255, 255, 0, 0, 255, 128, 0, 128, 255, 0, 0, 0, 0 }), 16);
	scene_release(&s);
	s = show_block(&gl, GL_COMPRESSED_RGB_S3TC_DXT1_EXT, 3, 2, 8, three); /* clipped: three texels of two rows */
	ck_assert_uint_eq(s->textures[0]->n_bytes, 24);
	scene_release(&s);
	s = show_block(&gl, GL_COMPRESSED_RGBA_S3TC_DXT3_EXT, 4, 4, 16, dxt3);
	t = s->textures[0]->texels;
	ck_assert_mem_eq(t, ((uint8_t[]){ 0, 0, 255, 0, 255, 0, 0, 17, 84, 0, 170, 34, 169, 0, 85, 51 }), 16);
	scene_release(&s);
	s = show_block(&gl, GL_COMPRESSED_RGBA_S3TC_DXT5_EXT, 4, 4, 16, dxt5); /* codes 0 1 2 6: 70, 0, 6/7 and 2/7 of 70 */
	t = s->textures[0]->texels;
	ck_assert_uint_eq(t[3], 70);
	ck_assert_uint_eq(t[7], 0x0c88 >> 3 & 1 ? 0 : 255);
	ck_assert_uint_eq(t[11], 60);
	ck_assert_uint_eq(t[15], 20);
	scene_release(&s);
	gl_call(&gl, "glCompressedTexImage2D", "eieiiiib", GL_TEXTURE_2D, 0, GL_COMPRESSED_RGB_S3TC_DXT1_EXT, 8, 8, 0,
	        8, (size_t)8, four);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE); /* too few blocks */
	gl_call(&gl, "glCompressedTexImage3D", "eieiiiiib", GL_TEXTURE_3D, 0, GL_COMPRESSED_RGB_S3TC_DXT1_EXT,
	        INT32_MAX, INT32_MAX, INT32_MAX, 0, 8, (size_t)8, four);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_VALUE); /* the block count overflows 64 bits */
	gl_close(&gl);
}
END_TEST

/* The four kinds of blocks. From bit 64 on: 15-bit colours, blue in the lowest bits. */
/* Uncompressed images become blocks as well: with one 5-6-5-bit colour, with two colours, with one-bit alpha. */
START_TEST(test_plain_s3tc)
{
	struct gl gl = begin();
	uint8_t texels[16][4];
	struct scene *s;

	for (unsigned how = 0; how < 3; how++) {
		for (unsigned i = 0; i < 16; i++) {
			const uint8_t kinds[3][4] = { { 100, 101, 102, 255 },
				                      { i & 1 ? 255 : 0, 0, i & 1 ? 0 : 255, 255 },
				                      { 80, 0, 0, i & 1 ? 127 : 128 } };

			memcpy(texels[i], kinds[how], 4);
		}
		gl_call(&gl, "glTexImage2D", "eieiiieeb", GL_TEXTURE_2D, 0,
		        how == 2 ? GL_COMPRESSED_RGBA_S3TC_DXT1_EXT : GL_COMPRESSED_RGB, 4, 4, 0, GL_RGBA,
		        GL_UNSIGNED_BYTE, sizeof(texels), texels);
		draw(&gl);
		s = gl_swap(&gl);
		for (unsigned i = 0; i < 16; i++) {
			const uint8_t left[3][4] = { { 99, 101, 99, 255 },
				                     { i & 1 ? 255 : 0, 0, i & 1 ? 0 : 255, 255 },
				                     { i & 1 ? 0 : 82, 0, 0, i & 1 ? 0 : 255 } };

			ck_assert_mem_eq(s->textures[0]->texels + 4 * i, left[how], 4);
		}
		scene_release(&s);
	}
	ck_assert_uint_eq(gl_unsupported(&gl), 0);
	gl_close(&gl);
}
END_TEST

START_TEST(test_fxt1)
{
	uint8_t block[16] = { 0 };
	struct gl gl = begin();
	struct scene *s;
	const uint8_t *t;

	/* CC_HI: colours at 96 and 111, three bits per texel: 6 and 7 (transparent) are the first two */
	block[0] = 6 | 7 << 3;
	block[12] = 31; /* the first is blue */
	block[15] = 0x3e; /* the second, red: bits 121 to 125 */
	s = show_block(&gl, GL_COMPRESSED_RGBA_FXT1_3DFX, 8, 4, 16, block);
	t = s->textures[0]->texels;
	ck_assert_mem_eq(t, ((uint8_t[]){ 255, 0, 0, 255, 0, 0, 0, 0, 0, 0, 255, 255 }), 12);
	scene_release(&s);
	/* CC_CHROMA: four colours at 64, 79, 94, 109; two bits per texel */
	memset(block, 0, 16);
	block[15] = 0x40 | 0x0f; /* mode 010; red of the fourth: bits 119 to 123 */
	block[14] = 0x80;
	block[0] = 3;
	s = show_block(&gl, GL_COMPRESSED_RGB_FXT1_3DFX, 8, 4, 16, block);
	t = s->textures[0]->texels;
	ck_assert_mem_eq(t, ((uint8_t[]){ 255, 0, 0, 255, 0, 0, 0, 255 }), 8);
	scene_release(&s);
	/* CC_ALPHA, not interpolated: three colours and alphas at 109, 114, 119; code 3 is transparent */
	memset(block, 0, 16);
	block[15] = 0x60;
	block[13] = 0xe0; /* alpha of the first: bits 109 to 113 */
	block[14] = 0x03;
	block[8] = 31;
	block[0] = 3 << 2;
	s = show_block(&gl, GL_COMPRESSED_RGBA_FXT1_3DFX, 8, 4, 16, block);
	t = s->textures[0]->texels;
	ck_assert_mem_eq(t, ((uint8_t[]){ 0, 0, 255, 255, 0, 0, 0, 0 }), 8);
	scene_release(&s);
	/* CC_MIXED with the transparent code: the left half's colours at 64 and 79 */
	memset(block, 0, 16);
	block[15] = 0x90;
	block[8] = 31;
	block[0] = 1 | 3 << 2;
	s = show_block(&gl, GL_COMPRESSED_RGBA_FXT1_3DFX, 8, 4, 16, block);
	t = s->textures[0]->texels;
	ck_assert_mem_eq(t, ((uint8_t[]){ 0, 0, 127, 255, 0, 0, 0, 0, 0, 0, 255, 255 }), 12);
	scene_release(&s);
	/* Without it, in thirds; bits 125 and 126 are the lowest bits of green, that of the first colour XORed with
	 * the first code's high bit */
	memset(block, 0, 16);
	block[15] = 0x80 | 0x40;
	block[8] = 31;
	block[11] = 0x3e | 0xc0; /* the left half's second is red; the right half's first, at 94, is blue */
	block[12] = 0x07;
	block[0] = 1 << 2 | 2 << 4 | 3 << 6;
	block[4] = 2;
	s = show_block(&gl, GL_COMPRESSED_RGB_FXT1_3DFX, 8, 4, 16, block);
	t = s->textures[0]->texels;
	ck_assert_mem_eq(
		t, ((uint8_t[]){ 0, 0, 255, 255, 85, 0, 170, 255, 170, 0, 85, 255, 255, 0, 0, 255, 0, 3, 85, 255 }),
		20);
	scene_release(&s);
	/* CC_ALPHA in thirds: from the first colour on the left, the third on the right, to the second */
	memset(block, 0, 16);
	block[15] = 0x70;
	block[13] = 0xe0;
	block[14] = 0x03;
	block[8] = 31;
	block[11] = 0x3e;
	block[0] = 1 << 2 | 2 << 4 | 3 << 6;
	block[4] = 3;
	s = show_block(&gl, GL_COMPRESSED_RGBA_FXT1_3DFX, 8, 4, 16, block);
	t = s->textures[0]->texels;
	ck_assert_mem_eq(t, ((uint8_t[]){ 0,   0, 255, 255, 85,  0, 170, 170, 170, 0, 85, 85,
	                                  255, 0, 0,   0,   255, 0, 0,   0,   0,   0, 0,  0 }),
	                 24);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* Depth and stencil values in one image: the depth is sampled, both are drawn as pixels. */
START_TEST(test_packed_depth_stencil)
{
	static const uint32_t pixels[2] = { 0x80000012, 0xffffff34 };
	struct gl gl = begin();
	struct scene *s;
	float depth[2];

	gl_call(&gl, "glTexImage2D", "eieiiieeb", GL_TEXTURE_2D, 0, GL_DEPTH24_STENCIL8, 2, 1, 0, GL_DEPTH_STENCIL,
	        GL_UNSIGNED_INT_24_8, sizeof(pixels), pixels);
	draw(&gl);
	gl_call(&gl, "glDrawPixels", "iieeb", 2, 1, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8, sizeof(pixels), pixels);
	ck_assert_uint_eq(gl_unsupported(&gl), 0);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->textures[0]->base_format, GL_DEPTH_COMPONENT);
	ck_assert_uint_eq(s->textures[0]->n_bytes, 8);
	memcpy(depth, s->textures[0]->texels, 8);
	ck_assert_float_eq_tol(depth[0], 0.5f, 1e-6f);
	ck_assert_float_eq(depth[1], 1);
	ck_assert_uint_eq(s->n_rectangles, 2);
	ck_assert_uint_eq(s->rectangles[0].kind, SCENE_DEPTH_PIXELS);
	ck_assert_uint_eq(s->materials[s->instances[1].material].color_mask, 0);
	ck_assert_uint_eq(s->rectangles[1].kind, SCENE_STENCIL_PIXELS);
	ck_assert_uint_eq(s->textures[s->rectangles[1].texture]->texels[0], 0x12);
	ck_assert_uint_eq(s->textures[s->rectangles[1].texture]->texels[4], 0x34);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

/* DEPTH_STENCIL with a type too small for both, an error in GL: no bytes beyond the pixels are read. */
START_TEST(test_small_depth_stencil)
{
	static const struct gls_pixel_store store = { .alignment = 1 };
	static const uint8_t bytes[8] = { 255, 255, 255, 255, 255, 255, 255, 255 };
	struct gls_pixels p = {
		.format = GL_DEPTH_STENCIL, .type = GL_UNSIGNED_BYTE, .width = 2, .height = 1, .data = bytes + 4, .n = 2,
		.store = &store
	};
	uint8_t out[2] = { 1, 1 };

	gls_unpack_stencil(&p, out);
	ck_assert_uint_eq(out[0], 0);
	ck_assert_uint_eq(out[1], 0);
}
END_TEST

START_TEST(test_swizzle_and_border)
{
	static const uint32_t gray_from_blue[4] = { GL_BLUE, GL_BLUE, GL_BLUE, GL_ONE };
	static const float border[4] = { 0.25f, 0.5f, 0.75f, 1 };
	static const uint8_t texel[4] = { 1, 2, 3, 4 };
	struct gl gl = begin();
	struct scene *s;

	gl_call(&gl, "glTexImage2D", "eieiiieeb", GL_TEXTURE_2D, 0, GL_LUMINANCE_ALPHA, 1, 1, 0, GL_RGBA,
	        GL_UNSIGNED_BYTE, (size_t)4, texel);
	gl_call(&gl, "glTexParameterfv", "eeF", GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, 4, border);
	draw(&gl);
	gl_call(&gl, "glTexParameteriv", "eeU", GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_RGBA, 4, gray_from_blue);
	draw(&gl);
	gl_call(&gl, "glTexParameteri", "eee", GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_R, GL_TEXTURE_2D);
	ck_assert_uint_eq(gl_error(&gl), GL_INVALID_ENUM);
	s = gl_swap(&gl);
	ck_assert_uint_eq(s->units[0].swizzle, 0);
	ck_assert_float_eq(s->units[0].border_color[2], 0.25f); /* luminance takes the value that red had */
	ck_assert_float_eq(s->units[0].border_color[3], 1);
	ck_assert_uint_eq(s->units[1].swizzle, SCENE_SWIZZLED | 2 | 2 << 3 | 2 << 6 | 5 << 9);
	scene_release(&s);
	gl_close(&gl);
}
END_TEST

GL_TESTS("formats", test_texels, test_linear_light, test_numbers, test_copy_image, test_rgtc, test_other_images,
         test_skipped_images, test_srgb_as_it_is, test_srgb_levels, test_s3tc, test_plain_s3tc, test_fxt1,
         test_packed_depth_stencil, test_small_depth_stencil, test_swizzle_and_border)
