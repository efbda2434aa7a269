/*
 * Runs inside the traced program. Frames that are not recorded: before the first one asked for, and while recording is paused.
 *
 * Objects and state are recorded all the time, with all that they depend on. Only what does nothing but draw is left out (the
 * commands that overlay.txt calls "draws", unless the program puts them into a display list), and with it the frames' ends.
 * Where recording begins, restore.h puts what drawing has left behind into the trace.
 */
#pragma once

/** 1 while frames are not recorded. */
int skip_active(void);
/** 1 where a draw made now is left out. */
int skip_draws(void);
/** 1 where this thread's program makes a display list: it must be whole. */
int skip_is_compiling(void);
/** The next frame is not recorded, and so on until skip_end. */
void skip_begin(void);
void skip_end(void);
/** The program began or ended a display list. */
void skip_list_state(void);
