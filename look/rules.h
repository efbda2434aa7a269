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
 *           stencil_tested: no
 *           environment_mapped: no   # a texture's coordinates are made from what the surface mirrors
 *           units: 2                 # texture units
 *           multiplies: no           # is blended so that it multiplies what is there
 *           parallel: no             # projection
 *           modelview: plain         # mirrored, or singular as of shadows on a plane
 *           in_plane: [0, 1, 0, -2]  # lies in this plane of the world (a, b, c, d), but for an edge; not where the world is unknown
 *         reflect: 0.2               # [0,1]
 *         transmit: 0.8              # [0,1], with reflect at most 1
 *         ior: 1.5                   # 1 and more
 *         absorb: [0.2, 0, 0]        # a unit of eye space inside
 *         roughness: 0.05            # of mirrors
 *         emission: [0, 0, 0]        # beside what OpenGL shows
 *         shadows: yes               # casts them
 *         passes: none               # light that it lets through all the same, in place of what each frame decides (look/spare.h):
 *                                    # none, from behind (of its lit side), suns (light at infinity), suns and from behind, all
 *         mirrors: yes               # is seen in them and through glass
 *         near: yes                  # `reflect` mirrors what is there; where nothing is, the surface keeps its own colour
 *         lightmap: 1                # of what takes the lights below: the texture unit that holds light
 *         vertex_light: yes          # of what takes the lights below: vertex colours hold light, and are no part of its own colour; one
 *                                    # colour for all vertices does where it is that of the ambient light below
 *         shadow_unit: 0             # of what OpenGL lights: the texture unit that holds a shadow, which traced ones replace
 *         shaded: no                 # nothing shades it: it keeps the light that OpenGL gives it, and takes none of the lights below
 *         lit: yes                   # takes the lights below where OpenGL does not light it
 *         crease: 40                 # of what OpenGL lights face by face: faces that meet at up to so many degrees look round, sharper
 *                                    # edges stay; [0,180], default 0. Edges, shadows' outlines and N stay; modes of paths do without
 *         repair: { weld: 4e-6, turn: yes } # cracks of its mesh are closed for all rays but the camera's (scene/repair/repair.h): places nearer
 *                                    # than this share of its size become one; corners on others' edges join them; with `turn`
 *                                    # (default: where it transmits) faces look out of closed bodies, as glass must; with `merge`
 *                                    # triangles of one plane are fewer, where nothing shows. {}: the defaults
 *         dome: no                   # does not take the light of `sky` below
 *         left_out: yes              # a trick: only OpenGL's picture shows it; what is `modelview: mirrored` is left out only in
 *                                    # frames with a `solid` mirror, if rules have one
 *         parameters:                # of a hook (hooks/README.md), for these surfaces
 *           - { name: tint, value: [1, 0, 0] }
 *         solid: yes                 # a mirror that is blended over its picture: the traced one is not
 *     world:                         # meshes that stand still, and where: 16 numbers, column by column. A frame that draws
 *       - mesh: 90c2                 # enough of them shows where the viewer is
 *         at: [1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 0, 1]
 *     unseen:                        # what stands still and not every frame draws: mirrors and shadows have it in each
 *       - frame: 12                  # that draws it,
 *         draws: 3-7,12              # with these draw numbers; needs `world`
 *     lights:
 *       - light: 0                   # OpenGL's; without this key a light is added
 *         off: no
 *         position: [0, 5, 0, 1]     # w 0: a direction towards it; in eye space, or
 *         object: 90c2               # in the space in which the first mesh of this hash was drawn, or
 *         space: world               # as the list `world` says
 *         on: unlit                  # lights only what OpenGL does not (and has `lit: yes`)
 *         diffuse: [1, 1, 1]         # also ambient and specular
 *         attenuation: [1, 0, 0]
 *         spot: { direction: [0, 0, -1], cutoff: 30, exponent: 0 }
 *         radius: 0.3                # soft shadows: of the light's sphere; for a direction, the tangent of half its angle
 *         shadows: yes               # no: nothing stops it
 *
 *     sky:                           # light from all around on solid things that no light above lights
 *       reach: 20                    # how far off things dim it, in units of eye space; near ones dim it more
 *       up: [0, 1, 0]                # whence `light` comes; from below comes `ground`. Without it all is `light`
 *       space: world                 # of `up`; default eye
 *       light: [1, 1, 1]
 *       ground: [0.5, 0.5, 0.5]
 *       lit: 0.5                   # [0,1]: how much of it counts on what OpenGL lights; default 0
 *       unlit: no                  # default yes: what OpenGL does not light takes it
 *
 *     gloss: { share: 1 }            # what is lit with highlights mirrors what is near (look/gloss.h): so much of it; default 0
 *
 *     parameters:                    # of a hook, for all surfaces and for rays that meet none
 *       - { name: bands, value: [4] }
 *
 *     spare: no                      # default yes: what a closed room, a backdrop or crossed cards would shut off from light is
 *                                    # lit as OpenGL lights it (look/spare.h), and what covers the window as
 *                                    # the picture of a framebuffer object is traced (replay/gl/surface/shown.h)
 *     replace: yes                   # no: rules with left_out, solid or shadow_unit do nothing
 *
 * Each rule may also say `role`, `confidence`, `why` and `plane` (four numbers), for its reader alone. A frame that does not show where
 * the world is, where some light stands in it, is left as OpenGL drew it.
 *
 * OpenGL's own picture (channels gl.*) never changes: channel relight has what rules do to lights and emission.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/frames.h"

