/* Keeps the scene that a frame starts from, and releases it as soon as it is known not to show. */
#include "scene/before.h"

#include <pthread.h>
#include <stdlib.h>

#include "scene/release.h"
#include "scene/scene.h"

struct scene_before {
	pthread_mutex_t lock;
	struct scene *scene;
	unsigned users;
	int is_needless, shows;
};

struct scene_before *scene_before_make(struct scene *scene)
{
	struct scene_before *b = calloc(1, sizeof(*b));

	if (!b) {
		scene_release(&scene);
		return NULL;
	}
	pthread_mutex_init(&b->lock, NULL);
	b->scene = scene;
	return b;
}

void scene_before_free(struct scene_before **before)
{
	struct scene_before *b = *before;

	*before = NULL;
	if (!b)
		return;
	scene_release(&b->scene);
	pthread_mutex_destroy(&b->lock);
	free(b);
}

unsigned scene_before_held(struct scene_before *before)
{
	unsigned n = 0;

	if (!before)
		return 0;
	pthread_mutex_lock(&before->lock);
	if (before->scene)
		n = 1 + scene_before_held(before->scene->before);
	pthread_mutex_unlock(&before->lock);
	return n;
}

const struct scene *scene_before_use(struct scene_before *before)
{
	const struct scene *scene;

	pthread_mutex_lock(&before->lock);
	before->users++;
	scene = before->scene;
	pthread_mutex_unlock(&before->lock);
	return scene;
}

/* The scene, taken out, if it neither shows nor is in use; else NULL. The lock must be held. */
static struct scene *take_needless(struct scene_before *b)
{
	struct scene *scene = b->is_needless && !b->users ? b->scene : NULL;

	if (scene)
		b->scene = NULL;
	return scene;
}

void scene_before_done(struct scene_before *before)
{
	struct scene *needless;

	pthread_mutex_lock(&before->lock);
	before->users--;
	needless = take_needless(before);
	pthread_mutex_unlock(&before->lock);
	scene_release(&needless);
}

void scene_before_settle(struct scene_before *before, int shows)
{
	struct scene *needless;

	pthread_mutex_lock(&before->lock);
	before->shows |= shows;
	before->is_needless |= !shows;
	needless = take_needless(before);
	pthread_mutex_unlock(&before->lock);
	scene_release(&needless);
}

int scene_before_shows(struct scene_before *before)
{
	int shows;

	if (!before)
		return 0;
	pthread_mutex_lock(&before->lock);
	shows = before->shows;
	pthread_mutex_unlock(&before->lock);
	return shows;
}
