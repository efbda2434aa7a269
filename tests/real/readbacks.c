/*
 * Pixels are read into buffer objects and drawn from there, one kind per frame: colours, luminance, depths, packed
 * types, rows with gaps, texels, vertex colours, and pixels of the previous frame. Recorded by test_readbacks.py.
 */
#include "tests/trace/window.h"

enum { SIDE = 16, BYTES = 8192 };

/* A square with a single colour, so that bytes must match exactly. */
static void rect(unsigned i, float x, float y, float size, float z)
{
	glColor4ub((unsigned char)(37 * i + 9), (unsigned char)(91 * i + 51), (unsigned char)(200 - 53 * i),
	           (unsigned char)(60 + 29 * i));
	glBegin(GL_QUADS);
	glVertex3f(x, y, z);
	glVertex3f(x + size, y, z);
	glVertex3f(x + size, y + size, z);
	glVertex3f(x, y + size, z);
	glEnd();
}

/* Start of every frame; buffer 5 has contents of its own. */
static void begin(void)
{
	static unsigned char bytes[BYTES];

	for (unsigned i = 0; i < BYTES; i++)
		bytes[i] = (unsigned char)(i * 37 >> 2);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_STENCIL_TEST);
	glStencilFunc(GL_ALWAYS, 77, 255);
	glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
	for (unsigned i = 0; i < 7; i++)
		rect(i, (float)(i % 3 * 5), (float)(i / 3 * 4 + 1), 7, (float)(3 * i % 7));
	glDisable(GL_DEPTH_TEST);
	glDisable(GL_STENCIL_TEST);
	glBindBuffer(GL_PIXEL_PACK_BUFFER, 5);
	glBufferData(GL_PIXEL_PACK_BUFFER, BYTES, bytes, GL_STREAM_COPY);
	glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 5);
}

/* Draw an offset of the buffer beside the original. */
static void draw(int column, int row, unsigned format, unsigned type, size_t offset)
{
	glWindowPos2i(17 * column, 17 * row);
	glDrawPixels(SIDE, SIDE, format, type, (void *)offset);
}

static void copy(int column, int row, unsigned format, unsigned type)
{
	glReadPixels(0, 0, SIDE, SIDE, format, type, (void *)64);
	draw(column, row, format, type, 64);
}

static void colors(void)
{
	copy(1, 0, GL_RGBA, GL_UNSIGNED_BYTE);
	copy(2, 0, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV);
	copy(0, 1, GL_RGB, GL_UNSIGNED_SHORT);
	copy(1, 1, GL_RGBA, GL_FLOAT);
	copy(2, 1, GL_BGR, GL_HALF_FLOAT);
	copy(0, 2, GL_GREEN, GL_UNSIGNED_BYTE);
}

static void greys(void)
{
	copy(1, 0, GL_LUMINANCE, GL_UNSIGNED_BYTE);
	copy(2, 0, GL_LUMINANCE, GL_FLOAT);
	copy(0, 1, GL_LUMINANCE_ALPHA, GL_UNSIGNED_SHORT);
	glPixelTransferf(GL_RED_SCALE, 0.5f);
	glPixelTransferf(GL_GREEN_BIAS, -0.25f);
	copy(1, 1, GL_LUMINANCE, GL_UNSIGNED_BYTE);
	copy(2, 1, GL_RGBA, GL_FLOAT);
	glPixelTransferf(GL_RED_SCALE, 1);
	glPixelTransferf(GL_GREEN_BIAS, 0);
}

static void packed(void)
{
	copy(1, 0, GL_RGB, GL_UNSIGNED_SHORT_5_6_5);
	copy(2, 0, GL_RGBA, GL_UNSIGNED_SHORT_4_4_4_4_REV);
	copy(0, 1, GL_RGB, GL_UNSIGNED_BYTE_3_3_2);
	copy(1, 1, GL_BGRA, GL_UNSIGNED_SHORT_1_5_5_5_REV);
	copy(2, 1, GL_RGBA, GL_UNSIGNED_INT_10_10_10_2);
}

/* Signed numbers, drawn as bytes. */
static void numbers(void)
{
	static const unsigned types[] = { GL_BYTE, GL_SHORT, GL_INT, GL_UNSIGNED_INT };

	for (int i = 0; i < 4; i++) {
		glReadPixels(0, 0, SIDE, SIDE, GL_RGBA, types[i], NULL);
		draw(1 + i % 2, i / 2, GL_RGBA, GL_UNSIGNED_BYTE, 0);
	}
	glReadPixels(0, 0, SIDE, SIDE, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8, NULL);
	glColorMask(1, 0, 1, 1); /* the lowest bits of depths may differ */
	draw(0, 1, GL_RGBA, GL_UNSIGNED_BYTE, 0);
	glColorMask(1, 1, 1, 1);
}

static void depths(void)
{
	static const unsigned types[] = { GL_FLOAT, GL_UNSIGNED_SHORT, GL_UNSIGNED_INT, GL_UNSIGNED_BYTE };

	for (int i = 0; i < 4; i++) {
		glReadPixels(0, 0, SIDE, SIDE, GL_DEPTH_COMPONENT, types[i], NULL);
		draw(1 + i % 2, i / 2, GL_LUMINANCE, types[i], 0);
	}
}

