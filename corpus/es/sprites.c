/*
 * cc sprites.c -lEGL -lGLESv1_CM -lX11 -lm
 *
 * Extensions of OpenGL ES 1's age: draw texture with crop rectangles, paletted textures, point sprites with an array of
 * sizes, a framebuffer object, separate blending, a cube map by reflection.
 *
 * The current colour is set once: Mesa (22.3.6) draws textures with the colour that was current when arrays were last
 * drawn.
 */
#include <math.h>

#include "window.h"

enum { TILE = 16, TILES = 4, SHEET = TILE * TILES, N_SPARKS = 24, TARGET = 64 };

static GLuint sheet, spark, target, cube, framebuffer;
static PFNGLDRAWTEXIOESPROC draw_tex_i;
static PFNGLDRAWTEXFOESPROC draw_tex_f;
static PFNGLBLENDFUNCSEPARATEOESPROC blend_func_separate;
static PFNGLTEXGENIOESPROC tex_gen_i;
static PFNGLGENFRAMEBUFFERSOESPROC gen_framebuffers;
static PFNGLBINDFRAMEBUFFEROESPROC bind_framebuffer;
static PFNGLFRAMEBUFFERTEXTURE2DOESPROC framebuffer_texture;
static PFNGLCHECKFRAMEBUFFERSTATUSOESPROC check_framebuffer;

static void *find(const char *name)
{
	void *found = (void *)eglGetProcAddress(name);

	if (!found)
		fail(name);
	return found;
}

/* Sixteen colours of 24 bits, two texels a byte, the left texel in the high half. */
static void make_sheet(void)
{
	static GLubyte image[16 * 3 + SHEET * SHEET / 2];

	for (int i = 0; i < 16; i++) {
		image[3 * i] = (GLubyte)(17 * i);
		image[3 * i + 1] = (GLubyte)(255 - 13 * i);
		image[3 * i + 2] = (GLubyte)(i * i);
	}
	for (int i = 0; i < SHEET * SHEET; i++) {
		const int x = i % SHEET, y = i / SHEET, dx = x % TILE - 7, dy = y % TILE - 7,
			  color = dx * dx + dy * dy < 40 ? x / TILE + 4 * (y / TILE) : (x + y) & 3;

		image[48 + i / 2] |= (GLubyte)(i % 2 ? color : color << 4);
	}
	glGenTextures(1, &sheet);
	glBindTexture(GL_TEXTURE_2D, sheet);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	glCompressedTexImage2D(GL_TEXTURE_2D, 0, GL_PALETTE4_RGB8_OES, SHEET, SHEET, 0, sizeof(image), image);
}

static void make_spark(void)
{
	static GLubyte texels[TILE][TILE][2];

	for (int y = 0; y < TILE; y++)
		for (int x = 0; x < TILE; x++) {
			const int dx = 2 * x - TILE + 1, dy = 2 * y - TILE + 1, d = dx * dx + dy * dy;

			texels[y][x][0] = (GLubyte)(255 - 8 * y);
			texels[y][x][1] = (GLubyte)(d < 225 ? 255 - d : 0);
		}
	glGenTextures(1, &spark);
	glBindTexture(GL_TEXTURE_2D, spark);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_LUMINANCE_ALPHA, TILE, TILE, 0, GL_LUMINANCE_ALPHA, GL_UNSIGNED_BYTE, texels);
}

static void make_target(void)
{
	glGenTextures(1, &target);
	glBindTexture(GL_TEXTURE_2D, target);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, TARGET, TARGET, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
	gen_framebuffers(1, &framebuffer);
	bind_framebuffer(GL_FRAMEBUFFER_OES, framebuffer);
	framebuffer_texture(GL_FRAMEBUFFER_OES, GL_COLOR_ATTACHMENT0_OES, GL_TEXTURE_2D, target, 0);
	if (check_framebuffer(GL_FRAMEBUFFER_OES) != GL_FRAMEBUFFER_COMPLETE_OES)
		fail("framebuffer object");
	bind_framebuffer(GL_FRAMEBUFFER_OES, 0);
}

