/*
 * Rules about surfaces and lights, written after recording: relume render --look FILE. Every key may be left out. An
 * unknown key is an error, reported with its line. Several files apply in order, and so do the rules of one file:
 * later ones override earlier ones. 'relume look' studies a recording and writes such a file.
 *
 * OpenGL's own picture (channels gl.*) never changes: channel relight holds what rules do to lights and emission.
 * Where a light stands in the world, a frame that does not show where the world is stays as OpenGL drew it.
 *
 * KEYS
 *     surfaces:                   # a list of rules; all that match apply
 *       - match:                  # which draws: every key here must match; without keys: all
 *           texture: 3fa1         # the hash of one of its textures, or its start ('relume scene --json' prints it)
 *           mesh: 90c2            # the same for its mesh
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
 *           environment_mapped: no # texture coordinates are generated from what the surface mirrors
 *           units: 2              # the number of its texture units
 *           multiplies: no        # blending multiplies what is there
 *           parallel: no          # the projection is parallel
 *           modelview: plain      # plain, mirrored, or singular as that of shadows drawn on a plane
 *           in_plane: [0, 1, 0, -2] # lies in this plane of the world (a, b, c, d), up to an edge; matches nothing
 *                                 # where the world is unknown
 *         reflect: 0.2            # share of light that it mirrors, [0,1]
 *         transmit: 0.8           # share of light that passes, as through glass, [0,1]; at most 1 together with
 *                                 # reflect
 *         ior: 1.5                # index of refraction, 1 and more
 *         absorb: [0.2, 0, 0]     # red, green and blue absorbed per unit of eye space inside
 *         roughness: 0.05         # blurs what it mirrors
 *         emission: [0, 0, 0]     # light that it sends out, besides what OpenGL shows
 *         shadows: yes            # whether it casts shadows
 *         passes: none            # light that it lets through in spite of that, instead of what each frame decides:
 *                                 # none, from behind (the only side that it shows), suns (lights at infinity),
 *                                 # suns and from behind, all
 *         mirrors: yes            # whether it is seen in mirrors and through glass
 *         near: yes               # reflect mirrors only what is near; where nothing is, the surface keeps its own
 *                                 # colour
 *         lightmap: 1             # for surfaces that take the lights below: the texture unit that holds light
 *         vertex_light: yes       # for surfaces that take the lights below: vertex colours hold light, and are no
 *                                 # part of the surface's own colour; a single colour for all vertices counts where
 *                                 # it is that of the ambient light below
 *         shadow_unit: 0          # for surfaces that OpenGL lights: the texture unit that holds a shadow; traced
 *                                 # ones replace it
 *         shaded: no              # no: it keeps the light that OpenGL gives it, in shadow too, and takes none of
 *                                 # the lights below
 *         lit: yes                # takes the lights below where OpenGL does not light it
 *         crease: 40              # for surfaces that OpenGL lights face by face: edges of up to this angle look
 *                                 # round, sharper edges stay; degrees, [0,180], default 0. Outlines, shadows'
 *                                 # outlines and channel N stay. Mode path ignores it
 *         repair:                 # closes cracks of its mesh, for all rays but the camera's; repair: {} takes the
 *                                 # defaults
 *           weld: 4e-6            # corners nearer than this share of the mesh's size become one, and corners on
 *                                 # others' edges join them
 *           turn: yes             # faces look out of closed bodies, as glass needs; default: where it transmits
 *           merge: no             # triangles of one plane become fewer, where that cannot be seen
 *         dome: no                # no: it does not take the light of `sky` below
 *         left_out: yes           # a trick that only OpenGL's picture shows. What is `modelview: mirrored` is left
 *                                 # out only in frames with a `solid` mirror, if rules have one
 *         solid: yes              # a mirror that the program blends over its picture: the traced one is not blended
 *         parameters:             # of a hook, for these surfaces ('relume help hook-file')
 *           - { name: tint, value: [1, 0, 0] }
 *     world:                      # meshes that stand still: a frame that draws enough of them shows where the
 *                                 # viewer is
 *       - mesh: 90c2              # its hash
 *         at: [1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 0, 1] # where it stands: a matrix, column by column
 *         part: 1                 # of the recording: nothing says where things of another part are. Default 0
 *     unseen:                     # what stands still but not every frame draws: mirrors and shadows have it in each
 *       - frame: 12               # a frame that draws it
 *         draws: 3-7,12           # with these draw numbers; needs `world`. Frames of the same part get them
 *     lights:                     # a list of rules
 *       - light: 0                # the light of OpenGL that changes; without this key a light is added
 *         off: no                 # yes: it is switched off
 *         position: [0, 5, 0, 1]  # a place; with 0 as fourth number a direction towards the light. In eye space,
 *                                 unless # one of the next two keys says otherwise
 *         object: 90c2            # the position is in the space in which the first mesh of this hash is drawn
 *         space: world            # the position is in the world that the list `world` describes
 *         on: unlit               # lights only what OpenGL does not light (and rules say `lit: yes` about)
 *         diffuse: [1, 1, 1]      # its colour; also ambient and specular
 *         attenuation: [1, 0, 0]  # constant, linear and quadratic, as OpenGL has them
 *         spot: { direction: [0, 0, -1], cutoff: 30, exponent: 0 } # a cone, as OpenGL has it
 *         radius: 0.3             # makes shadows soft: the radius of its sphere; for a direction, the tangent of
 *                                 # half its angle
 *         shadows: yes            # no: nothing blocks it
 *     sky:                        # light from all around, on solid things that no light above lights
 *       reach: 20                 # how far away things dim it, in units of eye space; near ones dim it more
 *       up: [0, 1, 0]             # the direction that `light` comes from, with `ground` opposite; without it all is
 *                                 # `light`
 *       space: world              # the space of `up`; default eye
 *       light: [1, 1, 1]          # its colour from above
 *       ground: [0.5, 0.5, 0.5]   # its colour from below
 *       lit: 0.5                  # how much of it counts where OpenGL lights, [0,1]; default 0
 *       unlit: no                 # no: what OpenGL does not light takes none; default yes
 *     gloss: { share: 1 }         # what is lit with highlights mirrors what is near, by this share; default 0
 *     parameters:                 # of a hook, for all surfaces and for rays that meet none
 *       - { name: bands, value: [4] }
 *     spare: no                   # no: trace surfaces that would shut off light from the whole scene as well, as a
 *                                 # closed room, a backdrop or crossed cards. Default yes: what they darken stays
 *                                 # lit as OpenGL lights it, and a quad that covers the window with a framebuffer
 *                                 # object's picture is traced as that picture
 *     replace: yes                # no: rules with left_out, solid or shadow_unit do nothing
 *
 * Each rule may also hold `role`, `confidence`, `why` and `plane` (four numbers), which only its reader uses.
 *
 * EXAMPLES
 *     # mirror.yaml: draw 3 is a mirror, draw 5 is glass, and light 0 has a size, so that shadows are soft
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

/* Pointers are NULL for keys that the file does not have. */
struct match {
	const char *texture, *mesh, *draws, *call;
	const uint32_t *list;
	const bool *program, *lit, *textured, *blended, *alpha_tested, *depth_tested, *stencil_tested,
		*environment_mapped, *multiplies, *parallel;
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
	uint32_t surfaces_count, lights_count, world_count, unseen_count; /* libcyaml wants these names */
};

struct findings;
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

/** The same for what a study found, without a file. */
int rules_from_findings(const char *name, const struct findings *findings, struct look **out);
void rules_free(struct look **look);
