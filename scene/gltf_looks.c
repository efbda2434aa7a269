/* Converts GL materials to glTF's metallic-roughness ones. */
#include "scene/gltf_looks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gl_tokens.h"
#include "scene/png_pack.h"

/* Store level 0 as PNG. */
static uint32_t put_image(struct gltf *g, const struct scene_texture *t)
{
	uint32_t piece = SCENE_NONE;
	uint8_t *png = NULL;
	size_t n = 0;
	void *out = png_pack_texture(t, &png, &n) ? NULL : gltf_put_piece(g, n, 0, &piece);

	if (out)
		memcpy(out, png, n);
	else
		g->failed = 1;
	free(png);
	return piece;
}

/* The number of a unit's texture with its sampler. Each image is stored once. */
static uint32_t put_sampled(struct gltf *g, const struct scene_unit *u)
{
	struct gltf_sampled s = { u->texture, SCENE_NONE, u->wrap_s, u->wrap_t, u->min_filter, u->mag_filter };

	for (uint32_t i = 0; i < g->n_sampled; i++) {
		if (g->sampled[i].texture != s.texture)
			continue;
		s.piece = g->sampled[i].piece;
		if (memcmp(&g->sampled[i], &s, sizeof(s)) == 0)
			return i;
	}
	if (s.piece == SCENE_NONE)
		s.piece = put_image(g, g->s->textures[s.texture]);
	return GLTF_PUSH(g, sampled, s);
}

/* 1 if a unit lets its texture's colour through, and not only its alpha as for shadows and fades (GL 2.1 sec. 3.8.13).
 * */
static int shows_color(const struct scene_unit *u)
{
	const int n = u->combine_rgb == GL_REPLACE ? 1 : u->combine_rgb == GL_INTERPOLATE ? 3 : 2;

	for (int i = 0; i < n && u->env_mode == GL_COMBINE; i++)
		if (u->source_rgb[i] == GL_TEXTURE &&
		    (u->operand_rgb[i] == GL_SRC_COLOR || u->operand_rgb[i] == GL_ONE_MINUS_SRC_COLOR))
			return 1;
	return u->env_mode != GL_COMBINE;
}

/* Likelihood that a texture is the surface's own colour; 0: it is not, or glTF cannot place it. */
static int rank(const struct scene_texture *t, const struct scene_mesh *mesh, const struct scene_unit *u)
{
	const int has_colors = t->base_format == GL_RGB || t->base_format == GL_RGBA;
	const int is_own = mesh->texcoord[u->unit] != NULL; /* else one texel colours the whole mesh */

	if ((t->target != GL_TEXTURE_2D && t->target != GL_TEXTURE_RECTANGLE) || t->base_format == GL_DEPTH_COMPONENT ||
	    u->gen_mode[0] || u->gen_mode[1] || !shows_color(u))
		return 0;
	return 1 + has_colors + 2 * is_own;
}

const struct scene_unit *gltf_shown_unit(struct gltf *g, const struct scene_material *m, const struct scene_mesh *mesh)
{
	const struct scene_unit *found = NULL;
	int best = 0;

	for (uint32_t i = 0; i < m->unit_count; i++) {
		const struct scene_unit *u = &g->s->units[m->unit_first + i];
		const int r = rank(g->s->textures[u->texture], mesh, u);

		if (r > best) {
			best = r;
			found = u;
		}
	}
	for (uint32_t i = 0; i < m->unit_count && !found; i++)
		if (g->s->units[m->unit_first + i].gen_mode[0]) {
			g->losses->texgen++;
			break;
		}
	g->losses->more_units += m->unit_count > 1;
	return found;
}

uint32_t gltf_put_look(struct gltf *g, const struct scene_material *m, const struct scene_unit *unit,
                       const float color[4], int vertex_colors)
{
	struct gltf_look look;
	const struct scene_face *f = &m->front;
	float base[4] = { 1, 1, 1, 1 };

	memset(&look, 0, sizeof(look)); /* padding must be equal, as looks are compared by their bytes */
	if (m->lighting && !m->color_material)
		memcpy(base, f->diffuse, sizeof(base));
	else if (!vertex_colors)
		memcpy(base, color, sizeof(base));
	for (int i = 0; i < 3; i++) {
		look.base[i] = gltf_linear(base[i]);
		look.emissive[i] = m->lighting ? gltf_linear(f->emission[i]) : 0;
	}
	look.base[3] = fminf(fmaxf(base[3], 0), 1);
	look.unlit = !m->lighting;
	look.roughness = powf(2 / (fmaxf(f->shininess, 0) + 2), 0.25f);
	if (f->specular[0] + f->specular[1] + f->specular[2] == 0)
		look.roughness = 1;
	if (m->surface.reflect > 0 || m->surface.transmit > 0)
		look.roughness = 0;
	look.metallic = fminf(m->surface.reflect, 1);
	look.transmission = fminf(m->surface.transmit, 1);
	look.ior = look.transmission > 0 && m->surface.ior >= 1 ? m->surface.ior : 1;
	look.blend = m->blend != 0;
	look.mask = !look.blend && m->alpha_test && (m->alpha_func == GL_GREATER || m->alpha_func == GL_GEQUAL);
	look.cutoff = look.mask ? m->alpha_ref : 0;
	look.double_sided = !m->cull_face;
	look.texture = unit ? put_sampled(g, unit) : SCENE_NONE;
	g->losses->blended += look.blend && (m->blend_src_rgb != GL_SRC_ALPHA || m->blend_dst_rgb != GL_ONE_MINUS_SRC_ALPHA);
	g->losses->fogged += m->fog != 0;
	for (uint32_t i = 0; i < g->n_looks; i++)
		if (memcmp(&g->looks[i], &look, sizeof(look)) == 0)
			return i;
	return GLTF_PUSH(g, looks, look);
}
