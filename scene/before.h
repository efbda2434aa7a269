/*
 * What a scene begins with where that is not made yet: the scene before it. Many programs clear no colours and draw
 * over all of them, and only who renders a scene finds out whether something from before shows. Threads may share one.
 */
#pragma once

struct scene;
struct scene_before;

/** Takes a reference to the scene before. @return NULL: out of memory, and the reference is given back */
struct scene_before *scene_before_make(struct scene *scene);

/** Set *before to NULL; NULL is allowed. Nobody uses it any more. */
void scene_before_free(struct scene_before **before);

/** How many scenes are held in a row: each may hold what it begins with. NULL counts as none. */
unsigned scene_before_held(struct scene_before *before);

/** The scene, until scene_before_done. @return NULL: it was given back, as it does not show */
const struct scene *scene_before_use(struct scene_before *before);

void scene_before_done(struct scene_before *before);

/** Say whether it shows, as was found out. Where it does not, the scene is given back as soon as nobody uses it. */
void scene_before_settle(struct scene_before *before, int shows);

/** Whether it was found to show. NULL does not. */
int scene_before_shows(struct scene_before *before);