static void make_cube(void)
{
	static GLubyte texels[TILE][TILE][3];

	glGenTextures(1, &cube);
	glBindTexture(GL_TEXTURE_CUBE_MAP_OES, cube);
	glTexParameteri(GL_TEXTURE_CUBE_MAP_OES, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	for (int face = 0; face < 6; face++) {
		for (int i = 0; i < TILE * TILE; i++) {
			texels[i / TILE][i % TILE][0] = (GLubyte)(face * 40 + 3 * (i % TILE));
			texels[i / TILE][i % TILE][1] = (GLubyte)(250 - face * 30);
			texels[i / TILE][i % TILE][2] = (GLubyte)(12 * (i / TILE));
		}
		glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X_OES + (GLenum)face, 0, GL_RGB, TILE, TILE, 0, GL_RGB,
		             GL_UNSIGNED_BYTE, texels);
	}
	tex_gen_i(GL_TEXTURE_GEN_STR_OES, GL_TEXTURE_GEN_MODE_OES, GL_REFLECTION_MAP_OES);
}

static void set_up(void)
{
	draw_tex_i = (PFNGLDRAWTEXIOESPROC)find("glDrawTexiOES");
	draw_tex_f = (PFNGLDRAWTEXFOESPROC)find("glDrawTexfOES");
	blend_func_separate = (PFNGLBLENDFUNCSEPARATEOESPROC)find("glBlendFuncSeparateOES");
	tex_gen_i = (PFNGLTEXGENIOESPROC)find("glTexGeniOES");
	gen_framebuffers = (PFNGLGENFRAMEBUFFERSOESPROC)find("glGenFramebuffersOES");
	bind_framebuffer = (PFNGLBINDFRAMEBUFFEROESPROC)find("glBindFramebufferOES");
	framebuffer_texture = (PFNGLFRAMEBUFFERTEXTURE2DOESPROC)find("glFramebufferTexture2DOES");
	check_framebuffer = (PFNGLCHECKFRAMEBUFFERSTATUSOESPROC)find("glCheckFramebufferStatusOES");
	glColor4f(1, 0.9f, 0.8f, 1);
	glTexEnvi(GL_POINT_SPRITE_OES, GL_COORD_REPLACE_OES, GL_TRUE);
	make_sheet();
	make_spark();
	make_target();
	make_cube();
}

static void crop(GLint x, GLint y, GLint width, GLint height)
{
	const GLint rect[4] = { x, y, width, height };

	glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_CROP_RECT_OES, rect);
}

static void draw_tiles(int frame)
{
	glBindTexture(GL_TEXTURE_2D, sheet);
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE);
	for (int i = 0; i < 6; i++) {
		crop(TILE * ((i + frame) % TILES), TILE * (i % TILES), TILE, i % 2 ? TILE : -TILE);
		draw_tex_i(10 + 64 * i, 8, 0, 48, 48);
	}
	crop(0, 0, SHEET, SHEET);
	draw_tex_f(280.25f, 190.25f, 0.5f, 96, 96);
}

static void draw_sparks(int frame)
{
	GLfloat at[N_SPARKS][2], sizes[N_SPARKS];
	GLubyte colors[N_SPARKS][4];

	for (int i = 0; i < N_SPARKS; i++) {
		const float angle = 0.7f * (float)i + 0.1f * (float)frame, reach = 0.03f * (float)i;

		at[i][0] = reach * cosf(angle);
		at[i][1] = reach * sinf(angle) + 0.1f;
		sizes[i] = 4 + 1.5f * (float)(i % 12);
		colors[i][0] = (GLubyte)(255 - 8 * i);
		colors[i][1] = (GLubyte)(100 + 6 * i);
		colors[i][2] = 80;
		colors[i][3] = (GLubyte)(255 - 4 * i);
	}
	glBindTexture(GL_TEXTURE_2D, spark);
	glEnable(GL_POINT_SPRITE_OES);
	glEnable(GL_BLEND);
	blend_func_separate(GL_SRC_ALPHA, GL_ONE, GL_ONE, GL_ONE);
	glEnableClientState(GL_VERTEX_ARRAY);
	glEnableClientState(GL_COLOR_ARRAY);
	glEnableClientState(GL_POINT_SIZE_ARRAY_OES);
	glVertexPointer(2, GL_FLOAT, 0, at);
	glColorPointer(4, GL_UNSIGNED_BYTE, 0, colors);
	glPointSizePointerOES(GL_FLOAT, 0, sizes);
	glDrawArrays(GL_POINTS, 0, N_SPARKS);
	glDisableClientState(GL_POINT_SIZE_ARRAY_OES);
	glDisableClientState(GL_COLOR_ARRAY);
	glDisable(GL_BLEND);
	glDisable(GL_POINT_SPRITE_OES);
}

