/*
 * A lit board with pieces, drawn into a framebuffer object of the window's size and brought to the window, with a score
 * drawn over it.
 *
 *   cc -o board_fbo corpus/board_fbo.c -lglut -lGLU -lGL -lm
 *
 * --by quad (default): one textured quad that covers the window. shader: the same by arrays and a trivial program, as
 * toolkits compose their windows. blit: glBlitFramebuffer. copy: the board is drawn in the window's back buffer, copied
 * by glCopyTexSubImage2D, and drawn again as the quad after a clear.
 */
#include <math.h>

#define GL_GLEXT_PROTOTYPES
#include "program.h"
#include <GL/glext.h>

static GLuint target, picture, depth, composer;

static int is_by(const char *way)
{
	return strcmp(program.by ? program.by : "quad", way) == 0;
}

static void make_target(void)
{
	glGenTextures(1, &picture);
	glBindTexture(GL_TEXTURE_2D, picture);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, PROGRAM_WIDTH, PROGRAM_HEIGHT, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
	if (is_by("copy"))
		return;
	glGenRenderbuffers(1, &depth);
	glBindRenderbuffer(GL_RENDERBUFFER, depth);
	glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, PROGRAM_WIDTH, PROGRAM_HEIGHT);
	glGenFramebuffers(1, &target);
	glBindFramebuffer(GL_FRAMEBUFFER, target);
	glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture, 0);
	glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
	if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
		exit(1);
}

static const char *const composing[] = {
	"#define highp\nattribute highp vec3 vertexCoord; attribute highp vec2 textureCoord; varying highp vec2 uv;\n"
	"uniform highp mat4 vertexTransform; uniform highp mat3 textureTransform;\n"
	"void main() { uv = (textureTransform * vec3(textureCoord, 1.0)).xy; gl_Position = vertexTransform * "
	"vec4(vertexCoord, 1.0); }",
	"#define highp\nvarying highp vec2 uv; uniform sampler2D textureSampler; uniform bool swizzle; uniform highp "
	"float opacity;\n"
	"void main() { highp vec4 c = texture2D(textureSampler, uv); c.a *= opacity; gl_FragColor = swizzle ? c.bgra : "
	"c; }",
};

static void make_composer(void)
{
	static const float vertex[16] = { 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, -1, -1, 0, 1 },
			   texture[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };

	composer = glCreateProgram();
	for (int i = 0; i < 2; i++) {
		GLuint shader = glCreateShader(i ? GL_FRAGMENT_SHADER : GL_VERTEX_SHADER);

		glShaderSource(shader, 1, &composing[i], NULL);
		glCompileShader(shader);
		glAttachShader(composer, shader);
	}
	glBindAttribLocation(composer, 0, "vertexCoord");
	glBindAttribLocation(composer, 1, "textureCoord");
	glLinkProgram(composer);
	glUseProgram(composer);
	glUniformMatrix4fv(glGetUniformLocation(composer, "vertexTransform"), 1, GL_FALSE, vertex);
	glUniformMatrix3fv(glGetUniformLocation(composer, "textureTransform"), 1, GL_FALSE, texture);
	glUniform1f(glGetUniformLocation(composer, "opacity"), 1);
	glUseProgram(0);
}

static void compose(void)
{
	static const float corners[12] = { 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0 }, texels[8] = { 0, 0, 1, 0, 1, 1, 0, 1 };

	glUseProgram(composer);
	glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, corners);
	glVertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, 0, texels);
	glEnableVertexAttribArray(0);
	glEnableVertexAttribArray(1);
	glDrawArrays(GL_TRIANGLE_FAN, 0, 4);
	glDisableVertexAttribArray(0);
	glDisableVertexAttribArray(1);
	glUseProgram(0);
}

static void init(void)
{
	make_target();
	make_composer();
	glEnable(GL_NORMALIZE);
	glEnable(GL_LIGHT0);
	program_perspective(40, 1, 50);
}

