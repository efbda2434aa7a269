/*
 * Runs inside the traced program. What the generated thunks call besides the writer: finding the real functions, the
 * values that depend on GL state, and the hooks that overlay.txt names.
 *
 * Nothing here changes GL state that the program can see, its errors included; state is asked from the driver, and cached
 * only where every command that can change it drops the cache.
 */
#ifndef CAPTURE_GL_WRAP_H
#define CAPTURE_GL_WRAP_H

#include <stddef.h>
#include <stdint.h>

#include "capture/gl/maps.h"
#include "capture/write/runs.h"
#include "capture/format/sizes.h"
#include "capture/stats.h"
#include "capture/write/writer.h"
#include "commands.h"
#include "enums.h"

#define SHOWN __attribute__((visibility("default")))

/* resolve.c: finding the real GL, and being found instead of it */

extern void *resolve_found[N_COMMANDS];

/** Find a command's real function and remember it. Where there is none, a function that does nothing and returns 0. */
void *resolve_command(unsigned command);

/** 1 where the command has a real function. */
int resolve_exists(unsigned command);

/** What a GetProcAddress of the real GL returned -> what the program gets. */
void *resolve_substitute(const char *name, void *real);

/** OSMesa brings its own gl*: use these from now on. */
void resolve_prefer_osmesa(void);

static inline void *real(unsigned command)
{
	void *found = __atomic_load_n(&resolve_found[command], __ATOMIC_RELAXED); /* any thread's find is as good */

	return found ? found : resolve_command(command);
}

/* context.c: contexts */

enum context_feature { /* what may be asked without making a GL error */
	HAS_FIXED_FUNCTION = 1 << 0, HAS_BUFFERS = 1 << 1, HAS_PIXEL_BUFFERS = 1 << 2, HAS_MAP_RANGE = 1 << 3,
	HAS_MULTITEXTURE = 1 << 4, HAS_FOG_COORD = 1 << 5, HAS_SECONDARY_COLOR = 1 << 6, HAS_ATTRIBUTES = 1 << 7,
	HAS_FRAMEBUFFERS = 1 << 8, HAS_READ_FRAMEBUFFER = 1 << 9, HAS_DIVISOR = 1 << 10, HAS_RESTART = 1 << 11,
	HAS_FIXED_RESTART = 1 << 12, HAS_INTEGER_ATTRIBUTES = 1 << 13, HAS_VERTEX_ARRAYS = 1 << 14,
	HAS_PACK_INVERT = 1 << 15, HAS_3D = 1 << 16, HAS_DESKTOP = 1 << 17 /* not OpenGL ES */, HAS_WINDOW_POS = 1 << 18,
	HAS_INDIRECT = 1 << 19, HAS_RESTART_NV = 1 << 20
};

/** 1 where this thread has a context. */
int context_is_current(void);
/** 1 where this thread's current context has the feature. */
int context_has(enum context_feature feature);
/** The current context's tables for content_buffer and mirror_buffer. There must be a current context. */
struct content_table **context_contents(void);
struct mirror_table **context_mirrors(void);
/** The current context's runs; NULL where there is no context. */
struct runs_table **context_runs(void);
/** An integer state of the current context; 0 where it has none. */
int context_get(unsigned pname);

void context_made_current_glx(int ok, void *display, unsigned long drawable, void *context);
void context_made_current_egl(unsigned ok, void *display, void *surface, void *context);
void context_made_current_osmesa(unsigned ok, void *context, int width, int height);
void context_destroyed(void *context);
/** Calls that draw nothing, by which glretrace's window learns of the size that a viewport has given it. */
void context_make_size_known(void);

/** glGetError's answer: errors that the recorder had to fetch come first. */
unsigned context_pending_error(unsigned error);
/** Keep the program's pending errors aside; errors made from here on are the recorder's, until ..._after drops them. */
void context_errors_before(void);
void context_errors_after(void);

/* frame.c: drawables and the ends of frames */

/** What this thread draws to from now on. */
void frame_drawable_glx(void *display, unsigned long drawable);
void frame_drawable_egl(void *display, void *surface);
void frame_drawable_osmesa(void *context, int width, int height);

void drawable_is_window(unsigned long glx_window, unsigned long window);
void drawable_is_pbuffer(void *display, unsigned long pbuffer);
void drawable_may_have_changed(void);

void frame_end_glx(void *display, unsigned long drawable);
void frame_end_egl(void *display, void *surface);
void frame_ended(void);
/** A context was made current for the first time: mark how many bits a pixel of its drawable has. */
void frame_mark_bits(void);

void frame_primitive_begins(void);
void frame_primitive_ended(void);
void frame_drawn(void);
void frame_cleared(unsigned buffers);
/** A call that ends a frame where `record --frame-end` says so, `truth` holds, and something was drawn since the last one. */
void frame_may_end(enum frame_trigger trigger, int truth);

