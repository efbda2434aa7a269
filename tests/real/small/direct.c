/* EXT_direct_state_access: calls change the named object and leave bindings alone. One frame each; recorded by
 * test_small.py. */
#include "tests/trace/window.h"

static GLubyte texels[2][16][4];
static GLuint textures[2];

static void before(void)
{
	glMatrixLoadIdentityEXT(GL_PROJECTION);
	glMatrixLoadIdentityEXT(GL_MODELVIEW);
	glMatrixLoadIdentityEXT(GL_TEXTURE1);
	for (int i = 0; i < 32; i++)
		for (int k = 0; k < 4; k++)
			texels[i / 16][i % 16][k] = (GLubyte)(i * 53 + k * 91);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glColor3f(0.3f, 0.7f, 0.9f);
}

static void rectangle(float x, float y, float size)
{
	glBegin(GL_QUADS);
	for (int i = 0; i < 4; i++) {
		const float s = i == 1 || i == 2, t = i >= 2;

		glMultiTexCoord2f(GL_TEXTURE0, s, t);
		glMultiTexCoord2f(GL_TEXTURE1, s, t);
		glVertex2f(x + s * size, y + t * size);
	}
	glEnd();
}

static void matrices(void)
{
	static const float skewed[16] = { 1, 0.3f, 0, 0, 0, 0.8f, 0, 0, 0, 0, 1, 0, 0.1f, 0.1f, 0, 1 };
	const GLuint list = glGenLists(1);

	glMatrixMode(GL_TEXTURE);
	glMatrixOrthoEXT(GL_PROJECTION, -2, 2, -2, 2, -1, 1);
	glMatrixPushEXT(GL_MODELVIEW);
	glMatrixTranslatefEXT(GL_MODELVIEW, -1, -1, 0);
	glMatrixRotatefEXT(GL_MODELVIEW, 30, 0, 0, 1);
	glMatrixScalefEXT(GL_MODELVIEW, 1.5f, 1, 1);
	rectangle(-0.5f, -0.5f, 1);
	glMatrixPopEXT(GL_MODELVIEW);
	glNewList(list, GL_COMPILE);
	glMatrixMultfEXT(GL_MODELVIEW, skewed);
	rectangle(0.2f, 0.2f, 1);
	glMatrixLoadTransposefEXT(GL_MODELVIEW, skewed);
	glMatrixMultTransposefEXT(GL_MODELVIEW, skewed);
	rectangle(-1.5f, 0.5f, 0.8f);
	glEndList();
	glCallList(list);
	glMatrixMode(GL_MODELVIEW);
}

