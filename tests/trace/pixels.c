/* Pixels in client memory under unpack state, in buffers, in mappings; texts; lists; errors that must remain the
 * program's. */
#include "capture/relume.h"
#include "window.h"

static unsigned char image[64];

int main(void)
{
	static const unsigned char stipple[128] = { 0x80, 1 };
	static const unsigned short lists[3] = { 1, 2, 3 };
	const char *source[2] = { "void main() {", " gl_FragColor = vec4(1); }//tail" };
	const int lengths[2] = { -1, 26 };
	unsigned texture, buffer, shader;
	unsigned char *mapped;

	open_window();
	for (int i = 0; i < 64; i++)
		image[i] = (unsigned char)i;
	glGenTextures(1, &texture);
	glBindTexture(GL_TEXTURE_2D, texture);
	glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 2, 2, 0, GL_RGB, GL_UNSIGNED_BYTE, image); /* alignment 4: 8 + 6 bytes */
	glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 2, 2, 0, GL_RGB, GL_UNSIGNED_BYTE, NULL);
	glPixelStorei(GL_UNPACK_ROW_LENGTH, 4);
	glPixelStorei(GL_UNPACK_SKIP_PIXELS, 1);
	glPixelStorei(GL_UNPACK_SKIP_ROWS, 1);
	glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
	glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 2, 2, GL_LUMINANCE, GL_UNSIGNED_BYTE, image); /* rows of 4: 4 + 4 + 3 */
	glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
	glPixelStorei(GL_UNPACK_SKIP_PIXELS, 0);
	glPixelStorei(GL_UNPACK_SKIP_ROWS, 0);
	glPolygonStipple(stipple);
	glBitmap(9, 2, 0, 0, 1, 0, image);
	glRasterPos2i(0, 0);
	glDrawPixels(1, 1, GL_RGBA, GL_UNSIGNED_SHORT_4_4_4_4, image);
	glCallLists(3, GL_UNSIGNED_SHORT, lists);

	glGenBuffers(1, &buffer);
	glBindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer);
	glBufferData(GL_PIXEL_UNPACK_BUFFER, 8, NULL, GL_STREAM_DRAW);
	mapped = glMapBuffer(GL_PIXEL_UNPACK_BUFFER, GL_WRITE_ONLY);
	memcpy(mapped, "\1\2\3\4\5\6\7", 8);
	glUnmapBuffer(GL_PIXEL_UNPACK_BUFFER);
	glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 1, 1, GL_LUMINANCE, GL_UNSIGNED_BYTE, (void *)5);
	glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);

	shader = glCreateShader(GL_FRAGMENT_SHADER);
	glShaderSource(shader, 2, source, lengths);
	glDeleteShader(shader);
	rtMaterialEXT(RT_GLASS_EXT, 0.9f, 1.5f);
	rtBuildKdTreeEXT();

	static const float matrices[8] = { 1, 2, 3, 4, 5, 6, 7, 8 };
	static float feedback[3];

	glUniformMatrix2fv(-1, 2, GL_FALSE, matrices); /* no program: an error, recorded with all values */
	expect(glGetError() == GL_INVALID_OPERATION, "no program, no uniform");
	glFeedbackBuffer(3, GL_2D, feedback);
	glPushMatrix();
	glClear(0x100000); /* an error that the program does not query before the frame is read back */
	end_frame();
	expect(glGetError() == GL_INVALID_VALUE, "the program's error is still there");
	expect(glGetError() == GL_NO_ERROR, "the recorder caused no error");
	return 0;
}
