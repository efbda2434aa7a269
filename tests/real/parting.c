/*
 * Six frames of textured squares, drawn from a list and from an array, with one change: `parting WHAT`. Recorded by
 * test_bisect.py, which must find that change and no other.
 */
#include "tests/trace/window.h"

static const char *what = "nothing";

static int changes(const char *name)
{
	return strcmp(what, name) == 0;
}

static void make_texture(unsigned name, unsigned char red)
{
	unsigned char texels[4][4][4];

	memset(texels, 255, sizeof(texels));
	for (int i = 0; i < 16; i++)
		texels[i / 4][i % 4][0] = (unsigned char)(i % 3 * 100), texels[i / 4][i % 4][1] = red;
	glBindTexture(GL_TEXTURE_2D, name);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
}

static void draw_frame(int frame, unsigned texture, unsigned list)
{
	const float corners[] = { 0, 0, 0.5f, 0, 0.5f, changes("array") && frame == 3 ? 0.9f : 0.5f, 0, 0.5f };

	glClearColor(0, 0, changes("last") && frame == 5 ? 1 : 0.5f, 1);
	glClear(GL_COLOR_BUFFER_BIT);
	if (changes("query"))
		expect(glGetError() == GL_NO_ERROR, "no error");
	glLoadIdentity();
	glRotatef((float)frame * (changes("matrix") && frame == 5 ? 8 : 7), 0, 0, 1);
	if (changes("inserted") && frame == 3)
		glEnable(GL_LIGHTING);
	if (!(changes("removed") && frame == 2))
		glEnable(GL_TEXTURE_2D);
	glBindTexture(GL_TEXTURE_2D, changes("texture") && frame == 4 ? texture : texture + 1);
	glCallList(list);
	glDisable(GL_TEXTURE_2D);
	if (changes("argument") && frame == 1)
		glBlendFunc(GL_ONE, GL_ONE);
	else
		glBlendFunc(GL_ONE, GL_ZERO);
	glEnable(GL_BLEND);
	glColor3f(1, 0.5f, 0.2f);
	glVertexPointer(2, GL_FLOAT, 0, corners);
	glDrawArrays(GL_QUADS, 0, 4);
	glDisable(GL_BLEND);
	glColor3f(1, 1, 1);
	end_frame();
}

int main(int argc, char **argv)
{
	unsigned texture = 1, list = 3;

	what = argc > 1 ? argv[1] : what;
	if (changes("numbers"))
		texture = 8, list = 41;
	open_window();
	make_texture(texture, 0);
	make_texture(texture + 1, changes("texel") ? 101 : 100);
	glNewList(list, GL_COMPILE);
	glBegin(GL_QUADS);
	for (int i = 0; i < 4; i++) {
		glTexCoord2f(i == 1 || i == 2, i > 1);
		glVertex2f((float)(i == 1 || i == 2) - (changes("list") && i == 2 ? 0.5f : 1), i > 1);
	}
	glEnd();
	glEndList();
	glEnableClientState(GL_VERTEX_ARRAY);
	for (int frame = 0; frame < 6; frame++) {
		if (changes("frame") && frame == 2)
			draw_frame(20, texture, list);
		draw_frame(frame, texture, list);
	}
	return 0;
}
