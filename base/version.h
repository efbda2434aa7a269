/* Relume's version: RELUME_VERSION, made from the file VERSION. Frames carry it; a frame of another version is rendered
 * again. */
#pragma once

#include "version_number.h"
