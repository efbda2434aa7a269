/*
 * Arrays of textures, which programs look up by a layer (EXT_texture_array): a frame each; recorded by test_small.py.
 */
#include "tests/trace/window.h"

enum { SIDE = 16, LAYERS = 5 };

static GLint place;

/* A texel of a layer: a wedge in its own colours. */
static void make_layer(int layer, int side, GLubyte (*out)[4])
{
	for (int i = 0; i < side * side; i++) {
		const int x = i % side * SIDE / side, y = i / side * SIDE / side;

		out[i][0] = (GLubyte)(40 + 40 * layer);
		out[i][1] = (GLubyte)((x * 15 + layer * 60) & 255);
		out[i][2] = (GLubyte)(y * (layer + 2) * 8 & 255);
		out[i][3] = 255;
	}
}

static void use_array(GLenum min, GLenum mag)
{
	static GLubyte texels[LAYERS][SIDE * SIDE][4];
	GLuint texture;

	for (int layer = 0; layer < LAYERS; layer++)
		make_layer(layer, SIDE, texels[layer]);
	glGenTextures(1, &texture);
	glBindTexture(GL_TEXTURE_2D_ARRAY, texture);
	glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, (GLint)min);
	glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, (GLint)mag);
	glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_RGBA8, SIDE, SIDE, LAYERS, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
}

/* Columns of quads, each with another layer; rows of other sizes. */
static void draw_layers(void)
{
	for (int row = 0; row < 3; row++)
		for (int column = 0; column < 8; column++) {
			const float size = 0.24f / (float)(1 + 2 * row), x = -0.98f + 0.245f * (float)column, y = -0.9f + 0.6f * (float)row;

			glUniform1f(place, -0.7f + 0.83f * (float)column); /* -0.7 to 5.1: beyond both ends, and halves between */
			glBegin(GL_QUADS);
			for (int i = 0; i < 4; i++) {
				const float right = i == 1 || i == 2, up = i > 1;

				glTexCoord2f(right * 1.3f - 0.1f, up * 1.3f - 0.1f);
				glVertex2f(x + right * size, y + up * size * 2);
			}
			glEnd();
		}
}

static void nearest(void)
{
	use_array(GL_NEAREST, GL_NEAREST);
	draw_layers();
}

static void linear(void)
{
	use_array(GL_LINEAR, GL_LINEAR);
	glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
	draw_layers();
}

static void levels(void)
{
	static const float small[LAYERS][4][3] = { { { 1, 0, 0 } }, { { 0, 1, 0 } }, { { 0, 0, 1 } }, { { 1, 1, 0 } } };

	use_array(GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR);
	glGenerateMipmap(GL_TEXTURE_2D_ARRAY);
	glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 3, 0, 0, 0, 2, 2, LAYERS, GL_RGB, GL_FLOAT, small);
	draw_layers();
}

static void parts(void)
{
	static GLubyte texels[SIDE * SIDE / 4][4];

	use_array(GL_NEAREST, GL_NEAREST);
	make_layer(9, SIDE / 2, texels);
	glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 3, 2, 1, SIDE / 2, SIDE / 2, 1, GL_RGBA, GL_UNSIGNED_BYTE, texels);
	glRasterPos2f(-1, -1);
	glDrawPixels(SIDE / 2, SIDE / 2, GL_RGBA, GL_UNSIGNED_BYTE, texels);
	glCopyTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 5, 5, 3, 0, 0, SIDE / 2, SIDE / 2);
	draw_layers();
}

static void drawn_to(void)
{
	GLuint object;
	GLint texture;

	use_array(GL_LINEAR, GL_LINEAR);
	glGetIntegerv(GL_TEXTURE_BINDING_2D_ARRAY, &texture);
	glGenFramebuffers(1, &object);
	glBindFramebuffer(GL_FRAMEBUFFER, object);
	glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, (GLuint)texture, 0, 2);
	glViewport(0, 0, SIDE, SIDE);
	glClearColor(0.9f, 0.1f, 0.5f, 1);
	glClear(GL_COLOR_BUFFER_BIT);
	glEnable(GL_SCISSOR_TEST);
	glScissor(4, 6, 5, 3);
	glClearColor(0.1f, 0.9f, 0.5f, 1);
	glClear(GL_COLOR_BUFFER_BIT);
	glDisable(GL_SCISSOR_TEST);
	glBindFramebuffer(GL_FRAMEBUFFER, 0);
	glViewport(0, 0, 64, 48);
	draw_layers();
}

static void use_program(void)
{
	static const char *vertex = "void main() { gl_TexCoord[0] = gl_MultiTexCoord0; gl_Position = ftransform(); }";
	static const char *fragment = "#version 120\n#extension GL_EXT_texture_array : enable\n"
	                              "uniform sampler2DArray layers;\nuniform float place;\n"
	                              "void main() { gl_FragColor = texture2DArray(layers, vec3(gl_TexCoord[0].st, place)); }";
	const GLuint program = glCreateProgram(), v = glCreateShader(GL_VERTEX_SHADER), f = glCreateShader(GL_FRAGMENT_SHADER);

	glShaderSource(v, 1, &vertex, NULL);
	glShaderSource(f, 1, &fragment, NULL);
	glCompileShader(v);
	glCompileShader(f);
	glAttachShader(program, v);
	glAttachShader(program, f);
	glLinkProgram(program);
	glUseProgram(program);
	place = glGetUniformLocation(program, "place");
}

int main(void)
{
	static void (*const frames[])(void) = { nearest, linear, levels, parts, drawn_to };

	open_window();
	if (!strstr((const char *)glGetString(GL_EXTENSIONS), "GL_EXT_texture_array")) {
		fprintf(stderr, "skipped: this GL has no GL_EXT_texture_array\n");
		return 77;
	}
	use_program();
	for (int i = 0; i < 5; i++) {
		glClearColor(0.1f, 0.2f, 0.3f, 1);
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		frames[i]();
		end_frame();
	}
	return 0;
}
