/* Giving scenes back. */
#pragma once

struct scene;

/** Give a scene back to who made it; NULL is allowed. Sets *scene to NULL. May run in any thread. */
void scene_release(struct scene **scene);
