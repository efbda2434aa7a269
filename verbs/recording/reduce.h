/*
 * Callbacks of `relume reduce` for reducing by a frame instead of a command. replay/ renders and scores nothing, so
 * others provide them.
 */
#pragma once

#include <stdint.h>

/**
 * Find the fault of a frame and note it in a file, which begins with the number of its call.
 * @param reference  as REF of `relume diff`
 * @return 0; ERR_USAGE (reported): no fault that can be traced to a call; or ERR_* (reported)
 */
typedef int reduce_note(const char *trace, const char *reference, uint64_t frame, const char *note);

/**
 * Does another recording have the same fault?
 * @param frame, call  where the fault would be in that recording
 * @return 1, 0, or ERR_* (reported)
 */
typedef int reduce_again(const char *note, const char *trace, uint64_t frame, uint64_t call);

/** The command. */
int reduce_main(int argc, char **argv, reduce_note *note, reduce_again *again);
