/*
 * Prints the keys that it receives, each with the number of the frame that it draws next: "3 press space 0".
 *
 *   keys FRAMES poll|wait|child|deaf
 *
 * poll: draws continuously. wait: draws its first frame, then one for each press. child: draws into a child window of
 * the one that receives keys. deaf: accepts none.
 */
#include <X11/keysym.h>

#include "window.h"

static int frame;

static void take_event(void)
{
	XEvent event;
	KeySym symbol;

	XNextEvent(display, &event);
	if (event.type != KeyPress && event.type != KeyRelease)
		return;
	symbol = XLookupKeysym(&event.xkey, 0);
	printf("%d %s %s %u\n", frame, event.type == KeyPress ? "press" : "release", XKeysymToString(symbol),
	       event.xkey.state);
	glClearColor(symbol == XK_space, event.type == KeyPress, 0, 1);
}

static void draw(void)
{
	glClear(GL_COLOR_BUFFER_BIT);
	end_frame();
	frame++;
}

int main(int argc, char **argv)
{
	const char *how = argc > 2 ? argv[2] : "";
	const int n = argc > 1 ? atoi(argv[1]) : 0, is_child = strcmp(how, "child") == 0;
	Window taker;

	setvbuf(stdout, NULL, _IOLBF, 0);
	open_window();
	taker = window;
	if (is_child) {
		taker = XCreateSimpleWindow(display, DefaultRootWindow(display), 0, 0, 90, 70, 0, 0, 0);
		XReparentWindow(display, window, taker, 5, 5);
		XMapWindow(display, taker);
	}
	if (strcmp(how, "deaf") != 0)
		XSelectInput(display, taker, KeyPressMask | KeyReleaseMask);
	while (frame < n) {
		draw();
		if (strcmp(how, "wait") == 0)
			take_event();
		while (XPending(display))
			take_event();
	}
	return 0;
}
