/*
 * Checkpoints with pixels. A frame that shows what earlier ones drew costs all frames back to where the pixels are
 * known. When these have been played, their pixels are saved: each checkpoint is an index that holds nothing else,
 * TRACE-MAKER-FRAME.index in a folder for such files. A missing or damaged file only costs time. The files hold no
 * scenes: a frame that shows a picture whose scene is traced (surface/shown.h) goes back to the frames that drew it.
 */
#pragma once

#include "replay/index/index.h"
#include "replay/machine/machine.h"
#include "replay/trace/reader.h"

struct pixels {
	const char *path, *trace; /* path of the trace; its hash_name. Borrowed */
	char *folder;             /* created on first use; NULL: nothing is saved or found */
	uint64_t maker;           /* pixels_maker */
};

/** Identifier of the pixels that this build makes on a device. */
uint64_t pixels_maker(const char *device);

/** Whether a checkpoint may be saved before this frame: there is a folder, and none is in it yet. */
int pixels_lacks(const struct pixels *p, uint64_t frame);

/** The last frame up to `frame` that has a checkpoint. @return 1; 0: none has */
int pixels_find(const struct pixels *p, uint64_t frame, uint64_t *found);

/**
 * As index_restore; a checkpoint that cannot be read is deleted.
 * @param base  the trace's index, which holds the blobs that checkpoints share with it; NULL: not available
 */
int pixels_restore(const struct pixels *p, struct index *base, uint64_t frame, struct trace_reader *reader,
                   struct gls_exec *x);

/**
 * Save the checkpoint that pixels_lacks names, after gls_frame_settle and if there is room. If the checkpoints of a
 * trace grow too large, every second one is deleted.
 * @param base  as in pixels_restore
 * @return 0 or ERR_SYSTEM (reported)
 */
int pixels_keep(const struct pixels *p, struct index *base, struct trace_reader *reader, struct gls_exec *x);
