/*
 * Keys that the recorder presses for the user (`record --press`), counted in frames so that each run gets them at the
 * same moment:
 *
 *     space@10         pressed and released once frame 9 is shown: frame 10 is the first that can show it
 *     Left@20-30       held while frames 20 to 30 are drawn
 *     Control+s@5      with Shift, Control, Alt
 *
 * Keys have X's names (XStringToKeysym). The window that showed the frame gets them as events (capture/gl/press.h).
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

struct options_row;

struct press_list {
	const char **texts; /* owned; the texts are borrowed */
	size_t n, room;
};

/** An option's setter (base/options.h): add one. `out` is a struct press_list. @return 0 or ERR_* (reported) */
int press_take(const struct options_row *row, const char *text, void *out);

/**
 * Look the keys up on the keyboard of DISPLAY, and list them for the recorder.
 * @param quit_after  the program ends after this many frames, so no key may have a later one; 0: no end
 * @param out         receives the list, the caller's; NULL if there are no keys
 * @return 0, ERR_USAGE or ERR_SYSTEM (reported)
 */
int press_plan(const struct press_list *keys, uint64_t quit_after, char **out);

void press_free(struct press_list *keys);
