/* Processes the rows of a picture on all cores. */
#pragma once

#include <stdint.h>

/** Rows are independent, so no result depends on the thread. If no thread can be started, the caller does them all. */
void rows_each(uint32_t height, void (*run)(const void *user, uint32_t y), const void *user);
