#ifndef REPLAY_GL_STATE_MATRIX_H
#define REPLAY_GL_STATE_MATRIX_H

#include "replay/machine/commands.h"

struct gls_matrix_stack;

gls_handler gls_glTranslatef, gls_glTranslated, gls_glRotatef, gls_glRotated, gls_glScalef, gls_glScaled, gls_glMultMatrixf,
	gls_glMultMatrixd, gls_glLoadIdentity, gls_glLoadMatrixf, gls_glLoadMatrixd, gls_glPushMatrix, gls_glPopMatrix, gls_glMatrixMode;

struct gls_matrix_stack *gls_current_stack(struct gls_state *st);

#endif
