#include "tests/generated/generated.h"

void step_draw(struct chance *chance, struct program *program)
{
	struct mesh mesh;

	(void)program;
	mesh_make(chance, &mesh);
	glPushMatrix();
	place_in_view(chance, 1);
	mesh_submit(chance, &mesh);
	glPopMatrix();
}

/* A list that draws, called at once, later, or both. It calls only older lists, and none is deleted, so no list
 * calls itself. */
void step_list(struct chance *chance, struct program *program)
{
	unsigned slot = chance_below(chance, MOST_LISTS);
	GLuint inner = program->lists[(slot + 1) % MOST_LISTS];
	GLfloat color[4];

	program->lists[slot] = glGenLists(1);
	glNewList(program->lists[slot], chance_of(chance, 3) ? GL_COMPILE_AND_EXECUTE : GL_COMPILE);
	glPushAttrib(GL_ALL_ATTRIB_BITS);
	if (chance_of(chance, 2)) {
		chance_color(chance, color);
		glColor4fv(color);
		glMaterialfv(GL_FRONT_AND_BACK, GL_DIFFUSE, color);
	}
	if (chance_of(chance, 4))
		step_material(chance, program);
	if (chance_of(chance, 6))
		step_blend(chance, program);
	step_draw(chance, program);
	if (inner && chance_of(chance, 3)) {
		glTranslatef(0.1f, 0.1f, 0);
		glCallList(inner);
		glTranslatef(-0.1f, -0.1f, 0);
	}
	glPopAttrib();
	glEndList();
}

void step_call_lists(struct chance *chance, struct program *program)
{
	GLubyte offsets[MOST_LISTS];
	GLuint base = 0;
	GLsizei n = 0;

	for (int i = 0; i < MOST_LISTS; i++)
		if (program->lists[i] && (!base || program->lists[i] < base))
			base = program->lists[i];
	for (int i = 0; i < MOST_LISTS; i++)
		if (program->lists[i] && program->lists[i] - base < 256)
			offsets[n++] = (GLubyte)(program->lists[i] - base);
	glPushMatrix();
	glTranslatef(chance_between(chance, -0.3f, 0.3f), chance_between(chance, -0.3f, 0.3f), 0);
	if (n > 1 && chance_of(chance, 2)) {
		glListBase(base);
		glCallLists(n, GL_UNSIGNED_BYTE, offsets);
		glListBase(0);
	} else if (n) {
		glCallList(base);
	}
	glPopMatrix();
}

/* Mesa 22.3 loses the current colour, normal and texture coordinates if evaluators generate some, so they are set
 * again. */
static void give_current(struct chance *chance)
{
	GLfloat color[4];

	chance_color(chance, color);
	glColor4fv(color);
	glNormal3f(0, 0, 1);
	glTexCoord4f(chance_between(chance, 0, 1), chance_between(chance, 0, 1), 0, 1);
}

void step_evaluator(struct chance *chance, struct program *program)
{
	GLfloat points[4][4][3], colors[2][2][4];
	GLfloat texture[2][2][2] = { { { 0, 0 }, { 0, 1 } }, { { 1, 0 }, { 1, 1 } } };

	(void)program;
	for (int j = 0; j < 4; j++)
		for (int i = 0; i < 4; i++) {
			points[j][i][0] = (float)j * 0.6f - 0.9f;
			points[j][i][1] = (float)i * 0.6f - 0.9f;
			points[j][i][2] = chance_between(chance, -0.6f, 0.6f);
		}
	for (int k = 0; k < 4; k++)
		chance_color(chance, colors[k / 2][k % 2]);
	glPushAttrib(GL_EVAL_BIT | GL_ENABLE_BIT);
	glMap2f(GL_MAP2_VERTEX_3, 0, 1, 12, 4, 0, 1, 3, 4, points[0][0]);
	glEnable(GL_MAP2_VERTEX_3);
	if (chance_of(chance, 2)) {
		glMap2f(GL_MAP2_COLOR_4, 0, 1, 8, 2, 0, 1, 4, 2, colors[0][0]);
		glEnable(GL_MAP2_COLOR_4);
	}
	if (chance_of(chance, 2)) {
		glMap2f(GL_MAP2_TEXTURE_COORD_2, 0, 1, 4, 2, 0, 1, 2, 2, texture[0][0]);
		glEnable(GL_MAP2_TEXTURE_COORD_2);
	}
	glEnable(GL_AUTO_NORMAL);
	glMapGrid2f((int)(2 + chance_below(chance, 10)), 0, 1, (int)(2 + chance_below(chance, 10)), 0, 1);
	glPushMatrix();
	place_in_view(chance, 1);
	give_current(chance);
	glEvalMesh2(ONE_OF(chance, GL_FILL, GL_FILL, GL_LINE, GL_POINT), 0, 2, 0, 2);
	glPopMatrix();
	glPopAttrib();
	give_current(chance);
}

void step_rectangle(struct chance *chance, struct program *program)
{
	(void)program;
	glPushMatrix();
	place_in_view(chance, 1);
	if (chance_of(chance, 2))
		glRecti(-1, -1, 1, 1);
	else
		glRectf(1, -1, -1, chance_between(chance, 0, 1));
	glPopMatrix();
}

/* Push some groups of state, or pop pushed ones. */
void step_attributes(struct chance *chance, struct program *program)
{
	if (program->pushed_attributes && chance_of(chance, 2)) {
		glPopAttrib();
		program->pushed_attributes--;
	} else if (program->pushed_attributes < 8) {
		glPushAttrib(ONE_OF(chance, GL_ALL_ATTRIB_BITS, GL_ENABLE_BIT, GL_LIGHTING_BIT, GL_TEXTURE_BIT,
		                    GL_POLYGON_BIT, GL_CURRENT_BIT, GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT,
		                    GL_FOG_BIT | GL_POINT_BIT | GL_LINE_BIT, GL_TRANSFORM_BIT | GL_VIEWPORT_BIT,
		                    GL_STENCIL_BUFFER_BIT | GL_SCISSOR_BIT));
		program->pushed_attributes++;
	}
}
