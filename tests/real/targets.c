/*
 * Draw targets, one kind per frame: a window with alpha, whose stored alpha is used by blending; textures and
 * renderbuffers as colour, depth and stencil, drawn with, copied and kept from frame to frame. Recorded by
 * test_targets.py; sums.c covers the accumulation buffer.
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
}

static void panel(int x, int y, int size, float r, float g, float b, float a)
{
	glColor4f(r, g, b, a);
	glRecti(x, y, x + size, y + size);
}

/* Blend factors that use the stored alpha, masks that preserve it, and a common trick: drawing alpha first. */
static void stored_alpha(void)
{
	glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
	panel(4, 4, 20, 1, 1, 1, 0.8f);
	glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
	glEnable(GL_BLEND);
	glBlendFunc(GL_DST_ALPHA, GL_ONE_MINUS_DST_ALPHA);
	panel(10, 10, 30, 1, 0.6f, 0, 0.2f);
	glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
	glBlendFunc(GL_SRC_ALPHA_SATURATE, GL_ONE);
	panel(30, 5, 25, 0.2f, 0.8f, 0.6f, 0.8f);
	panel(34, 9, 25, 0.8f, 0.2f, 0.6f, 0.8f);
	glBlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_DST_ALPHA);
	panel(20, 25, 20, 0.4f, 0.6f, 1, 0.6f);
	glDisable(GL_BLEND);
}

static unsigned objects[2], colors[2], depths[2]; /* the first with a depth renderbuffer, the second with a depth
                                                     texture */

static void make_objects(void)
{
	glGenFramebuffers(2, objects);
	glGenTextures(2, colors);
	glGenTextures(1, &depths[1]);
	glGenRenderbuffers(1, depths);
	glBindRenderbuffer(GL_RENDERBUFFER, depths[0]);
	glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, 32, 16);
	for (int i = 0; i < 2; i++) {
		glBindTexture(GL_TEXTURE_2D, colors[i]);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
		glTexImage2D(GL_TEXTURE_2D, 0, i ? GL_RGB : GL_RGBA, 32, 16 << i, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
		glBindFramebuffer(GL_FRAMEBUFFER, objects[i]);
		glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colors[i], 0);
	}
	glBindTexture(GL_TEXTURE_2D, depths[1]);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, 32, 32, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, NULL);
	glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depths[1], 0);
	expect(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE, "the second object is complete");
	glBindFramebuffer(GL_FRAMEBUFFER, objects[0]);
	glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depths[0]);
	glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_STENCIL_ATTACHMENT, GL_RENDERBUFFER, depths[0]);
	expect(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE, "the first object is complete");
	glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

/* Draw to an object from now on, or to the window again. */
static void draw_to(unsigned object, int width, int height)
{
	glBindFramebuffer(GL_FRAMEBUFFER, object);
	glViewport(0, 0, width, height);
}

static void show(unsigned texture, int x, int y, int width, int height)
{
	glBindTexture(GL_TEXTURE_2D, texture);
	glEnable(GL_TEXTURE_2D);
	glColor4f(1, 1, 1, 1);
	glBegin(GL_QUADS);
	glTexCoord2f(0, 0);
	glVertex2i(x, y);
	glTexCoord2f(1, 0);
	glVertex2i(x + width, y);
	glTexCoord2f(1, 1);
	glVertex2i(x + width, y + height);
	glTexCoord2f(0, 1);
	glVertex2i(x, y + height);
	glEnd();
	glDisable(GL_TEXTURE_2D);
}

/*
 * Draw with the object's own depth, stencil and scissor, then show its texture in the window; later draw to it without
 * a clear.
 */
