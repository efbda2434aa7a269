/* Window systems: contexts, drawables and frame ends, from calls of GLX 1.4, EGL or OSMesa; our recorder's markers. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "capture/format/call.h"
#include "replay/gl/context.h"
#include "replay/gl/geometry/pending.h"
#include "replay/gl/surface/drawable.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "scene/mesa.h"

static void set_current(struct gls_exec *x, struct gls_context *ctx, uint64_t drawable, uint64_t read)
{
	gls_flush(x);
	if (x->thread < x->n_threads)
		x->threads[x->thread] = ctx;
	x->current = ctx;
	x->st = ctx ? &ctx->state : NULL;
	if (!ctx)
		return;
	ctx->state.drawable = drawable;
	ctx->state.read_drawable = read;
	ctx->state.ever_current = 1;
	ctx->state.dirty = GLS_DIRTY_ALL;
}

/* Find a context; create it if that happened before the recording began. */
static struct gls_context *find_or_create(struct gls_exec *x, uint64_t handle, const char *api)
{
	struct gls_context *ctx = gls_context_find(x, handle);

	return ctx ? ctx : gls_context_create(x, handle, 0, NULL, api);
}

static struct gls_context *create_context(struct gls_exec *x, const struct call *c, int64_t share,
                                          const struct trace_value *config, const char *api)
{
	return gls_context_create(x, (uint64_t)gls_value_int(&c->ret), (uint64_t)share, config, api);
}

static void make_current(struct gls_exec *x, const struct call *c, unsigned drawable, unsigned read, unsigned context,
                         const char *api)
{
	uint64_t handle = (uint64_t)arg_i(c, context);

	if (c->ret.type != TRACE_NONE && gls_value_int(&c->ret) == 0)
		return; /* it failed: the old context stays current */
	set_current(x, handle ? find_or_create(x, handle, api) : NULL, (uint64_t)arg_i(c, drawable), (uint64_t)arg_i(c, read));
}

static void destroy_context(struct gls_exec *x, const struct call *c, unsigned context)
{
	struct gls_context *ctx = gls_context_find(x, (uint64_t)arg_i(c, context));

	/* A current context lives until it is released (GLX 1.4 sec. 3.3.7); its handle may be reused for a new one. */
	if (ctx)
		ctx->destroyed = 1;
}

/* A swap ends the drawable's frame, which is also the trace's. */
static void swap(struct gls_exec *x, uint64_t drawable)
{
	gls_flush(x);
	x->unswapped = 0;
	x->swapped = table_find(&x->drawables, drawable) || !x->st ? drawable : x->st->drawable;
	x->frame_ended = 1;
	x->counts.several_windows |= x->counts.window && x->counts.window != x->swapped;
	x->counts.window = x->counts.window ? x->counts.window : x->swapped;
}

/* Names of a context's attributes: major and minor version, profiles. */
static const int64_t glx_names[3] = { 0x2091, 0x2092, 0x9126 }, egl_names[3] = { 0x3098, 0x30FB, 0x30FD };

/*
 * 1 if a call asks for the core profile, which OpenGL 3.2 and later have unless they are asked for the other one
 * (GLX_ARB_create_context_profile; EGL 1.5 sec. 3.7.1.1).
 */
static int asks_for_core(const struct call *c, unsigned attributes, const int64_t names[3])
{
	int64_t values[3] = { 1, 0, 1 };
	uint64_t n;
	const struct trace_value *list = arg_items(c, attributes, &n);

	for (uint64_t i = 0; i + 1 < n; i += 2)
		for (unsigned k = 0; k < 3; k++)
			if (gls_value_int(&list[i]) == names[k])
				values[k] = gls_value_int(&list[i + 1]);
	return (values[0] > 3 || (values[0] == 3 && values[1] >= 2)) && values[2] & 1;
}

