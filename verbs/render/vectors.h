/*
 * Motion vectors: channels motion.X and motion.Y, in pixels, right and down: by how much the point that a pixel shows
 * has moved since the frame before; it was at the pixel minus this. motion.A is 1 where that is known, else 0, and the
 * vector is 0.
 *
 * They come from the recording alone: a point goes back through its draw's modelview into its mesh, to that mesh's
 * place in the frame before, and through that draw's matrices onto the picture. The draw before is its partner
 * (look/draws/followed.h); points of a mesh with other vertices are followed triangle by triangle. Draws without a
 * partner, and pixels that nothing drew, have no vector. What hid a point then does not count.
 */
#pragma once

#include "scene/scene.h"
#include "tracer/image/image.h"

/* The positions of everything in a frame. */
struct vectors_frame;

/** Note a frame for the next one. @return NULL: out of memory (reported) */
struct vectors_frame *vectors_note(const struct scene *scene);
void vectors_free(struct vectors_frame **frame);

/**
 * Add the channels.
 * @param before  the frame before, or NULL: there is none
 * @param img     of this scene, whole planes, with channels id and P
 * @return 0 or ERR_SYSTEM (reported)
 */
int vectors_add(const struct scene *scene, const struct vectors_frame *before, struct image *img);
