/*
 * Playing and seeking: executes frames, jumps to checkpoints, goes back for pixels of skipped frames, and collects
 * statistics.
 */
#include "replay/replay.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/frames.h"
#include "base/hash.h"
#include "base/memory.h"
#include "base/progress.h"
#include "capture/format/call.h"
#include "gl_tokens.h"
#include "replay/gl/dispatch.h"
#include "replay/gl/surface/drawable.h"
#include "replay/gl/surface/frames.h"
#include "replay/index/index_build.h"
#include "replay/index/pixels.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/play/player.h"
#include "replay/programs/program.h"
#include "scene/release.h"

#define FEW_FRAMES 8    /* distances up to this are executed, without the index */
/* Frames to rebuild first when a frame needs earlier pixels; each retry goes LONGER_BACK times further back. */
#define FIRST_BACK 16
#define LONGER_BACK 8
#define ALL_BACK UINT64_MAX
/*
 * The minimum distance between two checkpoints with pixels: PIXELS_SHARE times as long as writing one takes, and
 * PIXELS_FRAMES frames if these are still to be drawn.
 */
#define PIXELS_SHARE 4
#define PIXELS_FRAMES 8

/* Progress since the last checkpoint with pixels. */
struct keeping {
	uint64_t frame;   /* first frame after the last checkpoint, or the frame that the replay began at */
	double since_s;   /* when that frame began */
	double frame_s;   /* seconds to draw each frame before the last checkpoint */
	double writing_s; /* seconds to write the last checkpoint */
};

struct replay {
	struct player player;
	char hash[33];
	struct replay_count *counts; /* result of the last query */
	size_t room;
	struct replay_program *programs; /* result of the last replay_programs */
	size_t programs_room;
	int lacks_counts; /* 1: some counts were left out because memory ran out */
	struct replay_context *contexts;
	struct index *index; /* opened on first use */
	struct pixels pixels;
	uint64_t back;       /* number of frames built before a wanted one if player.build_all is set */
	struct keeping keeping;
};

int replay_open(struct replay **out, const char *path)
{
	struct replay *rp = calloc(1, sizeof(*rp));
	int rc;

	*out = NULL;
	if (!rp)
		return err_report(ERR_SYSTEM, path, "out of memory");
	rc = player_open(&rp->player, path);
	if (!rc)
		rc = hash_name(path, trace_reader_size(rp->player.reader), rp->hash);
	if (rc)
		replay_close(&rp);
	*out = rp;
	return rc;
}

void replay_close(struct replay **rp)
{
	if (!*rp)
		return;
	index_close(&(*rp)->index);
	player_close(&(*rp)->player);
	free((*rp)->counts);
	free((*rp)->programs);
	free((*rp)->contexts);
	free((*rp)->pixels.folder);
	free(*rp);
	*rp = NULL;
}

void replay_set_supplier(struct replay *rp, scene_supply *supply, void *user)
{
	player_set_supplier(&rp->player, supply, user);
}

int replay_keep_pixels(struct replay *rp, const char *folder, const char *device)
{
	free(rp->pixels.folder);
	rp->pixels = (struct pixels){ rp->player.path, rp->hash, strdup(folder), pixels_maker(device) };
	return rp->pixels.folder ? 0 : err_report(ERR_SYSTEM, folder, "out of memory");
}

void replay_set_tell(struct replay *rp, replay_tell *tell, void *user)
{
	rp->player.tell = tell;
	rp->player.tell_user = user;
}

void replay_keep_targets(struct replay *rp)
{
	player_keep_targets(&rp->player);
}

void replay_leave_starts(struct replay *rp)
{
	player_leave_starts(&rp->player);
}

static int have_index(struct replay *rp, enum index_mode mode)
{
	return rp->index ? 0 : index_open(&rp->index, rp->player.path, rp->hash, mode, NULL);
}

