/*
 * Checkpoints with pixels. To render a frame that shows what earlier frames drew, these must be rendered first, back to
 * one where all pixels are known. Once they have been, the state and its pixels are saved as a checkpoint, where later
 * runs start. Each is a file of its own, an index that holds nothing else: TRACE-MAKER-FRAME.index in a folder for such
 * files. A missing or damaged file only costs time. The files hold no scenes: a frame that shows a picture whose scene
 * is traced (surface/shown.h) still goes back to the frames that drew it.
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

/** A hash of this executable's size and time and of the device: pixels of others may differ. */
uint64_t pixels_maker(const char *device);

/** 1 if a checkpoint can be saved before this frame: there is a folder, and the checkpoint is not in it yet. */
int pixels_lacks(const struct pixels *p, uint64_t frame);

/** The last frame up to `frame` that has a checkpoint. @return 1; 0: none has */
int pixels_find(const struct pixels *p, uint64_t frame, uint64_t *found);

/**
 * Restore the state and pixels of a checkpoint, as index_restore does. A checkpoint that cannot be read is deleted.
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
