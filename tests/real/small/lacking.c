/* A shader that reads what Relume does not do, and a call after the draw that draws nothing itself. Recorded by test_small.py. */
#include "tests/trace/window.h"

int main(void)
{
	const char *text = "#version 130\nvoid main() { gl_Position = ftransform(); gl_ClipDistance[0] = 1.0; }";
	GLuint shader, program;
	GLint links;

	open_window();
	shader = glCreateShader(GL_VERTEX_SHADER);
	program = glCreateProgram();
	glShaderSource(shader, 1, &text, NULL);
	glCompileShader(shader);
	glAttachShader(program, shader);
	glLinkProgram(program);
	glGetProgramiv(program, GL_LINK_STATUS, &links);
	expect(links, "it links");
	glUseProgram(program);
	glPushMatrix();
	glBegin(GL_TRIANGLES);
	glVertex2f(-0.5f, -0.5f);
	glVertex2f(0.5f, -0.5f);
	glVertex2f(0, 0.5f);
	glEnd();
	glPopMatrix();
	end_frame();
	return 0;
}
