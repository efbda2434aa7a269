/*
 * Statistics that the recorder passes to the command that started it, in a small file that both map: they outlive the
 * program, however it ends. Every recorded process has a slot. Commands that were not recorded are counted by name, for
 * all processes together.
 */
#pragma once

#include <stdatomic.h>
#include <stdint.h>
#include <string.h>

/* Calls that end a frame besides a swap: the words of `record --frame-end`, in this order. */
enum frame_trigger { FRAME_SWAP, FRAME_FLUSH, FRAME_FINISH, FRAME_CLEAR, FRAME_READPIXELS, N_FRAME_TRIGGERS };
#define FRAME_TRIGGER_NAMES { "swap", "flush", "finish", "clear", "readpixels", NULL }

enum { STATS_MAX_PROCESSES = 64, STATS_MAX_UNKNOWN = 64, STATS_NAME_BYTES = 64, STATS_PATH_BYTES = 1024 };

struct stats_process {
	char path[STATS_PATH_BYTES]; /* its trace */
	_Atomic uint64_t frames, calls, bytes; /* whole frames, calls written, bytes in the file */
	_Atomic int32_t failed; /* errno of what ended the recording early; 0: nothing did */
	_Atomic int32_t programs; /* 1: it made shaders or programs current */
	_Atomic int32_t windows;  /* 1: its frames come from one window; 2: from several */
	_Atomic int32_t quit;   /* 1: it ended the program: after the frames asked for, or because nothing more could be
	                           recorded */
	_Atomic int32_t contexts; /* 1: it made a context current; 2: one of a core profile */
	_Atomic int32_t lost_references; /* 1: reference frames ended early */
	_Atomic uint64_t ends[N_FRAME_TRIGGERS]; /* frames so far, recorded or not (swap); calls that would have ended
	                                            the first one */
};

struct stats_unknown {
	char name[STATS_NAME_BYTES];
	_Atomic uint64_t calls;
};

/* Libraries seen in any process; they explain why nothing was recorded. */
enum { SEEN_RECORDER = 1, SEEN_GL = 2, SEEN_VULKAN = 4 };

struct recorder_stats {
	_Atomic uint32_t seen;    /* SEEN_* */
	_Atomic uint32_t toggles; /* requests to the command to switch recording on or off */
	_Atomic uint32_t keys_pressed, keys_lost; /* keys of --press that a window received, and that none did */
	_Atomic uint32_t n_processes, n_unknown; /* may exceed the tables; what does not fit is lost */
	struct stats_process processes[STATS_MAX_PROCESSES];
	struct stats_unknown unknown[STATS_MAX_UNKNOWN];
};

/* SEEN_* of a library's path, 0 for most. */
static inline uint32_t stats_library(const char *path)
{
	static const struct {
		const char *start;
		uint32_t seen;
	} libraries[] = {
		{ "librelume.so", SEEN_RECORDER }, { "libGL.so", SEEN_GL }, { "libGLX.so", SEEN_GL }, { "libEGL.so", SEEN_GL },
		{ "libGLES", SEEN_GL }, { "libOpenGL.so", SEEN_GL }, { "libOSMesa", SEEN_GL }, { "libvulkan.so", SEEN_VULKAN },
	};
	const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;

	for (unsigned i = 0; i < sizeof(libraries) / sizeof(libraries[0]); i++)
		if (strncmp(name, libraries[i].start, strlen(libraries[i].start)) == 0)
			return libraries[i].seen;
	return 0;
}

_Static_assert(sizeof(struct stats_process) == 1112 && sizeof(struct stats_unknown) == 72,
               "the same in programs of 32 bits");
