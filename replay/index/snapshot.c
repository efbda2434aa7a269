/* Saves and loads the machine with its contexts and drawables; the other snapshot_*.c files do the parts. */
#include "replay/index/snapshot.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "replay/gl/context.h"
#include "replay/gl/surface/drawable.h"
#include "replay/index/snapshot_objects.h"
#include "replay/index/snapshot_pixels.h"
#include "replay/index/snapshot_state.h"

enum { IS_MISSING = 1, HAS_PIXELS = 2 }; /* flags of a snapshot */

/* ---- drawables ---- */

static void put_drawable(struct saver *s, void *value)
{
	const struct gls_drawable *d = value;

	bytes_put_u64(s->out, d->width);
	bytes_put_u64(s->out, d->height);
	bytes_put_u64(s->out, (uint64_t)d->fixed);
	bytes_put_u64(s->out, d->accum_missing || d->accum);
	if (s->has_pixels) {
		bytes_put_u64(s->out, (uint64_t)d->surface.skipped);
		snapshot_put_picture(s, d->surface.picture);
	}
}

static void *get_drawable(struct loader *l)
{
	struct gls_drawable *d = loader_alloc(l, sizeof(*d));

	if (!d)
		return NULL;
	d->width = (uint32_t)cursor_u64(&l->in);
	d->height = (uint32_t)cursor_u64(&l->in);
	if (d->width > GLS_MAX_DRAWABLE || d->height > GLS_MAX_DRAWABLE)
		l->in.failed = 1;
	d->fixed = (int)cursor_u64(&l->in);
	d->accum_missing = cursor_u64(&l->in) != 0;
	d->front.is_front = 1;
	d->surface.skipped = d->front.skipped = 1; /* as after any frame that was not built: gls_frame_skip */
	if (l->has_pixels) {
		d->surface.skipped = cursor_u64(&l->in) != 0;
		d->surface.picture = snapshot_get_picture(l);
	}
	return d;
}

static void drop_drawable(void *value)
{
	struct gls_drawable *d = value;

	gls_picture_release(d->surface.picture);
	free(d);
}

static const struct snapshot_table drawables = { NULL, 40, put_drawable, get_drawable, drop_drawable };

/* ---- saving ---- */

/* 1 + index of a context; 0: none. */
static uint64_t context_number(const struct gls_exec *x, const struct gls_context *ctx)
{
	for (size_t i = 0; i < x->n_contexts; i++)
		if (x->contexts[i] == ctx)
			return i + 1;
	return 0;
}

/* A share group is identified by its first context. */
static uint64_t share_number(const struct gls_exec *x, const struct gls_share *share)
{
	uint64_t i = 0;

	while (x->contexts[i]->state.share != share)
		i++;
	return i;
}

static int is_quiet(const struct gls_exec *x)
{
	for (size_t i = 0; i < x->n_contexts; i++)
		if (x->contexts[i]->state.list || x->contexts[i]->state.begin_mode)
			return 0;
	return x->pending.geometry.n_vertices == 0;
}

static void put_context(struct saver *s, size_t i)
{
	struct gls_exec *x = s->x;
	const struct gls_context *ctx = x->contexts[i];
	uint64_t share = share_number(x, ctx->state.share);

	saver_section(s, "context", i);
	bytes_put_u64(s->out, ctx->handle);
	bytes_put_u64(s->out, ctx->share_handle);
	bytes_put_text(s->out, ctx->api);
	bytes_put_u64(s->out, ctx->calls);
	bytes_put_u64(s->out, (uint64_t)ctx->destroyed);
	bytes_put_u64(s->out, (uint64_t)ctx->shares);
	bytes_put_u64(s->out, share);
	if (share == i)
		snapshot_put_share(s, ctx->state.share);
	snapshot_put_state(s, &ctx->state);
}

static int save(struct saver *s)
{
	struct gls_exec *x = s->x;
	struct bytes *out = s->out;

	if (!is_quiet(x))
		return 1;
	bytes_put_u64(out, x->frame);
	bytes_put_u64(out, x->n_calls);
	bytes_put_u64(out, x->caches.versions);
	bytes_put_u64(out, x->thread);
	bytes_put_u64(out, x->egl_api);
	bytes_put_u64(out, (x->feedback.missing ? IS_MISSING : 0) | (s->has_pixels ? HAS_PIXELS : 0));
	bytes_put_u64(out, x->n_contexts);
	for (size_t i = 0; i < x->n_contexts; i++)
		put_context(s, i);
	saver_section(s, "threads", x->n_threads);
	bytes_put_u64(out, x->n_threads);
	for (size_t i = 0; i < x->n_threads; i++)
		bytes_put_u64(out, context_number(x, x->threads[i]));
	saver_section(s, "drawables", x->drawables.n);
	saver_table(s, &x->drawables, &drawables);
	saver_section(s, "configurations", x->configs.n);
	saver_table(s, &x->configs, &snapshot_numbers);
	if (out->failed && !s->err)
		s->err = err_report(ERR_SYSTEM, x->path, "out of memory");
	return s->err;
}

int snapshot_save(struct gls_exec *x, const struct snapshot_blobs *blobs, struct bytes *out)
{
	struct saver s = { .x = x, .blobs = blobs, .out = out, .wanted = SIZE_MAX };

	return save(&s);
}

