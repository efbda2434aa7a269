#include <stddef.h>

#include "tests/generated/generated.h"

/* Draw into a texture through a framebuffer object, then continue in the window with that texture bound. */
void step_framebuffer(struct chance *chance, struct program *program)
{
	unsigned slot = chance_below(chance, MOST_TEXTURES);
	int size = 32 << chance_below(chance, 3), depth = (int)chance_below(chance, 2);
	GLint viewport[4];
	GLuint framebuffer, renderbuffer = 0;

	renew_texture(program, slot, GL_TEXTURE_2D);
	glTexImage2D(GL_TEXTURE_2D, 0, (GLint)ONE_OF(chance, GL_RGBA8, GL_RGB8), size, size, 0, GL_RGBA,
	             GL_UNSIGNED_BYTE, NULL);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, (GLint)ONE_OF(chance, GL_NEAREST, GL_LINEAR));
	glBindTexture(GL_TEXTURE_2D, 0);
	glGenFramebuffers(1, &framebuffer);
	glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
	glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, program->textures[slot], 0);
	if (depth) {
		glGenRenderbuffers(1, &renderbuffer);
		glBindRenderbuffer(GL_RENDERBUFFER, renderbuffer);
		glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, size, size);
		glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, renderbuffer);
	}
	glGetIntegerv(GL_VIEWPORT, viewport);
	program->target_width = program->target_height = size;
	glViewport(0, 0, size, size);
	glPushAttrib(GL_SCISSOR_BIT | GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glDisable(GL_SCISSOR_TEST);
	glColorMask(1, 1, 1, 1);
	glDepthMask(1);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glPopAttrib();
	for (unsigned i = 1 + chance_below(chance, 3); i; i--)
		step_draw(chance, program);
	glBindFramebuffer(GL_FRAMEBUFFER, 0);
	glDeleteFramebuffers(1, &framebuffer);
	if (renderbuffer)
		glDeleteRenderbuffers(1, &renderbuffer);
	program->target_width = program->width;
	program->target_height = program->height;
	glViewport(viewport[0], viewport[1], viewport[2], viewport[3]);
	glBindTexture(GL_TEXTURE_2D, program->textures[slot]);
	glEnable(GL_TEXTURE_2D);
}
