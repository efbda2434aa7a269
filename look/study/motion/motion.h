/*
 * The viewer's position in each frame, and which things stand still, move, or move with the viewer, all derived from
 * where meshes are drawn.
 *
 * A mesh that was drawn before gives the camera that keeps it where it was: its modelview times the inverse of its
 * place in the world. The camera that most of the frame agrees on, by size, is taken. World space is the eye space of
 * the first frame.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "base/table.h"
#include "scene/scene.h"

enum { MOTION_MAX_FRAMES = 128, MOTION_MAX_THINGS = 65536 };

/* A mesh at its place in the drawing order, followed through the frames. */
struct motion_thing {
	uint64_t mesh[2];      /* its hash */
	uint64_t turned[2]; /* hash with its quads split the other way, as they are on the other side of some plane;
	                       0: never seen */
	double world[16];      /* from the mesh to the world, when it was last seen */
	double eye[16];        /* its last modelview */
	double middle[3], size; /* middle of its box in object space; length of the diagonal */
	uint32_t frames;       /* frames that draw it */
	uint32_t again;        /* frames with a known camera that draw it again */
	uint32_t still;        /* frames of `again` where it stood still */
	uint32_t carried;      /* frames of `again` where it stood still in eye space while the camera moved */
	uint64_t seen[MOTION_MAX_FRAMES / 64]; /* one bit for each frame */
	uint64_t last;         /* the last frame that drew it, counted from 1 */
	uint32_t votes;        /* 1: it votes for the camera: opaque, with extent in depth, in a view with depth */
	uint32_t part;         /* the camera's part when it was last seen */
};

/* A mesh whose points move while its triangles stay, identified by triangles and texture coordinates. */
struct motion_shape {
	uint32_t frames, changed; /* frames that draw it; frames where its points had changed */
	uint64_t points;          /* hash of the last points */
	uint64_t last;
	uint32_t triangles;
};

struct motion_camera {
	uint64_t frame;
	double eye_from_world[16];
	double share;  /* share, by size, of the things seen before that stand still under it */
	int witnessed; /* 0: nothing was seen before, and this is the previous camera */
	int moved;
	uint32_t part; /* part of the recording where the camera can be followed; each part has its own world
	                  space */
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
	uint32_t *of_instance; /* [n]: the thing of each instance of the last frame, or SCENE_NONE */
	size_t room_instances;
};

/**
 * Study one more frame; at most MOTION_MAX_FRAMES, in ascending order. Afterwards of_instance holds the thing of each
 * instance.
 * @return 0 or ERR_SYSTEM (reported)
 */
int motion_add(struct motion *m, const struct scene *scene);
void motion_free(struct motion *m);

/** The camera of the last frame studied. */
const struct motion_camera *motion_now(const struct motion *m);

/** The part of the recording with the most frames. @param count  receives their number */
uint32_t motion_main_part(const struct motion *m, uint32_t *count);

/** 1 if a thing stood still whenever it was seen again. */
int motion_is_static(const struct motion_thing *t);