/* has_pixels: the checkpoint is one made by pixels.h */
static int restore(struct replay *rp, uint64_t checkpoint, int has_pixels)
{
	struct gls_exec *x;
	int rc = gls_exec_create(&x, rp->player.path);

	if (rc)
		return rc;
	rc = has_pixels ? pixels_restore(&rp->pixels, rp->index, checkpoint, rp->player.reader, x) :
	                  index_restore(rp->index, checkpoint, rp->player.reader, x);
	if (!rc) {
		player_use(&rp->player, x);
		return 0;
	}
	gls_exec_destroy(&x);
	return rc;
}

/* Start at a frame's checkpoint, or, if 0, at the beginning of the trace. */
static int begin_at(struct replay *rp, uint64_t checkpoint)
{
	return checkpoint ? restore(rp, checkpoint, 0) : player_start_again(&rp->player);
}

/* Go to the last checkpoint before a frame. may_stay: stay where we are if the jump would lead back */
static int jump(struct replay *rp, uint64_t frame, int may_stay)
{
	int rc = frame ? have_index(rp, INDEX_KEEP) : 0;
	uint64_t checkpoint = rc || !frame ? 0 : index_checkpoint(rp->index, frame);

	if (rc || (may_stay && checkpoint <= rp->player.exec->frame))
		return rc;
	rc = begin_at(rp, checkpoint);
	if (rc != ERR_INPUT || !frame)
		return rc;
	/* A part of the index is damaged that is not read when it is opened. */
	index_close(&rp->index);
	rc = have_index(rp, INDEX_FORCE);
	return rc ? rc : begin_at(rp, index_checkpoint(rp->index, frame));
}

/* Frame to start from: `frame` itself, or an earlier one whose pixels it may show. */
static uint64_t beginning_of(const struct replay *rp, uint64_t frame)
{
	return !rp->player.build_all ? frame : frame > rp->back ? frame - rp->back : 0;
}

/* Report why a frame takes long, and how far the replay goes back. */
static void tell_back(const struct player *p, uint64_t frame, const struct gls_feedback *found)
{
	err_warn(p->path,
	         "frame %" PRIu64 " needs the pixels of frames before it (%s, found at call %" PRIu64
	         ", %s); playing them from frame %" PRIu64,
	         frame, found->rewind_why, found->rewind_call, gls_commands[found->rewind_command].name,
	         p->exec->frame);
}

/*
 * 1 if the distance from the last checkpoint is large enough for another one. Frames that are still to be drawn count
 * as long as earlier ones took; a few of them may wait, because drawing them together is cheaper (gls_frame_defer).
 */
static int is_far(const struct keeping *k, uint64_t frame)
{
	const double frames = (double)(frame - k->frame), least_s = PIXELS_SHARE * k->writing_s;

	return progress_clock_s() - k->since_s >= least_s || (frames >= PIXELS_FRAMES && frames * k->frame_s >= least_s);
}

/*
 * Save pixels between frames that are rebuilt on the way to another, as often as the cost is small compared with
 * drawing: a later replay then goes back no further than to the nearest checkpoint.
 * @return 1 or ERR_SYSTEM (reported)
 */
static int keep_pixels(struct replay *rp)
{
	struct gls_exec *x = rp->player.exec;
	struct keeping *k = &rp->keeping;
	double drawn_s;
	int is_settled, rc;

	if (!rp->player.build_all || x->feedback.rewind || x->frame == k->frame || !is_far(k, x->frame) ||
	    !pixels_lacks(&rp->pixels, x->frame))
		return 1;
	is_settled = gls_frame_settle(x);
	drawn_s = progress_clock_s();
	rc = is_settled ? have_index(rp, INDEX_KEEP) : x->failed;
	if (is_settled && !rc)
		rc = pixels_keep(&rp->pixels, rp->index, rp->player.reader, x);
	k->frame_s = (drawn_s - k->since_s) / (double)(x->frame - k->frame);
	k->since_s = progress_clock_s();
	k->writing_s = k->since_s - drawn_s;
	k->frame = x->frame;
	return rc ? rc : 1;
}

