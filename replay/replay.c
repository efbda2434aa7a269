#include "replay/replay.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "gl_tokens.h"
#include "base/err.h"
#include "capture/format/trace.h"
#include "replay/build/mesh.h"
#include "replay/gl/dispatch.h"
#include "replay/gl/surface/drawable.h"
#include "replay/gl/surface/frames.h"
#include "replay/gl/texture/image.h"
#include "replay/index/index.h"
#include "replay/machine/commands.h"
#include "replay/machine/machine.h"
#include "base/table.h"
#include "replay/trace/hash.h"
#include "replay/trace/reader.h"

#define HASHED_BYTES ((uint64_t)1 << 20)
#define FEW_FRAMES 8 /* that are rather executed than looked for in the index */

struct replay {
	char *path;
	struct trace_reader *reader;
	struct gls_exec *exec;
	char hash[33];
	struct replay_count *counts; /* what the last query answered */
	size_t room;
	struct replay_context *contexts;
	replay_supply *supply;
	void *supply_user;
	int build_all; /* 1: some frame needs pixels of earlier ones; all are built */
	struct index *index; /* once it was needed */
};

static int hash_begin(struct replay *rp)
{
	uint64_t size = trace_reader_size(rp->reader);
	XXH3_state_t *state = XXH3_createState();
	XXH128_hash_t hash;
	int rc = state ? 0 : err_report(ERR_SYSTEM, rp->path, "out of memory");

	if (!rc) {
		XXH3_128bits_reset(state);
		rc = hash_file(rp->path, HASHED_BYTES, state);
	}
	if (!rc) {
		XXH3_128bits_update(state, &size, sizeof(size));
		hash = XXH3_128bits_digest(state);
		snprintf(rp->hash, sizeof(rp->hash), "%016llx%016llx", (unsigned long long)hash.high64,
		         (unsigned long long)hash.low64);
	}
	XXH3_freeState(state);
	return rc;
}

int replay_open(struct replay **out, const char *path)
{
	struct replay *rp = calloc(1, sizeof(*rp));
	int rc = ERR_SYSTEM;

	*out = NULL;
	if (!rp || !(rp->path = strdup(path))) {
		err_report(ERR_SYSTEM, path, "out of memory");
		goto fail;
	}
	rc = trace_reader_open(&rp->reader, path);
	if (!rc)
		rc = hash_begin(rp);
	if (!rc)
		rc = gls_exec_create(&rp->exec, rp->path);
	if (rc)
		goto fail;
	*out = rp;
	return 0;
fail:
	replay_close(&rp);
	return rc;
}

void replay_close(struct replay **rp)
{
	if (!*rp)
		return;
	index_close(&(*rp)->index);
	gls_exec_destroy(&(*rp)->exec);
	trace_reader_close(&(*rp)->reader);
	free((*rp)->counts);
	free((*rp)->contexts);
	free((*rp)->path);
	free(*rp);
	*rp = NULL;
}

void replay_set_supplier(struct replay *rp, replay_supply *supply, void *user)
{
	rp->exec->feedback.supply = rp->supply = supply;
	rp->exec->feedback.supply_user = rp->supply_user = user;
}

/* Execute one frame. @return as replay_next_frame; 1 with exec->feedback.rewind set: it could not be built */
static int run_frame(struct replay *rp, int want, struct scene **scene)
{
	struct gls_exec *x = rp->exec;
	const struct call *call;
	int rc;

	x->want = want || rp->build_all;
	x->frame_ended = 0;
	if (want)
		gls_frame_end_deferred(x);
	while (!x->frame_ended) {
		rc = trace_reader_next(rp->reader, &call);
		if (rc <= 0)
			return rc;
		rc = gls_exec_call(x, call);
		if (rc)
			return rc;
		if (x->feedback.rewind)
			return 1;
	}
	if (want)
		*scene = gls_frame_finish(x);
	else if (x->want)
		gls_frame_defer(x);
	else
		gls_frame_skip(x);
	if (x->feedback.rewind)
		return 1;
	if (x->failed || (want && !*scene))
		return x->failed ? x->failed : err_report(ERR_SYSTEM, rp->path, "out of memory");
	x->frame++;
	gls_mesh_cache_trim(x);
	gls_image_cache_trim(x);
	return 1;
}

