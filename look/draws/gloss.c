#include "look/draws/gloss.h"

#include <math.h>

/* A specular colour is not grey if its components differ by more than this share of the largest. */
#define COLORED 0.15f
#define NO_METAL 0.1f /* factor for other surfaces than metals */
/* Reflections below this are ignored: one step of 8 bits, if white is reflected. */
#define LEAST 0.004f
/* One ray per pixel is too noisy for rougher surfaces. */
#define ROUGHEST 0.2f

static float most_of(const float c[4])
{
	return fmaxf(fmaxf(c[0], c[1]), c[2]);
}

static int is_metal(const struct scene_face *f)
{
	const float most = most_of(f->specular), least = fminf(fminf(f->specular[0], f->specular[1]), f->specular[2]);

	return most > 0 && most - least > COLORED * most && most > most_of(f->diffuse);
}

void gloss_set(const struct scene_material *m, float share, struct scene_surface *surface)
{
	const struct scene_face *f = &m->front;
	const float roughness = sqrtf(2 / (f->shininess + 2));
	/* A rougher surface spreads its reflection over more directions, so that one ray counts less. */
	const float reflect = share * fminf(most_of(f->specular), 1) * (is_metal(f) ? 1 : NO_METAL) * (1 - roughness) *
	                      (1 - roughness);

	if (surface->reflect > 0 || surface->transmit > 0) /* the program draws its own reflections */
		return;
	if (!m->lighting || !(reflect > LEAST) || roughness > ROUGHEST)
		return;
	surface->reflect = fminf(reflect, 1);
	surface->roughness = roughness;
	surface->hidden |= SCENE_NEAR_MIRROR;
}