static void begin_way(struct replay *rp)
{
	rp->player.told_s = rp->keeping.since_s = progress_clock_s();
	rp->keeping.frame = rp->player.exec->frame;
}

/* Build every frame from the player's position up to `frame`, saving pixels on the way. As replay_next_frame */
static int play_again(struct replay *rp, uint64_t frame, int want, const struct gls_feedback *found,
                      struct scene **scene)
{
	struct player *p = &rp->player;
	const uint64_t from = p->exec->frame;
	int rc = 1;

	tell_back(p, frame, found);
	begin_way(rp);
	while (rc == 1 && !p->exec->feedback.rewind && p->exec->frame <= frame) {
		rc = player_try_frame(p, want && p->exec->frame == frame, scene);
		if (rc == 1 && p->exec->frame <= frame)
			rc = keep_pixels(rp);
		player_tell(p, from, frame);
	}
	return rc;
}

/*
 * Go to the last saved pixels before a frame, which are all that it can need, unless that is more than twice as far as
 * an attempt without them would go, or further than the player's position.
 * @return 1; 0: there are none
 */
static int jump_to_pixels(struct replay *rp, uint64_t frame)
{
	const struct gls_exec *x = rp->player.exec;
	uint64_t begin = beginning_of(rp, frame), kept;

	if (x->feedback.fronts || !pixels_find(&rp->pixels, frame, &kept) || have_index(rp, INDEX_KEEP) != 0)
		return 0;
	begin = begin ? index_checkpoint(rp->index, begin) : 0;
	return frame - kept <= 2 * (frame - begin) && (kept > x->frame || x->frame > frame || x->feedback.rewind) &&
	       restore(rp, kept, 1) == 0;
}

/*
 * A frame needs pixels of skipped frames: build more and more of the frames before it, until all that it shows is
 * known. Start over from the trace's beginning if only the first pass there finds out that the program reads front
 * buffers.
 */
static int go_back(struct replay *rp, uint64_t frame, int want, struct scene **scene)
{
	struct player *p = &rp->player;
	struct gls_feedback found;
	int rc = 1, tried = 0;

	for (int whole = 0; rc == 1 && p->exec->feedback.rewind && whole < 2; whole += rp->back == ALL_BACK) {
		rp->back = !p->build_all ? FIRST_BACK : rp->back > frame / LONGER_BACK ? ALL_BACK : rp->back * LONGER_BACK;
		if (rp->back >= frame)
			rp->back = ALL_BACK;
		found = p->exec->feedback;
		p->why = found.rewind_why;
		p->build_all = 1;
		if (!tried && jump_to_pixels(rp, frame)) {
			tried = 1; /* a further try would end the same way */
			rc = 0;
		} else {
			rc = jump(rp, beginning_of(rp, frame), 0);
		}
		if (!rc)
			rc = play_again(rp, frame, want, &found, scene);
	}
	return rc;
}

int replay_next_frame(struct replay *rp, int want, struct scene **scene)
{
	const uint64_t frame = rp->player.exec->frame;
	int rc;

	*scene = NULL;
	rc = player_try_frame(&rp->player, want, scene);
	return rc == 1 && rp->player.exec->feedback.rewind ? go_back(rp, frame, want, scene) : rc;
}

int replay_seek(struct replay *rp, uint64_t frame)
{
	struct scene *none;
	uint64_t from;
	const int is_near = frame >= rp->player.exec->frame && frame <= rp->player.exec->frame + FEW_FRAMES;
	int rc = 0;

	if (!is_near && !(rp->player.build_all && jump_to_pixels(rp, frame)))
		rc = jump(rp, beginning_of(rp, frame), frame >= rp->player.exec->frame);
	rc = rc ? rc : 1;
	from = rp->player.exec->frame;
	begin_way(rp);
	while (rc == 1 && rp->player.exec->frame < frame) {
		rc = replay_next_frame(rp, 0, &none);
		if (rc == 1)
			rc = keep_pixels(rp);
		player_tell(&rp->player, from, frame);
	}
	return rc;
}

