/*
 * Rules, written after recording, that say what surfaces are made of and where lights are: `relume render --look FILE`.
 *
 *     surfaces:                      # all matching rules apply, in order; later ones override
 *       - match:                     # every key must match; no keys: everything
 *           texture: 3fa1            # hash of one of its textures, or the start of it (`relume scene --json` shows it)
 *           mesh: 90c2               # the same for its mesh
 *           draws: 3-7,12            # draw numbers in the frame
 *           call: glCallList         # the call that drew it
 *           list: 5                  # the display list that it came from
 *           program: no              # drawn by a program object
 *           lit: yes                 # draw state, as OpenGL saw it
 *           textured: yes
 *           blended: no
 *           alpha_tested: no
 *           depth_tested: yes
 *         reflect: 0.2               # [0,1]
 *         transmit: 0.8              # [0,1], with reflect at most 1
 *         ior: 1.5                   # 1 and more
 *         absorb: [0.2, 0, 0]        # a unit of eye space inside
 *         roughness: 0.05            # of mirrors
 *         emission: [0, 0, 0]        # beside what OpenGL shows
 *         shadows: yes               # casts them
 *         mirrors: yes               # is seen in them and through glass
 *         lit: yes                   # takes the lights below where OpenGL does not light it
 *     lights:
 *       - light: 0                   # OpenGL's; without this key a light is added
 *         off: no
 *         position: [0, 5, 0, 1]     # w 0: a direction towards it; in eye space, or
 *         object: 90c2               # in the space in which the first mesh of this hash was drawn
 *         diffuse: [1, 1, 1]         # also ambient and specular
 *         attenuation: [1, 0, 0]
 *         spot: { direction: [0, 0, -1], cutoff: 30, exponent: 0 }
 *         radius: 0.3                # soft shadows: of the light's sphere; for a direction, the tangent of half its angle
 *
 * OpenGL's own picture (channels gl.*) never changes: channel relight has what rules do to lights and emission.
 */
#pragma once

#include "scene/scene.h"

struct look;

/** @return 0; ERR_INPUT (reported, with the line), ERR_SYSTEM (reported) */
int look_load(const char *path, struct look **out);
void look_free(struct look **look);

/**
 * A scene under the rules.
 * @param out  a copy that borrows what has not changed; free it with look_release before the scene
 * @return 0 or ERR_SYSTEM (reported)
 */
int look_apply(const struct look *look, const struct scene *scene, struct scene *out);
void look_release(struct scene *changed);