static void draw_board(void)
{
	float turn = program_moved(program.animate_camera, 0.05f);

	glClearColor(0.25f, 0.3f, 0.35f, 1);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	glEnable(GL_DEPTH_TEST);
	glEnable(GL_LIGHTING);
	glLoadIdentity();
	gluLookAt(11 * sinf(turn), 8, 11 * cosf(turn), 0, 0, 0, 0, 1, 0);
	glLightfv(GL_LIGHT0, GL_POSITION, (const float[]){ -6, 8, 3, 1 });
	for (int i = 0; i < 64; i++) {
		float x = (float)(i % 8) - 4, z = (float)(i / 8) - 4, shade = (i + i / 8) % 2 ? 0.85f : 0.35f;

		program_color(shade, shade * 0.85f, shade * 0.65f);
		glBegin(GL_QUADS);
		glNormal3f(0, 1, 0);
		glVertex3f(x, 0, z + 1);
		glVertex3f(x + 1, 0, z + 1);
		glVertex3f(x + 1, 0, z);
		glVertex3f(x, 0, z);
		glEnd();
	}
	for (int i = 0; i < 8; i++) {
		glPushMatrix();
		glTranslatef((float)(i * 3 % 8) - 3.5f, 0.4f, (float)i - 3.5f);
		program_color(i % 2 ? 0.9f : 0.2f, i % 2 ? 0.85f : 0.15f, i % 2 ? 0.75f : 0.15f);
		glutSolidSphere(0.4, 32, 24);
		glPopMatrix();
	}
	glDisable(GL_LIGHTING);
	glDisable(GL_DEPTH_TEST);
}

/** A rectangle in window coordinates from -1 to 1. */
static void draw_rectangle(float x0, float y0, float x1, float y1)
{
	glBegin(GL_QUADS);
	glTexCoord2f(0, 0);
	glVertex2f(x0, y0);
	glTexCoord2f(1, 0);
	glVertex2f(x1, y0);
	glTexCoord2f(1, 1);
	glVertex2f(x1, y1);
	glTexCoord2f(0, 1);
	glVertex2f(x0, y1);
	glEnd();
}

static void show_picture(void)
{
	if (is_by("blit")) {
		glBindFramebuffer(GL_READ_FRAMEBUFFER, target);
		glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		glBlitFramebuffer(0, 0, PROGRAM_WIDTH, PROGRAM_HEIGHT, 0, 0, PROGRAM_WIDTH, PROGRAM_HEIGHT,
		                  GL_COLOR_BUFFER_BIT, GL_NEAREST);
		return;
	}
	if (is_by("copy"))
		glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, PROGRAM_WIDTH, PROGRAM_HEIGHT);
	else
		glBindFramebuffer(GL_FRAMEBUFFER, 0);
	glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
	if (is_by("shader")) {
		compose();
		return;
	}
	glEnable(GL_TEXTURE_2D);
	glColor3f(1, 1, 1);
	draw_rectangle(-1, -1, 1, 1);
	glDisable(GL_TEXTURE_2D);
}

static void draw(void)
{
	if (target)
		glBindFramebuffer(GL_FRAMEBUFFER, target);
	draw_board();
	glMatrixMode(GL_PROJECTION);
	glPushMatrix();
	glLoadIdentity();
	glMatrixMode(GL_MODELVIEW);
	glLoadIdentity();
	show_picture();
	if (target)
		glBindFramebuffer(GL_FRAMEBUFFER, 0);
	glColor3f(0.9f, 0.8f, 0.2f);
	draw_rectangle(-0.95f, 0.85f, -0.5f, 0.93f);
	glMatrixMode(GL_PROJECTION);
	glPopMatrix();
	glMatrixMode(GL_MODELVIEW);
}

int main(int argc, char **argv)
{
	program_run(argc, argv, "board", init, draw);
	return 0;
}
