/*
 * Surfaces that let light through: holes, blended surfaces, glass. They attenuate rays to lights, and paths continue
 * behind them.
 */
#pragma once

#include "kernels/gl/stages.h"

/* A colour blended over a destination, without clamping, as light is not rounded to 8 bits. */
static inline struct vec3 transparency_blend(GLOBAL const struct scene_material *m, struct vec4 s, struct vec4 d)
{
	struct vec4 c = blend_floats(m, s, d);

	return v3(c.x, c.y, c.z);
}

/* Transmittance of a blended surface: how strongly the result depends on the destination. */
static inline struct vec3 transparency_of_blend(GLOBAL const struct scene_material *m, struct vec4 color)
{
	struct vec3 c = v3_sub(transparency_blend(m, color, v4(1.0f, 1.0f, 1.0f, 1.0f)),
	                       transparency_blend(m, color, v4(0.0f, 0.0f, 0.0f, 0.0f)));

	return v3(clamp01(c.x), clamp01(c.y), clamp01(c.z));
}

/* 1 if GL draws nothing of the primitive at this point: it is clipped, or fails the alpha test. */
static inline int transparency_is_hole(const struct point *p, float alpha)
{
	return point_clipped(p) || (p->material->alpha_test && !pixel_compare(p->material->alpha_func, blend_round(alpha),
	                                                                   blend_round(p->material->alpha_ref)));
}

/* Share of unpolarised light that a boundary reflects (Fresnel). eta: refractive index on this side divided by that
 * beyond; cosine: on this side. */
static inline float glass_fresnel(float eta, float cosine, float *cosine_beyond)
{
	float k = 1.0f - eta * eta * (1.0f - cosine * cosine), across, along;

	*cosine_beyond = 0.0f;
	if (!(k > 0.0f))
		return 1.0f; /* total reflection */
	*cosine_beyond = M_SQRT(k);
	across = (eta * cosine - *cosine_beyond) / (eta * cosine + *cosine_beyond);
	along = (cosine - eta * *cosine_beyond) / (cosine + eta * *cosine_beyond);
	return 0.5f * (across * across + along * along);
}

static inline float glass_ior(GLOBAL const struct scene_material *m)
{
	return m->surface.ior > 0.0f ? m->surface.ior : 1.0f;
}

/* 1 if the visible side of a glass surface is the outside of its body. */
static inline int glass_is_outside(const struct point *p)
{
	return (p->front != 0) != ((p->material->surface.hidden & SCENE_BACK_OUTSIDE) != 0u);
}

/* 1 if light that reaches a glass surface from the visible side enters the body. */
static inline int glass_enters(const struct point *p)
{
	return glass_is_outside(p) || p->material->surface.hidden & SCENE_ENTERED;
}

/* 1 if rays that look for colours pass through a surface: rules hide it, or it has no colour (scene/depths.h). */
static inline int transparency_is_unseen(GLOBAL const struct scene_material *m)
{
	return m->surface.hidden & SCENE_HIDDEN_FROM_MIRRORS || !(m->color_mask & 7u);
}

/* The colour of a surface that lets light through. Each of a body's two surfaces applies half of it. */
static inline struct vec3 glass_tint(const struct tables *t, const struct point *p, const struct texturing *texturing)
{
	struct vec4 c = point_albedo(t, p, texturing);

	return v3(M_SQRT(clamp01(c.x)), M_SQRT(clamp01(c.y)), M_SQRT(clamp01(c.z)));
}

static inline struct vec3 glass_absorb(GLOBAL const struct scene_material *m, float length)
{
	return v3(M_EXP(-m->surface.absorb[0] * length), M_EXP(-m->surface.absorb[1] * length),
	          M_EXP(-m->surface.absorb[2] * length));
}

/* Normals perpendicular to the triangle's own, to within a thousandth, cannot tell its sides apart. */
#define TRANSPARENCY_ACROSS 1.0e-3f

/*
 * 1 if a ray to a light meets a one-sided surface on its visible side, so the light is behind it. Culled sides are not
 * visible; without culling, normals determine the side of a lit triangle (look/spare/sides.h). Both sides of glass
 * count.
 */
static inline int transparency_meets_shown(const struct point *p, struct vec3 d)
{
	struct vec3 plane, sum;
	float along;

	if (p->material->cull_face == GL_FRONT || p->material->cull_face == GL_BACK)
		return (p->material->cull_face == GL_BACK) == (p->front != 0);
	plane = point_plane_normal(p);
	sum = v3_add(v3_load(p->vertex[0]->normal), v3_add(v3_load(p->vertex[1]->normal), v3_load(p->vertex[2]->normal)));
	along = v3_dot(plane, sum);
	return p->material->lighting && !p->material->two_side &&
	       M_ABS(along) > TRANSPARENCY_ACROSS * M_SQRT(v3_dot(sum, sum)) && (along > 0.0f) == (v3_dot(plane, d) < 0.0f);
}