/* reference.c: what the program shows, read back */

/** 1 where frame `frame` is to be read back. */
int reference_wanted(uint64_t frame);
/**
 * Read the current context's default framebuffer; changes no state that the program can see.
 * @param unswapped  1: the frame ends without a swap and shows what is drawn to, be it the front buffer
 */
void reference_read(uint64_t frame, int width, int height, int unswapped);

/** All state that reading pixels depends on set to its initial value, the window's framebuffer bound; then put back. */
enum { READING_PACK = 6, READING_TRANSFER = 10 };
struct reading_state {
	int pack[READING_PACK], map_color, pack_buffer, pack_invert, framebuffer, draw_framebuffer, read_buffer;
	float transfer[READING_TRANSFER];
};
void reading_begin(struct reading_state *s);
void reading_end(const struct reading_state *s);
/** In between: what the window shows, RGBA with 8 bits each, rows from the bottom up; of several samples a pixel their mean. */
void reading_colors(int width, int height, void *pixels);

/* skip.c: frames that are not recorded */

/** 1 while frames are not recorded. */
int skip_active(void);
/** 1 where a draw made now is left out. */
int skip_draws(void);
/** The next frame is not recorded, and so on until skip_end, which puts what they have drawn into the trace. */
void skip_begin(void);
/** @param width, height  of the window; 0 where there is none */
void skip_end(int width, int height);
void skip_list_state(void);
/** The trace's state that pixels pass through on their way in set to its initial value (rows lie close), or put back. */
void skip_make_neutral(int back);
void skip_texture_copied(unsigned target);
void skip_texture_attached(unsigned target, unsigned name);

/* font.c: text of the X server */

/** glXUseXFont has made lists out of a font's characters: writes them, then the call. */
void font_used(unsigned long name, int first, int count, int list);

/* arrays.c: vertex arrays in client memory, written when they are drawn */

/** Array state can have changed. */
void arrays_changed(void);
/** And the trace may now have other pointers than the recorder has written last. */
void arrays_forget(void);
/** 1 where the indices of the draw being written lie at the start of a buffer of the recorder's own. */
int arrays_own_indices(void);
/** The draw has been made. */
void arrays_drawn(void);
void arrays_attributes_used(void);
void arrays_pointer_set(void);
void arrays_unit_used(unsigned texture);
int arrays_pointer_is_offset(void);
int arrays_interleave_is_offset(unsigned format);
void arrays_interleaved(unsigned format);
void arrays_begin(void);
int arrays_element_is_offset(int index);
void arrays_ended(void);
void arrays_draw(int first, int count, int instances, unsigned base_instance);
void arrays_draw_elements(int count, unsigned type, const void *indices, int base_vertex, int instances,
                          unsigned base_instance);
void arrays_multi_draw(const int *first, const int *count, int draws);
void arrays_multi_draw_elements(const int *count, unsigned type, const void *const *indices, int draws,
                                const int *base_vertex);
void arrays_draw_indirect(const void *indirect, int draws, int stride);
void arrays_draw_elements_indirect(unsigned type, const void *indirect, int draws, int stride);

/* wrap.c: values that depend on state */

/** 1 where pixel pointers are offsets in a bound unpack buffer. */
int pixels_in_buffer(void);
/** Pixels in client memory as the unpack state lays them out, or the offset. */
uint8_t *put_image(uint8_t *p, const void *pixels, int dims, unsigned format, unsigned type, int width, int height,
                   int depth);
/** Before a call whose pixels may have been seen before, and after it. */
void image_used(const void *pixels, int dims, unsigned format, unsigned type, int width, int height, int depth);
void image_written(void);
uint8_t *put_indices(uint8_t *p, const void *indices, int count, unsigned type);
uint8_t *put_multi_indices(uint8_t *p, const void *const *indices, const int *counts, unsigned type, int draws);
/** The parameters of indirect draws: of how many bytes they are, and they themselves or their offset. */
long indirect_bytes(int elements, int draws, int stride);
uint8_t *put_indirect(uint8_t *p, const void *indirect, long bytes);
uint8_t *put_attribs(uint8_t *p, const int *list, int end);
uint8_t *put_attribs_wide(uint8_t *p, const long *list, long end);
long polygon_stipple_count(void);

/* readback.c: how much the program has read back; -1: not into memory, or not known */

long read_pixels_bytes(unsigned format, unsigned type, int width, int height);
long texture_image_bytes(unsigned target, int level, unsigned format, unsigned type);
long compressed_image_bytes(unsigned target, int level);
/** So many bytes that a call has returned; below 0: their address, or offset in a buffer. */
uint8_t *put_returned(uint8_t *p, const void *data, long bytes);

#endif
