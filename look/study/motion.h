/*
 * Where the viewer is in each frame, and what stands, moves, or comes along with the viewer, by nothing but where
 * meshes were drawn.
 *
 * A mesh that was drawn before says where the camera must be for it to stand still: its modelview times the inverse of
 * its place in the world. What most of the frame says, by size, is the camera's motion. World space is the eye space of
 * the first frame.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "base/table.h"
#include "scene/scene.h"

enum { MOTION_MAX_FRAMES = 128, MOTION_MAX_THINGS = 65536 };

/* A mesh at its place in the frame's order, followed over the frames. */
struct motion_thing {
	uint64_t mesh[2];      /* its hash; */
	uint64_t turned[2]; /* the same with its quads cut the other way, as they are on the other side of some plane;
	                       0: never seen */
	double world[16];      /* from the mesh into the world, where it was last seen */
	double eye[16];        /* its last modelview */
	double middle[3], size; /* of its box, object space; length of the diagonal */
	uint32_t frames;       /* that drew it */
	uint32_t again;        /* of these, frames with a known camera in which it had been drawn before, */
	uint32_t still;        /* and stood where it was, */
	uint32_t carried;      /* or while the camera moved: was where it was in eye space */
	uint64_t seen[MOTION_MAX_FRAMES / 64]; /* bits of frames */
	uint64_t last;         /* number of the frame that drew it last, counted from 1 */
	uint32_t votes;        /* 1: it is of what decides about the camera: opaque, deep, in a view with depth */
	uint32_t part;         /* the camera's, when it was seen last */
};

/* A mesh whose points move while its triangles stay, by triangles and texture coordinates. */
struct motion_shape {
	uint32_t frames, changed; /* drawn in; with other points than the time before */
	uint64_t points;          /* hash of the last */
	uint64_t last;
	uint32_t triangles;
};

struct motion_camera {
	uint64_t frame;
	double eye_from_world[16];
	double share;  /* of what had been seen before, by size, that stands still under it */
	int witnessed; /* 0: nothing had been seen before; the camera is the last one's */
	int moved;
	uint32_t part; /* part of the recording: the camera is followed through it. Another one has another world space */
};

struct motion {
	struct motion_thing *things;
	size_t n_things, room_things;
	struct motion_shape *shapes;
	size_t n_shapes, room_shapes;
	struct motion_camera *cameras; /* [n_frames] */
	size_t n_frames, room_frames;
	uint32_t n_parts;
	struct table by_key, by_topology; /* -> index + 1 */
	uint32_t *of_instance; /* [n] of the last frame: its thing, or SCENE_NONE */
	size_t room_instances;
};

/**
 * Study one more frame; at most MOTION_MAX_FRAMES, in ascending order. Afterwards of_instance tells which thing each
 * instance is.
 * @return 0 or ERR_SYSTEM (reported)
 */
int motion_add(struct motion *m, const struct scene *scene);
void motion_free(struct motion *m);

/** The camera of the frame that was studied last. */
const struct motion_camera *motion_now(const struct motion *m);

/** The part of the recording that has most frames. count: receives how many */
uint32_t motion_main_part(const struct motion *m, uint32_t *count);

/** 1 where a thing stood still, as far as it was seen again. */
int motion_is_static(const struct motion_thing *t);
