#include "replay/index/snapshot_objects.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/hash.h"
#include "replay/gl/texture/texformat.h"
#include "replay/index/snapshot_lists.h"
#include "replay/index/snapshot_pixels.h"
#include "replay/index/snapshot_shaders.h"

/* ---- textures ---- */

/* A texture is saved as it is in memory except for its levels: the part before them, then the part after. */
#define LEVELS_BEGIN offsetof(struct gls_texture, levels)
#define LEVELS_END (LEVELS_BEGIN + sizeof(((struct gls_texture *)0)->levels))

/* Each existing level follows its number. Most are the same at every checkpoint, so their names are computed once. */
static void put_texture(struct saver *s, void *value)
{
	static const struct gls_level none;
	struct gls_texture *t = value, raw;

	memcpy(&raw, t, LEVELS_BEGIN);
	memcpy((char *)&raw + LEVELS_END, (const char *)t + LEVELS_END, sizeof(raw) - LEVELS_END);
	raw.image = NULL;
	raw.drawn = NULL;
	raw.dirty = 1;
	raw.hashed = 0;
	raw.drawn_lost |= t->drawn != NULL;
	bytes_put(s->out, &raw, LEVELS_BEGIN);
	bytes_put(s->out, (const char *)&raw + LEVELS_END, sizeof(raw) - LEVELS_END);
	for (unsigned i = 0; i < 6 * GLS_MAX_LEVELS; i++) {
		struct gls_level *level = &t->levels[i / GLS_MAX_LEVELS][i % GLS_MAX_LEVELS], kept;
		if (memcmp(level, &none, sizeof(none)) == 0)
			continue;
		kept = *level;
		kept.texels = NULL;
		memset(kept.hash, 0, sizeof(kept.hash));
		bytes_put_u64(s->out, i);
		bytes_put(s->out, &kept, sizeof(kept));
		bytes_put_u64(s->out, level->texels != NULL);
		if (level->texels && !t->hashed && !s->blobs->count)
			hash_bytes(level->texels, level->bytes, level->hash);
		if (level->texels)
			saver_named_blob(s, level->hash, level->texels, level->bytes);
	}
	bytes_put_u64(s->out, UINT64_MAX);
	t->hashed |= !s->blobs->count;
}

static void *get_texture(struct loader *l)
{
	struct gls_texture *t = loader_alloc(l, sizeof(*t));

	if (!t)
		return NULL;
	cursor_copy(&l->in, t, LEVELS_BEGIN);
	cursor_copy(&l->in, (char *)t + LEVELS_END, sizeof(*t) - LEVELS_END);
	t->image = NULL;
	t->drawn = NULL;
	t->dirty = 1;
	t->hashed = 0;
	for (uint64_t i; !loader_is_bad(l) && (i = cursor_u64(&l->in)) != UINT64_MAX;) {
		struct gls_level *level;
		size_t n;
		if (i >= 6 * GLS_MAX_LEVELS || t->levels[i / GLS_MAX_LEVELS][i % GLS_MAX_LEVELS].texels) {
			l->in.failed = 1;
			break;
		}
		level = &t->levels[i / GLS_MAX_LEVELS][i % GLS_MAX_LEVELS];
		cursor_copy(&l->in, level, sizeof(*level));
		level->texels = NULL;
		if (!cursor_u64(&l->in))
			continue;
		level->texels = loader_blob(l, &n);
		level->texel_bytes = gls_texel_bytes(level->internal_format);
		if (n != level->bytes || !gls_format_find(level->internal_format) || level->width > 65536 || level->height > 65536 ||
		    level->depth > 65536 || (uint64_t)level->width * level->height * level->depth > n / level->texel_bytes)
			l->in.failed = 1;
	}
	if (!loader_is_bad(l) && t->target <= N_GLS_TEXTURE_TARGETS)
		return t;
	l->in.failed = 1;
	gls_texture_free(t);
	return NULL;
}

static void drop_texture(void *texture)
{
	gls_texture_free(texture);
}

static const struct snapshot_table textures = {
	"texture", sizeof(struct gls_texture) - (LEVELS_END - LEVELS_BEGIN), put_texture, get_texture, drop_texture
};

/* ---- buffers ---- */

static void put_buffer(struct saver *s, void *value)
{
	struct gls_buffer raw = *(const struct gls_buffer *)value;
	const void *data = raw.data;

	raw.data = NULL;
	bytes_put(s->out, &raw, sizeof(raw));
	saver_blob(s, data, data ? raw.bytes : 0);
}

static void drop_buffer(void *value)
{
	struct gls_buffer *b = value;

	free(b->data);
	free(b);
}

static void *get_buffer(struct loader *l)
{
	struct gls_buffer *b = loader_alloc(l, sizeof(*b));
	uint8_t *data;
	size_t n;

	if (!b)
		return NULL;
	cursor_copy(&l->in, b, sizeof(*b));
	b->data = NULL;
	data = loader_blob(l, &n);
	if (n != b->bytes && !(n == 0 && b->bytes == 0))
		l->in.failed = 1;
	b->data = loader_alloc(l, b->bytes + 1);
	if (b->data && data)
		memcpy(b->data, data, n);
	free(data);
	if (!loader_is_bad(l) && b->mapped && table_set(&l->x->maps, b->mapped, b))
		l->err = ERR_SYSTEM;
	if (!loader_is_bad(l))
		return b;
	drop_buffer(b);
	return NULL;
}

static const struct snapshot_table buffers = { "buffer", sizeof(struct gls_buffer), put_buffer, get_buffer,
	                                       drop_buffer };

