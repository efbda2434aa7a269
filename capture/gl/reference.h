/* Runs inside the traced program. Reference frames: what the program shows, read back just before it is swapped
 * (ref.h). */
#pragma once

#include <stdint.h>

/** 1 if frame `frame` is to be read back. */
int reference_wanted(uint64_t frame);

/**
 * Read the current context's default framebuffer; changes no state that the program can see, keeps its pending errors
 * and errno. The pixels are kept until this thread's reference_write.
 * @param unswapped  1: the frame ends without a swap, and shows the buffer that is drawn to, which may be the front
 *                   buffer
 */
void reference_read(int width, int height, int unswapped);

/**
 * The frame has ended: write its pixels, if they are wanted.
 * @param frame  its number, from 1 on; 0: it is not in the trace
 */
void reference_write(uint64_t frame);