static void render_to_texture(void)
{
	draw_to(objects[0], 32, 16);
	glClearColor(0, 0, 1, 0.2f);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
	glEnable(GL_DEPTH_TEST);
	glTranslatef(0, 0, 2);
	panel(4, 6, 20, 1, 0, 0, 1);
	glTranslatef(0, 0, -1);
	panel(10, 12, 30, 0, 1, 0, 0.4f); /* behind it */
	glLoadIdentity();
	glDisable(GL_DEPTH_TEST);
	glEnable(GL_SCISSOR_TEST);
	glScissor(20, 8, 30, 30); /* the object ends at 32, 16 */
	panel(0, 0, 64, 1, 1, 0, 1);
	glDisable(GL_SCISSOR_TEST);
	draw_to(0, 64, 48);
	show(colors[0], 0, 0, 32, 16);
	draw_to(objects[0], 32, 16);
	panel(0, 0, 12, 0, 1, 1, 1);
	draw_to(0, 64, 48);
	show(colors[0], 32, 24, 32, 16);
}

/* A depth texture as a picture; the previous frame's colours are preserved. */
static void depth_texture(void)
{
	draw_to(objects[1], 32, 32);
	glClearColor(0.6f, 0.2f, 0, 1);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glEnable(GL_DEPTH_TEST);
	glTranslatef(0, 0, 6);
	panel(16, 12, 32, 0.2f, 0.4f, 0.6f, 1);
	glLoadIdentity();
	glDisable(GL_DEPTH_TEST);
	draw_to(0, 64, 48);
	show(depths[1], 0, 0, 32, 32);
	show(colors[1], 32, 0, 32, 32);
	show(colors[0], 0, 32, 32, 16);
}

/* Levels generated from a drawn picture, and levels drawn individually; uses the extension's names. */
static void levels(void)
{
	unsigned tex, fb;

	glGenTextures(1, &tex);
	glGenFramebuffersEXT(1, &fb);
	glBindTexture(GL_TEXTURE_2D, tex);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 32, 32, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
	glBindFramebufferEXT(GL_FRAMEBUFFER_EXT, fb);
	glFramebufferTexture2DEXT(GL_FRAMEBUFFER_EXT, GL_COLOR_ATTACHMENT0_EXT, GL_TEXTURE_2D, tex, 0);
	glViewport(0, 0, 32, 32);
	glClear(GL_COLOR_BUFFER_BIT);
	panel(10, 10, 30, 1, 0.5f, 0, 1);
	panel(3, 3, 17, 0, 0.5f, 1, 1);
	glGenerateMipmapEXT(GL_TEXTURE_2D);
	glBindFramebufferEXT(GL_FRAMEBUFFER_EXT, 0);
	glViewport(0, 0, 64, 48);
	show(tex, 0, 0, 16, 16);
	show(tex, 20, 0, 8, 8);
	show(tex, 30, 0, 4, 4);
	show(tex, 0, 16, 32, 32);
	glBindFramebufferEXT(GL_FRAMEBUFFER_EXT, fb);
	glViewport(0, 0, 16, 16);
	glFramebufferTexture2DEXT(GL_FRAMEBUFFER_EXT, GL_COLOR_ATTACHMENT0_EXT, GL_TEXTURE_2D, tex, 1);
	panel(3, 20, 17, 1, 1, 1, 1);
	glBindFramebufferEXT(GL_FRAMEBUFFER_EXT, 0);
	glViewport(0, 0, 64, 48);
	show(tex, 40, 0, 16, 16);
	glDeleteFramebuffersEXT(1, &fb);
	glDeleteTextures(1, &tex);
}