GLS_HANDLER(glXCreateContext, WINDOW) { create_context(x, c, arg_i(c, 2), arg(c, 1), "GLX"); }
GLS_HANDLER(glXCreateNewContext, WINDOW) { create_context(x, c, arg_i(c, 3), arg(c, 1), "GLX"); }
GLS_HANDLER(glXCreateContextAttribsARB, WINDOW)
{
	create_context(x, c, arg_i(c, 2), arg(c, 1), asks_for_core(c, 4, glx_names) ? "GLX, core profile" : "GLX");
}
GLS_HANDLER(glXDestroyContext, WINDOW) { destroy_context(x, c, 1); }
GLS_HANDLER(glXMakeCurrent, WINDOW) { make_current(x, c, 1, 1, 2, "GLX"); }
GLS_HANDLER(glXMakeContextCurrent, WINDOW) { make_current(x, c, 1, 2, 3, "GLX"); }
GLS_HANDLER(glXSwapBuffers, WINDOW) { swap(x, (uint64_t)arg_i(c, 1)); }
GLS_HANDLER(glXSwapBuffersMscOML, WINDOW) { swap(x, (uint64_t)arg_i(c, 1)); }
/*
 * The back buffer stays as it is. Our recorder has ended a frame before the call if anything was drawn; in other
 * recordings, pictures that a program shows this way belong to no frame.
 */
GLS_HANDLER(glXCopySubBufferMESA, WINDOW)
{
	const struct gls_drawable *d = x->st ? gls_drawable_of(x, x->st->drawable) : NULL;

	gls_flush(x);
	if (d && d->parted)
		gls_unsupported(x, "it changes a front buffer that is used separately");
	else if (d && d->surface.frame && gls_frame_events(&d->surface))
		gls_unsupported(x, "it shows a picture that is no frame of the recording: record the program again");
}
GLS_HANDLER(glXCopyContext, WINDOW) { gls_unsupported(x, "the copy of state between contexts"); }

enum { EGL_OPENGL_ES_API = 0x30A0, EGL_CONTEXT_CLIENT_VERSION = 0x3098 };

/*
 * EGL 1.5 sec. 3.7: the API chosen by eglBindAPI, by default OpenGL ES. Recordings that begin late may lack the call.
 */
static int is_es(const struct gls_exec *x, const struct call *c)
{
	uint64_t n;
	const struct trace_value *list = arg_items(c, 3, &n);

	if (x->egl_api)
		return x->egl_api == EGL_OPENGL_ES_API;
	for (uint64_t i = 0; i + 1 < n; i += 2)
		if (gls_value_int(&list[i]) == EGL_CONTEXT_CLIENT_VERSION)
			return gls_value_int(&list[i + 1]) == 1;
	return 0;
}

GLS_HANDLER(eglBindAPI, WINDOW) { x->egl_api = arg_u(c, 0); }
GLS_HANDLER(eglCreateContext, WINDOW)
{
	const int core = x->egl_api && x->egl_api != EGL_OPENGL_ES_API && asks_for_core(c, 3, egl_names);
	struct gls_context *ctx = create_context(x, c, arg_i(c, 2), arg(c, 1), core ? "EGL, core profile" : "EGL");

	/*
	 * Mesa (22.3.6) clamps OpenGL ES vertex colours only after interpolation, contrary to OpenGL ES 1.1 sec.
	 * 2.12.2.
	 */
	if (ctx && is_es(x, c))
		ctx->state.a.lighting.clamp = GL_FALSE;
}
GLS_HANDLER(eglDestroyContext, WINDOW) { destroy_context(x, c, 1); }
GLS_HANDLER(eglMakeCurrent, WINDOW) { make_current(x, c, 1, 2, 3, "EGL"); }
GLS_HANDLER(eglSwapBuffers, WINDOW) { swap(x, (uint64_t)arg_i(c, 1)); }
GLS_HANDLER(eglSwapBuffersWithDamageEXT, WINDOW) { swap(x, (uint64_t)arg_i(c, 1)); }
GLS_HANDLER(eglSwapBuffersWithDamageKHR, WINDOW) { swap(x, (uint64_t)arg_i(c, 1)); }
GLS_HANDLER(glFrameTerminatorGREMEDY, WINDOW)
{
	swap(x, x->st ? x->st->drawable : 0);
	x->unswapped = 1;
}

/* OSMesa draws into the program's memory: each context is its own drawable. */
GLS_HANDLER(OSMesaCreateContext, WINDOW) { create_context(x, c, arg_i(c, 1), NULL, "OSMesa"); }
GLS_HANDLER(OSMesaCreateContextExt, WINDOW) { create_context(x, c, arg_i(c, 4), NULL, "OSMesa"); }
GLS_HANDLER(OSMesaCreateContextAttribs, WINDOW) { create_context(x, c, arg_i(c, 1), NULL, "OSMesa"); }
GLS_HANDLER(OSMesaDestroyContext, WINDOW) { destroy_context(x, c, 0); }
GLS_HANDLER(OSMesaMakeCurrent, WINDOW) { make_current(x, c, 0, 0, 0, "OSMesa"); }

