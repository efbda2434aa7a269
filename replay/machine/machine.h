/*
 * The machine that executes calls, with all it knows while it plays a recording. The chapters of replay/gl/ and the
 * index use it.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "replay/machine/geometry.h"
#include "replay/machine/state.h"
#include "base/table.h"
#include "scene/scene.h"

struct call;
struct gls_mesh;

struct gls_context {
	uint64_t handle, share_handle; /* addresses in the program */
	const char *api;               /* "GLX", "EGL", "GLX, core profile" ... */
	uint64_t calls;                /* made while it was current */
	int destroyed, shares;         /* 1: released as soon as nothing uses it; 1: another context shares its objects */
	struct gls_state state;
};

/* Calls executed so far, by command. */
struct gls_counts {
	uint64_t *calls, *unsupported, *errors; /* [n_gls_commands] */
	const char **why;                       /* [n_gls_commands] the part that is not supported; NULL: all of it */
	uint32_t *error_code;                   /* [n_gls_commands] the last one */
	struct table unknown;                   /* name -> count, for calls that are in no table */
	uint64_t programs;                      /* draws by a program that is not run */
	struct table program_draws;             /* gls_program_current -> number of draws, for every program used */
	uint64_t programs_used;                 /* calls that make a program object current that is not run */
	const char *programs_why;               /* why the last one is not run; lives as long as these counts */
	char **reasons;                         /* owned: reasons copied from programs that may be gone */
	uint32_t n_reasons, reason_room;
	uint64_t window;                        /* drawable of the first frame's end */
	int several_windows;                    /* 1: another frame ended in a different window */
};

/* The last glProgramStringARB, which queries after it tell more about (gl/state/arb_program.c). */
struct gls_text_set {
	uint64_t key;     /* the program, as gls_program_key names it */
	uint64_t call;    /* its number; 0: there was none, or its program is gone */
	uint32_t command; /* the call's command */
};

/* Vertices of gls_exec.st that are not drawn yet (gl/geometry/pending.h). */
struct gls_pending {
	struct gls_geometry geometry;
	uint64_t call; /* number of the first call that contributed */
	uint32_t command, list; /* that call's command, and the list it came from */
	int mixes; /* 1: quads may be mixed with other polygons, as in lists */
};

/* Contents seen before, found by hash. */
struct gls_caches {
	struct table meshes;     /* low half of the hash -> struct gls_mesh (chains by probing the high half) */
	struct table draws;      /* key of an array draw -> struct gls_mesh */
	struct table images;     /* texture contents */
	size_t mesh_bytes, image_bytes;
	uint64_t versions;       /* last version given to a buffer */
};

/* Memory that any function may use during one call. */
struct gls_scratch {
	uint8_t *bytes;
	size_t room;
	uint32_t *elements; /* indices of the draw being executed */
	size_t elements_room;
	struct gls_geometry geometry; /* for array draws and rectangles */
};

/* Rendered pixels that the program reads back (gl/surface/surface.h). */
struct gls_feedback {
	scene_supply *supply; /* NULL: no renderer */
	void *supply_user;
	int keeps_targets; /* 1: pictures of framebuffer objects are drawn as pictures (surface/shown.h) */
	int leaves_starts; /* 1: the renderer of a frame supplies its initial contents (scene/before.h) */
	int fronts;        /* 1: the program reads front buffers */
	int missing;       /* 1: some texture lacks pixels of skipped frames */
	int shows_earlier; /* 1: the frame used a buffer that lacks pixels of an earlier frame */
	int shows_through; /* 1: some frame showed contents from before it */
	int rewind;        /* 1: a frame needs pixels of skipped frames: the replay must build the frames before it */
	const char *rewind_why; /* why it needs them; a static string */
	uint32_t rewind_command; /* the call that needs them */
	uint64_t rewind_call;    /* its number */
};

struct gls_exec;

/** Run a command from a list, or as part of another command. unpack: as in gls_exec. */
typedef void gls_dispatcher(struct gls_exec *x, const struct call *c, uint32_t command,
                            const struct gls_pixel_store *unpack);

struct gls_exec {
	const char *path;    /* path of the trace, for messages */
	int want;            /* 1: build scenes */
	int failed;          /* ERR_*: our own failure (errors.h) */
	uint64_t frame;      /* being executed */
	uint64_t time_ns;    /* when it ended, according to the recorder; 0: unknown */
	int frame_ended;     /* set by swaps */
	int is_ours;         /* 1: the recording has our recorder's mark */

	struct gls_context **contexts; /* owned, in order of creation */
	size_t n_contexts;
	struct gls_context *current; /* current context of the thread whose call is executed */
	struct gls_state *st;        /* &current->state or NULL */
	struct gls_context **threads; /* current context of each thread */
	size_t n_threads;
	uint64_t thread;
	struct table drawables;
	struct table configs; /* bits of visuals and configurations (config.c) */
	uint32_t egl_api;     /* chosen by eglBindAPI; 0: none */
	struct table maps;    /* mapped address -> struct gls_buffer */

	const struct call *call;      /* being executed */
	uint32_t command;             /* its index */
	const struct gls_pixel_store *unpack; /* layout of its pixels in client memory; NULL: the state's */
	uint32_t drawn_list;          /* the outermost list being called; 0: none */
	unsigned list_depth;
	uint64_t repeated, repeated_frame; /* work multiplied by calls in that frame (gls_is_beyond_measure) */
	uint64_t swapped;             /* drawable of the swap that ended the frame */
	int unswapped;                /* 1: it ended without a swap */

	gls_dispatcher *dispatch; /* lets handlers call gl/dispatch.c, which is a layer above; `command` is then the one
	                             that was run */
	struct gls_exec *assembler;   /* the machine that assembles lists (list_assemble.h); NULL: none yet */

	struct gls_pending pending;
	struct gls_text_set text_set;
	struct gls_caches caches;
	struct gls_scratch scratch;
	struct gls_feedback feedback;
	uint64_t n_calls, without_context;
	struct gls_counts counts;
};

/**
 * Layout of the current call's pixels in client memory. A list keeps the layout that was set when it was compiled (sec.
 * 5.4).
 */
static inline const struct gls_pixel_store *gls_client_store(const struct gls_exec *x, const struct gls_state *st)
{
	return x->unpack ? x->unpack : &st->client.unpack;
}
