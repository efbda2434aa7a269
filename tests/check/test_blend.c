/*
 * Blending against Mesa's llvmpipe, bit for bit: every source and alpha over every destination (alphas in steps), for
 * the pairs of factors that programs use.
 */
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <stdlib.h>

#include "kernels/gl/blend.h"
#include "scene/scene.h"
#include "tests/case.h"

#define SIDE 256

/* OpenGL's own headers define the same tokens as gl_tokens.h, spelled differently. */
extern void glReadPixels(int x, int y, int width, int height, unsigned format, unsigned type, void *pixels);
extern void glBegin(unsigned mode), glEnd(void), glEnable(unsigned what), glDisable(unsigned what);
extern void glColor4ub(unsigned char r, unsigned char g, unsigned char b, unsigned char a), glVertex2i(int x, int y);
extern void glOrtho(double l, double r, double b, double t, double n, double f), glBlendFunc(unsigned s, unsigned d);

static const struct {
	uint32_t source, destination;
} factors[] = {
	{ GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA }, { GL_SRC_ALPHA, GL_ONE },           { GL_ONE, GL_ONE_MINUS_SRC_ALPHA },
	{ GL_DST_COLOR, GL_ZERO },                { GL_DST_COLOR, GL_SRC_COLOR },     { GL_ONE, GL_ONE_MINUS_SRC_COLOR },
	{ GL_ONE_MINUS_DST_COLOR, GL_ONE },       { GL_ONE_MINUS_SRC_ALPHA, GL_SRC_ALPHA },
};

/* Make a context without a window current, with a picture of SIDE x SIDE pixels and four channels of 8 bits. */
static EGLDisplay open_picture(void)
{
	const EGLint wanted[] = { EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_RED_SIZE, 8,
		                  EGL_GREEN_SIZE, 8, EGL_BLUE_SIZE, 8, EGL_ALPHA_SIZE, 8, EGL_NONE };
	const EGLint size[] = { EGL_WIDTH, SIDE, EGL_HEIGHT, SIDE, EGL_NONE };
	const EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
	EGLSurface surface;
	EGLContext context;
	EGLConfig config;
	EGLint n = 0;

	ck_assert(eglInitialize(display, NULL, NULL) && eglBindAPI(EGL_OPENGL_API));
	ck_assert(eglChooseConfig(display, wanted, &config, 1, &n) && n == 1);
	surface = eglCreatePbufferSurface(display, config, size);
	context = eglCreateContext(display, config, EGL_NO_CONTEXT, NULL);
	ck_assert(eglMakeCurrent(display, surface, surface, context));
	return display;
}

START_TEST(every_color)
{
	const uint32_t sf = factors[_i].source, df = factors[_i].destination;
	struct scene_material m = { .blend_equation_rgb = GL_FUNC_ADD, .blend_equation_alpha = GL_FUNC_ADD };
	unsigned char *picture = malloc(4 * SIDE * SIDE);
	const EGLDisplay display = open_picture();
	unsigned wrong = 0;

	m.blend_src_rgb = m.blend_src_alpha = sf;
	m.blend_dst_rgb = m.blend_dst_alpha = df;
	glDisable(GL_DITHER);
	glOrtho(0, SIDE, 0, SIDE, -1, 1);
	glBlendFunc(sf, df);
	for (int alpha = 0; alpha < SIDE; alpha += 15) {
		glDisable(GL_BLEND);
		glBegin(GL_QUADS);
		for (int d = 0; d < SIDE; d++) {
			glColor4ub(d, d, d, 255);
			glVertex2i(d, 0), glVertex2i(d + 1, 0), glVertex2i(d + 1, SIDE), glVertex2i(d, SIDE);
		}
		glEnd();
		glEnable(GL_BLEND);
		glBegin(GL_QUADS);
		for (int s = 0; s < SIDE; s++) {
			glColor4ub(s, s, s, alpha);
			glVertex2i(0, s), glVertex2i(SIDE, s), glVertex2i(SIDE, s + 1), glVertex2i(0, s + 1);
		}
		glEnd();
		glReadPixels(0, 0, SIDE, SIDE, GL_RGBA, GL_UNSIGNED_BYTE, picture);
		for (int s = 0; s < SIDE; s++)
			for (int d = 0; d < SIDE; d++) {
				float source = (float)s / 255.0f, destination = (float)d / 255.0f;
				struct vec4 ours = blend_colors(&m, v4(source, source, source, (float)alpha / 255.0f),
				                                v4(destination, destination, destination, 1.0f));

				wrong += picture[4 * (s * SIDE + d)] != blend_round(ours.x);
			}
	}
	ck_assert_msg(!wrong, "%u of %u colours differ", wrong, 18u * SIDE * SIDE);
	eglTerminate(display);
	free(picture);
}
END_TEST

/* Kernel only: storing and reading back changes nothing. */
START_TEST(factors_one_and_zero)
{
	for (uint32_t a = 0; a < 256; a++) {
		ck_assert_uint_eq(blend_multiply(a, 255), a);
		ck_assert_uint_eq(blend_multiply(a, 0), 0);
	}
}
END_TEST

int main(void)
{
	TCase *c = tcase_create("llvmpipe");

	setenv("GALLIUM_DRIVER", "llvmpipe", 1);
	tcase_set_timeout(c, 60);
	tcase_add_test(c, factors_one_and_zero);
	tcase_add_loop_test(c, every_color, 0, sizeof(factors) / sizeof(factors[0]));
	return run_case(c, "blend");
}
