/*
 * The machine that executes calls: shared by the chapters of replay/ and seen by nobody else.
 *
 * A chapter defines one function per command with GLS_HANDLER at the start of a line; gen.py finds these and makes the
 * table from names to them. What the dispatcher does around a handler depends on the command's kind.
 */
#ifndef REPLAY_MACHINE_EXEC_H
#define REPLAY_MACHINE_EXEC_H

#include <stdatomic.h>

#include "capture/format/trace.h"
#include "gl_tokens.h"
#include "base/arena.h"
#include "replay/replay.h"
#include "scene/scene.h"
#include "replay/machine/state.h"
#include "base/table.h"

struct gls_exec;

typedef void gls_handler(struct gls_exec *x, struct gls_state *st, const struct call *c);

enum gls_kind {
	GLS_KIND_NONE,
	GLS_KIND_VERTEX, /* vertex attributes: anywhere, kept in lists, pending vertices stay pending */
	GLS_KIND_INSIDE, /* the same, but the handler decides what becomes of pending vertices (Material, CallList, End) */
	GLS_KIND_STATE,  /* outside Begin/End only, kept in lists; pending vertices are drawn first, material and view are stale */
	GLS_KIND_MATRIX, /* as STATE, but only the current matrix changes */
	GLS_KIND_ARRAY,  /* draws from client state: outside Begin/End only; into a list goes what it drew */
	GLS_KIND_CLIENT, /* client state: anywhere, never kept in lists, changes nothing that is pending */
	GLS_KIND_NOW,    /* outside Begin/End only, never kept in lists: client state, objects, queries */
	GLS_KIND_WINDOW  /* window system and memory: no context needed, st may be NULL */
};

#define GLS_HANDLER(name, kind) \
	void gls_##name(struct gls_exec *x __attribute__((unused)), struct gls_state *st __attribute__((unused)), \
	                const struct call *c __attribute__((unused)))

enum gls_drawing { GLS_DRAWS = 1, GLS_ENDS }; /* capture/gen/overlay.txt: does nothing but draw; ends a frame */

struct gls_command {
	const char *name;
	gls_handler *handler; /* NULL: excused, or not done yet */
	uint32_t kind;
	const char *excuse;   /* why nothing needs to be done */
	uint32_t core;        /* 1: part of GL 1.0 - 2.1 */
	uint32_t drawing;     /* enum gls_drawing, or 0 */
};
extern const struct gls_command gls_commands[]; /* sorted by name */
extern const unsigned n_gls_commands;

/** Index in gls_commands, or -1. */
int32_t gls_command_find(const char *name);

/* ---- arguments ---- */

/** Any numeric value (numbers, enums, booleans, masks, pointers) as the type wanted; 0 where there is none. */
double gls_value_double(const struct trace_value *v);
int64_t gls_value_int(const struct trace_value *v);

static inline const struct trace_value *arg(const struct call *c, unsigned i)
{
	extern const struct trace_value gls_no_value;
	return i < c->n_args ? &c->args[i] : &gls_no_value;
}
static inline float arg_f(const struct call *c, unsigned i)
{
	const struct trace_value *v = arg(c, i);
	return v->type == TRACE_FLOAT ? v->f : (float)gls_value_double(v);
}
/** A token or an index that was handed over as a float; 0 for what is none. */
static inline uint32_t token_of_float(float v)
{
	return v >= 0.0f && v < 4294967296.0f ? (uint32_t)v : 0;
}
static inline double arg_d(const struct call *c, unsigned i)
{
	return gls_value_double(arg(c, i));
}
static inline int64_t arg_i(const struct call *c, unsigned i)
{
	return gls_value_int(arg(c, i));
}
static inline uint32_t arg_u(const struct call *c, unsigned i)
{
	return (uint32_t)gls_value_int(arg(c, i));
}
/** A GLint that is reckoned with: 32 bits, whatever the recording says, so that sums of some fit 64. */
static inline int64_t arg_i32(const struct call *c, unsigned i)
{
	return (int32_t)gls_value_int(arg(c, i));
}
/** Numbers of an array argument (or one plain number). @return how many there were; the rest of out is left alone */
unsigned arg_floats(const struct call *c, unsigned i, float *out, unsigned n);
unsigned arg_uints(const struct call *c, unsigned i, uint32_t *out, unsigned n);
/** Elements of an array argument, NULL and 0 where it is none. */
const struct trace_value *arg_items(const struct call *c, unsigned i, uint64_t *n);
/** Bytes of a blob argument, NULL where it is none. */
const uint8_t *arg_blob(const struct call *c, unsigned i, size_t *n);
/** 1 where the argument is an address or NULL: an offset in a buffer object. */
int arg_is_offset(const struct call *c, unsigned i);

