/*
 * Runs inside the traced program. Frames that are not recorded: before the first one asked for, and while recording is
 * paused.
 *
 * Objects and state are always recorded, with everything that they depend on. Only commands that do nothing but draw
 * are left out (those that overlay.txt calls "draws", unless the program puts them into a display list), and the ends
 * of frames. When recording begins, restore.h writes the results of earlier drawing into the trace.
 */
#pragma once

/** 1 while frames are not recorded. */
int skip_active(void);
/** 1 if a draw made now is left out. */
int skip_draws(void);
/** 1 while this thread compiles a display list, which must be recorded in full. */
int skip_is_compiling(void);
/** The next frame is not recorded, and so on until skip_end. */
void skip_begin(void);
void skip_end(void);
/** The program began or ended a display list. */
void skip_list_state(void);
