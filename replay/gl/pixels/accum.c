/*
 * The accumulation buffer (GL 2.1 sec. 4.2.4): sums of pictures, stored as pixels. As in Mesa, values have 16 bits,
 * 32767 for 1, and are rounded towards 0; colours of a drawable that can hold sRGB are summed in linear light.
 *
 * A frame that is not built leaves the sums unknown, until the whole buffer is loaded or cleared.
 */
#include "replay/gl/pixels/accum.h"

#include <math.h>
#include <stdlib.h>

#include "gl_tokens.h"
#include "replay/build/frame.h"
#include "replay/gl/pixels/rectangle.h"
#include "replay/gl/surface/drawable.h"
#include "replay/gl/surface/screen.h"
#include "replay/gl/texture/texformat.h"
#include "replay/machine/args.h"
#include "replay/machine/commands.h"
#include "replay/machine/errors.h"
#include "replay/machine/machine.h"

#define UNIT 32767.0f            /* stored value of 1 */
#define PIXELS_PER_OPERATION 256 /* as gls_is_beyond_measure counts the work of lists */

/* Pixels x0 <= x < x1, y0 <= y < y1; row 0 at the bottom. */
struct area {
	int64_t x0, y0, x1, y1;
};

/* The drawable. area: its part within the scissor. NULL: none, or out of memory */
static struct gls_drawable *drawable_of(struct gls_exec *x, struct gls_state *st, struct area *area)
{
	struct gls_drawable *d = st->draw_framebuffer ? NULL : gls_drawable_of(x, st->drawable);
	const int32_t *r = st->a.scissor.rect;

	if (!d || !d->width || !d->height)
		return NULL;
	*area = (struct area){ 0, 0, d->width, d->height };
	if (!st->a.scissor.enabled)
		return d;
	area->x0 = r[0] > 0 ? r[0] : 0;
	area->y0 = r[1] > 0 ? r[1] : 0;
	area->x1 = (int64_t)r[0] + r[2] < area->x1 ? (int64_t)r[0] + r[2] : area->x1;
	area->y1 = (int64_t)r[1] + r[3] < area->y1 ? (int64_t)r[1] + r[3] : area->y1;
	return d;
}

/* As drawable_of, with a buffer of the drawable's present size. */
static struct gls_drawable *open_buffer(struct gls_exec *x, struct gls_state *st, struct area *area)
{
	struct gls_drawable *d = drawable_of(x, st, area);

	if (!d)
		return NULL;
	if (!d->accum || d->accum_width != d->width || d->accum_height != d->height) {
		free(d->accum);
		d->accum = calloc((size_t)d->width * d->height, 4 * sizeof(*d->accum));
		if (!d->accum) {
			gls_out_of_memory(x, (size_t)d->width * d->height * 8);
			return NULL;
		}
		d->accum_width = d->width;
		d->accum_height = d->height;
	}
	return d;
}

static int is_whole(const struct gls_drawable *d, const struct area *a)
{
	return !a->x0 && !a->y0 && a->x1 == d->width && a->y1 == d->height;
}

static int16_t clamp16(float v)
{
	return (int16_t)(v < -UNIT ? -UNIT : v > UNIT ? UNIT : v == v ? v : 0);
}

/* Overflow wraps round, as in Mesa: the specification leaves it undefined. */
static int16_t wrap16(float v)
{
	return fabsf(v) < 0x1p31f ? (int16_t)(uint32_t)(int32_t)v : 0;
}

/* The value, 0 .. 1, that a byte of the picture adds. component: 3 is alpha, which sRGB does not encode */
static float value_of(const struct gls_state *st, uint8_t byte, unsigned component)
{
	float v = (float)byte / 255;

	return st->srgb && component < 3 ? gls_linear_from_srgb(v) : v;
}

/* A change of a value: value * scale + offset + colour * factor. */
struct change {
	float scale, offset[4], factor;
};

/* Apply a change to all stored values in an area. p: the colours, or NULL */
static void change_area(struct gls_exec *x, const struct gls_state *st, struct gls_drawable *d, const struct area *a,
                        const struct change *by, const struct scene_picture *p)
{
	const int64_t width = a->x1 > a->x0 ? a->x1 - a->x0 : 0, height = a->y1 > a->y0 ? a->y1 - a->y0 : 0;

	if (x->list_depth &&
	    gls_is_beyond_measure(x, (uint64_t)(width * height) / PIXELS_PER_OPERATION, "lists that accumulate without end"))
		return;
	for (int64_t row = a->y0; row < a->y1; row++)
		for (int64_t column = a->x0; column < a->x1; column++) {
			size_t at = 4 * ((size_t)row * d->accum_width + (size_t)column);

			for (unsigned c = 0; c < 4; c++) {
				float v = (float)wrap16((float)d->accum[at + c] * by->scale) + by->offset[c];

				if (p && column < p->width && row < p->height)
					v += (float)wrap16(
						value_of(st, p->rgba[4 * ((size_t)row * p->width + (size_t)column) + c],
					                 c) *
						by->factor * UNIT);
				d->accum[at + c] = wrap16(v);
			}
		}
}