/* ---- geometry ---- */

/* A mesh of the cache. Referenced by the cache itself, by lists and by scenes; freed with the last reference. */
struct gls_mesh {
	struct scene_mesh mesh; /* first */
	atomic_uint refs;
	uint64_t used_frame;    /* last frame that drew it */
	uint32_t slot;          /* its place in the scene under construction, where slot_frame says so */
	uint64_t slot_frame;
	uint32_t n_draws;       /* draws inside: highest primitive_draw + 1 */
	size_t bytes;
};
struct gls_texture_image; /* texture.h */

#define GLS_MAX_PENDING_VERTICES (1u << 20)

/* Vertices collected and not drawn yet. All arrays grow and are kept. */
struct gls_geometry {
	enum scene_primitive kind;
	uint32_t n_vertices, room_vertices;
	uint32_t given; /* attributes that vary, as scene_mesh.attributes */
	float *position, *attribute[N_GLS_ATTRIBUTES]; /* 4 floats each, whatever the attribute */
	struct scene_face (*face)[2]; /* where `given` has SCENE_HAS_FACE */
	uint8_t *edge;  /* edge flag of each vertex */
	uint32_t *index, *primitive_draw;
	uint8_t *edge_flags;
	uint32_t n_primitives, room_primitives;
	uint32_t n_draws;        /* Begin..End pairs so far */
	uint32_t begin_vertex;   /* first vertex of the open Begin */
	uint32_t edges_hidden;   /* any edge flag is off */
	uint32_t quads;          /* 1: all primitives come from GL_QUADS */
	uint32_t touched;        /* attributes that may differ from `constant` by now: 1 << attribute */
	float constant[N_GLS_ATTRIBUTES][4]; /* values of attributes that do not vary */
};

/** Forget all vertices. */
void gls_geometry_clear(struct gls_geometry *g);
void gls_geometry_free(struct gls_geometry *g);
/** Room for n more vertices of the attributes in `given`, and n more primitives. @return 0 or ERR_SYSTEM (reported) */
int gls_geometry_reserve(struct gls_geometry *g, uint32_t n_vertices, uint32_t n_primitives);
/** Make an attribute vary: vertices so far get `constant`. @return 0 or ERR_SYSTEM */
int gls_geometry_vary(struct gls_geometry *g, unsigned attribute);
/** Make the material vary: vertices so far get `face`, front and back. @return 0 or ERR_SYSTEM */
int gls_geometry_vary_face(struct gls_geometry *g, const struct scene_face face[2]);
/** Triangles, lines or points that a primitive mode is cut into: SCENE_*; 0 for no mode of GL's. */
enum scene_primitive gls_mode_kind(uint32_t mode);
/**
 * Cut vertices of a primitive mode as Mesa does, provoking vertex last.
 * @param elements  [count] vertex numbers, NULL: first .. first + count - 1
 * @param first_provokes  1: separate triangles, strips and fans go by FIRST_VERTEX_CONVENTION (ARB_provoking_vertex); lines, which
 *                  have a direction, are left to who draws them
 * @return 0 or ERR_SYSTEM
 */
int gls_geometry_cut(struct gls_geometry *g, uint32_t mode, uint32_t first, uint32_t count, const uint32_t *elements, int first_provokes);
/**
 * Cut the other way, from the first to the third vertex, the quads of a geometry that holds nothing else: llvmpipe does so with
 * quads that come without indices (not in lists, then), are shaded smoothly, and of which nothing has to be clipped.
 */
void gls_geometry_turn_quads(struct gls_geometry *g);
/** 1 where quads with these positions ([n][4]) are cut the other way under the current state. */
int gls_quads_turn(const struct gls_state *st, const float *position, uint32_t n);
/** Find or make the mesh of what is collected. @return a reference, or NULL: nothing to draw, or out of memory (reported) */
struct gls_mesh *gls_geometry_mesh(struct gls_exec *x, struct gls_geometry *g);
void gls_mesh_release(struct gls_mesh *mesh);