/* Faces of a cube and layers of a 3D texture. */
static void layers(void)
{
	unsigned tex[2], fb;

	glGenTextures(2, tex);
	glGenFramebuffersEXT(1, &fb);
	glBindFramebufferEXT(GL_FRAMEBUFFER_EXT, fb);
	glBindTexture(GL_TEXTURE_3D, tex[0]);
	glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	glTexImage3D(GL_TEXTURE_3D, 0, GL_RGBA8, 16, 16, 2, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
	glBindTexture(GL_TEXTURE_CUBE_MAP, tex[1]);
	glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	glViewport(0, 0, 16, 16);
	for (int i = 0; i < 8; i++) {
		unsigned face = GL_TEXTURE_CUBE_MAP_POSITIVE_X + (unsigned)i;

		if (i < 6) {
			glTexImage2D(face, 0, GL_RGBA8, 16, 16, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
			glFramebufferTexture2DEXT(GL_FRAMEBUFFER_EXT, GL_COLOR_ATTACHMENT0_EXT, face, tex[1], 0);
		} else {
			glFramebufferTexture3DEXT(GL_FRAMEBUFFER_EXT, GL_COLOR_ATTACHMENT0_EXT, GL_TEXTURE_3D, tex[0], 0, i - 6);
		}
		glClearColor((float)(i & 1), (float)(i >> 1 & 1), (float)(i >> 2 & 1), 1);
		glClear(GL_COLOR_BUFFER_BIT);
		panel(10, 20, 17, 0.2f * (float)(i % 6), 0.4f, 0.6f, 1);
	}
	glBindFramebufferEXT(GL_FRAMEBUFFER_EXT, 0);
	glViewport(0, 0, 64, 48);
	glColor3f(1, 1, 1);
	glEnable(GL_TEXTURE_3D);
	for (int i = 0; i < 2; i++) {
		glBegin(GL_QUADS);
		glTexCoord3f(0, 0, 0.25f + 0.5f * (float)i);
		glVertex2i(32 * i, 0);
		glTexCoord3f(1, 0, 0.25f + 0.5f * (float)i);
		glVertex2i(32 * i + 16, 0);
		glTexCoord3f(1, 1, 0.25f + 0.5f * (float)i);
		glVertex2i(32 * i + 16, 16);
		glTexCoord3f(0, 1, 0.25f + 0.5f * (float)i);
		glVertex2i(32 * i, 16);
		glEnd();
	}
	glDisable(GL_TEXTURE_3D);
	glEnable(GL_TEXTURE_CUBE_MAP);
	for (int i = 0; i < 2; i++) {
		float x = i ? -1.0f : 1.0f;

		glBegin(GL_QUADS);
		glTexCoord3f(x, -1, -1);
		glVertex2i(32 * i, 20);
		glTexCoord3f(x, 1, -1);
		glVertex2i(32 * i + 16, 20);
		glTexCoord3f(x, 1, 1);
		glVertex2i(32 * i + 16, 36);
		glTexCoord3f(x, -1, 1);
		glVertex2i(32 * i, 36);
		glEnd();
	}
	glDisable(GL_TEXTURE_CUBE_MAP);
	glDeleteFramebuffersEXT(1, &fb);
	glDeleteTextures(2, tex);
}

/* Copies into and out of objects, between objects and the window, flipped and moved. */
static void copies(void)
{
	panel(2, 2, 10, 1, 0, 1, 1);
	glBindFramebuffer(GL_READ_FRAMEBUFFER, objects[1]);
	glBlitFramebuffer(0, 0, 32, 32, 0, 32, 32, 0, GL_COLOR_BUFFER_BIT, GL_NEAREST);
	glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
	glBindFramebuffer(GL_DRAW_FRAMEBUFFER, objects[0]);
	glBlitFramebuffer(0, 0, 16, 16, 0, 0, 16, 16, GL_COLOR_BUFFER_BIT, GL_NEAREST);
	glBindFramebuffer(GL_FRAMEBUFFER, objects[0]);
	glBindTexture(GL_TEXTURE_2D, colors[1]);
	glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 8, 12, 0, 0, 20, 10);
	glBindFramebuffer(GL_FRAMEBUFFER, 0);
	show(colors[0], 0, 32, 32, 16);
	show(colors[1], 32, 16, 32, 32);
}

/* Scaled blits: halved and mirrored in another object, doubled in the window, and clipped by its border. */
static void scaled(void)
{
	glBindFramebuffer(GL_FRAMEBUFFER, objects[1]);
	panel(2, 2, 10, 1, 0, 1, 1);
	panel(14, 6, 9, 0, 1, 0.5f, 1);
	glBindFramebuffer(GL_READ_FRAMEBUFFER, objects[1]);
	glBindFramebuffer(GL_DRAW_FRAMEBUFFER, objects[0]);
	glBlitFramebuffer(0, 0, 32, 32, 16, 0, 0, 16, GL_COLOR_BUFFER_BIT, GL_LINEAR);
	glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
	glBlitFramebuffer(4, 4, 24, 20, 0, 0, 36, 30, GL_COLOR_BUFFER_BIT, GL_LINEAR);
	glBlitFramebuffer(0, 0, 32, 32, 40, 60, 72, 40, GL_COLOR_BUFFER_BIT, GL_LINEAR);
	glBindFramebuffer(GL_FRAMEBUFFER, 0);
	show(colors[0], 2, 34, 16, 16);
}

/* An object with several colour attachments, each with a history of its own: cleared together, drawn over with and
 * without depth. */
static void several(void)
{
	static const unsigned both[2] = { GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT2 };
	unsigned tex[2], depth, fb;

	glGenTextures(2, tex);
	glGenFramebuffers(1, &fb);
	glGenRenderbuffers(1, &depth);
	glBindRenderbuffer(GL_RENDERBUFFER, depth);
	glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, 32, 24);
	glBindFramebuffer(GL_FRAMEBUFFER, fb);
	glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
	glViewport(0, 0, 32, 24);
	for (unsigned i = 0; i < 2; i++) {
		glBindTexture(GL_TEXTURE_2D, tex[i]);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
		glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 32, 24, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
		glFramebufferTexture2D(GL_FRAMEBUFFER, both[i], GL_TEXTURE_2D, tex[i], 0);
		glDrawBuffer(both[i]);
		glClearColor(i ? 0.2f : 0.8f, 0.4f, i ? 0.8f : 0, i ? 0.2f : 0.6f);
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		panel(6 + 20 * (int)i, 6, 22, 1, (float)i, 0.4f, 0.8f);
	}
	glDrawBuffers(2, both);
	expect(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE, "the object with two colours is complete");
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_DST_ALPHA);
	glTranslatef(0, 0, 3);
	panel(12, 12, 30, 0.2f, 0.6f, 1, 0.4f);
	glTranslatef(0, 0, -2);
	panel(2, 20, 30, 1, 0.6f, 0, 0.6f); /* partly behind */
	glLoadIdentity();
	glDisable(GL_BLEND);
	glDisable(GL_DEPTH_TEST);
	glDrawBuffer(GL_COLOR_ATTACHMENT2);
	panel(48, 30, 10, 0, 0, 0, 1);
	glBindFramebuffer(GL_FRAMEBUFFER, 0);
	glViewport(0, 0, 64, 48);
	show(tex[0], 0, 0, 32, 24);
	show(tex[1], 32, 0, 32, 24);
	glBindFramebuffer(GL_FRAMEBUFFER, fb); /* both are drawn to again */
	glDrawBuffers(2, both);
	glViewport(0, 0, 32, 24);
	glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
	glClearColor(0, 0.9f, 0.9f, 0);
	glEnable(GL_SCISSOR_TEST);
	glScissor(16, 4, 100, 12);
	glClear(GL_COLOR_BUFFER_BIT);
	glDisable(GL_SCISSOR_TEST);
	glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
	glBindFramebuffer(GL_FRAMEBUFFER, 0);
	glViewport(0, 0, 64, 48);
	show(tex[0], 0, 24, 32, 24);
	show(tex[1], 32, 24, 32, 24);
	glDeleteFramebuffers(1, &fb);
	glDeleteRenderbuffers(1, &depth);
	glDeleteTextures(2, tex);
}

