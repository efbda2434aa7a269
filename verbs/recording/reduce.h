/* What `relume reduce` asks where it is given a frame instead of a command. replay/ renders and scores nothing: others
 * answer. */
#pragma once

#include <stdint.h>

/**
 * Find the fault of a frame and note it in a file, which begins with the number of its call.
 * @param reference  as REF of `relume diff`
 * @return 0; ERR_USAGE (reported): there is none of which more could be said; or ERR_* (reported)
 */
typedef int reduce_note(const char *trace, const char *reference, uint64_t frame, const char *note);

/**
 * Has another recording the same fault?
 * @param frame, call  which it is there
 * @return 1, 0, or ERR_* (reported)
 */
typedef int reduce_again(const char *note, const char *trace, uint64_t frame, uint64_t call);

/** The verb. */
int reduce_main(int argc, char **argv, reduce_note *note, reduce_again *again);