static void draw_target(int frame)
{
	static const GLfloat triangle[3][2] = { { -0.9f, -0.8f }, { 0.9f, -0.5f }, { 0, 0.9f } };
	static const GLubyte colors[3][4] = { { 255, 0, 0, 255 }, { 0, 255, 0, 255 }, { 0, 0, 255, 255 } };

	bind_framebuffer(GL_FRAMEBUFFER_OES, framebuffer);
	glViewport(0, 0, TARGET, TARGET);
	glClearColor(0.9f, 0.8f, 0.05f * (float)frame, 1);
	glClear(GL_COLOR_BUFFER_BIT);
	glDisable(GL_TEXTURE_2D);
	glEnableClientState(GL_VERTEX_ARRAY);
	glEnableClientState(GL_COLOR_ARRAY);
	glVertexPointer(2, GL_FLOAT, 0, triangle);
	glColorPointer(4, GL_UNSIGNED_BYTE, 0, colors);
	glDrawArrays(GL_TRIANGLES, 0, 3);
	glDisableClientState(GL_COLOR_ARRAY);
	bind_framebuffer(GL_FRAMEBUFFER_OES, 0);
	glViewport(0, 0, WIDTH, HEIGHT);
	glEnable(GL_TEXTURE_2D);
	glBindTexture(GL_TEXTURE_2D, target);
	crop(8, 8, 48, 40);
	draw_tex_i(20, 180, 1, 96, 80);
}

static void draw_mirror(int frame)
{
	static const GLfloat corners[4][3] = { { -0.2f, 0.4f, 0 }, { 0.2f, 0.4f, 0 }, { -0.2f, 0.8f, 0 }, { 0.2f, 0.8f, 0 } };
	const GLfloat lean = 0.1f * (float)frame;
	const GLfloat normals[4][3] = {
		{ -0.5f, -0.5f, 1 }, { 0.5f + lean, -0.5f, 1 }, { -0.5f, 0.5f, 1 }, { 0.5f + lean, 0.5f, 1 }
	};

	glDisable(GL_TEXTURE_2D);
	glEnable(GL_TEXTURE_CUBE_MAP_OES);
	glEnable(GL_TEXTURE_GEN_STR_OES);
	glEnable(GL_NORMALIZE);
	glBindTexture(GL_TEXTURE_CUBE_MAP_OES, cube);
	glEnableClientState(GL_NORMAL_ARRAY);
	glVertexPointer(3, GL_FLOAT, 0, corners);
	glNormalPointer(GL_FLOAT, 0, normals);
	glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
	glDisableClientState(GL_NORMAL_ARRAY);
	glDisable(GL_TEXTURE_GEN_STR_OES);
	glDisable(GL_TEXTURE_CUBE_MAP_OES);
	glDisableClientState(GL_VERTEX_ARRAY);
}

static void draw_frame(int frame)
{
	glClearColor(0.1f, 0.15f, 0.2f, 1);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	draw_target(frame);
	glClearColor(0.1f, 0.15f, 0.2f, 1);
	draw_tiles(frame);
	draw_sparks(frame);
	draw_mirror(frame);
}
