/* Runs inside the traced program. A context was made current: what all the others do about it. */
#pragma once

void current_made_glx(int ok, void *display, unsigned long drawable, void *context);
void current_made_egl(unsigned ok, void *display, void *surface, void *context);
void current_made_osmesa(unsigned ok, void *context, int width, int height);
