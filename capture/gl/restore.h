/*
 * Runs inside the traced program. When recording begins after frames that were left out (skip.h), their results are
 * written into the trace. Textures copied from the screen or drawn to, and the window's colours, depths and stencil
 * values, are read back from the driver and written as calls that set them.
 *
 * Not restored: renderbuffers, the accumulation buffer, pixels read into buffer objects, and the windows of contexts
 * other than the current one.
 */
#pragma once

/** A texture was copied from the screen, or attached to a framebuffer object. */
void restore_texture_copied(unsigned target);
void restore_texture_attached(unsigned target, unsigned name);

/**
 * Write the results of earlier frames.
 * @param width, height  of the window; 0: there is none
 */
void restore_drawn(int width, int height);

/**
 * Write calls that set the state that pixels pass through on their way in.
 * @param back  0: to its initial value (rows tightly packed); 1: back to the program's
 */
void restore_make_neutral(int back);
