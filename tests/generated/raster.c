#include "tests/generated/generated.h"

void step_polygon(struct chance *chance, struct program *program)
{
	GLubyte pattern[128];

	(void)program;
	switch (chance_below(chance, 7)) {
	case 0:
		glPolygonMode(ONE_OF(chance, GL_FRONT, GL_BACK, GL_FRONT_AND_BACK),
		              ONE_OF(chance, GL_FILL, GL_FILL, GL_LINE, GL_POINT));
		break;
	case 1:
		glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
		glDisable(GL_CULL_FACE);
		break;
	case 2:
		glCullFace(ONE_OF(chance, GL_FRONT, GL_BACK, GL_BACK));
		glEnable(GL_CULL_FACE);
		break;
	case 3:
		glFrontFace(ONE_OF(chance, GL_CW, GL_CCW));
		break;
	case 4:
		for (int i = 0; i < 128; i++)
			pattern[i] = (GLubyte)chance_below(chance, 256);
		glPolygonStipple(pattern);
		glEnable(GL_POLYGON_STIPPLE);
		break;
	case 5:
		glDisable(GL_POLYGON_STIPPLE);
		break;
	default:
		glPolygonOffset(chance_between(chance, -4, 4), chance_between(chance, -4, 4));
		glEnable(ONE_OF(chance, GL_POLYGON_OFFSET_FILL, GL_POLYGON_OFFSET_LINE, GL_POLYGON_OFFSET_POINT));
	}
}

void step_line(struct chance *chance, struct program *program)
{
	(void)program;
	glLineWidth(chance_of(chance, 2) ? 1 : chance_between(chance, 0.5f, 7));
	if (chance_of(chance, 2)) {
		glLineStipple((int)(1 + chance_below(chance, 4)), (GLushort)chance_below(chance, 65536));
		glEnable(GL_LINE_STIPPLE);
	} else {
		glDisable(GL_LINE_STIPPLE);
	}
}

/* Draw sprites, then disable them: Mesa divides 0 by 0 for other primitives while sprites are enabled. */
static void draw_sprites(struct chance *chance)
{
	glEnable(GL_POINT_SPRITE);
	glTexEnvi(GL_POINT_SPRITE, GL_COORD_REPLACE, (GLint)chance_below(chance, 2));
	glPointParameteri(GL_POINT_SPRITE_COORD_ORIGIN, (GLint)ONE_OF(chance, GL_LOWER_LEFT, GL_UPPER_LEFT));
	glBegin(GL_POINTS);
	for (unsigned i = 2 + chance_below(chance, 6); i; i--)
		glVertex3f(chance_between(chance, -0.8f, 0.8f), chance_between(chance, -0.7f, 0.7f),
		           chance_between(chance, -7, -4));
	glEnd();
	glDisable(GL_POINT_SPRITE);
}

void step_point(struct chance *chance, struct program *program)
{
	(void)program;
	glPointSize(chance_between(chance, 0.5f, 12));
	if (chance_of(chance, 3)) {
		GLfloat attenuation[3] = { chance_between(chance, 0, 1), chance_between(chance, 0, 0.2f),
			                   chance_between(chance, 0.01f, 0.05f) };

		glPointParameterfv(GL_POINT_DISTANCE_ATTENUATION, attenuation);
		glPointParameterf(GL_POINT_SIZE_MIN, chance_between(chance, 0, 3));
	}
	if (chance_of(chance, 2))
		draw_sprites(chance);
}

void step_shade_model(struct chance *chance, struct program *program)
{
	(void)program;
	glShadeModel(ONE_OF(chance, GL_FLAT, GL_SMOOTH));
	if (chance_of(chance, 4))
		glHint(GL_PERSPECTIVE_CORRECTION_HINT, ONE_OF(chance, GL_NICEST, GL_FASTEST));
}
