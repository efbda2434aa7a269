/* One picture of a scene: under the rules, from the recorded camera or another, with what a report is told of it. */
#pragma once

#include "render/settings.h"
#include "scene/scene.h"
#include "tracer/frame/trace.h"

/**
 * @param tracer  traces it; one picture at a time
 * @param number  the picture's: the frame's, or of a turntable
 * @param img     filled; image_free, also after an error
 * @return 0; ERR_INPUT: the camera's file is not for this frame; ERR_SYSTEM (reported)
 */
int picture_render(const struct settings *settings, struct tracer *tracer, const struct scene *scene, uint64_t number, struct image *img);
