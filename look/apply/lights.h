/* Lights and the sky under the rules. */
#pragma once

#include "look/apply/applying.h"

/** 1 where a light's rule stands in the world, not in eye space. */
int lights_in_world(const struct light_rule *r);

/** Bits as applying.lights_change: which surfaces a rule of lights lights otherwise than OpenGL. 0: it gives a light a
 * size at most. */
int lights_change_of(const struct light_rule *r);

/** A light's position in eye space. It stays as written where the frame does not draw its object. */
void lights_place(const struct applying *a, const struct light_rule *r, float out[4]);

/** An instance's lights: OpenGL's under the rules, and added ones, the strongest where they are too many. @return how
 * many */
uint32_t lights_list(const struct applying *a, const struct scene_instance *in, const struct scene_material *m,
                     struct scene_light out[SCENE_MAX_LIGHTS]);

/** 1 where an instance whose vertices all have one colour is as bright as ambient light makes it: no other light of the
 * rules falls there. */
int lights_leave_in_shade(const struct applying *a, const struct scene_instance *in);

/** The sizes of OpenGL's own lights, and the sky, of the changed scene. */
void lights_size(const struct rules *rules, struct scene *s);
void lights_set_sky(const struct applying *a);
