/*
 * Relume's version: RELUME_VERSION, generated from the file VERSION. Frames record it; a frame of another version is
 * rendered again.
 */
#pragma once

#include "version_number.h"
