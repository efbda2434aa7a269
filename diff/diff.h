/* relume diff. */
#pragma once

#include "scene/draw_names.h"

/** The command, as in base/verbs.h. @param namer  names draws from their recording, as diff/ opens no replay */
int diff_main(int argc, char **argv, draw_namer *namer);
