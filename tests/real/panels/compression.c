/*
 * Uncompressed images in formats that Mesa compresses on upload (EXT_texture_compression_s3tc; the generic formats of
 * OpenGL 2.1 sec. 3.8.1), one texel per pixel, so that the result of each block is visible. Also formats with less than
 * one colour per texel.
 */
#include "panels.h"

enum { SIDE = PANEL, N_FORMATS = 8, N_IMAGES = 12 };

static GLubyte texels[SIDE][SIDE][4];

/* A texel's channel: noise, slopes, edges, nearly one colour, few levels; the same kinds for alpha. */
static GLubyte texel(int image, int x, int y, int channel)
{
	const unsigned at = (unsigned)((y * SIDE + x) * 4 + channel), block = (unsigned)(y / 4 * 8 + x / 4 + 100 * channel);
	const float n = noise(at * 7919u + 13u), of_block = noise(block * 104729u + (unsigned)image);

	switch (image) {
	case 0:
		return (GLubyte)(255 * n);
	case 1:
		return (GLubyte)(channel & 1 ? 12 * x : 12 * y);
	case 2:
		return (GLubyte)(255 * of_block);
	case 3:
		return (GLubyte)(120 + 8 * of_block + 7 * n);
	case 4:
		return (GLubyte)(240 + 6 * of_block + 12 * n > 255 ? 255 : 240 + 6 * of_block + 12 * n);
	case 5:
		return (GLubyte)(x + y < SIDE ? 30 + 40 * channel : 220 - 50 * channel);
	case 6:
		return (GLubyte)(channel == 3 ? n < 0.3f ? 0 : n < 0.6f ? 255 : (GLubyte)(255 * of_block) : 200 * n);
	case 7:
		return (GLubyte)(channel == 3 ? n < 0.5f ? 0 : 255 : 20 * x % 256);
	case 8:
		return (GLubyte)(channel == 3 ? 100 + 60 * n : 50 * channel + 4 * x + 100 * n);
	case 9:
		return (GLubyte)(channel == 3 ? (x + y) % 3 * 127 : 255 * of_block * n);
	case 10:
		return (GLubyte)(channel == 3 ? n < 0.2f ? 3 : n > 0.8f ? 251 : 128 + 40 * n : 128 + 2 * n);
	default:
		return (GLubyte)(channel == 3 ? 255 * of_block : (x / 2 + y / 2) % 2 * 255);
	}
}

static const GLint formats[N_FORMATS] = {
	GL_COMPRESSED_RGB_S3TC_DXT1_EXT, GL_COMPRESSED_RGBA_S3TC_DXT1_EXT, GL_COMPRESSED_RGBA_S3TC_DXT3_EXT,
	GL_COMPRESSED_RGBA_S3TC_DXT5_EXT, GL_COMPRESSED_RGB, GL_COMPRESSED_RGBA, GL_COMPRESSED_SRGB,
	GL_COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT
};

static void image(int number)
{
	for (int i = 0; i < SIDE * SIDE * 4; i++)
		texels[i / 4 / SIDE][i / 4 % SIDE][i % 4] = texel(number, i / 4 % SIDE, i / 4 / SIDE, i % 4);
	glEnable(GL_TEXTURE_2D);
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, 0);
	glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_FALSE);
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
}

static void whole(int i)
{
	const int format = choose(&i, N_FORMATS);

	image(choose(&i, N_IMAGES));
	glTexImage2D(GL_TEXTURE_2D, 0, formats[format], SIDE, SIDE, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
}

/* Sizes that cut blocks, and parts that are replaced. */
static void parts(int i)
{
	const int format = choose(&i, N_FORMATS), how = choose(&i, 2);

	image(choose(&i, N_IMAGES));
	glTexImage2D(GL_TEXTURE_2D, 0, formats[format], how ? SIDE : 17, how ? SIDE : 6, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
	if (how) {
		image(choose(&i, N_IMAGES) + 1);
		glTexSubImage2D(GL_TEXTURE_2D, 0, 4, 8, 12, 12, GL_RGBA, GL_UNSIGNED_BYTE, texels);
	}
}

/* Generated mipmaps: shows the second level. */
static void levels(int i)
{
	const int format = choose(&i, N_FORMATS);

	image(choose(&i, N_IMAGES));
	glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE);
	glTexImage2D(GL_TEXTURE_2D, 0, formats[format], SIDE, SIDE, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, 1 + i % 2);
}

/* Copied from the framebuffer. */
static void copied(int i)
{
	const int format = choose(&i, N_FORMATS);

	image(choose(&i, N_IMAGES));
	glTexImage2D(GL_TEXTURE_2D, 0, formats[format], SIDE, SIDE, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
	glDisable(GL_TEXTURE_2D);
	glRasterPos2f(-1, -1);
	glDrawPixels(SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, texels);
}

/* Luminance with one colour for two texels (MESA_ycbcr_texture): both orders, swapped, filtered, odd sizes, a part
 * replaced. */
static void ycbcr(int i)
{
	static const GLenum types[2] = { GL_UNSIGNED_SHORT_8_8_MESA, GL_UNSIGNED_SHORT_8_8_REV_MESA };
	const GLenum type = types[choose(&i, 2)];
	const int swap = choose(&i, 2), linear = choose(&i, 2), part = choose(&i, 2), small = choose(&i, 2);

	image(i % 5);
	glPixelStorei(GL_UNPACK_SWAP_BYTES, swap);
	glPixelStorei(GL_UNPACK_ROW_LENGTH, 2 * SIDE);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, linear ? GL_LINEAR : GL_NEAREST);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_YCBCR_MESA, small ? 6 : SIDE, small ? 5 : SIDE, 0, GL_YCBCR_MESA, type, texels);
	if (part)
		glTexSubImage2D(GL_TEXTURE_2D, 0, 2, 1, 4, 3, GL_YCBCR_MESA, type, texels[3]);
	glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
	glPixelStorei(GL_UNPACK_SWAP_BYTES, 0);
}

static void square(void)
{
	glBegin(GL_QUADS);
	for (int k = 0; k < 4; k++) {
		const float right = k == 1 || k == 2, up = k >= 2;

		glTexCoord2f(right, up);
		glVertex2f(2 * right - 1, 2 * up - 1);
	}
	glEnd();
}

static void draw_colors(int i)
{
	(void)i;
	square();
}

static void draw_alpha(int i)
{
	(void)i;
	glDisable(GL_TEXTURE_2D);
	square();
	glEnable(GL_TEXTURE_2D);
	glEnable(GL_BLEND);
	glBlendFunc(GL_ZERO, GL_SRC_ALPHA);
	square();
}

static void draw_copied(int i)
{
	const int x = i % ACROSS * PANEL, y = i / ACROSS * PANEL;

	glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, x, y, SIDE, SIDE);
	glEnable(GL_TEXTURE_2D);
	square();
}

int main(void)
{
	static const struct table tables[] = { { 96, whole, draw_colors },  { 96, whole, draw_alpha },
		                               { 192, parts, draw_colors }, { 96, levels, draw_colors },
		                               { 96, levels, draw_alpha },  { 96, copied, draw_copied },
		                               { 160, ycbcr, draw_colors } };

	last_needs = "GL_MESA_ycbcr_texture";
	DRAW_TABLES(tables, NULL);
	return 0;
}
