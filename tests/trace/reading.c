/*
 * All state that affects glReadPixels is set to unusual values, one kind at the end of each frame. The recorder reads
 * frames back within the program, and must leave all of it unchanged. The last two frames make an error each: GL keeps
 * only the first until it is fetched (GL 2.1 sec. 2.5). With an argument nothing is set: the same pictures.
 */
#include "window.h"

enum { FRAMES = 11, BYTES = 64 * 48 * 4 };

static const struct setting {
	unsigned name;
	int value;
} packing[] = { { GL_PACK_SWAP_BYTES, 1 }, { GL_PACK_LSB_FIRST, 1 },   { GL_PACK_ROW_LENGTH, 80 },
	        { GL_PACK_SKIP_ROWS, 3 },  { GL_PACK_SKIP_PIXELS, 5 }, { GL_PACK_ALIGNMENT, 1 } };
static unsigned buffer, framebuffer;

static void make_objects(void)
{
	static unsigned char sevens[BYTES];
	unsigned texture;

	memset(sevens, 7, sizeof(sevens));
	glGenBuffers(1, &buffer);
	glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer);
	glBufferData(GL_PIXEL_PACK_BUFFER, BYTES, sevens, GL_STREAM_READ);
	glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
	glGenTextures(1, &texture);
	glBindTexture(GL_TEXTURE_2D, texture);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 64, 64, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
	glBindTexture(GL_TEXTURE_2D, 0);
	glGenFramebuffers(1, &framebuffer);
	glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
	glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
	glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

static int asked(unsigned name)
{
	int value = -1;

	glGetIntegerv(name, &value);
	return value;
}

static float asked_float(unsigned name)
{
	float value = -1;

	glGetFloatv(name, &value);
	return value;
}

static void set(int frame)
{
	static const float inverse[2] = { 1, 0 };

	if (frame < 6)
		glPixelStorei(packing[frame].name, packing[frame].value);
	else if (frame == 6)
		glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer);
	else if (frame == 7)
		glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
	else if (frame == 9)
		glEnable(GL_FOG_MODE);
	else if (frame == 10)
		glPopMatrix();
	else {
		glPixelTransferf(GL_RED_SCALE, 0.5f);
		glPixelTransferf(GL_GREEN_BIAS, 0.25f);
		glPixelTransferf(GL_DEPTH_BIAS, 0.125f);
		glPixelTransferi(GL_MAP_COLOR, 1);
		glPixelMapfv(GL_PIXEL_MAP_B_TO_B, 2, inverse);
		glReadBuffer(GL_FRONT);
	}
}

static void expect_set(int frame)
{
	unsigned char bytes[BYTES];

	for (int i = 0; i < 6; i++)
		expect(asked(packing[i].name) == (i <= frame                           ? packing[i].value :
		                                  packing[i].name == GL_PACK_ALIGNMENT ? 4 :
		                                                                         0),
		       "packing as it was set");
	expect(asked(GL_PIXEL_PACK_BUFFER_BINDING) == (frame >= 6 ? (int)buffer : 0), "the buffer stays bound");
	if (frame >= 6) {
		glGetBufferSubData(GL_PIXEL_PACK_BUFFER, 0, BYTES, bytes);
		for (int i = 0; i < BYTES; i++)
			expect(bytes[i] == 7, "nothing is read into the program's buffer");
	}
	expect(asked(GL_FRAMEBUFFER_BINDING) == (frame == 7 ? (int)framebuffer : 0), "the framebuffer stays bound");
	expect(asked_float(GL_RED_SCALE) == (frame >= 8 ? 0.5f : 1) &&
	               asked_float(GL_GREEN_BIAS) == (frame >= 8 ? 0.25f : 0) &&
	               asked_float(GL_DEPTH_BIAS) == (frame >= 8 ? 0.125f : 0) && asked(GL_MAP_COLOR) == (frame >= 8),
	       "pixel transfer as it was set");
	expect(asked(GL_READ_BUFFER) == (frame >= 8 ? GL_FRONT :
	                                 frame == 7 ? GL_COLOR_ATTACHMENT0 :
	                                              GL_BACK),
	       "the buffer that is read");
	if (frame == 10) {
		glPopMatrix();
		expect(glGetError() == GL_INVALID_ENUM, "the first error is kept");
	}
	if (frame != 9)
		expect(glGetError() == GL_NO_ERROR, "no error, or no further one");
}

int main(int argc, char **argv)
{
	(void)argv;
	open_window();
	make_objects();
	glEnable(GL_DEPTH_TEST);
	for (int frame = 0; frame < FRAMES; frame++) {
		glClearColor(0.25f, 0.5f, 0.1f * (float)frame, 1);
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		glColor3f(1, 0.5f, 0.75f);
		glRectf(-0.5f, -0.75f, 0.1f * (float)frame, 0.3f);
		if (argc < 2)
			set(frame);
		end_frame();
		if (argc < 2)
			expect_set(frame);
		glBindFramebuffer(GL_FRAMEBUFFER, 0);
	}
	return 0;
}
