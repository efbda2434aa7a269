/*
 * Do no harm: surfaces that OpenGL never meant to stand in light's way. A program that knows no shadows may light a
 * closed hall from outside of it, put a lit figure between walls that are pictures, and cross two cards for a tree.
 * What shadows make of that is worse than what OpenGL drew. Rules: `spare: no` turns this off; `shadows: yes` of a
 * surface has the last word (look/rules.h).
 *
 *   sheets       What shows one side alone, by culling or lighting, blocks light on that side alone (look/sides.h).
 *   enclosures   A light that reaches less than a tenth of what it lights is shut out: by walls that are lit on both
 *                sides, or have an outside as well. Surfaces that shut it out let all light through that comes from
 *                beyond.
 *   globes       A body around a lamp, which sees the side that nobody does, lets its light through (look/globes.h).
 *   backdrops    What OpenGL does not light stops no light at infinity, unless it stands within the lit world: a tree
 *                on a lit hill casts a shadow, the walls around a lit figure do not.
 *   flattened    What the program draws a shadow of throws no second one (look/flattened.h).
 *   carved       Draws that show a part of a body alone stop no light (look/carved.h).
 *   cards        Crossed cut-out cards do not shade each other.
 *   terminator   Flat faces with smooth normals do not stop light that grazes them (kernels/frame/shadow.h); that is
 *                found by the kernels.
 *
 * All of it is decided from the geometry of the whole frame, also where something else hides it, so that it changes
 * little as the camera moves.
 */
#pragma once

#include "look/sides.h"
#include "scene/scene.h"

enum { SPARE_MOST_LAMPS = 16 };

/* Bits that rules set before anything is looked for. */
enum {
	SPARE_IS_DECIDED = 1,   /* what of enclosures and backdrops lets light pass */
	SPARE_NEW_LIGHTS = 2,   /* there are lights of rules' own, which may stand anywhere */
	SPARE_TRICKS_STAY = 4,  /* drawn shadows do not give way to traced ones */
	SPARE_TRICKS_KNOWN = 8, /* drawn shadows are seen to already */
};

/* What sparing decides of a surface, cards apart: bits of scene_surface's `hidden`. */
#define SPARE_BITS (SCENE_HIDDEN_FROM_LIGHTS | SCENE_ONE_SIDED | SCENE_STOPS_NO_SUN | SPARE_WINDING)
/* How one-sided ones are told apart. */
#define SPARE_WINDING (SCENE_SHOWN_COUNTER | SCENE_SHOWN_CLOCKWISE)

struct spare {
	uint32_t *bits; /* [n_instances]: SCENE_ONE_SIDED and the like; NULL: nothing is spared */
	uint32_t one_sided, flattened, enclosures, backdrops, cards, carved; /* instances */
	struct sides_lamp lamps[SPARE_MOST_LAMPS];
	uint32_t n_lamps;
	int kept; /* 1: rules keep all this from being spared (look_apply) */
};

/** Which light a surface lets through, in words of rules.h (`passes`). bits: of SPARE_BITS */
const char *spare_name(uint32_t bits);

/** @return 1; 0: there is no such word */
int spare_named(const char *name, uint32_t *bits);

/**
 * @param said  SPARE_IS_DECIDED and what follows it
 * @param out   filled; free with spare_free
 * @return 0 or ERR_SYSTEM (reported)
 */
int spare_find(const struct scene *scene, unsigned said, struct spare *out);
void spare_free(struct spare *spare);

/**
 * What diff's gate N wants to know: places of lights ("x y z w,..."), draw numbers of cards that shade each other
 * ("3-7,12"), of tricks that traced light takes the place of. To be freed; NULL: out of memory.
 */
char *spare_tell_lights(const struct spare *spare);
char *spare_tell_cards(const struct spare *spare, const struct scene *scene);
char *spare_tell_left_out(const struct scene *scene);
