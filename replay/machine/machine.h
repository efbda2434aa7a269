/* The machine that executes calls: what it knows while it runs a recording. The chapters of replay/gl/ and the index
 * see it. */
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
	const char *api;               /* "GLX", "EGL" ... */
	uint64_t calls;                /* made while it was current */
	int destroyed, shares;         /* 1: it lives until it is released; another context shares its objects */
	struct gls_state state;
};

/* Calls met so far, by command. */
struct gls_counts {
	uint64_t *calls, *unsupported, *errors; /* [n_gls_commands] */
	const char **why;                       /* [n_gls_commands] the part that is not done; NULL: all of it */
	uint32_t *error_code;                   /* [n_gls_commands] the last one */
	struct table unknown;                   /* name -> count, of calls in no table */
	uint64_t programs;                      /* draws by one that is not run */
	struct table program_draws;             /* gls_program_current -> draws, of all that are used */
	uint64_t programs_used;                 /* calls that make a program object current that is not run */
	const char *programs_why;               /* what stood in the way of the last one; lives as long as these */
	char **reasons;                         /* owned: what programs said that may be gone by now */
	uint32_t n_reasons, reason_room;
	uint64_t window;                        /* of the first frame */
	int several_windows;                    /* 1: another frame ended in another one */
};

/* Vertices of gls_exec.st that are not drawn yet (gl/geometry/pending.h). */
struct gls_pending {
	struct gls_geometry geometry;
	uint64_t call; /* number of the call that began them */
	uint32_t command, list; /* that call's command, and the list it came from */
	int mixes; /* 1: quads may join other polygons, as they do in lists */
};

/* Contents that were met before, found by hash. */
struct gls_caches {
	struct table meshes;     /* low half of the hash -> struct gls_mesh (chains by probing the high half) */
	struct table draws;      /* key of an array draw -> struct gls_mesh */
	struct table images;     /* texture contents */
	size_t mesh_bytes, image_bytes;
	uint64_t versions;       /* of buffers: the last one */
};

/* Memory for whoever needs it during one call. */
struct gls_scratch {
	uint8_t *bytes;
	size_t room;
	uint32_t *elements; /* indices of the draw being executed */
	size_t elements_room;
	struct gls_geometry geometry; /* of array draws and rectangles */
};

/* Pixels that were drawn and are needed (gl/surface/surface.h). */
struct gls_feedback {
	scene_supply *supply; /* NULL: nobody makes pixels */
	void *supply_user;
	int keeps_targets; /* 1: pictures of framebuffer objects stay pictures (surface/shown.h) */
	int leaves_starts; /* 1: who renders frames makes what they begin with (scene/before.h) */
	int fronts;        /* 1: something reads front buffers */
	int missing;       /* 1: some texture lacks pixels that were drawn in skipped frames */
	int shows_earlier; /* 1: the frame used a buffer that lacks what an earlier frame read into it */
	int shows_through; /* 1: some frame showed what was there before it */
	int rewind;        /* 1: a frame needs pixels of skipped frames: the replay must build those before it */
	const char *rewind_why; /* what it needs them for; a static string */
	uint32_t rewind_command; /* the call that found out */
	uint64_t rewind_call;    /* its number */
};

struct gls_exec;

/** Run a command from a list, or as part of another command. unpack: as in gls_exec. */
typedef void gls_dispatcher(struct gls_exec *x, const struct call *c, uint32_t command,
                            const struct gls_pixel_store *unpack);

struct gls_exec {
	const char *path;    /* of the trace, for messages */
	int want;            /* 1: build scenes */
	int failed;          /* ERR_*: we failed (errors.h) */
	uint64_t frame;      /* being executed */
	uint64_t time_ns;    /* when it ended, as the recorder says; 0: not known */
	int frame_ended;     /* set by swaps */
	int is_ours;         /* 1: our recorder has left its mark */

	struct gls_context **contexts; /* owned, in order of creation */
	size_t n_contexts;
	struct gls_context *current; /* of the thread whose call is executed */
	struct gls_state *st;        /* &current->state or NULL */
	struct gls_context **threads; /* current context of each thread */
	size_t n_threads;
	uint64_t thread;
	struct table drawables;
	struct table configs; /* of drawables, see config.c */
	uint32_t egl_api;     /* what eglBindAPI has chosen; 0: nothing */
	struct table maps;    /* mapped address -> struct gls_buffer */

	const struct call *call;      /* being executed */
	uint32_t command;             /* its index */
	const struct gls_pixel_store *unpack; /* how its pixels lie in client memory; NULL: as the state says */
	uint32_t drawn_list;          /* the outermost list being called; 0: none */
	unsigned list_depth;
	uint64_t repeated, repeated_frame; /* work that calls multiplied in that frame (gls_is_beyond_measure) */
	uint64_t swapped;             /* drawable of the swap that ended the frame */
	int unswapped;                /* 1: it ended without a swap */

	gls_dispatcher *dispatch; /* how handlers reach gl/dispatch.c, which stands above them; `command` is then what
	                             was run */
	struct gls_exec *assembler;   /* the machine in which lists are assembled (list_assemble.h); NULL: none yet */

	struct gls_pending pending;
	struct gls_caches caches;
	struct gls_scratch scratch;
	struct gls_feedback feedback;
	uint64_t n_calls, without_context;
	struct gls_counts counts;
};

/** How pixels of the current call lie in client memory. A list keeps the layout of the moment when it was made
 * (sec. 5.4). */
static inline const struct gls_pixel_store *gls_client_store(const struct gls_exec *x, const struct gls_state *st)
{
	return x->unpack ? x->unpack : &st->client.unpack;
}