/* ---- lists ---- */

enum gls_op_form { GLS_OP_CALL, GLS_OP_FLOATS, GLS_OP_FLOAT_ARRAY, GLS_OP_MESH };

/* One call of a list: its arguments in the list's arena. */
struct gls_op {
	uint16_t form;
	uint16_t command;
	uint32_t n; /* arguments, or floats */
	union {
		const struct trace_value *args; /* CALL */
		const float *floats;            /* FLOATS, FLOAT_ARRAY */
		const struct gls_op_mesh *mesh; /* MESH */
	};
	const struct gls_pixel_store *unpack; /* how to read pixels among the arguments; NULL: there are none */
};
/* Begin..End runs or an array draw, assembled when the list was made. */
struct gls_op_mesh {
	struct gls_mesh *mesh; /* a reference, or NULL: only attributes */
	uint32_t before, after; /* attributes set before the first vertex, and to be set after the last: 1 << attribute */
	const float (*before_values)[4], (*after_values)[4]; /* in ascending order of attribute */
	uint32_t n_draws;
	uint32_t first_provokes; /* as it was cut */
};
/* What a list leaves behind when nothing is drawn (effect.c). All zero: not made yet. */
struct gls_effect {
	struct gls_op *ops; /* owned; what they point to belongs to the lists they come from */
	uint32_t n;
	uint32_t pushes, nesting; /* of the matrix stack and of lists, as far as they are left out */
	uint32_t n_made, none;    /* how often it was; 1: there is none */
	uint64_t epoch;           /* of the share group when it was made, + 1 */
};
struct gls_list {
	struct gls_op *ops;
	uint32_t n, room;
	struct arena arena;
	struct gls_effect effect;
	uint32_t inlined, skipped; /* 1: effects of other lists may hold ops of this one; calls of it in frames that were skipped */
	uint64_t name[2], bytes, held; /* of its blob, and of that and its meshes' together (snapshot.c); held 0: not known yet */
};
#define GLS_MAX_LIST_NESTING 64
void gls_list_free(struct gls_list *list);
/** What to run in place of a list that is called now: its effect, borrowed until lists or textures go; NULL: the list itself. */
const struct gls_effect *gls_effect_of(const struct gls_exec *x, struct gls_state *st, struct gls_list *list);
/** Keep a call in the list being compiled. @return 0 or ERR_SYSTEM (reported) */
int gls_list_append(struct gls_exec *x, struct gls_state *st, const struct call *c);
/** Keep a mesh in it (takes the reference). */
int gls_list_append_mesh(struct gls_exec *x, struct gls_list *list, const struct gls_op_mesh *mesh);

/* ---- objects ---- */

struct gls_buffer {
	uint8_t *data;
	size_t bytes;
	uint64_t version; /* changes with the contents; unique among all buffers */
	uint64_t mapped;  /* address the program saw, 0: not mapped */
	size_t map_offset, map_bytes;
};

/* What an attachment point of a framebuffer object names: a renderbuffer, or an image of a texture; neither: nothing. */
struct gls_attachment {
	uint32_t texture, renderbuffer; /* names */
	uint32_t face, level, layer;    /* of the texture */
};
enum { GLS_ATTACHMENT_DEPTH = 8, GLS_ATTACHMENT_STENCIL, N_GLS_ATTACHMENTS }; /* below: colours */
struct gls_framebuffer;

struct gls_renderbuffer {
	uint32_t internal_format, width, height;
	uint32_t missing;            /* as of a texture's level */
	uint32_t samples;            /* of a pixel; 0: one */
	struct gls_picture *content; /* a reference; NULL: black, far and 0 */
};

struct gls_share {
	unsigned refs;
	struct table lists, textures, buffers; /* name -> struct gls_list, gls_texture, gls_buffer */
	struct table programs;                 /* ARB program name -> target + 1 */
	struct table framebuffers, renderbuffers; /* name (0: the window) -> struct gls_framebuffer, gls_renderbuffer */
	struct gls_texture *defaults[N_GLS_TEXTURE_TARGETS];
	uint64_t epoch; /* changes when a texture goes, or a list that another one's effect was made of */
};

