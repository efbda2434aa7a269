/*
 * A recording, played back frame by frame. The renderer and the commands on recordings use this.
 *
 * A replay runs a trace's calls through a GL state machine of its own (no GL, no window) and hands out one scene per
 * frame. Only one thread may use it at a time. Scenes are independent of it: a scene stays valid after the next
 * replay_next_frame and after replay_close, and may be released by another thread.
 *
 * Frame n (from 0) ends with the trace's n-th buffer swap; calls after the last swap are executed but are not a frame.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "replay/play/tell.h"
#include "scene/scene.h"

struct replay;

/**
 * Open a trace.
 * @param out   receives the replay; owned by the caller, replay_close. NULL on failure
 * @param path  apitrace's format: Snappy, gzip or Brotli container
 * @return 0, ERR_INPUT (reported: what is wrong with the file, and where) or ERR_SYSTEM (reported)
 */
int replay_open(struct replay **out, const char *path);
void replay_close(struct replay **rp);

/**
 * Execute the calls up to the end of the next frame.
 * @param want   0: execute only (skip a frame; cheaper), *scene is set to NULL. 1: build the frame's scene
 * @param scene  receives the frame's scene; the caller's, scene_release. NULL unless the return value is 1 and want was
 *               1
 * @return 1 a frame was finished; 0 the trace has no more frames (*scene NULL); ERR_INPUT (reported: damaged at a byte;
 *         all frames that are whole before it were delivered) or ERR_SYSTEM (reported)
 */
int replay_next_frame(struct replay *rp, int want, struct scene **scene);

/**
 * Go to a frame, forwards or backwards: replay_next_frame then finishes that one. Long distances use the trace's index
 * (replay/index/index.h), which is built if there is none.
 * @return 1; 0 the trace has no such frame; ERR_* as replay_next_frame
 */
int replay_seek(struct replay *rp, uint64_t frame);

/**
 * Number of frames in the trace, from its index.
 * @param damaged  receives 1 if the trace is damaged after its last complete frame, else 0
 * @return 0 or ERR_* (reported)
 */
int replay_frame_count(struct replay *rp, uint64_t *n, int *damaged);

/**
 * When each frame ended, from the trace's index.
 * @param out  [n]: times of the first n frames (replay_frame_count), nanoseconds; 0 if the recording does not say
 * @return 0 or ERR_* (reported)
 */
int replay_frame_times(struct replay *rp, uint64_t n, uint64_t *out);

/**
 * Go to a frame and build its scene.
 * @param path  of the trace, for messages
 * @return 0; ERR_USAGE (reported) if the trace has no such frame; else as replay_next_frame
 */
int replay_take_frame(struct replay *rp, const char *path, uint64_t frame, struct scene **scene);

/**
 * Build the scene of one frame of a trace.
 * @return 0; ERR_USAGE (reported) if the trace has no such frame; else as replay_open and replay_next_frame
 */
int replay_one_frame(const char *path, uint64_t frame, struct scene **scene);

/**
 * Set the supplier, which renders pixels that the recorded program reads back (screen copies, framebuffer objects,
 * frames that are not cleared). replay_next_frame calls it, in its own thread. Without a supplier such operations are
 * counted (replay_unsupported). With one, a wanted frame that needs pixels of skipped frames makes the replay go back
 * as far as necessary and build every frame from there: slow, but correct.
 */
void replay_set_supplier(struct replay *rp, scene_supply *supply, void *user);

/**
 * Save pixels that are rendered when the replay goes back, and start from saved ones (replay/index/pixels.h).
 * @param folder  for their files; created on first use
 * @param device  the supplier's: pixels of another device may differ
 * @return 0 or ERR_SYSTEM (reported)
 */
int replay_keep_pixels(struct replay *rp, const char *folder, const char *device);

/**
 * Set a callback that reports how many of the frames before the wanted one have been played. It is called in the
 * replay's thread, after each of them.
 */
void replay_set_tell(struct replay *rp, replay_tell *tell, void *user);

/**
 * Keep pictures of framebuffer objects that cover the window as pictures. By default, scenes hold the draws that made
 * them instead: OpenGL's pixels are the same, and rays can see the geometry. Call before the first frame.
 */
