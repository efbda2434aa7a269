/*
 * Text by glXUseXFont: the X server's characters are compiled into lists while the unpack state differs from that of
 * their bitmaps. An argument names a folder with a font "tall", whose A is taller than any recorded character, and
 * whose B is a box.
 */
#include "window.h"

enum { FRAMES = 5, BASE = 1000, CURSORS = 3000, TALL = 5000 };

static void use_font(const char *name, int first, int count, int base)
{
	Font font = XLoadFont(display, name);

	glXUseXFont(font, first, count, base);
	XUnloadFont(display, font);
}

static void write_text(int x, int y, int base, const char *text)
{
	glRasterPos2i(x, y);
	glListBase((unsigned)base);
	glCallLists((int)strlen(text), GL_UNSIGNED_BYTE, text);
}

static void use_tall_font(char *folder)
{
	char **path, *longer[64];
	int n;

	path = XGetFontPath(display, &n);
	expect(n < 64, "a font path");
	memcpy(longer, path, (size_t)n * sizeof(*path));
	longer[n] = folder;
	XSetFontPath(display, longer, n + 1);
	use_font("tall", 'A', 2, TALL);
	expect(glIsList(TALL) && glIsList(TALL + 1), "lists of tall characters");
	XSetFontPath(display, path, n);
	XFreeFontPath(path);
}

int main(int argc, char **argv)
{
	float at[4];

	open_window();
	glMatrixMode(GL_PROJECTION);
	glOrtho(0, 64, 0, 48, -1, 1);
	glPixelStorei(GL_UNPACK_ALIGNMENT, 8);
	glPixelStorei(GL_UNPACK_SKIP_PIXELS, 3);
	glPixelStorei(GL_UNPACK_LSB_FIRST, 1);
	use_font("fixed", 0, 256, BASE);
	use_font("cursor", 0, 256, CURSORS); /* characters of many sizes, left of and below their origin; the last do
	                                        not exist */
	expect(glIsList(BASE) && glIsList(CURSORS + 255) && !glIsList(BASE + 256), "a list for each character");
	if (argc > 1)
		use_tall_font(argv[1]);
	glGetError(); /* Mesa's own error, for characters without pixels */
	for (int frame = 0; frame < FRAMES; frame++) {
		glClearColor(0, 0, 0.1f * (float)frame, 1);
		glClear(GL_COLOR_BUFFER_BIT);
		glColor3f(1, 0.5f, 0);
		write_text(2 + frame, 34, BASE, "Txt gj \x7Fy");
		glColor3f(0, 1, 0.25f * (float)frame);
		write_text(12, 12 + frame, CURSORS, "\x02\x44\xFF\x3A");
		glGetFloatv(GL_CURRENT_RASTER_POSITION, at);
		expect(at[0] > 12, "text moves the raster position");
		if (argc > 1)
			write_text(40, 2 + frame, TALL, "\x01"); /* B; A has no bitmap to replay */
		end_frame();
	}
	expect(glGetError() == GL_NO_ERROR, "no error");
	return 0;
}