/*
 * Floating-point objects: values outside [0,1] are preserved by clears, draws, blending and copies, unless the program
 * enables clamping. Shown dimmed, panel by panel.
 */
static void floats(void)
{
	static const int formats[2] = { GL_RGBA32F, GL_RGB16F };
	static const float pixels[2][2][4] = { { { 3, -1, 0.5f, 1 }, { 0, 2, 4, 1 } },
		                               { { 1.5f, 1.5f, 0, 1 }, { -2, 3, 0.25f, 1 } } };
	const float fog[4] = { 2, 0.5f, -1, 1 };
	unsigned object[2], target[2], held, copy;

	glGenFramebuffers(2, object);
	glGenTextures(2, target);
	for (int i = 0; i < 2; i++) {
		glBindTexture(GL_TEXTURE_2D, target[i]);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
		glTexImage2D(GL_TEXTURE_2D, 0, formats[i], 32, 32, 0, GL_RGBA, GL_FLOAT, NULL);
		draw_to(object[i], 32, 32);
		glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target[i], 0);
		glMatrixMode(GL_PROJECTION);
		glLoadIdentity();
		glOrtho(0, 32, 0, 32, -10, 10);
		glClearColor(2, -1, 0.5f, 3);
		glClear(GL_COLOR_BUFFER_BIT);
		glEnable(GL_BLEND);
		glBlendFunc(GL_ONE, GL_ONE);
		for (int k = 0; k < 3; k++)
			panel(2, 2, 8, 0.7f, 0.9f, 0.3f, 0.5f);
		glBlendColor(2, 0.5f, -1, 1);
		glBlendFunc(GL_CONSTANT_COLOR, GL_ONE_MINUS_SRC_ALPHA);
		panel(12, 2, 8, 0.9f, 0.8f, 0.7f, 0.6f);
		glBlendEquation(GL_FUNC_REVERSE_SUBTRACT);
		glBlendFunc(GL_DST_ALPHA, GL_SRC_ALPHA_SATURATE);
		panel(22, 2, 8, 0.2f, 0.4f, 0.1f, 0.6f);
		glBlendEquation(GL_MAX);
		panel(2, 12, 8, 0.6f, 0.4f, 0.8f, 0.6f);
		glBlendEquation(GL_FUNC_ADD);
		glDisable(GL_BLEND);
		glClampColor(GL_CLAMP_VERTEX_COLOR, GL_FALSE);
		glEnable(GL_ALPHA_TEST);
		glAlphaFunc(GL_GREATER, 1.5f);
		panel(12, 12, 8, 3, -0.5f, 1.5f, 2);
		panel(12, 16, 4, 1, 1, 1, 1.25f);
		glDisable(GL_ALPHA_TEST);
		glClampColor(GL_CLAMP_FRAGMENT_COLOR, GL_TRUE);
		panel(22, 12, 4, 3, -0.5f, 1.5f, 2);
		glClampColor(GL_CLAMP_FRAGMENT_COLOR, GL_FIXED_ONLY);
		glClampColor(GL_CLAMP_VERTEX_COLOR, GL_TRUE);
		panel(26, 12, 4, 3, -0.5f, 1.5f, 2);
		glEnable(GL_FOG);
		glFogfv(GL_FOG_COLOR, fog);
		glFogi(GL_FOG_MODE, GL_LINEAR);
		glFogf(GL_FOG_START, -1);
		glFogf(GL_FOG_END, 1);
		panel(22, 16, 4, 0.2f, 0.4f, 0.6f, 1);
		glDisable(GL_FOG);
		glWindowPos2i(2, 22);
		glPixelZoom(4, 4);
		glPixelTransferf(GL_RED_SCALE, 1.5f);
		glDrawPixels(2, 2, GL_RGBA, GL_FLOAT, pixels);
		glPixelTransferf(GL_RED_SCALE, 1);
		glPixelZoom(1, 1);
		glWindowPos2i(12, 22);
		glCopyPixels(2, 22, 8, 8, GL_COLOR);
	}
	/* a renderbuffer's contents are kept when it moves to another object, and copied to a texture */
	glGenRenderbuffers(1, &held);
	glBindRenderbuffer(GL_RENDERBUFFER, held);
	glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA16F, 32, 32);
	draw_to(object[1], 32, 32);
	glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, held);
	glBindFramebuffer(GL_READ_FRAMEBUFFER, object[0]);
	glBlitFramebuffer(0, 0, 32, 32, 0, 0, 32, 32, GL_COLOR_BUFFER_BIT, GL_NEAREST);
	draw_to(object[1], 32, 32);
	glEnable(GL_BLEND);
	glBlendFunc(GL_ONE, GL_ONE);
	panel(8, 8, 16, 0.25f, 0.25f, 0.5f, 0);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	for (int k = 0; k < 400; k++) /* each store truncates to a half float, which adds up */
		panel(0, 0, 8, 0.9f, 0.4f, 0.7f, 0.005f);
	glDisable(GL_BLEND);
	glGenTextures(1, &copy);
	glBindTexture(GL_TEXTURE_2D, copy);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, 0, 0, 32, 32, 0);
	draw_to(0, 64, 48);
	reset();
	glEnable(GL_TEXTURE_2D);
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE);
	glColor4f(0.3f, 0.3f, 0.3f, 1);
	for (int i = 0; i < 3; i++) {
		glBindTexture(GL_TEXTURE_2D, i < 2 ? target[i] : copy);
		glBegin(GL_QUADS);
		for (int k = 0; k < 4; k++) {
			int u = k == 1 || k == 2, v = k >= 2;

			glTexCoord2i(u, v);
			glVertex2i(i % 2 * 32 + 32 * u, i / 2 * 32 + (i / 2 ? 16 : 32) * v);
		}
		glEnd();
	}
	glDisable(GL_TEXTURE_2D);
}

