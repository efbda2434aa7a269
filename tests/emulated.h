/** tests/emulated.h: limitations of an emulated kernel. */
#pragma once

#include <stdbool.h>
#include <stdlib.h>

/** Whether memory limits include the emulator's own memory, as under qemu-user (set by tests/show/suites.py). */
static inline bool memory_is_emulated(void)
{
	return getenv("TESTS_EMULATED") != NULL;
}
