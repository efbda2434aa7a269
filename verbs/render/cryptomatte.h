/*
 * Cryptomatte: which draw, mesh and texture each pixel shows, as compositors read it (J. Friedman and A. Jones, "Fully
 * automatic ID mattes with support for motion blur and transparency", 2015; specification 1.2.0). A pixel belongs
 * wholly to the object at its centre, as in channel id.
 */
#pragma once

#include "scene/scene.h"
#include "tracer/image/image.h"

/**
 * Add channels CryptoDraw00, CryptoMesh00 and CryptoTexture00 (.R: the object's number, .G: 1 where there is one), and
 * their attributes with the manifest.
 *
 * Draws are named "draw 12" by their number in the frame, meshes and textures by their hashes as `relume scene --json`
 * prints them: these are the same from frame to frame. Draws without a texture are "untextured".
 *
 * @param img  with channel id, whole
 * @return 0 or ERR_SYSTEM (reported)
 */
int cryptomatte_add(const struct scene *scene, struct image *img);

/** MurmurHash3_x86_32 of a name, seed 0, with the exponent changed where the bits were no finite float. */
uint32_t cryptomatte_hash(const char *name);
