/*
 * Cryptomatte: which draw, mesh and texture each pixel shows, as compositors read it (J. Friedman and A. Jones, "Fully
 * automatic ID mattes with support for motion blur and transparency", 2015; specification 1.2.0). A pixel belongs
 * wholly to the object at its centre, as in channel id.
 */
#pragma once

#include "scene/scene.h"
#include "tracer/image/image.h"

/**
 * Add channels CryptoDraw00, CryptoMesh00 and CryptoTexture00, and their attributes with the manifest. .R is the
 * object's cryptomatte_hash as the bits of a float; .G is 1 where there is an object, else 0; .B and .A are 0.
 *
 * Draws are named "draw 12" by their number in the frame. Meshes and textures are named by their hashes, as `relume
 * scene --json` prints them, and keep their names from frame to frame. Draws without a texture are "untextured".
 *
 * @param img  with channel id, whole
 * @return 0 or ERR_SYSTEM (reported)
 */
int cryptomatte_add(const struct scene *scene, struct image *img);

/** MurmurHash3_x86_32 of a name, seed 0. As a float it is finite and normal: an exponent of 0 or 255 is changed. */
uint32_t cryptomatte_hash(const char *name);
