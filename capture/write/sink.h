/*
 * Runs inside the traced program. The end of the trace: takes chunks of plain bytes, writes packed chunks to the file.
 *
 * A thread packs and writes full chunks while the program continues. At the end of a frame the rest is handed over
 * before the swap and awaited after it, so the kernel has every frame that was swapped, and packing costs no time if
 * the swap takes longer. Little data is packed and written at once: waking a thread would take longer.
 *
 * One caller at a time (the writer's lock). The first error ends all writing, and an incomplete end of the file is cut
 * off. Every function keeps errno. Nothing here maps a file: a full file system is an error of pwrite, never a SIGBUS.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

enum { SINK_CHUNK = 1 << 20 };

/* The recording up to some byte: frames that ended, calls that began. */
struct sink_content {
	uint64_t frames, calls;
};

struct sink_state {
	const char *path;  /* "" before there is a file */
	int error;         /* errno of what went wrong; 0: nothing */
	const char *what;  /* in words */
	uint64_t bytes;    /* in the file */
	struct sink_content content; /* the same */
};

/**
 * Create NAME.trace or, if that exists, NAME.1.trace and so on: the first process that calls GL gets the name.
 * @return the first chunk to fill, SINK_CHUNK bytes; NULL if there is no file (sink_state says why)
 */
uint8_t *sink_open(const char *name);

/**
 * The first `bytes` of the chunk are complete.
 * @param content  of the recording up to the last of them
 * @return the chunk to fill next
 */
uint8_t *sink_hand_over(size_t bytes, struct sink_content content);

/** As sink_hand_over, and all is in the file when it returns. */
uint8_t *sink_write(size_t bytes, struct sink_content content);

struct sink_state sink_state(void);

/** In the child of a fork: leave the file to the parent, which must have waited for what it handed over
 * (sink_write). */
void sink_leave(void);

/**
 * Write all of `data` at an offset, without raising SIGXFSZ.
 * @return 0 or an errno; part of the data may be in the file then
 */
int sink_pwrite(int fd, const void *data, size_t bytes, uint64_t offset);

/** Why a file ends, in the user's words: "disk full", or "cannot write: Input/output error". */
void sink_explain(char *out, size_t size, const char *what, int error);
