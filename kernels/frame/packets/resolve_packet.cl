/*
 * resolve_packet: resolve with all colours of a pixel as one vector, for CPUs. Tests and non-colour values are handled
 * as in kernels/gl/pixel.h, and so are all values for logic operations and float frame buffers.
 *
 * Lanes follow the beginnings of struct shaded and struct frame_pixel: GL's colour and alpha, then red, green and blue
 * of the four further parts.
 */
#include "kernels/frame/pack/pack_blend.h"
#include "kernels/frame/pack/pack_texture.h"
#include "kernels/gl/stages.h"

#define LANE_ALPHA 3
#define LANE_DIRECT 7 /* first lane of the parts that rules may omit or make solid */
#define LANE_BEAUTY 13
#define LANE_CHANNELS (packu)(0, 1, 2, 3, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2)

/* Aligned only like its elements. */
typedef float16 loose_floats __attribute__((aligned(4)));

/* blend_colors for all lanes. */
WIDE_VECTORS static inline packf blend(__global const struct scene_material *m, packf source, packf destination)
{
	const float4 own = vload4(0, m->blend_color);
	const packf c = (packf)(own, own, own, own);
	struct blend8_16 of;
	packu out;

	of.s = blend_round(source);
	of.s_alpha = of.s.s3;
	of.d = blend_round(destination);
	of.d_alpha = of.d.s3;
	of.c = c.s0123012012012012;
	of.c_alpha = c.s3;
	of.is_alpha = LANE_CHANNELS == LANE_ALPHA;
	out = blend_equation(m->blend_equation_rgb, of.s, blend_factor(m->blend_src_rgb, &of), of.d,
	                     blend_factor(m->blend_dst_rgb, &of));
	if (m->blend_equation_alpha != m->blend_equation_rgb || m->blend_src_alpha != m->blend_src_rgb ||
	    m->blend_dst_alpha != m->blend_dst_rgb)
		out.s3 = blend_equation(m->blend_equation_alpha, of.s, blend_factor(m->blend_src_alpha, &of), of.d,
		                        blend_factor(m->blend_dst_alpha, &of))
		                 .s3;
	return convert_float16(as_int16(out)) / 255.0f;
}

/* pixel_colors for all lanes. */
WIDE_VECTORS static inline void draw_colors(__global const struct scene_material *m,
                                            __global const struct shaded *shaded, __global struct frame_pixel *pixel,
                                            uint bits)
{
	const packf before = *(__global const loose_floats *)pixel->gl;
	packf source = *(__global const loose_floats *)shaded->gl, destination = before, color;
	packi written = ((packu)(m->color_mask) >> LANE_CHANNELS & 1) != 0;

	if (m->alpha_to_one)
		source.s3 = 1.0f;
	if (!pixel_alpha_bits(bits))
		destination.s3 = 1.0f;
	color = m->blend ? blend(m, source, destination) : source;
	if (m->surface.hidden & SCENE_SOLID)
		color = select(color, source, PACK_LANES >= LANE_DIRECT);
	if (m->surface.transmit > 0.0f)
		color = select(color, source, PACK_LANES >= LANE_BEAUTY);
	if (m->surface.hidden & SCENE_LEFT_OUT)
		written &= PACK_LANES < LANE_DIRECT;
	*(__global loose_floats *)pixel->gl = select(before, color, written);
}

static inline void draw(const struct tables *t, __global const struct fragment *f, __global struct shaded *s,
                        __global struct frame_pixel *pixel, uint bits)
{
	__global const struct scene_material *m = stage_material(t, f->instance);

	if (!pixel_reaches(m, s, pixel, bits))
		return;
	if (m->logic_op || m->floats || m->srgb)
		pixel_colors(m, s, pixel, bits);
	else
		draw_colors(m, s, pixel, bits);
	pixel_mark(m, s, f, stage_draw(t, f->instance, f->primitive), pixel);
}

KERNEL_OF(float16) void resolve_packet(KERNEL_ARGUMENTS(resolve))
{
	const struct resolve_arguments a = KERNEL_STRUCT(resolve);
	struct stage_row row;

	if ((uint)get_global_id(0) >= n)
		return;
	row = stage_open_row(&a, (uint)get_global_id(0));
	for (uint pixel = row.first; pixel < row.end; pixel++)
		for (uint i = first[pixel]; i < first[pixel] + counts[pixel]; i++)
			draw(&a.tables, &fragments[i], &shaded[i], &frame[pixel], bits);
}