/* Start again, and build every frame. */
static int rewind_and_build(struct replay *rp)
{
	int rc, fronts = rp->exec->feedback.fronts;

	gls_exec_destroy(&rp->exec);
	trace_reader_close(&rp->reader);
	rc = trace_reader_open(&rp->reader, rp->path);
	if (!rc)
		rc = gls_exec_create(&rp->exec, rp->path);
	if (rc)
		return rc;
	rp->exec->feedback.supply = rp->supply;
	rp->exec->feedback.supply_user = rp->supply_user;
	rp->exec->feedback.fronts = fronts;
	rp->build_all = 1;
	return 1;
}

int replay_next_frame(struct replay *rp, int want, struct scene **scene)
{
	uint64_t frame = rp->exec->frame;
	int rc;

	*scene = NULL;
	rc = run_frame(rp, want, scene);
	/* Twice, where only the second time finds that it is looked at what front buffers show. */
	for (int i = 0; i < 2 && rc == 1 && rp->exec->feedback.rewind; i++) {
		rc = rewind_and_build(rp);
		while (rc == 1 && !rp->exec->feedback.rewind && rp->exec->frame <= frame)
			rc = run_frame(rp, want && rp->exec->frame == frame, scene);
	}
	return rc;
}

static int have_index(struct replay *rp, enum index_mode mode)
{
	return rp->index ? 0 : index_open(&rp->index, rp->path, rp->hash, mode, NULL);
}

static void use_instead(struct replay *rp, struct gls_exec *x)
{
	gls_exec_take_counts(x, rp->exec);
	x->feedback.supply = rp->supply;
	x->feedback.supply_user = rp->supply_user;
	x->feedback.fronts = rp->exec->feedback.fronts;
	gls_exec_destroy(&rp->exec);
	rp->exec = x;
}

/* Execute nothing more, begin at a checkpoint. What was counted so far goes on being counted. */
static int restore(struct replay *rp, uint64_t checkpoint)
{
	struct gls_exec *x;
	int rc = gls_exec_create(&x, rp->path);

	if (rc)
		return rc;
	rc = index_restore(rp->index, checkpoint, rp->reader, x);
	if (!rc) {
		use_instead(rp, x);
		return 0;
	}
	gls_exec_destroy(&x);
	return rc;
}

/* From the trace's begin. */
static int start_again(struct replay *rp)
{
	struct gls_exec *x;
	int rc = gls_exec_create(&x, rp->path);

	if (rc)
		return rc;
	table_free(&rp->exec->counts.unknown); /* its keys go with the reader */
	use_instead(rp, x);
	trace_reader_close(&rp->reader);
	return trace_reader_open(&rp->reader, rp->path);
}

/* Come as near before a frame as a checkpoint does. */
static int jump(struct replay *rp, uint64_t frame)
{
	uint64_t checkpoint;
	int rc, backwards = frame < rp->exec->frame;

	if (rp->build_all) /* no frame may be left out */
		return backwards ? start_again(rp) : 0;
	rc = have_index(rp, INDEX_KEEP);
	if (rc)
		return rc;
	checkpoint = index_checkpoint(rp->index, frame);
	if (!backwards && checkpoint <= rp->exec->frame)
		return 0;
	rc = checkpoint ? restore(rp, checkpoint) : start_again(rp);
	if (rc != ERR_INPUT)
		return rc;
	/* The index is damaged where it was not looked at when it was opened. */
	index_close(&rp->index);
	rc = have_index(rp, INDEX_FORCE);
	checkpoint = rc ? 0 : index_checkpoint(rp->index, frame);
	if (!rc)
		rc = checkpoint ? restore(rp, checkpoint) : start_again(rp);
	return rc;
}

