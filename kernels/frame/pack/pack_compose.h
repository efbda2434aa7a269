/*
 * Composes sixteen pixels of a row into the planes of a picture, with results that are bit-identical to compose.h.
 * OpenCL C only.
 */
#pragma once

#include "kernels/frame/stages/compose.h"
#include "kernels/frame/pack/pack.h"
#include "kernels/frame/pack/pack_encode.h"
#include "kernels/frame/pack/pack_ray.h"

#include "kernels/sixteen_lanes.h"
#include "kernels/frame/stages/compose_lanes.h"
#include "kernels/one_lanes.h"

#if defined(__has_builtin) && !defined(LANES_PORTABLE)
#if defined(__AVX512F__) && __has_builtin(__builtin_ia32_vcvtps2ph512_mask)
#define PACK_HALF16 1
#elif defined(__F16C__) && __has_builtin(__builtin_ia32_vcvtps2ph256)
#define PACK_HALF8 1
#endif
#endif

/* Like pack_loose_floats. */
typedef ushort16 pack_loose_halves __attribute__((aligned(2)));

/* Pixels before composition; colours are GL's numbers. */
struct pack_pixels {
	packf gl[4], shadowed[3], direct[3], mirrored[3], beauty[3], albedo[3];
	packf drawn, depth, normal[3], position[3], id, layers;
};

/* Destination of composed pixels. */
struct pack_planes {
	const struct compose_request *request;
	__global ushort *halves;
	__global float *floats;
	uint at, n; /* index of the first pixel in each plane; number of pixels, at most sixteen */
};

/* Planes of a row of up to sixteen pixels. r: kept. y: from the bottom */
static inline struct pack_planes pack_planes_of(const struct compose_request *r, __global ushort *halves,
                                                __global float *floats, uint x, uint y)
{
	struct pack_planes to;

	to.request = r;
	to.halves = halves;
	to.floats = floats;
	to.at = (r->height - 1 - y) * r->width + x;
	to.n = min(PACK_SIZE, r->width - x);
	return to;
}

/* compose_half, using the processor's own conversion if it has one. */
WIDE_VECTORS static inline ushort16 pack_half(packf x)
{
#if defined(PACK_HALF16) || defined(PACK_HALF8)
	/* Give all NaNs the same fraction, as compose_half does. */
	const packf value = select(x, as_float16((as_uint16(x) & 0x80000000u) | 0x7fc00000u), isnan(x));
#endif
#ifdef PACK_HALF16
	return as_ushort16(__builtin_ia32_vcvtps2ph512_mask(value, 8, as_short16((ushort16)(0)), (ushort)0xffff));
#elif defined(PACK_HALF8)
	return (ushort16)(as_ushort8(__builtin_ia32_vcvtps2ph256(value.lo, 0)),
	                  as_ushort8(__builtin_ia32_vcvtps2ph256(value.hi, 0)));
#else
	return convert_ushort16(compose_half(x));
#endif
}

/* Test whether any plane needs the surfaces' positions. */
static inline int pack_wants_surface(const struct compose_request *r)
{
	return r->normals ||
	       (r->half_plane[COMPOSE_NORMAL] & r->half_plane[COMPOSE_NORMAL + 1] & r->half_plane[COMPOSE_NORMAL + 2] &
	        r->float_plane[COMPOSE_POSITION] & r->float_plane[COMPOSE_POSITION + 1] &
	        r->float_plane[COMPOSE_POSITION + 2] & r->float_plane[COMPOSE_Z]) != SCENE_NONE;
}

/* Set some lanes of a number. */
WIDE_VECTORS static inline void pack_put(packf *number, packf value, packi mask)
{
	*number = select(*number, value, mask);
}

/* Store the surface positions of some lanes. */
WIDE_VECTORS static inline void pack_put_surface(const struct tables *t, const struct pack *p,
                                                 const struct pack_surface *s, packi mask, struct pack_pixels *to)
{
	const struct vec3_16 normal = pack_normal(t, p, s), at = pack_place_at(s, p->weight);

	pack_put(&to->normal[0], normal.x, mask);
	pack_put(&to->normal[1], normal.y, mask);
	pack_put(&to->normal[2], normal.z, mask);
	pack_put(&to->position[0], at.x, mask);
	pack_put(&to->position[1], at.y, mask);
	pack_put(&to->position[2], at.z, mask);
}

/* The same for one lane. f: its fragment, of any kind */
static inline void pack_put_one(const struct tables *t, __global const struct window_vertex *windows,
                                const struct fragment *f, uint lane, struct pack_pixels *to)
{
	struct vec3 normal, position;

	compose_surface(t, windows, f, &normal, &position);
	LANE(to->normal[0], float, lane) = normal.x;
	LANE(to->normal[1], float, lane) = normal.y;
	LANE(to->normal[2], float, lane) = normal.z;
	LANE(to->position[0], float, lane) = position.x;
	LANE(to->position[1], float, lane) = position.y;
	LANE(to->position[2], float, lane) = position.z;
}

