/* Runs inside the traced program. */
#include "capture/gl/press.h"

#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <xcb/xcb.h>

#include "capture/gl/resolve.h"
#include "capture/write/clock.h"
#include "capture/write/report.h"

static const char *next; /* in the list */

/* Found at run time: the program may draw without X. */
#define XCB_FUNCTIONS(X) \
	X(connect) X(connection_has_error) X(disconnect) X(get_window_attributes) X(get_window_attributes_reply) \
	X(query_tree) X(query_tree_reply) X(send_event_checked) X(request_check) X(get_input_focus) X(get_input_focus_reply)
#define DECLARE(name) __typeof__(xcb_##name) *name;
static struct {
	XCB_FUNCTIONS(DECLARE)
} xcb;

static int find_xcb(void)
{
	void *lib = dlopen("libxcb.so.1", RTLD_LAZY | RTLD_LOCAL);

	if (!lib)
		return 0;
#define FIND(name) xcb.name = (__typeof__(xcb_##name) *)resolve_in(lib, "xcb_" #name);
	XCB_FUNCTIONS(FIND)
#define IS_THERE(name) && xcb.name
	return 1 XCB_FUNCTIONS(IS_THERE);
}

void press_begin(const char *list)
{
	next = list;
}

/* The first of a window and its ancestors whose key presses somebody takes; *root: the root window. 0: none */
static xcb_window_t find_taker(xcb_connection_t *c, xcb_window_t window, xcb_window_t *root)
{
	while (window) {
		xcb_get_window_attributes_reply_t *a = xcb.get_window_attributes_reply(c, xcb.get_window_attributes(c, window), NULL);
		xcb_query_tree_reply_t *tree = xcb.query_tree_reply(c, xcb.query_tree(c, window), NULL);
		const int takes = a && a->all_event_masks & XCB_EVENT_MASK_KEY_PRESS, is_known = a && tree && window != tree->root;
		const xcb_window_t parent = is_known ? tree->parent : 0;

		*root = tree ? tree->root : 0;
		free(a);
		free(tree);
		if (takes && is_known)
			return window;
		window = parent;
	}
	return 0;
}

/* A second request makes sure that the server has delivered the event before the program draws. */
static int send_key(xcb_connection_t *c, xcb_window_t window, xcb_window_t root, const unsigned long event[3])
{
	xcb_key_press_event_t key = {
		.response_type = (uint8_t)event[0], .detail = (uint8_t)event[1], .state = (uint16_t)event[2], .root = root,
		.event = window, .time = (xcb_timestamp_t)(clock_ns() / 1000000), .same_screen = 1,
	};
	const unsigned mask = event[0] == XCB_KEY_PRESS ? XCB_EVENT_MASK_KEY_PRESS : XCB_EVENT_MASK_KEY_RELEASE;
	xcb_generic_error_t *error = xcb.request_check(c, xcb.send_event_checked(c, 0, window, mask, (const char *)&key));
	const int is_sent = !error;

	free(error);
	free(xcb.get_input_focus_reply(c, xcb.get_input_focus(c), NULL));
	return is_sent;
}

/* "FRAME:TYPE:CODE:STATE ", in the order of frames */
static void send_due(xcb_connection_t *c, uint64_t frame, unsigned long window)
{
	xcb_window_t root = 0, taker = c ? find_taker(c, (xcb_window_t)window, &root) : 0;
	char *end;

	while (*next && strtoull(next, &end, 10) <= frame) {
		unsigned long event[3];
		int is_taken;

		for (int i = 0; i < 3; i++)
			event[i] = strtoul(end + 1, &end, 10);
		next = end + (*end == ' ');
		is_taken = taker && send_key(c, taker, root, event);
		if (event[0] == XCB_KEY_PRESS)
			report_key(is_taken);
	}
}

void press_before(uint64_t frame, unsigned long window)
{
	static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER; /* threads end frames at the same time */
	const int saved = errno;
	xcb_connection_t *c = NULL;

	if (!next) /* set before the first thread */
		return;
	pthread_mutex_lock(&lock);
	if (*next && strtoull(next, NULL, 10) <= frame) {
		if (find_xcb() && xcb.connection_has_error(c = xcb.connect(NULL, NULL))) {
			xcb.disconnect(c);
			c = NULL;
		}
		send_due(c, frame, window);
		if (c)
			xcb.disconnect(c);
	}
	pthread_mutex_unlock(&lock);
	errno = saved;
}
