/*
 * A shader that reads something unsupported by Relume, followed by a call that draws nothing; then an unsupported
 * texture, which must not be blamed on the shader. Recorded by test_small.py.
 */
#include "tests/trace/window.h"

int main(void)
{
	const char *text = "#version 130\nvoid main() { gl_Position = ftransform(); gl_ClipDistance[0] = 1.0; }";
	static const GLubyte texels[6 * 4];
	GLuint shader, program, texture;
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
	glUseProgram(0);
	glTexImage3D(GL_PROXY_TEXTURE_CUBE_MAP_ARRAY, 0, GL_RGB, 1, 1, 6, 0, GL_RGB, GL_UNSIGNED_BYTE, NULL);
	glGenTextures(1, &texture);
	glBindTexture(GL_TEXTURE_CUBE_MAP_ARRAY, texture);
	glTexImage3D(GL_TEXTURE_CUBE_MAP_ARRAY, 0, GL_RGB, 1, 1, 6, 0, GL_RGB, GL_UNSIGNED_BYTE, texels);
	glTexParameteri(GL_TEXTURE_CUBE_MAP_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	expect(glGetError() == GL_NO_ERROR, "no error");
	end_frame();
	return 0;
}
