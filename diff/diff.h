/* relume diff. */
#pragma once

#include "scene/draw_names.h"

/** The verb, as in base/verbs.h. @param namer  tells what draws of a recording were: diff/ opens no replay */
int diff_main(int argc, char **argv, draw_namer *namer);
