#include <string.h>

#include "tests/generated/generated.h"

enum { MOST_SIZE = 64, N_TARGETS = 5 };

static const GLenum targets[N_TARGETS] = { GL_TEXTURE_1D, GL_TEXTURE_2D, GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP,
	                                   GL_TEXTURE_RECTANGLE };

/* Texels: noise, a chessboard or a gradient, per component. */
static void paint(struct chance *chance, GLubyte *texels, unsigned width, unsigned height, unsigned components)
{
	unsigned kind = chance_below(chance, 3), cell = 1 + chance_below(chance, 8);
	GLubyte two[2][4];

	for (unsigned k = 0; k < 8; k++)
		two[k / 4][k % 4] = (GLubyte)chance_below(chance, 256);
	for (unsigned y = 0; y < height; y++)
		for (unsigned x = 0; x < width; x++)
			for (unsigned k = 0; k < components; k++) {
				GLubyte *texel = &texels[(y * width + x) * components + k];

				if (kind == 0)
					*texel = (GLubyte)chance_below(chance, 256);
				else if (kind == 1)
					*texel = two[(x / cell + y / cell) & 1][k];
				else
					*texel = (GLubyte)((k & 1 ? x * 255 / width : y * 255 / height) ^
					                   (k == 2 ? 255 : 0));
			}
}

static unsigned components_of(GLenum format)
{
	switch (format) {
	case GL_RGBA:
	case GL_BGRA:
		return 4;
	case GL_RGB:
	case GL_BGR:
		return 3;
	case GL_LUMINANCE_ALPHA:
		return 2;
	default:
		return 1;
	}
}

#define FORMATS GL_RGBA, GL_RGB, GL_BGRA, GL_BGR, GL_LUMINANCE, GL_LUMINANCE_ALPHA, GL_ALPHA, GL_RGBA, GL_RGB
#define INTERNAL_FORMATS                                                                                       \
	GL_RGBA, GL_RGB, GL_RGBA8, GL_RGB8, GL_LUMINANCE, GL_LUMINANCE_ALPHA, GL_ALPHA, GL_INTENSITY, GL_RGB5, \
		GL_RGBA4, GL_RGB5_A1, GL_LUMINANCE8_ALPHA8, GL_R3_G3_B2, GL_RGB10_A2, GL_RGBA, GL_RGB

