/*
 * Learns the alpha, depth and stencil bits of visuals and frame buffer configurations (GLX 1.4 sec. 3.3.3, EGL 1.5 sec.
 * 3.4) from a program's queries and requests. Only recordings of other recorders need this: ours store the bits in a
 * marker when a context is first made current (capture/format/trace.md). Bits that stay unknown keep gls_state_init's
 * values.
 */
#include "replay/gl/state/config.h"

#include "capture/format/call.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"

/* Attributes that have no value, in lists for visuals only. */
enum {
	GLX_RGBA = 4,
	GLX_DOUBLEBUFFER = 5,
	GLX_STEREO = 6,
	GLX_USE_GL = 1
};
enum { GLX_ALPHA_SIZE = 11, GLX_DEPTH_SIZE = 12, GLX_STENCIL_SIZE = 13 };
enum { EGL_ALPHA_SIZE = 0x3021, EGL_DEPTH_SIZE = 0x3025, EGL_STENCIL_SIZE = 0x3026, EGL_NONE = 0x3038 };

/* An entry of x->configs: three bit counts at these shifts, 7 bits each, with KNOWN added if the count is known. */
enum { ALPHA = 0, DEPTH = 8, STENCIL = 16, KNOWN = 128 };

/* The key of a configuration in x->configs: its address, or a visual's number. An array counts as its first element. */
static uint64_t key_of(const struct trace_value *v)
{
	while (v->type == TRACE_ARRAY && v->count)
		v = &v->items[0];
	if (v->type == TRACE_STRUCT && v->count > 1) /* XVisualInfo: visual, visualid, ... */
		return (uint64_t)gls_value_int(&v->items[1]);
	return (uint64_t)gls_value_int(v);
}

/* Set one bit count of a configuration. Key 0 is no configuration. */
static void set_bits(struct gls_exec *x, uint64_t key, unsigned shift, uint64_t bits)
{
	uintptr_t known = (uintptr_t)table_find(&x->configs, key);

	known = (known & ~((uintptr_t)255 << shift)) | (uintptr_t)(KNOWN | (bits < 64 ? bits : 64)) << shift;
	if (key && table_set(&x->configs, key, (void *)known))
		gls_out_of_memory(x, 16);
}

/* Shift of the bit count that an attribute sets; -1: none. */
static int shift_of(int64_t attribute)
{
	switch (attribute) {
	case GLX_ALPHA_SIZE: case EGL_ALPHA_SIZE: return ALPHA;
	case GLX_DEPTH_SIZE: case EGL_DEPTH_SIZE: return DEPTH;
	case GLX_STENCIL_SIZE: case EGL_STENCIL_SIZE: return STENCIL;
	default: return -1;
	}
}

/*
 * The alpha bits that a list of requested attributes leads to. If alpha is requested, every true-colour driver gives
 * eight bits; if not, it gives a visual without alpha.
 * @param i       the argument with the list
 * @param visual  1: the list is for glXChooseVisual, where some attributes have no value
 */
static uint64_t alpha_wanted(const struct call *c, unsigned i, int visual)
{
	uint64_t n;
	const struct trace_value *list = arg_items(c, i, &n);

	for (uint64_t k = 0; k < n; k++) {
		int64_t attribute = gls_value_int(&list[k]);

		if (attribute == 0 || attribute == EGL_NONE) /* the list's end: 0 in GLX */
			break;
		if (visual && (attribute == GLX_RGBA || attribute == GLX_DOUBLEBUFFER || attribute == GLX_STEREO ||
		               attribute == GLX_USE_GL))
			continue;
		if (shift_of(attribute) == ALPHA && k + 1 < n)
			return gls_value_int(&list[k + 1]) > 0 ? 8 : 0;
		k++;
	}
	return 0;
}

/* The program queried an attribute of a configuration. */
static void note_query(struct gls_exec *x, const struct call *c)
{
	int shift = shift_of(arg_i(c, 2));
	uint32_t value;

	if (shift >= 0 && arg_uints(c, 3, &value, 1) == 1)
		set_bits(x, key_of(arg(c, 1)), (unsigned)shift, value);
}

void gls_config_apply(struct gls_exec *x, struct gls_state *st, const struct trace_value *config)
{
	uintptr_t known = (uintptr_t)table_find(&x->configs, key_of(config));

	if (known >> ALPHA & KNOWN)
		st->alpha_bits = known >> ALPHA & 127;
	if (known >> DEPTH & KNOWN)
		st->depth_bits = known >> DEPTH & 127;
	if (known >> STENCIL & KNOWN)
		st->stencil_bits = known >> STENCIL & 127;
}

GLS_HANDLER(glXChooseVisual, WINDOW)
{
	if (arg(c, 2)->type == TRACE_ARRAY) /* our own recorder omits the list */
		set_bits(x, key_of(&c->ret), ALPHA, alpha_wanted(c, 2, 1));
}

GLS_HANDLER(glXChooseFBConfig, WINDOW)
{
	for (uint64_t i = 0; c->ret.type == TRACE_ARRAY && i < c->ret.count; i++)
		if (alpha_wanted(c, 2, 0))
			set_bits(x, key_of(&c->ret.items[i]), ALPHA, 8);
}

/* The visual of a configuration has the same bits. */
GLS_HANDLER(glXGetVisualFromFBConfig, WINDOW)
{
	uintptr_t known = (uintptr_t)table_find(&x->configs, key_of(arg(c, 1)));

	if (known && key_of(&c->ret) && table_set(&x->configs, key_of(&c->ret), (void *)known))
		gls_out_of_memory(x, 16);
}

GLS_HANDLER(eglChooseConfig, WINDOW)
{
	uint64_t n;
	const struct trace_value *configs = arg_items(c, 2, &n);

	for (uint64_t i = 0; i < n; i++)
		if (alpha_wanted(c, 1, 0))
			set_bits(x, key_of(&configs[i]), ALPHA, 8);
}

GLS_HANDLER(glXGetConfig, WINDOW) { note_query(x, c); }
GLS_HANDLER(glXGetFBConfigAttrib, WINDOW) { note_query(x, c); }
GLS_HANDLER(eglGetConfigAttrib, WINDOW) { note_query(x, c); }
