/* Giving scenes back. */
#ifndef SCENE_RELEASE_H
#define SCENE_RELEASE_H

struct scene;

/** Give a scene back to who made it; NULL is allowed. Sets *scene to NULL. May run in any thread. */
void scene_release(struct scene **scene);

#endif
