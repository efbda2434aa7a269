#include "replay/index/snapshot_pixels.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"

static void put_planes(struct saver *s, const struct scene_picture *p)
{
	const size_t n = (size_t)p->width * p->height;

	saver_blob(s, p->rgba, 4 * n);
	saver_blob(s, p->depth, n * sizeof(*p->depth));
	saver_blob(s, p->stencil, n);
	if (p->colors)
		saver_blob(s, p->colors, 4 * n * sizeof(*p->colors));
}

void snapshot_put_picture(struct saver *s, const struct gls_picture *picture)
{
	const struct scene_picture *p;

	bytes_put_u64(s->out, picture != NULL);
	if (!picture)
		return;
	p = &picture->picture;
	bytes_put_u64(s->out, p->width);
	bytes_put_u64(s->out, p->height);
	bytes_put_u64(s->out, p->depth_bits);
	bytes_put_u64(s->out, p->colors != NULL);
	bytes_put_u64(s->out, p->samples != NULL);
	bytes_put_u64(s->out, picture->lacks);
	put_planes(s, p);
	for (int i = 0; i < SCENE_SAMPLES && p->samples; i++)
		put_planes(s, &p->samples[i]);
}

/* Read a plane of `bytes` bytes. */
static void get_plane(struct loader *l, void *to, size_t bytes)
{
	size_t n;
	uint8_t *data = loader_blob(l, &n);

	l->in.failed |= n != bytes;
	if (!loader_is_bad(l) && n)
		memcpy(to, data, n);
	free(data);
}

/* Read all planes but the first, which is read already. */
static void get_planes(struct loader *l, struct scene_picture *p)
{
	const size_t n = (size_t)p->width * p->height;

	get_plane(l, p->depth, n * sizeof(*p->depth));
	get_plane(l, p->stencil, n);
	if (p->colors)
		get_plane(l, p->colors, 4 * n * sizeof(*p->colors));
}

struct gls_picture *snapshot_get_picture(struct loader *l)
{
	struct gls_picture_form form = { 0 };
	struct gls_picture *picture;
	uint8_t *first;
	uint32_t lacks;
	size_t n;

	if (!cursor_u64(&l->in))
		return NULL;
	form.width = (uint32_t)cursor_u64(&l->in);
	form.height = (uint32_t)cursor_u64(&l->in);
	form.depth_bits = (uint32_t)cursor_u64(&l->in);
	form.floats = cursor_u64(&l->in) != 0;
	form.samples = cursor_u64(&l->in) ? SCENE_SAMPLES : 1;
	lacks = (uint32_t)cursor_u64(&l->in);
	first = loader_blob(l, &n); /* before memory is allocated: a size alone must not cause an allocation */
	if (form.width > GLS_MAX_DRAWABLE || form.height > GLS_MAX_DRAWABLE || n != (size_t)4 * form.width * form.height)
		l->in.failed = 1;
	picture = loader_is_bad(l) ? NULL : gls_picture_make(l->x, &form);
	if (!picture) {
		free(first);
		l->err = loader_is_bad(l) ? l->err : ERR_SYSTEM;
		return NULL;
	}
	picture->lacks = lacks;
	if (n)
		memcpy(picture->picture.rgba, first, n);
	free(first);
	get_planes(l, &picture->picture);
	for (int i = 0; i < SCENE_SAMPLES && picture->picture.samples; i++) {
		get_plane(l, picture->picture.samples[i].rgba, n);
		get_planes(l, &picture->picture.samples[i]);
	}
	if (!loader_is_bad(l))
		return picture;
	gls_picture_release(picture);
	return NULL;
}