/* Rows with gaps, skipped pixels and swapped bytes; also partly outside the screen. */
static void storage(void)
{
	glPixelStorei(GL_PACK_ROW_LENGTH, 21);
	glPixelStorei(GL_PACK_SKIP_ROWS, 2);
	glPixelStorei(GL_PACK_SKIP_PIXELS, 3);
	glPixelStorei(GL_PACK_ALIGNMENT, 8);
	glReadPixels(0, 0, SIDE, SIDE, GL_RGB, GL_UNSIGNED_BYTE, (void *)5);
	glPixelStorei(GL_PACK_SWAP_BYTES, 1);
	glReadPixels(0, 0, SIDE, SIDE, GL_LUMINANCE, GL_UNSIGNED_SHORT, (void *)2048);
	glPixelStorei(GL_PACK_SWAP_BYTES, 0);
	glPixelStorei(GL_PACK_ROW_LENGTH, 0);
	glPixelStorei(GL_PACK_SKIP_ROWS, 0);
	glPixelStorei(GL_PACK_SKIP_PIXELS, 0);
	glPixelStorei(GL_PACK_ALIGNMENT, 4);
	glReadPixels(-5, -4, SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, (void *)4096);
	glReadPixels(0, 0, SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, (void *)(BYTES - 1020)); /* too large: an error */
	glGetError();
	draw(1, 0, GL_RGBA, GL_UNSIGNED_BYTE, 0);
	draw(2, 0, GL_RGBA, GL_UNSIGNED_BYTE, 1024);
	draw(1, 1, GL_LUMINANCE, GL_UNSIGNED_SHORT, 2048);
	draw(2, 1, GL_RGBA, GL_UNSIGNED_BYTE, 4096);
	draw(0, 1, GL_RGBA, GL_UNSIGNED_BYTE, BYTES - 1024);
}

static void textured(float x, float y)
{
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	glColor3f(1, 1, 1);
	glEnable(GL_TEXTURE_2D);
	glBegin(GL_QUADS);
	for (int i = 0; i < 4; i++) {
		glTexCoord2f(i == 1 || i == 2, i >= 2);
		glVertex2f(x + (i == 1 || i == 2 ? SIDE : 0), y + (i >= 2 ? SIDE : 0));
	}
	glEnd();
	glDisable(GL_TEXTURE_2D);
}

/* Texels from pixels, and pixels from texels. */
static void textures(void)
{
	static const unsigned formats[] = { GL_RGBA, GL_LUMINANCE_ALPHA, GL_RGB5, GL_INTENSITY };

	glReadPixels(0, 0, SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
	glBindTexture(GL_TEXTURE_2D, 1);
	for (int i = 0; i < 4; i++) {
		glTexImage2D(GL_TEXTURE_2D, 0, (int)formats[i], SIDE, SIDE, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
		textured((float)(17 * (i % 2)), (float)(17 + 16 * (i / 2)));
		glGetTexImage(GL_TEXTURE_2D, 0, i == 2 ? GL_LUMINANCE : GL_RGBA, i % 2 ? GL_FLOAT : GL_UNSIGNED_BYTE, (void *)2048);
		draw(2, i % 2, i == 2 ? GL_LUMINANCE : GL_RGBA, i % 2 ? GL_FLOAT : GL_UNSIGNED_BYTE, 2048);
	}
	glTexSubImage2D(GL_TEXTURE_2D, 0, 2, 3, 8, 8, GL_RGBA, GL_UNSIGNED_BYTE, (void *)2048);
	textured(17, 0);
}

/* Vertex colours from pixels. */
static void vertices(void)
{
	static const float corners[8] = { 20, 4, 60, 4, 60, 40, 20, 40 };

	glReadPixels(4, 4, 4, 1, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
	glVertexPointer(2, GL_FLOAT, 0, corners);
	glEnableClientState(GL_VERTEX_ARRAY);
	glBindBuffer(GL_ARRAY_BUFFER, 5);
	glColorPointer(4, GL_UNSIGNED_BYTE, 0, NULL);
	glEnableClientState(GL_COLOR_ARRAY);
	glDrawArrays(GL_QUADS, 0, 4);
	glDisableClientState(GL_COLOR_ARRAY);
	glDisableClientState(GL_VERTEX_ARRAY);
	glBindBuffer(GL_ARRAY_BUFFER, 0);
}

/* For the next frame, whose own `begin` leaves buffer 6 alone. */
static void leave(void)
{
	glBindBuffer(GL_PIXEL_PACK_BUFFER, 6);
	glBufferData(GL_PIXEL_PACK_BUFFER, BYTES, NULL, GL_STREAM_COPY);
	glReadPixels(0, 0, SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
}

static void find(void)
{
	glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 6);
	draw(1, 1, GL_RGBA, GL_UNSIGNED_BYTE, 0);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, SIDE, SIDE, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
}

static void find_texture(void)
{
	textured(20, 20);
}

int main(void)
{
	static void (*const frames[])(void) = { colors,   greys,    packed, numbers, depths,      storage,
		                                textures, vertices, leave,  find,    find_texture };
	int attributes[] = {
		GLX_RGBA, GLX_DOUBLEBUFFER, GLX_RED_SIZE, 8, GLX_ALPHA_SIZE, 8, GLX_DEPTH_SIZE, 24, GLX_STENCIL_SIZE, 8,
		None
	};

	open_window_of(attributes);
	glOrtho(0, 64, 0, 48, -10, 10);
	glClearColor(0.1f, 0.2f, 0.3f, 0.4f);
	draw_frames(frames, sizeof(frames) / sizeof(frames[0]), begin);
	return 0;
}
