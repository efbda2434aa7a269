/*
 * The wavefront: a scene becomes a picture on a device.
 *
 * A frame starts with the vertex stage and acceleration structures, and is then drawn in bands of rows. Buffers of
 * pixels and of their fragments have the size of a band, so they stay in a CPU's caches, and memory does not grow with
 * the frame. Within a band, segments (prepare.h) are drawn in draw order. A segment clears, traces camera rays, gathers
 * and shades fragments, relights those whose shadow rays were stopped, follows mirrors, and applies the per-fragment
 * operations. A column with more fragments than one camera pass delivers takes several passes.
 */
#pragma once

#include "scene/scene.h"
#include "tracer/device/device.h"
#include "tracer/frame/common/options.h"
#include "tracer/image/image.h"

struct tracer;

/** @param dev  kept until tracer_destroy. @return 0 or ERR_SYSTEM (reported) */
int tracer_create(struct tracer **out, struct device *dev);
void tracer_destroy(struct tracer **tracer);

/** Share mesh trees with other tracers of the process from now on. @param cache kept until tracer_destroy */
void tracer_share(struct tracer *tracer, struct blas_cache *cache);

/** Check a list of channel groups. @return 0, or ERR_USAGE (reported) if it has an unknown name. */
int tracer_check_aov(const char *aov);

/**
 * Render one frame.
 * @param img  empty; receives the channels and the attributes of the scene and device (relume:frame, relume:device,
 *             relume:encoding, camera); free with image_free
 * @return 0 or ERR_SYSTEM (reported)
 */
int tracer_render(struct tracer *tracer, const struct scene *scene, const struct tracer_options *options,
                  struct image *img);

/**
 * Render GL's picture of a scene, rounded to the frame buffer's bits, without shadows or mirrors.
 * @param picture  receives the picture; the caller sets the scene's size and allocates the arrays
 * @return 0 or ERR_SYSTEM (reported)
 */
int tracer_render_picture(struct tracer *tracer, const struct scene *scene, struct scene_picture *picture);

/** Counts of what tracing has added so far. */
const struct tracer_added *tracer_added(const struct tracer *tracer);

/** Add the difference between two moments to a sum. */
void tracer_added_add(struct tracer_added *sum, const struct tracer_added *now, const struct tracer_added *before);

/** Counts of what the tracer could not draw so far. */
const struct tracer_undrawn *tracer_undrawn(const struct tracer *tracer);
