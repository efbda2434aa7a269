/* What a frame draws first, and then clears the depth of: a picture of what is far, whatever its size. */
#pragma once

#include <stdint.h>

struct scene;
struct scene_clear;

/** 1 where a part (x, y, width, height) is all of the window. */
int scene_is_whole(const struct scene *scene, const int32_t part[4]);

/** 1 where a clear reaches all of the window. */
int scene_clears_window(const struct scene *scene, const struct scene_clear *clear);

/**
 * How many of the first instances are a backdrop: they are followed by a clear of the window's depth that keeps the
 * colours, and by more instances than they are. (A view model is drawn after such a clear, too; what stands before it
 * is the world.)
 */
uint32_t scene_backdrop(const struct scene *scene);
