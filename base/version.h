/* Relume's version. Frames carry it; a frame of another version is rendered again. */
#pragma once

#define RELUME_VERSION "0.1"
