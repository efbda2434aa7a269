#include "verbs/render/shot.h"

#include <stdlib.h>

#include "scene/release.h"

void shot_leave_scene(struct shared_scene **shared)
{
	struct shared_scene *s = *shared;

	*shared = NULL;
	while (s && atomic_fetch_sub(&s->users, 1) == 1) {
		struct shared_scene *next = s->next;

		interval_free(&s->after);
		scene_release(&s->scene);
		free(s);
		s = next;
	}
}

void shot_drop(struct shot **shot)
{
	if (*shot)
		shot_leave_scene(&(*shot)->of);
	free(*shot);
	*shot = NULL;
}

/* A frame that the shot has taken. */
static const struct shared_scene *frame_of(const struct shot *shot, uint64_t frame)
{
	const struct shared_scene *s = shot->of;

	for (uint64_t i = shot->first; i < frame; i++)
		s = s->next;
	return s;
}

/* 1 if a cut follows a frame. */
static int is_cut(const struct shot *shot, uint64_t frame)
{
	const struct shared_scene *s = frame_of(shot, frame);

	return s->after && interval_is_cut(s->after);
}

/* A moment of the recording. */
struct place {
	uint64_t frame;
	double at; /* [0,1): how far after it, as a share of the time to the next frame */
};

static struct place place_of(const struct moments *m, uint64_t picture, double after)
{
	struct place p;

	moments_at(m, picture, after, &p.frame, &p.at);
	return p;
}

/* A moment between two frames that a cut separates becomes the nearer frame. */
static struct place clear_of_cut(const struct shot *shot, struct place p)
{
	return p.at > 0 && is_cut(shot, p.frame) ? (struct place){ p.frame + (p.at >= 0.5), 0 } : p;
}

/* 1 if a is later than b. */
static int is_behind(struct place a, struct place b)
{
	return a.frame > b.frame || (a.frame == b.frame && a.at > b.at);
}

/* Go from one place, clear of cuts, towards another, but not through a cut. */
static struct place go(const struct shot *shot, struct place from, struct place to)
{
	for (uint64_t i = from.frame; is_behind(to, from) && i < to.frame + (to.at > 0); i++)
		if (is_cut(shot, i))
			return (struct place){ i, 0 };
	for (uint64_t i = from.frame + (from.at > 0); is_behind(from, to) && i-- > to.frame;)
		if (is_cut(shot, i))
			return (struct place){ i + 1, 0 };
	return to;
}

int shot_scene(const struct shot *shot, const struct moments *m, double after, struct between *room,
               const struct scene **scene)
{
	const struct place from = clear_of_cut(shot, place_of(m, shot->number, 0)),
	                   to = go(shot, from, place_of(m, shot->number, after));
	const struct shared_scene *s = frame_of(shot, to.frame);

	*scene = to.at > 0 ? &room->scene : s->scene;
	return to.at > 0 ? between_make(s->after, to.at, moments_nearest(m, shot->number) > to.frame, room) : 0;
}

int shot_is_at_cut(const struct shot *shot, const struct moments *m)
{
	const struct place p = place_of(m, shot->number, 0);

	return p.at > 0 && is_cut(shot, p.frame);
}

int shot_is_behind_cut(const struct shot *shot, const struct moments *m)
{
	const struct place from = clear_of_cut(shot, place_of(m, shot->number, 0)), to = place_of(m, shot->number, -1),
	                   end = go(shot, from, to);

	return end.frame != to.frame || end.at != to.at;
}