int replay_seek(struct replay *rp, uint64_t frame)
{
	struct scene *none;
	int rc = 0;

	if (frame < rp->exec->frame || frame > rp->exec->frame + FEW_FRAMES)
		rc = jump(rp, frame);
	rc = rc ? rc : 1;
	while (rc == 1 && rp->exec->frame < frame)
		rc = replay_next_frame(rp, 0, &none);
	return rc;
}

/* A supplier that renders nothing: whatever was there may show. */
static int know_nothing(void *user, const struct scene *scene, struct scene_picture *picture)
{
	size_t n = (size_t)scene->width * scene->height;

	(void)user;
	memset(picture->rgba, 0, n * 4);
	memset(picture->depth, 0, n * sizeof(*picture->depth));
	memset(picture->stencil, 0, n);
	picture->unknown = !scene->start;
	return 0;
}

int replay_needs_skipped(struct replay *rp, uint64_t last)
{
	struct scene *scene = NULL;
	int rc = 1;

	rp->exec->feedback.supply = know_nothing;
	while (rc == 1 && rp->exec->frame <= last) {
		rc = run_frame(rp, 1, &scene);
		if (rc == 1 && rp->exec->feedback.rewind)
			return 1;
		scene_release(&scene);
	}
	return rc < 0 ? rc : 0;
}

int replay_frame_count(struct replay *rp, uint64_t *n, int *damaged)
{
	struct index_facts facts;
	int rc = have_index(rp, INDEX_KEEP);

	if (rc)
		return rc;
	facts = index_facts(rp->index);
	*n = facts.frames;
	*damaged = facts.damaged;
	return 0;
}

struct trace_reader *replay_reader(struct replay *rp)
{
	return rp->reader;
}

struct gls_exec *replay_exec(struct replay *rp)
{
	return rp->exec;
}

int replay_one_frame(const char *path, uint64_t frame, struct scene **scene)
{
	struct replay *rp = NULL;
	int rc = replay_open(&rp, path);

	if (rc)
		return rc;
	rc = replay_seek(rp, frame);
	if (rc == 1)
		rc = replay_next_frame(rp, 1, scene);
	if (rc == 0)
		rc = err_report(ERR_USAGE, path, "there is no frame %" PRIu64 "; the trace has %" PRIu64 " frames (0 to %" PRIu64 ")",
		                frame, replay_frame(rp), replay_frame(rp) ? replay_frame(rp) - 1 : 0);
	replay_close(&rp);
	return rc < 0 ? rc : 0;
}

uint64_t replay_frame(const struct replay *rp)
{
	return rp->exec->frame;
}

uint64_t replay_call_count(const struct replay *rp)
{
	return rp->exec->n_calls;
}

const char *replay_trace_hash(const struct replay *rp)
{
	return rp->hash;
}

const char *replay_program(const struct replay *rp)
{
	const char *name = trace_reader_property(rp->reader, "process.name");

	return name ? name : "";
}

/* ---- counts ---- */

static int put(struct replay *rp, size_t at, const char *name, const char *why, uint64_t count)
{
	if (at == rp->room) {
		size_t room = rp->room ? 2 * rp->room : 64;
		struct replay_count *grown = realloc(rp->counts, room * sizeof(*grown));
		if (!grown)
			return 0;
		rp->counts = grown;
		rp->room = room;
	}
	rp->counts[at] = (struct replay_count){ name, why, count };
	return 1;
}

static int more_often(const void *a, const void *b)
{
	const struct replay_count *l = a, *r = b;

	if (l->count != r->count)
		return l->count < r->count ? 1 : -1;
	return strcmp(l->name, r->name);
}

static size_t finish(struct replay *rp, size_t n, const struct replay_count **out)
{
	if (n)
		qsort(rp->counts, n, sizeof(rp->counts[0]), more_often);
	*out = rp->counts;
	return n;
}