/* ---- framebuffer objects and renderbuffers: their pixels are not saved (gls_framebuffer_skip) ---- */

static void put_framebuffer(struct saver *s, void *value)
{
	struct gls_framebuffer raw = *(const struct gls_framebuffer *)value;

	memset(&raw.surface, 0, sizeof(raw.surface));
	raw.read = NULL;
	bytes_put(s->out, &raw, sizeof(raw));
}

static void *get_framebuffer(struct loader *l)
{
	struct gls_framebuffer *fb = loader_alloc(l, sizeof(*fb));

	if (!fb)
		return NULL;
	cursor_copy(&l->in, fb, sizeof(*fb));
	memset(&fb->surface, 0, sizeof(fb->surface));
	fb->read = NULL;
	for (unsigned i = 0; i < N_GLS_ATTACHMENTS; i++)
		if (fb->attached[i].face >= 6 || fb->attached[i].level >= GLS_MAX_LEVELS)
			l->in.failed = 1;
	return fb;
}

static const struct snapshot_table framebuffers = {
	"framebuffer object", sizeof(struct gls_framebuffer), put_framebuffer, get_framebuffer, free
};

static void put_renderbuffer(struct saver *s, void *value)
{
	struct gls_renderbuffer raw = *(const struct gls_renderbuffer *)value;

	raw.content = NULL;
	bytes_put(s->out, &raw, sizeof(raw));
	if (s->has_pixels)
		snapshot_put_picture(s, ((const struct gls_renderbuffer *)value)->content);
}

static void *get_renderbuffer(struct loader *l)
{
	struct gls_renderbuffer *r = loader_alloc(l, sizeof(*r));

	if (!r)
		return NULL;
	cursor_copy(&l->in, r, sizeof(*r));
	r->content = l->has_pixels ? snapshot_get_picture(l) : NULL;
	if (r->width > 16384 || r->height > 16384 ||
	    (r->content && (r->content->picture.width != r->width || r->content->picture.height != r->height)))
		l->in.failed = 1;
	return r;
}

static void drop_renderbuffer(void *renderbuffer)
{
	gls_renderbuffer_free(renderbuffer);
}

static const struct snapshot_table renderbuffers = {
	"renderbuffer", sizeof(struct gls_renderbuffer), put_renderbuffer, get_renderbuffer, drop_renderbuffer
};

/* ---- programs: saved as source, translated again ---- */

static void put_program(struct saver *s, void *value)
{
	const struct gls_program *p = value;

	bytes_put(s->out, &p->target, sizeof(p->target));
	bytes_put_u64(s->out, p->n_locals);
	bytes_put(s->out, p->local, p->n_locals * sizeof(*p->local));
	bytes_put_u64(s->out, p->source != NULL);
	saver_blob(s, p->source, p->source ? p->source_bytes : 0);
}

static void drop_program(void *program)
{
	gls_program_free(program);
}

static void *get_program(struct loader *l)
{
	struct gls_program *p = loader_alloc(l, sizeof(*p));
	uint8_t *text;
	uint64_t n_locals;
	size_t n;

	if (!p)
		return NULL;
	cursor_copy(&l->in, &p->target, sizeof(p->target));
	n_locals = loader_count(l, sizeof(*p->local));
	if (n_locals > GLS_MAX_PROGRAM_LOCALS)
		l->in.failed = 1;
	else if (gls_program_reserve(p, (uint32_t)n_locals))
		l->err = ERR_SYSTEM;
	else
		cursor_copy(&l->in, p->local, n_locals * sizeof(*p->local));
	if (cursor_u64(&l->in)) {
		text = loader_blob(l, &n);
		if (!loader_is_bad(l)) {
			const int refused = gls_program_set(p, text ? (const char *)text : "", text ? n : 0);

			if (refused < 0 || (refused && gls_program_judged(p, 0) < 0))
				l->err = ERR_SYSTEM;
		}
		free(text);
	} else {
		free(loader_blob(l, &n));
	}
	if (!loader_is_bad(l))
		return p;
	gls_program_free(p);
	return NULL;
}

static const struct snapshot_table programs = { "program", sizeof(((struct gls_program *)0)->target) + 16, put_program,
	                                        get_program, drop_program };

/* ---- all shared objects ---- */

void snapshot_put_share(struct saver *s, const struct gls_share *share)
{
	saver_table(s, &share->lists, &snapshot_lists);
	saver_table(s, &share->textures, &textures);
	saver_table(s, &share->buffers, &buffers);
	saver_table(s, &share->programs, &programs);
	snapshot_put_shaders(s, &share->shaders);
	saver_table(s, &share->framebuffers, &framebuffers);
	saver_table(s, &share->renderbuffers, &renderbuffers);
	for (unsigned i = 0; i < N_GLS_TEXTURE_TARGETS; i++) {
		bytes_put_u64(s->out, share->defaults[i] != NULL);
		if (share->defaults[i])
			put_texture(s, share->defaults[i]);
	}
}

void snapshot_get_share(struct loader *l, struct gls_share *share)
{
	loader_table(l, &share->lists, &snapshot_lists);
	loader_table(l, &share->textures, &textures);
	loader_table(l, &share->buffers, &buffers);
	loader_table(l, &share->programs, &programs);
	snapshot_get_shaders(l, &share->shaders);
	loader_table(l, &share->framebuffers, &framebuffers);
	loader_table(l, &share->renderbuffers, &renderbuffers);
	for (unsigned i = 0; i < N_GLS_TEXTURE_TARGETS && !loader_is_bad(l); i++)
		if (cursor_u64(&l->in))
			share->defaults[i] = get_texture(l);
}
