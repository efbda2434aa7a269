#include "tests/generated/generated.h"

/* Through the matrices, or directly in the window. */
static void set_raster_position(struct chance *chance, struct program *program)
{
	if (chance_of(chance, 2))
		glWindowPos2i((int)chance_below(chance, (unsigned)program->target_width),
		              (int)chance_below(chance, (unsigned)program->target_height));
	else
		glRasterPos3f(chance_between(chance, -0.8f, 0.8f), chance_between(chance, -0.7f, 0.7f),
		              chance_between(chance, -7, -4));
}

static void set_zoom(struct chance *chance)
{
	static const GLfloat zooms[] = { 1, 1, 2, 3, 0.5f, -1, -2 };

	glPixelZoom(zooms[chance_below(chance, 7)], zooms[chance_below(chance, 7)]);
}

/*
 * Draw pixels without textures: otherwise Mesa's pixels use coordinates of the previous draw, or of none, in whatever
 * form its vertices passed them. The caller pops.
 */
static void push_without_textures(void)
{
	glPushAttrib(GL_ENABLE_BIT);
	disable_textures();
}

/* Scale and bias. With maps, blue and alpha are undefined in Mesa. */
static void set_transfer(struct chance *chance)
{
	glPixelTransferf(GL_RED_SCALE, chance_between(chance, 0, 2));
	glPixelTransferf(GL_GREEN_BIAS, chance_between(chance, -0.5f, 0.5f));
}

static void reset_transfer(void)
{
	glPixelTransferf(GL_RED_SCALE, 1);
	glPixelTransferf(GL_GREEN_BIAS, 0);
	glPixelZoom(1, 1);
}

void step_draw_pixels(struct chance *chance, struct program *program)
{
	GLubyte pixels[32 * 32 * 4];
	int width = (int)(1 + chance_below(chance, 24)), height = (int)(1 + chance_below(chance, 24));
	GLenum type = ONE_OF(chance, GL_UNSIGNED_BYTE, GL_UNSIGNED_BYTE, GL_UNSIGNED_SHORT_5_6_5,
	                     GL_UNSIGNED_INT_8_8_8_8);
	GLenum format = ONE_OF(chance, GL_RGBA, GL_RGB, GL_BGRA, GL_LUMINANCE, GL_LUMINANCE_ALPHA, GL_RED);

	if (type == GL_UNSIGNED_SHORT_5_6_5)
		format = GL_RGB;
	if (type == GL_UNSIGNED_INT_8_8_8_8)
		format = GL_RGBA;
	for (unsigned i = 0; i < sizeof(pixels); i++)
		pixels[i] = (GLubyte)chance_below(chance, 256);
	set_raster_position(chance, program);
	set_zoom(chance);
	if (chance_of(chance, 3))
		set_transfer(chance);
	if (chance_of(chance, 3)) {
		glPixelStorei(GL_UNPACK_ROW_LENGTH, 32);
		glPixelStorei(GL_UNPACK_SKIP_PIXELS, 3);
		glPixelStorei(GL_UNPACK_SKIP_ROWS, 2);
	}
	push_without_textures();
	glDrawPixels(width, height, format, type, pixels);
	glPopAttrib();
	glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
	glPixelStorei(GL_UNPACK_SKIP_PIXELS, 0);
	glPixelStorei(GL_UNPACK_SKIP_ROWS, 0);
	reset_transfer();
}

void step_bitmap(struct chance *chance, struct program *program)
{
	GLubyte bits[4 * 32];
	GLfloat color[4];

	for (unsigned i = 0; i < sizeof(bits); i++)
		bits[i] = (GLubyte)chance_below(chance, 256);
	chance_color(chance, color);
	glColor4fv(color);
	set_raster_position(chance, program);
	push_without_textures();
	for (unsigned i = 1 + chance_below(chance, 3); i; i--)
		glBitmap((int)(1 + chance_below(chance, 32)), (int)(1 + chance_below(chance, 32)),
		         chance_between(chance, -2, 2), 0, chance_between(chance, 0, 20), chance_between(chance, -3, 3),
		         bits);
	glPopAttrib();
}

/* Without pixel maps, because with them Mesa 22.3 crashes some programs (a stack overrun). */
void step_copy_pixels(struct chance *chance, struct program *program)
{
	int width = (int)(4 + chance_below(chance, 30)), height = (int)(4 + chance_below(chance, 30));

	set_raster_position(chance, program);
	set_zoom(chance);
	if (chance_of(chance, 4))
		glPixelTransferf(GL_RED_SCALE, chance_between(chance, 0, 2));
	push_without_textures();
	glCopyPixels((int)chance_below(chance, 20), (int)chance_below(chance, 20), width, height, GL_COLOR);
	glPopAttrib();
	reset_transfer();
}

/* The accumulation buffer, which only windows have. */
void step_accumulate(struct chance *chance, struct program *program)
{
	if (program->target_width != program->width || program->target_height != program->height)
		return;
	glFlush(); /* Mesa keeps bitmaps until the next draw, where Accum does not see them */
	glAccum(GL_LOAD, chance_between(chance, 0.3f, 1));
	step_draw(chance, program);
	glAccum(GL_ACCUM, chance_between(chance, 0.1f, 0.7f));
	glAccum(GL_RETURN, chance_between(chance, 0.5f, 1.2f));
}