/* GL_RETURN: draw the sums times a value. Only the scissor and the colour mask affect these fragments. */
static void give_back(struct gls_exec *x, struct gls_state *st, const struct gls_drawable *d, const struct area *a,
                      float value)
{
	uint32_t width = (uint32_t)(a->x1 - a->x0), height = (uint32_t)(a->y1 - a->y0);
	uint8_t *texels = gls_scratch(x, (size_t)width * height * 4);

	for (uint32_t y = 0; texels && y < height; y++)
		for (uint32_t i = 0; i < 4 * width; i++) {
			float v = (float)d->accum[4 * (((size_t)a->y0 + y) * d->accum_width + (size_t)a->x0) + i] / UNIT * value;

			v = v > 0 ? v < 1 ? v : 1 : 0;
			texels[4 * (size_t)y * width + i] = (uint8_t)((st->srgb && i % 4 < 3 ? gls_srgb_from_linear(v) : v) * 255 + 0.5f);
		}
	if (texels)
		gls_copy_rectangle(x, st,
		                   &(struct gls_rectangle){ .kind = SCENE_COLOR_PIXELS,
		                                            .width = width,
		                                            .height = height,
		                                            .left = (float)a->x0,
		                                            .low = (float)a->y0,
		                                            .zoom = { 1, 1 },
		                                            .texels = texels },
		                   st->a.color.mask);
}

GLS_HANDLER(glAccum, STATE)
{
	uint32_t op = arg_u(c, 0);
	const float value = arg_f(c, 1), addend = (float)wrap16(value * UNIT);
	const struct scene_picture *p = NULL;
	struct area area;
	struct gls_drawable *d;

	if (gls_refuses(x, st, op != GL_ACCUM && op != GL_LOAD && op != GL_RETURN && op != GL_MULT && op != GL_ADD,
	                GL_INVALID_ENUM))
		return;
	if (gls_refuses(x, st, st->lacks_accum, GL_INVALID_OPERATION) || !gls_renders(st))
		return;
	if (!x->want) {
		d = op == GL_RETURN || st->draw_framebuffer ? NULL : gls_drawable_of(x, st->drawable);
		if (d)
			d->accum_missing = 1;
		return;
	}
	if (!(d = open_buffer(x, st, &area)) || area.x0 >= area.x1 || area.y0 >= area.y1)
		return;
	if ((op == GL_ACCUM || op == GL_LOAD) && !(p = gls_read_screen(x, st, NULL)))
		return;
	if (op == GL_LOAD && is_whole(d, &area))
		d->accum_missing = 0;
	if (op == GL_RETURN && d->accum_missing && x->feedback.supply)
		gls_rewind(x, "the accumulation buffer holds sums of them");
	else if (op == GL_RETURN)
		give_back(x, st, d, &area, value);
	else if (op == GL_ADD)
		change_area(x, st, d, &area, &(struct change){ 1, { addend, addend, addend, addend }, 0 }, NULL);
	else if (op == GL_MULT)
		change_area(x, st, d, &area, &(struct change){ .scale = value }, NULL);
	else
		change_area(x, st, d, &area, &(struct change){ .scale = op == GL_ACCUM, .factor = value }, p);
}

void gls_accum_clear(struct gls_exec *x, struct gls_state *st)
{
	struct gls_drawable *d = NULL;
	struct area area;
	struct change to = { 0 };
	int is_zero = 1;

	if (st->lacks_accum || !gls_renders(st))
		return;
	if (!x->want && !st->draw_framebuffer && (d = gls_drawable_of(x, st->drawable)))
		d->accum_missing = 1;
	if (!x->want || !(d = drawable_of(x, st, &area)))
		return;
	for (unsigned i = 0; i < 4; i++) {
		to.offset[i] = (float)clamp16(st->a.accum.clear[i] * UNIT);
		is_zero &= to.offset[i] == 0;
	}
	if (is_whole(d, &area))
		d->accum_missing = 0;
	if (is_whole(d, &area) && is_zero) { /* most programs clear it and never use it */
		free(d->accum);
		d->accum = NULL;
	} else if (open_buffer(x, st, &area)) {
		change_area(x, st, d, &area, &to, NULL);
	}
}