/* 1 if a surface is exempt from blocking a light (scene.h): because of the side that the ray meets, or because the
 * light is at infinity. */
static inline int transparency_is_spared(const struct point *p, struct vec3 d, int at_infinity)
{
	const uint32_t hidden = p->material->surface.hidden;

	return (hidden & SCENE_STOPS_NO_SUN && at_infinity) ||
	       (hidden & SCENE_ONE_SIDED && !(p->material->surface.transmit > 0.0f) && transparency_meets_shown(p, d));
}

/* Light that a stippled surface lets through (sec. 3.5.2): the share of its pixels that are not drawn. */
static inline float transparency_of_stipple(const struct tables *t, uint32_t stipple)
{
	uint32_t drawn = 0u;

	for (uint32_t row = 0u; row < 32u; row++)
		for (uint32_t bits = t->stipples[stipple * 32u + row]; bits; bits &= bits - 1u)
			drawn++;
	return 1.0f - (float)drawn / 1024.0f;
}

/* 1 if no part of a material that a ray to a light may hit can let it pass. */
static inline int transparency_is_none(GLOBAL const struct scene_material *m)
{
	return !m->alpha_test && !m->blend && !(m->surface.transmit > 0.0f) && !m->clip_plane_mask &&
	       m->polygon_stipple == SCENE_NONE &&
	       !(m->surface.hidden & (SCENE_HIDDEN_FROM_LIGHTS | SCENE_FILM | SCENE_STOPS_NO_SUN | SCENE_ONE_SIDED));
}

/*
 * Transmittance of the surface that a ray hit; 1 if it casts no shadow. to_lights: 1: a ray to a light, 0: one to the
 * surroundings
 */
static inline struct vec3 transparency_of_hit(const struct tables *t, const struct hit *hit,
                                              GLOBAL const struct ray *ray, uint32_t to_lights)
{
	struct vec3 d = v3_load(ray->d), none = v3(0.0f, 0.0f, 0.0f), all = v3(1.0f, 1.0f, 1.0f), pass;
	GLOBAL const struct scene_material *m = &t->materials[t->geometries[hit->instance].material];
	struct vec4 color = v4(0.0f, 0.0f, 0.0f, 0.0f);
	struct texturing texturing;
	float cosine, beyond;
	struct point p;
	struct lit lit;

	if (transparency_is_none(m))
		return none;
	p = point_from_hit(t, hit, d);
	if (m->surface.hidden & (SCENE_HIDDEN_FROM_LIGHTS | SCENE_FILM) ||
	    (to_lights && transparency_is_spared(&p, d, ray->t_max > 1.0f)))
		return all;
	if (m->polygon_stipple != SCENE_NONE && !m->blend && !m->alpha_test && !m->clip_plane_mask)
		return v3_scale(all, transparency_of_stipple(t, m->polygon_stipple));
	if (!m->alpha_test && !m->blend && !(m->surface.transmit > 0.0f) && !m->clip_plane_mask)
		return none;
	point_texture(t, &p, (const struct point_window *)0, &texturing);
	if (m->alpha_test || m->blend) {
		lit = point_lit_from_vertices(&p);
		color = point_finish(t, &p, &texturing, &lit);
	}
	if (transparency_is_hole(&p, color.w))
		return all;
	if (m->surface.transmit > 0.0f) {
		cosine = M_ABS(v3_dot(point_normal(&p), v3_normalize(d)));
		pass = v3_scale(glass_tint(t, &p, &texturing), clamp01(m->surface.transmit) *
		                (1.0f - glass_fresnel(1.0f / glass_ior(m), cosine, &beyond)));
		if (!glass_is_outside(&p)) /* on its way out: through the body since the last surface */
			pass = v3_mul(pass, glass_absorb(m, (hit->t - ray->t_min) * M_SQRT(v3_dot(d, d))));
		return pass;
	}
	if (!m->blend || m->surface.hidden & SCENE_SOLID)
		return none;
	/* Blended draws that leave no depth are light or film (glows, blob shadows), which do not block light. */
	return m->depth_write ? transparency_of_blend(m, color) : all;
}

/* Start of the search for the next surface on a ray: the same ray would meet the last surface at the same t again. */
static inline float ray_beyond(float t)
{
	return t > 0.0f ? M_FLOAT(M_BITS(t) + 1u) : 1.0e-37f;
}
