/*
 * Runs inside the traced program. glXUseXFont makes display lists out of a font of the X server. Readers of the trace have no such
 * font, so the lists are written out before the call: each character as the bitmap that the X server draws of it (GLX 1.4
 * sec. 3.3.6). The server is asked as GLX itself asks it, through the Xlib that GLX has loaded.
 */
#pragma once

/** glXUseXFont has made lists out of a font's characters: write them, then the call. */
void font_used(unsigned long name, int first, int count, int list);
