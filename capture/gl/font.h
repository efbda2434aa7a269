/*
 * Runs inside the traced program. glXUseXFont makes display lists from a font of the X server. Readers of the trace may
 * lack the font, so the lists are written before the call, each character as the bitmap that the X server draws (GLX
 * 1.4 sec. 3.3.6). The server is queried as GLX does, through the Xlib that GLX has loaded.
 */
#pragma once

/** glXUseXFont has made lists out of a font's characters: write them, then the call. */
void font_used(unsigned long name, int first, int count, int list);
