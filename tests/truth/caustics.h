/* A wall that receives light only through mirrors and glass (tracer/frame/light/photons.h). */
#pragma once

#include <math.h>

#include "tests/truth/scenes.h"

#define SIZE 32
#define WALL (-10.0)
#define ALBEDO 0.8
#define IOR 1.5

static inline struct tracer_options options_of(unsigned photons)
{
	return (struct tracer_options){ .mode = TRACER_WHITTED, .display = 1, .depth = 4, .photons = photons };
}

/* Perfectly clear glass, or a mirror. */
static inline uint32_t add_material(struct made *t, float reflect, float transmit)
{
	const uint32_t m = made_add_material(t, 1);

	t->materials[m].surface.reflect = reflect;
	t->materials[m].surface.transmit = transmit;
	t->materials[m].surface.ior = (float)IOR;
	return m;
}

/* A wall across the view, with no other object in view. */
static inline void begin(struct made *t, float x, float y, float z, float w)
{
	made_init(t, SIZE, SIZE, 0.2f);
	made_add_light(t, x, y, z, w);
	made_add_square(t, made_add_material(t, (float)ALBEDO), (float[3]){ 0, 0, (float)WALL }, (float[3]){ 1, 0, 0 },
	                (float[3]){ 0, 1, 0 }, 30, 1);
}

/* Position of a pixel on the wall. */
static inline double wall_at(uint32_t pixel)
{
	return ((double)pixel + 0.5 - SIZE / 2.0) / (SIZE / 2.0) * 0.2 * -WALL;
}
