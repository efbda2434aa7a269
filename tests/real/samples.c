/* A window with four samples per pixel (GL 2.1 sec. 3.2.1), one aspect per frame. Recorded by test_samples.py. */
#include <math.h>

#include "tests/trace/window.h"

enum { WIDTH = 112, HEIGHT = 84, LEAVES = 14 }; /* larger than one of llvmpipe's 64 x 64 tiles */

static void reset(int clears)
{
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glFrustum(-0.41, 0.41, -0.307, 0.307, 1, 37.3);
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	glClearColor(0.1f, 0.2f, 0.3f, 0.4f);
	if (clears)
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
	glEnable(GL_DEPTH_TEST);
	glDepthFunc(GL_LESS);
}

static void flat_window(void)
{
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glOrtho(0, WIDTH, 0, HEIGHT, -1, 1);
	glMatrixMode(GL_MODELVIEW);
}

static void leaf(int i, float depth)
{
	float angle = 6.2831853f * (float)i / LEAVES + 0.1f, next = angle + 6.2831853f / LEAVES;

	glColor4f((float)(i % 3) / 2, (float)(i % 5) / 4, 1 - (float)i / LEAVES, 0.1f + 0.9f * (float)i / LEAVES);
	glVertex3f(0.03f, -0.02f, depth);
	glVertex3f(0.71f * cosf(angle), 0.53f * sinf(angle), depth - 0.3f * (float)(i & 1));
	glColor4f((float)(i % 2), (float)(i % 4) / 3, (float)i / LEAVES, 0.9f - 0.7f * (float)i / LEAVES);
	glVertex3f(0.71f * cosf(next), 0.53f * sinf(next), depth);
}

/* A fan of triangles with shared edges of all slopes, each with colours of its own. */
static void fan(void)
{
	glBegin(GL_TRIANGLES);
	for (int i = 0; i < LEAVES; i++)
		leaf(i, -2);
	glEnd();
}

/* Intersecting surfaces, whose depth differs between samples. */
static void crossing(void)
{
	glTranslatef(0, 0, -3);
	for (int i = 0; i < 7; i++) {
		glRotatef(33, 0.7f, 0.2f + 0.1f * (float)i, 0.4f);
		glColor3f((float)(i & 1), (float)(i >> 1 & 1), (float)(i >> 2));
		glBegin(GL_QUADS);
		glVertex3f(-0.9f, -0.6f, 0);
		glVertex3f(0.9f, -0.6f, 0);
		glColor3f(0.4f, 0.6f, (float)i / 7);
		glVertex3f(0.9f, 0.6f, 0);
		glVertex3f(-0.9f, 0.6f, 0);
		glEnd();
	}
}

/* A floor from the viewer to the horizon that leaves the view on all sides, and steep strips that do, too. */
static void floor_and_strips(void)
{
	glBegin(GL_QUADS);
	glColor3f(0.9f, 0.4f, 0.1f);
	glVertex3f(-40, -0.4f, 5);
	glVertex3f(40, -0.4f, 5);
	glColor3f(0.1f, 0.9f, 0.4f);
	glVertex3f(40, -0.4f, -36);
	glVertex3f(-40, -0.4f, -36);
	for (int i = 0; i < 6; i++) {
		float x = 0.31f * (float)i - 0.8f;

		glColor3f(0.2f, 0.1f * (float)i, 0.8f);
		glVertex3f(x, -2, -2 - 0.1f * (float)i);
		glVertex3f(x + 0.03f, -2, -2);
		glVertex3f(x + 0.2f, 2, -2.5f);
		glVertex3f(x + 0.12f, 2, -2.5f);
	}
	glEnd();
}

