/*
 * Textures after piglit's tests, one aspect per frame: internal formats, compressed blocks, swizzles, wraps outside the
 * image; depth and stencil values as pixels; levels, points and sprites; frames that are not cleared. Recorded by
 * test_textures.py.
 */
#include "tests/trace/window.h"

static void reset(int clear)
{
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glOrtho(0, 64, 0, 48, -10, 10);
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	glClearColor(0.2f, 0.4f, 0.6f, 0.4f);
	if (clear)
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
	glColor4f(1, 1, 1, 1);
	glEnable(GL_TEXTURE_2D);
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
}

/* Create and bind a texture with nearest filtering. Pixel centres avoid the edges of texels, where rounding decides. */
static void texture(void)
{
	unsigned name;

	glGenTextures(1, &name);
	glBindTexture(GL_TEXTURE_2D, name);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

static void panel(int x, int y, int size, float from, float to)
{
	glBegin(GL_QUADS);
	glTexCoord2f(from, from);
	glVertex2i(x, y);
	glTexCoord2f(to, from);
	glVertex2i(x + size, y);
	glTexCoord2f(to, to);
	glVertex2i(x + size, y + size);
	glTexCoord2f(from, to);
	glVertex2i(x, y + size);
	glEnd();
}

static unsigned char colors[4][4][4];

static void formats(void)
{
	static const int internal[] = { GL_RGBA8,  GL_RGB5_A1,      GL_RGBA4,       GL_R3_G3_B2,          GL_RED,
		                        GL_RG8,    GL_SRGB8_ALPHA8, GL_SLUMINANCE8, GL_LUMINANCE6_ALPHA2, GL_INTENSITY4,
		                        GL_RGB565, GL_RGBA16F };

	for (int i = 0; i < 12; i++) {
		texture();
		glTexImage2D(GL_TEXTURE_2D, 0, internal[i], 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, colors);
		panel(i % 4 * 16, i / 4 * 16, 15, 0.01f, 0.98f);
	}
}

/* Texels outside [0,1]: multiplied and filtered values are not clamped. */
static void numbers(void)
{
	static const int internal[] = {
		GL_RGBA32F, GL_RGBA16F, GL_RGB16F, GL_LUMINANCE32F_ARB, GL_INTENSITY16F_ARB, GL_RG32F,
		GL_LUMINANCE_ALPHA16F_ARB, GL_R11F_G11F_B10F, GL_RGB9_E5, GL_RGBA8_SNORM, GL_RGB16_SNORM, GL_ALPHA32F_ARB
	};
	float texels[8][8][4];

	for (int i = 0; i < 256; i++)
		texels[i / 32][i / 4 % 8][i % 4] = (float)(i * 37 % 101) / 30 - 0.4f;
	glColor4f(0.4f, 0.3f, 0.2f, 0.6f);
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE);
	for (int i = 0; i < 12; i++) {
		texture();
		glTexImage2D(GL_TEXTURE_2D, 0, internal[i], 8, 8, 0, GL_RGBA, GL_FLOAT, texels);
		panel(i % 4 * 16, i / 4 * 16, 15, 0.01f, 0.98f);
	}
	glDisable(GL_BLEND);
}

/* The same filtered, with a border and generated levels; an addition that is clamped, and an interpolation that is
 * not. */
static void filtered_numbers(void)
{
	static const int internal[] = { GL_RGBA32F, GL_RGB16F, GL_LUMINANCE32F_ARB, GL_RGBA16_SNORM };
	const float border[4] = { 2, -1, 3, 1 }, constant[4] = { 0.9f, 0.5f, 0.1f, 0.3f };
	float texels[8][8][4];

	for (int i = 0; i < 256; i++)
		texels[i / 32][i / 4 % 8][i % 4] = (float)(i * 29 % 97) / 40 - 0.3f;
	glColor4f(0.4f, 0.3f, 0.2f, 1);
	for (int i = 0; i < 12; i++) {
		texture();
		glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
		glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, border);
		glTexImage2D(GL_TEXTURE_2D, 0, internal[i % 4], 8, 8, 0, GL_RGBA, GL_FLOAT, texels);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, i / 4 == 2 ? 1 : 0);
		glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, i / 4 == 1 ? GL_ADD : GL_MODULATE);
		if (i / 4 == 2) {
			glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_COMBINE);
			glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB, GL_INTERPOLATE);
			glTexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, constant);
		}
		panel(i % 4 * 16, i / 4 * 16, 15, -0.3f, 1.28f);
	}
}

