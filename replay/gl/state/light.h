#ifndef REPLAY_GL_STATE_LIGHT_H
#define REPLAY_GL_STATE_LIGHT_H

#include "replay/machine/commands.h"

gls_handler gls_glMaterialf, gls_glMaterialfv, gls_glMateriali, gls_glMaterialiv;

#endif