static void lines(void)
{
	for (int width = 0; width < 4; width++) {
		glLineWidth(0.5f + 0.9f * (float)width);
		glBegin(GL_LINES);
		for (int i = 0; i < 23; i++) {
			float angle = 6.2831853f * (float)i / 23 + 0.013f * (float)width, near = 0.05f, far = 0.2f + 0.25f * (float)width;

			glColor3f((float)i / 23, 1 - (float)i / 23, 0.6f);
			glVertex3f(near * cosf(angle), near * sinf(angle), -2);
			glColor3f(0.2f * (float)width, (float)i / 23, 0.1f);
			glVertex3f(far * cosf(angle), far * sinf(angle), -2 - 0.5f * (float)width);
		}
		glEnd();
	}
	glLineWidth(1);
	glLineStipple(2, 0x2cf1);
	glEnable(GL_LINE_STIPPLE);
	glColor3f(1, 1, 0);
	glBegin(GL_LINE_STRIP);
	for (int i = 0; i < 9; i++)
		glVertex3f(-0.7f + 0.17f * (float)i, 0.4f - 0.2f * (float)(i & 1), -2);
	glEnd();
	glDisable(GL_LINE_STIPPLE);
}

/* Lines that start just outside a tile and are clipped there. y: position of a border between tiles; away: of the
 * lines' other ends */
static void lines_near(float y, float away)
{
	glLoadIdentity();
	glDisable(GL_DEPTH_TEST);
	glLineWidth(1.5f);
	glBegin(GL_LINES);
	for (int i = 0; i < 20; i++) {
		glColor3f(1, 0.05f * (float)i, 0);
		glVertex2f(63 + 0.1f * (float)i, 3 + 3 * (float)i);
		glVertex2f(70 + 0.1f * (float)i, 4 + 3 * (float)i);
		glVertex2f(2 + 3 * (float)i, y - 1 + 0.1f * (float)i);
		glVertex2f(3 + 3 * (float)i, away);
	}
	glEnd();
	glLineWidth(1);
}

static void lines_at_tiles(void)
{
	flat_window();
	lines_near(HEIGHT - 64, 9);
}

/* Points, smooth or not, as squares of exactly their size. */
static void points(void)
{
	glRotatef(9, 0.3f, 0.5f, 1);
	for (int size = 0; size < 6; size++) {
		glPointSize(0.7f + 0.6f * (float)size);
		if (size == 3)
			glEnable(GL_POINT_SMOOTH);
		glBegin(GL_POINTS);
		for (int i = 0; i < 20; i++) {
			glColor3f((float)i / 20, 0.2f, 0.7f);
			glVertex3f(0.06f * (float)i - 0.6f, 0.13f * (float)size - 0.33f + 0.0037f * (float)i, -2 - 0.01f * (float)i);
		}
		glEnd();
	}
	glDisable(GL_POINT_SMOOTH);
	glPointSize(1);
}

static void textured(void)
{
	static unsigned char texels[16][16][4];

	for (int y = 0; y < 16; y++)
		for (int x = 0; x < 16; x++) {
			texels[y][x][0] = (unsigned char)(x * 17);
			texels[y][x][1] = (unsigned char)(y * 17);
			texels[y][x][2] = (unsigned char)((x ^ y) * 17);
			texels[y][x][3] = (unsigned char)((x + y) * 8);
		}
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 16, 16, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
	glEnable(GL_TEXTURE_2D);
	glTranslatef(0, 0, -3);
	for (int i = 0; i < 4; i++) {
		glRotatef(47, 0.3f, 0.8f, 0.4f);
		glBegin(GL_QUADS);
		glTexCoord2f(0, 0);
		glVertex3f(-0.9f, -0.6f, 0.2f);
		glTexCoord2f(2, 0);
		glVertex3f(0.9f, -0.6f, 0.2f);
		glTexCoord2f(2, 2);
		glVertex3f(0.9f, 0.6f, 0.1f);
		glTexCoord2f(0, 2);
		glVertex3f(-0.9f, 0.6f, 0.1f);
		glEnd();
	}
	glDisable(GL_TEXTURE_2D);
}

/* Alpha determines how many samples are covered. */
static void alpha_to_coverage(void)
{
	glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
	fan();
	glEnable(GL_SAMPLE_ALPHA_TO_ONE);
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE);
	glTranslatef(0.2f, 0.1f, 0.1f);
	fan();
	glDisable(GL_BLEND);
	glDisable(GL_SAMPLE_ALPHA_TO_ONE);
	glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
}

