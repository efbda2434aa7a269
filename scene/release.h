/* Releases scenes. */
#pragma once

struct scene;

/** Give a scene back to its maker; NULL is allowed. Sets *scene to NULL. May run in any thread. */
void scene_release(struct scene **scene);
