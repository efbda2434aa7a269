/*
 * Assembly programs with texts that the GL refuses: the text before remains, and without one nothing is drawn. A frame
 * each; recorded by test_small.py.
 */
#include "tests/trace/window.h"

#define RED "!!ARBfp1.0 MOV result.color, { 0.9, 0.2, 0.1, 1 }; END"
static const char *const texts[][2] = {
	{ RED, "END\n" },
	{ NULL, "\nEND\n" },
	{ NULL, "# blanks and comments before the header\n \t!!ARBfp1.0 MOV result.color, { 0.1, 0.9, 0.2, 1 }; END" },
	{ NULL, "!!ARBvp1.0 MOV result.position, vertex.position; END" },
	{ RED, "!!ARBfp1.0 OPTION ARB_made_up; MOV result.color, { 0.1, 0.9, 0.2, 1 }; END" },
	{ RED, "!!ARBfp1.0 MOV result.color, state.made.up; END" },
	{ NULL, "!!ARBfp1.0 TWIST result.color, fragment.color; END" },
	{ RED, "!!FP1.0 MOVR o[COLR], f[COL0]; END" },
};
enum { N_TEXTS = sizeof(texts) / sizeof(*texts) };

static void set(const char *text)
{
	if (text)
		glProgramStringARB(GL_FRAGMENT_PROGRAM_ARB, GL_PROGRAM_FORMAT_ASCII_ARB, (GLsizei)strlen(text), text);
}

int main(void)
{
	GLuint programs[N_TEXTS];
	GLint place;

	open_window();
	glClearColor(0.1f, 0.2f, 0.3f, 1);
	glGenProgramsARB(N_TEXTS, programs);
	for (int i = 0; i < N_TEXTS; i++) {
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		glBindProgramARB(GL_FRAGMENT_PROGRAM_ARB, programs[i]);
		set(texts[i][0]);
		set(texts[i][1]);
		if (i % 2)
			glGetIntegerv(GL_PROGRAM_ERROR_POSITION_ARB, &place);
		expect((glGetError() == GL_NO_ERROR) == (i == 2), "only one text is valid");
		glEnable(GL_FRAGMENT_PROGRAM_ARB);
		glRectf(-0.7f, -0.8f, 0.6f, 0.9f);
		glDisable(GL_FRAGMENT_PROGRAM_ARB);
		expect((glGetError() == GL_NO_ERROR) == (texts[i][0] || i == 2), "only those with a valid text draw");
		glRectf(-0.2f, -0.3f, 0.1f, 0.1f);
		end_frame();
	}
	return 0;
}
