/* Runs inside the traced program. */
#include "capture/gl/font.h"

#include <GL/gl.h>
#include <X11/Xlib.h>
#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <sys/mman.h>

#include "capture/gl/context.h"
#include "capture/gl/resolve.h"
#include "capture/gl/restore.h"
#include "capture/write/fake.h"
#include "capture/write/pages.h"
#include "capture/write/values.h"
#include "capture/write/writer.h"
#include "real.h"

enum { MAX_SIDE = 4096, MAX_CHARACTERS = 1 << 16 };

static struct {
	XFontStruct *(*XQueryFont)(Display *, XID);
	int (*XFreeFontInfo)(char **, XFontStruct *, int);
	Pixmap (*XCreatePixmap)(Display *, Drawable, unsigned, unsigned, unsigned);
	int (*XFreePixmap)(Display *, Pixmap);
	GC (*XCreateGC)(Display *, Drawable, unsigned long, XGCValues *);
	int (*XFreeGC)(Display *, GC);
	int (*XSetForeground)(Display *, GC, unsigned long);
	int (*XFillRectangle)(Display *, Drawable, GC, int, int, unsigned, unsigned);
	int (*XDrawString16)(Display *, Drawable, GC, int, int, const XChar2b *, int);
	XImage *(*XGetImage)(Display *, Drawable, int, int, unsigned, unsigned, unsigned long, int);
} x;
static int x_found;
static pthread_once_t x_once = PTHREAD_ONCE_INIT;

static void find_xlib(void)
{
	static const char *const names[] = { "XQueryFont",  "XFreeFontInfo",  "XCreatePixmap",  "XFreePixmap",   "XCreateGC",
		                             "XFreeGC",     "XSetForeground", "XFillRectangle", "XDrawString16", "XGetImage" };
	void *lib = dlopen("libX11.so.6", RTLD_LAZY | RTLD_LOCAL), **functions = (void **)&x;

	x_found = lib != NULL;
	for (size_t i = 0; lib && i < sizeof(names) / sizeof(names[0]); i++)
		if (!(functions[i] = resolve_in(lib, names[i])))
			x_found = 0;
}

/* A character's metrics; NULL if the font lacks the character. */
static const XCharStruct *find_character(const XFontStruct *font, unsigned code)
{
	unsigned columns = font->max_char_or_byte2 - font->min_char_or_byte2 + 1;
	unsigned row = code >> 8, column = code & 0xFF;

	if (font->min_byte1 == font->max_byte1) { /* one row, however long */
		row = font->min_byte1;
		column = code;
	}
	if (row < font->min_byte1 || row > font->max_byte1 || column < font->min_char_or_byte2 ||
	    column > font->max_char_or_byte2)
		return NULL;
	return font->per_char ? &font->per_char[(row - font->min_byte1) * columns + column - font->min_char_or_byte2] :
	                        &font->max_bounds;
}

/* `bits` is all zeros. GL's rows go from the bottom up; each has whole bytes, the leftmost pixel in the highest bit. */
static void draw_character(Display *display, const XFontStruct *font, unsigned code, const XCharStruct *c,
                           uint8_t *bits)
{
	unsigned width = (unsigned)(c->rbearing - c->lbearing), height = (unsigned)(c->ascent + c->descent);
	XGCValues values = { .font = font->fid };
	XChar2b name = { (unsigned char)(code >> 8), (unsigned char)code };
	Pixmap pixmap = x.XCreatePixmap(display, DefaultRootWindow(display), width, height, 1);
	GC gc = x.XCreateGC(display, pixmap, GCFont, &values);
	XImage *image;

	x.XSetForeground(display, gc, 0);
	x.XFillRectangle(display, pixmap, gc, 0, 0, width, height);
	x.XSetForeground(display, gc, 1);
	x.XDrawString16(display, pixmap, gc, -c->lbearing, c->ascent, &name, 1);
	image = x.XGetImage(display, pixmap, 0, 0, width, height, 1, XYPixmap);
	for (unsigned row = 0; image && row < height; row++)
		for (unsigned column = 0; column < width; column++)
			if (image->f.get_pixel(image, (int)column, (int)(height - 1 - row)))
				bits[row * ((width + 7) / 8) + column / 8] |= (uint8_t)(0x80 >> column % 8);
	if (image)
		image->f.destroy_image(image);
	x.XFreeGC(display, gc);
	x.XFreePixmap(display, pixmap);
}