void replay_keep_targets(struct replay *rp);

/**
 * Let the renderer of a frame supply its initial contents, which may turn out not to be visible (scene/before.h). By
 * default the supplier renders the frame once more to find out. Call if all frames are rendered, before the first.
 */
void replay_leave_starts(struct replay *rp);

/**
 * Do the frames up to and including `last` need pixels of skipped frames? Builds them without rendering: a frame that
 * does not clear the screen counts as one that shows earlier contents. Afterwards the replay can only be closed.
 * @return 1 they do; 0 they do not; ERR_* (reported)
 */
int replay_needs_skipped(struct replay *rp, uint64_t last);

/** Number of the frame that the next replay_next_frame finishes, which is the number of frames executed so far. */
uint64_t replay_frame(const struct replay *rp);

/** Calls read so far. */
uint64_t replay_call_count(const struct replay *rp);

/**
 * The trace's name for files derived from it: 32 hex digits, XXH3-128 over its first MiB and its size. Borrowed.
 */
const char *replay_trace_hash(const struct replay *rp);

/** The recorded program's path (the trace's property process.name), or "". Borrowed. */
const char *replay_program(const struct replay *rp);

/** A command and the number of times something happened to it. */
struct replay_count {
	const char *name;  /* a static string, or the reader's: valid until replay_close */
	const char *why;   /* the part that is not supported; NULL: all of it */
	uint64_t count;
};

/**
 * Calls met so far that the state machine does not execute, or only in part, most frequent first.
 * @param out  receives an array, valid until the next call of any replay function
 * @return number of entries
 */
size_t replay_unsupported(struct replay *rp, const struct replay_count **out);

/**
 * A feature that frames lack, from the trace's index: known before any frame is built. Excludes what only drawing can
 * reveal.
 */
struct replay_lack {
	const char *name, *why; /* command; the part that is missing, "": all. Borrowed from the replay */
	uint64_t first, last;   /* frames that lack it; last is UINT64_MAX if every frame from the first on may */
};

/**
 * @param out receives an array in order of first use, to be freed with free() @return number of entries, or ERR_*
 * (reported)
 */
long replay_lacks(struct replay *rp, struct replay_lack **out);

/** Requirements of the frames so far on a renderer. */
struct replay_needs {
	uint64_t programs;   /* draws by shaders or programs that are not run */
	int several_windows; /* 1: frames end in different windows */
	int single_buffered; /* 1: some context has no back buffer */
};
struct replay_needs replay_needs(const struct replay *rp);

/**
 * 1 if an entry of replay_unsupported is there only for lack of a renderer: 'relume render' supports it. These come
 * last.
 */
int replay_is_rendered(const struct replay_count *count);

/** All calls met so far by name, most frequent first; as above. */
size_t replay_calls(struct replay *rp, const struct replay_count **out);

/** A program that draws used. */
struct replay_program {
	const char *kind; /* "program object", "fragment program", "vertex program" */
	uint32_t name;    /* as the recorded program knows it; 0: the unnamed program */
	uint64_t draws;
};

/**
 * Programs that draws used so far. Those that are not run are also in replay_unsupported. Valid until the next call.
 * @return number of entries
 */
size_t replay_programs(struct replay *rp, const struct replay_program **out);

/** 1 if some list of counts is incomplete because memory ran out (reported). */
int replay_lacks_counts(const struct replay *rp);

/** GL errors that the program caused so far: name of the call, why = the error's name; as above. */
size_t replay_gl_errors(struct replay *rp, const struct replay_count **out);

/** A context of the recorded program. */
struct replay_context {
	uint64_t handle;        /* its address in the program */
	uint32_t width, height; /* size of the drawable it last drew to */
	const char *api;        /* "GLX", "EGL", "GLX, core profile" */
	uint64_t calls;         /* executed in it */
	int shares;             /* 1: shares its objects with another one */
	uint32_t alpha_bits, depth_bits, stencil_bits, samples; /* per pixel of the drawable, as far as the trace says */
};

/** Contexts met so far in the order they were created; as above. */
size_t replay_contexts(struct replay *rp, const struct replay_context **out);

/** 1 if a call seen so far shows that the trace comes from `relume record`. */
int replay_is_ours(const struct replay *rp);
