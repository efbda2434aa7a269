#include "capture/key.h"

#include <dlfcn.h>
#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/err.h"

enum { LOOK_EVERY_NS = 20000000, KEYMAP_BYTES = 32 };

/* Found at run time: nothing else in the command needs X. */
static struct {
	void *(*open_display)(const char *);
	int (*close_display)(void *);
	unsigned long (*string_to_keysym)(const char *);
	unsigned char (*keysym_to_keycode)(void *, unsigned long);
	unsigned long (*keycode_to_keysym)(void *, unsigned, int, int);
	int (*query_keymap)(void *, char *);
} x;

static int find_x(void)
{
	void *lib = dlopen("libX11.so.6", RTLD_NOW | RTLD_LOCAL);

	if (!lib)
		return -1;
	x.open_display = (void *(*)(const char *))dlsym(lib, "XOpenDisplay");
	x.close_display = (int (*)(void *))dlsym(lib, "XCloseDisplay");
	x.string_to_keysym = (unsigned long (*)(const char *))dlsym(lib, "XStringToKeysym");
	x.keysym_to_keycode = (unsigned char (*)(void *, unsigned long))dlsym(lib, "XKeysymToKeycode");
	x.keycode_to_keysym = (unsigned long (*)(void *, unsigned, int, int))dlsym(lib, "XkbKeycodeToKeysym");
	x.query_keymap = (int (*)(void *, char *))dlsym(lib, "XQueryKeymap");
	return x.open_display && x.close_display && x.string_to_keysym && x.keysym_to_keycode && x.keycode_to_keysym &&
		x.query_keymap ? 0 : -1;
}

int key_find(const char *option, const char *name, struct key_code *out)
{
	unsigned long symbol;
	void *display;

	if (find_x())
		return err_report(ERR_SYSTEM, NULL, "%s needs libX11.so.6", option);
	symbol = x.string_to_keysym(name);
	if (!symbol)
		return err_report(ERR_USAGE, NULL, "%s: X has no key '%s'; names are like F9, Pause, r", option, name);
	display = x.open_display(NULL);
	if (!display)
		return err_report(ERR_SYSTEM, NULL, "%s: no X display can be opened", option);
	out->code = x.keysym_to_keycode(display, symbol);
	out->state = x.keycode_to_keysym(display, (unsigned)out->code, 0, 0) != symbol &&
		x.keycode_to_keysym(display, (unsigned)out->code, 0, 1) == symbol ? KEY_SHIFT : 0;
	x.close_display(display);
	return out->code ? 0 : err_report(ERR_USAGE, NULL, "%s: this keyboard has no key '%s'", option, name);
}

static void watch(const char *name, int signal, pid_t whom)
{
	struct timespec pause = { 0, LOOK_EVERY_NS };
	void *display = x.open_display(NULL);
	int code = display ? x.keysym_to_keycode(display, x.string_to_keysym(name)) : 0, was = 0;

	while (code && getppid() == whom) {
		char down[KEYMAP_BYTES];
		int is;

		x.query_keymap(display, down);
		is = down[code / 8] >> (code % 8) & 1;
		if (is && !was)
			kill(whom, signal);
		was = is;
		nanosleep(&pause, NULL);
	}
}

pid_t key_watch(const char *name, int signal)
{
	pid_t whom = getpid(), watcher = fork();

	if (watcher == 0) {
		for (int number = 1; number < NSIG; number++) /* the command's handlers are not for this process */
			sigaction(number, &(struct sigaction){ .sa_handler = SIG_DFL }, NULL);
		prctl(PR_SET_PDEATHSIG, SIGKILL);
		watch(name, signal, whom);
		_exit(0);
	}
	return watcher;
}

void key_forget(pid_t watcher)
{
	if (watcher <= 0)
		return;
	kill(watcher, SIGKILL);
	while (waitpid(watcher, NULL, 0) < 0 && errno == EINTR)
		;
}
