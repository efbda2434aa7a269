/*
 * The preceding scene, kept instead of pixels: it is rendered only if they show. Many programs clear no colours and
 * draw over all of them, and only the renderer of a scene finds out whether older pixels show through. Threads may
 * share one.
 */
#pragma once

struct scene;
struct scene_before;

/** Takes over a reference to the preceding scene. @return NULL: out of memory; the reference is then released */
struct scene_before *scene_before_make(struct scene *scene);

/** Set *before to NULL; NULL is allowed. Nobody may use it any more. */
void scene_before_free(struct scene_before **before);

/** Length of the chain of scenes held: each may hold the one before it. 0 for NULL. */
unsigned scene_before_held(struct scene_before *before);

/** The scene, valid until scene_before_done. @return NULL: already released, as it does not show */
const struct scene *scene_before_use(struct scene_before *before);

void scene_before_done(struct scene_before *before);

/** Record whether the scene shows. If it does not, it is released as soon as nobody uses it. */
void scene_before_settle(struct scene_before *before, int shows);

/** 1 if the scene was found to show; 0 for NULL. */
int scene_before_shows(struct scene_before *before);