/* Contexts of other window systems, as apitrace records them. */
GLS_HANDLER(wglSwapBuffers, WINDOW) { swap(x, x->st ? x->st->drawable : 0); }
GLS_HANDLER(wglSwapLayerBuffers, WINDOW) { swap(x, x->st ? x->st->drawable : 0); }
GLS_HANDLER(wglSwapMultipleBuffers, WINDOW) { swap(x, x->st ? x->st->drawable : 0); }
GLS_HANDLER(CGLFlushDrawable, WINDOW) { swap(x, x->st ? x->st->drawable : 0); }
GLS_HANDLER(wglCreateContext, WINDOW) { create_context(x, c, 0, NULL, "WGL"); }
GLS_HANDLER(wglMakeCurrent, WINDOW) { make_current(x, c, 0, 0, 1, "WGL"); }

/* ---- markers of our recorder (capture/format/trace.md) and of rtMaterialEXT ---- */

static void set_surface(struct gls_exec *x, struct gls_state *st, const char *text)
{
	struct scene_surface surface = { 0 };

	if (sscanf(text, "mirror %f", &surface.reflect) == 1)
		;
	else if (sscanf(text, "glass %f %f", &surface.transmit, &surface.ior) >= 1)
		;
	else if (strncmp(text, "matte", 5) != 0) {
		gls_unsupported(x, "a material that is neither mirror, glass nor matte");
		return;
	}
	gls_flush(x);
	st->surface = surface;
	st->dirty |= GLS_DIRTY_MATERIAL;
}

GLS_HANDLER(glStringMarkerGREMEDY, INSIDE, MARKER)
{
	const struct trace_value *v = arg(c, 1);
	struct gls_drawable *drawable;
	char text[192];
	unsigned width, height, alpha, depth, stencil, srgb = 0, samples = 0, two_buffers = 1, accum = 1;
	size_t n;

	if (v->type != TRACE_STRING && v->type != TRACE_BLOB)
		return;
	n = v->count < sizeof(text) - 1 ? v->count : sizeof(text) - 1;
	memcpy(text, v->type == TRACE_STRING ? v->str : (const char *)v->blob, n);
	text[n] = 0;
	if (strncmp(text, "relume:material ", 16) == 0)
		set_surface(x, st, text + 16);
	if (strncmp(text, "relume:time ", 12) == 0)
		x->time_ns = strtoull(text + 12, NULL, 10);
	if (sscanf(text, "relume:condition %u", &st->answer) == 1)
		st->answered = 1;
	if (strcmp(text, "relume:kdtree") == 0)
		st->kd_tree = 1;
	if (strcmp(text, "relume:x87") == 0)
		st->x87 = 1;
	if (strncmp(text, "relume:gl ", 10) == 0)
		st->mesa = scene_mesa_of(text + 10);
	/* Some programs write a marker with every frame, and sscanf measures the text before it parses it. */
	if (strncmp(text, "relume:bits", 11) == 0 &&
	    sscanf(text, "relume:bits %u %u %u %u %u %u %u", &alpha, &depth, &stencil, &srgb, &samples, &two_buffers,
	           &accum) >= 3 &&
	    alpha <= 32 && depth <= 32 && stencil <= 8 && samples <= 64) {
		gls_flush(x);
		x->is_ours = 1;
		st->alpha_bits = alpha;
		st->depth_bits = depth;
		st->stencil_bits = stencil;
		st->srgb = srgb != 0;
		st->samples = samples;
		st->double_buffered = two_buffers != 0;
		st->lacks_accum = !accum;
		if (samples > 1 && samples != SCENE_SAMPLES)
			gls_unsupported(x, "other than four samples per pixel: four are taken");
		st->dirty |= GLS_DIRTY_ALL;
	}
	if (strncmp(text, "relume:drawable", 15) != 0 || sscanf(text, "relume:drawable %u %u", &width, &height) != 2 ||
	    width > GLS_MAX_DRAWABLE || height > GLS_MAX_DRAWABLE)
		return;
	drawable = gls_drawable_of(x, st->drawable);
	if (drawable)
		drawable->width = width, drawable->height = height, drawable->fixed = 1;
}
