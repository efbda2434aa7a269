/*
 * Contexts that are created and destroyed; each draws several times from a large array of the program's. The recorder's
 * copy of the array must be released with the context, so that the process does not grow. Run by
 * tests/real/test_record_arrays.sh.
 */
#include <unistd.h>

#include "window.h"

enum { CONTEXTS = 16, SETTLED = 6, DRAWS = 3, CORNERS = 300000 };

static float corners[CORNERS][3];

static size_t resident_bytes(void)
{
	FILE *f = fopen("/proc/self/statm", "r");
	unsigned long all, resident;

	expect(f && fscanf(f, "%lu %lu", &all, &resident) == 2, "statm");
	fclose(f);
	return resident * (size_t)getpagesize();
}

int main(void)
{
	int attributes[] = { GLX_RGBA, GLX_DOUBLEBUFFER, None };
	XVisualInfo *visual;
	size_t settled = 0;

	open_window_of(attributes);
	visual = glXChooseVisual(display, DefaultScreen(display), attributes);
	corners[1][0] = corners[2][1] = 1;
	for (int i = 0; i < CONTEXTS; i++) {
		GLXContext context = glXCreateContext(display, visual, NULL, True);

		expect(context && glXMakeCurrent(display, window, context), "a context");
		glClear(GL_COLOR_BUFFER_BIT);
		glColor3f(1, (float)i / CONTEXTS, 0);
		glEnableClientState(GL_VERTEX_ARRAY);
		glVertexPointer(3, GL_FLOAT, 0, corners);
		for (int k = 0; k < DRAWS; k++)
			glDrawArrays(GL_TRIANGLES, 0, CORNERS);
		end_frame();
		glXMakeCurrent(display, None, NULL);
		glXDestroyContext(display, context);
		settled = i < SETTLED ? resident_bytes() : settled;
		expect(resident_bytes() < settled + 3 * sizeof(corners), "destroyed contexts hold no memory");
	}
	return 0;
}
