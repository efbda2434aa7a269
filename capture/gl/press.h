/*
 * Runs inside the traced program. Keys that `record --press` sends to it (capture/press.h).
 *
 * They are sent as events to the window that drew, over an X connection of our own: neither focus nor pointer, nor
 * another program on the same display, affects who gets them, and the server does not repeat them.
 */
#pragma once

#include <stdint.h>

/** @param list  as press_plan writes it; NULL: no keys. Kept. */
void press_begin(const char *list);

/**
 * Send the events due before the program draws a frame, and return once the server has delivered them.
 * @param frame   number of the program's next frame
 * @param window  X window that showed the last one; the event goes to the nearest of its ancestors that takes keys
 */
void press_before(uint64_t frame, unsigned long window);
