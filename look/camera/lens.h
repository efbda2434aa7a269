/* Cameras without a projection matrix, as ray_generation of a hook (tracer/hook/hook.h). */
#pragma once

struct camera;

/**
 * The text of a hook that generates a camera's rays. Eye space is the camera's own: it is at the origin and looks
 * along -z.
 * @param out  to be freed; NULL: the camera has a projection and needs no hook
 * @return 0 or ERR_SYSTEM (reported)
 */
int lens_text(const struct camera *camera, char **out);

/** The arrangement of two eyes' pictures: "side by side" or "left above right". NULL: there is one eye */
const char *lens_eyes(const struct camera *camera);