struct gls_context {
	uint64_t handle, share_handle;
	const char *api;
	uint64_t calls;
	int destroyed, shares;
	struct gls_state state;
};

/* A picture that several may hold on to; freed with the last reference, in any thread. */
struct gls_picture {
	struct scene_picture picture; /* first */
	atomic_uint refs;
};

/* Something that is drawn to: what it held, and what happened to it since. All zero: black, and nothing happened. */
struct gls_surface {
	uint32_t width, height, depth_bits, stencil_bits, alpha_bits;
	uint32_t samples, samples_from_below, floats; /* as in struct scene */
	struct gls_frame *frame;     /* owned: events; NULL: none */
	struct gls_picture *picture; /* a reference: what it held before them, */
	struct scene *before;        /* or a reference to the scene that makes it so; at most one of the two is there */
	int carried;                 /* 1: some of the events are of earlier frames, which nobody wanted */
	int is_front;                /* 1: a front buffer beside a back buffer */
	int skipped;                 /* 1: neither, because it was drawn to in frames that were skipped */
};

/* A framebuffer object. */
struct gls_framebuffer {
	struct gls_attachment attached[N_GLS_ATTACHMENTS];
	uint32_t draw_buffer, read_buffer; /* GL tokens, while it is not bound */
	uint32_t also_drawn;               /* as in struct gls_color, while it is not bound */
	uint32_t drawn_buffer;             /* what the surface's events draw to, */
	uint32_t drawn_too;                /* and other colours, 1 << number: each begins from what it held itself */
	struct gls_surface surface;
	struct gls_picture *read; /* a reference: what was read last */
};

/* A window or pbuffer as far as the trace tells. */
struct gls_drawable {
	uint32_t width, height;
	int fixed; /* size said by the recorder (relume:drawable) and not guessed from viewports */
	struct gls_surface surface; /* the back buffer, or the only one */
	struct gls_surface front;   /* of two; without events while it has not parted (front.c) */
	int parted;                 /* 1: both get every event */
	int16_t *accum; /* owned: the accumulation buffer, [height][width][4], see accum.c; NULL: all 0 */
	uint32_t accum_width, accum_height;
	uint32_t accum_missing; /* 1: it was changed in a frame that was skipped */
};

/* ---- the scene under construction ---- */

struct gls_frame;

/* ---- the machine ---- */

struct gls_exec {
	const char *path;    /* of the trace, for messages */
	int want;            /* 1: scenes are built */
	int failed;          /* ERR_*: a handler met a failure of ours */
	uint64_t frame;      /* being executed */
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

	struct gls_geometry geometry; /* pending vertices of st */
	struct gls_geometry compiling; /* of list assembly and array draws */
	struct gls_state *assembling; /* state that a list's vertices are run through when it is made (list.c) */
	uint64_t pending_call;        /* number of the call that began them */
	uint32_t pending_command, pending_list;
	uint32_t drawn_list;          /* the outermost list being called; 0: none */
	const struct call *call;      /* being executed */
	uint32_t command;             /* its index */
	unsigned list_depth;
	uint64_t repeated, repeated_frame; /* what calls made of themselves in that frame: gls_is_beyond_measure */
	uint64_t swapped;             /* drawable of the swap that ended the frame */
	int unswapped;                /* 1: it ended without a swap */
	int fronts;                   /* 1: what front buffers show is looked at */
	uint64_t serial;              /* of the last scene begun */
	replay_supply *supply;        /* makes pixels; NULL: nobody does */
	void *supply_user;
	int missing;                  /* 1: some texture has pixels missing that were drawn in skipped frames */
	int shows_through;            /* 1: some frame did show what was there before it */
	int rewind;                   /* 1: a frame needs pixels of skipped ones: all must be built from the start */
	struct table meshes;          /* low half of the hash -> struct gls_mesh (chains by probing the high half) */
	struct table draws;           /* key of an array draw -> struct gls_mesh */
	struct table images;          /* texture contents */
	size_t mesh_bytes, image_bytes;
	uint64_t versions;            /* last one given to a buffer, array or texture */
	struct table maps;            /* mapped address -> struct gls_buffer */
	uint8_t *scratch;             /* for anyone, between two lines */
	uint32_t *elements;           /* indices of the draw being executed */
	size_t elements_room;
	size_t scratch_room;