static void blocks(void)
{
	static const unsigned formats[] = { GL_COMPRESSED_RGB_S3TC_DXT1_EXT, GL_COMPRESSED_RGBA_S3TC_DXT1_EXT,
		                            GL_COMPRESSED_RGBA_S3TC_DXT3_EXT, GL_COMPRESSED_RGBA_S3TC_DXT5_EXT,
		                            GL_COMPRESSED_RGB_FXT1_3DFX, GL_COMPRESSED_RGBA_FXT1_3DFX };
	unsigned char bytes[64];

	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	for (unsigned i = 0; i < 12; i++) {
		unsigned format = formats[i % 6], side = i % 6 < 4 ? 8 : 16, size = i % 6 < 2 ? 32 : 64;

		for (unsigned k = 0; k < size; k++) /* any bits are valid blocks */
			bytes[k] = (unsigned char)((k * 2654435761u + i * 40503u) >> 11);
		texture();
		glCompressedTexImage2D(GL_TEXTURE_2D, 0, format, (int)side, 8, 0, (int)size, bytes);
		panel((int)i % 4 * 16, (int)i / 4 * 16, 16, 0, 1);
	}
	glDisable(GL_BLEND);
}

/* Blocks of one or two channels; the last of each kind filtered, with a part replaced. */
static void channels(void)
{
	static const unsigned formats[9] = {
		GL_COMPRESSED_RED_RGTC1, GL_COMPRESSED_SIGNED_RED_RGTC1, GL_COMPRESSED_LUMINANCE_LATC1_EXT,
		GL_COMPRESSED_SIGNED_LUMINANCE_LATC1_EXT, GL_COMPRESSED_RG_RGTC2, GL_COMPRESSED_SIGNED_RG_RGTC2,
		GL_COMPRESSED_LUMINANCE_ALPHA_LATC2_EXT, GL_COMPRESSED_SIGNED_LUMINANCE_ALPHA_LATC2_EXT,
		0x8837 /* COMPRESSED_LUMINANCE_ALPHA_3DC_ATI, which glext.h lacks */
	};
	unsigned char bytes[64];

	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	for (unsigned i = 0; i < 12; i++) {
		unsigned format = i < 9 ? formats[i] : formats[(i - 9) * 3 + 1], block = i < 9 ? i < 4 ? 8 : 16 : i < 10 ? 8 : 16;

		for (unsigned k = 0; k < 4 * block; k++) /* any bits are valid blocks */
			bytes[k] = (unsigned char)((k * 2654435761u + i * 40503u) >> 11);
		texture();
		glCompressedTexImage2D(GL_TEXTURE_2D, 0, format, 8, 8, 0, (int)(4 * block), bytes);
		if (i >= 9) {
			glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
			glCompressedTexSubImage2D(GL_TEXTURE_2D, 0, 4, 0, 4, 8, format, (int)(2 * block), bytes + 5);
		}
		panel((int)i % 4 * 16, (int)i / 4 * 16, 16, 0, 1);
	}
	glDisable(GL_BLEND);
}

static void swizzles(void)
{
	static const int swizzle[4][4] = { { GL_BLUE, GL_RED, GL_GREEN, GL_ONE }, { GL_ALPHA, GL_ZERO, GL_ONE, GL_RED },
		                           { GL_RED, GL_RED, GL_RED, GL_RED }, { GL_ONE, GL_GREEN, GL_ZERO, GL_ALPHA } };
	const float border[4] = { 0.8f, 0.2f, 0.6f, 0.4f };
	static const int internal[3] = { GL_RGBA, GL_LUMINANCE, GL_ALPHA };

	for (int i = 0; i < 12; i++) {
		texture();
		glTexImage2D(GL_TEXTURE_2D, 0, internal[i / 4], 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, colors);
		glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_RGBA, swizzle[i % 4]);
		glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, border);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
		panel(i % 4 * 16, i / 4 * 16, 15, -0.47f, 1.51f);
	}
}