static void give_image(struct chance *chance, GLenum target, GLint level, GLenum internal, unsigned width,
                       unsigned height, unsigned depth)
{
	static GLubyte texels[MOST_SIZE * MOST_SIZE * 4 * 4];
	GLenum format = ONE_OF(chance, FORMATS);

	paint(chance, texels, width, height * depth, components_of(format));
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	if (target == GL_TEXTURE_1D)
		glTexImage1D(target, level, (GLint)internal, (GLsizei)width, 0, format, GL_UNSIGNED_BYTE, texels);
	else if (target == GL_TEXTURE_3D)
		glTexImage3D(target, level, (GLint)internal, (GLsizei)width, (GLsizei)height, (GLsizei)depth, 0, format,
		             GL_UNSIGNED_BYTE, texels);
	else
		glTexImage2D(target, level, (GLint)internal, (GLsizei)width, (GLsizei)height, 0, format,
		             GL_UNSIGNED_BYTE, texels);
	glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

/* Specify all levels of a mipmap chain, or one. */
static void give_images(struct chance *chance, GLenum target, int chain)
{
	unsigned width = 1u << chance_below(chance, 7), height = 1u << chance_below(chance, 7), depth = 1;
	GLenum internal = ONE_OF(chance, INTERNAL_FORMATS);
	GLenum first = target, last = target;
	GLint level = 0;

	if (target == GL_TEXTURE_CUBE_MAP) {
		height = width;
		first = GL_TEXTURE_CUBE_MAP_POSITIVE_X;
		last = GL_TEXTURE_CUBE_MAP_NEGATIVE_Z;
	} else if (target == GL_TEXTURE_3D) {
		width = height = 8u << chance_below(chance, 2);
		depth = 1u << chance_below(chance, 3);
	} else if (target == GL_TEXTURE_1D) {
		height = 1;
	} else if (target == GL_TEXTURE_RECTANGLE || chance_of(chance, 4)) {
		width = 1 + chance_below(chance, MOST_SIZE);
		height = 1 + chance_below(chance, MOST_SIZE);
	}
	for (;; level++) {
		for (GLenum face = first; face <= last; face++)
			give_image(chance, face, level, internal, width, height, depth);
		if (!chain || (width == 1 && height == 1 && depth == 1))
			break;
		width = width > 1 ? width / 2 : 1;
		height = height > 1 ? height / 2 : 1;
		depth = depth > 1 ? depth / 2 : 1;
	}
}

static void set_wraps(struct chance *chance, GLenum target)
{
	static const GLenum names[] = { GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R };
	GLfloat border[4];

	for (int i = 0; i < 3; i++) {
		GLenum any = ONE_OF(chance, GL_REPEAT, GL_REPEAT, GL_CLAMP, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_BORDER,
		                    GL_MIRRORED_REPEAT);
		GLenum plain = ONE_OF(chance, GL_CLAMP, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_BORDER);

		glTexParameteri(target, names[i], (GLint)(target == GL_TEXTURE_RECTANGLE ? plain : any));
	}
	chance_color(chance, border);
	glTexParameterfv(target, GL_TEXTURE_BORDER_COLOR, border);
}

static void make_texture(struct chance *chance, GLenum target)
{
	int chain = target != GL_TEXTURE_RECTANGLE && chance_of(chance, 2);
	int generated = chain && chance_of(chance, 3);

	if (generated)
		glTexParameteri(target, GL_GENERATE_MIPMAP, GL_TRUE);
	set_wraps(chance, target);
	glTexParameteri(target, GL_TEXTURE_MAG_FILTER, (GLint)ONE_OF(chance, GL_NEAREST, GL_LINEAR, GL_LINEAR));
	if (chain)
		glTexParameteri(target, GL_TEXTURE_MIN_FILTER,
		                (GLint)ONE_OF(chance, GL_NEAREST_MIPMAP_NEAREST, GL_LINEAR_MIPMAP_NEAREST,
		                              GL_NEAREST_MIPMAP_LINEAR, GL_LINEAR_MIPMAP_LINEAR));
	else
		glTexParameteri(target, GL_TEXTURE_MIN_FILTER, (GLint)ONE_OF(chance, GL_NEAREST, GL_LINEAR));
	give_images(chance, target, chain && !generated);
	if (chain && chance_of(chance, 4))
		glTexParameteri(target, GL_TEXTURE_BASE_LEVEL, 1 - (int)chance_below(chance, 2));
	if (chain && chance_of(chance, 4))
		glTexParameterf(target, GL_TEXTURE_MIN_LOD, chance_between(chance, 0, 2));
}

void renew_texture(struct program *program, unsigned slot, GLenum target)
{
	if (program->textures[slot])
		glDeleteTextures(1, &program->textures[slot]);
	glGenTextures(1, &program->textures[slot]);
	program->targets[slot] = target;
	glBindTexture(target, program->textures[slot]);
}

void disable_textures(void)
{
	for (unsigned unit = 0; unit < MOST_UNITS; unit++) {
		glActiveTexture(GL_TEXTURE0 + unit);
		for (int i = 0; i < N_TARGETS; i++)
			glDisable(targets[i]);
	}
	glActiveTexture(GL_TEXTURE0);
}

/* Enable a texture on one unit and target; an existing texture or a new one. */
void step_texture(struct chance *chance, struct program *program)
{
	unsigned unit = chance_of(chance, 3) ? chance_below(chance, MOST_UNITS) : 0,
		 slot = chance_below(chance, MOST_TEXTURES);
	GLenum target = chance_of(chance, 3) ? targets[chance_below(chance, N_TARGETS)] : GL_TEXTURE_2D;

	glActiveTexture(GL_TEXTURE0 + unit);
	for (int i = 0; i < N_TARGETS; i++)
		glDisable(targets[i]);
	if (chance_of(chance, 8)) {
		glActiveTexture(GL_TEXTURE0);
		return;
	}
	if (!program->targets[slot] || chance_of(chance, 2)) {
		renew_texture(program, slot, target);
		make_texture(chance, target);
	} else {
		target = program->targets[slot];
		glBindTexture(target, program->textures[slot]);
	}
	glEnable(target);
	glActiveTexture(GL_TEXTURE0);
}

/* Replace a part of an image, or parameters. */
void step_texture_change(struct chance *chance, struct program *program)
{
	GLubyte texels[8 * 8 * 4];
	GLint width = 0, height = 0;
	unsigned slot = chance_below(chance, MOST_TEXTURES);
	GLenum format = ONE_OF(chance, GL_RGBA, GL_RGB, GL_BGRA);

	if (program->targets[slot] != GL_TEXTURE_2D)
		return;
	glBindTexture(GL_TEXTURE_2D, program->textures[slot]);
	if (chance_of(chance, 2)) {
		set_wraps(chance, GL_TEXTURE_2D);
		return;
	}
	glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &width);
	glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_HEIGHT, &height);
	paint(chance, texels, 8, 8, components_of(format));
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	if (width >= 8 && height >= 8)
		glTexSubImage2D(GL_TEXTURE_2D, 0, (GLint)chance_below(chance, (unsigned)width - 7),
		                (GLint)chance_below(chance, (unsigned)height - 7), 8, 8, format, GL_UNSIGNED_BYTE,
		                texels);
	glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

