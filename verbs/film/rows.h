/* Processes the rows of a picture on all cores. */
#pragma once

#include <stdint.h>

/**
 * Call run(user, y) for y = 0 .. height - 1, on several threads. The calls must not depend on each other. If no thread
 * can be started, the caller's does them all.
 */
void rows_each(uint32_t height, void (*run)(const void *user, uint32_t y), const void *user);