static void wraps(void)
{
	static const int wrap[6] = { GL_REPEAT, GL_CLAMP, GL_CLAMP_TO_BORDER, GL_MIRRORED_REPEAT, GL_MIRROR_CLAMP_EXT,
		                     GL_MIRROR_CLAMP_TO_EDGE_EXT };
	const float border[4] = { 1, 0.2f, 0, 1 };

	for (int i = 0; i < 12; i++) {
		texture();
		glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, colors);
		glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, border);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap[i / 2]);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap[i / 2]);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, i % 2 ? GL_LINEAR : GL_NEAREST);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, i % 2 ? GL_LINEAR : GL_NEAREST);
		panel(i % 4 * 16, i / 4 * 16, 15, -1.27f, 2.31f);
	}
}

/* Depth and stencil values, drawn and copied as pixels, and the drawing that they let pass. */
static void depth_and_stencil(void)
{
	unsigned values[16][16];

	for (unsigned i = 0; i < 256; i++)
		values[i / 16][i % 16] = (i % 16 * 16 << 24) | (i / 16 < 8 ? 7 : 9);
	glDisable(GL_TEXTURE_2D);
	glRasterPos2i(2, 2);
	glDrawPixels(16, 16, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8, values);
	glRasterPos2i(24, 10);
	glPixelZoom(2, 2);
	glCopyPixels(2, 2, 16, 16, GL_DEPTH_STENCIL);
	glPixelZoom(1, 1);
	glEnable(GL_STENCIL_TEST);
	glStencilFunc(GL_EQUAL, 9, 255);
	glStencilOp(GL_KEEP, GL_KEEP, GL_INCR);
	glEnable(GL_DEPTH_TEST);
	glColor3f(1, 0.8f, 0);
	glRecti(0, 0, 64, 48);
	glStencilFunc(GL_EQUAL, 7, 255);
	glColor3f(0, 0.8f, 1);
	glRecti(0, 0, 64, 48);
	glDisable(GL_DEPTH_TEST);
	glDisable(GL_STENCIL_TEST);
}

/* Levels generated by the driver, for sizes that are not powers of two, each drawn at its own size. */
static void generated_levels(void)
{
	static const int internal[4] = { GL_RGBA8, GL_SRGB8_ALPHA8, GL_LUMINANCE, GL_RG8 };
	unsigned char texels[13 * 21 * 4];

	for (int i = 0; i < 13 * 21 * 4; i++)
		texels[i] = (unsigned char)(i * 2654435761u >> 9);
	for (int i = 0; i < 4; i++) {
		texture();
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
		glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE);
		glTexImage2D(GL_TEXTURE_2D, 0, internal[i], 13, 21, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
		for (int level = 0; level < 4; level++) {
			glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, level);
			panel(level * 16, i * 12, 12, 0.01f, 0.98f);
		}
	}
}

/* The same for formats that Mesa may be unable to draw to; odd sizes show which texels count. */
static void averaged_levels(void)
{
	static const int internal[12] = {
		GL_SLUMINANCE8, GL_SLUMINANCE8_ALPHA8, GL_RGB9_E5, GL_R3_G3_B2, GL_RGBA4,          GL_LUMINANCE4_ALPHA4,
		GL_RGBA8_SNORM, GL_LUMINANCE8_SNORM,   GL_RGB5_A1, GL_RGBA2,    GL_R11F_G11F_B10F, GL_RGB16F
	};
	unsigned char texels[13 * 21 * 4];

	for (int i = 0; i < 13 * 21 * 4; i++)
		texels[i] = (unsigned char)(i * 2654435761u >> 9);
	for (int i = 0; i < 12; i++) {
		texture();
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
		glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE);
		glTexImage2D(GL_TEXTURE_2D, 0, internal[i], 13, 21, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
		for (int level = 1; level < 3; level++) {
			glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, level);
			panel(i % 4 * 16 + level * 8 - 8, i / 4 * 16, 7, 0.01f, 0.98f);
		}
	}
}