	uint64_t n_calls;
	uint64_t *count, *unsupported, *errors; /* [n_gls_commands] */
	const char **why;                       /* [n_gls_commands] what of it is not done */
	uint32_t *error_code;                   /* [n_gls_commands] the last one */
	struct table unknown;                   /* name -> count, of calls in no table */
	uint64_t without_context;
};

int gls_exec_create(struct gls_exec **out, const char *path);
void gls_exec_destroy(struct gls_exec **x);

/** Go on counting calls, errors and what is not done where another machine stopped (the two exchange their counts). */
void gls_exec_take_counts(struct gls_exec *x, struct gls_exec *other);

/** Execute a call of the trace. @return 0 or ERR_SYSTEM (reported) */
int gls_exec_call(struct gls_exec *x, const struct call *c);

/** Run a command of the table as if it had been met (from lists and by handlers). */
void gls_dispatch(struct gls_exec *x, const struct call *c, uint32_t command);

/** Draw what is pending; called before any state that draws look at changes. */
void gls_flush(struct gls_exec *x);

/** A GL error of the program in the current call. */
void gls_error(struct gls_exec *x, struct gls_state *st, uint32_t error);

/** The current call, or the part of it named by `why` (a static string), is not done yet. */
void gls_unsupported(struct gls_exec *x, const char *why);

/** Scratch memory of n bytes, valid until the next call of this; NULL: out of memory (reported, x->failed). */
void *gls_scratch(struct gls_exec *x, size_t n);
/** Note a failure of ours: the run ends with it. */
void gls_out_of_memory(struct gls_exec *x, size_t bytes);

/* ---- between chapters ---- */

/* Handlers that others call as part of what they do. */
gls_handler gls_glBegin, gls_glEnd, gls_glBindFramebuffer, gls_glBindRenderbuffer;
/* Handlers that list.c and effect.c know something of. */
gls_handler gls_glTranslatef, gls_glTranslated, gls_glRotatef, gls_glRotated, gls_glScalef, gls_glScaled, gls_glMultMatrixf,
	gls_glMultMatrixd, gls_glLoadIdentity, gls_glLoadMatrixf, gls_glLoadMatrixd, gls_glPushMatrix, gls_glPopMatrix,
	gls_glMatrixMode, gls_glCallList, gls_glBindTexture, gls_glActiveTexture, gls_glPopAttrib, gls_glEdgeFlag, gls_glEdgeFlagv,
	gls_glMaterialf, gls_glMaterialfv, gls_glMateriali, gls_glMaterialiv;

void gls_set_attribute(struct gls_exec *x, struct gls_state *st, unsigned attribute, const float value[4]);
void gls_vertex(struct gls_exec *x, struct gls_state *st, const float position[4]);
void gls_color_changed(struct gls_state *st);
/** Called before a material parameter changes, which may happen between Begin and End. */
void gls_before_material(struct gls_exec *x, struct gls_state *st);
struct gls_matrix_stack *gls_current_stack(struct gls_state *st);
void gls_enable(struct gls_exec *x, struct gls_state *st, uint32_t cap, int on);
void gls_call_list(struct gls_exec *x, struct gls_state *st, uint32_t name);
/**
 * A list that calls the next one twice, and so on, or itself, runs longer than anybody waits, in a driver too; so do instances without
 * end. What a few calls make of themselves may come to so much a frame for each call recorded so far that no program comes near it.
 * @param n    more of it: operations that a list called by a list runs, instances, some points of evaluated meshes
 * @param why  what to count the call as where it is too much
 * @return 1 where it is too much
 */
int gls_is_beyond_measure(struct gls_exec *x, uint64_t n, const char *why);
void gls_make_current(struct gls_exec *x, struct gls_context *ctx, uint64_t drawable, uint64_t read);
struct gls_drawable *gls_drawable_of(struct gls_exec *x, struct gls_state *st);
void gls_array_set_client(struct gls_exec *x, struct gls_array *array, const uint8_t *data, size_t n);
/** The initial values of vertex arrays (GL 2.1 table 6.6). */
void gls_arrays_init(struct gls_array arrays[N_GLS_ARRAYS]);
/** Bind a vertex array object, made where there is none of this name. */
void gls_vertex_array_bind(struct gls_exec *x, struct gls_state *st, uint32_t name);
void gls_vertex_array_free(struct gls_vertex_array *object);
struct gls_buffer *gls_buffer_find(struct gls_state *st, uint32_t name);
/** The bits of drawables that a context made for this visual or configuration draws to, as far as they are known. */
void gls_config_apply(struct gls_exec *x, struct gls_state *st, const struct trace_value *config);
void gls_share_release(struct gls_share *share);
struct gls_share *gls_share_create(void);