int snapshot_save_pixels(struct gls_exec *x, const struct snapshot_blobs *blobs, struct bytes *out)
{
	struct saver s = { .x = x, .blobs = blobs, .out = out, .has_pixels = 1, .wanted = SIZE_MAX };

	return save(&s);
}

static int keep_nothing(void *user, const uint64_t name[2], const void *data, size_t n)
{
	(void)user, (void)name, (void)data, (void)n;
	return 0;
}

const struct snapshot_blobs snapshot_no_blobs = { .put = keep_nothing };

const char *snapshot_place(struct gls_exec *x, size_t at)
{
	static _Thread_local char place[96];
	struct bytes out = { .n = 0 };
	struct saver s = { .x = x, .blobs = &snapshot_no_blobs, .out = &out, .wanted = at, .place = "head" };

	save(&s);
	free(out.data);
	memcpy(place, s.place, sizeof(place));
	return place;
}

/* ---- loading ---- */

/* The window system's name, as a static string, which contexts refer to. */
static const char *get_api(struct loader *l)
{
	static const char *const names[] = { "GLX", "GLX, core profile", "EGL", "EGL, core profile",
		                              "WGL", "CGL", "OSMesa" };
	uint64_t n = cursor_u64(&l->in);
	const char *text = n < 32 ? cursor_get(&l->in, n + 1) : NULL;

	for (size_t i = 0; text && text[n] == 0 && i < sizeof(names) / sizeof(names[0]); i++)
		if (strcmp(names[i], text) == 0)
			return names[i];
	l->in.failed = 1;
	return "";
}

static void get_context(struct loader *l)
{
	struct gls_exec *x = l->x;
	struct gls_context *ctx = loader_alloc(l, sizeof(*ctx));
	uint64_t share;

	if (!ctx)
		return;
	if (gls_state_init(&ctx->state)) {
		free(ctx);
		l->err = ERR_SYSTEM;
		return;
	}
	ctx->handle = cursor_u64(&l->in);
	ctx->share_handle = cursor_u64(&l->in);
	ctx->api = get_api(l);
	ctx->calls = cursor_u64(&l->in);
	ctx->destroyed = (int)cursor_u64(&l->in);
	ctx->shares = (int)cursor_u64(&l->in);
	share = cursor_u64(&l->in);
	if (share > x->n_contexts)
		l->in.failed = 1;
	if (loader_is_bad(l))
		share = x->n_contexts; /* so that there is one to release */
	if (share < x->n_contexts) {
		ctx->state.share = x->contexts[share]->state.share;
		ctx->state.share->refs++;
	} else {
		ctx->state.share = gls_share_create();
		if (!ctx->state.share) {
			gls_state_free(&ctx->state);
			free(ctx);
			l->err = err_report(ERR_SYSTEM, x->path, "out of memory");
			return;
		}
	}
	x->contexts[x->n_contexts++] = ctx;
	if (share + 1 == x->n_contexts)
		snapshot_get_share(l, ctx->state.share);
	snapshot_get_state(l, &ctx->state);
}

static void get_threads(struct loader *l)
{
	struct gls_exec *x = l->x;
	uint64_t n = loader_count(l, 8);

	x->threads = loader_alloc(l, (n + 1) * sizeof(*x->threads));
	x->n_threads = x->threads ? (size_t)n : 0;
	for (size_t i = 0; i < x->n_threads; i++) {
		uint64_t number = cursor_u64(&l->in);
		if (number > x->n_contexts)
			l->in.failed = 1;
		else
			x->threads[i] = number ? x->contexts[number - 1] : NULL;
	}
	x->current = x->thread < x->n_threads ? x->threads[x->thread] : NULL;
	x->st = x->current ? &x->current->state : NULL;
}

int snapshot_load(struct gls_exec *x, const struct snapshot_blobs *blobs, const uint8_t *data, size_t n)
{
	struct loader l = { .x = x, .blobs = blobs, .in = { data, data + n, 0 } };
	uint64_t count, flags;

	x->frame = cursor_u64(&l.in);
	x->n_calls = cursor_u64(&l.in);
	x->caches.versions = cursor_u64(&l.in);
	x->thread = cursor_u64(&l.in);
	x->egl_api = (uint32_t)cursor_u64(&l.in);
	flags = cursor_u64(&l.in);
	x->feedback.missing = (flags & IS_MISSING) != 0;
	l.has_pixels = (flags & HAS_PIXELS) != 0;
	count = loader_count(&l, sizeof(struct gls_state));
	free(x->contexts);
	x->contexts = loader_alloc(&l, (count + 1) * sizeof(*x->contexts));
	for (uint64_t i = 0; i < count && !loader_is_bad(&l); i++)
		get_context(&l);
	if (!loader_is_bad(&l))
		get_threads(&l);
	loader_table(&l, &x->drawables, &drawables);
	loader_table(&l, &x->configs, &snapshot_numbers);
	if (l.err)
		return l.err;
	return l.in.failed || l.in.p != l.in.end
		? err_report(ERR_INPUT, x->path, "a checkpoint of its index cannot be read") : 0;
}