/* A supplier that renders nothing: earlier contents may show through. */
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

	rp->player.exec->feedback.supply = know_nothing;
	while (rc == 1 && rp->player.exec->frame <= last) {
		rc = player_try_frame(&rp->player, 1, &scene);
		if (rc == 1 && rp->player.exec->feedback.rewind)
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

int replay_frame_times(struct replay *rp, uint64_t n, uint64_t *out)
{
	int rc = have_index(rp, INDEX_KEEP);

	for (uint64_t i = 0; i < n && !rc; i++)
		out[i] = index_frame_time(rp->index, i);
	return rc;
}

int replay_take_frame(struct replay *rp, const char *path, uint64_t frame, struct scene **scene)
{
	int rc = replay_seek(rp, frame);

	if (rc == 1)
		rc = replay_next_frame(rp, 1, scene);
	if (rc == 0)
		rc = frame_report_missing(path, frame, replay_frame(rp));
	return rc < 0 ? rc : 0;
}

int replay_one_frame(const char *path, uint64_t frame, struct scene **scene)
{
	struct replay *rp = NULL;
	int rc = replay_open(&rp, path);

	if (rc)
		return rc;
	rc = replay_take_frame(rp, path, frame, scene);
	replay_close(&rp);
	return rc;
}

uint64_t replay_frame(const struct replay *rp)
{
	return rp->player.exec->frame;
}

uint64_t replay_call_count(const struct replay *rp)
{
	return rp->player.exec->n_calls;
}

const char *replay_trace_hash(const struct replay *rp)
{
	return rp->hash;
}

const char *replay_program(const struct replay *rp)
{
	const char *name = trace_reader_property(rp->player.reader, "process.name");

	return name ? name : "";
}

/* ---- counts ---- */

static void put(struct replay *rp, size_t *n, const char *name, const char *why, uint64_t count)
{
	if (!count)
		return;
	if (MEMORY_GROW(rp->counts, rp->room, *n + 1))
		rp->lacks_counts = 1;
	else
		rp->counts[(*n)++] = (struct replay_count){ name, why, count };
}

static int more_often(const void *a, const void *b)
{
	const struct replay_count *l = a, *r = b;

	if (replay_is_rendered(l) != replay_is_rendered(r))
		return replay_is_rendered(l) ? 1 : -1;
	if (l->count != r->count)
		return l->count < r->count ? 1 : -1;
	return strcmp(l->name, r->name);
}

/* Counts by command, and by name if the call is in no table, most frequent first. */
static size_t collect(struct replay *rp, const uint64_t *counts,
                      const char *(*why)(const struct gls_exec *x, unsigned command), const struct table *unknown,
                      const struct replay_count **out)
{
	size_t n = 0;

	for (unsigned i = 0; i < n_gls_commands; i++)
		put(rp, &n, gls_commands[i].name, why && counts[i] ? why(rp->player.exec, i) : NULL, counts[i]);
	for (size_t i = 0; unknown && i < unknown->room; i++)
		if (unknown->entries[i].value)
			put(rp, &n, ((const struct call_sig *)(uintptr_t)unknown->entries[i].key)->name, NULL,
			    (uintptr_t)unknown->entries[i].value);
	if (n)
		qsort(rp->counts, n, sizeof(rp->counts[0]), more_often);
	*out = rp->counts;
	return n;
}

long replay_lacks(struct replay *rp, struct replay_lack **out)
{
	const struct index_lack *lacks;
	int rc = have_index(rp, INDEX_KEEP);
	size_t n = rc ? 0 : index_lacks(rp->index, &lacks);

	*out = calloc(n + 1, sizeof(**out));
	if (!*out)
		return err_report(ERR_SYSTEM, rp->player.path, "out of memory");
	for (size_t i = 0; i < n; i++)
		(*out)[i] = (struct replay_lack){ lacks[i].name, lacks[i].why, lacks[i].first,
			                          lacks[i].stays ? UINT64_MAX : lacks[i].last };
	return rc ? rc : (long)n;
}

static const char *what_is_missing(const struct gls_exec *x, unsigned command)
{
	return x->counts.why[command];
}

int replay_lacks_counts(const struct replay *rp)
{
	return rp->lacks_counts;
}

size_t replay_unsupported(struct replay *rp, const struct replay_count **out)
{
	return collect(rp, rp->player.exec->counts.unsupported, what_is_missing, &rp->player.exec->counts.unknown, out);
}

struct replay_needs replay_needs(const struct replay *rp)
{
	const struct gls_exec *x = rp->player.exec;
	struct replay_needs n = { .programs = x->counts.programs, .several_windows = x->counts.several_windows };

	for (size_t i = 0; i < x->n_contexts; i++)
		n.single_buffered |= x->contexts[i]->state.ever_current && !x->contexts[i]->state.double_buffered;
	return n;
}

static int by_kind_and_name(const void *a, const void *b)
{
	const struct replay_program *l = a, *r = b;
	const int kind = strcmp(l->kind, r->kind);

	return kind ? kind : l->name < r->name ? -1 : l->name > r->name;
}

size_t replay_programs(struct replay *rp, const struct replay_program **out)
{
	const struct table *draws = &rp->player.exec->counts.program_draws;
	size_t n = 0;

	for (size_t i = 0; i < draws->room; i++) {
		const uint64_t key = draws->entries[i].key;

		if (!draws->entries[i].value)
			continue;
		if (MEMORY_GROW(rp->programs, rp->programs_room, n + 1)) {
			rp->lacks_counts = 1;
			break;
		}
		rp->programs[n++] = (struct replay_program){
			gls_program_kind(key), (uint32_t)key, (uintptr_t)draws->entries[i].value };
	}
	if (n)
		qsort(rp->programs, n, sizeof(rp->programs[0]), by_kind_and_name);
	*out = rp->programs;
	return n;
}

int replay_is_rendered(const struct replay_count *count)
{
	return count->why == gls_needs_renderer;
}

size_t replay_calls(struct replay *rp, const struct replay_count **out)
{
	return collect(rp, rp->player.exec->counts.calls, NULL, &rp->player.exec->counts.unknown, out);
}

static const char *error_name(const struct gls_exec *x, unsigned command)
{
	switch (x->counts.error_code[command]) {
	case GL_INVALID_ENUM: return "GL_INVALID_ENUM";
	case GL_INVALID_VALUE: return "GL_INVALID_VALUE";
	case GL_INVALID_OPERATION: return "GL_INVALID_OPERATION";
	case GL_STACK_OVERFLOW: return "GL_STACK_OVERFLOW";
	case GL_STACK_UNDERFLOW: return "GL_STACK_UNDERFLOW";
	default: return "GL_OUT_OF_MEMORY";
	}
}

size_t replay_gl_errors(struct replay *rp, const struct replay_count **out)
{
	return collect(rp, rp->player.exec->counts.errors, error_name, NULL, out);
}

size_t replay_contexts(struct replay *rp, const struct replay_context **out)
{
	struct gls_exec *x = rp->player.exec;

	free(rp->contexts);
	rp->contexts = calloc(x->n_contexts + 1, sizeof(*rp->contexts));
	*out = rp->contexts;
	if (!rp->contexts) {
		err_report(ERR_SYSTEM, NULL, "out of memory");
		rp->lacks_counts = 1;
		return 0;
	}
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
	return rp->player.exec->is_ours;
}
