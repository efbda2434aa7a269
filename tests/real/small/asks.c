/*
 * Programs that only query state, and extension names of features that became OpenGL 1.1: one frame each. Recorded by
 * test_small.py.
 */
#include "tests/trace/window.h"

void glGenTexturesEXT(GLsizei n, GLuint *names);
void glDeleteTexturesEXT(GLsizei n, const GLuint *names);
GLboolean glIsTextureEXT(GLuint name);

static GLuint textures[2];

static void before(void)
{
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glColor3f(1, 0.5f, 0.25f);
}

static void ask_framebuffers(void)
{
	GLint made;

	expect(!glIsFramebufferEXT(1) && !glIsRenderbufferEXT(1) && !glIsQuery(1), "none of these exists");
	/* an error: nothing is bound */
	glGetRenderbufferParameterivEXT(GL_RENDERBUFFER_EXT, GL_RENDERBUFFER_WIDTH_EXT, &made);
	expect(glGetError() == GL_INVALID_OPERATION, "nothing is bound");
	glRectf(-0.5f, -0.5f, 0.5f, 0.5f);
}

static void ask_shader_objects(void)
{
	const char *text = "void main() { gl_FragColor = vec4(0.2, 0.8, 0.4, 1.0); }";
	const GLhandleARB shader = glCreateShaderObjectARB(GL_FRAGMENT_SHADER_ARB), program = glCreateProgramObjectARB();
	GLhandleARB attached[4];
	GLint said = 0;
	GLsizei n = 0;
	char log[200];

	glShaderSourceARB(shader, 1, &text, NULL);
	glCompileShaderARB(shader);
	glGetInfoLogARB(shader, sizeof(log), &n, log);
	glAttachObjectARB(program, shader);
	glLinkProgramARB(program);
	glGetAttachedObjectsARB(program, 4, &n, attached);
	expect(n == 1 && attached[0] == shader, "the shader is attached");
	glGetObjectParameterivARB(program, GL_OBJECT_LINK_STATUS_ARB, &said);
	expect(said, "it links");
	glUseProgramObjectARB(program);
	expect(glGetHandleARB(GL_PROGRAM_OBJECT_ARB) == program, "it is used");
	glRectf(-0.5f, -0.5f, 0.5f, 0.5f);
	glUseProgramObjectARB(0);
}

static void show_textures(void)
{
	glEnable(GL_TEXTURE_2D);
	glColor3f(1, 1, 1);
	for (int i = 0; i < 2; i++) {
		glBindTextureEXT(GL_TEXTURE_2D, textures[i]);
		glRectf(i - 0.9f, -0.5f, (float)i, 0.5f);
	}
	glDisable(GL_TEXTURE_2D);
}

static void use_texture_objects(void)
{
	static const GLubyte colors[2][4] = { { 255, 0, 0, 255 }, { 0, 255, 0, 255 } };

	glGenTexturesEXT(2, textures);
	for (int i = 0; i < 2; i++) {
		glBindTextureEXT(GL_TEXTURE_2D, textures[i]);
		glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
		glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, colors[i]);
	}
	expect(glIsTextureEXT(textures[0]), "it is a texture");
	show_textures();
}

static void delete_texture_object(void)
{
	glDeleteTexturesEXT(1, textures);
	show_textures();
}

int main(void)
{
	static void (*const frames[])(void) = { ask_framebuffers, ask_shader_objects, use_texture_objects,
		                                delete_texture_object };

	open_window();
	draw_frames(frames, sizeof(frames) / sizeof(frames[0]), before);
	expect(glGetError() == GL_NO_ERROR, "no error");
	return 0;
}
