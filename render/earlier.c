#include "render/earlier.h"

#include <stdlib.h>

#include "base/err.h"
#include "scene/release.h"

void earlier_init(struct earlier *e)
{
	*e = (struct earlier){ .last = NULL };
	pthread_mutex_init(&e->lock, NULL);
}

void earlier_free(struct earlier *e)
{
	while (e->frames)
		earlier_drop(e, e->frames->frame);
	vectors_free(&e->last);
	pthread_mutex_destroy(&e->lock);
}

int earlier_note(struct earlier *e, const struct scene *scene)
{
	vectors_free(&e->last);
	e->last = vectors_note(scene);
	e->last_number = scene->frame;
	return e->last ? 0 : ERR_SYSTEM;
}

/* Keep the last frame for the one after it. */
static int keep(struct earlier *e, uint64_t frame)
{
	struct earlier_frame *kept = malloc(sizeof(*kept));

	if (!kept)
		return err_report(ERR_SYSTEM, NULL, "out of memory");
	kept->before = frame ? e->last : NULL;
	kept->frame = frame;
	if (frame)
		e->last = NULL;
	pthread_mutex_lock(&e->lock);
	kept->next = e->frames;
	e->frames = kept;
	pthread_mutex_unlock(&e->lock);
	return 1;
}

int earlier_decode(struct earlier *e, struct replay *replay, uint64_t frame)
{
	struct scene *scene = NULL;
	int more = 1;

	if (frame && (!e->last || e->last_number + 1 != frame)) {
		more = replay_seek(replay, frame - 1);
		if (more == 1)
			more = replay_next_frame(replay, 1, &scene);
		if (more == 1 && earlier_note(e, scene))
			more = ERR_SYSTEM;
		scene_release(&scene);
	}
	return more == 1 ? keep(e, frame) : more;
}

const struct vectors_frame *earlier_of(struct earlier *e, uint64_t frame)
{
	struct earlier_frame *f;

	pthread_mutex_lock(&e->lock);
	for (f = e->frames; f && f->frame != frame;)
		f = f->next;
	pthread_mutex_unlock(&e->lock);
	return f ? f->before : NULL;
}

void earlier_drop(struct earlier *e, uint64_t frame)
{
	struct earlier_frame **at, *f;

	pthread_mutex_lock(&e->lock);
	for (at = &e->frames; *at && (*at)->frame != frame;)
		at = &(*at)->next;
	f = *at;
	if (f)
		*at = f->next;
	pthread_mutex_unlock(&e->lock);
	if (f)
		vectors_free(&f->before);
	free(f);
}
