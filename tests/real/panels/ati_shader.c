/* ATI_fragment_shader: each instruction, argument, modifier and texture, on a tilted square. */
#include "programs.h"

#define CHANGES 16
#define ONES 6 /* arguments common to all */

static const GLenum registers[6] = {
	GL_REG_0_ATI, GL_REG_1_ATI, GL_REG_2_ATI, GL_REG_3_ATI, GL_REG_4_ATI, GL_REG_5_ATI
};

static void begin(void)
{
	static GLuint shader;

	if (!shader)
		shader = glGenFragmentShadersATI(1);
	glBindFragmentShaderATI(shader);
	glBeginFragmentShaderATI();
	glSetFragmentShaderConstantATI(GL_CON_6_ATI, (const float[4]){ 0.25f, 0.25f, 0.25f, 0.25f });
	glSetFragmentShaderConstantATI(GL_CON_7_ATI, (const float[4]){ 0.45f, 0.4f, 0.5f, 0.45f });
}

/* Scale the result into the visible range. */
static void end(void)
{
	glColorFragmentOp3ATI(GL_MAD_ATI, registers[0], GL_NONE, GL_NONE, registers[0], GL_NONE, GL_NONE, GL_CON_6_ATI,
	                      GL_NONE, GL_NONE, GL_CON_7_ATI, GL_NONE, GL_NONE);
	glAlphaFragmentOp3ATI(GL_MAD_ATI, registers[0], GL_NONE, registers[0], GL_NONE, GL_NONE, GL_CON_6_ATI, GL_NONE,
	                      GL_NONE, GL_CON_7_ATI, GL_NONE, GL_NONE);
	glEndFragmentShaderATI();
	glEnable(GL_FRAGMENT_SHADER_ATI);
}

static void draw(int i)
{
	draw_square(i);
	glDisable(GL_FRAGMENT_SHADER_ATI);
}

static void set_registers(void)
{
	for (unsigned k = 0; k < 3; k++)
		glPassTexCoordATI(registers[k], GL_TEXTURE0 + k, k == 1 ? GL_SWIZZLE_STQ_ATI : GL_SWIZZLE_STR_ATI);
}

/* Each instruction, for colours and for alpha, with inputs below 0 and above 1. */
static void instruction(int i)
{
	static const GLenum ones[] = { GL_MOV_ATI }, twos[] = { GL_ADD_ATI, GL_MUL_ATI, GL_SUB_ATI, GL_DOT3_ATI, GL_DOT4_ATI };
	static const GLenum threes[] = { GL_MAD_ATI, GL_LERP_ATI, GL_CND_ATI, GL_CND0_ATI, GL_DOT2_ADD_ATI };
	const GLenum a = registers[0], b = registers[1], c = registers[2];

	begin();
	set_registers();
	if (i == 0) {
		glColorFragmentOp1ATI(ones[0], a, GL_NONE, GL_NONE, b, GL_NONE, GL_NONE);
		glAlphaFragmentOp1ATI(ones[0], a, GL_NONE, b, GL_NONE, GL_NONE);
	} else if (i < 6) {
		glColorFragmentOp2ATI(twos[i - 1], a, GL_NONE, GL_NONE, a, GL_NONE, GL_NONE, b, GL_NONE, GL_NONE);
		glAlphaFragmentOp2ATI(twos[i - 1], a, GL_NONE, a, GL_NONE, GL_NONE, b, GL_NONE, GL_NONE);
	} else {
		glColorFragmentOp3ATI(threes[i - 6], a, GL_NONE, GL_NONE, a, GL_NONE, GL_NONE, b, GL_NONE, GL_NONE, c,
		                      GL_NONE, GL_NONE);
		glAlphaFragmentOp3ATI(threes[i - 6], a, GL_NONE, a, GL_NONE, GL_NONE, b, GL_NONE, GL_NONE, c, GL_NONE, GL_NONE);
	}
	end();
}

/* Each argument component and modifier: times two, complement, negation, bias. */
static void argument(int i)
{
	static const GLenum components[5] = { GL_NONE, GL_RED, GL_GREEN, GL_BLUE, GL_ALPHA };
	const int component = choose(&i, 5), change = choose(&i, CHANGES);

	begin();
	set_registers();
	glColorFragmentOp2ATI(GL_ADD_ATI, registers[0], GL_NONE, GL_NONE, registers[1], components[component],
	                      (GLuint)change, registers[2], GL_NONE, GL_NEGATE_BIT_ATI);
	glAlphaFragmentOp1ATI(GL_MOV_ATI, registers[0], GL_NONE, registers[1], components[component], (GLuint)change);
	end();
}

