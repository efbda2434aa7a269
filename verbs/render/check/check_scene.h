/*
 * Small scenes that exercise everything the kernels do. Pictures of them drawn on a device are compared with those of
 * the C twins.
 */
#pragma once

#include "tracer/frame/trace.h"
#include "verbs/render/check/made.h"

/* X(NAME, word, mode) */
#define CHECK_SCENES(X) \
	X(OPAQUE, opaque, TRACER_WHITTED)   /* lights, textures, fog, lines, points, flat shading, shadows, lamps of rules */ \
	X(GL, gl, TRACER_GL)               /* the same with camera rays only */ \
	X(BLENDED, blended, TRACER_WHITTED) /* films in any order, holes by the alpha test */ \
	X(STENCIL, stencil, TRACER_WHITTED) /* a window of stencil values, and a shadow volume */ \
	X(MIRROR, mirror, TRACER_WHITTED)   /* a floor and a ball that mirror each other */ \
	X(GLASS, glass, TRACER_WHITTED)     /* a ball and a pane, and their shadows */ \
	X(AO, ao, TRACER_AO)                /* short rays in all directions */ \
	X(PATH, path, TRACER_PATH)          /* light from surface to surface */ \
	X(LINEAR, linear, TRACER_PATH)      /* the same in linear light, two samples: rough mirrors, glass, a lamp */

enum check_scene {
#define CHECK_SCENE_ENUM(name, word, mode) CHECK_##name,
	CHECK_SCENES(CHECK_SCENE_ENUM)
	N_CHECK_SCENES
};

extern const char *const check_scene_names[N_CHECK_SCENES];

/* A scene, and how to draw it. */
struct check_world {
	struct made made;
	struct scene_unit unit;
	struct scene_texture texture;
	const struct scene_texture *textures[1];
	uint8_t texels[4 * (64 + 16 + 4 + 1)]; /* texels of all levels */
	uint32_t programs[192]; /* scene.programs */
	struct tracer_options options;
};

/**
 * Make one of the scenes.
 * @param rings  of its balls: 12 suffice to compare, 64 to measure time
 * @param out    free with check_world_free. Must not be moved
 * @return 0 or ERR_SYSTEM (reported)
 */
int check_world_make(enum check_scene scene, uint32_t width, uint32_t height, uint32_t rings, struct check_world *out);
void check_world_free(struct check_world *world);
