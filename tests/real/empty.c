/* Three frames, the second of a window without pixels, as its markers say. Recorded by test_empty.py. */
#include "tests/trace/window.h"

static void mark(const char *text)
{
	PFNGLSTRINGMARKERGREMEDYPROC marker = (PFNGLSTRINGMARKERGREMEDYPROC)glXGetProcAddress((const GLubyte *)"glStringMarkerGREMEDY");

	expect(marker != NULL, "there are markers");
	marker(0, text);
}

int main(void)
{
	open_window();
	for (int frame = 0; frame < 3; frame++) {
		glClearColor(0.3f * (float)frame, 0.5f, 0.2f, 1);
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		if (frame)
			mark(frame == 1 ? "relume:drawable 0 0" : "relume:drawable 64 48");
		end_frame();
	}
	return 0;
}