static void set_combiner(struct chance *chance)
{
	static const GLenum sources[2][3] = { { GL_SRC0_RGB, GL_SRC1_RGB, GL_SRC2_RGB },
		                              { GL_SRC0_ALPHA, GL_SRC1_ALPHA, GL_SRC2_ALPHA } };
	static const GLenum operands[2][3] = { { GL_OPERAND0_RGB, GL_OPERAND1_RGB, GL_OPERAND2_RGB },
		                               { GL_OPERAND0_ALPHA, GL_OPERAND1_ALPHA, GL_OPERAND2_ALPHA } };

	glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_COMBINE);
	glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB,
	          (GLint)ONE_OF(chance, GL_REPLACE, GL_MODULATE, GL_ADD, GL_ADD_SIGNED, GL_INTERPOLATE, GL_SUBTRACT,
	                        GL_DOT3_RGB));
	glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_ALPHA,
	          (GLint)ONE_OF(chance, GL_REPLACE, GL_MODULATE, GL_ADD, GL_ADD_SIGNED, GL_INTERPOLATE, GL_SUBTRACT));
	for (int alpha = 0; alpha < 2; alpha++)
		for (int i = 0; i < 3; i++) {
			GLenum color = ONE_OF(chance, GL_SRC_COLOR, GL_ONE_MINUS_SRC_COLOR, GL_SRC_ALPHA,
			                      GL_ONE_MINUS_SRC_ALPHA);

			glTexEnvi(GL_TEXTURE_ENV, sources[alpha][i],
			          (GLint)ONE_OF(chance, GL_TEXTURE, GL_CONSTANT, GL_PRIMARY_COLOR, GL_PREVIOUS));
			if (alpha)
				color = ONE_OF(chance, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
			glTexEnvi(GL_TEXTURE_ENV, operands[alpha][i], (GLint)color);
		}
	glTexEnvi(GL_TEXTURE_ENV, GL_RGB_SCALE, 1 << chance_below(chance, 2));
	glTexEnvi(GL_TEXTURE_ENV, GL_ALPHA_SCALE, 1 << chance_below(chance, 2));
}