static void named_textures(void)
{
	glGenTextures(2, textures);
	for (int i = 0; i < 2; i++) {
		glTextureImage2DEXT(textures[i], GL_TEXTURE_2D, 0, GL_RGBA, 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels[i]);
		glTextureParameteriEXT(textures[i], GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
		glTextureParameterfEXT(textures[i], GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, i ? GL_NEAREST_MIPMAP_NEAREST : GL_NEAREST);
	}
	glGenerateTextureMipmapEXT(textures[1], GL_TEXTURE_2D);
	glTextureSubImage2DEXT(textures[0], GL_TEXTURE_2D, 0, 1, 1, 2, 2, GL_RGBA, GL_UNSIGNED_BYTE, texels[1]);
	rectangle(-0.3f, -0.9f, 0.5f);
	glCopyTextureSubImage2DEXT(textures[0], GL_TEXTURE_2D, 0, 2, 0, 30, 10, 2, 2);
	glEnable(GL_TEXTURE_2D);
	rectangle(-0.9f, 0.1f, 0.7f); /* nothing is bound */
	for (int i = 0; i < 2; i++) {
		glBindTexture(GL_TEXTURE_2D, textures[i]);
		rectangle(-0.9f + (float)i, i ? 0.1f : -0.9f, i ? 0.1f : 0.7f);
	}
	glBindTexture(GL_TEXTURE_2D, 0);
	glDisable(GL_TEXTURE_2D);
}

static void units(void)
{
	static const float plane[4] = { 0.7f, 0.2f, 0, 0.1f };

	for (int i = 0; i < 2; i++) {
		glBindMultiTextureEXT(GL_TEXTURE0 + (GLenum)i, GL_TEXTURE_2D, textures[i]);
		glMultiTexParameteriEXT(GL_TEXTURE0 + (GLenum)i, GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
		glEnableIndexedEXT(GL_TEXTURE_2D, (GLuint)i);
	}
	glMultiTexEnviEXT(GL_TEXTURE1, GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_ADD);
	glMatrixScalefEXT(GL_TEXTURE1, 2, 3, 1);
	rectangle(-0.9f, -0.9f, 0.8f);
	glMultiTexGeniEXT(GL_TEXTURE1, GL_S, GL_TEXTURE_GEN_MODE, GL_OBJECT_LINEAR);
	glMultiTexGenfvEXT(GL_TEXTURE1, GL_S, GL_OBJECT_PLANE, plane);
	glEnableIndexedEXT(GL_TEXTURE_GEN_S, 1);
	glMultiTexImage2DEXT(GL_TEXTURE1, GL_TEXTURE_2D, 0, GL_RGB, 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels[0]);
	rectangle(0, 0, 0.9f);
	glDisableIndexedEXT(GL_TEXTURE_GEN_S, 1);
	glDisableIndexedEXT(GL_TEXTURE_2D, 1);
	rectangle(0.1f, -0.9f, 0.6f);
	glDisableIndexedEXT(GL_TEXTURE_2D, 0);
}

static void buffers_and_programs(void)
{
	static const float at[6] = { -1, -1, 0, -1, -1, 0.5f }, other[2] = { 0.2f, -0.6f };
	static const char text[] =
		"!!ARBvp1.0\nMOV result.position, vertex.position;\nMOV result.color, program.local[3];\nEND\n";
	static const char *const shader =
		"uniform vec4 c; uniform mat2 m; void main() { gl_FragColor = c + vec4(m[0], m[1]); }";
	static const float m[4] = { 0.1f, 0.2f, 0.3f, 0 };
	GLuint buffer, program, of_glsl = glCreateProgram(), fragments = glCreateShader(GL_FRAGMENT_SHADER);

	glGenBuffers(1, &buffer);
	glNamedBufferDataEXT(buffer, sizeof(at), at, GL_STATIC_DRAW);
	glNamedBufferSubDataEXT(buffer, 2 * sizeof(float), sizeof(other), other);
	glGenProgramsARB(1, &program);
	glNamedProgramStringEXT(program, GL_VERTEX_PROGRAM_ARB, GL_PROGRAM_FORMAT_ASCII_ARB, sizeof(text) - 1, text);
	glNamedProgramLocalParameter4fEXT(program, GL_VERTEX_PROGRAM_ARB, 3, 0.9f, 0.5f, 0.1f, 1);
	glBindBuffer(GL_ARRAY_BUFFER, buffer);
	glVertexPointer(2, GL_FLOAT, 0, NULL);
	glBindBuffer(GL_ARRAY_BUFFER, 0);
	glEnableClientState(GL_VERTEX_ARRAY);
	glDrawArrays(GL_TRIANGLES, 0, 3);
	glDisableClientState(GL_VERTEX_ARRAY);
	glBindProgramARB(GL_VERTEX_PROGRAM_ARB, program);
	glEnable(GL_VERTEX_PROGRAM_ARB);
	rectangle(0.2f, -0.8f, 0.6f);
	glDisable(GL_VERTEX_PROGRAM_ARB);
	glShaderSource(fragments, 1, &shader, NULL);
	glCompileShader(fragments);
	glAttachShader(of_glsl, fragments);
	glLinkProgram(of_glsl);
	glProgramUniform4fEXT(of_glsl, glGetUniformLocation(of_glsl, "c"), 0.5f, 0.1f, 0.3f, 1);
	glProgramUniformMatrix2fvEXT(of_glsl, glGetUniformLocation(of_glsl, "m"), 1, GL_FALSE, m);
	glUseProgram(of_glsl);
	rectangle(-0.6f, 0.1f, 0.8f);
	glUseProgram(0);
}

static void framebuffers(void)
{
	GLuint framebuffer, depth;

	glGenFramebuffers(1, &framebuffer);
	glGenRenderbuffers(1, &depth);
	glTextureImage2DEXT(textures[0], GL_TEXTURE_2D, 0, GL_RGBA, 64, 48, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
	glNamedRenderbufferStorageEXT(depth, GL_DEPTH_COMPONENT24, 64, 48);
	glNamedFramebufferTexture2DEXT(framebuffer, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, textures[0], 0);
	glNamedFramebufferRenderbufferEXT(framebuffer, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
	rectangle(-0.9f, -0.9f, 0.4f);
	glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
	glClearColor(0.4f, 0.1f, 0.1f, 1);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glEnable(GL_DEPTH_TEST);
	rectangle(-0.5f, -0.5f, 1);
	glColor3f(1, 1, 0);
	rectangle(0, 0, 0.8f);
	glDisable(GL_DEPTH_TEST);
	glBindFramebuffer(GL_FRAMEBUFFER, 0);
	glClearColor(0, 0, 0, 0);
	glColor3f(1, 1, 1);
	glBindMultiTextureEXT(GL_TEXTURE0, GL_TEXTURE_2D, textures[0]);
	glEnableIndexedEXT(GL_TEXTURE_2D, 0);
	rectangle(-0.2f, -0.2f, 1);
	glDisableIndexedEXT(GL_TEXTURE_2D, 0);
}

int main(void)
{
	static void (*const frames[])(void) = { matrices, named_textures, units, buffers_and_programs, framebuffers };

	open_window();
	draw_frames(frames, sizeof(frames) / sizeof(frames[0]), before);
	expect(glGetError() == GL_NO_ERROR, "no error");
	return 0;
}
