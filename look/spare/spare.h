/*
 * Do no harm: surfaces that were never meant to block light. A program without shadows may light a closed hall from
 * outside, put a lit figure between walls that are pictures, and cross two cards for a tree. Shadows would make such
 * scenes worse than OpenGL's picture. In rules, `spare: no` turns this off; `shadows: yes` of a surface overrides it
 * (look/rules/rules.h).
 *
 *   sheets       A surface that shows one side alone, by culling or lighting, blocks light on that side alone
 *                (sides.h).
 *   enclosures   A light is shut out if it reaches less than a tenth of the surfaces that it lights. Walls shut it out
 *                if both their sides are lit, or if they have an outside as well. They let all light through that
 *                comes from beyond.
 *   globes       A body around a lamp whose inside is never visible lets the lamp's light through (globes.h).
 *   backdrops    Surfaces that OpenGL does not light block no light at infinity, unless they are inside the lit
 *                world: a tree on a lit hill casts a shadow, the walls around a lit figure do not.
 *   flattened    A body whose shadow the program draws casts no second one (flattened.h).
 *   carved       Draws that show a part of a body alone block no light (carved.h).
 *   cards        Crossed cut-out cards do not shade each other.
 *   terminator   Flat faces with smooth normals do not block light at grazing angles. This one is done by the
 *                kernels (kernels/frame/light/shadow.h).
 *
 * All decisions use the geometry of the whole frame, hidden surfaces included, so that they change little as the
 * camera moves.
 */
#pragma once

#include "look/spare/sides.h"
#include "scene/scene.h"

enum { SPARE_MOST_LAMPS = 16 };

/* Bits that rules set before the search. */
enum {
	SPARE_IS_DECIDED = 1,   /* the decisions about enclosures and backdrops are made already */
	SPARE_NEW_LIGHTS = 2,   /* rules add lights, which may be anywhere */
	SPARE_TRICKS_STAY = 4,  /* drawn shadows do not give way to traced ones */
	SPARE_TRICKS_KNOWN = 8, /* drawn shadows are handled already */
};

/* Bits of scene_surface's `hidden` that this search sets, except for cards. */
#define SPARE_BITS (SCENE_HIDDEN_FROM_LIGHTS | SCENE_ONE_SIDED | SCENE_STOPS_NO_SUN | SPARE_WINDING)
/* How the sides of one-sided surfaces are distinguished. */
#define SPARE_WINDING (SCENE_SHOWN_COUNTER | SCENE_SHOWN_CLOCKWISE)

struct spare {
	uint32_t *bits; /* [n_instances]: SCENE_ONE_SIDED and so on; NULL: nothing is spared */
	uint32_t one_sided, flattened, enclosures, backdrops, cards, carved; /* numbers of instances */
	struct sides_lamp lamps[SPARE_MOST_LAMPS];
	uint32_t n_lamps;
	int kept; /* 1: rules turn all of this off (look_apply) */
};

/** Describe which light a surface lets through, as `passes` in rules.h does. @param bits  of SPARE_BITS */
const char *spare_name(uint32_t bits);

/** @return 1; 0: unknown */
int spare_named(const char *name, uint32_t *bits);

/**
 * @param said  SPARE_IS_DECIDED and the bits after it
 * @param out   filled; free with spare_free
 * @return 0 or ERR_SYSTEM (reported)
 */
int spare_find(const struct scene *scene, unsigned said, struct spare *out);
void spare_free(struct spare *spare);

/**
 * Text for diff's gate N: positions of lights ("x y z w,..."), draw numbers of cards that shade each other
 * ("3-7,12"), and of tricks that traced light replaces. To be freed; NULL: out of memory.
 */
char *spare_tell_lights(const struct spare *spare);
char *spare_tell_cards(const struct spare *spare, const struct scene *scene);
char *spare_tell_left_out(const struct scene *scene);