WIDE_VECTORS static inline void pack_store_half(const struct pack_planes *to, uint plane, packf x)
{
	__global ushort *out = to->halves + to->request->half_plane[plane] + to->at;
	ushort16 value;

	if (to->request->half_plane[plane] == SCENE_NONE)
		return;
	value = pack_half(x);
	if (to->n == PACK_SIZE)
		*(__global pack_loose_halves *)out = value;
	for (uint i = 0; i < to->n && to->n < PACK_SIZE; i++)
		out[i] = ((const ushort *)&value)[i];
}

WIDE_VECTORS static inline void pack_store_float(const struct pack_planes *to, uint plane, packf x)
{
	__global float *out = to->floats + to->request->float_plane[plane] + to->at;

	if (to->request->float_plane[plane] == SCENE_NONE)
		return;
	if (to->n == PACK_SIZE)
		*(__global pack_loose_floats *)out = x;
	for (uint i = 0; i < to->n && to->n < PACK_SIZE; i++)
		out[i] = ((const float *)&x)[i];
}

/* Encode a number. `before`, whose encoding is `known`, is usually equal to it. */
WIDE_VECTORS static inline packf pack_encode(const struct compose_request *r, packf x, packf before, packf known)
{
	if (r->display)
		return x;
	return any_pack(as_int16(x) != as_int16(before)) ? encode_linear(x) : known;
}

/* The part that one step adds to a sum, as in compose_channel. display, before: after and before the step, not
 * encoded */
WIDE_VECTORS static inline packf pack_part_of(packf display, packf before, packf color, packf sum)
{
	return select((packf)(0), compose_rounded(color - sum), display != before);
}

/* A channel without effects, which is GL's own colour. exact: that colour, encoded */
WIDE_VECTORS static inline void pack_compose_gl(packf exact, int c, const struct pack_planes *to)
{
	const packf gl = compose_rounded(exact), relight = compose_effect(exact - gl, exact);

	pack_store_half(to, COMPOSE_BEAUTY + c, gl + relight + 0.0f);
	pack_store_half(to, COMPOSE_GL + c, gl);
	pack_store_half(to, COMPOSE_SHADOW + c, (packf)(1));
	pack_store_half(to, COMPOSE_RELIGHT + c, relight);
	pack_store_half(to, COMPOSE_REFLECT + c, (packf)(0));
	pack_store_half(to, COMPOSE_REFRACT + c, (packf)(0));
}

/* One colour channel, decomposed as in compose_nudge, compose_normals, compose_encode and compose_channel. first: GL's,
 * or the normal's */
WIDE_VECTORS static inline void pack_compose_channel(const struct pack_pixels *p, packf nudged, packf first,
                                                     packf exact, int c, const struct pack_planes *to)
{
	const packf display_shadowed = select(p->shadowed[c], nudged, p->shadowed[c] == p->gl[c]);
	const packf display_direct = select(p->direct[c], nudged, p->direct[c] == p->gl[c]);
	const packf display_mirrored = select(p->mirrored[c], nudged, p->mirrored[c] == p->gl[c]);
	const packf display_beauty = select(p->beauty[c], nudged, p->beauty[c] == p->gl[c]);
	const packf shadowed = pack_encode(to->request, display_shadowed, first, exact);
	const packf direct = pack_encode(to->request, display_direct, display_shadowed, shadowed);
	const packf mirrored = pack_encode(to->request, display_mirrored, display_direct, direct);
	const packf beauty = pack_encode(to->request, display_beauty, display_mirrored, mirrored);
	const packf gl = compose_rounded(exact), share = shadowed / exact;
	const packf shadow = select((packf)(1), compose_rounded(select((packf)(0), share, share > 0.0f)),
	                            (gl > 0.0f) & (shadowed < exact));
	const packf relight = compose_effect(direct - gl * shadow, direct), sum = gl * shadow + relight;
	const packf reflect = pack_part_of(display_mirrored, display_direct, mirrored, sum);
	const packf refract = pack_part_of(display_beauty, display_mirrored, beauty, sum + reflect);

	pack_store_half(to, COMPOSE_BEAUTY + c, to->request->normals ? exact : sum + reflect + refract);
	pack_store_half(to, COMPOSE_GL + c, gl);
	pack_store_half(to, COMPOSE_SHADOW + c, shadow);
	pack_store_half(to, COMPOSE_RELIGHT + c, relight);
	pack_store_half(to, COMPOSE_REFLECT + c, reflect);
	pack_store_half(to, COMPOSE_REFRACT + c, refract);
}

