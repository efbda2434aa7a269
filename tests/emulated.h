/** tests/emulated.h: what an emulated kernel cannot do. */
#pragma once

#include <stdbool.h>
#include <stdlib.h>

/** Whether a limit of memory counts the emulator's own, as qemu-user's does (tests/show/suites.py says so). */
static inline bool memory_is_emulated(void)
{
	return getenv("TESTS_EMULATED") != NULL;
}
