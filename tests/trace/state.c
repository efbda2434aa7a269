/*
 * Frames that continue from earlier state: lists that move, rotate and colour, called plainly, by number, between Begin
 * and End and while they are compiled; a texture that is modified in each frame; attributes set without a draw; a
 * raster position moved by bitmaps; client arrays. Every frame clears the window.
 */
#include "window.h"

enum { FRAMES = 12, TURN = 1, CORNERS, NESTED, MADE };

static void make_lists(void)
{
	static const GLubyte nested[] = { TURN, TURN };

	glNewList(TURN, GL_COMPILE);
	glRotatef(7, 0, 0, 1);
	glColor3f(1, 0.5f, 0.25f);
	glRectf(-0.3f, -0.3f, 0.3f, 0.3f);
	glColor3f(0.25f, 0.75f, 1);
	glTranslatef(0.02f, 0, 0.001f);
	glEndList();
	glNewList(CORNERS, GL_COMPILE);
	glTexCoord2f(0, 0);
	glVertex2f(-0.9f, -0.9f);
	glTexCoord2f(1, 0);
	glVertex2f(-0.2f, -0.9f);
	glTexCoord2f(1, 1);
	glVertex2f(-0.2f, -0.2f);
	glEndList();
	glNewList(NESTED, GL_COMPILE);
	glPushAttrib(GL_CURRENT_BIT);
	glCallLists(2, GL_UNSIGNED_BYTE, nested);
	glPopAttrib();
	glEndList();
}

static void draw_texture(int frame)
{
	const GLubyte texel[3] = { (GLubyte)(20 * frame), (GLubyte)(255 - 20 * frame), 128 };

	glTexSubImage2D(GL_TEXTURE_2D, 0, frame % 4, frame / 4, 1, 1, GL_RGB, GL_UNSIGNED_BYTE, texel);
	glEnable(GL_TEXTURE_2D);
	glBegin(GL_TRIANGLES);
	glCallList(CORNERS);
	glEnd();
	glDisable(GL_TEXTURE_2D);
}

static void draw_array(int frame)
{
	const GLfloat corners[] = { 0.4f, 0.4f, 0.9f, 0.4f, 0.9f, 0.5f + 0.03f * (float)frame };

	glEnableClientState(GL_VERTEX_ARRAY);
	glVertexPointer(2, GL_FLOAT, 0, corners);
	glDrawArrays(GL_TRIANGLES, 0, 3);
	glDisableClientState(GL_VERTEX_ARRAY);
}

int main(void)
{
	static const GLubyte bits[] = { 0xF0, 0xF0, 0x0F, 0x0F };
	static GLubyte texels[4 * 4 * 3];

	open_window();
	make_lists();
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 4, 4, 0, GL_RGB, GL_UNSIGNED_BYTE, texels);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	glEnable(GL_DEPTH_TEST);
	glRasterPos2f(-0.9f, 0.6f);
	for (int frame = 0; frame < FRAMES; frame++) {
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
		draw_texture(frame);
		draw_array(frame);
		glBitmap(8, 4, 0, 0, 3, 0, bits);
		glCallList(TURN);
		glCallList(NESTED);
		glRectf(0.5f, -0.9f, 0.8f, -0.6f); /* in the colour left by a list */
		glNewList(MADE, GL_COMPILE_AND_EXECUTE);
		glColor3f(0.1f * (float)frame, 1, 0.5f);
		glRectf(-0.9f, 0, -0.7f, 0.2f);
		glEndList();
		end_frame();
		glColor3f(0.08f * (float)frame, 0.3f, 0.6f);
		glColor3f(0.3f, 0.08f * (float)frame, 0.6f);
	}
	expect(glGetError() == GL_NO_ERROR, "no error");
	return 0;
}