static void sample_coverage(void)
{
	glEnable(GL_SAMPLE_COVERAGE);
	for (int i = 0; i < 6; i++) {
		glSampleCoverage(0.2f * (float)i, i & 1);
		glBegin(GL_TRIANGLES);
		leaf(2 * i, -2);
		leaf(2 * i + 1, -2);
		glEnd();
	}
	glSampleCoverage(0.5f, 0);
	glTranslatef(0.4f, -0.2f, 0.4f);
	fan();
	glDisable(GL_SAMPLE_COVERAGE);
}

static void blended(void)
{
	glDisable(GL_DEPTH_TEST);
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	for (int i = 0; i < 5; i++) {
		glRotatef(21, 0.1f, 0.2f, 1);
		fan();
	}
	glDisable(GL_BLEND);
}

/* Drawing without multisampling covers whole pixels, between multisampled drawing. */
static void disabled(void)
{
	fan();
	glDisable(GL_MULTISAMPLE);
	glTranslatef(0.1f, 0.1f, 0.2f);
	glRotatef(17, 0, 0, 1);
	fan();
	glBegin(GL_LINES);
	glVertex3f(-0.7f, -0.4f, -2);
	glVertex3f(0.6f, 0.5f, -2);
	glEnd();
	glEnable(GL_MULTISAMPLE);
	glTranslatef(-0.3f, -0.1f, 0.2f);
	fan();
}

/* Stencil per sample, and alpha test. */
static void stencilled(void)
{
	glEnable(GL_STENCIL_TEST);
	glStencilFunc(GL_ALWAYS, 1, 255);
	glStencilOp(GL_KEEP, GL_KEEP, GL_INVERT);
	glColorMask(0, 0, 0, 0);
	glDepthMask(0);
	glTranslatef(0.1f, 0, 0);
	fan();
	glTranslatef(0.1f, 0.1f, 0);
	fan();
	glColorMask(1, 1, 1, 1);
	glDepthMask(1);
	glStencilFunc(GL_NOTEQUAL, 0, 255);
	glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
	glEnable(GL_ALPHA_TEST);
	glAlphaFunc(GL_GREATER, 0.5f);
	glTranslatef(-0.3f, -0.1f, 0.2f);
	fan();
	glDisable(GL_ALPHA_TEST);
	glDisable(GL_STENCIL_TEST);
}

/* Bitmaps and pixel rectangles, beside edges and across them, with depth. */
static void pixels(void)
{
	static const unsigned char letter[8] = { 0x81, 0x42, 0x24, 0x18, 0x18, 0x24, 0x42, 0xff };
	unsigned char rectangle[8][8][4];

	for (int i = 0; i < 64; i++) {
		rectangle[i / 8][i % 8][0] = (unsigned char)(i * 4);
		rectangle[i / 8][i % 8][1] = (unsigned char)(255 - i);
		rectangle[i / 8][i % 8][2] = (unsigned char)(i % 8 * 30);
		rectangle[i / 8][i % 8][3] = 128;
	}
	fan();
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	for (int i = 0; i < 5; i++) {
		glColor3f(1, 1, 0.2f * (float)i);
		glRasterPos3f(-0.5f + 0.2f * (float)i, -0.3f + 0.1f * (float)i, -1.7f - 0.15f * (float)i);
		glBitmap(8, 8, 0, 0, 9, 0, letter);
	}
	glRasterPos3f(0, -0.2f, -2.1f);
	glDrawPixels(8, 8, GL_RGBA, GL_UNSIGNED_BYTE, rectangle);
	glDisable(GL_DEPTH_TEST);
	glPixelZoom(1.3f, -0.7f);
	glRasterPos3f(-0.3f, 0.2f, -2);
	glDrawPixels(8, 8, GL_RGBA, GL_UNSIGNED_BYTE, rectangle);
	glPixelZoom(1, 1);
}

