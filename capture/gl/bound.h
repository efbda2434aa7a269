/*
 * Runs inside the traced program. Drawables bound to a texture (GLX_EXT_texture_from_pixmap, eglBindTexImage). Their
 * content comes from elsewhere, mostly from X, so the texture's image at that time is written as a call that sets it.
 */
#pragma once

void bound_glx(void *display, unsigned long drawable);
/** @param result  of eglBindTexImage */
void bound_egl(unsigned result);
