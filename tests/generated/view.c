#include "tests/generated/generated.h"

/* The visible part of eye space reaches about from -1 to 1, at depths of 4 to 8. */
void step_projection(struct chance *chance, struct program *program)
{
	double aspect = (double)program->target_width / program->target_height;
	double up = chance_between(chance, 0.8f, 1.3f), side = up * aspect;
	double shift = chance_of(chance, 4) ? chance_between(chance, -0.3f, 0.3f) : 0;
	double near = chance_between(chance, 1, 3), far = chance_between(chance, 9, 60);

	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	if (chance_of(chance, 3))
		glOrtho(-side + shift, side + shift, -up, up, chance_of(chance, 3) ? -far : near, far);
	else
		glFrustum((-side + shift) * near / 5, (side + shift) * near / 5, -up * near / 5, up * near / 5, near,
		          far);
	if (chance_of(chance, 12))
		glScaled(-1, 1, 1);
	glMatrixMode(GL_MODELVIEW);
}

void place_in_view(struct chance *chance, float size)
{
	float scale = size * chance_between(chance, 0.25f, 0.8f);

	glTranslatef(chance_between(chance, -0.8f, 0.8f), chance_between(chance, -0.7f, 0.7f),
	             chance_between(chance, -7, -4));
	glRotatef(chance_between(chance, 0, 360), chance_between(chance, -1, 1), chance_between(chance, -1, 1),
	          chance_between(chance, -1, 1) + 0.01f);
	if (chance_of(chance, 3))
		glScalef(scale, scale * chance_between(chance, 0.4f, 1.6f), scale);
	else
		glScalef(scale, scale, scale);
}

static void multiply_by_any(struct chance *chance)
{
	GLfloat shear[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };

	shear[4] = chance_between(chance, -0.3f, 0.3f);
	shear[8] = chance_between(chance, -0.1f, 0.1f);
	if (chance_of(chance, 2)) {
		GLfloat transposed[16];

		for (int i = 0; i < 16; i++)
			transposed[i] = shear[i % 4 * 4 + i / 4];
		glMultTransposeMatrixf(transposed);
	} else {
		glMultMatrixf(shear);
	}
}

/* The camera of later draws. */
void step_matrix(struct chance *chance, struct program *program)
{
	switch (chance_below(chance, 6)) {
	case 0:
		glLoadIdentity();
		break;
	case 1:
		if (program->pushed_matrices < 8) {
			glPushMatrix();
			program->pushed_matrices++;
		}
		break;
	case 2:
		if (program->pushed_matrices) {
			glPopMatrix();
			program->pushed_matrices--;
		}
		break;
	case 3:
		glTranslatef(chance_between(chance, -0.2f, 0.2f), chance_between(chance, -0.2f, 0.2f), 0);
		break;
	case 4:
		glRotatef(chance_between(chance, -20, 20), 0, 0, 1);
		break;
	default:
		multiply_by_any(chance);
	}
}

void step_viewport(struct chance *chance, struct program *program)
{
	int w = program->target_width, h = program->target_height;

	if (chance_of(chance, 2)) {
		glViewport(0, 0, w, h);
	} else {
		int x = (int)chance_below(chance, (unsigned)w / 2), y = (int)chance_below(chance, (unsigned)h / 2);

		glViewport(x - (int)chance_below(chance, 10), y - (int)chance_below(chance, 10), w - x, h - y);
	}
	if (chance_of(chance, 3)) {
		double near = chance_between(chance, 0, 0.5f), far = chance_between(chance, 0.6f, 1);

		if (chance_of(chance, 4))
			glDepthRange(far, near);
		else
			glDepthRange(near, far);
	}
}

void step_scissor(struct chance *chance, struct program *program)
{
	unsigned w = (unsigned)program->target_width, h = (unsigned)program->target_height;

	if (chance_of(chance, 3)) {
		glDisable(GL_SCISSOR_TEST);
		return;
	}
	glScissor((int)chance_below(chance, w / 3), (int)chance_below(chance, h / 3),
	          (int)(w / 2 + chance_below(chance, w / 2)), (int)(h / 2 + chance_below(chance, h / 2)));
	glEnable(GL_SCISSOR_TEST);
}

void step_clip_plane(struct chance *chance, struct program *program)
{
	GLenum plane = GL_CLIP_PLANE0 + chance_below(chance, 6);
	double equation[4] = { chance_between(chance, -1, 1), chance_between(chance, -1, 1),
		               chance_between(chance, -0.1f, 0.1f), chance_between(chance, 0.1f, 1) };

	(void)program;
	if (chance_of(chance, 3)) {
		glDisable(plane);
		return;
	}
	glClipPlane(plane, equation);
	glEnable(plane);
}