static size_t put_unknown(struct replay *rp, size_t n, const char *why)
{
	const struct table *t = &rp->exec->counts.unknown;

	for (size_t i = 0; i < t->room; i++)
		if (t->entries[i].value)
			n += (size_t)put(rp, n, ((const struct call_sig *)(uintptr_t)t->entries[i].key)->name, why,
			                 (uintptr_t)t->entries[i].value);
	return n;
}

size_t replay_unsupported(struct replay *rp, const struct replay_count **out)
{
	const struct gls_exec *x = rp->exec;
	size_t n = 0;

	for (unsigned i = 0; i < n_gls_commands; i++)
		if (x->counts.unsupported[i])
			n += (size_t)put(rp, n, gls_commands[i].name, x->counts.why[i], x->counts.unsupported[i]);
	return finish(rp, put_unknown(rp, n, NULL), out);
}

size_t replay_calls(struct replay *rp, const struct replay_count **out)
{
	const struct gls_exec *x = rp->exec;
	size_t n = 0;

	for (unsigned i = 0; i < n_gls_commands; i++)
		if (x->counts.calls[i])
			n += (size_t)put(rp, n, gls_commands[i].name, NULL, x->counts.calls[i]);
	return finish(rp, put_unknown(rp, n, NULL), out);
}

static const char *error_name(uint32_t error)
{
	switch (error) {
	case GL_INVALID_ENUM:
		return "GL_INVALID_ENUM";
	case GL_INVALID_VALUE:
		return "GL_INVALID_VALUE";
	case GL_INVALID_OPERATION:
		return "GL_INVALID_OPERATION";
	case GL_STACK_OVERFLOW:
		return "GL_STACK_OVERFLOW";
	case GL_STACK_UNDERFLOW:
		return "GL_STACK_UNDERFLOW";
	default:
		return "GL_OUT_OF_MEMORY";
	}
}

size_t replay_gl_errors(struct replay *rp, const struct replay_count **out)
{
	const struct gls_exec *x = rp->exec;
	size_t n = 0;

	for (unsigned i = 0; i < n_gls_commands; i++)
		if (x->counts.errors[i])
			n += (size_t)put(rp, n, gls_commands[i].name, error_name(x->counts.error_code[i]), x->counts.errors[i]);
	return finish(rp, n, out);
}

size_t replay_contexts(struct replay *rp, const struct replay_context **out)
{
	struct gls_exec *x = rp->exec;

	free(rp->contexts);
	rp->contexts = calloc(x->n_contexts + 1, sizeof(*rp->contexts));
	*out = rp->contexts;
	if (!rp->contexts)
		return 0;
	for (size_t i = 0; i < x->n_contexts; i++) {
		struct gls_context *ctx = x->contexts[i];
		struct gls_drawable *d = ctx->state.ever_current ? gls_drawable_of(x, ctx->state.drawable) : NULL;
		rp->contexts[i] = (struct replay_context){ ctx->handle, d ? d->width : 0, d ? d->height : 0, ctx->api, ctx->calls,
		                                           ctx->shares, ctx->state.alpha_bits, ctx->state.depth_bits,
		                                           ctx->state.stencil_bits, ctx->state.samples };
	}
	return x->n_contexts;
}

int replay_is_ours(const struct replay *rp)
{
	return rp->exec->is_ours;
}

void replay_report_unsupported(struct replay *rp, const char *where, size_t limit)
{
	const struct replay_count *counts;
	size_t n = replay_unsupported(rp, &counts);

	for (size_t i = 0; i < n && i < limit; i++)
		err_warn(where, "%s, %llu times: %s", counts[i].name, (unsigned long long)counts[i].count,
		         counts[i].why ? counts[i].why : "not done yet");
	if (n > limit)
		err_warn(where, "and %zu more commands that are not done yet ('relume info' lists them)", n - limit);
}
