/* Calls that GL refuses may point anywhere: the recorder must not look there as if it were safe. */
#include "window.h"

int main(void)
{
	const char *nowhere[1] = { (const char *)8 };

	open_window();
	glShaderSource(12345, 1, nowhere, NULL); /* there is no such shader */
	expect(glGetError() == GL_INVALID_VALUE, "no such shader");
	glShaderSource(12345, 1, (const char **)8, NULL);
	expect(glGetError() == GL_INVALID_VALUE, "nor now");
	end_frame();
	return 0;
}