/* A cube's levels, faces seen straight on and at an angle. */
static void cube_levels(void)
{
	static const float corners[6][3][3] = {
		/* a corner of a face and the vectors along its edges */
		{ { 1, 1, 1 }, { 0, -2, 0 }, { 0, 0, -2 } }, { { -1, 1, -1 }, { 0, -2, 0 }, { 0, 0, 2 } },
		{ { -1, 1, -1 }, { 2, 0, 0 }, { 0, 0, 2 } }, { { -1, -1, 1 }, { 2, 0, 0 }, { 0, 0, -2 } },
		{ { -1, 1, 1 }, { 2, 0, 0 }, { 0, -2, 0 } }, { { 1, 1, -1 }, { -2, 0, 0 }, { 0, -2, 0 } }
	};
	unsigned name;

	glDisable(GL_TEXTURE_2D);
	glEnable(GL_TEXTURE_CUBE_MAP);
	glGenTextures(1, &name);
	glBindTexture(GL_TEXTURE_CUBE_MAP, name);
	glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
	glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	for (unsigned face = 0; face < 6; face++)
		for (int level = 0; level < 6; level++) { /* one colour per level and face */
			unsigned char texels[32 * 32][3];

			for (int i = 0; i < 32 * 32; i++) {
				texels[i][0] = (unsigned char)(level * 50);
				texels[i][1] = (unsigned char)(face * 50);
				texels[i][2] = 128;
			}
			glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, level, GL_RGB, 32 >> level, 32 >> level, 0,
			             GL_RGB, GL_UNSIGNED_BYTE, texels);
		}
	for (int i = 0; i < 12; i++) {
		const float (*c)[3] = corners[i % 6];
		float x = (float)(i % 6 * 10) + 2, y = (float)(i / 6 * 20) + 3, width = i < 6 ? 9 : 5, height = i < 6 ? 15 : 7;

		glBegin(GL_QUADS);
		for (int k = 0; k < 4; k++) {
			float u = k == 1 || k == 2 ? 0.95f : 0.05f, v = k >= 2 ? 0.95f : 0.05f;

			glTexCoord3f(c[0][0] + u * c[1][0] + v * c[2][0], c[0][1] + u * c[1][1] + v * c[2][1],
			             c[0][2] + u * c[1][2] + v * c[2][2]);
			glVertex2f(x + u * width, y + v * height);
		}
		glEnd();
	}
	glDisable(GL_TEXTURE_CUBE_MAP);
}

/* Points at the corners of pixels, with odd and even sizes; sprites with both origins. */
static void points(void)
{
	glDisable(GL_TEXTURE_2D);
	for (int size = 1; size < 7; size++) {
		glPointSize((float)size);
		glBegin(GL_POINTS);
		glColor3f(1, 0.2f * (float)size, 0);
		glVertex2i(9 * size, 8);
		glColor3f(0, 0.2f * (float)size, 1);
		glVertex2f(9 * (float)size + 0.3f, 18.6f);
		glEnd();
	}
	glColor3f(1, 1, 1);
	glEnable(GL_TEXTURE_2D);
	texture();
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, colors);
	glEnable(GL_POINT_SPRITE);
	glTexEnvi(GL_POINT_SPRITE, GL_COORD_REPLACE, GL_TRUE);
	glPointSize(14);
	for (int i = 0; i < 2; i++) {
		glPointParameteri(GL_POINT_SPRITE_COORD_ORIGIN, i ? GL_LOWER_LEFT : GL_UPPER_LEFT);
		glBegin(GL_POINTS);
		glVertex2f(16.1f + 30 * (float)i, 36.1f);
		glEnd();
	}
	glPointParameteri(GL_POINT_SPRITE_COORD_ORIGIN, GL_UPPER_LEFT);
	glDisable(GL_POINT_SPRITE);
}

/* Texture environments with depth textures: alpha, luminance and intensity. */
static void depth_environments(void)
{
	static const int modes[3] = { GL_ALPHA, GL_LUMINANCE, GL_INTENSITY },
			 environments[4] = { GL_REPLACE_EXT, GL_MODULATE, GL_ADD, GL_BLEND };
	static const float depths[4] = { 0.1f, 0.4f, 0.6f, 0.9f };

	glEnable(GL_BLEND);
	glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
	glColor4f(0.8f, 0.6f, 0.2f, 0.6f);
	texture();
	glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, 2, 2, 0, GL_DEPTH_COMPONENT, GL_FLOAT, depths);
	for (int i = 0; i < 12; i++) {
		glTexParameteri(GL_TEXTURE_2D, GL_DEPTH_TEXTURE_MODE, modes[i / 4]);
		glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, environments[i % 4]);
		panel(i % 4 * 16, i / 4 * 16, 15, 0.01f, 0.98f);
	}
	glDisable(GL_BLEND);
}

