/* A backdrop: a picture of distant things that a frame draws first, of whatever size, before it clears the depth. */
#pragma once

#include <stdint.h>

struct scene;
struct scene_clear;

/** 1 if a rectangle (x, y, width, height) covers the whole window. */
int scene_is_whole(const struct scene *scene, const int32_t part[4]);

/** 1 if a clear reaches the whole window. */
int scene_clears_window(const struct scene *scene, const struct scene_clear *clear);

/**
 * Number of leading instances that are a backdrop. They are followed by a clear of the window's depth that keeps the
 * colours, and then by more instances than they are themselves. (The same clear also precedes a view model, but there
 * the instances before it are the world.)
 */
uint32_t scene_backdrop(const struct scene *scene);
