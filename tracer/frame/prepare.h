/*
 * A frame as the wavefront takes it: scene instances with their matrices and flags, and the frame's events in order,
 * cut into segments. One camera pass answers for each segment.
 */
#pragma once

#include "kernels/shared.h"
#include "scene/scene.h"

/* Clears, then the instances of one view. */
struct segment {
	uint32_t clear_first, clear_count; /* in scene.clears; happen first */
	uint32_t view;                     /* in prepared.views: each segment has its own; SCENE_NONE: clears only */
	uint32_t mode;                     /* CAMERA_*: nearest where that is the same answer, else columns */
	uint32_t instance_first, instance_count; /* in prepared.instances; screen geometry comes last */
	uint32_t screen_count;
	uint32_t multisample; /* its primitives cover samples, not pixels */
};

/* What the rasterizer makes of an instance's primitives (GL 2.1 sec. 3.5.4: polygon modes). */
enum prepared_shape { PREPARED_FILLED, PREPARED_LINES, PREPARED_POINTS };

struct prepared {
	struct segment *segments;
	uint32_t n_segments;

	/* [n_instances]: one of each for every instance. An instance comes twice where its faces have different polygon modes.
	   primitive_first, node and triangle places are not known yet. */
	struct instance *instances;
	struct geometry *geometries;
	enum prepared_shape *shapes;
	uint32_t *culls; /* INSTANCE_CULL_* of those that are to be expanded */
	uint32_t n_instances;

	struct view *views;             /* [n_views], one a segment that draws */
	struct scene_view *scene_views; /* the scene's, beside them; clears of the depth part eye spaces */
	uint32_t n_views;

	uint32_t n_vertices;  /* of all instances */
	uint32_t n_texcoords; /* [4] each */
	uint32_t *owner;      /* [n_vertices]: instance */
	uint8_t *skies;       /* [scene's instances]: 1 where it is a sky */
	uint8_t *depths;      /* the same: 1 where it is solid and shows no colour (scene/depths.h) */
	uint32_t n_light_slots; /* most lights in any lit material */
	int has_vertex_programs, has_fragment_programs;
	int has_mirrors; /* a surface mirrors or lets light through */
	int has_transparency;   /* what stops a ray to a light may let some of it pass */
};

/**
 * Prepare a frame.
 * @param shift  moves the picture, pixels: pixel centres then show what lies beside them
 * @param out  all zero; filled on success; free with prepared_free
 * @return 0 or ERR_SYSTEM (reported)
 */
int prepare_frame(const struct scene *scene, const float shift[2], struct prepared *out);

/** 1 where a program says where an instance's vertices are. */
int prepare_is_displaced(const struct scene *scene, const struct scene_instance *instance);

/** Place a filled instance by its modelview; bake it where that has no inverse, or is projective. */
void prepare_place(struct prepared *p, const struct scene *scene, uint32_t instance);

/** By how much camera rays widen an instance's boxes (struct instance): `positions`, in object space, or in eye space
 * where it is baked. */
void prepare_pad(struct prepared *p, uint32_t instance, const float (*positions)[4], uint32_t n);

/** Move the picture of a prepared frame: its views are as prepare_frame would have made them with this shift. */
void prepare_shift(struct prepared *p, const float shift[2]);
void prepared_free(struct prepared *p);

/** The first segment of the eye space of most instances. @return NULL: rays hit nothing in any */
const struct segment *prepare_main_segment(const struct prepared *p);

/** Where a mesh's arrays lie among the words of its block, in a geometry's fields; relative to `base`. */
void prepare_layout(const struct scene_mesh *mesh, uint32_t base, struct geometry *g);

/** Words of a mesh's vertex arrays, and of its indices. */
size_t prepare_attribute_words(const struct scene_mesh *mesh);
size_t prepare_index_words(const struct scene_mesh *mesh);

/** pool_fill for both: object is a struct scene_mesh. */
void prepare_fill_attributes(const void *object, uint32_t *words);
void prepare_fill_indices(const void *object, uint32_t *words);
