#include "replay/build/currents.h"

#include <math.h>
#include <string.h>

#include "gl_tokens.h"
#include "base/mat4.h"
#include "replay/build/intern.h"
#include "replay/build/material.h"
#include "replay/machine/state.h"
#include "scene/program.h"

#define MOST_TEXELS 1e6f /* above this, floats cannot tell a texel's centre from its edges */

/*
 * Texture coordinates that are constant over a draw's fragments. Mesa samples exactly there. Interpolated ones differ
 * in the last bits, which causes noise where two texels meet, so they are moved to the texel's centre, where this has
 * no effect. Filters that blend texels have no such places.
 */
static void settle(const struct scene *s, const struct scene_unit *unit, float c[4])
{
	const struct scene_texture *image = s->textures[unit->texture];
	const uint32_t sizes[3] = { image->width, image->height, image->depth };
	float inverse;

	if (unit->mag_filter != GL_NEAREST || unit->min_lod > 0 || image->border || c[3] == 0 ||
	    image->target == GL_TEXTURE_CUBE_MAP || memcmp(unit->matrix, mat4_identity, sizeof(unit->matrix)) != 0 ||
	    unit->gen_mode[0] || unit->gen_mode[1] || unit->gen_mode[2] || unit->gen_mode[3])
		return;
	inverse = 1 / c[3]; /* as llvmpipe divides: the exact quotient may fall on the other side of an edge */
	for (unsigned i = 0; i < 3; i++) {
		const float size = image->target == GL_TEXTURE_RECTANGLE ? 1 : (float)sizes[i], at = c[i] * inverse * size;

		if (fabsf(at) < MOST_TEXELS)
			c[i] = (floorf(at) + 0.5f) / size * c[3];
	}
}

/* Attributes that the mesh has or that nothing uses get GL's initial values, so that more currents are equal. */
uint32_t gls_frame_current(struct gls_exec *x, struct gls_frame *f, const struct scene_mesh *mesh,
                           const struct scene_material *m, const float (*values)[4])
{
	static const float white[4] = { 1, 1, 1, 1 }, up[4] = { 0, 0, 1, 0 }, origin[4] = { 0, 0, 0, 1 };
	struct scene *s = f->out;
	const uint32_t inputs = m->vertex_program ? scene_program_of(s, m->vertex_program)->inputs : 0;
	struct scene_current current;
	uint32_t varying = mesh->attributes, textured = 0;

	memset(&current, 0, sizeof(current));
	for (uint32_t i = 0; i < m->unit_count; i++)
		textured |= 1u << s->units[m->unit_first + i].unit;
	textured |= inputs >> SCENE_VERTEX_TEXCOORD;
	memcpy(current.color, varying & SCENE_HAS_COLOR ? white : values[GLS_ATTR_COLOR], 16);
	memcpy(current.secondary, varying & SCENE_HAS_SECONDARY ? origin : values[GLS_ATTR_SECONDARY], 16);
	memcpy(current.normal, varying & SCENE_HAS_NORMAL ? up : values[GLS_ATTR_NORMAL], 12);
	for (unsigned u = 0; u < SCENE_MAX_UNITS; u++) {
		int is_read = textured >> u & 1 && !(varying >> (GLS_ATTR_TEXCOORD + u) & 1);
		memcpy(current.texcoord[u], is_read ? values[GLS_ATTR_TEXCOORD + u] : origin, 16);
	}
	for (unsigned i = 0; i < SCENE_MAX_GENERICS; i++)
		memcpy(current.generics[i], inputs >> (SCENE_VERTEX_GENERIC + i) & 1 && !(varying >> (GLS_ATTR_GENERIC + i) & 1) ?
		       values[GLS_ATTR_GENERIC + i] : origin, 16);
	current.fog_coord = varying & SCENE_HAS_FOG_COORD ? 0 : values[GLS_ATTR_FOG_COORD][0];
	for (uint32_t i = 0; i < m->unit_count && !m->vertex_program && !m->fragment_program; i++) {
		const struct scene_unit *unit = &s->units[m->unit_first + i];

		if (!(varying >> (GLS_ATTR_TEXCOORD + unit->unit) & 1) && s->textures[unit->texture]->n_levels)
			settle(s, unit, current.texcoord[unit->unit]);
	}
	return gls_intern(x, &f->currents, &s->currents, &s->n_currents, &f->room.currents, &current, sizeof(current));
}