/* Sums of two products (NV_texture_env_combine4), and the ordinary functions. */
static void combine4(void)
{
	static const int functions[4] = { GL_ADD, GL_ADD_SIGNED, GL_INTERPOLATE, GL_DOT3_RGBA };
	static const int operands[3][4] = { { GL_SRC_COLOR, GL_SRC_COLOR, GL_SRC_COLOR, GL_ONE_MINUS_SRC_COLOR },
		                            { GL_SRC_COLOR, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_SRC_COLOR },
		                            { GL_ONE_MINUS_SRC_COLOR, GL_SRC_COLOR, GL_SRC_COLOR, GL_SRC_ALPHA } };
	static const int sources[3][4] = { { GL_TEXTURE, GL_PRIMARY_COLOR, GL_CONSTANT, GL_TEXTURE },
		                           { GL_PRIMARY_COLOR, GL_TEXTURE, GL_TEXTURE, GL_ZERO },
		                           { GL_PREVIOUS, GL_TEXTURE, GL_CONSTANT, GL_CONSTANT } };
	const float constant[4] = { 0.3f, 0.9f, 0.5f, 0.6f };

	texture();
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, colors);
	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_COMBINE4_NV);
	glTexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, constant);
	glColor4f(0.9f, 0.4f, 0.7f, 0.8f);
	for (int i = 0; i < 12; i++) {
		glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB, functions[i % 4]);
		glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_ALPHA, functions[i % 3]);
		for (int k = 0; k < 4; k++) {
			glTexEnvi(GL_TEXTURE_ENV, k < 3 ? GL_SOURCE0_RGB + (unsigned)k : GL_SOURCE3_RGB_NV, sources[i / 4][k]);
			glTexEnvi(GL_TEXTURE_ENV, k < 3 ? GL_OPERAND0_RGB + (unsigned)k : GL_OPERAND3_RGB_NV, operands[i / 4][k]);
			glTexEnvi(GL_TEXTURE_ENV, k < 3 ? GL_SOURCE0_ALPHA + (unsigned)k : GL_SOURCE3_ALPHA_NV, sources[(i / 4 + 1) % 3][k]);
		}
		glEnable(GL_BLEND);
		glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
		panel(i % 4 * 16, i / 4 * 16, 15, 0.01f, 0.98f);
	}
	glDisable(GL_BLEND);
}

/* Walls that extend out of the view on all sides, with texels much smaller than pixels: the last bits of the
 * coordinates select one. */
static void walls(void)
{
	static const unsigned char board[2][2] = { { 255, 0 }, { 0, 255 } };

	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	glFrustum(-0.4, 0.4, -0.3, 0.3, 0.5, 40);
	glMatrixMode(GL_MODELVIEW);
	texture();
	glTexImage2D(GL_TEXTURE_2D, 0, GL_LUMINANCE, 2, 2, 0, GL_LUMINANCE, GL_UNSIGNED_BYTE, board);
	for (int i = 0; i < 4; i++) {
		glLoadIdentity();
		glRotatef(90 * (float)i + 7, 0, 0, 1);
		glTranslatef(-0.3f, -1, -0.2f);
		glRotatef(-80 - 2 * (float)i, 1, 0, 0);
		glScalef(3, 5, 1);
		glTranslatef(-0.5f, -0.1f, 0);
		glBegin(GL_QUADS);
		for (int k = 0; k < 4; k++) {
			float u = k == 1 || k == 2, v = k >= 2;

			glTexCoord2f(3e5f * u - 1e5f, 2e5f * v);
			glVertex2f(u, v);
		}
		glEnd();
	}
}

/* Each of these draws onto the previous frame. */
static void trail(void)
{
	static int n;

	glDisable(GL_TEXTURE_2D);
	if (!n)
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
	glEnable(GL_BLEND);
	glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
	glColor4f(0.2f * (float)n, 1, 0.3f, 0.6f);
	glRecti(4 + 9 * n, 6, 20 + 9 * n, 40);
	glDisable(GL_BLEND);
	n++;
}

int main(void)
{
	static void (*const frames[])(void) = {
		formats, numbers, filtered_numbers, blocks, channels, swizzles, wraps, depth_and_stencil, generated_levels,
		cube_levels, points, averaged_levels, depth_environments, combine4, walls, trail, trail, trail, trail, trail
	};

	for (int i = 0; i < 64; i++)
		colors[i / 16][i / 4 % 4][i % 4] = (unsigned char)(i % 4 == 3 ? 255 - 12 * (i / 4) : i * 67 + i / 4 * 13);
	open_window();
	for (unsigned i = 0; i < sizeof(frames) / sizeof(frames[0]); i++) {
		reset(frames[i] != trail);
		frames[i]();
		end_frame();
	}
	return 0;
}
