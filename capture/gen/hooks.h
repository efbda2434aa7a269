/* Runs inside the traced program. All that the generated thunks call; for them alone. */
#ifndef CAPTURE_GEN_HOOKS_H
#define CAPTURE_GEN_HOOKS_H

#include "capture/client/array_state.h"
#include "capture/client/arrays.h"
#include "capture/client/elements.h"
#include "capture/client/indices.h"
#include "capture/client/maps.h"
#include "capture/client/pixels.h"
#include "capture/client/runs.h"
#include "capture/format/sizes.h"
#include "capture/gl/context.h"
#include "capture/gl/current.h"
#include "capture/gl/drawable.h"
#include "capture/gl/font.h"
#include "capture/gl/frame.h"
#include "capture/gl/restore.h"
#include "capture/gl/skip.h"
#include "capture/stats.h"
#include "capture/write/values.h"
#include "capture/write/writer.h"
#include "real.h"
#include "tables/enums.h"

#endif
