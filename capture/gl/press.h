/*
 * Runs inside the traced program. Keys that `record --press` sends to it (capture/press.h).
 *
 * They are events that only the window which drew gets, over an X connection of our own: neither the focus nor the
 * pointer, nor another program on the same display, decides who gets them, and the server repeats none.
 */
#pragma once

#include <stdint.h>

/** @param list  as press_plan writes it; NULL: no keys. Kept. */
void press_begin(const char *list);

/**
 * Send what is due before the program draws a frame, and return once the server has passed it on.
 * @param frame   number of the program's next frame
 * @param window  X window that showed the last one; the event goes to the nearest of its ancestors that takes keys
 */
void press_before(uint64_t frame, unsigned long window);