void gls_image_cache_free(struct gls_exec *x);

/* scene.c: events of a surface. Without a scene under construction (x->want 0) nothing happens. */
/** 1 where drawing and clearing reach a surface, or would if it were wanted: neither selection nor feedback (sec. 5.2, 5.3). */
static inline int gls_renders(const struct gls_state *st)
{
	return st->render_mode == GL_RENDER && !st->rasterizer_discard;
}
/** 1 where they reach the surface. */
static inline int gls_is_drawn(const struct gls_exec *x, const struct gls_state *st)
{
	return x->want && gls_renders(st);
}
/**
 * Draw a mesh with the state as it is.
 * @param mesh    no reference is taken (the scene takes its own)
 * @param values  attributes that the mesh does not give
 */
void gls_frame_add(struct gls_exec *x, struct gls_state *st, struct gls_mesh *mesh, const float (*values)[4],
                   uint32_t command, uint64_t call_number);
/**
 * Draw a bitmap or pixel rectangle; values: the raster position's attributes, final. r->texture is filled in from the image.
 * @param corner  window coordinates, z the window depth
 */
struct gls_texture_image;
void gls_frame_add_rectangle(struct gls_exec *x, struct gls_state *st, const struct scene_rectangle *r,
                             struct gls_texture_image *image, const float corner[4], const float (*values)[4]);
void gls_frame_clear(struct gls_exec *x, struct gls_state *st, uint32_t buffers);
/** The scene of all events so far, valid until the next one; begun where there is none. Borrowed; NULL: out of memory. */
struct scene *gls_frame_scene(struct gls_exec *x, struct gls_surface *surface);
/** The same, taken out of the surface: a reference for the caller. No events are left. */
struct scene *gls_frame_take(struct gls_exec *x, struct gls_surface *surface);
/** Forget all events. */
void gls_frame_drop(struct gls_surface *surface);
/** Nothing from before the events shows any more. */
void gls_frame_all_known(struct gls_surface *surface);
/** The scene so far becomes another one: what was rendered of it is not looked for. */
void gls_frame_renew(struct gls_exec *x, struct gls_surface *surface);
uint64_t gls_frame_events(const struct gls_surface *surface);
/** Where the picture of the first *events events is kept; the surface must have a frame. */
struct gls_picture **gls_frame_snapshot(struct gls_surface *surface, uint64_t **events);
struct scene *gls_scene_reference(struct scene *scene);

/* feedback.c: pixels that were drawn and are needed */
/** What the context draws to; NULL: out of memory, or an incomplete framebuffer object. */
struct gls_surface *gls_surface_of(struct gls_exec *x, struct gls_state *st);
/**
 * The pixels of a surface as all events so far leave them.
 * @return borrowed, valid until the surface's next event; NULL: not to be had (counted, or x->rewind is set)
 */
const struct scene_picture *gls_surface_read(struct gls_exec *x, struct gls_surface *surface);
/** Let the same events begin from another picture (takes the reference). @return 1; 0: what it was before does not show */
int gls_surface_restart(struct gls_exec *x, struct gls_surface *surface, struct gls_picture *picture);
/** The same of what the context reads from (ReadBuffer, read framebuffer, read drawable). */
const struct scene_picture *gls_read_screen(struct gls_exec *x, struct gls_state *st);
/** Make `to`, which holds nothing, begin from what `from` begins from. */
void gls_surface_share(struct gls_surface *to, const struct gls_surface *from);
/** The frame of the drawable that was swapped: its scene, a reference for the caller; NULL: out of memory or x->rewind. */
struct scene *gls_frame_finish(struct gls_exec *x);
/**
 * A frame ended that was built only for what later ones show of it: its events stay, so that a hundred such frames are one
 * scene, rendered once if at all. The second call is made before a frame that is wanted.
 */
