/*
 * A scene as a camera sees it that the program never had (look/camera/camera.h). All of a frame that stands in eye
 * space is moved: what was drawn, lights, clip planes, planes that texture coordinates are made from. So each mode and
 * channel shows it as if the program had stood there, and light stands where it stood.
 *
 * - Skies, drawn around the viewer before all that has depth, stay around the viewer; an orthographic view of what was
 *   seen in perspective goes without.
 * - What is drawn in parallel projection before the first thing in perspective, as a gradient behind it all, stays as
 *   it is. What follows (HUDs), pixels and bitmaps, and what is drawn in other viewports, is left out. Where the
 *   program looks at the world in parallel projection, other such projections count as these.
 * - Scissors and clears of parts of the window are dropped: they were cut for another view.
 * - Vertices that programs place are moved behind their programs, which shade them as the recorded camera saw them.
 *   Where the recorded projection does not tell how they see, they are left out.
 * - Environments of sphere maps turn with the viewer, as OpenGL has them; those of reflection maps stand.
 */
#pragma once

#include "scene/scene.h"

struct camera;
struct look;

struct elsewhere {
	struct scene scene; /* a copy that borrows what has not changed */
	char told[200];     /* where the camera stands, for an attribute of the picture */
	uint32_t without;   /* draws that were left out, since programs place their vertices nobody knows how */
};

/**
 * @param scene   under its rules (look/apply/apply.h)
 * @param look    its world counts; NULL: none
 * @param number  of a turntable's picture
 * @param out     elsewhere_release before the scene is released
 * @return 0; ERR_INPUT (reported): the file cannot be meant for this scene; ERR_SYSTEM (reported)
 */
int elsewhere_make(const struct camera *camera, const struct look *look, const struct scene *scene, uint32_t number,
                   struct elsewhere *out);
void elsewhere_release(struct elsewhere *elsewhere);