/* Destinations: write masks, scale factors, saturation. */
static void destination(int i)
{
	static const GLuint factors[7] = { GL_NONE,         GL_2X_BIT_ATI,      GL_4X_BIT_ATI,    GL_8X_BIT_ATI,
		                           GL_HALF_BIT_ATI, GL_QUARTER_BIT_ATI, GL_EIGHTH_BIT_ATI };
	static const GLuint masks[4] = { GL_NONE, GL_RED_BIT_ATI, GL_GREEN_BIT_ATI | GL_BLUE_BIT_ATI, GL_BLUE_BIT_ATI };
	const int factor = choose(&i, 7), mask = choose(&i, 4), saturates = choose(&i, 2);
	const GLuint change = factors[factor] | (saturates ? GL_SATURATE_BIT_ATI : 0);

	begin();
	set_registers();
	glColorFragmentOp1ATI(GL_MOV_ATI, registers[0], masks[mask], change, registers[1], GL_NONE, GL_NONE);
	glAlphaFragmentOp1ATI(GL_MOV_ATI, registers[0], change, registers[1], GL_RED, GL_NONE);
	end();
}

/* Sources other than registers: constants of the shader and of the context, colours. */
static void source(int i)
{
	static const GLenum sources[ONES] = {
		GL_ZERO, GL_ONE, GL_PRIMARY_COLOR_ARB, GL_SECONDARY_INTERPOLATOR_ATI, GL_CON_0_ATI, GL_CON_1_ATI
	};

	glSetFragmentShaderConstantATI(GL_CON_0_ATI, (const float[4]){ 0.2f, 0.9f, 0.1f + 0.1f * (float)i, 0.3f });
	begin();
	glSetFragmentShaderConstantATI(GL_CON_1_ATI, (const float[4]){ 0.8f, 0.3f, 0.6f, 0.9f });
	glColorFragmentOp1ATI(GL_MOV_ATI, registers[0], GL_NONE, GL_NONE, sources[i], GL_NONE, GL_NONE);
	glAlphaFragmentOp1ATI(GL_MOV_ATI, registers[0], GL_NONE, sources[i], GL_BLUE, GL_NONE);
	end();
}

/*
 * Coordinates passed on or used for look-ups, each swizzle, each kind of texture; in the second pass also with
 * coordinates computed by the first, except for the cube: for 1 in 200 pixels, Mesa finds another nearest texel for a
 * computed direction.
 */
static void texture(int i)
{
	static const GLenum swizzles[4] = { GL_SWIZZLE_STR_ATI, GL_SWIZZLE_STQ_ATI, GL_SWIZZLE_STR_DR_ATI,
		                            GL_SWIZZLE_STQ_DQ_ATI };
	static const struct {
		GLenum target;
		unsigned image;
	} kinds[4] = { { GL_TEXTURE_2D, 0 }, { GL_TEXTURE_2D, 1 }, { GL_TEXTURE_CUBE_MAP, 2 }, { GL_TEXTURE_1D, 3 } };
	const GLenum swizzle = swizzles[choose(&i, 4)];
	const int asked = choose(&i, 4), samples = choose(&i, 2), passes = choose(&i, 2),
		  kind = passes && asked == 2 ? 0 : asked;

	glActiveTexture(GL_TEXTURE1);
	glBindTexture(kinds[kind].target, images[kinds[kind].image]);
	glEnable(kinds[kind].target);
	glActiveTexture(GL_TEXTURE0);
	begin();
	if (passes) {
		glPassTexCoordATI(registers[2], GL_TEXTURE2, GL_SWIZZLE_STR_ATI);
		glColorFragmentOp1ATI(GL_MOV_ATI, registers[2], GL_NONE, GL_HALF_BIT_ATI, registers[2], GL_NONE, GL_BIAS_BIT_ATI);
		glSampleMapATI(registers[1], registers[2], GL_SWIZZLE_STR_ATI);
	} else if (samples) {
		glSampleMapATI(registers[1], GL_TEXTURE0, swizzle);
	} else {
		glPassTexCoordATI(registers[1], GL_TEXTURE0, swizzle);
	}
	glColorFragmentOp1ATI(GL_MOV_ATI, registers[0], GL_NONE, GL_NONE, registers[1], GL_NONE, GL_NONE);
	glAlphaFragmentOp1ATI(GL_MOV_ATI, registers[0], GL_NONE, registers[1], GL_BLUE, GL_NONE);
	end();
}

int main(void)
{
	static const struct table tables[] = {
		{ 11, instruction, draw }, { 5 * CHANGES, argument, draw }, { 56, destination, draw }, { ONES, source, draw },
		{ 64, texture, draw },
	};

	DRAW_TABLES(tables, make_images);
	return 0;
}
