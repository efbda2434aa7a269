/* Lights and the sky under rules. */
#pragma once

#include "look/apply/applying.h"

/** 1 if a rule places its light in the world rather than in eye space. */
int lights_in_world(const struct light_rule *r);

/** LIGHTS_ON_UNLIT and LIGHTS_ON_LIT, if a rule changes the light of such surfaces. 0: it only gives a light a size. */
int lights_change_of(const struct light_rule *r);

/** A light's position in eye space. If the frame does not draw its object, the position is taken as written. */
void lights_place(const struct applying *a, const struct light_rule *r, float out[4]);

/**
 * The lights of an instance: OpenGL's under the rules, and added ones; if there are too many, the strongest. @return
 * how many
 */
uint32_t lights_list(const struct applying *a, const struct scene_instance *in, const struct scene_material *m,
                     struct scene_light out[SCENE_MAX_LIGHTS]);

/** 1 if an instance whose vertices all have one colour is as bright as ambient light makes it, so that no other light
 * of the rules reaches it. */
int lights_leave_in_shade(const struct applying *a, const struct scene_instance *in);

/** Set the sizes of OpenGL's own lights, and the sky, in the changed scene. */
void lights_size(const struct rules *rules, struct scene *s);
void lights_set_sky(const struct applying *a);
