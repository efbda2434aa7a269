/*
 * Motion vectors. Channels motion.X and motion.Y are the movement, since the previous frame, of the point that a pixel
 * shows: in pixels, right and down, so the point was at the pixel minus this. motion.A is 1 where the movement is
 * known; elsewhere all three are 0.
 *
 * They come from the recording alone. A point is transformed by its draw's modelview back into its mesh, from there to
 * the mesh's place in the previous frame, and by the matrices of that frame's draw, its partner, onto the picture
 * (look/draws/followed.h). If a mesh's vertices have moved, points are followed triangle by triangle. Draws without a
 * partner, and pixels that nothing drew, have no vector. A point has one even if something hid it in the previous
 * frame.
 */
#pragma once

#include "scene/scene.h"
#include "tracer/image/image.h"

/* The positions of everything in a frame. */
struct vectors_frame;

/** Copy what the next frame's vectors_add needs of this one. @return NULL: out of memory (reported) */
struct vectors_frame *vectors_note(const struct scene *scene);
void vectors_free(struct vectors_frame **frame);

/**
 * Add the channels.
 * @param before  the previous frame; NULL: there is none
 * @param img     the scene's picture with whole planes, including channels id and P
 * @return 0 or ERR_SYSTEM (reported)
 */
int vectors_add(const struct scene *scene, const struct vectors_frame *before, struct image *img);
