/*
 * Files that appear whole: written under a name of their own beside the final one, renamed when done.
 *
 * The name of an unfinished file is "FINAL.HOST-PID-N.part": writers on several machines never meet, and what a killed
 * process left can be told from what is being written.
 */
#ifndef BASE_PART_H
#define BASE_PART_H

#include <stddef.h>

/**
 * Name an unfinished file.
 * @param part, size  receive the name
 * @return 0 or ERR_SYSTEM (reported: the name is too long)
 */
int part_begin(const char *path, char *part, size_t size);

/** The file is whole: give it its final name. @return 0, or ERR_SYSTEM (reported; it is gone) */
int part_finish(const char *part, const char *path);

/** Remove an unfinished file. */
void part_drop(const char *part);

/** Remove every unfinished file of this process, which is about to end. No other call of these may be under way to its end. */
void part_drop_all(void);

/**
 * Remove what killed processes of this machine left in the folder of a file (no process of that number, untouched for a
 * minute: the process may be out of sight in another container).
 */
void part_sweep(const char *path);

#endif
