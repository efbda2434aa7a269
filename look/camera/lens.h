/* Cameras that no projection matrix has, as a hook's ray_generation (tracer/hook/hook.h). */
#pragma once

struct camera;

/**
 * The text of a hook that sends a camera's rays. Eye space is the camera's own: it stands at the origin and looks along
 * -z.
 * @param out  to be freed; NULL: the camera has a projection, and no hook is needed
 * @return 0 or ERR_SYSTEM (reported)
 */
int lens_text(const struct camera *camera, char **out);

/** How two eyes' pictures are arranged: "side by side" or "left above right". NULL: there is one eye */
const char *lens_eyes(const struct camera *camera);
