/* Rasterization state: points, lines, polygons (GL 2.1 sec. 3.3 - 3.5). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "capture/format/call.h"
#include "capture/format/sizes.h"
#include "gl_tokens.h"
#include "replay/gl/texture/unpack.h"
#include "replay/machine/args.h"
#include "replay/machine/buffer.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"
#include "replay/machine/state.h"
#include "scene/mesa.h"

enum { SIDE = 32 }; /* rows and columns of a polygon stipple */

GLS_HANDLER(glPointSize, STATE)
{
	if (!gls_refuses(x, st, !(arg_f(c, 0) > 0), GL_INVALID_VALUE))
		st->a.point.size = arg_f(c, 0);
}

GLS_FAMILY(glPointParameter, STATE)
{
	struct gls_point *point = &st->a.point;
	float v[3] = { 0 };

	arg_floats(c, 1, v, 3);
	switch (arg_u(c, 0)) {
	case GL_POINT_SIZE_MIN: case GL_POINT_SIZE_MAX: case GL_POINT_FADE_THRESHOLD_SIZE:
		if (gls_refuses(x, st, !(v[0] >= 0), GL_INVALID_VALUE))
			return;
		*(arg_u(c, 0) == GL_POINT_SIZE_MIN   ? &point->size_min
		  : arg_u(c, 0) == GL_POINT_SIZE_MAX ? &point->size_max
		                                     : &point->fade_threshold) = v[0];
		break;
	case GL_POINT_DISTANCE_ATTENUATION:
		memcpy(point->attenuation, v, sizeof(v));
		break;
	case GL_POINT_SPRITE_COORD_ORIGIN:
		if (!gls_refuses(x, st, token_of_float(v[0]) != GL_UPPER_LEFT && token_of_float(v[0]) != GL_LOWER_LEFT,
		                 GL_INVALID_VALUE))
			point->sprite_origin = token_of_float(v[0]);
		break;
	default:
		gls_error(x, st, GL_INVALID_ENUM);
	}
}

GLS_HANDLER(glLineWidth, STATE)
{
	if (!gls_refuses(x, st, !(arg_f(c, 0) > 0), GL_INVALID_VALUE))
		st->a.line.width = arg_f(c, 0);
}

GLS_HANDLER(glLineStipple, STATE)
{
	int64_t factor = arg_i(c, 0);

	st->a.line.stipple_factor = (uint32_t)(factor < 1 ? 1 : factor > 256 ? 256 : factor);
	st->a.line.stipple_pattern = arg_u(c, 1) & 0xffff;
}

GLS_HANDLER(glCullFace, STATE)
{
	if (!gls_refuses(x, st, !gls_is_face(arg_u(c, 0)), GL_INVALID_ENUM))
		st->a.polygon.cull_face = arg_u(c, 0);
}

GLS_HANDLER(glFrontFace, STATE)
{
	uint32_t face = arg_u(c, 0);

	if (!gls_refuses(x, st, face != GL_CW && face != GL_CCW, GL_INVALID_ENUM))
		st->a.polygon.front_face = face;
}

GLS_HANDLER(glPolygonMode, STATE)
{
	uint32_t face = arg_u(c, 0), mode = arg_u(c, 1);

	if (gls_refuses(x, st, (mode != GL_POINT && mode != GL_LINE && mode != GL_FILL) || !gls_is_face(face),
	                GL_INVALID_ENUM))
		return;
	if (face != GL_BACK)
		st->a.polygon.mode[0] = mode;
	if (face != GL_FRONT)
		st->a.polygon.mode[1] = mode;
}

GLS_HANDLER(glPolygonOffset, STATE)
{
	st->a.polygon.offset_factor = arg_f(c, 0);
	st->a.polygon.offset_units = arg_f(c, 1);
}

/* The bias is in units of depth, not of its resolution. Mesa's libGL exports the function, but it does nothing. */
GLS_HANDLER(glPolygonOffsetEXT, STATE)
{
	if (gls_is_mesa(st))
		return;
	st->a.polygon.offset_factor = arg_f(c, 0);
	st->a.polygon.offset_units = arg_f(c, 1) * 16777215.0f;
}

/*
 * 32 rows of 32 bits from row 0 (the lowest) up, unpacked like glDrawPixels bits; bit 31 becomes the leftmost pixel
 * (sec. 3.5.2). Memory is recorded as numbers, one per byte.
 */
GLS_HANDLER(glPolygonStipple, STATE)
{
	const struct pixel_box box = { 2, GL_COLOR_INDEX, GL_BITMAP, SIDE, SIDE, 1 };
	struct gls_pixels p = { .width = SIDE, .height = SIDE, .store = gls_client_store(x, st) };
	const size_t wanted = gls_pixel_bytes(p.store, &box);
	uint8_t *numbers = arg(c, 0)->type == TRACE_ARRAY ? malloc(arg(c, 0)->count + 1) : NULL;

	p.data = numbers ? numbers : gls_pixel_source(st, c, 0, &p.n);
	p.n = numbers ? arg(c, 0)->count : p.n;
	for (size_t i = 0; numbers && i < p.n; i++)
		numbers[i] = (uint8_t)gls_value_int(&arg(c, 0)->items[i]);
	if (p.data && !numbers && arg(c, 0)->type != TRACE_BLOB)
		gls_buffer_keep(x, gls_buffer_find(st, st->client.unpack.buffer));
	if (!p.data || p.n < wanted)
		gls_unsupported(x, "stipples that are not in the recording");
	for (uint32_t row = 0; row < SIDE && p.data && p.n >= wanted; row++) {
		st->a.polygon_stipple[row] = 0;
		for (uint32_t bit = 0; bit < SIDE; bit++)
			st->a.polygon_stipple[row] |= (uint32_t)gls_unpack_bit(&p, bit, row) << (SIDE - 1 - bit);
	}
	free(numbers);
}

GLS_HANDLER(glSampleCoverage, STATE)
{
	st->a.multisample.coverage_value = fminf(fmaxf(arg_f(c, 0), 0), 1);
	st->a.multisample.coverage_invert = arg_i(c, 1) != 0;
}
