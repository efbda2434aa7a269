/*
 * Runs inside the traced program. Where recording begins after frames that were left out (skip.h): what they have drawn goes into
 * the trace by value. Textures copied from the screen or drawn to, and the colours, depths and stencil values of the window are
 * read back from the driver and written as calls that set them.
 *
 * Not put back: renderbuffers, the accumulation buffer, pixels read into buffer objects, and what contexts other than the
 * current one show.
 */
#pragma once

/** A texture was copied from the screen, or attached to a framebuffer object. */
void restore_texture_copied(unsigned target);
void restore_texture_attached(unsigned target, unsigned name);

/**
 * Write what was drawn.
 * @param width, height  of the window; 0 where there is none
 */
void restore_drawn(int width, int height);

/**
 * Write calls that set the state that pixels pass through on their way in.
 * @param back  0: to its initial value (rows lie close); 1: back to the program's
 */
void restore_make_neutral(int back);
