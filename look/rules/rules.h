/*
 * Rules about surfaces and lights, written after recording: relume render --look FILE. All keys are optional. An
 * unknown key is an error, reported with its line. Several files apply in order, as do the rules of a file: later ones
 * override earlier ones. 'relume look' studies a recording and writes such a file.
 *
 * OpenGL's own picture (channels gl.*) never changes. Channel relight holds the effect of rules on lights and emission.
 * If rules give a light a place in the world, a frame whose place in the world is unknown stays as OpenGL drew it.
 *
 * KEYS
 *     surfaces:                   # a list of rules; all that match apply
 *       - match:                  # which draws; all these keys must match. Without keys: all draws
 *           texture: 3fa1         # hash of one of its textures, or how it starts ('relume scene --json' prints it)
 *           mesh: 90c2            # hash of its mesh, likewise
 *           draws: 3-7,12         # draw numbers in the frame
 *           call: glCallList      # the OpenGL call that drew it
 *           list: 5               # the display list that holds the call
 *           program: no           # drawn by a program object
 *           lit: yes              # OpenGL's lighting is on
 *           textured: yes         # it has a texture
 *           blended: no           # blending is on
 *           alpha_tested: no      # the alpha test is on
 *           depth_tested: yes     # the depth test is on
 *           stencil_tested: no    # the stencil test is on
 *           environment_mapped: no # texture coordinates are generated from reflection
 *           units: 2              # the number of its texture units
 *           multiplies: no        # blending multiplies the picture
 *           parallel: no          # the projection is parallel
 *           modelview: plain      # plain, mirrored, or singular as for shadows drawn on a plane
 *           in_plane: [0, 1, 0, -2] # lies in this plane of the world (a, b, c, d), except for an edge; matches
 *                                 # nothing in frames whose place in the world is unknown
 *         reflect: 0.2            # share of light that it mirrors, [0,1]
 *         transmit: 0.8           # share of light that passes, as through glass, [0,1]; reflect and transmit add
 *                                 # up to at most 1
 *         ior: 1.5                # index of refraction, at least 1
 *         absorb: [0.2, 0, 0]     # red, green and blue absorbed per unit of eye space inside
 *         roughness: 0.05         # blurs its reflections
 *         emission: [0, 0, 0]     # light that it emits, added to OpenGL's colour
 *         shadows: yes            # whether it casts shadows
 *         passes: none            # light that passes through it even so; default: each frame decides. none, from
 *                                 # behind (if it shows one side only), suns (lights at infinity), suns and from
 *                                 # behind, or all
 *         mirrors: yes            # whether it is visible in mirrors and through glass
 *         near: yes               # reflect mirrors only nearby things; where there are none, the surface keeps its
 *                                 # own colour
 *         lightmap: 1             # for surfaces that the lights below light: the texture unit that holds light
 *         vertex_light: yes       # for surfaces that the lights below light: vertex colours hold light and do not
 *                                 # belong to the surface's own colour. If all vertices share one colour, this
 *                                 # applies only if it is that of the ambient light below
 *         shadow_unit: 0          # for surfaces that OpenGL lights: the texture unit that holds a shadow, which
 *                                 # traced shadows replace
 *         shaded: no              # no: it keeps OpenGL's light, even in shadow, and the lights below do not light it
 *         lit: yes                # the lights below light it if OpenGL does not
 *         crease: 40              # for surfaces that OpenGL lights face by face: edges of up to this angle look
 *                                 # round, sharper edges stay; degrees, [0,180], default 0. Silhouettes, outlines of
 *                                 # shadows and channel N stay. Mode path ignores this key
 *         repair:                 # closes cracks in its mesh, for all rays but the camera's; repair: {} uses the
 *                                 # defaults
 *           weld: 4e-6            # merges corners nearer than this share of the mesh's size, and inserts corners
 *                                 # into the edges that they lie on
 *           turn: yes             # turns the faces of closed bodies outwards, as glass needs; default: yes if it
 *                                 # transmits
 *           merge: no             # merges triangles of one plane where that is invisible
 *         dome: no                # no: the light of `sky` below does not light it
 *         left_out: yes           # a trick that only OpenGL's picture shows. Mirrored draws (`modelview: mirrored`)
 *                                 # are left out only in frames with a `solid` mirror, if rules have one
 *         solid: yes              # a mirror that the program blends over its picture: the traced one is not blended
 *         parameters:             # of a hook, for these surfaces ('relume help hook-file')
 *           - { name: tint, value: [1, 0, 0] }
 *     world:                      # meshes that stand still; a frame that draws enough of them shows where the
 *                                 # viewer is
 *       - mesh: 90c2              # its hash
 *         at: [1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 0, 1] # its place: a matrix, column by column
 *         part: 1                 # the part of the recording that it belongs to; positions in one part are unknown
 *                                 # in another. Default 0
 *     unseen:                     # static things that some frames omit; mirrors and shadows show them in all frames
 *       - frame: 12               # a frame that draws them
 *         draws: 3-7,12           # their draw numbers there; needs `world`. Frames of the same part get them
 *     lights:                     # a list of rules
 *       - light: 0                # the light of OpenGL to change; without this key, a light is added
 *         off: no                 # yes: it is switched off
 *         position: [0, 5, 0, 1]  # a position, or, with 0 as the fourth number, a direction towards the light; in
 *                                 # eye space unless one of the next two keys is present
 *         object: 90c2            # the position is in the space of the first mesh drawn with this hash
 *         space: world            # the position is in the world that the list `world` describes
 *         on: unlit               # lights only surfaces that OpenGL does not light and that have `lit: yes`
 *         diffuse: [1, 1, 1]      # its colour; also ambient and specular
 *         attenuation: [1, 0, 0]  # constant, linear and quadratic, as in OpenGL
 *         spot: { direction: [0, 0, -1], cutoff: 30, exponent: 0 } # a cone, as in OpenGL
 *         radius: 0.3             # makes shadows soft: the radius of its sphere or, for a direction, the tangent of
 *                                 # half its angle
 *         shadows: yes            # no: nothing blocks it
 *     sky:                        # light from all around, for solid surfaces that no light above lights
 *       reach: 20                 # things closer than this dim it, in units of eye space; near ones dim it more
 *       up: [0, 1, 0]             # the direction that `light` comes from; `ground` comes from the opposite one.
 *                                 # Without this key, `light` comes from everywhere
 *       space: world              # the space of `up`; default eye
 *       light: [1, 1, 1]          # its colour from above
 *       ground: [0.5, 0.5, 0.5]   # its colour from below
 *       lit: 0.5                  # its weight on surfaces that OpenGL lights, [0,1]; default 0
 *       unlit: no                 # no: it does not light surfaces that OpenGL does not light; default yes
 *     gloss: { share: 1 }         # surfaces with highlights mirror nearby things, scaled by this; default 0
 *     parameters:                 # of a hook, for all surfaces and for rays that hit nothing
 *       - { name: bands, value: [4] }
 *     spare: no                   # no: surfaces that would darken the whole scene, such as closed rooms, backdrops
 *                                 # and crossed cards, block light too. Default yes: they let it pass, and a quad
 *                                 # that covers the window with a framebuffer object's picture is traced as that
 *                                 # picture
 *     replace: yes                # no: rules with left_out, solid or shadow_unit do nothing
 *
 * Each rule may also hold `role`, `confidence`, `why` and `plane` (four numbers), which inform its reader alone.
 *
 * EXAMPLES
 *     # mirror.yaml: draw 3 is a mirror, draw 5 is glass, and light 0 has a size, which makes its shadows soft
 *     surfaces:
 *       - { match: { draws: "3" }, reflect: 0.7 }
 *       - { match: { draws: "5" }, reflect: 0.1, transmit: 0.9, ior: 1.5 }
 *     lights:
 *       - { light: 0, radius: 0.5 }
 *
 *     relume look game.trace -o game.look.yaml
 *     relume render game.trace -f 3 --look game.look.yaml --look mirror.yaml -o mirror.####.png
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/frames.h"

/* Pointers are NULL for missing keys. */
struct match {
	const char *texture, *mesh, *draws, *call;
	const uint32_t *list;
	const bool *program, *lit, *textured, *blended, *alpha_tested, *depth_tested, *stencil_tested,
		*environment_mapped, *multiplies, *parallel;
	const uint32_t *units;
	const char *modelview;
	const float *in_plane;
};

/* Keys for the reader of a rule, which have no effect. */
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
	const uint32_t *part;
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
	uint32_t surfaces_count, lights_count, world_count, unseen_count; /* libcyaml requires these names */
};

struct findings;
struct scene;

struct look {
	struct rules *rules;
	struct matched *matched; /* how many draws each rule has matched so far (look/rules/matched.h) */
	struct repaired *repaired; /* repaired meshes (look/rules/repaired.h); NULL: no rule repairs any */
	struct frame_list *draws; /* [surfaces_count] */
	struct unseen {
		struct frame_list draws;
		struct scene *scene; /* scene of its frame; NULL: not loaded. Released by rules_free */
	} *unseen; /* [unseen_count] */
};

/** @return 0; ERR_INPUT (reported, with the line), ERR_SYSTEM (reported) */
int rules_load(const char *path, struct look **out);

/** The same for text in memory. @param name  what messages call it */
int rules_parse(const char *name, const char *text, size_t n, struct look **out);

/** The same for the findings of a study, without a file. */
int rules_from_findings(const char *name, const struct findings *findings, struct look **out);
void rules_free(struct look **look);
