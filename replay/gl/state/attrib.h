#ifndef REPLAY_GL_STATE_ATTRIB_H
#define REPLAY_GL_STATE_ATTRIB_H

#include <stdint.h>

#include "replay/machine/commands.h"

gls_handler gls_glPopAttrib;

/** A context as GL hands it out (all initial values of chapter 6); width and height of the first drawable may be 0. */
int gls_state_init(struct gls_state *st);
void gls_state_free(struct gls_state *st);
void gls_enable(struct gls_exec *x, struct gls_state *st, uint32_t cap, int on);

#endif