void step_texture_environment(struct chance *chance, struct program *program)
{
	GLfloat color[4];

	(void)program;
	glActiveTexture(GL_TEXTURE0 + (chance_of(chance, 3) ? chance_below(chance, MOST_UNITS) : 0));
	chance_color(chance, color);
	glTexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, color);
	if (chance_of(chance, 3))
		set_combiner(chance);
	else
		glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE,
		          (GLint)ONE_OF(chance, GL_MODULATE, GL_DECAL, GL_BLEND, GL_REPLACE, GL_ADD));
	if (chance_of(chance, 4))
		glTexEnvf(GL_TEXTURE_FILTER_CONTROL, GL_TEXTURE_LOD_BIAS, chance_between(chance, -1, 2));
	glActiveTexture(GL_TEXTURE0);
}

void step_texture_generation(struct chance *chance, struct program *program)
{
	GLenum coordinate = GL_S + chance_below(chance, 4), enable = GL_TEXTURE_GEN_S + (coordinate - GL_S);
	GLfloat plane[4] = { chance_between(chance, -1, 1), chance_between(chance, -1, 1),
		             chance_between(chance, -1, 1), 0.5f };

	(void)program;
	glActiveTexture(GL_TEXTURE0 + (chance_of(chance, 4) ? chance_below(chance, MOST_UNITS) : 0));
	if (chance_of(chance, 3)) {
		for (GLenum each = GL_TEXTURE_GEN_S; each <= GL_TEXTURE_GEN_Q; each++)
			glDisable(each);
	} else if (chance_of(chance, 3)) {
		GLint mode = (GLint)ONE_OF(chance, GL_SPHERE_MAP, GL_REFLECTION_MAP, GL_NORMAL_MAP);

		for (GLenum each = GL_S; each <= (mode == GL_SPHERE_MAP ? GL_T : GL_R); each++) {
			glTexGeni(each, GL_TEXTURE_GEN_MODE, mode);
			glEnable(GL_TEXTURE_GEN_S + (each - GL_S));
		}
	} else if (coordinate != GL_Q) {
		int of_eye = (int)chance_below(chance, 2);

		glTexGeni(coordinate, GL_TEXTURE_GEN_MODE, of_eye ? GL_EYE_LINEAR : GL_OBJECT_LINEAR);
		glTexGenfv(coordinate, of_eye ? GL_EYE_PLANE : GL_OBJECT_PLANE, plane);
		glEnable(enable);
	}
	glActiveTexture(GL_TEXTURE0);
}

void step_texture_matrix(struct chance *chance, struct program *program)
{
	(void)program;
	glActiveTexture(GL_TEXTURE0 + (chance_of(chance, 4) ? chance_below(chance, MOST_UNITS) : 0));
	glMatrixMode(GL_TEXTURE);
	if (chance_of(chance, 3))
		glLoadIdentity();
	else if (chance_of(chance, 2))
		glRotatef(chance_between(chance, 0, 360), 0, 0, 1);
	else
		glScalef(chance_between(chance, 0.5f, 3), chance_between(chance, 0.5f, 3), 1);
	glMatrixMode(GL_MODELVIEW);
	glActiveTexture(GL_TEXTURE0);
}

/* Copy from the window or framebuffer object into a texture. */
void step_texture_copy(struct chance *chance, struct program *program)
{
	unsigned slot = chance_below(chance, MOST_TEXTURES);
	int width = 1 << (3 + chance_below(chance, 4)), height = 1 << (3 + chance_below(chance, 4));
	int x = (int)chance_below(chance, 20), y = (int)chance_below(chance, 20);

	renew_texture(program, slot, GL_TEXTURE_2D);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
	while (width + x > program->target_width)
		width /= 2;
	while (height + y > program->target_height)
		height /= 2;
	glCopyTexImage2D(GL_TEXTURE_2D, 0, ONE_OF(chance, GL_RGB, GL_RGBA, GL_LUMINANCE), x, y, width, height, 0);
	if (chance_of(chance, 2))
		glCopyTexSubImage2D(GL_TEXTURE_2D, 0, width / 4, height / 4, x, y, width / 2, height / 2);
	glEnable(GL_TEXTURE_2D);
}
