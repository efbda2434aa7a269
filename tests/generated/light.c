#include "tests/generated/generated.h"

static void set_attenuation(struct chance *chance, GLenum light)
{
	glLightf(light, GL_CONSTANT_ATTENUATION, chance_between(chance, 0.5f, 1.5f));
	if (chance_of(chance, 2))
		glLightf(light, GL_LINEAR_ATTENUATION, chance_between(chance, 0, 0.3f));
	if (chance_of(chance, 3))
		glLightf(light, GL_QUADRATIC_ATTENUATION, chance_between(chance, 0, 0.1f));
}

static void set_spot(struct chance *chance, GLenum light)
{
	GLfloat direction[3] = { chance_between(chance, -1, 1), chance_between(chance, -1, 1), -1 };

	glLightfv(light, GL_SPOT_DIRECTION, direction);
	glLightf(light, GL_SPOT_CUTOFF, chance_between(chance, 10, 90));
	glLightf(light, GL_SPOT_EXPONENT, chance_of(chance, 2) ? chance_between(chance, 0, 60) : 0);
}

void step_light(struct chance *chance, struct program *program)
{
	GLenum light = GL_LIGHT0 + chance_below(chance, chance_of(chance, 4) ? 8 : 3);
	GLfloat position[4] = { chance_between(chance, -3, 3), chance_between(chance, -3, 3),
		                chance_between(chance, -4, 3), (GLfloat)chance_below(chance, 2) },
		color[4];

	(void)program;
	if (chance_of(chance, 6)) {
		glDisable(GL_LIGHTING);
		return;
	}
	if (chance_of(chance, 8)) {
		glDisable(light);
		return;
	}
	if (position[3] == 0)
		position[2] = chance_between(chance, 0.1f, 2);
	glLightfv(light, GL_POSITION, position);
	chance_color(chance, color);
	glLightfv(light, GL_DIFFUSE, color);
	if (chance_of(chance, 2)) {
		chance_color(chance, color);
		glLightfv(light, GL_SPECULAR, color);
	}
	if (chance_of(chance, 3)) {
		chance_color(chance, color);
		for (int i = 0; i < 3; i++)
			color[i] *= 0.4f;
		glLightfv(light, GL_AMBIENT, color);
	}
	if (position[3] != 0 && chance_of(chance, 2))
		set_attenuation(chance, light);
	if (position[3] != 0 && chance_of(chance, 3))
		set_spot(chance, light);
	glEnable(light);
	glEnable(GL_LIGHTING);
	if (chance_of(chance, 2))
		glEnable(ONE_OF(chance, GL_NORMALIZE, GL_RESCALE_NORMAL));
}

void step_material(struct chance *chance, struct program *program)
{
	GLenum face = ONE_OF(chance, GL_FRONT, GL_BACK, GL_FRONT_AND_BACK, GL_FRONT_AND_BACK);
	GLfloat color[4];

	(void)program;
	chance_color(chance, color);
	switch (chance_below(chance, 4)) {
	case 0:
		glMaterialfv(face, ONE_OF(chance, GL_AMBIENT, GL_DIFFUSE, GL_AMBIENT_AND_DIFFUSE, GL_EMISSION), color);
		break;
	case 1:
		glMaterialfv(face, GL_SPECULAR, color);
		glMaterialf(face, GL_SHININESS, chance_of(chance, 4) ? 0 : chance_between(chance, 1, 128));
		break;
	case 2:
		glColorMaterial(
			face, ONE_OF(chance, GL_AMBIENT, GL_DIFFUSE, GL_AMBIENT_AND_DIFFUSE, GL_SPECULAR, GL_EMISSION));
		glEnable(GL_COLOR_MATERIAL);
		glColor4fv(color);
		break;
	default:
		glDisable(GL_COLOR_MATERIAL);
		glMaterialfv(face, GL_AMBIENT_AND_DIFFUSE, color);
	}
}

void step_light_model(struct chance *chance, struct program *program)
{
	GLfloat color[4];

	(void)program;
	switch (chance_below(chance, 4)) {
	case 0:
		chance_color(chance, color);
		glLightModelfv(GL_LIGHT_MODEL_AMBIENT, color);
		break;
	case 1:
		glLightModeli(GL_LIGHT_MODEL_LOCAL_VIEWER, (GLint)chance_below(chance, 2));
		break;
	case 2:
		glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, (GLint)chance_below(chance, 2));
		break;
	default:
		glLightModeli(GL_LIGHT_MODEL_COLOR_CONTROL,
		              (GLint)ONE_OF(chance, GL_SINGLE_COLOR, GL_SEPARATE_SPECULAR_COLOR));
	}
}

void step_fog(struct chance *chance, struct program *program)
{
	GLfloat color[4];

	(void)program;
	if (chance_of(chance, 4)) {
		glDisable(GL_FOG);
		return;
	}
	chance_color(chance, color);
	glFogfv(GL_FOG_COLOR, color);
	glFogi(GL_FOG_MODE, (GLint)ONE_OF(chance, GL_LINEAR, GL_EXP, GL_EXP2));
	glFogf(GL_FOG_DENSITY, chance_between(chance, 0.02f, 0.3f));
	glFogf(GL_FOG_START, chance_between(chance, 2, 5));
	glFogf(GL_FOG_END, chance_between(chance, 6, 10));
	glFogi(GL_FOG_COORD_SRC, (GLint)(chance_of(chance, 4) ? GL_FOG_COORD : GL_FRAGMENT_DEPTH));
	glEnable(GL_FOG);
	if (chance_of(chance, 3))
		glHint(GL_FOG_HINT, ONE_OF(chance, GL_NICEST, GL_FASTEST));
}
