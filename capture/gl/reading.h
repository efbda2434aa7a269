/*
 * Runs inside the traced program. Reading pixels back from the driver.
 *
 * All state that reading depends on is set to its initial value and put back. Queries go to the driver, so no cache can
 * be wrong.
 */
#pragma once

enum { READING_PACK = 6, READING_TRANSFER = 10 };

struct reading_state { /* the program's */
	int pack[READING_PACK], map_color, pack_buffer, pack_invert, framebuffer, draw_framebuffer, read_buffer;
	float transfer[READING_TRANSFER];
};

/** Set the state, and bind the window's framebuffer. `s` is all zeros. */
void reading_begin(struct reading_state *s);
void reading_end(const struct reading_state *s);

/**
 * Call in between: reduce the given size to that of the window's buffers. glReadPixels leaves memory unchanged for
 * pixels that they do not have (Mesa 22.3.6).
 */
void reading_held(int *width, int *height);

/**
 * Call in between: read what the window shows, RGBA with 8 bits each, rows from the bottom up; the mean of a pixel's
 * samples.
 */
void reading_colors(int width, int height, void *pixels);