/* Objects with few bits: drawing loses the low bits; only four-bit formats are rounded. */
static void few_bits(void)
{
	static const int formats[4] = { GL_RGB5_A1, GL_RGBA4, GL_R3_G3_B2, GL_RGB565 };
	unsigned object, target[4];

	glGenFramebuffers(1, &object);
	glGenTextures(4, target);
	for (int i = 0; i < 4; i++) {
		glBindTexture(GL_TEXTURE_2D, target[i]);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
		glTexImage2D(GL_TEXTURE_2D, 0, formats[i], 32, 24, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
		draw_to(object, 32, 24);
		glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target[i], 0);
		if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE)
			for (int k = 0; k < 48; k++)
				panel(k % 8 * 8, k / 8 * 8, 8, (float)(k * 5) / 255, (float)(k * 5 + 3) / 255,
				      1 - (float)(k * 5) / 255, (float)(k % 2));
		draw_to(0, 64, 48);
		show(target[i], i % 2 * 32, i / 2 * 24, 32, 24);
	}
}

/* Selection and feedback leave buffers unchanged but move the raster position; blits are not rendering. */
static void not_rendered(void)
{
	static const unsigned char bits[8] = { 255, 129, 165, 129, 165, 153, 129, 255 };
	static const float pixels[2][2][3] = { { { 1, 0, 0 }, { 0, 1, 0 } }, { { 0, 0, 1 }, { 1, 1, 0 } } };
	unsigned names[64];
	float numbers[256];

	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	panel(2, 2, 12, 1, 0.6f, 0, 1);
	glSelectBuffer(64, names);
	glFeedbackBuffer(256, GL_3D_COLOR, numbers);
	for (int i = 0; i < 2; i++) {
		glRenderMode(i ? GL_FEEDBACK : GL_SELECT);
		glInitNames();
		glPushName(7);
		glColor3f(0.2f, 0.8f, 0.4f);
		glRasterPos2i(20 + 20 * i, 4);
		panel(8, 8, 40, 0, 1, 1, 1);
		glBitmap(8, 8, 0, 0, 4, 24, bits);
		glDrawPixels(2, 2, GL_RGB, GL_FLOAT, pixels);
		glCopyPixels(2, 2, 8, 8, GL_COLOR);
		glClearColor(0, 0, 0, 0);
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		glBlitFramebuffer(2, 2, 8, 8, 4 + 10 * i, 30, 10 + 10 * i, 36, GL_COLOR_BUFFER_BIT, GL_NEAREST);
		glRenderMode(GL_RENDER);
		glBitmap(8, 8, 0, 0, 0, 0, bits);
	}
}

int main(void)
{
	static void (*const frames[])(void) = { stored_alpha, render_to_texture, depth_texture, copies, levels,
		                                layers,       several,           floats,        scaled, few_bits,
		                                not_rendered };
	int attributes[] = { GLX_RGBA, GLX_DOUBLEBUFFER, GLX_ALPHA_SIZE, 1, GLX_DEPTH_SIZE, 1, GLX_STENCIL_SIZE, 1, None };

	open_window_of(attributes);
	make_objects();
	draw_frames(frames, sizeof(frames) / sizeof(frames[0]), reset);
	return 0;
}