/* The same, with a shortcut for values that no effect changes. nudged: compose_nudged; first, exact: as in
 * pack_compose_channel */
WIDE_VECTORS static inline void pack_compose_color(const struct pack_pixels *p, packf nudged, packf first, packf exact,
                                                   int c, const struct pack_planes *to)
{
	const packi gl = as_int16(p->gl[c]);
	const packi changed = (gl ^ as_int16(p->shadowed[c])) | (gl ^ as_int16(p->direct[c])) |
	                      (gl ^ as_int16(p->mirrored[c])) | (gl ^ as_int16(p->beauty[c]));

	if (to->request->normals || any_pack((changed != 0) | (p->gl[c] != p->gl[c])))
		pack_compose_channel(p, nudged, first, exact, c, to);
	else
		pack_compose_gl(exact, c, to);
}

WIDE_VECTORS static inline void pack_compose_albedo(const struct pack_pixels *p, const struct pack_planes *to)
{
	packf albedo[3];

	if (to->request->half_plane[COMPOSE_ALBEDO] == SCENE_NONE)
		return;
	for (int c = 0; c < 3; c++)
		albedo[c] = p->albedo[c];
	if (!to->request->display)
		pack_linear3(albedo);
	for (int c = 0; c < 3; c++)
		pack_store_half(to, COMPOSE_ALBEDO + c, albedo[c]);
}

/* The colours encoded last, and their encodings, since consecutive rows often have the same colours. */
struct pack_encoded {
	int known; /* 0: empty */
	packf gl[3], nudged[3], first[3], exact[3];
};

/* Encode a row's colours, unless they equal the ones encoded last. */
WIDE_VECTORS static inline void pack_encode_row(const struct pack_pixels *p, const struct compose_request *r,
                                                struct pack_encoded *last)
{
	const packi differ = (as_int16(p->gl[0]) ^ as_int16(last->gl[0])) | (as_int16(p->gl[1]) ^ as_int16(last->gl[1])) |
	                     (as_int16(p->gl[2]) ^ as_int16(last->gl[2]));

	if (last->known && !r->normals && !any_pack(differ != 0))
		return;
	last->known = 1;
	for (int c = 0; c < 3; c++) {
		last->gl[c] = p->gl[c];
		last->nudged[c] = compose_nudged(p->gl[c]);
		last->first[c] = r->normals ? select((packf)(0), p->normal[c] * 0.5f + 0.5f, p->drawn > 0.0f) : last->nudged[c];
		last->exact[c] = last->first[c];
	}
	if (!r->display)
		pack_linear3(last->exact);
}

/*
 * Compose a row's pixels into all planes.
 *
 * is_gl  1: no effect changes any pixel; the colours after p->gl are not set, as they would be the same numbers
 * last   the colours encoded for the row before, or empty; in and out
 */
WIDE_VECTORS static inline void pack_compose(const struct pack_pixels *p, int is_gl, const struct pack_planes *to,
                                             struct pack_encoded *last)
{
	const packf *nudged = last->nudged, *first = last->first, *exact = last->exact;

	pack_encode_row(p, to->request, last);
	for (int c = 0; c < 3 && is_gl; c++)
		pack_compose_gl(exact[c], c, to);
	for (int c = 0; c < 3 && !is_gl; c++)
		pack_compose_color(p, nudged[c], first[c], exact[c], c, to);
	pack_compose_albedo(p, to);
	pack_store_half(to, COMPOSE_BEAUTY + 3, p->drawn);
	pack_store_half(to, COMPOSE_GL + 3, p->gl[3]);
	for (int i = 0; i < 3; i++) {
		pack_store_half(to, COMPOSE_NORMAL + i, p->normal[i]);
		pack_store_float(to, COMPOSE_POSITION + i, p->position[i]);
	}
	pack_store_float(to, COMPOSE_DEPTH, p->depth);
	pack_store_float(to, COMPOSE_Z, -p->position[2]);
	pack_store_float(to, COMPOSE_ID, p->id);
	pack_store_float(to, COMPOSE_LAYERS, p->layers);
}

/* Copy the planes of sixteen pixels from another place in the planes. */
WIDE_VECTORS static inline void pack_compose_again(uint from, const struct pack_planes *to)
{
	const struct compose_request *r = to->request;
	const uint size = r->width * r->height;

	for (uint i = 0; i < r->n_halves; i++) {
		__global ushort *plane = to->halves + i * size;

		*(__global pack_loose_halves *)(plane + to->at) = *(__global const pack_loose_halves *)(plane + from);
	}
	for (uint i = 0; i < r->n_floats; i++) {
		__global float *plane = to->floats + i * size;

		*(__global pack_loose_floats *)(plane + to->at) = *(__global const pack_loose_floats *)(plane + from);
	}
}
