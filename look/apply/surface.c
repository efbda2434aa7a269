#include "look/apply/surface.h"

void surface_set(struct scene_surface *s, const struct surface_rule *r, int spares)
{
	uint32_t passes;

	applying_number(&s->reflect, r->reflect, 1);
	if (r->reflect) { /* overrides the highlights */
		s->hidden &= ~SCENE_NEAR_MIRROR;
		s->roughness = 0;
	}
	applying_number(&s->transmit, r->transmit, 1);
	applying_number(&s->ior, r->ior, 1);
	applying_number(&s->roughness, r->roughness, 1);
	applying_number(s->absorb, r->absorb, 3);
	applying_number(s->emission, r->emission, 3);
	if (r->passes && spares && spare_named(r->passes, &passes)) {
		passes &= s->hidden | ~SCENE_ONE_SIDED; /* without a lamp behind, there is nothing to test */
		passes |= passes & SCENE_ONE_SIDED ? s->hidden & SPARE_WINDING : 0;
		s->hidden = (s->hidden & ~SPARE_BITS) | passes;
	}
	if (r->shadows)
		s->hidden = (s->hidden & ~(SPARE_BITS | SCENE_CARD | SCENE_FACETED | SCENE_FILM)) |
		            (*r->shadows ? 0u : SCENE_HIDDEN_FROM_LIGHTS);
	if (r->mirrors)
		s->hidden = (s->hidden & ~SCENE_HIDDEN_FROM_MIRRORS) | (*r->mirrors ? 0u : SCENE_HIDDEN_FROM_MIRRORS);
	if (r->near)
		s->hidden = (s->hidden & ~SCENE_NEAR_MIRROR) | (*r->near ? SCENE_NEAR_MIRROR : 0);
	if (r->shaded)
		s->hidden = (s->hidden & ~SCENE_UNSHADED) | (*r->shaded ? 0 : SCENE_UNSHADED);
	if (r->left_out)
		s->hidden = (s->hidden & ~SCENE_LEFT_OUT) | (*r->left_out ? SCENE_LEFT_OUT : 0);
	if (r->solid)
		s->hidden = (s->hidden & ~SCENE_SOLID) | (*r->solid ? SCENE_SOLID : 0);
	if (r->lightmap)
		s->light_unit = *r->lightmap + 1;
	if (r->vertex_light)
		s->light_unit = *r->vertex_light ? SCENE_LIGHT_IN_COLORS : 0;
	if (r->shadow_unit)
		s->light_unit = *r->shadow_unit + 1;
	if (r->lit)
		s->relit = *r->lit;
	if (r->dome)
		s->hidden = (s->hidden & ~SCENE_DOME_LIT) | (*r->dome ? SCENE_DOME_LIT : 0);
}
