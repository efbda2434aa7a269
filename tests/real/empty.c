/* Three frames; the second has a window without pixels, as its markers say. An argument gives another number of such
 * frames in its place. Recorded by test_empty.py. */
#include "tests/trace/window.h"

static void mark(const char *text)
{
	PFNGLSTRINGMARKERGREMEDYPROC marker = (PFNGLSTRINGMARKERGREMEDYPROC)glXGetProcAddress(
		(const GLubyte *)"glStringMarkerGREMEDY");

	expect(marker != NULL, "there are markers");
	marker(0, text);
}

int main(int argc, char **argv)
{
	const int n = argc > 1 ? atoi(argv[1]) : 1;

	open_window();
	for (int frame = 0; frame < n + 2; frame++) {
		glClearColor(frame ? 0.3f : 0, 0.5f, 0.2f, 1);
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		if (frame == 1 || frame == n + 1)
			mark(frame == 1 ? "relume:drawable 0 0" : "relume:drawable 64 48");
		end_frame();
	}
	return 0;
}
