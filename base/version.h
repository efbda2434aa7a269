/* Relume's version. Frames carry it; a frame of another version is rendered again. */
#ifndef BASE_VERSION_H
#define BASE_VERSION_H

#define RELUME_VERSION "0.1"

#endif
