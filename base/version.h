/* The version of Relume, as it says itself and writes into frames: frames of another version are rendered again. */
#ifndef BASE_VERSION_H
#define BASE_VERSION_H

#define RELUME_VERSION "0.1"

#endif