static void record_list(unsigned list, const XCharStruct *c, int width, int height, float advance, const uint8_t *bits)
{
	fake_call(CMD_glNewList, "ue", list, GL_COMPILE);
	fake_call(CMD_glBitmap, "iiffffb", width, height, (double)-c->lbearing, (double)(c->descent - 1),
	          (double)advance, 0.0, bits, (long)(width + 7) / 8 * height);
	fake_call(CMD_glEndList, "");
}

/*
 * How far the list of a character without pixels moves the raster position. Mesa's own glXUseXFont fails to store
 * bitmaps of no pixels, and its lists then do not move it. Calling such a list draws nothing.
 */
static float ask_advance(unsigned list, float otherwise)
{
	float position[4];

	if (!context_has(HAS_WINDOW_POS) || context_get(GL_RENDER_MODE) != GL_RENDER ||
	    context_get(GL_ATTRIB_STACK_DEPTH) >= context_get(GL_MAX_ATTRIB_STACK_DEPTH))
		return otherwise;
	real_glPushAttrib(GL_CURRENT_BIT);
	real_glWindowPos2i(0, 0);
	real_glCallList(list);
	real_glGetFloatv(GL_CURRENT_RASTER_POSITION, position);
	real_glPopAttrib();
	return position[0];
}

static void record_character(Display *display, const XFontStruct *font, unsigned code, unsigned list)
{
	static const uint8_t empty[1] = { 0 };
	const XCharStruct *found = find_character(font, code), *c = found ? found : &font->max_bounds;
	int width = c->rbearing - c->lbearing, height = c->ascent + c->descent;
	size_t bytes = (size_t)(width + 7) / 8 * (size_t)height;
	uint8_t *bits = NULL;

	if (!found || width <= 0 || height <= 0) { /* one pixel, not set: no driver refuses that */
		record_list(list, c, 1, 1, ask_advance(list, c->width), empty);
		return;
	}
	if (width <= MAX_SIDE && height <= MAX_SIDE)
		bits = pages_map(bytes);
	if (!bits) {
		record_list(list, c, 1, 1, c->width, empty);
		return;
	}
	writer_nest();
	draw_character(display, font, code, c, bits);
	writer_unnest();
	record_list(list, c, width, height, c->width, bits);
	munmap(bits, bytes);
}

static void record_lists(unsigned long name, int first, int count, int list)
{
	XFontStruct *font;
	Display *display;

	/* GLX makes no lists while the program makes one, or without a context. */
	if (count <= 0 || count > MAX_CHARACTERS || first < 0 || !context_has(HAS_FIXED_FUNCTION) ||
	    context_get(GL_LIST_INDEX))
		return;
	pthread_once(&x_once, find_xlib);
	writer_nest(); /* the program does not ask this */
	display = real_glXGetCurrentDisplay();
	font = display && x_found ? x.XQueryFont(display, name) : NULL;
	writer_unnest();
	if (!font)
		return;
	font->fid = name; /* a graphics context gets the font by this */
	restore_make_neutral(0);
	for (int i = 0; i < count; i++)
		record_character(display, font, (unsigned)(first + i), (unsigned)(list + i));
	restore_make_neutral(1);
	x.XFreeFontInfo(NULL, font, 1);
}

void font_used(unsigned long name, int first, int count, int list)
{
	int saved = errno;
	uint8_t *p;

	if (!writer_active())
		return;
	record_lists(name, first, count, list);
	if ((p = writer_enter(CMD_glXUseXFont))) {
		p = put_uint(put_argument(p, 0), name);
		p = put_sint(put_argument(p, 1), first);
		p = put_sint(put_argument(p, 2), count);
		p = put_sint(put_argument(p, 3), list);
		writer_call_end(p);
	}
	errno = saved;
}
