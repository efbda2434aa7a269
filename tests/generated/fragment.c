#include "tests/generated/generated.h"

#define COMPARISONS GL_NEVER, GL_LESS, GL_EQUAL, GL_LEQUAL, GL_GREATER, GL_NOTEQUAL, GL_GEQUAL, GL_ALWAYS

void step_alpha_test(struct chance *chance, struct program *program)
{
	(void)program;
	if (chance_of(chance, 3)) {
		glDisable(GL_ALPHA_TEST);
		return;
	}
	glAlphaFunc(ONE_OF(chance, GL_LESS, GL_LEQUAL, GL_GREATER, GL_GEQUAL, GL_NOTEQUAL, GL_GREATER, GL_GEQUAL),
	            chance_between(chance, 0, 1));
	glEnable(GL_ALPHA_TEST);
}

#define SOURCE_FACTORS                                                                                             \
	GL_ZERO, GL_ONE, GL_DST_COLOR, GL_ONE_MINUS_DST_COLOR, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_DST_ALPHA, \
		GL_ONE_MINUS_DST_ALPHA, GL_SRC_ALPHA_SATURATE, GL_SRC_COLOR, GL_ONE_MINUS_SRC_COLOR,               \
		GL_CONSTANT_COLOR, GL_ONE_MINUS_CONSTANT_COLOR, GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA
#define DESTINATION_FACTORS                                                                                        \
	GL_ZERO, GL_ONE, GL_SRC_COLOR, GL_ONE_MINUS_SRC_COLOR, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_DST_ALPHA, \
		GL_ONE_MINUS_DST_ALPHA, GL_DST_COLOR, GL_ONE_MINUS_DST_COLOR, GL_CONSTANT_COLOR,                   \
		GL_ONE_MINUS_CONSTANT_COLOR, GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA

void step_blend(struct chance *chance, struct program *program)
{
	GLfloat color[4];

	(void)program;
	if (chance_of(chance, 3)) {
		glDisable(GL_BLEND);
		return;
	}
	chance_color(chance, color);
	glBlendColor(color[0], color[1], color[2], color[3]);
	switch (chance_below(chance, 3)) {
	case 0:
		glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
		break;
	case 1:
		glBlendFunc(ONE_OF(chance, SOURCE_FACTORS), ONE_OF(chance, DESTINATION_FACTORS));
		break;
	default: {
		GLenum source = ONE_OF(chance, SOURCE_FACTORS), destination = ONE_OF(chance, DESTINATION_FACTORS);

		glBlendFuncSeparate(source, destination, ONE_OF(chance, SOURCE_FACTORS),
		                    ONE_OF(chance, DESTINATION_FACTORS));
	}
	}
	if (chance_of(chance, 3))
		glBlendEquation(
			ONE_OF(chance, GL_FUNC_ADD, GL_FUNC_SUBTRACT, GL_FUNC_REVERSE_SUBTRACT, GL_MIN, GL_MAX));
	else
		glBlendEquation(GL_FUNC_ADD);
	glEnable(GL_BLEND);
}

void step_depth(struct chance *chance, struct program *program)
{
	(void)program;
	switch (chance_below(chance, 4)) {
	case 0:
		glDisable(GL_DEPTH_TEST);
		break;
	case 1:
		glDepthMask((GLboolean)chance_below(chance, 2));
		break;
	default:
		glEnable(GL_DEPTH_TEST);
		glDepthFunc(chance_of(chance, 2) ?
		                    GL_LESS :
		                    ONE_OF(chance, GL_LEQUAL, GL_GREATER, GL_GEQUAL, GL_ALWAYS, GL_NOTEQUAL));
	}
}

void step_stencil(struct chance *chance, struct program *program)
{
	GLenum fails = ONE_OF(chance, GL_KEEP, GL_ZERO, GL_REPLACE, GL_INCR, GL_DECR, GL_INVERT, GL_INCR_WRAP,
	                      GL_DECR_WRAP);
	GLenum behind = ONE_OF(chance, GL_KEEP, GL_ZERO, GL_REPLACE, GL_INCR, GL_DECR, GL_INVERT, GL_INCR_WRAP,
	                       GL_DECR_WRAP);
	GLenum passes = ONE_OF(chance, GL_KEEP, GL_REPLACE, GL_INCR, GL_INVERT, GL_INCR_WRAP, GL_DECR_WRAP);
	GLenum compare = ONE_OF(chance, GL_ALWAYS, GL_ALWAYS, COMPARISONS);
	int reference = (int)chance_below(chance, 4);
	GLuint mask = chance_of(chance, 3) ? chance_below(chance, 256) : 255;

	(void)program;
	if (chance_of(chance, 3)) {
		glDisable(GL_STENCIL_TEST);
		return;
	}
	if (chance_of(chance, 4)) {
		glStencilFuncSeparate(ONE_OF(chance, GL_FRONT, GL_BACK), compare, reference, mask);
		glStencilOpSeparate(ONE_OF(chance, GL_FRONT, GL_BACK), fails, behind, passes);
	} else {
		glStencilFunc(compare, reference, mask);
		glStencilOp(fails, behind, passes);
	}
	glStencilMask(chance_of(chance, 5) ? chance_below(chance, 256) : 255);
	glEnable(GL_STENCIL_TEST);
}

void step_mask(struct chance *chance, struct program *program)
{
	unsigned mask = chance_below(chance, 16);

	(void)program;
	if (chance_of(chance, 2))
		mask = 15;
	glColorMask((GLboolean)(mask & 1), (GLboolean)(mask >> 1 & 1), (GLboolean)(mask >> 2 & 1),
	            (GLboolean)(mask >> 3));
}

void step_clear(struct chance *chance, struct program *program)
{
	GLfloat color[4];

	(void)program;
	chance_color(chance, color);
	glClearColor(color[0], color[1], color[2], color[3]);
	glClearStencil((int)chance_below(chance, 4));
	glClear(ONE_OF(chance, GL_DEPTH_BUFFER_BIT, GL_STENCIL_BUFFER_BIT, GL_COLOR_BUFFER_BIT,
	               GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT, GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT));
}

/* A quad with one colour under a logical operation, with everything disabled that makes its colour uncertain: an
 * operation on bits amplifies a difference in the last one. */
void step_logic(struct chance *chance, struct program *program)
{
	(void)program;
	glPushAttrib(GL_ENABLE_BIT | GL_COLOR_BUFFER_BIT | GL_CURRENT_BIT);
	glDisable(GL_LIGHTING);
	glDisable(GL_FOG);
	glDisable(GL_ALPHA_TEST);
	glDisable(GL_BLEND);
	disable_textures();
	glLogicOp(ONE_OF(chance, GL_CLEAR, GL_SET, GL_COPY, GL_COPY_INVERTED, GL_NOOP, GL_INVERT));
	glEnable(GL_COLOR_LOGIC_OP);
	glColor4ub((GLubyte)chance_below(chance, 256), (GLubyte)chance_below(chance, 256),
	           (GLubyte)chance_below(chance, 256), (GLubyte)chance_below(chance, 256));
	glPushMatrix();
	place_in_view(chance, 1);
	glRectf(-1, -1, 1, 1);
	glPopMatrix();
	glPopAttrib();
}