void gls_frame_carry(struct gls_exec *x);
void gls_frame_stop_carrying(struct gls_exec *x);
/** A frame was executed without being built: what it drew is not known. */
void gls_frame_skip(struct gls_exec *x);
void gls_surface_free(struct gls_surface *surface);
/** A black one, far and 0; floats: its colours are there as floats, too. @return a reference; NULL: out of memory (reported) */
struct gls_picture *gls_picture_make(struct gls_exec *x, uint32_t width, uint32_t height, uint32_t depth_bits,
                                     uint32_t alpha_bits, uint32_t samples, uint32_t floats);
/** The colour of a place in a picture. */
void gls_picture_color(const struct scene_picture *p, size_t place, float out[4]);
/** Kind of pixels that colours for what is drawn to should come as, so that none is clamped that need not be. */
uint32_t gls_color_pixels(struct gls_exec *x, struct gls_state *st);
void gls_picture_release(struct gls_picture *picture);

/* front.c: two buffers of a window */
struct gls_target {
	struct gls_surface *surface;
	int colored; /* 0: the context draws to another buffer, which has the same depth and stencil buffers */
};
/** The surfaces that an event of the context changes. @return how many; 0: none, or out of memory */
unsigned gls_targets_of(struct gls_exec *x, struct gls_state *st, struct gls_target out[2]);
/** 1 where the context draws to its window's front buffer beside a back buffer; where it reads from that. */
int gls_front_is_drawn(const struct gls_state *st);
int gls_front_is_read(const struct gls_state *st);
/** From now until the next swap the front buffer is apart from the back buffer. @return it */
struct gls_surface *gls_front_part(struct gls_exec *x, struct gls_drawable *d);
/** The back buffer, whose scene has just ended, was swapped to the front. */
void gls_front_swapped(struct gls_drawable *d);

/* framebuffer.c: framebuffer objects */
/** What the bound object draws to; NULL: out of memory, or nothing is attached. */
struct gls_surface *gls_framebuffer_surface(struct gls_exec *x, struct gls_state *st);
/** As gls_read_screen, of the bound read object. */
const struct scene_picture *gls_framebuffer_read(struct gls_exec *x, struct gls_state *st);
/** The bound object, if it is one, may have been drawn to in a frame that is not built. */
void gls_framebuffer_touch(struct gls_exec *x, struct gls_state *st);
/** Bring textures up to date that are drawn to: one that is looked at or changed; all that a draw looks at. */
struct gls_texture;
void gls_texture_settle(struct gls_exec *x, const struct gls_state *st, const struct gls_texture *t);
void gls_units_settle(struct gls_exec *x, struct gls_state *st);
/** A texture is deleted. */
void gls_texture_detach(struct gls_exec *x, struct gls_state *st, uint32_t name);
void gls_framebuffer_free(struct gls_framebuffer *fb);
void gls_renderbuffer_free(struct gls_renderbuffer *r);
/** glDrawArrays: draw, or keep in the list that is being made; errors as GL has them. */
void gls_draw_arrays(struct gls_exec *x, struct gls_state *st, uint32_t mode, int64_t first, int64_t count);
/**
 * glDrawElementsBaseVertex.
 * @param indices  a blob of them, or their offset in the element buffer
 */
void gls_draw_elements(struct gls_exec *x, struct gls_state *st, uint32_t mode, int64_t count, uint32_t type,
                       const struct trace_value *indices, int32_t base);

/** Draw a rectangle of pixels (pixels.c) with the raster position's attributes; left, low: its first pixel's outer corner. */
void gls_draw_rectangle(struct gls_exec *x, struct gls_state *st, uint32_t kind, float left, float low, uint32_t width,
                        uint32_t height, const float zoom[2], const uint8_t *texels);
/** The same, but that nothing touches the fragments but scissor, colour mask and masks of the kind of pixels. */
void gls_draw_rectangle_plainly(struct gls_exec *x, struct gls_state *st, uint32_t kind, float left, float low, uint32_t width,
                                uint32_t height, const float zoom[2], const uint8_t *texels);

/** Clear the accumulation buffer (accum.c). */
void gls_accum_clear(struct gls_exec *x, struct gls_state *st);

void gls_mesh_cache_trim(struct gls_exec *x);
void gls_image_cache_trim(struct gls_exec *x);
void gls_mesh_cache_free(struct gls_exec *x);

#endif
