#include "replay/play/player.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/progress.h"
#include "replay/build/mesh.h"
#include "replay/gl/dispatch.h"
#include "replay/machine/commands.h"
#include "replay/gl/surface/frames.h"
#include "replay/gl/texture/image.h"

#define TELL_S 10 /* seconds between progress messages of a replay from the start */

int player_open(struct player *p, const char *path)
{
	int rc;

	*p = (struct player){ .path = strdup(path) };
	rc = p->path ? trace_reader_open(&p->reader, path, gls_command_find) : err_report(ERR_SYSTEM, path, "out of memory");
	if (!rc)
		rc = gls_exec_create(&p->exec, p->path);
	if (rc)
		player_close(p);
	return rc;
}

void player_close(struct player *p)
{
	gls_exec_destroy(&p->exec);
	trace_reader_close(&p->reader);
	free(p->path);
	*p = (struct player){ 0 };
}

void player_set_supplier(struct player *p, scene_supply *supply, void *user)
{
	p->exec->feedback.supply = p->supply = supply;
	p->exec->feedback.supply_user = p->supply_user = user;
}

void player_keep_targets(struct player *p)
{
	p->exec->feedback.keeps_targets = p->keeps_targets = 1;
}

void player_leave_starts(struct player *p)
{
	p->exec->feedback.leaves_starts = p->leaves_starts = 1;
}

int player_try_frame(struct player *p, int want, struct scene **scene)
{
	struct gls_exec *x = p->exec;
	const struct call *call;
	int rc;

	x->want = want || p->build_all;
	x->frame_ended = 0;
	if (want)
		gls_frame_end_deferred(x);
	while (!x->frame_ended) {
		rc = trace_reader_next(p->reader, &call);
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
		return x->failed ? x->failed : err_report(ERR_SYSTEM, p->path, "out of memory");
	x->frame++;
	gls_mesh_cache_trim(x);
	gls_image_cache_trim(x);
	return 1;
}

int player_step(struct player *p, const struct call **call)
{
	struct gls_exec *x = p->exec;
	int rc = trace_reader_next(p->reader, call);

	if (rc <= 0)
		return rc;
	x->want = 0;
	x->frame_ended = 0;
	rc = gls_exec_call(x, *call);
	if (rc)
		return rc;
	if (x->frame_ended) {
		gls_frame_skip(x);
		x->frame++;
		gls_mesh_cache_trim(x);
		gls_image_cache_trim(x);
	}
	return x->failed ? x->failed : 1;
}

void player_tell(struct player *p, uint64_t from, uint64_t to)
{
	const uint64_t played = p->exec->frame - from;

	if (p->tell) {
		p->tell(p->tell_user, to, played, to - from, p->why);
	} else if (progress_clock_s() - p->told_s > TELL_S) {
		p->told_s = progress_clock_s();
		err_warn(p->path, "played %" PRIu64 " of the %" PRIu64 " frames before frame %" PRIu64, played, to - from, to);
	}
}

void player_use(struct player *p, struct gls_exec *x)
{
	gls_exec_take_counts(x, p->exec);
	x->feedback.supply = p->supply;
	x->feedback.supply_user = p->supply_user;
	x->feedback.keeps_targets = p->keeps_targets;
	x->feedback.leaves_starts = p->leaves_starts;
	x->feedback.fronts = p->exec->feedback.fronts;
	gls_exec_destroy(&p->exec);
	p->exec = x;
}

int player_start_again(struct player *p)
{
	struct gls_exec *x;
	int rc = gls_exec_create(&x, p->path);

	if (rc)
		return rc;
	table_free(&p->exec->counts.unknown); /* its keys belong to the reader */
	player_use(p, x);
	trace_reader_close(&p->reader);
	return trace_reader_open(&p->reader, p->path, gls_command_find);
}
