/*
 * Runs inside the traced program. Contexts: which is current, what it can do, its pending errors, and what belongs to
 * it.
 *
 * Nothing here changes GL state that the program can see, including its errors. State is queried from the driver, and
 * cached only if every command that can change it drops the cache.
 */
#pragma once

enum context_feature { /* features that can be queried without a GL error */
	               HAS_FIXED_FUNCTION = 1 << 0 /* all of it: not OpenGL ES 1 */,
	               HAS_BUFFERS = 1 << 1,
	               HAS_PIXEL_BUFFERS = 1 << 2,
	               HAS_MAP_RANGE = 1 << 3,
	               HAS_MULTITEXTURE = 1 << 4,
	               HAS_FOG_COORD = 1 << 5,
	               HAS_SECONDARY_COLOR = 1 << 6,
	               HAS_ATTRIBUTES = 1 << 7,
	               HAS_FRAMEBUFFERS = 1 << 8,
	               HAS_READ_FRAMEBUFFER = 1 << 9,
	               HAS_DIVISOR = 1 << 10,
	               HAS_RESTART = 1 << 11,
	               HAS_FIXED_RESTART = 1 << 12,
	               HAS_INTEGER_ATTRIBUTES = 1 << 13,
	               HAS_VERTEX_ARRAYS = 1 << 14,
	               HAS_PACK_INVERT = 1 << 15,
	               HAS_3D = 1 << 16,
	               HAS_DESKTOP = 1 << 17 /* not OpenGL ES */,
	               HAS_WINDOW_POS = 1 << 18,
	               HAS_INDIRECT = 1 << 19,
	               HAS_RESTART_NV = 1 << 20,
	               HAS_CONVENTIONAL =
	                       1 << 21 /* matrices, lights and arrays of positions: fixed function, and OpenGL ES 1 */,
	               HAS_POINT_SIZES = 1 << 22 /* point size arrays */
};

/** Data that other files keep for each context. */
enum context_slot { CONTEXT_CONTENTS, CONTEXT_MIRRORS, CONTEXT_RUNS, CONTEXT_MAPS, N_CONTEXT_SLOTS };

/** Identifies this thread's context; NULL if it has none. */
const void *context_current(void);
/** 1 if this thread's current context has the feature. */
int context_has(enum context_feature feature);
/** An integer state of the current context; 0 if it has none. */
int context_get(unsigned pname);
/** The same for a level of the texture bound to the target; there must be a current context. */
int context_get_level(unsigned target, int level, unsigned pname);

/** The content of the current context's slot; NULL if it is empty or there is no context. */
void *context_data(enum context_slot slot);
/** Fill the slot. `release(data)` is called when the context is destroyed; there must be a current context. */
void context_set_data(enum context_slot slot, void *data, void (*release)(void *data));

/** This thread's context from now on; NULL: none. @return 1 if it has never been current before */
int context_select(void *handle);
/** A number for each context that becomes current in this thread instead of another. */
unsigned context_turn(void);
/** The context was destroyed: once no thread has it, the contents of its slots are released. */
void context_destroyed(void *handle);

/** glGetError's answer: errors that the recorder had to fetch come first. */
unsigned context_pending_error(unsigned error);
/** Set the program's pending errors aside. Later errors are the recorder's, until ..._after drops them. */
void context_errors_before(void);
void context_errors_after(void);
