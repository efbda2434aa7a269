/*
 * A scene in a window of another size, as if the program had opened that one: viewports, scissors, clears, widths of
 * lines and sizes of points, factors of stipples, raster positions and zooms of pixels grow with it. Levels of detail
 * follow the new pixels, slopes of polygon offset the old ones.
 *
 * A window of another shape shows more to both sides, or above and below: what views of the whole window show grows as
 * far as the window lets it and is in the middle, HUDs too, and perspective views see on beyond it. A quad over all of
 * the window, as of a backdrop or a fade, covers the new one. Other views, scissors and pixels move along.
 *
 * These keep their pixels, and are counted:
 *   - polygons' stipples, which are 32 pixels wide in OpenGL;
 *   - programs that look at gl_FragCoord or write gl_PointSize, as they know the old window;
 *   - what the program drew before the scene begins, and shows through: each of its pixels becomes several.
 * Views whose vertices programs place see no farther than the recorded ones; they are counted, too.
 * Textures and framebuffer objects whose pictures the program draws with are as it made them.
 */
#pragma once

#include "scene/scene.h"

struct scaled {
	struct scene scene;     /* a copy that borrows what has not changed */
	struct scene_picture start;
	uint32_t stipples, programs, starts; /* materials that keep pixels; whether the beginning does */
	uint32_t narrow;                     /* views that do not see beyond the recorded window, where that was asked */
	struct scene_mesh *placed; /* [n_placed], owned: of pixels and bitmaps */
	uint32_t n_placed;
};

#define SCALED_MOST 16384u /* pixels on a side */

/**
 * @param factor  over 0: pixels of the new window for one of the recorded one; counts where size is 0
 * @param size    of the new window
 * @param out     scaled_release before the scene is released
 * @return 0; ERR_INPUT (reported): the picture has no pixel, or more than SCALED_MOST on a side; ERR_SYSTEM (reported)
 */
int scaled_make(const struct scene *scene, float factor, const uint32_t size[2], struct scaled *out);
void scaled_release(struct scaled *scaled);