/* Pointers are NULL for keys that the file does not have. */
struct match {
	const char *texture, *mesh, *draws, *call;
	const uint32_t *list;
	const bool *program, *lit, *textured, *blended, *alpha_tested, *depth_tested, *stencil_tested, *environment_mapped, *multiplies, *parallel;
	const uint32_t *units;
	const char *modelview;
	const float *in_plane;
};

/* What a rule says to its reader alone. */
struct rule_reason {
	const char *role, *why;
	const float *confidence, *plane;
};

struct parameter_rule {
	const char *name;
	const float *value;
	uint32_t value_count;
};

struct repair_rule {
	const float *weld;
	const bool *turn, *merge;
};

struct surface_rule {
	struct rule_reason reason;
	struct match *match;
	const float *reflect, *transmit, *ior, *roughness, *absorb, *emission, *crease;
	const uint32_t *lightmap, *shadow_unit;
	const bool *shadows, *mirrors, *near, *shaded, *lit, *dome, *left_out, *solid, *vertex_light;
	const char *passes;
	struct repair_rule *repair;
	struct parameter_rule *parameters;
	uint32_t parameters_count;
};

struct spot {
	const float *direction, *cutoff, *exponent;
};

struct light_rule {
	struct rule_reason reason;
	const uint32_t *light;
	const bool *off;
	const bool *shadows;
	const char *object, *space, *on;
	const float *position, *ambient, *diffuse, *specular, *attenuation, *radius;
	struct spot *spot;
};

struct sky_rule {
	struct rule_reason reason;
	const float *reach, *up, *light, *ground, *lit;
	const bool *unlit;
	const char *space;
};

struct gloss_rule {
	struct rule_reason reason;
	const float *share;
};

struct anchor {
	const char *mesh;
	const float *at;
};

struct unseen_rule {
	struct rule_reason reason;
	const uint32_t *frame;
	const char *draws;
};

struct rules {
	struct surface_rule *surfaces;
	struct light_rule *lights;
	struct anchor *world;
	struct unseen_rule *unseen;
	struct sky_rule *sky;
	struct gloss_rule *gloss;
	const bool *spare;
	const bool *replace;
	struct parameter_rule *parameters;
	uint32_t parameters_count;
	uint32_t surfaces_count, lights_count, world_count, unseen_count; /* libcyaml wants these names */
};

struct scene;

struct look {
	struct rules *rules;
	struct matched *matched; /* what rules matched so far (look/matched.h) */
	struct repaired *repaired; /* meshes (look/repaired.h); NULL: no rule repairs any */
	struct frame_list *draws; /* [surfaces_count] */
	struct unseen {
		struct frame_list draws;
		struct scene *scene; /* of its frame; NULL: it is not there. Given back by rules_free */
	} *unseen; /* [unseen_count] */
};

/** @return 0; ERR_INPUT (reported, with the line), ERR_SYSTEM (reported) */
int rules_load(const char *path, struct look **out);

/** The same for text in memory. @param name  what messages call it */
int rules_parse(const char *name, const char *text, size_t n, struct look **out);
void rules_free(struct look **look);
