/*
 * A scene in a window of another size, as if the program had opened it with that size: viewports, scissors, clears,
 * line widths, point sizes, factors of stipples, raster positions and pixel zooms are scaled. Levels of detail follow
 * the new pixels, slopes of polygon offset the old ones.
 *
 * A window of another shape shows more at both sides, or above and below: views of the whole window, HUDs included,
 * are enlarged as far as the window allows and centred, and perspective views extend beyond. A quad over the whole
 * window, such as a backdrop or a fade, covers the new one. Other views, scissors and pixels move along.
 *
 * These keep their pixels, and are counted:
 *   - polygon stipples, which are 32 pixels wide in OpenGL
 *   - programs that read gl_FragCoord or write gl_PointSize, since they know the old window
 *   - the picture drawn before the scene begins, if it shows through: its pixels are enlarged
 *
 * Views whose vertices programs place do not extend beyond the recorded window; they are counted too. Textures and
 * pictures of framebuffer objects stay as the program made them.
 */
#pragma once

#include "scene/scene.h"

struct scaled {
	struct scene scene;     /* a copy that borrows what has not changed */
	struct scene_picture start;
	uint32_t stipples, programs, starts; /* materials that keep pixels; 1 if the earlier picture does */
	uint32_t narrow;                     /* views that should extend beyond the recorded window but do not */
	struct scene_mesh *placed; /* [n_placed], owned: meshes of pixels and bitmaps */
	uint32_t n_placed;
};

#define SCALED_MOST 16384u /* pixels on each side */

/**
 * @param factor  over 0: pixels of the new window for one of the recorded window; used if size is 0
 * @param size    of the new window
 * @param out     call scaled_release before the scene is released
 * @return 0; ERR_INPUT (reported): the picture has no pixel, or more than SCALED_MOST on a side; ERR_SYSTEM
 * (reported)
 */
int scaled_make(const struct scene *scene, float factor, const uint32_t size[2], struct scaled *out);
void scaled_release(struct scaled *scaled);
