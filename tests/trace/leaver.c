/*
 * leaver HOW: draws FRAMES frames and exits without any clean-up. HOW: _exit, abort, or fork: a child draws CHILD
 * frames on a display of its own and calls _exit, while its parent draws FRAMES more. Run by test_record_durable.sh.
 */
#include "window.h"

#include <sys/wait.h>
#include <unistd.h>

enum { FRAMES = 20, CHILD = 7, CODE = 9 };

static void draw(int frames)
{
	for (int frame = 0; frame < frames; frame++) {
		glClearColor(0, (float)frame / FRAMES, 0, 1);
		glClear(GL_COLOR_BUFFER_BIT);
		end_frame();
	}
}

int main(int argc, char **argv)
{
	const char *how = argc > 1 ? argv[1] : "";
	int status = 0;
	pid_t child = -1;

	if (strcmp(how, "fork") == 0 && (child = fork()) == 0) {
		open_window();
		draw(CHILD);
		_exit(CODE);
	}
	open_window();
	draw(FRAMES);
	glClear(GL_COLOR_BUFFER_BIT); /* an incomplete frame */
	if (strcmp(how, "_exit") == 0)
		_exit(CODE);
	if (strcmp(how, "abort") == 0)
		abort();
	if (strcmp(how, "fork") == 0) {
		expect(waitpid(child, &status, 0) == child && WEXITSTATUS(status) == CODE, "the child ended as it should");
		if ((child = fork()) == 0)
			_exit(CODE); /* an exiting copy of a recording process must not end the recording */
		expect(waitpid(child, &status, 0) == child && WEXITSTATUS(status) == CODE, "the copy ended as it should");
		draw(FRAMES);
	}
	return 0;
}
