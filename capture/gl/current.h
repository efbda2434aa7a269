/* Runs inside the traced program. A context was made current: what all the others do about it. */
#pragma once

/** read: what pixels are read from, as a rule the same */
void current_made_glx(int ok, void *display, unsigned long drawable, unsigned long read, void *context);
void current_made_egl(unsigned ok, void *display, void *surface, void *read, void *context);
void current_made_osmesa(unsigned ok, void *context, int width, int height);