static void scissored(void)
{
	glEnable(GL_SCISSOR_TEST);
	glScissor(23, 9, 61, 55);
	fan();
	glScissor(5, 40, 30, 30);
	glClearColor(0.5f, 0.6f, 0.1f, 1);
	glClear(GL_COLOR_BUFFER_BIT);
	glDisable(GL_SCISSOR_TEST);
}

/* Covers few pixels: our cuts are exact at samples, while Mesa rounds their corners, which affects one sample in
 * thousands. */
static void cut_by_planes(void)
{
	static const double left[4] = { 1, 0.3, 0.1, 0.2 }, low[4] = { -0.2, 1, 0, 0.3 };

	glClipPlane(GL_CLIP_PLANE0, left);
	glClipPlane(GL_CLIP_PLANE1, low);
	glEnable(GL_CLIP_PLANE0);
	glEnable(GL_CLIP_PLANE1);
	glViewport(0, 0, 64, 48);
	fan();
	glViewport(0, 0, WIDTH, HEIGHT);
	glDisable(GL_CLIP_PLANE0);
	glDisable(GL_CLIP_PLANE1);
}

/* Faces as lines and points, with polygon offset from the surface below. */
static void outlines(void)
{
	glTranslatef(0, 0, -3);
	glRotatef(30, 1, 0.5f, 0);
	for (int pass = 0; pass < 3; pass++) {
		glPolygonMode(GL_FRONT_AND_BACK, pass == 0 ? GL_FILL : pass == 1 ? GL_LINE : GL_POINT);
		glColor3f(pass ? 1 : 0.3f, pass == 2, 0.3f);
		if (pass == 0) {
			glEnable(GL_POLYGON_OFFSET_FILL);
			glPolygonOffset(1, 2);
		}
		glPointSize(3);
		glLineWidth(1.5f);
		glBegin(GL_QUADS);
		for (int i = 0; i < 9; i++) {
			float x = 0.5f * (float)(i % 3) - 0.8f, y = 0.4f * (float)(i / 3) - 0.6f;

			glVertex3f(x, y, 0.1f * (float)(i % 4));
			glVertex3f(x + 0.5f, y, 0.1f * (float)((i + 1) % 4));
			glVertex3f(x + 0.5f, y + 0.4f, 0);
			glVertex3f(x, y + 0.4f, 0.2f);
		}
		glEnd();
		glDisable(GL_POLYGON_OFFSET_FILL);
	}
	glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
	glLineWidth(1);
}

/* Draw the bound texture over the window's lower left, one texel per pixel. */
static void show_texture(int size)
{
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
	flat_window();
	glLoadIdentity();
	glDisable(GL_DEPTH_TEST);
	glEnable(GL_TEXTURE_2D);
	glBegin(GL_QUADS);
	glTexCoord2f(0, 0);
	glVertex2i(4, 4);
	glTexCoord2f(1, 0);
	glVertex2i(4 + size, 4);
	glTexCoord2f(1, 1);
	glVertex2i(4 + size, 4 + size);
	glTexCoord2f(0, 1);
	glVertex2i(4, 4 + size);
	glEnd();
	glDisable(GL_TEXTURE_2D);
}

/* The window copied to a texture, which resolves it. */
static void copied(void)
{
	fan();
	glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 16, 8, 32, 32, 0);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	show_texture(32);
}

/* A framebuffer object with four samples per pixel. */
static void bind_samples(GLuint object, const GLuint *buffers)
{
	glBindFramebuffer(GL_FRAMEBUFFER, object);
	for (int i = 0; i < 2; i++) {
		glBindRenderbuffer(GL_RENDERBUFFER, buffers[i]);
		glRenderbufferStorageMultisample(GL_RENDERBUFFER, 4, i ? GL_DEPTH_COMPONENT24 : GL_RGBA8, 80, 80);
		glFramebufferRenderbuffer(GL_FRAMEBUFFER, i ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0,
		                          GL_RENDERBUFFER, buffers[i]);
	}
	expect(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE,
	       "the framebuffer object of samples is complete");
	glViewport(0, 0, 80, 80);
}

