/*
 * A scene seen by a camera that the program never had (look/camera/camera.h). Everything in eye space is moved:
 * draws, lights, clip planes, and planes that texture coordinates are generated from. Every mode and channel then
 * shows the scene as if the program's camera had been there, and lights stay where they were.
 *
 * - Skies, drawn around the viewer before everything with depth, stay around the viewer. An orthographic view of a
 * scene
 *   in perspective omits them.
 * - Draws in parallel projection before the first one in perspective, such as a background gradient, stay as they
 * are.
 *   Later ones (HUDs), pixels, bitmaps, and draws in other viewports are left out. If the program shows the world in
 *   parallel projection, draws in other parallel projections are treated the same way.
 * - Scissors and clears of parts of the window are dropped, since they belong to another view.
 * - Vertices that programs place are moved behind their programs, which shade them as seen by the recorded camera.
 * They
 *   are left out if the recorded projection does not determine their positions.
 * - Environments of sphere maps turn with the viewer, as in OpenGL; those of reflection maps stay.
 */
#pragma once

#include "scene/scene.h"

struct camera;
struct look;

struct elsewhere {
	struct scene scene;  /* a copy that borrows what has not changed */
	char placement[200]; /* the camera's position and direction, for an attribute of the picture */
	uint32_t without;    /* number of draws left out because programs place their vertices in an unknown way */
};

/**
 * @param scene   under its rules (look/apply/apply.h)
 * @param look    the source of the world's place; NULL: none
 * @param number  of a turntable's picture
 * @param out     call elsewhere_release before the scene is released
 * @return 0; ERR_INPUT (reported): the file cannot be meant for this scene; ERR_SYSTEM (reported)
 */
int elsewhere_make(const struct camera *camera, const struct look *look, const struct scene *scene, uint32_t number,
                   struct elsewhere *out);
void elsewhere_release(struct elsewhere *elsewhere);
