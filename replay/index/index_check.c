/* Checks an index: reaches each checkpoint by replaying, from the one before it, and by restoring. */
#include "replay/index/index_check.h"

#include <stdlib.h>

#include "base/err.h"
#include "replay/index/index_file.h"
#include "replay/play/player.h"

/* Compare a player's state with the one that a checkpoint saved. way: how it got there, for the report */
static int compare_state(struct index *index, const struct index_checkpoint *c, struct player *p, const char *way)
{
	struct bytes state = { .n = 0 };
	uint8_t *kept = index_get_blob(index, c->name, c->bytes);
	size_t at = 0;
	int rc = kept ? snapshot_save(p->exec, &snapshot_no_blobs, &state) : ERR_INPUT;

	if (rc == 1)
		rc = err_report(ERR_FAILED, index->trace, "checkpoint at frame %llu, %s: cannot be saved there",
		                (unsigned long long)c->frame, way);
	if (rc == 0) {
		while (at < state.n && at < c->bytes && state.data[at] == kept[at])
			at++;
		if (at < state.n || at < c->bytes)
			rc = err_report(ERR_FAILED, index->trace, "checkpoint at frame %llu, %s: byte %zu of %llu differs (%s)",
			                (unsigned long long)c->frame, way, at, (unsigned long long)c->bytes,
			                snapshot_place(p->exec, at));
	}
	free(kept);
	free(state.data);
	return rc;
}

/* Play up to a frame. @return 0, ERR_INPUT or ERR_SYSTEM (reported) */
static int run_to(struct player *p, uint64_t frame)
{
	struct scene *none;
	int rc = 1;

	while (rc == 1 && p->exec->frame < frame)
		rc = player_try_frame(p, 0, &none);
	return rc == 1 ? 0 : rc ? rc : ERR_INPUT;
}

/* Open a player at a checkpoint. */
static int begin_at(struct index *index, const struct index_checkpoint *c, struct player *p)
{
	int rc = player_open(p, index->trace);

	return rc ? rc : index_restore(index, c->frame, p->reader, p->exec);
}

int index_check(struct index *index)
{
	struct player straight, jumping = { 0 };
	int rc = player_open(&straight, index->trace);

	for (size_t i = 0; i < index->n_checkpoints && !rc; i++) {
		const struct index_checkpoint *c = &index->checkpoints[i];

		rc = run_to(&straight, c->frame);
		if (!rc)
			rc = compare_state(index, c, &straight, "replayed");
		if (!rc && i) {
			rc = run_to(&jumping, c->frame);
			if (!rc)
				rc = compare_state(index, c, &jumping, "from the checkpoint before");
		}
		player_close(&jumping);
		if (!rc)
			rc = begin_at(index, c, &jumping);
		if (!rc)
			rc = compare_state(index, c, &jumping, "restored");
	}
	player_close(&straight);
	player_close(&jumping);
	return rc;
}