/* Resolve its pixels into a framebuffer object with a texture (EXT_framebuffer_blit, EXT_framebuffer_multisample),
 * and into the window. */
static void resolve_into(GLuint object, GLuint texture)
{
	glBindFramebuffer(GL_DRAW_FRAMEBUFFER, object);
	glBindTexture(GL_TEXTURE_2D, texture);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 80, 80, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
	glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
	glBlitFramebuffer(0, 0, 80, 80, 0, 0, 80, 80, GL_COLOR_BUFFER_BIT, GL_NEAREST);
	glBindFramebuffer(GL_FRAMEBUFFER, 0);
	glViewport(0, 0, WIDTH, HEIGHT);
	show_texture(80);
	glBindTexture(GL_TEXTURE_2D, 0);
}

static void object(void)
{
	GLuint buffers[2], objects[2], texture;

	glGenRenderbuffers(2, buffers);
	glGenFramebuffers(2, objects);
	glGenTextures(1, &texture);
	bind_samples(objects[0], buffers);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	fan();
	glTranslatef(0.2f, 0.1f, 0);
	glRotatef(11, 1, 1, 1);
	fan();
	glEnable(GL_SCISSOR_TEST);
	glScissor(7, 9, 15, 13);
	glLineWidth(2);
	glBegin(GL_LINES);
	glVertex3f(-0.5f, -0.4f, -1.5f);
	glVertex3f(0.1f, 0.5f, -1.5f);
	glVertex3f(-0.5f, 0.1f, -1.5f);
	glVertex3f(0.1f, -0.5f, -1.5f);
	glEnd();
	glLineWidth(1);
	glDisable(GL_SCISSOR_TEST);
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glOrtho(0, 80, 0, 80, -1, 1);
	glMatrixMode(GL_MODELVIEW);
	lines_near(64, 75);
	resolve_into(objects[1], texture);
}

/* Draw over the samples of the previous frame, colours and depth. */
static void over_the_last(void)
{
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	glTranslatef(0.13f, 0.07f, -0.1f);
	glRotatef(31, 0.2f, 0.1f, 1);
	fan();
	glDisable(GL_BLEND);
}

/* A framebuffer object keeps its samples while another is bound. */
static void object_again(void)
{
	GLuint buffers[2], objects[2], texture;

	glGenRenderbuffers(2, buffers);
	glGenFramebuffers(2, objects);
	glGenTextures(1, &texture);
	bind_samples(objects[0], buffers);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	fan();
	resolve_into(objects[1], texture);
	glBindFramebuffer(GL_FRAMEBUFFER, objects[0]);
	glViewport(0, 0, 80, 80);
	reset(0);
	over_the_last();
	resolve_into(objects[1], texture);
}

int main(void)
{
	static void (*const frames[])(void) = {
		fan, crossing, floor_and_strips, lines, lines_at_tiles, points, textured, alpha_to_coverage, sample_coverage,
		blended, disabled, stencilled, pixels, scissored, cut_by_planes, outlines, copied, object, object_again, fan,
		over_the_last, over_the_last
	};
	int attributes[] = {
		GLX_RGBA, GLX_DOUBLEBUFFER, GLX_RED_SIZE, 8, GLX_ALPHA_SIZE, 8, GLX_DEPTH_SIZE, 24, GLX_STENCIL_SIZE, 8,
		GLX_SAMPLE_BUFFERS, 1, GLX_SAMPLES, 4, None
	};
	GLint samples;

	window_size[0] = WIDTH;
	window_size[1] = HEIGHT;
	window_kind = "four samples a pixel";
	open_window_of(attributes);
	glGetIntegerv(GL_SAMPLES, &samples);
	expect(samples == 4, "the window has four samples a pixel");
	for (unsigned i = 0; i < sizeof(frames) / sizeof(frames[0]); i++) {
		reset(frames[i] != over_the_last);
		frames[i]();
		end_frame();
	}
	expect(glGetError() == GL_NO_ERROR, "no error");
	return 0;
}
