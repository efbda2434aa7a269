/* Runs inside the traced program. A context was made current: notifies all other files. */
#pragma once

/** read: the drawable that pixels are read from, usually the same */
void current_made_glx(int ok, void *display, unsigned long drawable, unsigned long read, void *context);
void current_made_egl(unsigned ok, void *display, void *surface, void *read, void *context);
void current_made_osmesa(unsigned ok, void *context, int width, int height);
