/*
 * Textures as piglit's tests have them, one matter a frame: internal formats, blocks, swizzles, wraps beyond the image; depth and
 * stencil values as pixels. Recorded by test_textures.py.
 */
#include "tests/trace/window.h"

static void reset(void)
{
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glOrtho(0, 64, 0, 48, -10, 10);
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	glClearColor(0.2f, 0.4f, 0.6f, 0.4f);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
	glColor4f(1, 1, 1, 1);
	glEnable(GL_TEXTURE_2D);
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
}

/* A new texture; nearest. Pixel centres keep off the edges of texels, where rounding decides. */
static void texture(void)
{
	unsigned name;

	glGenTextures(1, &name);
	glBindTexture(GL_TEXTURE_2D, name);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

static void panel(int x, int y, int size, float from, float to)
{
	glBegin(GL_QUADS);
	glTexCoord2f(from, from);
	glVertex2i(x, y);
	glTexCoord2f(to, from);
	glVertex2i(x + size, y);
	glTexCoord2f(to, to);
	glVertex2i(x + size, y + size);
	glTexCoord2f(from, to);
	glVertex2i(x, y + size);
	glEnd();
}

static unsigned char colors[4][4][4];

static void formats(void)
{
	static const int internal[] = { GL_RGBA8, GL_RGB5_A1, GL_RGBA4, GL_R3_G3_B2, GL_RED, GL_RG8, GL_SRGB8_ALPHA8, GL_SLUMINANCE8,
		                        GL_LUMINANCE6_ALPHA2, GL_INTENSITY4, GL_RGB565, GL_RGBA16F };

	for (int i = 0; i < 12; i++) {
		texture();
		glTexImage2D(GL_TEXTURE_2D, 0, internal[i], 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, colors);
		panel(i % 4 * 16, i / 4 * 16, 15, 0.01f, 0.98f);
	}
}

static void blocks(void)
{
	static const unsigned formats[] = { GL_COMPRESSED_RGB_S3TC_DXT1_EXT, GL_COMPRESSED_RGBA_S3TC_DXT1_EXT,
		                            GL_COMPRESSED_RGBA_S3TC_DXT3_EXT, GL_COMPRESSED_RGBA_S3TC_DXT5_EXT,
		                            GL_COMPRESSED_RGB_FXT1_3DFX, GL_COMPRESSED_RGBA_FXT1_3DFX };
	unsigned char bytes[64];

	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	for (unsigned i = 0; i < 12; i++) {
		unsigned format = formats[i % 6], side = i % 6 < 4 ? 8 : 16, size = i % 6 < 2 ? 32 : 64;

		for (unsigned k = 0; k < size; k++) /* any bits are blocks */
			bytes[k] = (unsigned char)((k * 2654435761u + i * 40503u) >> 11);
		texture();
		glCompressedTexImage2D(GL_TEXTURE_2D, 0, format, (int)side, 8, 0, (int)size, bytes);
		panel((int)i % 4 * 16, (int)i / 4 * 16, 16, 0, 1);
	}
	glDisable(GL_BLEND);
}

static void swizzles(void)
{
	static const int swizzle[4][4] = { { GL_BLUE, GL_RED, GL_GREEN, GL_ONE }, { GL_ALPHA, GL_ZERO, GL_ONE, GL_RED },
		                           { GL_RED, GL_RED, GL_RED, GL_RED }, { GL_ONE, GL_GREEN, GL_ZERO, GL_ALPHA } };
	const float border[4] = { 0.8f, 0.2f, 0.6f, 0.4f };
	static const int internal[3] = { GL_RGBA, GL_LUMINANCE, GL_ALPHA };

	for (int i = 0; i < 12; i++) {
		texture();
		glTexImage2D(GL_TEXTURE_2D, 0, internal[i / 4], 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, colors);
		glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_RGBA, swizzle[i % 4]);
		glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, border);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
		panel(i % 4 * 16, i / 4 * 16, 15, -0.47f, 1.51f);
	}
}

static void wraps(void)
{
	static const int wrap[6] = { GL_REPEAT, GL_CLAMP, GL_CLAMP_TO_BORDER, GL_MIRRORED_REPEAT, GL_MIRROR_CLAMP_EXT,
		                     GL_MIRROR_CLAMP_TO_EDGE_EXT };
	const float border[4] = { 1, 0.2f, 0, 1 };

	for (int i = 0; i < 12; i++) {
		texture();
		glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, colors);
		glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, border);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap[i / 2]);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap[i / 2]);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, i % 2 ? GL_LINEAR : GL_NEAREST);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, i % 2 ? GL_LINEAR : GL_NEAREST);
		panel(i % 4 * 16, i / 4 * 16, 15, -1.27f, 2.31f);
	}
}

/* Depth and stencil values, drawn and copied as pixels, and what they let through. */
static void depth_and_stencil(void)
{
	unsigned values[16][16];

	for (unsigned i = 0; i < 256; i++)
		values[i / 16][i % 16] = (i % 16 * 16 << 24) | (i / 16 < 8 ? 7 : 9);
	glDisable(GL_TEXTURE_2D);
	glRasterPos2i(2, 2);
	glDrawPixels(16, 16, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8, values);
	glRasterPos2i(24, 10);
	glPixelZoom(2, 2);
	glCopyPixels(2, 2, 16, 16, GL_DEPTH_STENCIL);
	glPixelZoom(1, 1);
	glEnable(GL_STENCIL_TEST);
	glStencilFunc(GL_EQUAL, 9, 255);
	glStencilOp(GL_KEEP, GL_KEEP, GL_INCR);
	glEnable(GL_DEPTH_TEST);
	glColor3f(1, 0.8f, 0);
	glRecti(0, 0, 64, 48);
	glStencilFunc(GL_EQUAL, 7, 255);
	glColor3f(0, 0.8f, 1);
	glRecti(0, 0, 64, 48);
	glDisable(GL_DEPTH_TEST);
	glDisable(GL_STENCIL_TEST);
}

int main(void)
{
	static void (*const frames[])(void) = { formats, blocks, swizzles, wraps, depth_and_stencil };

	for (int i = 0; i < 64; i++)
		colors[i / 16][i / 4 % 4][i % 4] = (unsigned char)(i % 4 == 3 ? 255 - 12 * (i / 4) : i * 67 + i / 4 * 13);
	open_window();
	for (unsigned i = 0; i < sizeof(frames) / sizeof(frames[0]); i++) {
		reset();
		frames[i]();
		end_frame();
	}
	return 0;
}
