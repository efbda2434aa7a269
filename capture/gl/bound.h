/*
 * Runs inside the traced program. Drawables that were bound to a texture (GLX_EXT_texture_from_pixmap, eglBindTexImage): what they show comes
 * from elsewhere, X for the most part, so the picture that the texture has then is written as a call that sets it.
 */
#pragma once

void bound_glx(void *display, unsigned long drawable);
/** @param result  of eglBindTexImage */
void bound_egl(unsigned result);
